//! Results are invariant under a change of the units of length and force.

use crate::common::dense::largest;
use crate::common::measures::{flaw_of_escape, motion};
use crate::common::problems::{
    Case, Law, block, coulomb, decades, definite, floating, frictionless, loaded, mixed,
    semidefinite, tresca, vector,
};
use fastrand::Rng;
use signorini::certificate::certify;
use signorini::{Lcp, LcpSolution, Method, Monitor, Settings, Status, solve_lcp};

/// Units in which lengths and forces are given by numbers `length` and `force` times as large.
#[derive(Clone, Copy, Debug)]
struct Units {
    length: f64,
    force: f64,
}

const DECIMAL: [Units; 8] = {
    const fn units(length: f64, force: f64) -> Units {
        Units { length, force }
    }
    [
        units(1e12, 1.0),
        units(1e-12, 1.0),
        units(1.0, 1e12),
        units(1.0, 1e-12),
        units(1e12, 1e12),
        units(1e-12, 1e-12),
        units(1e12, 1e-12),
        units(1e-12, 1e12),
    ]
};

/// Powers of two round nothing; even ones, so that square roots of stiffnesses and of energies do
/// not either.
fn binary() -> impl Iterator<Item = Units> {
    let near = [(40, 0), (0, 38), (-30, 0), (0, -40), (31, 43), (-44, 44), (41, -41)];
    // Lengths, forces and stiffnesses whose products no double holds.
    let far = [(900, 0), (0, 900), (-900, 0), (0, -900), (900, 900), (-900, -900), (451, -451)];
    near.into_iter()
        .chain(far)
        .map(|(length, force)| Units { length: 2_f64.powi(length), force: 2_f64.powi(force) })
}

fn times(values: &[f64], factor: f64) -> Vec<f64> {
    values.iter().map(|value| value * factor).collect()
}

fn in_units(case: &Case, units: Units) -> Case {
    Case {
        k: times(&case.k, units.force / units.length),
        f: times(&case.f, units.force),
        gap: times(&case.gap, units.length),
        law: case.law.with_forces(units.force),
        slip: case.slip.as_ref().map(|slip| times(slip, units.length)),
        ..*case
    }
}

/// Problems of all kinds, conditions up to 1e4: the rounding of data given in other units, 1e-16,
/// changes answers by 1e-12 of their size. With each whether its stiffness is definite; otherwise
/// contact forces may be unique and displacements not.
fn problems(dims: &[usize], law: impl Fn(&mut Rng, usize) -> Law) -> Vec<(Case, bool)> {
    let mut cases = Vec::new();
    for seed in 0..60 {
        let mut rng = Rng::with_seed(seed);
        let pairs = rng.usize(1..=6);
        let condition = decades(&mut rng, 4.0);
        let k = match seed % 3 {
            0 => definite(&mut rng, 2 * pairs, condition),
            1 => floating(&mut rng, pairs, condition.min(100.0)).0,
            _ => block(&mut rng, pairs.max(3)),
        };
        let pairs = if seed % 3 == 2 { pairs.max(3) } else { pairs };
        let law = law(&mut rng, pairs);
        let mut case = loaded(&mut rng, 2, k, law);
        if seed % 6 == 2 {
            // Whole loads that cancel along the block.
            case.f.iter_mut().for_each(|f| *f = (4.0 * *f).round());
            case.f[1] -= case.f.iter().skip(1).step_by(2).sum::<f64>();
        }
        cases.push((case, seed % 3 == 0));
    }
    for seed in 0..20 {
        let mut rng = Rng::with_seed(seed);
        let dim = dims[seed as usize % dims.len()];
        let condition = decades(&mut rng, 4.0);
        let k = definite(&mut rng, 12, condition);
        let law = law(&mut rng, 12 / dim);
        cases.push((loaded(&mut rng, dim, k, law), true));
    }
    cases
}

