//! Faces that are refused for their shape, and neighbours of which one is turned over.

use std::collections::HashMap;

use super::mesh::{ON_PLANE, Side};
use super::watch::Watch;
use crate::error::{Error, index};

/// A face whose area, at one of its nodes, is below this part of the square of its size has none: 1e-10
/// is a corner of a ten-thousandth of a degree, far below what a mesh for computations has.
const LEAST_AREA: f64 = 1e-10;

impl Side<'_> {
    /// Refuses a face without area, and one that turns over in itself.
    pub(super) fn check_shape(&self, at: usize) -> Result<(), Error> {
        let face = self.face(at);
        let size = face.size();
        let inner = |&&node: &&usize| self.position(node).x < -ON_PLANE * size;
        if let Some(&node) = face.nodes.iter().find(inner).filter(|_| face.is_ring) {
            let radius = self.coordinates[self.dim * node];
            let what =
                format!("has node {} at the radius {radius}, beyond the axis x = 0", index(node));
            return Err(self.refuse(at, &what));
        }
        let least = LEAST_AREA * if self.dim == 2 { size } else { size * size };
        let middle = face.outward(face.kind.centre());
        // Written so that zero and NaN are refused.
        if !(middle.norm() > least) {
            return Err(self.refuse(at, "has no area: its nodes coincide or stand in one line"));
        }
        for (i, &place) in face.kind.places().iter().enumerate() {
            let normal = face.outward(place);
            if !(normal.norm() > least && normal.dot(&middle) > 0.0) {
                let what = format!(
                    "is folded at node {}: check the order of its nodes, the number from which \
                     they count, and that corners are convex and mid nodes near the middle of their edges",
                    index(face.nodes[i])
                );
                return Err(self.refuse(at, &what));
            }
        }
        Ok(())
    }

    /// Refuses neighbours that run along their common edge in the same direction.
    pub(super) fn check_orientation(&self, watch: &mut Watch<'_, '_>) -> Result<(), Error> {
        let mut seen: HashMap<(usize, usize), usize> =
            HashMap::with_capacity(self.faces.nodes.len());
        for face in 0..self.count() {
            watch.goes_on()?;
            let corners = self.corners(face);
            for (i, &a) in corners.iter().enumerate() {
                let b = corners[(i + 1) % corners.len()];
                // On a line the node and its end: 0 if it begins there, 1 if it ends there.
                let key = if self.dim == 2 { (a, i) } else { (a, b) };
                if let Some(other) = seen.insert(key, face) {
                    let where_ = if self.dim == 2 {
                        format!("node {}", index(a))
                    } else {
                        format!("the edge of nodes {} and {}", index(a), index(b))
                    };
                    let what = format!(
                        "and face {} disagree at {where_}: one of them is turned over, or they lie \
                         upon each other; turn the order of its nodes, or leave it out",
                        index(other)
                    );
                    return Err(self.refuse(face, &what));
                }
            }
        }
        Ok(())
    }
}
