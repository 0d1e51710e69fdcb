//! Quadratic faces over the rim of a master: the closed forms of what each node carries of a uniform pressure.

use crate::surfaces::{Shape, Sheet, TwoSheets, line};
use fastrand::Rng;
use signorini::surface::{Rims, SurfaceSettings};

/// Parts of a face that its master covers: from little to nearly all of it.
const PARTS: [f64; 7] = [0.1, 0.5, 0.75, 0.8, 0.85, 0.95, 0.99];

/// Integrals of Bernstein's polynomials `(1 - x)²`, `x²` and `2 x (1 - x)` over `0..t`: ends, then the middle.
fn integrals(t: f64) -> [f64; 3] {
    [(1.0 - (1.0 - t).powi(3)) / 3.0, t.powi(3) / 3.0, t * t - 2.0 * t.powi(3) / 3.0]
}

/// The area of each slave node, in the order of its face.
fn areas(sheets: &TwoSheets) -> Vec<f64> {
    let settings = SurfaceSettings { rims: Rims::Keep, ..SurfaceSettings::default() };
    let found = sheets.pair(&settings).unwrap();
    // The slave is one face of side 1.
    assert!((found.report.slave_area - 1.0).abs() < 1e-14, "{:?}", found.report);
    let area = |node: &usize| found.pairs.iter().find(|pair| pair.slave == *node).unwrap().area;
    sheets.slave[0].iter().map(area).collect()
}

/// A face of which a part is covered, however much, has functions that are nowhere negative: on a line with three nodes
/// Bernstein's polynomials, and on a quadrilateral with nine their products. The area of a node is the integral of its
/// function over the covered part. One that is covered wholly carries by its shape functions, 1/6, 1/6 and 2/3.
#[test]
fn a_covered_part_carries_by_bernsteins_polynomials() {
    for t in PARTS {
        let (nodes, faces) = line(&[0.0, 1.0], true, 0);
        let slave = Sheet { nodes, faces };
        // The body of the master lies below: its line runs from right to left.
        let master =
            Sheet { nodes: vec![[t, 0.0, 0.0], [-0.2, 0.0, 0.0]], faces: vec![vec![0, 1]] };
        let found = areas(&TwoSheets::new(2, slave, master));
        let x = integrals(t);
        // Rounding of an area of 1 in some tens of operations.
        for (found, expected) in found.iter().zip(x) {
            assert!((found - expected).abs() < 1e-14, "{t}: {found}, {expected}");
        }
        let rng = &mut Rng::with_seed(1);
        let slave = Sheet::rectangle(Shape::Q9, [1, 1], [[0.0, 1.0]; 2], (0.0, rng)).turned();
        let master = Sheet::rectangle(Shape::Q4, [1, 1], [[-0.2, t], [-0.2, 1.2]], (0.0, rng));
        let sheets = TwoSheets::new(3, slave, master);
        for (found, node) in areas(&sheets).iter().zip(&sheets.slave[0]) {
            // The function of a place along one edge: that of an end, or of the middle.
            let along =
                |place: f64, t: f64| integrals(t)[[0, 2, 1][(2.0 * place).round() as usize]];
            let [px, py, _] = sheets.nodes[*node];
            let expected = along(px, t) * along(py, 1.0);
            assert!((found - expected).abs() < 1e-14, "{t}: {px}, {py}: {found}, {expected}");
        }
    }
    let (nodes, faces) = line(&[0.0, 1.0], true, 0);
    let master = Sheet { nodes: vec![[1.2, 0.0, 0.0], [-0.2, 0.0, 0.0]], faces: vec![vec![0, 1]] };
    let found = areas(&TwoSheets::new(2, Sheet { nodes, faces }, master));
    for (found, expected) in found.iter().zip([1.0 / 6.0, 1.0 / 6.0, 2.0 / 3.0]) {
        assert!((found - expected).abs() < 1e-14, "{found}, {expected}");
    }
}

/// A part of a face with six or eight nodes that grows is a growing area of each node: nothing that is nowhere negative
/// falls.
#[test]
fn a_growing_part_is_a_growing_area_of_each_node() {
    for shape in [Shape::T6, Shape::Q8] {
        let mut before = Vec::new();
        for t in PARTS {
            let rng = &mut Rng::with_seed(1);
            let slave = Sheet::rectangle(shape, [1, 1], [[0.0, 1.0]; 2], (0.0, rng)).turned();
            let master = Sheet::rectangle(Shape::Q4, [1, 1], [[-0.2, t], [-0.2, 1.2]], (0.0, rng));
            let now = areas(&TwoSheets::new(3, slave, master));
            let grows = before.iter().zip(&now).all(|(before, now)| *now > before - 1e-14);
            assert!(grows && now.iter().all(|area| *area > 0.0), "{shape:?} {t}: {now:?}");
            before = now;
        }
    }
}

/// Two masters that lie over each other by a hundredth of the slave's face, which legal meshes of a curved surface may do as a
/// whole: a pressure would count twice there, and the slave's face names them.
#[test]
fn masters_over_each_other_by_a_hundredth_are_named() {
    let rng = &mut Rng::with_seed(1);
    let slave = Sheet::rectangle(Shape::Q4, [1, 1], [[0.0, 1.0]; 2], (0.0, rng)).turned();
    let mut pair_with = |middle: [f64; 2]| {
        let [to, from] = middle;
        let mut master = Sheet::rectangle(Shape::Q4, [1, 1], [[-0.2, to], [-0.2, 1.2]], (0.0, rng));
        let other = Sheet::rectangle(Shape::Q4, [1, 1], [[from, 1.2], [-0.2, 1.2]], (0.0, rng));
        let first = master.nodes.len();
        master.nodes.extend(other.nodes);
        let shifted = |face: Vec<usize>| face.into_iter().map(|node| node + first).collect();
        master.faces.extend(other.faces.into_iter().map(shifted));
        TwoSheets::new(3, slave.clone(), master).pair(&SurfaceSettings::default())
    };
    assert!(pair_with([0.5, 0.5]).is_ok());
    let message = pair_with([0.505, 0.495]).unwrap_err().message().to_string();
    assert!(message.contains("lie over each other"), "{message}");
}
