//! The complementarity problem of friction in 2D, as `frictional_lemke` states it, in arrays.

use super::elimination::driven_motion;
use super::factor::Factor;
use super::pieces::{Motion, Piece};
use super::solution::{Candidate, Ending};
use crate::error::Error;
use crate::linalg::small::largest;
use crate::problem::{ContactProblem, FrictionLaw};

/// The arrays of a complementarity problem in `(w, a, b)`.
pub struct Arrays {
    /// Matrix, column-major.
    pub matrix: Vec<f64>,
    /// Vector.
    pub q: Vec<f64>,
    /// Covering vector.
    pub cover: Vec<f64>,
    /// Scales of the variables.
    pub scales: Vec<f64>,
}

/// The complementarity problem of a contact problem.
pub struct FrictionLcp<'p> {
    problem: &'p ContactProblem<'p>,
    /// Components that carry no contact force are eliminated.
    eliminated: Factor,
    at_rest: Vec<f64>,
    /// Normal, then tangential components that are left.
    normal: Vec<usize>,
    tangential: Vec<usize>,
    /// `K` on them, condensed, column-major.
    stiffness: Vec<f64>,
}

impl<'p> FrictionLcp<'p> {
    /// Eliminates what carries no contact force; a candidate that tells why it cannot be.
    pub fn new(problem: &'p ContactProblem<'p>) -> Result<Self, Candidate> {
        let stalled = |reason| Candidate::ended(vec![0.0; problem.unknowns()], reason);
        let faces = |i: &usize| problem.gap(i / 2) < f64::INFINITY;
        let normal: Vec<usize> = (0..problem.unknowns()).step_by(2).filter(faces).collect();
        let coulomb = matches!(problem.law(), FrictionLaw::Coulomb(_));
        let rubs = |i: &usize| !coulomb || faces(i);
        let tangential: Vec<usize> = (1..problem.unknowns()).step_by(2).filter(rubs).collect();
        let kept: Vec<usize> = normal.iter().chain(&tangential).copied().collect();
        let mut is_kept = vec![false; problem.unknowns()];
        kept.iter().for_each(|&i| is_kept[i] = true);
        let others = (0..problem.unknowns()).filter(|&i| !is_kept[i]).collect();
        let eliminated = Factor::new(problem, others)
            .ok_or_else(|| stalled(Ending::Stalled("K is not positive semi-definite")))?;
        let mut at_rest = vec![0.0; problem.unknowns()];
        for &i in &normal {
            at_rest[i] = problem.gap(i / 2);
        }
        for &i in &tangential {
            at_rest[i] = problem.reference_slip(i / 2, 0);
        }
        eliminated.equilibrate(problem, &mut at_rest);
        if let Some(motion) = driven_motion(problem, &eliminated, &at_rest) {
            return Err(stalled(Ending::Escape(motion)));
        }
        let stiffness = eliminated.schur_complement(problem, &kept);
        Ok(FrictionLcp { problem, eliminated, at_rest, normal, tangential, stiffness })
    }

