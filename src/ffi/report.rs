//! The report of the C interface, led by its size, and the states of pairs.

use libc::c_char;

use super::args::c_entry;
use super::numbers::{Numbered, numbers};
use super::structures::Structure;
use crate::certificate::Certificate;
use crate::law::State;
use crate::settings::Method;
use crate::solve::{Existence, Fallback, LcpSolution, Remarks, Solution, Uniqueness};

/// The pair is apart: F_n = 0, with cohesion F_n = a; F_t = 0 except under Tresca's law and
/// cohesion. A pair with pressure and friction below 1e-11 of the largest load or force is open too.
pub const SIGNORINI_STATE_OPEN: i32 = 0;
/// The pair touches and slips: |F_t| is at its bound. Frictionless: every pair that touches.
pub const SIGNORINI_STATE_SLIP: i32 = 1;
/// The pair sticks: d_t = slip0.
pub const SIGNORINI_STATE_STICK: i32 = 2;

/// Not known.
pub const SIGNORINI_UNIQUENESS_NOT_KNOWN: i32 = 0;
/// Proved: there is no other solution.
pub const SIGNORINI_UNIQUENESS_UNIQUE: i32 = 1;
/// There are others, by an estimate of errors.
pub const SIGNORINI_UNIQUENESS_SEVERAL: i32 = 2;

/// settings.proof is 0.
pub const SIGNORINI_PROOF_NOT_ASKED: i32 = 0;
/// Proved: the problem (of a model: the condensed one) has a solution with these states, each
/// double taken as an exact number.
pub const SIGNORINI_PROOF_PROVED: i32 = 1;
/// Not proved: a pair at the boundary of two states, K badly conditioned, or no time.
pub const SIGNORINI_PROOF_NOT_PROVED: i32 = 2;

/// The first method succeeded.
pub const SIGNORINI_FALLBACK_NONE: i32 = 0;
/// Its states repeated.
pub const SIGNORINI_FALLBACK_CYCLE: i32 = 1;
/// It met a singular system.
pub const SIGNORINI_FALLBACK_SINGULAR: i32 = 2;
/// It found an unstable solution (orientation -1).
pub const SIGNORINI_FALLBACK_UNSTABLE: i32 = 3;
/// It found no accurate solution.
pub const SIGNORINI_FALLBACK_INACCURATE: i32 = 4;

/// Every finite gap is negative: interference everywhere, or wrong sign.
pub const SIGNORINI_REMARK_GAPS_NEGATIVE: i32 = 1;
/// A coefficient of friction is above 10: in percent, or another array?
pub const SIGNORINI_REMARK_FRICTION_LARGE: i32 = 2;
/// Without friction bodies may move freely: a support may be missing. Not sought in full space, nor
/// for dependent pairs.
pub const SIGNORINI_REMARK_FREE_MOTION: i32 = 4;
/// Only rounding of K holds a body.
pub const SIGNORINI_REMARK_HELD_BY_ROUNDING: i32 = 8;
/// d rounded to doubles misses the tolerance, d + extra.d_low meets it.
pub const SIGNORINI_REMARK_NEEDS_LOW_PART: i32 = 16;
/// Large penetration beside gaps: forces may be wrong.
pub const SIGNORINI_REMARK_GAPS_PASSED: i32 = 32;

