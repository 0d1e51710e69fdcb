//! A point of the law on bodies whose stiffness is not formed, with what it lacks to equilibrium.

use super::session::Session;
use crate::error::Error;
use crate::law::{Contact, Piece, Vector, natural_sum, scale_roots};
use crate::linalg::double_double::add_to_parts;
use crate::linalg::vector::{norm, norm_of};
use crate::problem::{MatrixFree, Relation, SOLUTIONS, StiffnessOperator};
use crate::solve::result::Ending;

/// Part of the forces inside that each of [`SOLUTIONS`] solutions for a measure leaves where there is a preconditioner alone:
/// below the rounding of doubles in the end.
const LEFT_BY_MEASURE: f64 = 1e-8;

/// The equations `A x - b + (0, P) = 0` with `(d, P)` on the law of each pair.
pub struct Equations<'a> {
    pub contact: &'a Contact<'a, MatrixFree<'a>>,
    /// `b`, of all unknowns.
    pub load: &'a [f64],
    /// Number of inner unknowns.
    pub inner: usize,
    /// Roots of the units of all unknowns.
    pub root: Vec<f64>,
    /// Size of the relative loads, or of the rounding of all loads if that is more, a force.
    pub unit: f64,
    /// Tolerance of their solution.
    pub tolerance: f64,
}

impl<'a> Equations<'a> {
    pub fn new(
        contact: &'a Contact<'a, MatrixFree<'a>>,
        bodies: &dyn StiffnessOperator,
        load: &'a [f64],
        tolerance: f64,
    ) -> Self {
        let relation = contact.problem().relation();
        let unit = norm(relation.load()).max(relation.size_of_force(&[]));
        let mut root: Vec<f64> = bodies.units().iter().map(|unit| unit.sqrt()).collect();
        root.truncate(bodies.inner());
        root.extend(scale_roots(contact.pairs(), contact.dim()));
        Equations { contact, load, inner: bodies.inner(), root, unit, tolerance }
    }

    /// Length of a vector of forces on all unknowns, each in its unit.
    pub fn length(&self, forces: &[f64]) -> f64 {
        norm_of(forces.iter().zip(&self.root).map(|(force, root)| force / root))
    }

    /// `eta` of displacements of all unknowns with their residual.
    fn eta(&self, x: &[f64], residual: &[f64]) -> f64 {
        let (inner, raw) = residual.split_at(self.inner);
        let mut sum = natural_sum(self.contact.each(&x[self.inner..], raw));
        inner.iter().for_each(|&lack| sum.add(lack));
        sum.root() / self.unit.max(norm(raw))
    }

    /// The point whose contact forces are those that hold the pairs at displacements of which the inner ones are in
    /// equilibrium.
    pub fn held_at(&self, at: Displacements, bodies: &mut Session<'_>) -> Result<Point, Error> {
        let residual = bodies.residual(&at.x, &at.low, self.load)?;
        let forces = &residual[self.inner..];
        let y = self.contact.each(&at.x[self.inner..], forces).map(|(law, d, f)| law.chart(d, f));
        let y = y.collect();
        self.point(bodies, at, y, None)
    }

    /// The point at `y`, with the inner unknowns of `at`; `known` is the residual at `at`, if it is known.
    pub fn point(
        &self,
        bodies: &mut Session<'_>,
        mut at: Displacements,
        y: Vec<Vector>,
        known: Option<Vec<f64>>,
    ) -> Result<Point, Error> {
        let dim = self.contact.dim();
        let x = &mut at.x;
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
        let residual = match known {
            Some(mut residual) if apart.iter().any(|apart| *apart != 0.0) => {
                let product = bodies.product(&apart)?;
                residual.iter_mut().zip(product).for_each(|(sum, product)| *sum += product);
                residual
            }
            Some(residual) => residual,
            None => bodies.residual(&at.x, &at.low, self.load)?,
        };
        let lack: Vec<f64> = residual.iter().zip(&push).map(|(r, p)| r + p).collect();
        let (merit, eta) = (self.length(&lack), self.eta(&at.x, &residual));
        Ok(Point { y, pieces, at, residual, lack, merit, eta })
    }
}

/// Displacements of all unknowns. A double cannot hold inner ones to the accuracy that forces on a fine mesh ask
/// for, so that they have two parts.
#[derive(Clone, Default)]
pub struct Displacements {
    /// All unknowns.
    pub x: Vec<f64>,
    /// The part of the inner ones that rounding to doubles has left out.
    pub low: Vec<f64>,
}

impl Displacements {
    /// No displacements of so many unknowns, of which the first `inner` are inner ones.
    pub fn zero(unknowns: usize, inner: usize) -> Self {
        Displacements { x: vec![0.0; unknowns], low: vec![0.0; inner] }
    }

    /// With what is not held in equilibrium with a load. Without a factor this part of the lack is left.
    pub fn in_equilibrium(
        self,
        bodies: &mut Session<'_>,
        (load, left): (&[f64], f64),
    ) -> Result<Self, Ending> {
        if !bodies.has_free_unknowns() {
            return Ok(self);
        }
        let lack = bodies.residual(&self.x, &self.low, load)?;
        let step = bodies.solve_to((&lack, left))?;
        Ok(self.moved(-1.0, &step))
    }

    /// With inner ones in equilibrium to the rounding of doubles, pairs of `dim` components held.
    pub fn settled(
        mut self,
        (bodies, dim): (&mut Session<'_>, usize),
        load: &[f64],
    ) -> Result<Self, Ending> {
        bodies.hold_all(dim)?;
        for _ in 0..SOLUTIONS {
            self = self.in_equilibrium(bodies, (load, LEFT_BY_MEASURE))?;
        }
        Ok(self)
    }

    /// With a share of other displacements.
    pub fn plus(&self, share: f64, other: &Displacements) -> Self {
        let mut sum = self.moved(share, &other.x);
        sum.low.iter_mut().zip(&other.low).for_each(|(low, other)| *low += share * other);
        sum
    }

    /// A `part` of `step` further.
    pub fn moved(&self, part: f64, step: &[f64]) -> Self {
        let mut next = self.clone();
        let (inner, pairs) = next.x.split_at_mut(self.low.len());
        add_to_parts((inner, &mut next.low), step.iter().map(|step| part * step));
        let steps = &step[self.low.len()..];
        pairs.iter_mut().zip(steps).for_each(|(x, step)| *x += part * step);
        next
    }
}

/// A point of the law.
#[derive(Clone)]
pub struct Point {
    /// The coordinates on the chart of the law, pair by pair.
    pub y: Vec<Vector>,
    /// The pieces on which they are.
    pub pieces: Vec<Piece>,
    /// Displacements of all unknowns.
    pub at: Displacements,
    /// `A x - b`.
    pub residual: Vec<f64>,
    /// `A x - b + (0, P)`, zero at solutions.
    pub lack: Vec<f64>,
    /// Length of the lack.
    pub merit: f64,
    /// As the certificate measures it.
    pub eta: f64,
}
