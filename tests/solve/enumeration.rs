//! Every result of a solver is checked against exhaustive enumeration of contact states (2D, up to four
//! pairs): what is called solved is a solution, and where "no equilibrium" is proved there is none.

use crate::common::oracle::Enumeration;
use crate::common::problems::{
    Case, Law, cohesive, contracting_case, coulomb, definite_case, floating_case, frictionless,
    mixed, tresca, uniform,
};
use crate::common::verdict::{Verdict, run};
use fastrand::Rng;
use signorini::{Method, Settings};

fn settings(method: Method, max_iterations: u64) -> Settings {
    Settings { method, max_iterations, ..Settings::default() }
}

/// Klarbring's pair: `K = [[2, 1], [1, 1]]`, `f = (1, F)`. With `mu = 2` and `1 < F < 2` it sticks,
/// slips by `2 - F` under the pressure `F - 1`, or opens to `(1 - F, 2 F - 1)`; with `mu = 0.9`,
/// below `k_tt / |k_nt| = 1`, there is one solution.
/// A. Klarbring, Ingenieur-Archiv 60 (1990) 529-541; the values follow from the law.
#[test]
fn enumeration_finds_the_three_solutions_of_klarbrings_pair() {
    for tangential in [1.1, 1.5, 1.9] {
        let case = |mu| Case {
            dim: 2,
            pairs: 1,
            k: vec![2.0, 1.0, 1.0, 1.0],
            f: vec![1.0, tangential],
            gap: vec![0.0],
            law: Law::Coulomb(vec![mu]),
            slip: None,
        };
        let three = case(2.0);
        let enumeration = Enumeration::new(&three);
        assert_eq!(enumeration.solutions().count(), 3);
        for d in [[0.0, 0.0], [0.0, 2.0 - tangential], [1.0 - tangential, 2.0 * tangential - 1.0]] {
            assert_eq!(enumeration.identify(&d, 1e-14).len(), 1);
            let off = [d[0] - 1e-6, d[1] + 1e-6];
            assert!(enumeration.identify(&off, 1e-8).is_empty());
        }
        assert_eq!(Enumeration::new(&case(0.9)).solutions().count(), 1);
    }
}

/// Definite K: with given thresholds (none: frictionless) a strictly convex minimum has one
/// solution. Under Coulomb's law the number is odd unless states meet: the degree of the natural
/// map does not change when mu grows from 0, since `f = gap = slip = 0` leaves `d.K d = F.d <= 0`,
/// so `d = 0`.
#[test]
fn enumeration_counts_as_theory_does() {
    for seed in 0..3000 {
        let mut rng = Rng::with_seed(seed);
        let most = uniform(&mut rng, 0.0, 5.0);
        let case = definite_case(&mut rng, 6.0, |rng, pairs| coulomb(rng, pairs, most));
        let enumeration = Enumeration::new(&case);
        if enumeration.is_clear() {
            assert_eq!(enumeration.solutions().count() % 2, 1, "seed {seed}");
        }
        let law = tresca(&mut rng, case.pairs);
        for law in [law, frictionless(case.pairs)] {
            let case = Case { law, ..case.clone() };
            let enumeration = Enumeration::new(&case);
            if enumeration.is_clear() {
                assert_eq!(enumeration.solutions().count(), 1, "seed {seed}");
            }
        }
    }
}

/// Lemke's method decides every frictionless problem: K positive semi-definite makes M so, and
/// then a ray proves that nothing is feasible (Cottle, Pang, Stone, *The Linear
/// Complementarity Problem*, section 4.4).
#[test]
fn lemke_decides_definite_and_floating_frictionless_problems() {
    let lemke = settings(Method::Lemke, 1000);
    let definite = |rng: &mut Rng| definite_case(rng, 6.0, |_, pairs| frictionless(pairs));
    run(4000, lemke.clone(), definite, |verdict| verdict == Verdict::Solved);
    let floating = |rng: &mut Rng| floating_case(rng, 6.0, |_, pairs| frictionless(pairs));
    run(8000, lemke, floating, |verdict| !matches!(verdict, Verdict::Unsolved { .. }));
}

