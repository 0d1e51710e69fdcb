//! Approximate minimum degree, by faer.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::amd;

use super::lists::{Lists, filled};
use crate::linalg::sparse_matrix::OutOfMemory;

/// The order of the vertices of a graph. Neighbours are told by one of both or by both, in any order and as often as they
/// come: they are sorted and told once by faer.
pub fn minimum_degree(links: &Lists) -> Result<Vec<usize>, OutOfMemory> {
    let (size, Lists { start, entries }) = (links.count(), links);
    let pattern = SymbolicSparseColMatRef::new_unsorted_checked(size, size, start, None, entries);
    let control = amd::Control { dense: -1.0, ..Default::default() };
    let scratch = amd::order_maybe_unsorted_scratch::<usize>(size, entries.len());
    let mut memory = MemBuffer::try_new(scratch).map_err(|_| OutOfMemory)?;
    let (mut order, mut inverse) = (filled(size, 0)?, filled(size, 0)?);
    let stack = MemStack::new(&mut memory);
    amd::order_maybe_unsorted(&mut order, &mut inverse, pattern, control, stack)
        .map_err(|_| OutOfMemory)?;
    Ok(order)
}
