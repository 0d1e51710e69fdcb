//! Control values in place of the displacements of mid nodes: the basis in which every node of a
//! quadratic face carries pressure.
//!
//! The shape functions of the corners of a quadratic face integrate to zero or less, so that a uniform
//! pressure would pull at corners. The basis (after Popp, Wohlmuth, Gee and Wall 2012)
//!
//! ```text
//! N̂_m = (1 - 2 α) N_m,    N̂_c = N_c + Σ α N_m  over the edges at c
//! û_m = (u_m - α (u_c1 + u_c2)) / (1 - 2 α),    û_c = u_c
//! ```
//!
//! has positive integrals. `α` belongs to an edge. A face that is covered in part needs functions that are
//! nowhere negative, so that any part of it has positive integrals; other faces have smaller values,
//! which are more accurate where the pressure varies. There the centre of a face with 9 nodes spreads
//! too, by a sixteenth to each corner and an eighth to each mid node.

use std::collections::HashMap;

use super::shape::{FaceKind, Values, padded};

/// The part of the centre's function that each corner takes. Each mid node takes two of them, and four remain.
const PART: f64 = 1.0 / 16.0;

/// `α` of a face's edges, if it is covered wholly or in part. A ring at its axis counts as covered in part: with `α = 0` the
/// integral of its corner there has the radius as a factor, and errors of forces are enlarged by its inverse.
fn alpha(kind: FaceKind, wholly: bool) -> f64 {
    match (kind, wholly) {
        (FaceKind::Line2 | FaceKind::T3 | FaceKind::Q4, _) => 0.0,
        (FaceKind::Line3 | FaceKind::Q9, true) => 0.0,
        (FaceKind::T6 | FaceKind::Q8, true) => 0.2,
        // Bernstein's polynomials.
        (FaceKind::Line3 | FaceKind::Q9 | FaceKind::T6, false) => 0.25,
        (FaceKind::Q8, false) => 0.375,
    }
}

/// `α` of all edges, by mid node: the largest of the faces at an edge.
#[derive(Debug, Default)]
pub(super) struct Edges(HashMap<usize, f64>);

impl Edges {
    pub(super) fn add(&mut self, kind: FaceKind, nodes: &[usize], wholly: bool) {
        for (mid, _) in kind.mids() {
            let value = self.0.entry(nodes[mid]).or_insert(0.0);
            *value = value.max(alpha(kind, wholly));
        }
    }

    /// The basis of a face.
    pub(super) fn basis(&self, kind: FaceKind, nodes: &[usize], wholly: bool) -> Basis {
        let alpha = padded(kind.mids().map(|(mid, _)| self.0[&nodes[mid]]));
        Basis { kind, alpha, spreads: !wholly }
    }
}

/// The changed basis of one face.
#[derive(Clone, Copy, Debug)]
pub(super) struct Basis {
    pub(super) kind: FaceKind,
    /// `α` of each edge.
    pub(super) alpha: [f64; 4],
    /// `true` if the centre spreads.
    pub(super) spreads: bool,
}

impl Basis {
    fn centre(&self) -> Option<usize> {
        self.kind.central_node().filter(|_| self.spreads)
    }

    /// Functions, or their integrals, in the changed basis: `N̂` from `N`.
    pub(super) fn functions(&self, mut n: Values) -> Values {
        let centre = self.centre().map(|centre| (centre, n[centre]));
        for (alpha, (mid, corners)) in self.alpha.iter().zip(self.kind.mids()) {
            corners.into_iter().for_each(|corner| n[corner] += alpha * n[mid]);
            n[mid] *= 1.0 - 2.0 * alpha;
        }
        if let Some((centre, value)) = centre {
            (0..self.kind.corners()).for_each(|corner| n[corner] += PART * value);
            self.kind.mids().for_each(|(mid, _)| n[mid] += 2.0 * PART * value);
            n[centre] = 4.0 * PART * value;
        }
        n
    }

    /// Control values from nodal values: `û` from `u`.
    pub(super) fn control_values(&self, mut u: Values) -> Values {
        for (alpha, (mid, [a, b])) in self.alpha.iter().zip(self.kind.mids()) {
            u[mid] = (u[mid] - alpha * (u[a] + u[b])) / (1.0 - 2.0 * alpha);
        }
        if let Some(centre) = self.centre() {
            let corners: f64 = u[..self.kind.corners()].iter().sum();
            let mids: f64 = self.kind.mids().map(|(mid, _)| u[mid]).sum();
            u[centre] = (u[centre] - PART * corners - 2.0 * PART * mids) / (4.0 * PART);
        }
        u
    }
}
