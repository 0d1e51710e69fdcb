//! Small least-squares problems: a few columns, of which some may depend on others.

use super::vector::dot;

/// A column of which this part is left beside those before it depends on them.
const DEPENDENT: f64 = 1e-6;

/// The coefficients by which columns come nearest to a target; 0 of those that depend on earlier ones.
pub fn least_squares(columns: Vec<Vec<f64>>, target: &[f64]) -> Vec<f64> {
    let count = columns.len();
    // Orthonormal columns, each with its place, and the parts that columns have along those before them.
    let mut basis: Vec<(usize, Vec<f64>)> = Vec::new();
    let mut parts = vec![vec![0.0; count]; count];
    for (place, mut column) in columns.into_iter().enumerate() {
        let before = dot(&column, &column).sqrt();
        for (other, unit) in &basis {
            let part = dot(&column, unit);
            parts[*other][place] = part;
            column.iter_mut().zip(unit).for_each(|(x, unit)| *x -= part * unit);
        }
        let left = dot(&column, &column).sqrt();
        if left > DEPENDENT * before {
            parts[place][place] = left;
            column.iter_mut().for_each(|x| *x /= left);
            basis.push((place, column));
        }
    }
    let mut coefficients = vec![0.0; count];
    for (place, unit) in basis.iter().rev() {
        let known = dot(&parts[*place], &coefficients);
        coefficients[*place] = (dot(target, unit) - known) / parts[*place][*place];
    }
    coefficients
}

#[cfg(test)]
mod tests {
    use super::least_squares;

    /// `2 + 3 x - x²` at four places with a rest `±1` that is orthogonal to all three, `(1, -3, 3, -1)`, and a column
    /// twice.
    #[test]
    fn a_polynomial_is_found_beside_what_no_column_has() {
        let x = [0.0, 1.0, 2.0, 3.0_f64];
        let column = |power: i32| x.iter().map(|x| x.powi(power)).collect::<Vec<f64>>();
        let rest = [1.0, -3.0, 3.0, -1.0];
        let target: Vec<f64> =
            x.iter().zip(rest).map(|(x, rest)| 2.0 + 3.0 * x - x * x + rest).collect();
        let found = least_squares(vec![column(0), column(1), column(0), column(2)], &target);
        for (found, exact) in found.iter().zip([2.0, 3.0, 0.0, -1.0]) {
            // A hundred roundings.
            assert!((found - exact).abs() < 1e-13, "{found}, {exact}");
        }
    }
}
