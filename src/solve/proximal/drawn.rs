//! Newton's method on the flexibility from points that are drawn.
//!
//! With Coulomb's friction and a singular `W` there may be several solutions, and forces that wedge: the problem is not
//! monotone, a path or springs from outside may run away past all of them, and no method but a search through the pieces
//! of the law is known to end. Near a solution Newton's method finds it, whatever the path does. A few pairs have few
//! pieces: so points are drawn on all pieces of the law, each as often, until Newton's method arrives from one. Half of
//! them are the point of the least lack so far, with two pairs drawn anew.

use super::on_flexibility::OnFlexibility;
use super::step::Means;
use crate::law::{Contact, Vector};
use crate::linalg::perturbation::Perturbation;
use crate::problem::Flexibility;
use crate::solve::result::{Ending, Solution, Status};

/// Most pairs, and most points that are drawn: pieces are four to the power of the pairs. Of problems with 1 to 8 pairs,
/// friction up to 50 and a solution 200 points leave 1 in 50, 500 leave 1 in 130, and 1000 next to none.
const MOST_PAIRS: usize = 16;
const MOST_POINTS: usize = 1000;

/// Pairs of the best point that are drawn anew.
const REDRAWN: usize = 2;

/// The solution of a problem, if points are found from which Newton's method arrives.
pub fn drawn(
    contact: &Contact<'_, Flexibility<'_>>,
    Means { settings, monitor, .. }: Means<'_>,
    force: &[f64],
) -> Option<Solution> {
    let laws = contact.pairs();
    if laws.len() > MOST_PAIRS || contact.is_frictionless() {
        return None;
    }
    let mut equations = OnFlexibility::new(contact, false, monitor);
    let size = equations.size();
    let mut random = Perturbation::new(0);
    let (mut best, mut least) = (equations.coordinates(force), f64::INFINITY);
    let (mut begin, mut systems): (Vec<Vector>, u64) = (best.clone(), 0);
    for _ in 0..MOST_POINTS {
        if monitor.is_late() {
            return None;
        }
        let mut found = equations.solve(begin, settings.tolerance);
        systems += found.systems;
        found.systems = systems;
        if found.ending == Ending::Done {
            let solution = found.solution(contact, settings);
            if solution.status == Status::Solved {
                return Some(solution);
            }
        }
        if let Ending::Stopped(_) = found.ending {
            return None;
        }
        if found.point.merit < least {
            (best, least) = (found.point.y, found.point.merit);
        }
        begin = match random.next() > 0.0 {
            true => laws.iter().map(|law| law.drawn(size, || random.next())).collect(),
            false => {
                let mut again = best.clone();
                for _ in 0..REDRAWN {
                    let pair = (random.next().abs() * laws.len() as f64) as usize;
                    again[pair] = laws[pair].drawn(size, || random.next());
                }
                again
            }
        };
    }
    None
}
