//! Pairs from surfaces, by mathematics alone: sums of weights, statics of a uniform pressure, motions that
//! open nothing.

use crate::surfaces::{
    SHAPES, Shape, Sheet, TwoSheets, exact_loads, flat, grid, line, most_moved, nodal_forces, pair,
    pair_with_obstacle, steps, unlimited,
};
use fastrand::Rng;
use signorini::surface::{
    Faces, Master, Obstacle, Pairing, SurfacePairs, SurfaceSettings, Surfaces, pair_surfaces,
};

/// Two lines: nodes, slave faces, master faces, turned by `angle`.
fn two_lines(
    slave: &[f64],
    master: &[f64],
    quadratic: [bool; 2],
    angle: f64,
) -> (Vec<[f64; 3]>, [Vec<Vec<usize>>; 2]) {
    let (mut nodes, slave) = line(slave, quadratic[0], 0);
    let (below, mut master) = line(master, quadratic[1], nodes.len());
    master.iter_mut().for_each(|face| face.swap(0, 1));
    nodes.extend(below);
    let (s, c) = angle.sin_cos();
    nodes.iter_mut().for_each(|p| *p = [c * p[0] - s * p[1], s * p[0] + c * p[1], 0.0]);
    (nodes, [slave, master])
}

/// Weights sum to 1, a uniform pressure loads both sides as its integral does, rigid and linear motions
/// open and slip nothing, areas are positive and sum to the covered length; covered wholly and by 3 to
/// 95 % of the last face. To 1e-12: a hundred roundings of sums of 40 terms.
#[test]
fn lines_pass_the_patch_test_by_statics() {
    let mut rng = Rng::with_seed(1);
    for quadratic in [[false, false], [true, false], [false, true], [true, true]] {
        for end in [4.0, 3.05, 3.5, 3.97, 3.0 + 1e-4, 3.0 + 1e-9] {
            for (a, b) in [(4, 7), (4, 3), (4, 1)] {
                let slave = steps(0.0, 4.0, a);
                let master = grid(-1.0, end, b, &mut rng);
                let (nodes, [s, m]) = two_lines(&slave, &master, quadratic, 0.3);
                let found = pair(2, &nodes, [&s, &m], &SurfaceSettings::default()).unwrap();
                let context = format!("{quadratic:?}, to {end}, {a} on {b}");
                check(&found, &nodes, &context);
                assert!((found.report.covered_area - end).abs() < 1e-12, "{context}");
                let normal = [0.3_f64.sin(), -(0.3_f64.cos()), 0.0];
                let loads = [
                    exact_loads(&slave, quadratic[0], [0.0, end]),
                    exact_loads(&master, quadratic[1], [0.0, end]),
                ];
                let forces = nodal_forces(&found, nodes.len(), 1.0);
                for (node, force) in forces.iter().enumerate() {
                    let of_slave = loads[0].len();
                    let load =
                        if node < of_slave { -loads[0][node] } else { loads[1][node - of_slave] };
                    for c in 0..2 {
                        let miss = (force[c] - load * normal[c]).abs();
                        assert!(miss < 1e-12, "{context}, node {node}: {miss:e}");
                    }
                }
            }
        }
    }
}

fn check(found: &SurfacePairs, nodes: &[[f64; 3]], context: &str) {
    for pair in &found.pairs {
        for weights in [pair.slaves(), pair.masters()] {
            let sum: f64 = weights.iter().map(|(_, weight)| weight).sum();
            assert!((sum - 1.0).abs() < 1e-13, "{context}, pair of {}: {sum}", pair.slave);
        }
        assert!(pair.area > 0.0 && pair.gap.abs() < 1e-12, "{context}: {pair:?}");
    }
    let motion = |[x, y, _]: [f64; 3]| [1.0 + 2.0 * x - 0.3 * y, 0.5 - x + 0.7 * y, 0.0];
    let moved = most_moved(found, nodes, motion);
    assert!(moved < 1e-12, "{context}: {moved:e}");
}

/// Gauss points of -1..1, five of them (Abramowitz and Stegun, table 25.4).
fn gauss() -> [(f64, f64); 5] {
    let root = (10.0_f64 / 7.0).sqrt();
    let [a, b] = [-1.0, 1.0].map(|sign| (5.0 + sign * 2.0 * root).sqrt() / 3.0);
    let part = 13.0 * 70.0_f64.sqrt();
    let [v, w] = [1.0, -1.0].map(|sign| (322.0 + sign * part) / 900.0);
    [(-b, w), (-a, v), (0.0, 128.0 / 225.0), (a, v), (b, w)]
}

