//! The geometry of projected faces with straight edges: bilinear in the local coordinates whatever the
//! nodes between the corners, so that corners are enough; and how far it is from linear, which decides
//! how many points an integral needs.

use super::clip::Point;
use super::shape::{FaceKind, Local};

/// A square this much below zero is zero: the rounding of its terms.
const ZERO: f64 = 16.0 * f64::EPSILON;

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
    /// Through corners with these points and heights.
    pub(super) fn new(kind: FaceKind, points: &[Point], heights: &[f64]) -> Bilinear {
        let along = |c: usize| coefficients(kind, |corner| points[corner][c]);
        let across = if kind.is_line() { ACROSS } else { along(1) };
        let x = [along(0), across, coefficients(kind, |corner| heights[corner])];
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
        let from = [p[0] - self.x[0][0], p[1] - self.x[1][0]];
        let [s, t] = self.inverse.map(|row| row[0] * from[0] + row[1] * from[1]);
        let (along, across) = (self.bend[0] * t, self.bend[1] * s);
        let skew = across - along;
        let square = (1.0 + skew) * (1.0 + skew) + 4.0 * along;
        // At a corner that is straight it is zero but for rounding.
        let least = -ZERO * (1.0 + skew * skew);
        let jacobian = if square < 0.0 && square >= least { 0.0 } else { square.sqrt() };
        let at = [2.0 * s / (1.0 - skew + jacobian), 2.0 * t / (1.0 + skew + jacobian)];
        (at[0].is_finite() && at[1].is_finite()).then_some(at)
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
    #[cfg(test)]
    fn point(&self, at: Local) -> (Point, [Point; 2]) {
        let [a, b] = [self.slopes(0, at), self.slopes(1, at)];
        ([self.value(0, at), self.value(1, at)], [[a[0], b[0]], [a[1], b[1]]])
    }

    /// The height above the plane.
    pub(super) fn height(&self, at: Local) -> f64 {
        self.value(2, at)
    }

    /// The area of the face over a unit of area of the plane. The slopes of the height by the two coordinates of
    /// the plane are those by `s` and `t` times the inverse of the Jacobian.
    pub(super) fn stretch(&self, at: Local) -> f64 {
        let [x, y, rise] = [0, 1, 2].map(|c| self.slopes(c, at));
        let area = x[0] * y[1] - x[1] * y[0];
        let slopes = [rise[0] * y[1] - rise[1] * y[0], rise[1] * x[0] - rise[0] * x[1]];
        let [s, t] = slopes.map(|slope| slope / area);
        (1.0 + s * s + t * t).sqrt()
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

#[cfg(test)]
mod tests {
    use fastrand::Rng;

    use super::{Bilinear, FaceKind, Local, Point};

    fn bilinear(kind: FaceKind, points: &[Point]) -> Bilinear {
        Bilinear::new(kind, points, &[0.0; 4][..points.len()])
    }

    /// Twice the signed area of a triangle.
    fn turn(a: Point, b: Point, c: Point) -> f64 {
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    }

    /// The least Jacobian of the corners relative to that of the middle: 1 on parallelograms, 0 where a corner is
    /// straight.
    fn convexity(points: &[Point; 4]) -> f64 {
        let corner = |i: usize| turn(points[(i + 3) % 4], points[i], points[(i + 1) % 4]);
        let whole: f64 = (0..4).map(corner).sum();
        (0..4).map(|i| 4.0 * corner(i) / whole).fold(f64::INFINITY, f64::min)
    }

    fn maps(points: &[Point; 4], at: Local) {
        let face = bilinear(FaceKind::Q4, points);
        let (p, [a, b]) = face.point(at);
        let found = face.local(p).unwrap();
        // A rounding of the position, of an epsilon of its length, moves local coordinates by the
        // inverse of the Jacobian; no method does better.
        let size = points.iter().flatten().fold(0.0_f64, |size, x| size.max(x.abs()));
        let sides = a[0].hypot(a[1]) + b[0].hypot(b[1]);
        let condition = size * sides / (a[0] * b[1] - a[1] * b[0]).abs();
        // Some thirty roundings on the way forth and back.
        let tolerance = 32.0 * f64::EPSILON * condition;
        let error = (found[0] - at[0]).abs().max((found[1] - at[1]).abs());
        assert!(error <= tolerance, "{points:?}, {at:?}: {error:e} of {tolerance:e}");
    }

    /// Places of a face: its corners and middle, and some between.
    fn places(rng: &mut Rng) -> Vec<Local> {
        let mut places =
            vec![[0.0, 0.0], [-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [1.0, 0.0]];
        places.extend((0..10).map(|_| [2.0 * rng.f64() - 1.0, 2.0 * rng.f64() - 1.0]));
        places
    }

    /// Convex quadrilaterals of any shape down to corners that are straight but for 1e-3, seen from either side,
    /// near the origin and ten sizes away.
    #[test]
    fn points_of_convex_quadrilaterals_are_found_again() {
        let rng = &mut Rng::with_seed(1);
        let mut near_straight = 0;
        for _ in 0..20_000 {
            let away = if rng.bool() { 10.0 } else { 0.0 };
            let mut points = [[0; 2]; 4].map(|p| p.map(|_: i32| away + rng.f64()));
            let convex = convexity(&points);
            if !(convex > 1e-3) {
                continue;
            }
            near_straight += i32::from(convex < 1e-2);
            if rng.bool() {
                points.reverse();
            }
            places(rng).into_iter().for_each(|at| maps(&points, at));
        }
        assert!(near_straight > 10);
    }

    /// Parallelograms, trapezia along either coordinate, triangles whose fourth corner stands on an edge but for a
    /// little, needles; a bend of 1e-300 and one of a rounding.
    #[test]
    fn points_of_special_quadrilaterals_are_found_again() {
        let rng = &mut Rng::with_seed(2);
        let mut faces = vec![
            [[0.0, 0.0], [2.0, 0.5], [2.5, 2.0], [0.5, 1.5]],
            [[0.0, 0.0], [3.0, 0.0], [2.0, 1.0], [1.5, 1.0]],
            [[0.0, 0.0], [1.0, 0.5], [1.0, 1.0], [0.0, 2.0]],
            [[0.0, 0.0], [1.0, 0.0], [0.5 + 1e-9, 0.5], [0.0, 1.0]],
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1e-6], [0.0, 2e-6]],
            [[0.0, 0.0], [1e-300, 0.0], [1.0, 1.0], [0.0, 1.0]],
            [[0.0, 0.0], [1.0, 0.0], [1.0 + f64::EPSILON, 1.0], [0.0, 1.0]],
        ];
        // From the corner in the middle of an edge on, only the other places have local coordinates.
        for face in &mut faces {
            for at in places(rng) {
                let (_, [a, b]) = bilinear(FaceKind::Q4, face).point(at);
                if (a[0] * b[1] - a[1] * b[0]).abs() > 0.0 {
                    maps(face, at);
                }
            }
        }
    }

    /// Triangles and lines are linear: one product for each coordinate.
    #[test]
    fn points_of_linear_faces_are_found_again() {
        let triangle = bilinear(FaceKind::T3, &[[1.0, 1.0], [3.0, 1.5], [0.5, 2.0]]);
        let line = bilinear(FaceKind::Line2, &[[1.0, 0.0], [3.0, 0.0]]);
        for (face, at) in [(triangle, [0.25, 0.5]), (line, [0.75, 0.0])] {
            let found = face.local(face.point(at).0).unwrap();
            assert!((0..2).all(|c| (found[c] - at[c]).abs() < 4.0 * f64::EPSILON), "{found:?}");
        }
    }

    /// Outside of a face that is bent there are points that no local coordinates have: behind the line that the
    /// edges envelop. A face that is seen along an edge has none at all.
    #[test]
    fn points_without_local_coordinates_are_not_found() {
        let trapezium = [[0.0, 0.0], [2.0, 0.0], [1.5, 1.0], [0.5, 1.0]];
        assert_eq!(bilinear(FaceKind::Q4, &trapezium).local([1.0, 2.0]), None);
        let flat = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [0.0, 0.0]];
        assert_eq!(bilinear(FaceKind::Q4, &flat).local([0.5, 0.0]), None);
    }
}
