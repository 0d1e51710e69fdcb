//! The flexibility form `d = W F + q`: closed forms, a judge in twice the precision, and the stiffness form where
//! there is one.

use crate::common::beam::beam;
use crate::common::dense::{Elimination, difference, dot, largest, product};
use crate::common::flexible::{Case, gram};
use crate::common::problems::{definite, uniform, vector};
use fastrand::Rng;
use signorini::{
    ContactData, ContactProblem, FlexibilityData, FlexibilityProblem, FrictionLaw, Method, Monitor,
    Search, Settings, Solution, State, Status, Uniqueness, solve, solve_flexibility,
};

/// The flexibility of a node on springs of stiffness 2 along each axis against planes with these outward
/// normals, and its free displacements under a load.
fn node_on_planes(normals: &[[f64; 2]], load: [f64; 2], mu: f64) -> Case {
    let rows: Vec<Vec<f64>> =
        normals.iter().flat_map(|[x, y]| [vec![*x, *y], vec![-*y, *x]]).collect();
    let w = gram(&rows).iter().map(|w| w / 2.0).collect();
    let q = rows.iter().map(|row| dot(row, &load) / 2.0).collect();
    Case::new(2, w, q, mu)
}

/// `W`, column-major, of `n` components whose stiffness is eliminated.
fn flexibility(stiffness: &Elimination, n: usize) -> Vec<f64> {
    let unit = |i: usize| (0..n).map(|j| f64::from(u8::from(i == j))).collect::<Vec<f64>>();
    let columns: Vec<Vec<f64>> = (0..n).map(|i| stiffness.solve(&unit(i)).0).collect();
    (0..n * n).map(|at| 0.5 * (columns[at / n][at % n] + columns[at % n][at / n])).collect()
}

/// The solution of a case in stiffness form, with its `K` and its loads.
fn in_stiffness_form(case: &Case, stiffness: &[f64], load: &[f64]) -> Solution {
    let problem = ContactProblem::new(ContactData {
        dim: case.dim,
        pairs: case.gap.len(),
        stiffness,
        ld: load.len(),
        load,
        gap: &case.gap,
        law: FrictionLaw::Coulomb(&case.mu),
        reference_slip: Some(&case.slip0),
    })
    .unwrap();
    let settings = Settings { proof: false, ..Settings::default() };
    solve(&problem, &settings, None, &mut Monitor::new(&settings, None)).unwrap()
}

#[test]
fn definite_flexibility_has_the_solution_of_the_stiffness_form() {
    let rng = &mut Rng::with_seed(1);
    let mut compared = 0;
    for round in 0..60 {
        let dim = rng.usize(2..=3);
        let pairs = rng.usize(1..=6);
        let n = dim * pairs;
        let k = definite(rng, n, 100.0);
        let load = vector(rng, n);
        let inverse = Elimination::new(n, &k);
        let mut case = Case::new(dim, flexibility(&inverse, n), inverse.solve(&load).0, 0.0);
        case.gap.fill_with(|| uniform(rng, -0.3, 0.5));
        let most = [0.1, 0.4][round % 2];
        case.mu.fill_with(|| uniform(rng, 0.0, most));
        case.slip0.fill_with(|| uniform(rng, -0.2, 0.2));
        let other = in_stiffness_form(&case, &k, &load);
        let solution = case.solved();
        // Where friction allows several solutions the forms may find different ones.
        if other.uniqueness == Uniqueness::Unique || case.mu.iter().all(|mu| *mu < 0.1) {
            compared += 1;
            let apart = largest(&difference(&solution.d, &other.d));
            assert!(apart <= 1e-9 * largest(&other.d), "{apart:e}");
            let forces = (&solution.certificate.force, &other.certificate.force);
            let apart = largest(&difference(forces.0, forces.1));
            assert!(apart <= 1e-9 * largest(forces.1).max(largest(&load)), "{apart:e}");
        }
    }
    assert!(compared >= 30, "{compared}");
}

