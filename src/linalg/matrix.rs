//! A view of a dense square matrix.

use std::ops::Range;

use super::ball::UNIT;
use super::simd::{AT_ONCE, add_columns, add_sizes, add_twice, vectorised};
use super::tolerances::{CONDENSATION, FREE, UNRESISTED};
use super::vector::{largest_of, norm, opposite};
use super::watched::BLOCK;
use crate::workers::{pieces, reading};

/// A residual in twice the precision, with the sizes of its sums.
#[derive(Clone, Debug)]
pub struct Residual {
    /// The residual, rounded once.
    pub values: Vec<f64>,
    /// The sums of the absolute values of the products.
    pub terms: Vec<f64>,
    /// Norm of bounds on these, on top of which the sums were taken.
    pub base: f64,
}

/// A square matrix, column-major, in the caller's memory.
#[derive(Clone, Copy, Debug)]
pub struct Matrix<'a> {
    size: usize,
    entries: &'a [f64],
    ld: usize,
}

impl<'a> Matrix<'a> {
    /// Views `size` columns of `size` entries, `ld >= max(1, size)` entries from one column to the
    /// next.
    pub fn new(size: usize, entries: &'a [f64], ld: usize) -> Self {
        Matrix { size, entries, ld }
    }

    /// Views columns that stand one behind the other.
    pub fn contiguous(size: usize, entries: &'a [f64]) -> Self {
        Matrix { size, entries, ld: size }
    }

    /// Number of rows and columns.
    pub fn size(&self) -> usize {
        self.size
    }

    /// All entries, column by column: in memory of just their size, which a call has in reserve.
    pub fn to_vec(self) -> Vec<f64> {
        let mut entries = Vec::with_capacity(self.size * self.size);
        for j in 0..self.size {
            entries.extend_from_slice(self.column(j));
        }
        entries
    }

