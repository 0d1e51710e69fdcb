//! The data of contact problems, which several calls receive in the same order: of condensed ones, and of load cases of a
//! model.

use super::args::Arrays;
use super::guard::{self, Failure, Outcome};
use super::law;
use crate::error::Argument::{Gap, Load, Matrix, Prescribed, ReferenceSlip};
use crate::model::{LoadCase, Model};
use crate::problem::ContactData;

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
    /// The arrays as slices, noted in `arrays`.
    pub(super) fn read<'h>(&self, arrays: &'h Arrays) -> Outcome<ContactData<'h>> {
        let at = |offset, name| arrays.at(self.first + offset, name);
        let [dim, pairs, n] = arrays.sizes([self.first, self.first + 1], self.dim, self.pairs)?;
        let (stiffness, ld) = at(2, "K").is(Matrix).square(self.K, ("ldk", self.ldk), n)?;
        Ok(ContactData {
            dim,
            pairs,
            stiffness,
            ld,
            load: at(4, "f").is(Load).required(self.f, n)?,
            gap: at(5, "gap").is(Gap).required(self.gap, pairs)?,
            law: law::read((at(6, "law"), self.law), (at(7, "friction"), self.friction), pairs)?,
            reference_slip: at(8, "slip0").is(ReferenceSlip).optional(self.slip0, n - pairs)?,
        })
    }
}

/// The arguments from `f` to `slip0` of a load case, as the host hands them over.
pub(super) struct CaseArguments {
    /// Number of `f` among the arguments of the call; the others follow it.
    pub(super) first: i32,
    pub(super) f: *const f64,
    pub(super) prescribed: *const f64,
    pub(super) gap: *const f64,
    pub(super) law: i32,
    pub(super) friction: *const f64,
    pub(super) slip0: *const f64,
}

impl CaseArguments {
    /// The arrays of `cases` load cases as slices, noted in `arrays`. `memory_limit` is that of the
    /// settings, 0: none.
    pub(super) fn read<'h>(
        &self,
        arrays: &'h Arrays,
        model: &'h Model,
        cases: usize,
        memory_limit: u64,
    ) -> Outcome<LoadCases<'h>> {
        let bytes = model.memory();
        // A case that may need more is refused before it takes anything.
        if memory_limit == 0 || bytes <= memory_limit {
            let explained = |failure: Failure| match model.largest_part() {
                Some(part) => failure.explained(&part),
                None => failure,
            };
            guard::reserve_estimate(bytes).map_err(explained)?;
        }
        guard::reserve_estimate(model.memory_of_cases(cases))?;
        let at = |offset, name| arrays.at(self.first + offset, name);
        let slips = (model.dim() - 1) * model.pairs();
        let (host, fixed) = (times(cases, model.host_size())?, times(cases, model.fixed_count())?);
        let (pairs, slips) = (times(cases, model.pairs())?, times(cases, slips)?);
        let all = LoadCase {
            load: at(0, "f").is(Load).matrix().required(self.f, host)?,
            prescribed: at(1, "prescribed").is(Prescribed).optional(self.prescribed, fixed)?,
            gap: at(2, "gap").is(Gap).required(self.gap, pairs)?,
            law: law::read((at(3, "law"), self.law), (at(4, "friction"), self.friction), pairs)?,
            reference_slip: at(5, "slip0").is(ReferenceSlip).optional(self.slip0, slips)?,
        };
        let cases = LoadCases { model, all };
        guard::reserve_estimate(cases.memory_of_ties())?;
        Ok(cases)
    }
}

/// The data of several load cases, a column for each.
pub(super) struct LoadCases<'a> {
    model: &'a Model,
    all: LoadCase<'a>,
}

impl<'a> LoadCases<'a> {
    /// Most bytes that a case takes beyond [`Model::memory`].
    pub(super) fn memory_of_ties(&self) -> u64 {
        self.model.memory_of_ties(self.all.law)
    }

    /// The load case number `case`.
    pub(super) fn case(&self, case: usize) -> LoadCase<'a> {
        let LoadCases { model, all } = self;
        let (pairs, fixed) = (model.pairs(), model.fixed_count());
        let slips = (model.dim() - 1) * pairs;
        let column = |array: &'a [f64], length: usize| &array[length * case..length * (case + 1)];
        LoadCase {
            load: column(all.load, model.host_size()),
            prescribed: all.prescribed.map(|values| column(values, fixed)),
            gap: column(all.gap, pairs),
            law: all.law.with_values(column(all.law.values(), all.law.parameters() * pairs)),
            reference_slip: all.reference_slip.map(|slip0| column(slip0, slips)),
        }
    }
}

/// `length` for each case.
pub(super) fn times(cases: usize, length: usize) -> Outcome<usize> {
    length
        .checked_mul(cases)
        .ok_or_else(|| Failure::argument(2, format!("cases is {cases}, too many cases")))
}
