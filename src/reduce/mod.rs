//! From a host's data to relative displacements of contact pairs, once, and back.

mod change;
mod interface;
mod sparse;
mod sparse_matrix;
mod two_body;

pub use interface::ContactPairs;
pub use sparse::SparseReduction;
pub use sparse_matrix::{Indices, SparseMatrix, Triangle};
pub use two_body::TwoBodyReduction;
