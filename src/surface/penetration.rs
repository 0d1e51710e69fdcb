//! Parts of the slave surface that have passed through the master: a check after the solution, as nothing holds what has no
//! pair.
//!
//! A moved point of the slave has passed through a moved master if that lies behind it along its normal before the motion,
//! and before they were not behind each other, the same point of the master along the slave's normal and it along the master's. What
//! was, as layers behind each other are and surfaces that overlap from the beginning, is left to the pairs, and to their report where
//! it is deeper than they look: coordinates alone do not say if such an overlap is meant, as that of shells whose thicknesses are gaps,
//! and the host knows it before it solves.
//!
//! A slave face that reaches over the rim of its master, or is larger than it, may have none of its points over the master, and
//! nodes of smaller master faces are held in the mean alone. So nodes of the master are asked too, by their own normals, if they
//! come to lie over slave faces whose pairs do not hold all that is over them.
//!
//! A pair holds its node along the normal before the motion, against the faces that lay over it. Where it slides far beside the
//! size of its faces, others lie over it, or the same ones at another height if they are inclined to that normal; these faces of
//! the slave are asked as those without a pair are.
//!
//! A point has passed into a rigid shape if it is in it. One that has passed through the whole of a shape is outside again, and
//! is not found.

use std::collections::{BTreeSet, HashSet};

use super::candidates::{Candidates, Reach};
use super::digits::ON_PLANE;
use super::face::Face;
use super::kept_surfaces::{KeptMaster, KeptSurfaces};
use super::mesh::Side;
use super::pairing_progress::PairingProgress;
use super::pairs::{SurfacePairs, Weight};
use super::plane::Plane;
use super::shape::{Local, MANY_FACES};
use super::sweep::{Bounds, Hull};
use super::tree::Tree;
use crate::error::{Argument, Error};
use crate::linalg::vector3::{Vector3, vector, without};
use crate::monitor::Monitor;

/// Pairs hold their nodes in the mean: between nodes, and where a node is folded, faces of two curved surfaces pass by a
/// small share of their size.
const LEAST_OF_PAIRED: f64 = 0.1;

/// How far the slave has passed through the master.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Penetration {
    /// Number of slave nodes and of middles of slave faces that have passed through, and of nodes of the master that have through
    /// faces no point of which has.
    pub count: usize,
    /// How deep the deepest is, along its normal before the motion; its distance from a rigid shape.
    pub depth: f64,
    /// Where it is, moved.
    pub point: [f64; 3],
    /// Its slave face, or that which a node of the master has passed through.
    pub face: usize,
    /// Its node, of the slave or of the master; `None`: the middle of the face, or a node of a rigid mesh.
    pub node: Option<usize>,
    /// The master face; `None` of a shape.
    pub master: Option<usize>,
}

/// The nodes that pairs hold, and the slave faces that are asked.
struct Held {
    /// By place of the node.
    nodes: Vec<bool>,
    /// Ascending.
    uncovered: Vec<usize>,
    asked: Vec<usize>,
}

impl Held {
    /// The least depth that counts of a point of a slave face: at a node, or in the middle.
    fn least(&self, at: usize, face: &Face<'_>, place: Option<usize>) -> f64 {
        let is_held = |place: &usize| self.nodes[*place];
        let of_face =
            || self.uncovered.binary_search(&at).is_err() && face.nodes.iter().any(is_held);
        face.size() * least_share(place.as_ref().map_or_else(of_face, is_held))
    }
}

/// The least depth that counts, beside the size of a face: where pairs hold it, and elsewhere.
fn least_share(is_held: bool) -> f64 {
    if is_held { LEAST_OF_PAIRED } else { ON_PLANE }
}

/// What has passed through, and the slave faces of which a point has.
type Found = (Penetration, HashSet<usize>);

/// A point of a face before and after the motion, by its place on it and its node; `None`: the middle.
type Point<'p> = ([&'p Face<'p>; 2], Local, Option<usize>);

/// How deep a point has passed through, with the slave face and the master face.
type Passed = (f64, usize, Option<usize>);

