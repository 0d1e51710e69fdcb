//! Load cases of a call, in chunks for its threads.

use std::ops::Range;

use crate::error::{Error, Message};
use crate::ffi::status::SIGNORINI_STATUS_OUT_OF_MEMORY;
use crate::model::{LoadCase, Series, Starts};
use crate::monitor::ProgressFn;
use crate::settings::Settings;
use crate::solve::Solution;
use crate::workers::Workers;

/// Load cases that one thread solves, one after the other.
pub(in crate::ffi) struct ThreadCases<'m> {
    pub(in crate::ffi) left: Range<usize>,
    pub(in crate::ffi) series: Series<'m>,
}

/// A solution, or a wrong case; or the status of a thread that has ended without one.
pub(in crate::ffi) type Solved = Result<Result<Solution, Error>, i32>;

/// The status and the message of a thread that has ended without solutions.
pub(in crate::ffi) fn stopped(code: i32) -> (i32, Message) {
    let message = match code {
        SIGNORINI_STATUS_OUT_OF_MEMORY => "not enough memory for a further thread",
        _ => "internal error on a further thread",
    };
    (code, message.into())
}

/// Load cases in a row, with their starts.
pub(in crate::ffi) struct LoadCaseChunk<'a> {
    pub(in crate::ffi) begin: usize,
    pub(in crate::ffi) cases: Vec<LoadCase<'a>>,
    pub(in crate::ffi) start: Start,
}

/// Where cases start.
pub(in crate::ffi) enum Start {
    Cold,
    Given(Vec<f64>),
    Previous,
}

impl LoadCaseChunk<'_> {
    /// Solves them as the next ones of a series; `workers` share what is factorised in full space.
    pub(in crate::ffi) fn solve(
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
    use super::*;
    use crate::ffi::status::SIGNORINI_STATUS_INTERNAL;

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
