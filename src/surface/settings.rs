//! Settings of the pairing.

use super::symmetry::SymmetryPlane;
use crate::error::{Argument, Error};

/// How the rows are made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pairing {
    /// Dual mortar: a uniform pressure passes between any two flat meshes.
    #[default]
    DualMortar,
    /// Each slave node against the point of the master that it meets along its normal, with the
    /// master's shape functions as weights. Forces and moments balance; the pressure between meshes that
    /// do not match is wrong by some percent.
    NodeToSurface,
}

/// The normal of a pair.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Normals {
    /// The mean of the unit normals of all slave faces at the slave node: it varies smoothly over meshes of
    /// curved surfaces.
    #[default]
    Averaged,
    /// The normal of the faces in contact. By dual mortar the mean of the unit normals at the node of the slave faces that
    /// lie over the master, by the node's share of the area that does: faces around a sharp edge that face
    /// nothing do not turn it. Nodes against surfaces: opposite to the normal of the master face that the node stands
    /// nearest to, at the foot of the perpendicular; beyond an edge of the master, where there is no foot,
    /// that of the face which the averaged normal meets, where it meets it. Which nodes have pairs does not
    /// depend on it.
    Faces,
}

/// The treatment of slave nodes at rims: those that have less than a tenth of their area over the master, counted
/// on the faces of which any part lies over it. Of dual mortar; nodes against surfaces have no cover.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rims {
    /// Their rows are added to that of a neighbour: uniform pressure stays exact.
    #[default]
    Fold,
    /// They keep pairs of their own, with small areas. Uniform pressure stays exact, but under others the
    /// pressures of these nodes may be large, and their rows hold points in the air by masters beside them. With
    /// less than a millionth of cover, where a row would be rounding, they are folded all the same.
    Keep,
    /// They get no pair, and the area that they would carry is left out: uniform pressure is not exact
    /// around them.
    Drop,
}

/// Settings of the pairing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurfaceSettings {
    /// How the rows are made.
    pub pairing: Pairing,
    /// The largest distance along the normal at which surfaces are paired, open or overlapping; `None`:
    /// the size of the largest slave face.
    pub search_distance: Option<f64>,
    /// Planes of symmetry of half and quarter models. A pair whose slave node stands on one neither moves nor carries
    /// a force across it, as in the whole body, and its normal is in the plane.
    pub symmetry: Vec<SymmetryPlane>,
    /// Normals of the pairs.
    pub normals: Normals,
    /// The treatment of nodes with little cover.
    pub rims: Rims,
}

impl SurfaceSettings {
    /// # Errors
    /// A choice for rims where nodes have no cover.
    pub(super) fn check(&self) -> Result<(), Error> {
        if self.pairing == Pairing::NodeToSurface && self.rims != Rims::Fold {
            let message = "rims: nodes against surfaces have no cover that a rim could be told by: leave the \
                           default, or pair by dual mortar";
            return Err(Error::invalid(Argument::Settings, message));
        }
        Ok(())
    }
}

/// The search distance, if it is one, or another one if it is not given.
pub(super) fn reach(given: Option<f64>, otherwise: impl Fn() -> f64) -> Result<f64, Error> {
    match given {
        // Written so that NaN is refused.
        Some(distance) if !(distance > 0.0 && distance.is_finite()) => {
            let message = format!("search_distance is {distance}, it must be positive and finite");
            Err(Error::invalid(Argument::Settings, message))
        }
        Some(distance) => Ok(distance),
        None => Ok(otherwise()),
    }
}
