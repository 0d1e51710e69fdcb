//! Blocks on a wavy obstacle, on meshes that are fine along the contact and grow away from it.

use signorini::reduce::ContactPairs;
use signorini::{Error, Model, Monitor, Settings};

use super::brick::{Brick, Support};
use super::mesh::{Mesh, Stiffness, steps};

/// A block with its load case, which has stick, slip and open pairs.
pub struct Wavy {
    pub stiffness: Stiffness,
    pub load: Vec<f64>,
    pub prescribed: Option<Vec<f64>>,
    pub gap: Vec<f64>,
    fixed: Vec<usize>,
    slaves: Vec<usize>,
    normals: Vec<f64>,
    dim: usize,
}

/// Heights of layers that grow by `factor` from `first`, to a total of `height`.
fn layers(first: f64, factor: f64, height: f64) -> Vec<f64> {
    let mut heights = vec![first];
    while heights.iter().sum::<f64>() < height {
        heights.push(factor * heights[heights.len() - 1]);
    }
    let stretch = height / heights.iter().sum::<f64>();
    let mut lines = vec![0.0];
    for height in &heights {
        lines.push(lines[lines.len() - 1] + stretch * height);
    }
    lines
}

impl Wavy {
    /// Half of the bar on the plane (paper, section 4.1) with `columns` elements along the contact, on waves.
    pub fn plane(columns: usize) -> Wavy {
        let mut mesh = Mesh::default();
        let lines = layers(40.0 / columns as f64, 1.25, 40.0);
        let block = mesh.block(&steps(0.0, 40.0, columns), &lines, (13000.0, 0.2));
        let mut load = vec![0.0; mesh.size()];
        mesh.traction(&block.row(block.rows), [0.0, -5.0], &mut load);
        mesh.traction(&block.column(0), [10.0, 0.0], &mut load);
        let place = |i: usize| 40.0 * i as f64 / columns as f64;
        Wavy {
            stiffness: mesh.stiffness(),
            load,
            prescribed: None,
            gap: (0..=columns).map(|i| 1e-3 * (1.0 - (0.8 * place(i)).cos())).collect(),
            fixed: block.column(columns).iter().map(|node| 2 * node).collect(),
            slaves: block.row(0).iter().flat_map(|node| [2 * node, 2 * node + 1]).collect(),
            normals: [0.0, -1.0].repeat(columns + 1),
            dim: 2,
        }
    }

    /// A clamped block of 2 x 2 x 1 with `nodes` x `nodes` pairs, pressed down, shifted and turned.
    pub fn space(nodes: usize) -> Wavy {
        let lines = layers(2.0 / (nodes - 1) as f64, 1.2, 1.0);
        let cells = [nodes - 1, nodes - 1, lines.len() - 1];
        let mut brick = Brick::new(cells, [2.0, 2.0, 1.0], Support::Clamped);
        for (node, place) in brick.nodes.iter_mut().enumerate() {
            place[2] = lines[node / (nodes * nodes)];
        }
        let (load, prescribed) =
            brick.moved(|[x, y, _]| [0.008 - 0.005 * y, 0.003 + 0.005 * x, -0.03]);
        let gap = |pair: usize| {
            let [x, y, _] = brick.place(pair);
            0.01 * (1.0 - (4.0 * x).cos() * (3.0 * y + 0.5).cos())
        };
        let dofs = |node: &usize| [3 * node, 3 * node + 1, 3 * node + 2];
        Wavy {
            stiffness: brick.stiffness(),
            load,
            prescribed,
            gap: (0..brick.pairs()).map(gap).collect(),
            fixed: brick.fixed(),
            slaves: brick.contact.iter().flat_map(dofs).collect(),
            normals: brick.normal.repeat(brick.pairs()),
            dim: 3,
        }
    }

    /// The model under these settings.
    pub fn model(&self, settings: &Settings) -> Model {
        self.try_model(&mut Monitor::new(settings, None)).expect("a valid model")
    }

    /// The model, made within the limits of a monitor.
    pub fn try_model(&self, monitor: &mut Monitor<'_>) -> Result<Model, Error> {
        let count = self.gap.len();
        let pairs = ContactPairs {
            dim: self.dim,
            count,
            slaves: &self.slaves,
            master_start: &vec![0; count + 1],
            masters: &[],
            weights: &[],
            normals: &self.normals,
            tangents: None,
            ..ContactPairs::default()
        };
        self.stiffness.model_under(&self.fixed, &pairs, monitor)
    }
}
