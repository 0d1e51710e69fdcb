//! Two blocks on non-matching meshes under a uniform pressure, from the pairing to the solution.

use crate::common::brick::{Brick, Support};
use crate::common::mesh::{Block, Mesh, Stiffness, steps};
use crate::common::stack::components;
use crate::surfaces::{exact_loads, grid, pair};
use fastrand::Rng;
use signorini::reduce::ContactPairs;
use signorini::surface::{PairArrays, Rims, SurfaceSettings};
use signorini::{FrictionLaw, LoadCase, Model, Monitor, Settings, Solution, State, Status};

/// The model of a mesh with pairs, and its solution without friction.
fn solve(stiffness: &Stiffness, fixed: &[usize], arrays: &PairArrays, load: &[f64]) -> Solution {
    let pairs = ContactPairs {
        dim: arrays.dim,
        count: arrays.count,
        slaves: &arrays.slaves,
        master_start: &arrays.master_start,
        masters: &arrays.masters,
        weights: &arrays.weights,
        normals: &arrays.normals,
        tangents: Some(&arrays.tangents),
        ..ContactPairs::default()
    };
    let model = Model::sparse(&stiffness.view(), fixed, &pairs).unwrap();
    let case = LoadCase {
        load,
        prescribed: None,
        gap: &arrays.gaps,
        law: FrictionLaw::Frictionless,
        reference_slip: None,
    };
    let settings = Settings { tolerance: 1e-13, ..Settings::default() };
    model.solve(&case, &settings, None, &mut Monitor::new(&settings, None)).unwrap()
}

/// Choices: the upper side is the slave or not, and the treatment of nodes with little cover.
const EITHER_WAY: [(bool, Rims); 4] =
    [(true, Rims::Fold), (false, Rims::Fold), (true, Rims::Keep), (false, Rims::Keep)];

/// Every pair is closed and carries the pressure 7, to a thousand times the tolerance: of each pressure, or of each
/// force beside the largest one if pairs keep small areas.
fn check_pressures(solution: &Solution, arrays: &PairArrays, rims: Rims, context: &str) {
    assert_eq!(solution.status, Status::Solved, "{context}: {}", solution.message);
    let largest = arrays.areas.iter().copied().fold(0.0, f64::max);
    for (j, &area) in arrays.areas.iter().enumerate() {
        let beside = if rims == Rims::Keep { largest } else { area };
        let force = -solution.certificate.force[arrays.dim * j];
        let miss = (force - 7.0 * area).abs() / (7.0 * beside);
        assert!(miss < 1e-10, "{context}, pair {j}: {miss:e}");
        assert_ne!(solution.certificate.states[j], State::Open, "{context}, pair {j}");
    }
}

/// Lines of nodes as faces.
fn faces(nodes: &[usize]) -> Vec<Vec<usize>> {
    nodes.windows(2).map(<[usize]>::to_vec).collect()
}

/// Two blocks under a uniform pressure, the upper one overhanging or not, either side slave: every pair
/// is closed and `F_j / D_j` is the pressure. Where one block overhangs, both are loaded from outside on
/// the uncovered part, so that the exact field is uniform. Nodes with little cover are folded, or keep
/// their pairs: then rounding of forces counts by their small areas.
#[test]
fn two_blocks_pass_the_patch_test() {
    let mut rng = Rng::with_seed(2);
    for (columns, shift) in
        [([3, 4], 0.0), ([5, 7], 0.0), ([7, 2], 0.0), ([3, 4], 0.03), ([3, 4], 0.5), ([6, 5], 0.95)]
    {
        for (upper_is_slave, rims) in EITHER_WAY {
            let mut mesh = Mesh::default();
            let shift = shift * 3.0 / columns[1] as f64;
            let x = [
                grid(0.0, 3.0, columns[0], &mut rng),
                grid(shift, 3.0 + shift, columns[1], &mut rng),
            ];
            let lower = mesh.block(&x[0], &steps(-1.0, 0.0, 2), (2000.0, 0.3));
            let upper = mesh.block(&x[1], &steps(0.0, 1.0, 3), (500.0, 0.2));
            let mut below: Vec<Vec<usize>> = faces(&lower.row(2));
            // The lower body lies below its upper edge: to the left of a line to the left.
            below.iter_mut().for_each(|face| face.reverse());
            let above = faces(&upper.row(0));
            let sides = if upper_is_slave { [&above[..], &below] } else { [&below[..], &above] };
            let nodes: Vec<[f64; 3]> = mesh.nodes.iter().map(|p| [p[0], p[1], 0.0]).collect();
            let settings = SurfaceSettings { rims, ..SurfaceSettings::default() };
            let found = pair(2, &nodes, sides, &settings).unwrap();
            let arrays = found.one_slave_each().expect("linear faces have one slave each");
            let load = uniform_load(&mesh, [&lower, &upper], shift);
            let mut fixed = components(&lower.row(0), 1);
            // Away from the interface, where supports of a slave would have to be those of its masters.
            fixed.extend([2 * lower.node(0, 0), 2 * upper.node(0, 3)]);
            let solution = solve(&mesh.stiffness(), &fixed, &arrays, &load);
            let context =
                format!("{columns:?}, {shift}, upper is slave: {upper_is_slave}, {rims:?}");
            check_pressures(&solution, &arrays, rims, &context);
        }
    }
}

