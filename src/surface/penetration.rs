//! Parts of the slave surface that have passed through the master: a check after the solution, as nothing holds what has no
//! pair.
//!
//! A moved point of the slave has passed through a moved master if that lies behind it along its normal before the motion,
//! and before they were not behind each other, the same point of the master along the slave's normal and it along the master's. What
//! was, as layers behind each other are and surfaces that overlap from the beginning, is left to the pairs, and to their report where
//! it is deeper than they look: coordinates alone do not say if such an overlap is meant, as that of shells whose thicknesses are gaps,
//! and the host knows it before it solves.
//!
//! A node at an edge of its body has several normals, and is as deep as along that which leads out soonest: one that stands on a
//! plate has not passed through the end of it, though that lies behind it along the plate. Where the way back enters the master's
//! body before it leaves it, the point is outside; unless it was over both sides of that body, and has passed through the whole of it.
//!
//! A slave face that reaches over the rim of its master, or is larger than it, may have none of its points over the master, and
//! nodes of smaller master faces are held in the mean alone. So nodes of the master are asked too, by their own normals, if they
//! come to lie over slave faces whose pairs do not hold all that is over them.
//!
//! A point has passed into a rigid shape if it is in it. One that has passed through the whole of a shape is outside again, and
//! is not found.

use std::collections::{BTreeSet, HashMap, HashSet};

use super::candidates::{Candidates, Reach};
use super::digits::ON_PLANE;
use super::face::Face;
use super::held::{Held, least_share};
use super::kept_surfaces::{KeptMaster, KeptSurfaces};
use super::mesh::Side;
use super::pairing_progress::PairingProgress;
use super::pairs::SurfacePairs;
use super::plane::Plane;
use super::shape::{Local, MANY_FACES};
use super::sweep::{Bounds, Hull};
use super::tree::Tree;
use crate::error::{Argument, Error};
use crate::linalg::vector3::Vector3;
use crate::monitor::Monitor;

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

/// What has passed through, and the slave faces of which a point has.
type Found = (Penetration, HashSet<usize>);

/// A point of a face before and after the motion, by its place on it and its node; `None`: the middle.
type Point<'p> = ([&'p Face<'p>; 2], Local, Option<usize>);

