//! The geometry of projected faces whose mid nodes stand off the middles of their edges: polynomials of the local
//! coordinates, whose inverse Newton's method finds from the point that the corners alone give.

use super::bilinear::Bilinear;
use super::clip::Point;
use super::face::Face;
use super::shape::{Block, FaceKind, Local, MOST_NODES, each};
use crate::linalg::vector3::Vector3;

/// Steps of Newton's method to local coordinates. It converges by squares from the face that the corners span; the rest
/// is for faces at the limit of what is accepted.
const STEPS: usize = 40;

/// The error of local coordinates that a step of Newton's method may leave: a thousandth of what points of integration may.
const LAST: f64 = 1e-15;

/// Powers of a local coordinate.
pub(super) const POWERS: usize = 3;

/// `Σ c_ij s^i t^j`.
type Polynomial = [[f64; POWERS]; POWERS];

/// Positions as polynomials, and how far these are from linear.
#[derive(Clone, Copy, Debug)]
pub(super) struct Curved {
    x: [Polynomial; 3],
    centre: Local,
    /// How much the derivatives change from the middle to a corner, relative to those in the middle.
    change: f64,
    /// The part of it that the face which the corners span does not have.
    bend: f64,
    /// The largest slope against the plane at a corner.
    pub(super) lean: f64,
}

/// The second coordinate of lines: their own, which is zero on them.
const ACROSS: Polynomial = [[0.0, 1.0, 0.0], [0.0; 3], [0.0; 3]];

/// Through three values at -1, 1 and 0.
fn parabola(low: f64, high: f64, middle: f64) -> [f64; POWERS] {
    [middle, 0.5 * (high - low), 0.5 * (high + low) - middle]
}

/// The polynomial with these values at the nodes of a face.
fn polynomial(kind: FaceKind, at: impl Fn(usize) -> f64) -> Polynomial {
    if kind.is_line() {
        return parabola(at(0), at(1), at(2)).map(|c| [c, 0.0, 0.0]);
    }
    if kind.is_triangle() {
        let [a, b, c, ab, bc, ca] = [0, 1, 2, 3, 4, 5].map(at);
        let along = |end: f64, mid: f64| [4.0 * mid - 3.0 * a - end, 2.0 * (a + end) - 4.0 * mid];
        let ([s, ss], [t, tt]) = (along(b, ab), along(c, ca));
        return [[a, t, tt], [s, 4.0 * (a - ab + bc - ca), 0.0], [ss, 0.0, 0.0]];
    }
    let [a, b, c, d, ab, bc, cd, da] = [0, 1, 2, 3, 4, 5, 6, 7].map(&at);
    // With eight nodes the middle is where `s² t²` has no part.
    let middle = kind.central_node().map(at);
    let middle = middle.unwrap_or(0.5 * (ab + bc + cd + da) - 0.25 * (a + b + c + d));
    let rows = [parabola(a, b, ab), parabola(d, c, cd), parabola(da, bc, middle)];
    [0, 1, 2].map(|i| parabola(rows[0][i], rows[1][i], rows[2][i]))
}

/// A polynomial with its derivatives.
#[inline(always)]
fn evaluate(c: &Polynomial, [s, t]: Local) -> [f64; 3] {
    let value = |[c0, c1, c2]: &[f64; POWERS]| c0 + t * (c1 + t * c2);
    let slope = |[_, c1, c2]: &[f64; POWERS]| c1 + 2.0 * t * c2;
    let ([low, mid, high], [a, b, c]) =
        ([value(&c[0]), value(&c[1]), value(&c[2])], [slope(&c[0]), slope(&c[1]), slope(&c[2])]);
    [low + s * (mid + s * high), mid + 2.0 * s * high, a + s * (b + s * c)]
}

impl Curved {
    /// Through the nodes of a face in the axes of a plane, with the face that its corners span.
    pub(super) fn new(face: &Face<'_>, corners: &Bilinear) -> Curved {
        let along = |c: usize| polynomial(face.kind, |node| face.x[node][c]);
        let across = if face.kind.is_line() { ACROSS } else { along(1) };
        let x = [along(0), across, along(2)];
        let centre = face.kind.centre();
        let mut curved = Curved { x, centre, change: 0.0, bend: 0.0, lean: 0.0 };
        curved.measure(face.kind, corners.twist());
        curved.change = curved.bend + corners.distortion();
        curved
    }

