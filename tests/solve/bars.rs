//! The bar on the plane (paper, section 4.1) and the same with its upper side fixed, at any friction.

use crate::bar::{Condensed, Top, bar_with_top};
use crate::common::dense::{Elimination, norm, product};
use crate::common::measures::{eta, force, rounding};
use crate::common::problems::{Case, Law};
use signorini::{Fallback, Method, Search, Settings, Solution, Status, Uniqueness};

const COEFFICIENTS: [f64; 8] = [0.1, 0.3, 1.0, 2.0, 3.0, 5.0, 10.0, 20.0];
const SIDE: f64 = 10.0;

fn case(bar: &Condensed, mu: f64) -> Case {
    Case {
        dim: 2,
        pairs: bar.pairs,
        k: bar.stiffness.clone(),
        f: bar.load.clone(),
        gap: vec![0.0; bar.pairs],
        law: Law::Coulomb(vec![mu; bar.pairs]),
        slip: None,
    }
}

/// Ten rows of elements, fine towards the contact.
fn bar(pairs: usize, top: Top) -> Condensed {
    bar_with_top(pairs - 1, 10, 1.5, SIDE, top)
}

fn solve(case: &Case, method: Method) -> Solution {
    case.solve(&Settings { method, ..Settings::default() })
}

/// Measured here, by the law; and in sum the plane carries what presses on the upper side, 5 on 40
/// (nothing else holds the pressed bar up): to 1e-8, as the residual is 1e-10 of all forces, and
/// the largest sum of 514 of them is 23 times as large as their norm.
fn assert_right(case: &Case, solution: &Solution, top: Top, context: &str) {
    assert_eq!(solution.status, Status::Solved, "{context}: {}", solution.message);
    let residual = eta(case, &solution.d);
    assert!(residual <= 1e-10 + rounding(case, &solution.d), "{context}: {residual:e}");
    if top == Top::Pressed {
        for force in [&solution.certificate.force, &force(case, &solution.d)] {
            let carried: f64 = force.iter().step_by(2).sum();
            assert!((carried + 200.0).abs() <= 1e-8 * 200.0, "{context}: {carried}");
        }
    }
}

#[test]
fn auto_solves_the_pressed_bar_at_any_friction() {
    for pairs in [33, 65, 129, 257] {
        let bar = bar(pairs, Top::Pressed);
        for mu in COEFFICIENTS {
            let case = case(&bar, mu);
            let solution = solve(&case, Method::Auto);
            let context = format!("{pairs} pairs, mu {mu}");
            println!("{context}: {:?} {}", solution.fallback, solution.iterations);
            assert_right(&case, &solution, Top::Pressed, &context);
        }
    }
}

/// The upper side fixed and moved towards the plane by up to what the pressure would move it,
/// 5 * 40 / 13000: with little friction it slips, with much it wedges, and Newton's method may repeat
/// itself. Then the default says so, and solves it.
#[test]
fn auto_solves_the_clamped_bar_where_newton_cycles() {
    let mut cycles = 0;
    for pairs in [33, 64, 129, 257] {
        for down in [0.001, 0.005, 0.0154] {
            let top = Top::Clamped(down);
            let bar = bar(pairs, top);
            for mu in [1.0, 10.0, 20.0] {
                let case = case(&bar, mu);
                let context = format!("{pairs} pairs, mu {mu}, down {down}");
                let newton = solve(&case, Method::Newton);
                let auto = solve(&case, Method::Auto);
                assert_right(&case, &auto, top, &context);
                if newton.status == Status::Solved {
                    assert_right(&case, &newton, top, &context);
                    continue;
                }
                println!("{context}: {}, then {:?}", newton.message, auto.fallback);
                // It was tried first, and ended as it does alone.
                let (first, reason) = auto.fallback.expect(&context);
                assert_eq!(first, Method::Newton, "{context}");
                assert_eq!(newton.status, Status::Stalled, "{context}: {}", newton.message);
                let repeats = newton.message.contains("cycle");
                assert_eq!(reason == Fallback::Cycle, repeats, "{context}: {}", newton.message);
                cycles += usize::from(repeats);
            }
        }
    }
    println!("{cycles} cycles");
    assert!(cycles > 0, "nothing here is hard for Newton's method");
}

/// `mu < 1 / sqrt(|K_nn| |(K⁻¹)_tt|)` leaves one solution (tests/solve/enumeration.rs), and the search says
/// so; norms by the power method, 10 % below to be sure of them.
#[test]
fn the_clamped_bar_is_unique_below_the_bound_of_the_contraction() {
    for pairs in [9, 33, 65] {
        let bar = bar(pairs, Top::Clamped(0.005));
        let inverse = Elimination::new(2 * pairs, &bar.stiffness);
        let part = |x: &[f64], odd: usize| -> Vec<f64> {
            let kept = |(i, x): (usize, &f64)| if i % 2 == odd { *x } else { 0.0 };
            x.iter().enumerate().map(kept).collect()
        };
        let norm_of = |times: &dyn Fn(&[f64]) -> Vec<f64>, odd: usize| {
            let mut x: Vec<f64> = (0..2 * pairs).map(|i| 1.0 + (i * i % 7) as f64).collect();
            let mut size = 0.0;
            for _ in 0..200 {
                x = part(&times(&part(&x, odd)), odd);
                size = norm(&x);
                x.iter_mut().for_each(|x| *x /= size);
            }
            size
        };
        let normal = norm_of(&|x| product(&bar.stiffness, x), 0);
        let tangential = norm_of(&|x| inverse.solve(x).0, 1);
        let bound = 1.0 / (normal * tangential).sqrt();
        let case = case(&bar, 0.9 * bound);
        let settings = Settings { search: Search::Others, ..Settings::default() };
        let solution = case.solve(&settings);
        let context = format!("{pairs} pairs, bound {bound}");
        assert_right(&case, &solution, Top::Clamped(0.005), &context);
        assert_eq!(solution.uniqueness, Uniqueness::Unique, "{context}");
    }
}

/// The states settle from the edges of the zones inwards, which takes one system more each time the
/// mesh is refined: at most 12 at 513 pairs.
#[test]
fn newton_takes_at_most_12_systems_on_the_pressed_bar() {
    for pairs in [33, 65, 129, 257, 513] {
        let bar = bar(pairs, Top::Pressed);
        for mu in [0.1, 0.3, 1.0] {
            let case = case(&bar, mu);
            let solution = solve(&case, Method::Newton);
            let context = format!("{pairs} pairs, mu {mu}");
            println!("{context}: {} systems", solution.iterations);
            assert_right(&case, &solution, Top::Pressed, &context);
            assert!(solution.iterations <= 12, "{context}: {}", solution.iterations);
        }
    }
}