/// Shape functions by the formulas of the textbooks, in the order of the library.
fn shapes(nodes: usize, s: f64, t: f64) -> Vec<f64> {
    let signs = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let l = [1.0 - s - t, s, t];
    let along = |x: f64, at: f64| match at {
        0.0 => 1.0 - x * x,
        _ => 0.5 * x * (x + at),
    };
    match nodes {
        3 => l.to_vec(),
        6 => {
            let corners = l.map(|l| l * (2.0 * l - 1.0));
            let mids = [4.0 * l[0] * l[1], 4.0 * l[1] * l[2], 4.0 * l[2] * l[0]];
            [corners, mids].concat()
        }
        4 => signs.map(|(a, b)| 0.25 * (1.0 + a * s) * (1.0 + b * t)).to_vec(),
        8 => {
            let corners = signs
                .map(|(a, b)| 0.25 * (1.0 + a * s) * (1.0 + b * t) * (a * s + b * t - 1.0))
                .to_vec();
            let (p, q) = (0.5 * (1.0 - s * s), 0.5 * (1.0 - t * t));
            [corners, vec![p * (1.0 - t), q * (1.0 + s), p * (1.0 + t), q * (1.0 - s)]].concat()
        }
        _ => {
            let mids = [(0.0, -1.0), (1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, 0.0)];
            let all = signs.iter().chain(&mids);
            all.map(|&(a, b)| along(s, a) * along(t, b)).collect()
        }
    }
}

/// Loads of a unit pressure on the part of a flat sheet in a window: integrals of its functions. `None`
/// if the window cuts a face that is no rectangle along the axes.
fn exact_sheet_loads(sheet: &Sheet, window: [[f64; 2]; 2]) -> Option<Vec<f64>> {
    let mut loads = vec![0.0; sheet.nodes.len()];
    for face in &sheet.faces {
        let triangle = matches!(face.len(), 3 | 6);
        let corners: Vec<[f64; 3]> =
            face[..if triangle { 3 } else { 4 }].iter().map(|&node| sheet.nodes[node]).collect();
        let mut range = [[-1.0, 1.0]; 2];
        let mut inside = true;
        let mut outside = false;
        for c in 0..2 {
            let low = corners.iter().map(|p| p[c]).fold(f64::INFINITY, f64::min);
            let high = corners.iter().map(|p| p[c]).fold(f64::NEG_INFINITY, f64::max);
            let [from, to] = [low.max(window[c][0]), high.min(window[c][1])];
            outside |= from >= to;
            inside &= from == low && to == high;
            range[c] = [from, to].map(|x| (2.0 * x - low - high) / (high - low));
        }
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| corners[i % corners.len()]);
        let rectangle = !triangle && a[1] == b[1] && c[1] == d[1] && a[0] == d[0] && b[0] == c[0];
        if outside {
            continue;
        }
        if !inside && !rectangle {
            return None;
        }
        for (x, v) in gauss() {
            for (y, w) in gauss() {
                let at = |c: usize, x: f64| {
                    let [from, to] = range[c];
                    0.5 * (from + to) + 0.5 * (to - from) * x
                };
                let shrink = 0.25 * (range[0][1] - range[0][0]) * (range[1][1] - range[1][0]);
                let (s, t, weight) = if triangle {
                    // Collapsed from the square.
                    let s = 0.5 * (1.0 + x);
                    (s, (1.0 - s) * 0.5 * (1.0 + y), 0.25 * (1.0 - s) * v * w)
                } else {
                    (at(0, x), at(1, y), shrink * v * w)
                };
                // Functions have degree 2 at most in each coordinate, where central differences are exact.
                let slope = |ds: f64, dt: f64| {
                    let ahead = shapes(face.len(), s + ds, t + dt);
                    let behind = shapes(face.len(), s - ds, t - dt);
                    let mut slope = [0.0; 2];
                    for (i, node) in face.iter().enumerate() {
                        let change = ahead[i] - behind[i];
                        let pairs = slope.iter_mut().zip(sheet.nodes[*node]);
                        pairs.for_each(|(slope, x)| *slope += change * x);
                    }
                    slope
                };
                let (p, q) = (slope(0.5, 0.0), slope(0.0, 0.5));
                let area = weight * (p[0] * q[1] - p[1] * q[0]);
                for (node, value) in face.iter().zip(shapes(face.len(), s, t)) {
                    loads[*node] += area * value;
                }
            }
        }
    }
    Some(loads)
}

/// Turns a point about two axes and moves it, so that no axis is special.
fn placed([x, y, z]: [f64; 3]) -> [f64; 3] {
    let ((a, b), (c, d)) = (0.4_f64.sin_cos(), 0.7_f64.sin_cos());
    let (y, z) = (b * y - a * z, a * y + b * z);
    [d * x + c * z + 3.0, y - 1.0, d * z - c * x + 0.5]
}

/// Faces of all kinds on all kinds, distorted by a quarter or not, covered wholly and by 3 to 95 % of
/// an element at a corner: weights sum to 1, areas are positive and sum to the covered area, linear
/// fields open and slip nothing, and a uniform pressure loads both sides as its integrals do. Undistorted
/// to 1e-12, rounding of sums of a few hundred terms; distorted to 1e-10, as no rule is exact there.
#[test]
fn faces_pass_the_patch_test_by_statics() {
    let mut rng = Rng::with_seed(3);
    for slave in SHAPES {
        for master in SHAPES {
            for distortion in [0.0, 0.25] {
                for part in [0.0, 0.03, 0.5, 0.95, 0.9999] {
                    statics_of(slave, master, (distortion, part, 1e-16), &mut rng);
                }
            }
        }
    }
}

