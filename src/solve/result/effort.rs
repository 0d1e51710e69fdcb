//! Counts of a solver's work.

/// The work of a solver.
#[derive(Clone, Copy, Debug, Default)]
pub struct Effort {
    /// Dense factorisations.
    pub factorisations: u64,
    /// Threshold updates.
    pub outer_iterations: u64,
    /// How often a tableau was refactorised.
    pub refactorisations: u64,
    /// Over-relaxation factor at the end, 0 if there is none.
    pub omega: f64,
    /// Damping of the threshold at the end, 0 if there is none.
    pub damping: f64,
}

impl Effort {
    /// The effort of so many linear systems.
    pub fn of_systems(factorisations: u64) -> Self {
        Effort { factorisations, ..Effort::default() }
    }
}
