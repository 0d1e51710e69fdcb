//! The values of a panel: the changes by the panels before it, and its elimination, a block of rows at a time.
//!
//! Each entry gets the same sums in the same order, whoever computes its block.

use std::ops::Range;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::{MatMut, MatRef};

use super::entries::Entries;
use super::parallel::ROWS;
use super::schedule::{Change, Schedule};
use super::structure::Structure;
use crate::linalg::dense::{self, subtract_products};

/// The pivot that is smallest relative to the diagonal: its place, and this ratio.
pub type Weakest = Option<(usize, f64)>;

/// The weaker one, of equal ones the first.
pub fn weaker(first: Weakest, second: Weakest) -> Weakest {
    first.into_iter().chain(second).min_by(|one, other| one.1.total_cmp(&other.1))
}

/// The parts of a matrix and of its factor from which panels are made.
#[derive(Clone, Copy)]
pub struct Source<'a> {
    pub structure: &'a Structure,
    pub schedule: &'a Schedule,
    pub entries: &'a Entries,
}

/// Values of panels from one on, up to the one that is made.
#[derive(Clone, Copy)]
pub struct Before<'a> {
    pub values: &'a [f64],
    /// Where those of the first one begin.
    pub start: usize,
}

/// A panel in the making.
pub struct Panel<'a> {
    source: Source<'a>,
    number: usize,
    before: Before<'a>,
    /// Where each of its rows stands in it.
    place: &'a [usize],
}

impl<'a> Panel<'a> {
    /// A panel with the entries of the matrix in its values; `place` becomes the places of its rows.
    pub fn filled(
        source: Source<'a>,
        number: usize,
        before: Before<'a>,
        place: &'a mut [usize],
        values: &mut [f64],
    ) -> Self {
        let (columns, rows) = (source.structure.columns(number), source.structure.rows(number));
        let stride = columns.len() + rows.len();
        let all = columns.clone().chain(rows.iter().copied());
        all.enumerate().for_each(|(k, row)| place[row] = k);
        for (k, j) in columns.enumerate() {
            for (row, value) in source.entries.of(j) {
                values[place[row] + stride * k] += value;
            }
        }
        Panel { source, number, before, place }
    }

    /// The diagonal block, and the rows below it.
    pub fn divided<'v>(&self, values: &'v mut [f64]) -> (MatMut<'v, f64>, MatMut<'v, f64>) {
        let (width, rows) = (self.width(), self.rows().len());
        MatMut::from_column_major_slice_mut(values, width + rows, width).split_at_row_mut(width)
    }

    /// The blocks of its rows.
    pub fn blocks(&self) -> impl Iterator<Item = Range<usize>> + use<> {
        let count = self.rows().len();
        (0..count).step_by(ROWS).map(move |begin| begin..count.min(begin + ROWS))
    }

    fn width(&self) -> usize {
        self.source.structure.columns(self.number).len()
    }

    fn rows(&self) -> &[usize] {
        self.source.structure.rows(self.number)
    }

    /// An earlier panel: its rows by number, and their values.
    fn earlier(&self, by: usize) -> (&[usize], MatRef<'_, f64>) {
        let structure = self.source.structure;
        let place = structure.values(by);
        let values = &self.before.values[place.start - self.before.start..][..place.len()];
        (structure.rows(by), structure.blocks(by, values).1)
    }

    /// The panels before it that change it, those together that change the same entries.
    fn chains(&self) -> impl Iterator<Item = &[Change]> {
        let Source { structure, schedule, .. } = self.source;
        schedule.changes(self.number).chunk_by(|one, other| {
            let count = |change: &Change| structure.rows(change.by).len() - change.first;
            // Rows of a panel are columns or rows of the one with its first row as a column.
            let is_next = structure.columns(other.by).contains(&structure.rows(one.by)[0]);
            is_next && count(one) == count(other)
        })
    }

    /// Subtracts from the lower triangle of the diagonal block what the panels before give.
    pub fn change_top(&self, mut top: MatMut<'_, f64>, product: &mut [f64]) {
        for chain in self.chains() {
            let columns = self.columns_of(&chain[0]);
            let count = columns.len();
            let place = |k: usize| self.place[columns[k]];
            let each = chain.iter().map(|change| {
                let l = self.earlier(change.by).1.subrows(change.first, count);
                (l, l)
            });
            subtract_products(top.as_mut(), each, (count, place), (count, place), true, product);
        }
    }

    /// Those of its columns that a panel before it changes.
    fn columns_of(&self, change: &Change) -> &[usize] {
        &self.earlier(change.by).0[change.first..change.end]
    }

    /// Subtracts from a block of rows what the panels before give.
    pub fn change_block(
        &self,
        block: Range<usize>,
        mut target: MatMut<'_, f64>,
        product: &mut [f64],
    ) {
        let (lowest, highest) = (self.rows()[block.start], self.rows()[block.end - 1]);
        let above = self.width() + block.start;
        for chain in self.chains() {
            let columns = self.columns_of(&chain[0]);
            let (width, below) = (columns.len(), &self.earlier(chain[0].by).0[chain[0].end..]);
            let begin = below.partition_point(|&row| row < lowest);
            let rows = &below[begin..];
            let rows = &rows[..rows.partition_point(|&row| row <= highest)];
            let count = rows.len();
            if count == 0 {
                continue;
            }
            let each = chain.iter().map(|change| {
                let l = self.earlier(change.by).1;
                (l.subrows(change.end + begin, count), l.subrows(change.first, width))
            });
            let column = |k: usize| self.place[columns[k]];
            let row = |k: usize| self.place[rows[k]] - above;
            let (rows, columns) = ((count, row), (width, column));
            subtract_products(target.as_mut(), each, rows, columns, false, product);
        }
    }

    /// Factorises the diagonal block and divides the rows below by its factor. Returns the weakest pivot, or the place of one
    /// that is not positive.
    pub fn eliminate(&self, values: &mut [f64], memory: &mut MemBuffer) -> Result<Weakest, usize> {
        let (mut top, below) = self.divided(values);
        let columns = self.source.structure.columns(self.number);
        let root = dense::root(top.as_mut(), MemStack::new(memory));
        root.map_err(|column| columns.start + column)?;
        dense::divide(top.as_ref(), below);
        let pivot = |k: usize, j: usize| top[(k, k)].powi(2) / self.source.entries.diagonal(j);
        let pivots = columns.enumerate().map(|(k, j)| Some((j, pivot(k, j))));
        Ok(pivots.fold(None, weaker))
    }
}
