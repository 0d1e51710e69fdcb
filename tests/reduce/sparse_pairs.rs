//! Pairs of any kind on random sparse matrices, in 2D and 3D: what a slave faces, and its frame.

use crate::common::dense::{condensed, difference, dot, largest, norm, product};
use crate::common::problems::{uniform, vector};
use fastrand::Rng;
use signorini::reduce::{ContactPairs, Indices, SparseMatrix, Triangle};
use signorini::{FrictionLaw, LoadCase, Model, Monitor, Settings, Status};

/// A host with nodes of `dim` components, pairs with up to three masters (one of them twice at
/// times, weights of both signs), supports that slaves do not have.
struct Host {
    dim: usize,
    pairs: usize,
    /// All entries, column-major.
    stiffness: Vec<f64>,
    fixed: Vec<usize>,
    values: Vec<f64>,
    slaves: Vec<usize>,
    starts: Vec<usize>,
    masters: Vec<usize>,
    weights: Vec<f64>,
    normals: Vec<f64>,
    tangents: Option<Vec<f64>>,
}

impl Host {
    fn new(rng: &mut Rng) -> Host {
        let dim = rng.usize(2..=3);
        let (nodes, pairs) = (rng.usize(8..=14), rng.usize(1..=4));
        let n = dim * nodes;
        // Springs of a few components each, one on every component: definite.
        let mut stiffness = vec![0.0; n * n];
        for i in 0..3 * n {
            let mut strain = vec![0.0; n];
            strain[i % n] = 1.0;
            (0..3 * (i / n)).for_each(|_| strain[rng.usize(0..n)] = uniform(rng, -1.0, 1.0));
            crate::common::problems::add_spring(&mut stiffness, &strain, uniform(rng, 0.5, 2.0));
        }
        let mut order: Vec<usize> = (0..nodes).collect();
        rng.shuffle(&mut order);
        let dofs = |node: usize| dim * node..dim * (node + 1);
        let slaves: Vec<usize> = order[..pairs].iter().flat_map(|&node| dofs(node)).collect();
        let (mut starts, mut masters, mut weights) = (vec![0], vec![], vec![]);
        for _ in 0..pairs {
            let count = rng.usize(0..=3);
            let mut given: Vec<f64> = (0..count).map(|_| uniform(rng, -0.3, 1.0)).collect();
            let rest: f64 = given.iter().skip(1).sum();
            given.iter_mut().take(1).for_each(|first| *first = 1.0 - rest);
            weights.extend(given);
            for _ in 0..count {
                masters.extend(dofs(order[rng.usize(pairs..nodes)]));
            }
            starts.push(weights.len());
        }
        let fixed: Vec<usize> =
            (0..n).filter(|dof| !slaves.contains(dof) && rng.u8(0..5) == 0).collect();
        let values = vector(rng, fixed.len());
        let normals: Vec<f64> = vector(rng, dim * pairs).iter().map(|n| 3.0 * n).collect();
        let across = |n: &[f64]| match *n {
            [x, y] => vec![2.0 * y, -2.0 * x],
            // Across (1, 2, 3) too.
            [x, y, z] => vec![3.0 * y - 2.0 * z, z - 3.0 * x, 2.0 * x - y],
            _ => unreachable!("2D or 3D"),
        };
        let tangents = rng.bool().then(|| normals.chunks(dim).flat_map(across).collect());
        Host {
            dim,
            pairs,
            stiffness,
            fixed,
            values,
            slaves,
            starts,
            masters,
            weights,
            normals,
            tangents,
        }
    }

    fn size(&self) -> usize {
        (0..).find(|n| n * n == self.stiffness.len()).unwrap()
    }

