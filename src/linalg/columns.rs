//! A dense matrix that begins as zeros in memory that the system hands out where it is written first: threads that fill
//! it share that, too.

use std::ops::{Index, IndexMut};

use faer::{MatMut, MatRef};

/// Numbers of a line of the cache: each column begins at one.
pub const LINE: usize = 8;

/// A matrix whose columns are contiguous.
#[derive(Debug)]
pub struct Columns {
    memory: Vec<f64>,
    /// Where the first column begins, and entries from one to the next.
    first: usize,
    ld: usize,
    rows: usize,
    columns: usize,
}

impl Columns {
    /// Zeros.
    pub fn zeros(rows: usize, columns: usize) -> Self {
        let ld = rows.next_multiple_of(LINE);
        let memory = vec![0.0; ld * columns + LINE];
        let first = memory.as_ptr().align_offset(LINE * size_of::<f64>()).min(LINE);
        Columns { memory, first, ld, rows, columns }
    }

    /// Number of rows.
    pub fn nrows(&self) -> usize {
        self.rows
    }

    fn place(&self, (i, j): (usize, usize)) -> usize {
        self.first + self.ld * j + i
    }

    /// A view.
    pub fn as_ref(&self) -> MatRef<'_, f64> {
        let (entries, ld) = (&self.memory[self.first..], self.ld);
        MatRef::from_column_major_slice_with_stride(entries, self.rows, self.columns, ld)
    }

    /// A view that may write.
    pub fn as_mut(&mut self) -> MatMut<'_, f64> {
        let (entries, ld) = (&mut self.memory[self.first..], self.ld);
        MatMut::from_column_major_slice_with_stride_mut(entries, self.rows, self.columns, ld)
    }

    /// All columns, and entries from one to the next.
    pub fn values_mut(&mut self) -> (&mut [f64], usize) {
        let end = self.place((0, self.columns));
        (&mut self.memory[self.first..end], self.ld)
    }

    /// Column `j`.
    pub fn column(&self, j: usize) -> &[f64] {
        &self.memory[self.place((0, j))..][..self.rows]
    }

    /// Column `j`.
    pub fn column_mut(&mut self, j: usize) -> &mut [f64] {
        let begin = self.place((0, j));
        &mut self.memory[begin..][..self.rows]
    }
}

impl Index<(usize, usize)> for Columns {
    type Output = f64;

    fn index(&self, at: (usize, usize)) -> &f64 {
        &self.memory[self.place(at)]
    }
}

impl IndexMut<(usize, usize)> for Columns {
    fn index_mut(&mut self, at: (usize, usize)) -> &mut f64 {
        let place = self.place(at);
        &mut self.memory[place]
    }
}
