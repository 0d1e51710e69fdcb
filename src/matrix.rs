//! A host's dense symmetric matrix, checked before it is believed.

use crate::error::{Argument, Error};

/// A view of a symmetric matrix, column-major, both triangles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SymmetricMatrix<'a> {
    /// Number of rows and columns.
    pub(crate) size: usize,
    /// Columns, `ld` entries from one to the next.
    pub(crate) entries: &'a [f64],
    /// Leading dimension, at least `size`.
    pub(crate) ld: usize,
}

/// Asymmetry allowed, relative to the diagonal: far above the rounding of a host's condensation
/// (measured 1e-13 from CalculiX and MUMPS), far below a slip of indices.
pub(crate) const SYMMETRY: f64 = 1e-9;

/// Asymmetry up to this, relative to the diagonal, is that of entries rounded to single precision
/// (6e-8) or printed with seven digits (5e-7); more is another mistake.
const SINGLE_PRECISION: f64 = 1e-6;

/// How far two entries that mirror each other differ, relative to what the diagonal allows, and the
/// `remedy` if it is the rounding of single precision.
pub(crate) fn difference(relative: f64, remedy: &str) -> String {
    if !relative.is_finite() {
        return "beside a zero on the diagonal both must be zero".into();
    }
    let said = format!("they differ by {relative:.0e} of the diagonal, {SYMMETRY:.0e} is allowed");
    if relative <= SINGLE_PRECISION { format!("{said}: {remedy}") } else { said }
}

/// Entries that a column-major matrix of `size` rows and columns has to the end of its last column.
///
/// # Errors
/// A sentence, if the leading dimension `ld` is less than `max(1, size)` or absurd.
pub(crate) fn entries(name: &str, size: usize, ld: usize) -> Result<usize, String> {
    let least = size.max(1);
    if ld < least {
        return Err(format!(
            "the leading dimension of {name} is {ld}, it must be at least {least}"
        ));
    }
    let begin_of_last = size.saturating_sub(1).checked_mul(ld);
    begin_of_last
        .and_then(|begin| begin.checked_add(size))
        .ok_or_else(|| format!("the leading dimension of {name} is {ld}: the matrix cannot exist"))
}

impl<'a> SymmetricMatrix<'a> {
    /// Column `j`.
    pub(crate) fn column(&self, j: usize) -> &'a [f64] {
        &self.entries[j * self.ld..j * self.ld + self.size]
    }

    /// Whether entries agree with those across the diagonal, up to rounding relative to it, which
    /// is positive.
    pub(crate) fn is_symmetric(&self) -> bool {
        let root: Vec<f64> = (0..self.size).map(|i| self.column(i)[i].sqrt()).collect();
        self.pairs_across(|i, j, lower, upper| {
            let scale = SYMMETRY * root[i] * root[j];
            if (lower - upper).abs() <= scale { Ok(()) } else { Err(()) }
        })
        .is_ok()
    }

    /// Visits each entry below the diagonal with the one across it, until an error.
    fn pairs_across<E>(
        &self,
        visit: impl Fn(usize, usize, f64, f64) -> Result<(), E>,
    ) -> Result<(), E> {
        // Square tiles: the transposed entry is read from cache.
        const TILE: usize = 32;
        let n = self.size;
        for j0 in (0..n).step_by(TILE) {
            for i0 in (j0..n).step_by(TILE) {
                for j in j0..(j0 + TILE).min(n) {
                    for i in i0.max(j + 1)..(i0 + TILE).min(n) {
                        visit(i, j, self.column(j)[i], self.column(i)[j])?;
                    }
                }
            }
        }
        Ok(())
    }

    /// Refuses entries that are not finite, diagonals that are not positive, asymmetry beyond
    /// rounding, and entries that a positive semi-definite matrix cannot have.
    pub(crate) fn check(&self, name: &str, argument: Argument) -> Result<(), Error> {
        let refuse = |message: String| Err(Error::invalid(argument, message));
        let n = self.size;
        for j in 0..n {
            let column = self.column(j);
            if let Some(i) = column.iter().position(|k| !k.is_finite()) {
                return refuse(format!("{name}[{i},{j}] is not finite"));
            }
            if column[j] <= 0.0 {
                if column.iter().all(|&k| k == 0.0) {
                    return refuse(format!(
                        "row {j} of {name} is zero: nothing resists that component"
                    ));
                }
                return refuse(format!("{name}[{j},{j}] is {}, it must be positive", column[j]));
            }
        }
        let root: Vec<f64> = (0..n).map(|i| self.column(i)[i].sqrt()).collect();
        self.pairs_across(|i, j, lower, upper| {
            let scale = root[i] * root[j];
            if (lower - upper).abs() > SYMMETRY * scale {
                let (below, above) = (format!("{name}[{i},{j}]"), format!("{name}[{j},{i}]"));
                let remedy =
                    format!("average {below} and {above}, or compute both in double precision");
                let difference = difference((lower - upper).abs() / scale, &remedy);
                return refuse(format!(
                    "{name} is not symmetric: {below} is {lower}, {above} is {upper}: {difference}"
                ));
            }
            if lower.abs() > (1.0 + SYMMETRY) * scale {
                return refuse(format!(
                    "{name} is not positive semi-definite: {name}[{i},{j}] is {lower}, more than \
                     its diagonal allows ({scale})"
                ));
            }
            Ok(())
        })
    }
}
