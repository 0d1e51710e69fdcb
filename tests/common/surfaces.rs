//! Two flat surfaces of any kind of face for the tests of the pairing, and sums over their rows.

use fastrand::Rng;
use signorini::surface::{
    Faces, Master, Obstacle, SurfacePairs, SurfaceSettings, Surfaces, pair_surfaces,
};
use signorini::{Monitor, Settings};

/// A list of faces with coordinates of its own nodes.
#[derive(Clone, Debug, Default)]
pub struct Sheet {
    pub nodes: Vec<[f64; 3]>,
    pub faces: Vec<Vec<usize>>,
}

/// Shape of the faces of a sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    T3,
    Q4,
    T6,
    Q8,
    Q9,
    /// T3 and Q4 by turns.
    Linear,
    /// T6 and Q8 by turns.
    Quadratic,
    /// T6 and Q9 by turns.
    Full,
    /// Q8 and Q9 by turns.
    Eight,
}

impl Shape {
    /// `true` if all faces are quadrilaterals.
    pub fn is_quadrilateral(self) -> bool {
        matches!(self, Shape::Q4 | Shape::Q8 | Shape::Q9 | Shape::Eight)
    }
}

pub const SHAPES: [Shape; 9] = [
    Shape::T3,
    Shape::Q4,
    Shape::T6,
    Shape::Q8,
    Shape::Q9,
    Shape::Linear,
    Shape::Quadratic,
    Shape::Full,
    Shape::Eight,
];

impl Sheet {
    /// A rectangle in the plane z = 0 with its normal upwards: `cells` squares, or twice as many
    /// triangles. Inner corners are moved by up to `distortion` of a cell; edges stay straight.
    pub fn rectangle(
        shape: Shape,
        cells: [usize; 2],
        [x, y]: [[f64; 2]; 2],
        (distortion, rng): (f64, &mut Rng),
    ) -> Sheet {
        let [nx, ny] = cells;
        let mut sheet = Sheet::default();
        let steps = [(x[1] - x[0]) / nx as f64, (y[1] - y[0]) / ny as f64];
        for j in 0..=ny {
            for i in 0..=nx {
                let mut move_by = |inside: bool| {
                    if inside { distortion * (2.0 * rng.f64() - 1.0) } else { 0.0 }
                };
                let inside = i % nx != 0 && j % ny != 0;
                let (a, b) = (move_by(inside), move_by(inside));
                let place = [x[0] + (i as f64 + a) * steps[0], y[0] + (j as f64 + b) * steps[1]];
                sheet.nodes.push([place[0], place[1], 0.0]);
            }
        }
        for j in 0..ny {
            for i in 0..nx {
                let node = |i, j| i + (nx + 1) * j;
                let [a, b, c, d] = [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)];
                let even = (i + j) % 2 == 0;
                match shape {
                    shape if shape.is_quadrilateral() => sheet.faces.push(vec![a, b, c, d]),
                    Shape::Linear | Shape::Quadratic | Shape::Full if even => {
                        sheet.faces.push(vec![a, b, c, d]);
                    }
                    _ if even => sheet.faces.extend([vec![a, b, c], vec![a, c, d]]),
                    _ => sheet.faces.extend([vec![a, b, d], vec![b, c, d]]),
                }
            }
        }
        sheet.add_mids(shape);
        sheet
    }

    fn add_mids(&mut self, shape: Shape) {
        if matches!(shape, Shape::T3 | Shape::Q4 | Shape::Linear) {
            return;
        }
        let mut mids = std::collections::HashMap::new();
        for (place, face) in self.faces.iter_mut().enumerate() {
            let corners = face.clone();
            for (i, &a) in corners.iter().enumerate() {
                let b = corners[(i + 1) % corners.len()];
                let mid = *mids.entry((a.min(b), a.max(b))).or_insert_with(|| {
                    self.nodes.push(mean(&[self.nodes[a], self.nodes[b]]));
                    self.nodes.len() - 1
                });
                face.push(mid);
            }
            let has_centre = match shape {
                Shape::Q9 => true,
                Shape::Full => corners.len() == 4,
                Shape::Eight => place % 2 == 1,
                _ => false,
            };
            if has_centre {
                let corners: Vec<[f64; 3]> = corners.iter().map(|&node| self.nodes[node]).collect();
                self.nodes.push(mean(&corners));
                face.push(self.nodes.len() - 1);
            }
        }
    }

    /// Turns all faces over, so that normals point the other way.
    pub fn turned(mut self) -> Sheet {
        for face in &mut self.faces {
            let corners = if matches!(face.len(), 3 | 6) { 3 } else { 4 };
            let mids = face.len() / corners > 1;
            face[..corners].reverse();
            if mids {
                // Mid i stands between corners i and i + 1: the last edge stays the last.
                face[corners..2 * corners - 1].reverse();
            }
        }
        self
    }

    /// Moves mid nodes and centres to the means of corners.
    pub fn straightened(mut self) -> Sheet {
        for face in &self.faces {
            let count = if matches!(face.len(), 3 | 6) { 3 } else { 4 };
            let corners: Vec<[f64; 3]> =
                face[..count].iter().map(|&node| self.nodes[node]).collect();
            for (i, &node) in face[count..].iter().enumerate() {
                let ends = [corners[i % count], corners[(i + 1) % count]];
                self.nodes[node] = mean(if i < count { &ends } else { &corners });
            }
        }
        self
    }

    /// Moves all nodes.
    pub fn mapped(mut self, map: impl Fn([f64; 3]) -> [f64; 3]) -> Sheet {
        self.nodes.iter_mut().for_each(|node| *node = map(*node));
        self
    }
}