/// The pressure 7 on the top, and on the parts of the interface `shift..3` leaves uncovered.
fn uniform_load(mesh: &Mesh, [lower, upper]: [&Block; 2], shift: f64) -> Vec<f64> {
    let mut load = vec![0.0; mesh.size()];
    mesh.traction(&upper.row(3), [0.0, -7.0], &mut load);
    let mut add = |row: Vec<usize>, range: [f64; 2], pressure: f64| {
        let x: Vec<f64> = row.iter().map(|&node| mesh.nodes[node][0]).collect();
        for (node, share) in row.iter().zip(exact_loads(&x, false, range)) {
            load[2 * node + 1] += pressure * share;
        }
    };
    add(lower.row(2), [0.0, shift], -7.0);
    add(upper.row(0), [3.0, 3.0 + shift], 7.0);
    load
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

/// Loads of a unit pressure on the nodes of a face of rectangles, node by node along x, then y, in a
/// window.
fn on_rectangles(nodes: &[[f64; 3]], cells: [usize; 3], window: [[f64; 2]; 2]) -> Vec<f64> {
    let [nx, ny] = [cells[0] + 1, cells[1] + 1];
    let x: Vec<f64> = nodes[..nx].iter().map(|p| p[0]).collect();
    let y: Vec<f64> = (0..ny).map(|j| nodes[nx * j][1]).collect();
    let (x, y) = (exact_loads(&x, false, window[0]), exact_loads(&y, false, window[1]));
    y.iter().flat_map(|b| x.iter().map(move |a| a * b)).collect()
}

/// The faces of the lower side of a block, seen from below, and of its upper side, seen from above.
fn brick_faces([nx, ny, nz]: [usize; 3], upper: bool, first: usize) -> Vec<Vec<usize>> {
    let level = if upper { (nx + 1) * (ny + 1) * nz } else { 0 };
    let node = |i, j| first + level + i + (nx + 1) * j;
    let mut faces = Vec::new();
    for j in 0..ny {
        for i in 0..nx {
            let mut face = vec![node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)];
            if !upper {
                face.reverse();
            }
            faces.push(face);
        }
    }
    faces
}

/// Two blocks of bricks under the pressure 7, one shifted over the other's edge by a share of an
/// element along x and y, either side slave, loaded from outside where uncovered.
#[test]
fn two_blocks_of_bricks_pass_the_patch_test() {
    for (cells, shift) in [
        ([[3, 2, 1], [2, 3, 2]], 0.0),
        ([[4, 3, 1], [2, 2, 1]], 0.0),
        ([[3, 2, 1], [2, 3, 1]], 0.03),
        ([[3, 3, 1], [2, 2, 1]], 0.5),
        ([[3, 2, 1], [2, 2, 1]], 0.95),
    ] {
        for (upper_is_slave, rims) in EITHER_WAY {
            let [mut lower, mut upper] =
                cells.map(|cells| Brick::new(cells, [1.0, 1.0, 0.8], Support::Free));
            (lower.material, upper.material) = ((2000.0, 0.3), (500.0, 0.2));
            let shift = [0, 1].map(|c| shift / cells[1][c] as f64);
            lower.nodes.iter_mut().for_each(|p| p[2] -= 0.8);
            upper.nodes.iter_mut().for_each(|p| (0..2).for_each(|c| p[c] += shift[c]));
            let below = brick_faces(cells[0], true, 0);
            let above = brick_faces(cells[1], false, lower.nodes.len());
            let sides = if upper_is_slave { [&above[..], &below] } else { [&below[..], &above] };
            let nodes = [&lower.nodes[..], &upper.nodes].concat();
            let settings = SurfaceSettings { rims, ..SurfaceSettings::default() };
            let found = pair(3, &nodes, sides, &settings).unwrap();
            let arrays = found.one_slave_each().expect("linear faces have one slave each");
            let load = brick_loads([&lower, &upper], shift);
            let fixed = statically_determinate(&lower, &upper);
            let stiffness = both(&lower.stiffness(), &upper.stiffness());
            let solution = solve(&stiffness, &fixed, &arrays, &load);
            let context =
                format!("{cells:?}, {shift:?}, upper is slave: {upper_is_slave}, {rims:?}");
            check_pressures(&solution, &arrays, rims, &context);
        }
    }
}

fn brick_loads([lower, upper]: [&Brick; 2], shift: [f64; 2]) -> Vec<f64> {
    let mut load = vec![0.0; lower.size() + upper.size()];
    let mut add = |body: &Brick, first: usize, nodes: std::ops::Range<usize>, window, pressure| {
        let shares = on_rectangles(&body.nodes[nodes.clone()], body.cells, window);
        for (node, share) in nodes.zip(shares) {
            load[3 * (first + node) + 2] += pressure * share;
        }
    };
    let all = [[-2.0, 2.0]; 2];
    let window = shift.map(|shift| [shift - 0.5, 0.5]);
    let first = lower.nodes.len();
    add(upper, first, upper.top(), all, -7.0);
    add(upper, first, 0..upper.pairs(), all, 7.0);
    add(upper, first, 0..upper.pairs(), window, -7.0);
    add(lower, 0, lower.top(), all, -7.0);
    add(lower, 0, lower.top(), window, 7.0);
    load
}

/// The lower face along z, and on each body two corners away from the interface against motions along it.
fn statically_determinate(lower: &Brick, upper: &Brick) -> Vec<usize> {
    let mut fixed: Vec<usize> = (0..lower.pairs()).map(|node| 3 * node + 2).collect();
    let top = lower.nodes.len() + upper.top().start;
    for (body, first) in [(lower, 0), (upper, top)] {
        let [a, b] = [first, first + body.cells[0]];
        fixed.extend([3 * a, 3 * a + 1, 3 * b + 1]);
    }
    fixed
}
