//! The frame of a contact pair: its normal and its tangents.

use crate::linalg::vector3::{self, ERROR_OF_DIRECTION, Vector3, most_across, unit};

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
                    return Err(format!(
                        "tangent is not orthogonal to its normal (cosine {cosine:.2e}): subtract its part along \
                         the normal"
                    ));
                }
                unit(given - cosine * normal).unwrap_or(given)
            }
            None if dim == 2 => Vector3::new(-normal.y, normal.x, 0.0),
            None => {
                let across = most_across(normal);
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

    /// The direction of a component of `d`.
    pub(super) fn direction(&self, component: usize) -> Vector3 {
        self.directions[component]
    }

    /// The component of `d` along a direction.
    fn component_along(&self, direction: &Vector3) -> Option<usize> {
        let sine = |own: &Vector3| (own - own.dot(direction) * direction).norm();
        (0..self.dim).find(|&c| sine(&self.directions[c]) <= ERROR_OF_DIRECTION)
    }

    /// The components of `d` along directions that supports hold, `held` orthonormal; the frame is turned exactly
    /// along them. If it `may_turn` about its normal, it is turned as far as that takes. `None` if no components are
    /// along them.
    pub(super) fn along(&mut self, held: &[Vector3], may_turn: bool) -> Option<Vec<usize>> {
        // The direction that is alone: the held one, or the one that is not.
        let (lone, is_held) = match *held {
            [] => return Some(Vec::new()),
            [lone] => (lone, true),
            [first, second] if self.dim == 3 => (unit(first.cross(&second))?, false),
            _ => return Some((0..self.dim).collect()),
        };
        let mut along = self.component_along(&lone);
        let across_normal = self.directions[0].dot(&lone).abs() <= ERROR_OF_DIRECTION;
        if along.is_none() && may_turn && across_normal && self.dim == 3 {
            self.directions[2] = lone;
            along = Some(2);
        }
        let along = along?;
        self.align(along, lone * self.directions[along].dot(&lone).signum());
        Some((0..self.dim).filter(|c| (*c == along) == is_held).collect())
    }

    /// Turns the frame so that the direction of `component`, which is `exact` but for rounding, is exactly so.
    fn align(&mut self, component: usize, exact: Vector3) {
        self.directions[component] = exact;
        if self.dim == 2 {
            let across = Vector3::new(-exact.y, exact.x, 0.0);
            let other = &mut self.directions[1 - component];
            *other = across * other.dot(&across).signum();
            return;
        }
        let [next, last] = [1, 2].map(|step| (component + step) % 3);
        let across = self.directions[next];
        let across = unit(across - across.dot(&exact) * exact);
        self.directions[next] = across.unwrap_or(self.directions[next]);
        self.directions[last] = exact.cross(&self.directions[next]);
    }
}
