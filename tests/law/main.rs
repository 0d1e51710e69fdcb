//! The friction laws: what a pair may do, piece by piece, against the statement of each law.

#[path = "../common/mod.rs"]
mod common;
#[path = "../common/laws.rs"]
#[allow(dead_code)] // Each test uses a part.
mod laws;

mod boundaries;
mod by_pair;
mod drawn;
mod ellipse;
mod friction_laws;
mod levelled;
mod pieces;
mod planar;
mod remarks;
mod rounding;
mod statement;
mod ties;
mod uses;
mod values;
