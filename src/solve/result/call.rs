//! A problem that a method solves, with how it is to be solved and from where.

use crate::law::Contact;
use crate::monitor::Watch;
use crate::settings::{Method, Settings};

/// A problem that a method solves.
#[derive(Clone, Copy)]
pub struct Call<'c> {
    pub contact: &'c Contact<'c>,
    pub settings: &'c Settings,
    /// Displacements, zero if `None`.
    pub start: Option<&'c [f64]>,
    /// Counts what is done, and tells when to stop.
    pub monitor: &'c dyn Watch,
}

impl<'c> Call<'c> {
    /// A call that begins at zero.
    pub fn new(contact: &'c Contact<'c>, settings: &'c Settings, monitor: &'c dyn Watch) -> Self {
        Call { contact, settings, start: None, monitor }
    }

    /// This call from other displacements.
    pub fn from(self, start: &'c [f64]) -> Self {
        Call { start: Some(start), ..self }
    }

    /// The displacements of the start.
    pub fn start_or_zero(&self) -> Vec<f64> {
        self.start.map_or_else(|| vec![0.0; self.contact.unknowns()], <[f64]>::to_vec)
    }

    /// True if the host has chosen the method itself.
    pub fn is_chosen(&self) -> bool {
        self.settings.method != Method::Auto
    }
}
