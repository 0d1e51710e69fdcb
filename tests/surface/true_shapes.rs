//! Gaps between true shapes: geometry in closed form.

use std::f64::consts::TAU;

use crate::surfaces::{SHAPES, Shape, Sheet, TwoSheets, line, pair};
use fastrand::Rng;
use signorini::surface::{Obstacle, Pairing, Sector, SurfaceSettings, SymmetryPlane, TrueShape};

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
            let (gap, measured_gap) = (a.gap, a.measured_gap);
            assert_eq!(a, &signorini::surface::SurfacePair { gap, measured_gap, ..b.clone() });
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

/// The images of a side have the images of its shape. Flat faces that meet a plane of symmetry at an angle, so that the whole is a
/// roof, or that meet their images in the sectors beside, so that it is a pyramid, touch everywhere if their planes are one. To a hundred
/// roundings.
#[test]
fn images_have_the_images_of_their_shapes() {
    let rng = &mut Rng::with_seed(31);
    let quarters = Sector { axis: [0.0, 0.0, 1.0], count: 4, ..Default::default() };
    for slope in [0.3, -0.3] {
        let roof = move |[x, y, _]: Point| [x, y, slope * (x + y)];
        let plane = Obstacle::Plane { point: [0.0; 3], outward: [slope, slope, -1.0] };
        let shapes = [TrueShape::Exact(plane), TrueShape::Exact(plane)];
        for (kind, other) in SHAPES.into_iter().flat_map(|s| SHAPES.map(|m| (s, m))) {
            let below = Sheet::rectangle(kind, [3; 2], [[0.0, 0.8]; 2], (0.0, rng));
            let above = Sheet::rectangle(other, [4; 2], [[0.0, 1.0]; 2], (0.0, rng)).turned();
            let sheets = TwoSheets::new(3, below.mapped(roof), above.mapped(roof));
            let planes = [0, 1].map(|axis| SymmetryPlane::across(axis, 0.0)).to_vec();
            for (symmetry, sector) in [(planes, None), (vec![], Some(quarters))] {
                let settings = SurfaceSettings { shapes, symmetry, sector, ..Default::default() };
                let found = sheets.pair(&settings).unwrap();
                assert!(found.unpaired.is_empty());
                for pair in &found.pairs {
                    let off = pair.gap.abs();
                    assert!(off < 2e-14, "{kind:?}, {other:?}, {slope}: {off:e}");
                }
            }
        }
    }
}

/// A shape that stands inside of a sector, or beside a plane of symmetry, is that of the model alone: a pin in a bore
/// has the gap of both radii, whatever image of it is near.
#[test]
fn shapes_inside_of_a_part_of_the_body_are_its_own() {
    let rng = &mut Rng::with_seed(32);
    let middle = [1.0, 0.6, 0.0];
    let bore = |out: f64, [around, along]: [usize; 2], rng: &mut Rng| {
        let flat =
            Sheet::rectangle(Shape::Q4, [around, along], [[0.0, TAU], [0.0, 1.0]], (0.0, rng));
        let (radius, [x0, y0, _]) = (0.3 + out, middle);
        let place =
            move |[angle, z, _]: Point| [x0 + radius * angle.cos(), y0 + radius * angle.sin(), z];
        closed(flat.mapped(place))
    };
    let shapes = [0.0, APART].map(|out| {
        let (radius, axis) = (0.3 + out, [0.0, 0.0, 1.0]);
        TrueShape::Exact(Obstacle::Cylinder { point: middle, axis, radius, hollow: out > 0.0 })
    });
    let sheets = TwoSheets::new(3, bore(0.0, [16, 2], rng), bore(APART, [24, 3], rng).turned());
    let plane = |axis, at| vec![SymmetryPlane::across(axis, at)];
    let around = Sector { axis: [0.0, 0.0, 1.0], count: 4, ..Default::default() };
    let beside = Sector { periods: [[0.7, 0.0, 0.0], [0.0; 3]], ..Default::default() };
    for (symmetry, sector) in [
        (plane(0, 0.68), None),
        (plane(1, 0.0), None),
        (plane(2, 0.0), None),
        (vec![], Some(around)),
        (vec![], Some(beside)),
        (plane(2, 0.0), Some(around)),
    ] {
        let settings = SurfaceSettings { shapes, symmetry, sector, ..Default::default() };
        let found = sheets.pair(&settings).unwrap();
        assert!(found.pairs.len() == 16 * 3, "{} pairs", found.pairs.len());
        for pair in &found.pairs {
            assert!((pair.gap - APART).abs() < 1e-12, "{:?}: {}", settings.symmetry, pair.gap);
        }
    }
}