    fn model(&self) -> Model {
        let n = self.size();
        let (mut starts, mut rows, mut values) = (vec![0], vec![], vec![]);
        for j in 0..n {
            for i in (j..n).filter(|i| self.stiffness[i + n * j] != 0.0) {
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
            count: self.pairs,
            slaves: &self.slaves,
            master_start: &self.starts,
            masters: &self.masters,
            weights: &self.weights,
            normals: &self.normals,
            tangents: self.tangents.as_deref(),
            ..ContactPairs::default()
        };
        Model::sparse(&matrix, &self.fixed, &pairs).unwrap()
    }

    /// `u_slave - sum w u_master` of each pair.
    fn relative(&self, u: &[f64]) -> Vec<f64> {
        let mut relative: Vec<f64> = self.slaves.iter().map(|&dof| u[dof]).collect();
        for pair in 0..self.pairs {
            for k in self.starts[pair]..self.starts[pair + 1] {
                for c in 0..self.dim {
                    relative[self.dim * pair + c] -=
                        self.weights[k] * u[self.masters[self.dim * k + c]];
                }
            }
        }
        relative
    }

    /// The pairs' frames as the model has them, by unit relative displacements: `frames[i]` is the
    /// relative motion that component `i` stands for.
    fn frames(&self, model: &Model) -> Vec<Vec<f64>> {
        let n = self.dim * self.pairs;
        (0..n)
            .map(|i| {
                let unit: Vec<f64> = (0..n).map(|j| f64::from(u8::from(i == j))).collect();
                self.relative(&model.recover(None, None, &unit).unwrap())
            })
            .collect()
    }
}

fn cross(a: &[f64], b: &[f64]) -> Vec<f64> {
    (0..3).map(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]).collect()
}

/// Frames are orthonormal, of the normal, then the tangent that was asked for (as far as it is
/// across the normal; in 2D by itself the normal turned by +90 degrees), then `n x t`.
#[test]
fn frames_are_those_of_the_normals() {
    for seed in 0..200 {
        let host = Host::new(&mut Rng::with_seed(seed));
        let frames = host.frames(&host.model());
        for pair in 0..host.pairs {
            let range = host.dim * pair..host.dim * (pair + 1);
            let given = &host.normals[range.clone()];
            let normal: Vec<f64> = given.iter().map(|n| n / norm(given)).collect();
            let first = match &host.tangents {
                Some(tangents) => {
                    let tangent = &tangents[range.clone()];
                    let along = dot(tangent, &normal);
                    let rest: Vec<f64> =
                        tangent.iter().zip(&normal).map(|(t, n)| t - along * n).collect();
                    rest.iter().map(|t| t / norm(&rest)).collect()
                }
                None if host.dim == 2 => vec![-normal[1], normal[0]],
                // Any, across the normal.
                None => frames[range.start + 1][range.clone()].to_vec(),
            };
            let mut expected = vec![normal.clone(), first.clone()];
            if host.dim == 3 {
                expected.push(cross(&normal, &first));
                assert!(dot(&normal, &first).abs() < 1e-12 && (norm(&first) - 1.0).abs() < 1e-12);
            }
            for (component, direction) in expected.iter().enumerate() {
                let moved = &frames[range.start + component];
                // Displacements of up to 100 are subtracted; a tangent may lie near the normal.
                let error = difference(&moved[range.clone()], direction);
                assert!(largest(&error) < 1e-11, "seed {seed}, pair {pair}: {error:?}");
                let others = (0..moved.len()).filter(|i| !range.contains(i)).map(|i| moved[i]);
                let others: Vec<f64> = others.collect();
                assert!(largest(&others) < 1e-11, "seed {seed}, pair {pair}: {others:?}");
            }
        }
    }
}

