//! How far a square matrix is from a symmetric one, by square blocks: the rows of a block and the columns of the one across
//! the diagonal are vectors of the processor.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

use super::matrix::Matrix;
use super::simd::vectorised;
use super::watched::BLOCK;
use crate::workers::{each, reading};

/// Rows and columns of a square block that is compared with the one across the diagonal at once: a vector of doubles.
const SIDE: usize = 4;

/// Tiles of a matrix of more rows are copied before they are compared: copies wait for memory once for a piece of a column,
/// and comparisons once for a vector.
const IN_CACHE: usize = 1024;

impl Matrix<'_> {
    /// `true` if each entry below the diagonal is of size `most` at most and differs by `apart` at most from the one
    /// across it, both times `root[i] root[j]`; `most` may be infinite.
    pub fn agrees_across(&self, root: &[f64], apart: f64, most: f64) -> bool {
        let whole = self.size() - self.size() % SIDE;
        let differ = AtomicBool::new(false);
        let compare = |first: usize| {
            let columns = first..whole.min(first + BLOCK);
            let agree = vectorised(
                #[inline(always)]
                || self.blocks_agree(columns, whole, (root, apart, most)),
            );
            differ.fetch_or(!agree, Ordering::Relaxed);
        };
        each((0..whole).step_by(BLOCK), reading(whole * whole), compare);
        !differ.into_inner() && self.others_agree(root, apart, most)
    }

    /// [`Self::agrees_across`] of the blocks of [`SIDE`] rows and columns that lie below the diagonal, in these columns and
    /// the rows before `end`.
    #[inline(always)]
    fn blocks_agree(
        &self,
        columns: Range<usize>,
        end: usize,
        (root, apart, most): (&[f64], f64, f64),
    ) -> bool {
        let is_copied = self.size() > IN_CACHE;
        let mut copies = vec![0.0; if is_copied { 2 * BLOCK * BLOCK } else { 0 }];
        for first in (columns.start..end).step_by(BLOCK) {
            let tile = first..end.min(first + BLOCK);
            let (mut lower, mut upper, mut row, mut column) = (*self, *self, 0, 0);
            if is_copied {
                let (below, above) = copies.split_at_mut(BLOCK * BLOCK);
                self.copy(&tile, &columns, below);
                self.copy(&columns, &tile, above);
                (lower, upper) =
                    (Matrix::new(BLOCK, below, BLOCK), Matrix::new(BLOCK, above, BLOCK));
                (row, column) = (first, columns.start);
            }
            for j in columns.clone().step_by(SIDE) {
                let rows = first.max(j + SIDE)..tile.end;
                if rows.is_empty() {
                    continue;
                }
                let across = vector(root, j);
                let lower: [&[f64]; SIDE] = std::array::from_fn(|c| {
                    &lower.column(j + c - column)[rows.start - row..rows.end - row]
                });
                for (k, i) in rows.clone().enumerate().step_by(SIDE) {
                    let below = lower.map(|column| vector(column, k));
                    let above: [[f64; SIDE]; SIDE] =
                        std::array::from_fn(|r| vector(upper.column(i + r - row), j - column));
                    let down = vector(root, i);
                    // A mark for each row: a loop over them is one of vectors.
                    let mut marks = [0.0; SIDE];
                    for c in 0..SIDE {
                        for r in 0..SIDE {
                            let scale = down[r] * across[c];
                            let both = (below[c][r], above[r][c]);
                            let agree = agree(both, apart * scale, most * scale);
                            marks[r] = if agree { marks[r] } else { 1.0 };
                        }
                    }
                    if marks != [0.0; SIDE] {
                        return false;
                    }
                }
            }
        }
        true
    }

    /// Copies the entries of some rows and columns to a tile.
    #[inline(always)]
    fn copy(&self, rows: &Range<usize>, columns: &Range<usize>, tile: &mut [f64]) {
        for (tile, j) in tile.chunks_exact_mut(BLOCK).zip(columns.clone()) {
            tile[..rows.len()].copy_from_slice(&self.column(j)[rows.clone()]);
        }
    }

    /// [`Self::agrees_across`] of the other entries: beside the diagonal, and in the rows that fill no block.
    #[inline(always)]
    fn others_agree(&self, root: &[f64], apart: f64, most: f64) -> bool {
        let whole = self.size() - self.size() % SIDE;
        for i in 0..self.size() {
            for j in if i < whole { i - i % SIDE } else { 0 }..i {
                let scale = root[i] * root[j];
                if !agree((self.at(i, j), self.at(j, i)), apart * scale, most * scale) {
                    return false;
                }
            }
        }
        true
    }
}

/// The numbers from `from` on.
#[inline(always)]
fn vector(values: &[f64], from: usize) -> [f64; SIDE] {
    let values = &values[from..from + SIDE];
    std::array::from_fn(|k| values[k])
}

/// `true` if an entry is of size `most` at most, and differs by `apart` at most from the one across the diagonal.
#[inline(always)]
fn agree((below, above): (f64, f64), apart: f64, most: f64) -> bool {
    ((below - above).abs() <= apart) & !(below.abs() > most)
}
