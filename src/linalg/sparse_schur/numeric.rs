//! The values of the factor, panel by panel from the left, and of the Schur complement, from which each
//! panel's product is subtracted as soon as it exists.
//!
//! A panel `s` gets the updates of those before it that have rows in its columns. These are found by
//! lists: each panel stands in the list of the panel that holds its next row.

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::cholesky::llt::factor::cholesky_in_place_scratch;
use faer::{Accum, MatMut, MatRef, Par, Spec};

use super::dense::{eliminate, mirror, trapezoid};
use super::failure::Failure;
use super::graph::filled;
use super::structure::{Structure, placed};
use super::watch::{Watch, Work};
use crate::linalg::sparse_matrix::Csc;

/// Columns of the Schur complement that one product changes.
const SCHUR_COLUMNS: usize = 256;

/// What a factorisation computes.
pub struct Numeric {
    /// Values of the panels.
    pub values: Vec<f64>,
    /// The Schur complement, column-major, both triangles.
    pub schur: Vec<f64>,
    /// The pivot that is smallest relative to the diagonal: its place, and this ratio.
    pub weakest: Option<(usize, f64)>,
}

/// How a factorisation ends without a factor.
pub enum Unfinished {
    /// The pivot in this place is not positive.
    Pivot(usize),
    /// For another reason.
    Failed(Failure),
}

impl<E: Into<Failure>> From<E> for Unfinished {
    fn from(error: E) -> Self {
        Unfinished::Failed(error.into())
    }
}

/// Bytes that a factorisation holds beside its arguments.
pub fn bytes(structure: &Structure, lower: &Csc, update: usize) -> usize {
    let (kept, size) = (structure.kept(), structure.size);
    let numbers = structure.stored() + kept * kept + update.max(buffer(structure));
    // Places of the columns, of the rows in a panel, the panel of each column; links of the panels.
    let indices = 3 * size + 3 * structure.panels();
    let entries = lower.compute_nnz() * size_of::<Entry>() + 2 * size * size_of::<usize>();
    numbers * size_of::<f64>() + indices * size_of::<usize>() + entries
}

/// Entries of the products that go into the Schur complement.
fn buffer(structure: &Structure) -> usize {
    structure.kept() * SCHUR_COLUMNS.min(structure.kept())
}

/// An entry of the matrix in a column: its row, and its value.
type Entry = (usize, f64);

/// Computes everything.
pub fn factorised(
    structure: &Structure,
    panel_of: &[usize],
    lower: &Csc,
    watch: &mut dyn Watch,
) -> Result<Numeric, Unfinished> {
    let cost = structure.cost(panel_of);
    let mut work = Work::new(watch, cost.operations);
    let kept = structure.kept();
    let mut numeric = Numeric {
        values: filled(structure.stored(), 0.0)?,
        schur: filled(kept * kept, 0.0)?,
        weakest: None,
    };
    let entries = Entries::new(structure, lower, &mut numeric.schur)?;
    let mut room = Room {
        place: filled(structure.size, 0)?,
        update: filled(cost.update.max(buffer(structure)), 0.0)?,
    };
    let mut links = Links::new(structure, panel_of)?;
    let scratch = widest(structure);
    let mut memory = MemBuffer::try_new(scratch).map_err(|_| Failure::OutOfMemory)?;
    for s in 0..structure.panels() {
        let (before, rest) = numeric.values.split_at_mut(structure.values(s).start);
        let panel = &mut rest[..structure.values(s).len()];
        let columns = structure.columns(s);
        fill(structure, s, &entries, &mut room.place, panel);
        let mut next = links.take(s);
        while let Some(d) = next {
            next = links.after(d);
            let values = &before[structure.values(d)];
            let rows = links.rows_in(d, columns.end);
            let operations = update(structure, (d, values), rows.clone(), (s, panel), &mut room);
            links.put(d, rows.end);
            work.did(operations)?;
        }
        eliminate(panel, columns.len(), MemStack::new(&mut memory))
            .map_err(|place| Unfinished::Pivot(columns.start + place))?;
        for (k, j) in columns.clone().enumerate() {
            let stride = structure.rows(s).len() + columns.len();
            let pivot = panel[k + stride * k].powi(2) / entries.diagonal(j);
            if numeric.weakest.is_none_or(|(_, least)| pivot < least) {
                numeric.weakest = Some((j, pivot));
            }
        }
        subtract(structure, (s, panel), &mut numeric.schur, &mut room.update, &mut work)?;
        links.put(s, 0);
    }
    mirror(&mut numeric.schur, kept);
    Ok(numeric)
}

