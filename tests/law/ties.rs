//! Tied pairs: what is left is the problem of the other pairs, whatever the method and the form.

use crate::common::dense::{Elimination, largest, product};
use crate::common::problems::{
    Case, Law, add_spring, decades, definite, loaded, mixed, uniform, vector,
};
use fastrand::Rng;
use signorini::certificate::{certify, is_escape, prove};
use signorini::law::{Bound, PairLaw, first_open_tie};
use signorini::{
    ContactData, ContactProblem, FlexibilityData, FlexibilityProblem, FrictionLaw, Method, Monitor,
    Search, Settings, Solution, State, Status, Uniqueness, solve, solve_flexibility,
};

/// The number of the law of a tie.
const TIED: [f64; 4] = [7.0, 0.0, 0.0, 0.0];

/// A random definite problem with a law for each pair, of which some are tied; and the components that are not.
fn partly_tied(rng: &mut Rng, dim: usize, most: f64) -> (Case, Vec<usize>) {
    let pairs = rng.usize(2..=6);
    let condition = decades(rng, 3.0);
    let k = definite(rng, dim * pairs, condition);
    let law = mixed(rng, (dim, pairs), most);
    let mut case = loaded(rng, dim, k, law);
    let mut numbers = case.law.values().to_vec();
    let tied: Vec<bool> = (0..pairs).map(|pair| pair == 0 || rng.bool()).collect();
    for pair in (0..pairs).filter(|&pair| tied[pair]) {
        numbers[4 * pair..4 * (pair + 1)].copy_from_slice(&TIED);
        case.gap[pair] = uniform(rng, -0.3, 0.3);
    }
    case.law = Law::ByPair(numbers);
    let others = (0..dim * pairs).filter(|i| !tied[i / dim]).collect();
    (case, others)
}

/// The displacement that a tie prescribes; 0 of other components.
fn prescribed(case: &Case, others: &[usize]) -> Vec<f64> {
    let dim = case.dim;
    let own = |i: usize| match i % dim {
        _ if others.contains(&i) => 0.0,
        0 => case.gap[i / dim],
        c => case.rest(i / dim, c - 1),
    };
    (0..case.size()).map(own).collect()
}

/// The problem that is left of the other pairs.
fn left(case: &Case, others: &[usize]) -> Case {
    let moved = product(&case.k, &prescribed(case, others));
    let pairs: Vec<usize> = others.iter().step_by(case.dim).map(|i| i / case.dim).collect();
    let numbers = pairs.iter().flat_map(|pair| case.law.values()[4 * pair..][..4].to_vec());
    let slips = |&pair: &usize| (0..case.dim - 1).map(move |c| (pair, c));
    Case {
        dim: case.dim,
        pairs: pairs.len(),
        k: others.iter().flat_map(|&j| others.iter().map(move |&i| case.stiffness(i, j))).collect(),
        f: others.iter().map(|&i| case.f[i] - moved[i]).collect(),
        gap: pairs.iter().map(|&pair| case.gap[pair]).collect(),
        law: Law::ByPair(numbers.collect()),
        slip: Some(pairs.iter().flat_map(slips).map(|(pair, c)| case.rest(pair, c)).collect()),
    }
}

fn settings(method: Method) -> Settings {
    Settings { method, tolerance: 1e-12, max_iterations: 50_000, ..Settings::default() }
}

