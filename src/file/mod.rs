//! Problem files: a problem as it goes to a solver, to be mailed and replayed.
//!
//! A problem file is a Matrix Market file, `matrix array real general`, which every reader of that
//! format takes for one dense matrix. Comment lines say what it is:
//!
//! ```text
//! %%MatrixMarket matrix array real general
//! % signorini problem 1
//! % kind: coulomb
//! % dim: 2
//! % pairs: 2
//! % remark: step 7 of the crane hook
//! % Written by signorini 0.1.0 in the units of the host.
//! % Columns: K (4), f, gap and mu in normal rows, slip in tangential rows.
//! 4 8
//! 4e0
//! ...
//! ```
//!
//! The lines after the last comment are the numbers of rows and columns, then the entries column by
//! column, one a line, with as many digits (17 at most) as give back the same bits. With
//! `N = dim * pairs` rows the columns are `K` (N of them), `f`, `gap` and `mu` (kind `tresca`: `g`),
//! which stand in the normal row of each pair, and `slip`, which stands in the tangential rows;
//! other rows are 0. Of kind `lcp` they are `M` (n columns), `q` and, if given, the
//! covering vector. A gap of a pair that never touches is `inf`, the one spelling that all of the
//! readers that were tried take. Other comment lines are skipped.
//!
//! The other open format of the field, FCLIB's, holds the flexibility matrix (Delassus), which does
//! not exist for bodies held by nothing but contact, and needs the HDF5 library.

mod lines;
mod read;
mod write;

use std::path::Path;

use crate::error::Error;
use crate::problem::{ContactData, FrictionLaw};

pub use read::read;
pub use write::{write, write_lcp};

/// What every problem file begins with, up to case and space.
const BANNER: &str = "%%MatrixMarket matrix array real general";
/// The comment that tells a problem file from other matrices, followed by the version.
const TITLE: &str = "signorini problem";
/// The version of the format.
const VERSION: &str = "1";
/// Most bytes of a remark.
const MOST_REMARK: usize = 1000;

/// The kind of a problem.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Contact with Coulomb friction.
    Coulomb,
    /// Contact with given thresholds of friction.
    Tresca,
    /// A bare linear complementarity problem.
    Lcp,
}

impl Kind {
    const ALL: [Kind; 3] = [Kind::Coulomb, Kind::Tresca, Kind::Lcp];

    /// Its name in a file.
    fn name(self) -> &'static str {
        match self {
            Kind::Coulomb => "coulomb",
            Kind::Tresca => "tresca",
            Kind::Lcp => "lcp",
        }
    }
}

/// A problem that was read from a file. Its numbers are finite (a gap may be `+inf`) and its arrays
/// have the lengths that they must have; all else is checked by whom it is handed to.
#[derive(Clone, Debug, PartialEq)]
pub struct ProblemFile {
    /// What it is.
    pub kind: Kind,
    /// 2 or 3; 0 of a bare complementarity problem.
    pub dim: usize,
    /// Contact pairs; 0 of a bare complementarity problem.
    pub pairs: usize,
    /// Unknowns, `dim * pairs` or those of the bare problem.
    pub size: usize,
    /// `K` or `M`, `size` columns, column-major, without space between them.
    pub matrix: Vec<f64>,
    /// `f` or `q`, `size`.
    pub load: Vec<f64>,
    /// Gaps, `pairs`.
    pub gap: Vec<f64>,
    /// Friction coefficients or thresholds, `pairs`.
    pub friction: Vec<f64>,
    /// Tangential displacement at rest, `(dim - 1) * pairs`.
    pub slip: Vec<f64>,
    /// Covering vector of a bare complementarity problem, if there is one.
    pub covering: Option<Vec<f64>>,
    /// What its sender says; may be empty.
    pub remark: String,
}

impl ProblemFile {
    /// The contact problem, not yet checked; `None` of a bare complementarity problem.
    pub fn contact(&self) -> Option<ContactData<'_>> {
        let friction = match self.kind {
            Kind::Coulomb => FrictionLaw::Coulomb(&self.friction),
            Kind::Tresca => FrictionLaw::Tresca(&self.friction),
            Kind::Lcp => return None,
        };
        Some(ContactData {
            dim: self.dim,
            pairs: self.pairs,
            stiffness: &self.matrix,
            ld: self.size.max(1),
            load: &self.load,
            gap: &self.gap,
            law: friction,
            reference_slip: Some(&self.slip),
        })
    }
}

/// An error about a file. Of a long path the end is shown, so that what is wrong stays in sight.
fn refuse(path: &Path, line: Option<u64>, what: &str) -> Error {
    const MOST: usize = 160;
    let path = path.to_string_lossy();
    let count = path.chars().count();
    let shown: String = match count.checked_sub(MOST) {
        Some(cut) if cut > 0 => "...".chars().chain(path.chars().skip(cut)).collect(),
        _ => path.into_owned(),
    };
    let message = match line {
        Some(line) => format!("{shown}: line {line}: {what}"),
        None => format!("{shown}: {what}"),
    };
    Error::File(message.into())
}
