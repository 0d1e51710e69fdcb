//! GMRES: a linear system of which only products are known; and orthonormal bases.
//!
//! Y. Saad and M. H. Schultz, *GMRES: a generalized minimal residual algorithm for solving nonsymmetric linear
//! systems*, SIAM J. Sci. Stat. Comput. 7 (1986) 856-869. Modified Gram-Schmidt, twice where digits cancel;
//! Givens rotations; no restart.

use super::tolerances::ROUNDING;
use super::vector::{dot, norm};

/// Where orthogonalisation leaves less of a vector than this part, it is done once more.
const CANCELS: f64 = 0.5;

/// Minimises `|right - sum c_j A v_j|` over the directions `v_0 = right / |right|, v_1, ...`, until it is at
/// most `least` or there are `most` directions. `multiply` gives `A v` of each direction in turn. Returns the
/// coefficients, one for each direction, and the norm of the residual.
///
/// # Errors
/// Those of `multiply`.
pub fn gmres<E>(
    right: &[f64],
    least: f64,
    most: usize,
    mut multiply: impl FnMut(&[f64]) -> Result<Vec<f64>, E>,
) -> Result<(Vec<f64>, f64), E> {
    let size = norm(right);
    // Columns of the triangle, rotations, and the rotated right side.
    let (mut triangle, mut rotations) = (Vec::<Vec<f64>>::new(), Vec::<(f64, f64)>::new());
    let mut rotated = vec![size];
    let mut basis = vec![scaled(right, 1.0 / size)];
    let mut residual = size;
    // Below the normal numbers a length has no reciprocal, and no direction.
    while size.is_normal() && residual > least && triangle.len() < most {
        let k = triangle.len();
        let mut image = multiply(&basis[k])?;
        let (mut column, left, was) = orthogonalised(&mut image, &basis);
        for (j, &(c, s)) in rotations.iter().enumerate() {
            (column[j], column[j + 1]) =
                (c * column[j] + s * column[j + 1], c * column[j + 1] - s * column[j]);
        }
        let diagonal = column[k].hypot(left);
        // Less is rounding: the space of the directions is invariant.
        if !(diagonal > ROUNDING * was) {
            break;
        }
        let (c, s) = (column[k] / diagonal, left / diagonal);
        column[k] = diagonal;
        column.truncate(k + 1);
        triangle.push(column);
        rotations.push((c, s));
        let last = rotated[k];
        rotated[k] = c * last;
        rotated.push(-s * last);
        residual = (s * last).abs();
        if left <= ROUNDING * was || !left.is_normal() {
            break;
        }
        basis.push(scaled(&image, 1.0 / left));
    }
    let mut coefficients = rotated;
    coefficients.truncate(triangle.len());
    solve_triangle(&triangle, &mut coefficients);
    Ok((coefficients, residual))
}

/// Overwrites `x` with the solution of an upper triangle of columns.
pub fn solve_triangle(triangle: &[Vec<f64>], x: &mut [f64]) {
    for (k, column) in triangle.iter().enumerate().rev() {
        x[k] /= column[k];
        let known = x[k];
        (0..k).for_each(|j| x[j] -= known * column[j]);
    }
}

/// Takes the directions of `basis` out of a vector: their coefficients, followed by a 0, what is left of its
/// length, and its length.
pub fn orthogonalised(vector: &mut [f64], basis: &[Vec<f64>]) -> (Vec<f64>, f64, f64) {
    let mut column = vec![0.0; basis.len() + 1];
    let was = norm(vector);
    let (mut before, mut left) = (f64::INFINITY, was);
    while left < CANCELS * before && left > 0.0 {
        for (coefficient, direction) in column.iter_mut().zip(basis) {
            let share = dot(direction, vector);
            *coefficient += share;
            vector.iter_mut().zip(direction).for_each(|(v, d)| *v -= share * d);
        }
        (before, left) = (left, norm(vector));
    }
    (column, left, was)
}

/// Adds to an orthonormal `basis` the part of `v` that is orthogonal to it, normalised.
pub fn extend_basis(basis: &mut Vec<Vec<f64>>, mut v: Vec<f64>) {
    let (_, size, _) = orthogonalised(&mut v, basis);
    v.iter_mut().for_each(|v| *v /= size);
    basis.push(v);
}

fn scaled(vector: &[f64], factor: f64) -> Vec<f64> {
    vector.iter().map(|v| factor * v).collect()
}
