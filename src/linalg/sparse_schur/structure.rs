//! Where the entries of the factor stand, before any is computed: its supernodes, and what they cost.

use faer::MatRef;
use faer::sparse::linalg::SymbolicSupernodalParams;
use faer::sparse::linalg::cholesky::supernodal;

use super::factor_progress::{FactorProgress, Failure};
use super::graph::Graph;
use super::lists::{Lists, reserved};
use super::order::{Pattern, chosen, of_tree, pattern};
use crate::linalg::sparse_matrix::{Csc, OutOfMemory};

/// Most columns of a panel, into which wide supernodes are cut, and of a block of the Schur complement. Products with so
/// many are fast; more would delay the question whether to go on, and store more of the triangle above the diagonal.
pub const PANEL: usize = 256;

/// Neighbouring supernodes become one if it has at most so many vertices, of whose entries at most this
/// share is zero. Of one with all kept vertices a small share is much: where these are most of the rows, a
/// twentieth costs a sixth of all operations.
const RELAXATION: [(usize, f64); 5] =
    [(2, 1.0), (6, 0.8), (16, 0.1), (300, 0.05), (usize::MAX, 0.01)];

/// Panels of the factor: consecutive columns with the same rows below them. The kept unknowns stand behind
/// the eliminated ones, as they are.
pub struct Structure {
    /// Number of all unknowns.
    pub size: usize,
    /// Number of those that are eliminated.
    pub eliminated: usize,
    /// The unknown in each place.
    pub order: Vec<usize>,
    /// First column of each panel; at last the number of eliminated unknowns.
    begin: Vec<usize>,
    /// Rows below the diagonal block of each panel, ascending.
    rows: Lists,
    value_start: Vec<usize>,
}

impl Structure {
    /// Finds the panels of the factor of the matrix whose lower triangle is `lower`, in the best order that is found or,
    /// if `given` has the rank of each unknown, in this one.
    ///
    /// # Errors
    /// No memory, or `progress`, who is asked between the parts of the work, ends it.
    pub fn new(
        lower: &Csc,
        eliminated: usize,
        given: Option<&[usize]>,
        progress: &mut FactorProgress<'_>,
    ) -> Result<Self, Failure> {
        progress(0.0)?;
        let graph = Graph::new(lower, eliminated, progress)?;
        progress(0.0)?;
        let order = chosen(&graph, given, progress)?;
        progress(0.0)?;
        let pattern = pattern(&graph, &order)?;
        progress(0.0)?;
        let symbolic = symbolic(&pattern)?;
        progress(0.0)?;
        let mut unknowns = Lists::reserved(graph.vertices(), lower.ncols())?;
        for k in 0..graph.vertices() {
            unknowns.push(graph.members.of(order.get(k).copied().unwrap_or(k)));
        }
        let mut structure = Structure {
            size: lower.ncols(),
            eliminated,
            order: Vec::new(),
            begin: vec![0],
            rows: Lists::default(),
            value_start: vec![0],
        };
        for s in 0..symbolic.n_supernodes() {
            let (first, end) = (symbolic.supernode_begin()[s], symbolic.supernode_end()[s]);
            if first >= graph.inner {
                break;
            }
            let last = end.min(graph.inner);
            let vertices = (last..end).chain(symbolic.supernode(s).pattern().iter().copied());
            let mut rows = Vec::new();
            for place in vertices.flat_map(|k| unknowns.range(k)) {
                // Kept unknowns stand where they are, whatever vertices they have.
                rows.push(if place < eliminated { place } else { unknowns.entries[place] });
            }
            rows.sort_unstable();
            structure.push_supernode(unknowns.start[last], &rows)?;
        }
        structure.order = unknowns.entries;
        (eliminated..structure.size).for_each(|i| structure.order[i] = i);
        Ok(structure)
    }

