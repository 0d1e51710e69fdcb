//! Newton's method on the flexibility itself: no stiffness is formed, and a pair without a force costs nothing.
//!
//! The unknowns are the coordinates `y` of the normal map, whose `(v, P)` obey the law. What is left to be solved is
//!
//! ```text
//! H(y) = d(y) - q - W F = 0,    F = -P(y)
//! ```
//!
//! A pair that is open has `dP = 0`: its columns are `dd/dy` alone, so that the system is one of the other pairs, and its
//! own coordinates follow. Where `W` is singular the system is damped: `ε D⁻¹ dP` is added, with an `ε` of the size of the
//! lack, which is nothing at a solution.

use super::step::ended;
use crate::law::{Contact, Linearised, PairLaw, Vector, natural_sum, references, scale_roots};
use crate::linalg::factor::{Factor, cholesky_work, lu_work};
use crate::linalg::matrix::Matrix;
use crate::linalg::tolerances::SINGULAR;
use crate::linalg::vector::{norm, norm_of};
use crate::monitor::Watch;
use crate::problem::{Flexibility, Relation};
use crate::settings::{Method, Settings};
use crate::solve::newton::{Goal, NewtonOutcome, NormalMap, descend};
use crate::solve::result::{Ending, Solution};

/// Least and largest damping, beside flexibilities of size one. With `1e-3` fewer first starts arrive, with `0.1` more of
/// them arrive and fewer of those that are drawn.
const DAMPING: [f64; 2] = [1e-13, 1e-2];

/// Part of the tolerance that is aimed at: forces are known to less than `eta` where `W` hardly feels them, and the last
/// system of Newton's method gives most of the digits.
pub const ACCURATE: f64 = 1e-3;

/// Operations of a solution on the inverse of `W` beside those of the inverse: the solution takes about as many, with the last system
/// on `W`.
const BY_INVERSE: f64 = 2.0;

/// How Newton's method ends where the inverse of `W` is cheaper.
pub const DEAR: Ending = Ending::Stalled("the inverse of W is cheaper");

impl NewtonOutcome<LawPoint> {
    /// The result, with a certificate.
    pub fn solution(
        &self,
        contact: &Contact<'_, Flexibility<'_>>,
        settings: &Settings,
    ) -> Solution {
        let force = &self.point.force;
        let d = contact.problem().relation().relative(force);
        ended(contact, (d, force), settings, (Method::Newton, &self.ending, self.systems))
    }
}

/// The equations of a problem.
pub struct OnFlexibility<'c, 'p> {
    contact: &'c Contact<'p, Flexibility<'p>>,
    monitor: &'c dyn Watch,
    is_definite: bool,
    /// Operations that factorisations may still take.
    work: f64,
    /// Roots of the scales of the components: `y / root` and `root d` are of one unit.
    root: Vec<f64>,
}

/// A point of the law.
pub struct LawPoint {
    /// The coordinates.
    pub y: Vec<Vector>,
    /// Contact forces.
    pub force: Vec<f64>,
    /// `H`, a length.
    lack: Vec<f64>,
    /// Length of `H`.
    pub merit: f64,
    /// `eta` of the forces, as far as it is known without a certificate.
    pub eta: f64,
}

impl<'c, 'p> OnFlexibility<'c, 'p> {
    /// The equations, undamped if `W` is definite.
    pub fn new(
        contact: &'c Contact<'p, Flexibility<'p>>,
        is_definite: bool,
        monitor: &'c dyn Watch,
    ) -> Self {
        let root = scale_roots(contact.pairs(), contact.dim()).collect();
        OnFlexibility { contact, monitor, is_definite, work: f64::INFINITY, root }
    }

    /// As long as factorisations take no more operations than a solution on the inverse of `W` would.
    pub fn while_cheap(self) -> Self {
        let n = self.root.len();
        OnFlexibility { work: BY_INVERSE * (cholesky_work(n) + lu_work(n)), ..self }
    }

