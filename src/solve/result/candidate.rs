//! The internal result of a method: displacements, how they were found, and their certificate.

use std::cell::OnceCell;

use super::ending::Ending;
use super::solution::Errors;
use crate::certificate::{Certificate, is_escape_of, measure};
use crate::law::Contact;

/// A candidate of a solver. Its displacements change only together with its certificate, which is measured once.
#[derive(Clone, Debug)]
pub struct Candidate {
    pub(super) d: Vec<f64>,
    /// Empty where nothing is known of what rounding has left out of `d`.
    pub(super) low: Vec<f64>,
    force: Vec<f64>,
    certificate: OnceCell<Certificate>,
    /// Why the solver stopped.
    pub ending: Ending,
    /// Counts.
    pub effort: Effort,
    /// Sign of the determinant of the system of its pieces, 0 if not known.
    pub orientation: i8,
    /// Components whose block of `K` is positive definite beyond doubt, as a factor of it has shown; empty if none is known.
    pub definite: Vec<bool>,
    /// Errors that a refinement has found.
    pub errors: Option<Errors>,
}

impl Candidate {
    /// A candidate with the contact forces that equilibrium needs at `d`, as the solver has them.
    pub fn new(d: Vec<f64>, force: Vec<f64>, ending: Ending, effort: Effort) -> Self {
        let certificate = OnceCell::new();
        let (low, definite, errors) = (Vec::new(), Vec::new(), None);
        Candidate { d, low, force, certificate, ending, effort, orientation: 0, definite, errors }
    }

    /// A candidate whose forces follow from its displacements.
    pub fn of_displacements(contact: &Contact<'_>, d: Vec<f64>, ending: Ending) -> Self {
        let force = contact.problem().force(&d);
        Candidate::new(d, force, ending, Effort::default())
    }

    /// A solver that could not begin: zero displacement.
    pub fn without_displacements(contact: &Contact<'_>, ending: Ending) -> Self {
        Candidate::of_displacements(contact, vec![0.0; contact.unknowns()], ending)
    }

    /// Displacements.
    pub fn d(&self) -> &[f64] {
        &self.d
    }

    /// The part that rounding to doubles has left out of the displacements; empty where nothing is known of it.
    pub fn low(&self) -> &[f64] {
        &self.low
    }

    /// Contact forces that equilibrium needs at the displacements, as the solver has them.
    pub fn force(&self) -> &[f64] {
        &self.force
    }

    /// [`Self::low`] with an entry for each displacement: zero where nothing is known.
    pub fn low_part(&self) -> Vec<f64> {
        if self.low.is_empty() { vec![0.0; self.d.len()] } else { self.low.clone() }
    }

    /// This candidate with the counts of what found it.
    pub fn with_effort(self, effort: Effort) -> Self {
        Candidate { effort, ..self }
    }

    /// This candidate with forces that the solver knows better. The certificate takes its own.
    pub fn with_force(self, force: Vec<f64>) -> Self {
        Candidate { force, ..self }
    }

    /// This candidate at the displacements `d + low`, which need `force`.
    pub fn moved_to(self, d: Vec<f64>, low: Vec<f64>, force: Vec<f64>) -> Self {
        Candidate { d, low, force, certificate: OnceCell::new(), ..self }
    }

    /// The certificate, measured once.
    pub fn certificate(&self, contact: &Contact<'_>) -> &Certificate {
        self.certificate.get_or_init(|| measure(contact, (&self.d, &self.low), &self.force))
    }

    /// Takes the certificate out.
    pub fn take_certificate(&mut self, contact: &Contact<'_>) -> Certificate {
        self.certificate(contact);
        self.certificate.take().expect("it is measured")
    }

    /// True if nothing is left to try: solved, proved to have no solution, or stopped.
    pub fn is_settled(&self, contact: &Contact<'_>, tolerance: f64) -> bool {
        match &self.ending {
            Ending::Recession(motion) => is_escape_of(contact, motion),
            Ending::Stopped(_) => true,
            _ => self.certificate(contact).holds(tolerance),
        }
    }
}

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
