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

/// Places of a flat face with eight or nine nodes: Lagrange's parabolas along both directions, of which eight have no part `s² t²`.
fn place(x: &[[f64; 3]], [s, t]: [f64; 2]) -> [f64; 2] {
    let parabola = |c: f64| [0.5 * c * (c - 1.0), 1.0 - c * c, 0.5 * c * (c + 1.0)];
    let (along, across) = (parabola(s), parabola(t));
    let order = [[0, 0], [2, 0], [2, 2], [0, 2], [1, 0], [2, 1], [1, 2], [0, 1], [1, 1]];
    [0, 1].map(|c| {
        let sum = |nodes: &[[f64; 3]]| nodes.iter().map(|x| x[c]).sum::<f64>();
        let middle = x.get(8).map_or_else(|| 0.5 * sum(&x[4..8]) - 0.25 * sum(&x[..4]), |x| x[c]);
        let value = |node: usize| if node < 8 { x[node][c] } else { middle };
        let part = |(node, [i, j]): (usize, &[usize; 2])| value(node) * along[*i] * across[*j];
        order.iter().enumerate().map(part).sum()
    })
}

/// A fine division of a face: the middles of its cells and their areas.
fn cells(x: &[[f64; 3]], count: usize) -> Vec<([f64; 2], f64)> {
    let at = |i: f64, j: f64| place(x, [i, j].map(|c| 2.0 * c / count as f64 - 1.0));
    let cell = |k: usize| {
        let [i, j] = [k % count, k / count].map(|c| c as f64);
        let [a, b, c, d] = [at(i, j), at(i + 1.0, j), at(i + 1.0, j + 1.0), at(i, j + 1.0)];
        let [e, f] = [[c[0] - a[0], c[1] - a[1]], [d[0] - b[0], d[1] - b[1]]];
        (at(i + 0.5, j + 0.5), 0.5 * (e[0] * f[1] - e[1] * f[0]))
    };
    (0..count * count).map(cell).collect()
}

/// A flat face whose nodes lie anywhere near those of a square, as far as no part of it is thin, under masters on either side of
/// a line. Corners of masters lie beyond its curved edges, where its polynomials turn back: a part that crosses itself there misses by
/// as much as the face has. Lines that are bent in local coordinates have two straight ones in their place, which leave some hundredths: a tenth
/// tells both apart.
#[test]
fn distorted_faces_are_halved_by_any_line() {
    let rng = &mut Rng::with_seed(20);
    let settings = SurfaceSettings { rims: Rims::Keep, ..Default::default() };
    let (mut faces, off_by) = (0, 0.05);
    while faces < 400 {
        let shape = [Shape::Q8, Shape::Q9][faces % 2];
        let mut slave = Sheet::rectangle(shape, [1, 1], [[-0.5, 0.5]; 2], (0.0, rng));
        for x in &mut slave.nodes {
            let mut moved = || off_by * (2.0 * rng.f64() - 1.0);
            *x = [x[0] + moved(), x[1] + moved(), 0.0];
        }
        let own: Vec<[f64; 3]> = slave.faces[0].iter().map(|node| slave.nodes[*node]).collect();
        let cells = cells(&own, 100);
        let (least, most) = cells.iter().fold((f64::INFINITY, 0.0_f64), |(least, most), cell| {
            (least.min(cell.1), most.max(cell.1))
        });
        if least < 0.25 * most {
            continue;
        }
        faces += 1;
        // The masters have corners on all sides of the line, some of them near the face.
        let (sin, cos) = (7.0 * rng.f64()).sin_cos();
        let [off, from, to] = [0.4, 0.6, 0.6].map(|part| part * rng.f64());
        let turned = |[x, y, z]: [f64; 3]| [cos * x - sin * y, sin * x + cos * y, z];
        let half = |ends: [f64; 2]| {
            let along = [-0.4 - from, 0.4 + to];
            Sheet::rectangle(Shape::Q4, [1, 1], [ends, along], (0.0, &mut Rng::with_seed(1)))
                .mapped(turned)
        };
        let inside = |ends: [f64; 2]| {
            let is_in = |[x, y]: &[f64; 2]| {
                let [x, y] = [cos * x + sin * y, cos * y - sin * x];
                ends[0] <= x && x <= ends[1] && -0.4 - from <= y && y <= 0.4 + to
            };
            cells.iter().filter(|(at, _)| is_in(at)).map(|(_, area)| area).sum::<f64>()
        };
        for ends in [[-1.0, off], [off, 1.0]] {
            let sheets = TwoSheets::new(3, slave.clone().turned(), half(ends));
            let found = sheets.pair(&settings).unwrap();
            let miss = (found.report.covered_area - inside(ends)).abs();
            assert!(miss < 0.1, "{shape:?}, {faces}: {miss:e}");
        }
    }
}
