//! The bar on the plane (paper, section 4.1) on any Q1 mesh, condensed row by row of nodes.
//!
//! Plane strain, half model 40 x 40 mm, E = 13000 daN/mm², nu = 0.2; row heights in geometric
//! progression from the contact side; `side` inward on x = 0, u_x = 0 on x = 40. On top a pressure
//! of 5, or all nodes held there and moved down.
//! Components per node: (n, t) = (-u_y, u_x).

use faer::linalg::solvers::Solve;
use faer::{Mat, Side};

/// A condensed contact problem in owned arrays.
pub struct Condensed {
    pub pairs: usize,
    /// Column-major, `2 * pairs` square.
    pub stiffness: Vec<f64>,
    pub load: Vec<f64>,
}

const E: f64 = 13000.0;
const NU: f64 = 0.2;
const SIZE: f64 = 40.0;

/// Condition on the upper side.
#[derive(Clone, Copy, PartialEq)]
#[allow(dead_code)] // Every user uses a part.
pub enum Top {
    Pressed,
    /// Held, and moved towards the plane by a length.
    Clamped(f64),
}

/// The bar with `columns x rows` elements of heights growing by `ratio`, pressed.
#[allow(dead_code)] // as above
pub fn bar(columns: usize, rows: usize, ratio: f64, side: f64) -> Condensed {
    bar_with_top(columns, rows, ratio, side, Top::Pressed)
}

/// The bar with either kind of upper side.
pub fn bar_with_top(columns: usize, rows: usize, ratio: f64, side: f64, top: Top) -> Condensed {
    let n = 2 * (columns + 1);
    let first = if ratio == 1.0 {
        SIZE / rows as f64
    } else {
        SIZE * (ratio - 1.0) / (ratio.powi(rows as i32) - 1.0)
    };
    let mut carried: Option<(Mat<f64>, Mat<f64>)> = None;
    for row in (0..rows).rev() {
        let height = first * ratio.powi(row as i32);
        let mut layer = Mat::<f64>::zeros(2 * n, 2 * n);
        let element = element(SIZE / columns as f64, height);
        for column in 0..columns {
            // Nodes of the element, bottom left, bottom right, top right, top left.
            let nodes =
                [column, column + 1, columns + 1 + column + 1, columns + 1 + column].map(|n| 2 * n);
            for (a, &row) in nodes.iter().enumerate() {
                for (b, &col) in nodes.iter().enumerate() {
                    for i in 0..2 {
                        for j in 0..2 {
                            layer[(row + i, col + j)] += element[2 * a + i][2 * b + j];
                        }
                    }
                }
            }
        }
        let mut load = Mat::<f64>::zeros(2 * n, 1);
        load[(1, 0)] += side * height / 2.0;
        load[(n + 1, 0)] += side * height / 2.0;
        for fixed in [n - 1, 2 * n - 1] {
            let diagonal = layer[(fixed, fixed)];
            layer.row_mut(fixed).fill(0.0);
            layer.col_mut(fixed).fill(0.0);
            layer[(fixed, fixed)] = diagonal;
        }
        let coupling = layer.submatrix(n, 0, n, n).to_owned();
        let rest = layer.submatrix(0, 0, n, n);
        if let (None, Top::Clamped(down)) = (&carried, top) {
            let moved = Mat::<f64>::from_fn(n, 1, |i, _| if i % 2 == 0 { down } else { 0.0 });
            let held = load.submatrix(0, 0, n, 1) - coupling.transpose() * &moved;
            carried = Some((rest.to_owned(), held));
            continue;
        }
        let mut upper = layer.submatrix(n, n, n, n).to_owned();
        let mut upper_load = load.submatrix(n, 0, n, 1).to_owned();
        match carried.take() {
            Some((stiffness, load)) => {
                upper += stiffness;
                upper_load += load;
            }
            None => {
                let share = 5.0 * SIZE / columns as f64;
                for node in 0..=columns {
                    let share = if node % columns == 0 { share / 2.0 } else { share };
                    upper_load[(2 * node, 0)] += share;
                }
            }
        }
        let factor = upper.llt(Side::Lower).expect("the upper part of the bar is held from below");
        let inner = factor.solve(&coupling);
        let inner_load = factor.solve(&upper_load);
        let stiffness = rest - coupling.transpose() * &inner;
        let load = load.submatrix(0, 0, n, 1) - coupling.transpose() * &inner_load;
        carried = Some((stiffness, load));
    }
    let (stiffness, load) = carried.expect("at least one row");
    Condensed {
        pairs: columns + 1,
        stiffness: (0..n * n)
            .map(|k| 0.5 * (stiffness[(k % n, k / n)] + stiffness[(k / n, k % n)]))
            .collect(),
        load: (0..n).map(|i| if i == n - 1 { 0.0 } else { load[(i, 0)] }).collect(),
    }
}

/// Stiffness of a `width x height` Q1 element by 2 x 2 Gauss points, components (-u_y, u_x).
fn element(width: f64, height: f64) -> [[f64; 8]; 8] {
    let lame = E * NU / ((1.0 + NU) * (1.0 - 2.0 * NU));
    let shear = E / (2.0 * (1.0 + NU));
    let signs = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let point = 1.0 / 3.0_f64.sqrt();
    let mut stiffness = [[0.0; 8]; 8];
    for (x, y) in signs.map(|(x, y)| (point * x, point * y)) {
        let mut gradient = [(0.0, 0.0); 4];
        for (gradient, (sx, sy)) in gradient.iter_mut().zip(signs) {
            let dx = sx * (1.0 + sy * y) / 4.0 * 2.0 / width;
            let dy = sy * (1.0 + sx * x) / 4.0 * 2.0 / height;
            *gradient = (dx, dy);
        }
        let weight = width * height / 4.0;
        for (a, (ax, ay)) in gradient.into_iter().enumerate() {
            for (b, (bx, by)) in gradient.into_iter().enumerate() {
                let xx = (lame + 2.0 * shear) * ax * bx + shear * ay * by;
                let yy = (lame + 2.0 * shear) * ay * by + shear * ax * bx;
                let xy = lame * ax * by + shear * ay * bx;
                let yx = lame * ay * bx + shear * ax * by;
                let block = [[yy, -yx], [-xy, xx]];
                for i in 0..2 {
                    for j in 0..2 {
                        stiffness[2 * a + i][2 * b + j] += weight * block[i][j];
                    }
                }
            }
        }
    }
    stiffness
}
