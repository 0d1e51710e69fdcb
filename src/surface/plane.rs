//! The auxiliary plane of a slave face: both faces are projected on it along its normal, clipped and
//! integrated there (Puso 2004). Of lines in the plane it is a straight line.

use super::bilinear::Bilinear;
use super::clip::{self, Point};
use super::curved::Curved;
use super::face::Face;
use super::shape::{Block, Local, each};
use crate::linalg::vector3::{Vector3, most_across, unit};

/// A plane with its axes.
#[derive(Clone, Debug)]
pub(super) struct Plane {
    origin: Vector3,
    along: [Vector3; 2],
    normal: Vector3,
}

/// First tangent of a normal: in the plane the normal turned by +90 degrees, in space one across the
/// axis that is most across the normal.
pub(super) fn tangents(dim: usize, normal: Vector3) -> [Vector3; 2] {
    if dim == 2 {
        return [Vector3::new(-normal.y, normal.x, 0.0), Vector3::zeros()];
    }
    let across = most_across(normal);
    let first = unit(across - normal.dot(&across) * normal).unwrap_or(across);
    [first, normal.cross(&first)]
}

impl Plane {
    /// The plane through a point with a unit normal.
    pub(super) fn new(dim: usize, origin: Vector3, normal: Vector3) -> Plane {
        Plane { origin, along: tangents(dim, normal), normal }
    }

    /// A face in the axes of the plane, with heights above it.
    pub(super) fn project<'a>(&self, face: &Face<'a>) -> Face<'a> {
        let mut seen = face.clone();
        for x in &mut seen.x[..face.kind.nodes()] {
            let from = *x - self.origin;
            let [along, across] = self.along.map(|along| along.dot(&from));
            *x = Vector3::new(along, across, self.normal.dot(&from));
        }
        seen
    }

    /// The point of a face on the normal through the plane's origin, with its height above the plane; `None` if that misses
    /// the face.
    pub(super) fn meeting(&self, face: &Face<'_>) -> Option<(Local, f64)> {
        let flat = self.flatten(face);
        let at = flat.local([0.0; 2]).filter(|&at| face.kind.holds(at))?;
        Some((at, flat.at(at)[0].z))
    }

    /// Projects a face.
    pub(super) fn flatten<'a>(&self, face: &Face<'a>) -> Flat<'a> {
        Flat::new(self.project(face))
    }
}

/// Where a mid node stands off its straight edge by more than this share of it, the outline follows the edge. Where it does not, a
/// strip of two thirds of this counts for the neighbour.
pub(super) const MOST_SAG: f64 = 5e-4;

/// Most pairs of straight lines in the place of a curved edge: beyond, the other face is a sliver.
const MOST_PARTS: f64 = 16.0;

/// Makes a polygon the outline of a projected face, turning to the left, or an interval that ascends. Of curved edges it has points
/// that are no further from each other than `longest`, and `bent` the places between two of these, in the middle.
pub(super) fn outline(
    face: &Face<'_>,
    longest: f64,
    polygon: &mut Vec<Point>,
    bent: &mut Vec<[Point; 3]>,
) {
    let Face { kind, x, .. } = face;
    polygon.clear();
    bent.clear();
    let mut mids = kind.mids().filter(|_| !kind.is_line());
    for corner in 0..kind.corners() {
        polygon.push([x[corner].x, x[corner].y]);
        let Some((mid, ends)) = mids.next().filter(|(mid, ends)| sag(x, *mid, *ends) > MOST_SAG)
        else {
            continue;
        };
        let [a, b] = ends.map(|end| x[end]);
        let parts = 2.0 * (2.0 * (b - a).norm() / longest).ceil().clamp(1.0, MOST_PARTS);
        let at = |t: f64| {
            let place = (1.0 - t) * (1.0 - 2.0 * t) * a + 4.0 * t * (1.0 - t) * x[mid];
            let place = place + t * (2.0 * t - 1.0) * b;
            [place.x, place.y]
        };
        for part in 0..parts as usize {
            let [from, between, to] = [0.0, 0.5, 1.0].map(|c| at((part as f64 + c) / parts));
            polygon.extend((part > 0).then_some(from));
            bent.push([from, between, to]);
        }
    }
    clip::turn_left(polygon);
}

/// A projected face.
#[derive(Clone, Debug)]
pub(super) struct Flat<'a> {
    /// The face in the axes of the plane, with heights above it.
    pub(super) face: Face<'a>,
    /// The face that the corners span: this one, if its edges are straight.
    pub(super) corners: Bilinear,
    curved: Option<Curved>,
}

