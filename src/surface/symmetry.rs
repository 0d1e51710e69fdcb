//! Planes of symmetry of half and quarter models, and the pairs whose slave nodes stand on them.
//!
//! In the whole body the row of such a node reaches as far to the other side. What it tells along the axis across
//! the plane cancels against its mirror image, so that the pair neither moves nor carries a force along it. Half
//! of the row, as the half model has it, would not cancel: it holds masters alone, of which there may be fewer
//! than such rows, and its force would be one that the whole body does not have. So that axis of the row is given up,
//! as other programs give up the multiplier of such a node along it. The mean normal of the faces around the
//! node is that of the whole body too: without a part across the plane.

use std::collections::{BTreeMap, HashMap};

use super::face::Face;
use super::mesh::{Faces, ON_PLANE, Side};
use super::normals::{at_nodes, direction};
use super::sweep::Bounds;
use super::watch::Watch;
use crate::error::{Argument, Error, index};
use crate::linalg::vector3::Vector3;

/// A plane of symmetry across an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SymmetryPlane {
    /// The axis that it is orthogonal to: 0, 1 or 2.
    pub axis: usize,
    /// Where it stands along that axis; length.
    pub at: f64,
}

/// The slave nodes that stand on planes of symmetry.
#[derive(Debug, Default)]
pub(super) struct OnPlanes {
    /// The axes across which each of them stands on a plane.
    axes: BTreeMap<usize, [bool; 3]>,
}

impl OnPlanes {
    /// # Errors
    /// A plane across an axis that is none, or at no finite place; a slave side on both sides of a plane.
    pub(super) fn new(
        slave: &Side<'_>,
        (planes, axisymmetric): (&[SymmetryPlane], bool),
    ) -> Result<Self, Error> {
        let refuse = |message: String| Err(Error::invalid(Argument::Settings, message));
        let mut found = OnPlanes::default();
        let nodes = slave.all_nodes();
        let Bounds { low, high } = Bounds::of(nodes.iter().map(|&node| slave.position(node)));
        let near = ON_PLANE * (high - low).amax();
        if axisymmetric {
            for node in nodes.iter().filter(|&&node| slave.position(node).x <= near) {
                found.axes.entry(*node).or_default()[0] = true;
            }
        }
        for (k, &SymmetryPlane { axis, at }) in planes.iter().enumerate() {
            let plane = format!("plane of symmetry {}", index(k));
            if axis >= slave.dim {
                let (axis, last) = (index(axis), index(slave.dim - 1));
                return refuse(format!("{plane}: there is no axis {axis}, the last one is {last}"));
            }
            if !at.is_finite() {
                return refuse(format!("{plane}: it stands at {at}, which is not finite"));
            }
            let mut beyond = [None; 2];
            for &node in &nodes {
                let height = slave.position(node)[axis] - slave.scale * at;
                if height.abs() <= near {
                    found.axes.entry(node).or_default()[axis] = true;
                } else {
                    beyond[usize::from(height > 0.0)] = Some(node);
                }
            }
            if let [Some(below), Some(above)] = beyond {
                let (axis, below, above) = (index(axis), index(below), index(above));
                return refuse(format!(
                    "{plane}, across axis {axis} at {at}, has slave nodes on both sides, {below} and \
                     {above}: model one side alone, or leave the plane out"
                ));
            }
        }
        Ok(found)
    }

    /// The unit normal of a slave node without what is across its planes, as the mean with its mirror images is. One
    /// that is across its plane, as in a face that lies in it, stays.
    pub(super) fn turned(&self, node: usize, normal: Vector3) -> Vector3 {
        let Some(axes) = self.axes.get(&node) else { return normal };
        let mut along = normal;
        (0..3).filter(|&axis| axes[axis]).for_each(|axis| along[axis] = 0.0);
        direction(along, 1.0).unwrap_or(normal)
    }

    /// The axes across which a node stands on a plane.
    fn of(&self, node: usize) -> [bool; 3] {
        self.axes.get(&node).copied().unwrap_or_default()
    }

