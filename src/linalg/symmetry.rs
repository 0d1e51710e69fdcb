//! How far a square matrix is from a symmetric one, by square tiles, and in these by blocks: the rows of a block and the columns
//! of the one across the diagonal are vectors of the processor.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

use super::matrix::{Matrix, TILE};
use super::simd::vectorised;
use crate::workers::{each, reading};

/// Rows and columns of a square block that is compared with the one across the diagonal at once: a vector of doubles.
const SIDE: usize = 4;

/// Tiles of a larger matrix are copied before they are compared: copies wait for memory once for a piece of a column, and
/// comparisons once for a vector.
const IN_CACHE: usize = 512;

/// Columns of a tile: their entries, and the number of entries from one to the next.
type Tile<'t> = (&'t [f64], usize);

impl Matrix<'_> {
    /// `true` if each entry below the diagonal is of size `most` at most and differs by `apart` at most from the one
    /// across it, both times `root[i] root[j]`; `most` may be infinite.
    pub fn agrees_across(&self, root: &[f64], apart: f64, most: f64) -> bool {
        let whole = self.size() - self.size() % SIDE;
        let differ = AtomicBool::new(false);
        let compare = |first: usize| {
            let columns = first..whole.min(first + TILE);
            let agree = vectorised(
                #[inline(always)]
                || self.columns_agree(columns, whole, (root, apart, most)),
            );
            differ.fetch_or(!agree, Ordering::Relaxed);
        };
        each((0..whole).step_by(TILE), reading(whole * whole), compare);
        !differ.into_inner() && self.others_agree(root, apart, most)
    }

    /// [`Self::agrees_across`] of the blocks of [`SIDE`] rows and columns that lie below the diagonal, in these columns and
    /// the rows before `end`.
    #[inline(always)]
    fn columns_agree(&self, columns: Range<usize>, end: usize, limits: (&[f64], f64, f64)) -> bool {
        let is_copied = self.size() > IN_CACHE;
        let mut copies = vec![0.0; if is_copied { 2 * TILE * TILE } else { 0 }];
        let half = copies.len() / 2;
        let (lower, upper) = copies.split_at_mut(half);
        for first in (columns.start..end).step_by(TILE) {
            let rows = first..end.min(first + TILE);
            let places = (rows.clone(), columns.clone());
            let agree = if is_copied {
                self.copy(&rows, &columns, lower);
                self.copy(&columns, &rows, upper);
                blocks_agree((lower, TILE), (upper, TILE), places, limits)
            } else {
                let tiles = (self.tile(first, columns.start), self.tile(columns.start, first));
                blocks_agree(tiles.0, tiles.1, places, limits)
            };
            if !agree {
                return false;
            }
        }
        true
    }

    /// The tile that begins with this row and column.
    #[inline(always)]
    fn tile(&self, row: usize, column: usize) -> Tile<'_> {
        (&self.entries[column * self.ld + row..], self.ld)
    }

    /// Copies the entries of some rows and columns to a tile.
    #[inline(always)]
    fn copy(&self, rows: &Range<usize>, columns: &Range<usize>, tile: &mut [f64]) {
        for (tile, j) in tile.chunks_exact_mut(TILE).zip(columns.clone()) {
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

/// [`Matrix::agrees_across`] of the blocks of a tile that lie below the diagonal with those of the tile across it.
#[inline(always)]
fn blocks_agree(
    lower: Tile<'_>,
    upper: Tile<'_>,
    (rows, columns): (Range<usize>, Range<usize>),
    (root, apart, most): (&[f64], f64, f64),
) -> bool {
    for j in columns.clone().step_by(SIDE) {
        let first = rows.start.max(j + SIDE);
        if first >= rows.end {
            continue;
        }
        let across = vector(root, j);
        let column = |c: usize| &lower.0[(j - columns.start + c) * lower.1..];
        let lower: [&[f64]; SIDE] =
            std::array::from_fn(|c| &column(c)[first - rows.start..rows.len()]);
        let upper_rows = upper.0[(first - rows.start) * upper.1..].chunks(SIDE * upper.1);
        let down = root[first..rows.end].chunks_exact(SIDE);
        for (k, (down, upper_rows)) in down.zip(upper_rows).enumerate() {
            let below = lower.map(|column| vector(column, SIDE * k));
            let above: [[f64; SIDE]; SIDE] =
                std::array::from_fn(|r| vector(&upper_rows[r * upper.1..], j - columns.start));
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
    true
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
