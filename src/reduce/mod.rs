//! From a host's data to relative displacements of contact pairs, once, and back.
//!
//! A [`Reduction`] gives the stiffness `K_rel` in relative displacements `d`, reduces each load case to
//! relative loads, and turns a solution back into the host's displacements and nodal forces.

mod condensed;
mod driven_motion;
mod equations;
mod flexibility;
mod frame;
mod host_operator;
mod memory;
mod motion;
mod operator;
mod pairs;
mod probes;
mod reduction;
mod sparse;
mod two_body;

pub use condensed::CondensedReduction;
pub(crate) use driven_motion::driven_motion;
pub use equations::Equations;
pub use flexibility::FlexibilityReduction;
pub use host_operator::{Held, HostOperator};
pub use memory::{memory, memory_of_vectors};
pub use operator::OperatorReduction;
pub use pairs::ContactPairs;
pub use reduction::{Condensed, HostLoad, Reduction, SolvedCase};
pub use sparse::{Control, Indices, SparseMatrix, SparseReduction, Triangle};
pub use two_body::TwoBodyReduction;
