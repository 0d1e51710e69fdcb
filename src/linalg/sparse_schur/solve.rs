//! Solves with the factor of the eliminated unknowns.

use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::{Accum, MatMut, MatRef, Par};

use super::structure::Structure;

/// Overwrites `x`, in the order of elimination, with `L⁻¹` of its eliminated part; the kept part `c` becomes
/// `c - B A⁻¹ a`.
pub fn forward(structure: &Structure, values: &[f64], x: &mut [f64]) {
    let mut product = Vec::new();
    for s in 0..structure.panels() {
        let (columns, rows) = (structure.columns(s), structure.rows(s));
        let width = columns.len();
        let (top, below) = blocks(structure, values, s);
        let mut part = MatMut::from_column_major_slice_mut(&mut x[columns], width, 1);
        solve_lower_triangular_in_place(top, part.as_mut(), Par::Seq);
        product.clear();
        product.resize(rows.len(), 0.0);
        let target = MatMut::from_column_major_slice_mut(&mut product, rows.len(), 1);
        matmul(target, Accum::Replace, below, part.as_ref(), 1.0, Par::Seq);
        rows.iter().zip(&product).for_each(|(&row, product)| x[row] -= product);
    }
}

/// Overwrites the eliminated part of `x` by `L⁻ᵀ (x - B'ᵀ d)`, with `B'` the rows of the factor that are
/// kept and `d` the kept part of `x`, which stays.
pub fn backward(structure: &Structure, values: &[f64], x: &mut [f64]) {
    let mut gathered = Vec::new();
    for s in (0..structure.panels()).rev() {
        let (columns, rows) = (structure.columns(s), structure.rows(s));
        let width = columns.len();
        let (top, below) = blocks(structure, values, s);
        gathered.clear();
        gathered.extend(rows.iter().map(|&row| x[row]));
        let mut part = MatMut::from_column_major_slice_mut(&mut x[columns], width, 1);
        let known = MatRef::from_column_major_slice(&gathered, rows.len(), 1);
        matmul(part.as_mut(), Accum::Add, below.transpose(), known, -1.0, Par::Seq);
        solve_upper_triangular_in_place(top.transpose(), part, Par::Seq);
    }
}

/// The diagonal block of a panel, and its rows.
fn blocks<'a>(
    structure: &Structure,
    values: &'a [f64],
    s: usize,
) -> (MatRef<'a, f64>, MatRef<'a, f64>) {
    let (width, rows) = (structure.columns(s).len(), structure.rows(s).len());
    let values = &values[structure.values(s)];
    MatRef::from_column_major_slice(values, width + rows, width).split_at_row(width)
}
