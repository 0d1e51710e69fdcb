//! Free bodies that are pulled off, pushed beyond friction or tipped, in full space beside condensed: rigid statics says
//! which of them have no equilibrium, and a motion proves it.

use crate::common::dense::{difference, dot, largest};
use crate::common::mesh::Stiffness;
use crate::common::solids::{Cells, Order, Solid};
use fastrand::Rng;
use signorini::reduce::ContactPairs;
use signorini::{FrictionLaw, LoadCase, Model, Monitor, Settings, Solution, Status};

/// A block of the edges `width` and, upwards, `height` on a plane.
struct Block {
    dim: usize,
    stiffness: Stiffness,
    /// Degrees of freedom of the nodes on the plane, node after node.
    slaves: Vec<usize>,
    normals: Vec<f64>,
    load: Vec<f64>,
    /// Nodes on the upper side.
    top: Vec<usize>,
}

impl Block {
    /// A block under a weight of 1, spread evenly over its nodes.
    fn new(dim: usize, cells: usize, [width, height]: [f64; 2]) -> Block {
        let line =
            |to: f64| -> Vec<f64> { (0..=cells).map(|i| to * i as f64 / cells as f64).collect() };
        let (flat, upright) = (line(width), line(height));
        let lines: Vec<&[f64]> =
            (0..dim).map(|c| if c + 1 < dim { &flat[..] } else { &upright[..] }).collect();
        let mut rng = Rng::with_seed(0);
        let order = (Cells::Boxes, Order::Linear);
        let solid = Solid::new(&lines, order, (100.0, 0.3), (0.0, &mut rng));
        let level = |height: f64| -> Vec<usize> {
            (0..solid.nodes.len()).filter(|&node| solid.nodes[node][dim - 1] == height).collect()
        };
        let (bottom, top) = (level(0.0), level(height));
        let mut load = vec![0.0; solid.size()];
        let weight = 1.0 / solid.nodes.len() as f64;
        load.iter_mut().skip(dim - 1).step_by(dim).for_each(|f| *f -= weight);
        let mut down = vec![0.0; dim];
        down[dim - 1] = -1.0;
        Block {
            dim,
            stiffness: Solid::stiffness(&[&solid]),
            slaves: bottom.iter().flat_map(|node| dim * node..dim * (node + 1)).collect(),
            normals: down.repeat(bottom.len()),
            load,
            top,
        }
    }

    /// The block with a further force, spread evenly over some of its nodes.
    fn loaded(mut self, nodes: &[usize], force: &[f64]) -> Block {
        for node in nodes {
            for (c, f) in force.iter().enumerate() {
                self.load[self.dim * node + c] += f / nodes.len() as f64;
            }
        }
        self
    }

    fn bottom(&self) -> Vec<usize> {
        self.slaves.iter().step_by(self.dim).map(|dof| dof / self.dim).collect()
    }

    fn solved(&self, full_space: bool, law: FrictionLaw<'_>) -> (Model, Solution) {
        let count = self.slaves.len() / self.dim;
        let pairs = ContactPairs {
            dim: self.dim,
            count,
            slaves: &self.slaves,
            master_start: &vec![0; count + 1],
            masters: &[],
            weights: &[],
            normals: &self.normals,
            tangents: None,
            ..ContactPairs::default()
        };
        let settings = Settings { full_space, ..Settings::default() };
        let monitor = &mut Monitor::new(&settings, None);
        let model = self.stiffness.model_under(&[], &pairs, monitor).unwrap();
        let (load, gap) = (&self.load[..], &vec![0.0; count][..]);
        let case = LoadCase { load, prescribed: None, gap, law, reference_slip: None };
        let settings = Settings::default();
        let solution = model.solve(&case, &settings, None, &mut Monitor::new(&settings, None));
        (model, solution.unwrap())
    }

