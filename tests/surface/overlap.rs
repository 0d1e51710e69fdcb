//! Faces of one side that lie upon each other are refused by their numbers; what a mesh may have is not.

use std::f64::consts::PI;

use crate::surfaces::{
    SHAPES, Shape, Sheet, flat, line, pair, pair_with_obstacle, steps, unlimited,
};
use fastrand::Rng;
use signorini::Argument;
use signorini::surface::{
    Faces, Master, Obstacle, Pairing, SurfaceSettings, Surfaces, pair_surfaces,
};

const UNIT: [[f64; 2]; 2] = [[0.0, 1.0], [0.0, 1.0]];

fn sheet(shape: Shape, cells: [usize; 2], ends: [[f64; 2]; 2]) -> Sheet {
    Sheet::rectangle(shape, cells, ends, (0.0, &mut Rng::with_seed(1)))
}

/// The faces of both, with nodes of their own.
fn together(mut first: Sheet, second: Sheet) -> Sheet {
    let count = first.nodes.len();
    first.nodes.extend(second.nodes);
    let shifted = |face: Vec<usize>| face.into_iter().map(|node| node + count).collect();
    first.faces.extend(second.faces.into_iter().map(shifted).collect::<Vec<Vec<usize>>>());
    first
}

/// Why a sheet is refused as the slave side, alone; `None` if it is not.
fn refused(dim: usize, sheet: &Sheet, search_distance: Option<f64>) -> Option<String> {
    let settings = SurfaceSettings {
        search_distance,
        pairing: Pairing::NodeToSurface,
        ..SurfaceSettings::default()
    };
    let error = pair(dim, &sheet.nodes, [&sheet.faces, &[]], &settings).err()?;
    let signorini::Error::Invalid { argument, message } = error else { panic!("{error}") };
    assert_eq!(argument, Argument::SlaveFaces, "{message}");
    Some(message.to_string())
}

/// A sheet upon another one, shifted by a half of a face: squares share a half, and the first that meets one
/// of the others is 4, the first of the second sheet.
#[test]
fn faces_that_lie_upon_each_other_are_named() {
    for shape in SHAPES {
        let shifted = [[0.25, 1.25], [0.0, 1.0]];
        let both = together(sheet(shape, [2, 2], UNIT), sheet(shape, [2, 2], shifted));
        let message = refused(3, &both, None).unwrap_or_else(|| panic!("{shape:?}"));
        assert!(message.starts_with("slave face "), "{shape:?}: {message}");
        for part in ["lies upon face ", "of the smaller one", "leave one of them out"] {
            assert!(message.contains(part), "{shape:?}: {message}");
        }
        if shape.is_quadrilateral() {
            let first = "slave face 4 lies upon face 0, with 50 % of the smaller one";
            assert!(message.starts_with(first), "{shape:?}: {message}");
        }
    }
    // Finer upon coarser, of another kind, inside one face, and a quarter of it.
    let upon = |second: Sheet| {
        refused(3, &together(sheet(Shape::Q4, [1, 1], UNIT), second), None).unwrap()
    };
    assert!(upon(sheet(Shape::T3, [6, 6], UNIT)).contains("with 100 %"));
    assert!(upon(sheet(Shape::Q8, [1, 1], [[0.4, 0.5], [0.4, 0.5]])).contains("with 100 %"));
    assert!(upon(sheet(Shape::Q9, [1, 1], [[0.5, 1.5], [0.5, 1.5]])).contains("with 25 %"));
}

/// Lines: each listed once more with nodes of its own, or a coarser mesh of the same line.
#[test]
fn lines_that_lie_upon_each_other_are_named() {
    for quadratic in [false, true] {
        let of = |count| {
            let (nodes, faces) = line(&steps(0.0, 1.0, count), quadratic, 0);
            Sheet { nodes, faces }
        };
        assert_eq!(refused(2, &of(4), None), None);
        let message = refused(2, &together(of(4), of(4)), None).unwrap();
        assert!(message.starts_with("slave face 4 lies upon face 0, with 100 %"), "{message}");
        let message = refused(2, &together(of(4), of(1)), None).unwrap();
        assert!(message.starts_with("slave face 4 lies upon face 0, with 100 %"), "{message}");
    }
}

