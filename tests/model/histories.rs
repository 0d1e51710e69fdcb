//! One model, many load cases: histories, warm starts, threads.

use crate::common::dense::{difference, largest};
use crate::common::mesh::{Mesh, Pairs, Stiffness, steps};
use fastrand::Rng;
use signorini::{
    Argument, Error, FrictionLaw, LoadCase, Method, Model, Monitor, Settings, Solution, State,
    Status,
};

const PAIRS: usize = 9;

/// A block on a block; loads: pressure on the top, and shear along it.
struct Blocks {
    model: Model,
    pressure: Vec<f64>,
    shear: Vec<f64>,
    stiffness: Stiffness,
}

impl Blocks {
    fn new() -> Blocks {
        let mut mesh = Mesh::default();
        let x = steps(0.0, 3.0, PAIRS - 1);
        let lower = mesh.block(&x, &steps(0.0, 1.0, 3), (2000.0, 0.3));
        let upper = mesh.block(&x, &steps(1.0, 2.0, 3), (700.0, 0.3));
        let fixed: Vec<usize> =
            lower.row(0).iter().flat_map(|node| [2 * node, 2 * node + 1]).collect();
        let pairs = Pairs::matching(&upper.row(0), &lower.row(3), [0.0, -1.0]);
        let stiffness = mesh.stiffness();
        let model = stiffness.model(&fixed, &pairs).unwrap();
        let mut pressure = vec![0.0; mesh.size()];
        let mut shear = pressure.clone();
        mesh.traction(&upper.row(3), [0.0, -1.0], &mut pressure);
        mesh.traction(&upper.row(3), [1.0, 0.0], &mut shear);
        Blocks { model, pressure, shear, stiffness }
    }

    fn load(&self, pressure: f64, shear: f64) -> Vec<f64> {
        let parts = self.pressure.iter().zip(&self.shear);
        parts.map(|(p, s)| pressure * p + shear * s).collect()
    }

    fn solve(
        &self,
        load: &[f64],
        mu: f64,
        slip: Option<&[f64]>,
        start: Option<&[f64]>,
        method: Method,
    ) -> Solution {
        let case = LoadCase {
            load,
            prescribed: None,
            gap: &[0.0; PAIRS],
            law: FrictionLaw::Coulomb(&[mu; PAIRS]),
            reference_slip: slip,
        };
        let settings = Settings { method, tolerance: 1e-12, ..Settings::default() };
        let monitor = &mut Monitor::new(&settings, None);
        let solution = self.model.solve(&case, &settings, start, monitor).unwrap();
        assert_eq!(solution.status, Status::Solved, "{}", solution.message);
        solution
    }
}

/// Step `k` of 50: pressure and shear grow, the shear turns and grows the other way.
fn step(blocks: &Blocks, k: usize) -> Vec<f64> {
    let time = k as f64 / 49.0;
    let shear = if time < 0.5 { 2.0 * time } else { 3.0 - 4.0 * time };
    blocks.load(4.0 + 4.0 * time, 2.0 * shear)
}

/// Steps with the slip of the one before, from the slip `carried`.
fn history(blocks: &Blocks, steps: std::ops::Range<usize>, mut carried: Vec<f64>) -> Vec<Solution> {
    steps
        .map(|k| {
            let solution =
                blocks.solve(&step(blocks, k), 0.4, Some(&carried), None, Method::SorNested);
            carried = tangential(&solution);
            solution
        })
        .collect()
}

fn tangential(solution: &Solution) -> Vec<f64> {
    solution.d.iter().skip(1).step_by(2).copied().collect()
}

/// All that a history is, is in the caller's arrays: a second model that goes on from the middle
/// gets the same bits. The history matters: it slips, sticks when the load turns, slips back, and
/// ends elsewhere than its last loads alone would.
#[test]
fn a_history_goes_on_from_the_slip_in_the_callers_arrays() {
    let blocks = Blocks::new();
    let whole = history(&blocks, 0..50, vec![0.0; PAIRS]);
    for middle in [1, 20, 25, 40] {
        let again = history(&Blocks::new(), middle..50, tangential(&whole[middle - 1]));
        for (k, (one, two)) in whole[middle..].iter().zip(&again).enumerate() {
            assert_eq!(one.d, two.d, "from {middle}, step {k}");
            assert_eq!(one.certificate.force, two.certificate.force, "from {middle}, step {k}");
        }
    }
    let sliding = |k: usize| {
        whole[k].certificate.states.iter().filter(|state| **state == State::Slip).count()
    };
    assert!(sliding(24) > 0, "it slips before the load turns");
    assert_eq!(sliding(26), 0, "it sticks when the load turns");
    assert!(sliding(49) > 0, "it slips back");
    let total = blocks.solve(&step(&blocks, 49), 0.4, None, None, Method::SorNested);
    let force = &whole[49].certificate.force;
    let apart = largest(&difference(force, &total.certificate.force)) / largest(force);
    assert!(apart > 1e-3, "the history matters: {apart:e}");
}

