//! How far a pairing looks and what it costs: default search distances, masters beyond them, slivers and needles, units,
//! limits. By geometry alone.

use std::ops::ControlFlow;

use crate::surfaces::{SHAPES, Shape, Sheet, TwoSheets, line, pair, pair_with_obstacle, steps};
use fastrand::Rng;
use signorini::surface::{
    Faces, Master, Normals, Obstacle, PairResults, Pairing, Rims, SurfacePair, SurfacePairs,
    SurfaceSettings, SymmetryPlane,
};
use signorini::{Error, Limit, Monitor, Progress, Settings};

const PAIRINGS: [Pairing; 2] = [Pairing::DualMortar, Pairing::NodeToSurface];

/// A beam's lower side from the plane to six above it, over a plane, in so many elements.
fn beam(elements: usize, pairing: Pairing) -> SurfacePairs {
    let (mut nodes, slave) = line(&steps(0.0, 20.0, elements), false, 0);
    nodes.iter_mut().for_each(|node| node[1] = 0.3 * node[0]);
    let (below, mut master) = line(&steps(-5.0, 25.0, 7), false, nodes.len());
    master.iter_mut().for_each(|face| face.swap(0, 1));
    nodes.extend(below);
    let settings = SurfaceSettings { pairing, ..SurfaceSettings::default() };
    pair(2, &nodes, [&slave, &master], &settings).unwrap()
}

/// All nodes of a beam have pairs, whatever the size of its elements.
#[test]
fn the_default_search_distance_is_not_that_of_elements() {
    for pairing in PAIRINGS {
        for elements in [5, 20, 80, 320] {
            let found = beam(elements, pairing);
            assert_eq!(found.pairs.len(), elements + 1, "{pairing:?}: {}", found.summary());
            assert!(found.report.beyond.is_empty() && found.unpaired.is_empty());
        }
    }
}

/// Squares of the size one, ten above each other: beyond the search distance, which is told, with the distance. One
/// that looks away points at nothing.
#[test]
fn masters_beyond_the_search_distance_are_told() {
    let rng = &mut Rng::with_seed(1);
    let square = |cells: usize, height: f64, rng: &mut Rng| {
        let flat = Sheet::rectangle(Shape::Q4, [cells; 2], [[0.0, 1.0]; 2], (0.0, rng));
        flat.mapped(|[x, y, _]| [x, y, height])
    };
    for pairing in PAIRINGS {
        let settings = SurfaceSettings { pairing, ..SurfaceSettings::default() };
        let below = square(3, 0.0, rng);
        let apart = TwoSheets::new(3, square(2, 10.0, rng).turned(), below.clone());
        let found = apart.pair(&settings).unwrap();
        assert!(found.pairs.is_empty());
        let told = found.report.beyond.iter();
        assert!(told.clone().map(|(face, _)| *face).eq(0..4), "{:?}", found.report.beyond);
        assert!(told.clone().all(|(_, distance)| (distance - 10.0).abs() < 1e-14));
        let end = "; 4 slave faces point at a master beyond the search distance of 0.7071, the nearest, face 0, at 10";
        assert!(found.summary().ends_with(end), "{}", found.summary());
        let away = TwoSheets::new(3, square(2, 10.0, rng), below);
        assert!(away.pair(&settings).unwrap().report.beyond.is_empty());
    }
}

/// The nearer of two masters one behind the other counts, if no search distance asks for both.
#[test]
fn the_nearest_of_masters_behind_each_other_counts() {
    let rng = &mut Rng::with_seed(2);
    let sheet = |cells: usize, height: f64, rng: &mut Rng| {
        let flat = Sheet::rectangle(Shape::Q4, [cells; 2], [[0.0, 1.0]; 2], (0.0, rng));
        flat.mapped(|[x, y, _]| [x, y, height])
    };
    let (near, far) = (sheet(7, -0.1, rng), sheet(6, -0.5, rng));
    let count = near.nodes.len();
    let further = far.faces.iter().map(|face| face.iter().map(|node| node + count).collect());
    let master = Sheet {
        nodes: [near.nodes, far.nodes].concat(),
        faces: near.faces.into_iter().chain(further).collect(),
    };
    let sheets = TwoSheets::new(3, sheet(5, 0.0, rng).turned(), master);
    let found = sheets.pair(&SurfaceSettings::default()).unwrap();
    assert_eq!(found.pairs.len(), 36);
    assert!(found.pairs.iter().all(|pair| (pair.gap - 0.1).abs() < 1e-15));
    let settings = SurfaceSettings { search_distance: Some(0.6), ..SurfaceSettings::default() };
    let error = sheets.pair(&settings).unwrap_err().to_string();
    assert!(error.contains("master faces that lie over each other"), "{error}");
}