/// A part of a round bar of the radius 1, from `turn[0]` to `turn[1]`, seen from outside.
fn arc(shape: Shape, cells: [usize; 2], turn: [f64; 2], along: [f64; 2]) -> Sheet {
    sheet(shape, cells, [turn, along]).mapped(|[turn, y, _]| [turn.cos(), turn.sin(), y])
}

/// Two meshes of one curved surface are at the distance of their chords.
#[test]
fn two_meshes_of_a_curved_surface_are_refused() {
    for (few, many) in [(4, 7), (6, 5), (8, 8)] {
        let quarter = [0.0, 0.5 * PI];
        let both = together(
            arc(Shape::Q4, [few, 2], quarter, [0.0, 1.0]),
            arc(Shape::T3, [many, 3], quarter, [0.0, 1.0]),
        );
        assert!(refused(3, &both, None).is_some(), "{few} and {many}");
    }
}

/// A mesh may have these: both sides of a thin plate, of no thickness too; layers further apart than the
/// search reaches; a surface folded upon itself; parts with nodes of their own side by side, with other
/// meshes and along a curved line; a corner of a cube; a sharp cone.
#[test]
fn what_a_mesh_may_have_is_accepted() {
    for shape in SHAPES {
        for thickness in [0.0, 1e-3, 0.1] {
            let top = sheet(shape, [2, 3], UNIT);
            let bottom = top.clone().turned().mapped(|[x, y, z]| [x, y, z - thickness]);
            assert_eq!(refused(3, &together(top, bottom), None), None, "{shape:?}, {thickness}");
        }
        let layers = together(
            sheet(shape, [2, 2], UNIT),
            sheet(shape, [2, 2], UNIT).mapped(|[x, y, z]| [x, y, z + 0.01]),
        );
        assert_eq!(refused(3, &layers, Some(0.009)), None, "{shape:?}");
        assert!(refused(3, &layers, Some(0.011)).is_some(), "{shape:?}");
        let beside =
            together(sheet(shape, [2, 3], UNIT), sheet(shape, [5, 2], [[1.0, 2.0], [0.1, 1.3]]));
        assert_eq!(refused(3, &beside, None), None, "{shape:?}");
        // Folded along x = 1/2 by 179.9 degrees.
        let (s, c) = 179.9_f64.to_radians().sin_cos();
        let folded = sheet(shape, [4, 2], UNIT).mapped(|[x, y, z]| {
            if x > 0.5 { [0.5 + c * (x - 0.5), y, s * (x - 0.5)] } else { [x, y, z] }
        });
        assert_eq!(refused(3, &folded, None), None, "{shape:?}");
    }
    // The rim of both arcs is a chord of the other's.
    for (few, many) in [(4, 7), (3, 8), (5, 6)] {
        let rim = together(
            arc(Shape::Q4, [few, 2], [0.0, 0.5 * PI], [0.0, 1.0]),
            sheet(Shape::Q4, [1, many], [[1.0, 1.5], [0.0, 0.5 * PI]])
                .mapped(|[radius, turn, _]| [radius * turn.cos(), radius * turn.sin(), 1.0]),
        );
        assert_eq!(refused(3, &rim, None), None, "{few} and {many}");
    }
    assert_eq!(refused(3, &cube_corner(), None), None);
    for slope in [0.01, 0.3, 3.0, 100.0] {
        for sides in [3, 5, 12] {
            assert_eq!(refused(3, &cone(slope, sides), None), None, "{slope}, {sides} sides");
        }
    }
}

