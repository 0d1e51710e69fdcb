//! Numbers at the points of a face: lists of them, one after the other, in loops that take several points and several
//! lists at once. They are to be called inside [`crate::linalg::simd::vectorised`].

use super::shape::{Block, FaceKind, MOST_NODES, Values};
use crate::linalg::columns::LINE;
use crate::linalg::simd::{add_columns, axpy};

/// Numbers of points, list after list, and memory for a block of them.
#[derive(Debug, Default)]
pub(super) struct Lists {
    pub(super) values: Vec<f64>,
    block: [Block; MOST_NODES],
}

impl Lists {
    /// Makes the lists those of the shape functions of a face at some points, each in whole lines.
    #[inline(always)]
    pub(super) fn fill(&mut self, kind: FaceKind, at: [&[f64]; 2]) {
        self.values.clear();
        self.values.resize(kind.nodes() * whole_lines(at[0].len()), 0.0);
        kind.values_at(at, &mut self.values, &mut self.block);
    }
}

/// The length of a list with zeros behind its points, up to the end of a line: sums take whole lines.
pub(super) fn whole_lines(points: usize) -> usize {
    points.next_multiple_of(LINE)
}

/// The sum of products, in as many sums beside each other as a line has numbers.
#[inline(always)]
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (parts, a) = a.as_chunks::<LINE>();
    let (others, b) = b.as_chunks::<LINE>();
    let mut sums = [0.0; LINE];
    for (part, other) in parts.iter().zip(others) {
        (0..LINE).for_each(|k| sums[k] += part[k] * other[k]);
    }
    sums.iter().sum::<f64>() + a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>()
}

/// The sums of the products of a list with each of some lists.
#[inline(always)]
pub(super) fn dots(a: &[f64], lists: &[f64]) -> Values {
    let mut sums = [0.0; MOST_NODES];
    for (sum, list) in sums.iter_mut().zip(lists.chunks_exact(a.len())) {
        *sum = dot(a, list);
    }
    sums
}

/// Adds multiples of as many lists as there are factors, half a line of them at once.
#[inline(always)]
pub(super) fn add_lists(y: &mut [f64], factors: &[f64], mut lists: &[f64]) {
    let (some, left) = factors.as_chunks::<{ LINE / 2 }>();
    for factors in some {
        add_columns(y, *factors, std::array::from_fn(|k| &lists[k * y.len()..]));
        lists = &lists[factors.len() * y.len()..];
    }
    for (factor, list) in left.iter().zip(lists.chunks_exact(y.len())) {
        axpy(y, *factor, list);
    }
}
