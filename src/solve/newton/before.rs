//! Load steps in space: a solution brought to the loads of the next problem with the same matrix, by the factors that it has
//! left.
//!
//! A factor belongs to slip directions. Where they turn by an angle from one load step to the next, a step with the factor
//! of the solution before leaves about that part of the lack of equilibrium: a few such chord steps find all digits, each
//! for a solve. The pairs that were eliminated as open ones must stay open, and the result is measured on the whole
//! problem. Where it is none, the problem is solved from there as one that follows no other.

use std::sync::Arc;

use super::ended::Ended;
use super::iteration;
use crate::linalg::elimination::Elimination;
use crate::problem::Remembered;
use crate::solve::part::ReducedProblem;
use crate::solve::pieces::Equations;
use crate::solve::result::{Call, Ending};

/// The elimination of open pairs that a problem leaves for the next one with its matrix.
pub struct Kept {
    pub elimination: Arc<Elimination>,
    /// The memory that the problem on the candidates has left for itself.
    pub of_candidates: Remembered,
}

/// Where steps with the factors of the problem before lead from its solution, whose displacements are `start`; `Done` if
/// that is a solution. `None`: they lead nowhere. Of what is remembered an elimination stays.
pub fn again(call: &Call<'_>, whole: &Equations<'_>, start: &[f64]) -> Option<Ended> {
    let remembered = whole.remembered?;
    if !remembered.is::<Kept>() {
        return iteration::solve_again(call, whole, start);
    }
    let Kept { elimination, of_candidates } = remembered.take()?;
    let reduced = ReducedProblem::by_elimination(whole, &elimination)?;
    let part = Equations { remembered: Some(&of_candidates), ..reduced.equations() };
    let found = again(call, &part, &reduced.restrict(start));
    drop(part);
    let found = found.map(|found| {
        let (d, force, y) = reduced.whole_from(&found.d, &found.y);
        let is_solved = found.ending == Ending::Done
            && reduced.closing(&y).is_empty()
            && whole.eta(&d, &force) <= call.settings.tolerance;
        let ending = if is_solved { Ending::Done } else { iteration::FAR };
        Ended { d, force, y, ending, ..found }
    });
    drop(reduced);
    remembered.leave(Kept { elimination, of_candidates });
    found
}
