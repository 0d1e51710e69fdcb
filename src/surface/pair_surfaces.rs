//! Two surfaces, or a surface and a rigid one, to pairs.

use super::candidates::{Candidates, Reach, SearchFaces};
use super::mesh::{Side, Surfaces};
use super::pairs::SurfacePairs;
use super::settings::{Pairing, SurfaceSettings};
use super::sweep::Bounds;
use super::symmetry::OnPlanes;
use super::unit::Unit;
use super::watch::Watch;
use super::{facets, mortar, node_to_surface, self_overlap};
#[cfg(doc)]
use crate::error::Argument;
use crate::error::Error;
use crate::monitor::Monitor;

/// The default search distance beside the diagonal of the smaller of the two sides' boxes: displacements that are small
/// beside the bodies do not reach further.
const OF_BOX: f64 = 0.5;

/// Pairs two surfaces. Surfaces that never meet give no pairs, which is no error. `monitor` has the time limit and
/// the callback.
///
/// # Errors
/// - [`Argument::Dimension`], [`Argument::Coordinates`]: a dimension other than 2 and 3, coordinates that are
///   not finite, or so large or small that areas are no numbers;
/// - [`Argument::SlaveFaces`], [`Argument::MasterFaces`]: what is wrong with which face: number of nodes,
///   repeated or missing nodes, no area, folded, turned over against its neighbour, nodes on both
///   sides, faces of one side that lie upon each other, master faces over each other (of masters with
///   [`Pairing::DualMortar`] alone: otherwise the nearest counts), a negative radius of a body of revolution;
/// - [`Argument::Settings`]: a search distance that is not positive; a plane of symmetry across no axis of the space,
///   with slave nodes on both sides, or with slave faces in it; a choice for rims with
///   [`Pairing::NodeToSurface`]; bodies of revolution in space;
/// - [`Error::Stopped`]: the time limit is used up, or the callback cancels.
pub fn pair_surfaces(
    surfaces: &Surfaces<'_>,
    settings: &SurfaceSettings,
    monitor: &mut Monitor<'_>,
) -> Result<SurfacePairs, Error> {
    pair_sides(surfaces.sides()?, surfaces.dim, settings, monitor)
}

/// Pairs two sides whose lists are in order.
pub(super) fn pair_sides(
    [slave, master]: [Side<'_>; 2],
    dim: usize,
    settings: &SurfaceSettings,
    monitor: &mut Monitor<'_>,
) -> Result<SurfacePairs, Error> {
    settings.check(dim)?;
    let watch = &mut Watch::new(monitor);
    let unit = Unit::of(slave.lengths().chain(master.lengths()));
    let slave = slave.checked((unit.inside, settings.axisymmetric), watch)?;
    let master = master.checked((unit.inside, settings.axisymmetric), watch)?;
    let planes = OnPlanes::new(&slave, dim, (&settings.symmetry, settings.axisymmetric))?;
    watch.goes_on()?;
    let mut own = SearchFaces::new(&slave, watch)?;
    let mut opposite = SearchFaces::new(&master, watch)?;
    let (reach, span) = reach(&slave, [own.tree.bounds(), opposite.tree.bounds()], settings);
    watch.expects(2 * slave.count() + master.count());
    self_overlap::check(&slave, &mut own, (dim, reach.overlap), watch)?;
    if settings.pairing == Pairing::DualMortar {
        self_overlap::check(&master, &mut opposite, (dim, reach.overlap), watch)?;
    }
    let candidates = Candidates::new(opposite, reach, span);
    let sides = [&slave, &master];
    let found = match settings.pairing {
        Pairing::DualMortar => mortar::pairs(sides, dim, &planes, candidates, settings, watch),
        Pairing::NodeToSurface => {
            node_to_surface::pairs(sides, dim, &planes, candidates, settings.normals, watch)
        }
    };
    let found = found?;
    watch.goes_on()?;
    let mut found = unit.of_host(found, settings)?;
    watch.goes_on()?;
    found.report.overlapping_and_rough = facets::overlapping_and_rough(&slave, &found, watch)?;
    Ok(found)
}

/// How far masters are looked for, and how far away any face may be.
fn reach(slave: &Side<'_>, boxes: [Option<Bounds>; 2], settings: &SurfaceSettings) -> (Reach, f64) {
    let largest = (0..slave.count()).map(|face| slave.face(face).size()).fold(0.0, f64::max);
    let all = boxes.into_iter().flatten().reduce(|a, b| a.with(&b));
    let span = all.map_or(0.0, |all| all.diagonal());
    let smaller = boxes.map(|of_side| of_side.map_or(0.0, |of_side| of_side.diagonal()));
    let open = largest.max(OF_BOX * smaller[0].min(smaller[1]));
    let reach = match settings.search_distance.map(|distance| slave.inside(distance)) {
        Some(given) => Reach { overlap: given, open: given, layer: f64::INFINITY },
        None => Reach { overlap: largest, open, layer: largest },
    };
    (reach, span)
}
