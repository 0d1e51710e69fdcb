//! A host's sparse symmetric matrix, as it is stored, checked before it is believed.

use crate::error::{Argument, Error};

/// Which entries of the symmetric matrix are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Triangle {
    /// Row >= column.
    Lower,
    /// Row <= column.
    Upper,
    /// All.
    Full,
}

/// Integer arrays of a host, 32 or 64 bits wide.
#[derive(Clone, Copy, Debug)]
pub enum Indices<'a> {
    /// 32 bits.
    Narrow(&'a [i32]),
    /// 64 bits.
    Wide(&'a [i64]),
}

impl Indices<'_> {
    /// Number of entries.
    pub fn len(&self) -> usize {
        match self {
            Indices::Narrow(values) => values.len(),
            Indices::Wide(values) => values.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Entry `i` less `base`, `None` if negative.
    fn get(&self, i: usize, base: i64) -> Option<usize> {
        let value = match self {
            Indices::Narrow(values) => i64::from(values[i]),
            Indices::Wide(values) => values[i],
        };
        usize::try_from(value.checked_sub(base)?).ok()
    }
}

/// Compressed columns, or rows, which are the same of a symmetric matrix.
#[derive(Clone, Copy, Debug)]
pub struct SparseMatrix<'a> {
    /// Number of rows and columns.
    pub size: usize,
    /// Begin of each column in `rows` and `values`, and their number: `size + 1`.
    pub starts: Indices<'a>,
    /// Row of each entry, ascending in a column.
    pub rows: Indices<'a>,
    /// Entries.
    pub values: &'a [f64],
    /// 0 or 1: what the first entry of `starts` and the first row are called.
    pub base: i64,
    /// Which entries are stored; a compressed-row matrix has the other triangle.
    pub triangle: Triangle,
}

/// The lower triangle in compressed columns, rows ascending.
pub(super) struct LowerTriangle {
    pub(super) starts: Vec<usize>,
    pub(super) rows: Vec<usize>,
    pub(super) values: Vec<f64>,
}

impl LowerTriangle {
    /// Entries as (row, column, value), row >= column.
    pub(super) fn entries(&self) -> impl Iterator<Item = (usize, usize, f64)> {
        self.starts.windows(2).enumerate().flat_map(move |(j, range)| {
            (range[0]..range[1]).map(move |k| (self.rows[k], j, self.values[k]))
        })
    }

    /// `y = K x`.
    pub(super) fn product(&self, x: &[f64]) -> Vec<f64> {
        let mut y = vec![0.0; x.len()];
        for (i, j, value) in self.entries() {
            y[i] += value * x[j];
            if i != j {
                y[j] += value * x[i];
            }
        }
        y
    }
}

impl SparseMatrix<'_> {
    /// Checks the arrays and copies the lower triangle.
    ///
    /// # Errors
    /// The first begin that is out of order or range, the first row that is out of range, not
    /// ascending, doubled or in the wrong triangle, the first value that is not finite, the first
    /// pair of entries that are not symmetric, the first diagonal entry that is missing or not
    /// positive.
    pub(super) fn lower_triangle(&self) -> Result<LowerTriangle, Error> {
        let refuse = |message: String| Err(Error::invalid(Argument::Matrix, message));
        let n = self.size;
        if self.base != 0 && self.base != 1 {
            return refuse(format!("the index base is {}, it must be 0 or 1", self.base));
        }
        if self.starts.len() != n + 1 {
            let given = self.starts.len();
            return refuse(format!("there are {given} column begins, there must be {}", n + 1));
        }
        let entries = self.values.len();
        if self.rows.len() != entries {
            return refuse(format!("{} row indices for {entries} entries", self.rows.len()));
        }
        let mut starts = Vec::with_capacity(n + 1);
        for j in 0..=n {
            match self.starts.get(j, self.base) {
                Some(start)
                    if start <= entries && starts.last().is_none_or(|last| *last <= start) =>
                {
                    starts.push(start);
                }
                _ => return refuse(format!("the begin of column {j} is out of order or range")),
            }
        }
        if starts[0] != 0 || starts[n] != entries {
            return refuse(format!(
                "the columns begin at {} and end at {}, there are {entries} entries",
                starts[0], starts[n]
            ));
        }
        let mut columns = vec![Vec::new(); n];
        let mut mirrored = vec![Vec::new(); n];
        for j in 0..n {
            let mut last = None;
            for k in starts[j]..starts[j + 1] {
                let Some(i) = self.rows.get(k, self.base).filter(|&i| i < n) else {
                    return refuse(format!("entry {k}, in column {j}, has a row out of range"));
                };
                if last.is_some_and(|last| last >= i) {
                    return refuse(format!(
                        "column {j}: row {i} stands twice or out of order, rows must ascend"
                    ));
                }
                last = Some(i);
                if !self.values[k].is_finite() {
                    return refuse(format!("K[{i},{j}] is not finite"));
                }
                let in_place = match self.triangle {
                    Triangle::Lower => i >= j,
                    Triangle::Upper => i <= j,
                    Triangle::Full => true,
                };
                if !in_place {
                    return refuse(format!("K[{i},{j}] is not in the triangle that was named"));
                }
                if i >= j {
                    columns[j].push((i, self.values[k]));
                } else {
                    mirrored[i].push((j, self.values[k]));
                }
            }
        }
        match self.triangle {
            Triangle::Lower => {}
            // Columns were visited in order, so that these rows ascend too.
            Triangle::Upper => {
                for (column, mut rest) in columns.iter_mut().zip(mirrored) {
                    column.append(&mut rest);
                }
            }
            Triangle::Full => check_symmetry(&columns, &mirrored)?,
        }
        for (j, column) in columns.iter().enumerate() {
            match column.first() {
                Some(&(i, value)) if i == j && value > 0.0 => {}
                Some(&(i, value)) if i == j => {
                    return refuse(format!("K[{j},{j}] is {value}, it must be positive"));
                }
                _ => return refuse(format!("K[{j},{j}] is missing, it must be positive")),
            }
        }
        let mut lower = LowerTriangle { starts: vec![0], rows: Vec::new(), values: Vec::new() };
        for column in columns {
            for (i, value) in column {
                lower.rows.push(i);
                lower.values.push(value);
            }
            lower.starts.push(lower.rows.len());
        }
        Ok(lower)
    }
}

