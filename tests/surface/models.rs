//! Models with the pairs of two surfaces as general rows: patch tests with quadratic faces, slaves on planes
//! of symmetry, and both sides slaves at once.

use crate::common::brick20::Brick20;
use crate::common::dense::largest;
use crate::common::mesh::Stiffness;
use crate::surfaces::{flat, pair};
use signorini::reduce::ContactPairs;
use signorini::surface::{
    ContactZone, Faces, PairArrays, SurfacePairs, SurfaceSettings, join_zones,
};
use signorini::{Error, FrictionLaw, LoadCase, Model, Monitor, Settings, Solution, State, Status};

const PRESSURE: f64 = 7.0;

fn model(stiffness: &Stiffness, fixed: &[usize], arrays: &PairArrays) -> Model {
    Model::sparse(&stiffness.view(), fixed, &ContactPairs::from(arrays)).unwrap()
}

fn solve(model: &Model, load: &[f64], gaps: &[f64], mu: f64, tolerance: f64) -> Solution {
    tried(model, load, gaps, mu, tolerance).unwrap()
}

fn tried(
    model: &Model,
    load: &[f64],
    gaps: &[f64],
    mu: f64,
    tolerance: f64,
) -> Result<Solution, Error> {
    let mu = vec![mu; gaps.len()];
    let case = LoadCase {
        load,
        prescribed: None,
        gap: gaps,
        law: FrictionLaw::Coulomb(&mu),
        reference_slip: None,
    };
    let settings = Settings { tolerance, ..Settings::default() };
    model.solve(&case, &settings, None, &mut Monitor::new(&settings, None))
}

/// The stiffness of two separate bodies.
fn both(a: &Stiffness, b: &Stiffness) -> Stiffness {
    let shift = |values: &[i64], by: usize| -> Vec<i64> {
        values.iter().map(|value| value + by as i64).collect()
    };
    Stiffness {
        size: a.size + b.size,
        col_start: [&a.col_start[..], &shift(&b.col_start[1..], a.values.len())].concat(),
        row: [&a.row[..], &shift(&b.row, a.size)].concat(),
        values: [&a.values[..], &b.values].concat(),
    }
}

/// Two blocks of 20-node bricks, one upon the other, on the same square.
struct Blocks {
    stiffness: Stiffness,
    nodes: Vec<[f64; 3]>,
    /// Faces of the interface: of the lower and of the upper block.
    faces: [Vec<Vec<usize>>; 2],
    /// A uniform pressure on the top.
    load: Vec<f64>,
}

impl Blocks {
    fn new(cells: [[usize; 3]; 2]) -> Blocks {
        Blocks::of(cells, [2000.0, 500.0])
    }

    /// With Young's moduli of the lower and the upper block.
    fn of(cells: [[usize; 3]; 2], young: [f64; 2]) -> Blocks {
        let lower = Brick20::new(cells[0], [0.0, 0.0, -0.8], [1.0, 1.0, 0.0], (young[0], 0.3));
        let upper = Brick20::new(cells[1], [0.0; 3], [1.0, 1.0, 0.6], (young[1], 0.2));
        let first = lower.nodes.len();
        let stiffness = both(&lower.stiffness(), &upper.stiffness());
        let mut load = vec![0.0; stiffness.size];
        for (node, share) in upper.unit_loads(true) {
            load[3 * (first + node) + 2] -= PRESSURE * share;
        }
        let faces = [lower.faces(true, 0), upper.faces(false, first)];
        Blocks { stiffness, nodes: [lower.nodes, upper.nodes].concat(), faces, load }
    }

    /// Nodes that satisfy a condition, along an axis.
    fn fixed(&self, axis: usize, is_fixed: impl Fn([f64; 3]) -> bool) -> Vec<usize> {
        let nodes = (0..self.nodes.len()).filter(|&node| is_fixed(self.nodes[node]));
        nodes.map(|node| 3 * node + axis).collect()
    }

    fn found(&self, upper_is_slave: bool) -> SurfacePairs {
        let [lower, upper] = &self.faces;
        let sides = if upper_is_slave { [&upper[..], lower] } else { [&lower[..], upper] };
        pair(3, &self.nodes, sides, &SurfaceSettings::default()).unwrap()
    }

    /// Asserts that all pairs of the solution are closed and carry the pressure.
    fn assert_uniform(&self, arrays: &PairArrays, solution: &Solution, context: &str) {
        assert_eq!(solution.status, Status::Solved, "{context}: {}", solution.message);
        let certificate = &solution.certificate;
        for (j, area) in arrays.areas.iter().enumerate() {
            let pressure = -certificate.force[3 * j] / area;
            // A hundred times the tolerance.
            assert!((pressure / PRESSURE - 1.0).abs() < 1e-10, "{context}, pair {j}: {pressure}");
            assert_ne!(certificate.states[j], State::Open, "{context}, pair {j}");
        }
    }

