//! How good a candidate is, computed from the problem alone, never from a solver's counters.
//!
//! The measure is the residual of the natural map, in forces, relative to the larger of the loads and
//! the contact forces:
//!
//! ```text
//! e_n = K_nn (d_n - min(gap, d_n - F_n / K_nn))                  F = K d - f
//! e_t = K_tt (delta - shrink(delta - F_t / K_tt, g / K_tt))      delta = d_t - slip0
//! eta = |e| / max(|f|, |F|)                                      g = mu max(0, -F_n), or given
//! ```
//!
//! For other laws see `law::natural_map`. A pair that is apart, `K_nn (d_n - gap) <= F_n < 0`, loses its force: where `F_t`
//! beyond `g(0)` is longer than `e_t`, it stands for `e_t`. So `|e|` is not below what the forces that are returned
//! lack to equilibrium.
//!
//! It is zero at solutions only and has no unit. In full space the rounding of the sums of all loads is the least size of
//! forces (`problem/stiffness_operator.rs`). On a relation in which `d` does not determine `F`, the
//! candidate is the pair `(d, F)` and the residual of the relation counts in `|e|` too; `|F|` is the size of
//! the part of `F` that moves anything.
//!
//! Two facts of doubles are taken into account:
//!
//! - A closing gap or an earlier slip may translate or rotate a body rigidly. These displacements
//!   cancel in `K d` up to rounding only. Displacements up to [`LEVER`] times the largest gap or slip qualify: a
//!   body that turns about a contact moves as much more at its far end as its length exceeds the contact's.
//! - Where rounding `d` to doubles changes `K d` by a part of the forces (above [`ROUNDING_LIMIT`])
//!   nothing is certified unless `K` resists `d` by more energy than rounding of its entries explains: a body
//!   that nothing holds would be "solved" by moving it far enough. Without loads there is nothing to drive
//!   such motions, and the first kind does not count.
//!
//! `K d - f` and `d - gap` are evaluated in twice the precision. [`Certificate::residual`] is `eta` plus a bound
//! on the rounding of its own evaluation: it is not below the true `eta`. Forces so small that products have lost
//! their digits are not certified.

mod condensation;
mod escape;
mod measure;
mod proof;
mod spread;
mod units;

pub use escape::is_escape;
pub(crate) use escape::{is_escape_of, lifts};
pub use measure::{Certificate, LEVER, ROUNDING_LIMIT, certify, certify_pair, eta};
pub(crate) use measure::{certify_in_units, eta_of, measure};
pub use proof::{Proof, prove};
pub(crate) use proof::{errors, prove_parts};
pub(crate) use spread::{is_spread_escape, is_unresisted, measure_spread};