/// How good a result is, and how it was found. Set struct_size; a call writes all other fields.
/// K d - f is the contact force that d requires.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SignoriniReport {
    /// sizeof(signorini_report).
    pub struct_size: u32,
    /// The status, as the call returns it.
    pub status: i32,
    /// The method that found the result, SIGNORINI_METHOD_...; certify: 0.
    pub method: i32,
    /// SIGNORINI_UNIQUENESS_...
    pub uniqueness: i32,
    /// Sweeps, pivots or linear systems, of all methods tried.
    pub iterations: i64,
    /// Threshold updates of the nested method; without a condensed K: solutions with a factor.
    pub outer_iterations: i64,
    /// How often Lemke's tableau was refactorised.
    pub refactorisations: i64,
    /// Residual of the law relative to the forces, no unit, before d is rounded to doubles.
    pub eta: f64,
    /// Most that rounding d to doubles may add to eta, no unit. Above 1e-6, d is certified only if
    /// its energy d . K d is more than rounding of K explains.
    pub rounding: f64,
    /// Largest d_n - gap; length; 0 if none.
    pub penetration: f64,
    /// Largest normal part of K d - f beyond the tension of the law; force; 0 if none.
    pub tension: f64,
    /// Largest excess of the tangential part of K d - f over its bound; force; 0 if none.
    pub cone_excess: f64,
    /// Largest component of K d - f - F; force.
    pub equilibrium: f64,
    /// Over-relaxation factor at the end; 0 if the method has none.
    pub omega: f64,
    /// Damping likewise.
    pub damping: f64,
    /// Pairs of SIGNORINI_STATE_OPEN.
    pub pairs_open: i64,
    /// Pairs of SIGNORINI_STATE_SLIP.
    pub pairs_slipping: i64,
    /// Pairs of SIGNORINI_STATE_STICK.
    pub pairs_sticking: i64,
    /// Dense factorisations by Newton's method and block pivoting. In full space: sparse ones.
    pub factorisations: i64,
    /// The first method, SIGNORINI_METHOD_...
    pub first_method: i32,
    /// SIGNORINI_FALLBACK_...
    pub fallback: i32,
    /// Sign of the determinant of the equations that the states select; 0: not known. -1: the
    /// solution is unstable; if K is positive definite, at least two others exist.
    pub orientation: i32,
    /// 1: a second solution was found; else 0.
    pub second: i32,
    /// Largest error of a component of d over its largest component, no unit: proved with
    /// SIGNORINI_PROOF_PROVED, else estimated from the last refinement; -1: not known.
    pub error_d: f64,
    /// Likewise of F, over the largest component of F and f.
    pub error_F: f64,
    /// SIGNORINI_PROOF_...
    pub proof: i32,
    /// Sum of SIGNORINI_REMARK_...; 0: none.
    pub remarks: i32,
}

// SAFETY: led by its size; numbers.
unsafe impl Structure for SignoriniReport {}

/// An error that is not known.
const NOT_KNOWN: f64 = -1.0;

impl SignoriniReport {
    pub(super) fn of(status: i32, solution: &Solution) -> Self {
        SignoriniReport {
            outer_iterations: solution.outer_iterations as i64,
            omega: solution.omega,
            damping: solution.damping,
            iterations: solution.iterations as i64,
            refactorisations: solution.refactorisations as i64,
            factorisations: solution.factorisations as i64,
            uniqueness: solution.uniqueness.number(),
            orientation: i32::from(solution.orientation),
            second: i32::from(solution.second.is_some()),
            error_d: solution.errors.map_or(NOT_KNOWN, |errors| errors.d),
            error_F: solution.errors.map_or(NOT_KNOWN, |errors| errors.force),
            proof: match solution.existence {
                Existence::NotAsked => SIGNORINI_PROOF_NOT_ASKED,
                Existence::Proved(_) => SIGNORINI_PROOF_PROVED,
                Existence::NotProved => SIGNORINI_PROOF_NOT_PROVED,
            },
            remarks: remark_codes(solution.remarks),
            ..Self::of_method(status, solution.method, solution.fallback)
                .with_certificate(&solution.certificate)
        }
    }

    pub(super) fn of_certificate(status: i32, certificate: &Certificate) -> Self {
        Self::of_method(status, Method::Auto, None).with_certificate(certificate)
    }

    fn with_certificate(self, certificate: &Certificate) -> Self {
        SignoriniReport {
            eta: certificate.eta,
            rounding: certificate.rounding,
            penetration: certificate.penetration,
            tension: certificate.tension,
            cone_excess: certificate.cone_excess,
            equilibrium: certificate.equilibrium,
            pairs_open: certificate.count(State::Open) as i64,
            pairs_slipping: certificate.count(State::Slip) as i64,
            pairs_sticking: certificate.count(State::Stick) as i64,
            ..self
        }
    }

