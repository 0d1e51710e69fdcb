//! Most bytes that the calls of a model take, known before work begins.

use super::{BLOCK, Model};
use crate::problem::{Dependence, FlexibilityForm, FrictionLaw};
use crate::solve::{memory_of_case, memory_of_flexibility, memory_of_ties};

/// Vectors of the host's size that each load case of a block takes while it is condensed or recovered.
const VECTORS: u64 = 10;

impl Model {
    /// Most bytes that [`Self::solve`] takes beside the model.
    pub fn memory(&self) -> u64 {
        if let Some(form) = self.reduction.flexibility() {
            return memory_of_flexibility(&form);
        }
        // Dependent rows are solved with springs between bodies and contact.
        let springs = self.reduction.dependence().map_or(0, Dependence::variables);
        let case = memory_of_case(self.reduction.inner_unknowns(), self.dim * self.pairs + springs);
        self.reduction.factor_bytes() + case
    }

    /// Most bytes that a load case under this law takes beyond [`Self::memory`].
    pub(crate) fn memory_of_ties(&self, law: FrictionLaw<'_>) -> u64 {
        let whole = self.dim * self.pairs;
        match self.reduction.flexibility() {
            _ if self.is_matrix_free() => 0,
            Some(FlexibilityForm::Sparse(matrix)) => memory_of_ties(law, matrix.largest_part()),
            _ => memory_of_ties(law, whole),
        }
    }

    /// Most bytes that condensing so many load cases takes beside the model and what the host holds.
    pub(crate) fn memory_of_cases(&self, cases: usize) -> u64 {
        let columns = cases.min(BLOCK) as u64;
        let size = (self.host_size() + self.fixed_count() + self.dim * self.pairs) as u64;
        let vectors = VECTORS.saturating_mul(columns).saturating_mul(size);
        vectors.saturating_mul(size_of::<f64>() as u64)
    }

    /// Most bytes that recovering so many load cases takes beside the model and what the host holds.
    pub(crate) fn memory_of_recovery(&self, cases: usize) -> u64 {
        self.memory_of_cases(cases).saturating_add(self.reduction.factor_bytes())
    }
}
