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
