//! The load cases of a call, parted for its threads.

use std::ops::Range;

use super::status::SIGNORINI_STATUS_OUT_OF_MEMORY;
use crate::error::{Error, Message};
use crate::model::{LoadCase, Series, Starts};
use crate::monitor::ProgressFn;
use crate::settings::Settings;
use crate::solve::Solution;
use crate::workers::Workers;

/// Load cases that one thread solves, one after the other.
pub(super) struct Lane<'m> {
    pub(super) left: Range<usize>,
    pub(super) series: Series<'m>,
}

/// A solution, or a wrong case; or the status of a thread that has ended without one.
pub(super) type Solved = Result<Result<Solution, Error>, i32>;

/// What a thread says that has ended without solutions.
pub(super) fn stopped(code: i32) -> (i32, Message) {
    let message = match code {
        SIGNORINI_STATUS_OUT_OF_MEMORY => "not enough memory for a further thread",
        _ => "internal error on a further thread",
    };
    (code, message.into())
}

/// Some cases in a row, with their starts.
pub(super) struct Work<'a> {
    pub(super) begin: usize,
    pub(super) cases: Vec<LoadCase<'a>>,
    pub(super) start: Start,
}

/// Where cases start.
pub(super) enum Start {
    Cold,
    Given(Vec<f64>),
    Previous,
}

impl Work<'_> {
    /// Solves them as the next ones of a series; `workers` share what is factorised in full space.
    pub(super) fn solve(
        &self,
        series: &mut Series<'_>,
        workers: &dyn Workers,
        settings: &Settings,
        progress: Option<&mut ProgressFn<'_>>,
    ) -> Vec<Result<Solution, Error>> {
        let starts = match &self.start {
            Start::Cold => Starts::Cold,
            Start::Given(given) => Starts::Given(given),
            Start::Previous => Starts::Previous(None),
        };
        series.solve_cases_with(workers, &self.cases, settings, starts, progress)
    }
}

#[cfg(test)]
mod tests {
    use super::super::status::SIGNORINI_STATUS_INTERNAL;
    use super::*;

    /// The status that a thread ended with is told, and the sentence fits it.
    #[test]
    fn a_thread_that_ends_says_why() {
        for (code, word) in
            [(SIGNORINI_STATUS_OUT_OF_MEMORY, "memory"), (SIGNORINI_STATUS_INTERNAL, "internal")]
        {
            let (told, message) = stopped(code);
            assert_eq!(told, code);
            assert!(message.contains(word), "{message:?}");
        }
    }
}