/// Triangles around a point, up to a part of the circle.
fn fan(slivers: usize, height: f64) -> Sheet {
    let rim = (0..=slivers).map(|k| {
        let (s, c) = (5.0 * k as f64 / slivers as f64).sin_cos();
        [c, s, height]
    });
    Sheet {
        nodes: std::iter::once([0.0, 0.0, height]).chain(rim).collect(),
        faces: (0..slivers).map(|k| vec![0, k + 1, k + 2]).collect(),
    }
}

/// Needles beside each other across the diagonal of a square.
fn needles(count: usize, height: f64) -> Sheet {
    let ends = |k: usize| {
        let at = k as f64 / count as f64;
        [[at, 1.0 + at, height], [1.0 + at, at, height]]
    };
    Sheet {
        nodes: (0..=count).flat_map(ends).collect(),
        faces: (0..count).map(|k| vec![2 * k, 2 * k + 1, 2 * k + 3, 2 * k + 2]).collect(),
    }
}

/// The rim of the master goes beside the point at which slivers meet, whose row is shared out: rows of all have as many weights as
/// four times as many slivers have, times four, and a half more for what is shared at the rim.
#[test]
fn slivers_at_a_rim_have_rows_of_few_weights() {
    let weights = |slivers: usize| {
        let ends = [[0.01, 1.5], [-1.5, 1.5]];
        let master = Sheet::rectangle(Shape::Q4, [10; 2], ends, (0.0, &mut Rng::with_seed(5)));
        let sheets = TwoSheets::new(3, fan(slivers, 1e-3).turned(), master);
        let found = sheets.pair(&SurfaceSettings::default()).unwrap();
        let of_pair = |pair: &SurfacePair| pair.slaves().len() + pair.masters().len();
        assert!(!found.report.folded.is_empty());
        found.pairs.iter().map(of_pair).sum::<usize>()
    };
    let (few, many) = (weights(400), weights(1600));
    assert!(many <= 6 * few, "{few}, {many}");
}

/// The search looks at a number of boxes that grows as `n log n`: sixteen times the faces, with a
/// logarithm that doubles at most, cost at most 32 times as many, and all against all 256 times. Slivers
/// that meet in a point, in a plane and aslant, needles that lean, and a search distance far above the bodies.
#[test]
fn slivers_needles_and_large_distances_are_nearly_linear() {
    let square = |cells: usize, height: f64| {
        let ends = [[0.0, 1.0]; 2];
        let flat = Sheet::rectangle(Shape::Q4, [cells; 2], ends, (0.0, &mut Rng::with_seed(3)));
        // So that boxes along the normal are large.
        flat.mapped(|[x, y, _]| {
            let (s, c) = 0.7_f64.sin_cos();
            let (y, z) = (c * y - s * height, s * y + c * height);
            [c * x + s * z, y, c * z - s * x]
        })
    };
    type Family<'a> = (&'a str, &'a dyn Fn(usize) -> [Sheet; 2], Option<f64>);
    let cone = |n: usize| fan(n, 0.0).mapped(|[x, y, _]| [x, y, -0.2 * x.hypot(y)]);
    let families: [Family<'_>; 4] = [
        ("slivers on a cone", &|n| [cone(n).turned(), cone(n + n / 3)], None),
        ("slivers", &|n| [fan(n, 1e-3).turned(), fan(n + n / 3, 0.0)], None),
        ("needles", &|n| [needles(n, 1e-3).turned(), needles(n + n / 3, 0.0)], None),
        (
            "distance",
            &|n| {
                let cells = (n as f64).sqrt() as usize;
                [square(cells, 1e-3).turned(), square(cells + 1, 0.0)]
            },
            Some(1e3),
        ),
    ];
    for (name, sheets, search_distance) in families {
        let cost = |n: usize| {
            let [slave, master] = sheets(n);
            let settings = SurfaceSettings { search_distance, ..SurfaceSettings::default() };
            let found = TwoSheets::new(3, slave, master).pair(&settings).unwrap();
            assert!(found.report.uncovered_faces.is_empty(), "{name}");
            found.report.boxes_searched
        };
        let (few, many) = (cost(400), cost(6400));
        assert!(many <= 32 * few, "{name}: {few}, {many}");
        assert!(few < 400 * 400 / 2, "{name}: {few}");
    }
}

