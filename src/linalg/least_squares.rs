//! Small least-squares problems: a few columns, of which some may depend on others.

use nalgebra::{DMatrix, DVector};

use super::gmres::{orthogonalised, solve_triangle};
use super::tolerances::ROUNDING;

/// A column of which this part is left beside those before it depends on them.
const DEPENDENT: f64 = 1e-6;

/// The coefficients by which columns come nearest to a target; 0 of those that depend on earlier ones.
pub fn least_squares(columns: impl Iterator<Item = Vec<f64>>, target: &[f64]) -> Vec<f64> {
    let columns = Columns::new(columns, DEPENDENT);
    columns.coefficients(columns.take_out(&mut target.to_vec()))
}

/// A matrix of any size.
pub type Matrix = DMatrix<f64>;

/// One column of any length.
pub type Column = DVector<f64>;

/// Columns of which some may depend on others, for many targets.
pub struct Nearest {
    columns: DMatrix<f64>,
    inverse: DMatrix<f64>,
    /// A basis of the coefficients that change nothing.
    free: DMatrix<f64>,
}

impl Nearest {
    /// What changes a sum of columns by less than `part` of the most counts as nothing.
    pub fn new(columns: &[Vec<f64>], part: f64) -> Self {
        let count = columns.len();
        // As many rows as columns at least: the factors then have all that changes nothing.
        let rows = columns[0].len().max(count);
        let entry = |i: usize, j: usize| columns[j].get(i).copied().unwrap_or(0.0);
        let columns = DMatrix::from_fn(rows, count, entry);
        let (basis, triangle) = columns.clone().qr().unpack();
        let inverse = triangle.solve_upper_triangular(&DMatrix::identity(count, count));
        // The norms are larger than the most and the inverse of the least: often they tell that nothing is free.
        let tells = |inverse: &DMatrix<f64>| part * triangle.norm() * inverse.norm() < 1.0;
        if let Some(inverse) = inverse.filter(tells) {
            let (inverse, free) = (inverse * basis.transpose(), DMatrix::zeros(count, 0));
            return Nearest { columns, inverse, free };
        }
        let factors = columns.clone().svd(true, true);
        let least = part * factors.singular_values.max();
        let right = factors.v_t.as_ref().expect("both factors are there");
        // In descending order.
        let held = factors.singular_values.iter().filter(|size| **size > least).count();
        let free = right.rows(held, count - held).transpose();
        let inverse = factors.pseudo_inverse(least).expect("both factors are there");
        Nearest { columns, inverse, free }
    }

    /// True if some coefficients change nothing.
    pub fn is_free(&self) -> bool {
        self.free.ncols() > 0
    }

    /// Takes coefficients on to some by which columns come nearest to a target; once more takes out the rounding that columns
    /// which are nearly dependent leave.
    pub fn improve(&self, found: &mut DVector<f64>, target: &[f64]) {
        let mut left = -(&self.columns * &*found);
        left.iter_mut().zip(target).for_each(|(left, target)| *left += target);
        *found += &self.inverse * left;
    }

    /// Of all coefficients that are as near as some those whose product with a regular matrix, how dear they are, is smallest.
    pub fn cheapest(&self, found: &mut DVector<f64>, dear: &DMatrix<f64>) {
        let (basis, triangle) = (dear * &self.free).qr().unpack();
        let shares = basis.tr_mul(&(dear * &*found));
        if let Some(shares) = triangle.solve_upper_triangular(&shares) {
            *found -= &self.free * shares;
        }
    }
}

/// Columns as an orthonormal basis `C` times a triangle `R`.
#[derive(Default)]
pub struct Columns {
    basis: Vec<Vec<f64>>,
    /// Columns of `R`.
    triangle: Vec<Vec<f64>>,
    /// The columns that are in the basis, and the number of all.
    which: Vec<usize>,
    count: usize,
}

impl Columns {
    /// The basis of columns, without those of which no more than this part is left when the ones before are taken out.
    pub fn new(columns: impl Iterator<Item = Vec<f64>>, dependent: f64) -> Self {
        let mut all = Columns::default();
        columns.for_each(|own| all.push(own, dependent));
        all
    }

    /// One more column, which is left out of the basis if no more than this part of it is left.
    pub fn push(&mut self, mut own: Vec<f64>, dependent: f64) {
        let (mut column, left, was) = orthogonalised(&mut own, &self.basis);
        if left > dependent * was {
            own.iter_mut().for_each(|v| *v /= left);
            column[self.basis.len()] = left;
            self.basis.push(own);
            self.triangle.push(column);
            self.which.push(self.count);
        }
        self.count += 1;
    }

    /// Leaves the first `count` columns.
    pub fn truncate(&mut self, count: usize) {
        self.which.retain(|&column| column < count);
        self.basis.truncate(self.which.len());
        self.triangle.truncate(self.which.len());
        self.count = count;
    }

    /// True if no column depends on earlier ones.
    pub fn are_independent(&self) -> bool {
        self.which.len() == self.count
    }

    /// Takes the columns out of a vector, and returns its shares in `C`. Of a vector in their span nothing is left: its rounding,
    /// taken for a vector, would have digits of chance alone.
    pub fn take_out(&self, vector: &mut [f64]) -> Vec<f64> {
        let (mut shares, left, was) = orthogonalised(vector, &self.basis);
        if left <= ROUNDING * was {
            vector.fill(0.0);
        }
        shares.pop();
        shares
    }

    /// The coefficients of the columns whose sum has the given shares in `C`; 0 of those that depend on earlier ones.
    pub fn coefficients(&self, mut shares: Vec<f64>) -> Vec<f64> {
        solve_triangle(&self.triangle, &mut shares);
        let mut all = vec![0.0; self.count];
        self.which.iter().zip(shares).for_each(|(&place, share)| all[place] = share);
        all
    }
}