/// Every method solves what is left, and the forces of the ties are those of equilibrium. Little friction: one solution.
/// Conditions up to 1e3 and residuals of 1e-12: 1e-9 of the displacements at most.
#[test]
fn the_other_pairs_are_a_problem_of_their_own() {
    let methods = [
        Method::Auto,
        Method::Newton,
        Method::Path,
        Method::SorNested,
        Method::Lemke,
        Method::SorDiagonal,
    ];
    let mut solved = 0;
    for seed in 0..150 {
        let rng = &mut Rng::with_seed(seed);
        let dim = rng.usize(2..=3);
        let (case, others) = partly_tied(rng, dim, 0.05);
        let method = methods[seed as usize % methods.len()];
        if dim == 3 && method == Method::Lemke {
            continue;
        }
        let own = left(&case, &others);
        let reference =
            if others.is_empty() { None } else { Some(own.solve(&settings(Method::Auto))) };
        let (Ok(solution), true) = (
            solve(
                &case.problem(),
                &settings(method),
                None,
                &mut Monitor::new(&settings(method), None),
            ),
            reference.as_ref().is_none_or(|own| own.status == Status::Solved),
        ) else {
            // The diagonal method takes no given thresholds alone.
            assert_eq!(method, Method::SorDiagonal);
            continue;
        };
        if solution.status != Status::Solved {
            assert!(
                method != Method::Auto && method != Method::Path,
                "seed {seed}: {}",
                solution.message
            );
            continue;
        }
        solved += 1;
        let mut d = prescribed(&case, &others);
        for (k, &i) in others.iter().enumerate() {
            d[i] = reference.as_ref().map_or(0.0, |own| own.d[k]);
        }
        let size = largest(&d).max(largest(&case.f));
        for (own, expected) in solution.d.iter().zip(&d) {
            assert!(
                (own - expected).abs() <= 1e-9 * size.max(1.0),
                "seed {seed}: {own} {expected}"
            );
        }
        let force = product(&case.k, &solution.d);
        for i in (0..case.size()).filter(|i| !others.contains(i)) {
            assert_eq!(solution.d[i], d[i], "a tie is exact");
            assert_eq!(solution.certificate.states[i / dim], State::Stick);
            let expected = force[i] - case.f[i];
            let force = solution.certificate.force[i];
            assert!((force - expected).abs() <= 1e-9 * size.max(1.0), "{force} {expected}");
        }
        let again = certify(&case.problem(), &solution.d);
        assert!(again.holds(1e-10), "{}", again.eta);
    }
    assert!(solved >= 110, "{solved}");
}

/// The law of all pairs: `d` is the references to the last bit, and `F` the force of equilibrium. A pair with the gap
/// `+inf` is free of any force.
#[test]
fn all_pairs_may_be_tied() {
    for seed in 0..40 {
        let rng = &mut Rng::with_seed(seed);
        let (dim, pairs) = (rng.usize(2..=3), rng.usize(1..=5));
        let k = definite(rng, dim * pairs, 100.0);
        let (f, slip) = (vector(rng, dim * pairs), vector(rng, (dim - 1) * pairs));
        let mut gap = vector(rng, pairs);
        if seed % 2 == 0 {
            gap[pairs - 1] = f64::INFINITY;
        }
        let free = |i: usize| gap[i / dim].is_infinite();
        let problem = ContactProblem::new(ContactData {
            dim,
            pairs,
            stiffness: &k,
            ld: dim * pairs,
            load: &f,
            gap: &gap,
            law: FrictionLaw::Tied,
            reference_slip: Some(&slip),
        })
        .unwrap();
        let settings = Settings { proof: true, search: Search::Others, ..settings(Method::Auto) };
        let solution =
            solve(&problem, &settings, None, &mut Monitor::new(&settings, None)).unwrap();
        assert_eq!(solution.status, Status::Solved, "{}", solution.message);
        assert!(!solution.remarks.gaps_negative, "a tie prescribes its gap");
        assert!(matches!(solution.existence, signorini::Existence::Proved(_)), "seed {seed}");
        assert_eq!(solution.uniqueness, Uniqueness::Unique);
        let force = product(&k, &solution.d);
        for i in 0..dim * pairs {
            let pair = i / dim;
            if free(i) {
                assert!((force[i] - f[i]).abs() <= 1e-10);
                assert_eq!(solution.certificate.states[pair], State::Open);
                assert_eq!(solution.certificate.force[i], 0.0);
                continue;
            }
            let reference =
                if i % dim == 0 { gap[pair] } else { slip[(dim - 1) * pair + i % dim - 1] };
            assert_eq!(solution.d[i], reference);
            assert!((solution.certificate.force[i] - (force[i] - f[i])).abs() <= 1e-13);
        }
    }
}

