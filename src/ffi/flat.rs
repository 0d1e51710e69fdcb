//! Condensed contact problems in one call on plain arrays.

use super::args::{Arrays, matrix_length, size, sizes};
use super::guard::{self, Failure};
use super::report::{SignoriniReport, state_code};
use super::settings::SignoriniSettings;
use super::status::{code, remember};
use crate::error::Argument;
use crate::monitor::{Monitor, ProgressFn};
use crate::problem::{ContactData, ContactProblem, FrictionLaw};
use crate::solve::{Status, solve};

/// Solves a condensed contact problem with Coulomb friction.
///
/// N = dim * pairs. Arrays must not overlap.
///
/// @param dim       space dimension, 2 or 3
/// @param pairs     number of contact pairs, 0 allowed
/// @param K         condensed stiffness, N columns of N entries, column-major, both triangles,
///                  symmetric, positive semi-definite, positive diagonal; force / length
/// @param ldk       entries from one column of K to the next, at least max(1, N)
/// @param f         condensed nodal loads, N; force
/// @param gap       initial gaps, one for each pair; length; negative: interference, +infinity:
///                  never touches
/// @param mu        friction coefficients, one for each pair, at least 0
/// @param slip      tangential displacement at which friction is at rest, dim - 1 for each pair;
///                  length; NULL: zero (total law). The last converged d_t gives the incremental
///                  law.
/// @param settings  NULL: the defaults
/// @param d         out: relative displacements, N; in: the start if settings->warm_start
/// @param F         out: contact forces, N; they obey the law, and K d = f + F up to
///                  report->equilibrium
/// @param state     out: SIGNORINI_OPEN, _SLIP or _STICK, one for each pair; NULL: not wanted
/// @param report    out; set report->struct_size before the call; NULL: not wanted
/// @return 0 solved and certified; > 0 results were written but are not a solution; -k the k-th
///         argument is wrong, nothing was written; <= -1000 internal. signorini_last_error()
///         tells in words.
#[unsafe(no_mangle)]
#[allow(non_snake_case)] // the names of the mechanics, which the header shows
pub unsafe extern "C" fn signorini_solve(
    dim: i32,
    pairs: i64,
    K: *const f64,
    ldk: i64,
    f: *const f64,
    gap: *const f64,
    mu: *const f64,
    slip: *const f64,
    settings: *const SignoriniSettings,
    d: *mut f64,
    F: *mut f64,
    state: *mut i32,
    report: *mut SignoriniReport,
) -> i32 {
    let arguments =
        Arguments { dim, pairs, K, ldk, f, gap, friction: mu, slip, settings, d, F, state, report };
    // SAFETY: the caller's contract, which the header states.
    guard::call(|| unsafe { arguments.run("mu", |mu| FrictionLaw::Coulomb(mu)) })
}

/// Solves a condensed contact problem with given friction thresholds (Tresca): |F_t| <= g, open or
/// closed.
///
/// The arguments are those of signorini_solve, with g in the place of mu. The method
/// SIGNORINI_METHOD_SOR_DIAGONAL is not for given thresholds.
///
/// @param dim       space dimension, 2 or 3
/// @param pairs     number of contact pairs, 0 allowed
/// @param K         condensed stiffness, N columns of N entries; force / length
/// @param ldk       entries from one column of K to the next, at least max(1, N)
/// @param f         condensed nodal loads, N; force
/// @param gap       initial gaps, one for each pair; length
/// @param g         friction thresholds, one for each pair, at least 0; force
/// @param slip      tangential displacement at rest, dim - 1 for each pair; length; NULL: zero
/// @param settings  NULL: the defaults
/// @param d         out: relative displacements, N; in: the start if settings->warm_start
/// @param F         out: contact forces, N
/// @param state     out: state of each pair; NULL: not wanted
/// @param report    out; set report->struct_size before the call; NULL: not wanted
/// @return as signorini_solve
#[unsafe(no_mangle)]
#[allow(non_snake_case)] // as above
pub unsafe extern "C" fn signorini_tresca(
    dim: i32,
    pairs: i64,
    K: *const f64,
    ldk: i64,
    f: *const f64,
    gap: *const f64,
    g: *const f64,
    slip: *const f64,
    settings: *const SignoriniSettings,
    d: *mut f64,
    F: *mut f64,
    state: *mut i32,
    report: *mut SignoriniReport,
) -> i32 {
    let arguments =
        Arguments { dim, pairs, K, ldk, f, gap, friction: g, slip, settings, d, F, state, report };
    // SAFETY: the caller's contract, which the header states.
    guard::call(|| unsafe { arguments.run("g", |g| FrictionLaw::Tresca(g)) })
}

