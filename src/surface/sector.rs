//! A sector of a body that repeats about an axis.

use std::f64::consts::TAU;

use super::motion::Motion;
use crate::error::{Argument, Error};
use crate::linalg::vector3::{self, Vector3, turn_about, unit, vector};

/// A sector of a body that consists of such sectors, each turned against the one before.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sector {
    /// A point of the axis; length.
    pub point: [f64; 3],
    /// The direction of the axis, of any length; not read in the plane. The sector reaches from its first boundary, in
    /// the sense of a right-handed turn about it, to the second.
    pub axis: [f64; 3],
    /// Number of sectors of the whole, at least 2.
    pub count: usize,
}

impl Sector {
    /// The sector with its axis as a unit vector.
    ///
    /// # Errors
    /// Fewer than two sectors; an axis without direction; a point that is not finite.
    pub(super) fn checked(self, dim: usize) -> Result<Sector, Error> {
        let refuse =
            |what: &str| Err(Error::invalid(Argument::Settings, format!("sector: {what}")));
        let [x, y, z] = self.axis;
        let axis = if dim == 2 { Some(vector3::axis(2)) } else { unit(self.axis.into()) };
        let Some(axis) = axis else {
            return refuse(&format!("its axis {x}, {y}, {z} is no direction"));
        };
        if self.count < 2 {
            return refuse(&format!("there are {} of them, a whole has at least 2", self.count));
        }
        let point = vector(&self.point[..dim]);
        if !point.iter().all(|x| x.is_finite()) {
            return refuse("its point is not finite");
        }
        Ok(Sector { point: point.into(), axis: axis.into(), count: self.count })
    }

    /// The direction of the axis.
    pub(super) fn axis(&self) -> Vector3 {
        unit(self.axis.into()).unwrap_or_default()
    }

    /// The nearest point of the axis to one in units of `scale`.
    pub(super) fn foot(&self, x: Vector3, scale: f64) -> Vector3 {
        let point = scale * Vector3::from(self.point);
        point + self.axis().dot(&(x - point)) * self.axis()
    }

    /// The motion of an image some sectors on.
    pub(super) fn motion(&self, by: i32) -> Motion {
        let angle = f64::from(by) * TAU / self.count as f64;
        Motion::about(self.point.into(), turn_about(self.axis(), angle))
    }
}