/// Sweeps at the smallest tolerance end at their rounding, by friction of 20. The sentence does not blame pairs that depend
/// on each other: the eigenvalues of `W` are between 1e-2 and 1, so that none does.
#[test]
fn definite_flexibility_is_not_said_to_have_dependent_pairs() {
    let mut stalled = 0;
    for seed in 0..100 {
        let rng = &mut Rng::with_seed(seed);
        let pairs = rng.usize(3..10);
        let mut q = vector(rng, 2 * pairs);
        q.iter_mut().step_by(2).for_each(|press| *press += 2.0);
        let case = Case::new(2, definite(rng, 2 * pairs, 100.0), q, 20.0);
        let problem = FlexibilityProblem::from_flexibility(case.data()).expect("valid data");
        let method = Method::SorNested;
        let settings = Settings { method, tolerance: 1e-15, ..Settings::default() };
        let monitor = &mut Monitor::new(&settings, None);
        let solution = solve_flexibility(&problem, &settings, None, monitor).expect("valid data");
        let message = solution.message.to_string();
        assert!(!message.contains("depend on each other"), "{seed}: {message}");
        if message.contains("settle") {
            let eta = solution.certificate.eta;
            let wanted = format!("no solution was found: forces do not settle (eta is {eta:.1e})");
            assert_eq!(message.split("; remark").next(), Some(&wanted[..]), "{seed}");
            stalled += 1;
        }
    }
    assert!(stalled > 0);
}

/// A rigid block of mass 2 and inertia 3 in the plane on five feet, for a step in which its weight would give
/// it the velocity 0.5 downwards. Its feet carry the impulse 1 together and do not move. The smallest
/// impulses, measured by the flexibility of each foot, are the larger the less flexible the foot is:
/// `F_i = -1 / W_ii / sum 1 / W_jj`.
#[test]
fn a_block_on_redundant_feet_is_carried_by_the_smallest_forces() {
    let (mass, inertia) = (2.0_f64, 3.0_f64);
    let feet = [-2.0, -1.0, 0.0, 1.0, 2.0];
    let rows: Vec<Vec<f64>> = feet
        .iter()
        .flat_map(|x| {
            // Downwards is into the floor. A turn lowers the foot at x, and moves it sideways, 1 below.
            let normal = vec![0.0, -1.0 / mass.sqrt(), -x / inertia.sqrt()];
            [normal, vec![1.0 / mass.sqrt(), 0.0, 1.0 / inertia.sqrt()]]
        })
        .collect();
    for mu in [0.0, 0.5] {
        let free = (0..10).map(|i| if i % 2 == 0 { 0.5 } else { 0.0 }).collect();
        let case = Case::new(2, gram(&rows), free, mu);
        let solution = case.solved();
        assert!(largest(&solution.d) < 1e-12, "{:?}", solution.d);
        let resistance = |i: usize| 1.0 / case.w[2 * i * 11];
        let all: f64 = (0..5).map(resistance).sum();
        for i in 0..5 {
            let force = &solution.certificate.force[2 * i..2 * i + 2];
            // The proximal iteration ends at a relative error of the tolerance over the least flexibility of
            // a pattern that is one, 0.1 here.
            assert!((force[0] + resistance(i) / all).abs() < 1e-9, "foot {i}: {force:?}");
            assert!(force[1].abs() < 1e-9, "foot {i}: {force:?}");
        }
    }
}

/// A body of flexibility 1 on two feet of their own small flexibilities `a` and `b`, pressed down by 1: they share the
/// load as `b` to `a`, however small both are, and not evenly as redundant ones.
#[test]
fn nearly_redundant_feet_share_by_their_own_flexibility() {
    for exponent in 1..=6 {
        for (one, other) in [(1.0, 2.0), (1.0, 0.0), (1.0, 10.0)] {
            let small = 10_f64.powi(-exponent);
            let mut w = vec![0.0; 16];
            (w[0], w[2], w[8], w[10]) = (1.0 + one * small, 1.0, 1.0, 1.0 + other * small);
            (w[5], w[15]) = (1.0, 1.0);
            // As the entries have them: the differences are exact.
            let (a, b) = (w[0] - 1.0, w[10] - 1.0);
            let solution = Case::new(2, w, vec![1.0, 0.0, 1.0, 0.0], 0.0).solved();
            let all = a + b + a * b;
            // Rounding of W F, 1e-16, changes the shares by 1e-16 / 1e-6; the tolerance is 1e-10.
            for (force, exact) in solution.certificate.force.iter().step_by(2).zip([b, a]) {
                let apart = (force + exact / all).abs();
                assert!(apart <= 1e-9, "1e-{exponent}, {one} and {other}: {apart:e}");
            }
        }
    }
}