fn check(method: Method, law: impl Fn(&mut Rng, usize) -> Law) {
    let settings = Settings { method, max_iterations: 20_000, ..Settings::default() };
    let (mut decided, mut stalled) = (0, 0);
    let with_law =
        matches!(law(&mut Rng::with_seed(0), 40), Law::Coulomb(mu) if largest(&mu) > 0.0);
    let planar = method == Method::Lemke && with_law;
    for (index, (case, definite)) in
        problems(if planar { &[2] } else { &[3] }, law).iter().enumerate()
    {
        let before = case.solve(&settings);
        decided += usize::from(matches!(before.status, Status::Solved | Status::NoEquilibrium));
        for units in DECIMAL {
            let scaled = in_units(case, units);
            let after = scaled.solve(&settings);
            let context = || format!("case {index}, {units:?}: {case:?}\n{before:?}\n{after:?}");
            // Several motions may prove that there is no equilibrium, and when a drift of sweeps has
            // lost its elastic part, so that it proves anything, is up to rounding.
            let drifts = method != Method::Lemke
                && [before.status, after.status]
                    .iter()
                    .all(|status| matches!(status, Status::NoEquilibrium | Status::IterationLimit));
            // Where a pair touches without a force, it is open or closed up to rounding. Newton's method
            // alone has nothing to solve a singular system by if it is open and nothing else holds the body.
            let stalls = method == Method::Newton
                && !definite
                && (before.status == Status::Stalled || after.status == Status::Stalled);
            stalled += usize::from(stalls && after.status != before.status);
            assert!(after.status == before.status || drifts || stalls, "{}", context());
            if before.status != Status::Solved || after.status != Status::Solved {
                let proof = after.status == Status::NoEquilibrium;
                assert!(
                    !proof || flaw_of_escape(&scaled, motion(&after)).is_none(),
                    "{}",
                    context()
                );
                continue;
            }
            let d = times(&before.d, units.length);
            assert!(!definite || near(&after.d, &d, largest(&d)), "{}", context());
            let force = times(&before.certificate.force, units.force);
            let scale = largest(&case.f).max(largest(&before.certificate.force));
            assert!(near(&after.certificate.force, &force, scale * units.force), "{}", context());
            assert_eq!(after.certificate.states, before.certificate.states, "{}", context());
        }
        for units in binary() {
            let after = in_units(case, units).solve(&settings);
            let context = || format!("case {index}, {units:?}: {case:?}\n{before:?}\n{after:?}");
            assert_eq!(after.status, before.status, "{}", context());
            assert_eq!(after.iterations, before.iterations, "{}", context());
            assert_eq!(after.certificate.eta, before.certificate.eta, "{}", context());
            assert_eq!(after.certificate.states, before.certificate.states, "{}", context());
            assert_eq!(after.d, times(&before.d, units.length), "{}", context());
            // A motion of escape has no unit: its largest component is 1.
            assert_eq!(after.recession, before.recession, "{}", context());
            let force = times(&before.certificate.force, units.force);
            assert_eq!(after.certificate.force, force, "{}", context());
        }
    }
    // Alone, block pivoting and Newton's method do not decide about bodies that nothing holds.
    let least = if matches!(method, Method::BlockPivoting | Method::Newton) { 45 } else { 60 };
    assert!(decided >= least, "only {decided} of 80 problems compare anything");
    assert!(stalled <= DECIMAL.len(), "{stalled} answers depend on rounding");
}

fn near(a: &[f64], b: &[f64], scale: f64) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-9 * scale)
}

#[test]
fn units_do_not_matter_to_laws_by_pair() {
    check(Method::Auto, |rng, pairs| mixed(rng, (2, pairs), 0.3));
}

#[test]
fn units_do_not_matter_to_ties() {
    check(Method::Auto, |rng, pairs| {
        let mut numbers = mixed(rng, (2, pairs), 0.3).values().to_vec();
        numbers
            .chunks_exact_mut(4)
            .step_by(3)
            .for_each(|own| own.copy_from_slice(&[7.0, 0.0, 0.0, 0.0]));
        Law::ByPair(numbers)
    });
}

#[test]
fn units_do_not_matter_to_nested_sor() {
    check(Method::SorNested, |rng, pairs| coulomb(rng, pairs, 0.3));
}

#[test]
fn units_do_not_matter_to_diagonal_sor() {
    check(Method::SorDiagonal, |rng, pairs| coulomb(rng, pairs, 0.3));
}

#[test]
fn units_do_not_matter_to_given_thresholds() {
    check(Method::SorNested, tresca);
}

#[test]
fn units_do_not_matter_to_lemke() {
    check(Method::Lemke, |_, pairs| frictionless(pairs));
}

#[test]
fn units_do_not_matter_to_lemke_with_law() {
    check(Method::Lemke, |rng, pairs| coulomb(rng, pairs, 0.3));
}

#[test]
fn units_do_not_matter_to_auto() {
    check(Method::Auto, |rng, pairs| coulomb(rng, pairs, 0.3));
    check(Method::Auto, |_, pairs| frictionless(pairs));
    check(Method::Auto, tresca);
}

#[test]
fn units_do_not_matter_to_block_pivoting() {
    check(Method::BlockPivoting, |_, pairs| frictionless(pairs));
}

#[test]
fn units_do_not_matter_to_newton() {
    check(Method::Newton, |rng, pairs| coulomb(rng, pairs, 0.3));
}

/// `w = q + M z` with `w`, `q` forces and `z` lengths.
#[test]
fn units_do_not_matter_to_a_bare_complementarity_problem() {
    for method in [Method::Lemke, Method::Auto, Method::BlockPivoting] {
        check_bare(method);
    }
}

