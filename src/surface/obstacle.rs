//! Rigid obstacles: planes, cylinders, spheres.

use std::collections::BTreeMap;

use super::candidates::SearchFaces;
use super::mesh::{Faces, Side};
use super::pairs::{SurfacePair, SurfacePairs, SurfaceReport, without_rounding};
use super::row::Row;
use super::self_overlap;
use super::settings::SurfaceSettings;
use super::symmetry::OnPlanes;
use super::unit::Unit;
use super::watch::Watch;
use super::whole_faces::paired;
use crate::error::{Argument, Error};
use crate::linalg::vector3::{Vector3, unit};
use crate::monitor::Monitor;

/// A surface that does not deform. Vectors have their third component zero in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Obstacle {
    /// A half space, in the plane a half plane.
    Plane {
        /// A point of its face.
        point: [f64; 3],
        /// The direction out of it, of any length.
        outward: [f64; 3],
    },
    /// A ball, in the plane a disc, or the space around it.
    Sphere {
        /// The middle.
        centre: [f64; 3],
        /// The radius.
        radius: f64,
        /// `true` if the body is inside, as in a bowl.
        hollow: bool,
    },
    /// A round bar of any length, or the space around it; in space only.
    Cylinder {
        /// A point of the axis.
        point: [f64; 3],
        /// The direction of the axis, of any length.
        axis: [f64; 3],
        /// The radius.
        radius: f64,
        /// `true` if the body is inside, as in a bore.
        hollow: bool,
    },
}

/// An obstacle whose numbers have been checked.
enum Checked {
    Plane {
        point: Vector3,
        outward: Vector3,
    },
    /// The axis is zero for a sphere; the sign is negative if it is hollow.
    Round {
        point: Vector3,
        axis: Vector3,
        radius: f64,
        sign: f64,
    },
}

fn refuse<T>(message: &str) -> Result<T, Error> {
    Err(Error::invalid(Argument::Obstacle, format!("obstacle: {message}")))
}

impl Obstacle {
    /// The numbers that are lengths.
    fn lengths(&self) -> [f64; 4] {
        let (Obstacle::Plane { point: [x, y, z], .. }
        | Obstacle::Sphere { centre: [x, y, z], .. }
        | Obstacle::Cylinder { point: [x, y, z], .. }) = *self;
        let radius = match *self {
            Obstacle::Plane { .. } => 0.0,
            Obstacle::Sphere { radius, .. } | Obstacle::Cylinder { radius, .. } => radius,
        };
        [x, y, z, radius]
    }

    fn check(&self, dim: usize, scale: Unit) -> Result<Checked, Error> {
        let direction = |name: &str, v: [f64; 3]| match unit(v.into()) {
            Some(v) => Ok(v),
            None => refuse(&format!("its {name} is zero or not finite")),
        };
        let (point, checked) = match *self {
            Obstacle::Plane { point, outward } => {
                let outward = direction("outward direction", outward)?;
                (point, Checked::Plane { point: point.into(), outward })
            }
            Obstacle::Sphere { centre, radius, hollow } => {
                (centre, round(centre, Vector3::zeros(), radius, hollow)?)
            }
            Obstacle::Cylinder { point, axis, radius, hollow } => {
                if dim == 2 {
                    return refuse(
                        "a cylinder needs three dimensions: in the plane it is a sphere",
                    );
                }
                (point, round(point, direction("axis", axis)?, radius, hollow)?)
            }
        };
        match point.iter().all(|x| x.is_finite()) {
            true => Ok(checked.scaled(scale.inside)),
            false => refuse("its point is not finite"),
        }
    }
}

fn round(point: [f64; 3], axis: Vector3, radius: f64, hollow: bool) -> Result<Checked, Error> {
    // Written so that NaN is refused.
    if !(radius > 0.0 && radius.is_finite()) {
        return refuse(&format!("its radius is {radius}, it must be positive and finite"));
    }
    let sign = if hollow { -1.0 } else { 1.0 };
    Ok(Checked::Round { point: point.into(), axis, radius, sign })
}

