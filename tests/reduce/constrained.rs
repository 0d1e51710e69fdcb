//! A structure with equations between its degrees of freedom, whole and as hosts have it that eliminate them.

use signorini::reduce::{ContactPairs, Equations};
use signorini::{Error, FrictionLaw, LoadCase, Model, Monitor, Settings, Solution, Status};

use crate::common::dense::{difference, dot, largest, product};
use crate::common::mesh::Stiffness;

pub type Terms = Vec<(usize, f64)>;

/// The arrays of a list of equations: dependent degree of freedom, terms.
#[derive(Clone, Default)]
pub struct EquationArrays {
    pub dependent: Vec<usize>,
    pub start: Vec<usize>,
    pub dofs: Vec<usize>,
    pub coefficients: Vec<f64>,
}

impl EquationArrays {
    pub fn new(equations: &[(usize, Terms)]) -> Self {
        let mut arrays = EquationArrays::default();
        if !equations.is_empty() {
            arrays.start.push(0);
        }
        for (dependent, terms) in equations {
            arrays.dependent.push(*dependent);
            arrays.dofs.extend(terms.iter().map(|(dof, _)| dof));
            arrays.coefficients.extend(terms.iter().map(|(_, a)| a));
            arrays.start.push(arrays.dofs.len());
        }
        arrays
    }

    pub fn view(&self) -> Equations<'_> {
        let EquationArrays { dependent, start, dofs, coefficients } = self;
        Equations { dependent, start, dofs, coefficients }
    }
}

/// The lower triangle of a dense symmetric matrix. Zeros are left out, those of the diagonal too.
pub fn sparse(dense: &[f64], size: usize) -> Stiffness {
    let mut lower = Stiffness { size, col_start: vec![0], row: vec![], values: vec![] };
    for j in 0..size {
        for i in (j..size).filter(|i| dense[i + size * j] != 0.0) {
            lower.row.push(i as i64);
            lower.values.push(dense[i + size * j]);
        }
        lower.col_start.push(lower.row.len() as i64);
    }
    lower
}

/// A structure whose pairs are rows by degree of freedom.
#[derive(Clone)]
pub struct Constrained {
    pub dim: usize,
    /// All entries.
    pub stiffness: Vec<f64>,
    /// None of them dependent.
    pub fixed: Vec<usize>,
    /// Dependent degree of freedom, terms.
    pub equations: Vec<(usize, Terms)>,
    /// Degrees of freedom of each pair with their vectors.
    pub rows: Vec<Vec<(usize, Vec<f64>)>>,
    pub normals: Vec<f64>,
    pub tangents: Option<Vec<f64>>,
}

impl Constrained {
    pub fn size(&self) -> usize {
        (0..).find(|n| n * n == self.stiffness.len()).unwrap()
    }

    pub fn independents(&self) -> Vec<usize> {
        let is_dependent = |dof: &usize| self.equations.iter().any(|(other, _)| other == dof);
        (0..self.size()).filter(|dof| !is_dependent(dof)).collect()
    }

    /// A degree of freedom in terms of the independents, by their places.
    fn of_independents(&self, dof: usize, independents: &[usize]) -> Vec<f64> {
        let mut sum = vec![0.0; independents.len()];
        match self.equations.iter().find(|(other, _)| *other == dof) {
            None => sum[independents.binary_search(&dof).unwrap()] = 1.0,
            Some((_, terms)) => {
                for (other, a) in terms {
                    let part = self.of_independents(*other, independents);
                    sum.iter_mut().zip(part).for_each(|(sum, part)| *sum += a * part);
                }
            }
        }
        sum
    }

    /// `E` of `u = E z`, row by row.
    pub fn elimination(&self) -> Vec<Vec<f64>> {
        let independents = self.independents();
        (0..self.size()).map(|dof| self.of_independents(dof, &independents)).collect()
    }

    /// `Eᵀ x`.
    pub fn gathered(&self, x: &[f64]) -> Vec<f64> {
        let elimination = self.elimination();
        let mut sum = vec![0.0; elimination[0].len()];
        for (row, x) in elimination.iter().zip(x) {
            sum.iter_mut().zip(row).for_each(|(sum, e)| *sum += e * x);
        }
        sum
    }

    /// The structure in which nothing is dependent: `Eᵀ K E`, `B E`.
    pub fn reduced(&self) -> Constrained {
        let (size, elimination) = (self.size(), self.elimination());
        let independents = self.independents();
        let count = independents.len();
        let mut stiffness = vec![0.0; count * count];
        for j in 0..count {
            let column: Vec<f64> = elimination.iter().map(|row| row[j]).collect();
            let forces = self.gathered(&product(&self.stiffness, &column));
            stiffness[count * j..count * (j + 1)].copy_from_slice(&forces);
        }
        // Exactly symmetric: the host has made it from one triangle.
        for j in 0..count {
            (0..j).for_each(|i| stiffness[i + count * j] = stiffness[j + count * i]);
        }
        let reduced = |row: &Vec<(usize, Vec<f64>)>| {
            let mut vectors = vec![vec![0.0; self.dim]; count];
            for (dof, vector) in row {
                for (target, share) in vectors.iter_mut().zip(&elimination[*dof]) {
                    target.iter_mut().zip(vector).for_each(|(sum, v)| *sum += share * v);
                }
            }
            let is_there = |(_, vector): &(usize, Vec<f64>)| largest(vector) > 0.0;
            vectors.into_iter().enumerate().filter(is_there).collect()
        };
        assert_eq!(elimination.len(), size);
        Constrained {
            stiffness,
            fixed: self.places_of_fixed(),
            equations: Vec::new(),
            rows: self.rows.iter().map(reduced).collect(),
            ..self.clone()
        }
    }

