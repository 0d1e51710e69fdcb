//! Blocks of 8-node bricks on a plane obstacle: trilinear, 2 x 2 x 2 Gauss points, isotropic.

use signorini::reduce::ContactPairs;
use signorini::{Error, Model, Monitor, Settings};

use super::dense::dot;
use super::mesh::Stiffness;
use super::problems::{Case, Law};

pub type Vector = [f64; 3];

/// Support of the upper face.
#[derive(Clone, Copy, Debug)]
pub enum Support {
    Clamped,
    /// Springs of this stiffness along each axis at each node, from the node to a plate.
    Springs(f64),
    /// Nothing: six rigid motions.
    Free,
}

/// A block that stands on its lower face, around the origin.
#[derive(Clone, Debug)]
pub struct Brick {
    /// Bricks along x, y, z.
    pub cells: [usize; 3],
    /// Node by node along x, then y, then z.
    pub nodes: Vec<Vector>,
    /// (E, nu).
    pub material: (f64, f64),
    pub support: Support,
    /// The outward normal of the lower face.
    pub normal: Vector,
    /// First tangents of the pairs; `None`: the library's choice.
    pub tangents: Option<Vec<Vector>>,
    /// The nodes of the lower face in the order of the pairs.
    pub contact: Vec<usize>,
    /// Degrees of freedom held at zero beside the support.
    pub held: Vec<usize>,
}

impl Brick {
    /// A block of `size` with `cells` bricks; it has `(cells[0] + 1)(cells[1] + 1)` pairs.
    pub fn new(cells: [usize; 3], size: Vector, support: Support) -> Brick {
        let [nx, ny, nz] = cells;
        let mut nodes = Vec::new();
        for k in 0..=nz {
            for j in 0..=ny {
                for i in 0..=nx {
                    let share = |i: usize, n: usize| i as f64 / n as f64;
                    nodes.push([
                        size[0] * (share(i, nx) - 0.5),
                        size[1] * (share(j, ny) - 0.5),
                        size[2] * share(k, nz),
                    ]);
                }
            }
        }
        let contact: Vec<usize> = (0..(nx + 1) * (ny + 1)).collect();
        let tangents = Some(vec![[1.0, 0.0, 0.0]; contact.len()]);
        let material = (1.0, 0.3);
        let (normal, held) = ([0.0, 0.0, -1.0], Vec::new());
        Brick { cells, nodes, material, support, normal, tangents, contact, held }
    }

    pub fn pairs(&self) -> usize {
        self.contact.len()
    }

    pub fn size(&self) -> usize {
        3 * self.nodes.len()
    }

    /// Nodes of the upper face.
    pub fn top(&self) -> std::ops::Range<usize> {
        let [nx, ny, _] = self.cells;
        self.nodes.len() - (nx + 1) * (ny + 1)..self.nodes.len()
    }

    /// The position of a pair's node.
    pub fn place(&self, pair: usize) -> Vector {
        self.nodes[self.contact[pair]]
    }