/// Two rings of one plane with other meshes meet along a circle of the radius 1. What they have in common lies
/// between the circle and a chord of the outer ring: less than (t - sin t) / 2 for the angle t of a face, which is
/// 0.005 for 22.5 degrees; the smallest face of the inner ring has the area sin(18 degrees) 3 / 8 = 0.116.
#[test]
fn rings_that_meet_along_a_circle_are_accepted() {
    let ring = |sides: usize, radius: [f64; 2]| {
        sheet(Shape::Q4, [sides, 1], [[0.0, PI], [0.0, 1.0]]).mapped(|[turn, y, _]| {
            let r = radius[1] + y * (radius[0] - radius[1]);
            [r * turn.cos(), r * turn.sin(), 0.0]
        })
    };
    for (few, many) in [(8, 10), (10, 8), (7, 12)] {
        let both = together(ring(few, [0.5, 1.0]), ring(many, [1.0, 1.5]));
        assert_eq!(refused(3, &both, None), None, "{few} and {many}");
    }
}

/// The three sides of a cube at a corner, outward.
fn cube_corner() -> Sheet {
    let nodes = (0..8).map(|i| [0, 1, 2].map(|c| f64::from((i >> c & 1) as u8))).collect();
    Sheet { nodes, faces: vec![vec![7, 6, 4, 5], vec![7, 3, 2, 6], vec![7, 5, 1, 3]] }
}

/// Triangles around an apex at the height `slope`.
fn cone(slope: f64, sides: usize) -> Sheet {
    let mut nodes = vec![[0.0, 0.0, slope]];
    for i in 0..sides {
        let turn = 2.0 * PI * i as f64 / sides as f64;
        nodes.push([turn.cos(), turn.sin(), 0.0]);
    }
    let faces = (0..sides).map(|i| vec![0, 1 + i, 1 + (i + 1) % sides]).collect();
    Sheet { nodes, faces }
}

/// A fan of six triangles of 72 degrees each around one node goes round more than once.
#[test]
fn a_fan_that_goes_round_twice_is_refused() {
    let mut nodes = vec![[0.0; 3]];
    for i in 0..=6 {
        let turn = 0.4 * PI * f64::from(i);
        nodes.push([turn.cos(), turn.sin(), 0.0]);
    }
    let faces = (0..6).map(|i| vec![0, 1 + i, 2 + i]).collect();
    let message = refused(3, &Sheet { nodes, faces }, None).unwrap();
    assert!(message.starts_with("slave face 5 lies upon face 0, with 100 %"), "{message}");
}

/// Two triangles with one corner in common, and mid nodes or none, are refused where they share more than a twentieth of the smaller
/// one, whatever their angles, sizes and the corner at which their lists begin. The share is the integral of half the square
/// of the lesser radius over the common angles, in a thousand steps.
#[test]
fn triangles_with_one_corner_in_common_are_refused_by_what_they_share() {
    let rng = &mut Rng::with_seed(9);
    let mut counts = [0; 2];
    for _ in 0..400 {
        let mut triangle = || {
            let (from, angle) = (2.0 * PI * rng.f64(), 0.2 + 2.2 * rng.f64());
            let lengths = [0.3 + rng.f64(), 0.3 + rng.f64()];
            (from, angle, lengths)
        };
        let both = [triangle(), triangle()];
        let end = |at: f64, length: f64| [length * at.cos(), length * at.sin(), 0.0];
        let ends = both.map(|(from, angle, [a, b])| [end(from, a), end(from + angle, b)]);
        // The radius up to the line between both ends; zero beside them.
        let radius = |k: usize, at: f64| {
            let (from, angle, [a, b]) = both[k];
            let turn = (at - from).rem_euclid(2.0 * PI);
            let across = a * turn.sin() + b * (angle - turn).sin();
            if turn < angle { a * b * angle.sin() / across } else { 0.0 }
        };
        let step = 2.0 * PI / 1000.0;
        let places = || (0..1000).map(|i| (f64::from(i) + 0.5) * step);
        let areas = both.map(|(_, angle, [a, b])| 0.5 * a * b * angle.sin());
        let common = places().map(|at| radius(0, at).min(radius(1, at)).powi(2));
        let share = 0.5 * step * common.sum::<f64>() / areas[0].min(areas[1]);
        if (share - 0.05).abs() < 0.02 {
            continue;
        }
        let corners = [[0.0; 3], ends[0][0], ends[0][1], ends[1][0], ends[1][1]];
        let mid = |a: usize, b: usize| [0, 1, 2].map(|c| 0.5 * (corners[a][c] + corners[b][c]));
        let mids = [mid(0, 1), mid(1, 2), mid(2, 0), mid(0, 3), mid(3, 4), mid(4, 0)];
        let nodes = [&corners[..], &mids].concat();
        let faces = [vec![0, 1, 2, 5, 6, 7], vec![0, 3, 4, 8, 9, 10]];
        for (has_mids, begin) in [(false, 0), (false, 1), (true, 0), (true, 2)] {
            let face = |face: &Vec<usize>| {
                let mut list = face.clone();
                list[..3].rotate_left(begin);
                list[3..].rotate_left(begin);
                list.truncate(if has_mids { 6 } else { 3 });
                list
            };
            let sheet = Sheet { nodes: nodes.clone(), faces: faces.iter().map(face).collect() };
            let is_refused = refused(3, &sheet, None).is_some();
            assert_eq!(is_refused, share > 0.05, "{has_mids}, {begin}, {share}: {both:?}");
            counts[usize::from(is_refused)] += 1;
        }
    }
    assert!(counts[0] > 100 && counts[1] > 100, "{counts:?}");
}

