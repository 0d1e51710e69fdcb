//! Is a square matrix symmetric? Its products with a vector from either side tell, in one pass over it.

use std::sync::atomic::{AtomicBool, Ordering};

use super::columns::LINE;
use super::matrix::Matrix;
use super::perturbation::Perturbation;
use super::simd::vectorised;
use super::watched::BLOCK;
use crate::workers::{each, reading};

/// Columns that are read in one pass. A vector of the processor has the numbers of a line.
const AT_ONCE: usize = 4;

impl Matrix<'_> {
    /// `true` if each entry is of size `most` at most and differs by `apart` at most from the one across the diagonal, both
    /// times `root[i] root[j]`; `most` may be infinite. `false` may be said of such a matrix too, if its differences add up
    /// to more.
    ///
    /// Seen are the sums of the differences of each row, each times a number of either sign between 1 and 2 without a
    /// pattern: one difference that is too large makes a sum too large, and several do not cancel in all of their rows.
    pub fn agrees_across(&self, root: &[f64], apart: f64, most: f64) -> bool {
        let size = self.size();
        let mut numbers = Perturbation::new(1);
        let scaled = |root: &f64| {
            let number = numbers.next();
            (number + number.signum()) / if *root == 0.0 { 1.0 } else { *root }
        };
        let x: Vec<f64> = root.iter().map(scaled).collect();
        let mut down = vec![0.0; size];
        // Each block of columns has a product of its own, so that their sum does not depend on the threads.
        let mut products = vec![0.0; size * size.div_ceil(BLOCK)];
        let beyond = AtomicBool::new(false);
        let blocks = products.chunks_mut(size.max(1)).zip(down.chunks_mut(BLOCK)).enumerate();
        each(blocks, reading(size * size), |(block, (product, down))| {
            let is_beyond = vectorised(
                #[inline(always)]
                || self.block_beyond(BLOCK * block, (&x, root), most, (product, down)),
            );
            beyond.fetch_or(is_beyond, Ordering::Relaxed);
        });
        // Written so that NaN does not agree.
        let agrees = |i: usize| {
            let across: f64 = products.iter().skip(i).step_by(size).sum();
            (across - down[i]).abs() <= apart * root[i]
        };
        !beyond.into_inner() && (0..size).all(agrees)
    }

    /// Adds the columns from `first` on, as many as `down` has, times their entries of `x` to `product`, and sets `down` to
    /// their inner products with `x`. Returns `true` if one of their entries is of a size beyond `most root[i] root[j]`.
    #[inline(always)]
    fn block_beyond(
        &self,
        first: usize,
        (x, root): (&[f64], &[f64]),
        most: f64,
        (product, down): (&mut [f64], &mut [f64]),
    ) -> bool {
        let mut is_beyond = false;
        for (down, j) in down.chunks_mut(AT_ONCE).zip((first..).step_by(AT_ONCE)) {
            // The last column with the factor 0 stands for those that are missing at the end.
            let place = |c: usize| j + c.min(down.len() - 1);
            let columns: [&[f64]; AT_ONCE] = std::array::from_fn(|c| self.column(place(c)));
            let factors = std::array::from_fn(|c| if c < down.len() { x[j + c] } else { 0.0 });
            let limits = std::array::from_fn(|c| most * root[place(c)]);
            let (sums, beyond) = pass(columns, (factors, limits), (x, root), product);
            down.iter_mut().zip(sums).for_each(|(down, sum)| *down = sum);
            is_beyond |= beyond;
        }
        is_beyond
    }
}

/// Adds columns times their `factors` to `product`. Returns their inner products with `x`, and `true` if an entry is of a
/// size beyond the limit of its column times the `root` of its row.
#[inline(always)]
fn pass(
    columns: [&[f64]; AT_ONCE],
    (factors, limits): ([f64; AT_ONCE], [f64; AT_ONCE]),
    (x, root): (&[f64], &[f64]),
    product: &mut [f64],
) -> ([f64; AT_ONCE], bool) {
    let (mut sums, mut marks) = ([[0.0; LINE]; AT_ONCE], [0.0; LINE]);
    let size = product.len();
    let whole = size - size % LINE;
    for from in (0..whole).step_by(LINE) {
        let (x, root, mut added) = (vector(x, from), vector(root, from), vector(product, from));
        for c in 0..AT_ONCE {
            let entries = vector(columns[c], from);
            for l in 0..LINE {
                added[l] = entries[l].mul_add(factors[c], added[l]);
                sums[c][l] = entries[l].mul_add(x[l], sums[c][l]);
                let is_beyond = entries[l].abs() > limits[c] * root[l];
                marks[l] = if is_beyond { 1.0 } else { marks[l] };
            }
        }
        product[from..from + LINE].copy_from_slice(&added);
    }
    let mut is_beyond = marks != [0.0; LINE];
    for i in whole..size {
        for c in 0..AT_ONCE {
            let entry = columns[c][i];
            product[i] += entry * factors[c];
            sums[c][0] += entry * x[i];
            is_beyond |= entry.abs() > limits[c] * root[i];
        }
    }
    (sums.map(|sums| sums.iter().sum()), is_beyond)
}

/// The numbers from `from` on.
#[inline(always)]
fn vector(values: &[f64], from: usize) -> [f64; LINE] {
    let values = &values[from..from + LINE];
    std::array::from_fn(|k| values[k])
}