/// As of the node in [`node_on_planes`] under (1, -1): `N + T = 1`, smallest with `N = 1 / (1 + min(mu, 1))`.
#[test]
fn a_corner_node_presses_on_floor_and_wall() {
    for mu in [0.0, 0.1, 0.5, 1.0, 1.5, 10.0] {
        let case = node_on_planes(&[[0.0, -1.0], [1.0, 0.0]], [1.0, -1.0], mu);
        let solution = case.solved();
        assert!(largest(&solution.d) < 1e-10, "mu {mu}: {:?}", solution.d);
        let normal = 1.0 / (1.0 + f64::min(mu, 1.0));
        for force in solution.certificate.force.chunks(2) {
            assert!((force[0] + normal).abs() < 1e-9, "mu {mu}: {force:?}");
            assert!((force[1].abs() - (1.0 - normal)).abs() < 1e-9, "mu {mu}: {force:?}");
        }
    }
}

/// A call that has no time for the first springs ends where it starts, certified: at the free displacements, for
/// `d = W F + q` and there is no force.
#[test]
fn a_call_without_time_ends_where_it_starts() {
    let case = node_on_planes(&[[0.0, -1.0], [1.0, 0.0]], [1.0, -1.0], 0.3);
    let problem = FlexibilityProblem::from_flexibility(case.data()).expect("valid data");
    let settings = Settings { time_limit: f64::MIN_POSITIVE, ..Settings::default() };
    let monitor = &mut Monitor::new(&settings, None);
    let solution = solve_flexibility(&problem, &settings, None, monitor).expect("valid data");
    assert_eq!(solution.status, Status::TimeLimit, "{}", solution.message);
    assert!(solution.message.contains("time_limit"), "{}", solution.message);
    assert_eq!(solution.d, case.q);
    // The planes press on nobody where the node has entered both.
    assert!(solution.certificate.eta > 0.1, "{:e}", solution.certificate.eta);
}

/// A node in a groove of half angle a whose walls both overlap it by h, as in `dependent_rows.rs`:
/// `2 N (sin a - mu cos a) = k h / sin a`, and with `tan a <= mu` no N does this.
#[test]
fn a_wedge_is_solved_or_said_to_be_one() {
    let (h, k) = (0.1, 2.0);
    let (mut lifted, mut wedged) = (0, 0);
    for degrees in [10.0_f64, 20.0, 45.0, 70.0] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        for mu in [0.0, 0.1, 0.3, 1.1] {
            let mut case = node_on_planes(&[[cos, -sin], [-cos, -sin]], [0.0; 2], mu);
            case.gap.fill(-h);
            let context = format!("{degrees} degrees, mu {mu}");
            if mu < sin / cos {
                let normal = k * h / sin / (2.0 * (sin - mu * cos));
                let force = case.solved().certificate.force;
                for pair in force.chunks(2) {
                    assert!((pair[0] + normal).abs() < 1e-8 * normal, "{context}: {force:?}");
                }
                lifted += 1;
            } else {
                let solution = case.solve();
                assert_eq!(solution.status, Status::Stalled, "{context}");
                let said = solution.message.contains("pairs 0, 1 grow without end and balance");
                assert!(said, "{context}: {}", solution.message);
                wedged += 1;
            }
        }
    }
    assert_eq!((lifted, wedged), (12, 4));
}

/// Forces under a definite `W` never balance each other: whatever the friction, no failure is called a wedge.
#[test]
fn definite_bodies_are_never_called_wedged() {
    let rng = &mut Rng::with_seed(7);
    let mut failed = 0;
    for _ in 0..300 {
        let (dim, pairs) = (rng.usize(2..=3), rng.usize(1..=4));
        let w = definite(rng, dim * pairs, 1e3);
        let q = vector(rng, dim * pairs);
        let mu = uniform(rng, 2.0, 50.0);
        let solution = Case::new(dim, w, q, mu).solve();
        failed += usize::from(solution.status == Status::Stalled);
        assert!(!solution.message.contains("wedge"), "{}", solution.message);
    }
    println!("{failed} of 300 are not solved");
}