impl Checked {
    fn scaled(self, by: f64) -> Checked {
        match self {
            Checked::Plane { point, outward } => Checked::Plane { point: by * point, outward },
            Checked::Round { point, axis, radius, sign } => {
                Checked::Round { point: by * point, axis, radius: by * radius, sign }
            }
        }
    }

    /// The size of its own lengths.
    fn size(&self) -> f64 {
        match self {
            Checked::Plane { point, .. } => point.lp_norm(1),
            Checked::Round { point, radius, .. } => point.lp_norm(1) + radius,
        }
    }

    /// The gap of a point, and the normal from the point into the obstacle; `None` where all normals
    /// are as good, on the axis or in the centre.
    fn facing(&self, x: Vector3) -> Option<(f64, Vector3)> {
        match self {
            Checked::Plane { point, outward } => Some((outward.dot(&(x - point)), -outward)),
            Checked::Round { point, axis, radius, sign } => {
                let from = x - point;
                let across = from - from.dot(axis) * axis;
                let outward = unit(across)?;
                Some((sign * (across.norm() - radius), -*sign * outward))
            }
        }
    }
}

/// Pairs the nodes of a surface with an obstacle, up to the search distance (`None` or infinite: all of
/// them). Of the settings it reads that and `axisymmetric`.
///
/// A mid node of a quadratic face has its corners beside it in its row, and the gap is that of the row.
///
/// # Errors
/// Faces that are wrong, as [`super::pair_surfaces`] says; an obstacle that is wrong
/// ([`Argument::Obstacle`]): a direction that is zero, a radius that is not positive, a node on the axis
/// or in the centre; a search distance that is not positive ([`Argument::Settings`]).
pub fn pair_with_obstacle(
    dim: usize,
    coordinates: &[f64],
    slave: Faces<'_>,
    obstacle: &Obstacle,
    settings: &SurfaceSettings,
    monitor: &mut Monitor<'_>,
) -> Result<SurfacePairs, Error> {
    let SurfaceSettings { search_distance, axisymmetric, .. } = *settings;
    let settings = &SurfaceSettings { search_distance, axisymmetric, ..Default::default() };
    settings.check(dim)?;
    let watch = &mut Watch::new(monitor);
    let side = Side::slave(dim, coordinates, slave)?;
    let unit = Unit::of(side.lengths().chain(obstacle.lengths()));
    let obstacle = obstacle.check(dim, unit)?;
    let side = side.checked((unit.inside, axisymmetric), watch)?;
    let reach = side.inside(search_distance.unwrap_or(f64::INFINITY));
    let planes = OnPlanes::new(&side, dim, (&settings.symmetry, axisymmetric))?;
    watch.expects(side.count());
    self_overlap::check(&side, &SearchFaces::new(&side, watch)?, (dim, reach), watch)?;
    let mut facing = BTreeMap::new();
    for node in side.all_nodes() {
        let Some(met) = obstacle.facing(side.position(node)) else {
            return refuse(&format!(
                "node {} stands on its axis or in its centre, where it has no normal",
                crate::error::index(node)
            ));
        };
        facing.insert(node, met);
    }
    let report = SurfaceReport {
        search_distance: reach,
        slave_faces: side.count(),
        ..SurfaceReport::default()
    };
    let meets = |node: usize| facing[&node].0.abs() <= reach;
    let pair = |node, row: Row| {
        let area = row.area;
        let [slaves, masters] = row.into_weights();
        let size = |node: &usize| side.position(*node).lp_norm(1) + obstacle.size();
        let gap = slaves.iter().map(|(node, weight)| weight * facing[node].0).sum();
        let size = slaves.iter().map(|(node, weight)| weight.abs() * size(node)).sum();
        let points = (side.point(&slaves), None);
        let normal = planes.turned(node, facing[&node].1);
        let pair = SurfacePair::new(dim, (node, area), [slaves, masters], normal, points);
        planes.hold(SurfacePair { gap: without_rounding(gap, size), ..pair })
    };
    unit.of_host(paired((&side, dim, &planes), report, meets, pair, watch)?, axisymmetric)
}
