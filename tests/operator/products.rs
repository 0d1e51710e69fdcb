//! Models of which the host gives products and solutions alone: the same answers, few products, and functions of the
//! host that are wrong.

use std::sync::Arc;
use std::sync::atomic::{AtomicI64, AtomicU64, Ordering::Relaxed};

use crate::common::blocks::block;
use crate::common::brick::{Support, Vector};
use crate::common::dense::{difference, largest};
use crate::common::measures::{eta, rounding};
use crate::common::mesh::{Mesh, Pairs, steps};
use crate::common::problems::{Law, definite, loaded, uniform};
use signorini::reduce::{Held, HostOperator};
use signorini::{FrictionLaw, LoadCase, Model, Monitor, Settings, Solution, Status};

/// The calls that the host has answered, and after how many products it fails (negative: never).
#[derive(Default)]
struct Asked {
    products: AtomicU64,
    inverses: AtomicU64,
    solves: AtomicU64,
    factorisations: AtomicU64,
    fails_in: AtomicI64,
}

impl Asked {
    fn none() -> Arc<Asked> {
        Arc::new(Asked { fails_in: AtomicI64::new(-1), ..Asked::default() })
    }

    fn reset(&self) {
        for count in [&self.products, &self.inverses, &self.solves, &self.factorisations] {
            count.store(0, Relaxed);
        }
    }
}

/// A host with a matrix, which it factorises by itself.
struct Host {
    k: Vec<f64>,
    size: usize,
    factor: std::sync::Mutex<Vec<f64>>,
    inverse: Option<Vec<f64>>,
    holds: bool,
    asked: Arc<Asked>,
    wrong: Wrong,
}

/// Faults of a host.
#[derive(Clone, Copy, PartialEq)]
enum Wrong {
    Nothing,
    /// One entry, in this row and column, is larger by a thousandth of the diagonal.
    Unsymmetric(usize, usize),
    Affine,
    Irreproducible,
    Negative,
    NotFinite,
    Unwritten,
    IndefiniteInverse,
    MovesHeld,
}

/// The factor of `K` with rows and columns of held components replaced by those of 1; column-major.
fn cholesky(k: &[f64], size: usize, held: impl Fn(usize) -> bool) -> Vec<f64> {
    let mut l = k.to_vec();
    for j in 0..size {
        for i in 0..size {
            if held(i) || held(j) {
                l[i + size * j] = f64::from(u8::from(i == j));
            }
        }
    }
    for j in 0..size {
        let (before, rest) = l.split_at_mut(size * j);
        let column = &mut rest[..size];
        for p in 0..j {
            let (other, share) = (&before[size * p..size * (p + 1)], before[j + size * p]);
            if share != 0.0 {
                (j..size).for_each(|i| column[i] -= share * other[i]);
            }
        }
        let root = column[j].sqrt();
        (j..size).for_each(|i| column[i] /= root);
    }
    l
}

fn solved_by(l: &[f64], size: usize, b: &[f64]) -> Vec<f64> {
    let mut x = b.to_vec();
    for j in 0..size {
        x[j] /= l[j + size * j];
        let known = x[j];
        (j + 1..size).for_each(|i| x[i] -= known * l[i + size * j]);
    }
    for j in (0..size).rev() {
        let sum: f64 = (j + 1..size).map(|i| l[i + size * j] * x[i]).sum();
        x[j] = (x[j] - sum) / l[j + size * j];
    }
    x
}

impl Host {
    fn new(k: &[f64], size: usize, holds: bool, asked: &Arc<Asked>) -> Host {
        let inverse = (!holds).then(|| cholesky(k, size, |_| false));
        Host {
            k: k.to_vec(),
            size,
            factor: Default::default(),
            inverse,
            holds,
            asked: asked.clone(),
            wrong: Wrong::Nothing,
        }
    }
}