/// Compares the strict lower triangle with the mirrored upper one. Their patterns may differ: an
/// assembly that drops zeros keeps the rounding of one entry and not that of its mirror image.
fn check_symmetry(
    columns: &[Vec<(usize, f64)>],
    mirrored: &[Vec<(usize, f64)>],
) -> Result<(), Error> {
    let diagonal = |i: usize| columns[i].first().filter(|(row, _)| *row == i).map_or(0.0, |e| e.1);
    for (j, (column, mirror)) in columns.iter().zip(mirrored).enumerate() {
        let mut lower = column.iter().filter(|(i, _)| *i > j).peekable();
        let mut upper = mirror.iter().peekable();
        while let Some(i) = [lower.peek(), upper.peek()].iter().flatten().map(|(i, _)| *i).min() {
            let below = lower.next_if(|(row, _)| *row == i).map_or(0.0, |entry| entry.1);
            let above = upper.next_if(|(row, _)| *row == i).map_or(0.0, |entry| entry.1);
            let scale = diagonal(i).sqrt() * diagonal(j).sqrt();
            if (below - above).abs() > crate::problem::symmetric_matrix::SYMMETRY * scale {
                return Err(Error::invalid(
                    Argument::Matrix,
                    format!("K is not symmetric: K[{i},{j}] is {below}, K[{j},{i}] is {above}"),
                ));
            }
        }
    }
    Ok(())
}
