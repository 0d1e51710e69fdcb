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
        let zeros = vec![0.0; n];
        let second = solution.second.as_deref();
        let (radius_d, radius_force) = radii(solution);
        let vectors = [
            solution.recession.as_ref().unwrap_or(&zeros),
            solution.escape.as_ref().map_or(&zeros, |escape| &escape.motion),
            second.map_or(&zeros, |second| &second.d),
            second.map_or(&zeros, |second| &second.certificate.force),
            &radius_d,
            &radius_force,
            &solution.d_low,
        ];
        for (output, values) in self.vectors.iter().zip(vectors) {
            output.part(n * case, n).write(values);
        }
        let states = second.map(|second| state_codes(&second.certificate.states));
        let states = states.unwrap_or_else(|| vec![0; pairs]);
        self.second_state.part(pairs * case, pairs).write(&states);
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
