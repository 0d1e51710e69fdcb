//! Resultants of sectors and periods: pairs at the first boundary act at its images too.

use std::f64::consts::FRAC_PI_2;

use crate::surfaces::{Shape, Sheet, TwoSheets};
use fastrand::Rng;
use signorini::surface::{PairResults, Resultant, Sector, SurfaceSettings};

/// A uniform pressure on all pairs, and the resultant about the origin with the force of all pairs added up.
fn pressed(sheets: &TwoSheets, sector: Sector) -> (Resultant, f64) {
    let settings = SurfaceSettings { sector: Some(sector), ..SurfaceSettings::default() };
    let found = sheets.pair(&settings).unwrap();
    let force: Vec<f64> =
        found.pairs.iter().flat_map(|pair| [-2.0 * pair.area, 0.0, 0.0]).collect();
    let d = vec![0.0; force.len()];
    let results = PairResults { gap: None, reference_slip: None, d: &d, force: &force };
    let size = force.iter().map(|force| force.abs()).sum();
    (found.resultant(&results, &[0.0; 3]).unwrap(), size)
}

/// Rounding of sums of some ten numbers of order 1.
fn assert_near(own: [f64; 3], wanted: [f64; 3]) {
    for (own, wanted) in own.into_iter().zip(wanted) {
        assert!((own - wanted).abs() < 1e-12, "{own} {wanted}");
    }
}

/// A quarter of a shaft in a hub is symmetric to the line at 45 degrees, and at half its height to a plane across the axis.
#[test]
fn the_resultant_of_a_quarter_ring_is_along_its_middle() {
    let rng = &mut Rng::with_seed(3);
    let mut ring = |cells| {
        let sheet = Sheet::rectangle(Shape::Q4, cells, [[0.0, 1.0]; 2], (0.0, rng));
        sheet.mapped(|[x, y, _]| [(FRAC_PI_2 * x).cos(), (FRAC_PI_2 * x).sin(), y])
    };
    let sheets = TwoSheets::new(3, ring([6, 2]), ring([6, 3]).turned());
    let sector = Sector { axis: [0.0, 0.0, 1.0], count: 4, ..Sector::default() };
    let (told, size) = pressed(&sheets, sector);
    let [x, y, _] = told.force;
    assert!(x < -0.5 * size, "{told:?}");
    assert_near(told.force, [x, x, 0.0]);
    assert_near(told.moment, [-0.5 * y, 0.5 * x, 0.0]);
}

/// A brick that repeats along one line, or along two, carries its load in its middle.
#[test]
fn the_resultant_of_a_period_is_in_its_middle() {
    let rng = &mut Rng::with_seed(4);
    for periods in [[[1.0, 0.0, 0.0], [0.0; 3]], [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0]]] {
        let mut brick = |cells| {
            let sheet = Sheet::rectangle(Shape::Q4, cells, [[0.0, 1.0], [0.0, 2.0]], (0.0, rng));
            sheet.mapped(|[x, y, z]| [x + 3.0, y - 5.0, z])
        };
        let sheets = TwoSheets::new(3, brick([4, 5]).turned(), brick([3, 4]));
        let (told, size) = pressed(&sheets, Sector { periods, ..Sector::default() });
        assert_near([0.0, 0.0, size], [0.0, 0.0, 4.0]);
        assert_near(told.force, [0.0, 0.0, size]);
        // About the origin, by the middle at (3.5, -4, 0); lengths there are up to five.
        let moment = told.moment.map(|moment| moment / 5.0);
        assert_near(moment, [-4.0 * size / 5.0, -3.5 * size / 5.0, 0.0]);
    }
}
