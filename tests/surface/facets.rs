//! How much facets change an interference: what the arcs of a circle stand off their chords and parabolas, in closed form.

use std::f64::consts::{PI, TAU};

use crate::surfaces::{flat, pair, pair_with_obstacle, steps};
use signorini::surface::{Faces, Obstacle, SurfacePairs, SurfaceSettings, TrueShape};

/// Nodes and faces of a line.
type Line = (Vec<[f64; 3]>, Vec<Vec<usize>>);

/// A closed line through nodes in their order, of faces with mid nodes or without.
fn closed(nodes: Vec<[f64; 3]>, has_mids: bool) -> Line {
    let count = nodes.len();
    let next = |i: usize, by: usize| (i + by) % count;
    let faces = match has_mids {
        true => (0..count).step_by(2).map(|i| vec![i, next(i, 2), next(i, 1)]).collect(),
        false => (0..count).map(|i| vec![i, next(i, 1)]).collect(),
    };
    (nodes, faces)
}

/// A circle, its body inside.
fn circle(divisions: usize, (radius, centre): (f64, f64), turn: f64, has_mids: bool) -> Line {
    let count = divisions * if has_mids { 2 } else { 1 };
    let at = |angle: f64| [radius * angle.cos(), centre + radius * angle.sin(), 0.0];
    let angles = steps(turn, turn + TAU, count);
    closed(angles[..count].iter().map(|angle| at(*angle)).collect(), has_mids)
}

/// Pairs a line with another one, whose body is outside.
fn in_hole(
    (mut nodes, inner): Line,
    (others, outer): Line,
    inner_is_slave: bool,
    settings: &SurfaceSettings,
) -> SurfacePairs {
    let first = nodes.len();
    nodes.extend(others);
    let turned = |face: &Vec<usize>| {
        let mut face: Vec<usize> = face.iter().map(|node| first + node).collect();
        face.swap(0, 1);
        face
    };
    let outer: Vec<Vec<usize>> = outer.iter().map(turned).collect();
    let sides = if inner_is_slave { [&inner[..], &outer] } else { [&outer[..], &inner] };
    pair(2, &nodes, sides, settings).unwrap()
}

/// The mean distance of an arc of radius 1 from its chord, or from the parabola through its middle.
fn off(divisions: usize, has_mids: bool) -> f64 {
    let half = PI / divisions as f64;
    match has_mids {
        // At `t` of a half the parabola has the squared radius `1 - (1 - cos)² t² (1 - t²)`.
        true => (1.0 - half.cos()).powi(2) / 15.0,
        false => (half - half.sin() * half.cos()) / (2.0 * half.sin()),
    }
}

/// Circles in each other, of the same radius, with an interference, either of which is the slave, in units of any size. What
/// is told is right to the square of half a division, as the formulas are.
#[test]
fn facets_change_an_interference_by_what_arcs_stand_off_them() {
    for (divisions, has_mids) in
        [([64, 150], false), ([150, 64], false), ([24, 240], false), ([40, 13], true)]
    {
        let [own, opposite] = divisions.map(|count| off(count, has_mids));
        let change = (own - opposite).abs();
        let half = PI / divisions.into_iter().min().unwrap() as f64;
        for (unit, inner_is_slave) in [(1.0, true), (1.0, false), (1024.0, true)] {
            let [inner, outer] =
                divisions.map(|count| circle(count, (unit, 0.0), 0.1 / count as f64, has_mids));
            let told = |part: f64| {
                let settings =
                    SurfaceSettings { clearance: -part * change * unit, ..Default::default() };
                let found = in_hole(inner.clone(), outer.clone(), inner_is_slave, &settings);
                found.report.large_facets
            };
            let context = format!("{divisions:?} {has_mids} {unit} {inner_is_slave}");
            // The interference that the facets leave is positive, or there is none.
            for part in [0.5, 1.0, 5.0] {
                let (_, most) = told(part).expect(&context);
                let error = (most / unit - change).abs();
                println!("{context} {part}: {:.2e} of {:.2e}", error / change, half * half);
                assert!(error <= half * half * change.max(own).max(opposite), "{context}: {most}");
            }
            // They change it by a tenth of ten times themselves.
            assert_eq!(told(10.0 * (1.0 + 2.0 * half * half) * 1.1), None, "{context}");
        }
    }
}

