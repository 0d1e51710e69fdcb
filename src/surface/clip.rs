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
