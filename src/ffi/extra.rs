//! Results that not every call wants: motions where no equilibrium exists, and a second solution.

use super::args::{Arrays, Output};
use super::guard::Failure;
use super::report::state_codes;
use super::structures::{self, Structure};
use crate::solve::{Existence, Solution};

/// Further results: arrays of N entries, of cases a column for each. Fill it by
/// signorini_extra_default(), then set the pointers that you want.
#[repr(C)]
#[derive(Clone, Copy)]
#[allow(non_snake_case)] // the names of the mechanics, which the header shows
pub struct SignoriniExtra {
    /// sizeof(signorini_extra).
    pub struct_size: u32,
    /// 0.
    pub reserved: i32,
    /// With SIGNORINI_STATUS_NO_EQUILIBRIUM a motion r that proves it, its largest entry 1:
    /// K r = 0, and f . r + F . r > 0 for all forces F that the law admits. It lifts slipping pairs
    /// by mu times their slip, as no body moves: draw escape. In flexibility form pressing normal
    /// forces p, the largest -1: W p = 0, and the sum of p_n (gap - q_n) is positive. Else zeros.
    pub motion: *mut f64,
    /// Displacements of a second solution if report.second is 1; else zeros.
    pub second_d: *mut f64,
    /// Its contact forces; else zeros.
    pub second_F: *mut f64,
    /// Its states, one for each pair; else zeros.
    pub second_state: *mut i32,
    /// With SIGNORINI_PROOF_PROVED the solution lies within this distance of d, component by
    /// component; length. Else -1.
    pub radius_d: *mut f64,
    /// Likewise of the contact forces; force.
    pub radius_F: *mut f64,
    /// With SIGNORINI_STATUS_NO_EQUILIBRIUM the motion of escape, to be drawn, its largest entry 1:
    /// K r = 0, no pair approaches its obstacle, friction opposes the slip, and f . r > 0, if every
    /// pair of finite gap touches. If stalled, a motion that proves nothing. Else zeros.
    pub escape: *mut f64,
}

/// A radius where nothing is proved.
pub(super) const NO_RADIUS: f64 = -1.0;

// SAFETY: led by its size; numbers and pointers.
unsafe impl Structure for SignoriniExtra {}

/// The arrays of the caller's structure.
pub(super) struct Extra {
    n: usize,
    pairs: usize,
    motion: Output<f64>,
    second_d: Output<f64>,
    second_force: Output<f64>,
    second_state: Output<i32>,
    radius_d: Output<f64>,
    radius_force: Output<f64>,
    escape: Output<f64>,
}

impl Extra {
    /// Reads the caller's structure for results of `n` unknowns of `pairs` pairs, each `cases`
    /// times; NULL: nothing is wanted.
    ///
    /// # Safety
    /// A pointer that is not NULL has as many readable bytes as its first field says, and its
    /// pointers are NULL or have the lengths of the header.
    pub(super) unsafe fn read(
        arrays: &mut Arrays,
        position: i32,
        pointer: *const SignoriniExtra,
        (n, pairs, cases): (usize, usize, usize),
    ) -> Result<Self, Failure> {
        // SAFETY: by the caller's contract.
        let given = unsafe { structures::read(position, "extra", pointer)? };
        if given.reserved != 0 {
            let message = format!("extra: reserved is {}, it must be 0", given.reserved);
            return Err(Failure::argument(position, message));
        }
        // SAFETY: by the caller's contract.
        unsafe { arrays.structure(position, "extra", pointer, false)? };
        // No overflow: the required arrays d and state of the call are as long.
        let (all, all_pairs) = (n * cases, pairs * cases);
        let mut vector = |name, pointer| arrays.optional_output(position, name, pointer, all);
        Ok(Extra {
            n,
            pairs,
            motion: vector("extra: motion", given.motion)?,
            second_d: vector("extra: second_d", given.second_d)?,
            second_force: vector("extra: second_F", given.second_F)?,
            radius_d: vector("extra: radius_d", given.radius_d)?,
            radius_force: vector("extra: radius_F", given.radius_F)?,
            escape: vector("extra: escape", given.escape)?,
            second_state: arrays.optional_output(
                position,
                "extra: second_state",
                given.second_state,
                all_pairs,
            )?,
        })
    }

    /// Writes the results of a case.
    ///
    /// # Safety
    /// The arrays have the lengths of the header and overlap nothing.
    pub(super) unsafe fn write(&self, case: usize, solution: &Solution) {
        let (n, pairs) = (self.n, self.pairs);
        let zeros = vec![0.0; n];
        let motion = solution.recession.as_deref().unwrap_or(&zeros);
        let escape = solution.escape.as_ref().map_or(&zeros[..], |escape| &escape.motion);
        let second = solution.second.as_deref();
        let d = second.map_or(&zeros[..], |second| &second.d);
        let force = second.map_or(&zeros[..], |second| &second.certificate.force);
        let states =
            second.map_or_else(|| vec![0; pairs], |second| state_codes(&second.certificate.states));
        let (radius_d, radius_force) = radii(solution);
        // SAFETY: by the caller's contract.
        unsafe {
            self.radius_d.part(n * case, n).write(&radius_d);
            self.radius_force.part(n * case, n).write(&radius_force);
            self.motion.part(n * case, n).write(motion);
            self.escape.part(n * case, n).write(escape);
            self.second_d.part(n * case, n).write(d);
            self.second_force.part(n * case, n).write(force);
            self.second_state.part(pairs * case, pairs).write(&states);
        }
    }
}

/// Distances of the proved solution from what the caller receives.
fn radii(solution: &Solution) -> (Vec<f64>, Vec<f64>) {
    match &solution.existence {
        Existence::Proved(proof) => {
            (proof.radius_about(&solution.d), proof.force_radius_about(&solution.certificate.force))
        }
        _ => (vec![NO_RADIUS; solution.d.len()], vec![NO_RADIUS; solution.d.len()]),
    }
}

/// Fills extra with NULL pointers; struct_size is sizeof(signorini_extra).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_extra_default(
    extra: *mut SignoriniExtra,
    struct_size: u32,
) -> i32 {
    // SAFETY: the caller's structure has `struct_size` bytes, as the header demands.
    unsafe { structures::fill("extra", extra, struct_size) }
}