/// The line with mid nodes on its chords.
fn on_chords((mut nodes, faces): Line) -> Line {
    let first = nodes.len();
    let mid = |face: &Vec<usize>| {
        let [a, b] = [nodes[face[0]], nodes[face[1]]];
        [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.0]
    };
    let mids: Vec<[f64; 3]> = faces.iter().map(mid).collect();
    nodes.extend(mids);
    let with_mid = |(i, face): (usize, Vec<usize>)| vec![face[0], face[1], first + i];
    (nodes, faces.into_iter().enumerate().map(with_mid).collect())
}

/// With mid nodes on the chords the change is told pair by pair: it is the difference between gaps of these faces and of the circle, to
/// the square of half a division as the sagitta is. They are fitted as the circle, to the sixth power of it, as faces without mid nodes.
#[test]
fn mid_nodes_on_chords_are_no_points_of_the_surface() {
    let circle_of = Obstacle::Sphere { centre: [0.0; 3], radius: 1.0, hollow: false };
    for divisions in [[24, 31], [40, 13], [64, 150], [240, 200]] {
        let change = (off(divisions[0], false) - off(divisions[1], false)).abs();
        let half = PI / divisions[0].min(divisions[1]) as f64;
        let sides = divisions.map(|count| circle(count, (1.0, 0.0), 0.1 / count as f64, false));
        for (part, inner_is_slave) in [(0.5, true), (1.0, false), (5.0, true), (100.0, true)] {
            let paired = |shape: TrueShape| {
                let settings = SurfaceSettings {
                    clearance: -part * change,
                    shapes: [shape; 2],
                    ..Default::default()
                };
                let [inner, outer] = sides.clone().map(on_chords);
                in_hole(inner, outer, inner_is_slave, &settings)
            };
            let [facets, exact, fitted] =
                [TrueShape::Facets, TrueShape::Exact(circle_of), TrueShape::Fitted].map(paired);
            let apart = |found: &SurfacePairs| {
                let gaps = found.pairs.iter().zip(&exact.pairs);
                gaps.map(|(pair, exact)| (pair.gap - exact.gap).abs()).fold(0.0, f64::max)
            };
            let context = format!("{divisions:?} {part}");
            assert!(apart(&fitted) < half.powi(6), "{context}: {:e}", apart(&fitted));
            assert_eq!(fitted.report.large_facets, None, "{context}");
            let told = facets.report.large_facets;
            assert_eq!(told.is_some(), part < 100.0, "{context}: {told:?}");
            let (_, most) = told.unwrap_or((0, apart(&facets)));
            let error = (most - apart(&facets)).abs();
            assert!(error < half * half * apart(&facets), "{context}: {most:e}, {error:e}");
        }
    }
}

/// A circle whose mid nodes stand on chords, in a rigid bore and around a rigid disc: the sagitta of these is told, to the square of half a
/// division. By the circle's shape, or fitted, all gaps are the interference.
#[test]
fn mid_nodes_on_chords_are_told_and_fitted_against_a_rigid_circle() {
    for (divisions, hollow) in [12, 24, 64].into_iter().flat_map(|n| [(n, true), (n, false)]) {
        let (nodes, mut faces) = on_chords(circle(divisions, (1.0, 0.0), 0.1, false));
        faces.iter_mut().filter(|_| !hollow).for_each(|face| face.swap(0, 1));
        let coordinates: Vec<f64> = nodes.iter().flat_map(|node| [node[0], node[1]]).collect();
        let (start, list) = flat(&faces);
        let half = PI / divisions as f64;
        let sagitta = 1.0 - half.cos();
        let own = Obstacle::Sphere { centre: [0.0; 3], radius: 1.0, hollow: false };
        let interference = 3.0 * sagitta;
        let radius = if hollow { 1.0 - interference } else { 1.0 + interference };
        let rigid = Obstacle::Sphere { centre: [0.0; 3], radius, hollow };
        for shape in [TrueShape::Facets, TrueShape::Exact(own), TrueShape::Fitted] {
            let shapes = [shape, TrueShape::Facets];
            let settings = SurfaceSettings { shapes, ..Default::default() };
            let slave = Faces { start: &start, nodes: &list };
            let found = pair_with_obstacle(2, &coordinates, slave, &rigid, &settings).unwrap();
            let context = format!("{divisions} {hollow} {shape:?}");
            assert_eq!(found.pairs.len(), 2 * divisions, "{context}");
            if shape == TrueShape::Facets {
                let (count, most) = found.report.large_facets.expect(&context);
                assert_eq!(count, divisions, "{context}");
                assert!((most - sagitta).abs() < half * half * sagitta, "{context}: {most}");
                continue;
            }
            assert_eq!(found.report.large_facets, None, "{context}");
            let off = found.pairs.iter().map(|pair| (pair.gap + interference).abs());
            // Rounding of numbers of size one, and of fits as between two sides.
            let least = if shape == TrueShape::Fitted { half.powi(6) } else { 1e-14 };
            assert!(off.fold(0.0, f64::max) < least, "{context}");
        }
    }
}