/// Curved sheets with rims: slave and master.
fn curved(shape: Shape, by: f64) -> TwoSheets {
    let rng = &mut Rng::with_seed(4);
    let slave = Sheet::rectangle(shape, [3, 4], [[0.0, 1.0]; 2], (0.2, rng));
    let master = Sheet::rectangle(shape, [4, 3], [[0.0, 1.2], [0.1, 1.1]], (0.2, rng));
    let bulge = |x: f64, y: f64| 0.1 * x * x - 0.05 * x * y;
    let slave = slave.turned().mapped(|[x, y, _]| [x, y, bulge(x, y) + 0.01 * y - 0.002]);
    let mut sheets = TwoSheets::new(3, slave, master.mapped(|[x, y, _]| [x, y, bulge(x, y)]));
    sheets.nodes.iter_mut().flatten().for_each(|x| *x *= by);
    sheets
}

/// The unit of length does not count: coordinates times a power of two give the same rows bit by bit, and gaps, places
/// and areas that scale.
#[test]
fn rows_do_not_depend_on_the_unit() {
    for (i, shape) in SHAPES.into_iter().enumerate() {
        for pairing in PAIRINGS {
            let [one, large, small] = [0, 400, -400].map(|power| {
                let by = 2_f64.powi(power);
                let settings = SurfaceSettings {
                    pairing,
                    normals: [Normals::Averaged, Normals::Faces][i % 2],
                    search_distance: [None, Some(0.3 * by)][i / 2 % 2],
                    symmetry: vec![SymmetryPlane::across(0, 0.0)],
                    ..SurfaceSettings::default()
                };
                (curved(shape, by).pair(&settings).unwrap(), by)
            });
            assert!(one.0.pairs.len() > 8);
            for (found, by) in [&large, &small] {
                assert_eq!(found.pairs.len(), one.0.pairs.len());
                for (a, b) in found.pairs.iter().zip(&one.0.pairs) {
                    assert_eq!((a.slaves(), a.masters()), (b.slaves(), b.masters()));
                    assert_eq!((a.normal, a.tangents), (b.normal, b.tangents));
                    assert_eq!((a.gap, a.area), (b.gap * by, b.area * by * by));
                    assert_eq!(a.point, b.point.map(|x| x * by));
                }
                assert_eq!(found.unpaired, one.0.unpaired);
                assert_eq!(found.report.search_distance, one.0.report.search_distance * by);
                assert_eq!(found.report.covered_area, one.0.report.covered_area * by * by);
            }
        }
    }
}

/// The same of an obstacle.
#[test]
fn gaps_to_an_obstacle_do_not_depend_on_the_unit() {
    let (start, nodes) = ([0, 2, 4], [0, 1, 1, 2]);
    let slave = Faces { start: &start, nodes: &nodes };
    let found = |by: f64| {
        let coordinates = [-0.5, 1.2, 0.1, 1.1, 0.5, 1.3].map(|x| x * by);
        let disc = Obstacle::Sphere { centre: [0.1 * by, 0.0, 0.0], radius: by, hollow: false };
        let settings =
            SurfaceSettings { search_distance: Some(0.5 * by), ..SurfaceSettings::default() };
        pair_with_obstacle(2, &coordinates, slave, &disc, &settings).unwrap()
    };
    let one = found(1.0);
    assert_eq!(one.pairs.len(), 3);
    for by in [400, -400].map(|power| 2_f64.powi(power)) {
        for (a, b) in found(by).pairs.iter().zip(&one.pairs) {
            assert_eq!((a.gap, a.area, a.normal), (b.gap * by, b.area * by, b.normal));
        }
    }
}

