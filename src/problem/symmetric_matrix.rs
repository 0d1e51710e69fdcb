//! Validation of a host's dense symmetric matrix.

use crate::error::{Argument, Error};
use crate::linalg::matrix::Matrix;

/// Asymmetry allowed, relative to the diagonal: far above the rounding of a host's condensation
/// (measured 1e-13 from CalculiX and MUMPS), far below a slip of indices.
pub(crate) const SYMMETRY: f64 = 1e-9;

/// Whether entries agree with those across the diagonal, up to rounding relative to it, which is
/// positive.
pub(crate) fn is_symmetric(matrix: &Matrix<'_>) -> bool {
    let root = matrix.diagonal_roots();
    let compare = |i: usize, j: usize, lower: f64, upper: f64| {
        if (lower - upper).abs() <= SYMMETRY * root[i] * root[j] { Ok(()) } else { Err(()) }
    };
    matrix.pairs_across(compare).is_ok()
}

/// Refuses entries that are not finite, diagonals that are not positive, asymmetry beyond rounding,
/// and entries that a positive semi-definite matrix cannot have. `name` is the host's name of the
/// matrix.
pub(crate) fn check(matrix: &Matrix<'_>, name: &str, argument: Argument) -> Result<(), Error> {
    let refuse = |message: String| Err(Error::invalid(argument, message));
    for j in 0..matrix.size() {
        let column = matrix.column(j);
        if let Some(i) = column.iter().position(|k| !k.is_finite()) {
            return refuse(format!("{name}[{i},{j}] is not finite"));
        }
        if column[j] <= 0.0 {
            if column.iter().all(|&k| k == 0.0) {
                return refuse(format!(
                    "row {j} of {name} is zero: component {j} has no stiffness; if the host holds \
                     it fixed, put a positive number on the diagonal"
                ));
            }
            return refuse(format!("{name}[{j},{j}] is {}, it must be positive", column[j]));
        }
    }
    let root = matrix.diagonal_roots();
    matrix.pairs_across(|i, j, lower, upper| {
        let scale = root[i] * root[j];
        let difference = (lower - upper).abs() / scale;
        if difference > SYMMETRY {
            return refuse(asymmetry(name, (i, j), (lower, upper), difference));
        }
        if lower.abs() > (1.0 + SYMMETRY) * scale {
            return refuse(format!(
                "{name} is not positive semi-definite: {name}[{i},{j}] is {lower}, more than its \
                 diagonal allows ({scale})"
            ));
        }
        Ok(())
    })
}

/// Rounding of single precision and of seven printed digits, relative to the diagonal: an asymmetry
/// below it is no slip of indices.
const SINGLE_PRECISION: f64 = 1e-6;

/// The sentence about two entries that should be equal; `difference` is relative to the diagonal.
pub(crate) fn asymmetry(
    name: &str,
    (i, j): (usize, usize),
    (lower, upper): (f64, f64),
    difference: f64,
) -> String {
    let mut message = format!(
        "{name} is not symmetric: {name}[{i},{j}] is {lower}, {name}[{j},{i}] is {upper}, they \
         differ by {difference:.1e} of the diagonal and may by {SYMMETRY:.0e}"
    );
    if difference < SINGLE_PRECISION {
        message.push_str(
            "; one of them looks rounded to single precision: use double precision for both, or \
             the average of the two",
        );
    }
    message
}
