//! Hosts that have eliminated degrees of freedom have the solutions of the whole model: turned nodal axes, a rigid
//! face, skewed symmetry, a cyclic sector. Condensed and in full space, with displacements.
//!
//! All are solved to 1e-12 of the forces; the meshes enlarge that to less than 1e-9.

use std::f64::consts::PI;

use crate::common::brick::{Brick, Support};
use crate::common::dense::largest;
use crate::common::mesh::{Block, Mesh, Pairs, steps};
use crate::constrained::{Constrained, Terms, close, in_axes, solved};
use signorini::reduce::ContactPairs;
use signorini::{Model, Monitor, Settings, Solution, State};

const TOLERANCE: f64 = 1e-9;

fn both_engines() -> [Settings; 2] {
    [false, true].map(|full_space| Settings { full_space, ..Settings::default() })
}

/// The dense stiffness with more rows of zeros behind it.
fn with_more(dense: &[f64], size: usize, more: usize) -> Vec<f64> {
    let all = size + more;
    let mut larger = vec![0.0; all * all];
    for j in 0..size {
        larger[all * j..all * j + size].copy_from_slice(&dense[size * j..size * (j + 1)]);
    }
    larger
}

/// Rows by degree of freedom of slaves against masters, by nodes with signed weights.
fn rows_of(nodes: &[Vec<(usize, f64)>]) -> Vec<Vec<(usize, Vec<f64>)>> {
    let of_node = |&(node, weight): &(usize, f64)| {
        [(2 * node, vec![weight, 0.0]), (2 * node + 1, vec![0.0, weight])]
    };
    nodes.iter().map(|row| row.iter().flat_map(of_node).collect()).collect()
}

fn signed(pairs: &Pairs) -> Vec<Vec<(usize, f64)>> {
    let row = |(slave, masters): (&usize, &Vec<(usize, f64)>)| {
        let masters = masters.iter().map(|(node, weight)| (*node, -weight));
        std::iter::once((*slave, 1.0)).chain(masters).collect()
    };
    pairs.slaves.iter().zip(&pairs.masters).map(row).collect()
}

/// Solves both hosts of a structure in both engines, checks the solution in the whole structure, and shows it with
/// all displacements of the whole structure. `load` is that of the whole structure.
fn solutions(
    structure: &Constrained,
    load: &[f64],
    gap: &[f64],
    mu: f64,
    check: &mut dyn FnMut(&Model, &Solution, &[f64]),
) {
    for settings in both_engines() {
        let whole = structure.whole(&settings);
        let solution = solved(&whole, load, gap, mu);
        let u = whole.recover(Some(load), None, &solution.d).unwrap();
        let nodal = whole.nodal_forces(&solution.certificate.force).unwrap();
        let frames = whole.frames().unwrap();
        structure.assert_balanced((frames, load), &solution, (&u, &nodal), TOLERANCE);
        check(&whole, &solution, &u);
        let eliminated = structure.eliminated(&settings);
        let own = structure.gathered(load);
        let other = solved(&eliminated, &own, gap, mu);
        close(&other.d, &solution.d, TOLERANCE, "d of the eliminated host");
        let (force, expected) = (&other.certificate.force, &solution.certificate.force);
        close(force, expected, TOLERANCE, "F of the eliminated host");
        let z = eliminated.recover(Some(&own), None, &other.d).unwrap();
        let independents = structure.independents();
        let expected: Vec<f64> = independents.iter().map(|&dof| u[dof]).collect();
        close(&z, &expected, TOLERANCE, "u of the eliminated host");
        check(&eliminated, &other, &u);
    }
}

/// Open, slipping and sticking pairs are there, so that a comparison means something.
fn assert_mixed(solution: &Solution, states: &[State]) {
    for state in states {
        assert!(solution.certificate.states.contains(state), "{:?}", solution.certificate.states);
    }
}

