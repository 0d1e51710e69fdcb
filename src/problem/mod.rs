//! The problems that solvers see: contact in relative displacements, and linear complementarity.

mod arguments;
mod bounded_lcp;
mod by_equilibrium;
mod contact;
mod contact_data;
mod dependence;
mod dependent_rows;
mod flexibility;
mod flexibility_form;
mod free_block;
mod friction_law;
mod islands;
mod iterated;
mod law_table;
mod lcp;
mod lcp_certificate;
mod relation;
mod remembered;
mod sparse_flexibility;
mod stiffness_operator;
pub(crate) mod symmetric_matrix;
mod units;

pub use crate::linalg::matrix::Residual;
pub(crate) use arguments::{
    Named, OF_MATRIX, check_count, check_finite, check_finite_matrix, check_gaps, checked_dim,
    dense, unknowns,
};
pub(crate) use bounded_lcp::BoundedLcp;
pub(crate) use by_equilibrium::OfLeastEnergy;
pub use contact::ContactProblem;
pub use contact_data::ContactData;
pub use dependence::Dependence;
pub(crate) use dependent_rows::{DependentRows, NEARLY_DEPENDENT};
pub use flexibility::{Flexibility, FlexibilityData, FlexibilityProblem};
pub use flexibility_form::FlexibilityForm;
pub(crate) use free_block::{FreeBlock, SOLUTIONS};
pub use friction_law::FrictionLaw;
pub(crate) use islands::Islands;
pub(crate) use iterated::iterated;
pub(crate) use law_table::FLATTEST;
pub use law_table::{Law, Parameter};
pub use lcp::Lcp;
pub(crate) use lcp_certificate::LcpCertificate;
pub(crate) use relation::Redundant;
pub use relation::{Relation, Stiffness};
pub(crate) use remembered::Remembered;
pub use sparse_flexibility::SparseW;
pub(crate) use stiffness_operator::{GoesOn, HeldSet, MatrixFree, Solved, StiffnessOperator};
pub(crate) use units::{ChangesUnits, Units, in_units};
