//! A body that the host itself has condensed on its contact nodes, on an obstacle: `d = u`.

use super::{Reduction, motion};
use crate::error::Message;

/// The host's condensed stiffness, taken as it is.
pub struct CondensedReduction {
    dim: usize,
    /// Components of `d`.
    size: usize,
    stiffness: Vec<f64>,
}

impl CondensedReduction {
    /// Keeps a checked stiffness of `size` rows, column-major with leading dimension `size`; each pair
    /// has `dim` of them.
    pub(crate) fn new(dim: usize, size: usize, stiffness: Vec<f64>) -> Self {
        CondensedReduction { dim, size, stiffness }
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
