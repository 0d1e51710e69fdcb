//! Calls on a dense `W` of so many rows that the callback is asked in the middle of a factorisation.

use crate::common::flexible::Case;
use signorini::{FlexibilityProblem, Monitor, Progress, Settings, Status, solve_flexibility};
use std::ops::ControlFlow;

/// Each pair stands twice, so that `W` is singular, and is pushed into its obstacle and along it.
fn pairs_twice(pairs: usize) -> Case {
    let n = 4 * pairs;
    let entry = |at: usize| if at / n % (n / 2) == at % n % (n / 2) { 1.0 } else { 0.0 };
    Case::new(2, (0..n * n).map(entry).collect(), [0.4, 0.1].repeat(2 * pairs), 0.5)
}

#[test]
fn a_call_that_is_cancelled_anywhere_says_nothing_false() {
    // The callback is asked between blocks of columns from 512 rows on.
    let case = pairs_twice(130);
    let problem = FlexibilityProblem::from_flexibility(case.data()).expect("valid data");
    let settings = Settings::default();
    for last in 1.. {
        let mut calls = 0;
        let mut cancel = |_: &Progress| {
            calls += 1;
            if calls < last { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        };
        let monitor = &mut Monitor::new(&settings, Some(&mut cancel));
        let solution = solve_flexibility(&problem, &settings, None, monitor);
        let solution = solution.unwrap_or_else(|error| panic!("call {last}: {error}"));
        if calls < last {
            assert_eq!(solution.status, Status::Solved, "{}", solution.message);
            // A factor of W, one with springs, and the inverse of that in blocks.
            assert!(last > 20, "{last} calls are too few to have been asked between blocks");
            return;
        }
        // Forces that are a solution already are one of a cancelled call too.
        let is_sound = matches!(solution.status, Status::Cancelled | Status::Solved);
        assert!(is_sound, "call {last}: {}", solution.message);
    }
}
