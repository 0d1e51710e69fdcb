//! The path in space: from any start, several starts in turn.

use super::curve::Curve;
use super::homotopy::Homotopy;
use crate::counters::count;
use crate::law::Vector;
use crate::linalg::perturbation::Perturbation;
use crate::solve::newton::{Ended, newton_from, on_candidates, refine_to_tolerance};
use crate::solve::pieces::{Equations, Point};
use crate::solve::result::{Call, Candidate, Effort, Ending};
use crate::solve::rigid::{self, leave_idle_motion};

/// Size of the perturbation of a start beside the loads: symmetric meshes have ties, and on a generic
/// start no two pairs reach their boundaries at once.
pub const PERTURBATION: f64 = 1e-7;

/// How far from the predicted place a curve may be, relative to the step: first and where that has failed.
const DEVIATIONS: [f64; 2] = [0.3, 0.1];

/// Starts of a search for other solutions.
const SEARCHED: u64 = 10;

/// Solves a problem by following a path.
pub fn curved(call: &Call<'_>) -> Candidate {
    // Without an equilibrium the path runs away slowly: what can be proved at once is.
    if let Some(motion) = rigid::escape_behind_others(call) {
        return Candidate::without_displacements(call.contact, Ending::Recession(motion));
    }
    on_candidates(call, &mut |equations, (y, _)| from(call, equations, y))
}

/// Ends of paths from several starts, moved at random by all of the loads, and what Newton's method makes of the starts
/// themselves: where there are several solutions they may differ.
pub fn ends(call: &Call<'_>) -> Vec<Candidate> {
    let equations = Equations::of(call.contact);
    let none = vec![[0.0; 3]; call.contact.pairs().len()];
    let mut ends = Vec::new();
    for seed in 0..SEARCHED {
        if call.monitor.is_late() {
            break;
        }
        let start = perturbed(&equations, &none, 1.0, seed);
        let newton = newton_from(call, &equations, start.clone(), false);
        let path = follow(call, &equations, start, DEVIATIONS[1]);
        ends.extend([newton, path].into_iter().filter(|end| end.ending == Ending::Done));
    }
    ends.into_iter().map(Ended::into_candidate).collect()
}

/// Follows paths from `y`, and from other starts if one fails, to a solution of the equations.
fn from(call: &Call<'_>, equations: &Equations<'_>, y: Vec<Vector>) -> Ended {
    let mut systems = 0;
    let mut best: Option<Ended> = None;
    let none = vec![[0.0; 3]; y.len()];
    let [easy, careful] = DEVIATIONS;
    let starts = [(&y, easy), (&none, easy), (&y, careful)];
    for (attempt, (start, deviation)) in starts.into_iter().enumerate() {
        let start = perturbed(equations, start, PERTURBATION, attempt as u64);
        let ended = follow(call, equations, start, deviation);
        systems += ended.systems;
        // A path ends with the orientation of its beginning, +1: with another one it has changed curves.
        let settled = match ended.ending {
            Ending::Stopped(_) => true,
            _ => ended.orientation >= 0 && is_solution(call, equations, &ended),
        };
        count("path in space", attempt, settled);
        let eta = |ended: &Ended| equations.eta(&ended.d, &ended.force);
        if settled || best.as_ref().is_none_or(|best| eta(&ended) < eta(best)) {
            best = Some(ended);
        }
        if settled {
            break;
        }
    }
    let mut best = best.expect("there is a first attempt");
    best.systems = systems;
    best
}

/// True if the end of a path is a solution: by the certificate of the problem, or on a part of the pairs by the
/// residual of theirs; or Newton's method has come to the rounding of that part, and the rest is found on the whole.
fn is_solution(call: &Call<'_>, equations: &Equations<'_>, ended: &Ended) -> bool {
    let (contact, settings) = (call.contact, call.settings);
    let (d, force) = (&ended.d, &ended.force);
    if ended.ending == Ending::Done || equations.eta(d, force) <= settings.tolerance {
        return true;
    }
    if d.len() != contact.unknowns() {
        return false;
    }
    let mut candidate =
        Candidate::new(d.clone(), force.clone(), ended.ending.clone(), Effort::default());
    leave_idle_motion(call, &mut candidate);
    refine_to_tolerance(call, &mut candidate);
    candidate.is_settled(contact, settings.tolerance)
}

/// Follows one path from `start`; where it ends Newton's method brings the solution to its last digits.
fn follow(call: &Call<'_>, equations: &Equations<'_>, start: Vec<Vector>, deviation: f64) -> Ended {
    let homotopy = Homotopy::new(equations, &start);
    let mut curve = Curve::new(&homotopy, start, deviation, call.monitor);
    let mut ended = match curve.follow() {
        Ok(()) => newton_from(call, equations, curve.place.y.clone(), false),
        Err(ending) => Ended::at(Point::new(equations, curve.place.y.clone()), ending),
    };
    ended.systems += curve.systems;
    ended
}

/// A start, moved at random by a part of the loads.
fn perturbed(equations: &Equations<'_>, y: &[Vector], by: f64, seed: u64) -> Vec<Vector> {
    let dim = equations.dim;
    let size = Homotopy::new(equations, y).size / (equations.root.len() as f64).sqrt();
    let mut random = Perturbation::new(seed);
    let moved = |(at, y): (usize, &Vector)| {
        let mut y = *y;
        for (y, root) in y.iter_mut().zip(&equations.root[dim * at..dim * (at + 1)]) {
            *y += by * size * root * random.next();
        }
        y
    };
    y.iter().enumerate().map(moved).collect()
}
