//! The common part of two convex polygons of a plane, or of two intervals of a line.

/// A point of the auxiliary plane; on a line the second coordinate is zero.
pub(super) type Point = [f64; 2];

/// Twice the signed area of the triangle `a b c`: positive if it turns to the left.
fn turn(a: Point, b: Point, c: Point) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// The area of a polygon that turns to the left, the length of an interval.
pub(super) fn measure(polygon: &[Point]) -> f64 {
    if let [a, b] = polygon {
        return b[0] - a[0];
    }
    let fan = polygon.windows(2).skip(1);
    fan.map(|side| 0.5 * turn(polygon[0], side[0], side[1])).sum()
}

/// Makes a polygon turn to the left, an interval ascend.
pub(super) fn turn_left(polygon: &mut [Point]) {
    if measure(polygon) < 0.0 {
        polygon.reverse();
    }
}

/// The common part of two polygons, in memory that the next one uses again.
#[derive(Debug, Default)]
pub(super) struct Clipper {
    polygon: Vec<Point>,
    left: Vec<Point>,
}

impl Clipper {
    /// The part of a polygon in a convex one, both of which turn to the left (Sutherland and Hodgman 1974), or the common
    /// part of two intervals that ascend. It is empty if they touch in an edge or a point. Of a polygon that is not
    /// convex it may have edges upon each other, between which there is no area.
    pub(super) fn common_part(&mut self, subject: &[Point], window: &[Point]) -> &[Point] {
        self.polygon.clear();
        if let ([a, b], [c, d]) = (subject, window) {
            let ends = [a[0].max(c[0]), b[0].min(d[0])];
            if ends[0] < ends[1] {
                self.polygon.extend(ends.map(|s| [s, 0.0]));
            }
            return &self.polygon;
        }
        self.polygon.extend(subject);
        let mut from = window[window.len() - 1];
        for &to in window {
            self.keep_left_of(from, to);
            from = to;
        }
        // Two corners are a common edge, and would be taken for an interval.
        if self.polygon.len() > 2 { &self.polygon } else { &[] }
    }

    /// Keeps the part of the polygon to the left of a line.
    fn keep_left_of(&mut self, from: Point, to: Point) {
        let Some(&last) = self.polygon.last() else {
            return;
        };
        self.left.clear();
        let (mut a, mut before) = (last, turn(from, to, last));
        for &b in &self.polygon {
            let here = turn(from, to, b);
            if (before > 0.0 && here < 0.0) || (before < 0.0 && here > 0.0) {
                let part = before / (before - here);
                self.left.push([a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])]);
            }
            if here >= 0.0 {
                self.left.push(b);
            }
            (a, before) = (b, here);
        }
        std::mem::swap(&mut self.polygon, &mut self.left);
    }
}

#[cfg(test)]
mod tests {
    use super::{Clipper, Point, measure};

    /// Squares shifted along both axes and turned: areas by elementary geometry.
    #[test]
    fn areas_of_common_parts() {
        let clipper = &mut Clipper::default();
        let mut common_part = |a: &[Point], b: &[Point]| clipper.common_part(a, b).to_vec();
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        for shift in [[0.25, 0.5], [-0.25, 0.125], [0.0, 0.0], [1.5, 0.0], [0.0, 1.0]] {
            let other = square.map(|p| [p[0] + shift[0], p[1] + shift[1]]);
            let side = |s: f64| (1.0 - s.abs()).max(0.0);
            let exact = side(shift[0]) * side(shift[1]);
            assert!((measure(&common_part(&square, &other)) - exact).abs() < 1e-16);
        }
        // A square on its corner with the half diagonal 3/4 around the centre: four corners cut off,
        // right-angled with the height 1/4.
        let turned = [[1.25, 0.5], [0.5, 1.25], [-0.25, 0.5], [0.5, -0.25]];
        let exact = 2.0 * 0.75 * 0.75 - 4.0 * 0.0625;
        assert!((measure(&common_part(&square, &turned)) - exact).abs() < 1e-15);
        assert!((measure(&common_part(&turned, &square)) - exact).abs() < 1e-15);
        let interval = common_part(&[[0.0, 0.0], [2.0, 0.0]], &[[1.5, 0.0], [3.0, 0.0]]);
        assert_eq!(interval, [[1.5, 0.0], [2.0, 0.0]]);
        assert!(common_part(&[[0.0, 0.0], [1.0, 0.0]], &[[1.0, 0.0], [3.0, 0.0]]).is_empty());
    }
}
