//! True if contact forces can balance the loads on the rigid motions at all, whatever the
//! displacements.
//!
//! With a basis `N` of the motions that `K` does not resist, balance is `Nᵀ (f + F) = 0` for forces
//! `F` in the friction cones. The forces that come nearest leave `e = Nᵀ (f + F)`; if it is not zero,
//! `r = N e` is a motion on which the loads do work, `f . r = |e|²`, and no admissible force does
//! negative work: what [`crate::certificate::is_escape`] asks of a proof. Forces that a law bounds, as cohesion does, take
//! no part; the certificate asks if the work of the loads is more than theirs.
//!
//! In space a cone has infinitely many edges. The projection begins with a few (non-negative least
//! squares); where a force of a cone does negative work on `r`, the edge of the least work joins, and
//! the projection is repeated (cutting planes, on the exact disc), until little is left of it. The rest is
//! taken away by Newton's method on the pairs that still approach their obstacles, in motions that stay rigid.

use std::f64::consts::SQRT_2;

use super::motions::RigidMotions;
use crate::certificate::is_escape_of;
use crate::law::{Contact, PairLaw};
use crate::linalg::least_squares::least_squares;
use crate::linalg::nnls::{self, Nearest};
use crate::linalg::tolerances::NEGLIGIBLE;
use crate::linalg::vector::{dot, largest_of, norm};
use crate::monitor::Watch;
use crate::problem::{Relation, Stiffness};
use crate::solve::result::{Call, Ending};

/// Approach of a pair beside the motion that is more than its own rounding.
const STOPPED: f64 = 2.0 * f64::EPSILON;

/// Pairs whose edges join in one round.
const JOINING: usize = 4;

/// Approach of a pair beside the largest motion that Newton's method takes away; a pair that moves less is brought to rest.
const NEARLY: f64 = 1e-6;

/// A force of 1 along each component.
const UNIT_FORCES: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Steps of Newton's method for a motion that approaches no obstacle.
const STEPS: usize = 20;

/// Rounds of cutting planes: a hundred were the most where it converged.
const MOST_ROUNDS: usize = 300;

/// A recession direction that the loads drive; `None` also if there is no time to look for it.
pub fn escape(contact: &Contact<'_>, monitor: &dyn Watch) -> Option<Vec<f64>> {
    Balance::new(contact, monitor)?.escape()
}

/// As [`escape`], for a method that comes behind others. The plan of a problem with friction has asked before: nothing was found.
pub fn escape_behind_others(call: &Call<'_>) -> Option<Vec<f64>> {
    let is_asked = !call.is_chosen() && !call.contact.is_frictionless();
    if is_asked { None } else { escape(call.contact, call.monitor) }
}

/// Is asked if a motion proves that no equilibrium exists.
type Proves<'c> = dyn Fn(&[f64]) -> bool + 'c;

/// The rigid motions of a problem, and the forces that balance them.
pub struct Balance<'c, R = Stiffness<'c>> {
    pub(super) contact: &'c Contact<'c, R>,
    pub(super) motions: RigidMotions,
    /// The certificate.
    proves: Box<Proves<'c>>,
    monitor: &'c dyn Watch,
}

impl<'c> Balance<'c> {
    /// `None` if `K` is not symmetric, if there are no such motions, or if there is no time to find them.
    pub fn new(contact: &'c Contact<'c>, monitor: &'c dyn Watch) -> Option<Self> {
        if !contact.problem().is_symmetric() {
            return None;
        }
        let motions = RigidMotions::of(contact.problem(), monitor)?;
        Some(Balance::of(contact, motions, monitor, move |r: &[f64]| is_escape_of(contact, r)))
    }
}

impl<'c, R: Relation> Balance<'c, R> {
    /// The balance on these motions; `proves` is the certificate's answer on one of them.
    pub fn of(
        contact: &'c Contact<'c, R>,
        motions: RigidMotions,
        monitor: &'c dyn Watch,
        proves: impl Fn(&[f64]) -> bool + 'c,
    ) -> Self {
        Balance { contact, motions, proves: Box::new(proves), monitor }
    }

    /// The ending of a method along whose motion bodies move away: a proof that no equilibrium exists, if the motion
    /// made rigid is one and contact stops it nowhere, not even by what the certificate takes for rounding.
    pub fn ending_away(&self, motion: &[f64]) -> Ending {
        let rigid = self.motions.part(motion);
        let proof = self.sharpened(rigid.clone());
        let is_stopped = self.nearest(&proof) > STOPPED * self.motions.size(&proof);
        if !is_stopped && (self.proves)(&proof) {
            Ending::Recession(proof)
        } else {
            Ending::RunsAway(rigid)
        }
    }

    /// A motion that proves that no equilibrium exists without the rounding of the method that found it: made
    /// rigid, and lifted where contact would stop it. The given one, if that is no proof.
    pub fn sharpened(&self, motion: Vec<f64>) -> Vec<f64> {
        let rigid = self.cleared(self.motions.part(&motion));
        if (self.proves)(&rigid) { rigid } else { motion }
    }

