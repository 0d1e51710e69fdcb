//! Newton's step on the normal map by GMRES.
//!
//! On the pieces of a point, with `z` the change of all unknowns, `H` the lack and `drag`, `C` of each pair as
//! `law` has them, the condensed system of `pieces::dense` reads in displacements
//!
//! ```text
//! inner unknowns        A z = -H
//! open pairs            (A z)_n = -H_n
//! slipping pairs        (A z)_t - drag (A z)_n + C z_t = -H_t + drag H_n
//! held components       z = 0
//! ```
//!
//! It is a symmetric matrix `M`, `A` with components held and the springs `C`, less `drag (A z)_n`. With the
//! factor of `M` the system is 1 plus a skew part of the size of `mu`, so that GMRES takes few steps on any mesh
//! (measured: 2 to 11). It works on forces `w` on the pairs alone: the inner unknowns are in equilibrium in all
//! directions. Three preconditioners:
//!
//! - A factor of an earlier `M`. A component that was held in it gets `w / k` as its displacement, with the springs of
//!   the pair, and the forces that this asks of the others are subtracted; one that was free and is held now keeps its force `w` as an
//!   unknown.
//! - An inverse `W` of `A`, nothing held: its block of the free components, and `w / k` for the held ones.
//! - One of the host, near the inverse of `M`: `w` are forces on all unknowns then, as no direction is in
//!   equilibrium inside, and GMRES is the flexible one (Y. Saad, *A flexible inner-outer preconditioned GMRES algorithm*,
//!   SIAM J. Sci. Comput. 14 (1993) 461-469), as the directions are kept.
//!
//! Held components have the equation `k z = 0`. Directions of earlier systems come before those of GMRES, which
//! then works on what they leave (`directions`).
//!
//! Where the factor has no springs, or nothing is held, `s` is multiplied to both sides of the preconditioner,
//! `s = 1` but across the slip, where it is `(1 + C / k)^-1/2`: so are the springs there, pair by pair.

use super::directions::{LEAST_OF_IMAGE, Moved, add_shares, forget};
use super::point::{Equations, Point};
use super::session::Session;
use crate::law::{Linearised, Plane, Vector, ellipse};
use crate::linalg::gmres::gmres;
use crate::linalg::least_squares::Columns;
use crate::linalg::tolerances::SUSPICIOUS_PIVOT;
use crate::linalg::vector::opposite;
use crate::problem::{HeldSet, StiffnessOperator};
use crate::solve::result::Ending;

/// Newton's system at a point.
pub struct System<'a> {
    equations: &'a Equations<'a>,
    /// The lack that a step takes away.
    lack: &'a [f64],
    /// The pairs on their pieces, of so many components each.
    pairs: Vec<Linearised>,
    dim: usize,
    /// The first unknown that GMRES works on: the first one of the pairs, or, without equilibrium inside, of all.
    first: usize,
    /// The components that are held on the pieces of the point.
    pub held_set: HeldSet,
}

/// A step, to first order.
pub struct Step {
    pub moved: Moved,
    /// Change of the coordinates.
    pub dy: Vec<Vector>,
    /// The part of the residual that is left for want of directions.
    pub left: f64,
}

impl<'a> System<'a> {
    /// The system at a point of these bodies.
    pub fn new(
        equations: &'a Equations<'a>,
        point: &'a Point,
        bodies: &dyn StiffnessOperator,
    ) -> Self {
        let first = if bodies.is_exact() { equations.inner } else { 0 };
        let dim = equations.contact.dim();
        let mut held_set = HeldSet::all(dim, point.y.len());
        let laws = equations.contact.pairs().iter();
        let mut pairs = Vec::with_capacity(point.y.len());
        for (at, (law, (y, &piece))) in laws.zip(point.y.iter().zip(&point.pieces)).enumerate() {
            let pair = law.linearised(piece, y);
            (0..dim).for_each(|c| held_set.held[dim * at + c] = !pair.moves(c));
            if pair.slips && bodies.is_sparse() {
                let unit = equations.root[equations.inner + dim * at + 1].powi(2);
                held_set.springs[at] = springs(&pair.curvature(), unit / SUSPICIOUS_PIVOT);
            }
            pairs.push(pair);
        }
        System { equations, lack: &point.lack, pairs, dim, first, held_set }
    }

    /// Each pair with its first component.
    fn each(&self) -> impl Iterator<Item = (usize, &Linearised)> {
        self.pairs.iter().enumerate().map(|(at, pair)| (self.dim * at, pair))
    }

    /// The unit of a component.
    fn unit(&self, i: usize) -> f64 {
        self.equations.root[self.equations.inner + i].powi(2)
    }

