//! Linear algebra: the only room that names faer, nalgebra and the SIMD kernels.
//! It knows nothing of mechanics.

pub(crate) mod approximate_inverse;
pub(crate) mod ball;
pub(crate) mod columns;
pub(crate) mod congruence;
pub(crate) mod conjugate_gradients;
pub(crate) mod definite;
pub(crate) mod dense;
pub(crate) mod double_double;
pub(crate) mod eigen;
pub(crate) mod elimination;
pub(crate) mod factor;
pub(crate) mod free_motions;
pub(crate) mod gmres;
pub(crate) mod last_case;
pub(crate) mod least_squares;
pub(crate) mod matrix;
pub(crate) mod memory;
pub(crate) mod nnls;
pub(crate) mod packed;
pub(crate) mod perturbation;
pub(crate) mod pivoted_cholesky;
pub(crate) mod power_of_two;
pub(crate) mod products;
pub(crate) mod row_elimination;
pub(crate) mod simd;
pub(crate) mod small_products;
pub(crate) mod sparse_matrix;
pub(crate) mod sparse_schur;
mod symmetry;
pub(crate) mod tolerances;
pub(crate) mod vector;
pub(crate) mod vector3;
pub(crate) mod watched;