fn check_bare(method: Method) {
    let settings = Settings { method, ..Settings::default() };
    let solve = |m: &[f64], q: &[f64]| -> LcpSolution {
        let lcp = Lcp::new(q.len(), m, q.len(), q, None).unwrap();
        solve_lcp(&lcp, &settings, &mut Monitor::new(&settings, None)).unwrap()
    };
    let mut infeasible = 0;
    for seed in 0..300 {
        let mut rng = Rng::with_seed(seed);
        let n = rng.usize(1..=12);
        let condition = decades(&mut rng, 4.0);
        let m = match seed % 3 {
            0 => definite(&mut rng, n, condition),
            1 => {
                let kernel: Vec<_> = (0..n / 2).map(|_| vector(&mut rng, n)).collect();
                semidefinite(&mut rng, n, condition, &kernel)
            }
            _ => vector(&mut rng, n * n),
        };
        let q = vector(&mut rng, n);
        let before = solve(&m, &q);
        infeasible += usize::from(before.status == Status::NoEquilibrium);
        for units in DECIMAL {
            let after = solve(&times(&m, units.force / units.length), &times(&q, units.force));
            let context = || format!("seed {seed}, {units:?}\n{before:?}\n{after:?}");
            assert_eq!(after.status, before.status, "{}", context());
            // A matrix that is singular to rounding may be so in one unit only, and take another way.
            let as_many = after.iterations == before.iterations || method != Method::Lemke;
            assert!(as_many, "{}", context());
            if before.status == Status::Stalled && method != Method::Lemke {
                continue;
            }
            if let (Some(after), Some(before)) = (&after.infeasible_by, &before.infeasible_by) {
                // It has no unit: its largest entry is 1.
                assert!(near(after, before, 1.0), "{}", context());
                continue;
            }
            let z = times(&before.z, units.length);
            assert!(near(&after.z, &z, largest(&z)), "{}", context());
            if before.status == Status::Solved {
                let w = times(&before.w, units.force);
                assert!(near(&after.w, &w, largest(&q) * units.force), "{}", context());
            }
        }
        for units in binary() {
            let after = solve(&times(&m, units.force / units.length), &times(&q, units.force));
            let context = || format!("seed {seed}, {units:?}\n{before:?}\n{after:?}");
            assert_eq!(after.status, before.status, "{}", context());
            assert_eq!(after.iterations, before.iterations, "{}", context());
            assert_eq!(after.z, times(&before.z, units.length), "{}", context());
            assert_eq!(after.infeasible_by, before.infeasible_by, "{}", context());
            if before.status == Status::Solved {
                assert_eq!(after.w, times(&before.w, units.force), "{}", context());
            }
        }
    }
    assert!(infeasible > 20 || method == Method::BlockPivoting, "only {infeasible} are infeasible");
}

/// The measures of a candidate that violates the law in each way change with the units, and their sizes beside the forces
/// do not: powers of two round nothing.
#[test]
fn measures_have_the_units_of_the_host() {
    let mut k = vec![0.0; 16];
    (0..4).for_each(|i| k[5 * i] = 4.0);
    let (f, gap) = (vec![3.0, 1.0, -2.0, 0.0], vec![0.5, 2.0]);
    let law = Law::Coulomb(vec![0.5; 2]);
    let case = Case { dim: 2, pairs: 2, k, f, gap, law, slip: None };
    // The first pair is 0.25 inside of its obstacle and carries no pressure and a friction of 7; the second one pulls by 6.
    let d = [0.75, 2.0, 1.0, 0.0];
    let one = certify(&case.problem(), &d);
    assert_eq!((one.penetration, one.tension, one.cone_excess), (0.25, 6.0, 7.0));
    assert_eq!(one.equilibrium, 7.0);
    for units in binary() {
        let other = in_units(&case, units);
        let there = certify(&other.problem(), &times(&d, units.length));
        assert_eq!((there.eta, there.residual), (one.eta, one.residual), "{units:?}");
        assert_eq!(there.penetration, 0.25 * units.length, "{units:?}");
        let forces = [there.tension, there.cone_excess, there.equilibrium];
        assert_eq!(forces, [6.0, 7.0, 7.0].map(|force| force * units.force), "{units:?}");
        assert_eq!(there.force, times(&one.force, units.force), "{units:?}");
    }
}

/// A solution whose force is 8 in ordinary units, and 2^1025 in others, which no double holds: nothing is certified there.
#[test]
fn a_force_beyond_doubles_is_no_solution() {
    let (k, f, gap) = (vec![4.0, 0.0, 0.0, 4.0], vec![3.0, 0.0], vec![-1.25]);
    let case = Case { dim: 2, pairs: 1, k, f, gap, law: frictionless(1), slip: None };
    let d = [-1.25, 0.0];
    assert_eq!(certify(&case.problem(), &d).eta, 0.0);
    let units = Units { length: 2_f64.powi(100), force: 2_f64.powi(1022) };
    let there = certify(&in_units(&case, units).problem(), &times(&d, units.length));
    assert!(there.eta >= 1.0 && there.residual >= 1.0, "{there:?}");
}