    /// The step to a residual of the part `forcing`, with at most so many new directions, by the last factor, or,
    /// without one, by the inverse. `known` directions are used, and new ones added.
    pub fn step(
        &self,
        bodies: &mut Session<'_>,
        (forcing, most): (f64, usize),
        known: &mut Vec<Moved>,
    ) -> Result<Step, Ending> {
        let first = self.first;
        let root = &self.equations.root[first..];
        let mut right = self.right();
        let lack = self.equations.length(self.lack);
        let mut sum = Moved { z: vec![0.0; self.lack.len()], forces: vec![0.0; right.len()] };
        bodies.monitor.goes_on()?;
        if bodies.held().is_some() && bodies.operator.is_exact() {
            let mut all = opposite(&self.lack[..first]);
            all.extend_from_slice(&right);
            sum = self.moved_by(bodies, &all)?;
            let rows = self.rows(&sum);
            right.iter_mut().zip(rows).for_each(|(right, row)| *right -= row);
        }
        right.iter_mut().zip(root).for_each(|(right, root)| *right /= root);
        let image = |moved: &Moved| -> Vec<f64> {
            self.rows(moved).iter().zip(root).map(|(row, root)| row / root).collect()
        };
        let images = Columns::new(known.iter().map(image), LEAST_OF_IMAGE);
        let (before, mut by_known) = (known.len(), images.take_out(&mut right));
        let mut taken_out = Vec::new();
        let (shares, left) = gmres(&right, forcing * lack, most, |v| {
            let mut all = vec![0.0; first];
            all.extend(v.iter().zip(root).map(|(v, root)| v * root));
            let moved = self.moved_by(bodies, &all)?;
            let mut row = image(&moved);
            taken_out.push(images.take_out(&mut row));
            known.push(moved);
            Ok::<_, Ending>(row)
        })?;
        for (share, taken_out) in shares.iter().zip(&taken_out) {
            by_known.iter_mut().zip(taken_out).for_each(|(sum, part)| *sum -= share * part);
        }
        let mut all = images.coefficients(by_known);
        all.extend(shares);
        add_shares(known, &all, &mut sum);
        let inner = self.equations.inner;
        let dy = self.coordinates(&sum.z[inner..], &sum.forces[inner - first..]);
        let left = if known.len() - before < most { 0.0 } else { left / lack };
        forget(known);
        Ok(Step { moved: sum, dy, left })
    }

    /// The right sides of all unknowns from the first one on, zero of held ones.
    fn right(&self) -> Vec<f64> {
        let (inside, lack) = self.lack.split_at(self.equations.inner);
        let inside = &inside[self.first..];
        let mut all = opposite(inside);
        all.resize(self.lack.len() - self.first, 0.0);
        let right = &mut all[inside.len()..];
        for (n, pair) in self.each() {
            if !pair.closed {
                right[n] = -lack[n];
            }
            for c in (1..self.dim).filter(|_| pair.slips) {
                right[n + c] = pair.slopes.drag[c - 1] * lack[n] - lack[n + c];
            }
        }
        all
    }

    /// The left sides for a change of all unknowns.
    fn rows(&self, Moved { z, forces }: &Moved) -> Vec<f64> {
        let (dim, inner) = (self.dim, self.equations.inner);
        let z = &z[inner..];
        let mut all = forces.clone();
        let (forces, rows) = (&forces[inner - self.first..], &mut all[inner - self.first..]);
        for (n, pair) in self.each() {
            let turned = ellipse::product(&pair.curvature(), tangential(&z[n..n + dim]));
            for c in 1..dim {
                rows[n + c] += turned[c - 1] - pair.slopes.drag[c - 1] * forces[n];
            }
        }
        for i in (0..rows.len()).filter(|&i| self.held_set.held[i]) {
            rows[i] = self.unit(i) * z[i];
        }
        all
    }

    /// The displacements of forces on all unknowns.
    fn moved_by(&self, bodies: &mut Session<'_>, all: &[f64]) -> Result<Moved, Ending> {
        let inner = self.equations.inner;
        let factor = bodies.held();
        let softens = factor.is_none() || !bodies.operator.is_sparse();
        let mut all = all.to_vec();
        if softens {
            self.soften(&mut all[inner..]);
        }
        let mut z = match factor {
            Some(factor) => self.by_factor(bodies, &factor, all)?,
            None => self.by_inverse(bodies, all)?,
        };
        if softens {
            self.soften(&mut z[inner..]);
        }
        let forces = bodies.product(&z)?.split_off(self.first);
        Ok(Moved { z, forces })
    }

    /// Multiplies `s` to the tangential components of slipping pairs.
    fn soften(&self, values: &mut [f64]) {
        let dim = self.dim;
        for (n, pair) in self.each().filter(|(_, pair)| pair.slips) {
            let curvature = pair.curvature();
            let stiffness = curvature[0][0] + curvature[1][1];
            if stiffness > 0.0 {
                let softening = (1.0 + stiffness / self.unit(n + 1)).sqrt().recip();
                let taken = (1.0 - softening) / stiffness;
                let across = ellipse::product(&curvature, tangential(&values[n..n + dim]));
                (1..dim).for_each(|c| values[n + c] -= taken * across[c - 1]);
            }
        }
    }

