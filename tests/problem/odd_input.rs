//! Degenerate but valid input has its plain answer: empty problems, all pairs open, all sticking, no
//! load, decoupled rows, over-long arrays.

use crate::common::dense::{Elimination, largest, product};
use crate::common::measures::eta;
use crate::common::problems::{Case, Law, coulomb, definite, frictionless, loaded, uniform};
use fastrand::Rng;
use signorini::{
    ContactData, ContactProblem, FrictionLaw, Lcp, Method, Monitor, Settings, Solution, State,
    Status, solve, solve_lcp,
};

/// Solves by every method that fits, and checks the law.
fn solved(case: &Case) -> Vec<Solution> {
    let mut methods = vec![Method::SorNested];
    if let Law::Coulomb(mu) = &case.law {
        methods.push(Method::SorDiagonal);
        if largest(mu) == 0.0 {
            methods.push(Method::Lemke);
        }
    }
    let check = |method| {
        let solution = case.solve_by(method);
        assert_eq!(solution.status, Status::Solved, "{method:?} {case:?}\n{solution:?}");
        // The default tolerance, and a little for computing it once more.
        assert!(eta(case, &solution.d) <= 1.1e-10, "{method:?} {case:?}\n{solution:?}");
        solution
    };
    methods.into_iter().map(check).collect()
}

#[test]
fn solves_problems_without_pairs() {
    for dim in [2, 3] {
        let case = Case {
            dim,
            pairs: 0,
            k: vec![],
            f: vec![],
            gap: vec![],
            law: Law::Coulomb(vec![]),
            slip: None,
        };
        for solution in solved(&case) {
            assert!(solution.d.is_empty() && solution.certificate.force.is_empty());
            assert_eq!(solution.certificate.eta, 0.0);
        }
    }
    let lcp = Lcp::new(0, &[], 1, &[], None).unwrap();
    let settings = Settings::default();
    let solution = solve_lcp(&lcp, &settings, &mut Monitor::new(&settings, None)).unwrap();
    assert_eq!((solution.status, solution.iterations), (Status::Solved, 0));
}

/// Well-conditioned problems of every kind (condition 10): answers are accurate to 1e-8.
fn random_case(rng: &mut Rng, friction: f64) -> Case {
    let (dim, pairs) = (rng.usize(2..=3), rng.usize(1..=6));
    let k = definite(rng, dim * pairs, 10.0);
    let law = if friction == 0.0 { frictionless(pairs) } else { coulomb(rng, pairs, friction) };
    loaded(rng, dim, k, law)
}

#[test]
fn without_obstacles_the_answer_is_that_of_linear_equations() {
    for seed in 0..100 {
        let mut rng = Rng::with_seed(seed);
        let mut case = random_case(&mut rng, [0.0, 0.5][seed as usize % 2]);
        case.gap.fill(f64::INFINITY);
        let (d, _) = Elimination::new(case.size(), &case.k).solve(&case.f);
        for solution in solved(&case) {
            let near = solution.d.iter().zip(&d).all(|(a, b)| (a - b).abs() <= 1e-8 * largest(&d));
            assert!(near, "seed {seed}: {case:?}\n{solution:?}");
            assert!(solution.certificate.states.iter().all(|&state| state == State::Open));
            assert!(solution.certificate.force.iter().all(|&force| force == 0.0));
        }
    }
}

