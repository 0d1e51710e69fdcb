//! Models of which the host gives products on all of its unknowns and a preconditioner: a bad one gives the answers of the
//! condensed matrix, and functions of the host that are wrong are named.

use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::sync::{Arc, Mutex};

use crate::common::blocks::block;
use crate::common::brick::{Support, Vector};
use crate::common::dense::{difference, largest};
use crate::common::mesh::{Mesh, Pairs, Stiffness, steps};
use signorini::reduce::{Held, HostOperator};
use signorini::{FrictionLaw, LoadCase, Model, Monitor, Settings, Solution, Status};

/// Faults of a host.
#[derive(Clone, Copy, PartialEq)]
enum Wrong {
    Nothing,
    Fails,
    NotFinite,
    Unsymmetric,
    Unwritten,
}

/// Sweeps of the preconditioner: they leave most of what is smooth.
const SWEEPS: usize = 2;

/// A host whose unknowns are its degrees of freedom, those of contact nodes in the frames of the pairs, and fixed ones
/// by themselves.
struct Host {
    /// All entries of each column.
    columns: Vec<Vec<(usize, f64)>>,
    components: Vec<usize>,
    /// The components held in the last call.
    last: Mutex<Option<(Vec<bool>, Vec<f64>)>>,
    asked: Arc<AtomicU64>,
    wrong: Wrong,
}

impl Host {
    /// The entries of the matrix of the last call of the preconditioner in row `i`.
    fn row(&self, held: &Held<'_>, i: usize) -> Vec<(usize, f64)> {
        let pair_of = |i: usize| self.components.iter().position(|&place| place == i);
        let mut row = self.columns[i].clone();
        let dim = if self.components[0] % 3 == 2 { 3 } else { 2 };
        row.retain(|(j, _)| pair_of(*j).is_none_or(|k| !held.components[k]));
        let Some(k) = pair_of(i).filter(|k| k % dim > 0) else { return row };
        for c in 1..dim {
            let j = self.components[k - k % dim + c];
            let (first, across) = ((dim - 1) * (dim - 1) * (k / dim), dim - 1);
            let spring = held.springs[first + across * (k % dim - 1) + c - 1];
            row.iter_mut().filter(|(other, _)| *other == j).for_each(|(_, a)| *a += spring);
        }
        row
    }
}

impl HostOperator for Host {
    fn stiffness(&self, x: &[f64], y: &mut [f64]) -> Result<(), i32> {
        y.fill(0.0);
        for (column, x) in self.columns.iter().zip(x) {
            column.iter().for_each(|(i, a)| y[*i] += a * x);
        }
        if self.wrong == Wrong::Unsymmetric {
            y[0] += 1e-3 * self.columns[0][0].1.abs() * x[1];
        }
        Ok(())
    }

    /// Gauss and Seidel, forwards and backwards, in single precision: no linear map.
    fn held(&self, held: &Held<'_>, r: &[f64], z: &mut [f64]) -> Result<(), i32> {
        let now = (held.components.to_vec(), held.springs.to_vec());
        let mut last = self.last.lock().unwrap();
        assert_eq!(held.changed, last.as_ref() != Some(&now), "what is said to have changed");
        self.asked.fetch_add(1, Relaxed);
        if held.springs.len() > held.components.len() {
            held.springs.chunks_exact(4).for_each(assert_semidefinite);
        }
        match self.wrong {
            Wrong::Fails => return Err(42),
            Wrong::NotFinite => z.fill(f64::NAN),
            Wrong::Unwritten => z[1..].fill(1.0),
            _ => z.fill(0.0),
        }
        *last = Some(now);
        if self.wrong != Wrong::Nothing {
            return Ok(());
        }
        let is_held =
            |i: usize| self.components.iter().zip(held.components).any(|(p, h)| *p == i && *h);
        let rows: Vec<_> = (0..z.len()).map(|i| self.row(held, i)).collect();
        for sweep in 0..2 * SWEEPS {
            for k in 0..z.len() {
                let i = if sweep % 2 == 0 { k } else { z.len() - 1 - k };
                if is_held(i) {
                    continue;
                }
                let of = |(j, a): &(usize, f64)| if *j == i { 0.0 } else { a * z[*j] };
                let others: f64 = rows[i].iter().map(of).sum();
                let own = rows[i].iter().find(|(j, _)| *j == i).unwrap().1;
                z[i] = f64::from(((r[i] - others) / own) as f32);
            }
        }
        Ok(())
    }
}

