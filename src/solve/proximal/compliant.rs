//! The stiffness of bodies and springs in series, `(W + e D⁻¹)⁻¹`.

use crate::linalg::factor::{Factor, cholesky_work};
use crate::linalg::tolerances::SINGULAR;
use crate::monitor::{Monitor, Stop};
use crate::problem::{Flexibility, Relation};

/// `e` of the first rounds, beside flexibilities of size one: the stiffness loses as many digits as `e` has.
const FIRST: f64 = 1e-4;

/// Least and largest `e`.
const RANGE: [f64; 2] = [1e-10, 1e-1];

/// By which `e` is changed.
const FACTOR: f64 = 0.1;

/// The springs of some rounds.
pub struct Springs {
    compliance: f64,
    stiffness: Vec<f64>,
}

impl Springs {
    /// The first springs; `None` if `W` has negative eigenvalues. `Err`: there is no time for them.
    pub fn new(
        relation: &Flexibility<'_>,
        monitor: &mut Monitor<'_>,
    ) -> Result<Option<Self>, Stop> {
        let stiffness = stiffness(relation, FIRST, monitor)?;
        Ok(stiffness.map(|stiffness| Springs { compliance: FIRST, stiffness }))
    }

    /// `e`.
    pub fn compliance(&self) -> f64 {
        self.compliance
    }

    /// `(W + e D⁻¹)⁻¹`, column-major.
    pub fn stiffness(&self) -> &[f64] {
        &self.stiffness
    }

    /// Less compliant springs, if there are any, and time for them.
    pub fn stiffen(&mut self, relation: &Flexibility<'_>, monitor: &mut Monitor<'_>) {
        self.change(relation, FACTOR, monitor);
    }

    /// More compliant springs, if there are any, and time for them.
    pub fn soften(&mut self, relation: &Flexibility<'_>, monitor: &mut Monitor<'_>) {
        self.change(relation, 1.0 / FACTOR, monitor);
    }

    /// True if there are no softer ones.
    pub fn are_softest(&self) -> bool {
        self.compliance >= RANGE[1]
    }

    fn change(&mut self, relation: &Flexibility<'_>, by: f64, monitor: &mut Monitor<'_>) {
        let compliance = (by * self.compliance).clamp(RANGE[0], RANGE[1]);
        if compliance != self.compliance
            && let Ok(Some(stiffness)) = stiffness(relation, compliance, monitor)
        {
            *self = Springs { compliance, stiffness };
        }
    }
}

/// Columns of the inverse that are solved for between two looks at the clock.
const BLOCK: usize = 64;

/// Beside flexibilities of size one: of an eigenvalue below `-NEGATIVE` the rounding of `W` is not the reason, which
/// is of the order of its size times `2e-16`.
const NEGATIVE: f64 = 1e-9;

/// Least pivot of a `W` that is told from a singular one, beside the largest. Forces are then known to the tolerance over
/// it.
const DEFINITE: f64 = 1e-6;

/// True if `W` is definite. `Err`: there is no time to see it.
pub fn is_definite(relation: &Flexibility<'_>, monitor: &mut Monitor<'_>) -> Result<bool, Stop> {
    Ok(factor(relation, (0.0, DEFINITE), monitor)?.is_some())
}

/// True if `W` has an eigenvalue below zero that is not due to rounding; if there is no time to see it, it has not.
pub fn is_indefinite(relation: &Flexibility<'_>, monitor: &mut Monitor<'_>) -> bool {
    matches!(factor(relation, (NEGATIVE, SINGULAR), monitor), Ok(None))
}

/// The factor of the scaled `D^½ W D^½ + e`; `None` if there is none. `Err`: there is no time for it.
fn factor(
    relation: &Flexibility<'_>,
    (compliance, least): (f64, f64),
    monitor: &mut Monitor<'_>,
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
    Ok(Factor::asked(n, true, least, fill, &mut monitor.asking()))
}

/// `D^½`.
fn roots(relation: &Flexibility<'_>) -> Vec<f64> {
    relation.units().iter().map(|unit| unit.sqrt()).collect()
}

/// The inverse of the scaled `D^½ W D^½ + e`, scaled back; `None` if there is none. `Err`: there is no time for it.
fn stiffness(
    relation: &Flexibility<'_>,
    compliance: f64,
    monitor: &mut Monitor<'_>,
) -> Result<Option<Vec<f64>>, Stop> {
    let n = relation.size();
    let root = roots(relation);
    let Some(mut factor) = factor(relation, (compliance, SINGULAR), monitor)? else {
        return Ok(None);
    };
    let mut inverse = vec![0.0; n * n];
    inverse.iter_mut().step_by(n + 1).for_each(|entry| *entry = 1.0);
    for columns in inverse.chunks_mut((BLOCK * n).max(1)) {
        monitor.affords(2.0 * (n * columns.len()) as f64)?;
        factor.solve(columns);
    }
    for j in 0..n {
        for i in j..n {
            let mean = 0.5 * (inverse[i + n * j] + inverse[j + n * i]);
            let scaled = root[i] * mean * root[j];
            (inverse[i + n * j], inverse[j + n * i]) = (scaled, scaled);
        }
    }
    Ok(inverse.iter().all(|entry| entry.is_finite()).then_some(inverse))
}