    /// Asserts `K u = f + Bᵀ F` but at supports, and `B u = d`, to 1e-9 of the largest: ten times the default
    /// tolerance.
    fn assert_balanced(
        &self,
        model: &Model,
        fixed: &[usize],
        arrays: &PairArrays,
        solution: &Solution,
    ) {
        let u = model.recover(Some(&self.load), None, &solution.d).unwrap();
        let nodal = model.nodal_forces(&solution.certificate.force).unwrap();
        let internal = self.stiffness.times(&u);
        let size = largest(&internal).max(largest(&nodal));
        for dof in (0..u.len()).filter(|dof| !fixed.contains(dof)) {
            let left = internal[dof] - self.load[dof] - nodal[dof];
            assert!(left.abs() < 1e-9 * size, "{dof}: {left:e} of {size:e}");
        }
        let frames = model.frames().unwrap();
        for (pair, d) in solution.d.chunks(3).enumerate() {
            for (d, direction) in d.iter().zip(frames[9 * pair..].chunks(3)) {
                let mut moved = 0.0;
                for k in arrays.master_start[pair]..arrays.master_start[pair + 1] {
                    let node = &arrays.masters[3 * k..3 * k + 3];
                    let along: f64 = node.iter().zip(direction).map(|(&dof, n)| u[dof] * n).sum();
                    moved += arrays.weights[k] * along;
                }
                assert!((moved - d).abs() < 1e-9 * largest(&u), "pair {pair}: {moved} is not {d}");
            }
        }
    }
}

const CELLS: [[[usize; 3]; 2]; 3] =
    [[[2, 1, 1], [1, 2, 1]], [[2, 2, 1], [3, 3, 1]], [[3, 2, 1], [2, 1, 1]]];

/// Mid nodes of quadratic faces share their rows with corners, which have rows of their own.
#[test]
fn quadratic_faces_pass_the_patch_test() {
    for cells in CELLS {
        for upper_is_slave in [true, false] {
            let blocks = Blocks::new(cells);
            let mut fixed = blocks.fixed(2, |p| p[2] == -0.8);
            for level in [-0.8, 0.6] {
                fixed.extend(blocks.fixed(0, |p| p == [0.0, 0.0, level]));
                fixed
                    .extend(blocks.fixed(1, |p| p[1] == 0.0 && p[2] == level && p[0] % 1.0 == 0.0));
            }
            let found = blocks.found(upper_is_slave);
            assert!(found.one_slave_each().is_none());
            let arrays = found.rows();
            let model = model(&blocks.stiffness, &fixed, &arrays);
            assert!(model.dependent_pairs().is_empty());
            let solution = solve(&model, &blocks.load, &arrays.gaps, 0.0, 1e-12);
            blocks.assert_uniform(&arrays, &solution, &format!("{cells:?}, {upper_is_slave}"));
            blocks.assert_balanced(&model, &fixed, &arrays, &solution);
        }
    }
}

/// A contact that is cut in two zones has the pressures and displacements of the whole, with friction and a load that is not
/// uniform: to a hundred times the tolerance.
#[test]
fn a_cut_contact_is_the_whole_one() {
    let mut blocks = Blocks::new([[3, 3, 1], [2, 2, 1]]);
    for (dof, load) in blocks.load.iter_mut().enumerate() {
        let [x, y, z] = blocks.nodes[dof / 3];
        *load *= 1.0 + x + 0.5 * y;
        *load += if dof % 3 == 0 && z == 0.6 { 0.01 } else { 0.0 };
    }
    let fixed: Vec<usize> = (0..3).flat_map(|axis| blocks.fixed(axis, |p| p[2] == -0.8)).collect();
    let [master, slave] = &blocks.faces;
    let whole = blocks.found(true);
    let is_left = |face: &&Vec<usize>| face.iter().all(|&node| blocks.nodes[node][0] <= 0.5);
    let (left, right): (Vec<_>, Vec<_>) = slave.iter().partition(is_left);
    let parts = [left, right].map(|part| part.into_iter().cloned().collect::<Vec<_>>());
    let contacts = parts
        .each_ref()
        .map(|part| pair(3, &blocks.nodes, [part, master], &SurfaceSettings::default()).unwrap());
    let lists = parts.each_ref().map(|part| flat(part));
    let zone = |at: usize| {
        let (start, nodes) = &lists[at];
        let slave = Faces { start, nodes };
        ContactZone { name: ["left", "right"][at], contact: &contacts[at], slave }
    };
    let joined = join_zones(&[zone(0), zone(1)]).unwrap().contact;
    let [cut, whole] = [joined, whole].map(|found| {
        let arrays = found.rows();
        let model = model(&blocks.stiffness, &fixed, &arrays);
        let solution = solve(&model, &blocks.load, &arrays.gaps, 0.3, 1e-12);
        assert_eq!(solution.status, Status::Solved, "{}", solution.message);
        let u = model.recover(Some(&blocks.load), None, &solution.d).unwrap();
        let force = solution.certificate.force.chunks(3).zip(&arrays.areas);
        let pressure =
            found.pairs.iter().zip(force).map(|(pair, (f, area))| (pair.slave, -f[0] / area));
        (u, pressure.collect::<std::collections::BTreeMap<usize, f64>>())
    });
    for (own, expected) in cut.0.iter().zip(&whole.0) {
        assert!((own - expected).abs() < 1e-10 * largest(&whole.0));
    }
    let most = whole.1.values().copied().fold(0.0, f64::max);
    assert!(cut.1.keys().eq(whole.1.keys()) && most > PRESSURE);
    assert!(cut.1.iter().all(|(node, pressure)| (pressure - whole.1[node]).abs() < 1e-10 * most));
}

