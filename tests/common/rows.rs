//! Hosts with contact rows over any nodes, dense and small, and what their models must satisfy.

use fastrand::Rng;
use signorini::reduce::{ContactPairs, Indices, SparseMatrix, Triangle};
use signorini::{Error, FrictionLaw, LoadCase, Model, Monitor, Settings, Solution};

use crate::common::dense::{Elimination, difference, dot, largest, product};

/// A structure with pairs, each a list of nodes with signed weights.
#[derive(Clone)]
pub struct Host {
    pub dim: usize,
    /// All entries, column-major.
    pub stiffness: Vec<f64>,
    pub fixed: Vec<usize>,
    /// Node and signed weight.
    pub rows: Vec<Vec<(usize, f64)>>,
    pub normals: Vec<f64>,
    pub tangents: Option<Vec<f64>>,
}

impl Host {
    pub fn size(&self) -> usize {
        (0..).find(|n| n * n == self.stiffness.len()).unwrap()
    }

    /// The model with general rows.
    pub fn model(&self) -> Result<Model, Error> {
        self.model_with(&Settings::default())
    }

    /// The model with general rows, condensed or in full space.
    pub fn model_with(&self, settings: &Settings) -> Result<Model, Error> {
        let mut start = vec![0];
        self.rows.iter().for_each(|row| start.push(start.last().unwrap() + row.len()));
        let nodes = self.rows.concat();
        let dofs: Vec<usize> = nodes.iter().flat_map(|&(node, _)| self.dofs(node)).collect();
        let weights: Vec<f64> = nodes.iter().map(|&(_, weight)| weight).collect();
        self.model_of(&[], &start, (&dofs, &weights), settings)
    }

    /// The model of pairs whose first node is the slave, of weight 1.
    pub fn model_of_slaves(&self) -> Result<Model, Error> {
        let (mut start, mut masters, mut weights) = (vec![0], vec![], vec![]);
        let mut slaves = Vec::new();
        for row in &self.rows {
            assert_eq!(row[0].1, 1.0);
            slaves.extend(self.dofs(row[0].0));
            masters.extend(row[1..].iter().flat_map(|&(node, _)| self.dofs(node)));
            weights.extend(row[1..].iter().map(|(_, weight)| -weight));
            start.push(weights.len());
        }
        self.model_of(&slaves, &start, (&masters, &weights), &Settings::default())
    }

    fn dofs(&self, node: usize) -> std::ops::Range<usize> {
        self.dim * node..self.dim * (node + 1)
    }

    fn model_of(
        &self,
        slaves: &[usize],
        master_start: &[usize],
        (masters, weights): (&[usize], &[f64]),
        settings: &Settings,
    ) -> Result<Model, Error> {
        let n = self.size();
        let (mut starts, mut rows, mut values) = (vec![0], vec![], vec![]);
        for j in 0..n {
            for i in (j..n).filter(|i| *i == j || self.stiffness[i + n * j] != 0.0) {
                rows.push(i as i64);
                values.push(self.stiffness[i + n * j]);
            }
            starts.push(rows.len() as i64);
        }
        let matrix = SparseMatrix {
            size: n,
            col_start: Indices::Wide(&starts),
            row: Indices::Wide(&rows),
            values: &values,
            index_base: 0,
            triangle: Triangle::Lower,
        };
        let pairs = ContactPairs {
            dim: self.dim,
            count: self.rows.len(),
            slaves,
            master_start,
            masters,
            weights,
            normals: &self.normals,
            tangents: self.tangents.as_deref(),
            ..ContactPairs::default()
        };
        let monitor = &mut Monitor::new(settings, None);
        Model::sparse_within(&matrix, &self.fixed, &pairs, None, monitor)
    }

    /// `B`, row by row, with the model's frames.
    pub fn matrix(&self, model: &Model) -> Vec<Vec<f64>> {
        let (dim, frames) = (self.dim, model.frames().unwrap());
        let row = |i: usize| {
            let direction = &frames[dim * i..dim * (i + 1)];
            let mut row = vec![0.0; self.size()];
            for &(node, weight) in &self.rows[i / dim] {
                (0..dim).for_each(|axis| row[dim * node + axis] += weight * direction[axis]);
            }
            row
        };
        (0..dim * self.rows.len()).map(row).collect()
    }