/// A tie is cohesion that nothing reaches, with no gap.
#[test]
fn a_tie_is_cohesion_that_is_strong_enough() {
    for seed in 0..60 {
        let rng = &mut Rng::with_seed(seed);
        let dim = rng.usize(2..=3);
        let (mut case, others) = partly_tied(rng, dim, 0.05);
        (0..case.pairs)
            .filter(|pair| !others.contains(&(dim * pair)))
            .for_each(|pair| case.gap[pair] = 0.0);
        let strong =
            |own: &[f64]| if own == TIED { [3.0, 0.0, 1e4, 1e4] } else { own.try_into().unwrap() };
        let numbers: Vec<f64> = case.law.values().chunks_exact(4).flat_map(strong).collect();
        let glued = Case { law: Law::ByPair(numbers), ..case.clone() };
        let [one, other] = [&case, &glued].map(|case| case.solve(&settings(Method::Auto)));
        assert_eq!((one.status, other.status), (Status::Solved, Status::Solved), "seed {seed}");
        // Residuals are relative to the strength in neither: forces are of a few units; conditions up to 1e3.
        for (a, b) in one.d.iter().zip(&other.d) {
            assert!((a - b).abs() <= 1e-8, "seed {seed}: {a} {b}");
        }
    }
}

/// The measure of a tie is the stiffness times the distance from its reference, however large its force; tension is none.
#[test]
fn a_tie_is_measured_by_its_displacement() {
    let k = [4.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 2.0];
    let f = [-8.0, 64.0, 0.0];
    let problem = ContactProblem::new(ContactData {
        dim: 3,
        pairs: 1,
        stiffness: &k,
        ld: 3,
        load: &f,
        gap: &[0.25],
        law: FrictionLaw::Tied,
        reference_slip: Some(&[0.5, 0.0]),
    })
    .unwrap();
    let at = certify(&problem, &[0.25, 0.5, 0.0]);
    assert_eq!((at.eta, at.tension, at.cone_excess, at.penetration), (0.0, 0.0, 0.0, 0.0));
    assert_eq!(at.force, [9.0, -63.0, 0.0]);
    assert_eq!(at.states, [State::Stick]);
    // Opened by 2^-10, sheared by 2^-9 and 2^-8: forces 2^-8, 2^-8 and 2^-7, of loads beside which F is no larger.
    let off = 2_f64.powi(-10);
    let at = certify(&problem, &[0.25 - off, 0.5 + 2.0 * off, 4.0 * off]);
    let scale = (f[0] * f[0] + f[1] * f[1]).sqrt();
    let expected = (2.0 * (4.0 * off).powi(2) + (8.0 * off).powi(2)).sqrt() / scale;
    assert!((at.eta - expected).abs() <= 1e-15, "{} {expected}", at.eta);
    assert_eq!(at.penetration, off);
    assert!(!at.holds(1e-5) && prove(&problem, &[0.25, 0.5, 0.0], &[State::Slip]).is_none());
    let proof = prove(&problem, &[0.25, 0.5, 0.0], &[State::Stick]).expect("a tie is a solution");
    assert!(proof.d == [0.25, 0.5, 0.0] && proof.d_radius == [0.0; 3], "{proof:?}");
    assert!(proof.force == [9.0, -63.0, 0.0] && largest(&proof.force_radius) <= 1e-13, "{proof:?}");
}