/// Three pairs of which each pulls half as much at both others as it gives itself, and by a part `e` of that more:
/// pressed alike they give `-e` each, an eigenvalue below zero. With an interference of 1 at each, one or two of them
/// cannot keep the third out, and all three can by tensions alone: there are no forces. Up to `e` of 1e-5 the first
/// springs make the flexibility definite, and forces run away or do not settle; the message names the eigenvalue then,
/// and as long as it is larger than rounding.
#[test]
fn a_negative_flexibility_is_named_where_no_forces_are_found() {
    for e in [1e-8, 1e-7, 1e-6, 4e-6] {
        for (mu, q) in [(0.0, [1.0, 1.0, 1.0]), (0.3, [1.0, 2.0, 3.0]), (1.0, [1.0, 2.0, 3.0])] {
            let mut w = vec![0.0; 36];
            for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
                w[2 * i + 12 * j] = if i == j { 1.0 } else { -0.5 * (1.0 + e) };
            }
            (0..3).for_each(|i| w[(2 * i + 1) * 7] = 1.0);
            let free = q.iter().flat_map(|q| [*q, 0.5]).collect();
            let solution = Case::new(2, w, free, mu).solve();
            assert_eq!(solution.status, Status::Stalled, "{e:e}: {}", solution.message);
            let named = solution.message.contains("W is not positive semi-definite");
            assert!(named, "{e:e}, mu {mu}: {}", solution.message);
        }
    }
}

/// Walls closer than the body, whatever the friction: no displacement keeps both gaps. The proof is two
/// pressing forces that move nothing and meet gaps of negative sum.
#[test]
fn gaps_that_contradict_each_other_are_proved_to() {
    for (mu, push) in [(0.0, 0.0), (0.3, 0.7), (2.0, -3.0)] {
        let mut case = node_on_planes(&[[1.0, 0.0], [-1.0, 0.0]], [push, 0.4], mu);
        case.gap = vec![0.1, -0.2];
        let solution = case.solve();
        assert_eq!(solution.status, Status::NoEquilibrium, "{}", solution.message);
        assert!(solution.message.contains("contradict each other"), "{}", solution.message);
        let proof = solution.recession.expect("a proof");
        let (n, largest_flexibility) = (case.q.len(), largest(&case.w));
        assert!(proof.iter().all(|p| *p <= 0.0) && (largest(&proof) - 1.0).abs() < 1e-12);
        // The library takes 1e-12 of the terms of W for its rounding.
        assert!(largest(&product(&case.w, &proof)) <= 1e-11 * largest_flexibility);
        let work: f64 = (0..n / 2).map(|i| -proof[2 * i] * (case.gap[i] - case.q[2 * i])).sum();
        assert!(work < -0.05, "{work}");
    }
}

/// `W = B Bᵀ` of low rank with free displacements `B z`: all pairs open a little at the motion -z, whose
/// sticking velocity is zero, so that a solution exists whatever the friction (Acary, Cadoux, Lemaréchal
/// and Malick, ZAMM 91 (2011) 155-175).
#[test]
fn random_flexibilities_of_low_rank_are_solved() {
    let rng = &mut Rng::with_seed(2);
    let mut redundant = 0;
    for round in 0..80 {
        let dim = rng.usize(2..=3);
        let pairs = rng.usize(2..=12);
        let n = dim * pairs;
        let rank = rng.usize(1..=n.min(6));
        let rows: Vec<Vec<f64>> = (0..n).map(|_| vector(rng, rank)).collect();
        let z = vector(rng, rank);
        let q = rows.iter().map(|row| dot(row, &z)).collect();
        let mut case = Case::new(dim, gram(&rows), q, 0.0);
        case.gap.fill_with(|| uniform(rng, 0.01, 0.1));
        case.mu.fill_with(|| [0.0, 0.3, 1.0][round % 3]);
        let solution = case.solved();
        redundant += usize::from(solution.certificate.count(State::Open) * dim + rank < n);
    }
    assert!(redundant > 40, "{redundant}");
}

