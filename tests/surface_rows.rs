//! Pairs from surfaces, by mathematics alone: sums of weights, statics of a uniform pressure, motions that
//! open nothing.

#[path = "common/surfaces.rs"]
#[allow(dead_code)] // Every test of surfaces uses a part.
mod surfaces;

use fastrand::Rng;
use signorini::surface::{SurfacePairs, SurfaceSettings};
use surfaces::{exact_loads, grid, line, most_moved, nodal_forces, pair, steps};

/// Two lines: nodes, slave faces, master faces, turned by `angle`.
fn two_lines(
    slave: &[f64],
    master: &[f64],
    quadratic: [bool; 2],
    angle: f64,
) -> (Vec<[f64; 3]>, [Vec<Vec<usize>>; 2]) {
    let (mut nodes, slave) = line(slave, quadratic[0], 0);
    let (below, mut master) = line(master, quadratic[1], nodes.len());
    master.iter_mut().for_each(|face| face.swap(0, 1));
    nodes.extend(below);
    let (s, c) = angle.sin_cos();
    nodes.iter_mut().for_each(|p| *p = [c * p[0] - s * p[1], s * p[0] + c * p[1], 0.0]);
    (nodes, [slave, master])
}

/// Weights sum to 1, a uniform pressure loads both sides as its integral does, rigid and linear motions
/// open and slip nothing, areas are positive and sum to the covered length; covered wholly and by 3 to
/// 95 % of the last face. To 1e-12: a hundred roundings of sums of 40 terms.
#[test]
fn lines_pass_the_patch_test_by_statics() {
    let mut rng = Rng::with_seed(1);
    for quadratic in [[false, false], [true, false], [false, true], [true, true]] {
        for end in [4.0, 3.05, 3.5, 3.97, 3.0 + 1e-4, 3.0 + 1e-9] {
            for (a, b) in [(4, 7), (4, 3), (4, 1)] {
                let slave = steps(0.0, 4.0, a);
                let master = grid(-1.0, end, b, &mut rng);
                let (nodes, [s, m]) = two_lines(&slave, &master, quadratic, 0.3);
                let found = pair(2, &nodes, [&s, &m], &SurfaceSettings::default()).unwrap();
                let context = format!("{quadratic:?}, to {end}, {a} on {b}");
                check(&found, &nodes, &context);
                assert!((found.report.covered_area - end).abs() < 1e-12, "{context}");
                let normal = [0.3_f64.sin(), -(0.3_f64.cos()), 0.0];
                let loads = [
                    exact_loads(&slave, quadratic[0], [0.0, end]),
                    exact_loads(&master, quadratic[1], [0.0, end]),
                ];
                let forces = nodal_forces(&found, nodes.len(), 1.0);
                for (node, force) in forces.iter().enumerate() {
                    let of_slave = loads[0].len();
                    let load =
                        if node < of_slave { -loads[0][node] } else { loads[1][node - of_slave] };
                    for c in 0..2 {
                        let miss = (force[c] - load * normal[c]).abs();
                        assert!(miss < 1e-12, "{context}, node {node}: {miss:e}");
                    }
                }
            }
        }
    }
}

fn check(found: &SurfacePairs, nodes: &[[f64; 3]], context: &str) {
    for pair in &found.pairs {
        for weights in [&pair.slaves, &pair.masters] {
            let sum: f64 = weights.iter().map(|(_, weight)| weight).sum();
            assert!((sum - 1.0).abs() < 1e-13, "{context}, pair of {}: {sum}", pair.slave);
        }
        assert!(pair.area > 0.0 && pair.gap.abs() < 1e-12, "{context}: {pair:?}");
    }
    let motion = |[x, y, _]: [f64; 3]| [1.0 + 2.0 * x - 0.3 * y, 0.5 - x + 0.7 * y, 0.0];
    let moved = most_moved(found, nodes, motion);
    assert!(moved < 1e-12, "{context}: {moved:e}");
}
