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
//! % Written by signorini 0.2.0 in the units of the host.
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

mod law;
mod lines;
mod read;
mod vtu;
mod write;

use std::path::Path;

use crate::error::Error;
use crate::problem::ContactData;

pub use law::Law;
pub use read::{memory, read};
pub use vtu::{Field, Mesh, Values, nodes_of_type, write_vtu};
pub use write::{write, write_lcp};

/// What every problem file begins with, up to case and space.
const BANNER: &str = "%%MatrixMarket matrix array real general";
/// The comment that tells a problem file from other matrices, followed by the version.
const TITLE: &str = "signorini problem";
/// The version of the format that is written.
const VERSION: &str = "2";
/// The version before it, which is read too: the kind is the law, or `lcp`.
const OLD_VERSION: &str = "1";
/// Most bytes of a remark.
const MOST_REMARK: usize = 1000;

/// The kind of a problem.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A contact problem with its friction law.
    Contact(Law),
    /// A linear complementarity problem.
    Lcp,
}

/// A problem that was read from a file. Its numbers are finite (a gap may be `+inf`) and its arrays
/// have the lengths that they must have; other checks are made when the problem is solved.
#[derive(Clone, Debug, PartialEq)]
pub struct ProblemFile {
    /// What it is.
    pub kind: Kind,
    /// 2 or 3; 0 of an LCP.
    pub dim: usize,
    /// Contact pairs; 0 of an LCP.
    pub pairs: usize,
    /// Unknowns, `dim * pairs` or those of the LCP.
    pub size: usize,
    /// `K` or `M`, `size` columns, column-major with leading dimension `size`.
    pub matrix: Vec<f64>,
    /// `f` or `q`, `size`.
    pub load: Vec<f64>,
    /// Gaps, `pairs`.
    pub gap: Vec<f64>,
    /// Parameters of the friction law pair by pair, one or three for each; none if frictionless.
    pub friction: Vec<f64>,
    /// Reference slip, `(dim - 1) * pairs`.
    pub reference_slip: Vec<f64>,
    /// Covering vector of an LCP, if there is one.
    pub covering: Option<Vec<f64>>,
    /// The remark stored in the file; may be empty.
    pub remark: String,
}

impl ProblemFile {
    /// The contact problem, not yet checked; `None` of an LCP.
    pub fn contact(&self) -> Option<ContactData<'_>> {
        let law = match self.kind {
            Kind::Contact(law) => law.with(&self.friction),
            Kind::Lcp => return None,
        };
        Some(ContactData {
            dim: self.dim,
            pairs: self.pairs,
            stiffness: &self.matrix,
            ld: self.size.max(1),
            load: &self.load,
            gap: &self.gap,
            law,
            reference_slip: Some(&self.reference_slip),
        })
    }
}

/// An error about a file. Of a long path the end is shown, so that what is wrong stays in sight; control
/// characters, which would break the line of the message, are shown as '?'.
fn refuse(path: &Path, line: Option<u64>, what: &str) -> Error {
    const MOST: usize = 160;
    let path = path.to_string_lossy().replace(char::is_control, "?");
    let count = path.chars().count();
    let shown: String = match count.checked_sub(MOST) {
        Some(cut) if cut > 0 => "...".chars().chain(path.chars().skip(cut)).collect(),
        _ => path,
    };
    let message = match line {
        Some(line) => format!("{shown}: line {line}: {what}"),
        None => format!("{shown}: {what}"),
    };
    Error::File(message.into())
}

/// What the system says of a file that cannot be read or written.
fn failed(path: &Path, what: &str, error: &std::io::Error) -> Error {
    match error.kind() {
        std::io::ErrorKind::OutOfMemory => Error::OutOfMemory("the name of a file"),
        _ => refuse(path, None, &format!("cannot be {what}: {error}")),
    }
}
