//! The order of elimination.
//!
//! Approximate minimum degree on the whole graph with the kept vertices made one clique: they count in the
//! degrees of the others and come last by their own. Where its factor costs much, nested dissection too,
//! and the better of both. Or the order of the host.

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::sparse::SymbolicSparseColMat;
use faer::sparse::linalg::cholesky::simplicial::{
    EliminationTreeRef, prefactorize_symbolic_cholesky, prefactorize_symbolic_cholesky_scratch,
};
use faer::sparse::linalg::qr::{postorder, postorder_scratch};

use super::dissection::dissected;
use super::factor_progress::{FactorProgress, Failure};
use super::graph::Graph;
use super::lists::{Lists, filled};
use super::minimum_degree::minimum_degree;
use crate::linalg::sparse_matrix::OutOfMemory;

/// Most vertices of the clique: of more, several are one. The clique has the square of it.
const LARGEST_CLIQUE: usize = 2000;

/// Nested dissection must save what it costs: so many operations of the factorisation take as long as one
/// vertex of nested dissection (2.5e-5 s at 5e10 operations in a second, measured), twice, because it saves
/// about half.
const OPERATIONS_PER_VERTEX: f64 = 2.0 * 2.5e-5 * 5e10;

/// The upper triangle of the graph's matrix in an order, the diagonal left out.
pub type Pattern = SymbolicSparseColMat<usize>;

/// The inner vertices in the order of elimination.
///
/// # Errors
/// No memory, or `progress` ends it.
pub fn chosen(
    graph: &Graph,
    given: Option<&[usize]>,
    progress: &mut FactorProgress<'_>,
) -> Result<Vec<usize>, Failure> {
    if let Some(rank) = given {
        let mut order: Vec<usize> = (0..graph.inner).collect();
        let first = |v: &usize| graph.members.of(*v).map(|i| rank[i]).min();
        order.sort_by_key(first);
        return Ok(examined(graph, &order)?.0);
    }
    let order = with_clique(graph)?;
    progress(0.0)?;
    let (order, operations) = examined(graph, &order)?;
    if operations <= OPERATIONS_PER_VERTEX * graph.inner as f64 {
        return Ok(order);
    }
    let dissected = dissected(inner_links(graph), progress)?;
    progress(0.0)?;
    let (dissected, fewer) = examined(graph, &dissected)?;
    Ok(if fewer < operations { dissected } else { order })
}

/// Minimum degree with the kept vertices made one clique.
fn with_clique(graph: &Graph) -> Result<Vec<usize>, OutOfMemory> {
    let (inner, kept) = (graph.inner, graph.vertices() - graph.inner);
    let share = kept.div_ceil(LARGEST_CLIQUE).max(1);
    let size = inner + kept.div_ceil(share);
    let place = |v: usize| if v < inner { v } else { inner + (v - inner) / share };
    let mut links = Lists::reserved(size, graph.links.entries.len())?;
    (0..inner).for_each(|v| _ = links.push(graph.links.of(v).map(place).filter(|&w| w > v)));
    (inner..size).for_each(|k| _ = links.push(k + 1..size));
    let mut order = minimum_degree(&links)?;
    order.retain(|&v| v < inner);
    Ok(order)
}

/// The graph of the inner vertices.
fn inner_links(graph: &Graph) -> Lists {
    (0..graph.inner).map(|v| graph.links.of(v).filter(|&w| w < graph.inner)).collect()
}

/// An order with the same fill in which the columns of each supernode stand together, and about how many
/// operations its factorisation takes.
fn examined(graph: &Graph, order: &[usize]) -> Result<(Vec<usize>, f64), OutOfMemory> {
    let pattern = pattern(graph, order)?;
    let size = graph.members.start[graph.inner] as f64 / graph.inner.max(1) as f64;
    let mut post = filled(graph.vertices(), 0)?;
    of_tree(&pattern, postorder_scratch::<usize>(post.len()), |tree, counts, stack| {
        let squares = counts[..graph.inner].iter().map(|&count| (count as f64).powi(2));
        postorder(&mut post, tree, stack);
        let inner = post.iter().filter_map(|&k| order.get(k).copied());
        (inner.collect(), size.powi(3) * squares.sum::<f64>())
    })
}

