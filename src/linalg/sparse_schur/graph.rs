//! The graph of a sparse symmetric matrix, unknowns with the same neighbours taken together: the unknowns
//! of one node of a mesh are one vertex, so that orderings and symbolic factorisations have a quarter or a
//! ninth of the entries.

use std::iter::once;
use std::mem::replace;

use faer::sparse::{SymbolicSparseColMat, SymbolicSparseColMatRef};

use super::factor_progress::{FactorProgress, Failure};
use super::lists::{Lists, filled, reserved};
use crate::linalg::sparse_matrix::{Csc, OutOfMemory};

/// Vertices with their unknowns and neighbours. First stand the vertices that are eliminated.
pub struct Graph {
    /// Number of vertices that are eliminated.
    pub inner: usize,
    /// Neighbours, without the vertex itself.
    pub links: Lists,
    /// Unknowns of each vertex, ascending.
    pub members: Lists,
}

impl Graph {
    /// Makes the graph of the matrix whose lower triangle is `lower`; the first `eliminated` unknowns are eliminated and
    /// share no vertex with the others.
    ///
    /// # Errors
    /// No memory, or `progress`, who is asked between the parts of the work, ends it.
    pub fn new(
        lower: &Csc,
        eliminated: usize,
        progress: &mut FactorProgress<'_>,
    ) -> Result<Self, Failure> {
        let unknowns = Adjacency::of_unknowns(lower)?;
        progress(0.0)?;
        let (vertex, members) = together(&unknowns, eliminated)?;
        progress(0.0)?;
        let inner = members.start.partition_point(|&start| start < eliminated);
        let count = members.count();
        let mut links = Lists::reserved(count, 0)?;
        // The vertex that has counted a neighbour last.
        let mut seen = filled(count, usize::MAX)?;
        for v in 0..count {
            seen[v] = v;
            let others = unknowns.of(members.entries[members.start[v]]).map(|i| vertex[i]);
            links.push(others.filter(|&other| replace(&mut seen[other], v) != v)).sort_unstable();
        }
        Ok(Graph { inner, links, members })
    }

    /// Number of vertices.
    pub fn vertices(&self) -> usize {
        self.links.count()
    }
}

/// The neighbours of each unknown: the larger ones in a column of the lower triangle, the smaller ones in one of the upper.
struct Adjacency<'l> {
    lower: SymbolicSparseColMatRef<'l, usize>,
    upper: SymbolicSparseColMat<usize>,
}

impl<'l> Adjacency<'l> {
    fn of_unknowns(lower: &'l Csc) -> Result<Self, OutOfMemory> {
        let lower = lower.symbolic();
        let upper = lower.transpose().to_col_major().map_err(|_| OutOfMemory)?;
        Ok(Adjacency { lower, upper })
    }

    /// Neighbours, ascending, without the unknown itself.
    fn of(&self, i: usize) -> impl Iterator<Item = usize> {
        let both = self.upper.as_ref().row_idx_of_col(i).chain(self.lower.row_idx_of_col(i));
        both.filter(move |&k| k != i)
    }

    /// `true` if two neighbours have the same other neighbours.
    fn alike(&self, i: usize, j: usize) -> bool {
        let others = |of: usize, but: usize| self.of(of).filter(move |&k| k != but);
        others(i, j).eq(others(j, i))
    }

    /// A sum over an unknown and its neighbours: unknowns that are alike have the same.
    fn signature(&self, i: usize) -> u64 {
        const MIX: u64 = 0x9E37_79B9_7F4A_7C15;
        let term = |k: usize| {
            let product = (k as u64 + 1).wrapping_mul(MIX);
            (product ^ (product >> 32)).wrapping_mul(MIX)
        };
        self.of(i).fold(term(i), |sum, k| sum.wrapping_add(term(k)))
    }
}

/// The vertex of each unknown, and the unknowns of each vertex.
fn together(
    unknowns: &Adjacency<'_>,
    eliminated: usize,
) -> Result<(Vec<usize>, Lists), OutOfMemory> {
    let size = unknowns.lower.ncols();
    let mut signature = reserved(size)?;
    signature.extend((0..size).map(|i| unknowns.signature(i)));
    let mut vertex = filled(size, usize::MAX)?;
    let mut members = Lists::reserved(size, size)?;
    for i in 0..size {
        if vertex[i] != usize::MAX {
            continue;
        }
        let joins = |j: &usize| {
            let same_side = (i < eliminated) == (*j < eliminated);
            let free = vertex[*j] == usize::MAX && signature[i] == signature[*j];
            *j > i && same_side && free && unknowns.alike(i, *j)
        };
        let new = members.count();
        let own = members.push(once(i).chain(unknowns.of(i).filter(joins)));
        own.iter().for_each(|&j| vertex[j] = new);
    }
    Ok((vertex, members))
}
