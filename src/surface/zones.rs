//! Contact zones in one set of pairs, one zone after the other.

use std::collections::HashMap;

use super::pairs::{SurfacePairs, SurfaceReport};
use super::surfaces::Faces;
use crate::error::{Argument, Error, Message, index};
use crate::linalg::vector3::Vector3;

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

/// Joins zones. A node may be slave in one zone and master in another, and a slave node of several zones by faces of its
/// own in each. The lists of faces in the report, which count in each zone by themselves, are empty.
///
/// # Errors
/// [`Argument::Pairs`]: no zone, a name that is empty or stands twice, zones of different dimensions or one of revolution
/// among others, and a slave face of two zones of which both have the pair of a node on the same side: they would press on it
/// twice.
pub fn join_zones(zones: &[ContactZone<'_>]) -> Result<SurfacePairs, Error> {
    let refuse = |message: String| Err(Error::invalid(Argument::Pairs, message));
    let Some(first) = zones.first() else { return refuse("there is no zone".into()) };
    let mut joined = SurfacePairs {
        dim: first.contact.dim,
        axisymmetric: first.contact.axisymmetric,
        ..SurfacePairs::default()
    };
    for (place, zone) in zones.iter().enumerate() {
        let (name, contact) = (zone.name, zone.contact);
        if name.is_empty() {
            return refuse(format!("zone {} has no name", index(place)));
        }
        if zones[..place].iter().any(|other| other.name == name) {
            return refuse(format!("two zones are named '{name}'"));
        }
        let named = |what: &str| format!("zone '{name}' {what} zone '{}'", first.name);
        if contact.dim != joined.dim {
            return refuse(named(&format!("is in {} dimensions, unlike", contact.dim)));
        }
        if contact.axisymmetric != joined.axisymmetric {
            return refuse(named("is of revolution and not, or not and is, unlike"));
        }
        if joined.images.join(&contact.images).is_err() {
            return refuse(named("is in another sector than"));
        }
        joined.pairs.extend(contact.pairs.iter().cloned());
        joined.unpaired.extend(&contact.unpaired);
        joined.held.extend(contact.held.clone());
        joined.report.add(&contact.report);
    }
    match shared_face(zones) {
        Some(message) => refuse(message),
        None => Ok(joined),
    }
}

/// The words for a slave face of two zones of which both have the pair of a node.
fn shared_face(zones: &[ContactZone<'_>]) -> Option<String> {
    let mut known: HashMap<Vec<usize>, Vec<(usize, usize)>> = HashMap::new();
    let normal = |zone: usize, node: usize| {
        let pairs = &zones[zone].contact.pairs;
        let found = pairs.binary_search_by_key(&node, |pair| pair.slave);
        found.ok().map(|at| Vector3::from(pairs[at].normal))
    };
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

/// What was found in zones, in a sentence for each.
pub fn summary_of_zones<'a>(zones: impl Iterator<Item = (&'a str, &'a SurfacePairs)>) -> Message {
    let parts = zones.map(|(name, contact)| format!("{name}: {}", contact.summary().marked()));
    parts.collect::<Vec<_>>().join(". ").into()
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
