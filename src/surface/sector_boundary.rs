//! The boundaries of a sector, of which the second is the image of the first.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use super::images::Images;
use super::mesh::Side;
use super::motion::Motion;
use super::plane::Plane;
use super::sector::Sector;
use super::sweep::Sweep;
use super::tree::Tree;
use crate::error::{Argument, Error, index};
use crate::linalg::vector3::{self, Vector3};

/// Of the shortest edge at a node: nodes whose images miss by less may be one of which coordinates have few digits.
const PARTNER: f64 = 0.1;

/// Of the shortest edge at a node: where its image is nearer than this to an edge, surfaces meet there.
pub(super) const CLOSE: f64 = 0.01;

/// The nodes of a side on the second boundary, to which a motion leads, with those on the first whose images they are. Nodes on
/// the axis are on neither.
///
/// # Errors
/// Two nodes at one place; what stops the pairing.
pub(super) fn second_boundary(
    motion: &Motion,
    side: &Side<'_>,
) -> Result<BTreeMap<usize, usize>, Error> {
    let nodes = side.all_nodes();
    let places: Vec<Vector3> = nodes.iter().map(|&node| side.of_host(node)).collect();
    let (rim, near) = (Rim::new(side), side.nearness() / side.scale);
    let allowed = |node: &usize| near.max(side.left_open.min(PARTNER * rim.edge(*node)));
    let allowed: Vec<f64> = nodes.iter().map(allowed).collect();
    let widest = allowed.iter().copied().fold(near, f64::max);
    let found = at_images(&places, |x| motion.of(x), widest, || side.progress.goes_on())?;
    let mut second = BTreeMap::new();
    for (place, mut same) in found.into_iter().enumerate() {
        let image = motion.of(places[place]);
        let limit = |other: usize| allowed[place].min(allowed[other]);
        same.retain(|&other| (places[other] - image).norm() <= limit(other));
        if let [a, b, ..] = same[..] {
            let what = format!(
                "sector: nodes {} and {} of one side stand at one place on its boundary: pair the two parts apart",
                index(nodes[a]),
                index(nodes[b])
            );
            return Err(Error::invalid(Argument::Settings, what));
        }
        // Each boundary is the image of the other where there are two sectors.
        let is_first = |other: &&usize| **other != place && !second.contains_key(&nodes[place]);
        let image = same.first().filter(is_first).copied();
        second.extend(image.map(|other| (nodes[other], nodes[place])));
    }
    Ok(second)
}

/// The rim of a side, on which the boundaries of a sector are: edges and ends that one face has.
struct Rim {
    /// For each node the nodes beside it on the rim.
    beside: BTreeMap<usize, Vec<usize>>,
    /// For each node of it the distance to the nearest other node of its faces, in the host's unit.
    edges: BTreeMap<usize, f64>,
}

impl Rim {
    fn new(side: &Side<'_>) -> Rim {
        let mut counts: HashMap<[usize; 2], (usize, Option<usize>)> = HashMap::new();
        for face in 0..side.count() {
            let nodes = side.nodes(face);
            let mids: HashMap<usize, usize> =
                side.kind(nodes).mids().map(|(mid, [a, _])| (a, nodes[mid])).collect();
            for (i, [a, next]) in side.edges(face).enumerate() {
                let b = if side.dim == 2 { a } else { next };
                let (count, mid) = counts.entry([a.min(b), a.max(b)]).or_default();
                *count += 1;
                *mid = mids.get(&i).copied().filter(|_| side.dim > 2);
            }
        }
        let mut beside: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for ([a, b], (_, mid)) in counts.into_iter().filter(|(_, (count, _))| *count == 1) {
            let chain = [Some(a), mid, Some(b)].into_iter().flatten().collect::<Vec<usize>>();
            for ends in chain.windows(2) {
                beside.entry(ends[0]).or_default().push(ends[1]);
                beside.entry(ends[1]).or_default().push(ends[0]);
            }
        }
        let mut edges = BTreeMap::new();
        for nodes in (0..side.count()).map(|face| side.nodes(face)) {
            for node in nodes.iter().filter(|node| beside.contains_key(node)) {
                let place = side.of_host(*node);
                let away = nodes.iter().filter(|other| *other != node);
                let away = away.map(|other| (side.of_host(*other) - place).norm());
                let shortest: &mut f64 = edges.entry(*node).or_insert(f64::INFINITY);
                *shortest = away.fold(*shortest, f64::min);
            }
        }
        Rim { beside, edges }
    }

    /// The shortest edge at a node; zero if it is not on the rim.
    fn edge(&self, node: usize) -> f64 {
        self.edges.get(&node).copied().unwrap_or(0.0)
    }

