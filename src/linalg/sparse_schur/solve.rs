//! Solves with the factor of the eliminated unknowns.

use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::{Accum, MatMut, MatRef, Par};

use super::super::small_products::by_rows;
use super::structure::Structure;
use crate::linalg::watched::GoesOn;

/// Values of a factor that are read, once for each column, between two questions whether to go on: some milliseconds.
const READ: usize = 1 << 22;

/// Overwrites each column of `x`, in the order of elimination, with `L⁻¹` of its eliminated part; the kept
/// part `c` becomes `c - B A⁻¹ a`. The factor is read once for all columns, and not where they all are zero, as
/// away from loads on few nodes. `None` where `goes_on` says no.
pub fn forward(
    structure: &Structure,
    values: &[f64],
    x: &mut [f64],
    goes_on: GoesOn<'_>,
) -> Option<()> {
    let mut x = columns_of(structure, x);
    let (mut product, mut read) = (Vec::new(), 0);
    for s in 0..structure.panels() {
        ask_now_and_then(&mut read, structure.values(s).len() * x.ncols(), goes_on)?;
        let (columns, rows) = (structure.columns(s), structure.rows(s));
        let (top, below) = structure.blocks(s, &values[structure.values(s)]);
        let mut part = x.as_mut().subrows_mut(columns.start, columns.len());
        if part.as_ref().col_iter().all(|column| column.iter().all(|entry| *entry == 0.0)) {
            continue;
        }
        solve_lower_triangular_in_place(top, part.as_mut(), Par::Seq);
        let many = part.ncols();
        product.clear();
        product.resize(rows.len() * many, 0.0);
        let target = MatMut::from_column_major_slice_mut(&mut product, rows.len(), many);
        matmul(target, Accum::Replace, below, part.as_ref(), 1.0, Par::Seq);
        for (k, product) in product.chunks_exact(rows.len().max(1)).enumerate() {
            let mut column = x.as_mut().col_mut(k);
            rows.iter().zip(product).for_each(|(&row, product)| column[row] -= product);
        }
    }
    Some(())
}

/// Overwrites the eliminated part of each column of `x` by `L⁻ᵀ (x - B'ᵀ d)`, with `B'` the rows of the factor
/// that are kept and `d` the kept part of the column, which stays. `None` where `goes_on` says no.
pub fn backward(
    structure: &Structure,
    values: &[f64],
    x: &mut [f64],
    goes_on: GoesOn<'_>,
) -> Option<()> {
    let mut x = columns_of(structure, x);
    let (mut gathered, mut work): (Vec<f64>, _) = (Vec::new(), Vec::new());
    let mut read = 0;
    for s in (0..structure.panels()).rev() {
        ask_now_and_then(&mut read, structure.values(s).len() * x.ncols(), goes_on)?;
        let (columns, rows) = (structure.columns(s), structure.rows(s));
        let (top, below) = structure.blocks(s, &values[structure.values(s)]);
        gathered.clear();
        for &row in rows {
            gathered.extend(x.as_ref().row(row).iter());
        }
        let part = x.as_mut().subrows_mut(columns.start, columns.len());
        let known = MatRef::from_row_major_slice(&gathered, rows.len(), part.ncols());
        by_rows(part, &mut work, |mut part| {
            matmul(part.as_mut(), Accum::Add, below.transpose(), known, -1.0, Par::Seq);
            solve_upper_triangular_in_place(top.transpose(), part, Par::Seq);
        });
    }
    Some(())
}

/// Counts what is read next, and asks where it is much; `None` where the answer is no.
fn ask_now_and_then(read: &mut usize, next: usize, goes_on: GoesOn<'_>) -> Option<()> {
    *read += next;
    if *read < READ {
        return Some(());
    }
    *read = 0;
    goes_on().then_some(())
}

/// Vectors of all unknowns that stand one behind the other, as columns.
fn columns_of<'x>(structure: &Structure, x: &'x mut [f64]) -> MatMut<'x, f64> {
    let many = x.len() / structure.size.max(1);
    MatMut::from_column_major_slice_mut(x, structure.size, many)
}
