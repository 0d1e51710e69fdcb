//! The default method solves every problem of a positive definite stiffness: in 2D there always is a
//! solution, and the linear path finds it where Newton's method fails; without friction, or with given
//! thresholds, in any dimension.

use crate::common::measures::{eta, rounding};
use crate::common::problems::{
    Case, Law, coulomb, decades, definite, frictionless, loaded, tresca, uniform, vector,
};
use fastrand::Rng;
use signorini::{Fallback, Method, Monitor, Settings, Solution, Status};

const TOLERANCE: f64 = 1e-10;

/// How large, and of a condition up to which power of ten.
struct Family {
    pairs: std::ops::RangeInclusive<usize>,
    condition: f64,
    dim: usize,
}

fn make(rng: &mut Rng, family: &Family, law: impl Fn(&mut Rng, usize) -> Law) -> Case {
    let pairs = rng.usize(family.pairs.clone());
    let condition = decades(rng, family.condition);
    let k = definite(rng, family.dim * pairs, condition);
    let law = law(rng, pairs);
    loaded(rng, family.dim, k, law)
}

fn solve(case: &Case, start: Option<&[f64]>) -> Solution {
    let settings = Settings { tolerance: TOLERANCE, ..Settings::default() };
    assert_eq!(settings.method, Method::Auto, "the default");
    let mut monitor = Monitor::new(&settings, None);
    signorini::solve(&case.problem(), &settings, start, &mut monitor).unwrap()
}

/// Solves all of these, half of them from a random start, and measures the answers; returns how many
/// the first method left to another, by reason.
fn solves_all(
    seeds: std::ops::Range<u64>,
    family: Family,
    law: impl Fn(&mut Rng, usize) -> Law,
) -> String {
    let mut fallbacks = [0; 4];
    let count = seeds.end - seeds.start;
    for seed in seeds {
        let mut rng = Rng::with_seed(seed);
        let case = make(&mut rng, &family, &law);
        let start = rng.bool().then(|| vector(&mut rng, case.size()));
        let solution = solve(&case, start.as_deref());
        let context = || format!("seed {seed}, {} pairs: {}", case.pairs, solution.message);
        assert_eq!(solution.status, Status::Solved, "{}", context());
        let residual = eta(&case, &solution.d);
        let allowed = TOLERANCE + rounding(&case, &solution.d);
        assert!(residual <= allowed, "{residual:e}, {}", context());
        assert_ne!(solution.method, Method::Auto, "the method that ended it: {}", context());
        if let Some((first, reason)) = solution.fallback {
            assert!(first != solution.method || reason == Fallback::Unstable, "{}", context());
            fallbacks[match reason {
                Fallback::Cycle => 0,
                Fallback::Singular => 1,
                Fallback::Unstable => 2,
                Fallback::Inaccurate => 3,
            }] += 1;
        }
    }
    format!("of {count}, cycle, singular, unstable, inaccurate: {fallbacks:?}")
}

const fn plane(pairs: std::ops::RangeInclusive<usize>) -> Family {
    Family { pairs, condition: 6.0, dim: 2 }
}

/// A coefficient of its own for each pair.
fn up_to(most: f64) -> impl Fn(&mut Rng, usize) -> Law {
    move |rng, pairs| coulomb(rng, pairs, most)
}

/// Every positive definite `K` and every `mu`, in 2D: the path from a start whose closed pairs stick
/// without friction cannot come back. Small problems, many states.
#[test]
fn friction_up_to_5_on_small_problems() {
    println!("{}", solves_all(0..1600, plane(1..=8), up_to(5.0)));
}

#[test]
fn friction_up_to_5_on_middling_problems() {
    println!("{}", solves_all(1600..2100, plane(9..=30), up_to(5.0)));
}

#[test]
fn friction_up_to_5_on_larger_problems() {
    println!("{}", solves_all(2100..2300, plane(40..=60), up_to(5.0)));
}

/// One coefficient on all pairs lets many of them slip together.
#[test]
fn the_same_high_friction_on_all_pairs() {
    let law = |rng: &mut Rng, pairs| Law::Coulomb(vec![uniform(rng, 1.0, 5.0); pairs]);
    println!("{}", solves_all(0..400, plane(2..=20), law));
}