/// Arcs with free ends, with mid nodes on the arc, on chords, or on either by turns, each at a distance from another of these: fitted they
/// have it, up to their ends, to the sixth power of half a division. In the plane and of revolution, to the axis.
#[test]
fn mid_nodes_on_chords_are_fitted_up_to_free_ends() {
    let apart = 0.01;
    let arc = |radius: f64, count: usize, on_chord: &dyn Fn(usize) -> bool| -> Line {
        let at = |k: f64| (0.3 + k / count as f64 * (0.5 * PI - 0.3)).sin_cos();
        let at = |k: f64| [radius * at(k).1, radius * at(k).0, 0.0];
        let corner = |k: usize| at(k as f64);
        let mid = |k: usize| match on_chord(k) {
            true => std::array::from_fn(|c| 0.5 * (corner(k)[c] + corner(k + 1)[c])),
            false => at(k as f64 + 0.5),
        };
        let nodes = (0..=count).map(corner).chain((0..count).map(mid)).collect();
        (nodes, (0..count).map(|k| vec![k, k + 1, count + 1 + k]).collect())
    };
    let kinds: [&dyn Fn(usize) -> bool; 3] = [&|_| true, &|k| k % 2 == 0, &|_| false];
    for (own, opposite) in (0..3).flat_map(|own| (0..3).map(move |opposite| (own, opposite))) {
        for (counts, axisymmetric) in [([6, 9], false), ([9, 6], true), ([12, 13], true)] {
            let [inner, outer] =
                [arc(1.0, counts[0], kinds[own]), arc(1.0 + apart, counts[1], kinds[opposite])];
            let settings = SurfaceSettings {
                shapes: [TrueShape::Fitted; 2],
                axisymmetric,
                ..Default::default()
            };
            let found = in_hole(inner, outer, true, &settings);
            assert!(found.pairs.len() > counts[0], "{:?}", found.summary());
            let error = found.pairs.iter().map(|pair| (pair.gap - apart).abs()).fold(0.0, f64::max);
            let half = 0.25 * PI / counts[0].min(counts[1]) as f64;
            assert!(error < half.powi(6), "{own} {opposite} {counts:?}: {error:e}");
        }
    }
}

/// A flat of one face between two rounds of four on a plate, whose mid nodes stand on the flat and on the rounds: its mid node holds it,
/// so that it is less than half as far off when it is fitted as with all mid nodes on chords.
#[test]
fn a_flat_between_rounds_has_its_mid_node() {
    let outline = |k: f64| -> [f64; 3] {
        let round = |part: f64, side: f64| {
            let (sin, cos) = (0.5 * PI * part).sin_cos();
            [side * (1.0 + sin), 1.0 - cos, 0.0]
        };
        match k {
            k if k < 4.0 => round((4.0 - k) / 4.0, -1.0),
            k if k <= 5.0 => [2.0 * (k - 4.5), 0.0, 0.0],
            k => round((k - 5.0) / 4.0, 1.0),
        }
    };
    let off = |is_exact: bool| {
        let corner = |k: usize| outline(k as f64);
        let mid = |k: usize| match is_exact {
            true => outline(k as f64 + 0.5),
            false => std::array::from_fn(|c| 0.5 * (corner(k)[c] + corner(k + 1)[c])),
        };
        let mut nodes: Vec<[f64; 3]> = (0..=9).map(corner).chain((0..9).map(mid)).collect();
        let slave: Vec<Vec<usize>> = (0..9).map(|k| vec![k, k + 1, 10 + k]).collect();
        nodes.extend([[3.0, -0.001, 0.0], [-3.0, -0.001, 0.0]]);
        let settings =
            SurfaceSettings { shapes: [TrueShape::Fitted; 2], ..SurfaceSettings::default() };
        let found = pair(2, &nodes, [&slave, &[vec![19, 20]]], &settings).unwrap();
        let least = found.pairs.iter().map(|pair| pair.gap).fold(f64::INFINITY, f64::min);
        (least - 0.001).abs()
    };
    let [exact, on_chords] = [true, false].map(off);
    assert!(2.0 * exact < on_chords, "{exact:e}, {on_chords:e}");
}

