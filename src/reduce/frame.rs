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

#[cfg(test)]
mod tests {
    use super::Frame;

    /// A normal of seven digits along y: the frame is that of the exact normal.
    #[test]
    fn a_frame_is_aligned_with_an_axis() {
        let rounded = [3e-7, -0.9999999, -8e-7];
        let mut frame = Frame::new(&rounded, Some(&[1.0, 0.0, 0.5])).unwrap();
        assert_eq!(frame.component_along(1), Some(0));
        frame.align(0, 1);
        let directions: Vec<Vec<f64>> = frame.directions().map(<[f64]>::to_vec).collect();
        assert_eq!(directions[0], [0.0, -1.0, 0.0]);
        let length = 1.25_f64.sqrt();
        for (i, exact) in [(1, [1.0, 0.0, 0.5]), (2, [-0.5, 0.0, 1.0])] {
            for (c, e) in directions[i].iter().zip(exact) {
                assert!((c - e / length).abs() < 2e-6, "{directions:?}");
            }
        }
        let inclined = Frame::new(&[1e-4, -1.0], None).unwrap();
        assert_eq!(inclined.component_along(1), None);
    }

    /// Any direction of a frame may be along any axis, up or down: it is then exactly so, the frame is orthonormal
    /// and turned the same way round, and no direction has changed by more than the rounding.
    #[test]
    fn every_direction_is_aligned_with_every_axis() {
        let near = 3e-7;
        for dim in [2, 3] {
            for (axis, sign) in (0..dim).flat_map(|axis| [(axis, 1.0), (axis, -1.0)]) {
                for turn in [0.4, 2.0, 3.5, 5.5] {
                    let mut along = [0.0; 3];
                    along[axis] = sign;
                    along[(axis + 1) % dim] += near;
                    let mut across = [0.0; 3];
                    across[(axis + 1) % dim] = f64::cos(turn);
                    if dim == 3 {
                        across[(axis + 2) % 3] = f64::sin(turn);
                        along[(axis + 2) % 3] = -near;
                    }
                    let frames = [
                        Frame::new(&along[..dim], None).unwrap(),
                        Frame::new(&across[..dim], Some(&along[..dim])).unwrap(),
                        Frame::new(&across[..dim], None).unwrap(),
                    ];
                    for frame in frames {
                        check(frame, axis, 4.0 * near);
                    }
                }
            }
        }
    }

    /// Checks frames that have a direction along the axis.
    fn check(frame: Frame, axis: usize, near: f64) {
        let Some(component) = frame.component_along(axis) else { return };
        let of =
            |frame: &Frame| -> Vec<Vec<f64>> { frame.directions().map(<[f64]>::to_vec).collect() };
        let mut aligned = frame.clone();
        aligned.align(component, axis);
        let (before, after) = (of(&frame), of(&aligned));
        assert_eq!(after[component][axis].abs(), 1.0);
        for (i, one) in after.iter().enumerate() {
            assert!(one.iter().zip(&before[i]).all(|(a, b)| (a - b).abs() <= near), "{after:?}");
            assert!(i == component || one[axis] == 0.0, "{after:?}");
            for (j, other) in after.iter().enumerate() {
                let dot: f64 = one.iter().zip(other).map(|(a, b)| a * b).sum();
                assert!((dot - f64::from(u8::from(i == j))).abs() <= 1e-15, "{after:?}");
            }
        }
    }
}