/// Coordinates of decks have some digits: mid nodes then stand off their edges by rounding. Distorted faces of all kinds, covered
/// wholly, pass the patch test with seven digits and ten as with all: what faces leave to neighbours is of the square.
#[test]
fn faces_with_rounded_coordinates_pass_the_patch_test() {
    let mut rng = Rng::with_seed(21);
    for (slave, master) in SHAPES.into_iter().flat_map(|s| SHAPES.map(|m| (s, m))) {
        for digits in [1e-7, 1e-10] {
            statics_of(slave, master, (0.25, 0.0, digits), &mut rng);
        }
    }
}

fn statics_of(
    slave: Shape,
    master: Shape,
    (distortion, part, digit): (f64, f64, f64),
    rng: &mut Rng,
) {
    let context = format!(
        "{slave:?} on {master:?}, distorted {distortion}, overhang {part}, digits to {digit:e}"
    );
    let rounded =
        |x: [f64; 3]| x.map(|x| if digit > 1e-15 { (x / digit).round() * digit } else { x });
    // Overhang of a share of the slave's element in x and y.
    let shift = [part * 0.5, part / 3.0];
    let above = Sheet::rectangle(slave, [2, 3], [[0.0, 1.0], [0.0, 1.0]], (distortion, rng))
        .mapped(rounded);
    let ends = [[shift[0], 1.0 + shift[0]], [shift[1], 1.0 + shift[1]]];
    let below = Sheet::rectangle(master, [3, 2], ends, (distortion, rng)).mapped(rounded);
    let window = [[shift[0], 1.0], [shift[1], 1.0]];
    let loads = [exact_sheet_loads(&above, window), exact_sheet_loads(&below, window)];
    let sheets = TwoSheets::new(3, above.turned().mapped(placed), below.mapped(placed));
    let found = sheets.pair(&SurfaceSettings::default()).unwrap();
    let tolerance = if distortion == 0.0 { 1e-12 } else { 1e-10 };
    for pair in &found.pairs {
        for weights in [pair.slaves(), pair.masters()] {
            let sum: f64 = weights.iter().map(|(_, weight)| weight).sum();
            assert!((sum - 1.0).abs() < tolerance, "{context}, pair of {}: {sum}", pair.slave);
            // No row holds a node by others that are far away, by weights far above 1.
            assert!(weights.iter().all(|(_, weight)| weight.abs() < 20.0), "{context}: {pair:?}");
        }
        assert!(pair.area > 0.0 && pair.gap.abs() < tolerance, "{context}: {pair:?}");
    }
    match (slave, found.one_slave_each()) {
        (Shape::T3 | Shape::Q4 | Shape::Linear, arrays) => {
            let arrays = arrays.expect("linear faces have one slave each");
            for ends in arrays.master_start.windows(2) {
                let sum: f64 = arrays.weights[ends[0]..ends[1]].iter().sum();
                assert!((sum - 1.0).abs() < tolerance, "{context}: {sum}");
            }
        }
        (Shape::Q9, _) => {}
        // A twentieth of a face leaves few pairs.
        (_, arrays) => {
            assert!(arrays.is_none() || part > 0.9, "{context}: mid rows hold corners too");
        }
    }
    // Rectangles can be cut.
    let cut = |shape: Shape| part > 0.0 && (!shape.is_quadrilateral() || distortion > 0.0);
    assert_eq!(loads.each_ref().map(Option::is_none), [slave, master].map(cut), "{context}");
    let motion = |[x, y, z]: [f64; 3]| [1.0 + 2.0 * x - y, 0.5 - x + 0.7 * y - z, x + y + z];
    let moved = most_moved(&found, &sheets.nodes, motion);
    assert!(moved < tolerance, "{context}: {moved:e}");
    let covered = (1.0 - shift[0]) * (1.0 - shift[1]);
    assert!((found.report.covered_area - covered).abs() < tolerance, "{context}");
    let forces = nodal_forces(&found, sheets.nodes.len(), 1.0);
    // The slave looks down.
    let origin = placed([0.0; 3]);
    let down = placed([0.0, 0.0, -1.0]);
    let slave_nodes = sheets.slave.concat().into_iter().max().unwrap() + 1;
    for (side, loads) in loads.iter().enumerate() {
        let Some(loads) = loads else { continue };
        let first = if side == 0 { 0 } else { slave_nodes };
        let sign = if side == 0 { -1.0 } else { 1.0 };
        for (node, load) in loads.iter().enumerate() {
            for c in 0..3 {
                let exact = sign * load * (down[c] - origin[c]);
                let miss = (forces[first + node][c] - exact).abs();
                assert!(miss < tolerance, "{context}, side {side}, node {node}: {miss:e}");
            }
        }
    }
}

/// An upper surface over a lower one at the height `height`, both of squares.
fn gapped(cells: usize, height: f64) -> TwoSheets {
    let rng = &mut Rng::with_seed(4);
    let square = |cells, rng: &mut Rng| {
        Sheet::rectangle(Shape::Q4, [cells; 2], [[0.0, 1.0], [0.0, 1.0]], (0.0, rng))
    };
    let above = square(cells, rng).turned().mapped(|[x, y, _]| [x, y, height]);
    TwoSheets::new(3, above, square(cells + 1, rng))
}