/// Rows of equal triangles, 12 by 14, of the given step, with nodes inside moved by up to a fifth of it.
fn triangles(step: f64, rng: &mut Rng) -> Sheet {
    let (across, rows) = (12, 14);
    let mut sheet = Sheet::default();
    for j in 0..=rows {
        for i in 0..=across {
            let inside = i % across != 0 && j % rows != 0;
            let mut moved = || if inside { 0.2 * (2.0 * rng.f64() - 1.0) } else { 0.0 };
            let x = i as f64 - 0.5 * across as f64 + 0.25 * if j % 2 == 0 { 1.0 } else { -1.0 };
            let y = 0.75_f64.sqrt() * (j as f64 - 0.5 * rows as f64);
            sheet.nodes.push([step * (x + moved()), step * (y + moved()), 0.0]);
        }
    }
    for j in 0..rows {
        for i in 0..across {
            let [a, b] = [i + (across + 1) * j, i + (across + 1) * (j + 1)];
            sheet.faces.extend(match j % 2 {
                0 => [vec![a, a + 1, b + 1], vec![a, b + 1, b]],
                _ => [vec![a, a + 1, b], vec![a + 1, b + 1, b]],
            });
        }
    }
    sheet
}

/// How far faces are from the shape on which their nodes stand, fitted and as they are: the gaps that a fine mesh on a
/// shape beside it has.
/// `sheet`: of the coarse faces in the angles of the shape.
fn deviation(curved: Curved, sheet: Sheet, half: f64, rng: &mut Rng) -> [f64; 2] {
    off_shape(curved, sheet.turned().mapped(curved(0.0).1), half, rng)
}

/// The same, of coarse faces in space.
fn off_shape(curved: Curved, coarse: Sheet, half: f64, rng: &mut Rng) -> [f64; 2] {
    let fine = Sheet::rectangle(Shape::Q4, [16; 2], [[-half, half]; 2], (0.1, rng));
    let sheets = TwoSheets::new(3, fine.mapped(curved(-APART).1), coarse);
    [TrueShape::Fitted, TrueShape::Facets].map(|of_coarse| {
        let shapes = [TrueShape::Exact(curved(-APART).0), of_coarse];
        let found = sheets.pair(&SurfaceSettings { shapes, ..Default::default() }).unwrap();
        assert_eq!(found.pairs.len(), 17 * 17);
        found.pairs.iter().map(|pair| (pair.gap - APART).abs()).fold(0.0, f64::max)
    })
}

/// Triangles on a cylinder of the radius 1, away from the rim, also halves of squares that are cut by turns: 64 divisions
/// around it leave 1e-6, a twentieth of what a press fit of a thousandth bears. Twice as coarse ones leave at least 8 times as
/// much: the order is above 3.
#[test]
fn fitted_triangles_follow_a_cylinder() {
    let rng = &mut Rng::with_seed(14);
    for equal in [true, false, true, false, false] {
        let [coarse, fine] = [32.0, 64.0].map(|divisions| {
            let (step, half) = (TAU / divisions, 6.0 * TAU / divisions);
            let sheet = match equal {
                true => triangles(step, rng),
                false => Sheet::rectangle(Shape::T3, [12; 2], [[-half, half]; 2], (0.2, rng)),
            };
            deviation(cylinder, sheet, 3.0 * step, rng)[0]
        });
        assert!(fine < 1e-6 && fine < coarse / 8.0, "{equal}: {coarse:e}, {fine:e}");
    }
}

