//! A law for each pair: one everywhere is that law, a problem in parts has the laws of its parts, and what is wrong is
//! named by its pair.

use crate::common::problems::{
    Case, Law, cohesive, coulomb, decades, definite, floating, loaded, mixed, tresca, uniform,
};
use fastrand::Rng;
use signorini::{ContactProblem, FrictionLaw, Method, Search, Settings, Solution, Status};

fn settings(method: Method) -> Settings {
    Settings { method, search: Search::Others, max_iterations: 20_000, ..Settings::default() }
}

fn assert_same(one: &Solution, other: &Solution, what: &str) {
    assert_eq!(one.status, other.status, "{what}");
    assert_eq!((one.method, one.iterations), (other.method, other.iterations), "{what}");
    assert_eq!((&one.d, &one.d_low), (&other.d, &other.d_low), "{what}");
    assert_eq!(one.certificate.force, other.certificate.force, "{what}");
    assert_eq!(one.certificate.states, other.certificate.states, "{what}");
    assert_eq!(one.certificate.eta.to_bits(), other.certificate.eta.to_bits(), "{what}");
    assert_eq!((one.uniqueness, &one.recession), (other.uniqueness, &other.recession), "{what}");
}

/// The law of all pairs, and each pair with that law: the same bits of all results, by every method that takes both.
#[test]
fn one_law_everywhere_is_that_law() {
    for seed in 0..120 {
        let rng = &mut Rng::with_seed(seed);
        let (dim, pairs) = (rng.usize(2..=3), rng.usize(1..=5));
        let condition = decades(rng, 3.0);
        let ellipse = |rng: &mut Rng| {
            let numbers =
                |_| [uniform(rng, 0.1, 0.5), uniform(rng, 0.1, 0.5), uniform(rng, -4.0, 4.0)];
            (0..pairs).flat_map(numbers).collect()
        };
        let law = match seed % 6 {
            0 => tresca(rng, pairs),
            1 => cohesive(rng, pairs, 0.5),
            2 if dim == 3 => Law::Orthotropic(ellipse(rng)),
            3 if dim == 3 => Law::Collinear(ellipse(rng)),
            4 => Law::Coulomb(vec![0.0; pairs]),
            _ => coulomb(rng, pairs, 0.5),
        };
        let k = match dim {
            2 if seed % 4 == 0 => floating(rng, pairs, condition).0,
            _ => definite(rng, dim * pairs, condition),
        };
        let one = loaded(rng, dim, k, law);
        let other = Case { law: one.law.by_pair(), ..one.clone() };
        for method in [Method::Auto, Method::Newton, Method::Path, Method::SorNested, Method::Lemke]
        {
            if method == Method::Lemke && dim == 3 {
                continue;
            }
            let settings = settings(method);
            let what = format!("seed {seed}, {method:?}, {:?}", one.law);
            assert_same(&one.solve(&settings), &other.solve(&settings), &what);
        }
    }
}

/// Pairs of frictionless laws alone are a frictionless problem, for methods that take no other.
#[test]
fn pairs_without_friction_are_a_frictionless_problem() {
    let rng = &mut Rng::with_seed(1);
    let k = definite(rng, 8, 10.0);
    let numbers = [[0.0; 4], [1.0, 0.0, 0.0, 0.0], [2.0, 0.0, 0.0, 0.0], [3.0, 0.0, 0.0, 0.0]];
    let case = loaded(rng, 2, k, Law::ByPair(numbers.concat()));
    let solution = case.solve(&settings(Method::BlockPivoting));
    assert_eq!(solution.status, Status::Solved);
    let other =
        Case { law: Law::Coulomb(vec![0.0; 4]), ..case }.solve(&settings(Method::BlockPivoting));
    assert_same(&solution, &other, "without friction");
}