fn widest(structure: &Structure) -> StackReq {
    let width = (0..structure.panels()).map(|s| structure.columns(s).len()).max().unwrap_or(0);
    cholesky_in_place_scratch::<f64>(width, Par::Seq, Spec::default())
}

/// Working memory.
struct Room {
    /// Where each row stands in the panel of which it is one.
    place: Vec<usize>,
    /// A product that is then subtracted.
    update: Vec<f64>,
}

/// The matrix by columns in the order of elimination.
struct Entries {
    start: Vec<usize>,
    entry: Vec<Entry>,
}

impl Entries {
    /// Puts the entries of kept unknowns into the lower triangle of `schur`.
    fn new(structure: &Structure, lower: &Csc, schur: &mut [f64]) -> Result<Self, Failure> {
        let (eliminated, kept) = (structure.eliminated, structure.kept());
        let mut inverse = filled(structure.size, 0)?;
        structure.order.iter().enumerate().for_each(|(place, &i)| inverse[i] = place);
        let mut start = filled(eliminated + 1, 0)?;
        for (i, j, value) in placed(lower, &inverse) {
            if j < eliminated {
                start[j + 1] += 1;
            } else {
                schur[i - eliminated + kept * (j - eliminated)] += value;
            }
        }
        (0..eliminated).for_each(|j| start[j + 1] += start[j]);
        let mut entry = filled(start[eliminated], (0, 0.0))?;
        let mut next = start.clone();
        for (i, j, value) in placed(lower, &inverse).filter(|&(_, j, _)| j < eliminated) {
            entry[next[j]] = (i, value);
            next[j] += 1;
        }
        Ok(Entries { start, entry })
    }

    fn of(&self, column: usize) -> &[Entry] {
        &self.entry[self.start[column]..self.start[column + 1]]
    }

    fn diagonal(&self, column: usize) -> f64 {
        self.of(column).iter().find(|(row, _)| *row == column).map_or(0.0, |(_, value)| *value)
    }
}

/// Which panels update each panel next.
struct Links<'s> {
    structure: &'s Structure,
    panel_of: &'s [usize],
    /// The first of the list of each panel.
    first: Vec<Option<usize>>,
    /// The next one in the list in which a panel stands.
    next: Vec<Option<usize>>,
    /// The first of its rows with which a panel updates next.
    row: Vec<usize>,
}

impl<'s> Links<'s> {
    fn new(structure: &'s Structure, panel_of: &'s [usize]) -> Result<Self, Failure> {
        let panels = structure.panels();
        let (first, next) = (filled(panels, None)?, filled(panels, None)?);
        Ok(Links { structure, panel_of, first, next, row: filled(panels, 0)? })
    }

    fn take(&mut self, panel: usize) -> Option<usize> {
        self.first[panel].take()
    }

    fn after(&self, panel: usize) -> Option<usize> {
        self.next[panel]
    }

    /// The rows of a panel, from its next one, that are before column `end`.
    fn rows_in(&self, panel: usize, end: usize) -> std::ops::Range<usize> {
        let (rows, begin) = (self.structure.rows(panel), self.row[panel]);
        begin..begin + rows[begin..].partition_point(|&row| row < end)
    }

    /// Puts a panel into the list where its row number `row` belongs, if that is eliminated.
    fn put(&mut self, panel: usize, row: usize) {
        self.row[panel] = row;
        let next = self.structure.rows(panel).get(row).and_then(|&row| self.panel_of.get(row));
        if let Some(&target) = next {
            self.next[panel] = self.first[target].replace(panel);
        }
    }
}