/// The gap of parallel surfaces is their distance, open or overlapping, by both ways of pairing, and nodes
/// of coordinates with gaps are not moved: up to 1e-13, rounding. Beyond the search distance nothing is
/// paired, which is said.
#[test]
fn parallel_surfaces_have_their_distance_as_gap() {
    for pairing in [Pairing::DualMortar, Pairing::NodeToSurface] {
        let settings =
            SurfaceSettings { pairing, search_distance: Some(0.2), ..SurfaceSettings::default() };
        for height in [0.1, 0.0, -0.15] {
            let sheets = gapped(4, height);
            let found = sheets.pair(&settings).unwrap();
            assert_eq!((found.pairs.len(), found.unpaired.len()), (25, 0));
            for pair in &found.pairs {
                assert!((pair.gap - height).abs() < 1e-13, "{pairing:?}: {pair:?}");
                assert_eq!(pair.slaves(), [(pair.slave, 1.0)], "{pairing:?}");
                assert!((pair.normal[2] + 1.0).abs() < 1e-15, "{pairing:?}: {pair:?}");
            }
            assert!((found.report.covered_area - 1.0).abs() < 1e-13, "{pairing:?}");
        }
        let found = gapped(4, 0.21).pair(&settings).unwrap();
        assert!(found.pairs.is_empty() && found.unpaired.len() == 25, "{pairing:?}");
        assert_eq!(found.report.covered_area, 0.0);
    }
}

/// Nodes against surfaces reproduce linear fields and balance forces and moments, on all kinds of faces:
/// the sums over a pair's weights of `1`, and of the places, agree.
#[test]
fn nodes_against_surfaces_move_nothing_in_a_linear_field() {
    let mut rng = Rng::with_seed(5);
    let settings = SurfaceSettings {
        pairing: Pairing::NodeToSurface,
        search_distance: None,
        ..SurfaceSettings::default()
    };
    for slave in SHAPES {
        for master in SHAPES {
            let above = Sheet::rectangle(slave, [2, 3], [[0.0, 1.0]; 2], (0.25, &mut rng));
            let below = Sheet::rectangle(master, [3, 2], [[-0.1, 1.1]; 2], (0.25, &mut rng));
            let sheets = TwoSheets::new(3, above.turned().mapped(placed), below.mapped(placed));
            let found = sheets.pair(&settings).unwrap();
            assert!(found.unpaired.is_empty());
            let motion = |[x, y, z]: [f64; 3]| [1.0 + 2.0 * x - y, 0.5 - x + 0.7 * y, x + z];
            let moved = most_moved(&found, &sheets.nodes, motion);
            assert!(moved < 1e-12, "{slave:?} on {master:?}: {moved:e}");
            assert!(found.pairs.iter().all(|pair| pair.area > 0.0));
        }
    }
}

/// A node that meets a master face has its pair, whether or not the nodes beside it meet one: a master below the
/// left half of the slave has the nodes there and at its own rim.
#[test]
fn nodes_at_the_rim_of_a_master_have_their_pairs() {
    let rng = &mut Rng::with_seed(8);
    let slave = Sheet::rectangle(Shape::Q4, [2, 2], [[0.0, 1.0]; 2], (0.0, rng)).turned();
    let master = Sheet::rectangle(Shape::Q4, [1, 1], [[-0.5, 0.5], [-0.5, 1.5]], (0.0, rng));
    let settings = SurfaceSettings {
        pairing: Pairing::NodeToSurface,
        search_distance: None,
        ..SurfaceSettings::default()
    };
    let found = TwoSheets::new(3, slave, master).pair(&settings).unwrap();
    let slaves: Vec<usize> = found.pairs.iter().map(|pair| pair.slave).collect();
    assert_eq!((slaves, found.unpaired), (vec![0, 1, 3, 4, 6, 7], vec![2, 5, 8]));
}

/// The search looks at a number of boxes that grows as `n log n`: sixteen times the faces, with a
/// logarithm that doubles at most, cost at most 32 times as many, and all against all 256 times.
#[test]
fn the_search_is_nearly_linear() {
    let settings = SurfaceSettings { search_distance: Some(0.01), ..SurfaceSettings::default() };
    let cost = |cells| gapped(cells, 0.001).pair(&settings).unwrap().report.boxes_searched;
    let (few, many) = (cost(10), cost(40));
    assert!(many <= 32 * few, "{few}, {many}");
    assert!(many < 1600 * 1681 / 10, "{many}");
}

