//! What two convex polygons of a plane, or two intervals of a line, have in common.

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

/// The common part of two convex polygons that turn to the left (Sutherland and Hodgman 1974), or of
/// two intervals that ascend. It is empty if they touch in an
/// edge or a point.
pub(super) fn common_part(subject: &[Point], window: &[Point]) -> Vec<Point> {
    if let ([a, b], [c, d]) = (subject, window) {
        let ends = [a[0].max(c[0]), b[0].min(d[0])];
        let some = ends[0] < ends[1];
        return if some { ends.map(|s| [s, 0.0]).to_vec() } else { Vec::new() };
    }
    let mut polygon = subject.to_vec();
    for (i, &from) in window.iter().enumerate() {
        let to = window[(i + 1) % window.len()];
        polygon = left_of(&polygon, from, to);
    }
    // Two corners are a common edge, and would be taken for an interval.
    if polygon.len() > 2 { polygon } else { Vec::new() }
}

/// The part of a convex polygon to the left of a line.
fn left_of(polygon: &[Point], from: Point, to: Point) -> Vec<Point> {
    let mut left = Vec::with_capacity(polygon.len() + 1);
    for (i, &b) in polygon.iter().enumerate() {
        let a = polygon[(i + polygon.len() - 1) % polygon.len()];
        let (before, here) = (turn(from, to, a), turn(from, to, b));
        if (before > 0.0 && here < 0.0) || (before < 0.0 && here > 0.0) {
            let part = before / (before - here);
            left.push([a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])]);
        }
        if here >= 0.0 {
            left.push(b);
        }
    }
    left
}

#[cfg(test)]
mod tests {
    use super::{common_part, measure};

    /// Squares shifted along both axes and turned: areas by elementary geometry.
    #[test]
    fn areas_of_common_parts() {
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