/// A part of a cylinder or a cone with free edges, on which nodes stand on one side: 64 divisions leave 2e-6 R up to these, also of
/// faces five times as long as wide, triangles cut by turns, nodes inside shifted by a fifth. `R`: the largest radius, of the cone that
/// at its end.
#[test]
fn fitted_free_edges_follow_cylinders_and_cones() {
    let rng = &mut Rng::with_seed(19);
    let step = TAU / 64.0;
    let cases: [(Curved, f64, f64); 4] =
        [(cylinder, 1.0, 0.0), (cylinder, 5.0, 0.0), (cylinder, 5.0, 0.2), (cone, 1.0, 0.0)];
    for (k, (curved, long, shifted)) in cases.into_iter().enumerate() {
        for (shape, across) in
            [Shape::T3, Shape::Q4].into_iter().flat_map(|s| [2, 15].map(|n| (s, n)))
        {
            let half = [0.5 * step * across as f64, 3.0 * long * step];
            let sides = half.map(|half| [-half, half]);
            let inner = Sheet::rectangle(shape, [across, 6], sides, (shifted, rng));
            let outer = half.map(|half| [-half - step, half + step]);
            let outer = Sheet::rectangle(Shape::Q4, [40, 10], outer, (0.0, rng)).turned();
            let (inner, outer) = (inner.mapped(curved(0.0).1), outer.mapped(curved(APART).1));
            let radius = inner.nodes.iter().map(|[x, _, z]| x.hypot(*z)).fold(0.0, f64::max);
            let sheets = TwoSheets::new(3, inner, outer);
            let shapes = [TrueShape::Fitted, TrueShape::Exact(curved(APART).0)];
            let found = sheets.pair(&SurfaceSettings { shapes, ..Default::default() }).unwrap();
            assert_eq!(found.pairs.len(), (across + 1) * 7);
            for pair in &found.pairs {
                let off = (pair.gap - APART).abs() / radius;
                assert!(off < 2e-6, "{k}, {shape:?}, {across}: {off:e} at {:?}", pair.point);
            }
        }
    }
}

/// One layer of linear faces around a cylinder, however it is turned: its nodes stand on two circles, which a pair of planes holds
/// too, so that they lie on many quadrics. To what triangles of this size leave.
#[test]
fn one_layer_of_faces_follows_a_cylinder() {
    let rng = &mut Rng::with_seed(18);
    let step = TAU / 64.0;
    for (shape, tilt) in
        [Shape::Q4, Shape::T3].into_iter().flat_map(|s| [0.0, 1e-4, 0.7].map(|t| (s, t)))
    {
        let around = |radius: f64| {
            move |[angle, along, _]: Point| {
                let [x, y, z] = [radius * angle.sin(), along, radius * angle.cos()];
                let [sin, cos] = [f64::sin(tilt), f64::cos(tilt)];
                [cos * x - sin * y, sin * x + cos * y, z]
            }
        };
        let mut sheet = |half: f64, along: [f64; 2]| {
            let sides = [[-half * step, half * step], along];
            Sheet::rectangle(shape, [2 * half as usize, 1], sides, (0.0, rng))
        };
        let (inner, outer) = (sheet(12.0, [0.0, 0.5]), sheet(14.0, [-0.1, 0.6]));
        let (inner, outer) =
            (inner.mapped(around(1.0)), outer.turned().mapped(around(1.0 + APART)));
        let sheets = TwoSheets::new(3, inner, outer);
        let shapes = [TrueShape::Fitted; 2];
        let found = sheets.pair(&SurfaceSettings { shapes, ..Default::default() }).unwrap();
        // Away from the ends, where there are nodes on both sides.
        for pair in found.pairs.iter().filter(|pair| pair.point[2] > (8.0 * step).cos()) {
            assert!((pair.gap - APART).abs() < 1e-6, "{shape:?}, {tilt}: {}", pair.gap);
        }
    }
}

/// Gaps of fitted triangles do not depend on where the lists of their nodes begin, although points of integration do: at 13 and
/// 40 divisions of a circle, to 1e-9 of what the chords of the 13 stand off it.
#[test]
fn fitted_triangles_begin_anywhere() {
    let around = |[x, y, z]: Point| [x.sin() * (1.0 + z), y, x.cos() * (1.0 + z)];
    for coarse_is_slave in [false, true] {
        let gaps = |turns: usize| {
            let mut rng = Rng::with_seed(18);
            let mut sheet = |divisions: f64, cells: usize| {
                let half = 0.5 * TAU / divisions * cells as f64;
                let sides = [[-half, half], [0.0, 0.5]];
                let sheet = Sheet::rectangle(Shape::T3, [cells, 2], sides, (0.1, &mut rng));
                let mut sheet = sheet.mapped(around);
                sheet.faces.iter_mut().for_each(|face| face.rotate_left(turns));
                sheet
            };
            let (coarse, fine) = (sheet(13.0, 6), sheet(40.0, 14));
            let sheets = match coarse_is_slave {
                true => TwoSheets::new(3, coarse, fine.turned()),
                false => TwoSheets::new(3, fine, coarse.turned()),
            };
            let settings = SurfaceSettings { shapes: [TrueShape::Fitted; 2], ..Default::default() };
            let found = sheets.pair(&settings).unwrap();
            found.pairs.iter().map(|pair| pair.gap).collect::<Vec<f64>>()
        };
        let sagitta = 1.0 - (0.5 * TAU / 13.0).cos();
        let [first, other, third] = [0, 1, 2].map(gaps);
        for ((a, b), c) in first.iter().zip(&other).zip(&third) {
            let most = (a - b).abs().max((a - c).abs());
            assert!(most < 1e-9 * sagitta, "{coarse_is_slave}: {most:e}");
        }
    }
}

