//! Curved bodies that lie on an elastic block and are pressed and pushed: nothing else holds them, few of their
//! pairs close, and a push rolls them until the contact stands under the resultant of the loads.

use fastrand::Rng;
use signorini::reduce::ContactPairs;
use signorini::{FrictionLaw, LoadCase, Model, Monitor, Settings, Solution};

use super::mesh::steps;
use super::solids::{Cells, Order, Solid};

/// The lower side of the body.
#[derive(Clone, Copy, Debug)]
pub enum Side {
    /// A cylinder about an axis along y, of this radius.
    Cylinder(f64),
    Ball(f64),
}

impl Side {
    /// How high it is above its lowest point.
    fn height(self, x: f64, y: f64) -> f64 {
        let (radius, square) = match self {
            Side::Cylinder(radius) => (radius, x * x),
            Side::Ball(radius) => (radius, x * x + y * y),
        };
        radius - (radius * radius - square).sqrt()
    }
}

/// The shape of a body and the block that it lies on.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    pub side: Side,
    /// Half of the lengths along x and y, and the height of the upper side.
    pub size: [f64; 3],
    /// Bricks along x, y, z.
    pub cells: [usize; 3],
    /// Young's moduli of the body and of the block.
    pub young: [f64; 2],
}

/// A body on a block whose lower side is clamped.
pub struct Rolling {
    pub model: Model,
    pub gap: Vec<f64>,
    /// Nodes of the upper side of the body.
    top: Vec<usize>,
    size: usize,
}

impl Shape {
    /// The body with a pair at each node of its lower side, which faces the plane upper side of the block.
    pub fn model(&self) -> Rolling {
        let [a, b, height] = self.size;
        let [nx, ny, nz] = self.cells;
        let rng = &mut Rng::with_seed(0);
        let kind = (Cells::Boxes, Order::Linear);
        let lines = [steps(-a, a, nx), steps(-b, b, ny), steps(0.0, 1.0, nz)];
        let lines = lines.each_ref().map(Vec::as_slice);
        let mut body = Solid::new(&lines, kind, (self.young[0], 0.3), (0.0, rng));
        for node in &mut body.nodes {
            let below = self.side.height(node[0], node[1]);
            node[2] = below + node[2] * (height - below);
        }
        // Lines that meet those of the body in no point.
        let under = [steps(-1.1 * a, 1.1 * a, 9), steps(-1.1 * b, 1.1 * b, 4)];
        let depth = steps(-0.5 * a, 0.0, 2);
        let block =
            Solid::new(&[&under[0], &under[1], &depth], kind, (self.young[1], 0.3), (0.0, rng));
        let stiffness = Solid::stiffness(&[&body, &block]);
        let first = body.nodes.len();
        let count = (nx + 1) * (ny + 1);
        let (mut start, mut masters, mut weights) = (vec![0], Vec::new(), Vec::new());
        for node in &body.nodes[..count] {
            for (own, share) in corners(&under, [node[0], node[1]]) {
                // The upper layer of the block.
                let own = first + own + 2 * under[0].len() * under[1].len();
                masters.extend([3 * own, 3 * own + 1, 3 * own + 2]);
                weights.push(share);
            }
            start.push(weights.len());
        }
        let pairs = ContactPairs {
            dim: 3,
            count,
            slaves: &(0..3 * count).collect::<Vec<usize>>(),
            master_start: &start,
            masters: &masters,
            weights: &weights,
            normals: &[0.0, 0.0, -1.0].repeat(count),
            tangents: None,
            ..ContactPairs::default()
        };
        let clamped = 3 * first..3 * (first + under[0].len() * under[1].len());
        let fixed: Vec<usize> = clamped.collect();
        Rolling {
            model: Model::sparse(&stiffness.view(), &fixed, &pairs).expect("a valid model"),
            gap: body.nodes[..count].iter().map(|node| node[2]).collect(),
            top: (first - count..first).collect(),
            size: stiffness.size,
        }
    }
}

/// The nodes of a grid around a place, with their bilinear weights.
fn corners(lines: &[Vec<f64>; 2], place: [f64; 2]) -> Vec<(usize, f64)> {
    let cell: [(usize, f64); 2] = std::array::from_fn(|c| {
        let lines = &lines[c];
        let i = (1..lines.len() - 1).find(|&i| place[c] < lines[i]).unwrap_or(lines.len() - 1) - 1;
        (i, (place[c] - lines[i]) / (lines[i + 1] - lines[i]))
    });
    let [(i, s), (j, t)] = cell;
    let node = |i: usize, j: usize| i + lines[0].len() * j;
    let all = [
        (node(i, j), (1.0 - s) * (1.0 - t)),
        (node(i + 1, j), s * (1.0 - t)),
        (node(i, j + 1), (1.0 - s) * t),
        (node(i + 1, j + 1), s * t),
    ];
    all.into_iter().filter(|(_, share)| *share != 0.0).collect()
}

impl Rolling {
    /// The solution under a weight and a push along a direction of the plane, both spread over the upper side.
    pub fn solve(&self, weight: f64, push: [f64; 2], mu: f64, settings: &Settings) -> Solution {
        let mut load = vec![0.0; self.size];
        let share = 1.0 / self.top.len() as f64;
        for node in &self.top {
            for (c, force) in [push[0], push[1], -weight].into_iter().enumerate() {
                load[3 * node + c] = share * force;
            }
        }
        let mu = vec![mu; self.gap.len()];
        let case = LoadCase {
            load: &load,
            prescribed: None,
            gap: &self.gap,
            law: FrictionLaw::Coulomb(&mu),
            reference_slip: None,
        };
        let monitor = &mut Monitor::new(settings, None);
        self.model.solve(&case, settings, None, monitor).expect("the data is valid")
    }
}
