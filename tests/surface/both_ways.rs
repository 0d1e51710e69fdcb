//! Rows of surfaces that follow from each other, or nearly: two surfaces that are each other's slaves, and slaves on planes that
//! are held and that no pairing was told of.

use crate::common::solids::{Cells, Order, Solid};
use crate::surfaces::{line, pair, steps};
use fastrand::Rng;
use signorini::reduce::{ContactPairs, Indices, SparseMatrix, Triangle};
use signorini::surface::{PairArrays, SurfaceSettings};
use signorini::{Error, FrictionLaw, LoadCase, Model, Monitor, Settings, Solution, Status};

/// Two chains of springs from 0 to 1, the first above the second, of `cells` elements each; each node of the
/// second stands on a spring of 1, the first one on contact alone.
struct Chains {
    cells: [usize; 2],
    stiffness: Vec<f64>,
    arrays: PairArrays,
}

impl Chains {
    fn new(cells: [usize; 2]) -> Chains {
        let (mut nodes, upper) = line(&steps(0.0, 1.0, cells[0]), false, 0);
        let (below, mut lower) = line(&steps(0.0, 1.0, cells[1]), false, nodes.len());
        lower.iter_mut().for_each(|face| face.swap(0, 1));
        nodes.extend(below);
        let found = |sides: [&[Vec<usize>]; 2]| {
            pair(2, &nodes, sides, &SurfaceSettings::default()).unwrap()
        };
        let mut both = found([&upper, &lower]);
        both.pairs.extend(found([&lower, &upper]).pairs);
        let size = 2 * nodes.len();
        let mut stiffness = vec![0.0; size * size];
        let mut spring = |i: usize, j: usize, k: f64| {
            [(i, i, k), (j, j, k), (i, j, -k), (j, i, -k)]
                .iter()
                .for_each(|(i, j, k)| stiffness[i + size * j] += k);
        };
        for (first, count) in [(0, cells[0]), (cells[0] + 1, cells[1])] {
            for dof in 2 * first..2 * (first + count) {
                spring(dof, dof + 2, count as f64);
            }
        }
        (2 * (cells[0] + 1)..size).for_each(|dof| stiffness[dof + size * dof] += 1.0);
        Chains { cells, stiffness, arrays: both.rows() }
    }

    fn size(&self) -> usize {
        2 * (self.cells[0] + self.cells[1] + 2)
    }

    fn model(&self) -> Result<Model, Error> {
        let (size, mut starts, mut rows, mut values) = (self.size(), vec![0], vec![], vec![]);
        for j in 0..size {
            let stored = (j..size).filter(|i| self.stiffness[i + size * j] != 0.0);
            for i in stored {
                rows.push(i as i64);
                values.push(self.stiffness[i + size * j]);
            }
            starts.push(rows.len() as i64);
        }
        let matrix = SparseMatrix {
            size,
            col_start: Indices::Wide(&starts),
            row: Indices::Wide(&rows),
            values: &values,
            index_base: 0,
            triangle: Triangle::Lower,
        };
        Model::sparse(&matrix, &[], &ContactPairs::from(&self.arrays))
    }

    /// The upper chain pressed by 1 in all.
    fn load(&self) -> Vec<f64> {
        let count = self.cells[0] + 1;
        let force = |dof: usize| if dof < 2 * count && dof % 2 == 1 { -1.0 } else { 0.0 };
        (0..self.size()).map(|dof| force(dof) / count as f64).collect()
    }

    fn solved(&self, model: &Model) -> Solution {
        let (load, friction) = (self.load(), vec![0.3; self.arrays.count]);
        let case = LoadCase {
            load: &load,
            prescribed: None,
            gap: &self.arrays.gaps,
            law: FrictionLaw::Coulomb(&friction),
            reference_slip: None,
        };
        let settings = Settings::default();
        model.solve(&case, &settings, None, &mut Monitor::new(&settings, None)).unwrap()
    }
}

