//! A sector of a body that repeats about an axis, or along one line or two.

use std::f64::consts::TAU;

use super::motion::Motion;
use crate::error::{Argument, Error};
use crate::linalg::vector3::{self, ERROR_OF_DIRECTION, Vector3, turn_about, unit, vector};

/// A sector of a body that consists of such sectors, each turned or shifted against the one before.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sector {
    /// A point of the axis; length.
    pub point: [f64; 3],
    /// The direction of the axis, of any length; not read in the plane. The sector reaches from its first boundary, in
    /// the sense of a right-handed turn about it, to the second.
    pub axis: [f64; 3],
    /// Number of sectors of the whole, at least 2.
    pub count: usize,
    /// The ways from a first boundary to a second, of a body that repeats along a line without end, or along two; else
    /// zero. Then the fields before are not read.
    pub periods: [[f64; 3]; 2],
}

impl Sector {
    /// The sector with its axis as a unit vector.
    ///
    /// # Errors
    /// Fewer than two sectors; an axis without direction; a point that is not finite; a period that is none.
    pub(super) fn checked(self, dim: usize) -> Result<Sector, Error> {
        let refuse =
            |what: &str| Err(Error::invalid(Argument::Settings, format!("sector: {what}")));
        if self.is_shifted() {
            let periods = self.periods.map(|period| vector(&period[..dim]));
            let ways = periods.map(unit);
            // One way may be left out.
            let is_none = |k: &usize| ways[*k].is_none() && is_given(&self.periods[*k]);
            if let Some(k) = (0..ways.len()).find(is_none) {
                let [x, y, z] = self.periods[k];
                return refuse(&format!("its period {x}, {y}, {z} is no way"));
            }
            if let [Some(one), Some(other)] = ways
                && one.cross(&other).norm() < ERROR_OF_DIRECTION
            {
                return refuse("its two periods are along one line: give the shorter one alone");
            }
            return Ok(Sector { count: 1, periods: periods.map(Into::into), ..Sector::default() });
        }
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
        Ok(Sector { point: point.into(), axis: axis.into(), ..self })
    }

    /// `true` of a sector that is shifted, and has no axis.
    pub(super) fn is_shifted(&self) -> bool {
        self.periods.iter().any(is_given)
    }

    /// The direction of the axis.
    pub(super) fn axis(&self) -> Vector3 {
        unit(self.axis.into()).unwrap_or_default()
    }

    /// The nearest point of the axis to one in units of `scale`; without an axis the point itself.
    pub(super) fn foot(&self, x: Vector3, scale: f64) -> Vector3 {
        if self.is_shifted() {
            return x;
        }
        let point = scale * Vector3::from(self.point);
        point + self.axis().dot(&(x - point)) * self.axis()
    }

    /// `true` if it is another one but for rounding, on bodies within so much of the origin.
    pub(super) fn is(&self, other: &Sector, size: f64) -> bool {
        let [own, others] = [self, other].map(Sector::steps);
        own.len() == others.len()
            && own.iter().zip(&others).all(|([own, _], [other, _])| own.is(other, size))
    }

    /// The motions to the next sector and back, for each of the ways that there are, with two periods along both at once too:
    /// a part may touch its image at a corner alone, or along a third line.
    pub(super) fn steps(&self) -> Vec<[Motion; 2]> {
        if self.is_shifted() {
            let given = self.periods.map(Vector3::from);
            let mut ways: Vec<Vector3> = given.into_iter().filter(|way| way.amax() > 0.0).collect();
            if let [one, other] = ways[..] {
                ways.extend([one + other, one - other]);
            }
            return ways.into_iter().map(|way| [way, -way].map(Motion::shift)).collect();
        }
        let angle = TAU / self.count as f64;
        let turned = |angle| Motion::about(self.point.into(), turn_about(self.axis(), angle));
        vec![[angle, -angle].map(turned)]
    }
}

/// `true` of a period that was not left out.
fn is_given(period: &[f64; 3]) -> bool {
    period.iter().any(|part| *part != 0.0)
}
