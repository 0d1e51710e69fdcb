//! The results of a call that solves contact problems: where they go, and how they are written. Not every call wants the
//! further ones: motions where no equilibrium exists, a second solution, and a proof.

use std::iter::repeat;

use super::args::{Arrays, Output, c_entry};
use super::guard::Outcome;
use super::numbers::Numbered;
use super::report::{SignoriniReport, state_codes};
use super::structures::{OutStructures, Structure};
use crate::solve::{Existence, Solution};

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
    /// Motion, escape, displacements and forces of the second solution, radii of displacements and forces, the low part.
    further: [Output<f64>; 7],
    second_state: Output<i32>,
}

impl OutputArguments {
    /// Notes the arrays of `n` unknowns of `pairs` pairs, each `cases` times, which the caller has checked to be
    /// numbers. `d`, `F`, `state` and `status` are the arguments from number `first` on, `report` and `extra` those from number
    /// `report` on.
    pub(super) fn note(
        &self,
        arrays: &Arrays,
        (first, report): (i32, i32),
        (n, pairs, cases): (usize, usize, usize),
    ) -> Outcome<Outputs> {
        let d = arrays.at(first, "d").output(self.d, n * cases)?;
        let force = arrays.at(first + 1, "F").output(self.F, n * cases)?;
        let state = arrays.at(first + 2, "state").optional_output(self.state, pairs * cases)?;
        let status = arrays.at(first + 3, "status").optional_output(self.status, cases)?;
        let reports = arrays.at(report, "report").out_structures(self.report, cases)?;
        let at = arrays.at(report + 1, "extra");
        let given = at.copy(self.extra)?;
        at.check_reserved(given.reserved)?;
        let vector = |field, pointer| at.field(field).optional_output(pointer, n * cases);
        let further = [
            vector("motion", given.motion)?,
            vector("escape", given.escape)?,
            vector("second_d", given.second_d)?,
            vector("second_F", given.second_F)?,
            vector("radius_d", given.radius_d)?,
            vector("radius_F", given.radius_F)?,
            vector("d_low", given.d_low)?,
        ];
        let at_state = at.field("second_state");
        let second_state = at_state.optional_output(given.second_state, pairs * cases)?;
        Ok(Outputs { n, pairs, d, force, state, status, reports, further, second_state })
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
        self.write_further(case, solution);
        status
    }

    /// Writes the results of a case that not every call wants.
    fn write_further(&self, case: usize, solution: &Solution) {
        let (n, pairs) = (self.n, self.pairs);
        let second = solution.second.as_deref();
        let proof = match &solution.existence {
            Existence::Proved(proof) => Some(proof),
            Existence::NotAsked | Existence::NotProved => None,
        };
        // Distances of the proved solution from what the caller receives.
        let about_d = proof.map(|proof| proof.radius_about(&solution.d));
        let about_force = proof.map(|proof| proof.force_radius_about(&solution.certificate.force));
        let vectors = [
            (solution.recession.as_ref(), 0.0),
            (solution.escape.as_ref().map(|escape| &escape.motion), 0.0),
            (second.map(|second| &second.d), 0.0),
            (second.map(|second| &second.certificate.force), 0.0),
            (about_d.as_ref(), NO_RADIUS),
            (about_force.as_ref(), NO_RADIUS),
            (Some(&solution.d_low), 0.0),
        ];
        for (output, (values, nothing)) in self.further.iter().zip(vectors) {
            output.part(n * case, n).write_or(values, nothing);
        }
        let states = second.iter().flat_map(|second| state_codes(&second.certificate.states));
        self.second_state.part(pairs * case, pairs).write_each(states.chain(repeat(0)));
    }
}

/// Further results: arrays of N entries, of cases a column for each. NULL, as
/// signorini_extra_default() sets them: not wanted.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SignoriniExtra {
    /// sizeof(signorini_extra).
    pub struct_size: u32,
    /// 0.
    pub reserved: i32,
    /// With SIGNORINI_STATUS_NO_EQUILIBRIUM a motion r that proves it, its largest entry 1: K r = 0,
    /// and f . r + F . r > 0 for all forces F that the law admits. In flexibility form forces p,
    /// pressing normal ones but for ties: W p = 0, p . (g - q) > 0, g gap and reference slip. Else
    /// zeros.
    pub motion: *mut f64,
    /// Displacements of a second solution if report.second is 1; else zeros.
    pub second_d: *mut f64,
    /// Its contact forces likewise.
    pub second_F: *mut f64,
    /// Its states likewise, one for each pair.
    pub second_state: *mut i32,
    /// With SIGNORINI_PROOF_PROVED the solution lies within this distance of d, component by
    /// component; length. Else -1.
    pub radius_d: *mut f64,
    /// Likewise of the contact forces; force.
    pub radius_F: *mut f64,
    /// With SIGNORINI_STATUS_NO_EQUILIBRIUM the motion of escape, its largest entry 1: K r = 0, no
    /// pair approaches its obstacle, friction opposes the slip, and f . r > 0, if every pair of
    /// finite gap touches. With SIGNORINI_STATUS_STALLED a motion that proves nothing. Else zeros.
    pub escape: *mut f64,
    /// The last digits of d: d + d_low is what the report measures; length.
    pub d_low: *mut f64,
}

/// A radius where nothing is proved.
pub(super) const NO_RADIUS: f64 = -1.0;

// SAFETY: led by its size; numbers and pointers.
unsafe impl Structure for SignoriniExtra {}

/// Fills extra with NULL pointers; struct_size is sizeof(signorini_extra).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_extra_default(
    extra: *mut SignoriniExtra,
    struct_size: u32,
) -> i32 {
    c_entry!(|arrays| { arrays.at(1, "extra").fill(extra, struct_size) })
}
