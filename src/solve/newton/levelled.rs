//! Problems in space with pairs that are far stiffer along one tangent than along the other: on tangents along which they
//! are as stiff (`law::levelled`).

use super::candidates::{self, Core};
use crate::law::{LevelledTangents, references};
use crate::linalg::matrix::Matrix;
use crate::solve::result::{Call, Candidate, Ending};

/// Solves a problem in space on levelled tangents: what that finds, on the tangents of the problem. `None` where no pair needs
/// them, and where that fails.
pub fn solve(call: &Call<'_>, core: &mut Core<'_>) -> Option<Candidate> {
    let (contact, problem) = (call.contact, call.contact.problem());
    let of_pair = |(pair, law)| LevelledTangents::of(law, problem.tangential_block(pair));
    let tangents = || contact.pairs().iter().enumerate().map(of_pair);
    if !problem.is_symmetric() || tangents().all(|of_pair| of_pair.is_none()) {
        return None;
    }
    let tangents: Vec<Option<LevelledTangents>> = tangents().collect();
    let size = contact.unknowns();
    let matrix = congruent(problem.stiffness(), &tangents);
    let load = changed(problem.load(), &tangents, LevelledTangents::force);
    let slips: Vec<f64> = references(contact.pairs(), 3).collect();
    let slips = changed(&slips, &tangents, LevelledTangents::levelled);
    let slips: Vec<f64> =
        slips.chunks_exact(3).flat_map(|of_pair| &of_pair[1..]).copied().collect();
    let problem = problem.with_numbers(Matrix::new(size, &matrix, size), &load, Some(&slips));
    let levelled = contact.levelled(&problem, &tangents);
    let start = call.start.map(|start| changed(start, &tangents, LevelledTangents::levelled));
    let call = Call { contact: &levelled, start: start.as_deref(), ..*call };
    let found = candidates::solve(&call, core);
    let on_own = || {
        let d = changed(found.d(), &tangents, LevelledTangents::displacement);
        let mut candidate = Candidate::of_displacements(contact, d, Ending::Done);
        (candidate.effort, candidate.orientation) = (found.effort, found.orientation);
        candidate
    };
    (found.ending == Ending::Done).then(on_own)
}

/// A vector with the tangential parts of pairs changed.
fn changed(
    values: &[f64],
    tangents: &[Option<LevelledTangents>],
    change: impl Fn(&LevelledTangents, [f64; 2]) -> [f64; 2],
) -> Vec<f64> {
    let mut values = values.to_vec();
    for (own, tangents) in values.chunks_exact_mut(3).zip(tangents) {
        if let Some(tangents) = tangents {
            [own[1], own[2]] = change(tangents, [own[1], own[2]]);
        }
    }
    values
}

/// `K` on levelled tangents, column-major: forces of displacements along them.
fn congruent(matrix: Matrix<'_>, tangents: &[Option<LevelledTangents>]) -> Vec<f64> {
    let size = matrix.size();
    let column = |j| changed(matrix.column(j), tangents, LevelledTangents::force);
    let mut entries: Vec<f64> = (0..size).flat_map(column).collect();
    for (columns, tangents) in entries.chunks_exact_mut(3 * size).zip(tangents) {
        let Some(tangents) = tangents else { continue };
        let (first, second) = columns[size..].split_at_mut(size);
        for (first, second) in first.iter_mut().zip(second) {
            [*first, *second] = tangents.force([*first, *second]);
        }
    }
    entries
}