impl HostOperator for Host {
    fn stiffness(&self, x: &[f64], y: &mut [f64]) -> Result<(), i32> {
        let number = self.asked.products.fetch_add(1, Relaxed);
        let left = self.asked.fails_in.load(Relaxed);
        if left >= 0 && self.asked.fails_in.fetch_sub(1, Relaxed) == 0 {
            return Err(7);
        }
        y.fill(0.0);
        for (column, x) in self.k.chunks_exact(self.size).zip(x) {
            y.iter_mut().zip(column).for_each(|(y, k)| *y += k * x);
        }
        match self.wrong {
            Wrong::Unsymmetric(row, column) => y[row] += 1e-3 * self.k[0] * x[column],
            Wrong::Affine => y[0] += self.k[0],
            Wrong::Irreproducible => y[0] *= 1.0 + 1e-6 * number as f64,
            Wrong::Negative => y.iter_mut().for_each(|y| *y = -*y),
            Wrong::NotFinite => y[3] = f64::NAN,
            Wrong::Unwritten => y[5..].fill(f64::NAN),
            _ => {}
        }
        Ok(())
    }

    fn has_inverse(&self) -> bool {
        self.inverse.is_some()
    }

    fn inverse(&self, x: &[f64], y: &mut [f64]) -> Result<(), i32> {
        self.asked.inverses.fetch_add(1, Relaxed);
        y.copy_from_slice(&solved_by(self.inverse.as_ref().unwrap(), self.size, x));
        if self.wrong == Wrong::IndefiniteInverse {
            y.iter_mut().for_each(|y| *y = -*y);
        }
        Ok(())
    }

    fn has_held(&self) -> bool {
        self.holds
    }

    fn held(&self, held: &Held<'_>, x: &[f64], y: &mut [f64]) -> Result<(), i32> {
        let (held, changed) = (held.components, held.changed);
        self.asked.solves.fetch_add(1, Relaxed);
        let mut factor = self.factor.lock().unwrap();
        if changed {
            self.asked.factorisations.fetch_add(1, Relaxed);
            *factor = cholesky(&self.k, self.size, |i| held[i]);
        }
        let free: Vec<f64> = x.iter().zip(held).map(|(x, h)| if *h { 0.0 } else { *x }).collect();
        y.copy_from_slice(&solved_by(&factor, self.size, &free));
        if self.wrong == Wrong::MovesHeld {
            y.fill(1.0);
        }
        Ok(())
    }
}

/// A condensed problem.
struct Condensed {
    dim: usize,
    k: Vec<f64>,
    f: Vec<f64>,
    gap: Vec<f64>,
    model: Model,
}

impl Condensed {
    fn new(model: Model, f: Vec<f64>, gap: Vec<f64>) -> Condensed {
        let k = model.stiffness().to_vec();
        Condensed { dim: model.dim(), k, f, gap, model }
    }

    /// A block that is clamped above, pressed down and shifted along waves, with `columns` elements along the
    /// contact.
    fn plane(columns: usize) -> Condensed {
        let mut mesh = Mesh::default();
        let lines = [0.0, 0.01, 0.03, 0.07, 0.15, 0.3, 0.6, 1.0];
        let block = mesh.block(&steps(0.0, 2.0, columns), &lines, (1.0, 0.3));
        let top = block.row(block.rows);
        let fixed: Vec<usize> = top.iter().flat_map(|n| [2 * n, 2 * n + 1]).collect();
        let prescribed = [0.02, -0.03].repeat(top.len());
        let pairs = Pairs::on_obstacle(&block.row(0), [0.0, -1.0]);
        let model = mesh.stiffness().model(&fixed, &pairs).unwrap();
        let load = vec![0.0; mesh.size()];
        let f = model.condensed_load(&load, Some(&prescribed)).unwrap();
        let place = |i: usize| 2.0 * i as f64 / columns as f64;
        let gap = (0..=columns).map(|i| 0.02 * (1.0 - (7.0 * place(i)).cos())).collect();
        Condensed::new(model, f, gap)
    }

    fn space(nodes: usize) -> Condensed {
        let brick = block(nodes, Support::Clamped);
        let model = brick.model();
        let motion = |[x, y, _]: Vector| [0.008 - 0.009 * y, 0.003 + 0.009 * x, -0.03];
        let (load, prescribed) = brick.moved(motion);
        let f = model.condensed_load(&load, prescribed.as_deref()).unwrap();
        let gap = |pair: usize| {
            let [x, y, _] = brick.place(pair);
            0.02 * (1.0 - (4.0 * x).cos() * (3.0 * y + 0.5).cos())
        };
        let gap = (0..brick.pairs()).map(gap).collect();
        Condensed::new(model, f, gap)
    }

