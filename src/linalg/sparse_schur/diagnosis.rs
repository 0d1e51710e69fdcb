//! A factorisation that names the motion which makes it fail.

use super::factor_progress::{FactorProgress, Failure};
use super::numeric::{Numeric, factorised};
use super::schedule::Schedule;
use super::solve;
use super::structure::Structure;
use crate::linalg::sparse_matrix::{Csc, scale_diagonal, symmetric_magnitude, symmetric_times};
use crate::linalg::tolerances::{
    INVERSE_ITERATIONS, NULL_VECTOR, REGULARISATION, SUSPICIOUS_PIVOT,
};
use crate::linalg::vector::{norm_inf, normalise, sizes};
use crate::linalg::watched::GoesOn;

/// Factorises `matrix`, which stays as it is, to the values of the panels and the rest; or says what motion of the eliminated rows nothing resists, and
/// leaves it with a larger diagonal.
pub fn diagnosed(
    parts: (&Structure, &Schedule),
    matrix: &mut Csc,
    progress: &mut FactorProgress<'_>,
) -> Result<(Vec<f64>, Numeric), Failure> {
    let (structure, mut values, mut singular) = (parts.0, Vec::new(), false);
    let numeric = loop {
        match factorised(parts, matrix, &mut values, progress) {
            Ok(numeric) => break numeric,
            Err(Failure::Indefinite(row)) if is_unresisted(matrix, row) => {
                return Err(Failure::NullVector(unit_vector(matrix.ncols(), row)));
            }
            Err(Failure::Indefinite(_)) if !singular => singular = true,
            Err(failure) => return Err(failure),
        }
        (0..structure.eliminated).for_each(|j| scale_diagonal(matrix, j, 1.0 + REGULARISATION));
    };
    if let Some((place, pivot)) = numeric.weakest
        && (singular || pivot < SUSPICIOUS_PIVOT)
    {
        let goes_on = &mut || progress(1.0).is_ok();
        let Some(vector) = weakest_motion(structure, &values, place, goes_on) else {
            return Err(Failure::Stopped);
        };
        if singular || resistance(matrix, &vector) <= NULL_VECTOR {
            return Err(Failure::NullVector(vector));
        }
    }
    Ok((values, numeric))
}

/// The motion of the eliminated rows that `A` resists least, its largest entry 1, by inverse iteration from the unit
/// vector of a `place`; `None` where `goes_on` says no.
fn weakest_motion(
    structure: &Structure,
    values: &[f64],
    place: usize,
    goes_on: GoesOn<'_>,
) -> Option<Vec<f64>> {
    let mut x = unit_vector(structure.size, place);
    for _ in 0..INVERSE_ITERATIONS {
        solve::forward(structure, values, &mut x, goes_on)?;
        x[structure.eliminated..].fill(0.0);
        solve::backward(structure, values, &mut x, goes_on)?;
        normalise(&mut x);
    }
    Some(structure.unordered(&x))
}

/// Largest entry of `A x`, relative to the largest sum of the sizes of its terms. `A` is symmetric, its
/// `lower` triangle given.
fn resistance(lower: &Csc, x: &[f64]) -> f64 {
    norm_inf(&symmetric_times(lower, x)) / norm_inf(&symmetric_magnitude(lower, &sizes(x)))
}

/// `true` if nothing resists the motion of a row alone: its entries are zero.
fn is_unresisted(lower: &Csc, row: usize) -> bool {
    let own_column = symmetric_times(lower, &unit_vector(lower.ncols(), row));
    norm_inf(&own_column) == 0.0
}

fn unit_vector(size: usize, place: usize) -> Vec<f64> {
    let mut unit = vec![0.0; size];
    unit[place] = 1.0;
    unit
}
