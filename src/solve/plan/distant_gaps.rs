//! Obstacles that nothing can reach are left out, and the result is certified with them.
//!
//! Methods may close any pair on their way: beside `K gap` of a gap of 1e8 displacements the loads lose
//! half of their digits, and of 1e16 all. Without the obstacle the pair is open, as it is in the solution.
//! If it is not, the certificate on the host's own gaps says so, and the obstacles that the displacements
//! come near are put back.

use super::auto;
use super::table::{MethodRow, chosen};
use super::ties::without_ties;
use crate::certificate::measure;
use crate::error::Error;
use crate::law::{Contact, gaps_within_reach};
use crate::solve::result::{Call, Solution, Status, certified};

/// How many times longer than the displacements that can be expected a gap must be to be left out. Weak
/// structures move a million times as far as a load moves its own component alone, and a gap of that length
/// costs no method the digits that a result must have.
pub const FAR: f64 = 1e6;

/// Factors where no method has solved the problem as it is: any obstacle may spoil it.
const FAR_OF_UNSOLVED: [f64; 2] = [1e3, 1e1];

/// Most solutions without far obstacles: each that is refused tells which ones to put back, and weak
/// structures in which that goes on are solved with all of them.
const ROUNDS: usize = 3;

/// Solves by the method that is chosen, if it fits, or by the default; ties are taken out before.
pub fn solve(call: &Call<'_>) -> Result<Solution, Error> {
    without_ties(call, untied).unwrap_or_else(|| untied(call))
}

/// Solves a problem of which no pair is tied.
fn untied(call: &Call<'_>) -> Result<Solution, Error> {
    let row = chosen(call.contact, call.settings.method)?;
    if let Some(found) = without_obstacles(FAR, row, call) {
        return found;
    }
    let mut found = by_method(row, call);
    if row.is_none()
        && let Ok(solution) = &mut found
        && solution.status == Status::Stalled
    {
        solve_nearer(call, solution)?;
    }
    found
}

/// Solves without obstacles that are less far away where `found` is no solution.
#[inline(never)]
fn solve_nearer(call: &Call<'_>, found: &mut Solution) -> Result<(), Error> {
    for far in FAR_OF_UNSOLVED {
        let other = without_obstacles(far, None, call).transpose()?;
        if let Some(other) = other.filter(|other| other.status == Status::Solved) {
            *found = other;
            break;
        }
    }
    Ok(())
}

/// Solves without the obstacles that are `far` away; `None` if there are none, or if they matter.
#[inline(never)] // results are large, and what solves needs the stack
fn without_obstacles(
    far: f64,
    row: Option<&MethodRow>,
    call: &Call<'_>,
) -> Option<Result<Solution, Error>> {
    let contact = call.contact;
    let mut moved = Vec::new();
    for _ in 0..ROUNDS {
        let Some(gaps) = gaps_within_reach(contact, &moved, far) else { break };
        let problem = contact.problem().with_gaps(&gaps);
        let near = Call { contact: &Contact::new(&problem), ..*call };
        let solution = match by_method(row, &near) {
            Ok(solution) => solution,
            failed => return Some(failed),
        };
        match solution.status {
            Status::Solved => match on_all_obstacles(call, solution) {
                Ok(solution) => return Some(Ok(solution)),
                Err(refused) => moved = refused,
            },
            // The motion may end at an obstacle that was left out.
            Status::NoEquilibrium | Status::Stalled => break,
            Status::IterationLimit | Status::TimeLimit | Status::Cancelled => {
                let certificate = measure(contact, (&solution.d, &solution.d_low), &[]);
                return Some(Ok(Solution { certificate, ..solution }));
            }
        }
    }
    None
}

/// Solves by the method of a row, or by the default.
fn by_method(row: Option<&MethodRow>, call: &Call<'_>) -> Result<Solution, Error> {
    let Some(row) = row else {
        return auto::solve(call);
    };
    let candidate = row.candidate(call)?;
    let candidate = candidate.expect("a method that can be chosen has a candidate");
    Ok(certified(call, row.method, candidate))
}

/// A solution without far obstacles, certified with them. `Err`: its displacements, if it is none.
fn on_all_obstacles(call: &Call<'_>, mut solution: Solution) -> Result<Solution, Vec<f64>> {
    let (contact, tolerance) = (call.contact, call.settings.tolerance);
    let certificate =
        |d: &[f64], low: &[f64]| measure(contact, (d, low), &[]).with_rounding(tolerance);
    solution.certificate = certificate(&solution.d, &solution.d_low);
    if !solution.certificate.holds(tolerance) {
        return Err(solution.d);
    }
    solution.change_second(tolerance, |second| {
        second.certificate = certificate(&second.d, &second.d_low);
    });
    Ok(solution)
}
