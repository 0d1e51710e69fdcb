//! `Wᵀ A W` of a sparse symmetric `A`, with zeros where only rounding is left.
//!
//! Where the columns of `W` are motions of many degrees of freedom, as those of a rigid body, the terms of an entry may
//! cancel. A diagonal entry that is no larger than the rounding of its terms says that `A` does not resist the motion,
//! which then has no force on any other one: the entries of its row that are rounding too become zero. Left as
//! they are they would pass for a stiffness, or for a negative one.

use super::sparse_matrix::{
    Columns, Csc, OutOfMemory, absolute, both, diagonals, entries, entries_of, from_entries,
    product, product_without_rounding, scale_diagonal, transposed, value_at, whole,
};
use super::tolerances::ROUNDING;
use super::watched::GoesOn;

/// The first `columns` columns of `Wᵀ A W`, in two parts: the lower triangle of their first `columns`
/// rows, and all later rows; `None` where `goes_on` says no. `lower` is the lower triangle of the symmetric `A`.
///
/// With `A = H + Hᵀ`, `H` the lower triangle with half the diagonal, it is `Wᵀ H W` and its transpose:
/// no product needs the upper triangle.
pub fn congruence(
    mut lower: Csc,
    w: &Csc,
    columns: usize,
    goes_on: GoesOn<'_>,
) -> Result<Option<(Csc, Csc)>, OutOfMemory> {
    (0..lower.ncols()).for_each(|j| scale_diagonal(&mut lower, j, 0.5));
    let half = product(&lower, w)?;
    let unresisted = Unresisted::new(&lower, w, &half, columns)?;
    drop(lower);
    if !goes_on() {
        return Ok(None);
    }
    let half = product(&transposed(w)?, &half)?;
    if !goes_on() {
        return Ok(None);
    }
    let mirrored = transposed(&half)?;
    if !goes_on() {
        return Ok(None);
    }
    // Each entry of the product gives one of the lower triangle at the most.
    let (mut leading, mut below) =
        (Columns::with_capacity(half.compute_nnz())?, Columns::default());
    for j in 0..columns {
        for (i, one, other) in both(&half, &mirrored, j, j) {
            let (part, row) =
                if i < columns { (&mut leading, i) } else { (&mut below, i - columns) };
            let value = one + other;
            let rounding = unresisted.is_rounding((i, j), value);
            part.row.push(row);
            part.values.push(if rounding { 0.0 } else { value });
        }
        leading.end_column();
        below.end_column();
    }
    Ok(Some((leading.matrix(columns), below.matrix(w.ncols() - columns))))
}

/// The lower triangle of `Eᵀ A E`, where `E` gives dependents from all others; `None` where `goes_on` says no. `lower` is the lower
/// triangle of the symmetric `A`.
///
/// Where dependents are one rigid body, its motions have no force on any of them but by what joins it to others. Forces `A E`
/// that are rounding become zero one by one, whatever other springs the body has: no combination of its motions meets them.
pub fn without_dependents(
    lower: &Csc,
    e: &Csc,
    goes_on: GoesOn<'_>,
) -> Result<Option<Csc>, OutOfMemory> {
    let forces = product_without_rounding(&whole(lower)?, e)?;
    if !goes_on() {
        return Ok(None);
    }
    let found = product(&transposed(e)?, &forces)?;
    drop(forces);
    if !goes_on() {
        return Ok(None);
    }
    // The mean of both triangles: what rounding is left in a force does no work on motions that do not move its node.
    let mirrored = transposed(&found)?;
    let mut mean = Columns::with_capacity(found.compute_nnz())?;
    for j in 0..found.ncols() {
        for (i, one, other) in both(&found, &mirrored, j, j) {
            mean.row.push(i);
            mean.values.push(one.midpoint(other));
        }
        mean.end_column();
    }
    Ok(Some(mean.matrix(found.nrows())))
}

/// The columns of `W` that `A` resists with no more than rounding.
struct Unresisted {
    /// The place of each column of `W` among them; behind all of them that of the others.
    places: Vec<usize>,
    /// Their columns of `|W|ᵀ |A| |W|`, the sizes of the terms, and an empty one.
    sizes: Csc,
}

impl Unresisted {
    /// Looks among the first `columns` of `W`. `lower` is `H`, and `half` is `H W`.
    fn new(lower: &Csc, w: &Csc, half: &Csc, columns: usize) -> Result<Self, OutOfMemory> {
        // No term of a semi-definite matrix is larger than these roots allow, so that few columns are looked at.
        let roots: Vec<f64> = diagonals(lower).map(|half| (2.0 * half).abs().sqrt()).collect();
        let energy = |j: usize| {
            2.0 * both(w, half, j, 0).map(|(_, motion, force)| motion * force).sum::<f64>()
        };
        let most = |j: usize| {
            entries_of(w, j).map(|(i, value)| value.abs() * roots[i]).sum::<f64>().powi(2)
        };
        let weak: Vec<usize> = (0..columns).filter(|&j| energy(j) < ROUNDING * most(j)).collect();
        let sizes = match weak.is_empty() {
            true => from_entries((w.ncols(), 1), std::iter::empty())?,
            false => sizes_of_terms(lower, w, &weak)?,
        };
        let mut places = vec![weak.len(); w.ncols()];
        for (k, &j) in weak.iter().enumerate() {
            if energy(j).abs() <= ROUNDING * value_at(&sizes, j, k) {
                places[j] = k;
            }
        }
        Ok(Unresisted { places, sizes })
    }

    /// `true` if a `value` of the product belongs to one of the columns, and is rounding.
    fn is_rounding(&self, (i, j): (usize, usize), value: f64) -> bool {
        let size = |row, column: usize| value_at(&self.sizes, row, self.places[column]);
        value.abs() <= ROUNDING * size(i, j).max(size(j, i))
    }
}

/// `|W|ᵀ |A|` times some columns of `|W|`, and an empty column; `lower` is `H`.
fn sizes_of_terms(lower: &Csc, w: &Csc, columns: &[usize]) -> Result<Csc, OutOfMemory> {
    let half = absolute(lower);
    let mirrored = entries(&half).flat_map(|(i, j, value)| [(i, j, value), (j, i, value)]);
    let whole = from_entries((half.nrows(), half.ncols()), mirrored)?;
    let w = absolute(w);
    let some = columns.iter().enumerate();
    let some = some.flat_map(|(k, &j)| entries_of(&w, j).map(move |(i, value)| (i, k, value)));
    let chosen = from_entries((w.nrows(), columns.len() + 1), some)?;
    product(&transposed(&w)?, &product(&whole, &chosen)?)
}
