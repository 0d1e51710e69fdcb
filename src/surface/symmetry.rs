//! Planes of symmetry of half and quarter models, and the pairs whose slave nodes stand on them.
//!
//! In the whole body the row of such a node reaches as far to the other side. What it tells along the axis across
//! the plane cancels against its mirror image, so that the pair neither moves nor carries a force along it. Half
//! of the row, as the half model has it, would not cancel: it holds masters alone, of which there may be fewer
//! than such rows, and its force would be one that the whole body does not have. So that direction of the row is given up,
//! as other programs give up the multiplier of such a node along it. The mean normal of the faces around the
//! node is that of the whole body too: without a part across the plane.

use std::collections::{BTreeMap, HashMap};

use super::face::Face;
use super::mesh::{ON_PLANE, Side};
use super::normals::{at_nodes, direction};
use super::plane;
use super::settings::SurfaceSettings;
use super::surfaces::Faces;
use super::symmetry_plane::SymmetryPlane;
use super::watch::Watch;
use crate::error::{Argument, Error, index};
use crate::linalg::vector3::{self, Vector3, unit, vector, without};

/// The slave nodes that stand on planes of symmetry.
#[derive(Debug, Default)]
pub(super) struct OnPlanes {
    /// Orthonormal directions across the planes that each of them stands on.
    across: BTreeMap<usize, Vec<Vector3>>,
    /// The planes that no node stands on.
    pub(super) idle: Vec<usize>,
}

impl OnPlanes {
    /// Those of a side. A plane that has nodes of a master on both sides is none of it.
    ///
    /// # Errors
    /// A plane whose normal is no direction of the space, or at no finite place; a slave side on both sides of a plane.
    pub(super) fn new(side: &Side<'_>, settings: &SurfaceSettings) -> Result<Self, Error> {
        let mut found = OnPlanes::default();
        let (nodes, near) = (side.all_nodes(), side.nearness());
        let place = |node: &&usize| side.position(**node);
        if settings.axisymmetric {
            let on = nodes.iter().filter(|node| place(node).x <= near);
            on.for_each(|node| found.add(*node, vector3::axis(0)));
        }
        if let Some(sector) = settings.sector {
            // What is across the axis cancels over all sectors.
            let is_on = |node: &&usize| sector.is_on_axis(place(node), (side.scale, near));
            let across = plane::tangents(3, sector.axis());
            let on = nodes.iter().filter(is_on);
            on.for_each(|node| across.into_iter().for_each(|across| found.add(*node, across)));
        }
        for (k, plane) in settings.symmetry.iter().enumerate() {
            let refuse = |what: String| {
                let message = format!("plane of symmetry {}{what}", index(k));
                Err(Error::invalid(Argument::Settings, message))
            };
            let [x, y, z] = plane.normal;
            let is_of_space = |across: &Vector3| side.dim > 2 || across.z == 0.0;
            let Some(across) = unit(plane.normal.into()).filter(is_of_space) else {
                let dim = side.dim;
                return refuse(format!(
                    ": its normal {x}, {y}, {z} is no direction in {dim} dimensions"
                ));
            };
            if !plane.at.is_finite() {
                return refuse(format!(": it stands at {}, which is not finite", plane.at));
            }
            let height = |node: &&usize| plane.height(&across, place(node), side.scale);
            let ends = [
                nodes.iter().rfind(|node| height(node) < -near),
                nodes.iter().rfind(|node| height(node) > near),
            ];
            match ends {
                [Some(below), Some(above)] if side.is_slave() => {
                    let (name, below, above) = (plane.name(), index(*below), index(*above));
                    return refuse(format!(
                        ", {name}, has slave nodes on both sides, {below} and {above}: model one side alone, or leave \
                         the plane out"
                    ));
                }
                [Some(_), Some(_)] => {}
                _ => {
                    let on = nodes.iter().filter(|node| height(node).abs() <= near);
                    let count = on.map(|node| found.add(*node, across)).count();
                    found.idle.extend((count == 0).then_some(k));
                }
            }
        }
        Ok(found)
    }

    /// Adds a plane that a node stands on, unless it stands on it already.
    fn add(&mut self, node: usize, across: Vector3) {
        let held = self.across.entry(node).or_default();
        held.extend(direction(without(across, held), 1.0));
    }

    /// The unit normal of a slave node without what is across its planes, as the mean with its mirror images is. One
    /// that is across its plane, as in a face that lies in it, stays.
    pub(super) fn turned(&self, node: usize, normal: Vector3) -> Vector3 {
        match self.of(node) {
            [] => normal,
            across => direction(without(normal, across), 1.0).unwrap_or(normal),
        }
    }

    /// Orthonormal directions across the planes that a node stands on.
    fn of(&self, node: usize) -> &[Vector3] {
        self.across.get(&node).map_or(&[], Vec::as_slice)
    }

    /// `true` if a node stands on all planes that another one, `from`, stands on: else what goes from there would leave
    /// the plane.
    pub(super) fn stays(&self, node: usize, from: usize) -> bool {
        self.of(from).iter().all(|across| direction(without(*across, self.of(node)), 1.0).is_none())
    }

    /// `true` of a ring that touches its axis.
    pub(super) fn touch_axis(&self, face: &Face<'_>) -> bool {
        let stands = |node: &usize| self.of(*node).contains(&vector3::axis(0));
        face.is_ring && face.nodes.iter().any(stands)
    }

    /// Adds the nodes to what pairs tell.
    pub(super) fn tell(&self, told: &mut BTreeMap<usize, Vec<[f64; 3]>>) {
        let given = |across: &[Vector3]| across.iter().copied().map(Into::into).collect();
        told.extend(self.across.iter().map(|(node, across)| (*node, given(across))));
    }

    /// Orthonormal directions along which a slave node with this normal is held.
    ///
    /// # Errors
    /// The normal is across one.
    pub(super) fn held(&self, node: usize, normal: Vector3) -> Result<&[Vector3], Error> {
        let held = self.of(node);
        if held.iter().any(|across| across.dot(&normal).abs() > ON_PLANE) {
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
    pub(super) fn new(side: &Side<'_>, plane: SymmetryPlane) -> Reflected {
        let mut coordinates = side.coordinates.to_vec();
        let (mut start, mut nodes) = (side.faces.start.to_vec(), side.faces.nodes.to_vec());
        let (own, near) = (side.all_nodes(), side.nearness());
        let across = unit(Vector3::from(plane.normal)).unwrap_or_default();
        let height = |node: &usize| plane.height(&across, side.position(*node), side.scale);
        let [below, above] =
            [-1.0, 1.0].map(|sign| own.iter().all(|node| sign * height(node) >= -near));
        if below || above {
            let mut images = HashMap::new();
            for node in own {
                let mut image = node;
                if height(&node).abs() > near {
                    image = coordinates.len() / side.dim;
                    let x = vector(&side.coordinates[side.dim * node..][..side.dim]);
                    let mirrored = x - 2.0 * plane.height(&across, x, 1.0) * across;
                    coordinates.extend(&mirrored.as_slice()[..side.dim]);
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
