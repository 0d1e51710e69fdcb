//! The proof that the data have a solution with given states, and where it is.
//!
//! A residual tells how well an answer satisfies the equations. The proof tells more: the data, each double
//! taken for the real number that it is, have a solution whose pairs are in these states, and it is within the
//! given radii. The pieces of the law are frozen, so that the equations are linear, and in space analytic on
//! slips; [`enclosure`] shows that they have a zero next to the answer, and that it keeps every pair clear of
//! the boundaries of its piece. Every rounding is bounded.
//!
//! It may fail: where a pair is on the boundary of two pieces, where the matrix of the pieces is singular
//! or ill-conditioned (the number of unknowns times the condition number must be well below 1e16), or where the
//! states are not those of a solution. Failure proves nothing.

mod enclosure;
mod forces;
mod prove;
mod system;

pub use prove::{Proof, prove};
pub(crate) use prove::{errors, prove_parts};
