//! Two surfaces, or a surface and a rigid one, to pairs.

use super::candidates::{Candidates, SearchFaces};
use super::mesh::{Side, Surfaces};
use super::pairs::SurfacePairs;
use super::settings::{Pairing, SurfaceSettings, reach};
use super::symmetry::OnPlanes;
use super::{mortar, node_to_surface, self_overlap};
#[cfg(doc)]
use crate::error::Argument;
use crate::error::Error;

/// Pairs two surfaces. Surfaces that never meet give no pairs, which is no error.
///
/// # Errors
/// - [`Argument::Dimension`], [`Argument::Coordinates`]: a dimension other than 2 and 3, coordinates that are
///   not finite;
/// - [`Argument::SlaveFaces`], [`Argument::MasterFaces`]: what is wrong with which face: number of nodes,
///   repeated or missing nodes, no area, folded, turned over against its neighbour, nodes on both
///   sides, faces of one side that lie upon each other, master faces over each other (of masters with
///   [`Pairing::DualMortar`] alone: otherwise the nearest counts);
/// - [`Argument::Settings`]: a search distance that is not positive; a plane of symmetry across no axis of the space,
///   with slave nodes on both sides, or with slave faces in it; a choice for rims with
///   [`Pairing::NodeToSurface`].
pub fn pair_surfaces(
    surfaces: &Surfaces<'_>,
    settings: &SurfaceSettings,
) -> Result<SurfacePairs, Error> {
    let [slave, master] = surfaces.sides()?;
    pair_sides([&slave, &master], surfaces.dim, settings)
}

/// Pairs two sides that are checked.
pub(super) fn pair_sides(
    [slave, master]: [&Side<'_>; 2],
    dim: usize,
    settings: &SurfaceSettings,
) -> Result<SurfacePairs, Error> {
    settings.check()?;
    let largest = || (0..slave.count()).map(|face| slave.face(face).size()).fold(0.0, f64::max);
    let reach = reach(settings.search_distance, largest)?;
    let planes = OnPlanes::new(slave, dim, &settings.symmetry)?;
    self_overlap::check(slave, &SearchFaces::new(slave), dim, reach)?;
    let opposite = SearchFaces::new(master);
    if settings.pairing == Pairing::DualMortar {
        self_overlap::check(master, &opposite, dim, reach)?;
    }
    let candidates = Candidates::new(opposite, reach);
    let sides = [slave, master];
    match settings.pairing {
        Pairing::DualMortar => mortar::pairs(sides, dim, &planes, candidates, settings),
        Pairing::NodeToSurface => {
            node_to_surface::pairs(sides, dim, &planes, candidates, settings.normals)
        }
    }
}