/// A punch pressed and pushed on a block, on meshes that do not match.
fn punch(columns: usize) -> (Mesh, [Block; 2], Pairs, Vec<f64>) {
    let mut mesh = Mesh::default();
    let lower = mesh.block(&steps(-1.0, 4.0, 10), &steps(0.0, 2.0, 3), (2000.0, 0.3));
    let upper = mesh.block(&steps(0.0, 3.0, columns), &steps(2.0, 3.0, 2), (700.0, 0.3));
    let masters = upper.row(0).into_iter().map(|node| {
        let place = (mesh.nodes[node][0] + 1.0) / 0.5;
        let left = (place.floor() as usize).min(9);
        let share = place - left as f64;
        vec![(lower.node(left, 3), 1.0 - share), (lower.node(left + 1, 3), share)]
    });
    let masters: Vec<_> = masters.collect();
    let pairs = Pairs::new(&upper.row(0), &masters, [0.0, -1.0]);
    let mut load = vec![0.0; mesh.size()];
    mesh.traction(&upper.row(2), [3.0, -15.0], &mut load);
    (mesh, [lower, upper], pairs, load)
}

fn held(block: &Block) -> Vec<usize> {
    block.row(0).iter().flat_map(|node| [2 * node, 2 * node + 1]).collect()
}

#[test]
fn turned_axes() {
    let (mesh, [lower, _], pairs, load) = punch(7);
    let size = mesh.size();
    let fixed = held(&lower);
    let gap: Vec<f64> = (0..pairs.count()).map(|i| if i == 2 { 0.1 } else { 0.0 }).collect();
    let plain = mesh.stiffness().model(&fixed, &pairs).unwrap();
    let reference = solved(&plain, &load, &gap, 0.25);
    assert_mixed(&reference, &[State::Open, State::Slip, State::Stick]);
    let u_plain = plain.recover(Some(&load), None, &reference.d).unwrap();
    // Each contact node has axes of its own: they stand behind the degrees of freedom of the mesh.
    let mut nodes: Vec<usize> = signed(&pairs).concat().iter().map(|(node, _)| *node).collect();
    nodes.sort_unstable();
    nodes.dedup();
    let mut equations: Vec<(usize, Terms)> = Vec::new();
    for (k, node) in nodes.iter().enumerate() {
        let (sin, cos) = (0.3 + 1.7 * k as f64).sin_cos();
        let own = [size + 2 * k, size + 2 * k + 1];
        equations.push((2 * node, vec![(own[0], cos), (own[1], -sin)]));
        equations.push((2 * node + 1, vec![(own[0], sin), (own[1], cos)]));
    }
    let structure = Constrained {
        dim: 2,
        stiffness: with_more(&mesh.stiffness().dense(), size, 2 * nodes.len()),
        fixed,
        equations,
        rows: rows_of(&signed(&pairs)),
        normals: pairs.normals.concat(),
        tangents: None,
    };
    let mut all = load.clone();
    all.resize(structure.size(), 0.0);
    solutions(&structure, &all, &gap, 0.25, &mut |_, solution, u| {
        close(&solution.d, &reference.d, TOLERANCE, "d");
        close(&solution.certificate.force, &reference.certificate.force, TOLERANCE, "F");
        close(&u[..size], &u_plain, TOLERANCE, "u");
    });
}

/// The face of the punch is rigid: three degrees of freedom behind those of the mesh, of which none has a stiffness of
/// its own. Slaves are its nodes.
#[test]
fn a_rigid_face() {
    // More slaves than masters would depend on each other.
    let (mesh, [lower, upper], pairs, load) = punch(5);
    let size = mesh.size();
    let mut equations: Vec<(usize, Terms)> = Vec::new();
    for node in upper.row(0) {
        let [x, y] = mesh.nodes[node];
        equations.push((2 * node, vec![(size, 1.0), (size + 2, -(y - 3.0))]));
        equations.push((2 * node + 1, vec![(size + 1, 1.0), (size + 2, x - 1.5)]));
    }
    let structure = Constrained {
        dim: 2,
        stiffness: with_more(&mesh.stiffness().dense(), size, 3),
        fixed: held(&lower),
        equations,
        rows: rows_of(&signed(&pairs)),
        normals: pairs.normals.concat(),
        tangents: None,
    };
    let mut all = load.clone();
    // A moment that lifts an end.
    all.extend([0.0, 0.0, 55.0]);
    let gap = vec![0.0; pairs.count()];
    solutions(&structure, &all, &gap, 0.25, &mut |model, solution, u| {
        assert!(model.dependent_pairs().is_empty());
        assert_mixed(solution, &[State::Open, State::Slip]);
        // The distances of its nodes stay: rotations are small, so along the line it was on.
        let along: Vec<f64> = upper.row(0).iter().map(|node| u[2 * node]).collect();
        assert!(along.iter().all(|u| (u - along[0]).abs() <= 1e-12 * along[0].abs()));
    });
}

