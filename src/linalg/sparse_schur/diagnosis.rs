//! A factorisation that names the motion which makes it fail.

use super::factor_progress::FactorProgress;
use super::failure::Failure;
use super::numeric::{Numeric, Unfinished, factorised};
use super::plan::Plan;
use super::solve;
use super::structure::Structure;
use crate::linalg::null_vector::{resistance, weakest};
use crate::linalg::sparse_matrix::Csc;
use crate::linalg::tolerances::{NULL_VECTOR, REGULARISATION, SUSPICIOUS_PIVOT};
use crate::workers::Workers;

/// Factorises `matrix`, which stays as it is; or says what motion of the eliminated rows nothing resists, and
/// leaves it with a larger diagonal.
pub fn diagnosed(
    plan: &Plan,
    matrix: &mut Csc,
    workers: &dyn Workers,
    progress: &mut dyn FactorProgress,
) -> Result<Numeric, Failure> {
    let structure = &plan.structure;
    let parts = (structure, &plan.schedule);
    let (numeric, singular) = match factorised(parts, matrix, workers, progress) {
        Ok(numeric) => (numeric, false),
        Err(Unfinished::Failed(failure)) => return Err(failure),
        Err(Unfinished::Pivot(_)) => {
            (0..structure.eliminated).for_each(|j| scale_diagonal(matrix, j, 1.0 + REGULARISATION));
            match factorised(parts, matrix, workers, progress) {
                Ok(numeric) => (numeric, true),
                Err(Unfinished::Failed(failure)) => return Err(failure),
                Err(Unfinished::Pivot(place)) => {
                    return Err(Failure::Indefinite(structure.order[place]));
                }
            }
        }
    };
    if let Some((place, pivot)) = numeric.weakest
        && (singular || pivot < SUSPICIOUS_PIVOT)
    {
        let vector = weakest_motion(structure, &numeric.values, place);
        if singular || resistance(matrix, &vector) <= NULL_VECTOR {
            return Err(Failure::NullVector(vector));
        }
    }
    Ok(numeric)
}

/// The motion of the eliminated rows that `A` resists least, by inverse iteration from a `place`.
fn weakest_motion(structure: &Structure, values: &[f64], place: usize) -> Vec<f64> {
    let ordered = weakest(structure.size, place, |x| {
        solve::forward(structure, values, x);
        x[structure.eliminated..].fill(0.0);
        solve::backward(structure, values, x);
    });
    structure.unordered(&ordered)
}

/// Multiplies the diagonal entry of column `j`, which is stored first.
fn scale_diagonal(matrix: &mut Csc, j: usize, factor: f64) {
    let place = matrix.symbolic().col_ptr()[j];
    matrix.val_mut()[place] *= factor;
}
