//! One pair with several solutions in closed form.
//!
//! Klarbring's pair: `K = [[2, 1], [1, 1]]`, `f = (1, F)`, gap 0. With `mu = 2` and `1 < F < 2` it
//! sticks at `(0, 0)`, slips to `(0, 2 - F)` under the pressure `F - 1`, or opens to
//! `(1 - F, 2 F - 1)`. Up to `mu = k_tt / |k_nt| = 1` there is one solution.
//! A. Klarbring, Ingenieur-Archiv 60 (1990) 529-541; the values follow from the law.

use crate::common::dense::{difference, largest};
use crate::common::measures::eta;
use crate::common::problems::{Case, Law};
use signorini::{Fallback, Method, Monitor, Search, Settings, Solution, Status, Uniqueness};

const METHODS: [Method; 3] = [Method::Auto, Method::Newton, Method::Lemke];
const TANGENTIAL: [f64; 3] = [1.1, 1.5, 1.9];

fn pair(f: [f64; 2], gap: f64, mu: f64, slip: f64) -> Case {
    let k = vec![2.0, 1.0, 1.0, 1.0];
    let law = Law::Coulomb(vec![mu]);
    Case { dim: 2, pairs: 1, k, f: f.to_vec(), gap: vec![gap], law, slip: Some(vec![slip]) }
}

fn klarbring(tangential: f64, mu: f64) -> Case {
    pair([1.0, tangential], 0.0, mu, 0.0)
}

/// Stick, slip, open.
fn three(tangential: f64) -> [[f64; 2]; 3] {
    [[0.0, 0.0], [0.0, 2.0 - tangential], [1.0 - tangential, 2.0 * tangential - 1.0]]
}

fn solve(case: &Case, method: Method, search: Search, start: Option<[f64; 2]>) -> Solution {
    let settings = Settings { method, search, ..Settings::default() };
    let mut monitor = Monitor::new(&settings, None);
    let start = start.as_ref().map(|d| &d[..]);
    let solution = signorini::solve(&case.problem(), &settings, start, &mut monitor).unwrap();
    assert_eq!(solution.status, Status::Solved, "{}", solution.message);
    assert!(eta(case, &solution.d) <= 1.1e-10, "{solution:?}");
    solution
}

/// Which of these displacements `d` is, to 1e-9: `eta <= 1e-10`, and the inverse of each state's
/// equations is no larger than 30.
fn which(candidates: &[[f64; 2]], d: &[f64]) -> Option<usize> {
    candidates.iter().position(|candidate| largest(&difference(candidate, d)) <= 1e-9)
}

#[test]
fn two_different_ones_of_the_three_are_returned() {
    for tangential in TANGENTIAL {
        let known = three(tangential);
        for method in METHODS {
            for start in known.map(Some).into_iter().chain([None]) {
                let case = klarbring(tangential, 2.0);
                let solution = solve(&case, method, Search::Others, start);
                assert_eq!(solution.uniqueness, Uniqueness::Several, "{solution:?}");
                let first = which(&known, &solution.d).expect("one of the three");
                let second = solution.second.as_ref().expect("a second one");
                assert!(eta(&case, &second.d) <= 1.1e-10, "{solution:?}");
                let other = which(&known, &second.d).expect("another of the three");
                assert_ne!(first, other, "{solution:?}");
                // Determinants: stick 1 (nothing is free), slip k_tt - mu k_nt = -1, open det K.
                let expected = [1, -1, 1];
                for (orientation, which) in
                    [(solution.orientation, first), (second.orientation, other)]
                {
                    assert!(orientation == 0 || orientation == expected[which], "{solution:?}");
                }
            }
        }
    }
}

/// Newton's method ends where it starts if that is a solution. Where there is one of orientation -1
/// there are others, search or not.
#[test]
fn newton_says_of_the_sliding_solution_that_there_are_others() {
    for tangential in TANGENTIAL {
        let known = three(tangential);
        let case = klarbring(tangential, 2.0);
        for search in [Search::Off, Search::Others] {
            let solution = solve(&case, Method::Newton, search, Some(known[1]));
            assert_eq!(which(&known, &solution.d), Some(1), "{solution:?}");
            assert_eq!(solution.orientation, -1);
            assert_eq!(solution.uniqueness, Uniqueness::Several);
            for stable in [0, 2] {
                let solution = solve(&case, Method::Newton, search, Some(known[stable]));
                assert_eq!(which(&known, &solution.d), Some(stable), "{solution:?}");
                assert_eq!(solution.orientation, 1);
            }
        }
    }
}

