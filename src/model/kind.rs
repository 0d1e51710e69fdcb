//! How a model solves its load cases.

use super::Model;

/// How a model solves its load cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModelKind {
    /// By a condensed stiffness matrix.
    Stiffness,
    /// By factors of the sparse stiffness matrix: nothing is condensed.
    FullSpace,
    /// By products and solutions of the host.
    Operator,
    /// In flexibility form, `d = W F + q`.
    Flexibility,
}

impl Model {
    /// How the model solves its load cases.
    pub fn kind(&self) -> ModelKind {
        match (self.reduction.flexibility(), self.is_matrix_free()) {
            (Some(_), _) => ModelKind::Flexibility,
            (None, false) => ModelKind::Stiffness,
            // Frames are those of the axes of a sparse matrix.
            (None, true) if self.frames().is_some() => ModelKind::FullSpace,
            (None, true) => ModelKind::Operator,
        }
    }
}