    /// The columns up to `end`, in panels, over `rows`.
    fn push_supernode(&mut self, end: usize, rows: &[usize]) -> Result<(), OutOfMemory> {
        while self.begin[self.panels()] < end {
            let first = self.begin[self.panels()];
            let last = end.min(first + PANEL);
            let below = end - last + rows.len();
            self.rows.entries.try_reserve(below).map_err(|_| OutOfMemory)?;
            self.rows.push((last..end).chain(rows.iter().copied()));
            let values = (last - first + below) * (last - first);
            self.begin.push(last);
            self.value_start.push(self.value_start[self.value_start.len() - 1] + values);
        }
        Ok(())
    }

    /// Vectors of all unknowns, one behind the other, in their places.
    pub fn ordered(&self, vectors: &[f64]) -> Vec<f64> {
        let mut ordered = Vec::with_capacity(vectors.len());
        for vector in vectors.chunks_exact(self.size.max(1)) {
            ordered.extend(self.order.iter().map(|&i| vector[i]));
        }
        ordered
    }

    /// The vectors that have `ordered` in their places.
    pub fn unordered(&self, ordered: &[f64]) -> Vec<f64> {
        let mut vectors = vec![0.0; ordered.len()];
        let size = self.size.max(1);
        for (vector, ordered) in vectors.chunks_exact_mut(size).zip(ordered.chunks_exact(size)) {
            self.order.iter().zip(ordered).for_each(|(&i, x)| vector[i] = *x);
        }
        vectors
    }

    /// Number of panels.
    pub fn panels(&self) -> usize {
        self.begin.len() - 1
    }

    /// Number of kept unknowns.
    pub fn kept(&self) -> usize {
        self.size - self.eliminated
    }

    /// Columns of a panel.
    pub fn columns(&self, panel: usize) -> std::ops::Range<usize> {
        self.begin[panel]..self.begin[panel + 1]
    }

    /// Rows below the diagonal block of a panel, ascending.
    pub fn rows(&self, panel: usize) -> &[usize] {
        &self.rows.entries[self.rows.range(panel)]
    }

    /// Where the values of a panel stand: column by column, the diagonal block above the rows.
    pub fn values(&self, panel: usize) -> std::ops::Range<usize> {
        self.value_start[panel]..self.value_start[panel + 1]
    }

    /// The diagonal block of a panel with these values, and its rows.
    pub fn blocks<'v>(
        &self,
        panel: usize,
        values: &'v [f64],
    ) -> (MatRef<'v, f64>, MatRef<'v, f64>) {
        let (width, rows) = (self.columns(panel).len(), self.rows(panel).len());
        MatRef::from_column_major_slice(values, width + rows, width).split_at_row(width)
    }

    /// Number of values of all panels.
    pub fn stored(&self) -> usize {
        self.value_start[self.panels()]
    }

    /// The panel of each column.
    pub fn panel_of_columns(&self) -> Result<Vec<usize>, OutOfMemory> {
        let mut panel = reserved(self.eliminated)?;
        for s in 0..self.panels() {
            panel.resize(self.begin[s + 1], s);
        }
        Ok(panel)
    }

    /// Rows of the panel before each one that belongs to the kept unknowns.
    pub fn inner_rows(&self, panel: usize) -> usize {
        self.rows(panel).partition_point(|&row| row < self.eliminated)
    }

    /// Bytes of the structure itself.
    pub fn bytes(&self) -> usize {
        let numbers = self.order.len() + self.rows.entries.len() + 3 * self.begin.len();
        numbers * size_of::<usize>()
    }
}

fn symbolic(
    pattern: &Pattern,
) -> Result<supernodal::SymbolicSupernodalCholesky<usize>, OutOfMemory> {
    let scratch =
        supernodal::factorize_supernodal_symbolic_cholesky_scratch::<usize>(pattern.ncols());
    let parameters = SymbolicSupernodalParams { relax: Some(&RELAXATION) };
    of_tree(pattern, scratch, |tree, counts, stack| {
        let pattern = pattern.as_ref();
        supernodal::factorize_supernodal_symbolic_cholesky(pattern, tree, counts, stack, parameters)
    })?
    .map_err(|_| OutOfMemory)
}
