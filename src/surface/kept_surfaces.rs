//! Copies of surfaces that have been paired, for the check after a solution.

use super::exact_shape::Obstacle;
use super::mesh::Side;
use super::pairing_progress::PairingProgress;
use super::surfaces::{Faces, Master, Surfaces};
use crate::error::Argument;

/// Copies of both sides before the motion, for the check after a solution.
#[derive(Clone, Debug)]
pub struct KeptSurfaces {
    pub(super) dim: usize,
    /// Nodes of the host that stand on a side, ascending.
    pub(super) nodes: Vec<usize>,
    /// Those of these nodes, then those of a rigid mesh; lists of faces count nodes by their places here.
    pub(super) coordinates: Vec<f64>,
    pub(super) slave: [Vec<usize>; 2],
    pub(super) master: KeptMaster,
    pub(super) clearance: f64,
}

#[derive(Clone, Debug)]
pub(super) enum KeptMaster {
    Faces([Vec<usize>; 2]),
    Shape(Obstacle),
}

impl KeptSurfaces {
    /// Keeps surfaces that have been paired with a clearance, which stands between them, as half the thicknesses of shells do if
    /// it is negative.
    pub fn new(
        &Surfaces { dim, coordinates, slave, master }: &Surfaces<'_>,
        clearance: f64,
    ) -> KeptSurfaces {
        let of_mesh = if let Master::Faces(faces) = master { faces.nodes } else { &[] };
        let mut nodes = [slave.nodes, of_mesh].concat();
        nodes.sort_unstable();
        nodes.dedup();
        let mut places = vec![0; nodes.last().map_or(0, |last| last + 1)];
        nodes.iter().enumerate().for_each(|(place, &node)| places[node] = place);
        let lists = |faces: Faces<'_>| {
            [faces.start.to_vec(), faces.nodes.iter().map(|&node| places[node]).collect()]
        };
        let kept = |node: &usize| coordinates[dim * node..dim * (node + 1)].to_vec();
        let mut kept: Vec<f64> = nodes.iter().flat_map(kept).collect();
        let master = match master {
            Master::Faces(faces) => KeptMaster::Faces(lists(faces)),
            Master::RigidFaces { coordinates, faces } => {
                kept.extend(coordinates);
                let places = faces.nodes.iter().map(|node| nodes.len() + node);
                KeptMaster::Faces([faces.start.to_vec(), places.collect()])
            }
            Master::RigidShape(shape) => KeptMaster::Shape(shape),
        };
        KeptSurfaces { dim, slave: lists(slave), coordinates: kept, nodes, master, clearance }
    }

    /// The nodes of the host that stand on a side, ascending: those whose displacements are asked.
    pub fn nodes(&self) -> &[usize] {
        &self.nodes
    }

    /// Sides of these faces, before the motion and `moved`.
    pub(super) fn before_and_after<'s>(
        &'s self,
        (name, progress): (&'static str, &'s PairingProgress<'s>),
        moved: &'s [f64],
        [start, nodes]: &'s [Vec<usize>; 2],
    ) -> [Side<'s>; 2] {
        let (faces, x) = (Faces { start, nodes }, (self.dim, &self.coordinates[..]));
        let before = Side::new(name, Argument::Coordinates, x, faces, progress);
        [before, before.moved(moved)]
    }
}