    fn host(&self, holds: bool, asked: &Arc<Asked>) -> Host {
        Host::new(&self.k, self.f.len(), holds, asked)
    }

    fn operator(&self, host: Host) -> Result<Model, signorini::Error> {
        Model::operator(self.dim, self.gap.len(), Box::new(host), None)
    }

    /// A dense model of the condensed model's matrix.
    fn dense(&self) -> Model {
        Model::condensed(self.dim, self.gap.len(), &self.k, self.f.len()).unwrap()
    }

    fn solve(&self, model: &Model, mu: f64) -> Result<Solution, signorini::Error> {
        let mu = vec![mu; self.gap.len()];
        let case = LoadCase {
            load: &self.f,
            prescribed: None,
            gap: &self.gap,
            law: FrictionLaw::Coulomb(&mu),
            reference_slip: None,
        };
        let settings = Settings::default();
        model.solve(&case, &settings, None, &mut Monitor::new(&settings, None))
    }
}

/// Both are certified to 1e-10 of the forces, which displacements of these meshes follow with ten times that.
fn same(operator: &Solution, dense: &Solution, context: &str) {
    for solution in [operator, dense] {
        assert_eq!(solution.status, Status::Solved, "{context}: {}", solution.message);
    }
    let forces = (&operator.certificate.force, &dense.certificate.force);
    for (what, (a, b)) in [("d", (&operator.d, &dense.d)), ("F", forces)] {
        let apart = largest(&difference(a, b)) / largest(b);
        assert!(apart <= 1e-9, "{context}: {what} is {apart:e} apart");
    }
}

/// Products with `K_rel` and `W`, solutions with components held, and factorisations of the host. The limits are
/// those that the header promises.
fn check_counts(condensed: &Condensed, most: u64, context: &str) {
    let asked = Asked::none();
    for mu in [0.0, 0.1, 0.3, 1.0] {
        let dense = condensed.solve(&condensed.dense(), mu).unwrap();
        for holds in [false, true] {
            let model = condensed.operator(condensed.host(holds, &asked)).unwrap();
            asked.reset();
            let solution = condensed.solve(&model, mu).unwrap();
            let counts = [&asked.products, &asked.inverses, &asked.solves, &asked.factorisations]
                .map(|count| count.load(Relaxed));
            let context = format!("{context}, mu {mu}, with held {holds}: {counts:?}");
            println!("{context}");
            same(&solution, &dense, &context);
            let [products, inverses, solves, factorisations] = counts;
            assert!(products <= most && inverses <= most, "{context}");
            assert!(solves <= 70 && factorisations <= 14, "{context}");
        }
    }
}

#[test]
fn blocks_in_the_plane_take_few_products() {
    for columns in [32, 128, 400] {
        check_counts(&Condensed::plane(columns), 110, &format!("{} pairs", columns + 1));
    }
}

/// A load case is refused before the host is asked for anything, where the limit on memory is a byte below what is told.
#[test]
fn a_limit_on_memory_refuses_load_cases() {
    let (condensed, asked) = (Condensed::plane(8), Asked::none());
    let model = condensed.operator(condensed.host(true, &asked)).unwrap();
    asked.reset();
    let (load, gap) = (&condensed.f[..], &condensed.gap[..]);
    let law = FrictionLaw::Frictionless;
    let case = LoadCase { load, prescribed: None, gap, law, reference_slip: None };
    let limited = |memory_limit| {
        let settings = Settings { memory_limit, ..Settings::default() };
        model.solve(&case, &settings, None, &mut Monitor::new(&settings, None))
    };
    let refused = limited(model.memory() - 1).err().unwrap().message().to_string();
    assert!(refused.contains("memory_limit allows"), "{refused}");
    assert_eq!(asked.products.load(Relaxed), 0);
    assert!(limited(model.memory()).is_ok());
}

