//! The stiffness of bodies and springs in series, `(W + e D⁻¹)⁻¹`.

use crate::linalg::factor::Factor;
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
    /// The first springs; `None` if `W` has negative eigenvalues.
    pub fn new(relation: &Flexibility<'_>) -> Option<Self> {
        let stiffness = stiffness(relation, FIRST)?;
        Some(Springs { compliance: FIRST, stiffness })
    }

    /// `e`.
    pub fn compliance(&self) -> f64 {
        self.compliance
    }

    /// `(W + e D⁻¹)⁻¹`, column-major.
    pub fn stiffness(&self) -> &[f64] {
        &self.stiffness
    }

    /// Less compliant springs, if there are any.
    pub fn stiffen(&mut self, relation: &Flexibility<'_>) {
        self.change(relation, FACTOR);
    }

    /// More compliant springs, if there are any.
    pub fn soften(&mut self, relation: &Flexibility<'_>) {
        self.change(relation, 1.0 / FACTOR);
    }

    /// Whether there are no softer ones.
    pub fn are_softest(&self) -> bool {
        self.compliance >= RANGE[1]
    }

    fn change(&mut self, relation: &Flexibility<'_>, by: f64) {
        let compliance = (by * self.compliance).clamp(RANGE[0], RANGE[1]);
        if compliance != self.compliance
            && let Some(stiffness) = stiffness(relation, compliance)
        {
            *self = Springs { compliance, stiffness };
        }
    }
}

/// The inverse of the scaled `D^½ W D^½ + e`, scaled back.
fn stiffness(relation: &Flexibility<'_>, compliance: f64) -> Option<Vec<f64>> {
    let n = relation.size();
    let root: Vec<f64> = relation.units().iter().map(|unit| unit.sqrt()).collect();
    let matrix = relation.matrix();
    let mut factor = Factor::new(n, true, |j, column| {
        for i in j..n {
            column[i] = root[i] * matrix.at(i, j) * root[j];
        }
        column[j] += compliance;
    })?;
    let mut inverse = vec![0.0; n * n];
    inverse.iter_mut().step_by(n + 1).for_each(|entry| *entry = 1.0);
    factor.solve(&mut inverse);
    for j in 0..n {
        for i in j..n {
            let mean = 0.5 * (inverse[i + n * j] + inverse[j + n * i]);
            let scaled = root[i] * mean * root[j];
            (inverse[i + n * j], inverse[j + n * i]) = (scaled, scaled);
        }
    }
    inverse.iter().all(|entry| entry.is_finite()).then_some(inverse)
}
