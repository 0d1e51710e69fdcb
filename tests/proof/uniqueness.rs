//! Reports about other solutions, against the enumeration of all states: 2D problems of up to
//! four pairs, where states do not meet.

use crate::common::dense::{difference, largest};
use crate::common::measures::{eta, rounding};
use crate::common::oracle::{Enumeration, Piece};
use crate::common::problems::{
    Case, Law, add_spring, block, contracting_case, coulomb, definite_case, floating_case,
    frictionless, tresca, vector,
};
use fastrand::Rng;
use signorini::{Method, Monitor, Search, Settings, Solution, Status, Uniqueness};

const TOLERANCE: f64 = 1e-10;

/// Friction up to 5, a definite stiffness of condition up to 1e6.
fn high_friction(seed: u64) -> Case {
    definite_case(&mut Rng::with_seed(seed), 6.0, |rng, pairs| coulomb(rng, pairs, 5.0))
}

fn solve(case: &Case, method: Method, search: Search, start: Option<&[f64]>) -> Solution {
    let settings = Settings { method, search, tolerance: TOLERANCE, ..Settings::default() };
    let mut monitor = Monitor::new(&settings, None);
    signorini::solve(&case.problem(), &settings, start, &mut monitor).unwrap()
}

/// The one enumerated solution that `d` is; `None` if its states are too close to tell, which the
/// certificate's tolerance and a condition of 1e6 allow.
fn identified<'e>(enumeration: &'e Enumeration, d: &[f64]) -> Option<&'e Piece> {
    match &enumeration.identify(d, TOLERANCE)[..] {
        [] => panic!("it is none of the solutions"),
        [only] => Some(only.piece),
        _ => None,
    }
}

/// Checks everything that a certified solution says about itself and others.
fn check(case: &Case, enumeration: &Enumeration, solution: &Solution) {
    let count = enumeration.solutions().count();
    match solution.uniqueness {
        Uniqueness::NotKnown => {}
        Uniqueness::Unique => assert_eq!(count, 1, "'unique'"),
        Uniqueness::Several => assert!(count > 1, "'several', but there is one"),
    }
    let piece = identified(enumeration, &solution.d);
    if let Some(piece) = piece
        && solution.orientation != 0
    {
        assert_eq!(solution.orientation, piece.orientation(), "orientation");
    }
    // Beside a solution of orientation -1 there are others, as all of them add up to +1.
    if solution.orientation == -1 {
        assert_eq!(solution.uniqueness, Uniqueness::Several, "orientation -1");
    }
    if let Some(second) = &solution.second {
        assert_eq!(solution.uniqueness, Uniqueness::Several, "there is a second");
        let residual = eta(case, &second.d);
        assert!(residual <= TOLERANCE + rounding(case, &second.d), "the second: {residual:e}");
        assert!(second.certificate.holds(TOLERANCE), "the second is not certified");
        let other = identified(enumeration, &second.d);
        if let (Some(piece), Some(other)) = (piece, other) {
            assert_ne!(piece.local, other.local, "the second is the first");
            if second.orientation != 0 {
                assert_eq!(second.orientation, other.orientation(), "orientation of the second");
            }
        }
    }
}

/// Checks with the problem and the answer in the message of a failure.
fn check_seed(seed: u64, case: &Case, enumeration: &Enumeration, solution: &Solution) {
    let checked = std::panic::AssertUnwindSafe(|| check(case, enumeration, solution));
    if let Err(cause) = std::panic::catch_unwind(checked) {
        println!("seed {seed}: {case:?}\n{solution:?}");
        std::panic::resume_unwind(cause);
    }
}

/// The degree of the natural map is that of the frictionless problem, +1, for every `mu`: `K`
/// definite leaves `d = 0` alone without loads. Each solution contributes the sign of its state's
/// determinant. (Cottle, Pang, Stone, *The Linear Complementarity Problem*, section 6.1.)
#[test]
fn orientations_of_all_solutions_add_up_to_one() {
    let (mut clear, mut several) = (0, 0);
    for seed in 0..3000 {
        let case = high_friction(seed);
        let enumeration = Enumeration::new(&case);
        if !enumeration.is_clear() {
            continue;
        }
        clear += 1;
        several += usize::from(enumeration.solutions().count() > 1);
        let sum: i32 = enumeration.solutions().map(|piece| i32::from(piece.orientation())).sum();
        assert_eq!(sum, 1, "seed {seed}: {case:?}");
    }
    // Ties are of measure zero but for the zeros that the loads draw; and there is something to add.
    assert!(clear > 2500 && several > 100, "{clear} clear problems, {several} of many solutions");
}

