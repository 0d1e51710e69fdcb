//! The default: choose, check, fall back.

use super::solution::{Solution, certified};
use crate::error::Error;
use crate::monitor::Monitor;
use crate::problem::ContactProblem;
use crate::settings::{Method, Settings};

/// Solves by the first method whose result is certified.
pub fn solve(
    problem: &ContactProblem<'_>,
    settings: &Settings,
    start: Option<&[f64]>,
    monitor: &mut Monitor<'_>,
) -> Result<Solution, Error> {
    let method = Method::SorNested;
    let candidate = super::run(method, problem, settings, start, monitor)?;
    Ok(certified(problem, settings, method, candidate))
}
