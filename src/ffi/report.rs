//! The report of the C interface, led by its size, and the states of pairs.

use super::args::checked_size;
use super::guard::Failure;
use super::settings::method_code;
use crate::certificate::Certificate;
use crate::law::State;
use crate::settings::Method;
use crate::solve::{Fallback, LcpSolution, Solution, Uniqueness};

/// A pair is apart: no normal force, and no tangential one but that of signorini_tresca.
pub const SIGNORINI_OPEN: i32 = 0;
/// A pair touches and |F_t| = mu |F_n|: it slides. Every frictionless contact, at rest or not, is of
/// this state.
pub const SIGNORINI_SLIP: i32 = 1;
/// A pair sticks: d_t = slip.
pub const SIGNORINI_STICK: i32 = 2;

/// Whether there are other solutions is not known.
pub const SIGNORINI_NOT_KNOWN: i32 = 0;
/// Proved: the solution is the only one.
pub const SIGNORINI_UNIQUE: i32 = 1;
/// Proved: there are other solutions.
pub const SIGNORINI_SEVERAL: i32 = 2;

/// The method that was tried first ended it.
pub const SIGNORINI_FALLBACK_NONE: i32 = 0;
/// The first method's states repeated in a cycle.
pub const SIGNORINI_FALLBACK_CYCLE: i32 = 1;
/// The first method met a singular system.
pub const SIGNORINI_FALLBACK_SINGULAR: i32 = 2;
/// The first method found a solution of orientation -1, beside which there are others if K is
/// positive definite.
pub const SIGNORINI_FALLBACK_UNSTABLE: i32 = 3;
/// The first method found no accurate solution.
pub const SIGNORINI_FALLBACK_INACCURATE: i32 = 4;

/// How good a result is. Before the call: report.struct_size = sizeof report; all else is written by
/// it. Forces and lengths are in the units of the problem.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SignoriniReport {
    /// sizeof(signorini_report) of the program: no more than that is written.
    pub struct_size: u32,
    /// What the call returned.
    pub status: i32,
    /// The method that ended it, SIGNORINI_METHOD_...; of signorini_certify 0.
    pub method: i32,
    /// SIGNORINI_NOT_KNOWN, _UNIQUE or _SEVERAL.
    pub uniqueness: i32,
    /// Sweeps, pivots or linear systems, of all methods that were tried.
    pub iterations: i64,
    /// Threshold updates of the nested method.
    pub outer_iterations: i64,
    /// How often Lemke's tableau was computed anew because accuracy was lost.
    pub refactorisations: i64,
    /// Residual of the natural map relative to the forces, without unit; 0 at exact solutions
    /// only.
    pub eta: f64,
    /// Rounding of K d relative to the forces, without unit; beyond 1e-6 nothing is certified.
    pub rounding: f64,
    /// Largest d_n - gap, a length; 0 if none.
    pub penetration: f64,
    /// Largest tensile (positive) normal component of K d - f, a force; 0 if none.
    pub tension: f64,
    /// Largest excess of the tangential part of K d - f over its bound, a force; 0 if none.
    pub cone_excess: f64,
    /// Largest component of K d - f - F, a force.
    pub equilibrium: f64,
    /// Over-relaxation factor at the end; 0 if there is none.
    pub omega: f64,
    /// Damping at the end; 0 if there is none.
    pub damping: f64,
    /// Pairs that are open.
    pub open: i64,
    /// Pairs that slide.
    pub slip: i64,
    /// Pairs that stick.
    pub stick: i64,
    /// Dense factorisations of Newton's method and of block pivoting.
    pub factorisations: i64,
    /// The method that was tried first, SIGNORINI_METHOD_...
    pub first_method: i32,
    /// Why it did not end it, SIGNORINI_FALLBACK_...
    pub fallback: i32,
    /// Sign of the determinant of the system of equations that the states select: +1, or -1 for
    /// an unstable solution, beside which there are at least two others if K is positive definite;
    /// 0 if not known.
    pub orientation: i32,
    /// 0.
    pub reserved: i32,
}

impl SignoriniReport {
    /// The size that the caller set, checked; 0 for NULL, which is allowed.
    ///
    /// # Safety
    /// A pointer that is not NULL has at least 4 readable bytes.
    pub(super) unsafe fn accept(position: i32, pointer: *mut Self) -> Result<usize, Failure> {
        if pointer.is_null() {
            return Ok(0);
        }
        // SAFETY: by the caller's contract.
        unsafe { checked_size::<Self>(position, "report", pointer.cast_const()) }
    }