/// A refusal says what is wrong, where, and what to do.
#[test]
fn wrong_surfaces_are_refused_by_place() {
    let square = || vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let four = vec![vec![0, 1, 2, 3]];
    let message = |nodes: &[[f64; 3]], slave: &[Vec<usize>], master: &[Vec<usize>]| {
        let error = pair(3, nodes, [slave, master], &SurfaceSettings::default()).unwrap_err();
        error.to_string()
    };
    let slave = |slave: Vec<Vec<usize>>| message(&square(), &slave, &[]);
    assert_eq!(slave(vec![vec![0, 1]]), "slave face 0 has 2 nodes, a face has 3, 4, 6, 8 or 9");
    assert_eq!(slave(vec![vec![0, 1, 0]]), "slave face 0 has node 0 twice");
    let missing = "slave face 0 has node 7, the coordinates are those of 4 nodes: \
                   check the number from which nodes count";
    assert_eq!(slave(vec![vec![0, 1, 7]]), missing);
    let turned = slave(vec![vec![0, 1, 2], vec![0, 3, 2]]);
    assert!(turned.starts_with("slave face 1 and face 0 disagree at the edge of nodes 2 and 0: "));
    let crossed = slave(vec![vec![0, 1, 3, 2]]);
    assert!(crossed.starts_with("slave face 0 has no area: "), "{crossed}");
    assert!(crossed.ends_with(", or they are not in their order around it"), "{crossed}");
    let mut nodes = square();
    nodes[2] = [2.0, 0.0, 0.0];
    let flat = message(&nodes, &[vec![0, 1, 2]], &[]);
    assert_eq!(flat, "slave face 0 has no area: its nodes coincide or stand in one line");
    nodes[2][1] = f64::NAN;
    let nan = message(&nodes, &four, &[]);
    assert_eq!(nan, "coordinates[7] of node 2 in slave face 0 is not finite");
    let both = message(&square(), &four, &[vec![2, 1, 0]]);
    assert!(both.starts_with("master face 0 has node 2, which is on the slave side too: "));
    // Two layers of the master within reach.
    let layers: Vec<[f64; 3]> = [0.0, -0.1, -0.2]
        .iter()
        .flat_map(|z| square().into_iter().map(move |[x, y, _]| [x, y, *z]))
        .collect();
    let up = vec![vec![4, 5, 6, 7], vec![8, 9, 10, 11]];
    let layered = message(&layers, &[vec![3, 2, 1, 0]], &up);
    let expected = "slave face 0 lies under master faces that lie over each other, among 0, 1: ";
    assert!(layered.starts_with(expected), "{layered}");
    let distance = SurfaceSettings { search_distance: Some(-1.0), ..SurfaceSettings::default() };
    let error = pair(3, &square(), [&four, &[]], &distance).unwrap_err();
    assert_eq!(error.to_string(), "search_distance is -1, it must be positive");
    let error = pair(4, &[], [&[], &[]], &SurfaceSettings::default()).unwrap_err();
    assert_eq!(error.to_string(), "dim is 4, it must be 2 or 3");
}

/// A surface turned over finds no partner, and the report says why.
#[test]
fn a_surface_turned_over_is_said() {
    let rng = &mut Rng::with_seed(6);
    let square = Sheet::rectangle(Shape::Q4, [2, 2], [[0.0, 1.0]; 2], (0.0, rng));
    let sheets = TwoSheets::new(3, square.clone(), square);
    let found = sheets.pair(&SurfaceSettings::default()).unwrap();
    assert!(found.pairs.is_empty());
    assert_eq!(found.report.uncovered_faces, [0, 1, 2, 3]);
    assert!(found.report.not_opposed >= 4);
}

/// Pairs in space with an obstacle.
fn facing(
    coordinates: &[f64],
    slave: Faces<'_>,
    obstacle: &Obstacle,
    search_distance: Option<f64>,
) -> Result<SurfacePairs, signorini::Error> {
    let settings = SurfaceSettings { search_distance, ..SurfaceSettings::default() };
    pair_with_obstacle(3, coordinates, slave, obstacle, &settings)
}

