//! Both sides with their images beyond the boundaries of the model.
//!
//! In the whole body the row of a node on a boundary of a sector, or on a plane of symmetry, is the sum over the faces on
//! both sides of it, and what lies opposite may be beyond. So both sides are paired with their images, turned and
//! mirrored, and the rows of nodes that the model has are kept: of the two nodes on the boundaries of a sector that are
//! images of each other those of the first. A node that is its own image, as it stands on a plane or on the axis, has
//! its part of a row of the whole.

use std::collections::{HashMap, HashSet};

use super::mesh::Side;
use super::motion::Motion;
use super::numbering::{Image, Numbering};
use super::pairs::SurfacePairs;
use super::sector_boundary::check_boundaries;
use super::settings::{SurfaceSettings, TrueShape};
use super::surfaces::Faces;
use super::sweep::Bounds;
use super::symmetry::OnPlanes;
use crate::error::Error;
use crate::linalg::vector3::axis;

/// A side with its images behind its own nodes and faces.
struct Extended {
    coordinates: Vec<f64>,
    start: Vec<usize>,
    nodes: Vec<usize>,
    /// The motion and the own face of each image.
    origins: Vec<(Motion, usize)>,
}

/// The images of a slave side and of what it faces.
pub(super) struct WithImages {
    numbering: Numbering,
    slave: Extended,
    master: Extended,
}

