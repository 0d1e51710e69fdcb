//! A host's sparse symmetric matrix, checked, and its lower triangle taken.

use super::host_arrays::{SparseMatrix, Triangle};
use super::messages;
use crate::error::{Error, entry, index, number};
use crate::linalg::sparse_matrix::{
    Columns, Csc, OutOfMemory, both, column, diagonal, entries, transposed, value_at,
};
use crate::linalg::tolerances::AGREES;
use crate::problem::symmetric_matrix::not_symmetric;
use crate::reduce::probes::refuse;

impl SparseMatrix<'_> {
    /// Checks the arrays' lengths and `col_start`. What else is wrong, a model finds.
    ///
    /// # Errors
    /// An index base that is not 0 or 1 or is not that of `col_start`, a wrong length, and the first
    /// entry of `col_start` that is out of order or range, with its value.
    pub fn check_col_start(&self) -> Result<(), Error> {
        self.checked_col_start().map(|_| ())
    }

    /// Checks the arrays, but for the diagonal, and copies the lower triangle. `name` is the host's name of the matrix.
    ///
    /// # Errors
    /// The first start of a column that is out of order or range; the first row that is out of range,
    /// not ascending, listed twice or in the wrong triangle; the first value that is not finite; the
    /// first pair of entries that are not symmetric.
    pub(super) fn lower_triangle(&self, name: &str) -> Result<Csc, Error> {
        let memory = |_: OutOfMemory| Error::OutOfMemory("a copy of the sparse matrix");
        let col_start = self.checked_col_start()?;
        let columns = Columns::with_capacity(self.values.len()).map_err(memory)?;
        let stored = self.checked_columns(name, &col_start, columns)?;
        match self.triangle {
            Triangle::Lower => Ok(stored),
            Triangle::Upper => transposed(&stored).map_err(memory),
            Triangle::Full => {
                check_symmetry(name, &stored, &transposed(&stored).map_err(memory)?)?;
                lower_part(&stored).map_err(memory)
            }
        }
    }

    fn checked_col_start(&self) -> Result<Vec<usize>, Error> {
        if self.index_base != 0 && self.index_base != 1 {
            return refuse(format!("index_base is {}, it must be 0 or 1", self.index_base));
        }
        let (columns, nnz) = (self.col_start.len(), self.values.len());
        if columns.checked_sub(1) != Some(self.size) {
            return refuse(format!(
                "col_start has {columns} entries, it must have size + 1, and size is {}",
                self.size
            ));
        }
        if self.row.len() != nnz {
            let rows = self.row.len();
            return refuse(format!("row has {rows} entries, but there are {nnz} values"));
        }
        let mut col_start: Vec<usize> = Vec::with_capacity(columns);
        for j in 0..columns {
            let start = self.col_start.get(j).checked_sub(self.index_base);
            let fits = |start: &usize| {
                let last = col_start.last().copied();
                *start <= nnz && last.map_or(*start == 0, |last| last <= *start)
            };
            match start.and_then(|start| usize::try_from(start).ok()).filter(fits) {
                Some(start) if j < self.size || start == nnz => col_start.push(start),
                _ => return refuse(messages::col_start(self, j)),
            }
        }
        Ok(col_start)
    }

    /// Copies the stored entries to `columns`.
    fn checked_columns(
        &self,
        name: &str,
        col_start: &[usize],
        mut columns: Columns,
    ) -> Result<Csc, Error> {
        for (j, ends) in col_start.windows(2).enumerate() {
            for k in ends[0]..ends[1] {
                let i = self.row.get(k).checked_sub(self.index_base);
                let i = i.and_then(|i| usize::try_from(i).ok()).filter(|i| *i < self.size);
                let Some(i) = i else { return refuse(messages::row_out_of_range(self, k, j)) };
                if k > ends[0] && columns.row[k - 1] >= i {
                    return refuse(messages::row_out_of_order(k, j, (columns.row[k - 1], i)));
                }
                if !self.values[k].is_finite() {
                    return refuse(entry(name, [i, j]) + " is not finite");
                }
                // Sums of a hundred such entries are doubles.
                let largest = f64::MAX / 100.0;
                if self.values[k].abs() > largest {
                    return refuse(format!(
                        "{} is {}: sums of such entries overflow; choose units in which they are smaller",
                        entry(name, [i, j]),
                        number(self.values[k])
                    ));
                }
                let in_place = match self.triangle {
                    Triangle::Lower => i >= j,
                    Triangle::Upper => i <= j,
                    Triangle::Full => true,
                };
                if !in_place {
                    let place = entry(name, [i, j]);
                    return refuse(place + " is not in the triangle that was named");
                }
                columns.row.push(i);
                columns.values.push(self.values[k]);
            }
            columns.end_column();
        }
        Ok(columns.matrix(self.size))
    }
}

