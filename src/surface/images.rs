//! The images of nodes in the parts of the body beyond the model: in the neighbours of a sector, and beyond planes of
//! symmetry. An image is a node of the model, moved: `u = Q u'`.

use std::collections::{BTreeMap, HashMap};
use std::ops::Range;

use super::motion::Motion;
use super::sector::Sector;
use crate::linalg::vector3::{Matrix3, Vector3};

/// Nodes on second boundaries, each with that on the first whose image it is, and the motion from there.
type OnSecond = BTreeMap<usize, (usize, Motion)>;

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
    second: OnSecond,
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

    /// Adds a node on a second boundary by that on the first, unless it is known.
    pub(super) fn add_second(&mut self, second: usize, first: (usize, Motion)) {
        self.second.entry(second).or_insert(first);
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

    /// As [`Self::of`], for a node on the second boundary too, which is an image of one on the first; and its motion.
    pub(super) fn home(&self, node: usize) -> (usize, Motion) {
        let (place, node) = self.at(node);
        let motion = self.motion(place);
        match self.second.get(&node) {
            None => (node, motion),
            Some((first, from_first)) => (*first, motion.after(from_first)),
        }
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

    /// `true` of a node that the model has, and not its neighbour on the second boundary.
    pub(super) fn is_own(&self, node: usize) -> bool {
        !self.has(node) && !self.second.contains_key(&node)
    }

    /// The nodes on second boundaries.
    pub(super) fn on_second(&self) -> &OnSecond {
        &self.second
    }

    /// Takes in the images of another zone of the same host, within so much of the origin, and returns the numbers that they
    /// have here, in their order. `None`: they are those of another sector, or of a host with another number of nodes.
    pub(super) fn join(&mut self, other: &Images, size: f64) -> Option<Vec<usize>> {
        let sectors = self.sector().zip(other.sector());
        let is_other_sector = sectors.is_some_and(|(own, other)| !own.is(&other, size));
        let is_other_host =
            !self.list.is_empty() && !other.list.is_empty() && self.nodes != other.nodes;
        if is_other_sector || is_other_host {
            return None;
        }
        if other.are_of_sector() {
            self.sector = other.sector;
        }
        if self.list.is_empty() {
            // A zone without images has not counted the nodes.
            (self.nodes, self.places) = (other.nodes, other.places.clone());
        }
        other.second.iter().for_each(|(second, first)| self.add_second(*second, *first));
        let mut known: HashMap<_, _> = (self.list.iter().copied()).zip(self.nodes..).collect();
        let numbers = other.list.iter().map(|&(place, node)| {
            let motion = other.places[place];
            let same = self.places.iter().position(|known| known.is(&motion, size));
            let image = (same.unwrap_or_else(|| self.add_motion(motion)), node);
            *known.entry(image).or_insert_with(|| self.add(image))
        });
        Some(numbers.collect())
    }
}
