//! A block that nothing but a plane supports: statics decides whether it is in equilibrium.

use crate::common::dense::{dot, largest};
use crate::common::measures::{eta, flaw_of_escape, force, motion};
use crate::common::problems::{Case, Law, block, uniform};
use fastrand::Rng;
use signorini::{Method, Settings, Solution, State, Status};

/// Loads on a frictionless block, whole numbers. It stands on points 0, 1, … of a line: pressures
/// that balance the loads exist if and only if the tangential loads cancel, and the resultant
/// presses within the base (its edges included): `0 <= moment <= (pairs - 1) resultant`.
#[test]
fn frictionless_block_stands_if_the_resultant_presses_within_its_base() {
    let mut standing = 0;
    for seed in 0..4000 {
        let mut rng = Rng::with_seed(seed);
        let pairs = rng.usize(3..=8);
        let mut f: Vec<f64> = (0..2 * pairs).map(|_| f64::from(rng.i32(-2..=2))).collect();
        for i in 0..pairs {
            f[2 * i] = (f[2 * i] + f64::from(rng.u8(0..=1))).min(2.0);
        }
        let slide: f64 = f.iter().skip(1).step_by(2).sum();
        if rng.u8(0..8) > 0 {
            f[1] -= slide;
        }
        let slide: f64 = f.iter().skip(1).step_by(2).sum();
        let press: f64 = f.iter().step_by(2).sum();
        let moment: f64 = f.iter().step_by(2).enumerate().map(|(x, f)| x as f64 * f).sum();
        let stands = slide == 0.0 && 0.0 <= moment && moment <= (pairs - 1) as f64 * press;
        let gap = if rng.bool() { 0.0 } else { 0.5 };
        let case = Case {
            dim: 2,
            pairs,
            k: block(&mut rng, pairs),
            f,
            gap: vec![gap; pairs],
            law: Law::Coulomb(vec![0.0; pairs]),
            slip: None,
        };
        let solution = case.solve_by(Method::Lemke);
        let context = || format!("seed {seed}: stands {stands}\n{case:?}\n{solution:?}");
        if stands {
            assert_eq!(solution.status, Status::Solved, "{}", context());
            balances(&case, &solution, &context);
            standing += 1;
        } else {
            assert_eq!(solution.status, Status::NoEquilibrium, "{}", context());
            assert_eq!(flaw_of_escape(&case, motion(&solution)), None, "{}", context());
            assert_eq!(largest(motion(&solution)), 1.0, "{}", context());
        }
    }
    assert!((1000..3000).contains(&standing), "the loads are one-sided: {standing} of 4000 stand");
}

/// The law and the balance of all rigid motions, to 1e-8 of the loads: 100 times the tolerance, as
/// the block's springs have condition numbers up to 1e3, and a sum of up to 24 forces.
fn balances(case: &Case, solution: &Solution, context: &dyn Fn() -> String) {
    assert!(eta(case, &solution.d) <= 1.1e-10, "{}", context());
    let force = force(case, &solution.d);
    let motions: [fn(usize) -> f64; 3] = [
        |i| f64::from(u8::from(i % 2 == 0)),
        |i| f64::from(u8::from(i % 2 == 1)),
        |i| if i % 2 == 0 { (i / 2) as f64 } else { 0.0 },
    ];
    for motion in motions {
        let motion: Vec<f64> = (0..case.size()).map(motion).collect();
        let balance = dot(&force, &motion) + dot(&case.f, &motion);
        let parts: f64 = motion.iter().zip(&case.f).map(|(r, f)| (r * f).abs()).sum();
        assert!(balance.abs() <= 1e-8 * parts.max(largest(&case.f)), "{}", context());
        let returned = dot(&solution.certificate.force, &motion) + dot(&case.f, &motion);
        assert!(returned.abs() <= 1e-8 * parts.max(largest(&case.f)), "{}", context());
    }
}

