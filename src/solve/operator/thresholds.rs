//! Coulomb's law as a sequence of problems with given thresholds (paper, section 2.1, `g <- mu |F_n|`), each by
//! Newton's method, which has one solution to find then, and Newton's method for the law itself from where each of
//! them ends.

use super::newton::{self, Tried, improve};
use super::point::Equations;
use crate::law::Contact;
use crate::problem::MatrixFree;
use crate::solve::result::Ending;

/// Most problems with given thresholds.
const ROUNDS: usize = 4;

/// Tolerance of one: its solution is a start alone.
const ROUGH: f64 = 1e-3;

/// Goes on from a first try that has failed.
pub fn solve(tried: &mut Tried<'_, '_>) -> Result<(), Ending> {
    let Tried { equations, bodies, start, best } = tried;
    if !equations.contact.is_coupled() {
        return Ok(());
    }
    let mut point = equations.held_at(start.clone(), bodies)?;
    for _ in 0..ROUNDS {
        let mut contact: Contact<'_, MatrixFree<'_>> = equations.contact.clone();
        contact.set_thresholds(&contact.thresholds(&point.residual[equations.inner..]));
        let root = equations.root.clone();
        let given = Equations { contact: &contact, root, tolerance: ROUGH, ..**equations };
        let from = given.held_at(point.at, bodies)?;
        let between = newton::solve(&given, bodies, from)?;
        if let Ending::Stopped(stop) = between.ending {
            return Err(stop.into());
        }
        point = equations.held_at(between.point.at, bodies)?;
        if improve(best, newton::solve(equations, bodies, point.clone())?) {
            break;
        }
    }
    Ok(())
}