/// A quarter: slaves on the planes of symmetry are fixed along their normals, their masters off the planes
/// are not. With friction the field is not uniform, but forces and motions still balance.
#[test]
fn a_quarter_model_passes_the_patch_test() {
    for cells in CELLS {
        for upper_is_slave in [true, false] {
            let blocks = Blocks::new(cells);
            let mut fixed = blocks.fixed(2, |p| p[2] == -0.8);
            fixed.extend(blocks.fixed(0, |p| p[0] == 0.0));
            fixed.extend(blocks.fixed(1, |p| p[1] == 0.0));
            let arrays = blocks.found(upper_is_slave).rows();
            let model = model(&blocks.stiffness, &fixed, &arrays);
            let context = format!("{cells:?}, {upper_is_slave}, {:?}", model.dependent_pairs());
            let solution = solve(&model, &blocks.load, &arrays.gaps, 0.0, 1e-12);
            blocks.assert_uniform(&arrays, &solution, &context);
            blocks.assert_balanced(&model, &fixed, &arrays, &solution);
            let solution = solve(&model, &blocks.load, &arrays.gaps, 0.3, 1e-12);
            assert_eq!(solution.status, Status::Solved, "{context}: {}", solution.message);
            blocks.assert_balanced(&model, &fixed, &arrays, &solution);
        }
    }
}

/// Each side slave of the other at once. On meshes that match each row comes twice, so that each side
/// carries half of the pressure, with friction or without; on others the rows still depend on each other
/// (uniform displacements), and forces and motions balance.
#[test]
fn both_sides_may_be_slaves() {
    for (cells, mu) in [
        ([[2, 2, 1], [2, 2, 1]], 0.0),
        ([[2, 2, 1], [2, 2, 1]], 0.3),
        ([[2, 1, 1], [1, 2, 1]], 0.0),
        ([[2, 1, 1], [1, 2, 1]], 0.3),
        ([[2, 2, 1], [3, 3, 1]], 0.0),
    ] {
        let blocks = Blocks::new(cells);
        let mut fixed = blocks.fixed(2, |p| p[2] == -0.8);
        for level in [-0.8, 0.6] {
            fixed.extend(blocks.fixed(0, |p| p == [0.0, 0.0, level]));
            fixed.extend(blocks.fixed(1, |p| p[1] == 0.0 && p[2] == level && p[0] % 1.0 == 0.0));
        }
        let mut twice = blocks.found(true);
        twice.pairs.extend(blocks.found(false).pairs);
        let arrays = twice.rows();
        let model = model(&blocks.stiffness, &fixed, &arrays);
        let context = format!("{cells:?}, mu {mu}, {} pairs", arrays.count);
        assert!(!model.dependent_pairs().is_empty(), "{context}");
        // Rows of both sides of meshes that do not match nearly depend on each other beyond the uniform
        // displacements, which costs digits: the default tolerance is what they leave.
        let tolerance = if cells[0] == cells[1] { 1e-12 } else { 1e-10 };
        let solution = solve(&model, &blocks.load, &arrays.gaps, mu, tolerance);
        assert_eq!(solution.status, Status::Solved, "{context}: {}", solution.message);
        blocks.assert_balanced(&model, &fixed, &arrays, &solution);
        let force = &solution.certificate.force;
        let carried: f64 = force.iter().step_by(3).sum();
        // Ten times the tolerance.
        assert!((carried + PRESSURE).abs() < 1e-9 * PRESSURE, "{context}: {carried}");
        if cells[0] == cells[1] && mu == 0.0 {
            for (j, area) in arrays.areas.iter().enumerate() {
                let share = -2.0 * force[3 * j] / area / PRESSURE;
                assert!((share - 1.0).abs() < 1e-8, "{context}, pair {j}: {share}");
            }
        }
    }
}

