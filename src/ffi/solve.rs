//! Condensed contact problems and linear complementarity problems (LCP), each in one call on plain arrays.

use std::ptr::null_mut;

use super::args::c_entry;
use super::case_arguments::CondensedArguments;
use super::guard;
use super::numbers::Numbered;
use super::outputs::{OutputArguments, SignoriniExtra};
use super::report::SignoriniReport;
use super::settings::{SignoriniSettings, WarmStart};
use super::status::{is_told, remember};
use crate::error::Argument;
use crate::problem::{ContactProblem, Lcp};
use crate::solve::{Status, memory, memory_of_ties, solve, solve_lcp};

/// Solves a contact problem that you have condensed on the N = dim * pairs contact components.
///
/// @param dim       space dimension, 2 or 3
/// @param pairs     number of contact pairs, 0 allowed
/// @param K         condensed stiffness, N columns of N entries, both triangles; force / length;
///                  symmetric to 1e-9 of the diagonal, positive semi-definite, not zero:
///                  signorini_solve checks a part of this, a model all. A row of zeros is a
///                  component that nothing resists. A component that you hold fixed keeps its
///                  row: zero off the diagonal, positive on it, zero load. If the body can move
///                  freely and touches at two or three points, use a model
/// @param ldk       entries from one column of K to the next, at least max(1, N)
/// @param f         condensed nodal loads, N; force
/// @param gap       initial gap of each pair; length; negative: interference; +infinity: no contact
/// @param law       SIGNORINI_LAW_..., the friction law
/// @param friction  parameters of the law, pair by pair; NULL if it has none
/// @param slip0     reference slip, dim - 1 for each pair; length; NULL: zero. In load steps hand
///                  over the d_t of the step before
/// @param settings  NULL: the defaults
/// @param d         out: relative displacements, N; in: the start if settings->warm_start
/// @param F         out: contact forces, N. They obey the contact law; K d = f + F holds up to
///                  report->equilibrium
/// @param state     out: SIGNORINI_STATE_... of each pair; may be NULL
/// @param report    out: how good the result is; set its struct_size before; may be NULL
/// @param extra     arrays for further results; may be NULL
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_solve(
    dim: i32,
    pairs: i64,
    K: *const f64,
    ldk: i64,
    f: *const f64,
    gap: *const f64,
    law: i32,
    friction: *const f64,
    slip0: *const f64,
    settings: *const SignoriniSettings,
    d: *mut f64,
    F: *mut f64,
    state: *mut i32,
    report: *mut SignoriniReport,
    extra: *const SignoriniExtra,
) -> i32 {
    const SETTINGS: i32 = 10;
    const START: i32 = 11;
    let given = CondensedArguments { first: 1, dim, pairs, K, ldk, f, gap, law, friction, slip0 };
    let wanted = OutputArguments { d, F, state, status: null_mut(), report, extra };
    c_entry!(|arrays| {
        let data = given.read(arrays)?;
        let received = SignoriniSettings::read(arrays.at(SETTINGS, "settings"), settings)?;
        let sizes = (data.dim * data.pairs, data.pairs, 1);
        let outputs = wanted.note(arrays, (START, START + 3), sizes)?;
        arrays.check_overlap()?;

        arrays.at(START, "d").is(Argument::Start);
        let n = data.dim * data.pairs;
        guard::reserve_estimate(memory(n) + memory_of_ties(data.law, n))?;
        let is_given = received.warm_start == WarmStart::Given;
        let start = is_given.then(|| outputs.d.read());
        let solved = received.monitored(|monitor| {
            let problem = ContactProblem::new(data)?;
            solve(&problem, &received.settings, start.as_deref(), monitor)
        });
        let solution = solved.map_err(arrays.refused(SETTINGS))?;
        let status = outputs.write(0, &solution);
        if is_told(&solution) {
            remember(solution.message);
        }
        Ok(status)
    })
}

/// Most bytes that a call with n unknowns may take beside your arrays, with any method, law (ties:
/// 8 n n more) and setting: signorini_solve with n = dim * pairs, and signorini_lcp_solve. Some MiB
/// that each thread keeps are not counted. -1 if n is negative.
#[unsafe(no_mangle)]
pub extern "C" fn signorini_solve_memory(n: i64) -> i64 {
    let n = usize::try_from(n).ok();
    n.map_or(-1, |n| i64::try_from(memory(n)).unwrap_or(i64::MAX))
}

/// Solves a linear complementarity problem (LCP): w = q + M z, w >= 0, z >= 0, w . z = 0.
///
/// With SIGNORINI_METHOD_AUTO the problem is solved if M is positive definite or a P-matrix, and
/// solved or proved infeasible (SIGNORINI_STATUS_NO_EQUILIBRIUM) if positive semi-definite or
/// copositive-plus, to condition numbers of 1e10. Any other M may also end in a ray that proves
/// nothing (SIGNORINI_STATUS_STALLED).
///
/// @param n         number of unknowns, 0 allowed
/// @param M         any matrix, n columns of n entries
/// @param ldm       entries from one column of M to the next, at least max(1, n)
/// @param q         n
/// @param cover     covering vector of Lemke's method, n positive entries; NULL: ones
/// @param settings  NULL: the defaults; method AUTO, BLOCK_PIVOTING or LEMKE; omega, damping,
///                  warm_start and search have no effect
/// @param w,z       out: n
/// @param y         out: n; may be NULL. With SIGNORINI_STATUS_NO_EQUILIBRIUM the proof: y >= 0,
///                  M' y <= 0, q . y < 0; else zeros
/// @param report    as for signorini_solve
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_lcp_solve(
    n: i64,
    M: *const f64,
    ldm: i64,
    q: *const f64,
    cover: *const f64,
    settings: *const SignoriniSettings,
    w: *mut f64,
    z: *mut f64,
    y: *mut f64,
    report: *mut SignoriniReport,
) -> i32 {
    c_entry!(|arrays| {
        let n = arrays.at(1, "n").size(n)?;
        let (matrix, ld) = arrays.at(2, "M").is(Argument::Matrix).square(M, ("ldm", ldm), n)?;
        let q = arrays.at(4, "q").is(Argument::Load).required(q, n)?;
        let cover = arrays.at(5, "cover").is(Argument::Covering).optional(cover, n)?;
        let received = SignoriniSettings::read(arrays.at(6, "settings"), settings)?;
        let w = arrays.at(7, "w").output(w, n)?;
        let z = arrays.at(8, "z").output(z, n)?;
        let y = arrays.at(9, "y").optional_output(y, n)?;
        let report = arrays.at(10, "report").out_structures(report, 1)?;
        arrays.check_overlap()?;

        guard::reserve_estimate(memory(n))?;
        let lcp = Lcp::new(n, matrix, ld, q, cover).map_err(arrays.refused(6))?;
        let solution = received
            .monitored(|monitor| solve_lcp(&lcp, &received.settings, monitor))
            .map_err(arrays.refused(6))?;

        let status = solution.status.number();
        if solution.status != Status::Solved {
            remember(solution.message.clone());
        }
        w.write(&solution.w);
        z.write(&solution.z);
        y.write_or(solution.infeasible_by.as_ref(), 0.0);
        report.write(0, &SignoriniReport::of_lcp(status, &solution));
        Ok(status)
    })
}
