//! The functions by which a host multiplies and solves by itself.

use crate::linalg::tolerances::AGREES;

/// The matrix that a host's solution stands for: its own with components of `d` held and, if it is a preconditioner, with
/// springs.
#[derive(Clone, Copy, Debug)]
pub struct Held<'a> {
    /// One for each component of `d`: `true` if it is held at zero.
    pub components: &'a [bool],
    /// Springs to add between the tangential components of each pair: a symmetric, positive semi-definite matrix,
    /// `(dim - 1)²` entries for each pair. Those of held components do not count. Empty but for a preconditioner.
    pub springs: &'a [f64],
    /// `false` if both are those of the call before, and that call has not failed.
    pub changed: bool,
}

/// The functions of a host. Vectors are relative displacements and forces of the pairs, `A = K_rel`, or have an entry for
/// each of its unknowns. A function that returns `Err` has failed; the message names its number.
pub trait HostOperator: Send + Sync {
    /// `y = A x`, symmetric and positive semi-definite; on all unknowns exact but for rounding.
    ///
    /// # Errors
    /// A number of the host.
    fn stiffness(&self, x: &[f64], y: &mut [f64]) -> Result<(), i32>;

    /// The part of their sizes to which products and solutions of the pairs are linear, symmetric and the same each time: no
    /// tolerance below it can be met.
    fn accuracy(&self) -> f64 {
        AGREES
    }

    /// Returns `true` if there is [`Self::inverse`].
    fn has_inverse(&self) -> bool {
        false
    }

    /// `y = W x`, symmetric and positive definite, close to the inverse of `K_rel`.
    ///
    /// # Errors
    /// A number of the host.
    fn inverse(&self, _x: &[f64], _y: &mut [f64]) -> Result<(), i32> {
        Err(-1)
    }

    /// Returns `true` if there is [`Self::held`]; it is not asked of a preconditioner.
    fn has_held(&self) -> bool {
        false
    }

    /// `y`, zero in components that are held, with `A y = x` in the others. A preconditioner on all unknowns gives a `y` near
    /// that: no accuracy is asked, nor that the map is linear or symmetric, and entries at held components do not count.
    ///
    /// # Errors
    /// A number of the host.
    fn held(&self, _held: &Held<'_>, _x: &[f64], _y: &mut [f64]) -> Result<(), i32> {
        Err(-1)
    }
}
