//! The data of a condensed contact problem, which several calls receive in the same order.

use super::args::Arrays;
use super::guard::{Outcome, number_of};
use super::law;
use crate::error::Argument::{
    self, Dimension, Gap, Law, LawChoice, LeadingDimension, Load, Matrix, ReferenceSlip, Size,
};
use crate::problem::ContactData;

const ARGUMENTS: [Argument; 9] =
    [Dimension, Size, Matrix, LeadingDimension, Load, Gap, LawChoice, Law, ReferenceSlip];

/// The arguments from `dim` to `slip0`, as the host hands them over.
pub(super) struct CondensedArguments {
    /// Number of `dim` among the arguments of the call; the others follow it.
    pub(super) first: i32,
    pub(super) dim: i32,
    pub(super) pairs: i64,
    pub(super) K: *const f64,
    pub(super) ldk: i64,
    pub(super) f: *const f64,
    pub(super) gap: *const f64,
    pub(super) law: i32,
    pub(super) friction: *const f64,
    pub(super) slip0: *const f64,
}

impl CondensedArguments {
    /// How many they are.
    pub(super) const COUNT: i32 = ARGUMENTS.len() as i32;

    /// The arrays as slices, noted in `arrays`.
    pub(super) fn read<'h>(&self, arrays: &'h Arrays) -> Outcome<ContactData<'h>> {
        let at = |offset, name| arrays.at(self.first + offset, name);
        let (dim, pairs, n) = arrays.sizes(self.first, self.dim, self.pairs)?;
        let (stiffness, ld) = at(2, "K").square(self.K, ("ldk", self.ldk), n)?;
        Ok(ContactData {
            dim,
            pairs,
            stiffness,
            ld,
            load: at(4, "f").required(self.f, n)?,
            gap: at(5, "gap").required(self.gap, pairs)?,
            law: law::read(at(6, "law"), (self.law, self.friction), pairs)?,
            reference_slip: at(8, "slip0").optional(self.slip0, n - pairs)?,
        })
    }

    /// Number of the argument that an error is about; `otherwise` of an argument of the call that
    /// is not here.
    pub(super) fn position(&self, argument: Argument, otherwise: i32) -> i32 {
        number_of(argument, self.first, &ARGUMENTS).unwrap_or(otherwise)
    }
}
