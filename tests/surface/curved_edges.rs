//! Flat faces whose edges are arcs in their plane, as of a washer or a flange: the part between an arc and its chord belongs to them.

use std::f64::consts::FRAC_PI_2;

use crate::surfaces::{Shape, Sheet, TwoSheets, nodal_forces};
use fastrand::Rng;
use signorini::surface::{SurfacePairs, SurfaceSettings};

const SHAPES: [Shape; 3] = [Shape::T6, Shape::Q8, Shape::Q9];

/// A quarter of a ring between the radii .5 and 1.5, of so many faces along both directions.
fn quarter(shape: Shape, cells: [usize; 2]) -> Sheet {
    let ring = |[r, angle, z]: [f64; 3]| [r * angle.cos(), r * angle.sin(), z];
    let ends = [[0.5, 1.5], [0.0, FRAC_PI_2]];
    Sheet::rectangle(shape, cells, ends, (0.0, &mut Rng::with_seed(1))).mapped(ring)
}

fn paired(slave: Sheet, master: Sheet) -> SurfacePairs {
    TwoSheets::new(3, slave.turned(), master).pair(&SurfaceSettings::default()).unwrap()
}

/// Sides that are the same cover each other, and a uniform pressure loads each node as the one that stands there: up to the rounding
/// of some hundred operations.
#[test]
fn rings_that_match_cover_each_other() {
    for shape in SHAPES {
        for cells in [[1, 1], [3, 2], [3, 3], [2, 6]] {
            let side = quarter(shape, cells);
            let count = side.nodes.len();
            let found = paired(side.clone(), side);
            let (area, covered) = (found.report.slave_area, found.report.covered_area);
            assert!((covered - area).abs() < 1e-13 * area, "{shape:?}, {cells:?}: {covered}");
            let forces = nodal_forces(&found, 2 * count, 1.0);
            for (own, opposite) in forces[..count].iter().zip(&forces[count..]) {
                assert!((own[2] + opposite[2]).abs() < 1e-13 * area, "{shape:?}, {cells:?}");
            }
        }
    }
}

/// An edge that turns by `2 a` stands off its circle by `(1 - cos a)² / 8` of the radius at most, 1.5e-4 for 30 degrees. So do
/// the edges of both sides, which leave a strip uncovered; lines between points of an edge of the master leave as much again. The
/// chords to its mid node would leave a strip of 1e-2.
#[test]
fn rings_that_do_not_match_cover_each_other_up_to_their_edges() {
    for shape in SHAPES {
        for [slave, master] in [[6, 4], [4, 6], [12, 5], [5, 12], [12, 3], [3, 12]] {
            let found = paired(quarter(shape, [3, slave]), quarter(shape, [2, master]));
            let missing = 1.0 - found.report.covered_area / found.report.slave_area;
            assert!(missing < 3e-4, "{shape:?}, {slave} on {master}: {missing:e}");
        }
    }
}
