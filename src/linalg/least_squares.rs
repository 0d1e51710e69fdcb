//! Small least-squares problems: a few columns, of which some may depend on others.

use super::gmres::{orthogonalised, solve_triangle};

/// A column of which this part is left beside those before it depends on them.
const DEPENDENT: f64 = 1e-6;

/// The coefficients by which columns come nearest to a target; 0 of those that depend on earlier ones.
pub fn least_squares(columns: impl Iterator<Item = Vec<f64>>, target: &[f64]) -> Vec<f64> {
    let columns = Columns::new(columns, DEPENDENT);
    columns.coefficients(columns.take_out(&mut target.to_vec()))
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

    /// Takes the columns out of a vector, and returns its shares in `C`.
    pub fn take_out(&self, vector: &mut [f64]) -> Vec<f64> {
        let (mut shares, _, _) = orthogonalised(vector, &self.basis);
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

#[cfg(test)]
mod tests {
    use super::{Columns, least_squares};

    /// `2 + 3 x - x²` at four places with a rest `±1` that is orthogonal to all three, `(1, -3, 3, -1)`, and a column
    /// twice.
    #[test]
    fn a_polynomial_is_found_beside_what_no_column_has() {
        let x = [0.0, 1.0, 2.0, 3.0_f64];
        let column = |power: i32| x.iter().map(|x| x.powi(power)).collect::<Vec<f64>>();
        let rest = [1.0, -3.0, 3.0, -1.0];
        let target: Vec<f64> =
            x.iter().zip(rest).map(|(x, rest)| 2.0 + 3.0 * x - x * x + rest).collect();
        let found = least_squares([0, 1, 0, 2].map(column).into_iter(), &target);
        for (found, exact) in found.iter().zip([2.0, 3.0, 0.0, -1.0]) {
            // A hundred roundings.
            assert!((found - exact).abs() < 1e-13, "{found}, {exact}");
        }
    }

    /// A sum of images is found again by its shares, also where some images follow from others.
    #[test]
    fn shares_of_a_sum_of_images() {
        let mut rng = fastrand::Rng::with_seed(1);
        let mut vector = || -> Vec<f64> { (0..12).map(|_| rng.f64() - 0.5).collect() };
        let mut images: Vec<Vec<f64>> = (0..6).map(|_| vector()).collect();
        images[3] = images[1].iter().zip(&images[2]).map(|(a, b)| a - 2.0 * b).collect();
        let sum: Vec<f64> = (0..12).map(|i| images[0][i] + images[3][i] - images[5][i]).collect();
        let all = Columns::new(images.iter().cloned(), 1e-4);
        let mut left = sum.clone();
        let shares = all.take_out(&mut left);
        let shares = all.coefficients(shares);
        assert_eq!(shares.len(), images.len());
        for i in 0..12 {
            let again: f64 =
                shares.iter().zip(&images).map(|(share, image)| share * image[i]).sum();
            // Rounding of twelve terms, and of a basis of a condition about 10.
            assert!((again - sum[i]).abs() <= 1e-13, "{again} {}", sum[i]);
            assert!(left[i].abs() <= 1e-13, "{}", left[i]);
        }
    }
}
