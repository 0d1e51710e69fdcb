//! The equation of one component on a piece of a piecewise linear law.

/// The equation of one component on a piece of a piecewise linear law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Row {
    /// The displacement has this value.
    Fixed(f64),
    /// `F_i + coupling F_n + offset = 0`, with the normal component `n` of its pair.
    Free {
        /// Coefficient of `F_n`; 0 in the equation of `F_n` itself.
        coupling: f64,
        /// A force.
        offset: f64,
    },
}

impl Row {
    /// No force.
    pub const FREE: Row = Row::Free { coupling: 0.0, offset: 0.0 };
}