/// The pattern with the inner vertices in their order and the kept ones behind them as they are.
pub fn pattern(graph: &Graph, order: &[usize]) -> Result<Pattern, OutOfMemory> {
    let size = graph.vertices();
    let mut place: Vec<usize> = (0..size).collect();
    order.iter().enumerate().for_each(|(k, &v)| place[v] = k);
    let mut rows = Lists::reserved(size, graph.links.entries.len() / 2)?;
    for k in 0..size {
        let own = graph.links.of(order.get(k).copied().unwrap_or(k)).map(|w| place[w]);
        rows.push(own.filter(|&w| w < k)).sort_unstable();
    }
    Ok(SymbolicSparseColMat::new_checked(size, size, rows.start, None, rows.entries))
}

/// The answer of `ask` to the elimination tree and the length of each column of the factor; with room for `scratch`.
pub fn of_tree<T>(
    pattern: &Pattern,
    scratch: StackReq,
    ask: impl FnOnce(EliminationTreeRef<'_, usize>, &[usize], &mut MemStack) -> T,
) -> Result<T, OutOfMemory> {
    let size = pattern.ncols();
    let (mut parent, mut counts) = (filled(size, 0)?, filled(size, 0)?);
    let own = prefactorize_symbolic_cholesky_scratch::<usize>(size, pattern.row_idx().len());
    let mut memory = MemBuffer::try_new(own.or(scratch)).map_err(|_| OutOfMemory)?;
    let stack = MemStack::new(&mut memory);
    let tree = prefactorize_symbolic_cholesky(&mut parent, &mut counts, pattern.as_ref(), stack);
    Ok(ask(tree, &counts, stack))
}

#[cfg(test)]
mod tests {
    use super::{chosen, dissected, examined, inner_links, with_clique};
    use crate::linalg::sparse_matrix::{Csc, from_entries};
    use crate::linalg::sparse_schur::graph::Graph;

    /// A cube of `edge`³ nodes with `dofs` unknowns each that are coupled with those of the 26 nodes around;
    /// the last layer is kept.
    fn cube(edge: usize, dofs: usize) -> (Csc, usize) {
        let nodes = edge.pow(3);
        let place = |node: usize| [node % edge, node / edge % edge, node / edge / edge];
        let near =
            |a: usize, b: usize| place(a).iter().zip(place(b)).all(|(&x, y)| x.abs_diff(y) <= 1);
        let pairs = (0..nodes).flat_map(|a| (0..=a).map(move |b| (a, b)));
        let coupled = pairs.filter(|&(a, b)| near(a, b)).flat_map(|(a, b)| {
            (0..dofs * dofs).map(move |k| (dofs * a + k % dofs, dofs * b + k / dofs, 1.0))
        });
        let entries = coupled.filter(|(i, j, _)| i >= j);
        let size = dofs * nodes;
        (from_entries((size, size), entries).unwrap(), size - dofs * edge * edge)
    }

    #[test]
    fn unknowns_of_a_node_are_one_vertex() {
        for dofs in [1, 2, 3] {
            let (matrix, eliminated) = cube(4, dofs);
            let graph = Graph::new(&matrix, eliminated, &mut |_| Ok(())).unwrap();
            assert_eq!((graph.vertices(), graph.inner), (64, 48));
            assert!((0..64).all(|v| graph.members.of(v).count() == dofs));
        }
    }

    /// Whatever is chosen is an order of all inner vertices, and never dearer than minimum degree.
    #[test]
    fn chosen_order_is_complete_and_the_cheaper_one() {
        for edge in [2, 5, 14] {
            let (matrix, eliminated) = cube(edge, 3);
            let graph = Graph::new(&matrix, eliminated, &mut |_| Ok(())).unwrap();
            let (_, most) = examined(&graph, &with_clique(&graph).unwrap()).unwrap();
            let chosen = chosen(&graph, None, &mut |_| Ok(())).unwrap();
            assert!(examined(&graph, &chosen).unwrap().1 <= most);
            let dissected = dissected(inner_links(&graph), &mut |_| Ok(())).unwrap();
            for mut order in [chosen, dissected] {
                order.sort_unstable();
                assert!(order.into_iter().eq(0..graph.inner));
            }
        }
    }
}