/// Distorted faces of every kind on every shape, at 60 divisions of the smaller radius: curved, linear ones are nearer to it
/// by a factor of 20 at least, and quadratic ones, which are near it as they are, are not twice as far.
#[test]
fn fitted_faces_follow_curved_shapes() {
    let rng = &mut Rng::with_seed(15);
    let step = 0.1;
    for (k, curved) in CURVED.into_iter().enumerate() {
        for kind in [Shape::T3, Shape::Q4, Shape::T6, Shape::Q8, Shape::Q9] {
            let half = 4.0 * step;
            let sheet = Sheet::rectangle(kind, [8; 2], [[-half, half]; 2], (0.2, rng));
            let [fitted, facets] = deviation(curved, sheet, 0.7 * half, rng);
            let context = format!("{kind:?} on {k}: {fitted:.1e}, facets {facets:.1e}");
            let factor = if matches!(kind, Shape::T3 | Shape::Q4) { 20.0 } else { 0.5 };
            assert!(factor * fitted < facets, "{context}");
        }
    }
}

/// Linear faces of a ring at 24 divisions of either circle, four times as long as wide where they are outside: curved, they are nearer to it
/// by a factor of 60 at least, as places nearby count more than those a long face away.
#[test]
fn fitted_long_faces_follow_a_torus() {
    let rng = &mut Rng::with_seed(31);
    let half = 4.0 * TAU / 24.0;
    for kind in [Shape::T3, Shape::Q4] {
        let sheet = Sheet::rectangle(kind, [8; 2], [[-half, half]; 2], (0.0, rng));
        let [fitted, facets] = deviation(torus, sheet, 0.5 * half, rng);
        assert!(60.0 * fitted < facets, "{kind:?}: {fitted:e}, {facets:e}");
    }
}

/// Faces whose mid nodes stand on chords are as far from the shape as those of their corners alone, to some thousand roundings: nearer
/// than chords by a factor of 20 at least.
#[test]
fn fitted_faces_with_mid_nodes_on_chords_follow_curved_shapes() {
    let rng = &mut Rng::with_seed(25);
    let half = 0.4;
    for (k, curved) in CURVED.into_iter().enumerate() {
        for kind in [Shape::T6, Shape::Q8, Shape::Q9, Shape::Full] {
            let sheet = Sheet::rectangle(kind, [8; 2], [[-half, half]; 2], (0.2, rng));
            let coarse = sheet.turned().mapped(curved(0.0).1).straightened();
            let mut corners = coarse.clone();
            corners
                .faces
                .iter_mut()
                .for_each(|face| face.truncate(if face.len() == 6 { 3 } else { 4 }));
            let mut again = rng.clone();
            let [fitted, facets] = off_shape(curved, coarse, 0.7 * half, rng);
            let [of_corners, _] = off_shape(curved, corners, 0.7 * half, &mut again);
            let context = format!("{kind:?} on {k}: {fitted:e}, {of_corners:e}, {facets:e}");
            assert!((fitted - of_corners).abs() < 1e-12 && 20.0 * fitted < facets, "{context}");
        }
    }
}

/// Faces with mid nodes follow shapes up to free edges: halving their sides divides gaps by more than the square, and 12 faces along the
/// radius of the shape, or fewer, leave less than a fiftieth of an interference of a thousandth.
#[test]
fn fitted_faces_with_mid_nodes_follow_shapes_to_their_edges() {
    let rng = &mut Rng::with_seed(21);
    for (k, curved) in CURVED.into_iter().enumerate() {
        for kind in [Shape::T6, Shape::Q8, Shape::Q9] {
            let [coarse, fine] = [6, 12].map(|cells| {
                let inner = Sheet::rectangle(kind, [cells; 2], [[-0.5, 0.5]; 2], (0.0, rng));
                let outer = Sheet::rectangle(Shape::Q4, [20; 2], [[-0.6, 0.6]; 2], (0.0, rng));
                let outer = outer.turned().mapped(curved(APART).1);
                let sheets = TwoSheets::new(3, inner.mapped(curved(0.0).1), outer);
                let shapes = [TrueShape::Fitted, TrueShape::Exact(curved(APART).0)];
                let found = sheets.pair(&SurfaceSettings { shapes, ..Default::default() }).unwrap();
                assert_eq!(found.unpaired.len(), found.report.folded.len());
                found.pairs.iter().map(|pair| (pair.gap - APART).abs()).fold(0.0, f64::max)
            });
            assert!(fine < coarse / 4.0 && fine < 2e-5, "{kind:?} on {k}: {coarse:e}, {fine:e}");
        }
    }
}

