//! A callback that cancels anywhere in a call: it is not asked again, and nothing false is said.

use std::ops::ControlFlow;

use crate::common::problems::{Case, Law};
use signorini::{
    Existence, Method, Monitor, Progress, Search, Settings, Solution, Status, Uniqueness, solve,
};

/// Pairs in the plane: their 560 components are factorised by blocks, between which the callback is asked.
const PAIRS: usize = 280;

/// A row of pairs, each tied to its neighbours and to the ground, over waves: open, stuck and sliding to both sides.
fn waves(mu: f64) -> Case {
    let n = 2 * PAIRS;
    let mut k = vec![0.0; n * n];
    for i in 0..n {
        k[i + n * i] = 4.0;
        for j in [i + 1, i + 2].into_iter().filter(|&j| j < n) {
            (k[i + n * j], k[j + n * i]) = (-0.9, -0.9);
        }
    }
    let wave = |pair: usize, rate: f64| (rate * pair as f64).sin();
    Case {
        dim: 2,
        pairs: PAIRS,
        k,
        f: (0..PAIRS).flat_map(|pair| [wave(pair, 0.21), 0.3 * wave(pair, 0.13)]).collect(),
        gap: (0..PAIRS).map(|pair| 0.1 * wave(pair, 0.34)).collect(),
        law: Law::Coulomb(vec![mu; PAIRS]),
        slip: None,
    }
}

/// Solves with a callback that cancels when it is asked for the `last` time; returns how often it was asked.
fn cancelled(case: &Case, settings: &Settings, last: u64) -> (Solution, u64) {
    let mut asked = 0;
    let mut cancel = |_: &Progress| {
        asked += 1;
        if asked < last { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    };
    let monitor = &mut Monitor::new(settings, Some(&mut cancel));
    let solution = solve(&case.problem(), settings, None, monitor).expect("settings that fit");
    (solution, asked)
}

/// With every method, the search for other solutions and the proof: whenever the callback cancels, it is asked no more, what
/// is called solved is a solution, and what is not known is left open.
#[test]
fn a_call_that_is_cancelled_anywhere_says_nothing_false() {
    for (method, mu) in [
        (Method::Auto, 0.0),
        (Method::Auto, 0.3),
        (Method::SorNested, 0.3),
        (Method::Lemke, 0.3),
        (Method::BlockPivoting, 0.0),
        (Method::Newton, 0.3),
        (Method::Path, 0.3),
    ] {
        let case = waves(mu);
        let settings =
            Settings { method, search: Search::Others, proof: true, ..Settings::default() };
        let (whole, all) = cancelled(&case, &settings, u64::MAX);
        assert_eq!(whole.status, Status::Solved, "{method:?}: {}", whole.message);
        // Each time the callback is asked is one place; of many some are tried.
        for last in (1..=all).step_by(1 + all as usize / 30) {
            let (solution, asked) = cancelled(&case, &settings, last);
            let at = format!("{method:?}, mu {mu}, {last} of {all}: {}", solution.message);
            assert_eq!(asked, last, "{at}");
            match solution.status {
                Status::Cancelled => assert!(solution.second.is_none(), "{at}"),
                Status::Solved => assert!(solution.certificate.eta <= settings.tolerance, "{at}"),
                _ => panic!("{at}"),
            }
            let known = [Uniqueness::NotKnown, whole.uniqueness];
            assert!(known.contains(&solution.uniqueness), "{at}");
            let is_proved =
                |solution: &Solution| matches!(solution.existence, Existence::Proved(_));
            assert!(is_proved(&whole) || !is_proved(&solution), "{at}");
        }
    }
}

/// The proof asks between blocks of 64 columns: of pairs that are all open in two factorisations, and where some slide in a
/// factorisation, the inverse and a product.
#[test]
fn a_proof_is_asked_between_blocks() {
    for every in [None, Some(20)] {
        let mut case = waves(0.1);
        for pair in 0..PAIRS {
            let slides = every.is_some_and(|every| pair % every == 0);
            case.gap[pair] = if slides { -0.5 } else { 10.0 };
            case.f[2 * pair + 1] = 3.0;
        }
        let settings = Settings::default();
        let (_, without) = cancelled(&case, &settings, u64::MAX);
        let (solution, with) = cancelled(&case, &Settings { proof: true, ..settings }, u64::MAX);
        assert!(matches!(solution.existence, Existence::Proved(_)), "{}", solution.message);
        let blocks = 2 * PAIRS as u64 / 64;
        assert!(with >= without + 2 * blocks, "{without}, {with}");
    }
}

/// A row of pairs that a stiff bar ties, so that displacements are refined behind Newton's method: a callback that cancels there has
/// cancelled, whatever time is left.
#[test]
fn a_call_that_is_cancelled_while_it_refines_is_no_matter_of_time() {
    for stiff in (5..=8).map(|exponent| 10_f64.powi(exponent)) {
        let mut case = waves(0.3);
        let n = 2 * PAIRS;
        let along = |i: usize| (0.7 * i as f64).cos();
        for (j, column) in case.k.chunks_exact_mut(n).enumerate() {
            let ties = column.iter_mut().enumerate();
            ties.for_each(|(i, entry)| *entry += stiff * along(i) * along(j));
        }
        let settings = Settings { tolerance: 1e-12, ..Settings::default() };
        let (_, all) = cancelled(&case, &settings, u64::MAX);
        for last in all.saturating_sub(12).max(1)..=all {
            let (solution, _) = cancelled(&case, &settings, last);
            let is_sound = matches!(solution.status, Status::Cancelled | Status::Solved);
            assert!(is_sound, "{stiff:e}, {last} of {all}: {}", solution.message);
        }
    }
}
