//! Problem files: serialised contact problems and LCPs, for bug reports and replay. Also meshes with fields
//! for ParaView ([`write_vtu`]).
//!
//! A problem file is a Matrix Market file, `matrix array real general`, which every reader of that
//! format takes for one dense matrix. Comment lines say what it is:
//!
//! ```text
//! %%MatrixMarket matrix array real general
//! % signorini problem 2
//! % kind: contact
//! % law: coulomb
//! % dim: 2
//! % pairs: 2
//! % remark: step 7 of the crane hook
//! % Written by signorini 0.9.0 in the units of the host.
//! % Columns: K (4), f, gap and mu in normal rows, slip0 in tangential rows.
//! 4 8
//! 4e0
//! ...
//! ```
//!
//! The lines after the last comment are the numbers of rows and columns, then the entries column by
//! column, one a line, with as many digits (17 at most) as give back the same bits. With `N = dim *
//! pairs` rows the columns of kind `contact` are `K` (N of them), `f`, `gap`, the parameters of the
//! law, a column each, and the reference slip `slip0`. Gap and parameters stand in the normal row of
//! each pair, `slip0` in its tangential rows; other rows are 0. The laws and their parameters are
//! `frictionless` (none), `coulomb` (mu), `tresca` (g), `cohesive` (mu, b, a), `orthotropic` and
//! `orthotropic-collinear` (mu1, mu2, angle). Of kind `lcp`, which has neither law, dim nor pairs, the columns are `M` (n of them), `q`
//! and, if given, the covering vector. A gap of a pair that never touches is `inf`, the one
//! spelling that all of the readers that were tried take. Other comment lines are skipped.
//!
//! Version 1 of the format is read too. It has no law: its kinds `coulomb` and `tresca` say it.
//!
//! The other open format of the field, FCLIB's, holds the flexibility matrix (Delassus), which does
//! not exist for bodies that only contact supports, and needs the HDF5 library.

mod errors;
mod format;
mod lines;
mod problem_file;
mod read;
mod vtu;
mod write;

pub use crate::problem::Law;
pub use problem_file::{Kind, ProblemFile};
pub use read::{memory, read};
pub use vtu::{Field, Mesh, Values, nodes_of_type, write_vtu};
pub use write::{write, write_lcp};