#[allow(non_snake_case)] // as above
struct Arguments {
    dim: i32,
    pairs: i64,
    K: *const f64,
    ldk: i64,
    f: *const f64,
    gap: *const f64,
    friction: *const f64,
    slip: *const f64,
    settings: *const SignoriniSettings,
    d: *mut f64,
    F: *mut f64,
    state: *mut i32,
    report: *mut SignoriniReport,
}

fn position(argument: Argument) -> i32 {
    match argument {
        Argument::Dimension => 1,
        Argument::Size => 2,
        Argument::Matrix => 3,
        Argument::LeadingDimension => 4,
        Argument::Load => 5,
        Argument::Gap => 6,
        Argument::Law | Argument::Covering => 7,
        Argument::ReferenceSlip => 8,
        Argument::Settings => 9,
        Argument::Start => 10,
        other => unreachable!("these calls have no argument {other:?}"),
    }
}

impl Arguments {
    /// # Safety
    /// Every pointer is NULL or has the length that the header demands.
    unsafe fn run(
        &self,
        friction_name: &'static str,
        friction: impl for<'a> Fn(&'a [f64]) -> FrictionLaw<'a>,
    ) -> Result<i32, Failure> {
        let (dim, pairs, n) = sizes(self.dim, self.pairs)?;
        let ld = size(4, "ldk", self.ldk)?;
        let entries = matrix_length(4, "K", n, ld)?;
        let slips = n - pairs;
        let mut arrays = Arrays::default();
        // SAFETY: the lengths are those of the header.
        let (stiffness, load, gap, friction_values, reference_slip) = unsafe {
            (
                arrays.input(3, "K", self.K, entries, true)?.unwrap_or_default(),
                arrays.input(5, "f", self.f, n, true)?.unwrap_or_default(),
                arrays.input(6, "gap", self.gap, pairs, true)?.unwrap_or_default(),
                arrays.input(7, friction_name, self.friction, pairs, true)?.unwrap_or_default(),
                arrays.input(8, "slip", self.slip, slips, false)?,
            )
        };
        // SAFETY: the header asks for structures that begin with their size.
        let received = unsafe { SignoriniSettings::receive(9, self.settings)? };
        let d = arrays.output(10, "d", self.d, n, true)?;
        let force = arrays.output(11, "F", self.F, n, true)?;
        let state = arrays.output(12, "state", self.state, pairs, false)?;
        // SAFETY: as above.
        unsafe { SignoriniReport::accept(13, self.report)? };
        arrays.structure(9, "settings", self.settings, false)?;
        arrays.structure(13, "report", self.report.cast_const(), true)?;
        arrays.check_overlap()?;

        let from_error = |error| Failure::from_error(error, position);
        let problem = ContactProblem::new(ContactData {
            dim,
            pairs,
            stiffness,
            ld,
            load,
            gap,
            law: friction(friction_values),
            reference_slip,
        })
        .map_err(from_error)?;
        // SAFETY: d has n entries, which the caller has filled if it asked for a warm start.
        let start = received.warm_start.then(|| unsafe { d.read() });
        let mut progress = received.progress();
        let progress = progress.as_mut().map(|progress| progress as &mut ProgressFn<'_>);
        let mut monitor = Monitor::new(&received.settings, progress);
        let solution = solve(&problem, &received.settings, start.as_deref(), &mut monitor)
            .map_err(from_error)?;

        let status = code(solution.status);
        if solution.status != Status::Solved {
            remember(format_args!("{}", solution.message));
        }
        let states: Vec<i32> =
            solution.certificate.states.iter().map(|&state| state_code(state)).collect();
        let report = SignoriniReport::of(status, &solution);
        // SAFETY: the outputs have the lengths of the header and overlap nothing.
        unsafe {
            d.write(&solution.d);
            force.write(&solution.certificate.force);
            state.write(&states);
            report.send(self.report);
        }
        Ok(status)
    }
}
