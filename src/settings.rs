//! How to solve: method, accuracy, budgets.

use crate::error::{Argument, Error, number};

/// The algorithm to run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Chooses, checks and falls back: [`Method::BlockPivoting`] without friction, [`Method::Newton`] with
    /// it, then [`Method::Path`], then [`Method::Lemke`] (not with friction in 3D), then sweeps. The
    /// default.
    Auto,
    /// Coulomb friction as a sequence of Tresca problems, each by projected SOR
    /// (paper, section 2.1: `g <- mu |F_n|`).
    SorNested,
    /// Projected SOR with the threshold updated inside the sweep.
    SorDiagonal,
    /// Lemke's method, without friction (paper, section 2.2) or with it in 2D.
    Lemke,
    /// Block principal pivoting, without friction.
    BlockPivoting,
    /// Newton's method: on the active set of the pairs in 2D, on the normal map in 3D.
    Newton,
    /// A path of solutions followed from the start, with a proof for every `mu` if `K` is definite.
    Path,
}

/// The search for other solutions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Search {
    /// Report only what the solution itself proves.
    Off,
    /// Prove that the solution is unique, or look for a second one.
    Others,
}

/// Smallest tolerance: a few units of the rounding of `eta` itself.
pub const SMALLEST_TOLERANCE: f64 = 1e-15;
/// Largest tolerance: beyond it a result says nothing about the contact.
pub const LARGEST_TOLERANCE: f64 = 0.1;

/// Refuses a tolerance out of range, by a sentence about the argument `name`.
pub fn check_tolerance(name: &str, tolerance: f64) -> Result<(), String> {
    if (SMALLEST_TOLERANCE..=LARGEST_TOLERANCE).contains(&tolerance) {
        return Ok(());
    }
    Err(format!(
        "{name} is {tolerance:?}, it must lie between {SMALLEST_TOLERANCE:?} and \
         {LARGEST_TOLERANCE:?}"
    ))
}

/// Settings of one call. `Settings::default()` suits most problems.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// The algorithm.
    pub method: Method,
    /// A result is called solved when its certificate has `eta <= tolerance`;
    /// between 1e-15 and 0.1.
    pub tolerance: f64,
    /// Over-relaxation factor, in (0, 2); 0 lets the solver choose from the measured rate.
    pub omega: f64,
    /// Damping of the threshold update of [`Method::SorNested`], in (0, 1]; 0 lets the solver
    /// choose from the measured rate.
    pub damping: f64,
    /// Most sweeps (SOR), pivots (Lemke) or linear systems (Newton, block pivoting), at least 1.
    pub max_iterations: u64,
    /// Most seconds of wall time; 0 means no limit. A factorisation that would take longer is not begun.
    pub time_limit: f64,
    /// The search for other solutions.
    pub search: Search,
    /// `true`: a proof is tried that the solution exists, and where: [`crate::Solution::existence`].
    pub proof: bool,
    /// Most bytes that a solution, or the reduction of a sparse matrix, may need; 0 means no limit. Where the condensed
    /// matrix would need more the model is left in full space ([`crate::Model::sparse_within`]).
    pub memory_limit: u64,
    /// `true`: a sparse matrix is left in full space whatever memory it needs.
    pub full_space: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            method: Method::Auto,
            tolerance: 1e-10,
            omega: 0.0,
            damping: 0.0,
            max_iterations: 200_000,
            time_limit: 0.0,
            search: Search::Off,
            proof: false,
            memory_limit: 0,
            full_space: false,
        }
    }
}

impl Settings {
    /// Refuses values out of range.
    pub fn validate(&self) -> Result<(), Error> {
        let refuse = |message: String| Err(Error::invalid(Argument::Settings, message));
        check_tolerance("settings: tolerance", self.tolerance).or_else(refuse)?;
        if !(0.0..2.0).contains(&self.omega) {
            return refuse(format!(
                "settings: omega is {}, it must be 0 (chosen) or lie between 0 and 2",
                number(self.omega)
            ));
        }
        if !(0.0..=1.0).contains(&self.damping) {
            return refuse(format!(
                "settings: damping is {}, it must be 0 (chosen) or lie in (0, 1]",
                number(self.damping)
            ));
        }
        if self.max_iterations == 0 {
            return refuse("settings: max_iterations is 0, it must be at least 1".into());
        }
        if !(self.time_limit >= 0.0) {
            return refuse(format!(
                "settings: time_limit is {}, it must be 0 (none) or a number of seconds",
                number(self.time_limit)
            ));
        }
        Ok(())
    }
}
