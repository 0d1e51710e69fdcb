//! Detection of a path that returns to a basis that it has left.

use std::hash::{BuildHasher, BuildHasherDefault, DefaultHasher};

/// The bases of a path, of which one is remembered: that of the last pivot whose number is a power of two
/// (R. P. Brent 1980). A cycle is found after at most three times the pivots to its end.
pub struct Trail {
    /// Exclusive or of the numbers of all variables that have entered or left an odd number of times.
    basis: u64,
    remembered: u64,
    pivots: u64,
}

impl Trail {
    /// At the first basis.
    pub fn new() -> Self {
        Trail { basis: 0, remembered: 0, pivots: 0 }
    }

    /// Goes on to the basis in which `entering` has taken the place of `leaving`; whether that is the one
    /// remembered. Two bases are mistaken for one with the probability `2^-64`.
    pub fn returns_by(&mut self, entering: usize, leaving: usize) -> bool {
        let number =
            |variable: usize| BuildHasherDefault::<DefaultHasher>::new().hash_one(variable);
        self.basis ^= number(entering) ^ number(leaving);
        self.pivots += 1;
        let returns = self.basis == self.remembered;
        if self.pivots.is_power_of_two() {
            self.remembered = self.basis;
        }
        returns
    }
}
