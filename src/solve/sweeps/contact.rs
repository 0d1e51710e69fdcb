//! Sweeps on a contact problem, pair by pair, in proximal form (`law::proximal`).
//!
//! With given thresholds each step lowers `J(d) = d.K d / 2 - f.d + sum g |delta|` for
//! `0 < omega < 2`, definite `K` or not. `K d - f` is carried along: an unknown that does not change
//! costs nothing.

use super::Swept;
use super::blocks::over_all;
use super::drift::contact_recession;
use crate::certificate::eta_of;
use crate::law::{Contact, PairLaw};
use crate::linalg::matrix::Matrix;
use crate::monitor::Monitor;

/// So many sweeps with a factor, fewer if the time is up.
pub fn sweep_in_time(
    laws: &[PairLaw],
    matrix: Matrix<'_>,
    (d, force): (&mut [f64], &mut [f64]),
    (sweeps, omega): (usize, f64),
    monitor: &mut Monitor<'_>,
) {
    for _ in 0..sweeps {
        if monitor.is_late() {
            break;
        }
        sweep(laws, matrix, (&mut *d, &mut *force), omega);
    }
}

/// One sweep over all pairs on displacements and their force `K d - f`. Under Coulomb's law the threshold follows the
/// pressure within the sweep. Returns the change in the norm of the diagonal of `K`.
fn sweep(
    laws: &[PairLaw],
    matrix: Matrix<'_>,
    iterate: (&mut [f64], &mut [f64]),
    omega: f64,
) -> f64 {
    match matrix.size() / laws.len().max(1) {
        3 => sweep_in::<3>(laws, matrix, iterate, omega),
        _ => sweep_in::<2>(laws, matrix, iterate, omega),
    }
}

fn sweep_in<const DIM: usize>(
    laws: &[PairLaw],
    matrix: Matrix<'_>,
    (d, force): (&mut [f64], &mut [f64]),
    omega: f64,
) -> f64 {
    over_all::<DIM>(
        matrix,
        force,
        #[inline(always)]
        |i, force| {
            let coupling = &matrix.column(i)[i + 1..i + DIM];
            laws[i / DIM].relax(&mut d[i..i + DIM], force, coupling, omega)
        },
    )
}

/// The problem with its own law, and with the law that the sweeps obey, if it is another.
pub struct OnContact<'p> {
    pub own: &'p Contact<'p>,
    pub working: Option<Contact<'p>>,
}

impl<'p> OnContact<'p> {
    fn working(&self) -> &Contact<'p> {
        self.working.as_ref().unwrap_or(self.own)
    }
}

impl Swept for OnContact<'_> {
    fn sweep(&self, d: &mut [f64], force: &mut [f64], omega: f64) -> f64 {
        sweep(self.working().pairs(), self.own.problem().stiffness(), (d, force), omega)
    }

    fn eta_of_sweeps(&self, d: &[f64], force: &[f64]) -> f64 {
        eta_of(self.working(), d, force)
    }

    fn eta(&self, d: &[f64], force: &[f64]) -> f64 {
        eta_of(self.own, d, force)
    }

    fn residual(&self, d: &[f64]) -> Vec<f64> {
        self.own.problem().force(d)
    }

    fn load(&self) -> &[f64] {
        self.own.load_with_tension()
    }

    fn recession(&self, drift: &[f64], monitor: &mut Monitor<'_>) -> Option<Vec<f64>> {
        contact_recession(self.own, drift, monitor)
    }
}