    /// Compares derivatives at the corners, without what they have by a twist, with those in the middle: of a triangle along the edges from each corner, so that it does
    /// not matter at which its list of nodes begins.
    fn measure(&mut self, kind: FaceKind, twist: Vector3) {
        let mut at_centre = self.slopes(kind.centre());
        let mut slopes = [at_centre; MOST_NODES];
        let at_corners = &mut slopes[..kind.corners()];
        for (slopes, corner) in at_corners.iter_mut().zip(kind.places()) {
            *slopes = self.slopes(*corner);
            let [c, d] = *slopes;
            let normal = c.cross(&d);
            self.lean = self.lean.max(normal.x.hypot(normal.y) / normal.z.abs());
            *slopes = [c - corner[1] * twist, d - corner[0] * twist];
        }
        let from_next_corner = |[a, b]: [Vector3; 2]| [b - a, -a];
        for _ in 0..if kind.is_triangle() { kind.corners() } else { 1 } {
            let [a, b] = at_centre;
            let area = a.cross(&b).z;
            for [c, d] in at_corners.iter_mut() {
                let (e, f) = (*c - a, *d - b);
                let steps = [e.cross(&b).z, a.cross(&e).z, f.cross(&b).z, a.cross(&f).z];
                let [es, et, fs, ft] = steps.map(|step| (step / area).abs());
                self.bend = self.bend.max(es + fs).max(et + ft);
                [*c, *d] = from_next_corner([*c, *d]);
            }
            at_centre = from_next_corner(at_centre);
        }
    }

    /// Derivatives by the local coordinates.
    fn slopes(&self, at: Local) -> [Vector3; 2] {
        let [_, a, b] = self.at(at);
        [a, b]
    }

    /// Local coordinates of a point of the plane, from those on the face that the corners span; `None` if there are none.
    /// Of a strongly curved face the corners may lead away from them.
    pub(super) fn local(&self, p: Point, corners: &Bilinear) -> Option<Local> {
        let near = corners.local(p).and_then(|near| self.newton(p, near));
        near.or_else(|| self.newton(p, self.centre))
    }

    /// [`Curved::local`] of a point on the face or around it. Polynomials turn back beyond it, and lead to a point on another sheet:
    /// there the face goes on with the derivatives that it has at the nearest of its points.
    pub(super) fn local_around(
        &self,
        p: Point,
        corners: &Bilinear,
        kind: FaceKind,
    ) -> Option<Local> {
        let is_on_sheet = |at: &Local| {
            let nearest = kind.nearest(*at);
            let beyond = (at[0] - nearest[0]).abs().max((at[1] - nearest[1]).abs());
            beyond == 0.0 || beyond < 1.0 && self.area(*at) * self.area(self.centre) > 0.0
        };
        let found = self.local(p, corners)?;
        if is_on_sheet(&found) {
            return Some(found);
        }
        let mut at = corners.local(p).unwrap_or(self.centre);
        for _ in 0..STEPS {
            at = kind.nearest(at);
            self.step(p, &mut at);
        }
        at.iter().all(|c| c.is_finite()).then_some(at)
    }

    /// The area of a unit of local coordinates in the plane.
    fn area(&self, at: Local) -> f64 {
        let [a, b] = self.slopes(at);
        a.x * b.y - b.x * a.y
    }

    fn newton(&self, p: Point, mut at: Local) -> Option<Local> {
        (0..STEPS).any(|_| self.step(p, &mut at)).then_some(at)
    }

    /// [`Curved::local`] of all points of a block, in their places.
    #[inline(always)]
    pub(super) fn locals(
        &self,
        points: &mut [Block; 2],
        count: usize,
        corners: &Bilinear,
    ) -> Option<()> {
        let from = *points;
        let mut steps = if corners.locals(points, count).is_some() { 0..STEPS } else { 0..0 };
        while steps.next().is_some() {
            let mut are_last = true;
            for k in each(count) {
                let mut at = [points[0][k], points[1][k]];
                are_last &= self.step([from[0][k], from[1][k]], &mut at);
                [points[0][k], points[1][k]] = at;
            }
            if are_last {
                return Some(());
            }
        }
        // One of them begins better elsewhere.
        for k in each(count) {
            [points[0][k], points[1][k]] = self.local([from[0][k], from[1][k]], corners)?;
        }
        Some(())
    }

    /// A step of Newton's method; `true` if it is the last.
    #[inline(always)]
    fn step(&self, p: Point, at: &mut Local) -> bool {
        let [x, a, b] = evaluate(&self.x[0], *at);
        let [y, c, d] = evaluate(&self.x[1], *at);
        let from = [x - p[0], y - p[1]];
        let inverse = 1.0 / (a * d - b * c);
        let step = [(from[0] * d - b * from[1]) * inverse, (a * from[1] - from[0] * c) * inverse];
        *at = [at[0] - step[0], at[1] - step[1]];
        // The error that remains is of the order of its square, by the change of the derivatives.
        let length = step[0].abs().max(step[1].abs());
        self.change * length * length <= LAST
    }

    /// The place, and derivatives by the local coordinates.
    #[inline(always)]
    pub(super) fn at(&self, at: Local) -> [Vector3; 3] {
        let [x, y, z] = &self.x;
        let [x, y, z] = [evaluate(x, at), evaluate(y, at), evaluate(z, at)];
        std::array::from_fn(|c| Vector3::new(x[c], y[c], z[c]))
    }

    /// As [`Bilinear::distortion`], beyond that of the corners: the inverse of `s + e s² / 2` is analytic up to the distance `1 / 2 e` from the
    /// middle, half as far as that of a bilinear face.
    pub(super) fn bending(&self) -> f64 {
        2.0 * self.bend
    }
}
