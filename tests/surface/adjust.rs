//! Slave nodes moved onto the other side: ties of curved sides whose meshes do not match, and obstacles.

use crate::common::solids::{Cells, Order, Point, Solid};
use crate::surfaces::{SHAPES, Shape, Sheet, flat, pair, pair_with_obstacle, steps, unlimited};
use fastrand::Rng;
use signorini::reduce::ContactPairs;
use signorini::surface::{Faces, Obstacle, SurfacePairs, SurfaceSettings};
use signorini::{FrictionLaw, LoadCase, Model, Monitor, Settings, Status};

const YOUNG: f64 = 1000.0;

/// Two blocks on the unit square, of which the interface is a wave of an amplitude of 0.08.
struct Blocks {
    solids: [Solid; 2],
}

impl Blocks {
    fn new(cells: [usize; 2], order: Order) -> Blocks {
        let rng = &mut Rng::with_seed(21);
        let solids = [0, 1].map(|body| {
            let sides = [steps(0.0, 1.0, cells[body]), steps(0.0, 1.0, cells[body] + 1)];
            let levels = if body == 0 { steps(-0.5, 0.0, 2) } else { steps(0.0, 0.5, 2) };
            let lines = [&sides[0][..], &sides[1], &levels];
            let mut solid = Solid::new(&lines, (Cells::Boxes, order), (YOUNG, 0.3), (0.0, rng));
            for p in &mut solid.nodes {
                let wave = 0.08 * (3.0 * p[0] + 1.0).sin() * (2.0 * p[1]).cos();
                p[2] += wave * (1.0 - 2.0 * p[2].abs());
            }
            solid
        });
        Blocks { solids }
    }

    fn nodes(&self) -> Vec<Point> {
        [&self.solids[0].nodes[..], &self.solids[1].nodes].concat()
    }

    fn pairs(&self, upper_is_slave: bool, settings: &SurfaceSettings) -> SurfacePairs {
        let first = self.solids[0].nodes.len();
        let shifted = |face: &Vec<usize>| face.iter().map(|node| first + node).collect();
        let upper: Vec<Vec<usize>> = self.solids[1].lower.iter().map(shifted).collect();
        let lower = &self.solids[0].upper;
        let sides = if upper_is_slave { [&upper[..], lower] } else { [&lower[..], &upper] };
        pair(3, &self.nodes(), sides, settings).unwrap()
    }

    /// Moves the nodes of the slave.
    fn adjust(&mut self, upper_is_slave: bool) {
        let mut coordinates = self.nodes().concat();
        let found = self.pairs(upper_is_slave, &SurfaceSettings::default());
        found.adjust(f64::INFINITY, &mut coordinates, &mut unlimited()).unwrap();
        let mut places = coordinates.chunks(3).map(|p| [p[0], p[1], p[2]]);
        for solid in &mut self.solids {
            solid.nodes.iter_mut().for_each(|node| *node = places.next().unwrap());
        }
    }

    /// The mean traction of the tie and the largest of a pair, beside Young's modulus times the angle, while the bottom turns
    /// about an axis and the rest follows: there is none where rows keep rigid motions.
    fn of_turn(&self, upper_is_slave: bool, axis: usize, keep_turns: bool) -> [f64; 2] {
        let settings = SurfaceSettings { keep_turns, ..SurfaceSettings::default() };
        let (nodes, arrays) = (self.nodes(), self.pairs(upper_is_slave, &settings).rows());
        let stiffness = Solid::stiffness(&[&self.solids[0], &self.solids[1]]);
        let bottom = (0..nodes.len()).filter(|&node| nodes[node][2] == -0.5);
        let fixed: Vec<usize> = bottom.flat_map(|node| 3 * node..3 * node + 3).collect();
        let turned = |dof: &usize| {
            let (p, c) = (nodes[dof / 3], dof % 3);
            let [next, last] = [(axis + 1) % 3, (axis + 2) % 3];
            if c == next {
                -p[last]
            } else if c == last {
                p[next]
            } else {
                0.0
            }
        };
        let prescribed: Vec<f64> = fixed.iter().map(turned).collect();
        let model = Model::sparse(&stiffness.view(), &fixed, &ContactPairs::from(&arrays)).unwrap();
        let case = LoadCase {
            load: &vec![0.0; stiffness.size],
            prescribed: Some(&prescribed),
            gap: &vec![0.0; arrays.count],
            law: FrictionLaw::Tied,
            reference_slip: None,
        };
        let settings = Settings::default();
        let monitor = &mut Monitor::new(&settings, None);
        let solution = model.solve(&case, &settings, None, monitor).unwrap();
        assert_eq!(solution.status, Status::Solved, "{}", solution.message);
        let force = solution.certificate.force.chunks(3);
        let sizes: Vec<f64> =
            force.map(|f| f.iter().map(|f| f * f).sum::<f64>().sqrt() / YOUNG).collect();
        let largest = sizes.iter().zip(&arrays.areas).map(|(size, area)| size / area);
        let mean = sizes.iter().sum::<f64>() / arrays.areas.iter().sum::<f64>();
        [mean, largest.fold(0.0, f64::max)]
    }
}

