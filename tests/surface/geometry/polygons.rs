//! Areas and integrals over polygons, intervals and triangles.

use super::clip::{Clipper, Point, measure};
use super::quadrature::{MOST_POINTS, on_interval, points};

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

/// Integrals of powers: `1 / (k + 1)` on 0..1, `i! j! / (i + j + 2)!` on the unit triangle.
#[test]
fn powers_are_integrated() {
    let factorial = |n: usize| (1..=n).map(|k| k as f64).product::<f64>();
    let triangle = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    for n in 1..=MOST_POINTS {
        for k in 0..2 * n {
            let sum: f64 = on_interval(n).iter().map(|(x, w)| w * x.powi(k as i32)).sum();
            assert!((sum - 1.0 / (k as f64 + 1.0)).abs() < 1e-15, "{n}, {k}");
        }
        for i in 0..2 * n - 1 {
            for j in 0..2 * n - 1 - i {
                let power = |([s, t], w): (Point, f64)| w * s.powi(i as i32) * t.powi(j as i32);
                let sum: f64 = points(&triangle, &mut Vec::new(), n).map(power).sum();
                let exact = factorial(i) * factorial(j) / factorial(i + j + 2);
                assert!((sum - exact).abs() < 2e-15, "{n}, {i}, {j}");
            }
        }
    }
}

/// Moments `∫ x^i y^j` of an L of three unit squares, whose fan from a corner turns back: differences of those of
/// two rectangles, exact to the degree `2 n - 2`.
#[test]
fn moments_of_polygons_that_are_not_convex() {
    let l = [[1.0, 2.0], [0.0, 2.0], [0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0]];
    for (i, j) in (0..=4).flat_map(|i| (0..=4 - i).map(move |j| (i, j))) {
        let sum: f64 =
            points(&l, &mut Vec::new(), 3).map(|([x, y], area)| area * x.powi(i) * y.powi(j)).sum();
        let power = |from: f64, k: i32| (2.0_f64.powi(k) - from.powi(k)) / f64::from(k);
        let exact = power(0.0, i + 1) * power(0.0, j + 1) - power(1.0, i + 1) * power(1.0, j + 1);
        // Some fifty terms of the size of the sum.
        assert!((sum - exact).abs() < 1e-14 * exact, "{i}, {j}");
    }
}
