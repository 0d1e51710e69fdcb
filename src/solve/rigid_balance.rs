//! Whether contact forces can balance the loads on the rigid motions at all, whatever the
//! displacements.
//!
//! With a basis `N` of the motions that `K` does not resist, balance is `Nᵀ (f + F) = 0` for forces
//! `F` in the friction cones. The forces that come nearest, by non-negative least squares over the
//! edges of the cones, leave `e = Nᵀ (f + F)`; if it is not zero, `r = N e` is a motion on which the
//! loads do work, `f . r = |e|²`, and no admissible force does negative work: what
//! [`crate::certificate::is_escape`] asks of a proof.

use super::condense::FreeBlock;
use crate::certificate::is_escape_of;
use crate::law::Contact;
use crate::linalg::nnls::{extend_basis, nearest};
use crate::linalg::vector::dot;

/// A recession direction that the loads drive, where the admissible forces are cones.
pub fn escape(contact: &Contact<'_>) -> Option<Vec<f64>> {
    if !contact.bounds().all(|bound| bound.is_cone()) {
        return None;
    }
    let (problem, dim) = (contact.problem(), contact.dim());
    let root = problem.stiffness().diagonal_roots();
    let basis = rigid_motions(contact, &root);
    // Work on each motion of forces whose first component is `first`.
    let on_motions = |force: &[f64], first: usize| -> Vec<f64> {
        let scaled: Vec<f64> =
            force.iter().zip(&root[first..]).map(|(force, root)| force / root).collect();
        basis.iter().map(|v| dot(&v[first..first + force.len()], &scaled)).collect()
    };
    let load = on_motions(contact.shifted_load(), 0);
    let mut edges = Vec::new();
    for (pair, law) in contact.pairs().iter().enumerate() {
        for edge in law.cone_edges() {
            edges.push(on_motions(&edge[..dim], dim * pair));
        }
    }
    let rest = nearest(&load, &edges)?;
    let mut motion = vec![0.0; contact.unknowns()];
    for (v, e) in basis.iter().zip(&rest) {
        for ((motion, v), root) in motion.iter_mut().zip(v).zip(&root) {
            *motion += e * v / root;
        }
    }
    is_escape_of(contact, &motion).then_some(motion)
}

/// An orthonormal basis of the motions without internal force, each component times its `root`.
fn rigid_motions(contact: &Contact<'_>, root: &[f64]) -> Vec<Vec<f64>> {
    let matrix = contact.problem().stiffness();
    let mut basis = Vec::new();
    if let Some(block) = FreeBlock::new(matrix, (0..matrix.size()).collect()) {
        for mut motion in block.null_vectors() {
            motion.iter_mut().zip(root).for_each(|(r, root)| *r *= root);
            extend_basis(&mut basis, motion);
        }
    }
    basis
}
