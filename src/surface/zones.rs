//! Contact zones in one set of pairs, one zone after the other.

use std::collections::{BTreeSet, HashMap, HashSet};

use super::candidates::SAME_WAY;
use super::digits::ON_PLANE;
use super::pairs::{SurfacePair, SurfacePairs, SurfaceReport, tangents};
use super::sector_boundary::{CLOSE, at_images};
use super::surfaces::Faces;
use super::sweep::Bounds;
use crate::error::{Argument, Error, Message, index};
use crate::linalg::vector3::{Vector3, unit, without};

/// A contact zone: its name, its pairs, and the slave faces that they were made of.
#[derive(Clone, Copy, Debug)]
pub struct ContactZone<'a> {
    /// The name, which no other zone has.
    pub name: &'a str,
    /// The pairs.
    pub contact: &'a SurfacePairs,
    /// The slave side.
    pub slave: Faces<'a>,
}

/// Zones in one set of pairs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Joined {
    /// The pairs, one zone after the other. The lists of faces in the report, which count in each zone by themselves, are empty.
    pub contact: SurfacePairs,
    /// The first pair of each zone, and the number of all pairs.
    pub starts: Vec<usize>,
}

/// Joins zones. A node may be slave in one zone and master in another, and a slave node of several zones by faces of its
/// own in each. At an edge of the body it has a pair in each of them. Where zones cut a smooth surface it has one, in the first
/// of them, which is the sum of its rows in all: a row of dual mortar is a sum over the faces at its node, so that this one is
/// the row of the node on the whole surface.
///
/// # Errors
/// [`Argument::Pairs`]: no zone, a name that is empty or stands twice, zones of different dimensions or one of revolution
/// among others, zones of different sectors, or of which one has one boundary of a slave and another one the other, and a slave
/// face of two zones of which both have the pair of a node on the same side: they would press on it twice.
pub fn join_zones(zones: &[ContactZone<'_>]) -> Result<Joined, Error> {
    join(zones).map_err(|message| Error::invalid(Argument::Pairs, message))
}

/// As [`join_zones`], with the first fault of zones in words.
fn join(zones: &[ContactZone<'_>]) -> Result<Joined, String> {
    check(zones)?;
    let mut joined = SurfacePairs {
        dim: zones[0].contact.dim,
        axisymmetric: zones[0].contact.axisymmetric,
        towards: zones[0].contact.towards,
        ..SurfacePairs::default()
    };
    let mut starts = vec![0];
    // The places of the pairs of a node, and the rows that are summed for each pair, with the direction of first tangents.
    let mut places: HashMap<usize, Vec<usize>> = HashMap::new();
    let mut parts: Vec<(Vec<SurfacePair>, [f64; 3])> = Vec::new();
    let points = zones.iter().flat_map(|zone| &zone.contact.pairs).map(|pair| pair.point);
    let size = points.flatten().fold(0.0, |size: f64, x| size.max(x.abs()));
    for ContactZone { name, contact, .. } in zones {
        let numbers = joined.images.join(&contact.images, size).ok_or_else(|| {
            format!(
                "zone '{name}' is in another sector than zone '{}', or of another mesh: give all zones the same axis and number \
                 of sectors, and pair them on one mesh",
                zones[0].name
            )
        })?;
        joined.held.extend(contact.held.clone());
        for pair in &contact.pairs {
            let pair = pair.renumbered(&contact.images, &numbers);
            let of_node = places.entry(pair.slave).or_default();
            // Parts of one smooth surface, and both against bodies or against obstacles.
            let same = of_node.iter().find(|&&at| {
                let other = &parts[at].0[0];
                let [own, others] = [&pair, other].map(|pair| Vector3::from(pair.normal));
                let are_alike = pair.masters().is_empty() == other.masters().is_empty();
                are_alike && own.dot(&others) > SAME_WAY
            });
            if let Some(&at) = same {
                parts[at].0.push(pair);
            } else {
                of_node.push(parts.len());
                parts.push((vec![pair], contact.towards));
            }
        }
        joined.unpaired.extend(&contact.unpaired);
        joined.report.add(&contact.report);
        starts.push(parts.len());
    }
    let sum = |(parts, towards): (Vec<SurfacePair>, [f64; 3])| {
        let held = joined.held(parts[0].slave);
        SurfacePair::sum(joined.dim, parts, (towards.into(), &held))
    };
    joined.pairs = parts.into_iter().map(sum).collect();
    check_boundary(&joined, &starts, zones)?;
    let mut told = HashSet::new();
    joined.unpaired.retain(|node| !places.contains_key(node) && told.insert(*node));
    Ok(Joined { contact: joined, starts })
}

/// The first fault of zones, in words.
fn check(zones: &[ContactZone<'_>]) -> Result<(), String> {
    let Some(first) = zones.first() else { return Err("there is no zone".into()) };
    for (place, zone) in zones.iter().enumerate() {
        let (name, contact) = (zone.name, zone.contact);
        if name.is_empty() {
            return Err(format!("zone {} has no name", index(place)));
        }
        if name.chars().any(char::is_control) {
            return Err(format!(
                "the name of zone {} has a control character, as a line's end is",
                index(place)
            ));
        }
        if zones[..place].iter().any(|other| other.name == name) {
            return Err(format!("two zones are named '{name}': give each a name of its own"));
        }
        let named = |what: &str| format!("zone '{name}' {what} zone '{}'", first.name);
        if contact.dim != first.contact.dim {
            return Err(named(&format!("is in {} dimensions, unlike", contact.dim)));
        }
        if contact.axisymmetric != first.contact.axisymmetric {
            let kinds = ["in the plane", "a body of revolution"];
            let kind = |contact: &SurfacePairs| kinds[usize::from(contact.axisymmetric)];
            return Err(format!(
                "zone '{name}' is {}, and zone '{}' is {}: give axisymmetric alike to the pairings of all zones",
                kind(contact),
                first.name,
                kind(first.contact)
            ));
        }
    }
    shared_face(zones).map_or(Ok(()), Err)
}

/// Refuses pairs of two zones at one place of a sector's boundary: each has half of a row, as no zone has both.
fn check_boundary(
    joined: &SurfacePairs,
    starts: &[usize],
    zones: &[ContactZone<'_>],
) -> Result<(), String> {
    let Some(sector) = joined.images.sector() else { return Ok(()) };
    let points: Vec<Vector3> = joined.pairs.iter().map(|pair| pair.point.into()).collect();
    let Bounds { low, high } = Bounds::of(points.iter().copied());
    // Half rows have areas as faces have, and images miss by what the digits of coordinates leave open.
    let exact = ON_PLANE * (high - low).amax();
    let length = |pair: &SurfacePair| pair.area.powf(1.0 / (joined.dim - 1) as f64);
    let allowed: Vec<f64> =
        joined.pairs.iter().map(|pair| exact.max(CLOSE * length(pair))).collect();
    let near = allowed.iter().copied().fold(exact, f64::max);
    let zone = |pair: usize| starts.partition_point(|start| *start <= pair) - 1;
    let mut found = Vec::new();
    for [ahead, _] in sector.steps() {
        let same = at_images(&points, |x| ahead.of(x), near, || Ok::<(), String>(()))?;
        found.extend(same.into_iter().enumerate().map(|(pair, same)| (pair, same, ahead)));
    }
    for (pair, same, motion) in found {
        let normal = motion.turn * Vector3::from(joined.pairs[pair].normal);
        let image = motion.of(points[pair]);
        let is_half = |other: &&usize| {
            let is_there = (points[**other] - image).norm() <= allowed[pair].min(allowed[**other]);
            let others = Vector3::from(joined.pairs[**other].normal);
            is_there && zone(**other) != zone(pair) && normal.dot(&others) > SAME_WAY
        };
        if let Some(&other) = same.iter().find(is_half) {
            let [(own, a), (others, b)] =
                [pair, other].map(|at| (zones[zone(at)].name, index(joined.pairs[at].slave)));
            return Err(format!(
                "node {a} of zone '{own}' and node {b} of zone '{others}' are images of each other on the boundary of the \
                 sector: give the slave faces at both to one zone"
            ));
        }
    }
    Ok(())
}

/// The normal of the pair that a node has in a zone.
fn normal_at(zone: &ContactZone<'_>, node: usize) -> Option<Vector3> {
    let found = zone.contact.pairs.binary_search_by_key(&node, |pair| pair.slave);
    found.ok().map(|at| Vector3::from(zone.contact.pairs[at].normal))
}

/// The words for a slave face of two zones of which both have the pair of a node.
fn shared_face(zones: &[ContactZone<'_>]) -> Option<String> {
    let mut known: HashMap<Vec<usize>, Vec<(usize, usize)>> = HashMap::new();
    let normal = |zone: usize, node: usize| normal_at(&zones[zone], node);
    for (place, zone) in zones.iter().enumerate() {
        for (face, ends) in zone.slave.start.windows(2).enumerate() {
            let nodes = &zone.slave.nodes[ends[0]..ends[1]];
            let mut key = nodes.to_vec();
            key.sort_unstable();
            let others = known.entry(key).or_default();
            for &(other, other_face) in others.iter() {
                // Both sides of a shell have the same nodes, and normals that are opposite.
                let twice = |node: &&usize| {
                    let normals = normal(place, **node).zip(normal(other, **node));
                    normals.is_some_and(|(own, others)| own.dot(&others) > 0.0)
                };
                if let Some(node) = nodes.iter().find(twice) {
                    return Some(format!(
                        "slave face {} of zone '{}' is slave face {} of zone '{}', and both have a pair of node {}: \
                         pair it once, with the masters of both zones",
                        index(face),
                        zone.name,
                        index(other_face),
                        zones[other].name,
                        index(node)
                    ));
                }
            }
            others.push((place, face));
        }
    }
    None
}

impl Joined {
    /// The findings in the zones that were joined, in a sentence for each, and how many pairs are in others.
    pub fn summary(&self, zones: &[ContactZone<'_>]) -> Message {
        let told =
            |zone: &ContactZone<'_>| format!("{}: {}", zone.name, zone.contact.summary().marked());
        let mut parts: Vec<String> = zones.iter().map(told).collect();
        let own: usize = zones.iter().map(|zone| zone.contact.pairs.len()).sum();
        let taken_in = own - self.contact.pairs.len();
        if taken_in > 0 {
            parts.push(format!(
                "Where zones cut a smooth surface, {taken_in} pairs of later zones are in those of the same nodes in \
                 earlier ones, with the law of these"
            ));
        }
        let folded = folded_at_cuts(zones);
        if folded > 0 {
            parts.push(format!(
                "{folded} nodes of such cuts are folded in one zone, and have a pair in another one: pressures around them are not those of \
                 the whole surface. Pair the slave faces of both zones in one call, with a law for each pair"
            ));
        }
        parts.join(". ").into()
    }
}

/// Number of nodes that are folded in one zone and have a pair on the same surface in another: on the whole surface they are
/// one or the other.
fn folded_at_cuts(zones: &[ContactZone<'_>]) -> usize {
    let folds = zones
        .iter()
        .flat_map(|zone| zone.contact.report.folded.iter().map(move |fold| (zone, fold)));
    let mut nodes = BTreeSet::new();
    for (zone, fold) in folds {
        let Some(own) = normal_at(zone, fold.into) else { continue };
        let goes_on = |other: &ContactZone<'_>| {
            normal_at(other, fold.node).is_some_and(|normal| own.dot(&normal) > SAME_WAY)
        };
        nodes.extend(zones.iter().any(goes_on).then_some(fold.node));
    }
    nodes.len()
}

impl SurfacePair {
    /// The sum of the rows of one node on parts of the faces around it, by their areas, with a first tangent towards a direction.
    /// The node is held along orthonormal directions.
    fn sum(
        dim: usize,
        mut parts: Vec<SurfacePair>,
        (towards, held): (Vector3, &[Vector3]),
    ) -> SurfacePair {
        if parts.len() == 1 {
            return parts.swap_remove(0);
        }
        let area: f64 = parts.iter().map(|part| part.area).sum();
        let mean = |value: fn(&SurfacePair) -> f64| {
            parts.iter().map(|part| part.area / area * value(part)).sum::<f64>()
        };
        let mean_vector = |vector: fn(&SurfacePair) -> [f64; 3]| -> Vector3 {
            parts.iter().map(|part| part.area / area * Vector3::from(vector(part))).sum()
        };
        let normal = unit(without(mean_vector(|part| part.normal), held));
        let normal = normal.unwrap_or_else(|| parts[0].normal.into());
        let mut sum = SurfacePair {
            point: mean_vector(|part| part.point).into(),
            normal: normal.into(),
            tangents: tangents(dim, normal, towards, held).map(Into::into),
            gap: mean(|part| part.gap),
            measured_gap: mean(|part| part.measured_gap),
            area,
            ..parts[0].clone()
        };
        sum.set_entries(parts.iter().flat_map(|part| {
            let share = part.area / area;
            part.entries().map(move |(key, (weight, turn))| (key, (share * weight, share * turn)))
        }));
        sum
    }
}

impl SurfaceReport {
    /// Adds what holds of another zone, but for its lists of faces.
    fn add(&mut self, other: &SurfaceReport) {
        self.search_distance = self.search_distance.max(other.search_distance);
        self.overlap_distance = self.overlap_distance.max(other.overlap_distance);
        self.slave_faces += other.slave_faces;
        self.slave_area += other.slave_area;
        self.covered_area += other.covered_area;
        self.folded.extend(&other.folded);
        self.not_opposed += other.not_opposed;
        self.boxes_searched += other.boxes_searched;
    }
}
