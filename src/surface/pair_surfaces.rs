//! A surface and what it may touch to pairs. A rigid mesh is paired as a master is, and then left out of the rows, as it does
//! not move.

use super::candidates::{Candidates, Reach, SearchFaces};
use super::mesh::Side;
use super::pairs::{SurfacePair, SurfacePairs};
use super::settings::{Pairing, SurfaceSettings};
use super::surfaces::{Master, Surfaces};
use super::sweep::Bounds;
use super::symmetry::OnPlanes;
use super::unit::Unit;
use super::watch::Watch;
use super::with_images::{own_pairs, with_images};
use super::{mortar, node_to_surface, obstacle, self_overlap};
use crate::error::{Argument, Error};
use crate::linalg::tolerances::ROUNDING_OF_SUM;
use crate::monitor::Monitor;
use crate::problem::checked_dim;

/// Pairs a surface with what it may touch. Surfaces that never meet give no pairs, which is no error. `monitor` has the
/// time limit and the callback.
///
/// With a shape `search_distance`, `axisymmetric`, `close_within` and `clearance` are read of the settings. A mid node of a
/// quadratic face has its corners beside it in its row then, and the gap is that of the row.
///
/// # Errors
/// - [`Argument::Dimension`], [`Argument::Coordinates`]: a dimension other than 2 and 3, coordinates that are
///   not finite, or so large or small that areas are no numbers;
/// - [`Argument::SlaveFaces`], [`Argument::MasterFaces`], [`Argument::Obstacle`] of rigid ones: what is wrong with which face:
///   number of nodes, repeated or missing nodes, no area, folded, turned over against its neighbour, nodes on both
///   sides, faces of one side that lie upon each other, master faces over each other (of masters with
///   [`Pairing::DualMortar`] alone: otherwise the nearest counts), a negative radius of a body of revolution;
/// - [`Argument::Obstacle`] of a shape: a direction that is zero, a radius that is not positive, a node on the axis or in the
///   centre;
/// - [`Argument::Settings`]: a search distance that is not positive; a plane of symmetry whose normal is no direction of the
///   space, with slave nodes on both sides, or with slave faces in it; a sector that is none, or whose slave faces do not
///   match on its boundaries; a choice for rims with [`Pairing::NodeToSurface`]; bodies of revolution in space;
/// - [`Error::Stopped`]: the time limit is used up, or the callback cancels.
pub fn pair_surfaces(
    &Surfaces { dim, coordinates, slave, master }: &Surfaces<'_>,
    settings: &SurfaceSettings,
    monitor: &mut Monitor<'_>,
) -> Result<SurfacePairs, Error> {
    let watch = &mut Watch::new(monitor);
    checked_dim(dim)?;
    let slave = Side::new("slave", Argument::SlaveFaces, (dim, coordinates), slave)?;
    match master {
        Master::Faces(faces) => {
            let master = slave.opposite(faces)?;
            pair_sides([slave, master], settings, watch)
        }
        Master::RigidFaces { coordinates, faces } => {
            let rigid = Side::new("obstacle", Argument::Obstacle, (dim, coordinates), faces)?;
            let found = pair_sides([slave, rigid], settings, watch)?;
            let pairs = found.pairs.into_iter().map(SurfacePair::without_masters).collect();
            Ok(SurfacePairs { pairs, ..found })
        }
        Master::RigidShape(shape) => obstacle::pairs(slave, &shape, settings, watch),
    }
}

/// Pairs two sides whose lists are in order.
fn pair_sides(
    [slave, master]: [Side<'_>; 2],
    settings: &SurfaceSettings,
    watch: &mut Watch<'_, '_>,
) -> Result<SurfacePairs, Error> {
    settings.check(slave.dim)?;
    let unit = Unit::of(slave.lengths().chain(master.lengths()));
    let slave = slave.checked((unit.inside, settings.axisymmetric), watch)?;
    let master = master.checked((unit.inside, settings.axisymmetric), watch)?;
    let found = match settings.sector {
        None => search([&slave, &master], settings, watch)?,
        Some(sector) => {
            let (images, sides) =
                with_images((sector, &settings.shapes), [&slave, &master], watch)?;
            let sides = [sides[0].on(&slave), sides[1].on(&master)];
            own_pairs(search(sides.each_ref(), settings, watch)?, images, slave.count())
        }
    };
    watch.goes_on()?;
    let mut found = unit.of_host(found, settings)?;
    watch.goes_on()?;
    found.report.overlapping_and_rough = overlapping_and_rough(&slave, &found, watch)?;
    Ok(found)
}

/// The pairs of two sides that are checked.
fn search(
    sides: [&Side<'_>; 2],
    settings: &SurfaceSettings,
    watch: &mut Watch<'_, '_>,
) -> Result<SurfacePairs, Error> {
    let [slave, master] = sides;
    let planes = OnPlanes::new(slave, settings)?;
    watch.goes_on()?;
    let mut own = SearchFaces::new(slave, watch)?;
    let mut opposite = SearchFaces::new(master, watch)?;
    let (reach, span) = reach(sides, [own.tree.bounds(), opposite.tree.bounds()], settings);
    watch.expects(2 * slave.count() + master.count());
    self_overlap::check(slave, &mut own, reach.overlap, watch)?;
    if settings.pairing == Pairing::DualMortar {
        self_overlap::check(master, &mut opposite, reach.overlap, watch)?;
    }
    let candidates = Candidates::new(opposite, reach, span);
    let found = match settings.pairing {
        Pairing::DualMortar => mortar::pairs(sides, &planes, (own, candidates), settings, watch),
        Pairing::NodeToSurface => {
            node_to_surface::pairs(sides, &planes, (own, candidates), settings.normals, watch)
        }
    };
    let mut found = found?;
    planes.tell(&mut found.held);
    found.report.idle_planes = planes.idle;
    if !master.is_rigid() {
        OnPlanes::new(master, settings)?.tell(&mut found.held);
    }
    Ok(found)
}

/// How far masters are looked for, and how far away any face may be. Displacements that are small beside the bodies do not
/// reach further than the smaller of the two sides.
fn reach(
    sides: [&Side<'_>; 2],
    boxes: [Option<Bounds>; 2],
    settings: &SurfaceSettings,
) -> (Reach, f64) {
    let [slave, _] = sides;
    let largest = (0..slave.count()).map(|face| slave.face(face).size()).fold(0.0, f64::max);
    let all = boxes.into_iter().flatten().reduce(|a, b| a.with(&b));
    let span = all.map_or(0.0, |all| all.diagonal());
    let open = || {
        let [own, opposite] = sides.map(Side::radius);
        largest.max(own.min(opposite))
    };
    let reach = match settings.search_distance.map(|distance| slave.scale * distance) {
        Some(given) => Reach { overlap: given, open: given, layer: f64::INFINITY },
        None => Reach { overlap: largest, open: open(), layer: largest },
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
        let face = slave.face(at);
        let of_nodes = face.nodes.iter().map(|&node| *gap_at.get(node)?);
        let gaps: Vec<f64> = of_nodes.flatten().collect();
        let [least, most] = [f64::min, f64::max].map(|of| gaps.iter().copied().reduce(of));
        let (Some(least), Some(most)) = (least, most) else { continue };
        let overlap = -gaps.iter().sum::<f64>() / gaps.len() as f64;
        // Sides that touch have gaps of rounding, of either sign.
        let overlaps = overlap > ROUNDING_OF_SUM * face.size();
        overlapping += usize::from(overlaps);
        rough += usize::from(overlaps && most - least > overlap);
    }
    Ok([overlapping, rough])
}