#[test]
fn all_stuck_all_closed_and_unloaded_problems_have_their_plain_answers() {
    for seed in 0..100 {
        let mut rng = Rng::with_seed(seed);
        let mut case = random_case(&mut rng, 0.5);
        let dim = case.dim;
        // Rest, and forces far inside the cone: everything sticks there, gaps negative or not.
        case.gap.iter_mut().for_each(|gap| *gap = uniform(&mut rng, -1.0, 1.0));
        case.law = Law::Coulomb(vec![0.5; case.pairs]);
        let rest: Vec<f64> = (0..case.size())
            .map(|i| if i % dim == 0 { case.gap[i / dim] } else { case.rest(i / dim, i % dim - 1) })
            .collect();
        let force: Vec<f64> = (0..case.size())
            .map(|i| if i % dim == 0 { -10.0 } else { uniform(&mut rng, -2.0, 2.0) })
            .collect();
        let kd = product(&case.k, &rest);
        case.f = kd.iter().zip(&force).map(|(kd, force)| kd - force).collect();
        for solution in solved(&case) {
            assert_eq!(solution.d, rest, "seed {seed}: {case:?}\n{solution:?}");
            assert!(solution.certificate.states.iter().all(|&state| state == State::Stick));
            let near = |(a, b): (&f64, &f64)| (a - b).abs() <= 1e-13 * 10.0;
            assert!(solution.certificate.force.iter().zip(&force).all(near), "seed {seed}");
        }
        // An unloaded structure that touches nothing does not move.
        case.f.fill(0.0);
        case.gap.iter_mut().for_each(|gap| *gap = gap.abs());
        case.slip = None;
        for solution in solved(&case) {
            assert!(solution.d.iter().all(|&d| d == 0.0), "seed {seed}: {solution:?}");
            assert_eq!(solution.certificate.eta, 0.0);
        }
    }
}

/// A component that the host holds fixed is a row of its own: zero off the diagonal, no load.
#[test]
fn decoupled_components_stay_at_rest() {
    for seed in 0..200 {
        let mut rng = Rng::with_seed(seed);
        let mut case = random_case(&mut rng, [0.0, 0.3][seed as usize % 2]);
        let n = case.size();
        let fixed: Vec<usize> = (0..n).filter(|_| rng.u8(0..3) == 0).collect();
        for &i in &fixed {
            for j in (0..n).filter(|&j| j != i) {
                case.k[i + j * n] = 0.0;
                case.k[j + i * n] = 0.0;
            }
            case.f[i] = 0.0;
            let pair = i / case.dim;
            match i % case.dim {
                0 => case.gap[pair] = case.gap[pair].abs(),
                c => {
                    if let Some(slip) = &mut case.slip {
                        slip[(case.dim - 1) * pair + c - 1] = 0.0;
                    }
                }
            }
        }
        if largest(&case.f) == 0.0 {
            continue;
        }
        let gaps = case.gap.iter().filter(|gap| gap.is_finite());
        let lengths = gaps.fold(0.0, |most: f64, gap| most.max(gap.abs()));
        for solution in solved(&case) {
            for &i in &fixed {
                // Lemke's method counts from the gap: a few units of its rounding.
                let zero = 1e-15 * lengths;
                let context = || format!("seed {seed}, {i}: {case:?}\n{solution:?}");
                assert!(solution.d[i].abs() <= zero, "{}", context());
                assert!(solution.certificate.force[i].abs() <= zero, "{}", context());
            }
        }
    }
}

/// Arrays may be longer than needed, and the rows between `n` and the leading dimension hold
/// anything.
#[test]
fn what_lies_beyond_the_data_does_not_matter() {
    let mut rng = Rng::with_seed(7);
    let case = random_case(&mut rng, 0.3);
    let (n, ld) = (case.size(), case.size() + 3);
    let mut k = vec![f64::NAN; n * ld];
    for j in 0..n {
        k[j * ld..j * ld + n].copy_from_slice(&case.k[j * n..(j + 1) * n]);
    }
    let longer = |x: &[f64]| [x, &[1e6, -1e6, 3e5]].concat();
    let (load, gap) = (longer(&case.f), longer(&case.gap));
    let Law::Coulomb(mu) = &case.law else { unreachable!() };
    let mu: Vec<f64> = longer(mu).iter().map(|mu| mu.abs()).collect();
    let slip = longer(&case.slip.clone().unwrap_or(vec![0.0; n - case.pairs]));
    let data = ContactData {
        stiffness: &k,
        ld,
        load: &load,
        gap: &gap,
        law: FrictionLaw::Coulomb(&mu),
        reference_slip: Some(&slip),
        ..case.data()
    };
    let settings = Settings::default();
    let problem = ContactProblem::new(data).unwrap();
    let padded = solve(&problem, &settings, None, &mut Monitor::new(&settings, None)).unwrap();
    let plain = case.solve(&settings);
    assert_eq!(padded.status, plain.status);
    assert_eq!(padded.d, plain.d);
    assert_eq!(padded.certificate.force, plain.certificate.force);
    assert_eq!(padded.certificate.eta, plain.certificate.eta);
    assert_eq!(padded.certificate.rounding, plain.certificate.rounding);
}

