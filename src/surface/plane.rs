//! The auxiliary plane of a slave face: both faces are projected on it along its normal, clipped and
//! integrated there (Puso 2004). Of lines in the plane it is a straight line.

use super::bilinear::Bilinear;
use super::clip::Point;
use super::face::Face;
use super::shape::{FaceKind, Local, MOST_NODES};
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
    pub(super) fn flatten(&self, face: &Face<'_>) -> Flat {
        let mut flat = Flat {
            kind: face.kind,
            points: [[0.0; 2]; MOST_NODES],
            heights: [0.0; MOST_NODES],
            bilinear: None,
        };
        for (i, x) in face.x[..face.kind.nodes()].iter().enumerate() {
            let from = x - self.origin;
            flat.points[i] = self.along.map(|along| along.dot(&from));
            flat.heights[i] = self.normal.dot(&from);
        }
        if face.is_bilinear() {
            flat.bilinear = Some(Bilinear::new(face.kind, &flat.points, &flat.heights));
        }
        flat
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

/// A projected face: its nodes in the axes of the plane, and their heights above it.
#[derive(Clone, Debug)]
pub(super) struct Flat {
    pub(super) kind: FaceKind,
    pub(super) points: [Point; MOST_NODES],
    heights: [f64; MOST_NODES],
    /// The closed form of faces with straight edges.
    pub(super) bilinear: Option<Bilinear>,
}

impl Flat {
    /// A part of the face as a polygon that turns to the left, or an interval that ascends.
    pub(super) fn polygon(&self, part: &[usize]) -> Polygon {
        let mut polygon = Polygon { corners: [[0.0; 2]; MOST_CORNERS], count: part.len() };
        for (corner, &node) in polygon.corners.iter_mut().zip(part) {
            *corner = self.points[node];
        }
        if super::clip::measure(polygon.corners()) < 0.0 {
            polygon.corners[..part.len()].reverse();
        }
        polygon
    }

    /// The height above the plane.
    pub(super) fn height(&self, at: Local) -> f64 {
        if let Some(bilinear) = &self.bilinear {
            return bilinear.height(at);
        }
        self.kind.values(at).iter().zip(self.heights).map(|(value, height)| value * height).sum()
    }

    /// Position less `p`, and its derivatives by the local coordinates.
    fn offset(&self, at: Local, p: Point) -> (Point, [Point; 2]) {
        let mut from = [-p[0], -p[1]];
        let mut by = [[0.0; 2]; 2];
        let functions = self.kind.functions(at);
        let nodes = self.kind.nodes();
        for (point, [value, first, second]) in self.points[..nodes].iter().zip(functions) {
            for c in 0..2 {
                from[c] += value * point[c];
                by[0][c] += first * point[c];
                by[1][c] += second * point[c];
            }
        }
        if self.kind.is_line() {
            by[1] = [0.0, 1.0];
        }
        (from, by)
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
        let p = if self.kind.is_line() { [p[0], 0.0] } else { p };
        let mut at = self.kind.centre();
        for _ in 0..STEPS {
            let (from, [a, b]) = self.offset(at, p);
            let determinant = a[0] * b[1] - a[1] * b[0];
            let step = [
                (from[0] * b[1] - from[1] * b[0]) / determinant,
                (a[0] * from[1] - a[1] * from[0]) / determinant,
            ];
            at = [at[0] - step[0], if self.kind.is_line() { 0.0 } else { at[1] - step[1] }];
            if step[0].abs().max(step[1].abs()) <= LAST {
                return Some(at);
            }
        }
        None
    }

    fn rise(&self, at: Local) -> [f64; 2] {
        let mut rise = [0.0; 2];
        for (slopes, height) in self.kind.derivatives(at).iter().zip(self.heights) {
            rise[0] += slopes[0] * height;
            rise[1] += slopes[1] * height;
        }
        rise
    }

    /// The area of the face over a unit of area of the plane.
    pub(super) fn stretch(&self, at: Local) -> f64 {
        if let Some(bilinear) = &self.bilinear {
            return bilinear.stretch(at);
        }
        let (_, [a, b]) = self.offset(at, [0.0; 2]);
        let rise = self.rise(at);
        if self.kind.is_line() {
            return (1.0 + (rise[0] / a[0]).powi(2)).sqrt();
        }
        let area = a[0] * b[1] - a[1] * b[0];
        let [s, t] =
            [(rise[0] * b[1] - rise[1] * a[1]) / area, (rise[1] * a[0] - rise[0] * b[0]) / area];
        (1.0 + s * s + t * t).sqrt()
    }
}
