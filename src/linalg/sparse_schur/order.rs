//! The order of elimination.
//!
//! Approximate minimum degree on the whole graph with the kept vertices made one clique: they count in the
//! degrees of the others and come last by their own. Where its factor costs much, nested dissection too,
//! and the better of both. Or the order of the host.

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::sparse::linalg::amd;
use faer::sparse::linalg::cholesky::simplicial::{
    EliminationTreeRef, prefactorize_symbolic_cholesky, prefactorize_symbolic_cholesky_scratch,
};
use faer::sparse::{SymbolicSparseColMat, SymbolicSparseColMatRef};

use super::dissection::dissected;
use super::factor_progress::{FactorProgress, FactorStep, Failure};
use super::graph::{Graph, filled, reserved};
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
        let first = |v: &usize| graph.members(*v).iter().map(|&i| rank[i]).min();
        order.sort_by_key(first);
        return Ok(examined(graph, &order)?.0);
    }
    let order = minimum_degree(graph)?;
    progress(FactorStep::HasDone(0.0))?;
    let (order, operations) = examined(graph, &order)?;
    if operations <= OPERATIONS_PER_VERTEX * graph.inner as f64 {
        return Ok(order);
    }
    let Some(dissected) = nested_dissection(graph, progress)? else { return Ok(order) };
    progress(FactorStep::HasDone(0.0))?;
    let (dissected, fewer) = examined(graph, &dissected)?;
    Ok(if fewer < operations { dissected } else { order })
}

fn minimum_degree(graph: &Graph) -> Result<Vec<usize>, OutOfMemory> {
    let (inner, kept) = (graph.inner, graph.vertices() - graph.inner);
    let share = kept.div_ceil(LARGEST_CLIQUE).max(1);
    let size = inner + kept.div_ceil(share);
    let place = |v: usize| if v < inner { v } else { inner + (v - inner) / share };
    let (mut start, mut row) = (reserved(size + 1)?, reserved(graph.entries())?);
    start.push(0);
    for v in 0..inner {
        row.extend(graph.neighbours(v).iter().map(|&w| place(w)).filter(|&w| w > v));
        start.push(row.len());
    }
    for k in inner..size {
        row.extend(k + 1..size);
        start.push(row.len());
    }
    // Vertices that are one have their neighbours several times: sorted and told once by faer.
    let pattern = SymbolicSparseColMatRef::new_unsorted_checked(size, size, &start, None, &row);
    let control = amd::Control { dense: -1.0, ..Default::default() };
    let scratch = amd::order_maybe_unsorted_scratch::<usize>(size, row.len());
    let mut memory = MemBuffer::try_new(scratch).map_err(|_| OutOfMemory)?;
    let (mut order, mut inverse) = (filled(size, 0)?, filled(size, 0)?);
    let stack = MemStack::new(&mut memory);
    amd::order_maybe_unsorted(&mut order, &mut inverse, pattern, control, stack)
        .map_err(|_| OutOfMemory)?;
    order.retain(|&v| v < inner);
    Ok(order)
}

/// `None` if it fails in any way: the other order serves.
fn nested_dissection(
    graph: &Graph,
    progress: &mut FactorProgress<'_>,
) -> Result<Option<Vec<usize>>, Failure> {
    let Some((start, neighbour)) = inner_links(graph) else { return Ok(None) };
    let order = dissected(start, neighbour, progress)?;
    Ok(order.and_then(|order| permutation(&order, graph.inner)))
}

/// Where the neighbours of each inner vertex begin among those of all, and these, without kept vertices; `None` if
/// there are too many.
fn inner_links(graph: &Graph) -> Option<(Vec<i32>, Vec<i32>)> {
    let number = |i: usize| i32::try_from(i).ok();
    let (mut start, mut neighbour) = (vec![0], Vec::new());
    for v in 0..graph.inner {
        for &w in graph.neighbours(v).iter().filter(|&&w| w < graph.inner) {
            neighbour.push(number(w)?);
        }
        start.push(number(neighbour.len())?);
    }
    Some((start, neighbour))
}

/// `order`, if it is one of `size` numbers.
fn permutation(order: &[i32], size: usize) -> Option<Vec<usize>> {
    let order: Option<Vec<usize>> = order.iter().map(|&v| usize::try_from(v).ok()).collect();
    order.filter(|order| is_permutation(order, size))
}

/// `true` if `order` has each of the numbers below `size` once.
fn is_permutation(order: &[usize], size: usize) -> bool {
    let mut missing = vec![true; size];
    let is_new = |&i: &usize| missing.get_mut(i).is_some_and(std::mem::take);
    order.len() == size && order.iter().all(is_new)
}