/// Few pairs, meshes of which one has all nodes of the other, and meshes whose rows from both sides are nearly the same: the forces
/// of all pairs carry the press. To 1e-8: a hundred times the tolerance, as the sum of some tens of forces.
#[test]
fn chains_that_are_each_others_slaves() {
    for cells in [[3, 2], [12, 11], [20, 15], [40, 40], [60, 30], [58, 44], [50, 49]] {
        let chains = Chains::new(cells);
        let model = chains.model().unwrap_or_else(|error| panic!("{cells:?}: {error}"));
        let solution = chains.solved(&model);
        assert_eq!(solution.status, Status::Solved, "{cells:?}: {}", solution.message);
        let nodal = model.nodal_forces(&solution.certificate.force).unwrap();
        let carried: f64 = (0..=cells[0]).map(|node| nodal[2 * node + 1]).sum();
        assert!((carried - 1.0).abs() < 1e-8, "{cells:?}: {carried}");
    }
}

/// Blocks of bricks in space, one layer each, of `cells` along either side, without friction: the upper one stands on contact
/// alone, and nothing holds it sideways.
fn blocks(cells: [usize; 2]) -> (Model, PairArrays, Vec<f64>) {
    let half = [5.0 * cells[0] as f64, 3.75 * cells[1] as f64];
    let across = [0, 1].map(|k| steps(-half[k], half[k], cells[k]));
    let levels = [[-10.0, 0.0], [0.0, 7.5]];
    let solids = [0, 1].map(|k| {
        let lines: [&[f64]; 3] = [&across[k], &across[k], &levels[k]];
        let kind = (Cells::Boxes, Order::Linear);
        Solid::new(&lines, kind, (210e3, 0.3), (0.0, &mut Rng::with_seed(0)))
    });
    let below = solids[0].nodes.len();
    let mut nodes = solids[0].nodes.clone();
    nodes.extend(&solids[1].nodes);
    let mut upper = solids[1].lower.clone();
    upper.iter_mut().flatten().for_each(|node| *node += below);
    let found =
        |sides: [&[Vec<usize>]; 2]| pair(3, &nodes, sides, &SurfaceSettings::default()).unwrap();
    let mut both = found([&upper, &solids[0].upper]);
    both.pairs.extend(found([&solids[0].upper, &upper]).pairs);
    let arrays = both.rows();
    let level = |node: &usize| nodes[*node][2];
    let fixed: Vec<usize> = (0..below)
        .filter(|node| level(node) < -5.0)
        .flat_map(|node| 3 * node..3 * node + 3)
        .collect();
    let pressed: Vec<usize> = (below..nodes.len()).filter(|node| level(node) > 5.0).collect();
    let mut load = vec![0.0; 3 * nodes.len()];
    pressed.iter().for_each(|node| load[3 * node + 2] = -1.0 / pressed.len() as f64);
    let stiffness = Solid::stiffness(&[&solids[0], &solids[1]]);
    let model = Model::sparse(&stiffness.view(), &fixed, &ContactPairs::from(&arrays)).unwrap();
    (model, arrays, load)
}

/// Few pairs, and many: the forces of all pairs carry the press, to 1e-8 as above.
#[test]
fn blocks_that_are_each_others_slaves() {
    let some = [[2, 2], [3, 2], [4, 2], [4, 3], [5, 5], [3, 7]];
    for cells in some.into_iter().chain([[4, 7], [5, 7], [6, 7], [8, 8]]) {
        let (model, arrays, load) = blocks(cells);
        let law = FrictionLaw::Frictionless;
        let gap = &arrays.gaps;
        let case = LoadCase { load: &load, prescribed: None, gap, law, reference_slip: None };
        let settings = Settings::default();
        let monitor = &mut Monitor::new(&settings, None);
        let solution = model.solve(&case, &settings, None, monitor).unwrap();
        assert_eq!(solution.status, Status::Solved, "{cells:?}: {}", solution.message);
        let nodal = model.nodal_forces(&solution.certificate.force).unwrap();
        let below = 2 * (cells[0] + 1).pow(2);
        let carried: f64 = nodal.iter().skip(3 * below + 2).step_by(3).sum();
        assert!((carried - 1.0).abs() < 1e-8, "{cells:?}: {carried}");
    }
}

