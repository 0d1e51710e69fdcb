//! A body that the host itself has condensed on its contact nodes, on an obstacle: `d = u`.

use super::{Reduction, motion};
use crate::error::{Argument, Error, Message};
use crate::linalg::free_motions::{Doubt, Whole, settle};
use crate::linalg::matrix::Matrix;
use crate::linalg::tolerances::CONDENSATION;
use crate::linalg::vector::first_not_finite;
use crate::problem::symmetric_matrix::{check, is_symmetric_beside};

/// The host's condensed stiffness, taken as it is.
pub struct CondensedReduction {
    dim: usize,
    /// Components of `d`.
    size: usize,
    stiffness: Vec<f64>,
}

impl CondensedReduction {
    /// Keeps the stiffness, checked, with `dim` rows for each pair, and without what rounding has made of
    /// free motions.
    ///
    /// # Errors
    /// As [`settled`].
    pub(crate) fn new(dim: usize, matrix: &Matrix<'_>) -> Result<Self, Error> {
        let stiffness = settled(dim, matrix, "K", Argument::Matrix)?;
        Ok(CondensedReduction { dim, size: matrix.size(), stiffness })
    }
}

/// A host's condensed matrix, contiguous, checked, and exact on the motions that are free up to the rounding
/// of its condensation. `name` is the host's name of the matrix.
///
/// # Errors
/// As `check`; a motion of negative energy, and one whose energy cannot be told from rounding.
pub(super) fn settled(
    dim: usize,
    matrix: &Matrix<'_>,
    name: &str,
    argument: Argument,
) -> Result<Vec<f64>, Error> {
    let size = matrix.size();
    let given: Vec<f64> = (0..size).flat_map(|j| matrix.column(j).iter().copied()).collect();
    let mut stiffness = given.clone();
    let otherwise = matrix.largest_diagonal();
    let units: Vec<f64> = (0..size).map(|i| matrix.unit_of_group(i, dim, otherwise)).collect();
    let root: Vec<f64> = units.iter().map(|unit| unit.sqrt()).collect();
    let is_sound = first_not_finite(&given).is_none()
        && units.iter().all(|&unit| unit > 0.0)
        && is_symmetric_beside(matrix, &root);
    // What is not sound the check names.
    if is_sound {
        let given = Given { matrix: Matrix::new(size, &given, size.max(1)), units: &units };
        settle(&mut stiffness, &units, &given).map_err(|doubt| {
            let (what, moves) = match doubt {
                Doubt::Indefinite(moves) => (INDEFINITE, moves),
                Doubt::Unclear(moves) => (UNCLEAR, moves),
            };
            let moves = motion::of_pairs(dim, &moves);
            Error::invalid(argument, format!("{name} {what}: it moves {moves}"))
        })?;
    }
    check(&Matrix::new(size, &stiffness, size.max(1)), name, argument)?;
    Ok(stiffness)
}

const INDEFINITE: &str = "is not positive semi-definite: the energy of a motion is negative";

const UNCLEAR: &str = "resists a motion so little that its stiffness cannot be told from the rounding of \
     a condensation; support the motion, or hand over the whole sparse matrix";

/// A matrix of which nothing was eliminated here.
struct Given<'k> {
    matrix: Matrix<'k>,
    units: &'k [f64],
}

impl Whole for Given<'_> {
    fn extended(&self, kept: &[f64]) -> Vec<f64> {
        kept.to_vec()
    }

    fn forces(&self, motion: &[f64]) -> Vec<f64> {
        self.matrix.product(motion)
    }

    fn noise(&self, motion: &[f64]) -> f64 {
        CONDENSATION * self.units.iter().zip(motion).map(|(unit, x)| unit * x * x).sum::<f64>()
    }
}

impl Reduction for CondensedReduction {
    fn stiffness(&self) -> &[f64] {
        &self.stiffness
    }

    fn host_size(&self) -> usize {
        self.size
    }

    fn condense(&self, load: &[f64], _prescribed: Option<&[f64]>) -> Vec<f64> {
        load.to_vec()
    }

    fn recover(&self, _load: Option<&[f64]>, _prescribed: Option<&[f64]>, d: &[f64]) -> Vec<f64> {
        d.to_vec()
    }

    fn nodal_forces(&self, force: &[f64]) -> Vec<f64> {
        force.to_vec()
    }

    fn motion_in_words(&self, d: &[f64]) -> Message {
        motion::of_pairs(self.dim, d).into()
    }
}
