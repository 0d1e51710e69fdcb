//! Load cases of a model: solve, recover.

use super::args::{Arrays, Output, size};
use super::guard::{self, Failure};
use super::model::{SignoriniModel, receive};
use super::report::{SignoriniReport, state_code};
use super::settings::{Received, SignoriniSettings};
use super::status::{code, remember};
use crate::error::Argument;
use crate::model::{LoadCase, Model};
use crate::monitor::{Monitor, ProgressFn};
use crate::problem::FrictionLaw;

/// Solves load cases, one after the other. Case c has its own columns in every array; a NULL status
/// array is not wanted. A case that is wrong or not solved does not stop the others; one that is wrong
/// leaves its d, F, state and report as they were.
///
/// Friction in load steps: hand over as slip the d_t of the step before (zero at first); all state is
/// in your arrays.
///
/// @param model       the model
/// @param cases       number of load cases, 0 allowed
/// @param f           nodal loads of the host, H = signorini_model_host_size entries a case
/// @param prescribed  values of the fixed degrees of freedom, in their order, a column a case; NULL:
///                    zero
/// @param gap         gaps, one for each pair and case
/// @param mu          friction coefficients, one for each pair and case
/// @param slip        tangential displacement at rest, dim - 1 for each pair and case; NULL: zero
/// @param settings    NULL: the defaults; a progress callback is told of each case in turn
/// @param d           out: relative displacements, N = dim * pairs entries a case; in: the starts if
///                    settings->warm_start
/// @param F           out: contact forces, N entries a case
/// @param state       out: state of each pair, a column a case; NULL: not wanted
/// @param report      out: one for each case; set struct_size in each one before the call; NULL: not
///                    wanted
/// @param status      out: status of each case, as signorini_solve returns it, -k standing for the
///                    k-th argument of this call; NULL: not wanted
/// @return 0 if every case is solved; otherwise the status of the first that is not, and
///         signorini_last_error names it; -k the k-th argument is wrong
#[unsafe(no_mangle)]
#[allow(non_snake_case)] // as above
pub unsafe extern "C" fn signorini_model_solve(
    model: *const SignoriniModel,
    cases: i64,
    f: *const f64,
    prescribed: *const f64,
    gap: *const f64,
    mu: *const f64,
    slip: *const f64,
    settings: *const SignoriniSettings,
    d: *mut f64,
    F: *mut f64,
    state: *mut i32,
    report: *mut SignoriniReport,
    status: *mut i32,
) -> i32 {
    guard::call(|| {
        // SAFETY: a model as the header demands.
        let model = unsafe { receive(model)? };
        let cases = size(2, "cases", cases)?;
        let (pairs, n) = (model.pairs(), model.dim() * model.pairs());
        let times = |length: usize| {
            length
                .checked_mul(cases)
                .ok_or_else(|| Failure::argument(2, format!("cases is {cases}, too many cases")))
        };
        let (host, fixed, slips) =
            (times(model.host_size())?, times(model.fixed_count())?, times(n - pairs)?);
        let (all_pairs, all) = (times(pairs)?, times(n)?);
        let mut arrays = Arrays::default();
        // SAFETY: arrays of the lengths of the header, structures that begin with their size.
        let (block, received) = unsafe {
            let block = Block {
                model,
                load: arrays.input(3, "f", f, host, true)?.unwrap_or_default(),
                prescribed: arrays.input(4, "prescribed", prescribed, fixed, false)?,
                gap: arrays.input(5, "gap", gap, all_pairs, true)?.unwrap_or_default(),
                mu: arrays.input(6, "mu", mu, all_pairs, true)?.unwrap_or_default(),
                slip: arrays.input(7, "slip", slip, slips, false)?,
                d: arrays.output(9, "d", d, all, true)?,
                force: arrays.output(10, "F", F, all, true)?,
                state: arrays.output(11, "state", state, all_pairs, false)?,
                reports: Reports::accept(12, report, cases)?,
            };
            (block, SignoriniSettings::receive(8, settings)?)
        };
        received.settings.validate().map_err(|error| Failure::from_error(error, |_| 8))?;
        let status = arrays.output(13, "status", status, cases, false)?;
        let bytes = times(block.reports.stride)?;
        arrays.structures(12, "report", report.cast_const(), bytes, true)?;
        arrays.check_overlap()?;

        let mut first = None;
        for case in 0..cases {
            let (code, message) = block.solve(case, &received);
            // SAFETY: one status for each case, as the header demands.
            unsafe { status.part(case, 1).write(&[code]) };
            if code != 0 && first.is_none() {
                first = Some(code);
                remember(format_args!("case {case}: {message}"));
            }
        }
        Ok(first.unwrap_or(0))
    })
}

/// The arrays of a block of load cases.
struct Block<'a> {
    model: &'a Model,
    load: &'a [f64],
    prescribed: Option<&'a [f64]>,
    gap: &'a [f64],
    mu: &'a [f64],
    slip: Option<&'a [f64]>,
    d: Output<f64>,
    force: Output<f64>,
    state: Output<i32>,
    reports: Reports,
}

