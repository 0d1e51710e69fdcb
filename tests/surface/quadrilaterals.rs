//! Nodes above quadrilaterals with straight edges, of any convex shape: the weights of each are the shape functions at
//! the place that it stands above.

use crate::surfaces::{Shape, Sheet, TwoSheets};
use fastrand::Rng;
use signorini::surface::{
    Faces, Master, Pairing, SurfacePairs, SurfaceSettings, Surfaces, pair_surfaces,
};

type Point = [f64; 2];

/// The shape function of a corner with its slopes.
fn shape(corner: usize, [s, t]: Point) -> [f64; 3] {
    let [a, b] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]][corner];
    let (along, across) = (1.0 + a * s, 1.0 + b * t);
    [0.25 * along * across, 0.25 * a * across, 0.25 * b * along]
}

/// The point at local coordinates, and its derivatives by them.
fn point(corners: &[Point; 4], at: Point) -> [Point; 3] {
    let sum = |part: usize, c: usize| (0..4).map(|i| shape(i, at)[part] * corners[i][c]).sum();
    [0, 1, 2].map(|part| [sum(part, 0), sum(part, 1)])
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

/// Places of a face: its corners and middle, and some between.
fn places(rng: &mut Rng) -> Vec<Point> {
    let mut places =
        vec![[0.0, 0.0], [-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [1.0, 0.0]];
    places.extend((0..10).map(|_| [2.0 * rng.f64() - 1.0, 2.0 * rng.f64() - 1.0]));
    rng.shuffle(&mut places);
    places
}

/// The pairs of triangles with their corners above these points, each triangle one higher than that before, and of the
/// quadrilateral, whose nodes are the first four.
fn pairs(corners: &[Point; 4], triangles: &[[Point; 3]]) -> SurfacePairs {
    let turns_right =
        turn(corners[0], corners[1], corners[2]) + turn(corners[0], corners[2], corners[3]);
    let master = if turns_right > 0.0 { [0, 1, 2, 3] } else { [3, 2, 1, 0] };
    let mut coordinates: Vec<f64> = corners.iter().flat_map(|p| [p[0], p[1], 0.0]).collect();
    let (mut nodes, mut start) = (Vec::new(), vec![0]);
    for (k, triangle) in triangles.iter().enumerate() {
        let first = 4 + 3 * k;
        coordinates.extend(triangle.iter().flat_map(|p| [p[0], p[1], 1.0 + k as f64]));
        // They look down.
        let looks_up = turn(triangle[0], triangle[1], triangle[2]) > 0.0;
        nodes.extend(if looks_up {
            [first, first + 2, first + 1]
        } else {
            [first, first + 1, first + 2]
        });
        start.push(nodes.len());
    }
    let surfaces = Surfaces {
        dim: 3,
        coordinates: &coordinates,
        slave: Faces { start: &start, nodes: &nodes },
        master: Master::Faces(Faces { start: &[0, 4], nodes: &master }),
    };
    let settings = SurfaceSettings {
        pairing: Pairing::NodeToSurface,
        search_distance: Some(100.0),
        ..SurfaceSettings::default()
    };
    pair_surfaces(&surfaces, &settings, &mut crate::surfaces::unlimited()).unwrap()
}

/// Checks the weights of nodes above some places; returns how many were checked.
fn check(corners: &[Point; 4], rng: &mut Rng) -> usize {
    let places = places(rng);
    let above = |at: &Point| point(corners, *at)[0];
    let has_area = |three: &&[Point]| {
        let [a, b, c] = [0, 1, 2].map(|i| above(&three[i]));
        // Far above what a triangle needs to be one.
        turn(a, b, c).abs() > 1e-6
    };
    let chosen: Vec<&[Point]> = places.chunks_exact(3).filter(has_area).collect();
    let triangles: Vec<[Point; 3]> =
        chosen.iter().map(|three| [0, 1, 2].map(|i| above(&three[i]))).collect();
    let found = pairs(corners, &triangles);
    let size = corners.iter().flatten().fold(0.0_f64, |size, x| size.max(x.abs()));
    let mut checked = 0;
    for (k, at) in chosen.iter().flat_map(|three| three.iter()).enumerate() {
        let [_, a, b] = point(corners, *at);
        // A rounding of the position, of an epsilon of its length and height, moves local coordinates by the inverse of
        // the Jacobian; no method does better.
        let sides = a[0].hypot(a[1]) + b[0].hypot(b[1]);
        let condition = (size + 10.0) * sides / (a[0] * b[1] - a[1] * b[0]).abs();
        // Some thirty roundings on the way forth and back.
        let tolerance = 32.0 * f64::EPSILON * condition;
        // On the rim a node may miss the face by rounding, which is taken for 1e-9 at most.
        if !(tolerance < 1e-9) {
            continue;
        }
        let pair = found.pairs.iter().find(|pair| pair.slave == 4 + k);
        let pair = pair.unwrap_or_else(|| panic!("{corners:?}: no pair above {at:?}"));
        for corner in 0..4 {
            let given = pair.masters().iter().find(|(node, _)| *node == corner);
            let given = given.map_or(0.0, |(_, weight)| *weight);
            let error = (given - shape(corner, *at)[0]).abs();
            assert!(error <= tolerance, "{corners:?}, {at:?}: {error:e} of {tolerance:e}");
        }
        checked += 1;
    }
    checked
}

/// Convex quadrilaterals of any shape down to corners that are straight but for 1e-3, in either order, near the origin
/// and ten sizes away.
#[test]
fn weights_are_shape_functions_on_convex_quadrilaterals() {
    let rng = &mut Rng::with_seed(1);
    let (mut near_straight, mut checked) = (0, 0);
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
        checked += check(&points, rng);
    }
    assert!(near_straight > 10 && checked > 20_000, "{near_straight}, {checked}");
}

/// Parallelograms, trapezia along either coordinate, triangles whose fourth corner stands on an edge but for a
/// little, needles; a bend of a rounding.
#[test]
fn weights_are_shape_functions_on_special_quadrilaterals() {
    let rng = &mut Rng::with_seed(2);
    let faces = [
        [[0.0, 0.0], [2.0, 0.5], [2.5, 2.0], [0.5, 1.5]],
        [[0.0, 0.0], [3.0, 0.0], [2.0, 1.0], [1.5, 1.0]],
        [[0.0, 0.0], [1.0, 0.5], [1.0, 1.0], [0.0, 2.0]],
        [[0.0, 0.0], [1.0, 0.0], [0.5 + 1e-9, 0.5], [0.0, 1.0]],
        [[0.0, 0.0], [1.0, 0.0], [1.0, 1e-3], [0.0, 2e-3]],
        [[0.0, 0.0], [1.0, 0.0], [1.0 + f64::EPSILON, 1.0], [0.0, 1.0]],
    ];
    for face in &faces {
        assert!((0..10).map(|_| check(face, rng)).sum::<usize>() > 20, "{face:?}");
    }
}

/// Beside a face that is bent there are points that no local coordinates have: behind the line that the edges envelop.
#[test]
fn points_without_local_coordinates_have_no_pair() {
    let trapezium = [[0.0, 0.0], [2.0, 0.0], [1.5, 1.0], [0.5, 1.0]];
    let found = pairs(&trapezium, &[[[1.0, 2.0], [1.0, 0.5], [1.2, 0.5]]]);
    assert_eq!(found.unpaired, [4]);
}

/// A curved face with a corner of 164 degrees, as meshers leave them beside a circle: its area is positive everywhere, but its
/// local coordinates turn back shortly beyond that corner. It is refused, and told why.
#[test]
fn a_face_with_a_corner_that_is_nearly_straight_is_told() {
    let at = [
        [0.199, 0.0],
        [0.0, 0.0],
        [-0.162, -0.034],
        [0.132, -0.1165],
        [0.1, 0.0],
        [-0.0813, -0.017],
        [-0.0151, -0.076],
        [0.1659, -0.0584],
    ];
    let slave = Sheet {
        nodes: at.iter().map(|p| [p[0], p[1], 0.0]).collect(),
        faces: vec![(0..8).collect()],
    };
    let flat =
        Sheet::rectangle(Shape::Q4, [1; 2], [[-0.3, 0.3]; 2], (0.0, &mut Rng::with_seed(31)));
    let sheets = TwoSheets::new(3, slave, flat.turned().mapped(|[x, y, _]| [x, y, 0.1]));
    let error = sheets.pair(&SurfaceSettings::default()).unwrap_err().to_string();
    let says = "slave face 0 cannot be projected on master face 0: ";
    assert!(
        error.starts_with(says) && error.contains("a corner that is nearly straight"),
        "{error}"
    );
}