    /// `true` if a node stands on all planes that another one, `from`, stands on: else what goes from there would leave
    /// the plane.
    pub(super) fn stays(&self, node: usize, from: usize) -> bool {
        self.of(from).into_iter().zip(self.of(node)).all(|(from, own)| !from || own)
    }

    /// `true` of a ring that touches its axis.
    pub(super) fn touch_axis(&self, face: &Face<'_>) -> bool {
        face.is_ring && face.nodes.iter().any(|&node| self.of(node)[0])
    }

    /// The axes across which a slave node with this normal is held.
    ///
    /// # Errors
    /// The normal is across one.
    pub(super) fn held(&self, node: usize, normal: Vector3) -> Result<[bool; 3], Error> {
        let held = self.of(node);
        if held.iter().zip(&normal).any(|(held, part)| *held && *part != 0.0) {
            let message = format!(
                "a plane of symmetry has slave faces in it, at node {}: leave these faces out, or the plane",
                index(node)
            );
            return Err(Error::invalid(Argument::Settings, message));
        }
        Ok(held)
    }
}

/// A side with its mirror image across a plane, behind its own nodes and faces. Nodes on the plane are their own images.
pub(super) struct Reflected {
    coordinates: Vec<f64>,
    start: Vec<usize>,
    nodes: Vec<usize>,
}

impl Reflected {
    /// Without the image if the side has nodes beyond the plane.
    pub(super) fn new(side: &Side<'_>, SymmetryPlane { axis, at }: SymmetryPlane) -> Reflected {
        let mut coordinates = side.coordinates.to_vec();
        let (mut start, mut nodes) = (side.faces.start.to_vec(), side.faces.nodes.to_vec());
        let own = side.all_nodes();
        let Bounds { low, high } = Bounds::of(own.iter().map(|&node| side.position(node)));
        let (near, at_plane) = (ON_PLANE * (high - low).amax(), side.scale * at);
        if high[axis] <= at_plane + near || low[axis] >= at_plane - near {
            let mut images = HashMap::new();
            for node in own {
                let mut image = node;
                if (side.position(node)[axis] - at_plane).abs() > near {
                    image = coordinates.len() / side.dim;
                    coordinates.extend_from_within(side.dim * node..side.dim * (node + 1));
                    let mirrored = &mut coordinates[side.dim * image + axis];
                    *mirrored = 2.0 * at - *mirrored;
                }
                images.insert(node, image);
            }
            for face in 0..side.count() {
                let (face, corners) = (side.face(face), side.corners(face).len());
                let mut image: Vec<usize> = face.nodes.iter().map(|node| images[node]).collect();
                image[..corners].reverse();
                // Mid nodes are between corners as before; the last edge stays the last.
                let mids = corners..face.nodes.len().min(2 * corners - 1);
                image[mids].reverse();
                nodes.extend(image);
                start.push(nodes.len());
            }
        }
        Reflected { coordinates, start, nodes }
    }

    /// As a side like the one that it was made of.
    pub(super) fn on<'a>(&'a self, side: &Side<'a>) -> Side<'a> {
        let faces = Faces { start: &self.start, nodes: &self.nodes };
        side.with(&self.coordinates, faces)
    }
}

impl Side<'_> {
    /// Averaged unit normals of the nodes of [`Self::all_nodes`], by node, in the planes of symmetry on which they stand; zero
    /// where they cancel.
    ///
    /// # Errors
    /// What ends the watch.
    pub(super) fn node_normals(
        &self,
        planes: &OnPlanes,
        watch: &mut Watch<'_, '_>,
    ) -> Result<HashMap<usize, Vector3>, Error> {
        let mut normals: HashMap<usize, Vector3> = HashMap::new();
        for at in 0..self.count() {
            watch.goes_on()?;
            let face = self.face(at);
            for (&node, normal) in face.nodes.iter().zip(at_nodes(&face)) {
                *normals.entry(node).or_default() += normal;
            }
        }
        for (&node, normal) in &mut normals {
            watch.goes_on()?;
            *normal = planes.turned(node, direction(*normal, 1.0).unwrap_or_default());
        }
        Ok(normals)
    }
}