/// Writes the entries of the matrix into a panel, and the places of its rows.
fn fill(
    structure: &Structure,
    s: usize,
    entries: &Entries,
    place: &mut [usize],
    panel: &mut [f64],
) {
    let (columns, rows) = (structure.columns(s), structure.rows(s));
    let stride = columns.len() + rows.len();
    columns.clone().chain(rows.iter().copied()).enumerate().for_each(|(k, row)| place[row] = k);
    for (k, j) in columns.enumerate() {
        for &(row, value) in entries.of(j) {
            panel[place[row] + stride * k] += value;
        }
    }
}

/// Subtracts from the panel `s` what the panel `d` before it gives with those of its rows that are columns
/// of `s`. Returns the number of operations.
fn update(
    structure: &Structure,
    (d, before): (usize, &[f64]),
    inside: std::ops::Range<usize>,
    (s, panel): (usize, &mut [f64]),
    room: &mut Room,
) -> f64 {
    let (rows, width) = (structure.rows(d), structure.columns(d).len());
    let before = MatRef::from_column_major_slice(before, width + rows.len(), width);
    let below = before.get(width + inside.start.., ..);
    let (count, many) = (below.nrows(), inside.len());
    let operations = (count * many * width) as f64;
    let stride = structure.columns(s).len() + structure.rows(s).len();
    let rows = &rows[inside.start..];
    let place = |k: usize| room.place[rows[k]];
    let (first, last) = (place(0), place(count - 1));
    if last + 1 - first == count {
        let panel = MatMut::from_column_major_slice_mut(panel, stride, structure.columns(s).len());
        let target = panel.get_mut(first..last + 1, first..first + many);
        trapezoid(target, Accum::Add, below, many, -1.0);
        return operations;
    }
    let product = &mut room.update[..count * many];
    trapezoid(
        MatMut::from_column_major_slice_mut(product, count, many),
        Accum::Replace,
        below,
        many,
        1.0,
    );
    for (j, product) in product.chunks_exact(count).enumerate() {
        let column = &mut panel[stride * room.place[rows[j]]..][..stride];
        for (row, product) in rows[j..].iter().zip(&product[j..]) {
            column[room.place[*row]] -= product;
        }
    }
    operations
}

/// Subtracts the product of the rows of a panel that are kept from the lower triangle of the Schur
/// complement.
fn subtract(
    structure: &Structure,
    (s, panel): (usize, &[f64]),
    schur: &mut [f64],
    buffer: &mut [f64],
    work: &mut Work<'_>,
) -> Result<(), Failure> {
    let (width, kept) = (structure.columns(s).len(), structure.kept());
    let (rows, inner) = (structure.rows(s), structure.inner_rows(s));
    let whole = MatRef::from_column_major_slice(panel, width + rows.len(), width);
    let (l, rows) = (whole.get(width + inner.., ..), &rows[inner..]);
    let place = |row: usize| row - structure.eliminated;
    work.did((width * width * (width + inner)) as f64)?;
    let mut first = 0;
    while first < rows.len() {
        let l = l.get(first.., ..);
        let (count, rows) = (l.nrows(), &rows[first..]);
        let many = count.min(SCHUR_COLUMNS);
        let (top, last) = (place(rows[0]), place(rows[count - 1]));
        if last + 1 - top == count {
            let schur = MatMut::from_column_major_slice_mut(schur, kept, kept);
            trapezoid(schur.get_mut(top..last + 1, top..top + many), Accum::Add, l, many, -1.0);
        } else {
            let product = &mut buffer[..count * many];
            let target = MatMut::from_column_major_slice_mut(product, count, many);
            trapezoid(target, Accum::Replace, l, many, 1.0);
            for (j, product) in product.chunks_exact(count).enumerate() {
                let column = &mut schur[kept * place(rows[j])..][..kept];
                for (row, product) in rows[j..].iter().zip(&product[j..]) {
                    column[place(*row)] -= product;
                }
            }
        }
        work.did((count * many * width) as f64)?;
        first += many;
    }
    Ok(())
}