/// `K_rel` is the Schur complement of `Tᵀ K T` with the slaves written by masters and relative
/// displacements, by dense elimination. To 1e-11 of the largest entry: rounding of 42 unknowns and
/// condition numbers up to 1e3.
#[test]
fn stiffness_is_the_dense_schur_complement() {
    for seed in 0..200 {
        let host = Host::new(&mut Rng::with_seed(seed));
        let model = host.model();
        let (n, frames) = (host.size(), host.frames(&model));
        let taken = |dof: &usize| host.fixed.contains(dof) || host.slaves.contains(dof);
        let free: Vec<usize> = (0..n).filter(|dof| !taken(dof)).collect();
        let mut columns = Vec::new();
        for &dof in &free {
            let mut column = vec![0.0; n];
            column[dof] = 1.0;
            let carried = host.relative(&column);
            host.slaves.iter().zip(carried).for_each(|(&slave, u)| column[slave] = -u);
            columns.push(column);
        }
        for frame in &frames {
            let mut column = vec![0.0; n];
            host.slaves.iter().zip(frame).for_each(|(&slave, u)| column[slave] = *u);
            columns.push(column);
        }
        let strained: Vec<Vec<f64>> =
            columns.iter().map(|column| product(&host.stiffness, column)).collect();
        let matrix: Vec<f64> =
            strained.iter().flat_map(|s| columns.iter().map(|c| dot(c, s))).collect();
        let (expected, _) = condensed(&matrix, &vec![0.0; columns.len()], free.len());
        let error = largest(&difference(model.stiffness(), &expected)) / largest(&expected);
        assert!(error <= 1e-11, "seed {seed}: {error:e}");
    }
}

/// Any load case obeys `u_slave = sum w u_master + R d`, supports are where they are put, `K u = f +` the
/// nodal contact forces wherever no support reacts, and contact forces do no work on motions that
/// leave `d` as it is. To 1e-9 of the forces: a thousand times the tolerance.
#[test]
fn recovered_displacements_balance_loads_and_contact_forces() {
    for seed in 0..200 {
        let mut rng = Rng::with_seed(seed);
        let host = Host::new(&mut rng);
        let (model, n) = (host.model(), host.size());
        let load: Vec<f64> = vector(&mut rng, n).iter().map(|f| 3.0 * f).collect();
        let gap = vector(&mut rng, host.pairs);
        let mu: Vec<f64> = (0..host.pairs).map(|_| uniform(&mut rng, 0.0, 0.4)).collect();
        let case = LoadCase {
            load: &load,
            prescribed: Some(&host.values),
            gap: &gap,
            law: FrictionLaw::Coulomb(&mu),
            reference_slip: None,
        };
        let settings = Settings { tolerance: 1e-12, ..Settings::default() };
        let monitor = &mut Monitor::new(&settings, None);
        let solution = model.solve(&case, &settings, None, monitor).unwrap();
        assert_eq!(solution.status, Status::Solved, "seed {seed}: {}", solution.message);
        let u = model.recover(Some(&load), Some(&host.values), &solution.d).unwrap();
        host.fixed.iter().zip(&host.values).for_each(|(&dof, value)| assert_eq!(u[dof], *value));
        let frames = host.frames(&model);
        let mut relative = host.relative(&u);
        for (frame, d) in frames.iter().zip(&solution.d) {
            relative.iter_mut().zip(frame).for_each(|(r, direction)| *r -= d * direction);
        }
        assert!(largest(&relative) < 1e-10 * largest(&u), "seed {seed}: {relative:?}");

        let nodal = model.nodal_forces(&solution.certificate.force).unwrap();
        let strained = product(&host.stiffness, &u);
        let residual = difference(&difference(&strained, &load), &nodal);
        let sizes = largest(&strained).max(largest(&nodal));
        for dof in (0..n).filter(|dof| !host.fixed.contains(dof)) {
            assert!(residual[dof].abs() <= 1e-9 * sizes, "seed {seed}: {dof}: {}", residual[dof]);
        }
        let mut motion = vector(&mut rng, n);
        host.slaves.iter().for_each(|&slave| motion[slave] = 0.0);
        let carried = host.relative(&motion);
        host.slaves.iter().zip(carried).for_each(|(&slave, u)| motion[slave] = -u);
        let work = dot(&nodal, &motion).abs();
        assert!(work <= 1e-13 * n as f64 * norm(&nodal) * norm(&motion), "seed {seed}: {work:e}");
    }
}
