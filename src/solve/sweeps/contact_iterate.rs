//! Sweeps on a contact problem, pair by pair, in proximal form (`law::proximal`).
//!
//! With given thresholds each step lowers `J(d) = d.K d / 2 - f.d + sum g |delta|` for
//! `0 < omega < 2`, definite `K` or not. `K d - f` is carried along: an unknown that does not change
//! costs nothing.

use super::Iterate;
use super::blocks::over_all;
use super::drift::contact_recession;
use crate::certificate::eta_of;
use crate::law::{Contact, PairLaw};
use crate::linalg::matrix::Matrix;
use crate::linalg::vector::norm_inf;
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

/// An iterate with its force.
pub struct ContactIterate<'p> {
    /// The problem with its own law.
    own: &'p Contact<'p>,
    /// The problem with the law that the sweeps obey, if it is another.
    working: Option<Contact<'p>>,
    d: Vec<f64>,
    /// `K d - f`.
    force: Vec<f64>,
}

impl<'p> ContactIterate<'p> {
    /// Starts from `d`, made admissible.
    pub fn new(contact: &'p Contact<'p>, d: &[f64]) -> Self {
        let d = contact.admissible(d);
        let force = contact.problem().force(&d);
        ContactIterate { own: contact, working: None, d, force }
    }

    /// Thresholds of the problem's own law at the pressures of the iterate.
    pub fn thresholds(&self) -> Vec<f64> {
        self.own.thresholds(&self.d, &self.force)
    }

    /// Lets the following sweeps obey given thresholds.
    pub fn set_thresholds(&mut self, thresholds: &[f64]) {
        self.working.get_or_insert_with(|| self.own.clone()).set_thresholds(thresholds);
    }

    /// Displacements and forces.
    pub fn into_parts(self) -> (Vec<f64>, Vec<f64>) {
        (self.d, self.force)
    }
}

impl Iterate for ContactIterate<'_> {
    fn sweep(&mut self, omega: f64) -> f64 {
        let (law, matrix) =
            (self.working.as_ref().unwrap_or(self.own), self.own.problem().stiffness());
        sweep(law.pairs(), matrix, (&mut self.d, &mut self.force), omega)
    }

    fn eta_of_sweeps(&self) -> f64 {
        eta_of(self.working.as_ref().unwrap_or(self.own), &self.d, &self.force)
    }

    fn eta(&self) -> f64 {
        eta_of(self.own, &self.d, &self.force)
    }

    fn refresh(&mut self) {
        self.force = self.own.problem().force(&self.d);
    }

    fn unknowns(&self) -> &[f64] {
        &self.d
    }

    fn largest_force(&self) -> f64 {
        norm_inf(&self.force)
    }

    fn is_unloaded(&self) -> bool {
        norm_inf(self.own.load_with_tension()) == 0.0
    }

    fn recession(&self, drift: &[f64], monitor: &mut Monitor<'_>) -> Option<Vec<f64>> {
        contact_recession(self.own, drift, monitor)
    }
}