/// Two problems that no entry of `K` ties to each other, of different laws, are one with a law for each pair.
#[test]
fn a_problem_in_parts_has_the_laws_of_its_parts() {
    let mut solved = 0;
    for seed in 0..100 {
        let rng = &mut Rng::with_seed(seed);
        let dim = rng.usize(2..=3);
        let parts: Vec<Case> = (0..2)
            .map(|_| {
                let pairs = rng.usize(1..=3);
                let k = definite(rng, dim * pairs, 10.0);
                let law = mixed(rng, (dim, pairs), 0.2);
                let case = loaded(rng, dim, k, law);
                Case { slip: case.slip.or_else(|| Some(vec![0.0; (dim - 1) * pairs])), ..case }
            })
            .collect();
        let n: usize = parts.iter().map(Case::size).sum();
        let first = parts[0].size();
        let entry = |i: usize, j: usize| match (i < first, j < first) {
            (true, true) => parts[0].stiffness(i, j),
            (false, false) => parts[1].stiffness(i - first, j - first),
            _ => 0.0,
        };
        let both = |of: &dyn Fn(&Case) -> Vec<f64>| [of(&parts[0]), of(&parts[1])].concat();
        let whole = Case {
            dim,
            pairs: parts[0].pairs + parts[1].pairs,
            k: (0..n * n).map(|at| entry(at % n, at / n)).collect(),
            f: both(&|part| part.f.clone()),
            gap: both(&|part| part.gap.clone()),
            law: Law::ByPair(both(&|part| part.law.values().to_vec())),
            slip: Some(both(&|part| part.slip.clone().unwrap())),
        };
        let settings = Settings { tolerance: 1e-13, ..Settings::default() };
        let own: Vec<Solution> = parts.iter().map(|part| part.solve(&settings)).collect();
        let solution = whole.solve(&settings);
        if own.iter().chain([&solution]).any(|solution| solution.status != Status::Solved) {
            continue;
        }
        solved += 1;
        let expected = [&own[0].d[..], &own[1].d].concat();
        // Condition 10, and residuals of 1e-13 of forces of a few units, by axes up to 10 to 1.
        for (d, expected) in solution.d.iter().zip(&expected) {
            assert!((d - expected).abs() <= 1e-10, "seed {seed}: {d} {expected}");
        }
    }
    assert!(solved >= 98, "{solved} of 100");
}

/// What is wrong with the numbers of a pair is told with its law.
#[test]
fn wrong_numbers_are_named_with_their_pair_and_law() {
    for (dim, wrong, words) in [
        (
            2,
            [6.0, 0.0, 0.0, 0.0],
            "friction[4] (law of pair 1) is 6, it must be the number of a law: 0 (frictionless)",
        ),
        (2, [0.5, 0.0, 0.0, 0.0], "friction[4] (law of pair 1) is 0.5"),
        (2, [-1.0, 0.0, 0.0, 0.0], "friction[4] (law of pair 1) is -1"),
        (2, [f64::NAN, 0.0, 0.0, 0.0], "friction[4] (law of pair 1) is not finite"),
        (2, [1.0, -0.5, 0.0, 0.0], "friction[5] (mu of pair 1) is -0.5, it must not be negative"),
        (
            2,
            [1.0, 0.5, 0.0, 0.2],
            "friction[7] (p3 of pair 1) is 0.2, it must be 0: the pair has Coulomb's law: mu",
        ),
        (
            2,
            [0.0, 0.3, 0.0, 0.0],
            "friction[5] (p1 of pair 1) is 0.3, it must be 0: the pair has no friction",
        ),
        (2, [2.0, f64::INFINITY, 0.0, 0.0], "friction[5] (g of pair 1) is not finite"),
        (2, [3.0, 0.5, 0.1, 0.4], "friction[6] (b of pair 1) is 0.1, it must be at least mu a"),
        (2, [4.0, 0.5, 0.1, 0.4], "friction[4] (law of pair 1) is orthotropic, and dim is 2"),
        (3, [4.0, 0.5, 0.0, 0.4], "friction[6] (mu2 of pair 1) is 0, it must be positive"),
        (
            3,
            [5.0, 1e-7, 1.0, 0.4],
            "friction[5] (mu1 of pair 1) is 1e-7, and the other coefficient",
        ),
    ] {
        let numbers = [[1.0, 0.5, 0.0, 0.0], wrong].concat();
        let case = Case {
            dim,
            pairs: 2,
            k: (0..4 * dim * dim).map(|at| f64::from(u8::from(at % (2 * dim + 1) == 0))).collect(),
            f: vec![0.0; 2 * dim],
            gap: vec![0.0; 2],
            law: Law::ByPair(numbers),
            slip: None,
        };
        let error = ContactProblem::new(case.data()).expect_err(words);
        assert!(error.to_string().contains(words), "{error}\n{words}");
    }
    let few = FrictionLaw::ByPair(&[0.0; 7]);
    let case = Case {
        dim: 2,
        pairs: 2,
        k: definite(&mut Rng::with_seed(0), 4, 1.0),
        f: vec![0.0; 4],
        gap: vec![0.0; 2],
        law: Law::Coulomb(vec![0.0; 2]),
        slip: None,
    };
    let data = signorini::ContactData { law: few, ..case.data() };
    assert!(ContactProblem::new(data).expect_err("too few").to_string().contains("friction"));
}
