//! Springs beside a problem that make an easier one of it, and leave in the end.
//!
//! | file | springs |
//! |---|---|
//! | `let_go` | hold every component of bodies that contact alone holds, softer from problem to problem |
//! | `rounds` | stand in series with the pairs, and are stretched anew in each round: the one loop of `dependent` and `flexibility` |
//! | `dependent` | where rows depend on each other |
//! | `flexibility`, `compliant`, `islands` | where the flexibility form may be singular |
//! | `on_flexibility`, `lone_pair` | none: Newton's method on `W` itself, and on the block of a pair alone |
//! | `drawn` | none: Newton's method from points that are drawn, for a few pairs |
//! | `step`, `growth` | the problem of a round, and forces that grow without end |

mod compliant;
mod dependent;
mod drawn;
mod flexibility;
mod growth;
mod islands;
mod let_go;
mod lone_pair;
mod on_flexibility;
mod rounds;
mod step;

pub use dependent::solve as solve_dependent;
pub use islands::{largest_island, solve as solve_flexibility};
pub use let_go::let_go;
pub use step::Means;
