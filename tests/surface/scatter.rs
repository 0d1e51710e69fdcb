//! Gaps that scatter: two meshes of one curved surface, whose gaps are those of faces and fits alone.

use crate::surfaces::{Shape, Sheet, TwoSheets};
use fastrand::Rng;
use signorini::surface::{SurfaceSettings, TrueShape};

type Point = [f64; 3];

/// A square of -0.5 ... 0.5 on a sphere of radius 2.
fn on_sphere([x, y, _]: Point) -> Point {
    let length = (x * x + y * y + 1.0).sqrt();
    [x, y, 1.0].map(|x| 2.0 * x / length)
}

/// On the inside of a ring of radius 3, whose tube of radius 1 is curved the other way.
fn on_torus([x, y, _]: Point) -> Point {
    let around = 3.0 - y.cos();
    [around * x.sin(), y.sin(), -around * x.cos()]
}

/// The interference of two meshes of one surface is told to be hidden by their faces, or by fits, where these change it by twice as much in the
/// root mean square, and not where all of them are below a hundredth of it. Mid nodes are on the surface. A sphere is fitted so well that what is
/// left is even, and is not told.
#[test]
fn an_interference_that_faces_hide_is_told() {
    let rng = &mut Rng::with_seed(31);
    for (is_torus, place) in [(false, on_sphere as fn(Point) -> Point), (true, on_torus)] {
        for (kinds, shape) in [
            ([Shape::T6, Shape::T6], TrueShape::Facets),
            ([Shape::Q8, Shape::T6], TrueShape::Facets),
            ([Shape::Q9, Shape::Q8], TrueShape::Facets),
            ([Shape::T3, Shape::Q4], TrueShape::Fitted),
            ([Shape::T6, Shape::Q8], TrueShape::Fitted),
        ] {
            let inner = Sheet::rectangle(kinds[0], [5; 2], [[-0.4, 0.4]; 2], (0.2, rng));
            let outer = Sheet::rectangle(kinds[1], [7; 2], [[-0.5, 0.5]; 2], (0.2, rng)).turned();
            let sheets = TwoSheets::new(3, inner.mapped(place), outer.mapped(place));
            let pair = |clearance: f64| {
                let settings =
                    SurfaceSettings { shapes: [shape; 2], clearance, ..Default::default() };
                sheets.pair(&settings).unwrap()
            };
            let found = pair(0.0);
            let sum = |of: fn(f64) -> f64| -> f64 {
                found.pairs.iter().map(|pair| pair.area * of(pair.gap)).sum()
            };
            let changes = (sum(|gap| gap * gap) / sum(|_| 1.0)).sqrt();
            let most = found.pairs.iter().map(|pair| pair.gap.abs()).fold(0.0, f64::max);
            let context = format!("{kinds:?} {shape:?}: {changes:.1e}, {most:.1e}");
            let is_told = pair(-0.5 * changes).report.large_facets.is_some();
            assert!(is_told || !is_torus && shape == TrueShape::Fitted, "{context}");
            assert_eq!(pair(-100.0 * most).report.large_facets, None, "{context}");
        }
    }
}