/// Nearly flat faces, one of them with a short edge, whose patches end far away where they are continued: feet are looked for next to
/// where facets meet, so that gaps are those of facets to a tenth of the length of a face.
#[test]
fn patches_are_not_continued_far_away() {
    let with_short_edge = [
        vec![[0.0, 0.08072, 0.02938], [0.0, 0.526587, 0.027954], [0.414857, 0.433582, 0.03439]],
        vec![
            [-0.1, 0.229291, 0.028178],
            [-0.1, 0.339558, 0.028704],
            [-0.095571, 0.344778, 0.028842],
            [0.262488, 0.333975, 0.036928],
            [-0.1, 0.284424, 0.028628],
            [-0.097785, 0.342168, 0.028774],
            [0.083459, 0.339376, 0.033981],
            [0.081244, 0.281633, 0.034322],
        ],
    ];
    let with_few = [
        vec![
            [0.842166, 0.585229, 0.057159],
            [0.794539, 0.35566, -0.01927],
            [0.965218, 0.458329, 0.004988],
            [1.0, 0.691365, 0.082621],
            [0.847473, 0.671273, 0.088032],
            [1.0, 0.697779, 0.083943],
            [1.0, 0.699693, 0.084318],
        ],
        vec![
            [1.004213, 0.59378, 0.052142],
            [0.570175, 0.678359, 0.028137],
            [1.006047, 0.835528, 0.083168],
            [0.717343, 0.418849, -0.007379],
        ],
    ];
    let faces = [
        [vec![vec![1, 0, 2]], vec![vec![0, 1, 2, 3, 4, 5, 6, 7]]],
        [
            vec![vec![0, 1, 2], vec![3, 4, 0, 2], vec![5, 4, 3], vec![5, 6, 4]],
            vec![vec![0, 1, 2], vec![3, 1, 0]],
        ],
    ];
    for (nodes, faces) in [with_short_edge, with_few].into_iter().zip(faces) {
        let [slave, master] =
            std::array::from_fn(|k| Sheet { nodes: nodes[k].clone(), faces: faces[k].clone() });
        let sheets = TwoSheets::new(3, slave, master);
        let gaps = [TrueShape::Facets, TrueShape::Fitted].map(|shape| {
            let settings = SurfaceSettings { shapes: [shape; 2], ..Default::default() };
            sheets.pair(&settings).unwrap().pairs.iter().map(|pair| pair.gap).collect::<Vec<f64>>()
        });
        assert!(!gaps[0].is_empty() && gaps[0].len() == gaps[1].len());
        for (facets, fitted) in gaps[0].iter().zip(&gaps[1]) {
            assert!((facets - fitted).abs() < 0.1 * 0.35, "{facets}, {fitted}");
        }
    }
}

/// A prism of a half circle and two flat sides that meet in a sharp edge, although they are one smooth surface around the
/// circle: the sides stay flat up to the edge, and to where all nodes of two
/// rows of faces around stand on them. To a hundred roundings.
#[test]
fn a_sharp_edge_parts_a_surface_that_is_smooth_around_it() {
    const SIDE: usize = 8;
    let round = 24;
    // Tangents of the circle at 30 degrees to its axis x meet at x = 2.
    let (tip, from) = ([2.0, 0.0], TAU / 6.0);
    let at = |angle: f64| [angle.cos(), angle.sin()];
    let between = |[a, b]: [[f64; 2]; 2], t: f64| [0, 1].map(|c| a[c] + t * (b[c] - a[c]));
    let place = |[u, v, _]: Point| {
        let along = u / SIDE as f64;
        let on_circle = (u - SIDE as f64) / round as f64;
        let [x, y] = match on_circle {
            t if t < 0.0 => between([tip, at(from)], along),
            t if t <= 1.0 => at(from + t * (TAU - 2.0 * from)),
            _ => between([at(-from), tip], along - 1.0 - round as f64 / SIDE as f64),
        };
        [x, y, v]
    };
    let rng = &mut Rng::with_seed(22);
    for kind in [Shape::T3, Shape::Q4, Shape::T6, Shape::Q8, Shape::Q9] {
        let all = 2 * SIDE + round;
        let sides = [[0.0, all as f64], [0.0, 1.0]];
        let prism = closed(Sheet::rectangle(kind, [all, 3], sides, (0.0, rng)).mapped(place));
        let plate = Sheet::rectangle(Shape::Q4, [6, 3], [[0.1, 5.9], [0.1, 0.9]], (0.0, rng));
        let sheets = TwoSheets::new(3, plate.turned().mapped(place), prism);
        let shapes = [TrueShape::Facets, TrueShape::Fitted];
        let found = sheets.pair(&SurfaceSettings { shapes, ..Default::default() }).unwrap();
        assert_eq!(found.pairs.len(), 7 * 4);
        for pair in &found.pairs {
            assert!(pair.gap.abs() < 1e-13, "{kind:?}: {:e} at {:?}", pair.gap, pair.point);
        }
    }
}