    /// By an earlier factor.
    fn by_factor(
        &self,
        bodies: &mut Session<'_>,
        factor: &HeldSet,
        mut forces: Vec<f64>,
    ) -> Result<Vec<f64>, Ending> {
        let inner = self.equations.inner;
        let mut released = vec![0.0; forces.len()];
        if self.release(factor, &forces[inner..], &mut released[inner..]) {
            let asked = bodies.product(&released)?;
            forces.iter_mut().zip(asked).for_each(|(force, asked)| *force -= asked);
        }
        let mut z = bodies.solve(&forces)?;
        z.iter_mut().zip(&released).for_each(|(z, released)| *z += released);
        Ok(z)
    }

    /// The displacements of components that are held in a factor under forces `w`, each pair for itself: on springs
    /// of its units, and on those that it has across its slip. Returns whether there are any.
    fn release(&self, factor: &HeldSet, w: &[f64], released: &mut [f64]) -> bool {
        let dim = self.dim;
        for ((n, pair), springs) in self.each().zip(&self.held_set.springs) {
            for i in (n..n + dim).filter(|&i| factor.held[i]) {
                released[i] = w[i] / self.unit(i);
            }
            if pair.slips && dim > 2 && factor.held[n + 1] {
                let [[a, b], [_, c]] = *springs;
                let (a, c) = (a + self.unit(n + 1), c + self.unit(n + 2));
                let determinant = a * c - b * b;
                released[n + 1] = (c * w[n + 1] - b * w[n + 2]) / determinant;
                released[n + 2] = (a * w[n + 2] - b * w[n + 1]) / determinant;
            }
        }
        released.iter().any(|z| *z != 0.0)
    }

    /// By the block of an inverse.
    fn by_inverse(&self, bodies: &mut Session<'_>, mut w: Vec<f64>) -> Result<Vec<f64>, Ending> {
        let held = (0..w.len()).filter(|&i| self.held_set.held[i]);
        let own: Vec<(usize, f64)> =
            held.map(|i| (i, std::mem::take(&mut w[i]) / self.unit(i))).collect();
        let mut z = bodies.solve(&w)?;
        own.iter().for_each(|(i, displacement)| z[*i] = *displacement);
        Ok(z)
    }

    /// The change of the coordinates.
    fn coordinates(&self, z: &[f64], product: &[f64]) -> Vec<Vector> {
        let (dim, lack) = (self.dim, &self.lack[self.equations.inner..]);
        let coordinates = |(n, pair): (usize, &Linearised)| {
            let reaction = |c: usize| -(lack[n + c] + product[n + c]);
            let scaled = pair.scaled(&z[n..n + dim]);
            let turned = ellipse::product(&pair.curvature(), tangential(&z[n..n + dim]));
            let mut dy = [0.0; 3];
            dy[0] = if pair.closed { reaction(0) } else { scaled[0] };
            for c in 1..dim {
                dy[c] = match pair.slips {
                    true => scaled[c] + turned[c - 1] + pair.slopes.drag[c - 1] * dy[0],
                    false => reaction(c),
                };
            }
            dy
        };
        self.each().map(coordinates).collect()
    }
}

/// Number of pairs of which a component is held in one held set only.
pub fn changed(a: &HeldSet, b: &HeldSet) -> usize {
    let dim = a.held.len() / a.springs.len().max(1);
    let pairs = a.held.chunks_exact(dim.max(1)).zip(b.held.chunks_exact(dim.max(1)));
    pairs.filter(|(a, b)| a != b).count()
}

/// The springs of a curvature: its symmetric part with negative eigenvalues set to zero. The curvature of an associated
/// law is that itself; that of a collinear law is not symmetric, and its symmetric part is indefinite where the slip
/// turns: no factor may exist with it. Where a slip has hardly begun the curvature may be 1e15 times the stiffness of
/// the bodies, which its rounding would hide: no spring is more than `stiffest`, beside which nothing moves either.
fn springs(plane: &Plane, stiffest: f64) -> Plane {
    let [[a, _], [_, c]] = *plane;
    let across = (plane[0][1] + plane[1][0]) / 2.0;
    let (middle, radius) = ((a + c) / 2.0, ((a - c) / 2.0).hypot(across));
    let (least, largest) = (middle - radius, middle + radius);
    let softer = if largest > stiffest { stiffest / largest } else { 1.0 };
    let scaled = |part: f64, [a, across, c]: [f64; 3]| {
        [[part * a, part * across], [part * across, part * c]]
    };
    if least >= 0.0 {
        return scaled(softer, [a, across, c]);
    }
    scaled(softer * largest.max(0.0) / (2.0 * radius), [a - least, across, c - least])
}

/// The tangential components of a pair's part of a vector; the second is 0 in the plane.
fn tangential(v: &[f64]) -> [f64; 2] {
    [v[1], v.get(2).copied().unwrap_or(0.0)]
}