/// A rigid turn of tied blocks leaves a mean traction of less than a thousandth of Young's modulus times the angle with
/// linear elements, and of a ten-thousandth with quadratic ones; a move makes it at least ten and three times less. After a
/// second one, of new pairs, that of no single pair is more.
#[test]
fn a_rigid_turn_is_free_after_the_move() {
    for (order, bar, factor) in [(Order::Linear, 1e-3, 10.0), (Order::Edges, 1e-4, 3.0)] {
        for upper_is_slave in [false, true] {
            let mut blocks = Blocks::new([5, 7], order);
            let [before, once, twice] = [0, 1, 2].map(|_| {
                let traction = blocks.of_turn(upper_is_slave, 1, false);
                // Rows that keep turns ask for no move: what is left is the rounding of the reduction.
                let kept = blocks.of_turn(upper_is_slave, 1, true);
                assert!(kept[1] < 1e-11, "{order:?}, {upper_is_slave}: {kept:?}");
                blocks.adjust(upper_is_slave);
                traction
            });
            let context = format!("{order:?}, {upper_is_slave}: {before:?}, {once:?}, {twice:?}");
            assert!(once[0] < bar && factor * once[0] < before[0], "{context}");
            assert!(twice[1] < bar, "{context}");
        }
    }
}

/// A sheet, and where its nodes are after they were moved onto an obstacle.
fn onto(sheet: &Sheet, obstacle: &Obstacle, within: f64) -> Vec<Point> {
    let (start, nodes) = flat(&sheet.faces);
    let (x, faces) = (sheet.nodes.concat(), Faces { start: &start, nodes: &nodes });
    let settings = SurfaceSettings::default();
    let found = pair_with_obstacle(3, &x, faces, obstacle, &settings).unwrap();
    let mut moved = x;
    found.adjust(within, &mut moved, &mut unlimited()).unwrap();
    moved.chunks(3).map(|p| [p[0], p[1], p[2]]).collect()
}

/// A wave above a plane comes down along the plane's normal, faces of any kind; conjugate gradients leave 1e-12. What is
/// further away than `within` stays where rows have one node.
#[test]
fn nodes_are_moved_onto_a_plane() {
    let plane = Obstacle::Plane { point: [0.0; 3], outward: [0.0, 0.0, 1.0] };
    let rng = &mut Rng::with_seed(22);
    for shape in SHAPES {
        let sheet = Sheet::rectangle(shape, [3, 4], [[0.0, 1.0]; 2], (0.2, rng)).turned();
        let sheet = sheet.mapped(|[x, y, _]| [x, y, 0.1 + 0.1 * x * y * y]);
        let all = onto(&sheet, &plane, f64::INFINITY);
        let near = onto(&sheet, &plane, 0.15);
        for ((before, all), near) in sheet.nodes.iter().zip(all).zip(near) {
            let [x, y, z] = *before;
            let apart = all.iter().zip([x, y, 0.0]).map(|(a, b)| (a - b).abs());
            assert!(apart.fold(0.0, f64::max) < 1e-12, "{shape:?}: {all:?}");
            if matches!(shape, Shape::T3 | Shape::Q4) {
                let level = if z <= 0.15 { 0.0 } else { z };
                assert!((near[2] - level).abs() < 1e-12, "{shape:?}: {near:?}");
            }
        }
    }
}

/// Onto a sphere nodes go along its radii.
#[test]
fn nodes_are_moved_onto_a_sphere() {
    let sphere = Obstacle::Sphere { centre: [0.5, 0.5, -2.0], radius: 2.0, hollow: false };
    let rng = &mut Rng::with_seed(23);
    for shape in [Shape::T3, Shape::Q4] {
        let sheet = Sheet::rectangle(shape, [3, 4], [[0.0, 1.0]; 2], (0.2, rng)).turned();
        let sheet = sheet.mapped(|[x, y, _]| [x, y, 0.1]);
        for (before, after) in sheet.nodes.iter().zip(onto(&sheet, &sphere, f64::INFINITY)) {
            let from = |p: &Point| [p[0] - 0.5, p[1] - 0.5, p[2] + 2.0];
            let size = from(before).iter().map(|x| x * x).sum::<f64>().sqrt();
            let apart = from(&after).into_iter().zip(from(before)).map(|(a, b)| a - 2.0 * b / size);
            assert!(apart.fold(0.0, |most: f64, a| most.max(a.abs())) < 1e-12, "{shape:?}");
        }
    }
}

/// Nodes move onto the other side, whatever gap the settings make of the measured one: those over a plane as those over faces in
/// it. Heights of 0 to a few roundings.
#[test]
fn a_clearance_moves_no_nodes() {
    let rng = &mut Rng::with_seed(22);
    let mut level = |z: f64| {
        let sheet = Sheet::rectangle(Shape::Q4, [2; 2], [[0.0, 1.0]; 2], (0.0, rng));
        sheet.mapped(|[x, y, _]| [x, y, z])
    };
    let (sole, floor) = (level(0.05).turned(), level(0.0));
    let (start, list) = flat(&sole.faces);
    let slave = Faces { start: &start, nodes: &list };
    let sheets = crate::surfaces::TwoSheets::new(3, sole.clone(), floor);
    let plane = Obstacle::Plane { point: [0.0; 3], outward: [0.0, 0.0, 1.0] };
    for (close_within, clearance) in [(0.0, 0.0), (0.0, -0.1), (0.0, 0.1), (0.06, 0.0)] {
        let settings = SurfaceSettings { close_within, clearance, ..Default::default() };
        let own = sole.nodes.concat();
        let on_plane = pair_with_obstacle(3, &own, slave, &plane, &settings).unwrap();
        for (found, coordinates) in
            [(on_plane, own), (sheets.pair(&settings).unwrap(), sheets.nodes.concat())]
        {
            for within in [0.07, f64::INFINITY] {
                let mut moved = coordinates.clone();
                found.adjust(within, &mut moved, &mut unlimited()).unwrap();
                let heights = moved.chunks(3).map(|p| p[2].abs());
                assert!(
                    heights.fold(0.0, f64::max) < 1e-15,
                    "{close_within}, {clearance}: {moved:?}"
                );
            }
        }
    }
}