/// Every third pair tied, with a gap and a slip of its own: products and `W` alone, and solutions with components held,
/// give what the dense matrix gives.
#[test]
fn ties_are_held_by_products_alone() {
    let asked = Asked::none();
    for (condensed, name) in [(Condensed::plane(60), "plane"), (Condensed::space(5), "space")] {
        let pairs = condensed.gap.len();
        let numbers: Vec<f64> = (0..pairs)
            .flat_map(|j| if j % 3 == 0 { [7.0, 0.0, 0.0, 0.0] } else { [1.0, 0.3, 0.0, 0.0] })
            .collect();
        let slip: Vec<f64> =
            (0..(condensed.dim - 1) * pairs).map(|i| 1e-3 * (i % 5) as f64).collect();
        let case = LoadCase {
            load: &condensed.f,
            prescribed: None,
            gap: &condensed.gap,
            law: FrictionLaw::ByPair(&numbers),
            reference_slip: Some(&slip),
        };
        let settings = Settings::default();
        let solve = |model: &Model| {
            model.solve(&case, &settings, None, &mut Monitor::new(&settings, None)).unwrap()
        };
        let dense = solve(&condensed.dense());
        for holds in [false, true] {
            let model = condensed.operator(condensed.host(holds, &asked)).unwrap();
            same(&solve(&model), &dense, &format!("{name}, with held {holds}"));
        }
    }
}

/// Random definite problems with friction up to 20, of which theory promises that each has a solution: the paths
/// behind Newton's method find one, with components held, and with products and `W` alone.
fn check_hard_friction(dim: usize) {
    let asked = Asked::none();
    let mut unsolved = [0, 0];
    for condition in [1e2, 1e4] {
        for seed in 0..60 {
            let mut rng = fastrand::Rng::with_seed(seed);
            let pairs = rng.usize(1..=16);
            let k = definite(&mut rng, dim * pairs, condition);
            let mu = uniform(&mut rng, 0.1_f64.ln(), 20_f64.ln()).exp();
            let law = Law::Coulomb(vec![mu; pairs]);
            let problem = loaded(&mut rng, dim, k, law);
            for holds in [false, true] {
                let host = Host::new(&problem.k, dim * pairs, holds, &asked);
                let model = Model::operator(dim, pairs, Box::new(host), None).unwrap();
                let case = LoadCase {
                    load: &problem.f,
                    prescribed: None,
                    gap: &problem.gap,
                    law: FrictionLaw::Coulomb(&vec![mu; pairs]),
                    reference_slip: problem.slip.as_deref(),
                };
                let settings = Settings::default();
                let monitor = &mut Monitor::new(&settings, None);
                let solution = model.solve(&case, &settings, None, monitor).unwrap();
                let context = format!("condition {condition:e}, seed {seed}, mu {mu}, {holds}");
                let allowed = 1e-10 + rounding(&problem, &solution.d);
                if solution.status != Status::Solved || eta(&problem, &solution.d) > allowed {
                    println!("{context}: {}", solution.message);
                    unsolved[usize::from(holds)] += 1;
                }
            }
        }
    }
    assert_eq!(unsolved, [0, 0], "of 120");
}

#[test]
fn hard_friction_in_the_plane_is_solved() {
    check_hard_friction(2);
}

#[test]
fn hard_friction_in_space_is_solved() {
    check_hard_friction(3);
}

/// `SIGNORINI_OPERATOR_NODES=31` adds a block of 31 x 31 pairs, which takes more than a minute.
#[test]
fn blocks_in_space_take_few_products() {
    let larger = std::env::var("SIGNORINI_OPERATOR_NODES").map(|nodes| nodes.parse().unwrap());
    for nodes in [5, 9, 13].into_iter().chain(larger) {
        check_counts(&Condensed::space(nodes), 160, &format!("{} pairs", nodes * nodes));
    }
}

