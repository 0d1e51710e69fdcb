//! A point of the law with its lack of equilibrium.

use crate::law::{Contact, Vector};
use crate::linalg::vector::NormSum;

/// The coordinates `y` of all pairs, and what they mean.
pub struct Point {
    /// `y`, pair by pair.
    pub y: Vec<Vector>,
    /// Displacements.
    pub d: Vec<f64>,
    /// `K d - f`: the contact force that equilibrium needs.
    pub force: Vec<f64>,
    /// `H = K d - f + P`, zero at solutions.
    pub lack: Vec<f64>,
    /// `|H|`, each force in the unit that its diagonal entry of `K` gives it.
    pub merit: f64,
}

impl Point {
    /// The point at `y`; `root` holds the roots of the diagonal of `K`.
    pub fn new(contact: &Contact<'_>, root: &[f64], y: Vec<Vector>) -> Self {
        let dim = contact.dim();
        let (mut d, mut p) = (Vec::with_capacity(root.len()), Vec::with_capacity(root.len()));
        for (law, y) in contact.pairs().iter().zip(&y) {
            let (displacement, push) = law.point(y);
            d.extend_from_slice(&displacement[..dim]);
            p.extend_from_slice(&push[..dim]);
        }
        let force = contact.problem().force(&d);
        let lack: Vec<f64> = force.iter().zip(&p).map(|(force, p)| force + p).collect();
        let mut merit = NormSum::default();
        lack.iter().zip(root).for_each(|(lack, root)| merit.add(lack / root));
        Point { y, d, force, lack, merit: merit.root() }
    }
}
