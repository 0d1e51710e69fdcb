//! Regression tests for known failures of other solvers, one each.

use crate::common::bare::Bare;
use crate::common::dense::largest;
use crate::common::measures::{eta, flaw_of_escape, motion, rounding};
use crate::common::problems::{
    Case, Law, block, coulomb, decades, definite, frictionless, loaded, tresca, uniform, vector,
};
use fastrand::Rng;
use signorini::{Method, Settings, Solution, Status};

fn settings(method: Method) -> Settings {
    Settings { method, ..Settings::default() }
}

fn assert_solved(case: &Case, solution: &Solution, context: &str) {
    assert_eq!(solution.status, Status::Solved, "{context}: {}", solution.message);
    let residual = eta(case, &solution.d);
    assert!(residual <= 1e-10 + rounding(case, &solution.d), "{context}: {residual:e}");
}

/// The bar of tests/solve/bars.rs.
fn bar(pairs: usize, mu: f64) -> Case {
    let bar = crate::bar::bar_with_top(pairs - 1, 10, 1.5, 10.0, crate::bar::Top::Pressed);
    let law = Law::Coulomb(vec![mu; pairs]);
    let gap = vec![0.0; pairs];
    Case { dim: 2, pairs: bar.pairs, k: bar.stiffness, f: bar.load, gap, law, slip: None }
}

/// Lemke's method with friction in 2D ended with a code of success and a residual of 9e-3.
#[test]
fn the_bar_of_129_pairs_with_little_friction_is_solved_as_it_is_said_to_be() {
    let case = bar(129, 0.1);
    for method in
        [Method::Auto, Method::Newton, Method::Lemke, Method::SorNested, Method::SorDiagonal]
    {
        let solution = case.solve(&settings(method));
        assert_solved(&case, &solution, &format!("{method:?}"));
        // The plane carries 5 on 40, as in tests/solve/bars.rs.
        let carried: f64 = solution.certificate.force.iter().step_by(2).sum();
        assert!((carried + 200.0).abs() <= 1e-8 * 200.0, "{method:?}: {carried}");
    }
}

/// In units in which stiffnesses are 1e6 times as large or small three solvers returned wrong
/// answers as solved. Displacements change by the inverse, and forces do not: to 1e-7, as the
/// tolerance is 1e-12 and the condition 1e3 at most, friction low.
#[test]
fn the_unit_of_stiffness_does_not_matter() {
    for seed in 0..60 {
        let mut rng = Rng::with_seed(seed);
        let dim = rng.usize(2..=3);
        let pairs = rng.usize(1..=8);
        let condition = decades(&mut rng, 3.0);
        let k = definite(&mut rng, dim * pairs, condition);
        let law = coulomb(&mut rng, pairs, 0.2);
        let case = loaded(&mut rng, dim, k, law);
        let precise = Settings { tolerance: 1e-12, ..settings(Method::Auto) };
        let before = case.solve(&precise);
        assert_eq!(before.status, Status::Solved, "seed {seed}: {}", before.message);
        for factor in [1e6, 1e-6, 1e9, 1e-9, 1e12, 1e-12] {
            let times = |x: &[f64], by: f64| x.iter().map(|x| x * by).collect::<Vec<f64>>();
            let other = Case {
                k: times(&case.k, factor),
                gap: times(&case.gap, 1.0 / factor),
                slip: case.slip.as_ref().map(|slip| times(slip, 1.0 / factor)),
                ..case.clone()
            };
            let after = other.solve(&precise);
            let context = || format!("seed {seed}, {factor:e}: {before:?}\n{after:?}");
            assert_eq!(after.status, before.status, "{}", context());
            let back = times(&after.d, factor);
            let near = |a: &[f64], b: &[f64]| {
                let scale = largest(b).max(largest(&case.f));
                a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-7 * scale)
            };
            assert!(near(&back, &before.d), "{}", context());
            assert!(near(&after.certificate.force, &before.certificate.force), "{}", context());
            assert_eq!(after.certificate.states, before.certificate.states, "{}", context());
        }
    }
}

/// Two copies of each pair with half the load: `K' = Bᵀ K B`, `B = [1 1] / 2`, semi-definite with as
/// large a kernel as `K` has columns.
fn twice(case: &Case) -> Case {
    let n = case.size();
    let both = |x: &[f64]| [x, x].concat();
    Case {
        pairs: 2 * case.pairs,
        k: (0..4 * n * n).map(|k| case.stiffness(k % (2 * n) % n, k / (2 * n) % n) / 4.0).collect(),
        f: both(&case.f.iter().map(|f| f / 2.0).collect::<Vec<f64>>()),
        gap: both(&case.gap),
        law: match &case.law {
            Law::Coulomb(mu) => Law::Coulomb(both(mu)),
            Law::Tresca(g) => Law::Tresca(both(&g.iter().map(|g| g / 2.0).collect::<Vec<f64>>())),
            _ => unreachable!("none of these problems has cohesion or an ellipse"),
        },
        slip: case.slip.as_ref().map(|slip| both(slip)),
        ..*case
    }
}