/// Gaps and normals of nodes against obstacles, by elementary geometry.
#[test]
fn obstacles_face_nodes() {
    let rng = &mut Rng::with_seed(7);
    let sheet = Sheet::rectangle(Shape::Q4, [3, 3], [[-0.6, 0.6]; 2], (0.25, rng))
        .turned()
        .mapped(|[x, y, _]| [x, y, 1.2]);
    let coordinates = sheet.nodes.concat();
    let (start, nodes) = flat(&sheet.faces);
    let slave = Faces { start: &start, nodes: &nodes };
    let sphere = Obstacle::Sphere { centre: [0.0; 3], radius: 1.0, hollow: false };
    let bowl = Obstacle::Sphere { centre: [0.0; 3], radius: 2.0, hollow: true };
    let (point, axis) = ([0.0, 5.0, 0.0], [0.0, -3.0, 0.0]);
    let bar = Obstacle::Cylinder { point, axis, radius: 1.0, hollow: false };
    let plane = Obstacle::Plane { point: [7.0, 0.0, 1.0], outward: [0.0, 0.0, 2.0] };
    // A cone of 45 degrees under its apex at z = 1.
    let to_apex = [0.0, 0.0, 1.0];
    let cone = Obstacle::Cone { point: [0.0; 3], to_apex, radius: 1.0, hollow: false };
    let (centre, axis) = ([0.0; 3], [0.0, 0.0, -2.0]);
    let torus = Obstacle::Torus { centre, axis, radius: 0.5, ring: 1.0, hollow: false };
    for obstacle in [sphere, bowl, bar, plane, cone, torus] {
        let found = facing(&coordinates, slave, &obstacle, None).unwrap();
        assert_eq!(found.pairs.len(), 16);
        for pair in &found.pairs {
            let [x, y, z] = sheet.nodes[pair.slave];
            let across = x.hypot(y);
            let (ball, round) = ((x * x + y * y + z * z).sqrt(), x.hypot(z));
            let (gap, normal) = match obstacle {
                Obstacle::Sphere { hollow: false, .. } => {
                    (ball - 1.0, [x, y, z].map(|x| -x / ball))
                }
                Obstacle::Sphere { .. } => (2.0 - ball, [x, y, z].map(|x| x / ball)),
                Obstacle::Cylinder { .. } => (round - 1.0, [-x / round, 0.0, -z / round]),
                Obstacle::Plane { .. } => (z - 1.0, [0.0, 0.0, -1.0]),
                Obstacle::Cone { .. } if across < z - 1.0 => {
                    let from = across.hypot(z - 1.0);
                    (from, [x, y, z - 1.0].map(|x| -x / from))
                }
                Obstacle::Cone { .. } => {
                    let normal = [x / across, y / across, 1.0].map(|x| -x * 0.5_f64.sqrt());
                    ((across + z - 1.0) * 0.5_f64.sqrt(), normal)
                }
                Obstacle::Torus { .. } => {
                    let ring = across - 1.0;
                    let from = ring.hypot(z);
                    (from - 0.5, [ring * x / across, ring * y / across, z].map(|x| -x / from))
                }
            };
            assert!((pair.gap - gap).abs() < 1e-15, "{obstacle:?}: {pair:?}");
            assert!((0..3).all(|c| (pair.normal[c] - normal[c]).abs() < 1e-15), "{pair:?}");
            assert!(pair.masters().is_empty() && pair.area > 0.0);
        }
        assert!((found.report.covered_area - 1.44).abs() < 1e-14);
    }
    let near = facing(&coordinates, slave, &sphere, Some(0.3)).unwrap();
    assert_eq!(near.pairs.len() + near.unpaired.len(), 16);
    assert!(near.pairs.iter().all(|pair| pair.gap <= 0.3) && !near.unpaired.is_empty());
    let flat = Obstacle::Sphere { centre: [0.0; 3], radius: 0.0, hollow: false };
    let error = facing(&coordinates, slave, &flat, None).unwrap_err();
    assert_eq!(error.to_string(), "obstacle: its radius is 0, it must be positive and finite");
}

/// A rigid mesh gives the rows of a deformable one without its masters; a plane of triangles, inclined, has the
/// gap of the plane along the slave's normal, and a ball of triangles that of the ball up to the square of
/// their size: a sphere's arc of the length h is h² / 8 from its chord.
#[test]
fn rigid_meshes_face_nodes() {
    let rng = &mut Rng::with_seed(9);
    let slave = Sheet::rectangle(Shape::Q4, [3, 4], [[-0.4, 0.4]; 2], (0.25, rng))
        .turned()
        .mapped(|[x, y, _]| [x, y, 1.2]);
    let coordinates = slave.nodes.concat();
    let (start, nodes) = flat(&slave.faces);
    let faces = Faces { start: &start, nodes: &nodes };
    let found = |obstacle: &Sheet, pairing| {
        let (start, nodes) = flat(&obstacle.faces);
        let own = obstacle.nodes.concat();
        let master =
            Master::RigidFaces { coordinates: &own, faces: Faces { start: &start, nodes: &nodes } };
        let settings =
            SurfaceSettings { pairing, search_distance: Some(2.0), ..SurfaceSettings::default() };
        let surfaces = Surfaces { dim: 3, coordinates: &coordinates, slave: faces, master };
        let found = pair_surfaces(&surfaces, &settings, &mut unlimited()).unwrap();
        let both = TwoSheets::new(3, slave.clone(), obstacle.clone()).pair(&settings).unwrap();
        assert_eq!(found.pairs.len(), 20);
        for (pair, other) in found.pairs.iter().zip(&both.pairs) {
            let alone = other.clone().without_masters();
            assert_eq!(*pair, alone);
        }
        found
    };
    for pairing in [Pairing::DualMortar, Pairing::NodeToSurface] {
        let sheet = |cells, rng: &mut Rng| {
            Sheet::rectangle(Shape::T3, [cells; 2], [[-0.6, 0.6]; 2], (0.25, rng))
        };
        let incline = sheet(5, rng).mapped(|[x, y, _]| [x, y, 0.3 * x - 0.2 * y]);
        for pair in found(&incline, pairing).pairs {
            let [x, y, z] = pair.point;
            assert!((pair.gap - (z - 0.3 * x + 0.2 * y)).abs() < 1e-13, "{pairing:?}: {pair:?}");
        }
    }
    let mut ball = Sheet::rectangle(Shape::T3, [24; 2], [[-0.6, 0.6]; 2], (0.25, rng));
    let height = |[x, y, _]: [f64; 3]| (1.0 - x * x - y * y).sqrt();
    ball.nodes.iter_mut().for_each(|p| p[2] = height(*p));
    // The diagonal of a cell, half as long again by distortion; the surface curves 2.2 times as much as the
    // ball along z at the rim.
    let step = 1.5 * 2.0_f64.sqrt() * 1.2 / 24.0;
    for pair in found(&ball, Pairing::NodeToSurface).pairs {
        let error = pair.gap - (pair.point[2] - height(pair.point));
        assert!((0.0..step * step / 8.0 * 2.2).contains(&error), "{error:e}: {pair:?}");
    }
}

