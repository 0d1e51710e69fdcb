//! The data that change from load case to load case.

use crate::problem::FrictionLaw;

/// One load case: nodal loads of the host and the contact data of each pair.
#[derive(Clone, Copy, Debug)]
pub struct LoadCase<'a> {
    /// Nodal loads, [`crate::Model::host_size`].
    pub load: &'a [f64],
    /// Values of the fixed degrees of freedom, in their order; `None`: zero.
    pub prescribed: Option<&'a [f64]>,
    /// Gaps of the pairs.
    pub gap: &'a [f64],
    /// Friction of the pairs.
    pub law: FrictionLaw<'a>,
    /// Reference slip `d_t0`, `dim - 1` for each pair: the tangential displacement at which
    /// a sticking pair stays. `None`: zero.
    pub reference_slip: Option<&'a [f64]>,
}