    /// A recession direction that the loads drive, if it is found by the cones in which forces have no bound,
    /// and in time.
    pub fn escape(&self) -> Option<Vec<f64>> {
        self.balanced(|_| true).err()?
    }

    /// Forces in the cones of pairs that may press that balance the loads, or a recession direction that these drive. In space
    /// forces of few edges are looked at, and `Err(None)` says nothing; nor does it where the monitor ends the search.
    pub fn balanced(&self, presses: impl Fn(usize) -> bool) -> Result<Vec<f64>, Option<Vec<f64>>> {
        let contact = self.contact;
        let load = self.on_motions(contact.load_with_tension(), 0);
        let pairs = contact.pairs().iter().enumerate().filter(|(pair, _)| presses(*pair));
        let of_pair =
            |(pair, law): (usize, &PairLaw)| law.cone_edges().into_iter().map(move |e| (pair, e));
        let mut edges: Vec<(usize, [f64; 3])> = pairs.flat_map(of_pair).collect();
        // Motions move the pairs of other bodies by rounding, which would ask for forces without end.
        let moved = |(pair, edge): &(usize, [f64; 3])| norm(&self.on_pair(edge, *pair));
        let least = NEARLY * largest_of(edges.iter().map(moved));
        edges.retain(|edge| moved(edge) > least);
        let mut last = Vec::new();
        for _ in 0..MOST_ROUNDS {
            let columns: Vec<Vec<f64>> =
                edges.iter().map(|(pair, edge)| self.on_pair(edge, *pair)).collect();
            let rest = match nnls::nearest(&load, &columns, &mut self.monitor.asking()) {
                Some(Nearest::Left(rest)) => rest,
                Some(Nearest::Nothing(shares)) => return Ok(self.sum(&edges, &shares)),
                None => break,
            };
            let motion = self.motions.motion(&rest);
            if self.nearest(&motion) <= NEARLY * self.motions.size(&motion) {
                let proof = self.sharpened(motion.clone());
                if (self.proves)(&proof) {
                    return Err(Some(proof));
                }
            }
            if rest == last {
                break;
            }
            let worst = self.worst(&motion).into_iter().filter(|&pair| presses(pair));
            for pair in worst.take(JOINING) {
                let own = &motion[contact.dim() * pair..contact.dim() * (pair + 1)];
                edges.push((pair, contact.pairs()[pair].opposing_edge(own)));
            }
            last = rest;
        }
        Err(None)
    }

    /// The forces with these shares of edges of pairs.
    fn sum(&self, edges: &[(usize, [f64; 3])], shares: &[(usize, f64)]) -> Vec<f64> {
        let (dim, mut force) = (self.contact.dim(), vec![0.0; self.motions.root.len()]);
        for &(column, share) in shares {
            let (pair, edge) = &edges[column];
            let own = force[dim * pair..].iter_mut().zip(&edge[..dim]);
            own.for_each(|(force, edge)| *force += share * edge);
        }
        force
    }

    /// Work on each motion of forces whose first component is `first`.
    fn on_motions(&self, force: &[f64], first: usize) -> Vec<f64> {
        let scaled: Vec<f64> = force
            .iter()
            .zip(&self.motions.root[first..])
            .map(|(force, root)| force / root)
            .collect();
        self.motions.basis.iter().map(|v| dot(&v[first..first + force.len()], &scaled)).collect()
    }

    /// Work on each motion of a force of a pair.
    fn on_pair(&self, force: &[f64], pair: usize) -> Vec<f64> {
        let dim = self.contact.dim();
        self.on_motions(&force[..dim], dim * pair)
    }

    /// `r_n + slope |r_t|` of each pair, in the unit of `root`.
    fn approaches(&self, motion: &[f64]) -> Vec<f64> {
        let dim = self.contact.dim();
        let parts = self.contact.pairs().iter().zip(motion.chunks_exact(dim));
        let roots = self.motions.root.iter().step_by(dim);
        parts.zip(roots).map(|((law, r), root)| law.recession(r).approach * root).collect()
    }

    /// Largest approach of a pair, in the unit of `root`; 0 if there is none.
    fn nearest(&self, motion: &[f64]) -> f64 {
        self.approaches(motion).into_iter().fold(0.0, f64::max)
    }

    /// The pairs with a force that does negative work on a motion, those of most work first.
    fn worst(&self, motion: &[f64]) -> Vec<usize> {
        let (least, approaches) = (NEGLIGIBLE * self.motions.size(motion), self.approaches(motion));
        let mut worst: Vec<usize> =
            (0..approaches.len()).filter(|&pair| approaches[pair] > least).collect();
        worst.sort_by(|&a, &b| approaches[b].total_cmp(&approaches[a]));
        worst
    }

