//! The images of nodes in the parts of the body beyond the model: in the neighbours of a sector, and beyond planes of
//! symmetry. An image is a node of the model, moved: `u = Q u'`.

use std::collections::{BTreeSet, HashMap};
use std::ops::Range;

use super::motion::Motion;
use super::sector::Sector;
use crate::linalg::vector3::{Matrix3, Vector3};

/// The images of a host's nodes, counted behind them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Images {
    /// None if its count is 0.
    sector: Sector,
    /// Number of nodes of the host.
    nodes: usize,
    /// The motions of images; the first is none.
    places: Vec<Motion>,
    /// Each image: the place of its motion, and its node.
    list: Vec<(usize, usize)>,
    /// Nodes on the second boundary, ascending, with those on the first whose images they are.
    second: Vec<(usize, usize)>,
}

impl Images {
    /// Those of so many nodes of the host, none so far.
    pub(super) fn new(sector: Option<Sector>, nodes: usize) -> Images {
        let (sector, places) = (sector.unwrap_or_default(), vec![Motion::none()]);
        Images { sector, nodes, places, ..Images::default() }
    }

    /// The sector, if there is one.
    pub(super) fn sector(&self) -> Option<Sector> {
        self.are_of_sector().then_some(self.sector)
    }

    /// Adds a node on the second boundary, with that on the first whose image it is.
    pub(super) fn add_second(&mut self, second: usize, first: usize) {
        let place = self.second.partition_point(|(other, _)| *other < second);
        self.second.insert(place, (second, first));
    }

    /// `true` in a sector.
    pub(super) fn are_of_sector(&self) -> bool {
        self.sector.count > 0
    }

    /// `true` of an image: the host has no such node.
    pub fn has(&self, node: usize) -> bool {
        !self.list.is_empty() && node >= self.nodes
    }

    /// The host's node that a node is or is an image of, and the turn or mirror of its displacement.
    pub fn of(&self, node: usize) -> (usize, Matrix3) {
        let (place, node) = self.at(node);
        (node, self.motion(place).turn)
    }

    /// The same for a node on the second boundary too, which is an image of one on the first; and its motion.
    pub(super) fn home(&self, node: usize) -> (usize, Motion) {
        let (place, node) = self.at(node);
        let motion = self.motion(place);
        let of_first = |first| (first, motion.after(&self.sector.motion(1)));
        self.first_of(node).map_or((node, motion), of_first)
    }

    /// The place of the motion and the node of an image; of other nodes themselves.
    pub(super) fn at(&self, node: usize) -> (usize, usize) {
        if self.has(node) { self.list[node - self.nodes] } else { (0, node) }
    }

    /// The motion at a place.
    pub(super) fn motion(&self, place: usize) -> Motion {
        self.places.get(place).copied().unwrap_or_else(Motion::none)
    }

    /// The boundaries of the sector alone, where no row has an image.
    pub(super) fn without_images(self) -> Images {
        Images { sector: self.sector, second: self.second, ..Images::default() }
    }

    /// The numbers of all images.
    pub(super) fn numbers(&self) -> Range<usize> {
        self.nodes..self.nodes + self.list.len()
    }

    /// The motions, by place.
    pub(super) fn motions(&self) -> &[Motion] {
        &self.places
    }

    /// Adds a motion, and returns its place.
    pub(super) fn add_motion(&mut self, motion: Motion) -> usize {
        self.places.push(motion);
        self.places.len() - 1
    }

    /// Adds the image of a node by the motion at a place, and returns its number.
    pub(super) fn add(&mut self, image: (usize, usize)) -> usize {
        self.list.push(image);
        self.nodes + self.list.len() - 1
    }

    /// The places of all images by the host's coordinates, as vectors.
    pub(super) fn positions<'a>(
        &'a self,
        of_host: impl Fn(usize) -> Vector3 + 'a,
    ) -> impl Iterator<Item = Vector3> + 'a {
        self.list.iter().map(move |(place, node)| self.places[*place].of(of_host(*node)))
    }

    /// From the first boundary to the second.
    pub(super) fn to_second(&self) -> Motion {
        self.sector.motion(1)
    }

    /// `true` of a node that the model has, and not its neighbour on the second boundary.
    pub(super) fn is_own(&self, node: usize) -> bool {
        !self.has(node) && self.first_of(node).is_none()
    }

    /// The node on the first boundary whose image one on the second is.
    fn first_of(&self, node: usize) -> Option<usize> {
        let place = self.second.binary_search_by_key(&node, |(second, _)| *second);
        place.ok().map(|place| self.second[place].1)
    }

    /// The nodes on the first boundary.
    pub(super) fn on_first(&self) -> BTreeSet<usize> {
        self.second.iter().map(|(_, first)| *first).collect()
    }

    /// The nodes on the second boundary, each with that on the first whose image it is.
    pub(super) fn on_second(&self) -> impl Iterator<Item = (usize, usize)> {
        self.second.iter().copied()
    }

    /// Takes in the images of another zone of the same host, within so much of the origin, and returns the numbers that they
    /// have here, in their order.
    ///
    /// # Errors
    /// They are those of another sector, or of a host with another number of nodes.
    pub(super) fn join(&mut self, other: &Images, size: f64) -> Result<Vec<usize>, ()> {
        let is_other_sector = self.are_of_sector()
            && other.are_of_sector()
            && !self.to_second().is(&other.to_second(), size);
        let is_other_host =
            !self.list.is_empty() && !other.list.is_empty() && self.nodes != other.nodes;
        if is_other_sector || is_other_host {
            return Err(());
        }
        if other.are_of_sector() {
            self.sector = other.sector;
        }
        if self.list.is_empty() {
            // A zone without images has not counted the nodes.
            (self.nodes, self.places) = (other.nodes, other.places.clone());
        }
        self.second.extend(&other.second);
        self.second.sort_unstable();
        self.second.dedup();
        let mut known: HashMap<_, _> = (self.list.iter().copied()).zip(self.nodes..).collect();
        let numbers = other.list.iter().map(|&(place, node)| {
            let motion = other.places[place];
            let same = self.places.iter().position(|known| known.is(&motion, size));
            let image = (same.unwrap_or_else(|| self.add_motion(motion)), node);
            *known.entry(image).or_insert_with(|| self.add(image))
        });
        Ok(numbers.collect())
    }
}
