//! Plane-strain Q1 meshes, their stiffness as a sparse matrix, and contact pairs on them.

use signorini::reduce::{ContactPairs, Indices, SparseMatrix, Triangle};
use signorini::{Error, Model, Monitor};

/// Elements of one material each: nodes counterclockwise, and (E, nu).
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    pub nodes: Vec<[f64; 2]>,
    pub elements: Vec<([usize; 4], (f64, f64))>,
}

/// A rectangle of a mesh: its nodes, row by row from the bottom.
#[derive(Clone, Copy, Debug)]
pub struct Block {
    first: usize,
    pub columns: usize,
    pub rows: usize,
}

impl Block {
    /// Node `i` from the left in row `j` from the bottom.
    pub fn node(&self, i: usize, j: usize) -> usize {
        self.first + i + (self.columns + 1) * j
    }

    pub fn row(&self, j: usize) -> Vec<usize> {
        (0..=self.columns).map(|i| self.node(i, j)).collect()
    }

    pub fn column(&self, i: usize) -> Vec<usize> {
        (0..=self.rows).map(|j| self.node(i, j)).collect()
    }

    pub fn nodes(&self) -> std::ops::Range<usize> {
        self.first..self.first + (self.columns + 1) * (self.rows + 1)
    }
}

/// Equal steps.
pub fn steps(from: f64, to: f64, count: usize) -> Vec<f64> {
    (0..=count).map(|i| from + (to - from) * i as f64 / count as f64).collect()
}

impl Mesh {
    /// Adds a rectangle with these grid lines.
    pub fn block(&mut self, x: &[f64], y: &[f64], material: (f64, f64)) -> Block {
        let block = Block { first: self.nodes.len(), columns: x.len() - 1, rows: y.len() - 1 };
        self.nodes.extend(y.iter().flat_map(|&y| x.iter().map(move |&x| [x, y])));
        for j in 0..block.rows {
            for i in 0..block.columns {
                let at = |i, j| block.node(i, j);
                let nodes = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                self.elements.push((nodes, material));
            }
        }
        block
    }

    pub fn size(&self) -> usize {
        2 * self.nodes.len()
    }

    /// The stiffness, components (u_x, u_y) of node after node.
    pub fn stiffness(&self) -> Stiffness {
        let mut columns: Vec<Vec<(usize, f64)>> = vec![Vec::new(); self.size()];
        for (nodes, material) in &self.elements {
            let element = element(nodes.map(|node| self.nodes[node]), *material);
            for a in 0..8 {
                for b in 0..8 {
                    let (i, j) = (2 * nodes[a / 2] + a % 2, 2 * nodes[b / 2] + b % 2);
                    if i >= j {
                        columns[j].push((i, element[a][b]));
                    }
                }
            }
        }
        let mut lower =
            Stiffness { size: self.size(), col_start: vec![0], row: vec![], values: vec![] };
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

    /// Adds the nodal loads of a uniform traction on a line of nodes.
    pub fn traction(&self, line: &[usize], traction: [f64; 2], load: &mut [f64]) {
        for ends in line.windows(2) {
            let [a, b] = [self.nodes[ends[0]], self.nodes[ends[1]]];
            let length = (a[0] - b[0]).hypot(a[1] - b[1]);
            for &node in ends {
                for c in 0..2 {
                    load[2 * node + c] += traction[c] * length / 2.0;
                }
            }
        }
    }
}

/// Stiffness of a quadrilateral by 2 x 2 Gauss points.
fn element(corners: [[f64; 2]; 4], (young, poisson): (f64, f64)) -> [[f64; 8]; 8] {
    let lame = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
    let shear = young / (2.0 * (1.0 + poisson));
    let signs = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let point = 1.0 / 3.0_f64.sqrt();
    let mut stiffness = [[0.0; 8]; 8];
    for (s, t) in signs.map(|(s, t)| (point * s, point * t)) {
        let local = signs.map(|(a, b)| [a * (1.0 + b * t) / 4.0, b * (1.0 + a * s) / 4.0]);
        let jacobian: [[f64; 2]; 2] = std::array::from_fn(|r| {
            std::array::from_fn(|c| (0..4).map(|n| local[n][r] * corners[n][c]).sum())
        });
        let [[a, b], [c, d]] = jacobian;
        let determinant = a * d - b * c;
        let gradient =
            local.map(|[r, q]| [(d * r - b * q) / determinant, (a * q - c * r) / determinant]);
        for (m, p) in gradient.into_iter().enumerate() {
            for (n, q) in gradient.into_iter().enumerate() {
                let along = p[0] * q[0] + p[1] * q[1];
                for i in 0..2 {
                    for j in 0..2 {
                        let same = if i == j { shear * along } else { 0.0 };
                        let entry = lame * p[i] * q[j] + shear * p[j] * q[i] + same;
                        stiffness[2 * m + i][2 * n + j] += determinant * entry;
                    }
                }
            }
        }
    }
    stiffness
}

/// Lower triangle by columns.
#[derive(Clone, Debug)]
pub struct Stiffness {
    pub size: usize,
    pub col_start: Vec<i64>,
    pub row: Vec<i64>,
    pub values: Vec<f64>,
}

impl Stiffness {
    /// Entries as (row, column, value), row >= column.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize, f64)> + '_ {
        (0..self.size).flat_map(move |j| {
            (self.col_start[j] as usize..self.col_start[j + 1] as usize)
                .map(move |k| (self.row[k] as usize, j, self.values[k]))
        })
    }