/// With given thresholds each step of SOR lowers a convex function: it converges for every
/// definite K. (A condition of 1e4 costs it up to 2e4 sweeps.)
#[test]
fn sor_solves_every_definite_problem_with_given_thresholds() {
    let make = |rng: &mut Rng| definite_case(rng, 4.0, tresca);
    run(3000, settings(Method::SorNested, 1_000_000), make, |verdict| verdict == Verdict::Solved);
}

/// As long as `mu sqrt(|K_nn| |(K⁻¹)_tt|) < 1` the nested iteration is a contraction (the energy of
/// a change of the thresholds `g` is at most `|dg| |d_t|`, and `F_n` follows with `sqrt |K_nn|`);
/// here the product is at most 0.9.
#[test]
fn nested_sor_solves_every_problem_in_which_it_contracts() {
    let settings = settings(Method::SorNested, 1_000_000);
    run(3000, settings, contracting_case, |verdict| verdict == Verdict::Solved);
}

/// Cohesion and tension beside friction of any size: Lemke's method solves every definite problem, as
/// its theorem says; Newton's is never wrong; and the default solves all.
#[test]
fn problems_with_cohesion_are_solved() {
    let definite = |rng: &mut Rng| definite_case(rng, 4.0, |rng, pairs| cohesive(rng, pairs, 3.0));
    let solved = |verdict| verdict == Verdict::Solved;
    run(2000, settings(Method::Lemke, 1000), definite, solved);
    run(2000, settings(Method::Auto, 20_000), definite, solved);
    run(2000, settings(Method::Newton, 1000), definite, |_| true);
    let little = |rng: &mut Rng| definite_case(rng, 2.0, |rng, pairs| cohesive(rng, pairs, 0.3));
    run(1000, settings(Method::SorNested, 200_000), little, solved);
}

/// A law of its own for each pair, friction of any size: as with cohesion, which all laws of the plane are cases of. In
/// bodies that only contact holds nothing is judged wrongly.
#[test]
fn problems_with_a_law_for_each_pair_are_solved() {
    let definite =
        |rng: &mut Rng| definite_case(rng, 4.0, |rng, pairs| mixed(rng, (2, pairs), 3.0));
    let solved = |verdict| verdict == Verdict::Solved;
    run(2000, settings(Method::Lemke, 1000), definite, solved);
    run(2000, settings(Method::Auto, 20_000), definite, solved);
    run(2000, settings(Method::Newton, 1000), definite, |_| true);
    let floating =
        |rng: &mut Rng| floating_case(rng, 4.0, |rng, pairs| mixed(rng, (2, pairs), 3.0));
    for method in [Method::Auto, Method::Lemke, Method::SorNested] {
        run(1500, settings(method, 2_000), floating, |_| true);
    }
}

/// Bodies that only contact holds, which tension may hold too, are never judged wrongly. With tension
/// alone, without friction, every problem is decided.
#[test]
fn floating_problems_with_cohesion_are_judged_rightly() {
    let floating = |rng: &mut Rng| floating_case(rng, 4.0, |rng, pairs| cohesive(rng, pairs, 3.0));
    for method in [Method::Auto, Method::Lemke, Method::SorNested] {
        run(1500, settings(method, 2_000), floating, |_| true);
    }
    let tension = |rng: &mut Rng, pairs: usize| {
        Law::Cohesive((0..pairs).flat_map(|_| [0.0, 0.0, rng.f64()]).collect())
    };
    let floating = |rng: &mut Rng| floating_case(rng, 4.0, tension);
    let decided = |verdict| !matches!(verdict, Verdict::Unsolved { .. });
    run(2000, settings(Method::Lemke, 1000), floating, decided);
    let definite = |rng: &mut Rng| definite_case(rng, 4.0, tension);
    run(2000, settings(Method::BlockPivoting, 1000), definite, |verdict| {
        verdict == Verdict::Solved
    });
}

