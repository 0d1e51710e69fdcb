//! The graph of a sparse symmetric matrix, unknowns with the same neighbours taken together: the unknowns
//! of one node of a mesh are one vertex, so that orderings and symbolic factorisations have a quarter or a
//! ninth of the entries.

use faer::sparse::{SymbolicSparseColMat, SymbolicSparseColMatRef};

use super::factor_progress::{FactorProgress, Failure};
use super::links::Links;
use crate::linalg::sparse_matrix::{Csc, OutOfMemory};
use crate::shortage;

/// Vertices with their unknowns and neighbours. First stand the vertices that are eliminated.
pub struct Graph {
    /// Number of vertices that are eliminated.
    pub inner: usize,
    /// Neighbours, without the vertex itself.
    links: Links,
    /// Where the unknowns of each vertex begin.
    member_start: Vec<usize>,
    member: Vec<usize>,
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
        let (vertex, member_start, member) = together(&unknowns, eliminated)?;
        progress(0.0)?;
        let inner = member_start.partition_point(|&start| start < eliminated);
        let count = member_start.len() - 1;
        let mut start = reserved(count + 1)?;
        let mut neighbour = Vec::new();
        // The vertex that has counted a neighbour last.
        let mut seen = filled(count, usize::MAX)?;
        start.push(0);
        for v in 0..count {
            let begin = neighbour.len();
            seen[v] = v;
            for i in unknowns.of(member[member_start[v]]) {
                let other = vertex[i];
                if seen[other] != v {
                    seen[other] = v;
                    neighbour.push(other);
                }
            }
            neighbour[begin..].sort_unstable();
            start.push(neighbour.len());
        }
        Ok(Graph { inner, links: Links { start, neighbour }, member_start, member })
    }

    /// Number of vertices.
    pub fn vertices(&self) -> usize {
        self.links.vertices()
    }

    /// Neighbours of a vertex, ascending.
    pub fn neighbours(&self, vertex: usize) -> impl Iterator<Item = usize> {
        self.links.neighbours(vertex)
    }

    /// Number of pairs of neighbours, each counted twice.
    pub fn entries(&self) -> usize {
        self.links.neighbour.len()
    }

    /// Unknowns of a vertex, ascending.
    pub fn members(&self, vertex: usize) -> &[usize] {
        &self.member[self.member_start[vertex]..self.member_start[vertex + 1]]
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

    fn unknowns(&self) -> usize {
        self.lower.ncols()
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

/// The vertex of each unknown, and the unknowns of each vertex: its begins, and the unknowns.
type Together = (Vec<usize>, Vec<usize>, Vec<usize>);

fn together(unknowns: &Adjacency<'_>, eliminated: usize) -> Result<Together, OutOfMemory> {
    let size = unknowns.unknowns();
    let mut signature = reserved(size)?;
    signature.extend((0..size).map(|i| unknowns.signature(i)));
    let mut vertex = filled(size, usize::MAX)?;
    let (mut member_start, mut member) = (reserved(size + 1)?, reserved(size)?);
    member_start.push(0);
    for i in 0..size {
        if vertex[i] != usize::MAX {
            continue;
        }
        let new = member_start.len() - 1;
        vertex[i] = new;
        member.push(i);
        for j in unknowns.of(i).filter(|&j| j > i) {
            let same_side = (i < eliminated) == (j < eliminated);
            let free = vertex[j] == usize::MAX && signature[i] == signature[j];
            if same_side && free && unknowns.alike(i, j) {
                vertex[j] = new;
                member.push(j);
            }
        }
        member_start.push(member.len());
    }
    Ok((vertex, member_start, member))
}

/// An empty vector with room.
pub fn reserved<T>(length: usize) -> Result<Vec<T>, OutOfMemory> {
    let mut vector = Vec::new();
    vector.try_reserve_exact(length).map_err(|_| OutOfMemory)?;
    // The reserve of a call is not for arrays that can be refused.
    if shortage::is_noted() { Err(OutOfMemory) } else { Ok(vector) }
}

/// A vector of equal entries.
pub fn filled<T: Clone>(length: usize, value: T) -> Result<Vec<T>, OutOfMemory> {
    let mut vector = reserved(length)?;
    vector.resize(length, value);
    Ok(vector)
}
