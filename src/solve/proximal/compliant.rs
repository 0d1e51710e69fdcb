//! The stiffness of bodies and springs in series, `(W + e D⁻¹)⁻¹`.

use super::rounds::{InSeries, RANGE, changed};
use crate::linalg::factor::{Factor, cholesky_work};
use crate::linalg::tolerances::SINGULAR;
use crate::monitor::{Stop, Watch};
use crate::problem::{Flexibility, Relation};

/// Bodies of a flexibility, with the springs of some rounds.
pub struct Springs<'p> {
    relation: &'p Flexibility<'p>,
    compliance: f64,
    stiffness: Vec<f64>,
    monitor: &'p dyn Watch,
}

impl<'p> Springs<'p> {
    /// Springs of a compliance; `None` if `W` has negative eigenvalues. `Err`: there is no time for them.
    pub fn new(
        relation: &'p Flexibility<'p>,
        compliance: f64,
        monitor: &'p dyn Watch,
    ) -> Result<Option<Self>, Stop> {
        let stiffness = stiffness(relation, compliance, monitor)?;
        Ok(stiffness.map(|stiffness| Springs { relation, compliance, stiffness, monitor }))
    }
}

impl InSeries for Springs<'_> {
    fn compliance(&self) -> f64 {
        self.compliance
    }

    fn displacements(&self, force: &[f64]) -> Vec<f64> {
        self.relation.relative(force)
    }

    fn stiffness(&self) -> &[f64] {
        &self.stiffness
    }

    fn load(&mut self, force: &[f64]) -> Vec<f64> {
        force.iter().map(|force| -force).collect()
    }

    fn change(&mut self, softer: bool) {
        let compliance = changed(self.compliance, softer, RANGE[1]);
        // Where there is no time for others these stay.
        if compliance != self.compliance
            && let Ok(Some(stiffness)) = stiffness(self.relation, compliance, self.monitor)
        {
            (self.compliance, self.stiffness) = (compliance, stiffness);
        }
    }

    fn are_softest(&self) -> bool {
        self.compliance >= RANGE[1]
    }
}

/// Beside flexibilities of size one: of an eigenvalue below `-NEGATIVE` the rounding of `W` is not the reason, which
/// is of the order of its size times `2e-16`.
const NEGATIVE: f64 = 1e-9;

/// Least pivot of a `W` that is told from a singular one, beside the largest. Forces are then known to the tolerance over
/// it.
pub const DEFINITE: f64 = 1e-6;

/// True if `W` is definite; if there is no time to see it, it is not.
pub fn is_definite(relation: &Flexibility<'_>, monitor: &dyn Watch) -> bool {
    matches!(factor(relation, (0.0, DEFINITE), monitor), Ok(Some(_)))
}

/// True if `W` has an eigenvalue below zero that is not due to rounding; if there is no time to see it, it has not.
pub fn is_indefinite(relation: &Flexibility<'_>, monitor: &dyn Watch) -> bool {
    matches!(factor(relation, (NEGATIVE, SINGULAR), monitor), Ok(None))
}

/// The factor of the scaled `D^½ W D^½ + e`; `None` if there is none. `Err`: there is no time for it, or it was stopped.
fn factor(
    relation: &Flexibility<'_>,
    (compliance, least): (f64, f64),
    monitor: &dyn Watch,
) -> Result<Option<Factor>, Stop> {
    let n = relation.size();
    let root = roots(relation);
    let matrix = relation.matrix();
    monitor.affords(cholesky_work(n))?;
    let fill = |j: usize, column: &mut [f64]| {
        for i in j..n {
            column[i] = root[i] * matrix.at(i, j) * root[j];
        }
        column[j] += compliance;
    };
    let factor = Factor::new(n, true, least, fill, &mut monitor.asking());
    match monitor.stop() {
        Some(stop) if factor.is_none() => Err(stop),
        _ => Ok(factor),
    }
}

/// `D^½`.
fn roots(relation: &Flexibility<'_>) -> Vec<f64> {
    relation.units().iter().map(|unit| unit.sqrt()).collect()
}

/// The inverse of the scaled `D^½ W D^½ + e`, scaled back; `None` if there is none. `Err`: there is no time for it.
pub fn stiffness(
    relation: &Flexibility<'_>,
    compliance: f64,
    monitor: &dyn Watch,
) -> Result<Option<Vec<f64>>, Stop> {
    let n = relation.size();
    let root = roots(relation);
    let Some(factor) = factor(relation, (compliance, SINGULAR), monitor)? else {
        return Ok(None);
    };
    let mut inverse = factor.inverse(|operations| monitor.affords(operations))?;
    for (column, root_of_column) in inverse.chunks_exact_mut(n.max(1)).zip(&root) {
        column.iter_mut().zip(&root).for_each(|(entry, root)| *entry *= root * root_of_column);
    }
    Ok(inverse.iter().all(|entry| entry.is_finite()).then_some(inverse))
}