    /// All entries, column-major.
    pub fn dense(&self) -> Vec<f64> {
        let mut dense = vec![0.0; self.size * self.size];
        for (i, j, value) in self.entries() {
            dense[i + self.size * j] = value;
            dense[j + self.size * i] = value;
        }
        dense
    }

    pub fn times(&self, x: &[f64]) -> Vec<f64> {
        let mut y = vec![0.0; self.size];
        for (i, j, value) in self.entries() {
            y[i] += value * x[j];
            if i != j {
                y[j] += value * x[i];
            }
        }
        y
    }

    /// By columns in another triangle, or all entries.
    pub fn stored(&self, triangle: Triangle) -> Stiffness {
        let mut columns = vec![Vec::new(); self.size];
        for (i, j, value) in self.entries() {
            if triangle != Triangle::Upper || i == j {
                columns[j].push((i, value));
            }
            if triangle != Triangle::Lower && i != j {
                columns[i].push((j, value));
            }
        }
        let mut stored = Stiffness { col_start: vec![0], row: vec![], values: vec![], ..*self };
        for mut column in columns {
            column.sort_by_key(|(i, _)| *i);
            stored.row.extend(column.iter().map(|(i, _)| *i as i64));
            stored.values.extend(column.iter().map(|(_, value)| *value));
            stored.col_start.push(stored.row.len() as i64);
        }
        stored
    }

    /// As the library takes it.
    pub fn view(&self) -> SparseMatrix<'_> {
        SparseMatrix {
            size: self.size,
            col_start: Indices::Wide(&self.col_start),
            row: Indices::Wide(&self.row),
            values: &self.values,
            index_base: 0,
            triangle: Triangle::Lower,
        }
    }

    pub fn model(&self, fixed: &[usize], pairs: &Pairs) -> Result<Model, Error> {
        Model::sparse(&self.view(), fixed, &pairs.view())
    }

    /// The model under settings.
    pub fn model_under(
        &self,
        fixed: &[usize],
        pairs: &ContactPairs<'_>,
        monitor: &mut Monitor<'_>,
    ) -> Result<Model, Error> {
        Model::sparse_within(&self.view(), fixed, pairs, None, monitor)
    }
}

/// Contact pairs of nodes.
#[derive(Clone, Debug, Default)]
pub struct Pairs {
    pub slaves: Vec<usize>,
    /// Nodes of each pair and their weights.
    pub masters: Vec<Vec<(usize, f64)>>,
    pub normals: Vec<[f64; 2]>,
    dofs: [Vec<usize>; 3],
    weights: Vec<f64>,
    flat_normals: Vec<f64>,
}

impl Pairs {
    pub fn new(slaves: &[usize], masters: &[Vec<(usize, f64)>], normal: [f64; 2]) -> Pairs {
        let normals = vec![normal; slaves.len()];
        let both = |node: &usize| [2 * node, 2 * node + 1];
        let mut starts = vec![0];
        for masters in masters {
            starts.push(starts.last().unwrap() + masters.len());
        }
        let all = || masters.iter().flatten();
        let dofs = [
            slaves.iter().flat_map(both).collect(),
            starts,
            all().flat_map(|(node, _)| both(node)).collect(),
        ];
        Pairs {
            weights: all().map(|(_, weight)| *weight).collect(),
            flat_normals: normals.concat(),
            slaves: slaves.to_vec(),
            masters: masters.to_vec(),
            normals,
            dofs,
        }
    }

    /// Nodes on an obstacle.
    pub fn on_obstacle(slaves: &[usize], normal: [f64; 2]) -> Pairs {
        Pairs::new(slaves, &vec![Vec::new(); slaves.len()], normal)
    }

    /// Nodes on nodes.
    pub fn matching(slaves: &[usize], masters: &[usize], normal: [f64; 2]) -> Pairs {
        let masters: Vec<_> = masters.iter().map(|&node| vec![(node, 1.0)]).collect();
        Pairs::new(slaves, &masters, normal)
    }

    pub fn count(&self) -> usize {
        self.slaves.len()
    }

    pub fn view(&self) -> ContactPairs<'_> {
        ContactPairs {
            dim: 2,
            count: self.count(),
            slaves: &self.dofs[0],
            master_start: &self.dofs[1],
            masters: &self.dofs[2],
            weights: &self.weights,
            normals: &self.flat_normals,
            tangents: None,
            ..ContactPairs::default()
        }
    }
}
