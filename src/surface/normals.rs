//! Normals of faces, where a pair has those and not the mean at its slave node.

use super::face::Face;
use super::plane::Plane;
use super::shape::{Local, MOST_NODES, padded};
use crate::error::{Argument, Error, index};
use crate::linalg::tolerances::ROUNDING;
use crate::linalg::vector3::{Vector3, unit};

/// Steps to the foot of a perpendicular. Each reduces the error by the distance over the radius of curvature; from
/// half of that radius this many reach the last digits, and Newton's method needs fewer.
pub(super) const MOST_STEPS: usize = 60;

/// A sum of unit normals this small beside their number or area, or the rest of one that lies across a plane, has no
/// direction of its own.
const LEAST_NORMAL: f64 = 1e-6;

/// Unit normals of a face at its nodes.
pub(super) fn at_nodes(face: &Face<'_>) -> [Vector3; MOST_NODES] {
    padded(face.kind.places().iter().map(|&place| face.normal(place)))
}

/// The direction of a sum of unit normals times areas; `None` if they cancel. `area` is the sum of the areas.
pub(super) fn direction(sum: Vector3, area: f64) -> Option<Vector3> {
    unit(sum).filter(|_| sum.norm() > LEAST_NORMAL * area)
}

/// The error of a slave node at which they cancel.
pub(super) fn cancel(node: usize) -> Error {
    let message = format!(
        "the normals of the slave faces at node {} cancel: leave out those of them that cannot touch, or pair \
         the two sides of a thin body in two calls and join them as two zones",
        index(node)
    );
    Error::invalid(Argument::SlaveFaces, message)
}

/// The point of a face, or of its continuation, from which the perpendicular leads to `x`: local coordinates
/// and the face's unit normal there. `None` if steps along normals do not lead to one. Normals have the rounding of coordinates
/// beside the size of the face.
pub(super) fn foot(face: &Face<'_>, x: Vector3) -> Option<(Local, Vector3)> {
    let mut normal = face.middle_normal();
    let rounding = ROUNDING * (1.0 + x.amax() / face.size());
    for _ in 0..MOST_STEPS {
        let at = Plane::new(face.kind.dim(), x, normal).flatten(face).local([0.0; 2])?;
        let next = unit(face.outward(at))?;
        let change = (next - normal).norm();
        normal = next;
        if change <= rounding {
            return Some((at, normal));
        }
    }
    None
}