/// Masters: by dual mortar they are refused, as the slave's force would go to both; nodes take the nearest. An
/// obstacle's faces are named as such, and slaves are compared against any obstacle.
#[test]
fn masters_and_obstacles_are_compared_too() {
    let slave = sheet(Shape::Q4, [2, 2], UNIT).turned();
    let floor = [[-0.5, 0.5], [-0.5, 1.5]];
    // Over a half of the slave two layers, over the other none: each slave face is covered at most once.
    let master = together(sheet(Shape::Q4, [1, 1], floor), sheet(Shape::Q4, [1, 1], floor));
    let both = together(slave.clone(), master.clone());
    let (s, m) = both.faces.split_at(4);
    let by = |pairing| {
        let settings = SurfaceSettings { pairing, ..SurfaceSettings::default() };
        pair(3, &both.nodes, [s, m], &settings)
    };
    let error = by(Pairing::DualMortar).unwrap_err();
    assert!(error.to_string().starts_with("master face 1 lies upon face 0, with 100 %"), "{error}");
    assert_eq!(by(Pairing::NodeToSurface).unwrap().pairs.len(), 6);

    let coordinates = slave.nodes.concat();
    let (start, nodes) = flat(&slave.faces);
    let faces = Faces { start: &start, nodes: &nodes };
    let (obstacle_start, obstacle_nodes) = flat(&master.faces);
    let obstacle = master.nodes.concat();
    let master = Master::RigidFaces {
        coordinates: &obstacle,
        faces: Faces { start: &obstacle_start, nodes: &obstacle_nodes },
    };
    let settings = &SurfaceSettings::default();
    let surfaces = Surfaces { dim: 3, coordinates: &coordinates, slave: faces, master };
    let error = pair_surfaces(&surfaces, settings, &mut unlimited()).unwrap_err().to_string();
    assert!(error.starts_with("obstacle face 1 lies upon face 0"), "{error}");

    let twice = together(slave.clone(), slave);
    let coordinates = twice.nodes.concat();
    let (start, nodes) = flat(&twice.faces);
    let faces = Faces { start: &start, nodes: &nodes };
    let plane = Obstacle::Plane { point: [0.0; 3], outward: [0.0, 0.0, 1.0] };
    let error =
        pair_with_obstacle(3, &coordinates, faces, &plane, settings).unwrap_err().to_string();
    assert!(error.starts_with("slave face 4 lies upon face 0"), "{error}");
}
