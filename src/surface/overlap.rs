//! Where a slave face and the master faces lie over each other: the parts, and points of integration.

use std::cell::LazyCell;

use super::clip::{Clipper, Point, measure};
use super::face::Face;
use super::plane::{Flat, Plane, Polygon};
use super::quadrature::{self, RulePoint};
use super::shape::Local;

/// Parts smaller than this share of the slave face are left out on both sides: they are the rounding of
/// edges that lie upon each other.
const LEAST_PART: f64 = 1e-13;

/// Most points along each direction: on quadrilaterals distorted by 0.25 of their size, where local
/// coordinates are not polynomials of the position, the error is 1e-12 (measured).
const MOST_POINTS: usize = 9;

/// The error that fewer points may leave: that of the most. And the error of areas where faces are warped.
const LEFT: f64 = 1e-12;
const LEFT_OF_AREA: f64 = 1e-11;

/// At this distortion a corner is straight, and at this slope by a warp no series of the area converges.
const FOLDED: f64 = 1.0;
const STEEP: f64 = 1.0;

/// A face that is further from linear than this, relative to its size, is not taken for linear: rounding.
const LINEAR: f64 = 1e-11;

/// A point where a slave and a master face lie over each other.
#[derive(Clone, Copy, Debug)]
pub(super) struct Meeting {
    pub(super) slave: Local,
    pub(super) master: Local,
    /// Area of the slave face.
    pub(super) weight: f64,
}

/// A slave face in its auxiliary plane.
pub(super) struct SlaveFace {
    pub(super) plane: Plane,
    flat: Flat,
    polygons: Vec<Polygon>,
    /// Area in the plane.
    pub(super) area: f64,
}

/// What a slave face has in common with master faces, in memory that the next one uses again.
#[derive(Debug, Default)]
pub(super) struct Overlaps {
    /// The points, master face after master face.
    pub(super) points: Vec<Meeting>,
    clipper: Clipper,
}

/// A part of a face whose local coordinates were not found.
#[derive(Debug)]
pub(super) struct NotFound;

/// The polygons of a projected face: its own, or those of its flat parts if its edges are curved.
fn polygons(face: &Face<'_>, flat: &Flat) -> impl Iterator<Item = Polygon> {
    let whole = face.is_straight() || face.kind.is_line();
    let parts = if whole { face.kind.outline() } else { face.kind.parts() };
    parts.iter().map(|part| flat.polygon(part))
}

impl SlaveFace {
    pub(super) fn new(face: &Face<'_>, plane: Plane) -> SlaveFace {
        let flat = plane.flatten(face);
        let polygons: Vec<Polygon> = polygons(face, &flat).collect();
        let area = polygons.iter().map(|polygon| measure(polygon.corners())).sum();
        SlaveFace { plane, flat, polygons, area }
    }

    /// Adds the points of what lies over a master face, at a distance of at most `reach` along the normal, and
    /// returns its area in the auxiliary plane.
    ///
    /// # Errors
    /// A face that is turned over in the projection has no local coordinates.
    pub(super) fn overlap(
        &self,
        master: &Face<'_>,
        reach: f64,
        found: &mut Overlaps,
    ) -> Result<f64, NotFound> {
        let flat = self.plane.flatten(master);
        // Most faces that are near have nothing in common.
        let rule = LazyCell::new(|| self.rule(&flat));
        let mut whole = 0.0;
        for window in polygons(master, &flat) {
            for polygon in &self.polygons {
                let common = found.clipper.common_part(polygon.corners(), window.corners());
                let area = measure(common);
                if !(area > LEAST_PART * self.area) {
                    continue;
                }
                let before = found.points.len();
                let distance = self.add_points(&flat, common, &rule, &mut found.points)?;
                if distance.abs() <= reach {
                    whole += area;
                } else {
                    found.points.truncate(before);
                }
            }
        }
        Ok(whole)
    }

    /// Barycentric points and weights for simplices of the parts: exact for products of shape
    /// functions if local coordinates are linear in the position, and otherwise with so many more points
    /// as the distance from linear asks for.
    fn rule(&self, master: &Flat) -> &'static [RulePoint] {
        let own = self.flat.kind.degree();
        let degree = own + own.max(master.kind.degree());
        let further = self.further_degrees(master);
        let points = |exact: usize| further.map_or(MOST_POINTS, |more| (exact + more).div_ceil(2));
        if self.flat.kind.is_line() {
            return quadrature::on_interval(points(degree + 1).min(MOST_POINTS));
        }
        quadrature::on_triangle(points(degree + 2).min(MOST_POINTS))
    }

    /// Degrees that a rule has to be exact to beyond that of products of shape functions; `None`: as
    /// many as there are.
    ///
    /// With the distortion `e` of a quadrilateral, local coordinates are analytic in the position up to the
    /// distance `1 / e` from the middle, so that what is neglected falls by `2 / e` with each degree. The
    /// area of a face whose warp adds the slope `w` has terms `w^2k` of the degree `2 k`.
    fn further_degrees(&self, master: &Flat) -> Option<usize> {
        let (own, other) = (self.flat.bilinear?, master.bilinear?);
        let terms = |ratio: f64, left: f64| (left.ln() / ratio.ln()).ceil() as usize;
        let distortion = own.distortion().max(other.distortion());
        let warp = own.warp();
        if !(distortion < FOLDED && warp < STEEP) {
            return None;
        }
        let of_distortion = match distortion > LINEAR {
            true => terms(0.5 * distortion, LEFT) - 1,
            false => 0,
        };
        let of_warp = match warp > LINEAR {
            true => 2 * (terms(warp * warp, LEFT_OF_AREA) - 1),
            false => 0,
        };
        Some(of_distortion.max(of_warp))
    }

    /// Adds the points of a common part, and returns its mean distance along the normal.
    fn add_points(
        &self,
        master: &Flat,
        common: &[Point],
        rule: &[RulePoint],
        points: &mut Vec<Meeting>,
    ) -> Result<f64, NotFound> {
        let (mut distance, mut whole) = (0.0, 0.0);
        // Triangles of a fan, or the interval itself.
        for k in 2..common.len().max(3) {
            let last = common.get(k).unwrap_or(&common[1]);
            let simplex = [common[0], common[k - 1], *last];
            let area = measure(&simplex[..common.len().min(3)]);
            for (barycentric, share) in rule {
                let mut p = [0.0; 2];
                for (corner, part) in simplex.iter().zip(barycentric) {
                    p[0] += part * corner[0];
                    p[1] += part * corner[1];
                }
                let slave = self.flat.local(p).ok_or(NotFound)?;
                let at = master.local(p).ok_or(NotFound)?;
                let weight = share * area;
                distance += weight * (master.height(at) - self.flat.height(slave));
                whole += weight;
                let weight = weight * self.flat.stretch(slave);
                points.push(Meeting { slave, master: at, weight });
            }
        }
        Ok(distance / whole)
    }
}