    /// Whatever factorisations take.
    pub fn at_any_cost(self) -> Self {
        OnFlexibility { work: f64::INFINITY, ..self }
    }

    fn relation(&self) -> &'p Flexibility<'p> {
        self.contact.problem().relation()
    }

    /// The coordinates of contact forces, and of the displacements that they cause.
    pub fn coordinates(&self, force: &[f64]) -> Vec<Vector> {
        let d = self.caused(force);
        self.contact.each(&d, force).map(|(law, d, force)| law.chart(d, force)).collect()
    }

    /// The length of `H` where there is no force and no slip beside the reference.
    pub fn size(&self) -> f64 {
        let lack = references(self.contact.pairs(), self.contact.dim())
            .zip(self.relation().free)
            .map(|(r, q)| r - q);
        self.length(&lack.collect::<Vec<f64>>())
    }

    /// Newton's method from the coordinates `y`.
    pub fn solve(&mut self, y: Vec<Vector>, tolerance: f64) -> NewtonOutcome<LawPoint> {
        let (begin, monitor) = (self.point(y), self.monitor);
        descend(self, begin, Goal::of(ACCURATE * tolerance), monitor)
    }

    /// `W F + q`.
    fn caused(&self, force: &[f64]) -> Vec<f64> {
        let mut d = self.relation().free.to_vec();
        add_products(&self.relation().matrix(), force.iter().copied(), &mut d);
        d
    }

    fn point(&self, y: Vec<Vector>) -> LawPoint {
        let dim = self.contact.dim();
        let [mut lack, mut force] = [(); 2].map(|()| Vec::with_capacity(self.root.len()));
        for (law, y) in self.contact.pairs().iter().zip(&y) {
            let (d, push) = law.point(y);
            lack.extend_from_slice(&d[..dim]);
            force.extend(push[..dim].iter().map(|p| -p));
        }
        let caused = self.caused(&force);
        lack.iter_mut().zip(&caused).for_each(|(lack, caused)| *lack -= caused);
        let (merit, eta) = (self.length(&lack), self.eta_of(&force, &caused));
        LawPoint { y, force, lack, merit, eta }
    }

    /// `eta` of forces, with the displacements that they cause.
    fn eta_of(&self, force: &[f64], caused: &[f64]) -> f64 {
        let relation = self.relation();
        let sum = natural_sum(self.contact.each(caused, force)).root();
        let felt = caused.iter().zip(relation.free).zip(relation.units());
        let felt: Vec<f64> = felt.map(|((d, q), unit)| unit * (d - q)).collect();
        let size = norm(relation.load()).max(norm(force).min(norm(&felt)));
        if sum == 0.0 { 0.0 } else { sum / size }
    }

    /// Length of a vector of displacements, each in the unit of its component.
    fn length(&self, d: &[f64]) -> f64 {
        norm_of(d.iter().zip(&self.root).map(|(d, root)| d * root))
    }

    /// `ε` at a point.
    fn damping(&self, point: &LawPoint) -> f64 {
        let [least, most] = DAMPING;
        if self.is_definite { 0.0 } else { (point.merit / self.size()).clamp(least, most) }
    }

    /// The changes of all coordinates by those of pairs with forces, `step`, to first order; `pairs` tells which have one.
    fn complete(&self, pairs: &[(bool, Linearised)], lack: &[f64], step: &mut [Vector]) {
        let dim = self.contact.dim();
        let mut change: Vec<f64> = lack.iter().map(|lack| -lack).collect();
        let forces = pairs.iter().zip(&*step).flat_map(|((_, linear), step)| {
            let moved = linear.moved(step);
            (0..dim).map(move |c| moved[c] - step[c])
        });
        add_products(&self.relation().matrix(), forces, &mut change);
        for (((has_force, linear), change), step) in
            pairs.iter().zip(change.chunks_exact(dim)).zip(step)
        {
            if !has_force {
                *step = linear.scaled(change);
            }
        }
    }
}

