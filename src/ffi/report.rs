//! The report of the C interface, led by its size, and the states of pairs.

use super::args::checked_size;
use super::guard::Failure;
use super::settings::method_code;
use crate::law::State;
use crate::settings::Method;
use crate::solve::{LcpSolution, Solution};

/// A pair is apart: no normal force, and no tangential one but that of signorini_tresca.
pub const SIGNORINI_OPEN: i32 = 0;
/// A pair touches and |F_t| = mu |F_n|: it slides. Every frictionless contact, at rest or not, is of
/// this state.
pub const SIGNORINI_SLIP: i32 = 1;
/// A pair sticks: d_t = slip.
pub const SIGNORINI_STICK: i32 = 2;

/// How good a result is. Before the call: report.struct_size = sizeof report; all else is written by
/// it. Forces and lengths are in the units of the problem.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SignoriniReport {
    /// sizeof(signorini_report) of the program: no more than that is written.
    pub struct_size: u32,
    /// What the call returned.
    pub status: i32,
    /// The method that ended it, SIGNORINI_METHOD_...
    pub method: i32,
    /// 0.
    pub reserved: i32,
    /// Sweeps or pivots.
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

    pub(super) fn of(status: i32, method: Method, solution: &Solution) -> Self {
        let certificate = &solution.certificate;
        SignoriniReport {
            outer_iterations: solution.outer_iterations as i64,
            rounding: certificate.rounding,
            penetration: certificate.penetration,
            tension: certificate.tension,
            cone_excess: certificate.cone_excess,
            equilibrium: certificate.equilibrium,
            omega: solution.omega,
            damping: solution.damping,
            open: certificate.count(State::Open) as i64,
            slip: certificate.count(State::Slip) as i64,
            stick: certificate.count(State::Stick) as i64,
            eta: certificate.eta,
            iterations: solution.iterations as i64,
            refactorisations: solution.refactorisations as i64,
            ..Self::empty(status, method)
        }
    }

    pub(super) fn of_lcp(status: i32, solution: &LcpSolution) -> Self {
        SignoriniReport {
            eta: solution.eta,
            iterations: solution.iterations as i64,
            refactorisations: solution.refactorisations as i64,
            ..Self::empty(status, Method::Lemke)
        }
    }

    fn empty(status: i32, method: Method) -> Self {
        SignoriniReport {
            struct_size: size_of::<Self>() as u32,
            status,
            method: method_code(method),
            reserved: 0,
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
        }
    }
}

pub(super) fn state_code(state: State) -> i32 {
    match state {
        State::Open => SIGNORINI_OPEN,
        State::Slip => SIGNORINI_SLIP,
        State::Stick => SIGNORINI_STICK,
    }
}