/// An order with the same fill in which the columns of each supernode stand together, and about how many
/// operations its factorisation takes.
fn examined(graph: &Graph, order: &[usize]) -> Result<(Vec<usize>, f64), OutOfMemory> {
    let pattern = pattern(graph, order)?;
    let unknowns: usize = (0..graph.inner).map(|v| graph.members(v).len()).sum();
    let size = unknowns as f64 / graph.inner.max(1) as f64;
    of_tree(&pattern, StackReq::EMPTY, |tree, counts, _| {
        let squares = counts[..graph.inner].iter().map(|&count| (count as f64).powi(2));
        let post = post_order(tree.into_inner(), graph.inner);
        (post.into_iter().map(|k| order[k]).collect(), size.powi(3) * squares.sum::<f64>())
    })
}

/// The pattern with the inner vertices in their order and the kept ones behind them as they are.
pub fn pattern(graph: &Graph, order: &[usize]) -> Result<Pattern, OutOfMemory> {
    let size = graph.vertices();
    let mut place: Vec<usize> = (0..size).collect();
    order.iter().enumerate().for_each(|(k, &v)| place[v] = k);
    let (mut start, mut row) = (reserved(size + 1)?, reserved(graph.entries() / 2)?);
    start.push(0);
    for k in 0..size {
        let vertex = order.get(k).copied().unwrap_or(k);
        let begin = row.len();
        row.extend(graph.neighbours(vertex).iter().map(|&w| place[w]).filter(|&w| w < k));
        row[begin..].sort_unstable();
        start.push(row.len());
    }
    Ok(SymbolicSparseColMat::new_checked(size, size, start, None, row))
}

/// The answer of `ask` to the elimination tree, in which -1 is the parent of a root, and the length of each column of
/// the factor; with room for `scratch`.
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

/// The first `inner` columns, each after those below it in the tree and right behind them.
fn post_order(parent: &[isize], inner: usize) -> Vec<usize> {
    let (mut first_child, mut sibling) = (vec![None; inner], vec![None; inner]);
    let mut roots = Vec::new();
    // Backwards, so that children stand in ascending order.
    for k in (0..inner).rev() {
        match usize::try_from(parent[k]) {
            Ok(above) if above < inner => {
                sibling[k] = first_child[above];
                first_child[above] = Some(k);
            }
            _ => roots.push(k),
        }
    }
    let (mut order, mut open) = (Vec::with_capacity(inner), roots);
    while let Some(&k) = open.last() {
        let (mut next, begin) = (first_child[k].take(), open.len());
        while let Some(child) = next {
            open.push(child);
            next = sibling[child];
        }
        open[begin..].reverse();
        if open.len() == begin {
            open.pop();
            order.push(k);
        }
    }
    order
}

#[cfg(test)]
mod tests {
    use super::{
        chosen, examined, is_permutation, minimum_degree, nested_dissection, permutation,
        post_order,
    };
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
            assert!((0..64).all(|v| graph.members(v).len() == dofs));
        }
    }

    /// Whatever is chosen is an order of all inner vertices, and never dearer than minimum degree.
    #[test]
    fn chosen_order_is_complete_and_the_cheaper_one() {
        for edge in [2, 5, 14] {
            let (matrix, eliminated) = cube(edge, 3);
            let graph = Graph::new(&matrix, eliminated, &mut |_| Ok(())).unwrap();
            let (_, most) = examined(&graph, &minimum_degree(&graph).unwrap()).unwrap();
            let order = chosen(&graph, None, &mut |_| Ok(())).unwrap();
            assert!(is_permutation(&order, graph.inner));
            assert!(nested_dissection(&graph, &mut |_| Ok(())).unwrap().is_some());
            assert!(examined(&graph, &order).unwrap().1 <= most);
        }
    }

    #[test]
    fn children_stand_right_before_their_parents() {
        // Columns 5 and 6 are kept; the trees are 0, 2 -> 4 and 1 -> 3.
        let parent = [4, 3, 4, 5, 6, 6, -1];
        assert_eq!(post_order(&parent, 5), [1, 3, 0, 2, 4]);
    }

    #[test]
    fn what_is_no_permutation_is_not_taken() {
        assert_eq!(permutation(&[2, 0, 1], 3), Some(vec![2, 0, 1]));
        for wrong in [vec![0, 1], vec![0, 1, 1], vec![0, 1, 3], vec![0, 1, -1], vec![0, 1, 2, 3]] {
            assert_eq!(permutation(&wrong, 3), None);
        }
    }
}
