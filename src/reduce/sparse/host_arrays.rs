//! A host's sparse symmetric matrix, as it is stored.

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
    pub(super) fn len(&self) -> usize {
        match self {
            Indices::Narrow(values) => values.len(),
            Indices::Wide(values) => values.len(),
        }
    }

    /// Entry `i` as the host has it.
    pub(crate) fn get(&self, i: usize) -> i64 {
        match self {
            Indices::Narrow(values) => i64::from(values[i]),
            Indices::Wide(values) => values[i],
        }
    }
}

/// A symmetric matrix in compressed columns, or in compressed rows, which is the same of the other
/// triangle.
#[derive(Clone, Copy, Debug)]
pub struct SparseMatrix<'a> {
    /// Number of rows and columns: of degrees of freedom.
    pub size: usize,
    /// Start of each column in `row` and `values`, counted from `index_base`; `size + 1` entries, the
    /// last is the number of stored entries.
    pub col_start: Indices<'a>,
    /// Row of each stored entry, counted from `index_base`, strictly ascending in each column.
    pub row: Indices<'a>,
    /// Stored entries.
    pub values: &'a [f64],
    /// Index base of `col_start` and `row`: 0 or 1.
    pub index_base: i64,
    /// Which entries are stored; a compressed-row matrix has the other triangle.
    pub triangle: Triangle,
}
