//! Planes of symmetry of half and quarter models, and the nodes of a side that stand on them, or on an axis.
//!
//! In the whole body the row of a node on a plane reaches as far to the other side, and both sides are paired with their
//! mirror images. What it tells along the axis across the plane cancels against its mirror image, so that the pair neither
//! moves nor carries a force along it, as across the axis of a sector; the rows that are handed out have nothing there. The
//! axis of bodies of revolution has no image: around it what is across the axis cancels in each ring.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use super::images::Images;
use super::mesh::Side;
use super::motion::Motion;
use super::normals::{at_nodes, direction};
use super::plane;
use super::sector::Sector;
use super::self_overlap::UPON;
use super::settings::{SurfaceSettings, SymmetryPlane};
use crate::error::{Argument, Error, index};
use crate::linalg::vector3::{self, Vector3, unit, without};

/// A plane of symmetry on one side of which all nodes of a side stand.
#[derive(Clone, Debug)]
pub(super) struct Mirror {
    pub(super) motion: Motion,
    /// The nodes on it, ascending.
    pub(super) nodes: Vec<usize>,
}

/// The nodes of a side that stand on planes of symmetry, or on an axis.
#[derive(Debug, Default)]
pub(super) struct OnPlanes {
    /// Orthonormal directions across the planes, or the axis, that each of them stands on.
    across: BTreeMap<usize, Vec<Vector3>>,
    /// Those on the axis of bodies of revolution.
    of_rings: BTreeSet<usize>,
    /// Those on the axis of a sector.
    pub(super) on_axis: Vec<usize>,
    /// The planes that the side ends at, or does not reach.
    pub(super) mirrors: Vec<Mirror>,
    /// The planes that no node stands on.
    pub(super) idle: Vec<usize>,
    /// The planes beside which a node stands, each with the nearest such node and its distance.
    pub(super) beside: Vec<(usize, usize, f64)>,
}

impl OnPlanes {
    /// Those of a side. A plane that has nodes of a master on both sides is none of it.
    ///
    /// # Errors
    /// A plane whose normal is no direction of the space, or at no finite place; a slave side on both sides of a plane, or with
    /// faces in one.
    pub(super) fn new(side: &Side<'_>, settings: &SurfaceSettings) -> Result<Self, Error> {
        let mut found = OnPlanes::default();
        let (nodes, near) = (side.all_nodes(), side.nearness());
        let place = |node: &&usize| side.position(**node);
        if settings.axisymmetric {
            found.of_rings = nodes.iter().filter(|node| place(node).x <= near).copied().collect();
            let on = found.of_rings.clone();
            on.into_iter().for_each(|node| found.add(node, vector3::axis(0)));
        }
        if let Some(sector) = settings.sector.filter(|sector| !sector.is_shifted()) {
            let near = near.max(side.scale * side.left_open);
            let is_on =
                |node: &&usize| (place(node) - sector.foot(place(node), side.scale)).norm() <= near;
            found.on_axis = nodes.iter().filter(is_on).copied().collect();
            let across = plane::tangents(3, sector.axis());
            let on = found.on_axis.clone();
            on.into_iter().for_each(|node| across.into_iter().for_each(|a| found.add(node, a)));
        }
        for (k, plane) in settings.symmetry.iter().enumerate() {
            found.add_plane((k, plane), (side, &nodes, near)).map_err(|what| {
                let message = format!("plane of symmetry {}{what}", index(k));
                Error::invalid(Argument::Settings, message)
            })?;
        }
        if side.is_slave() {
            found.check(side)?;
        }
        Ok(found)
    }

    /// Refuses slave faces in a plane, or on the axis of bodies of revolution.
    fn check(&self, side: &Side<'_>) -> Result<(), Error> {
        for nodes in (0..side.count()).map(|at| side.nodes(at)) {
            let is_in =
                |mirror: &Mirror| nodes.iter().all(|node| mirror.nodes.binary_search(node).is_ok());
            if self.mirrors.iter().any(is_in)
                || nodes.iter().all(|node| self.of_rings.contains(node))
            {
                let node = nodes.iter().min().copied().unwrap_or_default();
                let message = format!(
                    "a plane of symmetry has slave faces in it, at node {}: leave these faces out, or the plane",
                    index(node)
                );
                return Err(Error::invalid(Argument::Settings, message));
            }
        }
        Ok(())
    }