/// The last pair is at a wall that nothing moves, 0.2 beyond its gap: a unit of force on it moves nothing and proves that
/// no displacement keeps the gap, whatever the other pairs do. Nearer than its gap it is open.
#[test]
fn a_wall_beyond_its_gap_is_proved_to_be() {
    let rng = &mut Rng::with_seed(5);
    for round in 0..60 {
        let (pairs, mu) = (rng.usize(1..=4), [0.0, 0.3][round % 2]);
        let (own, n) = (2 * pairs, 2 * pairs + 2);
        let free = definite(rng, own, 10.0);
        let mut w = vec![0.0; n * n];
        for i in 0..own * own {
            w[i % own + n * (i / own)] = free[i];
        }
        w[n * n - 1] = f64::from(u8::from(round % 3 == 0));
        let mut case = Case::new(2, w, vector(rng, n), mu);
        case.q[own] = 0.3;
        case.gap[pairs] = 0.1;
        let solution = case.solve();
        assert_eq!(solution.status, Status::NoEquilibrium, "{round}: {}", solution.message);
        let named = format!("no solution exists: the gaps of pairs {pairs} contradict each other");
        assert!(solution.message.starts_with(&named), "{round}: {}", solution.message);
        let mut proof = vec![0.0; n];
        proof[own] = -1.0;
        assert_eq!(solution.recession, Some(proof), "{round}");
        case.gap[pairs] = 0.4;
        let solution = case.solve();
        assert_eq!(solution.status, Status::Solved, "{round}: {}", solution.message);
    }
}

/// A tied pair that nothing moves is where it may not be, beside a pair whose normal and tangent move as one: its forces tend to
/// their end while those of the tie grow without one, and these alone are the proof.
#[test]
fn a_tie_that_nothing_moves_is_proved_to_be_elsewhere() {
    let mut w = vec![0.0; 16];
    [0, 1, 4, 5].into_iter().for_each(|at| w[at] = 1.0);
    for tied in [[-1.0, -2.0], [0.5, 0.0], [0.0, 1.0]] {
        let case = Case::new(2, w.clone(), [[3.0, 2.0], tied].concat(), 0.0);
        let law = FrictionLaw::ByPair(&[0.0, 0.0, 0.0, 0.0, 7.0, 0.0, 0.0, 0.0]);
        let problem = FlexibilityProblem::from_flexibility(FlexibilityData { law, ..case.data() });
        let settings = Settings::default();
        let monitor = &mut Monitor::new(&settings, None);
        let solution = solve_flexibility(&problem.unwrap(), &settings, None, monitor).unwrap();
        let context = format!("{tied:?}: {}", solution.message);
        assert_eq!(solution.status, Status::NoEquilibrium, "{context}");
        let proof = solution.recession.expect("a proof");
        assert_eq!(proof[..2], [0.0, 0.0], "{context}");
        assert!(proof[2] * tied[0] + proof[3] * tied[1] != 0.0, "{context}: {proof:?}");
    }
}

/// Each pair twice: displacements and the sum of the forces are those of the single problem, and the copies
/// share evenly, as the smallest forces do.
#[test]
fn copies_of_pairs_share_their_force() {
    let rng = &mut Rng::with_seed(3);
    for _ in 0..30 {
        let dim = rng.usize(2..=3);
        let pairs = rng.usize(1..=4);
        let n = dim * pairs;
        let rows: Vec<Vec<f64>> = (0..n)
            .map(|i| {
                let own = (0..n).map(|j| f64::from(u8::from(i == j)));
                own.zip(vector(rng, n)).map(|(own, other)| own + 0.2 * other).collect()
            })
            .collect();
        let mut single = Case::new(dim, gram(&rows), vector(rng, n), 0.3);
        single.gap.fill_with(|| uniform(rng, -0.2, 0.2));
        let twice = |values: &[f64]| [values, values].concat();
        let mut double = Case::new(dim, gram(&[&rows[..], &rows].concat()), twice(&single.q), 0.3);
        double.gap = twice(&single.gap);
        let (one, two) = (single.solved(), double.solved());
        let apart = largest(&difference(&two.d, &twice(&one.d)));
        assert!(apart <= 1e-9 * largest(&single.q), "{apart:e}");
        let half: Vec<f64> = one.certificate.force.iter().map(|force| force / 2.0).collect();
        let apart = largest(&difference(&two.certificate.force, &twice(&half)));
        assert!(apart <= 1e-8 * largest(&half).max(0.1), "{apart:e}");
    }
}

