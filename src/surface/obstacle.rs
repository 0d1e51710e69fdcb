//! Rigid obstacles with a shape: each slave node against the nearest point. In a sector shapes repeat in the neighbours.

use std::collections::BTreeMap;

use super::exact_shape::{ExactShape, Obstacle};
use super::mesh::Side;
use super::pairs::{SurfacePair, SurfacePairs, SurfaceReport, without_rounding};
use super::row::{Row, pair_of_row, pairs_of_rows, whole_rows};
use super::sector::Sector;
use super::self_overlap;
use super::settings::SurfaceSettings;
use super::symmetry::OnPlanes;
use super::tree::Tree;
use super::true_shape::true_places;
use super::unit::Unit;
use crate::error::{Argument, Error, index};
use crate::linalg::vector3::Vector3;

/// A shape and its images in the neighbours of a sector.
struct Repeated(Vec<ExactShape>);

impl Repeated {
    /// # Errors
    /// The space in front of a plane, or inside of a hollow shape, that is not its own image: the images would cut it.
    fn new(shape: &ExactShape, sector: Option<Sector>, side: &Side<'_>) -> Result<Self, Error> {
        let steps = sector.map_or(Vec::new(), |sector| sector.steps());
        let images = steps.as_flattened().iter().map(|step| shape.moved(step, side.scale));
        let all = Repeated([*shape].into_iter().chain(images).collect());
        let near = side.nearness();
        let differs =
            |image: &ExactShape, x: Vector3| (image.facing(x).0 - shape.facing(x).0).abs() > near;
        let is_cut = |node: usize| all.0.iter().any(|image| differs(image, side.position(node)));
        match !shape.is_solid() && side.all_nodes().into_iter().any(is_cut) {
            true => refuse(
                "it is not its own image in the next sector, and a plane or a hollow shape does not repeat: give faces",
            ),
            false => Ok(all),
        }
    }

    /// The gap of a point and the normal into the obstacle, of the nearest image.
    fn facing(&self, x: Vector3) -> (f64, Option<Vector3>) {
        let of_images = self.0.iter().map(|image| image.facing(x));
        of_images.min_by(|a, b| a.0.total_cmp(&b.0)).expect("the shape itself")
    }
}

fn refuse<T>(message: &str) -> Result<T, Error> {
    Err(Error::invalid(Argument::Obstacle, format!("obstacle: {message}")))
}

/// The shape with lengths in the unit of the pairing, its numbers checked.
pub(super) fn checked(shape: &Obstacle, dim: usize, unit: &Unit) -> Result<ExactShape, Error> {
    shape.check(dim, unit.inside).or_else(|message| refuse(&message))
}

/// The settings that a shape reads: it has normals of its own and no rim, and needs no images of planes.
pub(super) fn settings_of_shape(settings: &SurfaceSettings) -> SurfaceSettings {
    let SurfaceSettings { pairing, normals, rims, symmetry, shapes, .. } = Default::default();
    let shapes = [settings.shapes[0], shapes[1]];
    SurfaceSettings { pairing, normals, rims, symmetry, shapes, ..settings.clone() }
}

/// Pairs the nodes of a side that is checked with a shape, up to the search distance (`None` or infinite: all of them).
///
/// # Errors
/// As [`super::pair_surfaces`] says.
pub(super) fn pairs(
    side: &Side<'_>,
    (obstacle, on): (&ExactShape, &OnPlanes),
    settings: &SurfaceSettings,
) -> Result<SurfacePairs, Error> {
    let reach = side.scale * settings.search_distance.unwrap_or(f64::INFINITY);
    side.progress.expects(side.count());
    self_overlap::check(side, &mut Tree::new(side)?, reach)?;
    let obstacle = &Repeated::new(obstacle, settings.sector, side)?;
    let places = true_places(side, &settings.shapes[0])?;
    let surface = side.moved(places.as_deref().unwrap_or(side.coordinates));
    let mut facing = BTreeMap::new();
    for node in side.all_nodes() {
        let (away, normal) = obstacle.facing(surface.position(node));
        if normal.is_none() && away.abs() <= reach {
            return refuse(&format!(
                "node {} stands on its axis or in its centre, where it has no normal: leave out the faces there, \
                 give a search distance that does not reach them, or an obstacle of faces",
                index(node)
            ));
        }
        let normal = normal.unwrap_or_default();
        // On an axis a pair is along it, and so is its gap.
        facing.insert(node, (away / normal.dot(&on.turned(node, normal)), normal));
    }
    let looking_away = looking_away(side, obstacle);
    let [search_distance, overlap_distance] = [reach; 2];
    let mut report =
        SurfaceReport { search_distance, overlap_distance, looking_away, ..Default::default() };
    let meets = |node: usize| facing[&node].0.abs() <= reach;
    let rows = whole_rows(meets, side, &mut report)?;
    let pair = |node, row: Row| {
        let pair = pair_of_row([side; 2], on, (node, row), facing[&node].1);
        let slaves = pair.slaves().iter();
        let size = |node: &usize| side.position(*node).lp_norm(1) + obstacle.0[0].size();
        let gap = slaves.clone().map(|(node, weight)| weight * facing[node].0).sum();
        let size = slaves.map(|(node, weight)| weight.abs() * size(node)).sum();
        Ok(SurfacePair { gap: without_rounding(gap, size), ..pair })
    };
    pairs_of_rows(side, rows, report, pair)
}

/// Number of faces whose middles look away from a shape.
fn looking_away(side: &Side<'_>, shape: &Repeated) -> usize {
    let looks_away = |at: &usize| {
        let (face, middle) = (side.face(*at), side.face(*at).kind.centre());
        let (_, normal) = shape.facing(face.position(middle));
        normal.is_some_and(|normal| normal.dot(&face.outward(middle)) <= 0.0)
    };
    (0..side.count()).filter(|at| !side.is_image(*at)).filter(looks_away).count()
}