#[test]
fn what_lies_beyond_a_bare_complementarity_problem_does_not_matter() {
    let settings = Settings::default();
    let run = |m: &[f64], ld, q: &[f64]| {
        let lcp = Lcp::new(2, m, ld, q, None).unwrap();
        solve_lcp(&lcp, &settings, &mut Monitor::new(&settings, None)).unwrap()
    };
    let plain = run(&[2.0, 1.0, 1.0, 3.0], 2, &[-1.0, -1.0]);
    let padded = run(&[2.0, 1.0, f64::NAN, 1.0, 3.0, f64::NAN], 3, &[-1.0, -1.0, -1e6]);
    assert_eq!(padded.status, plain.status);
    assert_eq!((&padded.z, &padded.w), (&plain.z, &plain.w));
    assert_eq!(padded.eta, plain.eta);
    // Solved wrongly by 1e-4, it would be good enough for a scale of 1e6.
    let lcp = Lcp::new(2, &[2.0, 1.0, 1.0, 3.0], 2, &[-1.0, -1.0, -1e6], None).unwrap();
    let off = [plain.z[0] + 1e-4, plain.z[1]];
    assert!(lcp.eta(&off) > 1e-5, "{}", lcp.eta(&off));
}

/// Forces in space whose sums are beyond the largest number: no method calls it solved, or returns what
/// is no number.
#[test]
fn sums_in_space_that_overflow_are_said() {
    for (k, f, gap) in
        [([1.0, 1e-300, 1e-300], [1.0, 1e300, 1e300], 0.0), ([1.7e308; 3], [1.7e308; 3], -3.0)]
    {
        let stiffness: Vec<f64> = (0..9).map(|i| if i % 4 == 0 { k[i / 4] } else { 0.0 }).collect();
        let gaps = [gap];
        let problem = ContactProblem::new(ContactData {
            dim: 3,
            pairs: 1,
            stiffness: &stiffness,
            ld: 3,
            load: &f,
            gap: &gaps,
            law: FrictionLaw::Coulomb(&[0.5]),
            reference_slip: None,
        });
        let problem = problem.expect("all entries are finite");
        for method in [Method::Auto, Method::Newton, Method::Path] {
            let settings = Settings { method, max_iterations: 1000, ..Settings::default() };
            let mut monitor = Monitor::new(&settings, None);
            let solution = signorini::solve(&problem, &settings, None, &mut monitor).unwrap();
            assert_ne!(solution.status, Status::Solved, "{method:?}");
            assert!(solution.d.iter().all(|d| d.is_finite()), "{method:?}: {:?}", solution.d);
        }
    }
}

/// A load so large that sums in twice the precision overflow: its force is no number, and displacements that
/// leave it alone are no solution.
#[test]
fn a_force_that_overflows_is_not_certified() {
    let (stiffness, load) = ([2e-14, 0.0, 0.0, 2e-14], [0.0, 1e308]);
    let data = ContactData {
        dim: 2,
        pairs: 1,
        stiffness: &stiffness,
        ld: 2,
        load: &load,
        gap: &[0.0],
        law: FrictionLaw::Frictionless,
        reference_slip: None,
    };
    let problem = ContactProblem::new(data).expect("all entries are finite");
    let certificate = signorini::certificate::certify(&problem, &[0.0, 1e-16]);
    assert!(!certificate.holds(0.1), "{certificate:?}");
}