#[test]
fn wrong_operators_are_refused() {
    let condensed = Condensed::plane(8);
    for (wrong, holds, words) in [
        (Wrong::Unsymmetric(0, 1), false, "K_rel is not symmetric"),
        (Wrong::Affine, false, "K_rel is not linear"),
        (Wrong::Irreproducible, false, "K_rel is not reproducible"),
        (Wrong::Negative, false, "K_rel is not positive"),
        (Wrong::NotFinite, false, "y[3] is not finite"),
        (Wrong::Unwritten, false, "y[5] is not finite, or was not written"),
        (Wrong::IndefiniteInverse, false, "W is not positive"),
        (Wrong::MovesHeld, true, "with components held"),
    ] {
        let host = Host { wrong, ..condensed.host(holds, &Asked::none()) };
        let message = condensed.operator(host).err().expect(words).message().to_string();
        assert!(message.contains(words), "{message}");
    }
    let neither = Host { inverse: None, ..condensed.host(false, &Asked::none()) };
    let message = condensed.operator(neither).err().unwrap().message().to_string();
    assert!(message.contains("give one of them"), "{message}");
    for (units, words) in [(vec![1.0; 3], "3 entries"), (vec![-1.0; 18], "units[0] must be")] {
        let host = Box::new(condensed.host(false, &Asked::none()));
        let message = Model::operator(2, 9, host, Some(&units)).err().unwrap().message();
        assert!(message.contains(words), "{message}");
    }
}

/// With few components, where two vectors may well agree in many of them.
#[test]
fn every_entry_that_is_not_symmetric_is_found() {
    let condensed = Condensed::plane(1);
    for row in 0..4 {
        for column in (0..4).filter(|&column| column != row) {
            let wrong = Wrong::Unsymmetric(row, column);
            let host = Host { wrong, ..condensed.host(false, &Asked::none()) };
            let message = condensed.operator(host).err().expect("refused").message().to_string();
            assert!(message.contains("K_rel is not symmetric"), "{message}");
        }
    }
}

/// A host that fails in a product ends the call wherever it is; then the model serves as before.
#[test]
fn a_host_that_fails_ends_the_call() {
    let condensed = Condensed::plane(16);
    let asked = Asked::none();
    asked.fails_in.store(2, Relaxed);
    let message = condensed.operator(condensed.host(false, &asked)).err().unwrap().message();
    assert!(message.contains("K_rel x has returned 7"), "{message}");
    asked.fails_in.store(-1, Relaxed);
    let model = condensed.operator(condensed.host(false, &asked)).unwrap();
    asked.reset();
    let whole = condensed.solve(&model, 0.3).unwrap();
    let all = asked.products.load(Relaxed) as i64;
    for at in 0..all {
        asked.fails_in.store(at, Relaxed);
        let message = condensed.solve(&model, 0.3).expect_err("it fails").message();
        assert!(message.contains("K_rel x has returned 7"), "{at}: {message}");
        asked.fails_in.store(-1, Relaxed);
    }
    let again = condensed.solve(&model, 0.3).unwrap();
    assert_eq!((whole.status, &whole.d), (Status::Solved, &again.d));
}

/// A call that needs entries of a matrix is refused by a sentence; certify and recover are not.
#[test]
fn what_needs_the_matrix_is_refused() {
    let condensed = Condensed::plane(8);
    let model = condensed.operator(condensed.host(false, &Asked::none())).unwrap();
    assert!(model.is_matrix_free() && model.stiffness().is_empty());
    let solution = condensed.solve(&model, 0.3).unwrap();
    let mu = vec![0.3; 9];
    let case = LoadCase {
        load: &condensed.f,
        prescribed: None,
        gap: &condensed.gap,
        law: FrictionLaw::Coulomb(&mu),
        reference_slip: None,
    };
    assert!(model.certify(&case, &solution.d).unwrap().holds(1e-10));
    let off: Vec<f64> = solution.d.iter().map(|d| d + 1e-3).collect();
    assert!(!model.certify(&case, &off).unwrap().holds(1e-10));
    assert_eq!(model.recover(Some(&condensed.f), None, &solution.d).unwrap(), solution.d);
    let path = std::path::Path::new("never written");
    let message = model.write_case(path, &case, None).err().unwrap().message();
    assert!(message.contains("forms no condensed matrix"), "{message}");
    for settings in [
        Settings { method: signorini::Method::Lemke, ..Settings::default() },
        Settings { search: signorini::Search::Others, ..Settings::default() },
        Settings { proof: true, ..Settings::default() },
    ] {
        let monitor = &mut Monitor::new(&settings, None);
        let message = model.solve(&case, &settings, None, monitor).err().unwrap().message();
        assert!(message.contains("needs the condensed matrix"), "{message}");
    }
    assert_eq!(condensed.model.pairs(), 9);
}
