//! Results that not every call wants: motions where no equilibrium exists, and a second solution.

use std::iter::repeat;

use super::args::{Arrays, Output};
use super::guard::Failure;
use super::report::state_codes;
use super::structures::{self, Structure};
use crate::solve::{Existence, Solution};

/// Further results: arrays of N entries, of cases a column for each. Fill it by
/// signorini_extra_default(), then set the pointers that you want.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SignoriniExtra {
    /// sizeof(signorini_extra).
    pub struct_size: u32,
    /// 0.
    pub reserved: i32,
    /// With SIGNORINI_STATUS_NO_EQUILIBRIUM a motion r that proves it, its largest entry 1: K r = 0,
    /// and f . r + F . r > 0 for all forces F that the law admits. It lifts slipping pairs by mu
    /// times their slip, as no body does: to draw it, take escape. In flexibility form pressing
    /// normal forces p, the largest -1: W p = 0, and the sum of p_n (gap - q_n) is positive. Else
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
    /// With SIGNORINI_STATUS_NO_EQUILIBRIUM the motion of escape, to be drawn, its largest entry 1:
    /// K r = 0, no pair approaches its obstacle, friction opposes the slip, and f . r > 0, if every
    /// pair of finite gap touches. With SIGNORINI_STATUS_STALLED a motion that proves nothing. Else
    /// zeros.
    pub escape: *mut f64,
    /// The last digits of d: d + d_low is what the report measures; length.
    pub d_low: *mut f64,
}

/// A radius where nothing is proved.
pub(super) const NO_RADIUS: f64 = -1.0;

// SAFETY: led by its size; numbers and pointers.
unsafe impl Structure for SignoriniExtra {}

/// The arrays of the caller's structure.
pub(super) struct Extra {
    /// Motion, escape, displacements and forces of the second solution, radii of displacements and forces, the low part.
    vectors: [Output<f64>; 7],
    second_state: Output<i32>,
}

impl Extra {
    /// Reads the caller's structure for results of `n` unknowns of `pairs` pairs, each `cases`
    /// times; NULL: nothing is wanted.
    pub(super) fn read(
        arrays: &mut Arrays<'_>,
        position: i32,
        pointer: *const SignoriniExtra,
        (n, pairs, cases): (usize, usize, usize),
    ) -> Result<Self, Failure> {
        let given = arrays.copy(position, "extra", pointer)?;
        structures::check_reserved(position, "extra", given.reserved)?;
        // No overflow: the required arrays d and state of the call are as long.
        let mut vector = |name, pointer| arrays.optional_output(position, name, pointer, n * cases);
        let vectors = [
            vector("extra: motion", given.motion)?,
            vector("extra: escape", given.escape)?,
            vector("extra: second_d", given.second_d)?,
            vector("extra: second_F", given.second_F)?,
            vector("extra: radius_d", given.radius_d)?,
            vector("extra: radius_F", given.radius_F)?,
            vector("extra: d_low", given.d_low)?,
        ];
        let (name, state) = ("extra: second_state", given.second_state);
        let second_state = arrays.optional_output(position, name, state, pairs * cases)?;
        Ok(Extra { vectors, second_state })
    }

    /// Writes the results of a case.
    pub(super) fn write(&self, case: usize, solution: &Solution) {
        let (n, pairs) = (solution.d.len(), solution.certificate.states.len());
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
        for (output, (values, nothing)) in self.vectors.iter().zip(vectors) {
            output.part(n * case, n).write_or(values, nothing);
        }
        let states = self.second_state.part(pairs * case, pairs);
        match second {
            Some(second) => states.write_each(state_codes(&second.certificate.states)),
            None => states.write_each(repeat(0)),
        }
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