    /// Solves in both forms and compares; `left` is the resultant that contact leaves in the host's axes, if it is known.
    fn compare(&self, (mu, given): (f64, bool), status: Status, left: Option<&[f64]>, name: &str) {
        let count = self.slaves.len() / self.dim;
        let values = vec![if given { mu / count as f64 } else { mu }; count];
        let law = if given { FrictionLaw::Tresca(&values) } else { FrictionLaw::Coulomb(&values) };
        let [(dense, condensed), (_, full)] = [false, true].map(|full| self.solved(full, law));
        for solution in [&condensed, &full] {
            assert_eq!(solution.status, status, "{name}: {}", solution.message);
        }
        if status == Status::Solved {
            return;
        }
        let load = dense.condensed_load(&self.load, None).unwrap();
        let r = full.recession.as_ref().unwrap();
        self.judge(&dense, &load, (r, if given { 0.0 } else { mu }), name);
        let [one, other] =
            [&condensed, &full].map(|solution| &solution.escape.as_ref().unwrap().motion);
        // Rotations about an edge and translations that symmetry leaves are unique; 1e-6 of a strain is left in them.
        assert!(largest(&difference(one, other)) <= 1e-5, "{name}: {one:?}, {other:?}");
        for solution in [&condensed, &full] {
            let Some(left) = left else { continue };
            let message = solution.message.to_string();
            let (_, force) = message.split_once("the force is (").expect(&message);
            let (force, _) = force.split_once(')').unwrap();
            let force: Vec<f64> = force.split(", ").map(|f| f.parse().unwrap()).collect();
            // Four digits are written.
            assert!(largest(&difference(&force, left)) <= 1e-3, "{name}: {message}");
        }
    }

    /// `r` proves that there is no equilibrium: nothing resists it, it lifts slips by `mu`, and the loads do work.
    fn judge(&self, model: &Model, load: &[f64], (r, mu): (&[f64], f64), name: &str) {
        let (n, k) = (r.len(), model.stiffness());
        let largest_entry = largest(k);
        for i in 0..n {
            let force: f64 = (0..n).map(|j| k[i + n * j] * r[j]).sum();
            // The rounding of a condensation, 3e-12 of the stiffness of a pair.
            assert!(force.abs() <= 1e-10 * largest_entry, "{name}: {force:e}");
        }
        for pair in r.chunks_exact(self.dim) {
            let slip = dot(&pair[1..], &pair[1..]).sqrt();
            assert!(pair[0] + mu * slip <= 1e-9, "{name}: {pair:?}");
        }
        assert!(dot(load, r) > 0.0, "{name}");
    }
}

/// A direction along the plane.
fn along(dim: usize, force: f64) -> Vec<f64> {
    let mut all = vec![0.0; dim];
    all[0] = force;
    all
}

fn upwards(dim: usize, force: f64) -> Vec<f64> {
    let mut all = vec![0.0; dim];
    all[dim - 1] = force;
    all
}

/// Pulled by more than the weight 1 a block flies off along the sum of both; by less it stays. Given friction does not hold it.
#[test]
fn a_block_that_is_pulled_off() {
    for (dim, cells) in [(2, 4), (2, 11), (3, 3), (3, 5)] {
        for pull in [0.9, 1.1, 30.0] {
            let block = Block::new(dim, cells, [2.0, 1.0]);
            let all: Vec<usize> = (0..block.stiffness.size / dim).collect();
            let block = block.loaded(&all, &upwards(dim, pull));
            let status = if pull < 1.0 { Status::Solved } else { Status::NoEquilibrium };
            let left = upwards(dim, pull - 1.0);
            for given in [false, true] {
                let name = format!("{dim}, {cells}, {pull}, {given}");
                block.compare((0.4, given), status, Some(&left), &name);
            }
        }
    }
}

/// Pushed at its base by more than `mu` times its weight a block slides, and the force beyond friction is left; with a
/// given friction of `mu` in all it is the same.
#[test]
fn a_block_that_is_pushed_beyond_friction() {
    for (dim, cells) in [(2, 4), (2, 11), (3, 3), (3, 5)] {
        for (ratio, given) in [(0.8, false), (1.02, false), (3.0, false), (0.8, true), (1.3, true)]
        {
            let block = Block::new(dim, cells, [2.0, 0.5]);
            let base = block.bottom();
            let block = block.loaded(&base, &along(dim, 0.3 * ratio));
            let status = if ratio < 1.0 { Status::Solved } else { Status::NoEquilibrium };
            let left = along(dim, 0.3 * (ratio - 1.0));
            let name = format!("{dim}, {cells}, {ratio}, {given}");
            block.compare((0.3, given), status, Some(&left), &name);
        }
    }
}

/// A force `T` on the top of a block of height 2 and width 1 tips it over its edge if `2 T > 1 / 2`; friction of 1 holds.
#[test]
fn a_block_that_tips() {
    for (dim, cells) in [(2, 4), (2, 11), (3, 3), (3, 5)] {
        for push in [0.2, 0.26, 0.5] {
            let block = Block::new(dim, cells, [1.0, 2.0]);
            let top = block.top.clone();
            let block = block.loaded(&top, &along(dim, push));
            let status = if push < 0.25 { Status::Solved } else { Status::NoEquilibrium };
            block.compare((1.0, false), status, None, &format!("{dim}, {cells}, {push}"));
        }
    }
}