/// Lemke's method gave up, another one aborted the process. Both copies carry the same force, as
/// `K' d - f'` has equal halves; hence the law holds for the mean of their displacements and the sum
/// of their forces: a solution of the problem without copies. Its residual is of the same size:
/// 10 times the tolerance is allowed.
#[test]
fn redundant_pairs_are_solved() {
    for seed in 0..300 {
        let mut rng = Rng::with_seed(seed);
        let pairs = rng.usize(1..=8);
        let condition = decades(&mut rng, 2.0);
        let k = definite(&mut rng, 2 * pairs, condition);
        let law = match seed % 3 {
            0 => coulomb(&mut rng, pairs, 0.3),
            1 => frictionless(pairs),
            _ => tresca(&mut rng, pairs),
        };
        let single = loaded(&mut rng, 2, k, law);
        let case = twice(&single);
        for method in [Method::Auto, Method::Lemke] {
            let solution = case.solve(&settings(method));
            let context = format!("seed {seed}, {method:?}");
            assert_solved(&case, &solution, &context);
            let (a, b) = solution.d.split_at(single.size());
            let mean: Vec<f64> = a.iter().zip(b).map(|(a, b)| (a + b) / 2.0).collect();
            let residual = eta(&single, &mean);
            assert!(residual <= 1e-9 + rounding(&case, &solution.d), "{context}: {residual:e}");
        }
    }
}

/// LCPs are redundant likewise: `M' = [M M; M M]`, and the sum of both halves of `z` solves `M`.
#[test]
fn redundant_complementarity_is_solved() {
    for seed in 0..200 {
        let mut rng = Rng::with_seed(seed);
        let n = rng.usize(1..=10);
        let condition = decades(&mut rng, 3.0);
        let m = definite(&mut rng, n, condition);
        let q = vector(&mut rng, n);
        let single = Bare { n, m, q: q.clone() };
        let m = (0..4 * n * n).map(|k| single.m[k % (2 * n) % n + n * (k / (2 * n) % n)]).collect();
        let double = Bare { n: 2 * n, m, q: [&q[..], &q].concat() };
        for method in [Method::Auto, Method::Lemke] {
            let mut solution = double.solve(&settings(method));
            let context = format!("seed {seed}, {method:?}: {solution:?}");
            assert_eq!(solution.status, Status::Solved, "{context}");
            assert_eq!(double.flaw(&solution, 1e-10), None, "{context}");
            solution.z = (0..n).map(|i| solution.z[i] + solution.z[n + i]).collect();
            // One of two copies may be zero with a w that is zero but for rounding.
            solution.w.truncate(n);
            for (w, z) in solution.w.iter_mut().zip(&solution.z) {
                assert!(*z == 0.0 || *w <= 1e-10, "{context}");
                *w = if *z > 0.0 { 0.0 } else { *w };
            }
            assert_eq!(single.flaw(&solution, 1e-9), None, "{context}");
        }
    }
}

/// 2^n pivots on problems in which block pivoting takes n + 1 systems: tests/lcp/worst_cases.rs has
/// them in detail.
#[test]
fn the_default_is_not_exponential_on_the_worst_cases_of_pivoting() {
    let n = 40;
    let lower = |i: usize, j: usize| f64::from([2_u8, 1, 0][(1 + j).saturating_sub(i).min(2)]);
    let power = |e: usize| 2_f64.powi(e as i32);
    let fathi = (0..n * n).map(|k| (0..n).map(|l| lower(k % n, l) * lower(k / n, l)).sum());
    let murty = (0..n * n).map(|k| lower(k % n, k / n));
    let rising = (0..n).map(|i| -(n - i..=n).map(power).sum::<f64>());
    for (name, data) in [
        ("Fathi", Bare { n, m: fathi.collect(), q: vec![-1.0; n] }),
        ("Murty", Bare { n, m: murty.collect(), q: rising.collect() }),
    ] {
        let budget = Settings { max_iterations: 1000, ..settings(Method::Auto) };
        let solution = data.solve(&budget);
        assert_eq!(solution.status, Status::Solved, "{name}: {}", solution.message);
        assert_eq!(data.flaw(&solution, budget.tolerance), None, "{name}");
    }
}