/// Ordinary friction on ordinary stiffness (condition up to 100): the nested form solves all, the
/// diagonal one, for which there is no theory, all but 1 %.
#[test]
fn sor_solves_problems_of_ordinary_friction() {
    let make = |rng: &mut Rng| definite_case(rng, 2.0, |rng, pairs| coulomb(rng, pairs, 0.3));
    let solved = |verdict| verdict == Verdict::Solved;
    run(3000, settings(Method::SorNested, 200_000), make, solved);
    let unsolved = run(3000, settings(Method::SorDiagonal, 50_000), make, |_| true);
    assert!(unsolved <= 30, "{unsolved} of 3000");
}

/// Friction up to 5 on stiffness of condition up to 1e6, where there may be many solutions and
/// SOR may end without one: it is never wrong, and solves 90 % (nested) and 85 % (diagonal).
#[test]
fn sor_is_never_wrong_on_problems_of_high_friction() {
    let make = |rng: &mut Rng| definite_case(rng, 6.0, |rng, pairs| coulomb(rng, pairs, 5.0));
    for (method, allowed) in [(Method::SorNested, 300), (Method::SorDiagonal, 450)] {
        let unsolved = run(3000, settings(method, 20_000), make, |_| true);
        assert!(unsolved <= allowed, "{unsolved} of 3000 by {method:?}");
    }
}

/// Bodies that only contact holds, given thresholds: SOR finds an equilibrium where there is one,
/// and otherwise the rigid motion that proves the contrary, which convex duality promises.
#[test]
fn sor_decides_floating_problems_with_given_thresholds() {
    let make = |rng: &mut Rng| floating_case(rng, 2.0, tresca);
    let decided = |verdict| !matches!(verdict, Verdict::Unsolved { .. });
    run(2000, settings(Method::SorNested, 1_000_000), make, decided);
}

/// Bodies that only contact holds, little friction: the nested form finds an equilibrium where
/// there is one in all but 0.2 %, the diagonal one in all but 1 %; no theorem promises more. Where
/// there is none, both may give up.
#[test]
fn sor_solves_floating_problems_of_little_friction() {
    let make = |rng: &mut Rng| floating_case(rng, 2.0, |rng, pairs| coulomb(rng, pairs, 0.2));
    for (method, allowed) in [(Method::SorNested, 6), (Method::SorDiagonal, 30)] {
        let unsolved = run(3000, settings(method, 20_000), make, |_| true);
        assert!(unsolved <= allowed, "{unsolved} of 3000 by {method:?}");
    }
}

/// Bodies that only contact holds, friction up to 5, condition up to 1e6: never wrong.
#[test]
fn sor_is_never_wrong_on_floating_problems_of_high_friction() {
    let make = |rng: &mut Rng| floating_case(rng, 6.0, |rng, pairs| coulomb(rng, pairs, 5.0));
    for method in [Method::SorNested, Method::SorDiagonal] {
        run(3000, settings(method, 2_000), make, |_| true);
    }
}

/// No load at all, after a slip or before it: the answer may be that nothing touches and nothing
/// moves, and every force then is zero. From a start of zero and from others.
#[test]
fn unloaded_problems_are_solved() {
    let unloaded = |case: Case| Case { f: vec![0.0; case.size()], ..case };
    let solved = |verdict| verdict == Verdict::Solved;
    let make =
        |rng: &mut Rng| unloaded(definite_case(rng, 2.0, |rng, pairs| coulomb(rng, pairs, 0.3)));
    run(1000, settings(Method::SorNested, 20_000), make, solved);
    run(1000, settings(Method::SorDiagonal, 20_000), make, solved);
    let make = |rng: &mut Rng| unloaded(definite_case(rng, 2.0, tresca));
    run(1000, settings(Method::SorNested, 20_000), make, solved);
    // Without interference: a body that it pushes rests without force elsewhere, and no relative
    // measure tells such forces from rounding.
    let make = |rng: &mut Rng| {
        let mut case = unloaded(floating_case(rng, 2.0, |_, pairs| frictionless(pairs)));
        case.gap.iter_mut().for_each(|gap| *gap = gap.abs());
        case
    };
    run(1000, settings(Method::Lemke, 1000), make, solved);
}
