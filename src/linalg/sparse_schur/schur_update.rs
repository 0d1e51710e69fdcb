//! The Schur complement, from which the products of all panels are subtracted, block by block.

use std::ops::Range;
use std::sync::Mutex;

use faer::{MatMut, MatRef};

use super::factor_progress::Failure;
use super::parallel::{Parallel, ROWS, locked};
use super::structure::{PANEL, Structure};
use crate::linalg::dense::subtract_products;

/// A block of the lower triangle.
struct TriangleBlock<'a> {
    rows: Range<usize>,
    columns: Range<usize>,
    values: MatMut<'a, f64>,
}

/// The rows of a panel that are kept.
struct KeptRows<'a> {
    rows: &'a [usize],
    l: MatRef<'a, f64>,
}

impl<'a> KeptRows<'a> {
    /// Those of a panel, if it has any.
    fn of(structure: &'a Structure, values: &'a [f64], panel: usize) -> Option<Self> {
        let (rows, inner) = (structure.rows(panel), structure.inner_rows(panel));
        let (_, below) = structure.blocks(panel, &values[structure.values(panel)]);
        let kept = KeptRows { rows: &rows[inner..], l: below.split_at_row(inner).1 };
        (inner < rows.len()).then_some(kept)
    }

    /// Those of its rows that are in a range.
    fn within(&self, range: &Range<usize>) -> (&'a [usize], MatRef<'a, f64>) {
        let begin = self.rows.partition_point(|&row| row < range.start);
        let count = self.rows[begin..].partition_point(|&row| row < range.end);
        (&self.rows[begin..begin + count], self.l.subrows(begin, count))
    }

    fn reaches(&self, range: &Range<usize>) -> bool {
        self.rows[0] < range.end && range.start <= self.rows[self.rows.len() - 1]
    }
}

/// Subtracts the products of the kept rows of all panels, whose values are there, from `schur`, of which the lower
/// triangle matters.
pub fn subtract(
    structure: &Structure,
    values: &[f64],
    schur: &mut [f64],
    parallel: &mut Parallel<'_>,
) -> Result<(), Failure> {
    let panels: Vec<KeptRows<'_>> =
        (0..structure.panels()).filter_map(|s| KeptRows::of(structure, values, s)).collect();
    // A product is made in its lower triangle alone.
    let multiplications = |kept: &KeptRows<'_>| kept.l.ncols() * kept.rows.len().pow(2);
    let operations = panels.iter().map(|kept| multiplications(kept) as f64 / 2.0).sum();
    // Panels with the same rows change the same entries.
    let chains: Vec<&[KeptRows<'_>]> =
        panels.chunk_by(|one, other| one.rows == other.rows).collect();
    let blocks = blocks(structure, schur);
    parallel.share(blocks.len(), operations, &|workspace, part| {
        let block = &mut *locked(&blocks[part]);
        for chain in &chains {
            if chain[0].reaches(&block.rows) && chain[0].reaches(&block.columns) {
                block.change(chain, &mut workspace.product);
            }
        }
    })
}

/// The blocks of the lower triangle: those on the diagonal are square.
fn blocks<'a>(structure: &Structure, schur: &'a mut [f64]) -> Vec<Mutex<TriangleBlock<'a>>> {
    let (first, kept) = (structure.eliminated, structure.kept());
    let mut rest = MatMut::from_column_major_slice_mut(schur, kept, kept);
    let mut blocks = Vec::new();
    let mut push = |rows: Range<usize>, columns: &Range<usize>, values| {
        let numbers = |range: &Range<usize>| first + range.start..first + range.end;
        blocks.push(Mutex::new(TriangleBlock {
            rows: numbers(&rows),
            columns: numbers(columns),
            values,
        }));
    };
    for begin in (0..kept).step_by(PANEL) {
        let columns = begin..kept.min(begin + PANEL);
        let (strip, right) = rest.split_at_col_mut(columns.len());
        let (_, strip) = strip.split_at_row_mut(begin);
        let (square, mut below) = strip.split_at_row_mut(columns.len());
        push(columns.clone(), &columns, square);
        for top in (columns.end..kept).step_by(ROWS) {
            let rows = top..kept.min(top + ROWS);
            let (block, rest) = below.split_at_row_mut(rows.len());
            push(rows, &columns, block);
            below = rest;
        }
        rest = right;
    }
    blocks
}

impl TriangleBlock<'_> {
    /// Subtracts the products of the rows of panels that have the same ones.
    fn change(&mut self, chain: &[KeptRows<'_>], product: &mut [f64]) {
        let (columns, _) = chain[0].within(&self.columns);
        let (rows, _) = chain[0].within(&self.rows);
        if columns.is_empty() || rows.is_empty() {
            return;
        }
        let (first_row, first_column) = (self.rows.start, self.columns.start);
        let on_diagonal = first_row == first_column;
        let row = |k: usize| rows[k] - first_row;
        let column = |k: usize| columns[k] - first_column;
        let each =
            chain.iter().map(|kept| (kept.within(&self.rows).1, kept.within(&self.columns).1));
        let (rows, columns) = ((rows.len(), row), (columns.len(), column));
        subtract_products(self.values.as_mut(), each, rows, columns, on_diagonal, product);
    }
}
