//! Masters with steps and edges, and bodies that are thinner than the search reaches: gaps of flat sides are distances.

use crate::surfaces::{Shape, Sheet, TwoSheets, line, pair, steps};
use fastrand::Rng;
use signorini::surface::{Pairing, Rims, SurfacePairs, SurfaceSettings};

const PAIRINGS: [Pairing; 2] = [Pairing::DualMortar, Pairing::NodeToSurface];

/// The clearance of all sides.
const CLEARANCE: f64 = 0.01;

/// A flat line of four elements above a flat side with a groove that is narrower than an element.
fn over_a_groove(
    (depth, lean): (f64, f64),
    quadratic: bool,
    settings: &SurfaceSettings,
) -> SurfacePairs {
    let (mut nodes, slave) = line(&steps(0.0, 4.0, 4), quadratic, 0);
    nodes.iter_mut().for_each(|node| node[1] = CLEARANCE);
    let first = nodes.len();
    let outline = [
        [5.0, 0.0],
        [2.0, 0.0],
        [2.0 - lean, -depth],
        [1.8 + lean, -depth],
        [1.8, 0.0],
        [-1.0, 0.0],
    ];
    nodes.extend(outline.map(|[x, y]| [x, y, 0.0]));
    let master: Vec<Vec<usize>> = (first..first + 5).map(|i| vec![i, i + 1]).collect();
    pair(2, &nodes, [&slave, &master], settings).unwrap()
}

/// A groove across an element: all gaps are the clearance, whatever its depth beyond a twentieth of the element, also with a
/// bottom that walls of 79 degrees lead to.
#[test]
fn gaps_over_a_groove_are_those_of_its_rims() {
    let choices = [(PAIRINGS[0], Rims::Fold), (PAIRINGS[0], Rims::Keep), (PAIRINGS[1], Rims::Fold)];
    for ((pairing, rims), quadratic) in
        choices.into_iter().flat_map(|choice| [(choice, false), (choice, true)])
    {
        let settings = SurfaceSettings { pairing, rims, ..SurfaceSettings::default() };
        for groove in [(0.2, 0.0), (0.5, 0.0), (0.9, 0.0), (0.4, 0.08)] {
            let found = over_a_groove(groove, quadratic, &settings);
            assert_eq!(found.pairs.len(), if quadratic { 9 } else { 5 });
            for pair in &found.pairs {
                // Weights of rims have sizes of up to ten.
                let off = (pair.gap - CLEARANCE).abs();
                assert!(off < 1e-13, "{pairing:?}, {groove:?}: {}", pair.gap);
            }
        }
    }
}

/// The skin of a plate from one height to another, all six sides or the two large ones.
fn skin([low, high]: [f64; 2], size: f64, cells: usize) -> Sheet {
    let rng = &mut Rng::with_seed(1);
    let side = |height: f64, rng: &mut Rng| {
        let flat = Sheet::rectangle(Shape::Q4, [cells; 2], [[-size, size]; 2], (0.0, rng));
        flat.mapped(|[x, y, _]| [x, y, height])
    };
    let (top, bottom) = (side(high, rng), side(low, rng).turned());
    let count = top.nodes.len();
    let below = bottom.faces.iter().map(|face| face.iter().map(|node| node + count).collect());
    Sheet {
        nodes: [top.nodes, bottom.nodes].concat(),
        faces: top.faces.into_iter().chain(below).collect(),
    }
}

/// Whole plates upon each other, thinner than their elements: the side between them alone is paired, and not the top of the
/// upper plate with the underside of the lower one, which it sees through both.
#[test]
fn plates_that_are_thinner_than_elements_touch_between_them_alone() {
    for pairing in PAIRINGS {
        for thickness in [0.01, 0.4, 1.0, 3.0] {
            for overlap in [0.0, 1e-3, -1e-3] {
                let upper = skin([-overlap, thickness], 5.0, 2);
                let lower = skin([-thickness, 0.0], 8.0, 4);
                let settings = SurfaceSettings { pairing, ..SurfaceSettings::default() };
                let found = TwoSheets::new(3, upper, lower).pair(&settings).unwrap();
                let area: f64 = found.pairs.iter().map(|pair| pair.area).sum();
                assert_eq!(found.pairs.len(), 9, "{pairing:?}, {thickness}");
                assert!((area - 100.0).abs() < 1e-11, "{pairing:?}, {thickness}: {area}");
                for pair in &found.pairs {
                    let off = (pair.gap + overlap).abs();
                    assert!(off < 1e-13, "{pairing:?}, {thickness}: {}", pair.gap);
                }
            }
        }
    }
}

/// Whole plates beside each other, flush, of which one reaches into the other by a thousandth: their large sides look away from each
/// other, and are not paired through both.
#[test]
fn flush_plates_touch_at_their_rims_alone() {
    for pairing in PAIRINGS {
        for thickness in [0.4, 1.0, 3.0] {
            let left = skin([0.0, thickness], 5.0, 2);
            let right = skin([0.0, thickness], 5.0, 4).mapped(|[x, y, z]| [x + 9.99, y, z]);
            let settings = SurfaceSettings { pairing, ..SurfaceSettings::default() };
            let found = TwoSheets::new(3, left, right).pair(&settings).unwrap();
            let through = found.pairs.iter().filter(|pair| pair.normal[2].abs() > 0.5).count();
            assert_eq!(through, 0, "{pairing:?}, {thickness}: {}", found.summary());
        }
    }
}

/// The two sides of a shell are in one plane: what overlaps it a little is paired.
#[test]
fn shells_of_no_thickness_may_be_overlapped() {
    for pairing in PAIRINGS {
        let shell = skin([0.0, 0.0], 5.0, 2);
        let plate = skin([-10.0, 1e-3], 8.0, 4);
        let settings = SurfaceSettings { pairing, ..SurfaceSettings::default() };
        let found = TwoSheets::new(3, shell, plate).pair(&settings).unwrap();
        assert_eq!(found.pairs.len(), 9, "{pairing:?}: {}", found.summary());
        assert!(found.pairs.iter().all(|pair| (pair.gap + 1e-3).abs() < 1e-13));
    }
}