/// Whatever the start, the answer is the same, to the tolerance of 1e-12 times a condition of 1e3.
#[test]
fn a_warm_start_gives_the_same_answer() {
    let blocks = Blocks::new();
    let load = blocks.load(6.0, 1.7);
    for (mu, method) in
        [(0.4, Method::SorNested), (0.4, Method::SorDiagonal), (0.1, Method::SorNested)]
    {
        // Below the friction angle, where the block rests.
        let load = if mu < 0.2 { blocks.load(6.0, 0.4) } else { load.clone() };
        let cold = blocks.solve(&load, mu, None, None, method);
        let near = blocks.solve(&blocks.load(6.1, 0.39), mu, None, None, method).d;
        let wild = crate::common::problems::vector(&mut Rng::with_seed(1), 2 * PAIRS);
        for start in [&cold.d, &near, &wild] {
            let warm = blocks.solve(&load, mu, None, Some(start), method);
            for (name, one, two) in
                [("d", &warm.d, &cold.d), ("F", &warm.certificate.force, &cold.certificate.force)]
            {
                let error = largest(&difference(one, two)) / largest(two);
                assert!(error <= 1e-9, "mu {mu}, {method:?}: {name}: {error:e}");
            }
        }
        // A start at the answer needs no more than it takes to see that.
        let again = blocks.solve(&load, mu, None, Some(&cold.d), method);
        assert!(again.iterations < cold.iterations, "{} of {}", again.iterations, cold.iterations);
    }
}

/// Four threads solve different cases on one model, and recover, at once: the bits of the
/// sequential run.
#[test]
fn threads_share_a_model() {
    let blocks = Blocks::new();
    let cases: Vec<(Vec<f64>, f64)> = (0..40)
        .map(|k| {
            let k = f64::from(k);
            (blocks.load(3.0 + 0.1 * k, 0.5 + 0.01 * k), if k % 4.0 == 0.0 { 0.0 } else { 0.5 })
        })
        // Without friction nothing holds the block along the shear.
        .map(|(load, mu)| if mu == 0.0 { (blocks.load(3.0, 0.0), mu) } else { (load, mu) })
        .collect();
    let run = |(load, mu): &(Vec<f64>, f64)| {
        let method = if *mu == 0.0 { Method::Lemke } else { Method::SorNested };
        let solution = blocks.solve(load, *mu, None, None, method);
        let u = blocks.model.recover(Some(load), None, &solution.d).unwrap();
        let nodal = blocks.model.nodal_forces(&solution.certificate.force).unwrap();
        (solution.d, u, nodal)
    };
    let sequential: Vec<_> = cases.iter().map(run).collect();
    assert!(largest(&blocks.stiffness.times(&sequential[1].1)) > 0.1, "the cases do something");
    let (run, cases) = (&run, &cases);
    for _ in 0..5 {
        std::thread::scope(|scope| {
            let threads: Vec<_> = (0..4)
                .map(|first| {
                    scope.spawn(move || {
                        cases.iter().skip(first).step_by(4).map(run).collect::<Vec<_>>()
                    })
                })
                .collect();
            for (first, thread) in threads.into_iter().enumerate() {
                let results = thread.join().unwrap();
                let expected: Vec<_> = sequential.iter().skip(first).step_by(4).cloned().collect();
                assert!(results == expected, "thread {first}");
            }
        });
    }
}

/// `K = 1 - c v vᵀ`, `v` the unit vector of equal entries: the eigenvalue along `v` is `1 - c`, and each pair of
/// entries on its own is that of a definite matrix. A model refuses `c > 1` by the component with
/// which the energy first can be negative; `c = 1` is a free body.
#[test]
fn an_indefinite_matrix_is_refused_by_a_component() {
    let n = 6;
    let matrix = |c: f64| -> Vec<f64> {
        let entry = |k: usize| if k / n == k % n { 1.0 } else { 0.0 } - c / n as f64;
        (0..n * n).map(entry).collect()
    };
    for dim in [2, 3] {
        let refused = |c: f64| match Model::condensed(dim, n / dim, &matrix(c), n) {
            Err(Error::Invalid { argument: Argument::Matrix, message }) => message.to_string(),
            _ => panic!("dim {dim}: {c} is accepted"),
        };
        for c in [1.0 + 1e-6, 1.04, 1.5] {
            let message = refused(c);
            // The block of the leading m components has the eigenvalue 1 - c m / n.
            let last = (0..n).find(|m| c * (m + 1) as f64 > n as f64).unwrap();
            let named = format!("components up to {last}, the last of pair {},", last / dim);
            assert!(message.contains("semi-definite") && message.contains(&named), "{message}");
        }
        for c in [0.0, 0.9, 1.0 - 1e-12, 1.0] {
            assert!(Model::condensed(dim, n / dim, &matrix(c), n).is_ok(), "dim {dim}, {c}");
        }
    }
    let (sound, wrong) = (matrix(0.5), matrix(1.04));
    let Err(Error::Invalid { argument, message }) = Model::two_body(2, 3, (&sound, n), (&wrong, n))
    else {
        panic!("an indefinite body is accepted");
    };
    assert!(argument == Argument::SecondMatrix && message.contains("K_B"), "{message}");
}
