//! Where a slave face and the master faces lie over each other: the parts, and points of integration.

use std::cell::LazyCell;

use super::clip::{Clipper, Point, measure};
use super::face::{Face, ON_EDGE};
use super::plane::{Flat, Plane, Polygon};
use super::quadrature::{self, MOST_POINTS, RulePoint};
use super::shape::Local;

/// Parts smaller than this share of the slave face are left out on both sides: they are the rounding of
/// edges that lie upon each other.
const LEAST_PART: f64 = 1e-13;

/// The error that fewer points may leave: that of the most. And the error of areas where faces are warped.
const LEFT: f64 = 1e-12;
const LEFT_OF_AREA: f64 = 1e-11;

/// At this distortion a corner is straight, and at this slope by a warp no series of the area converges.
const FOLDED: f64 = 1.0;

/// A point where a slave and a master face lie over each other.
#[derive(Clone, Copy, Debug)]
pub(super) struct Meeting {
    pub(super) slave: Local,
    pub(super) master: Local,
    /// Area of the slave face.
    pub(super) weight: f64,
}

/// A slave face in its auxiliary plane.
pub(super) struct SlaveFace<'a> {
    pub(super) plane: Plane,
    flat: Flat<'a>,
    polygons: Vec<Polygon>,
    /// Area in the plane.
    pub(super) area: f64,
    face: Face<'a>,
}

/// What lies over a master face.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Part {
    /// Area in the auxiliary plane.
    pub(super) area: f64,
    /// Mean distance along the normal.
    pub(super) distance: f64,
}

/// The common parts of a slave face and master faces, in memory that the next one uses again.
#[derive(Debug, Default)]
pub(super) struct Overlaps {
    /// The points, master face after master face.
    pub(super) points: Vec<Meeting>,
    clipper: Clipper,
}

/// Points of a triangle or an interval, and whether a triangle is quartered first.
#[derive(Clone, Copy)]
struct Rule {
    points: &'static [RulePoint],
    quartered: bool,
}

/// A part of a face whose local coordinates were not found.
#[derive(Debug)]
pub(super) struct NotFound;

/// The polygons of a projected face: its own, or those of its flat parts if its edges are curved.
fn polygons(face: &Face<'_>, flat: &Flat<'_>) -> impl Iterator<Item = Polygon> {
    let whole = face.is_straight() || face.kind.is_line();
    let parts = if whole { face.kind.outline() } else { face.kind.parts() };
    parts.iter().map(|part| flat.polygon(part))
}

impl<'a> SlaveFace<'a> {
    pub(super) fn new(face: &Face<'a>, plane: Plane) -> SlaveFace<'a> {
        let flat = plane.flatten(face);
        let polygons: Vec<Polygon> = polygons(face, &flat).collect();
        let area = polygons.iter().map(|polygon| measure(polygon.corners())).sum();
        SlaveFace { plane, flat, polygons, area, face: face.clone() }
    }

    /// Adds the points of what lies over a master face, at a distance along the normal that is `wanted`.
    ///
    /// # Errors
    /// A face that is turned over in the projection has no local coordinates.
    pub(super) fn overlap(
        &self,
        master: &Face<'_>,
        wanted: impl Fn(f64) -> bool,
        found: &mut Overlaps,
    ) -> Result<Part, NotFound> {
        let flat = self.plane.flatten(master);
        // Most faces that are near have nothing in common.
        let rule = LazyCell::new(|| self.rule(&flat));
        let mut whole = Part::default();
        for window in polygons(master, &flat) {
            for polygon in &self.polygons {
                let common = found.clipper.common_part(polygon.corners(), window.corners());
                let area = measure(common);
                if !(area > LEAST_PART * self.area) {
                    continue;
                }
                let before = found.points.len();
                let distance = self.add_points(&flat, common, &rule, &mut found.points)?;
                if wanted(distance) {
                    whole.area += area;
                    whole.distance += area * (distance - whole.distance) / whole.area;
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
    fn rule(&self, master: &Flat<'_>) -> Rule {
        let own = self.flat.face.kind.degree();
        // The length of a ring is as much of a polynomial as the place.
        let ring = if self.face.is_ring { own } else { 0 };
        let degree = own + own.max(master.face.kind.degree()) + ring;
        let count = |exact: usize, size: f64| {
            let further = self.further_degrees(master, size);
            further.map_or(MOST_POINTS, |more| (exact + more).div_ceil(2))
        };
        if self.flat.face.kind.is_line() {
            let points = quadrature::on_interval(count(degree + 1, 1.0).min(MOST_POINTS));
            return Rule { points, quartered: false };
        }
        // Where quadrilaterals are so distorted that they ask for more points, triangles are quartered.
        let whole = count(degree + 2, 1.0);
        let quartered = whole > MOST_POINTS;
        let needed = if quartered { count(degree + 2, 0.5) } else { whole };
        Rule { points: quadrature::on_triangle(needed.min(MOST_POINTS)), quartered }
    }

    /// Degrees that a rule has to be exact to beyond that of products of shape functions, on parts of the given
    /// size beside the face's; `None`: as many as there are.
    ///
    /// With the distortion `e` of a quadrilateral, local coordinates are analytic in the position up to the
    /// distance `1 / e` from the middle, so that what is neglected falls by `2 / e` with each degree. The
    /// area of a face whose warp adds the slope `w` has terms `w^2k` of the degree `2 k`.
    fn further_degrees(&self, master: &Flat<'_>, size: f64) -> Option<usize> {
        let (own, other) = (self.flat.bilinear?, master.bilinear?);
        let terms = |ratio: f64, left: f64| (left.ln() / ratio.ln()).ceil() as usize;
        let distortion = own.distortion().max(other.distortion());
        let warp = own.warp();
        if !(distortion < FOLDED && warp < FOLDED) {
            return None;
        }
        let of_distortion = match distortion > ON_EDGE {
            true => terms(0.5 * size * distortion, LEFT) - 1,
            false => 0,
        };
        let of_warp = match warp > ON_EDGE {
            true => 2 * (terms(size * size * warp * warp, LEFT_OF_AREA) - 1),
            false => 0,
        };
        Some(of_distortion.max(of_warp))
    }

    /// Adds the points of a common part, and returns its mean distance along the normal.
    fn add_points(
        &self,
        master: &Flat<'_>,
        common: &[Point],
        rule: &Rule,
        points: &mut Vec<Meeting>,
    ) -> Result<f64, NotFound> {
        let (mut distance, mut whole) = (0.0, 0.0);
        // Triangles of a fan, or the interval itself.
        let simplices = (2..common.len().max(3)).flat_map(|k| {
            let last = common.get(k).unwrap_or(&common[1]);
            let simplex = [common[0], common[k - 1], *last];
            if rule.quartered { quarters(simplex) } else { [Some(simplex), None, None, None] }
        });
        for simplex in simplices.flatten() {
            let area = measure(&simplex[..common.len().min(3)]);
            for (barycentric, share) in rule.points {
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
                let weight = weight * self.flat.stretch(slave) * self.face.around(slave);
                points.push(Meeting { slave, master: at, weight });
            }
        }
        Ok(distance / whole)
    }
}

/// The four triangles that the middles of its sides make of one.
fn quarters([a, b, c]: [Point; 3]) -> [Option<[Point; 3]>; 4] {
    let middle = |p: Point, q: Point| [0, 1].map(|i| 0.5 * (p[i] + q[i]));
    let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
    [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]].map(Some)
}
