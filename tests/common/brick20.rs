//! Blocks of 20-node bricks: serendipity functions, 3 x 3 x 3 Gauss points, isotropic, rectangular.

use std::collections::HashMap;

use super::mesh::Stiffness;

/// Corners, then mid nodes of the edges, in natural coordinates.
const NODES: [[i8; 3]; 20] = [
    [-1, -1, -1],
    [1, -1, -1],
    [1, 1, -1],
    [-1, 1, -1],
    [-1, -1, 1],
    [1, -1, 1],
    [1, 1, 1],
    [-1, 1, 1],
    [0, -1, -1],
    [1, 0, -1],
    [0, 1, -1],
    [-1, 0, -1],
    [0, -1, 1],
    [1, 0, 1],
    [0, 1, 1],
    [-1, 0, 1],
    [-1, -1, 0],
    [1, -1, 0],
    [1, 1, 0],
    [-1, 1, 0],
];

pub struct Brick20 {
    pub nodes: Vec<[f64; 3]>,
    pub elements: Vec<[usize; 20]>,
    /// (E, nu).
    pub material: (f64, f64),
}

impl Brick20 {
    /// The block `from` to `to` with `cells` bricks.
    pub fn new(cells: [usize; 3], from: [f64; 3], to: [f64; 3], material: (f64, f64)) -> Brick20 {
        let mut block = Brick20 { nodes: vec![], elements: vec![], material };
        let mut known: HashMap<[usize; 3], usize> = HashMap::new();
        for k in 0..cells[2] {
            for j in 0..cells[1] {
                for i in 0..cells[0] {
                    let element = NODES.map(|place| {
                        // Half steps from the first corner.
                        let at: [usize; 3] =
                            std::array::from_fn(|c| 2 * [i, j, k][c] + (place[c] + 1) as usize);
                        *known.entry(at).or_insert_with(|| {
                            let part = |c: usize| at[c] as f64 / (2 * cells[c]) as f64;
                            let x = |c: usize| from[c] + (to[c] - from[c]) * part(c);
                            block.nodes.push([x(0), x(1), x(2)]);
                            block.nodes.len() - 1
                        })
                    });
                    block.elements.push(element);
                }
            }
        }
        block
    }

    /// Faces on the lower side (seen from below) or on the upper one, 8 nodes each; `first` is the number
    /// of the first node.
    pub fn faces(&self, upper: bool, first: usize) -> Vec<Vec<usize>> {
        let ends = self.nodes.iter().map(|p| p[2]);
        let level =
            if upper { ends.fold(f64::MIN, f64::max) } else { ends.fold(f64::MAX, f64::min) };
        let local: [usize; 8] =
            if upper { [4, 5, 6, 7, 12, 13, 14, 15] } else { [3, 2, 1, 0, 10, 9, 8, 11] };
        let is_there = |face: &Vec<usize>| face.iter().all(|&node| self.nodes[node][2] == level);
        let of = |element: &[usize; 20]| local.map(|k| element[k]).to_vec();
        let faces = self.elements.iter().map(of).filter(is_there);
        faces.map(|face| face.iter().map(|node| first + node).collect()).collect()
    }

    /// Loads of a unit pressure along z on a side: -1/12 of a face at corners, 1/3 at mid nodes.
    pub fn unit_loads(&self, upper: bool) -> Vec<(usize, f64)> {
        let mut loads = Vec::new();
        for face in self.faces(upper, 0) {
            let [a, c] = [face[0], face[2]].map(|node| self.nodes[node]);
            let area = ((a[0] - c[0]) * (a[1] - c[1])).abs();
            let share = |k: usize| if k < 4 { -1.0 / 12.0 } else { 1.0 / 3.0 };
            loads.extend(face.iter().enumerate().map(|(k, &node)| (node, area * share(k))));
        }
        loads
    }

    pub fn stiffness(&self) -> Stiffness {
        let size = 3 * self.nodes.len();
        let sizes: [f64; 3] = {
            let [a, b] = [0, 6].map(|k| self.nodes[self.elements[0][k]]);
            std::array::from_fn(|c| b[c] - a[c])
        };
        let matrix = element(sizes, self.material);
        let mut sums: Vec<HashMap<usize, f64>> = vec![HashMap::new(); size];
        for nodes in &self.elements {
            for (p, &a) in nodes.iter().enumerate() {
                for (q, &b) in nodes.iter().enumerate() {
                    for (c, d) in (0..9).map(|k| (k / 3, k % 3)) {
                        if 3 * a + c >= 3 * b + d {
                            let entry = matrix[3 * p + c][3 * q + d];
                            *sums[3 * b + d].entry(3 * a + c).or_default() += entry;
                        }
                    }
                }
            }
        }
        let mut lower = Stiffness { size, col_start: vec![0], row: vec![], values: vec![] };
        for column in sums {
            let mut column: Vec<(usize, f64)> = column.into_iter().collect();
            column.sort_by_key(|(row, _)| *row);
            lower.row.extend(column.iter().map(|(row, _)| *row as i64));
            lower.values.extend(column.iter().map(|(_, value)| value));
            lower.col_start.push(lower.row.len() as i64);
        }
        lower
    }
}

/// The stiffness of a rectangular element of these sizes.
fn element(sizes: [f64; 3], (young, poisson): (f64, f64)) -> Vec<Vec<f64>> {
    let lambda = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
    let shear = young / (2.0 * (1.0 + poisson));
    let gauss = [(-0.6_f64.sqrt(), 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.6_f64.sqrt(), 5.0 / 9.0)];
    let mut matrix = vec![vec![0.0; 60]; 60];
    for (x, y, z) in (0..27).map(|k| (gauss[k % 3], gauss[k / 3 % 3], gauss[k / 9])) {
        let weight = x.1 * y.1 * z.1 * sizes.iter().product::<f64>() / 8.0;
        let slopes: Vec<[f64; 3]> = (0..20)
            .map(|k| {
                let slope = slope(k, [x.0, y.0, z.0]);
                std::array::from_fn(|c| slope[c] * 2.0 / sizes[c])
            })
            .collect();
        for (p, a) in slopes.iter().enumerate() {
            for (q, b) in slopes.iter().enumerate() {
                let along: f64 = (0..3).map(|c| a[c] * b[c]).sum();
                for (c, d) in (0..9).map(|k| (k / 3, k % 3)) {
                    let same = if c == d { shear * along } else { 0.0 };
                    matrix[3 * p + c][3 * q + d] +=
                        weight * (lambda * a[c] * b[d] + shear * a[d] * b[c] + same);
                }
            }
        }
    }
    matrix
}

/// The derivatives of a function in natural coordinates, by its factors.
fn slope(k: usize, x: [f64; 3]) -> [f64; 3] {
    let node = NODES[k].map(f64::from);
    // Factor (1 + s x) of a coordinate, or (1 - x²) across the mid node.
    let factor = |c: usize| if node[c] == 0.0 { 1.0 - x[c] * x[c] } else { 1.0 + node[c] * x[c] };
    let change = |c: usize| if node[c] == 0.0 { -2.0 * x[c] } else { node[c] };
    let is_corner = node.iter().all(|n| *n != 0.0);
    std::array::from_fn(|c| {
        let others: f64 = (0..3).filter(|e| *e != c).map(factor).product();
        if is_corner {
            let sum: f64 = (0..3).map(|e| node[e] * x[e]).sum::<f64>() - 2.0;
            0.125 * others * (change(c) * sum + factor(c) * node[c])
        } else {
            0.25 * others * change(c)
        }
    })
}