/// The other side, the nodes of it that stand on planes, and how far from the slave it may be.
type Opposite<'a, 's> = (&'a Side<'s>, &'a OnPlanes, f64);

impl WithImages {
    /// The images that bear on the rows of a side, of which some nodes are on planes. `None`: there are none.
    ///
    /// # Errors
    /// A side with two nodes at one place of the boundary of a sector; a slave side whose boundaries do not match;
    /// too many images; what stops the pairing.
    pub(super) fn new(
        settings: &SurfaceSettings,
        (slave, on): (&Side<'_>, &mut OnPlanes),
        (master, on_master, reach): Opposite<'_, '_>,
    ) -> Result<Option<WithImages>, Error> {
        if slave.count() == 0 || settings.sector.is_none() && settings.symmetry.is_empty() {
            return Ok(None);
        }
        let sector = settings.sector;
        let mut numbering = Numbering::new(sector, slave);
        numbering.relate((slave, on))?;
        if let Some(sector) = &sector {
            check_boundaries(slave, (sector, &numbering.images))?;
        }
        // Rows depend on the cover of nodes up to eight faces away, and fitted normals on two more.
        let layers = if settings.shapes.contains(&TrueShape::Fitted) { 10 } else { 8 };
        let faces = layers_beyond(&mut numbering, (slave, layers))?;
        let own = Extended::new(&mut numbering, slave, &faces)?;
        on.see(&numbering.images);
        // A box around the slave and its images, in the host's unit.
        let of_host = |node: usize| slave.of_host(node);
        let places = slave.all_nodes().into_iter().map(of_host);
        let near = Bounds::of(places.chain(numbering.images.positions(of_host)));
        let near = near.widened(reach / slave.scale);
        let mut of_rigid;
        let of_master = if master.is_rigid() {
            of_rigid = Numbering::new(sector, master);
            &mut of_rigid
        } else {
            &mut numbering
        };
        of_master.relate((master, on_master))?;
        let faces = images_near(of_master, (master, on_master), &near)?;
        let master = Extended::new(of_master, master, &faces)?;
        let has_some = !own.origins.is_empty() || !master.origins.is_empty();
        let all = WithImages { numbering, slave: own, master };
        Ok(Some(all).filter(|_| sector.is_some() || has_some))
    }

    /// Both sides with their images.
    pub(super) fn sides<'a>(&'a self, slave: &Side<'a>, master: &Side<'a>) -> [Side<'a>; 2] {
        [self.slave.on(slave), self.master.on(master)]
    }

    /// The supports of nodes along axes, with those of their images. Those of second boundaries are images too: there the host has
    /// equations and no supports.
    pub(super) fn with_images(&self, settings: &SurfaceSettings, dim: usize) -> SurfaceSettings {
        let images = &self.numbering.images;
        let is_held = |(image, along): &(usize, usize)| {
            let (node, motion) = images.home(*image);
            settings.is_supported(node, motion.turn.transpose() * axis(*along))
        };
        let all = images.on_second().keys().copied().chain(images.numbers());
        let places = all.flat_map(|image| (0..dim).map(move |along| (image, along)));
        let supports = settings.supports.iter().copied().chain(places.filter(is_held));
        let mut supports: Vec<(usize, usize)> = supports.collect();
        supports.sort_unstable();
        SurfaceSettings { supports, ..settings.clone() }
    }

    /// The pairs of nodes that the model has, among those of sides with images.
    ///
    /// # Errors
    /// Too many images.
    pub(super) fn own_pairs(
        mut self,
        mut found: SurfacePairs,
        slave: &Side<'_>,
    ) -> Result<SurfacePairs, Error> {
        let images = &self.numbering.images;
        found.pairs.retain(|pair| images.is_own(pair.slave));
        found.unpaired.retain(|node| images.is_own(*node));
        found.held.retain(|node, _| !images.has(*node));
        let report = &mut found.report;
        report.slave_faces = slave.count();
        report.uncovered_faces.retain(|face| *face < slave.count());
        report.held_in_part.retain(|face| *face < slave.count());
        report.beyond.retain(|(face, _)| *face < slave.count());
        report.stand_off.retain(|(node, _)| images.is_own(*node));
        report.folded.retain(|fold| images.is_own(fold.node));
        report.folded.iter_mut().for_each(|fold| fold.into = images.home(fold.into).0);
        for pair in &mut found.pairs {
            self.numbering.take_part(pair)?;
        }
        report.covered_area = found.pairs.iter().map(|pair| pair.area).sum();
        let images = self.numbering.images;
        let is_used = found.pairs.iter().any(|pair| pair.has_image(&images));
        found.images = if is_used { images } else { images.without_images() };
        Ok(found)
    }
}

impl Extended {
    /// A side with images of some of its faces, by the places of their motions.
    ///
    /// # Errors
    /// Too many images; what stops the pairing.
    fn new(numbering: &mut Numbering, side: &Side<'_>, faces: &[Image]) -> Result<Extended, Error> {
        let Faces { start, nodes } = side.faces;
        let motion_and_face = |&(place, face): &Image| (numbering.images.motion(place), face);
        let mut all = Extended {
            coordinates: side.coordinates.to_vec(),
            start: start.to_vec(),
            nodes: nodes.to_vec(),
            origins: faces.iter().map(motion_and_face).collect(),
        };
        for &(place, face) in faces {
            side.progress.goes_on()?;
            let (nodes, corners) = (side.face(face).nodes, side.corners(face).len());
            let first = all.nodes.len();
            for &node in nodes {
                all.nodes.push(numbering.number((place, node))?);
            }
            if numbering.images.motion(place).mirrors() {
                let image = &mut all.nodes[first..];
                image[..corners].reverse();
                // Mid nodes are between corners as before; the last edge stays the last.
                let mids = corners..nodes.len().min(2 * corners - 1);
                image[mids].reverse();
            }
            all.start.push(all.nodes.len());
        }
        for x in numbering.images.positions(|node| side.of_host(node)) {
            all.coordinates.extend(&x.as_slice()[..side.dim]);
        }
        Ok(all)
    }

    /// As a side like the one that it was made of.
    fn on<'a>(&'a self, side: &Side<'a>) -> Side<'a> {
        let faces = Faces { start: &self.start, nodes: &self.nodes };
        side.with(&self.coordinates, faces, &self.origins)
    }
}

/// The images of faces, not of nodes, up to so many layers beyond the boundaries.
///
/// # Errors
/// Too many images; what stops the pairing.
fn layers_beyond(
    numbering: &mut Numbering,
    (side, layers): (&Side<'_>, usize),
) -> Result<Vec<Image>, Error> {
    let mut around: HashMap<usize, Vec<usize>> = HashMap::new();
    for face in side.each_face() {
        let (at, face) = face?;
        face.nodes.iter().for_each(|node| around.entry(*node).or_default().push(at));
    }
    let (mut found, mut known): (Vec<Image>, HashSet<Image>) = Default::default();
    let mut last: Vec<Image> = numbering.on_boundaries().map(|node| (0, node)).collect();
    for _ in 0..layers {
        let before = found.len();
        for image in std::mem::take(&mut last) {
            side.progress.goes_on()?;
            for (place, node) in numbering.same(image)?.into_iter().filter(|(place, _)| *place > 0)
            {
                let faces = around[&node].iter().map(|face| (place, *face));
                found.extend(faces.filter(|face| known.insert(*face)));
            }
        }
        let nodes =
            |&(place, face): &Image| side.face(face).nodes.iter().map(move |node| (place, *node));
        last = found[before..].iter().flat_map(nodes).collect();
        last.sort_unstable();
        last.dedup();
    }
    Ok(found)
}

/// The images of faces that reach into a box, in the host's unit: image by image from the side itself, as none is nearer than
/// those between.
///
/// # Errors
/// Too many images; what stops the pairing.
fn images_near(
    numbering: &mut Numbering,
    (side, on): (&Side<'_>, &OnPlanes),
    near: &Bounds,
) -> Result<Vec<Image>, Error> {
    let nodes = side.all_nodes();
    let steps = numbering.steps(on);
    let bounds = |nodes: &[usize], motion: &Motion| {
        Bounds::of(nodes.iter().map(|node| motion.of(side.of_host(*node))))
    };
    let mut places = vec![0];
    let mut next = 0;
    while let Some(&place) = places.get(next) {
        next += 1;
        for step in &steps {
            side.progress.goes_on()?;
            let motion = numbering.images.motion(place).after(step);
            let there = numbering.place(&motion)?;
            if !places.contains(&there) && bounds(&nodes, &motion).meets(near) {
                places.push(there);
            }
        }
    }
    let mut found = Vec::new();
    for &place in &places[1..] {
        let motion = numbering.images.motion(place);
        for face in side.each_face() {
            let (at, face) = face?;
            found.extend(bounds(face.nodes, &motion).meets(near).then_some((place, at)));
        }
    }
    Ok(found)
}