    /// `K_rel` of independent rows from the saddle point problem
    /// `K u = Bᵀ F` where nothing is fixed, `u = 0` elsewhere, `B u = d`: `F = K_rel d`.
    pub fn relative_stiffness(&self, model: &Model) -> Vec<f64> {
        let (n, b) = (self.size(), self.matrix(model));
        let free: Vec<usize> = (0..n).filter(|dof| !self.fixed.contains(dof)).collect();
        let (count, m) = (free.len(), b.len());
        let all = count + m;
        let mut saddle = vec![0.0; all * all];
        for (i, &p) in free.iter().enumerate() {
            for (j, &q) in free.iter().enumerate() {
                saddle[i * all + j] = self.stiffness[p + n * q];
            }
            for (k, row) in b.iter().enumerate() {
                saddle[i * all + count + k] = -row[p];
                saddle[(count + k) * all + i] = -row[p];
            }
        }
        let saddle = Elimination::new(all, &saddle);
        assert_eq!(saddle.rank, all, "rows are independent and hold every motion");
        let column = |k: usize| {
            let mut right = vec![0.0; all];
            right[count + k] = -1.0;
            saddle.solve(&right).0[count..].to_vec()
        };
        (0..m).flat_map(column).collect()
    }

    /// Asserts, in the host's full size, `K u = f + Bᵀ F` but at supports, `B u = d`, and prescribed
    /// values; relative to the largest forces and displacements.
    pub fn assert_balanced(
        &self,
        model: &Model,
        case: &LoadCase<'_>,
        solution: &Solution,
        tolerance: f64,
    ) {
        let b = self.matrix(model);
        let u = model.recover(Some(case.load), case.prescribed, &solution.d).unwrap();
        let nodal = model.nodal_forces(&solution.certificate.force).unwrap();
        let mut by_rows = vec![0.0; u.len()];
        for (row, force) in b.iter().zip(&solution.certificate.force) {
            by_rows.iter_mut().zip(row).for_each(|(sum, b)| *sum += b * force);
        }
        assert!(largest(&difference(&by_rows, &nodal)) <= 1e-12 * largest(&nodal), "Bᵀ F");
        let internal = product(&self.stiffness, &u);
        let left = difference(&difference(&internal, case.load), &nodal);
        let size = largest(case.load).max(largest(&internal)).max(largest(&nodal));
        for dof in (0..u.len()).filter(|dof| !self.fixed.contains(dof)) {
            assert!(left[dof].abs() <= tolerance * size, "K u at {dof}: {:e}", left[dof] / size);
        }
        let moved: Vec<f64> = b.iter().map(|row| dot(row, &u)).collect();
        let error = largest(&difference(&moved, &solution.d));
        assert!(error <= tolerance * largest(&u), "B u: {:e}", error / largest(&u));
        for (k, &dof) in self.fixed.iter().enumerate() {
            assert_eq!(u[dof], case.prescribed.map_or(0.0, |values| values[k]));
        }
    }
}

/// The solution of a load case with Coulomb's friction, to 1e-12.
pub fn solved(model: &Model, load: &[f64], gap: &[f64], mu: &[f64]) -> Solution {
    let settings = Settings { tolerance: 1e-12, ..Settings::default() };
    let case = LoadCase {
        load,
        prescribed: None,
        gap,
        law: FrictionLaw::Coulomb(mu),
        reference_slip: None,
    };
    model.solve(&case, &settings, None, &mut Monitor::new(&settings, None)).unwrap()
}

/// A definite stiffness of `nodes` nodes: springs of a few components each, one on every component.
pub fn springs(rng: &mut Rng, n: usize) -> Vec<f64> {
    let number = |rng: &mut Rng, low: f64, high: f64| low + (high - low) * rng.f64();
    let mut stiffness = vec![0.0; n * n];
    for i in 0..3 * n {
        let mut strain = vec![0.0; n];
        strain[i % n] = 1.0;
        (0..3 * (i / n)).for_each(|_| strain[rng.usize(0..n)] = number(rng, -1.0, 1.0));
        crate::common::problems::add_spring(&mut stiffness, &strain, number(rng, 0.5, 2.0));
    }
    stiffness
}