fn mean(points: &[[f64; 3]]) -> [f64; 3] {
    std::array::from_fn(|c| points.iter().map(|p| p[c]).sum::<f64>() / points.len() as f64)
}

/// Two sheets in one numbering: the slave's nodes first.
#[derive(Clone, Debug)]
pub struct TwoSheets {
    pub dim: usize,
    pub nodes: Vec<[f64; 3]>,
    pub slave: Vec<Vec<usize>>,
    pub master: Vec<Vec<usize>>,
}

impl TwoSheets {
    pub fn new(dim: usize, slave: Sheet, master: Sheet) -> TwoSheets {
        let first = slave.nodes.len();
        let shifted = |face: Vec<usize>| face.into_iter().map(|node| node + first).collect();
        TwoSheets {
            dim,
            nodes: [slave.nodes, master.nodes].concat(),
            slave: slave.faces,
            master: master.faces.into_iter().map(shifted).collect(),
        }
    }

    pub fn pair(&self, settings: &SurfaceSettings) -> Result<SurfacePairs, signorini::Error> {
        pair(self.dim, &self.nodes, [&self.slave, &self.master], settings)
    }
}

/// Pairs lists of faces, slave and master.
pub fn pair(
    dim: usize,
    nodes: &[[f64; 3]],
    [slave, master]: [&[Vec<usize>]; 2],
    settings: &SurfaceSettings,
) -> Result<SurfacePairs, signorini::Error> {
    let coordinates: Vec<f64> = nodes.iter().flat_map(|node| node[..dim].to_vec()).collect();
    let (slave, master) = (flat(slave), flat(master));
    let surfaces = Surfaces {
        dim,
        coordinates: &coordinates,
        slave: Faces { start: &slave.0, nodes: &slave.1 },
        master: Master::Faces(Faces { start: &master.0, nodes: &master.1 }),
    };
    pair_surfaces(&surfaces, settings, &mut unlimited())
}

/// Pairs of a surface with an obstacle.
pub fn pair_with_obstacle(
    dim: usize,
    coordinates: &[f64],
    slave: Faces<'_>,
    obstacle: &Obstacle,
    settings: &SurfaceSettings,
) -> Result<SurfacePairs, signorini::Error> {
    let surfaces = Surfaces { dim, coordinates, slave, master: Master::RigidShape(*obstacle) };
    pair_surfaces(&surfaces, settings, &mut unlimited())
}

/// A monitor without limits.
pub fn unlimited<'a>() -> Monitor<'a> {
    Monitor::new(&Settings::default(), None)
}