/// A code, no proof. Here infeasible problems are called so, and the vector or motion that is
/// returned proves it.
#[test]
fn infeasible_problems_come_with_a_proof() {
    for seed in 0..100 {
        let mut rng = Rng::with_seed(seed);
        // A positive y in the kernel with q.y < 0 proves it.
        let n = rng.usize(2..=8);
        let kernel: Vec<f64> = (0..n).map(|_| rng.f64() + 0.1).collect();
        let m =
            crate::common::problems::semidefinite(&mut rng, n, 10.0, std::slice::from_ref(&kernel));
        let mut q = vector(&mut rng, n);
        let work: f64 = q.iter().zip(&kernel).map(|(q, y)| q * y).sum();
        q[0] -= (work + 0.1) / kernel[0];
        let data = Bare { n, m, q };
        for method in [Method::Auto, Method::Lemke] {
            let solution = data.solve(&settings(method));
            let context = format!("seed {seed}, {method:?}: {solution:?}");
            assert_eq!(solution.status, Status::NoEquilibrium, "{context}");
            assert_eq!(data.flaw(&solution, 1e-10), None, "{context}");
        }

        // A block that is pushed harder than friction holds it.
        let pairs = rng.usize(3..=8);
        let mu = uniform(&mut rng, 0.0, 0.5);
        let push = (1.0 + uniform(&mut rng, 0.05, 1.0)) * mu + 0.05;
        let case = Case {
            dim: 2,
            pairs,
            k: block(&mut rng, pairs),
            f: [1.0, push].repeat(pairs),
            gap: vec![0.0; pairs],
            law: Law::Coulomb(vec![mu; pairs]),
            slip: None,
        };
        let solution = case.solve(&settings(Method::Auto));
        let context = format!("seed {seed}: {solution:?}");
        assert_eq!(solution.status, Status::NoEquilibrium, "{context}");
        assert_eq!(flaw_of_escape(&case, motion(&solution)), None, "{context}");
        // The ray of Lemke's method slides along the plane, which is less than a proof.
        let solution = case.solve(&settings(Method::Lemke));
        match solution.status {
            Status::NoEquilibrium => assert_eq!(flaw_of_escape(&case, motion(&solution)), None),
            other => assert_eq!(other, Status::Stalled, "seed {seed}: {solution:?}"),
        }
    }
}

/// Sweeps that update the threshold inside cycled here; the sequence of given thresholds converges.
/// So do the direct methods, and none claims what is not so.
#[test]
fn the_bar_of_513_pairs_with_law_1_is_solved() {
    let case = bar(513, 1.0);
    for method in [Method::Auto, Method::Newton, Method::SorNested] {
        let solution = case.solve(&settings(method));
        assert_solved(&case, &solution, &format!("{method:?}"));
    }
    let budget = Settings { max_iterations: 300, ..settings(Method::SorDiagonal) };
    let solution = case.solve(&budget);
    let solved = eta(&case, &solution.d) <= 1e-10;
    assert_eq!(solution.status == Status::Solved, solved, "{}", solution.message);
}

/// A projected Gauss–Seidel returned NaN as solved on unsymmetric positive definite matrices.
#[test]
fn unsymmetric_definite_problems_are_solved() {
    for seed in 0..400 {
        let mut rng = Rng::with_seed(seed);
        let n = rng.usize(1..=30);
        let condition = decades(&mut rng, 4.0);
        let mut m = definite(&mut rng, n, condition);
        let size = decades(&mut rng, 2.0);
        for j in 0..n {
            for i in 0..j {
                let skew = uniform(&mut rng, -size, size);
                m[i + j * n] += skew;
                m[j + i * n] -= skew;
            }
        }
        let data = Bare { n, m, q: vector(&mut rng, n) };
        for method in [Method::Auto, Method::Lemke, Method::BlockPivoting] {
            let solution = data.solve(&settings(method));
            let context = format!("seed {seed}, {method:?}: {:?} {}", data.n, solution.message);
            let numbers = solution.w.iter().chain(&solution.z);
            assert!(numbers.clone().all(|x| x.is_finite()), "{context}");
            if method == Method::BlockPivoting {
                // Finite for symmetric or P-matrices by its single flips; no theorem on rounding.
                assert!(matches!(solution.status, Status::Solved | Status::Stalled), "{context}");
            } else {
                assert_eq!(solution.status, Status::Solved, "{context}");
            }
            assert_eq!(data.flaw(&solution, 1e-10), None, "{context}");
        }
    }
}
