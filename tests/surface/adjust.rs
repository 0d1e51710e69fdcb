//! Ties of curved sides whose meshes do not match, after their nodes were moved onto each other.

use crate::common::solids::{Cells, Order, Point, Solid};
use crate::surfaces::{pair, steps, unlimited};
use fastrand::Rng;
use signorini::reduce::ContactPairs;
use signorini::surface::{SurfacePairs, SurfaceSettings};
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

    /// The mean traction of the tie beside Young's modulus times the angle, while the bottom turns about an axis and the rest
    /// follows: there is none where rows keep rigid motions.
    fn of_turn(&self, upper_is_slave: bool, axis: usize) -> f64 {
        let (nodes, arrays) =
            (self.nodes(), self.pairs(upper_is_slave, &Default::default()).rows());
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
        let sum: f64 = force.map(|f| f.iter().map(|f| f * f).sum::<f64>().sqrt()).sum();
        sum / arrays.areas.iter().sum::<f64>() / YOUNG
    }
}

/// A rigid turn of tied blocks leaves a mean traction of less than a thousandth of Young's modulus times the angle with
/// linear elements, and of a ten-thousandth with quadratic ones; a move makes it at least ten and three times less.
#[test]
fn a_rigid_turn_is_free_after_the_move() {
    for (order, bar, factor) in [(Order::Linear, 1e-3, 10.0), (Order::Edges, 1e-4, 3.0)] {
        for upper_is_slave in [false, true] {
            let mut blocks = Blocks::new([5, 7], order);
            let before = blocks.of_turn(upper_is_slave, 1);
            blocks.adjust(upper_is_slave);
            let after = blocks.of_turn(upper_is_slave, 1);
            let context = format!("{order:?}, {upper_is_slave}: {before:e}, then {after:e}");
            assert!(after < bar && factor * after < before, "{context}");
        }
    }
}
