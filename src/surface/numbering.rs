//! Numbers of images while they are looked for: one for all images at one place that are the same node of the whole body.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use super::images::Images;
use super::mesh::Side;
use super::motion::Motion;
use super::pairs::SurfacePair;
use super::sector::Sector;
use super::sector_boundary::second_boundary;
use super::sweep::Bounds;
use super::symmetry::{Mirror, OnPlanes};
use crate::error::{Argument, Error};
use crate::linalg::vector3::{Matrix3, Vector3};

/// The image of a node, or of a face: the place of its motion among those of the images, and its number in the model.
pub(super) type Image = (usize, usize);

/// Images with their numbers.
pub(super) struct Numbering {
    pub(super) images: Images,
    /// For each node on a boundary: the motions that lay a node upon it, with these nodes. A node on a plane of symmetry is its
    /// own mirror image, and one on the second boundary of a sector the image of one on the first.
    same: BTreeMap<usize, Vec<(Motion, usize)>>,
    numbers: HashMap<Image, usize>,
    /// The middle of the bodies and their size, in the host's unit.
    around: (Vector3, f64),
    /// Motions that move no point of the bodies further apart than this are the same.
    near: f64,
}

impl Numbering {
    /// Images of the nodes of a host, which a side tells with the size of bodies; none so far.
    pub(super) fn new(sector: Option<Sector>, side: &Side<'_>) -> Numbering {
        let nodes = side.all_nodes();
        let Bounds { low, high } = Bounds::of(nodes.iter().map(|node| side.of_host(*node)));
        Numbering {
            images: Images::new(sector, side.coordinates.len() / side.dim),
            same: BTreeMap::new(),
            numbers: HashMap::new(),
            around: (0.5 * (low + high), (high - low).amax()),
            near: side.nearness() / side.scale,
        }
    }

    /// Tells which images of a side's nodes are the same, by its nodes on planes and on boundaries of a sector.
    ///
    /// # Errors
    /// Two nodes at one place of a boundary; as [`Self::place`]; what stops the pairing.
    pub(super) fn relate(&mut self, (side, on): (&Side<'_>, &OnPlanes)) -> Result<(), Error> {
        for Mirror { motion, nodes } in &on.mirrors {
            nodes.iter().for_each(|node| self.lay(*node, (*motion, *node)));
        }
        let Some(sector) = self.images.sector() else { return Ok(()) };
        let (mut on_boundaries, mut seconds) = (BTreeSet::new(), BTreeSet::new());
        for [ahead, back] in sector.steps() {
            for &node in &on.on_axis {
                self.lay(node, (ahead, node));
                self.lay(node, (back, node));
            }
            for (second, first) in second_boundary(&ahead, side)? {
                self.lay(second, (ahead, first));
                self.lay(first, (back, second));
                seconds.insert(second);
                on_boundaries.extend([second, first]);
            }
        }
        // The first one of nodes that are images of each other is one that is on no second boundary, if there is one.
        for node in on_boundaries.into_iter().filter(|_| !side.is_rigid()) {
            let same = self.same((0, node))?.into_iter();
            let first = same.min_by_key(|(_, other)| (seconds.contains(other), *other));
            if let Some((place, first)) = first.filter(|(_, first)| *first != node) {
                self.images.add_second(node, (first, self.images.motion(place)));
            }
        }
        Ok(())
    }

    /// The motions that lay a side upon the images beside it.
    pub(super) fn steps(&self, on: &OnPlanes) -> Vec<Motion> {
        let mirrors = on.mirrors.iter().map(|mirror| mirror.motion);
        let of_sector = self.images.sector().map_or(Vec::new(), |sector| sector.steps());
        mirrors.chain(of_sector.as_flattened().iter().copied()).collect()
    }

    /// Tells that a motion lays a node, the second one, upon another one.
    fn lay(&mut self, node: usize, same: (Motion, usize)) {
        self.same.entry(node).or_default().push(same);
    }

    /// The nodes on boundaries.
    pub(super) fn on_boundaries(&self) -> impl Iterator<Item = usize> {
        self.same.keys().copied()
    }

    /// The place of a motion.
    ///
    /// # Errors
    /// There are too many of them.
    pub(super) fn place(&mut self, motion: &Motion) -> Result<usize, Error> {
        let is_same = |other: &Motion| motion.apart(other, self.around) <= self.near;
        if let Some(place) = self.images.motions().iter().position(is_same) {
            return Ok(place);
        }
        // Sectors of a third of a degree have no more; planes at an angle that is no part of a half turn have no end of them.
        let most = 4 * usize::from(u8::MAX);
        if self.images.motions().len() > most {
            let message = format!(
                "more than {most} images of the model meet: planes of symmetry meet at an angle of which half a turn is no \
                 multiple, so that no whole body has them, as happens if a direction has few digits, or there are too many \
                 sectors; give directions with all digits, leave out a plane, or give the number of sectors of the whole"
            );
            return Err(Error::invalid(Argument::Settings, message));
        }
        Ok(self.images.add_motion(*motion))
    }

    /// All images that are the same node of the whole body, this one first.
    ///
    /// # Errors
    /// As [`Self::place`].
    pub(super) fn same(&mut self, image: Image) -> Result<Vec<Image>, Error> {
        let mut found = vec![image];
        let mut next = 0;
        while let Some(&(place, node)) = found.get(next) {
            next += 1;
            for (motion, other) in self.same.get(&node).cloned().unwrap_or_default() {
                let moved = self.images.motion(place).after(&motion);
                let same = (self.place(&moved)?, other);
                if !found.contains(&same) {
                    found.push(same);
                }
            }
        }
        Ok(found)
    }

    /// The number of an image: that of the host's node if it is one.
    ///
    /// # Errors
    /// As [`Self::place`].
    pub(super) fn number(&mut self, image: Image) -> Result<usize, Error> {
        if let Some(&number) = self.numbers.get(&image) {
            return Ok(number);
        }
        let same = self.same(image)?;
        let own = same.iter().filter(|(place, _)| *place == 0).map(|(_, node)| *node).min();
        let number = own.unwrap_or_else(|| self.images.add(image));
        self.numbers.extend(same.into_iter().map(|image| (image, number)));
        Ok(number)
    }

    /// Takes of the row of a node that is its own image the part that belongs to the model. Its force has no part that the
    /// motions of these images change, and so all images of a node count in it as one.
    ///
    /// # Errors
    /// As [`Self::place`].
    pub(super) fn take_part(&mut self, pair: &mut SurfacePair) -> Result<(), Error> {
        let mut upon = self.same((0, pair.slave))?;
        upon.retain(|(_, node)| *node == pair.slave);
        if let [_] = upon[..] {
            return Ok(());
        }
        let mut entries = Vec::with_capacity(pair.nodes.len());
        for ((is_master, node), (weight, turn)) in pair.entries() {
            let (place, node) = self.images.at(node);
            let (mut first, mut back) = (usize::MAX, Matrix3::identity());
            for (by, _) in &upon {
                let by = self.images.motion(*by);
                let motion = by.after(&self.images.motion(place));
                let image = self.place(&motion)?;
                let image = self.number((image, node))?;
                if image < first {
                    (first, back) = (image, by.turn.transpose());
                }
            }
            entries.push(((is_master, first), (weight, turn * back)));
        }
        pair.set_entries(entries);
        pair.area /= upon.len() as f64;
        Ok(())
    }
}