/// The springs of a pair in space, a few roundings aside: the eigenvalues of a matrix of two rows are not negative if
/// its trace and its determinant are not.
fn assert_semidefinite(springs: &[f64]) {
    let &[a, b, other, c] = springs else { unreachable!("four numbers") };
    assert_eq!(b, other, "symmetric");
    assert!(a + c >= 0.0 && a * c - b * b >= -8.0 * f64::EPSILON * (a + c).powi(2), "{springs:?}");
}

/// A load case with its two models.
struct Problem {
    condensed: Model,
    matrix: Stiffness,
    fixed: Vec<usize>,
    prescribed: Vec<f64>,
    gap: Vec<f64>,
    /// The degree of freedom of each component, and its sign.
    components: Vec<(usize, f64)>,
}

impl Problem {
    fn new(
        condensed: Model,
        matrix: Stiffness,
        (fixed, prescribed): (Vec<usize>, Vec<f64>),
        nodes: &[usize],
        gap: Vec<f64>,
    ) -> Problem {
        let dim = condensed.dim();
        let frames = condensed.frames().unwrap();
        let component = |i: usize| {
            let axis = &frames[dim * i..dim * (i + 1)];
            let along = (0..dim).find(|&c| axis[c].abs() > 0.5).unwrap();
            assert_eq!(axis[along].abs(), 1.0, "the frames are those of the axes");
            (dim * nodes[i / dim] + along, axis[along])
        };
        let components = (0..dim * nodes.len()).map(component).collect();
        Problem { condensed, matrix, fixed, prescribed, gap, components }
    }

    /// A clamped block of bricks that is pressed on waves, and shifted.
    fn space(nodes: usize) -> Problem {
        let brick = block(nodes, Support::Clamped);
        let motion = |[x, y, _]: Vector| [0.008 - 0.009 * y, 0.003 + 0.009 * x, -0.03];
        let (_, prescribed) = brick.moved(motion);
        let gap = |pair: usize| {
            let [x, y, _] = brick.place(pair);
            0.02 * (1.0 - (4.0 * x).cos() * (3.0 * y + 0.5).cos())
        };
        let gap = (0..brick.pairs()).map(gap).collect();
        let supports = (brick.fixed(), prescribed.unwrap());
        Problem::new(brick.model(), brick.stiffness(), supports, &brick.contact, gap)
    }

    /// The same in the plane.
    fn plane(columns: usize) -> Problem {
        let mut mesh = Mesh::default();
        let rectangle =
            mesh.block(&steps(0.0, 2.0, columns), &steps(0.0, 1.0, columns / 2), (1.0, 0.3));
        let top = rectangle.row(rectangle.rows);
        let fixed: Vec<usize> = top.iter().flat_map(|n| [2 * n, 2 * n + 1]).collect();
        let prescribed = [0.02, -0.03].repeat(top.len());
        let contact = rectangle.row(0);
        let model =
            mesh.stiffness().model(&fixed, &Pairs::on_obstacle(&contact, [0.0, -1.0])).unwrap();
        let gap =
            (0..=columns).map(|i| 0.01 * (1.0 - (7.0 * mesh.nodes[contact[i]][0]).cos())).collect();
        Problem::new(model, mesh.stiffness(), (fixed, prescribed), &contact, gap)
    }

    fn signs(&self) -> Vec<f64> {
        let mut signs = vec![1.0; self.matrix.size];
        self.components.iter().for_each(|&(dof, sign)| signs[dof] = sign);
        signs
    }

    /// What the supports load: minus the forces that their motions ask for.
    fn load(&self) -> Vec<f64> {
        let mut moved = vec![0.0; self.matrix.size];
        self.fixed.iter().zip(&self.prescribed).for_each(|(&dof, u)| moved[dof] = *u);
        let mut load: Vec<f64> = self.matrix.times(&moved).iter().map(|f| -f).collect();
        self.fixed.iter().for_each(|&dof| load[dof] = 0.0);
        load.iter().zip(self.signs()).map(|(f, sign)| f * sign).collect()
    }

    fn host(&self, wrong: Wrong, asked: &Arc<AtomicU64>) -> Host {
        let (signs, mut columns) = (self.signs(), vec![Vec::new(); self.matrix.size]);
        let is_fixed = |dof: usize| self.fixed.contains(&dof);
        for (i, j, value) in self.matrix.entries() {
            if i == j {
                columns[i].push((i, value));
            } else if !is_fixed(i) && !is_fixed(j) {
                columns[j].push((i, signs[i] * signs[j] * value));
                columns[i].push((j, signs[i] * signs[j] * value));
            }
        }
        let components = self.components.iter().map(|(dof, _)| *dof).collect();
        Host { columns, components, last: Mutex::default(), asked: asked.clone(), wrong }
    }