/// A sheet whose nodes at one place are one.
fn closed(mut sheet: Sheet) -> Sheet {
    let is_same = |a: &Point, b: &Point| (0..3).all(|c| (a[c] - b[c]).abs() < 1e-9);
    let nodes = sheet.nodes.clone();
    let first = |node: usize| nodes.iter().position(|other| is_same(other, &nodes[node]));
    for node in sheet.faces.iter_mut().flatten() {
        *node = first(*node).expect("the node itself");
    }
    sheet
}

/// Flat faces of every kind are their own curved ones, and a sharp edge stays: gaps are those of the faces to a hundred
/// roundings.
#[test]
fn fitted_flat_faces_are_flat() {
    let rng = &mut Rng::with_seed(16);
    let bent = |[x, y, _]: Point| [x.min(0.5), y, -(x - 0.5).max(0.0)];
    for (slave, master) in SHAPES.into_iter().flat_map(|s| SHAPES.map(|m| (s, m))) {
        let below = Sheet::rectangle(slave, [4, 2], [[0.0, 1.0]; 2], (0.0, rng));
        let above = Sheet::rectangle(master, [2, 3], [[0.0, 1.0], [0.2, 1.1]], (0.0, rng)).turned();
        let beside = |[x, y, z]: Point| [x + 0.1, y, z + 0.1];
        let sheets = TwoSheets::new(3, below.mapped(bent), above.mapped(|x| beside(bent(x))));
        let fitted = SurfaceSettings { shapes: [TrueShape::Fitted; 2], ..Default::default() };
        let exact = SurfaceSettings {
            shapes: [TrueShape::Fitted, TrueShape::Facets],
            ..Default::default()
        };
        let [a, b] = [fitted, exact].map(|settings| sheets.pair(&settings).unwrap().pairs);
        for (a, b) in a.iter().zip(&b) {
            assert!((a.gap - b.gap).abs() < 1e-14, "{slave:?}, {master:?}: {} {}", a.gap, b.gap);
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

/// The fault of a shape, and its place, are said.
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
    let says = "shape of the slave: node 0 of face 0 is ";
    let refusal = refused(&of_slave(far));
    assert!(refusal.starts_with(says) && refusal.contains(" of the face's size away from it: "));
    let flat = Obstacle::Cylinder { point: [0.0; 3], axis: [0.0; 3], radius: 1.0, hollow: false };
    assert_eq!(refused(&of_slave(flat)), "shape of the slave: its axis is zero or not finite");
    let thick =
        Obstacle::Torus { centre: [0.0; 3], axis: [1.0; 3], radius: 2.0, ring: 1.0, hollow: false };
    let says = "shape of the slave: its radius is 2, it must be less than that of the ring, 1";
    assert_eq!(refused(&of_slave(thick)), says);
    let settings = SurfaceSettings { pairing: Pairing::NodeToSurface, ..of_slave(far) };
    assert!(refused(&settings).starts_with("true shapes are for dual mortar"));
    for (close_within, clearance, says) in [
        (-1.0, 0.0, "close_within is -1, it must not be negative"),
        (f64::NAN, 0.0, "close_within is NaN, it must not be negative"),
        (0.0, f64::INFINITY, "clearance is inf, it must be finite"),
    ] {
        let settings = SurfaceSettings { close_within, clearance, ..Default::default() };
        assert_eq!(refused(&settings), says);
    }
}

/// A bore with a chamfer at its end, whose nodes all stand within a face of the bore: the chamfer is refused as a part of it, by its turn if it
/// is steep, and by the distance of its outer nodes if it is a lead-in of 10 degrees. Facets as coarse as a hexagon are none.
#[test]
fn a_chamfer_is_no_facet_of_its_bore() {
    let bore =
        Obstacle::Cylinder { point: [0.0; 3], axis: [0.0, 0.0, 1.0], radius: 1.0, hollow: true };
    let settings = SurfaceSettings {
        shapes: [TrueShape::Exact(bore), TrueShape::Facets],
        ..Default::default()
    };
    let around = |count: usize, [from, to]: [[f64; 2]; 2], turned: bool| {
        let ring = |[r, z]: [f64; 2]| {
            (0..count).map(move |k| {
                let (s, c) = (TAU * k as f64 / count as f64).sin_cos();
                [r * c, r * s, z]
            })
        };
        let next = |k: usize| (k + 1) % count;
        let face = |k: usize| vec![k, count + k, count + next(k), next(k)];
        let sheet = Sheet {
            nodes: ring(from).chain(ring(to)).collect(),
            faces: (0..count).map(face).collect(),
        };
        if turned { sheet.turned() } else { sheet }
    };
    let refused = |count: usize, end: [f64; 2]| {
        let (slave, pin) = (
            around(count, [[1.0, 0.0], end], false),
            around(count, [[1.0, -1.0], [1.0, 2.0]], true),
        );
        TwoSheets::new(3, slave, pin).pair(&settings).err().map(|error| error.to_string())
    };
    for count in [6, 12, 24] {
        assert_eq!(refused(count, [1.0, 1.0]), None, "{count}");
        let degrees = |angle: f64, length: f64| {
            let (s, c) = angle.to_radians().sin_cos();
            [1.0 + length * s, length * c]
        };
        let steep = refused(count, degrees(60.0, 0.02)).unwrap();
        // Facets between generators of a chamfer of 60 degrees are less steep than these.
        assert!(steep.contains("is turned from it by "), "{count}: {steep}");
        let lead_in = refused(count, degrees(12.0, 2.0)).unwrap();
        assert!(lead_in.contains("of the face's size away from it"), "{count}: {lead_in}");
    }
}

/// A drill point in a countersink, cones of 45 degrees with nodes in their apexes: everywhere as far from each other as
/// their apexes are along the axis, times the sine of the angle. To a few hundred roundings.
#[test]
fn cones_have_their_apexes() {
    let around = 12;
    let fan = |apex: f64| Sheet {
        nodes: std::iter::once([0.0, 0.0, apex])
            .chain((0..around).map(|k| {
                let (s, c) = (TAU * k as f64 / around as f64).sin_cos();
                [c, s, 1.0 + apex]
            }))
            .collect(),
        faces: (0..around).map(|k| vec![0, 1 + (k + 1) % around, 1 + k]).collect(),
    };
    let cone = |apex: f64| {
        let (point, to_apex) = ([0.0, 0.0, 1.0 + apex], [0.0, 0.0, -1.0]);
        TrueShape::Exact(Obstacle::Cone { point, to_apex, radius: 1.0, hollow: false })
    };
    let sheets = TwoSheets::new(3, fan(0.0), fan(-APART).turned());
    let shapes = [cone(0.0), cone(-APART)];
    let found = sheets.pair(&SurfaceSettings { shapes, ..Default::default() }).unwrap();
    assert_eq!(found.pairs.len() + found.report.folded.len(), 1 + around);
    for pair in &found.pairs {
        assert!((pair.gap - APART * 0.5_f64.sqrt()).abs() < 1e-13, "{}", pair.gap);
    }
}

/// Fitted faces of a quarter of two cylinders, round or oval, have the gaps of the whole, of which they are a mirrored part, if the
/// pairing is told the planes. Round ones to 1e-12: what roundings of the fit, 1e-14, become over the weights of quadratic faces.
/// Points of integration on triangles depend on the order of their corners, and gaps of oval ones are no polynomials, so that mirror
/// images within the whole differ too: quarters of oval ones differ by no more. Fits on one side of the planes alone, without the
/// planes, are wrong by more on oval ones; on round ones those are exact. Numbers of cells sum to even ones, so that halves of squares
/// have their mirror images.
#[test]
fn fitted_quarters_are_those_of_the_whole() {
    let rng = &mut Rng::with_seed(17);
    let shapes = [Shape::T3, Shape::Q4, Shape::T6, Shape::Q8, Shape::Q9];
    for (shape, high) in shapes.into_iter().flat_map(|shape| [1.0, 0.6].map(|high| (shape, high))) {
        let mut pairs = |from: f64, symmetry: Vec<SymmetryPlane>| {
            let by = if from < 0.0 { 2 } else { 1 };
            let mut sheet = |[n, m]: [usize; 2], end: f64, out: f64| {
                let sides = [[from * end, end], [from * 0.6 * end, 0.6 * end]];
                let flat = Sheet::rectangle(shape, [by * n, by * m], sides, (0.0, rng));
                flat.mapped(cylinder(out).1).mapped(|[x, y, z]| [x, y, high * z])
            };
            let (inner, outer) = (sheet([4, 4], 0.8, 0.0), sheet([5, 3], 0.9, APART).turned());
            let sheets = TwoSheets::new(3, inner, outer);
            let shapes = [TrueShape::Fitted; 2];
            let settings = SurfaceSettings { shapes, symmetry, ..Default::default() };
            let found = sheets.pair(&settings).unwrap().pairs;
            found.into_iter().map(|pair| (sheets.nodes[pair.slave], pair.gap)).collect::<Vec<_>>()
        };
        let planes = [0, 1].map(|axis| SymmetryPlane::across(axis, 0.0));
        let [quarter, whole, unnamed] =
            [pairs(0.0, planes.to_vec()), pairs(-1.0, vec![]), pairs(0.0, vec![])];
        let apart = |a: Point, b: Point| (0..3).map(|c| (a[c] - b[c]).abs()).sum::<f64>();
        let differs = |part: &[(Point, f64)]| {
            let of_pair = |(place, gap): &(Point, f64)| {
                let same = whole.iter().find(|(other, _)| apart(*place, *other) < 1e-9).unwrap();
                (gap - same.1).abs()
            };
            part.iter().map(of_pair).fold(0.0, f64::max)
        };
        let (told, not_told) = (differs(&quarter), differs(&unnamed));
        let context = format!("{shape:?}, {high}: {told:e}, {not_told:e}");
        // How far mirror images within the whole differ.
        let mut images = 0.0_f64;
        for ([x, y, z], gap) in &whole {
            for image in [[-x, *y, *z], [*x, -y, *z]] {
                let same = whole.iter().find(|(other, _)| apart(image, *other) < 1e-9).unwrap();
                images = images.max((gap - same.1).abs());
            }
        }
        if high < 1.0 {
            assert!(told <= images.max(1e-12) && not_told > 1e-7, "{context}, {images:e}");
        } else {
            // Triangles to a twentieth of what is asked of their fits, 2e-6.
            let most = if shape.is_quadrilateral() { 1e-12 } else { 1e-7 };
            assert!(told < most, "{context}");
        }
    }
}

/// Right facets are taken however coarse they are: chords of a fifth of a circle with straight mid nodes, and triangles of a cylinder with obtuse
/// corners, which turn from it (H. A. Schwarz's lantern) though their corners stand on it. The end of a cylinder, whose corners do so too, is
/// none.
#[test]
fn coarse_facets_are_those_of_their_shape() {
    let radius = 1.0;
    let bore = Obstacle::Cylinder { point: [0.0; 3], axis: [0.0, 0.0, 1.0], radius, hollow: true };
    let shapes = [TrueShape::Exact(bore), TrueShape::Facets];
    let settings = SurfaceSettings { shapes, ..Default::default() };
    let at = |angle: f64, z: f64| [angle.cos(), angle.sin(), z];
    let refused = |nodes: Vec<[f64; 3]>, face: Vec<usize>| {
        // A master further inside, turned towards the face.
        let inner = [[0.2, 0.1, -1.0], [0.2, 0.1, 1.0], [0.1, 0.2, 1.0]];
        let first = nodes.len();
        let all = [nodes, inner.to_vec()].concat();
        let master = vec![vec![first, first + 1, first + 2]];
        pair(3, &all, [&[face], &master], &settings).err().map(|error| error.to_string())
    };
    let step = TAU / 5.0;
    let corners = [at(step, 0.0), at(0.0, 0.0), at(0.0, 1.0), at(step, 1.0)];
    let mids = (0..4).map(|k| {
        let (a, b) = (corners[k], corners[(k + 1) % 4]);
        std::array::from_fn(|c| 0.5 * (a[c] + b[c]))
    });
    assert_eq!(refused(corners.into_iter().chain(mids).collect(), (0..8).collect()), None);
    // Flat triangles of the lantern are turned by the angle whose tangent is (1 - cos) / height.
    let lantern = vec![at(0.0, 0.0), at(-0.8, 0.1), at(0.8, 0.1)];
    assert_eq!(refused(lantern, vec![0, 1, 2]), None);
    let end = vec![at(0.0, 0.0), at(2.0, 0.0), at(4.0, 0.0)];
    let words = refused(end, vec![0, 2, 1]).unwrap();
    assert!(words.contains("is turned from it by 90 degrees"), "{words}");
}
