//! Bodies that contact alone holds, in each form of their problem: that no equilibrium exists is proved in every one
//! where rigid statics says so, and in none where it says otherwise.
//!
//! `SIGNORINI_FORMS=1000` tries so many of each kind.

use crate::common::brick::Vector;
use crate::common::contact_alone::{ContactAlone, KINDS};
use crate::common::dense::{dot, norm};
use crate::common::mesh::{Block, Mesh};
use crate::common::problems::uniform;
use crate::common::rigid_statics::{Statics, distance};
use crate::rows::Host;
use fastrand::Rng;
use signorini::{
    ContactData, ContactProblem, FrictionLaw, LoadCase, Model, Monitor, Settings, Solution, Status,
    solve,
};

/// Problems of each kind in the ordinary run.
const FEW: usize = 60;

/// The rest of the loads that no forces balance, relative to them: up to the first it is rounding, from the second on
/// it is not.
const ROUNDING: f64 = 1e-12;
const CLEAR: f64 = 1e-8;

fn count() -> usize {
    let wanted = std::env::var("SIGNORINI_FORMS").ok();
    wanted.map_or(FEW, |wanted| wanted.parse().expect("a number of problems"))
}

/// A host with loads and coefficients.
struct Problem {
    host: Host,
    load: Vec<f64>,
    gap: Vec<f64>,
    mu: Vec<f64>,
}

impl Problem {
    fn case(&self) -> LoadCase<'_> {
        let law = FrictionLaw::Coulomb(&self.mu);
        LoadCase { load: &self.load, prescribed: None, gap: &self.gap, law, reference_slip: None }
    }

    fn solved(&self, model: &Model) -> Solution {
        let settings = &Settings::default();
        model.solve(&self.case(), settings, None, &mut Monitor::new(settings, None)).unwrap()
    }

    /// The solution of each form, with its name; none if the model is refused.
    fn forms(&self) -> Vec<(&'static str, Solution)> {
        let Ok(condensed) = self.host.model() else { return vec![] };
        let mut all = vec![("condensed", self.solved(&condensed))];
        let mut add = |name, problem: &Problem| {
            all.extend(problem.host.model().ok().map(|model| (name, problem.solved(&model))));
        };
        add("in the opposite order", &self.reversed());
        if self.host.dim == 2 {
            [0.3, 1.0].into_iter().for_each(|angle| add("turned", &self.turned(angle)));
        }
        if condensed.dependent_pairs().is_empty() {
            let settings = Settings { full_space: true, ..Settings::default() };
            let full = self.host.model_with(&settings).unwrap();
            all.push(("in full space", self.solved(&full)));
            all.push(("dense", self.dense(&condensed)));
        }
        all
    }

    /// The condensed stiffness, solved by itself.
    fn dense(&self, model: &Model) -> Solution {
        let load = model.condensed_load(&self.load, None).unwrap();
        let data = ContactData {
            dim: self.host.dim,
            pairs: self.mu.len(),
            stiffness: model.stiffness(),
            ld: load.len(),
            load: &load,
            gap: &self.gap,
            law: FrictionLaw::Coulomb(&self.mu),
            reference_slip: None,
        };
        let settings = &Settings::default();
        let problem = ContactProblem::new(data).unwrap();
        solve(&problem, settings, None, &mut Monitor::new(settings, None)).unwrap()
    }

    /// In axes that are turned by an angle.
    fn turned(&self, angle: f64) -> Problem {
        let (sin, cos) = angle.sin_cos();
        let turn = |values: &[f64]| -> Vec<f64> {
            let each = values.chunks_exact(2);
            each.flat_map(|v| [cos * v[0] - sin * v[1], sin * v[0] + cos * v[1]]).collect()
        };
        let mut host = self.host.clone();
        let n = host.size();
        for _ in 0..2 {
            let columns: Vec<f64> = host.stiffness.chunks_exact(n).flat_map(turn).collect();
            let transposed = (0..n * n).map(|k| columns[k / n + n * (k % n)]);
            host.stiffness = transposed.collect();
        }
        host.normals = turn(&host.normals);
        host.tangents = host.tangents.map(|tangents| turn(&tangents));
        Problem { host, load: turn(&self.load), gap: self.gap.clone(), mu: self.mu.clone() }
    }

    /// The pairs in the opposite order.
    fn reversed(&self) -> Problem {
        let (mut host, dim) = (self.host.clone(), self.host.dim);
        host.rows.reverse();
        let vectors =
            |of: &[f64]| of.chunks_exact(dim).rev().flatten().copied().collect::<Vec<f64>>();
        host.normals = vectors(&host.normals);
        host.tangents = host.tangents.map(|tangents| vectors(&tangents));
        let back = |values: &[f64]| values.iter().rev().copied().collect();
        Problem { host, load: self.load.clone(), gap: back(&self.gap), mu: back(&self.mu) }
    }
}