/// Units of force by 1000, of length by 0.001: so are the forces and displacements. No step depends on units
/// but by rounding.
#[test]
fn units_change_the_units_of_the_answer_alone() {
    let case = node_on_planes(&[[0.0, -1.0], [1.0, 0.0], [0.6, -0.8]], [1.0, -0.7], 0.4);
    let one = case.solved();
    let scaled = |values: &[f64], by: f64| values.iter().map(|value| by * value).collect();
    let other = Case::new(2, scaled(&case.w, 1e-6), scaled(&case.q, 1e-3), 0.4).solved();
    let forces: Vec<f64> = scaled(&one.certificate.force, 1e3);
    assert!(largest(&difference(&other.certificate.force, &forces)) <= 1e-9 * largest(&forces));
}

#[test]
fn a_start_of_forces_is_taken() {
    let case = node_on_planes(&[[0.0, -1.0], [1.0, 0.0]], [1.0, -1.0], 0.5);
    let first = case.solved();
    let problem = FlexibilityProblem::from_flexibility(case.data()).unwrap();
    let settings = Settings::default();
    let monitor = &mut Monitor::new(&settings, None);
    let start = &first.certificate.force;
    let again = solve_flexibility(&problem, &settings, Some(start), monitor).unwrap();
    assert_eq!(again.status, Status::Solved);
    assert!(again.iterations <= first.iterations);
    let monitor = &mut Monitor::new(&settings, None);
    let wrong = solve_flexibility(&problem, &settings, Some(&[0.0, f64::NAN, 0.0, 0.0]), monitor);
    assert_eq!(wrong.unwrap_err().message().to_string(), "the start F[1] is not finite");
}

#[test]
fn what_no_flexibility_has_is_refused() {
    let case = node_on_planes(&[[0.0, -1.0], [1.0, 0.0]], [1.0, -1.0], 0.5);
    let refused = |change: &dyn Fn(&mut Case)| {
        let mut case = Case {
            w: case.w.clone(),
            q: case.q.clone(),
            ..Case::new(2, vec![], vec![0.0; 4], 0.5)
        };
        change(&mut case);
        let problem = match FlexibilityProblem::from_flexibility(case.data()) {
            Err(error) => return error.message().to_string(),
            Ok(problem) => problem,
        };
        let settings = Settings::default();
        let monitor = &mut Monitor::new(&settings, None);
        solve_flexibility(&problem, &settings, None, monitor).unwrap_err().message().to_string()
    };
    type Wrong<'a> = (&'a dyn Fn(&mut Case), &'a str);
    const NEARLY: f64 = -0.25 * (1.0 + 1e-6);
    let wrong: [Wrong<'_>; 7] = [
        (&|case| case.w[1] = 0.3, "W is not symmetric: W[1,0] is 0.3"),
        (&|case| case.w[5] = -0.5, "W[1,1] is -0.5, it must be positive"),
        (&|case| case.w[3] = f64::NAN, "W[3,0] is not finite"),
        (&|case| case.q[2] = f64::INFINITY, "q[2] is not finite"),
        (&|case| case.w.fill(0.0), "W is zero: no contact force moves anything"),
        // Each block of two is allowed, all three together are not: eigenvalues 1.4, 1.4 and -0.8 halves.
        (
            &|case| {
                for (i, j) in [(0, 1), (1, 2), (0, 2)] {
                    (case.w[i + 4 * j], case.w[j + 4 * i]) = (-0.45, -0.45);
                }
            },
            "W is not positive semi-definite",
        ),
        // Now with eigenvalues 1.5, 1.5 and -1e-6 halves: far above what rounding leaves.
        (
            &|case| {
                for (i, j) in [(0, 1), (1, 2), (0, 2)] {
                    (case.w[i + 4 * j], case.w[j + 4 * i]) = (NEARLY, NEARLY);
                }
            },
            "W is not positive semi-definite",
        ),
    ];
    for (change, said) in wrong {
        let message = refused(change);
        assert!(message.contains(said), "{message}");
    }
}

