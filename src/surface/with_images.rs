//! Both sides of a sector with their images in the neighbours.
//!
//! In the whole body the row of a node on a boundary is the sum over the faces on both sides of it, of which a sector has
//! one half here and one, turned, on its other boundary; and what lies opposite may be in the neighbour. So both sides are
//! paired with their images in the neighbours, and the rows of nodes that the sector has are kept: of the two nodes that
//! are images of each other those of the first.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use super::candidates::SearchFaces;
use super::images::Images;
use super::mesh::Side;
use super::pairs::SurfacePairs;
use super::plane::Plane;
use super::sector::Sector;
use super::settings::TrueShape;
use super::surfaces::Faces;
use super::sweep::Sweep;
use super::watch::Watch;
use crate::error::{Argument, Error, index};
use crate::linalg::vector3::{self, Vector3, vector};

/// A side with its images.
pub(super) struct WithImages {
    coordinates: Vec<f64>,
    start: Vec<usize>,
    nodes: Vec<usize>,
}

impl WithImages {
    /// A side with its images in the neighbours up to `most` sectors away, of which some nodes are on the `second` boundary.
    fn new(
        side: &Side<'_>,
        (sector, most): (&Sector, i32),
        second: &BTreeMap<usize, usize>,
    ) -> WithImages {
        let (dim, count) = (side.dim, side.coordinates.len() / side.dim);
        let first: BTreeMap<usize, usize> =
            second.iter().map(|(second, first)| (*first, *second)).collect();
        let Faces { start, nodes } = side.faces;
        let mut all = WithImages {
            coordinates: side.coordinates.to_vec(),
            start: start.to_vec(),
            nodes: nodes.to_vec(),
        };
        let neighbours = sector.neighbours(most);
        for &by in &neighbours {
            let (image, place) = (sector.image(by), dim * Images::number(0, count, by));
            let end = place + side.coordinates.len();
            all.coordinates.resize(end.max(all.coordinates.len()), 0.0);
            for node in side.all_nodes() {
                let x = image(vector(&side.coordinates[dim * node..][..dim]));
                all.coordinates[place + dim * node..][..dim].copy_from_slice(&x.as_slice()[..dim]);
            }
            // Ahead, images of nodes on the first boundary are those on the second of the sector before; behind, those on the
            // second are those on the first of the sector after, and so around.
            let after = if by < 0 { by + 1 } else { by + 1 - sector.count as i32 };
            let closes = after == 0 || neighbours.contains(&after);
            let number = |node: &usize| {
                let ahead = first.get(node).filter(|_| by > 0).map(|second| (second, by - 1));
                let behind = || second.get(node).filter(|_| closes).map(|first| (first, after));
                let (node, by) = ahead.or_else(behind).unwrap_or((node, by));
                Images::number(*node, count, by)
            };
            let before = all.nodes.len();
            all.start.extend(start[1..].iter().map(|end| before + end));
            all.nodes.extend(nodes.iter().map(number));
        }
        all
    }

    /// As a side like the one that it was made of.
    pub(super) fn on<'a>(&'a self, side: &Side<'a>) -> Side<'a> {
        side.with(&self.coordinates, Faces { start: &self.start, nodes: &self.nodes })
    }
}

/// The images of two sides of one mesh, or of a side and of one of another mesh, which has none of its own; and both sides
/// with them. Slaves on a boundary have faces in the next sector, and these may have masters in the next but one; fitted normals
/// look two faces further.
///
/// # Errors
/// A sector that is none; a side with two nodes at one place of its boundary; a slave side whose boundaries do not match;
/// what ends the watch.
pub(super) fn with_images(
    (sector, shapes): (Sector, &[TrueShape; 2]),
    [slave, master]: [&Side<'_>; 2],
    watch: &mut Watch<'_, '_>,
) -> Result<(Images, [WithImages; 2]), Error> {
    let sector = &sector.checked(slave.dim)?;
    let is_fitted = shapes.contains(&TrueShape::Fitted);
    let [own, others] = if is_fitted { [2, 4] } else { [1, 2] };
    let mut second = second_boundary(sector, slave, watch)?;
    let opposite = second_boundary(sector, master, watch)?;
    check_boundaries(slave, (sector, &second), watch)?;
    let sides = [(slave, own, &second), (master, others, &opposite)];
    let sides = sides.map(|(side, most, second)| WithImages::new(side, (sector, most), second));
    if !master.is_rigid() {
        second.extend(opposite);
    }
    Ok((Images::new(*sector, slave.coordinates.len() / slave.dim, second), sides))
}

/// The pairs of a sector among those of sides with images: of nodes that it has. `faces` is the number of its slave faces.
pub(super) fn own_pairs(mut found: SurfacePairs, images: Images, faces: usize) -> SurfacePairs {
    found.pairs.retain(|pair| images.is_own(pair.slave));
    found.unpaired.retain(|node| images.is_own(*node));
    found.held.retain(|node, _| images.of(*node).0 == *node);
    let report = &mut found.report;
    let sectors = (report.slave_faces / faces.max(1)).max(1);
    report.slave_area /= sectors as f64;
    report.looking_away /= sectors;
    report.slave_faces = faces;
    report.covered_area = found.pairs.iter().map(|pair| pair.area).sum();
    report.uncovered_faces.retain(|face| *face < faces);
    report.beyond.retain(|(face, _)| *face < faces);
    report.folded.retain(|fold| images.is_own(fold.node));
    report.folded.iter_mut().for_each(|fold| fold.into = images.home(fold.into).0);
    found.images = images;
    found
}

/// The nodes of a side on the second boundary, with those on the first whose images they are. Nodes on the axis are
/// on neither.
///
/// # Errors
/// Two nodes at one place; what ends the watch.
fn second_boundary(
    sector: &Sector,
    side: &Side<'_>,
    watch: &mut Watch<'_, '_>,
) -> Result<BTreeMap<usize, usize>, Error> {
    let nodes = side.all_nodes();
    let place = |node: &usize| vector(&side.coordinates[side.dim * node..][..side.dim]);
    let places: Vec<Vector3> = nodes.iter().map(place).collect();
    let near = side.nearness() / side.scale;
    let found = at_images(&places, sector.image(1), near, || watch.goes_on())?;
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
        // Of two sectors each boundary is the image of the other.
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
fn check_boundaries(
    slave: &Side<'_>,
    (sector, second): (&Sector, &BTreeMap<usize, usize>),
    watch: &mut Watch<'_, '_>,
) -> Result<(), Error> {
    let first: BTreeSet<usize> = second.values().copied().collect();
    let SearchFaces { mut tree, normals, .. } = SearchFaces::new(slave, watch)?;
    let (near, mut found) = (slave.nearness(), Vec::new());
    let inner = slave
        .all_nodes()
        .into_iter()
        .filter(|node| !first.contains(node) && !second.contains_key(node));
    for node in inner {
        for by in sector.neighbours(1) {
            watch.goes_on()?;
            let x = slave.position(node);
            let image = slave.scale * sector.image(by)(x / slave.scale);
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
                    "sector: the image of slave node {}, turned by one of {} sectors, lies on slave face {} and on none of \
                     its nodes: give the number of sectors of the whole, and nodes of the two boundaries that match",
                    index(node),
                    sector.count,
                    index(*face)
                );
                return Err(Error::invalid(Argument::Settings, message));
            }
        }
    }
    Ok(())
}