/// A uniform pressure of an obstacle loads quadratic faces as its integrals do: forces of the corners
/// are zero (6 nodes) or pull (8 nodes), although every area is positive.
#[test]
fn obstacles_load_quadratic_faces() {
    let plane = Obstacle::Plane { point: [0.0; 3], outward: [0.0, 0.0, 1.0] };
    for shape in SHAPES {
        let rng = &mut Rng::with_seed(8);
        let sheet = Sheet::rectangle(shape, [2, 2], [[0.0, 1.0]; 2], (0.25, rng));
        let loads = exact_sheet_loads(&sheet, [[0.0, 1.0]; 2]).unwrap();
        let sheet = sheet.turned();
        let (start, nodes) = flat(&sheet.faces);
        let slave = Faces { start: &start, nodes: &nodes };
        let found = facing(&sheet.nodes.concat(), slave, &plane, None).unwrap();
        assert!(found.pairs.iter().all(|pair| pair.area > 0.0 && pair.gap.abs() < 1e-15));
        for (force, load) in nodal_forces(&found, sheet.nodes.len(), 1.0).iter().zip(loads) {
            assert!((force[2] - load).abs() < 1e-14, "{shape:?}: {force:?}, {load}");
        }
    }
}

/// A square whose inner lines are bent, mid nodes on the bent lines: edges are curved.
fn bent(shape: Shape, cells: usize) -> Sheet {
    let wave = |x: f64| (std::f64::consts::PI * x).sin();
    let square = Sheet::rectangle(shape, [cells; 2], [[0.0, 1.0]; 2], (0.0, &mut Rng::new()));
    square.mapped(|[x, y, z]| {
        let bend = 0.1 * wave(x) * wave(y);
        [x + bend, y - bend, z]
    })
}

/// Faces with curved edges are cut into flat parts with straight edges. Areas and linear fields stay
/// exact, but slivers at an edge count for the neighbour's functions. An edge bulges by 2 % of its length
/// with 6 faces a side, and by half of that with twice as many: the error of nodal loads, relative to the
/// largest, is below 1 % and falls by 2 at least.
#[test]
fn the_error_of_curved_edges_falls_with_the_mesh() {
    for shape in [Shape::T6, Shape::Q8, Shape::Q9] {
        let error = |cells: usize| {
            let (above, below) = (bent(shape, cells), bent(shape, cells + 1));
            let loads = exact_sheet_loads(&below, [[-1.0, 2.0]; 2]).unwrap();
            let sheets = TwoSheets::new(3, above.turned(), below);
            let found = sheets.pair(&SurfaceSettings::default()).unwrap();
            assert!((found.report.covered_area - 1.0).abs() < 1e-12, "{shape:?}");
            let motion = |[x, y, _]: [f64; 3]| [1.0 + 2.0 * x - y, 0.5 - x + 0.7 * y, x + y];
            assert!(most_moved(&found, &sheets.nodes, motion) < 1e-12, "{shape:?}");
            let forces = nodal_forces(&found, sheets.nodes.len(), 1.0);
            let first = sheets.nodes.len() - loads.len();
            let largest = loads.iter().fold(0.0_f64, |most, load| most.max(load.abs()));
            let miss = forces[first..].iter().zip(&loads).map(|(f, load)| (f[2] + load).abs());
            miss.fold(0.0, f64::max) / largest
        };
        let errors = [6, 12].map(error);
        assert!(errors[0] < 0.01, "{shape:?}: {errors:?}");
        assert!(errors[1] < errors[0] / 2.0, "{shape:?}: {errors:?}");
    }
}

/// A part of a sphere of radius 1 in a hollow one of radius 1.02: the gap is 0.02, but for the error of
/// the meshes, of second order with linear faces and of third with quadratic ones: by 9 and by 27 from a
/// mesh to one three times as fine. The largest error depends on how the two meshes lie to each other
/// too: half an order less, and one order less, are asked for.
#[test]
fn gaps_of_curved_surfaces_converge() {
    let cap = |shape, cells, radius: f64, size: f64| {
        let flat = Sheet::rectangle(shape, [cells; 2], [[-size, size]; 2], (0.0, &mut Rng::new()));
        flat.mapped(|[x, y, _]| {
            let length = (1.0 + x * x + y * y).sqrt() / radius;
            [x / length, y / length, 1.0 / length]
        })
    };
    for (shape, factor) in
        [(Shape::T3, 5.0), (Shape::Q4, 5.0), (Shape::T6, 9.0), (Shape::Q8, 9.0), (Shape::Q9, 9.0)]
    {
        for pairing in [Pairing::DualMortar, Pairing::NodeToSurface] {
            let error = |cells| {
                let master = cap(shape, 2 * cells - 1, 1.02, 0.6).turned();
                let sheets = TwoSheets::new(3, cap(shape, cells, 1.0, 0.4), master);
                let settings = SurfaceSettings {
                    pairing,
                    search_distance: None,
                    ..SurfaceSettings::default()
                };
                let found = sheets.pair(&settings).unwrap();
                assert!(found.unpaired.is_empty(), "{shape:?}, {pairing:?}");
                found.pairs.iter().map(|pair| (pair.gap - 0.02).abs()).fold(0.0, f64::max)
            };
            let errors = [4, 12].map(error);
            assert!(errors[1] < errors[0] / factor, "{shape:?}, {pairing:?}: {errors:?}");
        }
    }
}