/// Compares a matrix with its transpose. Their patterns may differ: an assembly that drops zeros keeps
/// the rounding of one entry and not that of its mirror image.
fn check_symmetry(name: &str, full: &Csc, transposed: &Csc) -> Result<(), Error> {
    let root: Vec<f64> = (0..full.ncols()).map(|i| value_at(full, i, i).sqrt()).collect();
    for j in 0..full.ncols() {
        for (i, below, above) in both(full, transposed, j, j + 1) {
            let scale = root[i] * root[j];
            if (below - above).abs() > AGREES * scale {
                let remedy =
                    "hand over one triangle (SIGNORINI_TRIANGLE_LOWER), or average the two";
                let stored = match [below, above].contains(&0.0) {
                    true => "; if one triangle is stored, triangle must name it",
                    false => "",
                };
                let differ = not_symmetric(name, (i, j), (below, above), scale, remedy);
                return refuse(differ + stored);
            }
        }
    }
    Ok(())
}

fn lower_part(full: &Csc) -> Result<Csc, OutOfMemory> {
    let size = full.ncols();
    let mut lower = Columns::with_capacity(full.compute_nnz().div_ceil(2) + size)?;
    for j in 0..size {
        let (rows, values) = column(full, j);
        let above = rows.partition_point(|&i| i < j);
        lower.row.extend_from_slice(&rows[above..]);
        lower.values.extend_from_slice(&values[above..]);
        lower.end_column();
    }
    Ok(lower.matrix(size))
}

/// Refuses diagonal entries that are not positive. That of a degree of freedom which `may_lack` stiffness may be zero or not
/// stored, if its row is zero.
pub(super) fn check_diagonal(
    name: &str,
    lower: &Csc,
    may_lack: impl Fn(usize) -> bool,
) -> Result<(), Error> {
    let size = lower.ncols();
    let mut without = vec![false; size];
    for (j, without) in without.iter_mut().enumerate() {
        match diagonal(lower, j) {
            Some(value) if value > 0.0 => {}
            Some(value) if value < 0.0 => {
                let place = entry(name, [j, j]);
                return refuse(format!("{place} is {}, it must be positive", number(value)));
            }
            _ => *without = true,
        }
    }
    let Some(first) = without.iter().position(|without| *without) else { return Ok(()) };
    let is = |j: usize| if diagonal(lower, j).is_some() { "0" } else { "missing" };
    // Beside a zero on its diagonal a positive semi-definite matrix has zeros.
    for (i, j, value) in entries(lower).filter(|(_, _, value)| *value != 0.0) {
        if let Some(dof) = [i, j].into_iter().find(|&dof| without[dof]) {
            return refuse(format!(
                "{} is {}, it must be positive: {} is {}",
                entry(name, [dof, dof]),
                is(dof),
                entry(name, [i, j]),
                number(value)
            ));
        }
    }
    match (first..size).find(|&dof| without[dof] && !may_lack(dof)) {
        Some(dof) => refuse(format!(
            "nothing resists degree of freedom {}: list it in fixed, or give it stiffness ({} is {})",
            index(dof),
            entry("K", [dof, dof]),
            is(dof)
        )),
        None => Ok(()),
    }
}
