//! Rules of integration: Gauss and Legendre's on intervals, and collapsed onto triangles.

use std::sync::LazyLock;

/// Steps of Newton's method to a root of a Legendre polynomial: from the usual start, whose error is
/// below 1e-2, four reach the last digit.
const STEPS: usize = 8;

/// Most points of a rule along a direction.
pub(super) const MOST_POINTS: usize = 9;

/// Barycentric coordinates of a point with its weight. On an interval the third is zero, and the second is
/// the place in 0..1.
pub(super) type RulePoint = ([f64; 3], f64);

/// A rule on a triangle; zeros behind its points.
type OnTriangle = [RulePoint; MOST_POINTS * MOST_POINTS];

/// The rules, by the number of points along a direction: every face asks for them. They stand in
/// arrays, as memory of a static would be lost when a host unloads the library.
static INTERVALS: LazyLock<[[RulePoint; MOST_POINTS]; MOST_POINTS + 1]> =
    LazyLock::new(|| std::array::from_fn(interval));
static TRIANGLES: LazyLock<[OnTriangle; MOST_POINTS + 1]> =
    LazyLock::new(|| std::array::from_fn(triangle));

/// Points of 0..1 and weights that sum to 1, exact for polynomials of degree `2 n - 1`.
pub(super) fn on_interval(n: usize) -> &'static [RulePoint] {
    &INTERVALS[n][..n]
}

/// Barycentric coordinates of points of a triangle and weights that sum to 1: an interval's rule in
/// both directions, one of them collapsed to a corner. Exact for polynomials of degree `2 n - 2`.
pub(super) fn on_triangle(n: usize) -> &'static [RulePoint] {
    &TRIANGLES[n][..n * n]
}

/// A rule of `n` points; zeros behind them.
fn interval(n: usize) -> [RulePoint; MOST_POINTS] {
    let mut points = [([0.0; 3], 0.0); MOST_POINTS];
    for (i, point) in points[..n].iter_mut().enumerate() {
        let order = n as f64;
        let mut x = -(std::f64::consts::PI * (i as f64 + 0.75) / (order + 0.5)).cos();
        for _ in 0..STEPS {
            let (value, slope) = legendre(n, x);
            x -= value / slope;
        }
        let (_, slope) = legendre(n, x);
        let place = 0.5 * (1.0 + x);
        *point = ([1.0 - place, place, 0.0], 1.0 / ((1.0 - x * x) * slope * slope));
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

/// A rule of `n * n` points; zeros behind them.
fn triangle(n: usize) -> OnTriangle {
    let rule = interval(n);
    let mut points = [([0.0; 3], 0.0); MOST_POINTS * MOST_POINTS];
    for (i, point) in points[..n * n].iter_mut().enumerate() {
        let (([_, s, _], a), ([_, t, _], b)) = (rule[i / n], rule[i % n]);
        let across = (1.0 - s) * t;
        *point = ([1.0 - s - across, s, across], 2.0 * a * b * (1.0 - s));
    }
    points
}
