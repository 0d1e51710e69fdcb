//! One sweep over all components, in their order.
//!
//! What a step adds to the forces of a block of components is added at once, as the next steps read it; what it adds to
//! the others, after the block, by threads that share them. Each force gets the same terms in the same order.

use crate::linalg::matrix::Matrix;
use crate::linalg::simd::{add_columns, axpy, vectorised};
use crate::workers::{columns_to_share, pieces, reading};

/// The steps of some components, the others zero.
type Steps = [f64; 3];

/// Lets `relax(i, force)` change the `DIM` components from `i` on, whose forces it is told, for all of these groups. It
/// returns their steps and the square of the change in the norm of the diagonal, of which the root of the sum is returned.
/// The symmetric `matrix` times the steps is added to `force`.
#[inline(always)]
pub fn over_all<const DIM: usize>(
    matrix: Matrix<'_>,
    force: &mut [f64],
    mut relax: impl FnMut(usize, &[f64]) -> (Steps, f64),
) -> f64 {
    let size = matrix.size();
    let least = DIM * columns_to_share(size).div_ceil(DIM).min(size / DIM).max(1);
    let (mut first, mut length) = (0, least);
    let (mut change, mut steps) = (0.0, Vec::new());
    while first < size {
        let block = first..size.min(first + length);
        steps.clear();
        let own = &mut force[block.clone()];
        vectorised(
            #[inline(always)]
            || {
                for i in (0..own.len()).step_by(DIM) {
                    let (moved, added) = relax(first + i, &own[i..i + DIM]);
                    change += added;
                    add_steps::<DIM>(|c| &matrix.column(first + i + c)[block.clone()], moved, own);
                    if least < size {
                        steps.extend_from_slice(&moved[..DIM]);
                    }
                }
            },
        );
        let moved = steps.iter().filter(|step| **step != 0.0).count();
        pieces([force], reading(moved * size), |begin, [force]| {
            let end = begin + force.len();
            let (from, to) = (block.end.clamp(begin, end), block.start.clamp(begin, end));
            for rows in [begin..to, from..end] {
                let own = &mut force[rows.start - begin..rows.end - begin];
                matrix.add_rows_of_product((first, &steps), rows, own);
            }
        });
        first = block.end;
        // The next block is so long that its products are shared if as few components move in it; at most twice as long, as
        // one thread multiplies within a block.
        let groups = (block.len() * least / moved.max(1)).min(2 * block.len()) / DIM;
        length = (DIM * groups).max(least);
    }
    change.sqrt()
}

/// Adds the columns of a group times its steps.
#[inline(always)]
fn add_steps<'a, const DIM: usize>(
    column: impl Fn(usize) -> &'a [f64],
    steps: Steps,
    sum: &mut [f64],
) {
    let mut moved = (0..DIM).filter(|&c| steps[c] != 0.0);
    match [moved.next(), moved.next(), moved.next()] {
        [Some(a), Some(b), Some(c)] => {
            add_columns(sum, [steps[a], steps[b], steps[c]], [column(a), column(b), column(c)]);
        }
        [Some(a), Some(b), None] => add_columns(sum, [steps[a], steps[b]], [column(a), column(b)]),
        [Some(a), ..] => axpy(sum, steps[a], column(a)),
        [None, ..] => {}
    }
}