/// A slab of bricks on a finer or a coarser one, both held along y at both ends, which no pairing was told of, and free along x, pressed
/// by a hundredth of their height: the pressure is `E / (1 - nu²)` times that. To 1e-9 of a force: ten times the tolerance.
#[test]
fn slabs_between_planes_that_no_pairing_was_told_of() {
    let (long, wide) = (12.0, 2.0);
    for cells in [[[6, 3], [10, 2]], [[7, 4], [15, 3]], [[20, 3], [31, 2]], [[12, 2], [20, 3]]] {
        for friction in [0.0, 0.3] {
            let levels = [[-1.0, 0.0], [0.0, 1.0]];
            let solids = [0, 1].map(|k| {
                let [along, across] = [(long, cells[k][0]), (wide, cells[k][1])]
                    .map(|(length, count)| steps(0.0, length, count));
                let kind = (Cells::Boxes, Order::Linear);
                let rng = &mut Rng::with_seed(k as u64);
                Solid::new(&[&along, &across, &levels[k]], kind, (100.0, 0.3), (0.15, rng))
            });
            let below = solids[0].nodes.len();
            let nodes: Vec<[f64; 3]> =
                solids.iter().flat_map(|solid| &solid.nodes).copied().collect();
            let mut upper = solids[1].lower.clone();
            upper.iter_mut().flatten().for_each(|node| *node += below);
            let sides: [&[Vec<usize>]; 2] = [&upper, &solids[0].upper];
            let found = pair(3, &nodes, sides, &SurfaceSettings::default()).unwrap();
            let (arrays, areas) = (found.rows(), found.pairs.iter().map(|pair| pair.area));
            let (mut fixed, mut values) = (Vec::new(), Vec::new());
            for (node, [x, y, z]) in nodes.iter().enumerate() {
                let ends = [*x == 0.0, *y == 0.0 || *y == wide, z.abs() == 1.0];
                fixed.extend((0..3).filter(|&c| ends[c]).map(|c| 3 * node + c));
                let pressed = |&c: &usize| if c == 2 && *z == 1.0 { -0.02 } else { 0.0 };
                values.extend((0..3).filter(|&c| ends[c]).map(|c| pressed(&c)));
            }
            let load = vec![0.0; 3 * nodes.len()];
            let pressure = 100.0 / (1.0 - 0.3 * 0.3) * 0.01;
            let stiffness = Solid::stiffness(&[&solids[0], &solids[1]]);
            let pairs = ContactPairs::from(&arrays);
            let model = Model::sparse(&stiffness.view(), &fixed, &pairs).unwrap();
            assert!(!model.dependent_pairs().is_empty(), "{cells:?}");
            let (gap, mu) = (&arrays.gaps, vec![friction; arrays.count]);
            let law = FrictionLaw::Coulomb(&mu);
            let prescribed = Some(&values[..]);
            let case = LoadCase { load: &load, prescribed, gap, law, reference_slip: None };
            let settings = Settings::default();
            let monitor = &mut Monitor::new(&settings, None);
            let solution = model.solve(&case, &settings, None, monitor).unwrap();
            assert_eq!(solution.status, Status::Solved, "{cells:?}: {}", solution.message);
            for (force, area) in solution.certificate.force.chunks(3).zip(areas) {
                let error = force[0] / (pressure * area) + 1.0;
                assert!(error.abs() < 1e-9, "{cells:?}, {friction}: {error:e}");
            }
        }
    }
}
