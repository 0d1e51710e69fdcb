//! A surface and what it may touch to pairs. A rigid mesh is paired as a master is, and then left out of the rows, as it does
//! not move.

use super::candidates::{Candidates, Reach};
use super::exact_shape::Obstacle;
use super::mesh::Side;
use super::pairing_progress::PairingProgress;
use super::pairs::{SurfacePair, SurfacePairs};
use super::settings::{Pairing, SurfaceSettings, TrueShape};
use super::surfaces::{Faces, Master, Surfaces};
use super::symmetry::OnPlanes;
use super::tree::Tree;
use super::turns::keep_turns;
use super::unit::Unit;
use super::with_images::WithImages;
use super::{facets, mortar, node_to_surface, obstacle, scatter, self_overlap};
use crate::error::{Argument, Error};
use crate::monitor::Monitor;
use crate::problem::checked_dim;

/// Pairs a surface with what it may touch. Surfaces that never meet give no pairs, which is no error. `monitor` has the
/// time limit and the callback.
///
/// With a shape `search_distance`, `axisymmetric`, `close_within`, `clearance`, `tangent`, the sector and the slave's true shape are read of
/// the settings. A mid node of a quadratic face has its corners beside it in its row then, and the gap is that of the row.
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
    let progress = &PairingProgress::new(monitor);
    checked_dim(dim)?;
    let slave = Side::new("slave", Argument::SlaveFaces, (dim, coordinates), slave, progress);
    slave.check_lists()?;
    let mut found = match master {
        Master::Faces(faces) => {
            let master = slave.opposite(faces)?;
            pair_sides([slave, master], None, settings)?
        }
        Master::RigidFaces { coordinates, faces } => {
            let rigid =
                Side::new("obstacle", Argument::Obstacle, (dim, coordinates), faces, progress);
            rigid.check_lists()?;
            pair_sides([slave, rigid], None, settings)?
        }
        Master::RigidShape(shape) => {
            let none = Faces { start: &[0], nodes: &[] };
            let rigid = Side::new("obstacle", Argument::Obstacle, (dim, &[]), none, progress);
            pair_sides([slave, rigid], Some(&shape), &obstacle::settings_of_shape(settings))?
        }
    };
    found.set_tangents(settings.tangent);
    Ok(found)
}

/// Pairs two sides whose lists are in order, or a side with a shape in place of faces of the other one.
fn pair_sides(
    [slave, master]: [Side<'_>; 2],
    shape: Option<&Obstacle>,
    settings: &SurfaceSettings,
) -> Result<SurfacePairs, Error> {
    let mut settings = settings.checked(slave.dim)?;
    if master.is_rigid() {
        // Its nodes have numbers of their own.
        settings.supports.clear();
    }
    let settings = &settings;
    let of_shape = shape.map_or(Vec::new(), Obstacle::lengths);
    let unit = Unit::of(slave.lengths().chain(master.lengths()).chain(of_shape));
    let shape = shape.map(|shape| obstacle::checked(shape, slave.dim, &unit)).transpose()?;
    let slave = slave.checked(unit.inside, settings)?;
    let master = master.checked(unit.inside, settings)?;
    let [mut on, on_master] = [OnPlanes::new(&slave, settings)?, OnPlanes::new(&master, settings)?];
    let reach = reach([(&slave, &on), (&master, &on_master)], settings);
    let within = f64::max(reach.overlap, reach.open).min(span([&slave, &master]));
    // Normals are fitted to three faces around.
    let is_fitted = settings.shapes.contains(&TrueShape::Fitted);
    let wanted = within + if is_fitted { 3.0 * master.largest_face() } else { 0.0 };
    let opposite = (&master, &on_master, wanted);
    let images = WithImages::new(settings, (&slave, &mut on), opposite)?;
    let settings = &match &images {
        Some(images) => images.with_images(settings, slave.dim),
        None => settings.clone(),
    };
    let sides = [slave, master];
    let sides = images.as_ref().map_or(sides, |images| images.sides(&slave, &master));
    let mut found = match &shape {
        Some(shape) => obstacle::pairs(&sides[0], (shape, &on), settings)?,
        None => search(sides.each_ref(), (&on, reach), settings)?,
    };
    let by_nodes = shape.is_some() || settings.pairing == Pairing::NodeToSurface;
    facets::stand_off(sides.each_ref(), (settings, by_nodes), &mut found)?;
    on.tell(&mut found.held);
    if master.is_rigid() {
        found.pairs = found.pairs.into_iter().map(SurfacePair::without_masters).collect();
    } else {
        on_master.tell(&mut found.held);
    }
    found.report.idle_planes = on.idle;
    found.report.beside_planes = on.beside;
    if let Some(images) = images {
        found = images.own_pairs(found, &slave)?;
    }
    slave.progress.goes_on()?;
    let mut found = unit.of_host(found, settings)?;
    slave.progress.goes_on()?;
    found.report.large_facets = match facets::too_large(&found, (&slave, settings))? {
        None => scatter::too_large(&found, (&slave, settings))?,
        told => told,
    };
    found.report.stand_off = Vec::new();
    Ok(found)
}

/// The pairs of two sides that are checked, with their images.
fn search(
    sides: [&Side<'_>; 2],
    (on, reach): (&OnPlanes, Reach),
    settings: &SurfaceSettings,
) -> Result<SurfacePairs, Error> {
    let [slave, master] = sides;
    slave.progress.goes_on()?;
    let mut own = Tree::new(slave)?;
    let mut opposite = Tree::new(master)?;
    slave.progress.expects(2 * slave.count() + master.count());
    self_overlap::check(slave, &mut own, reach.overlap)?;
    if settings.pairing == Pairing::DualMortar {
        self_overlap::check(master, &mut opposite, reach.overlap)?;
    }
    let candidates = Candidates::new(opposite, reach, span(sides));
    let mut found = match settings.pairing {
        Pairing::DualMortar => mortar::pairs(sides, on, (own, candidates), settings)?,
        Pairing::NodeToSurface => {
            node_to_surface::pairs(sides, on, (own, candidates), settings.normals)?
        }
    };
    if settings.keep_turns {
        keep_turns(&mut found.pairs, sides)?;
    }
    Ok(found)
}

/// How far masters are looked for. Displacements that are small beside the bodies do not reach further than the smaller of the
/// two sides of the whole body.
fn reach(sides: [(&Side<'_>, &OnPlanes); 2], settings: &SurfaceSettings) -> Reach {
    let [(slave, _), _] = sides;
    let largest = slave.largest_face();
    let open = || {
        let radius =
            |(side, on): (&Side<'_>, &OnPlanes)| side.radius(on.middle(side, settings.sector));
        let [own, opposite] = sides.map(radius);
        largest.max(own.min(opposite))
    };
    match settings.search_distance.map(|distance| slave.scale * distance) {
        Some(given) => Reach { overlap: given, open: given, layer: f64::INFINITY },
        None => Reach { overlap: largest, open: open(), layer: largest },
    }
}

/// No face of either side is further away from another one.
fn span(sides: [&Side<'_>; 2]) -> f64 {
    let [own, opposite] = sides.map(Side::bounds);
    own.with(&opposite).diagonal()
}
