//! The images of nodes in the neighbours of a sector. An image is a node of the sector, turned: `u = Q u'`.

use std::collections::{BTreeMap, BTreeSet};

use super::sector::Sector;
use crate::linalg::vector3::{Matrix3, Vector3};

/// The images of a host's nodes in the neighbours of a sector. Of `n` nodes, the image of node `i` in the neighbour beyond the
/// second boundary is counted as `n + i`, that before the first one as `2 n + i`, those in the next but one as `3 n + i` and
/// `4 n + i`, and so on.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Images {
    /// Of no sectors: there are no images.
    sector: Sector,
    /// Number of nodes of the host.
    nodes: usize,
    /// Nodes on the second boundary, ascending, with those on the first whose images they are.
    second: Vec<(usize, usize)>,
}

/// The neighbours by whose places images are counted, in sectors.
const PLACES: [i32; 9] = [0, 1, -1, 2, -2, 3, -3, 4, -4];

impl Images {
    /// The number of the image of a node, of so many, in a neighbour.
    pub(super) fn number(node: usize, nodes: usize, by: i32) -> usize {
        let place = PLACES.iter().position(|place| *place == by).unwrap_or_default();
        node + place * nodes
    }

    /// Those of a sector, of so many nodes of the host, of which some are on the `second` boundary with those on the first
    /// whose images they are.
    pub(super) fn new(sector: Sector, nodes: usize, second: BTreeMap<usize, usize>) -> Images {
        Images { sector, nodes, second: second.into_iter().collect() }
    }

    /// `true` if there is no sector.
    pub fn are_none(&self) -> bool {
        self.sector.count == 0
    }

    /// The host's node that a node is or is an image of, and the turn of its displacement.
    pub fn of(&self, node: usize) -> (usize, Matrix3) {
        let (node, by) = self.counted(node);
        (node, self.turn(by))
    }

    /// The same for a node on the second boundary too, which is an image of one on the first; and by how many sectors it is
    /// turned.
    pub(super) fn home(&self, node: usize) -> (usize, i32) {
        let (node, by) = self.counted(node);
        self.first_of(node).map_or((node, by), |first| (first, by + 1))
    }

    fn counted(&self, node: usize) -> (usize, i32) {
        if self.are_none() || node < self.nodes {
            return (node, 0);
        }
        (node % self.nodes, PLACES[node / self.nodes])
    }

    /// The turn by some sectors.
    pub(super) fn turn(&self, by: i32) -> Matrix3 {
        if by == 0 { Matrix3::identity() } else { self.sector.turn(by) }
    }

    /// The place of the image of a point.
    pub(super) fn image(&self, x: Vector3, by: i32) -> Vector3 {
        if by == 0 { x } else { self.sector.image(by)(x) }
    }

    /// `true` of a node that the sector has, and not its neighbour on the second boundary.
    pub(super) fn is_own(&self, node: usize) -> bool {
        node < self.nodes && self.first_of(node).is_none()
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

    /// Takes in the images of another zone.
    ///
    /// # Errors
    /// They are those of another sector.
    pub(super) fn join(&mut self, other: &Images) -> Result<(), ()> {
        if self.are_none() {
            *self = other.clone();
        } else if !other.are_none() {
            if (self.sector, self.nodes) != (other.sector, other.nodes) {
                return Err(());
            }
            self.second.extend(&other.second);
            self.second.sort_unstable();
            self.second.dedup();
        }
        Ok(())
    }
}