impl<'a> Flat<'a> {
    /// The geometry of a projected face.
    pub(super) fn new(face: Face<'a>) -> Flat<'a> {
        let corners = Bilinear::new(&face);
        let curved = (!face.is_bilinear()).then(|| Curved::new(&face, &corners));
        Flat { corners, face, curved }
    }

    pub(super) fn is_curved(&self) -> bool {
        self.curved.is_some()
    }

    /// The polygon of the corners, moved away from their middle so far that it reaches beyond the mid nodes too, by a
    /// share of its size.
    pub(super) fn around(&self, share: f64) -> Vec<Point> {
        let Face { kind, x, .. } = &self.face;
        let corners = &x[..kind.corners()];
        let middle: Vector3 = corners.iter().sum::<Vector3>() / corners.len() as f64;
        let beyond = |(mid, [a, b]): (usize, [usize; 2])| {
            let edge = x[b] - x[a];
            let height = |x: Vector3| edge.x * (x.y - corners[a].y) - edge.y * (x.x - corners[a].x);
            -height(x[mid]) / height(middle)
        };
        let most = if kind.is_line() { 0.0 } else { kind.mids().map(beyond).fold(0.0, f64::max) };
        let moved = corners.iter().map(|x| x + (share + most) * (x - middle));
        let mut polygon: Vec<Point> = moved.map(|x| [x.x, x.y]).collect();
        clip::turn_left(&mut polygon);
        polygon
    }

    /// Local coordinates of the face's point above `p`, in closed form if its edges are straight and by Newton's
    /// method otherwise; `None` if there are none.
    pub(super) fn local(&self, p: Point) -> Option<Local> {
        match &self.curved {
            Some(curved) => curved.local(p, &self.corners),
            None => self.corners.local(p),
        }
    }

    /// [`Flat::local`] of a point on the face or around it: beyond a curved one, if there are none, on that which the corners span.
    pub(super) fn local_around(&self, p: Point) -> Option<Local> {
        let curved = self.curved.as_ref();
        let own = curved.and_then(|it| it.local_around(p, &self.corners, self.face.kind));
        own.or_else(|| self.corners.local(p))
    }

    /// [`Flat::local`] of all points of a block, in their places.
    #[inline(always)]
    pub(super) fn locals(&self, points: &mut [Block; 2], count: usize) -> Option<()> {
        match &self.curved {
            Some(curved) => curved.locals(points, count, &self.corners),
            None => self.corners.locals(points, count),
        }
    }

    /// [`Flat::at`] of all points of a block, each with its place in that.
    #[inline(always)]
    pub(super) fn each_at(
        &self,
        [s, t]: &[Block; 2],
        count: usize,
        mut then: impl FnMut(usize, [Vector3; 3]),
    ) {
        match self.curved {
            // Coefficients of its own stay in registers while the loop writes.
            Some(curved) => {
                for k in each(count) {
                    then(k, curved.at([s[k], t[k]]));
                }
            }
            None => {
                let corners = self.corners;
                for k in each(count) {
                    then(k, corners.at([s[k], t[k]]));
                }
            }
        }
    }

    /// How much derivatives change from the middle to a corner, relative to those in the middle: 0 where local
    /// coordinates are linear in the position, 1 where a corner may be straight.
    pub(super) fn distortion(&self) -> f64 {
        self.corners.distortion() + self.bending()
    }

    /// The part of the distortion that the face which the corners span does not have.
    pub(super) fn bending(&self) -> f64 {
        self.curved.map_or(0.0, |curved| curved.bending())
    }

    /// The largest slope that warp or curvature adds to that of the middle.
    pub(super) fn warp(&self) -> f64 {
        match &self.curved {
            Some(curved) => curved.lean,
            None => self.corners.warp(),
        }
    }

    /// How far mid nodes stand off their straight edges, relative to these, at most; zero on a line.
    pub(super) fn sag(&self) -> f64 {
        let Face { kind, x, .. } = &self.face;
        if !self.is_curved() || kind.is_line() {
            return 0.0;
        }
        kind.mids().map(|(mid, ends)| sag(x, mid, ends)).fold(0.0, f64::max)
    }

    /// The place in the axes of the plane, and derivatives by the local coordinates.
    #[inline(always)]
    pub(super) fn at(&self, at: Local) -> [Vector3; 3] {
        match &self.curved {
            Some(curved) => curved.at(at),
            None => self.corners.at(at),
        }
    }
}

/// How far a projected mid node stands off the straight edge between two corners, relative to that.
fn sag(x: &[Vector3], mid: usize, [a, b]: [usize; 2]) -> f64 {
    let (edge, from) = (x[b] - x[a], x[mid] - x[a]);
    (edge.x * from.y - edge.y * from.x).abs() / (edge.x * edge.x + edge.y * edge.y)
}