/// The default does not end at an unstable solution, even if it starts there.
#[test]
fn auto_leaves_the_sliding_solution() {
    for tangential in TANGENTIAL {
        let known = three(tangential);
        let case = klarbring(tangential, 2.0);
        let solution = solve(&case, Method::Auto, Search::Off, Some(known[1]));
        assert!(matches!(which(&known, &solution.d), Some(0 | 2)), "{solution:?}");
        assert_eq!(solution.fallback, Some((Method::Newton, Fallback::Unstable)));
        assert_eq!(solution.orientation, 1);
        assert_eq!(solution.uniqueness, Uniqueness::Several);
    }
}

/// `mu sqrt(|K_nn| |W_tt|) < 1`, `W_tt` of the inverse, makes the map `p -> g -> p` a contraction:
/// here `2 mu < 1`. (The bound of tests/solve/enumeration.rs.)
#[test]
fn is_unique_below_the_bound_of_the_contraction() {
    for tangential in TANGENTIAL {
        for method in METHODS {
            let solution = solve(&klarbring(tangential, 0.4), method, Search::Others, None);
            assert_eq!(solution.uniqueness, Uniqueness::Unique, "{solution:?}");
            assert!(solution.second.is_none());
        }
    }
}

/// Below `mu = 1` every state's determinant is positive (`k_tt -+ mu k_nt`), and they add up to +1.
#[test]
fn is_never_called_one_of_several_where_it_is_the_only_one() {
    for tangential in TANGENTIAL {
        for mu in [0.5, 0.9, 0.99] {
            for method in METHODS {
                for search in [Search::Off, Search::Others] {
                    let solution = solve(&klarbring(tangential, mu), method, search, None);
                    assert_ne!(solution.uniqueness, Uniqueness::Several, "{solution:?}");
                    assert!(solution.second.is_none());
                    assert_eq!(solution.orientation.abs(), solution.orientation);
                }
            }
        }
    }
}

/// Without load, a pair that has slipped by -1 towards the obstacle may stay wedged there: sticking at
/// `(gap, -1)` it presses with `1 - 2 gap` and is dragged with `1 - gap`. So it does if and only if
/// `mu >= (1 - gap) / (1 - 2 gap)`, for gap 0 `k_tt / |k_nt|`. It may as well stick at `(0, 0)`,
/// and for a positive gap slip, to `gap (2 mu - 1) / (1 - mu)`.
#[test]
fn a_pair_stays_wedged_if_friction_is_high_enough() {
    for gap in [0.0, 0.1] {
        let wedged = [gap, -1.0];
        let least = (1.0 - gap) / (1.0 - 2.0 * gap);
        for mu in [0.5 * least, 0.99 * least, 1.01 * least, 2.0 * least] {
            let case = pair([0.0; 2], gap, mu, -1.0);
            let stays = mu > least;
            assert_eq!(eta(&case, &wedged) < 1e-15, stays, "the closed form, mu = {mu}");
            let solution = solve(&case, Method::Newton, Search::Off, Some(wedged));
            assert_eq!(which(&[[0.0; 2], wedged], &solution.d), Some(usize::from(stays)));
            if stays {
                // Nothing is free: the empty determinant.
                assert_eq!(solution.orientation, 1);
            } else {
                assert_ne!(solution.uniqueness, Uniqueness::Several, "{solution:?}");
            }
        }
    }
}

/// With a gap of 0.1 nothing of this is degenerate, and the search tells that there are three.
#[test]
fn the_search_sees_that_a_pair_may_be_wedged() {
    let (gap, mu): (f64, f64) = (0.1, 2.0);
    let known = [[0.0, 0.0], [gap, gap * (2.0 * mu - 1.0) / (1.0 - mu)], [gap, -1.0]];
    let case = pair([0.0; 2], gap, mu, -1.0);
    for d in known {
        assert!(eta(&case, &d) < 1e-15, "the closed form {d:?}");
    }
    for method in METHODS {
        for start in known.map(Some).into_iter().chain([None]) {
            let solution = solve(&case, method, Search::Others, start);
            assert_eq!(solution.uniqueness, Uniqueness::Several, "{solution:?}");
            let first = which(&known, &solution.d).expect("one of the three");
            let second = solution.second.as_ref().expect("a second one");
            let other = which(&known, &second.d).expect("another of the three");
            assert_ne!(first, other, "{solution:?}");
        }
    }
}