impl Block<'_> {
    /// Solves a case and writes its results, unless it is wrong. Returns status and message.
    fn solve(&self, case: usize, received: &Received) -> (i32, String) {
        let (pairs, n) = (self.model.pairs(), self.model.dim() * self.model.pairs());
        let fixed = self.model.fixed_count();
        let given = LoadCase {
            load: column(self.load, self.model.host_size(), case),
            prescribed: self.prescribed.map(|values| column(values, fixed, case)),
            gap: column(self.gap, pairs, case),
            law: FrictionLaw::Coulomb(column(self.mu, pairs, case)),
            reference_slip: self.slip.map(|slip| column(slip, n - pairs, case)),
        };
        let d = self.d.part(n * case, n);
        // SAFETY: d has n entries for each case, filled by a caller that wants a warm start.
        let start = received.warm_start.then(|| unsafe { d.read() });
        let mut progress = received.progress();
        let progress = progress.as_mut().map(|progress| progress as &mut ProgressFn<'_>);
        let mut monitor = Monitor::new(&received.settings, progress);
        match self.model.solve(&given, &received.settings, start.as_deref(), &mut monitor) {
            Ok(solution) => {
                let code = code(solution.status);
                let states: Vec<i32> =
                    solution.certificate.states.iter().map(|&state| state_code(state)).collect();
                let report = SignoriniReport::of(code, &solution);
                // SAFETY: the outputs have the lengths of the header and overlap nothing.
                unsafe {
                    d.write(&solution.d);
                    self.force.part(n * case, n).write(&solution.certificate.force);
                    self.state.part(pairs * case, pairs).write(&states);
                    report.send(self.reports.nth(case));
                }
                (code, solution.message)
            }
            Err(error) => {
                let message = error.message().marked().to_owned();
                (Failure::from_error(error, position).code(), message)
            }
        }
    }
}

fn column(array: &[f64], length: usize, case: usize) -> &[f64] {
    &array[length * case..length * (case + 1)]
}

/// Displacements of the host from the relative ones, for one load case.
///
/// @param model       the model
/// @param f           nodal loads of the case, H entries; NULL: none, for the motion of a case without
///                    equilibrium
/// @param prescribed  values of the fixed degrees of freedom; NULL: zero
/// @param d           relative displacements, N entries
/// @param u           out: displacements, H entries
/// @return 0; -k the k-th argument is wrong
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_model_recover(
    model: *const SignoriniModel,
    f: *const f64,
    prescribed: *const f64,
    d: *const f64,
    u: *mut f64,
) -> i32 {
    guard::call(|| {
        let mut arrays = Arrays::default();
        // SAFETY: a model and arrays as the header demands.
        unsafe {
            let model = receive(model)?;
            let (host, n) = (model.host_size(), model.dim() * model.pairs());
            let load = arrays.input(2, "f", f, host, false)?;
            let values = arrays.input(3, "prescribed", prescribed, model.fixed_count(), false)?;
            let d = arrays.input(4, "d", d, n, true)?.unwrap_or_default();
            let out = arrays.output(5, "u", u, host, true)?;
            arrays.check_overlap()?;
            let recovered = model.recover(load, values, d).map_err(|error| {
                Failure::from_error(error, |argument| match argument {
                    Argument::Load => 2,
                    Argument::Prescribed => 3,
                    _ => 4,
                })
            })?;
            out.write(&recovered);
        }
        Ok(0)
    })
}

/// Contact forces as a nodal force vector of the host: of a sparse model on slaves, and the opposite
/// on masters; of two bodies F on both, each in its own frame; of a condensed one F itself.
///
/// @param model  the model
/// @param F      contact forces, N entries
/// @param nodal  out: nodal forces, H entries
/// @return 0; -k the k-th argument is wrong
#[unsafe(no_mangle)]
#[allow(non_snake_case)] // as above
pub unsafe extern "C" fn signorini_model_nodal_forces(
    model: *const SignoriniModel,
    F: *const f64,
    nodal: *mut f64,
) -> i32 {
    guard::call(|| {
        let mut arrays = Arrays::default();
        // SAFETY: a model and arrays as the header demands.
        unsafe {
            let model = receive(model)?;
            let n = model.dim() * model.pairs();
            let force = arrays.input(2, "F", F, n, true)?.unwrap_or_default();
            let out = arrays.output(3, "nodal", nodal, model.host_size(), true)?;
            arrays.check_overlap()?;
            let forces = model.nodal_forces(force);
            out.write(&forces.map_err(|error| Failure::from_error(error, |_| 2))?);
        }
        Ok(0)
    })
}

fn position(argument: Argument) -> i32 {
    match argument {
        Argument::Load => 3,
        Argument::Prescribed => 4,
        Argument::Gap => 5,
        Argument::Law => 6,
        Argument::ReferenceSlip => 7,
        Argument::Settings => 8,
        Argument::Start => 9,
        _ => 1,
    }
}

/// An array of reports of the caller, whose structure may be smaller than ours.
struct Reports {
    first: *mut SignoriniReport,
    stride: usize,
}

impl Reports {
    /// # Safety
    /// NULL, or an array of `cases` reports that begin with their size.
    unsafe fn accept(
        position: i32,
        first: *mut SignoriniReport,
        cases: usize,
    ) -> Result<Self, Failure> {
        if first.is_null() || cases == 0 {
            return Ok(Reports { first: std::ptr::null_mut(), stride: 0 });
        }
        // SAFETY: by the caller's contract, as in the loop.
        let stride = unsafe { SignoriniReport::accept(position, first)? };
        let reports = Reports { first, stride };
        for case in 1..cases {
            // SAFETY: as above.
            let size = unsafe { SignoriniReport::accept(position, reports.nth(case))? };
            if size != stride {
                let message = format!("report {case}: struct_size is {size}, not {stride}");
                return Err(Failure::argument(position, message));
            }
        }
        Ok(reports)
    }

    /// The report of a case, NULL if none is wanted.
    fn nth(&self, case: usize) -> *mut SignoriniReport {
        if self.first.is_null() {
            self.first
        } else {
            self.first.wrapping_byte_add(self.stride * case)
        }
    }
}