/// Starts and nodes of lists.
pub fn flat(faces: &[Vec<usize>]) -> (Vec<usize>, Vec<usize>) {
    let mut start = vec![0];
    faces.iter().for_each(|face| start.push(start.last().unwrap() + face.len()));
    (start, faces.concat())
}

/// Nodal forces of forces `pressure * area` along the normals: on slaves by their weights, on masters
/// by the opposite of theirs.
pub fn nodal_forces(found: &SurfacePairs, nodes: usize, pressure: f64) -> Vec<[f64; 3]> {
    let mut forces = vec![[0.0; 3]; nodes];
    for pair in &found.pairs {
        for (weights, sign) in [(pair.slaves(), -1.0), (pair.masters(), 1.0)] {
            for &(node, weight) in weights {
                let size = sign * pressure * pair.area * weight;
                forces[node].iter_mut().zip(pair.normal).for_each(|(f, n)| *f += size * n);
            }
        }
    }
    forces
}

/// The most that a displacement field opens or slips at a pair.
pub fn most_moved(
    found: &SurfacePairs,
    nodes: &[[f64; 3]],
    u: impl Fn([f64; 3]) -> [f64; 3],
) -> f64 {
    let moved = |pair: &signorini::surface::SurfacePair| {
        let sum = |weights: &[(usize, f64)], c: usize| -> f64 {
            weights.iter().map(|&(node, weight)| weight * u(nodes[node])[c]).sum()
        };
        (0..3).map(|c| (sum(pair.slaves(), c) - sum(pair.masters(), c)).abs()).fold(0.0, f64::max)
    };
    found.pairs.iter().map(moved).fold(0.0, f64::max)
}

/// Lines of 2 or 3 nodes between grid lines, from left to right; `first` is the number of the first node.
/// The body lies above: to the left.
pub fn line(x: &[f64], quadratic: bool, first: usize) -> (Vec<[f64; 3]>, Vec<Vec<usize>>) {
    let corners = x.len();
    let mut nodes: Vec<[f64; 3]> = x.iter().map(|&x| [x, 0.0, 0.0]).collect();
    let mut faces: Vec<Vec<usize>> =
        (0..corners - 1).map(|i| vec![first + i, first + i + 1]).collect();
    if quadratic {
        for (i, face) in faces.iter_mut().enumerate() {
            nodes.push([0.5 * (x[i] + x[i + 1]), 0.0, 0.0]);
            face.push(first + nodes.len() - 1);
        }
    }
    (nodes, faces)
}

/// Steps that differ by up to a quarter.
pub fn grid(from: f64, to: f64, count: usize, rng: &mut Rng) -> Vec<f64> {
    let step = (to - from) / count as f64;
    let mut x = steps(from, to, count);
    x[1..count].iter_mut().for_each(|x| *x += 0.25 * step * (2.0 * rng.f64() - 1.0));
    x
}

/// Loads of a unit pressure on the nodes of a line between two places: the integrals of its functions,
/// by Simpson's rule on the covered part of each face, which is exact to degree 3.
pub fn exact_loads(x: &[f64], quadratic: bool, [from, to]: [f64; 2]) -> Vec<f64> {
    let (nodes, faces) = line(x, quadratic, 0);
    let mut loads = vec![0.0; nodes.len()];
    for face in &faces {
        let [a, b] = [nodes[face[0]][0], nodes[face[1]][0]];
        let [low, high] = [a.max(from), b.min(to)];
        if low >= high {
            continue;
        }
        for (x, weight) in [(low, 1.0), (0.5 * (low + high), 4.0), (high, 1.0)] {
            let s = (2.0 * x - a - b) / (b - a);
            let values = if quadratic {
                vec![0.5 * s * (s - 1.0), 0.5 * s * (s + 1.0), 1.0 - s * s]
            } else {
                vec![0.5 * (1.0 - s), 0.5 * (1.0 + s)]
            };
            for (node, value) in face.iter().zip(values) {
                loads[*node] += weight * (high - low) / 6.0 * value;
            }
        }
    }
    loads
}

/// Equal steps.
pub fn steps(from: f64, to: f64, count: usize) -> Vec<f64> {
    (0..=count).map(|i| from + (to - from) * i as f64 / count as f64).collect()
}
