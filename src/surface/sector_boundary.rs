//! The boundaries of a sector, of which the second is the image of the first.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use super::candidates::SearchFaces;
use super::images::Images;
use super::mesh::Side;
use super::motion::Motion;
use super::plane::Plane;
use super::sector::Sector;
use super::sweep::Sweep;
use super::watch::Watch;
use crate::error::{Argument, Error, index};
use crate::linalg::vector3::{self, Vector3, vector};

/// The nodes of a side on the second boundary, to which a motion leads, with those on the first whose images they are. Nodes on
/// the axis are on neither.
///
/// # Errors
/// Two nodes at one place; what ends the watch.
pub(super) fn second_boundary(
    motion: &Motion,
    side: &Side<'_>,
    watch: &mut Watch<'_, '_>,
) -> Result<BTreeMap<usize, usize>, Error> {
    let nodes = side.all_nodes();
    let place = |node: &usize| vector(&side.coordinates[side.dim * node..][..side.dim]);
    let places: Vec<Vector3> = nodes.iter().map(place).collect();
    let near = side.nearness() / side.scale;
    let found = at_images(&places, |x| motion.of(x), near, || watch.goes_on())?;
    let mut second = BTreeMap::new();
    for (place, same) in found.into_iter().enumerate() {
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

/// Refuses a slave side on one of whose faces the image of a node lies, and no node there.
pub(super) fn check_boundaries(
    slave: &Side<'_>,
    (sector, images): (&Sector, &Images),
    watch: &mut Watch<'_, '_>,
) -> Result<(), Error> {
    let on_boundary: BTreeSet<usize> =
        images.on_second().iter().flat_map(|(second, first, _)| [*second, *first]).collect();
    let SearchFaces { mut tree, normals, .. } = SearchFaces::new(slave, watch)?;
    let (near, mut found) = (slave.nearness(), Vec::new());
    let inner = slave.all_nodes().into_iter().filter(|node| !on_boundary.contains(node));
    for node in inner {
        for motion in sector.steps().as_flattened() {
            watch.goes_on()?;
            let x = slave.position(node);
            let image = slave.scale * motion.of(x / slave.scale);
            if (image - x).norm() <= near {
                continue;
            }
            tree.near(&Sweep::of_point(&image, vector3::axis(0), [near; 2]), &mut found);
            let holds = |at: &&usize| {
                let flat = Plane::new(slave.dim, image, normals[**at]).flatten(&slave.face(**at));
                let local = flat.local([0.0; 2]).filter(|&local| flat.face.kind.holds(local));
                local.is_some_and(|local| flat.height(local).abs() <= near)
            };
            if let Some(face) = found.iter().find(holds) {
                let message = format!(
                    "sector: the image of slave node {}, {}, lies on slave face {} and on none of its nodes: give the number of \
                     sectors of the whole or the period, and nodes of the two boundaries that match",
                    index(node),
                    sector.step_in_words(),
                    index(*face)
                );
                return Err(Error::invalid(Argument::Settings, message));
            }
        }
    }
    Ok(())
}