/// Two bodies, each of two pairs that nothing but contact holds: the first has a tie, and whatever pulls it is held. The
/// second one leaves if it is pulled, along a motion that moves no tie, and is named by its own number.
#[test]
fn no_motion_moves_a_tie() {
    for dim in [2, 3] {
        let pairs = 4;
        let n = dim * pairs;
        let mut k = vec![0.0; n * n];
        for body in 0..2 {
            for c in 0..dim {
                let (i, j) = (2 * dim * body + c, 2 * dim * body + dim + c);
                let stiffness = 1.0 + c as f64;
                for (a, b, sign) in [(i, i, 1.0), (j, j, 1.0), (i, j, -1.0), (j, i, -1.0)] {
                    k[a + n * b] = sign * stiffness;
                }
            }
        }
        let mut numbers = [1.0, 0.3, 0.0, 0.0].repeat(pairs);
        numbers[4..8].copy_from_slice(&TIED);
        for pull in [false, true] {
            let mut f = vec![0.0; n];
            (f[0], f[dim], f[dim + 1]) = (-3.0, -5.0, 2.0);
            f[2 * dim] = if pull { -1.0 } else { 1.0 };
            f[3 * dim] = 1.0 - f64::from(u8::from(pull)) * 0.5;
            let problem = ContactProblem::new(ContactData {
                dim,
                pairs,
                stiffness: &k,
                ld: n,
                load: &f,
                gap: &[0.0; 4],
                law: FrictionLaw::ByPair(&numbers),
                reference_slip: None,
            })
            .unwrap();
            let settings = Settings::default();
            let found =
                solve(&problem, &settings, None, &mut Monitor::new(&settings, None)).unwrap();
            if !pull {
                assert_eq!(found.status, Status::Solved, "{}", found.message);
                assert_eq!(found.certificate.force[dim], 8.0, "the tie carries both pulls");
                assert_eq!(found.d[0], -3.0, "pulled by 3 on a spring of 1");
                continue;
            }
            assert_eq!(found.status, Status::NoEquilibrium, "{}", found.message);
            let motion = found.recession.expect("a proof");
            assert!(is_escape(&problem, &motion));
            assert_eq!(motion[..2 * dim], vec![0.0; 2 * dim], "the first body stays");
            let escape = found.escape.expect("a motion to draw");
            assert_eq!(escape.motion[..2 * dim], vec![0.0; 2 * dim]);
            let message = found.message.to_string();
            assert!(
                message.contains("of 4 pairs, most of all pair 2") || message.contains("pair 3"),
                "{message}"
            );
            // A motion that turns the first body off its tie proves nothing.
            let mut other = motion.clone();
            other[..2 * dim].iter_mut().step_by(dim).for_each(|r| *r = -1.0);
            assert!(!is_escape(&problem, &other));
        }
    }
}

fn inverse(n: usize, k: &[f64]) -> Vec<f64> {
    let elimination = Elimination::new(n, k);
    let unit = |j: usize| (0..n).map(|i| f64::from(u8::from(i == j))).collect::<Vec<f64>>();
    let columns: Vec<Vec<f64>> = (0..n).map(|j| elimination.solve(&unit(j)).0).collect();
    // The mean of entries that are equal but for rounding.
    (0..n * n).map(|at| f64::midpoint(columns[at / n][at % n], columns[at % n][at / n])).collect()
}

/// In flexibility form, `W = K⁻¹` and `q = W f`: the same displacements and forces, also where a tie stands twice, so
/// that `W` is singular and the sum of both forces counts.
#[test]
fn ties_in_flexibility_form() {
    let solve_form = |dim: usize, w: &[f64], q: &[f64], case: &Case| -> Solution {
        let problem = FlexibilityProblem::from_flexibility(FlexibilityData {
            dim,
            pairs: case.pairs,
            flexibility: (w, q.len()),
            free: q,
            gap: &case.gap,
            law: case.law.friction(),
            reference_slip: case.slip.as_deref(),
        })
        .unwrap();
        let settings = Settings::default();
        solve_flexibility(&problem, &settings, None, &mut Monitor::new(&settings, None)).unwrap()
    };
    for seed in 0..80 {
        let rng = &mut Rng::with_seed(seed);
        let dim = rng.usize(2..=3);
        let (case, _) = partly_tied(rng, dim, 0.05);
        let case =
            Case { slip: case.slip.clone().or(Some(vec![0.0; (dim - 1) * case.pairs])), ..case };
        let (n, stiff) = (case.size(), case.solve(&settings(Method::Auto)));
        assert_eq!(stiff.status, Status::Solved, "seed {seed}");
        let w = inverse(n, &case.k);
        let q = product(&w, &case.f);
        let form = solve_form(dim, &w, &q, &case);
        assert_eq!(form.status, Status::Solved, "seed {seed}: {}", form.message);
        // eta is 1e-10 of forces; conditions up to 1e3, and that of W too.
        let near = |a: &[f64], b: &[f64]| {
            let apart = a.iter().zip(b).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
            assert!(apart <= 1e-5 * largest(b).max(1.0), "seed {seed}: {a:?}\n{b:?}");
        };
        near(&form.d, &stiff.d);
        near(&form.certificate.force, &stiff.certificate.force);
        assert_eq!(form.certificate.states, stiff.certificate.states, "seed {seed}");

        // The first pair, a tie, once more at the end.
        let m = n + dim;
        let from = |i: usize| if i < n { i } else { i - n };
        let doubled = Case {
            pairs: case.pairs + 1,
            gap: [&case.gap[..], &case.gap[..1]].concat(),
            law: Law::ByPair([case.law.values(), &TIED].concat()),
            slip: case.slip.as_ref().map(|slip| [&slip[..], &slip[..dim - 1]].concat()),
            ..case.clone()
        };
        let w: Vec<f64> = (0..m * m).map(|at| w[from(at % m) + n * from(at / m)]).collect();
        let q: Vec<f64> = (0..m).map(|i| q[from(i)]).collect();
        let form = solve_form(dim, &w, &q, &doubled);
        assert_eq!(form.status, Status::Solved, "seed {seed}: {}", form.message);
        near(&form.d[..n], &stiff.d);
        let mut force = form.certificate.force.clone();
        (0..dim).for_each(|c| force[c] += force[n + c]);
        near(&force[..n], &stiff.certificate.force);
    }
}