    fn units(&self) -> Vec<f64> {
        let mut units = vec![0.0; self.matrix.size];
        self.matrix.entries().filter(|(i, j, _)| i == j).for_each(|(i, _, value)| units[i] = value);
        units
    }

    fn model(&self, host: Host) -> Result<Model, signorini::Error> {
        let components = host.components.clone();
        Model::preconditioned(self.condensed.dim(), Box::new(host), &self.units(), &components)
    }

    fn solve(
        &self,
        model: &Model,
        law: FrictionLaw<'_>,
        slip: &[f64],
    ) -> Result<Solution, signorini::Error> {
        let load = self.load();
        let nothing = vec![0.0; self.matrix.size];
        let is_condensed = model.fixed_count() > 0;
        let case = LoadCase {
            load: if is_condensed { &nothing } else { &load },
            prescribed: is_condensed.then_some(&self.prescribed),
            gap: &self.gap,
            law,
            reference_slip: Some(slip),
        };
        let settings = Settings::default();
        model.solve(&case, &settings, None, &mut Monitor::new(&settings, None))
    }

    /// Both are certified to 1e-10 of the forces, which displacements of these meshes follow with ten times that.
    fn check(&self, law: FrictionLaw<'_>, slip: &[f64], context: &str) {
        let asked = Arc::default();
        let model = self.model(self.host(Wrong::Nothing, &asked)).unwrap();
        let (found, wanted) = (
            self.solve(&model, law, slip).unwrap(),
            self.solve(&self.condensed, law, slip).unwrap(),
        );
        for solution in [&found, &wanted] {
            assert_eq!(solution.status, Status::Solved, "{context}: {}", solution.message);
        }
        println!(
            "{context}: {} systems, {} preconditionings",
            found.factorisations,
            asked.load(Relaxed)
        );
        let apart = |a: &[f64], b: &[f64]| largest(&difference(a, b)) / largest(b);
        assert!(apart(&found.d, &wanted.d) <= 1e-9, "{context}: d");
        let forces = (&found.certificate.force, &wanted.certificate.force);
        assert!(apart(forces.0, forces.1) <= 1e-9, "{context}: F");
        // Each preconditioning is counted, and all displacements are those of the condensed model.
        assert_eq!(found.outer_iterations, asked.load(Relaxed), "{context}");
        let nothing = vec![0.0; self.matrix.size];
        let whole =
            self.condensed.recover(Some(&nothing), Some(&self.prescribed), &wanted.d).unwrap();
        let mut whole: Vec<f64> =
            whole.iter().zip(self.signs()).map(|(u, sign)| u * sign).collect();
        self.fixed.iter().for_each(|&dof| whole[dof] = 0.0);
        let load = self.load();
        for d in [&found.d, &wanted.d] {
            // The first by what the solution has left, the second, if it has other digits, anew.
            let u = model.recover(Some(&load), None, d).unwrap();
            assert!(apart(&u, &whole) <= 1e-9, "{context}: u");
        }
        let nodal = model.nodal_forces(&wanted.certificate.force).unwrap();
        let host: Vec<f64> = self.condensed.nodal_forces(&wanted.certificate.force).unwrap();
        let host: Vec<f64> = host.iter().zip(self.signs()).map(|(f, sign)| f * sign).collect();
        assert_eq!(nodal, host, "{context}: nodal forces");
    }
}

#[test]
fn a_bad_preconditioner_gives_the_answers_of_the_condensed_matrix() {
    for (problem, name) in [(Problem::plane(16), "plane"), (Problem::space(5), "space")] {
        let pairs = problem.gap.len();
        let slip = vec![0.0; (problem.condensed.dim() - 1) * pairs];
        for mu in [0.0, 0.3, 1.0] {
            let mu = vec![mu; pairs];
            problem.check(FrictionLaw::Coulomb(&mu), &slip, &format!("{name}, mu {}", mu[0]));
        }
    }
}

/// The springs that the host is handed are positive semi-definite, also under the collinear rule, whose slope is not
/// symmetric: [`Host::precondition`] asserts it.
#[test]
fn collinear_slips_are_those_of_the_condensed_matrix() {
    let problem = Problem::space(4);
    let pairs = problem.gap.len();
    let numbers: Vec<f64> = (0..pairs).flat_map(|j| [0.1, 0.4, 0.7 * (j % 5) as f64]).collect();
    let law = FrictionLaw::OrthotropicCollinear(&numbers);
    problem.check(law, &vec![0.0; 2 * pairs], "collinear");
}

