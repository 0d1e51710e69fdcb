//! Gaps between true shapes: geometry in closed form.

use crate::surfaces::{SHAPES, Shape, Sheet, TwoSheets, line, pair};
use fastrand::Rng;
use signorini::surface::{Obstacle, Pairing, SurfaceSettings, TrueShape};

type Point = [f64; 3];

/// The distance between the shapes of the two sides.
const APART: f64 = 0.01;

/// A shape, and the map of a square of -0.5 ... 0.5 onto it, both as far out of the shape's own place as is said.
type Curved = fn(f64) -> (Obstacle, Box<dyn Fn(Point) -> Point>);

fn sphere(out: f64) -> (Obstacle, Box<dyn Fn(Point) -> Point>) {
    let radius = 2.0 + out;
    let place = move |[x, y, _]: Point| {
        let length = (x * x + y * y + 1.0).sqrt();
        [x, y, 1.0].map(|x| radius * x / length)
    };
    (Obstacle::Sphere { centre: [0.0; 3], radius, hollow: false }, Box::new(place))
}

fn cylinder(out: f64) -> (Obstacle, Box<dyn Fn(Point) -> Point>) {
    let radius = 1.0 + out;
    let place = move |[x, y, _]: Point| [radius * x.sin(), y, radius * x.cos()];
    let (point, axis) = ([0.0, 3.0, 0.0], [0.0, 2.0, 0.0]);
    (Obstacle::Cylinder { point, axis, radius, hollow: true }, Box::new(place))
}

/// Of 45 degrees about the axis x = 0 = z, with its apex at y = -2 beside `out`.
fn cone(out: f64) -> (Obstacle, Box<dyn Fn(Point) -> Point>) {
    let apex = -2.0 - 2.0_f64.sqrt() * out;
    let place = move |[x, y, _]: Point| [(y - apex) * x.sin(), y, (y - apex) * x.cos()];
    let (point, to_apex) = ([0.0, 1.0, 0.0], [0.0, apex - 1.0, 0.0]);
    (Obstacle::Cone { point, to_apex, radius: 1.0 - apex, hollow: false }, Box::new(place))
}

/// The outside of a ring about the axis y.
fn torus(out: f64) -> (Obstacle, Box<dyn Fn(Point) -> Point>) {
    let radius = 1.0 + out;
    let place = move |[x, y, _]: Point| {
        let around = 3.0 + radius * y.cos();
        [around * x.sin(), radius * y.sin(), around * x.cos()]
    };
    let (centre, axis) = ([0.0; 3], [0.0, 1.0, 0.0]);
    (Obstacle::Torus { centre, axis, radius, ring: 3.0, hollow: false }, Box::new(place))
}

const CURVED: [Curved; 4] = [sphere, cylinder, cone, torus];

/// Faces of a kind on the inner of two shapes, distorted, and of another one on the outer, which covers more.
fn sheets(curved: Curved, [slave, master]: [Shape; 2], rng: &mut Rng) -> TwoSheets {
    let inner = Sheet::rectangle(slave, [2, 3], [[-0.4, 0.4]; 2], (0.2, rng));
    let outer = Sheet::rectangle(master, [3, 4], [[-0.5, 0.5]; 2], (0.2, rng)).turned();
    TwoSheets::new(3, inner.mapped(curved(0.0).1), outer.mapped(curved(APART).1))
}

/// Shapes at a constant distance have it as the gap of every pair, whatever their faces. To 1e-12: a few thousand
/// roundings, as functions of quadratic faces that are covered in part are hundreds at a node.
#[test]
fn exact_shapes_have_their_own_distance() {
    let rng = &mut Rng::with_seed(11);
    for (curved, kind) in CURVED.into_iter().flat_map(|c| SHAPES.map(|kind| (c, kind))) {
        let other = SHAPES[rng.usize(..SHAPES.len())];
        let sheets = sheets(curved, [kind, other], rng);
        let shapes = [0.0, APART].map(|out| TrueShape::Exact(curved(out).0));
        let found = sheets.pair(&SurfaceSettings { shapes, ..Default::default() }).unwrap();
        assert!(found.unpaired.len() <= found.report.folded.len() && found.pairs.len() >= 12);
        for pair in &found.pairs {
            let context = format!("{:?}, {kind:?} under {other:?}", shapes[0]);
            assert!((pair.gap - APART).abs() < 1e-12, "{context}: {}", pair.gap);
        }
        // Rows are those of the faces.
        let faces = sheets.pair(&SurfaceSettings::default()).unwrap();
        for (a, b) in found.pairs.iter().zip(&faces.pairs) {
            assert_eq!(a, &signorini::surface::SurfacePair { gap: a.gap, ..b.clone() });
        }
    }
}

