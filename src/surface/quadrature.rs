//! Rules of integration: Gauss and Legendre's on intervals, and on polygons by quadrilaterals from a corner, which take
//! half the points that triangles would. Areas have signs, so that polygons need not be convex.

use std::sync::LazyLock;

use super::clip::Point;

/// Steps of Newton's method to a root of a Legendre polynomial: from the usual start, whose error is
/// below 1e-2, four reach the last digit.
const STEPS: usize = 8;

/// Most points of a rule along a direction.
pub(super) const MOST_POINTS: usize = 18;

/// A place in 0..1 with its weight.
type RulePoint = (f64, f64);

/// The rules, by the number of points: every face asks for them. They stand in
/// arrays, as memory of a static would be lost when a host unloads the library.
static INTERVALS: LazyLock<[[RulePoint; MOST_POINTS]; MOST_POINTS + 1]> =
    LazyLock::new(|| std::array::from_fn(interval));

/// Points of 0..1 and weights that sum to 1, exact for polynomials of degree `2 n - 1`.
pub(super) fn on_interval(n: usize) -> &'static [RulePoint] {
    &INTERVALS[n][..n]
}

/// A rule of `n` points; zeros behind them.
fn interval(n: usize) -> [RulePoint; MOST_POINTS] {
    let mut points = [(0.0, 0.0); MOST_POINTS];
    for (i, point) in points[..n].iter_mut().enumerate() {
        let order = n as f64;
        let mut x = -(std::f64::consts::PI * (i as f64 + 0.75) / (order + 0.5)).cos();
        for _ in 0..STEPS {
            let (value, slope) = legendre(n, x);
            x -= value / slope;
        }
        let (_, slope) = legendre(n, x);
        *point = (0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope));
    }
    points
}

/// The Legendre polynomial of degree `n` with its derivative, inside of -1..1.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut last, mut value) = (1.0, x);
    for k in 2..=n {
        let k = k as f64;
        (last, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * last) / k);
    }
    (value, n as f64 * (x * value - last) / (x * x - 1.0))
}

/// Points of a polygon, or of an interval, with their areas: `n` along each direction of a part. They are exact for
/// polynomials of degree `2 n - 1` on an interval and `2 n - 2` on triangles.
pub(super) fn points(polygon: &[Point], n: usize) -> impl Iterator<Item = (Point, f64)> {
    let rule = on_interval(n);
    let last = polygon.len() - 1;
    let length = polygon[1][0] - polygon[0][0];
    let along = move |(s, share): &RulePoint| ([polygon[0][0] + s * length, 0.0], share * length);
    let of_interval = if last == 1 { rule } else { &[] }.iter().map(along);
    // Two corners of a part are one if it is a triangle.
    let part =
        move |k: usize| [last, k, k + 1, (k + 2).min(last - 1)].map(|corner| polygon[corner]);
    let of_parts = (0..last - 1).step_by(2).flat_map(move |k| in_quadrilateral(part(k), rule));
    of_interval.chain(of_parts)
}

/// Points of a quadrilateral with their areas.
fn in_quadrilateral(
    [a, b, c, d]: [Point; 4],
    rule: &[RulePoint],
) -> impl Iterator<Item = (Point, f64)> {
    rule.iter().flat_map(move |&(s, v)| {
        // From the side between `a` and `b` across to that between `d` and `c`.
        let (from, to) = (between(a, b, s), between(d, c, s));
        let across = [to[0] - from[0], to[1] - from[1]];
        rule.iter().map(move |&(t, w)| {
            let along = |i: usize| (1.0 - t) * (b[i] - a[i]) + t * (c[i] - d[i]);
            let area = v * w * (along(0) * across[1] - along(1) * across[0]);
            (between(from, to, t), area)
        })
    })
}

/// The point at the share `s` of the way from `p` to `q`.
fn between(p: Point, q: Point, s: f64) -> Point {
    [p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1])]
}