/// Beams on a floor: `eta` feels their forces by a flexibility that is 1e-8 of that of the whole, and they are those of the stiffness
/// form all the same, up to the rounding of `W` times its condition number.
#[test]
fn forces_of_beams_are_those_of_the_stiffness_form() {
    let pairs = 100;
    let (k, n) = (beam(pairs, 0.1), 2 * pairs);
    let inverse = Elimination::new(n, &k);
    let w = flexibility(&inverse, n);
    for seed in 0..4 {
        let rng = &mut Rng::with_seed(seed);
        // Pressed upon the floor in the mean.
        let mut load = vector(rng, n);
        load.iter_mut().step_by(2).for_each(|load| *load += 0.3);
        let mut case = Case::new(2, w.clone(), inverse.solve(&load).0, 0.3);
        case.gap.fill(0.0);
        let other = in_stiffness_form(&case, &k, &load).certificate.force;
        let force = case.solved().certificate.force;
        let error = largest(&difference(&force, &other)) / largest(&other);
        assert!(error < 1e-6, "seed {seed}: {error:e}");
    }
}

/// A question that the form cannot answer is refused, as in full space.
#[test]
fn a_search_for_other_solutions_is_refused() {
    let case = node_on_planes(&[[0.0, -1.0]], [0.0, -1.0], 0.3);
    case.solved();
    let problem = FlexibilityProblem::from_flexibility(case.data()).unwrap();
    let settings = Settings { search: Search::Others, ..Settings::default() };
    let monitor = &mut Monitor::new(&settings, None);
    let error = solve_flexibility(&problem, &settings, None, monitor).unwrap_err();
    assert!(error.to_string().contains("search for other solutions"), "{error}");
}

/// Tension alone pulls pairs whose gaps never close, and cohesion holds their tangents: `d_t = 0`, `K_nn d_n = a`, `F_n = a`. The loads
/// are zero, so that forces of rounding are larger than these; both forms solve it.
#[test]
fn tension_alone_is_a_load() {
    let rng = &mut Rng::with_seed(7);
    for gap in [1e4, f64::INFINITY].repeat(10) {
        let k = definite(rng, 6, 100.0);
        let tension: Vec<f64> = (0..3).map(|_| uniform(rng, 0.1, 1.0)).collect();
        let law: Vec<f64> = tension.iter().flat_map(|a| [0.3, 1e4, *a]).collect();
        let normals: Vec<f64> = (0..9).map(|at| k[6 * (at / 3 * 2) + at % 3 * 2]).collect();
        let opening = Elimination::new(3, &normals).solve(&tension).0;
        let exact: Vec<f64> = opening.iter().flat_map(|d| [*d, 0.0]).collect();
        let (w, gaps, zero) = (flexibility(&Elimination::new(6, &k), 6), [gap; 3], [0.0; 6]);
        let law = FrictionLaw::Cohesive(&law);
        let settings = Settings::default();
        let stiff = ContactProblem::new(ContactData {
            dim: 2,
            pairs: 3,
            stiffness: &k,
            ld: 6,
            load: &zero,
            gap: &gaps,
            law,
            reference_slip: None,
        });
        let flexible = FlexibilityProblem::from_flexibility(FlexibilityData {
            dim: 2,
            pairs: 3,
            flexibility: (&w, 6),
            free: &zero,
            gap: &gaps,
            law,
            reference_slip: None,
        });
        let monitor = &mut Monitor::new(&settings, None);
        let stiff = solve(&stiff.unwrap(), &settings, None, monitor).unwrap();
        let flexible = solve_flexibility(&flexible.unwrap(), &settings, None, monitor).unwrap();
        for solution in [stiff, flexible] {
            assert_eq!(solution.status, Status::Solved, "{gap}: {}", solution.message);
            let apart = largest(&difference(&solution.d, &exact));
            // The tolerance of 1e-10 by the condition number of 100.
            assert!(apart <= 1e-8 * largest(&exact), "{gap}: {apart:e}");
        }
    }
}
