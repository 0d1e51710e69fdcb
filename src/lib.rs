//! Unilateral contact with friction for existing finite-element codes.
//!
//! Most hosts call the C interface, `include/signorini.h`. This is the same library for Rust.
//!
//! For `n` contact pairs in dimension `D`, ordered pair by pair as (n, t) or (n, t1, t2):
//!
//! ```text
//! K d = f + F                                            equilibrium
//! d_n <= gap,  F_n <= 0,  (d_n - gap) F_n = 0            unilateral contact
//! |F_t| <= mu |F_n|,  d_t = slip0 inside the cone,       Coulomb friction
//! d_t - slip0 = -lambda F_t, lambda >= 0, on it
//! ```
//!
//! `K` is the stiffness condensed on the contact components, symmetric and positive definite or
//! semi-definite; `n` is the body's outward normal, `F_n < 0` presses; `slip0` is the reference slip,
//! the `d_t` at which a sticking pair stays; units are the caller's. [`FrictionLaw`] has the other laws:
//! none, Tresca's, cohesion with tension, and orthotropic friction in 3D.
//!
//! [`solve`] solves one condensed problem. A [`Model`] reduces a sparse matrix or condensed bodies once,
//! solves many load cases, and recovers the displacements of the host. [`solve_lcp`] solves a linear
//! complementarity problem.
//!
//! # Guarantees
//!
//! - [`Status::Solved`]: the certificate ([`certificate::certify`]) has measured `eta` at or below the
//!   tolerance on the data as given. It is computed after the solver has ended; the solver's own
//!   convergence test plays no part.
//! - [`Status::NoEquilibrium`]: the motion in [`Solution::recession`] has passed
//!   [`certificate::is_escape`], which tests it on the data as given.
//! - [`Existence::Proved`], on request ([`Settings::proof`]): the data, each double taken for the real number
//!   that it is, have a solution with these states, within the radii given. All rounding is bounded.
//! - [`Uniqueness::Unique`] and [`Uniqueness::Several`] follow from a criterion or from a second certified
//!   solution; otherwise it is [`Uniqueness::NotKnown`].
//! - Changing the units of length and force changes the units of the answer and nothing else.
//! - The same input gives the same bits on the same machine.
//!
//! All of this is double precision: CHANGELOG.md lists what is known beyond which condition numbers.
//!
//! # Example
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
//!
//! # References
//!
//! "The paper", with the number of an equation or section, is
//!
//! - F. Lebon, M. Raous (CNRS, Laboratoire de Mécanique et d'Acoustique and GRECO G.D.E., Marseille) and
//!   D. Boulegues (Technicatome, Les Milles): *Contact with friction modeling for the study of a bolted
//!   junction*. The copy at hand names neither year nor journal; its references go up to 1985.
//!
//! Others are cited by author and year:
//!
//! - P. Alart and A. Curnier: *A mixed formulation for frictional contact problems prone to Newton like
//!   solution methods*. Computer Methods in Applied Mechanics and Engineering 92 (1991) 353–375.
//! - J. L. Blue: *A portable Fortran program to find the Euclidean norm of a vector*. ACM Transactions on
//!   Mathematical Software 4 (1978) 15–23.
//! - D. G. Christopherson: *A new mathematical method for the solution of film lubrication problems*.
//!   Proceedings of the Institution of Mechanical Engineers 146 (1941) 126–135.
//! - R. W. Cottle, J.-S. Pang and R. E. Stone: *The Linear Complementarity Problem*. Academic Press, 1992.
//! - C. W. Cryer: *The solution of a quadratic programming problem using systematic overrelaxation*. SIAM
//!   Journal on Control 9 (1971) 385–392.
//! - J. J. Júdice and F. M. Pires: *A block principal pivoting algorithm for large-scale strictly monotone
//!   linear complementarity problems*. Computers & Operations Research 21 (1994) 587–596.
//! - A. Klarbring: *A mathematical programming approach to three-dimensional contact problems with
//!   friction*. Computer Methods in Applied Mechanics and Engineering 58 (1986) 175–200.
//! - A. Klarbring: *Examples of non-uniqueness and non-existence of solutions to quasistatic contact
//!   problems with friction*. Ingenieur-Archiv 60 (1990) 529–541.
//! - C. L. Lawson and R. J. Hanson: *Solving Least Squares Problems*. Prentice-Hall, 1974.
//! - C. E. Lemke: *Bimatrix equilibrium points and mathematical programming*. Management Science 11 (1965)
//!   681–689.
//! - K. G. Murty: *Note on a Bard-type scheme for solving the complementarity problem*. Opsearch 11 (1974)
//!   123–130.
//! - B. N. Parlett: *The Symmetric Eigenvalue Problem*. Prentice-Hall, 1980.
//! - S. M. Robinson: *Normal maps induced by linear transformations*. Mathematics of Operations Research 17
//!   (1992) 691–714.
//! - D. M. Young: *Iterative Solution of Large Linear Systems*. Academic Press, 1971.

#[cfg(not(target_pointer_width = "64"))]
compile_error!("signorini needs 64 bits");

#[forbid(unsafe_code)]
pub mod certificate;
#[cfg(not(feature = "counters"))]
mod counters;
#[cfg(feature = "counters")]
pub mod counters;
#[forbid(unsafe_code)]
mod error;
// The only room that may: pointers of C.
mod ffi;
#[forbid(unsafe_code)]
pub mod file;
#[forbid(unsafe_code)]
pub mod law;
#[forbid(unsafe_code)]
mod linalg;
#[forbid(unsafe_code)]
mod model;
#[forbid(unsafe_code)]
mod monitor;
#[forbid(unsafe_code)]
mod problem;
#[forbid(unsafe_code)]
pub mod reduce;
#[forbid(unsafe_code)]
mod settings;
#[forbid(unsafe_code)]
mod shortage;
#[forbid(unsafe_code)]
mod solve;
#[forbid(unsafe_code)]
pub mod surface;
#[forbid(unsafe_code)]
mod workers;

pub use error::{Argument, Error, Limit, Message};
pub use law::State;
pub use model::{LoadCase, Model, ModelKind, Series, Starts};
pub use monitor::{Monitor, Progress, ProgressFn, Stop};
pub use problem::{
    ContactData, ContactProblem, Dependence, Flexibility, FlexibilityData, FlexibilityProblem,
    FrictionLaw, Lcp, Relation, Residual, Stiffness,
};
pub use settings::{Method, Search, Settings};
pub use solve::{
    Errors, Escape, Existence, Fallback, LcpSolution, Remarks, SecondSolution, Solution, Status,
    Uniqueness, memory, memory_flexibility, solve, solve_flexibility, solve_lcp,
};
pub use workers::{Workers, with_workers};