/// The way from a point, back along a normal, to the nearest face that it was in front of.
#[derive(Clone, Copy, Debug)]
struct Way {
    /// Its length; negative: ahead.
    depth: f64,
    /// It is longer than the least depth that counts.
    is_through: bool,
    slave: usize,
    /// `None`: a shape.
    master: Option<usize>,
}

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
        let slaves = &self.before_and_after(("slave", progress), &moved, &self.slave);
        let held = &self.held(pairs, &moved, &slaves[0]);
        match &self.master {
            KeptMaster::Shape(shape) => {
                let wrong = |what| Error::invalid(Argument::Obstacle, format!("obstacle: {what}"));
                let shape = shape.check(self.dim, 1.0).map_err(wrong)?;
                let depth = |x: Vector3| -shape.facing(x).0 - self.clearance;
                let through = |at, (faces, local, place): Point<'_>| {
                    let least = held.least(at, faces[0], place);
                    let [before, now] = faces.map(|face| depth(face.position(local)));
                    let is_through = before <= least && now > least;
                    is_through.then_some(Way { depth: now, is_through, slave: at, master: None })
                };
                let faces = (held.asked.iter().copied(), true);
                Ok(self.deepest(Found::default(), faces, slaves, through)?.0)
            }
            KeptMaster::Faces(_) if held.asked.is_empty() => Ok(Penetration::default()),
            KeptMaster::Faces(lists) => {
                let masters = &self.before_and_after(("master", progress), &moved, lists);
                let (near, found) = self.through_faces(held, [slaves, masters])?;
                let mut lists = [vec![0], Vec::new()];
                for &at in &held.asked {
                    lists[1].extend(slaves[0].nodes(at));
                    lists[0].push(lists[1].len());
                }
                let asked = &self.before_and_after(("slave", progress), &moved, &lists);
                self.masters_through((held, near), [asked, masters], found)
            }
        }
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
            let (depth, is_through, master) =
                self.behind((point, normal), masters, &mut candidates, |_| least)?;
            Some(Way { depth, is_through, slave: at, master: Some(master) })
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

    /// The nearest face at a point with a normal or behind it, with its depth, and if that counts, for which `least` tells the least.
    fn behind(
        &self,
        ((faces, local, _), normal): (Point<'_>, Vector3),
        [before, after]: &[Side<'_>; 2],
        candidates: &mut Candidates<'_>,
        least: impl Fn(usize) -> f64,
    ) -> Option<(f64, bool, usize)> {
        let [origin, x] = faces.map(|face| face.position(local) - self.clearance * normal);
        let plane = Plane::new(self.dim, x, normal);
        // How far behind the point a face is, and how far in front of both the point was: along its normal, and along the face's.
        let meeting = |&at: &usize| {
            let (local, height) = plane.meeting(&after.face(at))?;
            let opposite = before.face(at);
            let apart = opposite.position(local) - origin;
            Some((at, -height, [normal.dot(&apart), -opposite.normal(local).dot(&apart)]))
        };
        let behind = candidates.of_point(x, normal).iter().filter_map(meeting);
        let behind = behind.filter_map(|(at, depth, [own, other])| {
            let least = least(at);
            let was_in_front = own.max(other) >= -least;
            (was_in_front && depth >= -least).then_some(((depth, least, at), own.min(other)))
        });
        let ((depth, least, at), front) = behind.min_by(|a, b| a.0.0.total_cmp(&b.0.0))?;
        let is_through = depth > least;
        let is_outside = is_through && {
            let mut entered = candidates.looking_along(x, normal).iter().filter_map(meeting);
            entered.any(|(_, entered, [own, other])| {
                let was_over_both = front >= -ON_PLANE * depth && own.min(-other) > front;
                (-least..depth - least).contains(&entered) && !was_over_both
            })
        };
        (!is_outside).then_some((depth, is_through, at))
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
            let (depth, is_through, at) =
                self.behind((point, normal), slaves, &mut candidates, least)?;
            Some(Way { depth, is_through, slave: held.asked[at], master: Some(of_master) })
        };
        let faces = (near_asked.into_iter(), false);
        Ok(self.deepest(found, faces, masters, through)?.0)
    }

    /// Adds points of some faces of a side to what is found: their nodes, and their middles if these are wanted. `way` leads from a
    /// point of a face to that which it may have passed through. The shortest from a node tells if it has. Points count if their slave
    /// face is not told yet; the faces that have such points are returned.
    fn deepest(
        &self,
        (mut found, told): Found,
        (faces, wants_middles): (impl Iterator<Item = usize>, bool),
        [before, after]: &[Side<'_>; 2],
        mut way: impl FnMut(usize, Point<'_>) -> Option<Way>,
    ) -> Result<Found, Error> {
        let mut ways: Vec<(Way, Option<usize>, Vector3)> = Vec::new();
        let mut shortest: HashMap<usize, usize> = HashMap::new();
        let mut asked = vec![0; self.coordinates.len() / self.dim];
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
                let Some(way) = way(at, (faces, local, place)) else { continue };
                if let Some(place) = place {
                    let first = shortest.entry(place).or_insert(ways.len());
                    if ways.get(*first).is_some_and(|(other, ..)| way.depth < other.depth) {
                        *first = ways.len();
                    }
                }
                ways.push((way, place, faces[1].position(local)));
            }
        }
        let mut passed = HashSet::new();
        for (at, &(way, place, point)) in ways.iter().enumerate() {
            let first = place.map_or(at, |place| shortest[&place]);
            if !(way.is_through && ways[first].0.is_through) {
                continue;
            }
            passed.insert(way.slave);
            if first != at {
                continue;
            }
            found.count += usize::from(!told.contains(&way.slave));
            if way.depth > found.depth {
                let node = place.and_then(|place| self.nodes.get(place).copied());
                let Way { depth, slave: face, master, .. } = way;
                found = Penetration { depth, point: point.into(), face, node, master, ..found };
            }
        }
        Ok((found, passed))
    }
}