/// A block pressed on a plane by `N` with friction `mu` and pushed by `T`: at rest for `T < mu N`;
/// for `T > mu N` it slides away, and no equilibrium exists. Coulomb.
///
/// The nested form brings it to rest always, the diagonal one, for which there is no theory, for
/// `mu <= 0.2` and in 98 % beyond.
#[test]
fn block_on_a_plane_rests_below_the_friction_angle_and_slides_above() {
    let (mut rests, mut unsolved) = (0, 0);
    for seed in 0..400 {
        let mut rng = Rng::with_seed(seed);
        let pairs = rng.usize(3..=6);
        let mu = uniform(&mut rng, 0.05, 0.5);
        let press: Vec<f64> = (0..pairs).map(|_| uniform(&mut rng, 0.9, 1.1)).collect();
        let share: Vec<f64> = (0..pairs).map(|_| rng.f64()).collect();
        let total = mu * press.iter().sum::<f64>() / share.iter().sum::<f64>();
        let side = if rng.bool() { 1.0 } else { -1.0 };
        let k = block(&mut rng, pairs);
        for ratio in [0.5, 0.9, 1.1, 3.0] {
            let push = |i: usize| side * ratio * total * share[i];
            let case = Case {
                dim: 2,
                pairs,
                k: k.clone(),
                f: (0..pairs).flat_map(|i| [press[i], push(i)]).collect(),
                gap: vec![0.0; pairs],
                law: Law::Coulomb(vec![mu; pairs]),
                slip: None,
            };
            for method in [Method::SorNested, Method::SorDiagonal] {
                let max_iterations = if ratio < 1.0 { 200_000 } else { 10_000 };
                let solution =
                    case.solve(&Settings { method, max_iterations, ..Settings::default() });
                let context = || format!("seed {seed}, {method:?}, T = {ratio} mu N\n{solution:?}");
                if ratio < 1.0 {
                    rests += 1;
                    if method == Method::SorDiagonal
                        && mu > 0.2
                        && solution.status != Status::Solved
                    {
                        assert_eq!(solution.status, Status::IterationLimit, "{}", context());
                        unsolved += 1;
                        continue;
                    }
                    assert_eq!(solution.status, Status::Solved, "{}", context());
                    balances(&case, &solution, &context);
                    assert!(solution.certificate.count(State::Stick) > 0, "{}", context());
                } else {
                    assert_eq!(solution.status, Status::NoEquilibrium, "{}", context());
                    assert_eq!(flaw_of_escape(&case, motion(&solution)), None, "{}", context());
                }
            }
        }
    }
    assert!(unsolved <= rests / 50, "{unsolved} of {rests} blocks at rest not solved");
}

/// `K = 1 - Q Qᵀ` of two motions without a step towards an obstacle, which nothing but contact holds; `None` if a component
/// is left without stiffness.
fn of_two_motions(rng: &mut Rng, pairs: usize) -> Option<Vec<f64>> {
    let n = 2 * pairs;
    let drawn = |rng: &mut Rng, i: usize| {
        f64::from(if i.is_multiple_of(2) { -rng.i32(0..=3) } else { rng.i32(-3..=3) })
    };
    let [first, second] = [(); 2].map(|()| (0..n).map(|i| drawn(rng, i)).collect::<Vec<f64>>());
    let unit = |v: Vec<f64>| {
        let length = dot(&v, &v).sqrt();
        v.iter().map(|x| x / length).collect::<Vec<f64>>()
    };
    let first = unit(first);
    let along = dot(&first, &second);
    let second = unit(second.iter().zip(&first).map(|(x, u)| x - along * u).collect());
    let entry = |i: usize, j: usize| {
        f64::from(u8::from(i == j)) - first[i] * first[j] - second[i] * second[j]
    };
    let is_stiff = (0..n).all(|i| entry(i, i) >= 0.05);
    is_stiff.then(|| (0..n * n).map(|k| entry(k % n, k / n)).collect())
}

/// A motion that proves that no equilibrium exists under Coulomb's law proves it with cohesion `b` and tension `a` too, if the
/// loads do more work on it than these can take, `sum b |r_t| + a |r_n|`.
#[test]
fn loads_that_outwork_cohesion_leave_no_equilibrium() {
    let (mu, b, a, mut proved) = (0.3, 0.5, 0.25, 0);
    for seed in 0..600 {
        let rng = &mut Rng::with_seed(seed);
        let pairs = rng.usize(2..=3);
        let Some(k) = of_two_motions(rng, pairs) else { continue };
        let f: Vec<f64> = (0..2 * pairs).map(|_| f64::from(rng.i32(-9..=9))).collect();
        let (gap, law) = (vec![0.0; pairs], Law::Coulomb(vec![mu; pairs]));
        let case = Case { dim: 2, pairs, k, f, gap, law, slip: None };
        let found = case.solve(&Settings::default());
        if found.status != Status::NoEquilibrium {
            continue;
        }
        let r = motion(&found);
        let taken: f64 = r.chunks(2).map(|r| a * r[0].abs() + b * r[1].abs()).sum();
        if dot(&case.f, r) > 1.01 * taken {
            let case = Case { law: Law::Cohesive([mu, b, a].repeat(pairs)), ..case };
            let found = case.solve(&Settings::default());
            assert_eq!(found.status, Status::NoEquilibrium, "seed {seed}: {}", found.message);
            assert_eq!(flaw_of_escape(&case, motion(&found)), None, "seed {seed}");
            proved += 1;
        }
    }
    assert!(proved > 100, "{proved}");
}