/// A matrix that is not symmetric, as of a load that follows the motion: the others are such a problem too.
#[test]
fn ties_on_a_matrix_that_is_not_symmetric() {
    for seed in 0..40 {
        let rng = &mut Rng::with_seed(seed);
        let (mut case, others) = partly_tied(rng, 3, 0.05);
        let n = case.size();
        // A little more on one side of the diagonal: x . K x stays positive, as eigenvalues are 1e-3 at least.
        for j in 0..n {
            for i in 0..j {
                case.k[i + n * j] += uniform(rng, -1e-5, 1e-5);
            }
        }
        let own = left(&case, &others);
        let solve = |case: &Case| {
            let problem = ContactProblem::unsymmetric(case.data()).unwrap();
            let settings = settings(Method::Auto);
            solve(&problem, &settings, None, &mut Monitor::new(&settings, None)).unwrap()
        };
        let whole = solve(&case);
        assert_eq!(whole.status, Status::Solved, "seed {seed}: {}", whole.message);
        if others.is_empty() {
            continue;
        }
        let part = solve(&own);
        for (&i, expected) in others.iter().zip(&part.d) {
            assert!(
                (whole.d[i] - expected).abs() <= 1e-8 * largest(&part.d).max(1.0),
                "seed {seed}"
            );
        }
    }
}

/// The sentence of a problem that is not solved has the measure of the report: that of the whole, to whose forces the
/// tie that moves the bodies adds its own, and not that of the other pair.
#[test]
fn sentences_have_the_measure_of_the_whole() {
    let k = [4.0, 1.0, -1.0, 0.0, 1.0, 4.0, 0.0, -1.0, -1.0, 0.0, 4.0, 1.0, 0.0, -1.0, 1.0, 4.0];
    for gap in [0.0, 0.5, 1.0, 2.0] {
        let gaps = [0.0, gap];
        let numbers = [[1.0, 0.3, 0.0, 0.0], TIED].concat();
        let problem = ContactProblem::new(ContactData {
            dim: 2,
            pairs: 2,
            stiffness: &k,
            ld: 4,
            load: &[2.0, 1.5, 3.0, 0.5],
            gap: &gaps,
            law: FrictionLaw::ByPair(&numbers),
            reference_slip: None,
        });
        let settings = Settings { max_iterations: 3, ..settings(Method::SorNested) };
        let monitor = &mut Monitor::new(&settings, None);
        let solution = solve(&problem.unwrap(), &settings, None, monitor).unwrap();
        let wanted = format!(
            "max_iterations (3) used up; eta is {:.1e}, wanted 1.0e-12",
            solution.certificate.eta
        );
        assert_eq!(solution.message.to_string(), wanted, "{gap}");
    }
}

