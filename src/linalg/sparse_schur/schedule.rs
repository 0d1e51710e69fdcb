//! The panels that change each panel, and the order in which panels are made.
//!
//! The panels of a small subtree of the elimination tree stand in a row and need no others: each subtree is the work
//! of one thread. The panels above come one after the other, and threads share the rows of each. What is a subtree
//! depends on the matrix alone.

use std::ops::Range;

use super::lists::{filled, reserved};
use super::structure::Structure;
use crate::linalg::sparse_matrix::OutOfMemory;

/// A subtree takes at most this share of all operations, so that even many threads have all about as much.
const SHARE: f64 = 1.0 / 64.0;

/// And at most so many: some hundredths of a second, in which nothing asks whether to go on.
const LARGEST_SUBTREE: f64 = 1e9;

/// The panels that change each panel, and the order.
pub struct Schedule {
    start: Vec<usize>,
    changes: Vec<Change>,
    /// Multiplications of each panel.
    pub of_panel: Vec<f64>,
    /// Multiplications of all, the Schur complement with them.
    pub operations: f64,
    /// Panels that need no others.
    pub subtrees: Vec<Range<usize>>,
    /// The panels above them, in order.
    pub above: Vec<usize>,
}

/// The change of a panel by an earlier one.
#[derive(Clone, Copy)]
pub struct Change {
    /// The earlier panel.
    pub by: usize,
    /// Those of its rows that are columns of the later one, by number.
    pub first: usize,
    pub end: usize,
}

impl Schedule {
    /// Finds the changes and the order of the panels of a factor.
    pub fn new(structure: &Structure) -> Result<Self, OutOfMemory> {
        let panels = structure.panels();
        let panel_of = structure.panel_of_columns()?;
        let (mut start, mut of_panel) = (filled(panels + 1, 0)?, filled(panels, 0.0)?);
        let mut outer = 0.0;
        for by in 0..panels {
            let width = structure.columns(by).len() as f64;
            let (rows, inner) = (structure.rows(by).len(), structure.inner_rows(by));
            of_panel[by] += width * width * (width / 3.0 + rows as f64);
            outer += 0.5 * width * ((rows - inner) as f64).powi(2);
            for_changes(structure, &panel_of, by, |panel, first, end| {
                start[panel + 1] += 1;
                of_panel[panel] += width * ((end - first) * (rows - first)) as f64;
            });
        }
        (0..panels).for_each(|s| start[s + 1] += start[s]);
        let mut next = reserved(panels)?;
        next.extend_from_slice(&start[..panels]);
        let mut changes = filled(start[panels], Change { by: 0, first: 0, end: 0 })?;
        for by in 0..panels {
            for_changes(structure, &panel_of, by, |panel, first, end| {
                changes[next[panel]] = Change { by, first, end };
                next[panel] += 1;
            });
        }
        let operations = of_panel.iter().sum::<f64>() + outer;
        let mut schedule =
            Schedule { start, changes, of_panel, operations, subtrees: Vec::new(), above: next };
        schedule.part(structure, &panel_of)?;
        Ok(schedule)
    }

    /// Finds the subtrees.
    fn part(&mut self, structure: &Structure, panel_of: &[usize]) -> Result<(), OutOfMemory> {
        let (panels, most) = (self.of_panel.len(), (SHARE * self.operations).min(LARGEST_SUBTREE));
        // The operations of each subtree, the first of its panels, and how many it has.
        let mut work: Vec<f64> = reserved(panels)?;
        work.extend_from_slice(&self.of_panel);
        let (mut first, mut count) = (filled(panels, 0)?, filled(panels, 1)?);
        (0..panels).for_each(|s| first[s] = s);
        let parent = |s: usize| structure.rows(s).first().and_then(|&row| panel_of.get(row));
        for s in 0..panels {
            if let Some(&up) = parent(s) {
                work[up] += work[s];
                count[up] += count[s];
                first[up] = first[up].min(first[s]);
            }
        }
        // The panels of a subtree stand in a row where the order is a post-order.
        let is_small = |s: usize| work[s] <= most && s + 1 - first[s] == count[s];
        self.above.clear();
        let mut end = panels;
        while end > 0 {
            let root = end - 1;
            if is_small(root) {
                self.subtrees.try_reserve(1).map_err(|_| OutOfMemory)?;
                self.subtrees.push(first[root]..end);
                end = first[root];
            } else {
                self.above.push(root);
                end = root;
            }
        }
        self.subtrees.reverse();
        self.above.reverse();
        Ok(())
    }

    /// The changes of a panel by those before it, in order.
    pub fn changes(&self, panel: usize) -> &[Change] {
        &self.changes[self.start[panel]..self.start[panel + 1]]
    }

    /// Bytes of the schedule.
    pub fn bytes(&self) -> usize {
        let numbers = self.start.len() + 2 * self.of_panel.len();
        numbers * size_of::<usize>()
            + self.changes.len() * size_of::<Change>()
            + self.subtrees.len() * size_of::<Range<usize>>()
    }
}

/// Tells the panels that a panel changes, with the range of its rows that are columns of each.
fn for_changes(
    structure: &Structure,
    panel_of: &[usize],
    by: usize,
    mut tell: impl FnMut(usize, usize, usize),
) {
    let (rows, inner) = (structure.rows(by), structure.inner_rows(by));
    let mut first = 0;
    while first < inner {
        let panel = panel_of[rows[first]];
        let last = structure.columns(panel).end;
        let end = first + rows[first..inner].partition_point(|&row| row < last);
        tell(panel, first, end);
        first = end;
    }
}
