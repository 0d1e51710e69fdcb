//! The auxiliary plane of a slave face: both faces are projected on it along its normal, clipped and
//! integrated there (Puso 2004). Of lines in the plane it is a straight line.

use super::bilinear::Bilinear;
use super::clip::Point;
use super::face::Face;
use super::shape::Local;
use crate::linalg::vector3::{Vector3, axis, unit};

/// Steps of Newton's method to local coordinates. It converges by squares from the middle of a face that
/// is convex; the rest is for faces at the limit of what is accepted.
const STEPS: usize = 40;

/// A step of Newton's method this short is the last one: what remains is of the order of its square.
const LAST: f64 = 4e-9;

/// A plane with its axes.
#[derive(Clone, Debug)]
pub(super) struct Plane {
    origin: Vector3,
    along: [Vector3; 2],
    pub(super) normal: Vector3,
}

/// First tangent of a normal: in the plane the normal turned by +90 degrees, in space one across the
/// axis that is most across the normal.
pub(super) fn tangents(dim: usize, normal: Vector3) -> [Vector3; 2] {
    if dim == 2 {
        return [Vector3::new(-normal.y, normal.x, 0.0), Vector3::zeros()];
    }
    let most_across = axis(normal.iamin());
    let first = unit(most_across - normal.dot(&most_across) * normal).unwrap_or(most_across);
    [first, normal.cross(&first)]
}

impl Plane {
    /// The plane through a point with a unit normal.
    pub(super) fn new(dim: usize, origin: Vector3, normal: Vector3) -> Plane {
        Plane { origin, along: tangents(dim, normal), normal }
    }

    /// Projects a face.
    pub(super) fn flatten<'a>(&self, face: &Face<'a>) -> Flat<'a> {
        let mut seen = face.clone();
        for x in &mut seen.x[..face.kind.nodes()] {
            let from = *x - self.origin;
            let [along, across] = self.along.map(|along| along.dot(&from));
            *x = Vector3::new(along, across, self.normal.dot(&from));
        }
        let bilinear = face.is_bilinear().then(|| Bilinear::new(&seen));
        Flat { face: seen, bilinear }
    }
}

/// Most corners of a part of a face.
const MOST_CORNERS: usize = 4;

/// A projected part of a face.
#[derive(Clone, Copy, Debug)]
pub(super) struct Polygon {
    corners: [Point; MOST_CORNERS],
    count: usize,
}

impl Polygon {
    /// Its corners in turn.
    pub(super) fn corners(&self) -> &[Point] {
        &self.corners[..self.count]
    }
}

/// A projected face.
#[derive(Clone, Debug)]
pub(super) struct Flat<'a> {
    /// The face in the axes of the plane, with heights above it.
    pub(super) face: Face<'a>,
    /// The closed form of faces with straight edges.
    pub(super) bilinear: Option<Bilinear>,
}

impl Flat<'_> {
    /// A part of the face as a polygon that turns to the left, or an interval that ascends.
    pub(super) fn polygon(&self, part: &[usize]) -> Polygon {
        let mut polygon = Polygon { corners: [[0.0; 2]; MOST_CORNERS], count: part.len() };
        for (corner, &node) in polygon.corners.iter_mut().zip(part) {
            *corner = [self.face.x[node].x, self.face.x[node].y];
        }
        if super::clip::measure(polygon.corners()) < 0.0 {
            polygon.corners[..part.len()].reverse();
        }
        polygon
    }

    /// The height above the plane.
    pub(super) fn height(&self, at: Local) -> f64 {
        match &self.bilinear {
            Some(bilinear) => bilinear.height(at),
            None => self.face.position(at).z,
        }
    }

    /// Derivatives of the position by the local coordinates; across a line of the plane itself.
    fn derivatives(&self, at: Local) -> [Vector3; 2] {
        match &self.bilinear {
            Some(bilinear) => bilinear.derivatives(at),
            None if self.face.kind.is_line() => [self.face.derivatives(at)[0], axis(1)],
            None => self.face.derivatives(at),
        }
    }

    /// Local coordinates of the face's point above `p`, in closed form if its edges are straight and by Newton's
    /// method otherwise; `None` if there are none.
    pub(super) fn local(&self, p: Point) -> Option<Local> {
        match &self.bilinear {
            Some(bilinear) => bilinear.local(p),
            None => self.newton(p),
        }
    }

    fn newton(&self, p: Point) -> Option<Local> {
        let mut at = self.face.kind.centre();
        for _ in 0..STEPS {
            let from = self.face.position(at) - Vector3::new(p[0], p[1], 0.0);
            let [a, b] = self.derivatives(at);
            let determinant = a.cross(&b).z;
            let step = [from.cross(&b).z / determinant, a.cross(&from).z / determinant];
            at = [at[0] - step[0], at[1] - step[1]];
            if step[0].abs().max(step[1].abs()) <= LAST {
                return Some(at);
            }
        }
        None
    }

    /// The area of the face over a unit of area of the plane.
    pub(super) fn stretch(&self, at: Local) -> f64 {
        let [a, b] = self.derivatives(at);
        let normal = a.cross(&b);
        normal.norm() / normal.z.abs()
    }
}
