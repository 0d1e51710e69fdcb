//! Sparse Cholesky factorisation of `[A Bᵀ; B C]` that ends before the columns of `C`, and the Schur
//! complement `S = C - B A⁻¹ Bᵀ`, on the threads of `Workers`, with the same bits on any number of them.
//!
//! With `A = L Lᵀ` the factor has the rows `B' = B L⁻ᵀ`, and `S = C - B' B'ᵀ` is accumulated in place. `S` itself is not
//! factorised, so that it may be singular. Loads `(a, c)` become `c - B' y` with `L y = a`; and `Lᵀ x = y - B'ᵀ d` gives
//! the eliminated unknowns.

mod diagnosis;
mod dissection;
mod entries;
mod factor_progress;
mod graph;
mod lists;
mod minimum_degree;
mod numeric;
mod order;
mod panel;
mod panel_assembly;
mod parallel;
mod plan;
mod schedule;
mod schur;
mod schur_update;
mod separator;
mod solve;
mod structure;

pub use factor_progress::{FactorProgress, Failure};
pub use plan::{Plan, Values};
pub use schur::SparseSchur;
