//! An elastic half-space under tractions that are uniform on the squares of a grid, and what the closed
//! forms of its contacts need.
//!
//! Displacements at the centres of the squares, by Boussinesq's and Cerruti's solutions integrated over a
//! rectangle (A. E. H. Love 1929; K. L. Johnson, *Contact Mechanics*, 1985, chapter 3). With
//! `x`, `y` from the square to the point, `r` its length, means over the square, `n` outward, and forces on
//! the half-space:
//!
//! ```text
//! d_n   from F_n:   (1 - nu) / (2 pi G) ∬ 1/r
//! d_t1  from F_t1:  1 / (2 pi G) ∬ (1 - nu)/r + nu x²/r³       d_t2 from F_t1:  nu / (2 pi G) ∬ x y/r³
//! d_t1  from F_n:   (1 - 2 nu) / (4 pi G) ∬ x/r²               d_n from F_t1: the same with the other sign
//! ```

use nalgebra::DMatrix;

/// An isotropic material.
#[derive(Clone, Copy, Debug)]
pub struct HalfSpace {
    pub shear: f64,
    pub poisson: f64,
    /// `true`: pressures move the surface along itself. The theories of friction on round contacts
    /// leave this out; it vanishes for an incompressible material.
    pub coupled: bool,
}

/// Squares of an `n` x `n` grid on [-1, 1]² whose centres are within a radius.
#[derive(Clone, Debug)]
pub struct Grid {
    pub side: f64,
    pub centres: Vec<[f64; 2]>,
}

impl Grid {
    pub fn new(n: usize, radius: f64) -> Grid {
        let side = 2.0 / n as f64;
        let at = |i: usize| -1.0 + side * (i as f64 + 0.5);
        let centres = (0..n * n)
            .map(|k| [at(k % n), at(k / n)])
            .filter(|[x, y]| x.hypot(*y) <= radius)
            .collect();
        Grid { side, centres }
    }

    pub fn area(&self) -> f64 {
        self.side * self.side
    }

    pub fn radii(&self) -> impl Iterator<Item = f64> + '_ {
        self.centres.iter().map(|[x, y]| x.hypot(*y))
    }

    /// Radius of the disc that has the area of `count` squares.
    pub fn radius_of(&self, count: usize) -> f64 {
        (count as f64 * self.area() / std::f64::consts::PI).sqrt()
    }
}

impl HalfSpace {
    /// `E / (1 - nu²)`: that of the contact with a rigid body.
    pub fn contact_modulus(&self) -> f64 {
        2.0 * self.shear / (1.0 - self.poisson)
    }

    /// Displacement (row) at `(x, y)` from the centre of a square, by the force (column) on it.
    fn block(&self, x: f64, y: f64, side: f64) -> [[f64; 3]; 3] {
        let nu = self.poisson;
        let over = |primitive: fn(f64, f64) -> f64| {
            let half = side / 2.0;
            let along = |y: f64| primitive(x + half, y) - primitive(x - half, y);
            (along(y + half) - along(y - half)) / (side * side)
        };
        // ∬ x²/r³ and ∬ y²/r³, whose sum is ∬ 1/r; ∬ x y/r³; ∬ x/r² and ∬ y/r².
        let xx = over(|x, y| y * (x + x.hypot(y)).ln());
        let yy = over(|x, y| x * (y + x.hypot(y)).ln());
        let xy = over(|x, y| -x.hypot(y));
        let turn = |x: f64, y: f64| y * x.hypot(y).ln() + x * (y / x).atan();
        let by_x = over(turn);
        let by_y = over(|x, y| x * x.hypot(y).ln() + y * (x / y).atan());
        let unit = 1.0 / (2.0 * std::f64::consts::PI * self.shear);
        let across = if self.coupled { unit * (0.5 - nu) } else { 0.0 };
        [
            [unit * (1.0 - nu) * (xx + yy), -across * by_x, -across * by_y],
            [across * by_x, unit * (xx + (1.0 - nu) * yy), unit * nu * xy],
            [across * by_y, unit * nu * xy, unit * ((1.0 - nu) * xx + yy)],
        ]
    }

    /// Displacements by forces, (n, t1, t2) = (up, x, y) of square after square.
    pub fn flexibility(&self, grid: &Grid) -> DMatrix<f64> {
        let n = 3 * grid.centres.len();
        let mut w = DMatrix::zeros(n, n);
        for (i, to) in grid.centres.iter().enumerate() {
            for (j, from) in grid.centres.iter().enumerate() {
                let block = self.block(to[0] - from[0], to[1] - from[1], grid.side);
                for (a, row) in block.iter().enumerate() {
                    for (b, entry) in row.iter().enumerate() {
                        w[(3 * i + a, 3 * j + b)] = *entry;
                    }
                }
            }
        }
        w
    }

    /// Inverse of the flexibility, symmetric to the last bit, column-major. Forces on squares that are
    /// not in the grid are zero.
    pub fn stiffness(&self, grid: &Grid) -> Vec<f64> {
        let w = self.flexibility(grid);
        // Betti's theorem.
        assert!((&w - w.transpose()).amax() <= 1e-13 * w.amax(), "the flexibility is symmetric");
        let k = w.cholesky().expect("the flexibility is definite").inverse();
        ((&k + k.transpose()) / 2.0).as_slice().to_vec()
    }
}

/// Complete elliptic integrals `K` and `E` of the modulus `k`, by the arithmetic-geometric mean
/// (M. Abramowitz and I. A. Stegun, *Handbook of Mathematical Functions*, 17.6).
pub fn elliptic(k: f64) -> (f64, f64) {
    let (mut a, mut b, mut c) = (1.0, (1.0 - k * k).sqrt(), k);
    let (mut sum, mut weight) = (0.0, 0.5);
    // The number of right digits doubles with each round: c is zero or rounding after eight.
    for _ in 0..8 {
        sum += weight * c * c;
        weight *= 2.0;
        (a, b, c) = ((a + b) / 2.0, (a * b).sqrt(), (a - b) / 2.0);
    }
    let first = std::f64::consts::FRAC_PI_2 / a;
    (first, first * (1.0 - sum))
}
