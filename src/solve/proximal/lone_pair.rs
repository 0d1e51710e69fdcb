//! A pair that no entry of `W` ties to another: Newton's method of [`super::on_flexibility`] on its block, with numbers in
//! the place of vectors, so that a host with many such pairs waits for no memory.

use super::compliant::DEFINITE;
use super::on_flexibility::{ACCURATE, column};
use crate::law::{PairLaw, Vector, natural_sum};
use crate::linalg::vector3::{Matrix3, Vector3, vector};
use crate::monitor::Watch;
use crate::solve::newton::{Goal, NormalMap, descend};
use crate::solve::result::Ending;

/// The equations of a pair. In the plane the third component stands for itself.
pub struct LonePair<'c> {
    law: &'c PairLaw,
    dim: usize,
    /// Its block of `W`.
    block: Matrix3,
    /// `q`, and roots of the units of force per length.
    free: Vector3,
    root: Vector3,
}

/// A point of the law.
#[derive(Clone, Copy)]
pub struct LonePoint {
    y: Vector,
    force: Vector3,
    /// `H`, a length in the unit of each component.
    lack: Vector3,
    eta: f64,
}

impl<'c> LonePair<'c> {
    /// The equations of a pair with its block of `W`, column-major; `None` if that is not definite.
    pub fn new(law: &'c PairLaw, block: &[f64], (free, units): (&[f64], &[f64])) -> Option<Self> {
        let dim = free.len();
        let mut whole = Matrix3::identity();
        whole.view_mut((0, 0), (dim, dim)).copy_from_slice(block);
        let mut root = vector(units);
        root.apply(|unit| *unit = unit.sqrt());
        let scaled = Matrix3::from_fn(|i, j| {
            if i.max(j) < dim { root[i] * whole[(i, j)] * root[j] } else { whole[(i, j)] }
        });
        let pivots = scaled.cholesky()?.l_dirty().diagonal();
        let is_definite = pivots.min() * pivots.min() >= DEFINITE * pivots.max() * pivots.max();
        let free = vector(free);
        is_definite.then_some(LonePair { law, dim, block: whole, free, root })
    }

    /// The contact force after Newton's method from the force `begin`, and its systems; `None` if it does not reach the
    /// tolerance.
    pub fn solve(
        mut self,
        begin: &[f64],
        tolerance: f64,
        monitor: &dyn Watch,
    ) -> Option<(Vector, u64)> {
        let force = vector(begin);
        let caused = self.block * force + self.free;
        let begin = self.point(self.law.chart(caused.as_slice(), force.as_slice()));
        let found = descend(&mut self, begin, Goal::of(ACCURATE * tolerance), monitor);
        let is_solved = found.ending == Ending::Done && found.point.eta <= tolerance;
        is_solved.then_some((found.point.force.into(), found.systems))
    }

    fn point(&self, y: Vector) -> LonePoint {
        let (d, push) = self.law.point(&y);
        let force = -Vector3::from(push);
        let felt = self.block * force;
        let caused = felt + self.free;
        let own = [(self.law, &caused.as_slice()[..self.dim], &force.as_slice()[..self.dim])];
        let sum = natural_sum(own.into_iter()).root();
        let unit = self.root.component_mul(&self.root);
        let size = |d: &Vector3| unit.component_mul(d).norm();
        let largest = size(&self.free).max(force.norm().min(size(&felt)));
        let eta = if sum == 0.0 { 0.0 } else { sum / largest };
        let lack = self.root.component_mul(&(Vector3::from(d) - caused));
        LonePoint { y, force, lack, eta }
    }
}

impl NormalMap for LonePair<'_> {
    type Point = LonePoint;
    type Step = Vector3;

    fn eta(&self, point: &LonePoint) -> f64 {
        point.eta
    }

    fn merit(&self, point: &LonePoint) -> f64 {
        point.lack.norm()
    }

    fn step(&mut self, point: &LonePoint) -> Result<Vector3, Ending> {
        let linear = self.law.linearised(self.law.piece(&point.y), &point.y);
        let mut matrix = Matrix3::identity();
        for c in 0..self.dim {
            let (push, motion) = column(self.law, &linear, c);
            let moved = self.block * Vector3::from(push) + Vector3::from(motion);
            matrix.set_column(c, &(self.root.component_mul(&moved) * self.root[c]));
        }
        let step = matrix.lu().solve(&-point.lack).ok_or(Ending::Singular)?;
        Ok(self.root.component_mul(&step))
    }

    fn moved(&mut self, point: &LonePoint, step: &Vector3, part: f64) -> Result<LonePoint, Ending> {
        Ok(self.point((Vector3::from(point.y) + part * step).into()))
    }
}
