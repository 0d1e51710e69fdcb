//! Motions that lay a body upon its image: turns about an axis, mirror images, and both one after the other.

use crate::linalg::tolerances::ROUNDING_OF_SUM;
use crate::linalg::vector3::{Matrix3, Vector3};

/// `x -> Q x + shift` with an orthogonal `Q`, in the host's unit of length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Motion {
    /// `Q`: displacements move by it.
    pub(super) turn: Matrix3,
    shift: Vector3,
}

impl Motion {
    /// The one that leaves all where it is.
    pub(super) fn none() -> Motion {
        Motion::shift(Vector3::zeros())
    }

    /// A shift.
    pub(super) fn shift(shift: Vector3) -> Motion {
        Motion { turn: Matrix3::identity(), shift }
    }

    /// A turn about a point.
    pub(super) fn about(point: Vector3, turn: Matrix3) -> Motion {
        Motion { turn, shift: point - turn * point }
    }

    /// The mirror image at a plane across a unit vector, so far along it.
    pub(super) fn mirror(across: Vector3, at: f64) -> Motion {
        let turn = Matrix3::identity() - 2.0 * across * across.transpose();
        Motion { turn, shift: 2.0 * at * across }
    }

    /// The image of a point.
    pub(super) fn of(&self, x: Vector3) -> Vector3 {
        self.turn * x + self.shift
    }

    /// Another motion, and then this one.
    pub(super) fn after(&self, first: &Motion) -> Motion {
        Motion { turn: self.turn * first.turn, shift: self.of(first.shift) }
    }

    /// How far apart it and another one move points within so much of a middle, at most but for a factor.
    pub(super) fn apart(&self, other: &Motion, (middle, size): (Vector3, f64)) -> f64 {
        (self.of(middle) - other.of(middle)).amax() + size * (self.turn - other.turn).amax()
    }

    /// `true` if it is another one but for rounding, on bodies within so much of the origin.
    pub(super) fn is(&self, other: &Motion, size: f64) -> bool {
        self.apart(other, (Vector3::zeros(), size)) <= ROUNDING_OF_SUM * size
    }

    /// `true` of one that turns faces over.
    pub(super) fn mirrors(&self) -> bool {
        self.turn.determinant() < 0.0
    }
}
