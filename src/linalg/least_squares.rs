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

/// Of all coefficients by which columns come nearest to a target those whose sum of squares is least. What changes a sum of
/// columns by less than this part of the most counts as nothing.
pub fn least_coefficients(columns: &[Vec<f64>], target: &[f64], part: f64) -> Vec<f64> {
    let column = |column: &Vec<f64>| DVector::from_column_slice(column);
    let columns = DMatrix::from_columns(&columns.iter().map(column).collect::<Vec<_>>());
    let factors = columns.clone().svd(true, true);
    let least = part * factors.singular_values.max();
    let solved =
        |right: &DVector<f64>| factors.solve(right, least).expect("both factors are there");
    let target = DVector::from_column_slice(target);
    let first = solved(&target);
    // Columns that are nearly dependent have left rounding, which a second solution takes out.
    let found = &first + solved(&(target - columns * &first));
    found.as_slice().to_vec()
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
        for mut own in columns {
            let (mut column, left, was) = orthogonalised(&mut own, &all.basis);
            if left > dependent * was {
                own.iter_mut().for_each(|v| *v /= left);
                column[all.basis.len()] = left;
                all.basis.push(own);
                all.triangle.push(column);
                all.which.push(all.count);
            }
            all.count += 1;
        }
        all
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
