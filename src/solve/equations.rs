//! An iterate, and the linear system of a choice of pieces, solved again and again as they change.

use super::bordered::{Bordered, Coefficients};
use super::pieces::{self, Piece, Row};
use super::sor::Iterate;
use crate::problem::ContactProblem;

/// The system is singular to working precision.
#[derive(Debug)]
pub struct Singular;

/// An iterate, and the factors of the last system.
pub struct Equations<'p> {
    problem: ContactProblem<'p>,
    symmetric: bool,
    /// `K[i, i]^-1/2`: rows and columns are scaled by it.
    scale: Vec<f64>,
    /// The last system that was factorised, if it may serve again.
    factorised: Option<Bordered>,
    /// Displacements.
    pub d: Vec<f64>,
    /// `K d - f`.
    pub force: Vec<f64>,
    /// Factorisations so far.
    pub factorisations: u64,
    /// Sign of the determinant of the last system.
    pub orientation: i8,
}

impl<'p> Equations<'p> {
    /// Begins at the displacements `d`. `symmetric` tells whether `K` is, as far as rounding goes.
    pub fn new(problem: &ContactProblem<'p>, symmetric: bool, d: Vec<f64>) -> Self {
        Equations {
            symmetric,
            scale: (0..d.len()).map(|i| problem.diagonal(i).sqrt().recip()).collect(),
            factorised: None,
            force: problem.force(&d),
            d,
            factorisations: 0,
            orientation: 0,
            problem: *problem,
        }
    }

    /// Solves the system that `rows` select.
    pub fn solve(&mut self, rows: &[Row]) -> Result<(), Singular> {
        let mut step = vec![0.0; rows.len()];
        for (i, row) in rows.iter().enumerate() {
            if let Row::Held(value) = *row {
                step[i] = value - self.d[i];
                self.d[i] = value;
            }
        }
        self.add_force(&step);
        let coefficients =
            Coefficients { problem: &self.problem, symmetric: self.symmetric, scale: &self.scale };
        let system = match self.factorised.take() {
            Some(system) if system.is_near(rows) => system,
            _ => {
                self.factorisations += 1;
                Bordered::new(&coefficients, rows).ok_or(Singular)?
            }
        };
        let system = self.factorised.insert(system);
        let (step, orientation) = system.solve(&coefficients, rows, &self.force).ok_or(Singular)?;
        self.orientation = orientation;
        for (d, step) in self.d.iter_mut().zip(&step) {
            *d += step;
        }
        self.add_force(&step);
        Ok(())
    }

    /// The pieces on which the iterate is after some sweeps, which it does not keep.
    pub fn swept_pieces(&self, sweeps: u32) -> Vec<Piece> {
        let (d, force) = (self.d.clone(), self.force.clone());
        let mut iterate = Iterate::with_force(&self.problem, d, force);
        for _ in 0..sweeps {
            iterate.sweep(&self.problem, 1.0);
        }
        pieces::at(&self.problem, &iterate.d, &iterate.force)
    }

    /// Lets the next system be factorised anew.
    pub fn forget(&mut self) {
        self.factorised = None;
    }

    /// Computes the force anew.
    pub fn refresh(&mut self) {
        self.force = self.problem.force(&self.d);
    }

    fn add_force(&mut self, step: &[f64]) {
        self.problem.add_product(step, &mut self.force);
    }
}