    /// Refuses a slave side on the rim of which, between two nodes or at one, the image of a node of it lies that is none of its
    /// nodes, but for little of its shortest edge, though surfaces meet there. Nodes that have partners need none.
    ///
    /// # Errors
    /// That; what stops the pairing.
    fn check(
        &self,
        (sector, motion): (&Sector, &Motion),
        side: &Side<'_>,
        partners: &BTreeSet<usize>,
    ) -> Result<(), Error> {
        let nodes: Vec<usize> = self.beside.keys().copied().collect();
        let places: Vec<Vector3> = nodes.iter().map(|&node| side.of_host(node)).collect();
        let lengths = nodes.iter().zip(&places).flat_map(|(node, x)| {
            self.beside[node].iter().map(move |&other| (side.of_host(other) - x).norm())
        });
        let longest = lengths.fold(side.left_open, f64::max);
        let found = at_images(&places, |x| motion.of(x), longest, || side.progress.goes_on())?;
        for ((&node, x), near) in nodes.iter().zip(&places).zip(found) {
            let (image, most) = (motion.of(*x), CLOSE * self.edge(node));
            if partners.contains(&node) || (image - x).norm() <= most.max(side.left_open) {
                continue;
            }
            let near = near.into_iter().map(|at| nodes[at]);
            let beside = |a: usize| self.beside[&a].iter().copied().chain([a]);
            let mut pairs = near.flat_map(|a| beside(a).map(move |b| [a, b]));
            let is_met = |ends: &[usize; 2]| {
                let [a, b] = ends.map(|end| side.of_host(end));
                let way = b - a;
                let along = (image - a).dot(&way) / way.norm_squared();
                // A node beside itself has no way.
                let along = if along.is_finite() { along.clamp(0.0, 1.0) } else { 0.0 };
                (a + along * way - image).norm() <= most
            };
            if let Some([a, b]) = pairs.find(is_met) {
                let place =
                    format!("at the edge of nodes {} and {} and is none", index(a), index(b));
                return Err(no_match(sector, node, &place));
            }
        }
        Ok(())
    }
}

/// For each point those that are at its image, nearer than `near`.
///
/// # Errors
/// Those of `goes_on`, which is asked for each point.
pub(super) fn at_images<E>(
    points: &[Vector3],
    image: impl Fn(Vector3) -> Vector3,
    near: f64,
    mut goes_on: impl FnMut() -> Result<(), E>,
) -> Result<Vec<Vec<usize>>, E> {
    let cell = |x: Vector3| (x / (2.0 * near)).map(f64::floor);
    let key = |cell: Vector3| cell.map(f64::to_bits);
    let mut cells: HashMap<_, Vec<usize>> = HashMap::new();
    for (at, x) in points.iter().enumerate() {
        cells.entry(key(cell(*x) + Vector3::zeros())).or_default().push(at);
    }
    let step = |k: i32| [k % 3, k / 3 % 3, k / 9].map(|step| f64::from(step - 1));
    let around = || (0..27).map(|k| Vector3::from(step(k)));
    let of_point = |x: &Vector3| {
        goes_on()?;
        let image = image(*x);
        let cells = around().filter_map(|step| cells.get(&key(cell(image) + step)));
        let is_there = |other: &&usize| (points[**other] - image).norm() <= near;
        Ok(cells.flatten().filter(is_there).copied().collect())
    };
    points.iter().map(of_point).collect()
}

/// Refuses a slave side on one of whose faces, or on whose rim, the image of a node lies, and no node there.
pub(super) fn check_boundaries(
    slave: &Side<'_>,
    (sector, images): (&Sector, &Images),
) -> Result<(), Error> {
    let on_boundary: BTreeSet<usize> =
        images.on_second().iter().flat_map(|(second, (first, _))| [*second, *first]).collect();
    let mut tree = Tree::new(slave)?;
    let (near, mut found) = (slave.nearness(), Vec::new());
    let inner = slave.all_nodes().into_iter().filter(|node| !on_boundary.contains(node));
    for node in inner {
        for motion in sector.steps().as_flattened() {
            slave.progress.goes_on()?;
            let x = slave.position(node);
            let image = slave.scale * motion.of(x / slave.scale);
            if (image - x).norm() <= near {
                continue;
            }
            tree.near(&Sweep::of_point(&image, vector3::axis(0), [near; 2]), &mut found);
            let holds = |at: &&usize| {
                let plane = Plane::new(slave.dim, image, tree.normals[**at]);
                plane.meeting(&slave.face(**at)).is_some_and(|(_, height)| height.abs() <= near)
            };
            if let Some(face) = found.iter().find(holds) {
                let place = format!("on slave face {} and on none", index(*face));
                return Err(no_match(sector, node, &place));
            }
        }
    }
    let (rim, steps) = (Rim::new(slave), sector.steps());
    let mut steps = steps.as_flattened().iter();
    steps.try_for_each(|motion| rim.check((sector, motion), slave, &on_boundary))
}

/// The error of a slave node whose image lies where no node is.
fn no_match(sector: &Sector, node: usize, place: &str) -> Error {
    let step = match sector.is_shifted() {
        true => "shifted by a period".into(),
        false => format!("turned by one of {} sectors", sector.count),
    };
    let message = format!(
        "sector: the image of slave node {}, {step}, lies {place} of its nodes: give the number of sectors of the whole or the period, \
         and nodes of the two boundaries that match to the digits of their coordinates",
        index(node)
    );
    Error::invalid(Argument::Settings, message)
}
