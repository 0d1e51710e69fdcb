//! The geometry of projected faces with straight edges: bilinear in the local coordinates whatever the
//! nodes between the corners, so that corners are enough; and how far it is from linear, which decides
//! how many points an integral needs.

use super::clip::Point;
use super::shape::{FaceKind, Local};

/// `x = c0 + c1 s + c2 t + c3 s t`, of both coordinates in the plane and of the height above it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bilinear {
    x: [[f64; 4]; 3],
}

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
    /// Through corners with these points and heights.
    pub(super) fn new(kind: FaceKind, points: &[Point], heights: &[f64]) -> Bilinear {
        let along = |c: usize| coefficients(kind, |corner| points[corner][c]);
        Bilinear { x: [along(0), along(1), coefficients(kind, |corner| heights[corner])] }
    }

    fn value(&self, c: usize, [s, t]: Local) -> f64 {
        let [c0, c1, c2, c3] = self.x[c];
        c0 + c1 * s + (c2 + c3 * s) * t
    }

    fn slopes(&self, c: usize, [s, t]: Local) -> [f64; 2] {
        let [_, c1, c2, c3] = self.x[c];
        [c1 + c3 * t, c2 + c3 * s]
    }

    /// Position in the plane, and its derivatives by `s` and by `t`.
    pub(super) fn point(&self, at: Local) -> (Point, [Point; 2]) {
        let [a, b] = [self.slopes(0, at), self.slopes(1, at)];
        ([self.value(0, at), self.value(1, at)], [[a[0], b[0]], [a[1], b[1]]])
    }

    /// The height above the plane.
    pub(super) fn height(&self, at: Local) -> f64 {
        self.value(2, at)
    }

    /// Derivatives of the height by `s` and by `t`.
    pub(super) fn rise(&self, at: Local) -> [f64; 2] {
        self.slopes(2, at)
    }

    /// How much the area of a unit of local coordinates changes from the middle to a corner, relative to that
    /// in the middle: 0 on parallelograms, 1 where a corner is straight. Lines have 0.
    pub(super) fn distortion(&self) -> f64 {
        let [x, y, _] = self.x;
        let area = x[1] * y[2] - x[2] * y[1];
        let change = (x[1] * y[3] - x[3] * y[1]).abs() + (x[3] * y[2] - x[2] * y[3]).abs();
        if change > 0.0 { change / area.abs() } else { 0.0 }
    }

    /// The largest slope that the warp of the face adds to those of its plane.
    pub(super) fn warp(&self) -> f64 {
        let [x, y, [.., warp]] = self.x;
        let area = x[1] * y[2] - x[2] * y[1];
        let sides = x[1].hypot(y[1]) + x[2].hypot(y[2]);
        if warp == 0.0 { 0.0 } else { (warp * sides / area).abs() }
    }
}
