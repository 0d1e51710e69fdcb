//! The results of a call that solves contact problems: where they go, and how they are written.

use super::args::{Arrays, Output};
use super::extra::{Extra, SignoriniExtra};
use super::guard::Failure;
use super::numbers::Numbered;
use super::report::{SignoriniReport, state_codes};
use super::structures::OutStructures;
use crate::solve::Solution;

/// The pointers of a call.
pub(super) struct OutputArguments {
    pub(super) d: *mut f64,
    pub(super) F: *mut f64,
    pub(super) state: *mut i32,
    /// NULL in a call of one case, which returns it.
    pub(super) status: *mut i32,
    pub(super) report: *mut SignoriniReport,
    pub(super) extra: *const SignoriniExtra,
}

/// Where the results of the call go.
pub(super) struct Outputs {
    n: usize,
    pairs: usize,
    pub(super) d: Output<f64>,
    pub(super) force: Output<f64>,
    state: Output<i32>,
    pub(super) status: Output<i32>,
    reports: OutStructures<SignoriniReport>,
    extra: Extra,
}

impl OutputArguments {
    /// Notes the arrays of `n` unknowns of `pairs` pairs, each `cases` times, which the caller has checked to be
    /// numbers. `d`, `F`, `state` and `status` are the arguments from number `first` on, `report` and `extra` those from number
    /// `report` on.
    pub(super) fn note(
        &self,
        arrays: &mut Arrays<'_>,
        (first, report): (i32, i32),
        (n, pairs, cases): (usize, usize, usize),
    ) -> Result<Outputs, Failure> {
        let d = arrays.output(first, "d", self.d, n * cases)?;
        let force = arrays.output(first + 1, "F", self.F, n * cases)?;
        let state = arrays.optional_output(first + 2, "state", self.state, pairs * cases)?;
        let status = arrays.optional_output(first + 3, "status", self.status, cases)?;
        let reports = arrays.out_structures(report, "report", self.report, cases)?;
        let extra = Extra::read(arrays, report + 1, self.extra, (n, pairs, cases))?;
        Ok(Outputs { n, pairs, d, force, state, status, reports, extra })
    }
}

impl Outputs {
    /// Writes the solution of a case. Returns its status.
    pub(super) fn write(&self, case: usize, solution: &Solution) -> i32 {
        let (n, pairs, status) = (self.n, self.pairs, solution.status.number());
        let certificate = &solution.certificate;
        self.d.part(n * case, n).write(&solution.d);
        self.force.part(n * case, n).write(&certificate.force);
        self.state.part(pairs * case, pairs).write_each(state_codes(&certificate.states));
        self.reports.write(case, &SignoriniReport::of(status, solution));
        self.extra.write(case, solution);
        status
    }
}