    /// A motion next to this one along which no pair approaches its obstacle; as near to that as its steps come. Newton's
    /// method solves `r_n + slope |r_t|* = 0` of the pairs that slide. Rounding of the motions leaves equations that
    /// contradict each other in the last digits, and the least lift that the inequalities ask for takes these away.
    fn cleared(&self, mut motion: Vec<f64>) -> Vec<f64> {
        for _ in 0..STEPS {
            let (nearest, size) = (self.nearest(&motion), self.motions.size(&motion));
            if nearest <= STOPPED * size {
                break;
            }
            let lift = self.least_lift(&motion, nearest);
            let lift = lift.filter(|step| self.motions.size(step) <= NEARLY * size);
            let better = std::iter::once(self.step_away(&motion))
                .chain(lift)
                .map(|step| motion.iter().zip(step).map(|(r, step)| r + step).collect::<Vec<f64>>())
                .map(|moved| (self.nearest(&moved), moved))
                .filter(|(to, _)| *to < nearest)
                .min_by(|(a, _), (b, _)| a.total_cmp(b));
            let Some((_, better)) = better else { break };
            motion = better;
        }
        motion
    }

    /// True if the pair moves by more than little beside a motion of the `size`.
    fn moves(&self, pair: usize, own: &[f64], size: f64) -> bool {
        let roots = &self.motions.root[self.contact.dim() * pair..];
        own.iter().zip(roots).any(|(r, root)| (r * root).abs() > NEARLY * size)
    }

    /// The motion that takes away the approach of the pairs that move towards their obstacles or along them, to first order
    /// in the slip, and brings to rest those that nearly are, by least squares.
    fn step_away(&self, motion: &[f64]) -> Vec<f64> {
        let dim = self.contact.dim();
        let size = self.motions.size(motion);
        let mut equations = Vec::new();
        for (pair, approach) in self.approaches(motion).into_iter().enumerate() {
            if approach <= -NEGLIGIBLE * size {
                continue;
            }
            let own = &motion[dim * pair..dim * (pair + 1)];
            let mut ask = |force: &[f64]| {
                let (row, work) = self.row(force, pair, own);
                equations.push((row, -work));
            };
            match self.moves(pair, own, size) {
                true => ask(&self.contact.pairs()[pair].opposing_edge(own)),
                false => UNIT_FORCES[..dim].iter().for_each(|force| ask(force)),
            }
        }
        self.motions.motion(&solved(&equations, self.motions.basis.len()))
    }

    /// The least motion that lifts every pair off its obstacle, to first order in the slip, from a motion on which pairs
    /// approach by `nearest` at most; `None` if there is none. Least distance programming: of `e . x >= b`, the sum of
    /// columns `(e, b)` nearest to `(0, -1)` leaves `(r, -s)`, and `x = r / s` (Lawson and Hanson, chapter 23).
    fn least_lift(&self, motion: &[f64], nearest: f64) -> Option<Vec<f64>> {
        let (dim, size) = (self.contact.dim(), self.motions.size(motion));
        let mut columns = Vec::new();
        let pairs = self.contact.pairs().iter().enumerate();
        for (pair, law) in pairs.filter(|(_, law)| law.has_obstacle()) {
            let own = &motion[dim * pair..dim * (pair + 1)];
            let edges = match self.moves(pair, own, size) {
                true => vec![law.opposing_edge(own)],
                // Four edges of a cone around that of all forces.
                false => law.cone_edges().into_iter().map(|[n, t, s]| [n / SQRT_2, t, s]).collect(),
            };
            for edge in edges {
                let (mut column, work) = self.row(&edge, pair, own);
                column.push(-work / nearest);
                columns.push(column);
            }
        }
        let mut target = vec![0.0; self.motions.basis.len()];
        target.push(-1.0);
        let left = nnls::nearest(&target, &columns, &mut self.monitor.asking())?;
        let Nearest::Left(mut rest) = left else { return None };
        let along = -rest.pop()?;
        rest.iter_mut().for_each(|x| *x *= nearest / along);
        Some(self.motions.motion(&rest))
    }

    /// Work of a force of a pair on each motion, and on its motion `own`, in the unit of `root`.
    fn row(&self, force: &[f64], pair: usize, own: &[f64]) -> (Vec<f64>, f64) {
        let root = self.motions.root[self.contact.dim() * pair];
        let row = self.on_pair(force, pair).iter().map(|work| work * root).collect();
        (row, dot(&force[..own.len()], own) * root)
    }
}

/// The `n` unknowns of equations, rows and right sides, by least squares; 0 for those that the equations do not tell.
fn solved(equations: &[(Vec<f64>, f64)], n: usize) -> Vec<f64> {
    let column = |i: usize| -> Vec<f64> {
        let own: Vec<f64> = equations.iter().map(|(row, _)| row[i]).collect();
        if norm(&own) > NEGLIGIBLE { own } else { vec![0.0; own.len()] }
    };
    let right: Vec<f64> = equations.iter().map(|(_, right)| *right).collect();
    least_squares((0..n).map(column), &right)
}

#[cfg(test)]
mod tests;