    pub(super) fn of_lcp(status: i32, solution: &LcpSolution) -> Self {
        SignoriniReport {
            eta: solution.eta,
            rounding: solution.rounding,
            iterations: solution.iterations as i64,
            refactorisations: solution.refactorisations as i64,
            factorisations: solution.factorisations as i64,
            ..Self::of_method(status, solution.method, solution.fallback)
        }
    }

    /// The method, with the first one and why it was abandoned, if there was another one before.
    fn of_method(status: i32, method: Method, tried: Option<(Method, Fallback)>) -> Self {
        let why = tried.map_or(SIGNORINI_FALLBACK_NONE, |(_, why)| why.number());
        SignoriniReport {
            status,
            method: method.number(),
            first_method: tried.map_or(method, |(first, _)| first).number(),
            fallback: why,
            error_d: NOT_KNOWN,
            error_F: NOT_KNOWN,
            ..Self::zeros()
        }
    }
}

fn remark_codes(remarks: Remarks) -> i32 {
    let code = |said: bool, code: i32| if said { code } else { 0 };
    code(remarks.gaps_negative, SIGNORINI_REMARK_GAPS_NEGATIVE)
        + code(remarks.friction_large, SIGNORINI_REMARK_FRICTION_LARGE)
        + code(remarks.free_motion, SIGNORINI_REMARK_FREE_MOTION)
        + code(remarks.held_by_rounding, SIGNORINI_REMARK_HELD_BY_ROUNDING)
        + code(remarks.needs_low_part, SIGNORINI_REMARK_NEEDS_LOW_PART)
        + code(remarks.gaps_passed, SIGNORINI_REMARK_GAPS_PASSED)
}

numbers! {
    Uniqueness {
        NotKnown = SIGNORINI_UNIQUENESS_NOT_KNOWN,
        Unique = SIGNORINI_UNIQUENESS_UNIQUE,
        Several = SIGNORINI_UNIQUENESS_SEVERAL,
    }
}

numbers! {
    Fallback {
        Cycle = SIGNORINI_FALLBACK_CYCLE,
        Singular = SIGNORINI_FALLBACK_SINGULAR,
        Unstable = SIGNORINI_FALLBACK_UNSTABLE,
        Inaccurate = SIGNORINI_FALLBACK_INACCURATE,
    }
}

numbers! {
    State {
        Open = SIGNORINI_STATE_OPEN,
        Slip = SIGNORINI_STATE_SLIP,
        Stick = SIGNORINI_STATE_STICK,
    }
}

/// The states of the pairs as numbers.
pub(super) fn state_codes(states: &[State]) -> impl Iterator<Item = i32> {
    states.iter().map(|state| state.number())
}

/// Fills report with zeros; struct_size is sizeof(signorini_report).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_report_default(
    report: *mut SignoriniReport,
    struct_size: u32,
) -> i32 {
    c_entry!(|arrays| { arrays.at(1, "report").fill(report, struct_size) })
}

/// Static text for one remark, such as "every gap is negative"; never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn signorini_remark_string(remark: i32) -> *const c_char {
    let text = match remark {
        SIGNORINI_REMARK_GAPS_NEGATIVE => c"every gap is negative",
        SIGNORINI_REMARK_FRICTION_LARGE => c"a coefficient of friction is above 10",
        SIGNORINI_REMARK_FREE_MOTION => c"the bodies may move without any force",
        SIGNORINI_REMARK_HELD_BY_ROUNDING => c"only rounding of K holds a body",
        SIGNORINI_REMARK_NEEDS_LOW_PART => c"d rounded to doubles misses the tolerance",
        SIGNORINI_REMARK_GAPS_PASSED => c"the penetration is large beside the gaps",
        _ => c"unknown remark",
    };
    text.as_ptr()
}