    /// Adds a plane by its number.
    ///
    /// # Errors
    /// What is wrong with it, in words.
    fn add_plane(
        &mut self,
        (k, plane): (usize, &SymmetryPlane),
        (side, nodes, near): (&Side<'_>, &[usize], f64),
    ) -> Result<(), String> {
        let ([x, y, z], dim) = (plane.normal, side.dim);
        let is_of_space = |across: &Vector3| dim > 2 || across.z == 0.0;
        let Some(across) = unit(plane.normal.into()).filter(is_of_space) else {
            return Err(format!(": its normal {x}, {y}, {z} is no direction in {dim} dimensions"));
        };
        if !plane.at.is_finite() {
            return Err(format!(": it stands at {}, which is not finite", plane.at));
        }
        let height = |node: &usize| plane.height(&across, side.position(*node), side.scale);
        let below = nodes.iter().rfind(|node| height(node) < -near);
        let above = nodes.iter().rfind(|node| height(node) > near);
        if let Some((below, above)) = below.zip(above) {
            if !side.is_slave() {
                return Ok(());
            }
            let (name, below, above) = (plane.name(), index(*below), index(*above));
            let beyond = |way: f64| nodes.iter().map(|node| way * height(node)).fold(0.0, f64::max);
            let [least, near] = [beyond(1.0).min(beyond(-1.0)), near].map(|by| by / side.scale);
            return Err(format!(
                ", {name}, has slave nodes on both sides, {below} and {above}: model one side alone, or leave the plane out. \
                 Those on one side are {least:.1e} away at most: if they should stand on it, give its direction and its place, \
                 and coordinates, with more digits, as nodes do to {near:.1e}"
            ));
        }
        let on: Vec<usize> =
            nodes.iter().filter(|node| height(node).abs() <= near).copied().collect();
        on.iter().for_each(|node| self.add(*node, across));
        self.idle.extend(on.is_empty().then_some(k));
        let beside = nearest_beside(side, |node| height(&node).abs(), near);
        self.beside.extend(beside.map(|(node, distance)| (k, node, distance / side.scale)));
        self.mirrors.push(Mirror { motion: Motion::mirror(across, plane.at), nodes: on });
        Ok(())
    }

    /// Adds a direction across a plane that a node stands on, unless it stands on it already.
    fn add(&mut self, node: usize, across: Vector3) {
        let held = self.across.entry(node).or_default();
        held.extend(direction(without(across, held), 1.0));
    }

    /// The unit normal of a slave node without what is across its planes: of the mean with its mirror images rounding.
    pub(super) fn turned(&self, node: usize, normal: Vector3) -> Vector3 {
        match self.held(node) {
            [] => normal,
            across => direction(without(normal, across), 1.0).unwrap_or(normal),
        }
    }

    /// Orthonormal directions along which a node is held.
    pub(super) fn held(&self, node: usize) -> &[Vector3] {
        self.across.get(&node).map_or(&[], Vec::as_slice)
    }

    /// `true` if a node is on the axis of bodies of revolution if another one, `from`, is: else what goes from there would
    /// leave the axis.
    pub(super) fn stays(&self, node: usize, from: usize) -> bool {
        !self.of_rings.contains(&from) || self.of_rings.contains(&node)
    }

    /// The middle of a side and its images: on the axis, and on the planes on which some of its nodes stand.
    pub(super) fn middle(&self, side: &Side<'_>, sector: Option<Sector>) -> Vector3 {
        let mut middle = side.mean();
        for Mirror { motion, .. } in self.mirrors.iter().filter(|mirror| !mirror.nodes.is_empty()) {
            let host = middle / side.scale;
            middle = 0.5 * side.scale * (host + motion.of(host));
        }
        sector.map_or(middle, |sector| sector.foot(middle, side.scale))
    }

    /// Adds images of nodes on the axis of bodies of revolution: these are on it too.
    pub(super) fn see(&mut self, images: &Images) {
        for image in images.numbers() {
            if self.of_rings.contains(&images.at(image).1) {
                self.of_rings.insert(image);
                self.add(image, vector3::axis(0));
            }
        }
    }

    /// Adds the nodes to what pairs tell.
    pub(super) fn tell(&self, told: &mut BTreeMap<usize, Vec<[f64; 3]>>) {
        let given = |across: &[Vector3]| across.iter().copied().map(Into::into).collect();
        told.extend(self.across.iter().map(|(node, across)| (*node, given(across))));
    }
}

/// The nearest node, with its distance, of those beside a plane and not on it, as a direction of few digits leaves them: nearer than
/// a small share of what a face of theirs reaches away from there.
fn nearest_beside(
    side: &Side<'_>,
    distance: impl Fn(usize) -> f64,
    near: f64,
) -> Option<(usize, f64)> {
    let of_face = |at: usize| {
        let nodes = side.face(at).nodes;
        let reach = nodes.iter().map(|&node| distance(node)).fold(0.0, f64::max);
        let is_beside =
            move |(_, distance): &(usize, f64)| near < *distance && *distance <= UPON * reach;
        nodes.iter().map(|&node| (node, distance(node))).filter(is_beside)
    };
    (0..side.count()).flat_map(of_face).min_by(|a, b| a.1.total_cmp(&b.1))
}

impl Side<'_> {
    /// Averaged unit normals of the nodes of [`Self::all_nodes`], by node, in the planes of symmetry on which they stand; zero
    /// where they cancel. Of the faces at a node those that `counts` says no of, by face, node and normal, are left out.
    ///
    /// # Errors
    /// What stops the pairing.
    pub(super) fn node_normals(
        &self,
        planes: &OnPlanes,
        counts: impl Fn(usize, usize, &Vector3) -> bool,
    ) -> Result<HashMap<usize, Vector3>, Error> {
        let mut normals: HashMap<usize, Vector3> = HashMap::new();
        for face in self.each_face() {
            let (at, face) = face?;
            let at_nodes = face.nodes.iter().zip(at_nodes(&face));
            for (&node, normal) in at_nodes.filter(|(node, normal)| counts(at, **node, normal)) {
                *normals.entry(node).or_default() += normal;
            }
        }
        for (&node, normal) in &mut normals {
            self.progress.goes_on()?;
            *normal = planes.turned(node, direction(*normal, 1.0).unwrap_or_default());
        }
        Ok(normals)
    }
}