/// A whole block on an inclined plane, and its half with nodes that slide along the plane of symmetry, which is across
/// no axis.
#[test]
fn skewed_symmetry() {
    let (sin, cos) = 0.6_f64.sin_cos();
    let turn = |[x, y]: [f64; 2]| [cos * x - sin * y, sin * x + cos * y];
    let normal = turn([0.0, -1.0]);
    let make = |x: Vec<f64>| {
        let mut mesh = Mesh::default();
        let block = mesh.block(&x, &steps(0.0, 2.0, 4), (1000.0, 0.3));
        let straight = mesh.nodes.clone();
        mesh.nodes.iter_mut().for_each(|node| *node = turn(*node));
        let mut load = vec![0.0; mesh.size()];
        // More in the middle: the ends lift.
        for ends in block.row(4).windows(2) {
            let middle = (straight[ends[0]][0] + straight[ends[1]][0]) / 2.0;
            mesh.traction(ends, turn([0.0, -20.0 * (-middle * middle).exp()]), &mut load);
        }
        (mesh, block, load)
    };
    let (whole, block, load) = make(steps(-3.0, 3.0, 12));
    let pairs = Pairs::on_obstacle(&block.row(0), normal);
    let plain = whole.stiffness().model(&[], &pairs).unwrap();
    let reference = solved(&plain, &load, &[0.0; 13], 0.2);
    assert_mixed(&reference, &[State::Open, State::Slip]);
    let u_plain = plain.recover(Some(&load), None, &reference.d).unwrap();

    let (half, own, load) = make(steps(0.0, 3.0, 6));
    // Nodes on the plane: u . m = 0 with m = turn(1, 0), solved for u_x.
    let equations =
        own.column(0).into_iter().map(|node| (2 * node, vec![(2 * node + 1, -sin / cos)]));
    let structure = Constrained {
        dim: 2,
        stiffness: half.stiffness().dense(),
        fixed: vec![],
        equations: equations.collect(),
        rows: rows_of(&own.row(0).iter().map(|&node| vec![(node, 1.0)]).collect::<Vec<_>>()),
        normals: [normal; 7].concat(),
        tangents: None,
    };
    solutions(&structure, &load, &[0.0; 7], 0.2, &mut |model, solution, u| {
        // The pair on the plane is held along its tangent: nothing depends on anything.
        assert!(model.dependent_pairs().is_empty());
        assert_eq!((solution.d[1], solution.certificate.force[1]), (0.0, 0.0));
        let d = &reference.d[12..];
        assert!((d[1] / largest(d)).abs() <= TOLERANCE, "{}", d[1]);
        close(&solution.d, d, TOLERANCE, "d");
        let mut force = reference.certificate.force[12..].to_vec();
        // The half of a pair.
        (force[0], force[1]) = (force[0] / 2.0, 0.0);
        close(&solution.certificate.force, &force, TOLERANCE, "F");
        for j in 0..=4 {
            for i in 0..=6 {
                let (a, b) = (2 * own.node(i, j), 2 * block.node(i + 6, j));
                close(&u[a..a + 2], &u_plain[b..b + 2], 1e-9, "u of a node");
            }
        }
    });
}

/// A ring in `sectors` sectors of 60 degrees: nodes at radii and angles, counterclockwise.
#[derive(Clone, Copy)]
struct Ring {
    first: usize,
    columns: usize,
    closed: bool,
}

impl Ring {
    fn new(
        mesh: &mut Mesh,
        radii: &[f64],
        (from, columns, sectors): (f64, usize, usize),
        material: (f64, f64),
    ) -> Ring {
        let (first, all, closed) = (mesh.nodes.len(), columns * sectors, sectors == 6);
        let ring = Ring { first, columns: if closed { all } else { all + 1 }, closed };
        for radius in radii {
            for i in 0..ring.columns {
                let angle = from + PI / 3.0 * i as f64 / columns as f64;
                mesh.nodes.push([radius * angle.cos(), radius * angle.sin()]);
            }
        }
        for j in 0..radii.len() - 1 {
            for i in 0..all {
                let nodes = [(i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j)];
                mesh.elements.push((nodes.map(|(i, j)| ring.node(i, j)), material));
            }
        }
        ring
    }

    fn node(&self, i: usize, j: usize) -> usize {
        let i = if self.closed { i % self.columns } else { i };
        self.first + i + self.columns * j
    }
}