/// Every third pair tied, with a slip of its own.
#[test]
fn ties_and_slips_are_those_of_the_condensed_matrix() {
    for (problem, name) in [(Problem::plane(12), "plane"), (Problem::space(4), "space")] {
        let pairs = problem.gap.len();
        let numbers: Vec<f64> = (0..pairs)
            .flat_map(|j| if j % 3 == 0 { [7.0, 0.0, 0.0, 0.0] } else { [1.0, 0.3, 0.0, 0.0] })
            .collect();
        let slip: Vec<f64> =
            (0..(problem.condensed.dim() - 1) * pairs).map(|i| 1e-3 * (i % 5) as f64).collect();
        problem.check(FrictionLaw::ByPair(&numbers), &slip, name);
    }
}

/// The measure of displacements from elsewhere is that of a model in full space, which has the same units and solves by a
/// factor.
#[test]
fn displacements_from_elsewhere_are_measured() {
    let problem = Problem::plane(12);
    let (pairs, mu) = (problem.gap.len(), vec![0.3; problem.gap.len()]);
    let model = problem.model(problem.host(Wrong::Nothing, &Arc::default())).unwrap();
    let contact: Vec<usize> =
        problem.components.iter().step_by(2).map(|(dof, _)| dof / 2).collect();
    let obstacle = Pairs::on_obstacle(&contact, [0.0, -1.0]);
    let settings = Settings { full_space: true, ..Settings::default() };
    let monitor = &mut Monitor::new(&settings, None);
    let full = problem.matrix.model_under(&problem.fixed, &obstacle.view(), monitor).unwrap();
    let law = FrictionLaw::Coulomb(&mu);
    let solution = problem.solve(&problem.condensed, law, &vec![0.0; pairs]).unwrap();
    let (load, gap) = (problem.load(), &problem.gap[..]);
    for off in [0.0, 1e-5] {
        let d: Vec<f64> = solution.d.iter().map(|d| d * (1.0 + off)).collect();
        let case = LoadCase { load: &load, prescribed: None, gap, law, reference_slip: None };
        let found = model.certify(&case, &d).unwrap();
        let nothing = vec![0.0; load.len()];
        let prescribed = Some(&problem.prescribed[..]);
        let wanted = full.certify(&LoadCase { load: &nothing, prescribed, ..case }, &d).unwrap();
        // The size of the loads, to which `eta` is relative, is known to a thousandth; the solution itself has an `eta` of 1e-10.
        let apart = (found.eta - wanted.eta).abs();
        assert!(apart <= 2e-3 * wanted.eta + 1e-10, "{} {}", found.eta, wanted.eta);
    }
}

#[test]
fn what_is_wrong_is_named() {
    let problem = Problem::plane(6);
    let (pairs, asked) = (problem.gap.len(), Arc::default());
    let host = |wrong| problem.host(wrong, &asked);
    let refused =
        |model: Result<Model, signorini::Error>| model.err().unwrap().message().to_string();
    let unsymmetric = refused(problem.model(host(Wrong::Unsymmetric)));
    assert!(unsymmetric.contains("A is not symmetric"), "{unsymmetric}");
    let (units, places) = (problem.units(), host(Wrong::Nothing).components);
    let with = |units: &[f64], places: &[usize]| {
        refused(Model::preconditioned(2, Box::new(host(Wrong::Nothing)), units, places))
    };
    let mut wrong = units.clone();
    wrong[3] = 0.0;
    assert_eq!(with(&wrong, &places), "units[3] must be positive and finite");
    let mut wrong = places.clone();
    wrong[2] = wrong[0];
    assert_eq!(with(&units, &wrong), format!("place[2] is {}, as one before it is", wrong[0]));
    wrong[2] = units.len();
    let message = format!("place[2] is {}, there is no such unknown", units.len());
    assert_eq!(with(&units, &wrong), message);
    assert_eq!(with(&units, &places[1..]), "place has 13 entries, not 2 for each pair");
    let (mu, slip) = (vec![0.3; pairs], vec![0.0; pairs]);
    let faults = [
        (Wrong::Fails, "has returned 42"),
        (Wrong::NotFinite, "is not finite"),
        (Wrong::Unwritten, "or was not written"),
    ];
    for (fault, message) in faults {
        let model = problem.model(host(fault)).unwrap();
        let error = problem.solve(&model, FrictionLaw::Coulomb(&mu), &slip).unwrap_err();
        assert!(error.message().to_string().contains(message), "{}", error.message());
    }
}
