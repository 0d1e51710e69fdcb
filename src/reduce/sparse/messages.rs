//! Sentences about errors in a host's sparse matrix, its supports and pairs: what is wrong, where, and
//! what to do.

use super::host_arrays::{Indices, SparseMatrix};
use crate::error::{entry, index};
use crate::linalg::sparse_schur::Failure;
use crate::problem::NEARLY_DEPENDENT;
use crate::reduce::motion;

/// Beyond this an integer is none that counts the entries of a matrix in memory, but two integers of 4
/// bytes side by side.
const TWO_INTEGERS: i64 = 1 << 32;

/// Why entry `j` of `col_start` is refused.
pub(super) fn col_start(matrix: &SparseMatrix<'_>, j: usize) -> String {
    let (value, base, nnz) = (matrix.col_start.get(j), matrix.index_base, matrix.values.len());
    let said = format!("{} is {value}", entry("col_start", [j]));
    if let Some(question) = width(&matrix.col_start, j) {
        return format!("{said}: {question}");
    }
    if j == 0 {
        let other = 1 - base;
        if value == other {
            return format!(
                "{said}, but index_base is {base}: set index_base to {other}, or count from {base}"
            );
        }
        if value != base {
            return format!("{said}, it must be index_base, which is {base}");
        }
    } else if value < matrix.col_start.get(j - 1) {
        return format!(
            "{said}, less than {}, which is {}: col_start must not descend",
            entry("col_start", [j - 1]),
            matrix.col_start.get(j - 1)
        );
    }
    if j == matrix.size {
        return format!(
            "the columns hold {} entries ({said}, index_base is {base}), but nnz is {nnz}: size, \
             here {}, must be the number of degrees of freedom, and nnz the number of stored entries",
            value.saturating_sub(base),
            matrix.size
        );
    }
    format!("{said}, beyond the stored entries: nnz is {nnz}, index_base is {base}")
}

/// Asks whether the integers have another width than was said, if entry `k` looks like it.
fn width(indices: &Indices<'_>, k: usize) -> Option<&'static str> {
    let value = indices.get(k);
    match indices {
        Indices::Wide(_) if !(-TWO_INTEGERS..TWO_INTEGERS).contains(&value) => {
            Some("are these integers of 4 bytes, and index_bytes 8?")
        }
        // The upper halves of small integers of 8 bytes are zero.
        Indices::Narrow(values)
            if k % 2 == 1 && values[1..=k].iter().step_by(2).all(|half| *half == 0) =>
        {
            Some("are these integers of 8 bytes, and index_bytes 4?")
        }
        _ => None,
    }
}

/// Entry `k` of `row`, in column `j`, is no row of the matrix.
pub(super) fn row_out_of_range(matrix: &SparseMatrix<'_>, k: usize, j: usize) -> String {
    let (value, base) = (matrix.row.get(k), matrix.index_base);
    let what = match width(&matrix.row, k) {
        Some(question) => question.to_owned(),
        None => format!("size is {} and index_base {base}", matrix.size),
    };
    format!("{}, in column {}, is {value}: {what}", entry("row", [k]), index(j))
}

/// Entry `k` of `row`, in column `j`, names row `i` after row `last`.
pub(super) fn row_out_of_order(k: usize, j: usize, (last, i): (usize, usize)) -> String {
    let (said, place) = (format!("column {}: row {}", index(j), index(i)), entry("row", [k]));
    if last == i {
        let before = entry("row", [k - 1]);
        return format!(
            "{said} is listed twice, in {before} and {place}: sum the values of one place to one \
             entry"
        );
    }
    format!(
        "{said} stands after row {}, in {place}: row indices must be strictly ascending in each \
         column",
        index(last)
    )
}

/// Why the factorisation failed, with motions by `host` in degrees of freedom of the host, and the free ones of these. Pairs of
/// `general` rows may nearly follow from others, which enlarges rounding.
///
/// # Panics
/// If it was stopped, or lacks memory: that is told elsewhere.
pub(super) fn failure(
    failure: Failure,
    free: &[usize],
    host: impl Fn(&[f64]) -> Vec<f64>,
    general: bool,
) -> String {
    let moves = |x: &[f64]| format!("it moves {}", motion::of_host(&host(x)));
    let indefinite = "K is not positive semi-definite";
    match failure {
        Failure::OutOfMemory | Failure::Stopped => unreachable!("who stops it says why"),
        Failure::Indefinite(row) => match free.get(row) {
            Some(dof) => format!("{indefinite}, as degree of freedom {} shows", index(dof)),
            None => indefinite.into(),
        },
        Failure::Negative(x) => {
            format!(
                "{indefinite}: the energy of a motion is negative: {}; if bodies move so without strain, K is rounded: give all its \
                 digits",
                moves(&x)
            )
        }
        Failure::NullVector(x) => {
            format!("a motion remains that no support and no pair holds: {}", moves(&x))
        }
        Failure::Unclear(x) => {
            let otherwise =
                if general { format!("{NEARLY_DEPENDENT}; otherwise ") } else { String::new() };
            format!(
                "the stiffness against a motion cannot be told from the rounding of K: {}: {otherwise}support the \
                 motion, or hold it by springs that are not so soft beside K",
                moves(&x)
            )
        }
    }
}
