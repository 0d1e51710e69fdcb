//! The frame of a contact pair: its normal and its tangents.

use crate::linalg::vector3::{self, Vector3, unit};

/// Directions of seven digits are known up to a tenth of this (radians). A tangent that is further from orthogonal to
/// its normal belongs to another pair, or to no frame at all; one that is nearer to an axis is along it.
const ERROR_OF_DIRECTION: f64 = 1e-5;

/// Orthonormal: the normal, then `dim - 1` tangents. In space `t2 = n x t1`.
#[derive(Clone, Debug)]
pub(super) struct Frame {
    dim: usize,
    directions: [Vector3; 3],
}

impl Frame {
    /// The frame of a normal of any length and, if given, the first tangent, which is orthogonal to the
    /// normal but for rounding and is made so. Without one it is the normal turned by +90 degrees in the plane, and in space
    /// one across the axis that is most across the normal.
    ///
    /// # Errors
    /// A sentence on the normal or the tangent: "normal is zero or not finite".
    pub(super) fn new(normal: &[f64], tangent: Option<&[f64]>) -> Result<Self, String> {
        let dim = normal.len();
        let normal = unit(vector3::vector(normal)).ok_or("normal is zero or not finite")?;
        let first = match tangent {
            Some(tangent) => {
                let given =
                    unit(vector3::vector(tangent)).ok_or("tangent is zero or not finite")?;
                let cosine = given.dot(&normal);
                if cosine.abs() > ERROR_OF_DIRECTION {
                    return Err(not_orthogonal(cosine));
                }
                unit(given - cosine * normal).unwrap_or(given)
            }
            None if dim == 2 => Vector3::new(-normal.y, normal.x, 0.0),
            None => {
                let across = vector3::axis(normal.iamin());
                unit(across.cross(&normal)).unwrap_or(across)
            }
        };
        let second = if dim == 3 { normal.cross(&first) } else { Vector3::zeros() };
        Ok(Frame { dim, directions: [normal, first, second] })
    }

    /// Normal and tangents, component by component of `d`.
    pub(super) fn directions(&self) -> impl Iterator<Item = &[f64]> {
        self.directions[..self.dim].iter().map(|direction| &direction.as_slice()[..self.dim])
    }

    /// The component of `d` whose direction is along an axis.
    pub(super) fn component_along(&self, axis: usize) -> Option<usize> {
        let sine = |direction: &Vector3| {
            let mut across = *direction;
            across[axis] = 0.0;
            across.norm()
        };
        (0..self.dim).find(|&component| sine(&self.directions[component]) <= ERROR_OF_DIRECTION)
    }

    /// Turns the frame so that the direction of `component`, which is along `axis` but for rounding,
    /// is exactly so.
    pub(super) fn align(&mut self, component: usize, axis: usize) {
        let exact = vector3::axis(axis) * self.directions[component][axis].signum();
        self.directions[component] = exact;
        let [next, last] = [1, 2].map(|step| (component + step) % 3);
        if self.dim == 2 {
            let other = 1 - component;
            let across = vector3::axis(1 - axis);
            self.directions[other] = across * self.directions[other][1 - axis].signum();
            return;
        }
        self.directions[next][axis] = 0.0;
        self.directions[next] =
            unit(self.directions[next]).unwrap_or_else(|| vector3::axis((axis + 1) % 3));
        self.directions[last] = exact.cross(&self.directions[next]);
    }
}

fn not_orthogonal(cosine: f64) -> String {
    format!(
        "tangent is not orthogonal to its normal (cosine {cosine:.2e}): subtract its part along the normal"
    )
}