    /// Writes as much of the report as the caller's structure holds.
    ///
    /// # Safety
    /// A pointer that is not NULL was accepted and has as many bytes as its first field says.
    pub(super) unsafe fn send(mut self, pointer: *mut Self) {
        if pointer.is_null() {
            return;
        }
        // SAFETY: by the caller's contract; the size was checked by `accept`.
        unsafe {
            self.struct_size = pointer.cast::<u32>().read();
            let bytes = self.struct_size as usize;
            std::ptr::copy_nonoverlapping(
                (&raw const self).cast::<u8>(),
                pointer.cast::<u8>(),
                bytes,
            );
        }
    }

    pub(super) fn of(status: i32, solution: &Solution) -> Self {
        let (first, fallback) = tried(solution.method, solution.fallback);
        SignoriniReport {
            method: method_code(solution.method),
            outer_iterations: solution.outer_iterations as i64,
            omega: solution.omega,
            damping: solution.damping,
            iterations: solution.iterations as i64,
            refactorisations: solution.refactorisations as i64,
            factorisations: solution.factorisations as i64,
            uniqueness: uniqueness_code(solution.uniqueness),
            first_method: method_code(first),
            fallback,
            orientation: i32::from(solution.orientation),
            ..Self::of_certificate(status, &solution.certificate)
        }
    }

    pub(super) fn of_certificate(status: i32, certificate: &Certificate) -> Self {
        SignoriniReport {
            eta: certificate.eta,
            rounding: certificate.rounding,
            penetration: certificate.penetration,
            tension: certificate.tension,
            cone_excess: certificate.cone_excess,
            equilibrium: certificate.equilibrium,
            open: certificate.count(State::Open) as i64,
            slip: certificate.count(State::Slip) as i64,
            stick: certificate.count(State::Stick) as i64,
            ..Self::empty(status, Method::Auto)
        }
    }

    pub(super) fn of_lcp(status: i32, solution: &LcpSolution) -> Self {
        let (first, fallback) = tried(solution.method, solution.fallback);
        SignoriniReport {
            eta: solution.eta,
            iterations: solution.iterations as i64,
            refactorisations: solution.refactorisations as i64,
            factorisations: solution.factorisations as i64,
            first_method: method_code(first),
            fallback,
            ..Self::empty(status, solution.method)
        }
    }

    /// One to be filled by a call.
    pub(super) fn blank() -> Self {
        Self::empty(0, Method::Auto)
    }

    fn empty(status: i32, method: Method) -> Self {
        SignoriniReport {
            struct_size: size_of::<Self>() as u32,
            status,
            method: method_code(method),
            uniqueness: SIGNORINI_NOT_KNOWN,
            iterations: 0,
            outer_iterations: 0,
            refactorisations: 0,
            eta: 0.0,
            rounding: 0.0,
            penetration: 0.0,
            tension: 0.0,
            cone_excess: 0.0,
            equilibrium: 0.0,
            omega: 0.0,
            damping: 0.0,
            open: 0,
            slip: 0,
            stick: 0,
            factorisations: 0,
            first_method: method_code(method),
            fallback: SIGNORINI_FALLBACK_NONE,
            orientation: 0,
            reserved: 0,
        }
    }
}

fn uniqueness_code(uniqueness: Uniqueness) -> i32 {
    match uniqueness {
        Uniqueness::NotKnown => SIGNORINI_NOT_KNOWN,
        Uniqueness::Unique => SIGNORINI_UNIQUE,
        Uniqueness::Several => SIGNORINI_SEVERAL,
    }
}

/// The first method, and why it did not end it.
fn tried(method: Method, fallback: Option<(Method, Fallback)>) -> (Method, i32) {
    match fallback {
        None => (method, SIGNORINI_FALLBACK_NONE),
        Some((first, Fallback::Cycle)) => (first, SIGNORINI_FALLBACK_CYCLE),
        Some((first, Fallback::Singular)) => (first, SIGNORINI_FALLBACK_SINGULAR),
        Some((first, Fallback::Unstable)) => (first, SIGNORINI_FALLBACK_UNSTABLE),
        Some((first, Fallback::Inaccurate)) => (first, SIGNORINI_FALLBACK_INACCURATE),
    }
}

pub(super) fn state_code(state: State) -> i32 {
    match state {
        State::Open => SIGNORINI_OPEN,
        State::Slip => SIGNORINI_SLIP,
        State::Stick => SIGNORINI_STICK,
    }
}
