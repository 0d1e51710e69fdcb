//! Parts of the slave surface that have passed through the master: a check after the solution, as nothing holds what has no
//! pair.
//!
//! A moved point of the slave has passed through a moved master if that lies behind it along its normal before the motion,
//! and the same point of the master was not behind it before. What was, as layers behind each other are and surfaces that overlap
//! from the beginning, is left to the pairs, and to their report where it is deeper than they look: coordinates alone do not say if
//! such an overlap is meant, as that of shells whose thicknesses are gaps, and the host knows it before it solves.
//!
//! A point has passed into a rigid shape if it is in it. One that has passed through the whole of a shape is outside again, and
//! is not found.

use std::collections::HashSet;

use super::candidates::{Candidates, Reach, SearchFaces};
use super::exact_shape::Obstacle;
use super::face::Face;
use super::mesh::Side;
use super::pairs::SurfacePairs;
use super::plane::Plane;
use super::shape::Local;
use super::surfaces::{Faces, Master, Surfaces};
use super::sweep::Hull;
use super::watch::Watch;
use crate::error::{Argument, Error};
use crate::linalg::vector3::Vector3;
use crate::monitor::Monitor;

/// Less than this share of a face's size is rounding of displacements.
const LEAST: f64 = 1e-6;

/// Pairs hold their nodes in the mean: between nodes, and where a node is folded, faces of two curved surfaces pass by a
/// small share of their size.
const LEAST_OF_PAIRED: f64 = 0.1;

/// Copies of both sides before the motion, for [`Self::penetration`].
#[derive(Clone, Debug)]
pub struct KeptSurfaces {
    dim: usize,
    /// Nodes of the host that stand on a side, ascending.
    nodes: Vec<usize>,
    /// Those of these nodes, then those of a rigid mesh; lists of faces count nodes by their places here.
    coordinates: Vec<f64>,
    slave: [Vec<usize>; 2],
    master: KeptMaster,
    clearance: f64,
}

#[derive(Clone, Debug)]
enum KeptMaster {
    Faces([Vec<usize>; 2]),
    Shape(Obstacle),
}

/// How far the slave has passed through the master.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Penetration {
    /// Number of slave nodes and of middles of slave faces that have passed through.
    pub count: usize,
    /// How deep the deepest is, along the slave's normal before the motion; its distance from a rigid shape.
    pub depth: f64,
    /// Where it is, moved.
    pub point: [f64; 3],
    /// Its slave face.
    pub face: usize,
    /// Its slave node; `None`: the middle of the face.
    pub node: Option<usize>,
    /// The master face; `None` of a shape.
    pub master: Option<usize>,
}

/// The nodes that pairs hold, and the slave faces that they do not hold wholly.
struct Held {
    /// By place of the node.
    nodes: Vec<bool>,
    uncovered: Vec<bool>,
    asked: Vec<usize>,
}

