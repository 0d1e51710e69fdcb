//! Faces whose mid nodes stand off their edges by rounding, or by more: errors grow as the rounding does, from nothing.

use crate::surfaces::{Shape, Sheet, TwoSheets};
use fastrand::Rng;
use signorini::surface::{Rims, SurfaceSettings};

/// A line through the middle of the median of a trapezoid that meets both parallel sides halves it. With mid nodes off by `d` the
/// outline of the face moves by `d` at most, on its length of 3.4, and so does, within the face, what lies over the line, by twice
/// that: the functions of mid nodes sum to less than 2. So the half is right to 6 `d`, whatever `d` is.
#[test]
fn halves_of_trapezoids_are_halves() {
    let rng = &mut Rng::with_seed(22);
    let narrow = |[x, y, z]: [f64; 3]| [0.5 + (x - 0.5) * (1.0 - 0.75 * y), y, z];
    // The edge of the master leads through (0.5, 0.5).
    let lean = |[x, y, z]: [f64; 3]| [x + 0.1 * (y - 0.5), y, z];
    let settings = SurfaceSettings { rims: Rims::Keep, ..Default::default() };
    for shape in [Shape::Q8, Shape::Q9] {
        for exponent in 3..15 {
            let off = 10.0_f64.powi(-exponent);
            let mut slave =
                Sheet::rectangle(shape, [1, 1], [[0.0, 1.0]; 2], (0.0, rng)).mapped(narrow);
            for x in &mut slave.nodes[4..8] {
                let (sin, cos) = (7.0 * rng.f64()).sin_cos();
                *x = [x[0] + off * cos, x[1] + off * sin, 0.0];
            }
            let ends = [[-0.5, 0.5], [-1.0, 2.0]];
            let master = Sheet::rectangle(Shape::Q4, [1, 1], ends, (0.0, rng)).mapped(lean);
            let found = TwoSheets::new(3, slave.turned(), master).pair(&settings).unwrap();
            let miss = (found.report.covered_area - 0.5 * 0.625).abs();
            assert!(miss < 6.0 * off + 1e-14, "{shape:?}, {off:e}: {miss:e}");
        }
    }
}