impl KeptSurfaces {
    /// How far the slave has passed through the master where no pair holds it, after displacements `u` of nodes along axes.
    /// Faces that are covered wholly by faces of their size, and all of whose nodes have pairs of their own that slide by less than
    /// a tenth of the face, are left to these. `pairs` are those of these surfaces.
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
        let progress = &PairingProgress::new(monitor);
        let slaves = &self.before_and_after(("slave", progress), &moved, &self.slave)?;
        let held = &self.held(pairs, &moved, &slaves[0]);
        match &self.master {
            KeptMaster::Shape(shape) => {
                let wrong = |what| Error::invalid(Argument::Obstacle, format!("obstacle: {what}"));
                let shape = shape.check(self.dim, 1.0).map_err(wrong)?;
                let depth = |x: Vector3| -shape.facing(x).0 - self.clearance;
                let through = |at, (faces, local, place): Point<'_>| {
                    let least = held.least(at, faces[0], place);
                    let [before, now] = faces.map(|face| depth(face.position(local)));
                    (before <= least && now > least).then_some((now, at, None))
                };
                let faces = (held.asked.iter().copied(), true);
                Ok(self.deepest(Found::default(), faces, slaves, through)?.0)
            }
            KeptMaster::Faces(_) if held.asked.is_empty() => Ok(Penetration::default()),
            KeptMaster::Faces(lists) => {
                let masters = &self.before_and_after(("master", progress), &moved, lists)?;
                let (near, found) = self.through_faces(held, [slaves, masters])?;
                let mut lists = [vec![0], Vec::new()];
                for &at in &held.asked {
                    lists[1].extend(slaves[0].nodes(at));
                    lists[0].push(lists[1].len());
                }
                let asked = &self.before_and_after(("slave", progress), &moved, &lists)?;
                self.masters_through((held, near), [asked, masters], found)
            }
        }
    }

    /// The nodes that pairs hold, and the faces that these do not hold wholly or along which they slide far.
    fn held(&self, pairs: &SurfacePairs, moved: &[f64], slave: &Side<'_>) -> Held {
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
        let moved = |sum: Vector3, &(node, weight): &Weight| match pairs.images.has(node) {
            false => sum + weight * motion(node),
            true => {
                let (node, turn) = pairs.images.of(node);
                sum + weight * turn * motion(node)
            }
        };
        let mut slides = vec![None; count];
        for pair in &pairs.pairs {
            let sum = |row: &[Weight]| row.iter().fold(Vector3::zeros(), moved);
            let apart = sum(pair.slaves()) - sum(pair.masters());
            slides[pair.slave] = Some(without(apart, &[pair.normal.into()]).norm());
        }
        slides
    }

    /// The master faces before or behind those that are asked; what has passed through of the slave, and the slave faces of
    /// which a point has.
    fn through_faces(
        &self,
        held: &Held,
        [slaves, masters]: [&[Side<'_>; 2]; 2],
    ) -> Result<(BTreeSet<usize>, Found), Error> {
        let opposite = Tree::new(&masters[1])?;
        let asked = held.asked.iter().map(|&at| Hull::of(&slaves[1].face(at)).bounds());
        let mut candidates = Self::candidates(opposite, asked);
        let mut near = BTreeSet::new();
        for &at in &held.asked {
            masters[1].progress.goes_on()?;
            let normal = slaves[0].face(at).middle_normal();
            near.extend(candidates.of_face(&slaves[1].face(at), normal));
        }
        let through = |at, point: Point<'_>| {
            let ([first, _], local, place) = point;
            let (normal, least) = (first.normal(local), held.least(at, first, place));
            let found = self.behind((point, normal), masters, &mut candidates, |_| least)?;
            Some((found.0, at, Some(found.1)))
        };
        let faces = (held.asked.iter().copied(), true);
        let found = self.deepest(Found::default(), faces, slaves, through)?;
        Ok((near, found))
    }

    /// The search for faces behind others, however deep.
    fn candidates<'s>(opposite: Tree<'s>, asked: impl Iterator<Item = Bounds>) -> Candidates<'s> {
        let bounds = asked.chain(opposite.bounds()).reduce(|a, b| a.with(&b));
        let span = bounds.map_or(0.0, |all| all.diagonal());
        Candidates::new(opposite, Reach { overlap: span, open: 0.0, layer: span }, span)
    }

    /// The nearest face that a point with a normal has passed through, with its depth. `least` tells the least depth that counts.
    fn behind(
        &self,
        ((faces, local, _), normal): (Point<'_>, Vector3),
        [before, after]: &[Side<'_>; 2],
        candidates: &mut Candidates<'_>,
        least: impl Fn(usize) -> f64,
    ) -> Option<(f64, usize)> {
        let [origin, x] = faces.map(|face| face.position(local) - self.clearance * normal);
        let plane = Plane::new(self.dim, x, normal);
        let behind = candidates.of_point(x, normal).iter().filter_map(|&at| {
            let (local, height) = plane.meeting(&after.face(at))?;
            let opposite = before.face(at);
            let apart = opposite.position(local) - origin;
            let (depth, least) = (-height, least(at));
            let was_in_front = normal.dot(&apart).max(-opposite.normal(local).dot(&apart));
            (was_in_front >= -least && depth > least).then_some((depth, at))
        });
        behind.min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// Adds nodes of the master that have passed through slave faces, those that are asked, to what is found of the slave: they
    /// count if their face is not told yet.
    fn masters_through(
        &self,
        (held, near_asked): (&Held, BTreeSet<usize>),
        [slaves, masters]: [&[Side<'_>; 2]; 2],
        found: Found,
    ) -> Result<Penetration, Error> {
        let opposite = Tree::new(&slaves[1])?;
        let mut candidates = Self::candidates(opposite, std::iter::once(masters[1].bounds()));
        let through = |of_master, point: Point<'_>| {
            let ([first, _], ..) = point;
            let (normal, size) = (first.middle_normal(), first.size());
            let least = |at: usize| {
                let face = slaves[0].face(at);
                // A node that stands at the end of a face that it is paired with may slide to the next one.
                let is_held = face.nodes.iter().any(|place| held.nodes[*place]);
                size.min(face.size()) * least_share(is_held)
            };
            let (depth, at) = self.behind((point, normal), slaves, &mut candidates, least)?;
            Some((depth, held.asked[at], Some(of_master)))
        };
        let faces = (near_asked.into_iter(), false);
        Ok(self.deepest(found, faces, masters, through)?.0)
    }

    /// Adds points of some faces of a side to what is found: their nodes, and their middles if these are wanted. `through` tells how
    /// deep a point of a face has passed. They count if their slave face is not told yet; the faces that have such points are returned.
    fn deepest(
        &self,
        (mut found, told): Found,
        (faces, wants_middles): (impl Iterator<Item = usize>, bool),
        [before, after]: &[Side<'_>; 2],
        mut through: impl FnMut(usize, Point<'_>) -> Option<Passed>,
    ) -> Result<Found, Error> {
        let (mut passed, mut counted) = (HashSet::new(), HashSet::new());
        let mut asked = vec![0; self.coordinates.len()];
        for at in faces {
            before.progress.goes_on()?;
            let faces = [&before.face(at), &after.face(at)];
            let (kind, nodes) = (faces[0].kind, faces[0].nodes);
            let places = kind.places().iter().copied().zip(nodes.iter().copied().map(Some));
            let points = places.chain(wants_middles.then_some((kind.centre(), None)));
            // Not along the normals of all faces at a node: those of slivers are all near each other.
            let mut asks = |place: Option<usize>| {
                place.iter().for_each(|at| asked[*at] += 1);
                place.is_none_or(|at| asked[at] <= MANY_FACES)
            };
            for (local, place) in points.filter(|(_, place)| asks(*place)) {
                let Some((depth, face, master)) = through(at, (faces, local, place)) else {
                    continue;
                };
                passed.insert(face);
                let is_told = told.contains(&face);
                let is_new = !is_told && place.is_none_or(|place| counted.insert(place));
                found.count += usize::from(is_new);
                if depth > found.depth {
                    let point = faces[1].position(local).into();
                    let node = place.and_then(|place| self.nodes.get(place).copied());
                    found = Penetration { depth, point, face, node, master, ..found };
                }
            }
        }
        Ok((found, passed))
    }
}