/// A ring around a hub that is held inside, turned and pressed by loads that repeat in each of six sectors. The ring
/// has three elements in a sector and the hub four, shifted by 5 degrees.
struct Joint {
    mesh: Mesh,
    hub: Ring,
    ring: Ring,
    load: Vec<f64>,
}

const SHIFT: f64 = PI / 36.0;

impl Joint {
    fn new(sectors: usize) -> Joint {
        let mut mesh = Mesh::default();
        let hub = Ring::new(&mut mesh, &[1.0, 1.5, 2.0], (SHIFT, 4, sectors), (1000.0, 0.3));
        let ring = Ring::new(&mut mesh, &[2.0, 2.6, 3.0], (0.0, 3, sectors), (600.0, 0.25));
        let mut load = vec![0.0; mesh.size()];
        for i in 0..3 * sectors {
            let ends = [ring.node(i, 2), ring.node(i + 1, 2)];
            let angle = PI / 9.0 * (i as f64 + 0.5);
            // A pressure on one face of three, a pull on another, and a shear.
            let (normal, shear) = [(-30.0, 0.3), (-5.0, 0.3), (24.0, 0.3)][i % 3];
            let (sin, cos) = angle.sin_cos();
            let traction = [normal * cos - shear * sin, normal * sin + shear * cos];
            mesh.traction(&ends, traction, &mut load);
        }
        Joint { mesh, hub, ring, load }
    }

    fn fixed(&self, columns: usize) -> Vec<usize> {
        (0..columns).flat_map(|i| [0, 1].map(|axis| 2 * self.hub.node(i, 0) + axis)).collect()
    }

    /// The masters of node `i` of the ring: columns of the hub, which may be before the first one, with weights.
    fn masters(&self, i: usize) -> [(isize, f64); 2] {
        let place = (PI / 9.0 * i as f64 - SHIFT) / (PI / 12.0);
        let share = place - place.floor();
        [(place.floor() as isize, 1.0 - share), (place.floor() as isize + 1, share)]
    }

    fn normal(&self, i: usize) -> [f64; 2] {
        let (sin, cos) = (PI / 9.0 * i as f64).sin_cos();
        [-cos, -sin]
    }
}

#[test]
fn a_cyclic_sector() {
    let all = Joint::new(6);
    let rows: Vec<Vec<(usize, f64)>> = (0..18)
        .map(|i| {
            let master = |(column, weight): (isize, f64)| {
                (all.hub.node(column.rem_euclid(24) as usize, 2), -weight)
            };
            let masters = all.masters(i).map(master);
            vec![(all.ring.node(i, 0), 1.0), masters[0], masters[1]]
        })
        .collect();
    let whole = Constrained {
        dim: 2,
        stiffness: all.mesh.stiffness().dense(),
        fixed: all.fixed(24),
        equations: vec![],
        rows: rows_of(&rows),
        normals: (0..18).flat_map(|i| all.normal(i)).collect(),
        tangents: None,
    };
    let plain = whole.whole(&Settings::default());
    let reference = solved(&plain, &all.load, &[0.0; 18], 0.2);
    assert_mixed(&reference, &[State::Open, State::Slip]);
    let u_plain = plain.recover(Some(&all.load), None, &reference.d).unwrap();

    let one = Joint::new(1);
    let size = one.mesh.size();
    let (sin, cos) = (PI / 3.0).sin_cos();
    // u_image = Q u, Q the turn by a sector; `back` the other way.
    let image = |image: usize, of: usize, back: bool| -> [(usize, Terms); 2] {
        let sin = if back { -sin } else { sin };
        [
            (2 * image, vec![(2 * of, cos), (2 * of + 1, -sin)]),
            (2 * image + 1, vec![(2 * of, sin), (2 * of + 1, cos)]),
        ]
    };
    let mut equations = Vec::new();
    for j in 0..3 {
        equations.extend(image(one.hub.node(4, j), one.hub.node(0, j), false));
        equations.extend(image(one.ring.node(3, j), one.ring.node(0, j), false));
    }
    // The hub's column before the first one is the image of the last but one.
    let before = size / 2;
    equations.extend(image(before, one.hub.node(3, 2), true));
    let rows: Vec<Vec<(usize, f64)>> = (0..3)
        .map(|i| {
            let master = |(column, weight): (isize, f64)| match usize::try_from(column) {
                Ok(column) => (one.hub.node(column, 2), -weight),
                Err(_) => (before, -weight),
            };
            let masters = one.masters(i).map(master);
            vec![(one.ring.node(i, 0), 1.0), masters[0], masters[1]]
        })
        .collect();
    // The first column of the hub is fixed inside; its image follows.
    let sector = Constrained {
        dim: 2,
        stiffness: with_more(&one.mesh.stiffness().dense(), size, 2),
        fixed: one.fixed(4),
        equations,
        rows: rows_of(&rows),
        normals: (0..3).flat_map(|i| one.normal(i)).collect(),
        tangents: None,
    };
    let mut load = one.load.clone();
    load.resize(sector.size(), 0.0);
    solutions(&sector, &load, &[0.0; 3], 0.2, &mut |_, solution, u| {
        close(&solution.d, &reference.d[..6], TOLERANCE, "d");
        close(&solution.certificate.force, &reference.certificate.force[..6], TOLERANCE, "F");
        let (one, all) = (&one, &all);
        let nodes = (0..3).flat_map(|j| {
            let hub = (0..=4).map(move |i| (one.hub.node(i, j), all.hub.node(i, j)));
            hub.chain((0..=3).map(move |i| (one.ring.node(i, j), all.ring.node(i, j))))
        });
        for (own, other) in nodes {
            let (own, other) = (&u[2 * own..2 * own + 2], &u_plain[2 * other..2 * other + 2]);
            let apart = (own[0] - other[0]).hypot(own[1] - other[1]);
            assert!(apart <= TOLERANCE * largest(&u_plain), "{apart:e}");
        }
    });
}

