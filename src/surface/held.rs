//! The slave faces that pairs do not hold: those that are asked if they have passed through the master.
//!
//! A pair holds its node along the normal before the motion, against the faces that lay over it. Where it slides far beside the
//! size of its faces, others lie over it, or the same ones at another height if they are inclined to that normal; these faces of
//! the slave are asked as those without a pair are.

use std::collections::BTreeSet;

use super::digits::ON_PLANE;
use super::face::Face;
use super::kept_surfaces::KeptSurfaces;
use super::mesh::Side;
use super::pairs::{SurfacePairs, Weight};
use crate::linalg::vector3::{Vector3, vector, without};

/// Pairs hold their nodes in the mean: between nodes, and where a node is folded, faces of two curved surfaces pass by a
/// small share of their size.
const LEAST_OF_PAIRED: f64 = 0.1;

/// The nodes that pairs hold, and the slave faces that are asked.
pub(super) struct Held {
    /// By place of the node.
    pub(super) nodes: Vec<bool>,
    /// Ascending.
    uncovered: Vec<usize>,
    pub(super) asked: Vec<usize>,
}

impl Held {
    /// The least depth that counts of a point of a slave face: at a node, or in the middle.
    pub(super) fn least(&self, at: usize, face: &Face<'_>, place: Option<usize>) -> f64 {
        let is_held = |place: &usize| self.nodes[*place];
        let of_face =
            || self.uncovered.binary_search(&at).is_err() && face.nodes.iter().any(is_held);
        face.size() * least_share(place.as_ref().map_or_else(of_face, is_held))
    }
}

/// The least depth that counts, beside the size of a face: where pairs hold it, and elsewhere.
pub(super) fn least_share(is_held: bool) -> f64 {
    if is_held { LEAST_OF_PAIRED } else { ON_PLANE }
}

impl KeptSurfaces {
    /// The nodes that pairs hold, and the faces that these do not hold wholly or along which they slide far.
    pub(super) fn held(&self, pairs: &SurfacePairs, moved: &[f64], slave: &Side<'_>) -> Held {
        let [start, places] = &self.slave;
        let slides = self.slides(pairs, moved);
        let home = |node: &usize| pairs.images.home(*node).0;
        let slides: Vec<Option<f64>> =
            self.nodes.iter().map(|node| slides.get(home(node)).copied().flatten()).collect();
        let folded: BTreeSet<usize> = pairs.report.folded.iter().map(|fold| fold.node).collect();
        let [uncovered, in_part] = [&pairs.report.uncovered_faces, &pairs.report.held_in_part];
        let is_asked = |at: &usize| {
            let own = &places[start[*at]..start[at + 1]];
            let stay = |size: f64| {
                let far = LEAST_OF_PAIRED * size;
                own.iter().all(|place| slides[*place].is_some_and(|slide| slide <= far))
            };
            // An edge is no longer than the face.
            let edge = || (slave.position(own[1]) - slave.position(own[0])).norm();
            let [uncovered, in_part] = [uncovered, in_part].map(|list| list.binary_search(at));
            let is_left = || stay(edge()) || stay(slave.face(*at).size());
            uncovered.is_ok() || in_part.is_ok() || !is_left()
        };
        let asked = (0..start.len() - 1).filter(is_asked).collect();
        let is_folded = |node: &usize| !folded.is_empty() && folded.contains(&home(node));
        let nodes = slides.iter().zip(&self.nodes);
        let nodes = nodes.map(|(slide, node)| slide.is_some() || is_folded(node)).collect();
        Held { nodes, uncovered: uncovered.clone(), asked }
    }

    /// How far each node with a pair slides along its tangents, by its number. It is not known if no face has a node of the row, as an
    /// image may be of one.
    fn slides(&self, pairs: &SurfacePairs, moved: &[f64]) -> Vec<Option<f64>> {
        let of_pairs = pairs.pairs.iter().map(|pair| pair.slave + 1);
        let of_faces = self.nodes.last().map(|last| last + 1);
        let count = of_pairs.chain(of_faces).max().unwrap_or(0);
        let unknown = Vector3::repeat(f64::NAN);
        let mut motions = vec![unknown; count];
        let [now, before] = [moved, &self.coordinates].map(|x| x.chunks_exact(self.dim));
        for ((now, before), &node) in now.zip(before).zip(&self.nodes) {
            motions[node] = vector(now) - vector(before);
        }
        let motion = |node: usize| motions.get(node).copied().unwrap_or(unknown);
        let mut slides = vec![None; count];
        for pair in &pairs.pairs {
            let sum = |row: &[Weight]| {
                let mut sum = Vector3::zeros();
                for &(node, weight) in row {
                    if pairs.images.has(node) {
                        let (node, turn) = pairs.images.of(node);
                        sum += weight * turn * motion(node);
                    } else {
                        sum += weight * motion(node);
                    }
                }
                sum
            };
            let apart = sum(pair.slaves()) - sum(pair.masters());
            slides[pair.slave] = Some(without(apart, &[pair.normal.into()]).norm());
        }
        slides
    }
}