    fn elements(&self) -> impl Iterator<Item = [usize; 8]> + '_ {
        let [nx, ny, nz] = self.cells;
        let node = move |i, j, k| i + (nx + 1) * (j + (ny + 1) * k);
        (0..nx * ny * nz).map(move |e| {
            let (i, j, k) = (e % nx, e / nx % ny, e / nx / ny);
            CORNERS.map(|c| node(i + c[0], j + c[1], k + c[2]))
        })
    }

    /// The stiffness, components (x, y, z) of node after node.
    pub fn stiffness(&self) -> Stiffness {
        let size = self.size();
        let mut columns: Vec<Vec<(usize, f64)>> = vec![Vec::new(); size];
        // The bricks of a layer are alike, and those of layers of one height: one matrix serves them.
        let mut matrices: Vec<(f64, Vec<[f64; 24]>)> = Vec::new();
        for nodes in self.elements() {
            let height = self.nodes[nodes[6]][2] - self.nodes[nodes[0]][2];
            let alike = |(other, _): &(f64, _)| (other - height).abs() <= 1e-12 * height;
            if !matrices.last().is_some_and(alike) {
                matrices.push((height, element(nodes.map(|n| self.nodes[n]), self.material)));
            }
            let (_, matrix) = &matrices[matrices.len() - 1];
            for (a, row) in matrix.iter().enumerate() {
                for (b, entry) in row.iter().enumerate() {
                    let (i, j) = (3 * nodes[a / 3] + a % 3, 3 * nodes[b / 3] + b % 3);
                    if i >= j {
                        columns[j].push((i, *entry));
                    }
                }
            }
        }
        if let Support::Springs(spring) = self.support {
            for dof in self.top().flat_map(dofs) {
                columns[dof].push((dof, spring));
            }
        }
        let mut lower = Stiffness { size, col_start: vec![0], row: vec![], values: vec![] };
        for column in &mut columns {
            column.sort_by_key(|(i, _)| *i);
            let begin = lower.row.len();
            for &(i, value) in column.iter() {
                if lower.row.len() > begin && lower.row.last() == Some(&(i as i64)) {
                    *lower.values.last_mut().unwrap() += value;
                } else {
                    lower.row.push(i as i64);
                    lower.values.push(value);
                }
            }
            lower.col_start.push(lower.row.len() as i64);
        }
        lower
    }

    pub fn model(&self) -> Model {
        self.model_of(&self.stiffness())
    }

    /// The model of [`Self::stiffness`], for who has it already.
    pub fn model_of(&self, matrix: &Stiffness) -> Model {
        let monitor = &mut Monitor::new(&Settings::default(), None);
        self.model_within(matrix, None, monitor).expect("the block is a model")
    }

    /// The model in an order of elimination, within the limits of a monitor.
    pub fn model_within(
        &self,
        matrix: &Stiffness,
        order: Option<&[usize]>,
        monitor: &mut Monitor<'_>,
    ) -> Result<Model, Error> {
        let count = self.pairs();
        let tangents = self.tangents.as_ref().map(|tangents| tangents.concat());
        let pairs = ContactPairs {
            dim: 3,
            count,
            slaves: &self.contact.iter().flat_map(|&node| dofs(node)).collect::<Vec<_>>(),
            master_start: &vec![0; count + 1],
            masters: &[],
            weights: &[],
            normals: &vec![self.normal; count].concat(),
            tangents: tangents.as_deref(),
            ..ContactPairs::default()
        };
        Model::sparse_within(&matrix.view(), &self.fixed(), &pairs, order, monitor)
    }

    /// Degrees of freedom that are fixed.
    pub fn fixed(&self) -> Vec<usize> {
        let mut fixed: Vec<usize> = match self.support {
            Support::Clamped => self.top().flat_map(dofs).collect(),
            _ => Vec::new(),
        };
        fixed.extend(&self.held);
        fixed
    }

    /// Loads and prescribed displacements by which the plate moves as `motion` says of a place: a
    /// clamped face with it, springs at their upper ends.
    pub fn moved(&self, motion: impl Fn(Vector) -> Vector) -> (Vec<f64>, Option<Vec<f64>>) {
        let mut values: Vec<f64> = self.top().flat_map(|node| motion(self.nodes[node])).collect();
        let mut load = vec![0.0; self.size()];
        match self.support {
            Support::Clamped => {
                values.extend(self.held.iter().map(|_| 0.0));
                return (load, Some(values));
            }
            Support::Springs(spring) => {
                let top = 3 * self.top().start;
                load[top..].iter_mut().zip(&values).for_each(|(f, u)| *f = spring * u);
            }
            Support::Free => panic!("nothing holds the block"),
        }
        (load, None)
    }

    /// The condensed problem, without gaps and slip.
    pub fn case(&self, model: &Model, motion: impl Fn(Vector) -> Vector, mu: f64) -> Case {
        let (load, prescribed) = self.moved(motion);
        let f = model.condensed_load(&load, prescribed.as_deref()).unwrap();
        let pairs = self.pairs();
        Case {
            dim: 3,
            pairs,
            k: model.stiffness().to_vec(),
            f,
            gap: vec![0.0; pairs],
            law: Law::Coulomb(vec![mu; pairs]),
            slip: None,
        }
    }

    /// The axes of each pair in those of the block: normal and tangents.
    pub fn frames(model: &Model) -> Vec<[Vector; 3]> {
        let frames = model.frames().expect("a sparse model has frames");
        let axis = |pair: usize, c: usize| -> Vector {
            std::array::from_fn(|i| frames[9 * pair + 3 * c + i])
        };
        (0..model.pairs()).map(|pair| std::array::from_fn(|c| axis(pair, c))).collect()
    }

    /// Vectors of the pairs, given in the axes of the block, in the frames of the pairs.
    pub fn in_frames(model: &Model, vectors: impl IntoIterator<Item = Vector>) -> Vec<f64> {
        let frames = Self::frames(model).into_iter();
        frames.zip(vectors).flat_map(|(frame, v)| frame.map(|axis| dot(&axis, &v))).collect()
    }

    /// The rigid motions of the pairs, in their frames: along x, y, z and about them.
    pub fn rigid_motions(&self, model: &Model) -> [Vec<f64>; 6] {
        std::array::from_fn(|motion| {
            let mut axis = [0.0; 3];
            axis[motion % 3] = 1.0;
            let places = (0..self.pairs()).map(|pair| self.place(pair));
            let moved = |place| if motion < 3 { axis } else { cross(axis, place) };
            Self::in_frames(model, places.map(moved))
        })
    }
}

