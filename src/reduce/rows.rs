//! Contact pairs as equations between degrees of freedom of the matrix: the one form behind all forms of a host.

use std::collections::HashMap;

use crate::linalg::row_elimination::Terms;

/// An equation `sum a_k u_k = delta` for each axis of each pair, `delta` the relative displacement in the axes of the
/// normals.
pub(super) struct Rows {
    /// Space dimension.
    pub(super) dim: usize,
    /// `dim` equations for each pair.
    pub(super) equations: Vec<Terms>,
    /// `true` if each pair has a slave whose degrees of freedom stand in no other equation.
    pub(super) have_own_slaves: bool,
}

impl Rows {
    /// Takes the equations; `slaves` are the degrees of freedom of slaves, `dim` for each pair, or none.
    pub(super) fn new(dim: usize, equations: Vec<Terms>, slaves: &[usize]) -> Self {
        let have_own_slaves = !slaves.is_empty() && stand_once(slaves, &equations);
        Rows { dim, equations, have_own_slaves }
    }

    /// The equations of a pair, one for each axis.
    pub(super) fn of_pair(&self, pair: usize) -> &[Terms] {
        &self.equations[self.dim * pair..self.dim * (pair + 1)]
    }
}

/// `true` if each of some degrees of freedom stands in one equation, once.
fn stand_once(dofs: &[usize], equations: &[Terms]) -> bool {
    let mut uses: HashMap<usize, usize> = dofs.iter().map(|dof| (*dof, 0)).collect();
    for (dof, _) in equations.iter().flatten() {
        if let Some(uses) = uses.get_mut(dof) {
            *uses += 1;
        }
    }
    uses.values().all(|uses| *uses == 1)
}
