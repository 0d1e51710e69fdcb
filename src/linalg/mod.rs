//! Linear algebra: the only room that names faer, nalgebra and the SIMD kernels.

pub(crate) mod dense;
pub(crate) mod direct;
pub(crate) mod kernels;
pub(crate) mod null_vector;
pub(crate) mod small;
pub(crate) mod sparse_matrix;
pub(crate) mod sparse_schur;
pub(crate) mod tolerances;
pub(crate) mod vector3;
pub(crate) mod workspaces;