/// Asserts of so many problems what statics says, for each that it decides; `make` makes one of a seed.
fn each_form_agrees(make: impl Fn(usize) -> (Problem, Statics)) {
    let (mut odd, mut driven, mut proved, mut solved) = (Vec::new(), 0, 0, 0);
    for seed in 0..count() {
        let (problem, statics) = make(seed);
        driven += usize::from(statics == Statics::Driven);
        for (form, solution) in problem.forms() {
            let is_proved = solution.status == Status::NoEquilibrium;
            proved += usize::from(is_proved);
            solved += usize::from(solution.status == Status::Solved);
            let agrees = match statics {
                Statics::Driven => is_proved,
                Statics::Balanced => !is_proved,
                Statics::Undecided => true,
            };
            if !agrees {
                odd.push(format!("{seed} {form}, {statics:?}: {}", solution.message));
            }
        }
    }
    println!("{driven} driven, {proved} forms proved, {solved} solved, {} odd", odd.len());
    assert!(odd.is_empty(), "{}", odd.join("\n"));
    assert!(driven > 0 && solved > 0);
}

/// A wall in running bond: bricks of one element, 2 wide and 1 high.
struct Wall {
    mesh: Mesh,
    courses: Vec<Vec<Block>>,
    /// So many courses, from the lowest on, are between abutments.
    held: usize,
    /// Corners meet at every joint, so that rows depend on each other; otherwise on top alone.
    all_meet: bool,
}

impl Wall {
    fn new(rng: &mut Rng, all_meet: bool) -> Wall {
        let (columns, courses) = (rng.usize(2..=4), rng.usize(1..=4));
        let shift = uniform(rng, 0.1, 1.9);
        let mut mesh = Mesh::default();
        let mut brick = |left: f64, level: f64| {
            mesh.block(&[left, left + 2.0], &[level, level + 1.0], (1000.0, 0.2))
        };
        let course = |j: usize| -> Vec<Block> {
            let left = shift * (j % 2) as f64;
            (0..columns).map(|i| brick(left + 2.0 * i as f64, j as f64)).collect()
        };
        let all = (0..courses).map(course).collect();
        Wall { mesh, courses: all, held: rng.usize(0..=courses), all_meet }
    }

    /// A course with the one above, if there is one.
    fn beds(&self) -> impl Iterator<Item = (&Block, &Block)> {
        let both = self.courses.windows(2);
        both.flat_map(|both| both[0].iter().flat_map(|b| both[1].iter().map(move |a| (b, a))))
    }

    /// Lower corners stand on the floor, corners on the bricks above and below between their ends; those of bricks beside
    /// each other meet.
    fn host(&self) -> Host {
        let (mut rows, mut normals) = (vec![], vec![]);
        let mut add = |row: Vec<(usize, f64)>, normal: [f64; 2]| {
            rows.push(row);
            normals.extend(normal);
        };
        let floor = self.courses[0].iter().flat_map(|brick| brick.row(0));
        floor.for_each(|corner| add(vec![(corner, 1.0)], [0.0, -1.0]));
        for (j, course) in self.courses.iter().enumerate() {
            let last = j + 1 == self.courses.len();
            for level in [0, 1] {
                let meet = self.all_meet || last && level == 1;
                for two in course.windows(2).filter(|_| meet) {
                    let both = [(two[1].node(0, level), 1.0), (two[0].node(1, level), -1.0)];
                    add(both.to_vec(), [-1.0, 0.0]);
                }
                if j < self.held && (self.all_meet || level == 1) {
                    add(vec![(course[0].node(0, level), 1.0)], [-1.0, 0.0]);
                    add(vec![(course[course.len() - 1].node(1, level), 1.0)], [1.0, 0.0]);
                }
            }
        }
        for (below, above) in self.beds() {
            let (top, bottom) = (below.row(1), above.row(0));
            for (corners, edge, normal) in [(&bottom, &top, -1.0), (&top, &bottom, 1.0)] {
                let on = corners.iter().filter_map(|&corner| self.on(corner, edge));
                on.for_each(|row| add(row, [0.0, normal]));
            }
        }
        let stiffness = self.mesh.stiffness().dense();
        Host { dim: 2, stiffness, fixed: vec![], rows, normals, tangents: None }
    }

    /// The row of a corner on an edge, if it is between its ends.
    fn on(&self, corner: usize, edge: &[usize]) -> Option<Vec<(usize, f64)>> {
        let share = (self.mesh.nodes[corner][0] - self.mesh.nodes[edge[0]][0]) / 2.0;
        let row = vec![(corner, 1.0), (edge[0], share - 1.0), (edge[1], -share)];
        (share > 0.0 && share < 1.0).then_some(row)
    }

