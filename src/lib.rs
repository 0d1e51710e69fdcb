//! Unilateral contact with Coulomb friction for existing finite-element codes.
//!
//! Most hosts call the C interface, `include/signorini.h`. This is the same library for Rust.
//!
//! For `n` contact pairs in dimension `D`, ordered pair by pair as (n, t) or (n, t1, t2):
//!
//! ```text
//! K d = f + F                                            equilibrium
//! d_n <= gap,  F_n <= 0,  (d_n - gap) F_n = 0            unilateral contact
//! |F_t| <= mu |F_n|,  d_t = slip inside the cone,        Coulomb friction
//! d_t - slip = -lambda F_t, lambda >= 0, on it
//! ```
//!
//! `K` is the stiffness condensed on the contact components, symmetric and positive definite or
//! semi-definite; `n` is the body's outward normal, `F_n < 0` presses; units are the caller's.
//!
//! Guarantees: [`Status::Solved`] means that [`certificate::certify`] measured `eta` at or below the
//! tolerance on the data as given. [`Status::NoEquilibrium`] means that the returned motion passed
//! [`certificate::is_escape`]. No solver's own opinion enters. Changing the units of length and
//! force changes nothing but the units of the answer.
//!
//! ```
//! use signorini::{ContactData, ContactProblem, FrictionLaw, Monitor, Settings, State, Status, solve};
//!
//! // One pair pressed on a plane by 2 and pushed along it by 1.
//! let problem = ContactProblem::new(ContactData {
//!     dim: 2,
//!     pairs: 1,
//!     stiffness: &[4.0, 1.0, 1.0, 4.0],
//!     ld: 2,
//!     load: &[2.0, 1.0],
//!     gap: &[0.0],
//!     law: FrictionLaw::Coulomb(&[0.3]),
//!     reference_slip: None,
//! })?;
//! let settings = Settings::default();
//! let solution = solve(&problem, &settings, None, &mut Monitor::new(&settings, None))?;
//! assert_eq!(solution.status, Status::Solved);
//! assert_eq!(solution.certificate.states, [State::Slip]);
//! // Sliding: 4 d_t = 1 - 0.3 p with p = 2 - d_t.
//! assert!((solution.d[1] - 0.4 / 3.7).abs() < 1e-9);
//! # Ok::<(), signorini::Error>(())
//! ```

pub mod certificate;
mod error;
mod ffi;
pub mod file;
pub mod law;
mod linalg;
mod model;
mod monitor;
mod problem;
pub mod reduce;
mod settings;
mod solve;

pub use error::{Argument, Error, Message};
pub use law::State;
pub use model::{LoadCase, Model};
pub use monitor::{Monitor, Progress, ProgressFn, Stop};
pub use problem::{ContactData, ContactProblem, FrictionLaw, Lcp, Relation, Stiffness};
pub use settings::{Method, Search, Settings};
pub use solve::{
    Fallback, LcpSolution, SecondSolution, Solution, Status, Uniqueness, solve, solve_lcp,
};