/// By every method that knows states, from rest and from elsewhere, with and without the search.
#[test]
fn what_is_said_about_other_solutions_is_true() {
    let mut proved = [0; 3];
    for seed in 0..1500 {
        let case = high_friction(seed);
        let enumeration = Enumeration::new(&case);
        if !enumeration.is_clear() {
            continue;
        }
        let start = vector(&mut Rng::with_seed(seed), case.size());
        for method in [Method::Auto, Method::Newton, Method::Lemke] {
            for search in [Search::Off, Search::Others] {
                for start in [None, Some(&start[..])] {
                    let solution = solve(&case, method, search, start);
                    if solution.status == Status::Solved {
                        check_seed(seed, &case, &enumeration, &solution);
                        proved[match solution.uniqueness {
                            Uniqueness::NotKnown => 0,
                            Uniqueness::Unique => 1,
                            Uniqueness::Several => 2,
                        }] += 1;
                        if method == Method::Newton {
                            assert_ne!(solution.orientation, 0, "seed {seed}: Newton knows it");
                        }
                    }
                }
            }
        }
    }
    println!("not known, unique, several: {proved:?}");
    assert!(proved[1] > 0 && proved[2] > 0, "nothing is ever proved: {proved:?}");
}

/// Where the nested iteration contracts (tests/solve/enumeration.rs) there is one solution, and this is
/// found out; without friction `K` alone tells.
#[test]
fn what_a_contraction_can_prove_is_proved() {
    for seed in 0..1500 {
        let mut rng = Rng::with_seed(seed);
        let case = contracting_case(&mut rng);
        let solution = solve(&case, Method::Auto, Search::Others, None);
        assert_eq!(solution.status, Status::Solved, "seed {seed}: {}", solution.message);
        assert_eq!(solution.uniqueness, Uniqueness::Unique, "seed {seed}: {case:?}");
        let case = Case { law: frictionless(case.pairs), ..case };
        let solution = solve(&case, Method::Auto, Search::Others, None);
        assert_eq!(solution.uniqueness, Uniqueness::Unique, "seed {seed}: {case:?}");
    }
}

/// Nine of ten problems that have several solutions are seen to have them, and a second one of
/// these is at hand.
#[test]
fn the_search_finds_a_second_solution_where_there_are_several() {
    let (mut several, mut found, mut shown) = (0, 0, 0);
    for seed in 0..3000 {
        let case = high_friction(seed);
        let enumeration = Enumeration::new(&case);
        if !enumeration.is_clear() || enumeration.solutions().count() < 3 {
            continue;
        }
        several += 1;
        let solution = solve(&case, Method::Auto, Search::Others, None);
        assert_eq!(solution.status, Status::Solved, "seed {seed}: {}", solution.message);
        found += usize::from(solution.uniqueness == Uniqueness::Several);
        shown += usize::from(solution.second.is_some());
    }
    println!("{several} problems of three or more solutions, {found} found, {shown} shown");
    assert!(several > 100);
    assert!(10 * found >= 9 * several, "{found} of {several} problems are found to have several");
    assert!(10 * shown >= 9 * several, "{shown} of {several} problems show a second solution");
}

/// Whole numbers, where states meet: pairs that stick without force, at the edge of the cone, touching
/// without pressure. Several states may then be one solution; what counts are displacements, which
/// differ by more than 1e-3 if at all (of matrices with whole entries up to 100, loads up to 2).
#[test]
fn rounding_does_not_make_two_solutions_of_one() {
    let (mut unique, mut several) = (0, 0);
    for seed in 0..4000 {
        let mut rng = Rng::with_seed(seed);
        let pairs = rng.usize(2..=4);
        let n = 2 * pairs;
        let mut k = if pairs > 2 { block(&mut rng, pairs) } else { vec![0.0; n * n] };
        for _ in 0..3 {
            let strain: Vec<f64> = (0..n).map(|_| f64::from(rng.i32(-1..=1))).collect();
            add_spring(&mut k, &strain, f64::from(rng.i32(1..=3)));
        }
        (0..n).for_each(|i| k[i * n + i] += 1.0);
        let whole = |rng: &mut Rng, most| f64::from(rng.i32(-1..=most));
        let case = Case {
            dim: 2,
            pairs,
            k,
            f: (0..n).map(|_| whole(&mut rng, 2)).collect(),
            gap: (0..pairs).map(|_| if rng.bool() { 0.0 } else { whole(&mut rng, 1) }).collect(),
            law: Law::Coulomb((0..pairs).map(|_| [0.0, 0.5, 1.0, 2.0][rng.usize(0..4)]).collect()),
            slip: rng.bool().then(|| (0..pairs).map(|_| whole(&mut rng, 1)).collect()),
        };
        let enumeration = Enumeration::new(&case);
        let candidates: Vec<_> = enumeration.solutions().map(Piece::candidate).collect();
        let differ = |a: &[f64], b: &[f64]| largest(&difference(a, b)) > 1e-6;
        let one = candidates.iter().all(|d| !differ(d, &candidates[0]));
        let flat = enumeration.solutions().any(|piece| piece.orientation() == 0);
        let solution = solve(&case, Method::Auto, Search::Others, None);
        let context = || format!("seed {seed}: {candidates:?}\n{case:?}\n{solution:?}");
        assert_eq!(solution.status, Status::Solved, "{}", context());
        match solution.uniqueness {
            Uniqueness::NotKnown => {}
            Uniqueness::Unique => assert!(one && !flat, "{}", context()),
            Uniqueness::Several => assert!(!one || flat, "{}", context()),
        }
        if let Some(second) = &solution.second {
            assert!(differ(&second.d, &solution.d), "{}", context());
        }
        unique += usize::from(solution.uniqueness == Uniqueness::Unique);
        several += usize::from(solution.uniqueness == Uniqueness::Several);
    }
    println!("{unique} unique, {several} several");
    assert!(unique > 100 && several > 10, "{unique} unique, {several} several");
}

