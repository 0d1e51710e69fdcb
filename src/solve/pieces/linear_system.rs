//! An iterate, and the linear system that a choice of rows selects, solved again and again as rows
//! change.

use super::bordered::{Bordered, Coefficients};
use crate::law::Row;
use crate::linalg::matrix::Matrix;
use crate::monitor::{Monitor, Stop};

/// The system is singular to working precision.
#[derive(Debug)]
pub struct Singular;

/// An iterate `x` of the affine map `r = c + M x`, and the factors of the last system.
pub struct LinearSystem<'p> {
    coefficients: Coefficients<'p>,
    /// `c`.
    constant: Vec<f64>,
    /// The last system that was factorised, if it may serve again.
    factorised: Option<Bordered>,
    /// The change of `x`: memory that all systems share.
    step: Vec<f64>,
    /// The unknowns.
    pub x: Vec<f64>,
    /// `c + M x`.
    pub residual: Vec<f64>,
    /// Factorisations so far.
    pub factorisations: u64,
    /// Sign of the determinant of the last system.
    pub orientation: i8,
}

impl<'p> LinearSystem<'p> {
    /// Begins at `x`. Components belong to groups of `group`, whose first one rows may be coupled to;
    /// `symmetric` tells whether `M` is, as far as rounding goes.
    pub fn new(
        matrix: Matrix<'p>,
        symmetric: bool,
        group: usize,
        constant: Vec<f64>,
        x: Vec<f64>,
    ) -> Self {
        let mut system = LinearSystem {
            coefficients: Coefficients::new(matrix, symmetric, group),
            factorised: None,
            step: vec![0.0; x.len()],
            residual: Vec::with_capacity(x.len()),
            x,
            constant,
            factorisations: 0,
            orientation: 0,
        };
        system.refresh();
        system
    }

    /// Operations of [`Self::solve`]: a factorisation, or borders.
    pub fn work(&self, rows: &[Row]) -> f64 {
        match &self.factorised {
            Some(system) if system.is_near(rows) => system.border_work(rows),
            _ => Bordered::work(&self.coefficients, rows),
        }
    }

    /// Moves the iterate to the solution of the system that `rows` select.
    pub fn solve(&mut self, rows: &[Row]) -> Result<(), Singular> {
        self.step.fill(0.0);
        for (i, row) in rows.iter().enumerate() {
            if let Row::Fixed(value) = *row {
                self.step[i] = value - self.x[i];
                self.x[i] = value;
            }
        }
        self.coefficients.matrix.add_product(&self.step, &mut self.residual);
        let system = match self.factorised.take() {
            Some(system) if system.is_near(rows) => system,
            _ => {
                self.factorisations += 1;
                Bordered::new(&self.coefficients, rows).ok_or(Singular)?
            }
        };
        let system = self.factorised.insert(system);
        self.orientation = system
            .solve(&self.coefficients, rows, &self.residual, &mut self.step)
            .ok_or(Singular)?;
        for (x, step) in self.x.iter_mut().zip(&self.step) {
            *x += step;
        }
        self.coefficients.matrix.add_product(&self.step, &mut self.residual);
        Ok(())
    }

    /// Lets the next system be refactorised.
    pub fn forget_factor(&mut self) {
        self.factorised = None;
    }

    /// Recomputes the residual.
    pub fn refresh(&mut self) {
        self.residual.clone_from(&self.constant);
        self.coefficients.matrix.add_product(&self.x, &mut self.residual);
    }

    /// Brings the solution of the last system to the accuracy that `is_accurate` asks for, if rounding
    /// has left less: iterative refinement. `eta` is watched on the way. `Err`: there is no time for more of
    /// it.
    pub fn refine(
        &mut self,
        rows: &[Row],
        eta: impl Fn(&[f64], &[f64]) -> f64,
        is_accurate: impl Fn(&[f64], f64) -> bool,
        monitor: &mut Monitor<'_>,
    ) -> Result<(), Stop> {
        let mut best = f64::INFINITY;
        for _ in 0..=REFINEMENTS {
            self.refresh();
            let eta = eta(&self.x, &self.residual);
            if is_accurate(&self.x, eta) {
                return Ok(());
            }
            if eta >= best {
                // Bordering loses accuracy that a fresh factor has.
                self.forget_factor();
            }
            best = best.min(eta);
            monitor.affords(self.work(rows))?;
            let before = self.x.clone();
            if self.solve(rows).is_err() {
                self.x = before;
                return Ok(());
            }
        }
        Ok(())
    }
}

/// Steps of iterative refinement: each gains about as many digits as the factor has right, so that
/// three suffice whenever any do.
const REFINEMENTS: usize = 3;
