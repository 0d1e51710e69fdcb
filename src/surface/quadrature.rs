//! Rules of integration: Gauss and Legendre's on intervals, and on polygons by quadrilaterals, which take half the points
//! that triangles would. Areas have signs, so that polygons need not be convex.

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
/// polynomials of degree `2 n - 1` on an interval and `2 n - 2` on triangles. A polygon that is turned, or a mirror image,
/// has the points turned or mirrored, whichever corner its list begins with: a half model has those of the whole.
/// `rest` is memory for what is left of the polygon.
pub(super) fn points<'r>(
    polygon: &[Point],
    rest: &'r mut Vec<Point>,
    n: usize,
) -> impl Iterator<Item = (Point, f64)> + 'r {
    let rule = on_interval(n);
    rest.clear();
    rest.extend(polygon);
    let ends = (polygon.len() == 2).then(|| [polygon[0][0], polygon[1][0]]);
    let of_interval = ends.into_iter().flat_map(move |[from, to]| {
        let length = to - from;
        rule.iter().map(move |(s, share)| ([from + s * length, 0.0], share * length))
    });
    let parts = std::iter::from_fn(move || cut_off(rest));
    of_interval.chain(parts.flat_map(move |part| in_quadrilateral(part, rule)))
}

/// Cuts a part off a polygon: of an odd number of corners a triangle, otherwise a quadrilateral, along the shortest
/// line; the last part leaves nothing.
fn cut_off(polygon: &mut Vec<Point>) -> Option<[Point; 4]> {
    let count = polygon.len();
    let of_part = if count % 2 == 1 { 3 } else { 4 };
    if count < of_part {
        return None;
    }
    if count > of_part {
        let line = |k: usize| square(polygon[k], polygon[(k + of_part - 1) % count]);
        let shortest = (0..count).min_by(|k, l| line(*k).total_cmp(&line(*l)));
        polygon.rotate_left(shortest.unwrap_or_default());
    }
    let part = match of_part {
        3 => triangle([polygon[0], polygon[1], polygon[2]]),
        _ => [polygon[0], polygon[1], polygon[2], polygon[3]],
    };
    // Both ends of the line stay, if there is more.
    let cut = if count > of_part { 1..of_part - 1 } else { 0..count };
    polygon.drain(cut);
    Some(part)
}

/// A triangle as a quadrilateral of which two corners are one: the corner that faces the side which differs most from the
/// other two.
fn triangle(corners: [Point; 3]) -> [Point; 4] {
    let mut by_side = [0, 1, 2].map(|k| {
        let [a, b] = [corners[(k + 1) % 3], corners[(k + 2) % 3]];
        (square(a, b), [a, b, corners[k], corners[k]])
    });
    by_side.sort_by(|one, other| one.0.total_cmp(&other.0));
    let [short, middle, long] = by_side;
    if long.0 - middle.0 > middle.0 - short.0 { long.1 } else { short.1 }
}

/// The square of the distance of two points.
fn square(p: Point, q: Point) -> f64 {
    let [x, y] = [p[0] - q[0], p[1] - q[1]];
    x * x + y * y
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
