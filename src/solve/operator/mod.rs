//! Contact on bodies whose stiffness `K_rel` is never formed: Newton's method on the normal map
//! (`law::normal_map`) with products and solutions only (D. A. Knoll and D. E. Keyes, *Jacobian-free
//! Newton-Krylov methods*, J. Comput. Phys. 193 (2004) 357-397, for the family).
//!
//! A step is a system that GMRES solves (`system`) on a factor that serves several steps (`session`). Where Newton's
//! method fails, the balance of free motions is asked (`free_motions`), then the pairs that may touch are condensed
//! into a dense problem (`condensed`), and where that is too large, the thresholds of friction are given one after the
//! other (`thresholds`).

mod case;
mod condensed;
mod directions;
mod free_motions;
mod memory;
mod newton;
mod past;
mod point;
mod session;
mod system;
mod thresholds;

pub use case::{Case, certify, solve};
pub use memory::memory_of_case;
pub use past::CasePast;
