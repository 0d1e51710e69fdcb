//! Where a slave face and the master faces lie over each other: the parts, and points of integration.

use super::clip::{Point, common_part, measure};
use super::face::Face;
use super::plane::{Flat, Plane};
use super::quadrature;
use super::shape::Local;

/// Parts smaller than this share of the slave face are left out on both sides: they are the rounding of
/// edges that lie upon each other.
const LEAST_PART: f64 = 1e-13;

/// Points along each direction where local coordinates are not linear in the position, so that no rule
/// is exact: on quadrilaterals distorted by 0.25 of their size the error is 1e-12 (measured).
const MANY_POINTS: usize = 9;

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
    polygons: Vec<Vec<Point>>,
    affine: bool,
    /// Area in the plane.
    pub(super) area: f64,
}

/// What a master face has in common with a slave face.
pub(super) struct Part {
    pub(super) points: Vec<Meeting>,
    /// Area in the auxiliary plane.
    pub(super) area: f64,
}

/// A part of a face whose local coordinates were not found.
#[derive(Debug)]
pub(super) struct NotFound;

/// The polygons of a projected face: its own, or those of its flat parts if its edges are curved.
fn polygons(face: &Face<'_>, flat: &Flat) -> Vec<Vec<Point>> {
    if face.is_straight() || face.kind.is_line() {
        let corners: Vec<usize> = (0..face.kind.corners()).collect();
        return vec![flat.polygon(&corners)];
    }
    face.kind.parts().iter().map(|part| flat.polygon(part)).collect()
}

impl SlaveFace {
    pub(super) fn new(face: &Face<'_>, plane: Plane) -> SlaveFace {
        let flat = plane.flatten(face);
        let polygons = polygons(face, &flat);
        let area = polygons.iter().map(|polygon| measure(polygon)).sum();
        SlaveFace { plane, flat, polygons, affine: face.is_affine(), area }
    }

    /// What lies over a master face, at a distance of at most `reach` along the normal.
    ///
    /// # Errors
    /// Newton's method fails on a face that is turned over in the projection.
    pub(super) fn overlap(&self, master: &Face<'_>, reach: f64) -> Result<Part, NotFound> {
        let flat = self.plane.flatten(master);
        let mut part = Part { points: Vec::new(), area: 0.0 };
        for window in polygons(master, &flat) {
            for polygon in &self.polygons {
                let common = common_part(polygon, &window);
                let area = measure(&common);
                if !(area > LEAST_PART * self.area) {
                    continue;
                }
                let (points, distance) = self.points(&flat, &common, &self.rule(master))?;
                if distance.abs() <= reach {
                    part.points.extend(points);
                    part.area += area;
                }
            }
        }
        Ok(part)
    }

    /// Barycentric points and weights for simplices of the parts: exact for products of shape
    /// functions if both faces are affine.
    fn rule(&self, master: &Face<'_>) -> Vec<([f64; 3], f64)> {
        let own = self.flat.kind.degree();
        let degree = own + own.max(master.kind.degree());
        let many = !(self.affine && master.is_affine());
        if self.flat.kind.is_line() {
            let points = if many { MANY_POINTS } else { (degree + 2) / 2 };
            let rule = quadrature::on_interval(points);
            return rule.iter().map(|(s, w)| ([1.0 - s, *s, 0.0], *w)).collect();
        }
        let points = if many { MANY_POINTS } else { (degree + 3) / 2 };
        quadrature::on_triangle(points).to_vec()
    }

    /// Points of a common part, and its mean distance along the normal.
    fn points(
        &self,
        master: &Flat,
        common: &[Point],
        rule: &[([f64; 3], f64)],
    ) -> Result<(Vec<Meeting>, f64), NotFound> {
        let simplices: Vec<Vec<Point>> = match common {
            [a, b] => vec![vec![*a, *b]],
            _ => common.windows(2).skip(1).map(|s| vec![common[0], s[0], s[1]]).collect(),
        };
        let mut points = Vec::with_capacity(simplices.len() * rule.len());
        let (mut distance, mut whole) = (0.0, 0.0);
        for simplex in &simplices {
            let area = measure(simplex);
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
        Ok((points, distance / whole))
    }
}
