//! A symmetric matrix in half of the memory.

/// A symmetric matrix of which the lower triangle is stored, column by column.
pub struct PackedSymmetric {
    size: usize,
    entries: Vec<f64>,
}

impl PackedSymmetric {
    /// Keeps the lower triangle of a column-major matrix of `size` rows.
    pub fn new(size: usize, mut matrix: Vec<f64>) -> Self {
        let mut end = 0;
        for j in 0..size {
            matrix.copy_within(size * j + j..size * (j + 1), end);
            end += size - j;
        }
        matrix.truncate(end);
        matrix.shrink_to_fit();
        PackedSymmetric { size, entries: matrix }
    }

    /// Column `j`, with what symmetry tells of it.
    pub fn column(&self, j: usize) -> Vec<f64> {
        let mut column = Vec::with_capacity(self.size);
        // Entry (j, i) of column i < j, which begins at its diagonal.
        let mut begin = 0;
        for i in 0..j {
            column.push(self.entries[begin + j - i]);
            begin += self.size - i;
        }
        column.extend_from_slice(&self.entries[begin..begin + self.size - j]);
        column
    }
}
