//! The problems that solvers see: contact in relative displacements, and linear complementarity.

mod bodies;
mod bounded_lcp;
mod contact;
mod dependent_rows;
mod flexibility;
mod friction_law;
mod islands;
mod lcp;
mod relation;
mod sparse_flexibility;
pub(crate) mod symmetric_matrix;

pub(crate) use bodies::{Bodies, GoesOn, Restriction, Unformed};
pub(crate) use bounded_lcp::BoundedLcp;
pub use contact::{ContactData, ContactProblem};
pub(crate) use contact::{checked_dim, unknowns};
pub use dependent_rows::Dependence;
pub(crate) use dependent_rows::DependentRows;
pub use flexibility::{Flexibility, FlexibilityData, FlexibilityProblem};
pub use friction_law::FrictionLaw;
pub use lcp::Lcp;
pub(crate) use relation::Redundant;
pub use relation::{Relation, Stiffness};
pub use sparse_flexibility::SparseFlexibilityProblem;
