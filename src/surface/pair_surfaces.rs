//! Two surfaces, or a surface and a rigid one, to pairs. A rigid surface is a mesh of its own: it is paired as a master is,
//! and then left out of the rows, as it does not move.

use super::candidates::{Candidates, Reach, SearchFaces};
use super::mesh::{Faces, Side, Surfaces};
use super::pairs::{SurfacePair, SurfacePairs};
use super::settings::{Pairing, SurfaceSettings};
use super::sweep::Bounds;
use super::symmetry::OnPlanes;
use super::unit::Unit;
use super::watch::Watch;
use super::{mortar, node_to_surface, self_overlap};
use crate::error::{Argument, Error};
use crate::monitor::Monitor;

/// The default search distance beside the diagonal of the smaller of the two sides' boxes: displacements that are small
/// beside the bodies do not reach further.
const OF_BOX: f64 = 0.5;

/// A surface that does not deform, with coordinates of its own: triangles of a scan or of a drawing, or any
/// other faces.
#[derive(Clone, Copy, Debug)]
pub struct RigidSurface<'a> {
    /// Coordinates of its nodes, `dim` for each node.
    pub coordinates: &'a [f64],
    /// Its faces, in nodes of its own counted from 0; seen from the body that may touch them the corners
    /// run counterclockwise, in the plane the obstacle lies to the left of a line.
    pub faces: Faces<'a>,
}

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
    pair_sides(surfaces.sides()?, settings, monitor)
}

/// Pairs a surface with a rigid one. Rows have slaves alone; gaps are those that two deformable surfaces of
/// the same places have.
///
/// # Errors
/// As [`pair_surfaces`]; what is wrong with the rigid surface has [`Argument::Obstacle`].
pub fn pair_with_rigid_surface(
    dim: usize,
    coordinates: &[f64],
    slave: Faces<'_>,
    rigid: &RigidSurface<'_>,
    settings: &SurfaceSettings,
    monitor: &mut Monitor<'_>,
) -> Result<SurfacePairs, Error> {
    let slave = Side::slave(dim, coordinates, slave)?;
    let RigidSurface { coordinates, faces } = *rigid;
    let obstacle = Side::new("obstacle", Argument::Obstacle, (dim, coordinates), faces)?;
    let found = pair_sides([slave, obstacle], settings, monitor)?;
    let pairs = found.pairs.into_iter().map(SurfacePair::without_masters).collect();
    Ok(SurfacePairs { pairs, ..found })
}

/// Pairs two sides whose lists are in order.
fn pair_sides(
    [slave, master]: [Side<'_>; 2],
    settings: &SurfaceSettings,
    monitor: &mut Monitor<'_>,
) -> Result<SurfacePairs, Error> {
    settings.check(slave.dim)?;
    let watch = &mut Watch::new(monitor);
    let unit = Unit::of(slave.lengths().chain(master.lengths()));
    let slave = slave.checked((unit.inside, settings.axisymmetric), watch)?;
    let master = master.checked((unit.inside, settings.axisymmetric), watch)?;
    let planes = OnPlanes::new(&slave, (&settings.symmetry, settings.axisymmetric))?;
    watch.goes_on()?;
    let mut own = SearchFaces::new(&slave, watch)?;
    let mut opposite = SearchFaces::new(&master, watch)?;
    let (reach, span) = reach(&slave, [own.tree.bounds(), opposite.tree.bounds()], settings);
    watch.expects(2 * slave.count() + master.count());
    self_overlap::check(&slave, &mut own, reach.overlap, watch)?;
    if settings.pairing == Pairing::DualMortar {
        self_overlap::check(&master, &mut opposite, reach.overlap, watch)?;
    }
    let candidates = Candidates::new(opposite, reach, span);
    let sides = [&slave, &master];
    let found = match settings.pairing {
        Pairing::DualMortar => mortar::pairs(sides, &planes, candidates, settings, watch),
        Pairing::NodeToSurface => {
            node_to_surface::pairs(sides, &planes, candidates, settings.normals, watch)
        }
    };
    let found = found?;
    watch.goes_on()?;
    let mut found = unit.of_host(found, settings)?;
    watch.goes_on()?;
    found.report.overlapping_and_rough = overlapping_and_rough(&slave, &found, watch)?;
    Ok(found)
}

/// How far masters are looked for, and how far away any face may be.
fn reach(slave: &Side<'_>, boxes: [Option<Bounds>; 2], settings: &SurfaceSettings) -> (Reach, f64) {
    let largest = (0..slave.count()).map(|face| slave.face(face).size()).fold(0.0, f64::max);
    let all = boxes.into_iter().flatten().reduce(|a, b| a.with(&b));
    let span = all.map_or(0.0, |all| all.diagonal());
    let smaller = boxes.map(|of_side| of_side.map_or(0.0, |of_side| of_side.diagonal()));
    let open = largest.max(OF_BOX * smaller[0].min(smaller[1]));
    let reach = match settings.search_distance.map(|distance| slave.scale * distance) {
        Some(given) => Reach { overlap: given, open: given, layer: f64::INFINITY },
        None => Reach { overlap: largest, open, layer: largest },
    };
    (reach, span)
}

/// The slave faces whose pairs overlap the other side in the mean, and those of them on which gaps differ by more than that.
///
/// # Errors
/// What ends the watch.
fn overlapping_and_rough(
    slave: &Side<'_>,
    found: &SurfacePairs,
    watch: &mut Watch<'_, '_>,
) -> Result<[usize; 2], Error> {
    let mut gap_at = vec![None; found.pairs.last().map_or(0, |pair| pair.slave + 1)];
    found.pairs.iter().for_each(|pair| gap_at[pair.slave] = Some(pair.gap));
    let [mut overlapping, mut rough] = [0, 0];
    for at in 0..slave.count() {
        watch.goes_on()?;
        let of_nodes = slave.face(at).nodes.iter().map(|&node| *gap_at.get(node)?);
        let gaps: Vec<f64> = of_nodes.flatten().collect();
        let [least, most] = [f64::min, f64::max].map(|of| gaps.iter().copied().reduce(of));
        let (Some(least), Some(most)) = (least, most) else { continue };
        let overlap = -gaps.iter().sum::<f64>() / gaps.len() as f64;
        overlapping += usize::from(overlap > 0.0);
        rough += usize::from(overlap > 0.0 && most - least > overlap);
    }
    Ok([overlapping, rough])
}