/// With given thresholds, or none, a definite `K` makes the energy strictly convex: its minimum is
/// the only solution.
#[test]
fn convex_problems_never_have_several() {
    for seed in 0..1000 {
        let mut rng = Rng::with_seed(seed);
        let case = definite_case(&mut rng, 6.0, |rng, pairs| match rng.bool() {
            true => tresca(rng, pairs),
            false => frictionless(pairs),
        });
        let solution = solve(&case, Method::Auto, Search::Others, None);
        assert_eq!(solution.status, Status::Solved, "seed {seed}: {}", solution.message);
        assert_ne!(solution.uniqueness, Uniqueness::Several, "seed {seed}: {case:?}");
        assert!(solution.second.is_none(), "seed {seed}: {case:?}");
    }
}

/// A body that only contact holds may have a whole line of solutions (singular equations that are
/// consistent): then it is not unique. The sum of orientations proves nothing here.
#[test]
fn what_is_said_about_floating_bodies_is_true() {
    for seed in 0..1500 {
        let mut rng = Rng::with_seed(seed);
        let most = if seed % 2 == 0 { 0.3 } else { 5.0 };
        let case = floating_case(&mut rng, 4.0, |rng, pairs| coulomb(rng, pairs, most));
        let enumeration = Enumeration::new(&case);
        if enumeration.pieces.iter().any(|piece| piece.margin.abs() <= 1e-7) {
            continue;
        }
        let line = enumeration.solutions().any(|piece| piece.orientation() == 0);
        let count = enumeration.solutions().count();
        for search in [Search::Off, Search::Others] {
            let solution = solve(&case, Method::Auto, search, None);
            if solution.status != Status::Solved {
                assert_eq!(solution.uniqueness, Uniqueness::NotKnown, "seed {seed}: {solution:?}");
                continue;
            }
            let context = || format!("seed {seed}, {count} solutions: {case:?}\n{solution:?}");
            match solution.uniqueness {
                Uniqueness::NotKnown => {}
                Uniqueness::Unique => assert!(count == 1 && !line, "{}", context()),
                Uniqueness::Several => assert!(count > 1 || line, "{}", context()),
            }
            if let Some(second) = &solution.second {
                let residual = eta(&case, &second.d);
                assert!(residual <= TOLERANCE + rounding(&case, &second.d), "{}", context());
            }
        }
    }
}

/// Springs between neighbours and to the ground, normal components apart from tangential ones: the eigenvalues of
/// both are `2 + s - 2 cos(k pi / (n + 1))`. With a uniform `mu` and constant diagonals the bound is
/// `mu < 1 / sqrt(|K_nn| |W_tt|)`, which is found to a per cent for more pairs than Lanczos' method has directions.
#[test]
fn a_long_chain_is_proved_unique_up_to_its_bound() {
    let (pairs, ground) = (100, 0.5);
    let n = 2 * pairs;
    let mut k = vec![0.0; n * n];
    for pair in 0..pairs {
        for i in [2 * pair, 2 * pair + 1] {
            k[i + n * i] = 2.0 + ground;
            if pair > 0 {
                (k[i + n * (i - 2)], k[i - 2 + n * i]) = (-1.0, -1.0);
            }
        }
    }
    let cosine = (std::f64::consts::PI / (pairs + 1) as f64).cos();
    let (stiffest, softest) = (2.0 + ground + 2.0 * cosine, 2.0 + ground - 2.0 * cosine);
    let bound = (softest / stiffest).sqrt();
    for (mu, unique) in [(0.99 * bound, true), (1.01 * bound, false)] {
        let case = Case {
            dim: 2,
            pairs,
            k: k.clone(),
            f: [1.0, 0.1].repeat(pairs),
            gap: vec![0.0; pairs],
            law: Law::Coulomb(vec![mu; pairs]),
            slip: None,
        };
        let solution = solve(&case, Method::Auto, Search::Others, None);
        assert_eq!(solution.status, Status::Solved, "{}", solution.message);
        assert_eq!(solution.uniqueness == Uniqueness::Unique, unique, "mu {mu}");
    }
}