impl KeptSurfaces {
    /// Keeps surfaces that have been paired with a clearance, which stands between them, as half the thicknesses of shells do if
    /// it is negative.
    pub fn new(
        &Surfaces { dim, coordinates, slave, master }: &Surfaces<'_>,
        clearance: f64,
    ) -> KeptSurfaces {
        let of_mesh = if let Master::Faces(faces) = master { faces.nodes } else { &[] };
        let mut nodes = [slave.nodes, of_mesh].concat();
        nodes.sort_unstable();
        nodes.dedup();
        let mut places = vec![0; nodes.last().map_or(0, |last| last + 1)];
        nodes.iter().enumerate().for_each(|(place, &node)| places[node] = place);
        let lists = |faces: Faces<'_>| {
            [faces.start.to_vec(), faces.nodes.iter().map(|&node| places[node]).collect()]
        };
        let kept = |node: &usize| coordinates[dim * node..dim * (node + 1)].to_vec();
        let mut kept: Vec<f64> = nodes.iter().flat_map(kept).collect();
        let master = match master {
            Master::Faces(faces) => KeptMaster::Faces(lists(faces)),
            Master::RigidFaces { coordinates, faces } => {
                kept.extend(coordinates);
                let places = faces.nodes.iter().map(|node| nodes.len() + node);
                KeptMaster::Faces([faces.start.to_vec(), places.collect()])
            }
            Master::RigidShape(shape) => KeptMaster::Shape(shape),
        };
        KeptSurfaces { dim, slave: lists(slave), coordinates: kept, nodes, master, clearance }
    }

    /// How far the slave has passed through the master where no pair holds it, after displacements `u` of nodes along axes.
    /// Faces that are covered, and all of whose nodes have pairs, are left to these.
    /// `pairs` are those of these surfaces.
    ///
    /// # Errors
    /// Displacements that are not finite; a shape with wrong numbers; [`Error::Stopped`]: the monitor ends it.
    pub fn penetration(
        &self,
        pairs: &SurfacePairs,
        u: impl Fn(usize, usize) -> f64,
        monitor: &mut Monitor<'_>,
    ) -> Result<Penetration, Error> {
        let axes = self.nodes.iter().flat_map(|&node| (0..self.dim).map(move |axis| (node, axis)));
        let mut moved = self.coordinates.clone();
        moved.iter_mut().zip(axes).for_each(|(x, (node, axis))| *x += u(node, axis));
        if moved.iter().any(|x| !x.is_finite()) {
            return Err(Error::invalid(Argument::Coordinates, "u has entries that are not finite"));
        }
        let watch = &mut Watch::new(monitor);
        let held = &self.held(pairs);
        let slaves = self.before_and_after("slave", &moved, &self.slave)?;
        match &self.master {
            KeptMaster::Shape(shape) => {
                let wrong = |what| Error::invalid(Argument::Obstacle, format!("obstacle: {what}"));
                let shape = shape.check(self.dim, 1.0).map_err(wrong)?;
                let depth = |x: Vector3| -shape.facing(x).0 - self.clearance;
                self.deepest(held, &slaves, watch, |faces, at, least| {
                    let [before, now] = faces.map(|face| depth(face.position(at)));
                    (before <= least).then_some((now, None))
                })
            }
            KeptMaster::Faces(_) if held.asked.is_empty() => Ok(Penetration::default()),
            KeptMaster::Faces(lists) => {
                let masters = self.before_and_after("master", &moved, lists)?;
                self.through_faces(held, [&slaves, &masters], watch)
            }
        }
    }

    fn before_and_after<'s>(
        &'s self,
        name: &'static str,
        moved: &'s [f64],
        [start, nodes]: &'s [Vec<usize>; 2],
    ) -> Result<[Side<'s>; 2], Error> {
        let faces = Faces { start, nodes };
        let side = |x| Side::new(name, Argument::Coordinates, (self.dim, x), faces);
        Ok([side(&self.coordinates)?, side(moved)?])
    }

    fn held(&self, pairs: &SurfacePairs) -> Held {
        let [start, places] = &self.slave;
        let (mut nodes, mut uncovered) =
            (vec![false; self.nodes.len()], vec![false; start.len() - 1]);
        let folded = pairs.report.folded.iter().map(|fold| fold.node);
        for node in pairs.pairs.iter().map(|pair| pair.slave).chain(folded) {
            let place = self.nodes.binary_search(&node);
            place.into_iter().for_each(|place| nodes[place] = true);
        }
        for (second, first, _) in pairs.images.on_second() {
            let [second, first] = [second, first].map(|node| self.nodes.binary_search(node));
            second.into_iter().zip(first).for_each(|(second, first)| nodes[second] = nodes[first]);
        }
        pairs.report.uncovered_faces.iter().for_each(|&at| uncovered[at] = true);
        let of_pairs = |at: &usize| {
            let mut places = places[start[*at]..start[at + 1]].iter();
            !uncovered[*at] && places.all(|&place| nodes[place])
        };
        let asked = (0..uncovered.len()).filter(|at| !of_pairs(at)).collect();
        Held { nodes, uncovered, asked }
    }

    fn through_faces(
        &self,
        held: &Held,
        [slaves, [before, after]]: [&[Side<'_>; 2]; 2],
        watch: &mut Watch<'_, '_>,
    ) -> Result<Penetration, Error> {
        let opposite = SearchFaces::new(after, watch)?;
        let asked = held.asked.iter().map(|&at| Hull::of(&slaves[1].face(at)).bounds());
        let bounds = asked.chain(opposite.tree.bounds()).reduce(|a, b| a.with(&b));
        let span = bounds.map_or(0.0, |all| all.diagonal());
        let reach = Reach { overlap: span, open: 0.0, layer: span };
        let mut candidates = Candidates::new(opposite, reach, span);
        self.deepest(held, slaves, watch, |[first, face], at, least| {
            let normal = first.normal(at);
            let [x, origin] = [face, first].map(|face| face.position(at) - self.clearance * normal);
            let plane = Plane::new(self.dim, x, normal);
            let behind = candidates.of_point(x, normal).iter().filter_map(|&at| {
                let flat = plane.flatten(&after.face(at));
                let local = flat.local([0.0; 2]).filter(|&local| flat.face.kind.holds(local))?;
                let apart = before.face(at).position(local) - origin;
                let was_before = normal.dot(&apart) >= -least;
                let depth = -flat.height(local);
                (was_before && depth > least).then_some((depth, Some(at)))
            });
            behind.min_by(|a, b| a.0.total_cmp(&b.0))
        })
    }

    /// The deepest of all points of the faces that are asked. `through` tells its depth with the master face, of both faces, the
    /// place on them and the least depth that counts.
    fn deepest(
        &self,
        held: &Held,
        [before, after]: &[Side<'_>; 2],
        watch: &mut Watch<'_, '_>,
        mut through: impl FnMut([&Face<'_>; 2], Local, f64) -> Option<(f64, Option<usize>)>,
    ) -> Result<Penetration, Error> {
        let (mut found, mut counted) = (Penetration::default(), HashSet::new());
        for &at in &held.asked {
            watch.goes_on()?;
            let faces = [before.face(at), after.face(at)];
            let size = faces[0].size();
            let nodes = faces[0].nodes;
            let is_held = |place: &usize| held.nodes[*place];
            let face_is_held = !held.uncovered[at] && nodes.iter().any(is_held);
            let places = faces[0].kind.places().iter().copied().zip(nodes.iter().map(Some));
            for (local, place) in places.chain([(faces[0].kind.centre(), None)]) {
                let is_held = place.map_or(face_is_held, is_held);
                let node = place.map(|&place| self.nodes[place]);
                let least = size * if is_held { LEAST_OF_PAIRED } else { LEAST };
                let passed = through(faces.each_ref(), local, least);
                let Some((depth, master)) = passed.filter(|(depth, _)| *depth > least) else {
                    continue;
                };
                found.count += usize::from(node.is_none_or(|node| counted.insert(node)));
                if depth > found.depth {
                    let point = faces[1].position(local).into();
                    found = Penetration { depth, point, face: at, node, master, ..found };
                }
            }
        }
        Ok(found)
    }
}
