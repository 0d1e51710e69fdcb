//! The results of a call that solves one contact problem: where they go, and how they are written.

use super::args::{Arrays, Output};
use super::extra::{Extra, SignoriniExtra};
use super::guard::Failure;
use super::report::{SignoriniReport, state_codes};
use super::status::{code, remember};
use crate::solve::{Solution, Status};

/// The pointers of the last arguments of a call, in their order.
#[allow(non_snake_case)] // the names of the mechanics, which the header shows
pub(super) struct OutputArguments {
    pub(super) d: *mut f64,
    pub(super) F: *mut f64,
    pub(super) state: *mut i32,
    pub(super) report: *mut SignoriniReport,
    pub(super) extra: *const SignoriniExtra,
}

/// Where the results of the call go.
pub(super) struct Outputs {
    pub(super) d: Output<f64>,
    pub(super) force: Output<f64>,
    state: Output<i32>,
    report: *mut SignoriniReport,
    extra: Extra,
}

impl OutputArguments {
    /// Notes the arrays of `n` unknowns of `pairs` pairs. `first` is the number of `d` among the
    /// arguments.
    ///
    /// # Safety Every pointer is NULL or has the length that the header demands.
    pub(super) unsafe fn note(
        &self,
        arrays: &mut Arrays,
        first: i32,
        (n, pairs): (usize, usize),
    ) -> Result<Outputs, Failure> {
        let d = arrays.output(first, "d", self.d, n)?;
        let force = arrays.output(first + 1, "F", self.F, n)?;
        let state = arrays.optional_output(first + 2, "state", self.state, pairs)?;
        // SAFETY: by the caller's contract.
        let extra = unsafe {
            arrays.structure(first + 3, "report", self.report.cast_const(), true)?;
            Extra::read(arrays, first + 4, self.extra, (n, pairs, 1))?
        };
        Ok(Outputs { d, force, state, report: self.report, extra })
    }
}

impl Outputs {
    /// Writes the solution. Returns its status, and remembers its message unless it is solved.
    ///
    /// # Safety
    /// The arrays have the lengths of the header and overlap nothing.
    pub(super) unsafe fn write(&self, solution: &Solution) -> i32 {
        let status = code(solution.status);
        if solution.status != Status::Solved {
            remember(solution.message.clone());
        }
        // SAFETY: by the caller's contract.
        unsafe {
            self.d.write(&solution.d);
            self.force.write(&solution.certificate.force);
            self.state.write(&state_codes(&solution.certificate.states));
            SignoriniReport::of(status, solution).write(self.report);
            self.extra.write(0, solution);
        }
        status
    }
}