    /// The arrays, with the glue of the covering vector against slip to either side.
    pub fn arrays(&self, glue: [f64; 2]) -> Result<Arrays, Error> {
        let (problem, n, m) = (self.problem, self.normal.len(), self.tangential.len());
        let size = n + 2 * m;
        let force = problem.force(&self.at_rest);
        let root = |i: usize| problem.diagonal(i).sqrt();
        let scale = |i: &usize| root(*i).recip();
        let scales: Vec<f64> = self.normal.iter().map(scale).collect();
        let tangential_scales: Vec<f64> = self.tangential.iter().map(scale).collect();
        let scales = [&scales[..], &tangential_scales, &tangential_scales].concat();
        // Where the pair of each tangential component has its pressure, and its coefficient.
        let mut place = vec![usize::MAX; problem.pairs()];
        for (k, &i) in self.normal.iter().enumerate() {
            place[i / 2] = k;
        }
        let (mu, g) = match problem.law() {
            FrictionLaw::Frictionless => (None, None),
            FrictionLaw::Coulomb(mu) => (Some(mu), None),
            FrictionLaw::Tresca(g) => (None, Some(g)),
        };
        let coefficient =
            |k: usize| mu.map(|mu| (mu[self.tangential[k] / 2], place[self.tangential[k] / 2]));

        let mut q = vec![0.0; size];
        let mut cover = vec![0.0; size];
        for (k, &i) in self.normal.iter().enumerate() {
            q[k] = -force[i];
            cover[k] = root(i);
        }
        for (k, &i) in self.tangential.iter().enumerate() {
            let (bound, clamp) = match coefficient(k) {
                Some((mu, normal)) => (mu * q[normal], mu * cover[normal]),
                None => (g.map_or(0.0, |g| g[i / 2]), 0.0),
            };
            (q[n + k], q[n + m + k]) = (bound + force[i], bound - force[i]);
            (cover[n + k], cover[n + m + k]) =
                (clamp + glue[0] * root(i), clamp + glue[1] * root(i));
        }
        let mut matrix = Vec::new();
        matrix
            .try_reserve_exact(size * size)
            .map_err(|_| Error::OutOfMemory("the complementarity problem of friction"))?;
        matrix.resize(size * size, 0.0);
        for (j, column) in matrix.chunks_exact_mut(size.max(1)).enumerate() {
            // Unknown j moves one component, an opening or a slip to one side.
            let (component, sign) = match j {
                j if j < n => (j, -1.0),
                j if j < n + m => (j, 1.0),
                j => (j - m, -1.0),
            };
            let source = &self.stiffness[component * (n + m)..(component + 1) * (n + m)];
            for (column, k) in column.iter_mut().zip(&source[..n]) {
                *column = -sign * k;
            }
            for k in 0..m {
                let bound = coefficient(k).map_or(0.0, |(mu, normal)| -mu * sign * source[normal]);
                let force = sign * source[n + k];
                (column[n + k], column[n + m + k]) = (bound + force, bound - force);
            }
        }
        Ok(Arrays { matrix, q, cover, scales })
    }

    /// All displacements of a point of the path.
    pub fn displacements(&self, z: &[f64]) -> Vec<f64> {
        let mut d = self.at_rest.clone();
        for (d, motion) in d.iter_mut().zip(self.kept_motion(z)) {
            *d += motion;
        }
        self.eliminated.equilibrate(self.problem, &mut d);
        d
    }

    /// The motion of all components along a ray.
    pub fn motion(&self, ray: &[f64]) -> Vec<f64> {
        let mut motion = self.kept_motion(ray);
        // Digits that rounding has left beside the largest are no motion.
        let least = 1e-12 * largest(&motion);
        motion.iter_mut().filter(|r| r.abs() < least).for_each(|r| *r = 0.0);
        self.eliminated.follow(self.problem, &mut motion);
        motion
    }

    fn kept_motion(&self, z: &[f64]) -> Vec<f64> {
        let (n, m) = (self.normal.len(), self.tangential.len());
        let mut motion = vec![0.0; self.problem.unknowns()];
        for (k, &i) in self.normal.iter().enumerate() {
            motion[i] = -z[k];
        }
        for (k, &i) in self.tangential.iter().enumerate() {
            motion[i] = z[n + k] - z[n + m + k];
        }
        motion
    }

    /// The pieces of a point of the path.
    pub fn pieces(&self, z: &[f64]) -> Vec<Piece> {
        let (n, m) = (self.normal.len(), self.tangential.len());
        let apart = Piece { closed: false, motion: Motion::Slide(0) };
        let mut pieces = vec![apart; self.problem.pairs()];
        for (k, &i) in self.normal.iter().enumerate() {
            pieces[i / 2].closed = z[k] == 0.0;
        }
        let tresca = matches!(self.problem.law(), FrictionLaw::Tresca(_));
        for (k, &i) in self.tangential.iter().enumerate() {
            let piece = &mut pieces[i / 2];
            let rubs = self.problem.threshold(i / 2, 1.0) > 0.0;
            if rubs && (piece.closed || tresca) {
                piece.motion = match (z[n + k], z[n + m + k]) {
                    (a, b) if a > b => Motion::Slide(1),
                    (a, b) if a < b => Motion::Slide(-1),
                    _ => Motion::Rest,
                };
            }
        }
        pieces
    }
}
