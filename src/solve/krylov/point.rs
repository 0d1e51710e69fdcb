//! A point of the law on bodies whose stiffness is not formed, with what it lacks to equilibrium.

use crate::error::Error;
use crate::law::piece::Piece;
use crate::law::{Contact, Vector};
use crate::linalg::vector::{NormSum, norm};
use crate::problem::{Bodies, Unformed};

/// The equations `A x - b + (0, P) = 0` with `(d, P)` on the law of each pair.
pub struct Equations<'a> {
    pub contact: &'a Contact<'a, Unformed<'a>>,
    /// `b`, of all unknowns.
    pub load: &'a [f64],
    /// Number of inner unknowns.
    pub inner: usize,
    /// Roots of the units of all unknowns.
    pub root: Vec<f64>,
    /// Size of the relative loads, a force.
    pub unit: f64,
}

impl<'a> Equations<'a> {
    pub fn new(
        contact: &'a Contact<'a, Unformed<'a>>,
        bodies: &dyn Bodies,
        load: &'a [f64],
        relative: &[f64],
    ) -> Self {
        let mut root: Vec<f64> = bodies.units().iter().map(|unit| unit.sqrt()).collect();
        let scales =
            contact.pairs().iter().flat_map(|law| law.scale().into_iter().take(contact.dim()));
        root[bodies.inner()..].iter_mut().zip(scales).for_each(|(root, k)| *root = k.sqrt());
        Equations { contact, load, inner: bodies.inner(), root, unit: norm(relative) }
    }

    /// Length of a vector of forces on all unknowns, each in its unit.
    pub fn length(&self, forces: &[f64]) -> f64 {
        let mut sum = NormSum::default();
        forces.iter().zip(&self.root).for_each(|(force, root)| sum.add(force / root));
        sum.root()
    }

    /// `eta` of displacements of all unknowns with their residual.
    fn eta(&self, x: &[f64], residual: &[f64]) -> f64 {
        let (inner, raw) = residual.split_at(self.inner);
        let mut sum = NormSum::default();
        inner.iter().for_each(|&lack| sum.add(lack));
        let mut natural = [0.0; 3];
        for (law, d, raw) in self.contact.each(&x[self.inner..], raw) {
            law.natural_residual(d, raw, &mut natural);
            natural[..d.len()].iter().for_each(|&e| sum.add(e));
        }
        sum.root() / self.unit.max(norm(raw))
    }

    /// The point whose contact forces are those that hold the pairs at `d`; `x` has all unknowns, of which the
    /// inner ones are in equilibrium.
    pub fn held_at(&self, x: Vec<f64>, bodies: &mut dyn Bodies) -> Result<Point, Error> {
        let residual = self.residual(bodies, &x)?;
        let forces = &residual[self.inner..];
        let y = self.contact.each(&x[self.inner..], forces).map(|(law, d, f)| law.chart(d, f));
        let y = y.collect();
        self.point(bodies, x, y, |_, _| None)
    }

    /// `A x - b`.
    pub fn residual(&self, bodies: &mut dyn Bodies, x: &[f64]) -> Result<Vec<f64>, Error> {
        let mut residual = bodies.product(x)?;
        residual.iter_mut().zip(self.load).for_each(|(sum, b)| *sum -= b);
        Ok(residual)
    }

    /// The point at `y`, with the inner unknowns of `x`. `known` may tell the residual where `d` differs by a vector
    /// from the entries of `x`.
    pub fn point(
        &self,
        bodies: &mut dyn Bodies,
        mut x: Vec<f64>,
        y: Vec<Vector>,
        known: impl FnOnce(&mut dyn Bodies, &[f64]) -> Option<Result<Vec<f64>, Error>>,
    ) -> Result<Point, Error> {
        let dim = self.contact.dim();
        let (mut pieces, mut push) = (Vec::with_capacity(y.len()), vec![0.0; x.len()]);
        let mut apart = vec![0.0; x.len()];
        for (pair, (law, y)) in self.contact.pairs().iter().zip(&y).enumerate() {
            let piece = law.piece(y);
            let p = law.push_on(piece, y);
            let d = law.displacement(y, &p);
            for (c, i) in (self.inner + dim * pair..self.inner + dim * (pair + 1)).enumerate() {
                (push[i], apart[i]) = (p[c], d[c] - x[i]);
                x[i] = d[c];
            }
            pieces.push(piece);
        }
        let residual = match known(bodies, &apart) {
            Some(residual) => residual?,
            None => self.residual(bodies, &x)?,
        };
        let lack: Vec<f64> = residual.iter().zip(&push).map(|(r, p)| r + p).collect();
        let (merit, eta) = (self.length(&lack), self.eta(&x, &residual));
        Ok(Point { y, pieces, x, residual, lack, merit, eta })
    }
}

/// A point of the law.
pub struct Point {
    /// The coordinates on the chart of the law, pair by pair.
    pub y: Vec<Vector>,
    /// The pieces on which they are.
    pub pieces: Vec<Piece>,
    /// Displacements of all unknowns.
    pub x: Vec<f64>,
    /// `A x - b`.
    pub residual: Vec<f64>,
    /// `A x - b + (0, P)`, zero at solutions.
    pub lack: Vec<f64>,
    /// Length of the lack.
    pub merit: f64,
    /// As the certificate measures it.
    pub eta: f64,
}