/// Squares of one body that meet in an edge, in the plane in a node, as those of voxels: two faces run along it each way. The
/// soles of both are paired, and the walls around the edge cancel in the mean normal there.
#[test]
fn bodies_may_meet_in_an_edge() {
    let at = |x: f64, y: f64, z: f64| [x, y, z];
    let grid = |z| (0..9).map(move |k| at(f64::from(k % 3), f64::from(k / 3), z));
    let mut nodes: Vec<[f64; 3]> = grid(0.0).chain(grid(1.0)).collect();
    nodes.extend([
        at(-1.0, -1.0, -0.1),
        at(3.0, -1.0, -0.1),
        at(3.0, 3.0, -0.1),
        at(-1.0, 3.0, -0.1),
    ]);
    let soles = [vec![0, 3, 4, 1], vec![4, 7, 8, 5]];
    let walls = [vec![1, 4, 13, 10], vec![4, 3, 12, 13], vec![7, 4, 13, 16], vec![4, 5, 14, 13]];
    let slave = [&soles[..], &walls].concat();
    let found = pair(3, &nodes, [&slave, &[vec![18, 19, 20, 21]]], &SurfaceSettings::default());
    let found = found.unwrap();
    assert_eq!(found.pairs.len(), 7);
    assert!((found.report.covered_area - 2.0).abs() < 1e-14);
    assert_eq!(found.pairs.iter().find(|pair| pair.slave == 4).unwrap().normal, [0.0, 0.0, -1.0]);
    // In the plane the normals of both squares cancel in the node: that of the line over the master is taken.
    let mut nodes: Vec<[f64; 3]> = grid(0.0).collect();
    nodes.extend([at(-1.0, -0.1, 0.0), at(3.0, -0.1, 0.0)]);
    let squares = [[0, 1], [1, 4], [4, 3], [3, 0], [4, 5], [5, 8], [8, 7], [7, 4]];
    let slave: Vec<Vec<usize>> = squares.iter().map(|line| line.to_vec()).collect();
    let found = |pairing| {
        let settings = SurfaceSettings { pairing, ..SurfaceSettings::default() };
        pair(2, &nodes, [&slave, &[vec![10, 9]]], &settings)
    };
    let pairs = found(Pairing::DualMortar).unwrap().pairs;
    assert_eq!(pairs.iter().find(|pair| pair.slave == 4).unwrap().normal, [0.0, -1.0, 0.0]);
    let error = found(Pairing::NodeToSurface).unwrap_err().to_string();
    assert!(
        error.contains("at node 4 cancel: leave out those of them that cannot touch"),
        "{error}"
    );
}

/// A plate on an O-ring: its middle stands on the axis, where all normals are as good. Out of reach it has no pair; within
/// reach it is refused. The rim touches the top of the tube: gaps of zero to a few roundings.
#[test]
fn a_node_on_an_axis_counts_within_reach() {
    let coordinates =
        [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]];
    let (start, nodes) = flat(&[vec![0, 2, 1], vec![0, 3, 2], vec![0, 4, 3], vec![0, 1, 4]]);
    let slave = Faces { start: &start, nodes: &nodes };
    let (centre, axis) = ([0.0, 0.0, -0.3], [0.0, 0.0, 1.0]);
    let found = |ring: f64, search_distance: Option<f64>| {
        let tube = Obstacle::Torus { centre, axis, radius: 0.3, ring, hollow: false };
        let settings = SurfaceSettings { search_distance, ..SurfaceSettings::default() };
        pair_with_obstacle(3, &coordinates.concat(), slave, &tube, &settings)
    };
    // From the middle to the tube.
    let away = 1.0_f64.hypot(0.3) - 0.3;
    let near = found(1.0, Some(0.99 * away)).unwrap();
    assert!(near.pairs.iter().map(|pair| pair.slave).eq(1..5));
    assert!(near.pairs.iter().all(|pair| pair.gap.abs() < 1e-15));
    assert_eq!(near.unpaired, [0]);
    for search_distance in [None, Some(1.01 * away)] {
        let error = found(1.0, search_distance).unwrap_err().to_string();
        let says = "obstacle: node 0 stands on its axis or in its centre, where it has no normal: leave out the faces there";
        assert!(error.starts_with(says), "{error}");
    }
    let error = found(0.0, None).unwrap_err().to_string();
    assert_eq!(error, "obstacle: its ring is 0, it must be positive and finite");
}