/// Surfaces that touch have gaps of zero, wherever they are: rounding of coordinates is no overlap.
#[test]
fn rounding_of_coordinates_is_no_gap() {
    let rng = &mut Rng::with_seed(6);
    for shape in SHAPES {
        for _ in 0..10 {
            let (angle, away) = (6.0 * rng.f64(), 10.0 * rng.f64());
            let placed = |[x, y, _]: [f64; 3]| {
                let (s, c) = angle.sin_cos();
                let (y, z) = (c * y, s * y);
                [c * x + s * z + away, y - away, c * z - s * x + 0.1]
            };
            let slave = Sheet::rectangle(shape, [3, 4], [[0.0, 1.0]; 2], (0.2, rng));
            let master = Sheet::rectangle(shape, [4, 3], [[-0.1, 1.1]; 2], (0.2, rng));
            let sheets = TwoSheets::new(3, slave.turned().mapped(placed), master.mapped(placed));
            for pairing in PAIRINGS {
                let settings = SurfaceSettings { pairing, ..SurfaceSettings::default() };
                let found = sheets.pair(&settings).unwrap();
                assert!(found.pairs.iter().all(|pair| pair.gap == 0.0), "{shape:?}, {pairing:?}");
            }
        }
    }
}

/// A callback that cancels and a limit of time end a pairing, by either way and against an obstacle.
#[test]
fn callback_and_clock_end_a_pairing() {
    let sheets = curved(Shape::T3, 1.0);
    let coordinates = sheets.nodes.concat();
    let [slave, master] = [&sheets.slave, &sheets.master].map(|faces| crate::surfaces::flat(faces));
    let [slave, master] = [&slave, &master].map(|(start, nodes)| Faces { start, nodes });
    let plane = Obstacle::Plane { point: [0.0; 3], outward: [0.0, 0.0, 1.0] };
    let ended = |settings: &Settings, cancels: bool| {
        let mut told = 0;
        let mut progress = |progress: &Progress| {
            told += 1;
            assert!((0.0..=1.0).contains(&progress.reduced));
            if cancels { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let monitor = &mut Monitor::new(settings, Some(&mut progress));
        let pairing = SurfaceSettings::default();
        let errors = [Master::Faces(master), Master::RigidShape(plane)].map(|master| {
            let surfaces =
                signorini::surface::Surfaces { dim: 3, coordinates: &coordinates, slave, master };
            signorini::surface::pair_surfaces(&surfaces, &pairing, monitor).unwrap_err()
        });
        errors.map(|error| match error {
            Error::Stopped { limit, message } => (limit, message.to_string()),
            other => panic!("{other}"),
        })
    };
    for (limit, message) in ended(&Settings::default(), true) {
        assert_eq!(limit, Limit::Cancelled);
        assert_eq!(message, "cancelled with 0 % of the pairing done");
    }
    for (limit, message) in ended(&Settings { time_limit: 1e-12, ..Settings::default() }, false) {
        assert_eq!(limit, Limit::Time);
        assert!(message.ends_with("is used up with 0 % of the pairing done"), "{message}");
    }
}

/// Loads of a unit pressure on the nodes of lines from the axis outwards, of whole rings: integrals of the functions
/// times `2 pi r`, by Gauss' rule with three points, which is exact to degree 5.
fn ring_loads(nodes: &[[f64; 3]], faces: &[Vec<usize>], [from, to]: [f64; 2]) -> Vec<f64> {
    let mut loads = vec![0.0; nodes.len()];
    for face in faces {
        let [a, b] = [nodes[face[0]][0], nodes[face[1]][0]];
        let [low, high] = [a.min(b).max(from), a.max(b).min(to)];
        if low >= high {
            continue;
        }
        let place = 0.6_f64.sqrt();
        for (t, weight) in [(-place, 5.0 / 18.0), (0.0, 4.0 / 9.0), (place, 5.0 / 18.0)] {
            let r = 0.5 * (low + high) + 0.5 * t * (high - low);
            let s = (2.0 * r - a - b) / (b - a);
            let values = if face.len() == 3 {
                vec![0.5 * s * (s - 1.0), 0.5 * s * (s + 1.0), 1.0 - s * s]
            } else {
                vec![0.5 * (1.0 - s), 0.5 * (1.0 + s)]
            };
            let weight = std::f64::consts::TAU * r * weight * (high - low);
            face.iter().zip(values).for_each(|(node, value)| loads[*node] += weight * value);
        }
    }
    loads
}

/// Bodies of revolution: forces of a pressure times the areas load both sides as the pressure on rings does, on meshes
/// that do not match, from the axis on, wholly and in part, with slopes too. Areas are those of discs and cones.
#[test]
fn a_uniform_pressure_passes_between_rings() {
    let rng = &mut Rng::with_seed(7);
    for (quadratic, slope) in [(false, 0.0), (true, 0.0), (false, 0.5), (true, 0.5)] {
        for (of_master, end) in [(false, 1.0), (true, 1.0), (false, 0.77), (true, 0.9)] {
            for (axis, rims) in [(0.0, Rims::Fold), (0.3, Rims::Fold), (0.0, Rims::Keep)] {
                let x = [
                    crate::surfaces::grid(axis, 1.0, 5, rng),
                    crate::surfaces::grid(axis, end, 7, rng),
                ];
                let (mut nodes, slave) = line(&x[0], quadratic, 0);
                let (below, mut master) = line(&x[1], of_master, nodes.len());
                let first = nodes.len();
                master.iter_mut().for_each(|face| face.swap(0, 1));
                nodes.extend(below);
                let [own, other] = [[&slave, &vec![]], [&vec![], &master]]
                    .map(|[a, b]| ring_loads(&nodes, &[&a[..], b].concat(), [axis, end]));
                nodes.iter_mut().for_each(|node| node[1] = slope * (node[0] - axis));
                let settings =
                    SurfaceSettings { axisymmetric: true, rims, ..SurfaceSettings::default() };
                let found = pair(2, &nodes, [&slave, &master], &settings).unwrap();
                let context = format!("{quadratic}, {of_master}, {slope}, {end}, {axis}, {rims:?}");
                let long = (1.0 + slope * slope).sqrt();
                let area: f64 = found.pairs.iter().map(|pair| pair.area).sum();
                let exact = std::f64::consts::PI * (end * end - axis * axis) * long;
                assert!((area - exact).abs() < 1e-13, "{context}: {area}, {exact}");
                let whole = std::f64::consts::PI * (1.0 - axis * axis) * long;
                assert!((found.report.slave_area - whole).abs() < 1e-13, "{context}");
                assert!(found.pairs.iter().all(|pair| pair.area > 0.0), "{context}");
                let mut sums = vec![0.0; nodes.len()];
                for pair in &found.pairs {
                    for (weights, sign) in [(pair.slaves(), 1.0), (pair.masters(), -1.0)] {
                        weights.iter().for_each(|(node, a)| sums[*node] += sign * pair.area * a);
                    }
                    let on_axis = nodes[pair.slave][0] == 0.0;
                    let across = on_axis.then(|| vec![[1.0, 0.0, 0.0]]);
                    assert_eq!(found.held.get(&pair.slave), across.as_ref(), "{context}");
                    assert!(!on_axis || pair.normal == [0.0, -1.0, 0.0], "{context}: {pair:?}");
                }
                check_resultant(&found, slope, exact);
                for (node, sum) in sums.iter().enumerate() {
                    let exact = long * if node < first { own[node] } else { -other[node] };
                    assert!((sum - exact).abs() < 1e-12, "{context}, {node}: {sum}, {exact}");
                }
            }
        }
    }
}

/// Rows beside a bore are those at the axis as its radius falls to nothing: quadratic faces too, whose corner at the bore would have
/// an area as small as the radius. To 1e-7: a radius of 1e-9 moves a mesh of unit size by as much, and rows by some ten times that.
#[test]
fn a_bore_of_nothing_is_none() {
    for quadratic in [false, true] {
        let areas = |bore: f64| {
            let (mut nodes, slave) = line(&steps(bore, 1.0, 4), quadratic, 0);
            let (below, mut master) = line(&steps(bore, 1.0, 5), quadratic, nodes.len());
            master.iter_mut().for_each(|face| face.swap(0, 1));
            nodes.extend(below);
            let settings = SurfaceSettings { axisymmetric: true, ..SurfaceSettings::default() };
            let found = pair(2, &nodes, [&slave, &master], &settings).unwrap();
            found.pairs.iter().map(|pair| pair.area).collect::<Vec<f64>>()
        };
        for (with, without) in areas(1e-9).into_iter().zip(areas(0.0)) {
            assert!((with - without).abs() < 1e-7, "{quadratic}: {with}, {without}");
        }
    }
}

/// The resultant of a unit pressure on rings acts along the axis: the area that the axis sees.
fn check_resultant(found: &SurfacePairs, slope: f64, area: f64) {
    let force: Vec<f64> = found.pairs.iter().flat_map(|pair| [-pair.area, 0.0]).collect();
    let d = vec![0.0; force.len()];
    let results = PairResults { gap: None, reference_slip: None, d: &d, force: &force };
    let sums = found.resultant(&results, &[0.0, 0.0]).unwrap();
    // On a cone the pair at the apex has the normal of the axis: it leans from those of its faces.
    let miss = (sums.force[1] - area / (1.0 + slope * slope).sqrt()).abs();
    assert!(miss < if slope == 0.0 { 1e-13 } else { 0.02 * area }, "{sums:?}, {area}");
    assert_eq!((sums.force[0], sums.moment), (0.0, [0.0; 3]));
}

/// Faces that cannot turn about an axis are refused.
#[test]
fn wrong_rings_are_refused() {
    let settings = SurfaceSettings { axisymmetric: true, ..SurfaceSettings::default() };
    let (mut nodes, slave) = line(&[-0.1, 1.0], false, 0);
    nodes.extend([[1.0, 0.0, 0.0], [0.0, 0.0, 0.0]]);
    let error = pair(2, &nodes, [&slave, &[vec![2, 3]]], &settings).unwrap_err().to_string();
    assert_eq!(error, "slave face 0 has node 0 at the radius -0.1, beyond the axis x = 0");
    nodes[0][0] = 0.0;
    nodes[3][0] = -0.1;
    let error = pair(2, &nodes, [&slave, &[vec![2, 3]]], &settings).unwrap_err().to_string();
    assert_eq!(error, "master face 0 has node 3 at the radius -0.1, beyond the axis x = 0");
    let error = curved(Shape::T3, 1.0).pair(&settings).unwrap_err().to_string();
    assert!(error.starts_with("axisymmetric: faces of bodies of revolution are lines"), "{error}");
}

/// Two sheets in one list, the first one's faces first.
fn joined(first: Sheet, second: Sheet) -> Sheet {
    let count = first.nodes.len();
    let shifted = |face: Vec<usize>| face.into_iter().map(|node| count + node).collect();
    Sheet {
        nodes: [first.nodes, second.nodes].concat(),
        faces: first.faces.into_iter().chain(second.faces.into_iter().map(shifted)).collect(),
    }
}

/// A unit square of so many cells at a height, its normal upwards.
fn level(cells: usize, height: f64) -> Sheet {
    let rng = &mut Rng::with_seed(8);
    let flat = Sheet::rectangle(Shape::Q4, [cells; 2], [[0.0, 1.0]; 2], (0.0, rng));
    flat.mapped(|[x, y, _]| [x, y, height])
}

/// The clause of the summary on pairs all of which overlap.
const EVERY: &str = "; every pair overlaps, by at least 0.5, more than a face is long: if the sides do not, the faces of both are \
                     turned over";

/// Open surfaces with the faces of both sides turned over overlap by their gap; the summary says so in the plane and in space.
#[test]
fn sides_that_are_both_turned_over_are_told() {
    let settings = SurfaceSettings { search_distance: Some(0.6), ..SurfaceSettings::default() };
    let above = TwoSheets::new(3, level(5, 0.5), level(3, 0.0).turned());
    // The body of the upper line is above it as it is drawn, and below it as it is turned over.
    let (nodes, line) = line(&steps(0.0, 1.0, 4), false, 0);
    let line = Sheet { nodes, faces: line };
    let turned = |mut sheet: Sheet| {
        sheet.faces.iter_mut().for_each(|face| face.reverse());
        sheet
    };
    let lifted = line.clone().mapped(|[x, y, z]| [x, y + 0.5, z]);
    let in_plane = TwoSheets::new(2, turned(lifted.clone()), line.clone());
    for (sheets, axisymmetric) in [(&above, false), (&in_plane, false), (&in_plane, true)] {
        let found = sheets.pair(&SurfaceSettings { axisymmetric, ..settings.clone() }).unwrap();
        assert!(!found.pairs.is_empty());
        let summary = found.summary().to_string();
        assert!(summary.ends_with(EVERY), "{summary}");
    }
    let open = TwoSheets::new(2, lifted, turned(line)).pair(&settings).unwrap();
    assert!(!open.summary().to_string().contains("every pair"), "{}", open.summary());
}

/// A square that overlaps another one by a half, more than its faces are long, is told with that depth, and paired if the
/// search distance allows for it. The upper and lower sides of two plates that stand on each other overlap nothing.
#[test]
fn deep_overlaps_are_told() {
    for pairing in PAIRINGS {
        let settings = SurfaceSettings { pairing, ..SurfaceSettings::default() };
        let deep = TwoSheets::new(3, level(5, -0.5).turned(), level(3, 0.0));
        let found = deep.pair(&settings).unwrap();
        let told = found.report.beyond.iter();
        assert!(told.clone().map(|(face, _)| *face).eq(0..25), "{:?}", found.report.beyond);
        assert!(told.clone().all(|(_, distance)| (distance + 0.5).abs() < 1e-14));
        let says = "no pairs: nothing lies opposite the 25 slave faces within 0.7071, or overlaps them by at most 0.2828; if it \
                    should, give a larger search distance, or check the numbers from which nodes of faces count; 25 slave faces overlap a master by more than 0.2828, the nearest, \
                    face 0, by 0.5";
        assert_eq!(found.summary().to_string(), says);
        let settings = SurfaceSettings { search_distance: Some(0.6), ..settings };
        let found = deep.pair(&settings).unwrap();
        assert_eq!((found.pairs.len(), found.report.beyond.len()), (36, 0));
        assert!(found.pairs.iter().all(|pair| (pair.gap + 0.5).abs() < 1e-14));
        assert!(found.summary().to_string().contains(EVERY), "{}", found.summary());
        let upper = joined(level(5, 0.0).turned(), level(5, 1.0));
        let lower = joined(level(3, 0.0), level(3, -1.0).turned());
        let settings = SurfaceSettings { pairing, ..SurfaceSettings::default() };
        let found = TwoSheets::new(3, upper, lower).pair(&settings).unwrap();
        assert_eq!((found.pairs.len(), found.report.beyond.len()), (36, 0));
    }
}

/// The default search distance is a length of the bodies: it is the same whichever corner of a face is first, and however the
/// model is turned. That of a square is half of its diagonal, by definition; to a few roundings.
#[test]
fn the_default_search_distance_is_invariant() {
    let rng = &mut Rng::with_seed(9);
    let floor = level(1, 0.0).mapped(|[x, y, z]| [15.0 * x - 6.0, 15.0 * y - 6.0, z]);
    // The longest side of the triangle is 5, above the overlap.
    let nodes = [[0.0, 0.0, -4.5], [4.0, 0.0, -4.5], [0.0, 3.0, -4.5]].to_vec();
    for face in [[0, 2, 1], [2, 1, 0], [1, 0, 2]] {
        let faces = vec![face.to_vec()];
        let slave = Sheet { nodes: nodes.clone(), faces };
        let found = TwoSheets::new(3, slave, floor.clone()).pair(&SurfaceSettings::default());
        assert_eq!(found.unwrap().pairs.len(), 3, "{face:?}");
    }
    for gap in [0.7, 0.75, 0.8] {
        for _ in 0..10 {
            let [a, b] =
                [rng.f64(), rng.f64()].map(|part| (std::f64::consts::TAU * part).sin_cos());
            let turned = |[x, y, z]: [f64; 3]| {
                let (x, y) = (a.1 * x - a.0 * y, a.0 * x + a.1 * y);
                [x, b.1 * y - b.0 * z, b.0 * y + b.1 * z]
            };
            let [slave, master] = [level(4, gap).turned(), floor.clone()].map(|s| s.mapped(turned));
            let found = TwoSheets::new(3, slave, master).pair(&SurfaceSettings::default()).unwrap();
            assert!((found.report.search_distance - 0.5_f64.sqrt()).abs() < 1e-14);
            assert_eq!(found.pairs.len(), if gap == 0.7 { 25 } else { 0 }, "{gap}");
        }
    }
}