/// Adds the products of columns with forces; those without one cost nothing.
fn add_products(matrix: &Matrix<'_>, forces: impl Iterator<Item = f64>, sum: &mut [f64]) {
    for (j, by) in forces.enumerate().filter(|(_, by)| *by != 0.0) {
        sum.iter_mut().zip(matrix.column(j)).for_each(|(sum, w)| *sum += w * by);
    }
}

/// Column `c` of `dP/dy`, and of `dd/dy`.
pub fn column(law: &PairLaw, slopes: &Linearised, c: usize) -> (Vector, Vector) {
    let mut unit = [0.0; 3];
    unit[c] = 1.0;
    let moved = slopes.moved(&unit);
    (std::array::from_fn(|row| unit[row] - moved[row]), law.displacement_by(&moved))
}

impl NormalMap for OnFlexibility<'_, '_> {
    type Point = LawPoint;
    type Step = Vec<Vector>;

    fn eta(&self, point: &LawPoint) -> f64 {
        point.eta
    }

    fn merit(&self, point: &LawPoint) -> f64 {
        point.merit
    }

    fn step(&mut self, point: &LawPoint) -> Result<Vec<Vector>, Ending> {
        let (dim, laws) = (self.contact.dim(), self.contact.pairs());
        let (matrix, units) = (self.relation().matrix(), self.relation().units());
        let pairs = laws.iter().zip(&point.y).map(|(law, y)| {
            let piece = law.piece(y);
            (piece.carries_force(), law.linearised(piece, y))
        });
        let pairs: Vec<(bool, Linearised)> = pairs.collect();
        let unknowns: Vec<usize> = (0..point.lack.len()).filter(|i| pairs[i / dim].0).collect();
        let damping = self.damping(point);
        let n = unknowns.len();
        self.work -= lu_work(n);
        if self.work < 0.0 {
            return Err(DEAR);
        }
        self.monitor.affords(lu_work(n))?;
        let fill = |j: usize, entries: &mut [f64]| {
            let (pair, c) = (unknowns[j] / dim, unknowns[j] % dim);
            let (push, motion) = column(&laws[pair], &pairs[pair].1, c);
            entries.fill(0.0);
            for (row, push) in push[..dim].iter().enumerate().filter(|(_, push)| **push != 0.0) {
                let w = matrix.column(dim * pair + row);
                entries.iter_mut().zip(&unknowns).for_each(|(entry, &i)| *entry += w[i] * push);
            }
            let first = j - c;
            for row in 0..dim {
                entries[first + row] +=
                    motion[row] + damping / units[unknowns[first + row]] * push[row];
            }
            let scale = self.root[unknowns[j]];
            entries
                .iter_mut()
                .zip(&unknowns)
                .for_each(|(entry, &i)| *entry *= self.root[i] * scale);
        };
        let factor = Factor::new(n, false, SINGULAR, fill, &mut self.monitor.asking());
        let singular = || self.monitor.stop().map_or(Ending::Singular, Ending::Stopped);
        let factor = factor.ok_or_else(singular)?;
        let mut own: Vec<f64> = unknowns.iter().map(|&i| -self.root[i] * point.lack[i]).collect();
        factor.solve(&mut own);
        let mut step = vec![[0.0; 3]; pairs.len()];
        for (i, own) in unknowns.iter().zip(own) {
            step[i / dim][i % dim] = own * self.root[*i];
        }
        self.complete(&pairs, &point.lack, &mut step);
        Ok(step)
    }

    fn moved(
        &mut self,
        point: &LawPoint,
        step: &Vec<Vector>,
        part: f64,
    ) -> Result<LawPoint, Ending> {
        let each = |(y, dy): (&Vector, &Vector)| std::array::from_fn(|c| y[c] + part * dy[c]);
        Ok(self.point(point.y.iter().zip(step).map(each).collect()))
    }
}