/// Both sides slaves of matching meshes, one body far stiffer than the other: solved, and the pairs carry the
/// pressure, to 1e-8: a hundred times the tolerance, and the rounding of `K u` where a body that is a million times as
/// stiff floats on a soft one, 1e-9. Where the floating body is the stiff one by a million, its stiffness beside the
/// springs of dependent rows is near the limit of what can be told from rounding: it may be refused with that reason.
#[test]
fn both_sides_may_be_slaves_whatever_their_stiffness() {
    for ratio in [1e-6, 1e-3, 1.0, 1e3, 1e6] {
        for mu in [0.0, 0.3] {
            let blocks = Blocks::of([[2, 2, 1], [2, 2, 1]], [1000.0, 1000.0 * ratio]);
            let mut fixed = blocks.fixed(2, |p| p[2] == -0.8);
            for level in [-0.8, 0.6] {
                let is_level = |p: [f64; 3]| p[2] == level;
                fixed.extend(blocks.fixed(0, |p| is_level(p) && p[0] == 0.0 && p[1] == 0.0));
                fixed.extend(blocks.fixed(1, |p| is_level(p) && p[1] == 0.0 && p[0] % 1.0 == 0.0));
            }
            let mut twice = blocks.found(true);
            twice.pairs.extend(blocks.found(false).pairs);
            let arrays = twice.rows();
            let model = model(&blocks.stiffness, &fixed, &arrays);
            let solution = match tried(&model, &blocks.load, &arrays.gaps, mu, 1e-10) {
                Err(error) if ratio == 1e6 => {
                    assert!(error.to_string().contains("told from rounding"), "{error}");
                    continue;
                }
                solution => solution.unwrap(),
            };
            let context = format!("ratio {ratio}, mu {mu}");
            assert_eq!(solution.status, Status::Solved, "{context}: {}", solution.message);
            let carried: f64 = solution.certificate.force.iter().step_by(3).sum();
            assert!((carried / PRESSURE + 1.0).abs() < 1e-8, "{context}: {carried}");
        }
    }
}

/// The upper block is held by nothing but contact. Pressed by P and pushed along the interface by H, it stays
/// while H <= mu P, and leaves beyond: statics. The push acts low on the block, which does not tip.
#[test]
fn a_block_that_contact_alone_holds_obeys_statics() {
    for cells in CELLS {
        for upper_is_slave in [true, false] {
            let blocks = Blocks::new(cells);
            let mut fixed = blocks.fixed(2, |p| p[2] == -0.8);
            fixed.extend(blocks.fixed(0, |p| p[2] == -0.8));
            fixed.extend(blocks.fixed(1, |p| p[2] == -0.8));
            let arrays = blocks.found(upper_is_slave).rows();
            let model = model(&blocks.stiffness, &fixed, &arrays);
            let first = blocks.nodes.iter().position(|p| p[2] > 0.0).unwrap();
            let low: Vec<usize> = (first..blocks.nodes.len())
                .filter(|&node| (blocks.nodes[node][2] - 0.3).abs() < 1e-12)
                .collect();
            for (share, holds) in [(0.0, true), (0.2, true), (0.29, true), (0.31, false)] {
                let mut load = blocks.load.clone();
                for &node in &low {
                    load[3 * node] += share * PRESSURE / low.len() as f64;
                }
                let context = format!("{cells:?}, {upper_is_slave}, H {share}");
                let solution = solve(&model, &load, &arrays.gaps, 0.3, 1e-10);
                let expected = if holds { Status::Solved } else { Status::NoEquilibrium };
                assert_eq!(solution.status, expected, "{context}: {}", solution.message);
                if holds {
                    let nodal = model.nodal_forces(&solution.certificate.force).unwrap();
                    let upper = blocks.faces[1].concat();
                    let upper: std::collections::BTreeSet<usize> = upper.into_iter().collect();
                    let sum = |axis| upper.iter().map(|node| nodal[3 * node + axis]).sum::<f64>();
                    // Ten times the tolerance.
                    assert!((sum(2) - PRESSURE).abs() < 1e-8 * PRESSURE, "{context}: {}", sum(2));
                    assert!((sum(0) + share * PRESSURE).abs() < 1e-8 * PRESSURE, "{context}");
                }
            }
        }
    }
}
