//! Rows do not depend on the corner at which the list of a face begins, and mirror images have those of what they are
//! images of.

use fastrand::Rng;

use crate::surfaces::{SHAPES, Sheet, TwoSheets};
use signorini::surface::{SurfacePair, SurfacePairs, SurfaceSettings, TrueShape};

/// The face from its next corner on: its mid nodes go with the corners, a middle node stays.
fn from_next_corner(face: &mut [usize]) {
    let corners = if matches!(face.len(), 3 | 6) { 3 } else { 4 };
    let mids = (face.len() / corners - 1) * corners;
    face[..corners].rotate_left(1);
    face[corners..corners + mids].rotate_left(mids.min(1));
}

/// The largest difference of gaps, areas relative to the largest one, and weights.
fn apart(a: &SurfacePairs, b: &SurfacePairs) -> f64 {
    let largest = a.pairs.iter().map(|pair| pair.area).fold(0.0, f64::max);
    assert_eq!(a.pairs.len(), b.pairs.len());
    let mut most = 0.0_f64;
    for (a, b) in a.pairs.iter().zip(&b.pairs) {
        assert_eq!(a.slave, b.slave);
        most = most.max((a.gap - b.gap).abs()).max((a.area - b.area).abs() / largest);
        for &(node, _) in a.nodes.iter().chain(&b.nodes) {
            let weight = |pair: &SurfacePair| -> f64 {
                pair.nodes.iter().filter(|entry| entry.0 == node).map(|entry| entry.1).sum()
            };
            most = most.max((weight(a) - weight(b)).abs());
        }
    }
    most
}

/// Curved faces too: chords that stand for edges of masters, and points of integration, are the same from each corner. Of rounding a
/// hundred times is left. A fitted face goes on beyond its edges as one of its parts, and where that changes, gaps have steps of 3e-8.
#[test]
fn rows_do_not_depend_on_the_first_corner() {
    let mut rng = Rng::with_seed(31);
    for shape in SHAPES {
        for height in [0.02, 0.05, 0.1, 0.2] {
            let bend = 0.3 * height;
            let bent =
                |[x, y, z]: [f64; 3]| [x + bend * (4.0 * y).sin(), y + bend * (3.0 * x).cos(), z];
            let wave = |[x, y, z]: [f64; 3]| [x, y, z + height * (3.0 * x + 2.0 * y).sin()];
            let mut sheet =
                |cells| Sheet::rectangle(shape, cells, [[0.0, 1.0]; 2], (0.2, &mut rng));
            let slave = sheet([5, 6]).mapped(bent).mapped(wave);
            let master = sheet([6, 5]).mapped(wave).mapped(|[x, y, z]| [x, y, z + 0.001]).turned();
            let sheets = TwoSheets::new(3, slave.clone(), master.clone());
            let settings = SurfaceSettings { search_distance: Some(1.0), ..Default::default() };
            let first = sheets.pair(&settings).unwrap();
            for turns in 1..4 {
                for of_slave in [true, false] {
                    let mut other = sheets.clone();
                    let faces = if of_slave { &mut other.slave } else { &mut other.master };
                    for face in faces {
                        (0..turns).for_each(|_| from_next_corner(face));
                    }
                    let error = apart(&first, &other.pair(&settings).unwrap());
                    let context = format!("{shape:?}, {height}, {turns}, {of_slave}");
                    assert!(error < 1e-12, "{context}: {error:e}");
                }
            }
            let mirrored = |sheet: &Sheet| sheet.clone().mapped(|[x, y, z]| [-x, y, z]).turned();
            let other = TwoSheets::new(3, mirrored(&slave), mirrored(&master));
            let error = apart(&first, &other.pair(&settings).unwrap());
            assert!(error < 1e-12, "{shape:?}, {height}, mirrored: {error:e}");
            let fitted = SurfaceSettings { shapes: [TrueShape::Fitted; 2], ..settings };
            let [first, other] = [&sheets, &other].map(|sheets| sheets.pair(&fitted).unwrap());
            let error = apart(&first, &other);
            assert!(error < 1e-7, "{shape:?}, {height}, fitted: {error:e}");
        }
    }
}