/// The first of the pairs asked for that is tied across a gap, or across an interference, with that gap. A gap of 0 is closed,
/// a pair without an obstacle is free, and nothing is told of a law whose numbers are not all there.
#[test]
fn the_first_open_tie_is_found() {
    let coulomb = [1.0, 0.5, 0.0, 0.0];
    let numbers = [TIED, coulomb, TIED, TIED, TIED].concat();
    let gaps = [0.0, 2.0, -0.5, 3.0, f64::INFINITY];
    let first = |law, pairs: &[usize]| first_open_tie((&gaps, law), pairs.iter().copied());
    let by_pair = FrictionLaw::ByPair(&numbers);
    for (pairs, expected) in [
        (&[0, 1, 2, 3, 4][..], Some((2, -0.5))),
        (&[4, 3, 2], Some((3, 3.0))),
        (&[0, 1, 4], None),
        (&[9, 3], Some((3, 3.0))),
        (&[9], None),
    ] {
        assert_eq!(first(by_pair, pairs), expected, "{pairs:?}");
    }
    assert_eq!(first(FrictionLaw::Tied, &[0, 1, 2]), Some((1, 2.0)));
    assert_eq!(first(FrictionLaw::Tied, &[0, 4]), None);
    assert_eq!(first(FrictionLaw::Frictionless, &[0, 1, 2]), None);
    assert_eq!(first(FrictionLaw::ByPair(&numbers[..16]), &[2, 3, 4]), None);
}

/// A tie lacks what it is away from its reference, in forces, whatever its force is, and nothing of that is rounded beside
/// a force. All numbers are exact.
#[test]
fn a_tie_lacks_its_distance_from_its_reference() {
    let bound = Bound { slope: 0.5, offset: 1.0 };
    let tie = PairLaw::new(3, 0.5, [2.0, -1.0], bound, (4.0, 8.0)).with_tie();
    for force in [[0.0; 3], [-1.0, 5.0, -3.0], [2.0, 0.0, 7.0]] {
        for (d, expected) in [
            ([0.5, 2.0, -1.0], [0.0; 3]),
            ([1.5, 2.5, 0.0], [4.0, 4.0, 8.0]),
            ([-1.5, 1.0, -2.0], [-8.0, -8.0, -8.0]),
        ] {
            let mut residual = [0.0; 3];
            tie.natural_residual(&d, &force, &mut residual);
            assert_eq!(residual, expected, "{d:?}, {force:?}");
            assert_eq!((tie.natural_rounding(&d, &force), tie.sensitivity()), (0.0, 0.0));
            assert_eq!(tie.state(&d, &force, 1e-3), State::Stick);
            let violation = tie.violation(&d, &force);
            let lengths = (violation.penetration, violation.tension, violation.cone_excess);
            assert_eq!(lengths, (f64::abs(expected[0]) / 4.0, 0.0, 0.0), "{d:?}, {force:?}");
        }
        assert_eq!(tie.admissible_force(&force, State::Stick), force);
    }
}

/// A tie resists every motion, by `hypot(r_n, 3/2 |r_t|)` with the stiffnesses 4 and 9. It carries the force of 1 along each
/// axis of its dimension and against it, and along no other axis.
#[test]
fn a_tie_resists_all_motions_and_carries_all_forces() {
    for dim in [2, 3] {
        let bound = Bound { slope: 0.5, offset: 0.0 };
        let tie = PairLaw::new(dim, 0.0, [0.0; 2], bound, (4.0, 9.0)).with_tie();
        for (motion, length) in [
            ([3.0, 0.0, 0.0], 3.0),
            ([-3.0, 0.0, 0.0], 3.0),
            ([0.0, 4.0, 0.0], 6.0),
            ([8.0, -4.0, 0.0], 10.0),
            ([0.0, 2.0, 0.0], 3.0),
        ] {
            let approach = tie.recession(&motion[..dim]).approach;
            // Three roundings of a number up to 10.
            assert!((approach - length).abs() <= 1e-14, "{motion:?}: {approach}");
        }
        let mut edges = tie.cone_edges();
        for c in 0..dim {
            for along in [1.0, -1.0] {
                let mut force = [0.0; 3];
                force[c] = along;
                let at = edges.iter().position(|&edge| edge == force).expect("an edge");
                edges.swap_remove(at);
            }
        }
        assert!(edges.is_empty(), "{dim}: {edges:?}");
    }
}

