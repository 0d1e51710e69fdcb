//! A problem that was read from a file.

use super::Law;
use crate::problem::ContactData;

/// The kind of a problem.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Kind {
    /// A contact problem with its friction law.
    Contact(Law),
    /// A linear complementarity problem.
    #[default]
    Lcp,
}

/// A problem that was read from a file. Its numbers are finite (a gap may be `+inf`) and its arrays
/// have the lengths that they must have; other checks are made when the problem is solved.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ProblemFile {
    /// A contact problem with its law, or an LCP.
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