/// Lines and faces that are flat have the gaps that they have without a shape, if the shape is given for one side or for
/// both. To a hundred roundings.
#[test]
fn flat_faces_have_the_gaps_of_their_plane() {
    let rng = &mut Rng::with_seed(12);
    let planes = [0.0, 0.25].map(|z| {
        TrueShape::Exact(Obstacle::Plane { point: [4.0, 1.0, z], outward: [0.0, 0.0, -3.0] })
    });
    for (slave, master) in SHAPES.into_iter().flat_map(|s| SHAPES.map(|m| (s, m))) {
        let below = Sheet::rectangle(slave, [3, 2], [[0.0, 1.0]; 2], (0.2, rng));
        let above = Sheet::rectangle(master, [2, 2], [[0.2, 1.1]; 2], (0.2, rng)).turned();
        let sheets = TwoSheets::new(3, below, above.mapped(|[x, y, _]| [x, y, 0.25]));
        let facets = TrueShape::Facets;
        for shapes in [planes, [facets, planes[1]], [planes[0], facets]] {
            let found = sheets.pair(&SurfaceSettings { shapes, ..Default::default() }).unwrap();
            for pair in &found.pairs {
                assert!((pair.gap - 0.25).abs() < 1e-14, "{slave:?}, {master:?}: {}", pair.gap);
            }
        }
    }
}

/// Small gaps become zero, then all of them are shifted.
#[test]
fn gaps_are_closed_and_then_shifted() {
    let (mut nodes, slave) = line(&[0.0, 1.0], false, 0);
    // The master leans: gaps 0.1 and -0.02 at its ends.
    nodes.extend([[0.0, -0.1, 0.0], [1.0, 0.02, 0.0]]);
    let gaps = |pairing, close_within, clearance| {
        let settings = SurfaceSettings { pairing, close_within, clearance, ..Default::default() };
        let found = pair(2, &nodes, [&slave, &[vec![3, 2]]], &settings).unwrap();
        [0, 1].map(|i| found.pairs[i].gap)
    };
    let near = |a: [f64; 2], b: [f64; 2]| (0..2).all(|i| (a[i] - b[i]).abs() < 1e-15);
    for pairing in [Pairing::DualMortar, Pairing::NodeToSurface] {
        assert!(near(gaps(pairing, 0.0, 0.0), [0.1, -0.02]));
        assert!(near(gaps(pairing, 0.05, 0.0), [0.1, 0.0]));
        assert!(near(gaps(pairing, 0.05, -0.3), [-0.2, -0.3]));
        assert!(near(gaps(pairing, f64::INFINITY, 0.5), [0.5, 0.5]));
    }
}

/// What is wrong with a shape, and where, is said.
#[test]
fn shapes_that_do_not_fit_are_refused() {
    let rng = &mut Rng::with_seed(13);
    let sheets = sheets(cylinder, [Shape::Q4; 2], rng);
    let refused = |settings: &SurfaceSettings| sheets.pair(settings).unwrap_err().to_string();
    let of_slave = |shape| SurfaceSettings {
        shapes: [TrueShape::Exact(shape), TrueShape::Facets],
        ..Default::default()
    };
    let far = Obstacle::Plane { point: [0.0, 0.0, 5.0], outward: [0.0, 0.0, 1.0] };
    let says = "shape of the slave: node 0 of face 0 is further away from it than the face is long";
    assert_eq!(refused(&of_slave(far)), says);
    let flat = Obstacle::Cylinder { point: [0.0; 3], axis: [0.0; 3], radius: 1.0, hollow: false };
    assert_eq!(refused(&of_slave(flat)), "shape of the slave: its axis is zero or not finite");
    let thick =
        Obstacle::Torus { centre: [0.0; 3], axis: [1.0; 3], radius: 2.0, ring: 1.0, hollow: false };
    let says = "shape of the slave: its radius is 2, it must be less than that of the ring, 1";
    assert_eq!(refused(&of_slave(thick)), says);
    let settings = SurfaceSettings { pairing: Pairing::NodeToSurface, ..of_slave(far) };
    assert!(refused(&settings).starts_with("true shapes are for dual mortar"));
    for (close_within, clearance) in [(-1.0, 0.0), (f64::NAN, 0.0), (0.0, f64::INFINITY)] {
        let settings = SurfaceSettings { close_within, clearance, ..Default::default() };
        assert!(refused(&settings).starts_with("close_within is "));
    }
}