/// A tie on springs beside a free mass on its obstacle, whose block of `K` is zero: pressed, it rests on the obstacle with
/// the force of the press; drawn away, or along the obstacle without friction, it has no equilibrium. In any unit, to rounding.
#[test]
fn a_free_mass_beside_a_tie_rests_or_escapes() {
    for (scale, gap, method) in [1.0, 2_f64.powi(40), 2_f64.powi(-40)]
        .into_iter()
        .flat_map(|scale| [-0.5, 0.0, 0.1].map(|gap| (scale, gap)))
        .flat_map(|(scale, gap)| [Method::Auto, Method::Newton].map(|m| (scale, gap, m)))
    {
        let mut k = [0.0; 16];
        (k[0], k[5]) = (scale, scale);
        let settings = Settings { method, ..Settings::default() };
        for load in [[1.0, 0.0], [-1.0, 0.0], [1.0, 0.5]] {
            let f = [scale, 0.0, scale * load[0], scale * load[1]];
            let (numbers, gaps) = ([TIED, [0.0; 4]].concat(), [0.0, gap]);
            let problem = ContactProblem::new(ContactData {
                dim: 2,
                pairs: 2,
                stiffness: &k,
                ld: 4,
                load: &f,
                gap: &gaps,
                law: FrictionLaw::ByPair(&numbers),
                reference_slip: None,
            })
            .unwrap();
            let monitor = &mut Monitor::new(&settings, None);
            let found = solve(&problem, &settings, None, monitor).unwrap();
            let context = format!("{scale:e}, {gap}, {method:?}, {load:?}: {}", found.message);
            if load == [1.0, 0.0] {
                assert_eq!(found.status, Status::Solved, "{context}");
                assert!((found.d[2] - gap).abs() < 1e-12, "{context}: {:?}", found.d);
                let force = &found.certificate.force;
                assert!((force[2] + scale).abs() < 1e-12 * scale, "{context}: {force:?}");
                assert!(!found.remarks.gaps_passed, "{context}");
            } else if method == Method::Auto {
                assert_eq!(found.status, Status::NoEquilibrium, "{context}");
                assert!(is_escape(&problem, &found.recession.expect("a proof")), "{context}");
            }
        }
    }
}

/// Four pairs whose `K` has the rank 2, one of them tied where it has slipped: the loads of the other pairs are larger than
/// those of the whole, and so is what their tolerance lets pass. Displacements and forces are chosen, and the loads follow, so
/// that there is a solution. Pair 0 is open to friction, pair 1 sticks at a force on the edge of its ellipse, pair 3 has none.
#[test]
fn a_tie_that_moves_far_leaves_loads_that_are_larger_than_the_whole() {
    let strains = [
        [2.0, -1.0, 2.0, -2.0, 1.0, 2.0, 1.0, 2.0, 0.0, 1.0, -1.0, -1.0],
        [0.0, 1.0, 2.0, -1.0, 2.0, -1.0, 0.0, 0.0, 2.0, -1.0, 2.0, 0.0],
    ];
    let numbers = [[1.0, 1.0, 0.0, 0.0], [5.0, 1.0, 1.0, 2.0], TIED, [2.0, 0.0, 0.0, 0.0]];
    let mut k = vec![0.0; 144];
    strains.iter().for_each(|strain| add_spring(&mut k, strain, 1.0));
    let rng = &mut Rng::with_seed(1);
    for round in 0..500 {
        let mut d = [0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0];
        d[10..].fill_with(|| uniform(rng, -3.0, 3.0));
        let (sin, cos) = uniform(rng, 0.0, std::f64::consts::TAU).sin_cos();
        let force = [0.0, 0.0, 0.0, -2.0, cos, sin, 0.0, -1.0, 1.0, 0.0, 0.0, 0.0];
        let case = Case {
            dim: 3,
            pairs: 4,
            f: product(&k, &d)
                .iter()
                .zip(force)
                .map(|(internal, force)| internal - force)
                .collect(),
            k: k.clone(),
            gap: vec![0.0; 4],
            law: Law::ByPair(numbers.concat()),
            slip: Some(vec![-1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 1.0, -1.0]),
        };
        let found = case.solve(&Settings::default());
        assert_eq!(found.status, Status::Solved, "{round}: {}", found.message);
    }
}
