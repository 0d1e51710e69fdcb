//! Linear algebra: the only room that names faer, nalgebra and the SIMD kernels.

pub(crate) mod dense;
pub(crate) mod direct;
pub(crate) mod kernels;
pub(crate) mod small;
pub(crate) mod sparse;