pub fn cross(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        a[j] * b[k] - a[k] * b[j]
    })
}

fn dofs(node: usize) -> [usize; 3] {
    [3 * node, 3 * node + 1, 3 * node + 2]
}

const CORNERS: [[usize; 3]; 8] =
    [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]];

/// Gradients of the eight shape functions, and the determinant of the map, at a point of [-1, 1]³.
fn gradients(corners: &[Vector; 8], point: Vector) -> ([Vector; 8], f64) {
    let local: [Vector; 8] = CORNERS.map(|corner| {
        let sign = corner.map(|c| 2.0 * c as f64 - 1.0);
        let factor: Vector = std::array::from_fn(|c| 1.0 + sign[c] * point[c]);
        std::array::from_fn(|c| sign[c] * factor[(c + 1) % 3] * factor[(c + 2) % 3] / 8.0)
    });
    let jacobian: [Vector; 3] = std::array::from_fn(|r| {
        std::array::from_fn(|c| (0..8).map(|n| local[n][r] * corners[n][c]).sum())
    });
    let [a, b, c] = jacobian;
    let determinant = dot(&a, &cross(b, c));
    // Columns of the inverse.
    let inverse = [cross(b, c), cross(c, a), cross(a, b)];
    let gradient = local.map(|local| {
        std::array::from_fn(|i| (0..3).map(|r| local[r] * inverse[r][i]).sum::<f64>() / determinant)
    });
    (gradient, determinant)
}

/// Stiffness of a brick.
fn element(corners: [Vector; 8], (young, poisson): (f64, f64)) -> Vec<[f64; 24]> {
    let lame = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
    let shear = young / (2.0 * (1.0 + poisson));
    let point = 1.0 / 3.0_f64.sqrt();
    let mut stiffness = vec![[0.0; 24]; 24];
    for corner in CORNERS {
        let (gradient, weight) =
            gradients(&corners, corner.map(|c| point * (2.0 * c as f64 - 1.0)));
        for (m, p) in gradient.iter().enumerate() {
            for (n, q) in gradient.iter().enumerate() {
                for i in 0..3 {
                    for j in 0..3 {
                        let same = if i == j { shear * dot(p, q) } else { 0.0 };
                        let entry = lame * p[i] * q[j] + shear * p[j] * q[i] + same;
                        stiffness[3 * m + i][3 * n + j] += weight * entry;
                    }
                }
            }
        }
    }
    stiffness
}