    /// Column `j`.
    #[inline(always)]
    pub fn column(&self, j: usize) -> &'a [f64] {
        &self.entries[j * self.ld..j * self.ld + self.size]
    }

    /// Entry in row `i` and column `j`.
    pub fn at(&self, i: usize, j: usize) -> f64 {
        self.entries[j * self.ld + i]
    }

    /// The block of `size` rows and columns on the diagonal, from component `first` on.
    pub fn block(&self, first: usize, size: usize) -> Matrix<'a> {
        Matrix { size, entries: &self.entries[first * (self.ld + 1)..], ld: self.ld }
    }

    /// Square roots of the diagonal, which is positive.
    pub fn diagonal_roots(&self) -> Vec<f64> {
        (0..self.size).map(|i| self.at(i, i).sqrt()).collect()
    }

    /// Largest diagonal entry.
    pub fn largest_diagonal(&self) -> f64 {
        largest_of((0..self.size).map(|i| self.at(i, i)))
    }

    /// The unit of component `i`, positive: its diagonal entry; where that is nothing beside the largest of
    /// its group of `group` components, this one; `largest` in a group that nothing resists, which no diagonal entry
    /// exceeds.
    pub fn unit(&self, i: usize, group: usize, largest: f64) -> f64 {
        let own = self.at(i, i);
        // Most components pass beside the largest of all, too.
        if own > UNRESISTED * largest {
            return own;
        }
        let unit = self.unit_of_group(i, group, largest);
        if own > UNRESISTED * unit { own } else { unit }
    }

    /// The largest diagonal entry of the group of component `i`, or `otherwise` if that is zero.
    fn unit_of_group(&self, i: usize, group: usize, otherwise: f64) -> f64 {
        let first = i - i % group;
        let largest = largest_of((first..first + group).map(|k| self.at(k, k)));
        if largest > 0.0 { largest } else { otherwise }
    }

    /// The largest diagonal entry of each component's group, or `otherwise` if that is zero.
    pub fn units_of_groups(&self, group: usize, otherwise: f64) -> impl Iterator<Item = f64> {
        (0..self.size).map(move |i| self.unit_of_group(i, group, otherwise))
    }

    /// The units of all components, [`Self::unit`]; those of a group that nothing resists are the largest
    /// diagonal entry of all.
    pub fn units(&self, group: usize) -> Vec<f64> {
        let otherwise = self.largest_diagonal();
        (0..self.size).map(|i| self.unit(i, group, otherwise)).collect()
    }

    /// The largest diagonal entry of each component's group, beside which a host's condensation has rounded. A component
    /// that is coupled to no other one has its own: condensation leaves no such row, it is a spring of the host.
    pub fn units_of_condensation(&self, group: usize) -> Vec<f64> {
        let units = self.units_of_groups(group, self.largest_diagonal()).enumerate();
        let unit = |(i, unit): (usize, f64)| {
            let own = self.at(i, i);
            let is_small = own > 0.0 && own <= FREE * CONDENSATION * unit;
            let is_spring = || self.column(i).iter().enumerate().all(|(j, &k)| j == i || k == 0.0);
            if is_small && is_spring() { own } else { unit }
        };
        units.map(unit).collect()
    }

    /// Adds the product with `x` to `sum`.
    pub fn add_product(&self, x: &[f64], sum: &mut [f64]) {
        pieces([sum], self.reading(), |first, [sum]| {
            self.add_rows_of_product((0, x), first..first + sum.len(), sum);
        });
    }

    /// Adds some rows of the product with `x`, which is that of the columns from `first` on, to `sum`.
    pub fn add_rows_of_product(
        &self,
        (first, x): (usize, &[f64]),
        rows: Range<usize>,
        sum: &mut [f64],
    ) {
        self.by_columns(
            (first, x),
            rows,
            #[inline(always)]
            |x, columns| add_columns(sum, x, columns),
        );
    }

    /// The work of a product.
    fn reading(&self) -> f64 {
        reading(self.size * self.size)
    }

    /// The product of the absolute values of the entries with `size`.
    pub fn magnitude(&self, size: &[f64]) -> Vec<f64> {
        let mut sum = vec![0.0; self.size];
        pieces([&mut sum], self.reading(), |first, [sum]| {
            self.by_columns(
                (0, size),
                first..first + sum.len(),
                #[inline(always)]
                |size, columns| add_sizes(sum, size, columns),
            );
        });
        sum
    }

    /// The product with `x`.
    pub fn product(&self, x: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; self.size];
        self.add_product(x, &mut product);
        product
    }

    /// The product with `x` less `b`.
    pub fn product_less(&self, x: &[f64], b: &[f64]) -> Vec<f64> {
        let mut left = opposite(b);
        self.add_product(x, &mut left);
        left
    }

    /// The product with `x + x_low` less `b`, in twice the precision and rounded once. `x_low` is empty, or
    /// what rounding to doubles has left out of `x`; `terms` is [`Self::magnitude`] of `|x|`.
    ///
    /// Sums are taken on top of a number so large that they do not change its exponent: digits below its
    /// last one go to a second sum. With `n` columns, `u = 2^-53` and where nothing is subnormal, row `i` is
    /// off by `16 u² (n + 2)² (terms[i] + |b[i]|)` at most before it is rounded; where that sum of sizes is
    /// above 2e307 it is not a number. After S. M. Rump, T. Ogita and S. Oishi, *Accurate floating-point
    /// summation, part I*, SIAM J. Sci. Comput. 31 (2008) 189-224.
    pub fn residual(&self, x: &[f64], x_low: &[f64], b: &[f64], terms: &[f64]) -> Vec<f64> {
        self.residual_on(terms, (x, x_low), b).0
    }

    /// [`Self::residual`] and its terms in one pass, where that is as good as two: off by `16 u² (n + 2)²` of
    /// [`Residual::base`] and the norm of `b`, in norm.
    ///
    /// Of a semi-definite matrix `|K_ij| <= sqrt(K_ii K_jj)`, which bounds the terms beforehand. On top of the terms
    /// themselves the sums are taken again where that is no bound, or so far above them that what is lost exceeds the
    /// rounding of the residual.
    pub fn residual_and_terms(&self, x: &[f64], x_low: &[f64], b: &[f64]) -> Residual {
        let mut tops = self.diagonal_roots();
        let sum: f64 = tops.iter().zip(x).map(|(root, x)| root * x.abs()).sum();
        tops.iter_mut().for_each(|root| *root *= 2.0 * sum);
        let (values, terms) = self.residual_on(&tops, (x, x_low), b);
        let lost = (4.0 * UNIT * (x.len() + 2) as f64).powi(2);
        let base = norm(&tops);
        let are_above = terms.iter().zip(&tops).all(|(terms, top)| terms <= top);
        if are_above && lost * (base + norm(b)) <= UNIT * norm(&values).max(norm(b)) {
            return Residual { values, terms, base };
        }
        Residual { values: self.residual(x, x_low, b, &terms), base: norm(&terms), terms }
    }

    /// [`Self::residual`] on top of these bounds on its terms, with the terms.
    fn residual_on(
        &self,
        tops: &[f64],
        (x, x_low): (&[f64], &[f64]),
        b: &[f64],
    ) -> (Vec<f64>, Vec<f64>) {
        let base = |i: usize| base_of_sum(tops[i] + b[i].abs());
        let mut values: Vec<f64> = (0..b.len()).map(|i| base(i) - b[i]).collect();
        let lost = values.iter().enumerate().map(|(i, high)| (base(i) - high) - b[i]);
        let (mut low, mut terms): (Vec<f64>, Vec<f64>) = (lost.collect(), vec![0.0; b.len()]);
        pieces([&mut values, &mut low, &mut terms], self.reading(), |first, [high, low, terms]| {
            let rows = first..first + high.len();
            self.by_columns(
                (0, x),
                rows.clone(),
                #[inline(always)]
                |x, columns| add_twice([&mut *high, &mut *low, &mut *terms], x, columns),
            );
            self.add_rows_of_product((0, x_low), rows.clone(), low);
            for (i, (high, low)) in rows.zip(high.iter_mut().zip(low)) {
                *high = (*high - base(i)) + *low;
            }
        });
        (values, terms)
    }

    /// Visits some rows of the columns with a factor that is not zero, in order and [`AT_ONCE`] at a time, with the widest
    /// vectors that the processor has; the factors are those of the columns from `first` on. What is missing has the
    /// factor 0.
    #[inline(always)]
    fn by_columns(
        &self,
        (first, factors): (usize, &[f64]),
        rows: Range<usize>,
        mut visit: impl FnMut([f64; AT_ONCE], [&'a [f64]; AT_ONCE]),
    ) {
        let column = |j: usize| &self.column(j)[rows.clone()];
        vectorised(
            #[inline(always)]
            || {
                let factors = (first..).zip(factors);
                let mut left = factors.filter(|(_, factor)| **factor != 0.0);
                while let Some((first, &factor)) = left.next() {
                    let (mut some, mut columns) = ([0.0; AT_ONCE], [column(first); AT_ONCE]);
                    some[0] = factor;
                    for (c, (j, &factor)) in (1..AT_ONCE).zip(&mut left) {
                        (some[c], columns[c]) = (factor, column(j));
                    }
                    visit(some, columns);
                }
            },
        );
    }
}

/// Columns and rows of square tiles, on and below the diagonal of a square matrix: what stands across the diagonal of one is
/// read from cache.
pub fn tiles(size: usize) -> impl Iterator<Item = (Range<usize>, Range<usize>)> {
    let from = move |first: usize| (first..size).step_by(BLOCK);
    let range = move |first: usize| first..size.min(first + BLOCK);
    from(0).flat_map(move |column| from(column).map(move |row| (range(column), range(row))))
}

/// A number that sums of terms whose sizes sum up to `size` change by less than a third, however they are
/// rounded, so that its exponent stays: 12 to 24 times the power of two below `size`.
fn base_of_sum(size: f64) -> f64 {
    let exponent = f64::INFINITY.to_bits();
    12.0 * f64::from_bits(size.max(f64::MIN_POSITIVE).to_bits() & exponent)
}

/// Entries that a column-major matrix of `size` rows and columns has to the end of its last column.
///
/// # Errors
/// A sentence, if the leading dimension `ld` is less than `max(1, size)` or absurd.
pub fn required_length(name: &str, size: usize, ld: usize) -> Result<usize, String> {
    let least = size.max(1);
    if ld < least {
        return Err(format!(
            "the leading dimension of {name} is {ld}, it must be at least {least}"
        ));
    }
    let begin_of_last = size.saturating_sub(1).checked_mul(ld);
    begin_of_last
        .and_then(|begin| begin.checked_add(size))
        .ok_or_else(|| format!("the leading dimension of {name} is {ld}: the matrix cannot exist"))
}

/// `true` if a square matrix of `size` rows fits the address space.
pub fn can_exist(size: usize) -> bool {
    size.checked_mul(size).is_some_and(|entries| entries <= isize::MAX as usize / size_of::<f64>())
}

#[cfg(test)]
mod tests {
    use super::can_exist;

    /// 2^30 rows of as many doubles are 2^63 bytes, one more than the language has for an array.
    #[test]
    fn no_matrix_is_larger_than_half_of_all_addresses() {
        assert!(can_exist((1 << 30) - 1) && !can_exist(1 << 30) && !can_exist(usize::MAX));
    }
}