    /// Weights of 1, and a force on the upper corners of the last brick.
    fn load(&self, force: [f64; 2]) -> Vec<f64> {
        let mut load = vec![0.0; self.mesh.size()];
        load.iter_mut().skip(1).step_by(2).for_each(|load| *load = -0.25);
        let last = self.courses.last().and_then(|course| course.last()).unwrap();
        for corner in last.row(1) {
            (0..2).for_each(|axis| load[2 * corner + axis] += 0.5 * force[axis]);
        }
        load
    }

    /// The motions of each brick, two translations and a rotation about its middle, of all nodes.
    fn motions(&self) -> Vec<Vec<f64>> {
        let bricks = self.courses.iter().flatten();
        let of_brick = |brick: &Block| {
            let [x, y] = self.mesh.nodes[brick.node(0, 0)];
            let mut motions = vec![vec![0.0; self.mesh.size()]; 3];
            for node in brick.nodes() {
                let [from_x, from_y] = [self.mesh.nodes[node][0] - x, self.mesh.nodes[node][1] - y];
                (motions[0][2 * node], motions[1][2 * node + 1]) = (1.0, 1.0);
                (motions[2][2 * node], motions[2][2 * node + 1]) = (0.5 - from_y, from_x - 1.0);
            }
            motions
        };
        bricks.flat_map(of_brick).collect()
    }

    /// If forces in the cones of the pairs balance the loads on rigid bricks.
    fn statics(&self, problem: &Problem) -> Statics {
        let motions = self.motions();
        let on_motions =
            |force: &[f64]| motions.iter().map(|r| dot(r, force)).collect::<Vec<f64>>();
        let loads = on_motions(&problem.load);
        let target: Vec<f64> = loads.iter().map(|load| load / norm(&loads)).collect();
        let normals = problem.host.normals.chunks_exact(2).zip(&problem.mu);
        let edges = problem.host.rows.iter().zip(normals).flat_map(|(row, (n, mu))| {
            [*mu, -mu].map(|slope| {
                let mut force = vec![0.0; problem.load.len()];
                for &(node, weight) in row {
                    force[2 * node] += weight * (slope * n[1] - n[0]);
                    force[2 * node + 1] -= weight * (slope * n[0] + n[1]);
                }
                on_motions(&force)
            })
        });
        match distance(&target, &edges.collect::<Vec<_>>()) {
            rest if rest <= ROUNDING => Statics::Balanced,
            rest if rest >= CLEAR => Statics::Driven,
            _ => Statics::Undecided,
        }
    }

    /// A wall with its answer.
    fn random(seed: usize, all_meet: bool) -> (Problem, Statics) {
        let rng = &mut Rng::with_seed(seed as u64);
        let wall = Wall::new(rng, all_meet);
        let (host, load) =
            (wall.host(), wall.load([uniform(rng, -1.0, 1.0), uniform(rng, -1.0, 0.5)]));
        let mu = uniform(rng, 0.2, 1.0) * [0.0, 0.1, 1.0, 2.0][seed % 4];
        let pairs = host.rows.len();
        let problem = Problem { host, load, gap: vec![0.0; pairs], mu: vec![mu; pairs] };
        let statics = wall.statics(&problem);
        (problem, statics)
    }
}

#[test]
fn walls_of_independent_pairs() {
    each_form_agrees(|seed| Wall::random(seed, false));
}

/// Between abutments bricks press on each other without a load: a motion of such bricks that rounding makes must not
/// take away what drives the others.
#[test]
fn walls_of_dependent_pairs() {
    each_form_agrees(|seed| Wall::random(seed, true));
}

#[test]
fn random_bodies() {
    each_form_agrees(|seed| {
        let kind = KINDS[seed % KINDS.len()];
        let bodies = ContactAlone::random(&mut Rng::with_seed(seed as u64), kind);
        let (whole, dim) = (&bodies.whole, bodies.raw.dim);
        let row = |&(slave, master): &(usize, Option<usize>)| {
            [(slave, 1.0)].into_iter().chain(master.map(|master| (master, -1.0))).collect()
        };
        let axes = |k: usize| {
            let own = |frame: &Vec<Vector>| frame[k][..dim].to_vec();
            whole.frames.iter().flat_map(own).collect::<Vec<f64>>()
        };
        let host = Host {
            dim,
            stiffness: whole.stiffness.clone(),
            fixed: vec![],
            rows: whole.nodes.iter().map(row).collect(),
            normals: axes(0),
            tangents: Some(axes(1)),
        };
        let mu = (0..bodies.raw.pairs).map(|pair| bodies.raw.law.of(pair)[0]).collect();
        let problem = Problem { host, load: whole.load.clone(), gap: bodies.raw.gap.clone(), mu };
        (problem, bodies.statics())
    });
}
