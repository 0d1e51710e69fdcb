//! Obstacles that nothing can reach are left out, and the result is certified with them.
//!
//! Methods may close any pair on their way: beside `K gap` of a gap of 1e8 displacements the loads lose
//! half of their digits, and of 1e16 all. Without the obstacle the pair is open, as it is in the solution.
//! If it is not, the certificate on the host's own gaps says so, and the obstacles that the displacements
//! come near are put back.

use super::auto;
use super::dispatch::{check_method, run};
use super::table::{Call, chosen};
use crate::certificate::measure_parts;
use crate::error::Error;
use crate::law::{Contact, gaps_within_reach};
use crate::monitor::Monitor;
use crate::settings::{Method, Settings};
use crate::solve::result::{Solution, Status, Uniqueness, certified};

/// How many times longer than the displacements that can be expected a gap must be to be left out. Weak
/// structures move a million times as far as a load moves its own component alone, and a gap of that length
/// costs no method the digits that a result must have.
pub const FAR: f64 = 1e6;

/// Factors where no method has solved the problem as it is: any obstacle may spoil it.
const FAR_OF_UNSOLVED: [f64; 2] = [1e3, 1e1];

/// Most solutions without far obstacles: each that is refused tells which ones to put back, and weak
/// structures in which that goes on are solved with all of them.
const ROUNDS: usize = 3;

/// Solves by the method that is chosen, if it fits, or by the default.
pub fn solve(
    contact: &Contact<'_>,
    settings: &Settings,
    start: Option<&[f64]>,
    monitor: &mut Monitor<'_>,
) -> Result<Solution, Error> {
    check_method(contact, settings.method)?;
    if let Some(solution) = without_obstacles(FAR, contact, settings, start, monitor)? {
        return Ok(solution);
    }
    let solution = by_method(contact, settings, start, monitor)?;
    if solution.status == Status::Stalled && settings.method == Method::Auto {
        for far in FAR_OF_UNSOLVED {
            let other = without_obstacles(far, contact, settings, start, monitor)?;
            if let Some(other) = other.filter(|other| other.status == Status::Solved) {
                return Ok(other);
            }
        }
    }
    Ok(solution)
}

/// Solves without the obstacles that are `far` away; `None` if there are none, or if they matter.
fn without_obstacles(
    far: f64,
    contact: &Contact<'_>,
    settings: &Settings,
    start: Option<&[f64]>,
    monitor: &mut Monitor<'_>,
) -> Result<Option<Solution>, Error> {
    let mut moved = Vec::new();
    for _ in 0..ROUNDS {
        let Some(gaps) = gaps_within_reach(contact, &moved, far) else { break };
        let problem = contact.problem().with_gaps(&gaps);
        let solution = by_method(&Contact::new(&problem), settings, start, monitor)?;
        match solution.status {
            Status::Solved => match on_all_obstacles(contact, settings, solution) {
                Ok(solution) => return Ok(Some(solution)),
                Err(refused) => moved = refused,
            },
            // The motion may end at an obstacle that was left out.
            Status::NoEquilibrium | Status::Stalled => break,
            Status::IterationLimit | Status::TimeLimit | Status::Cancelled => {
                let certificate = measure_parts(contact, &solution.d, &solution.d_low);
                return Ok(Some(Solution { certificate, ..solution }));
            }
        }
    }
    Ok(None)
}

fn by_method(
    contact: &Contact<'_>,
    settings: &Settings,
    start: Option<&[f64]>,
    monitor: &mut Monitor<'_>,
) -> Result<Solution, Error> {
    match settings.method {
        Method::Auto => auto::solve(contact, settings, start, monitor),
        method => {
            let row = chosen(contact, method).expect("checked before");
            let candidate = run(row, &Call { contact, settings, start }, monitor)?;
            let candidate = candidate.expect("a method that can be chosen has a candidate");
            Ok(certified(contact, settings, method, &candidate))
        }
    }
}

/// A solution without far obstacles, certified with them. `Err`: its displacements, if it is none.
fn on_all_obstacles(
    contact: &Contact<'_>,
    settings: &Settings,
    mut solution: Solution,
) -> Result<Solution, Vec<f64>> {
    let certificate =
        |d: &[f64], low: &[f64]| measure_parts(contact, d, low).with_rounding(settings.tolerance);
    let own = certificate(&solution.d, &solution.d_low);
    if !own.holds(settings.tolerance) {
        return Err(solution.d);
    }
    solution.certificate = own;
    if let Some(second) = solution.second.as_mut() {
        second.certificate = certificate(&second.d, &second.d_low);
        if !second.certificate.holds(settings.tolerance) {
            solution.second = None;
            solution.uniqueness = Uniqueness::NotKnown;
        }
    }
    Ok(solution)
}