/// Friction of any size, as far as rounding lets: `mu` carries errors of the pressures, which are
/// 1e-16 of the condition, into the friction; `mu` times the condition is up to 1e7 here, so that
/// 1e-9 of the forces may be lost at the worst, and hardly ever is.
#[test]
fn friction_of_any_size() {
    for seed in 0..1500 {
        let mut rng = Rng::with_seed(seed);
        let pairs = rng.usize(1..=8);
        let power = uniform(&mut rng, 0.0, 6.0);
        let condition = decades(&mut rng, 7.0 - power);
        let k = definite(&mut rng, 2 * pairs, condition.min(1e5));
        let most = 10_f64.powf(power);
        let law = Law::Coulomb((0..pairs).map(|_| uniform(&mut rng, 0.1, 1.0) * most).collect());
        let case = loaded(&mut rng, 2, k, law);
        let solution = solve(&case, None);
        let context = || format!("seed {seed}, mu {most:e}: {}", solution.message);
        assert_eq!(solution.status, Status::Solved, "{}", context());
        let allowed = TOLERANCE + (1.0 + most) * rounding(&case, &solution.d);
        assert!(eta(&case, &solution.d) <= allowed, "{}", context());
    }
}

/// No friction: a strictly convex problem.
#[test]
fn frictionless_problems_in_the_plane_and_in_space() {
    let none = |_: &mut Rng, pairs| frictionless(pairs);
    println!("{}", solves_all(0..600, plane(1..=30), none));
    println!("{}", solves_all(600..650, plane(40..=60), none));
    let space = Family { pairs: 1..=20, condition: 6.0, dim: 3 };
    println!("{}", solves_all(0..400, space, none));
}

/// Given thresholds: strictly convex as well.
#[test]
fn given_thresholds_in_the_plane() {
    println!("{}", solves_all(0..600, plane(1..=12), tresca));
    println!("{}", solves_all(600..660, plane(20..=40), tresca));
}

/// In space there is no theorem behind a method but for little friction, here up to 0.3 on
/// stiffness of condition up to 30; a condition of 1e3 slows down sweeps with given thresholds.
#[test]
fn moderate_friction_and_given_thresholds_in_space() {
    let mild = || Family { pairs: 1..=10, condition: 1.5, dim: 3 };
    println!("{}", solves_all(0..600, mild(), up_to(0.3)));
    let space = Family { pairs: 1..=10, condition: 3.0, dim: 3 };
    println!("{}", solves_all(0..300, space, tresca));
}

/// Where all of it is rigid and wedged: interference everywhere, and a slip before.
#[test]
fn interference_everywhere_after_a_slip() {
    for seed in 0..400 {
        let mut rng = Rng::with_seed(seed);
        let mut case = make(&mut rng, &plane(1..=12), up_to(5.0));
        case.gap.iter_mut().for_each(|gap| *gap = -rng.f64());
        case.slip = Some(vector(&mut rng, case.pairs));
        if seed % 2 == 0 {
            case.f.fill(0.0);
        }
        let solution = solve(&case, None);
        assert_eq!(solution.status, Status::Solved, "seed {seed}: {}", solution.message);
        let residual = eta(&case, &solution.d);
        assert!(residual <= TOLERANCE + rounding(&case, &solution.d), "seed {seed}: {residual:e}");
    }
}

/// Newton's method solves most of these from nothing: then it ends the call from any start, however far away that is, but
/// for a solution of negative orientation, beside which others are looked for.
#[test]
fn no_start_keeps_newtons_method_from_what_it_solves_from_nothing() {
    let mut from_nothing = 0;
    for seed in 0..600 {
        let mut rng = Rng::with_seed(seed);
        let case = make(&mut rng, &plane(1..=30), up_to(2.0));
        if solve(&case, None).method != Method::Newton {
            continue;
        }
        from_nothing += 1;
        let start: Vec<f64> = vector(&mut rng, case.size()).iter().map(|d| 1e3 * d).collect();
        let solution = solve(&case, Some(&start));
        let is_unstable = solution.fallback == Some((Method::Newton, Fallback::Unstable));
        let by_newton = solution.method == Method::Newton || is_unstable;
        assert!(by_newton, "seed {seed}: {}", solution.message);
    }
    assert!(from_nothing > 400, "{from_nothing}");
}