    fn places_of_fixed(&self) -> Vec<usize> {
        let independents = self.independents();
        self.fixed.iter().map(|dof| independents.binary_search(dof).unwrap()).collect()
    }

    /// The model of the whole matrix, from which the library eliminates dependents.
    pub fn whole(&self, settings: &Settings) -> Model {
        self.tried(settings).unwrap()
    }

    /// That model, or why it is refused.
    pub fn tried(&self, settings: &Settings) -> Result<Model, Error> {
        self.model(&self.stiffness, &self.fixed, &|dof| dof, settings)
    }

    /// The model of `Eᵀ K E` with the pairs as they are: their dependents are numbers beyond the matrix.
    pub fn eliminated(&self, settings: &Settings) -> Model {
        let independents = self.independents();
        let count = independents.len();
        let number = |dof: usize| match independents.binary_search(&dof) {
            Ok(place) => place,
            Err(_) => count + 3 * dof + 1,
        };
        let stiffness = self.reduced().stiffness;
        self.model(&stiffness, &self.places_of_fixed(), &number, settings).unwrap()
    }

    fn model(
        &self,
        stiffness: &[f64],
        fixed: &[usize],
        number: &dyn Fn(usize) -> usize,
        settings: &Settings,
    ) -> Result<Model, Error> {
        let size = (0..).find(|n| n * n == stiffness.len()).unwrap();
        let (mut start, mut dofs, mut vectors) = (vec![0], vec![], vec![]);
        for row in &self.rows {
            dofs.extend(row.iter().map(|(dof, _)| number(*dof)));
            vectors.extend(row.iter().flat_map(|(_, vector)| vector));
            start.push(dofs.len());
        }
        let numbered = |(dof, a): &(usize, f64)| (number(*dof), *a);
        let equations: Vec<(usize, Terms)> = self
            .equations
            .iter()
            .map(|(dof, terms)| (number(*dof), terms.iter().map(numbered).collect()))
            .collect();
        let arrays = EquationArrays::new(&equations);
        let pairs = ContactPairs {
            dim: self.dim,
            count: self.rows.len(),
            master_start: &start,
            masters: &dofs,
            vectors: Some(&vectors),
            normals: &self.normals,
            tangents: self.tangents.as_deref(),
            equations: arrays.view(),
            ..ContactPairs::default()
        };
        let monitor = &mut Monitor::new(settings, None);
        sparse(stiffness, size).model_under(fixed, &pairs, monitor)
    }

    /// Asserts, in the whole structure, that a solution balances, `Eᵀ (K u - f - Bᵀ F) = 0` but at supports,
    /// that `u` obeys the equations and that `B u = d`. `u` and `nodal` are those of [`Self::whole`].
    pub fn assert_balanced(
        &self,
        (frames, load): (&[f64], &[f64]),
        solution: &Solution,
        (u, nodal): (&[f64], &[f64]),
        tolerance: f64,
    ) {
        let dim = self.dim;
        let mut by_rows = vec![0.0; u.len()];
        for (i, force) in solution.certificate.force.iter().enumerate() {
            let direction = &frames[dim * i..dim * (i + 1)];
            let mut d = 0.0;
            for (dof, vector) in &self.rows[i / dim] {
                let part = dot(vector, direction);
                by_rows[*dof] += part * force;
                d += part * u[*dof];
            }
            let error = (d - solution.d[i]).abs();
            assert!(error <= tolerance * largest(u), "B u at {i}: {error:e}");
        }
        for (dof, terms) in &self.equations {
            let sum: f64 = terms.iter().map(|(other, a)| a * u[*other]).sum();
            assert!((u[*dof] - sum).abs() <= tolerance * largest(u), "u[{dof}]");
        }
        let internal = product(&self.stiffness, u);
        let size = largest(&internal).max(largest(load)).max(largest(nodal));
        // Contact forces come out on independents: they do the work of those on the rows.
        let independents = self.independents();
        let by_rows = self.gathered(&by_rows);
        let left = self.gathered(&difference(&internal, load));
        for (k, dof) in independents.iter().enumerate() {
            assert!(
                (nodal[*dof] - by_rows[k]).abs() <= 1e-12 * size.max(largest(&by_rows)),
                "Bᵀ F"
            );
            let rest = (left[k] - nodal[*dof]).abs();
            let is_free = !self.fixed.contains(dof);
            assert!(!is_free || rest <= tolerance * size, "{dof}: {:e}", rest / size);
        }
    }
}

/// The solution of a load case with Coulomb's friction, to 1e-12.
pub fn solved(model: &Model, load: &[f64], gap: &[f64], mu: f64) -> Solution {
    let settings = Settings { tolerance: 1e-12, ..Settings::default() };
    let mu = vec![mu; gap.len()];
    let law = FrictionLaw::Coulomb(&mu);
    let case = LoadCase { load, prescribed: None, gap, law, reference_slip: None };
    let solution = model.solve(&case, &settings, None, &mut Monitor::new(&settings, None)).unwrap();
    assert_eq!(solution.status, Status::Solved, "{}", solution.message);
    solution
}

/// Vectors of pairs in the host's axes.
pub fn in_axes(frames: &[f64], components: &[f64], dim: usize) -> Vec<f64> {
    let mut vectors = vec![0.0; components.len()];
    for (i, part) in components.iter().enumerate() {
        for axis in 0..dim {
            vectors[i / dim * dim + axis] += part * frames[dim * i + axis];
        }
    }
    vectors
}

pub fn close(a: &[f64], b: &[f64], tolerance: f64, what: &str) {
    assert_eq!(a.len(), b.len(), "{what}");
    let error = largest(&difference(a, b)) / largest(b).max(f64::MIN_POSITIVE);
    assert!(error <= tolerance, "{what}: {error:e}");
}