/// In space: half of a block that is turned anyhow. Tangents that the library chooses follow the plane of symmetry;
/// with others the rows on it depend on supports, and the solution is the same.
#[test]
fn skewed_symmetry_in_space() {
    // Columns are the axes of the block: a rotation by quaternion (1, 2, 3, 4) / sqrt(30).
    let axes = [[-20.0, 20.0, 10.0], [4.0, -10.0, 28.0], [22.0, 20.0, 4.0]]
        .map(|axis| axis.map(|part| part / 30.0));
    let turn = |x: [f64; 3]| -> [f64; 3] {
        std::array::from_fn(|c| (0..3).map(|k| axes[k][c] * x[k]).sum())
    };
    let make = |cells: usize, from: f64| {
        let mut brick = Brick::new([cells, 2, 2], [1.0, 2.0, 1.5], Support::Free);
        let columns = cells + 1;
        for (k, node) in brick.nodes.iter_mut().enumerate() {
            node[0] = from + (3.0 - from) * (k % columns) as f64 / cells as f64;
        }
        let straight = brick.nodes.clone();
        let stiffness = brick.stiffness();
        // The stiffness of a turned body is the turned stiffness.
        let mut dense = stiffness.dense();
        let size = stiffness.size;
        turn_blocks(&mut dense, size, &axes);
        let mut load = vec![0.0; size];
        for node in brick.top() {
            let [x, y, _] = straight[node];
            let half = if x == 0.0 && from == 0.0 { 0.5 } else { 1.0 };
            let force = half * (-x * x - 0.3 * y).exp();
            let turned = turn([0.0, 0.02 * force, -0.1 * force]);
            load[3 * node..3 * node + 3].copy_from_slice(&turned);
        }
        (brick, dense, load, straight)
    };
    let structure = |brick: &Brick, dense: Vec<f64>, equations, tangents| {
        let unit =
            |axis: usize| (0..3).map(|k| f64::from(u8::from(k == axis))).collect::<Vec<f64>>();
        let row = |&node: &usize| (0..3).map(|axis| (3 * node + axis, unit(axis))).collect();
        Constrained {
            dim: 3,
            stiffness: dense,
            fixed: vec![],
            equations,
            rows: brick.contact.iter().map(row).collect(),
            normals: vec![turn([0.0, 0.0, -1.0]); brick.contact.len()].concat(),
            tangents,
        }
    };
    let (brick, dense, load, _) = make(4, -3.0);
    let count = brick.contact.len();
    let plain = structure(&brick, dense, vec![], None).whole(&Settings::default());
    let reference = solved(&plain, &load, &vec![0.0; count], 0.3);
    assert_mixed(&reference, &[State::Open, State::Slip]);
    let d = in_axes(plain.frames().unwrap(), &reference.d, 3);
    let force = in_axes(plain.frames().unwrap(), &reference.certificate.force, 3);

    let (half, dense, load, straight) = make(2, 0.0);
    let m = turn([1.0, 0.0, 0.0]);
    let on_plane = (0..half.nodes.len()).filter(|&node| straight[node][0] == 0.0);
    let equations = on_plane
        .map(|node| (3 * node, vec![(3 * node + 1, -m[1] / m[0]), (3 * node + 2, -m[2] / m[0])]));
    let equations: Vec<(usize, Terms)> = equations.collect();
    let count = half.contact.len();
    let given = vec![turn([0.6, 0.8, 0.0]); count].concat();
    for tangents in [None, Some(given)] {
        let is_chosen = tangents.is_none();
        let structure = structure(&half, dense.clone(), equations.clone(), tangents);
        for settings in both_engines() {
            let model = structure.whole(&settings);
            assert_eq!(model.dependent_pairs().is_empty(), is_chosen);
            let solution = solved(&model, &load, &vec![0.0; count], 0.3);
            let frames = model.frames().unwrap();
            let own_d = in_axes(frames, &solution.d, 3);
            let own_force = in_axes(frames, &solution.certificate.force, 3);
            let (mut whole_d, mut whole_force) = (Vec::new(), Vec::new());
            for pair in 0..count {
                let (i, j) = (pair % 3, pair / 3);
                let place = 3 * (i + 2 + 5 * j);
                let part = if i == 0 { 0.5 } else { 1.0 };
                whole_d.extend(&d[place..place + 3]);
                whole_force.extend(force[place..place + 3].iter().map(|f| part * f));
            }
            close(&own_d, &whole_d, 1e-9, "d");
            close(&own_force, &whole_force, TOLERANCE, "F");
        }
    }
}

