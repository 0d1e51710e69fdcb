//! The data of a contact problem, as a caller hands them over.

use super::friction_law::FrictionLaw;

/// The caller's arrays, not yet checked. Forces and displacements are in the caller's units.
#[derive(Clone, Copy, Debug)]
pub struct ContactData<'a> {
    /// Space dimension, 2 or 3.
    pub dim: usize,
    /// Number of contact pairs, 0 allowed.
    pub pairs: usize,
    /// `K`, `dim * pairs` columns of the same number of rows, column-major.
    pub stiffness: &'a [f64],
    /// Entries from the beginning of one column of `stiffness` to that of the next.
    pub ld: usize,
    /// `f`, the condensed nodal loads, `dim * pairs`.
    pub load: &'a [f64],
    /// Initial gaps, `pairs`; negative: interference, `+inf`: the pair never touches.
    pub gap: &'a [f64],
    /// The friction law.
    pub law: FrictionLaw<'a>,
    /// Reference slip `slip0`: the tangential displacement of each pair at which its friction carries
    /// no memory of a slip, `(dim - 1) * pairs`; `None` is zero (the paper's total law).
    pub reference_slip: Option<&'a [f64]>,
}
