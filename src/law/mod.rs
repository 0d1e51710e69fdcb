//! The law of a contact pair: the only room that knows what open, stick and slip are, which sign a
//! penetration has, and that a pair without an obstacle has an infinite gap.
//!
//! One file for one notion: a friction law is a [`Bound`] on the tangential force
//! (`friction`), with a tension that the pair may carry and, if it is not isotropic, an [`Ellipse`]; all else
//! is the same for every law:
//!
//! | file | what it gives | who uses it |
//! |---|---|---|
//! | `gauge` | what the bound limits, and the scale of slips | all below, Newton's method in space |
//! | `natural_map` | how far a displacement and a force are from the law | certificate |
//! | `normal_map` | `y -> (v, P)`, the chart on which the law is one function | pieces, Newton's method |
//! | `piece` | which smooth piece of the normal map a point is on | all methods, uniqueness |
//! | `piece_map` | the map on a piece that is given: push, derivative, boundaries; can a pair be held on it? | Newton's method, the path in space |
//! | `planar_piece` | the boundaries between the pieces in the plane | the linear path |
//! | `slopes`, `assembly` | a pair on its piece to first order, and the system of equations of all pairs | `solve::pieces`, proofs |
//! | `proximal` | the step of one pair in a sweep | sweeps |
//! | `complementarity` | the law as complementarity of non-negative variables | Lemke's method, block pivoting |
//! | `enclosed_piece` | a pair on a piece that is given, with bounds on all that is computed of it | proofs that a solution exists |
//! | `drawn` | points of the law at random | `solve::proximal` |
//! | `reach` | which obstacles are too far away to matter | `solve::plan` |
//! | `contradiction` | when normal forces prove that no displacements meet all gaps | `solve::dependent` |
//! | `recession` | what a rigid motion must satisfy to prove that no equilibrium exists | certificate |
//! | `remarks` | data that are legal and look like a mistake; pairs that touch | `solve::plan` |
//!
//! Notation, for one pair: `v = d - (gap, slip0)`, so that `v_n` is the penetration (at most 0 if the
//! law is obeyed) and `delta = v_t` the slip; `P = -F = (p, tau)`, so that `p` is the pressure, and
//! `p' = p + a`, `P' = (p', tau)` with the tension `a` that the pair may carry, 0 but for cohesion. With
//! `k = (k_n, k_t)`, forces per length that only scale,
//!
//! ```text
//! v_n <= 0,  p' >= 0,  v_n p' = 0;   |tau| <= g(p'),  delta = lambda tau, lambda >= 0, zero where |tau| < g(p')
//! y = P' + k v                                                     (Alart and Curnier's trial forces)
//! ```
//!
//! With an ellipse the length of `tau` is its gauge, and `delta` is along its normal at `tau`, or along `tau`.

mod assembly;
mod bound;
pub mod complementarity;
mod contact;
mod contradiction;
mod drawn;
pub mod ellipse;
mod enclosed_piece;
mod friction;
mod gauge;
mod levelled;
mod natural_map;
mod normal_map;
mod pair_law;
mod piece;
mod piece_map;
mod planar_piece;
mod proximal;
mod reach;
mod recession;
mod remarks;
mod slopes;
mod state;

pub use assembly::{Assembly, Unknown};
pub use bound::{Bound, length};
pub use contact::{Contact, references, scale_roots};
pub use contradiction::{
    COUNTS, bounded, exceed_gaps, first_open_tie, first_penetration, first_tension,
    without_friction,
};
pub use ellipse::{Ellipse, Plane, Rule};
pub(crate) use enclosed_piece::{EnclosedPiece, Local};
pub use levelled::LevelledTangents;
pub use natural_map::Violation;
pub(crate) use natural_map::natural_sum;
pub use pair_law::{PairLaw, Vector, by_pairs};
pub use piece::{Boundary, Piece, Tangential};
pub use planar_piece::{PieceExit, Planar};
pub use reach::gaps_within_reach;
pub use recession::{Recession, lift};
pub use remarks::{
    deepest_of_negative_gaps, friction_is_large, passes_gaps, size_of_gaps, touching,
};
pub use slopes::{Linearised, Slopes};
pub use state::State;
