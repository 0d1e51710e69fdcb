//! The geometry of projected faces with straight edges: bilinear in the local coordinates whatever the
//! nodes between the corners, so that corners are enough; and how far it is from linear, which decides
//! how many points an integral needs.

use super::clip::Point;
use super::face::Face;
use super::shape::{Block, FaceKind, Local, each};
use crate::linalg::tolerances::FEW_OPERATIONS;
use crate::linalg::vector3::Vector3;

/// `x = c0 + c1 s + c2 t + c3 s t`, of both coordinates in the plane and of the height above it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bilinear {
    x: [[f64; 4]; 3],
    /// The parts of `c1` and of `c2` in a step in the plane: two rows.
    inverse: [Point; 2],
    /// The parts in `c3`: `c3 = bend[0] c1 + bend[1] c2`. Zero of parallelograms, triangles and lines.
    bend: [f64; 2],
}

/// The second coordinate of lines: their own, which is zero on them.
const ACROSS: [f64; 4] = [0.0, 0.0, 1.0, 0.0];

/// Coefficients of corner values.
fn coefficients(kind: FaceKind, corner: impl Fn(usize) -> f64) -> [f64; 4] {
    match kind.corners() {
        2 => [0.5 * (corner(0) + corner(1)), 0.5 * (corner(1) - corner(0)), 0.0, 0.0],
        3 => [corner(0), corner(1) - corner(0), corner(2) - corner(0), 0.0],
        _ => {
            let [a, b, c, d] = [0, 1, 2, 3].map(corner);
            [a + b + c + d, b + c - a - d, c + d - a - b, a + c - b - d].map(|sum| 0.25 * sum)
        }
    }
}

impl Bilinear {
    /// Local coordinates as the places in the plane.
    pub(super) const LOCAL: Bilinear = Bilinear {
        x: [[0.0, 1.0, 0.0, 0.0], ACROSS, [0.0; 4]],
        inverse: [[1.0, 0.0], [0.0, 1.0]],
        bend: [0.0; 2],
    };

    /// Through the corners of a face in the axes of a plane.
    pub(super) fn new(face: &Face<'_>) -> Bilinear {
        let along = |c: usize| coefficients(face.kind, |corner| face.x[corner][c]);
        let across = if face.kind.is_line() { ACROSS } else { along(1) };
        let x = [along(0), across, along(2)];
        let [[_, x1, x2, x3], [_, y1, y2, y3], _] = x;
        let area = x1 * y2 - x2 * y1;
        let inverse = [[y2 / area, -x2 / area], [-y1 / area, x1 / area]];
        let bend = inverse.map(|row| row[0] * x3 + row[1] * y3);
        Bilinear { x, inverse, bend }
    }

    /// Local coordinates of a point of the plane; `None` where the face does not reach it.
    ///
    /// With `[a, b]` the bend and `[S, T]` the coordinates that a parallelogram would give,
    /// `S = s + a s t` and `T = t + b s t`. The quadratic equations for `s` and for `t` share the
    /// discriminant `(1 + b S - a T)² + 4 a T`, which is the square of the Jacobian there relative to that in the
    /// middle, `1 + b s + a t`. Its positive root is the one of the sheet that the middle is on. Both sums below are
    /// then `2 (1 + b s)` or `2 (1 + a t)`, positive in a convex face: nothing cancels, whatever the bend.
    pub(super) fn local(&self, p: Point) -> Option<Local> {
        let at = self.on_parallelogram(p);
        let at = if self.bend == [0.0; 2] { at } else { self.bent(at) };
        (at[0].is_finite() && at[1].is_finite()).then_some(at)
    }

    /// [`Bilinear::local`] of all points of a block, in their places.
    #[inline(always)]
    pub(super) fn locals(&self, p: &mut [Block; 2], count: usize) -> Option<()> {
        for k in each(count) {
            [p[0][k], p[1][k]] = self.on_parallelogram([p[0][k], p[1][k]]);
        }
        if self.bend != [0.0; 2] {
            for k in each(count) {
                [p[0][k], p[1][k]] = self.bent([p[0][k], p[1][k]]);
            }
        }
        let mut are_finite = true;
        for k in each(count) {
            are_finite &= p[0][k].is_finite() & p[1][k].is_finite();
        }
        are_finite.then_some(())
    }

    #[inline(always)]
    fn on_parallelogram(&self, p: Point) -> Local {
        let from = [p[0] - self.x[0][0], p[1] - self.x[1][0]];
        self.inverse.map(|row| row[0] * from[0] + row[1] * from[1])
    }

    /// Local coordinates from those that a parallelogram would give.
    #[inline(always)]
    fn bent(&self, [s, t]: Local) -> Local {
        let (along, across) = (self.bend[0] * t, self.bend[1] * s);
        let skew = across - along;
        let square = (1.0 + skew) * (1.0 + skew) + 4.0 * along;
        // At a corner that is straight it is zero but for rounding.
        let least = -2.0 * FEW_OPERATIONS * (1.0 + skew * skew);
        let jacobian = if square < 0.0 && square >= least { 0.0 } else { square.sqrt() };
        [2.0 * s / (1.0 - skew + jacobian), 2.0 * t / (1.0 + skew + jacobian)]
    }

    /// The place, and derivatives by the local coordinates.
    #[inline(always)]
    pub(super) fn at(&self, [s, t]: Local) -> [Vector3; 3] {
        let place = self.x.map(|[c0, c1, c2, c3]| c0 + c1 * s + (c2 + c3 * s) * t);
        let along = self.x.map(|[_, c1, _, c3]| c1 + c3 * t);
        let across = self.x.map(|[_, _, c2, c3]| c2 + c3 * s);
        [place, along, across].map(Vector3::from)
    }

    /// The place in the plane.
    pub(super) fn place(&self, at: Local) -> Point {
        let [place, ..] = self.at(at);
        [place.x, place.y]
    }

    /// The area of a unit of local coordinates in the plane; negative of a face that is turned over.
    #[inline(always)]
    pub(super) fn area(&self, at: Local) -> f64 {
        let [[_, x1, x2, _], [_, y1, y2, _], _] = self.x;
        (x1 * y2 - x2 * y1) * (1.0 + self.bend[1] * at[0] + self.bend[0] * at[1])
    }

    /// The change of both derivatives with the other coordinate.
    pub(super) fn twist(&self) -> Vector3 {
        Vector3::from(self.x.map(|[.., twist]| twist))
    }

    /// How much the area of a unit of local coordinates changes from the middle to a corner, relative to that
    /// in the middle: 0 on parallelograms, 1 where a corner is straight. Lines have 0.
    pub(super) fn distortion(&self) -> f64 {
        self.bend[0].abs() + self.bend[1].abs()
    }

    /// The largest slope that the warp of the face adds to those of its plane.
    pub(super) fn warp(&self) -> f64 {
        let [x, y, [.., warp]] = self.x;
        let area = x[1] * y[2] - x[2] * y[1];
        let sides = x[1].hypot(y[1]) + x[2].hypot(y[2]);
        if warp == 0.0 { 0.0 } else { (warp * sides / area).abs() }
    }
}