/// `R K Rᵀ` for each pair of nodes; `axes` are the columns of `R`.
fn turn_blocks(dense: &mut [f64], size: usize, axes: &[[f64; 3]; 3]) {
    for a in (0..size).step_by(3) {
        for b in (0..size).step_by(3) {
            let block: [[f64; 3]; 3] =
                std::array::from_fn(|i| std::array::from_fn(|j| dense[a + i + size * (b + j)]));
            for i in 0..3 {
                for j in 0..3 {
                    let sum = (0..9).map(|k| axes[k / 3][i] * block[k / 3][k % 3] * axes[k % 3][j]);
                    dense[a + i + size * (b + j)] = sum.sum();
                }
            }
        }
    }
}

/// Nodes of slaves and masters in axes that are turned may be named as before: the pairs themselves do not change.
#[test]
fn pairs_of_nodes_take_equations_too() {
    let (mesh, [lower, _], pairs, load) = punch(7);
    let (size, fixed) = (mesh.size(), held(&lower));
    let gap = vec![0.0; pairs.count()];
    let reference = solved(&mesh.stiffness().model(&fixed, &pairs).unwrap(), &load, &gap, 0.25);
    // The host's matrix has its degrees of freedom in the order in which it counts backwards.
    let equations: Vec<(usize, Terms)> =
        (0..size).map(|dof| (size + dof, vec![(size - 1 - dof, 1.0)])).collect();
    let arrays = crate::constrained::EquationArrays::new(&equations);
    let dense = mesh.stiffness().dense();
    let backwards: Vec<f64> = dense.iter().rev().copied().collect();
    let view = pairs.view();
    let beyond = |dofs: &[usize]| dofs.iter().map(|dof| size + dof).collect::<Vec<usize>>();
    let (slaves, masters) = (beyond(view.slaves), beyond(view.masters));
    let pairs =
        ContactPairs { slaves: &slaves, masters: &masters, equations: arrays.view(), ..view };
    let fixed: Vec<usize> = fixed.iter().map(|dof| size - 1 - dof).collect();
    let monitor = &mut Monitor::new(&Settings::default(), None);
    let stiffness = crate::constrained::sparse(&backwards, size);
    let model = stiffness.model_under(&fixed, &pairs, monitor).unwrap();
    let load: Vec<f64> = load.iter().rev().copied().collect();
    let solution = solved(&model, &load, &gap, 0.25);
    close(&solution.d, &reference.d, TOLERANCE, "d");
    close(&solution.certificate.force, &reference.certificate.force, TOLERANCE, "F");
}
