//! Half of the bar on the plane (paper, section 4.1) on a mesh that is fine along the contact line.

use signorini::Model;

use super::mesh::{Mesh, Pairs, steps};

/// Width and height of the half, mm.
const SIZE: f64 = 40.0;

/// Growth of the rows of elements away from the contact line.
const GROWTH: f64 = 1.5;

/// The reduced bar and its nodal loads.
pub struct GradedBar {
    pub model: Model,
    pub load: Vec<f64>,
}

impl GradedBar {
    /// `columns` square elements along the contact line, and rows that grow away from it.
    pub fn new(columns: usize) -> Self {
        let mut heights = vec![SIZE / columns as f64];
        while heights.iter().sum::<f64>() < SIZE {
            heights.push(GROWTH * heights[heights.len() - 1]);
        }
        let stretch = SIZE / heights.iter().sum::<f64>();
        let mut lines = vec![0.0];
        for height in &heights {
            lines.push(lines[lines.len() - 1] + stretch * height);
        }
        let mut mesh = Mesh::default();
        let block = mesh.block(&steps(0.0, SIZE, columns), &lines, (13000.0, 0.2));
        let mut load = vec![0.0; mesh.size()];
        mesh.traction(&block.row(block.rows), [0.0, -5.0], &mut load);
        mesh.traction(&block.column(0), [10.0, 0.0], &mut load);
        let fixed: Vec<usize> = block.column(columns).iter().map(|node| 2 * node).collect();
        let pairs = Pairs::on_obstacle(&block.row(0), [0.0, -1.0]);
        GradedBar { model: mesh.stiffness().model(&fixed, &pairs).expect("a valid model"), load }
    }
}