/// A shaft in its bearing, centred: facets are told if they change the clearance by a tenth, and its polygon is not if it has the clearance
/// of twenty times that.
#[test]
fn facets_that_change_a_clearance_are_told() {
    for (divisions, has_mids) in [([24, 40], false), ([96, 160], false), ([40, 13], true)] {
        let [own, opposite] = divisions.map(|count| off(count, has_mids));
        let change = (own - opposite).abs();
        for (part, inner_is_slave) in [(0.5, true), (2.0, false), (5.0, true), (20.0, false)] {
            let [inner, outer] = [(0, 0.0), (1, part * change)]
                .map(|(side, play)| circle(divisions[side], (1.0 + play, 0.0), 0.1, has_mids));
            let found = in_hole(inner, outer, inner_is_slave, &SurfaceSettings::default());
            let told = found.report.large_facets;
            assert_eq!(told.is_some(), part < 10.0, "{divisions:?} {part}: {told:?}");
        }
    }
}

/// Facets of one length change nothing, turned or not, and neither do those of exact shapes. A loose body that touches is none with an interference.
#[test]
fn facets_that_cancel_or_are_loose_are_not_told() {
    let shape = TrueShape::Exact(Obstacle::Sphere { centre: [0.0; 3], radius: 1.0, hollow: false });
    let none = |found: SurfacePairs| assert_eq!(found.report.large_facets, None);
    for inner_is_slave in [true, false] {
        for overlap in [0.0, 1e-4, 1e-2] {
            let settings = SurfaceSettings { clearance: -overlap, ..Default::default() };
            for turn in [0.0, 0.3, 0.5] {
                let [inner, outer] =
                    [0.0, turn * TAU / 24.0].map(|turn| circle(24, (1.0, 0.0), turn, false));
                none(in_hole(inner, outer, inner_is_slave, &settings));
            }
            let exact = SurfaceSettings { shapes: [shape; 2], ..settings };
            let [inner, outer] = [24, 40].map(|count| circle(count, (1.0, 0.0), 0.1, false));
            none(in_hole(inner, outer, inner_is_slave, &exact));
        }
        // Ten times what facets change.
        let play = 10.0 * (off(32, false) - off(40, false));
        for [inner, outer] in [[32, 40], [40, 32]] {
            let inner = circle(inner, (1.0, 0.0), 0.1, false);
            let outer = circle(outer, (1.0 + play, play), 0.0, false);
            none(in_hole(inner, outer, inner_is_slave, &SurfaceSettings::default()));
        }
    }
}

/// Edges of flat faces are no curves, be they sharp or a chamfer of 30 degrees.
#[test]
fn edges_of_flat_faces_are_not_told() {
    let side = |corners: &[[f64; 2]], count: usize, nodes: &mut Vec<[f64; 3]>| {
        let first = nodes.len();
        for ends in corners.windows(2) {
            let [xs, ys] = [0, 1].map(|axis| steps(ends[0][axis], ends[1][axis], count));
            nodes.extend(xs.iter().zip(ys).take(count).map(|(x, y)| [*x, y, 0.0]));
        }
        (first..nodes.len() - 1).map(|node| vec![node, node + 1]).collect::<Vec<_>>()
    };
    let chamfer = 0.1 * (PI / 6.0).tan();
    let lower =
        [[1.2, -1.0], [1.2, -chamfer], [1.1, 0.0], [0.1, 0.0], [0.0, -chamfer], [0.0, -1.0]];
    let upper = [[0.05, 1.0], [0.05, 0.0], [1.15, 0.0], [1.15, 1.0]];
    for (counts, overlap) in [([3, 4], 0.0), ([7, 4], 1e-3), ([3, 10], 1e-6)] {
        let mut nodes = Vec::new();
        let slave = side(&lower, counts[0], &mut nodes);
        let master = side(&upper, counts[1], &mut nodes);
        let settings = SurfaceSettings { clearance: -overlap, ..Default::default() };
        let found = pair(2, &nodes, [&slave, &master], &settings).unwrap();
        assert!(found.pairs.len() > counts[0], "{:?}", found.summary());
        assert_eq!(found.report.large_facets, None, "{counts:?} {overlap}");
    }
}
