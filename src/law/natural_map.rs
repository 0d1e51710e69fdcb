//! The natural map: how far a displacement and a force are from the law, as a force.
//!
//! ```text
//! e_n = k_n (d_n - min(gap, d_n - (F_n - a) / k_n))
//! e_t = back(k delta - F_t) + F_t                                g = g(max(0, a - F_n))
//! ```
//!
//! with `back(y)` the trial force `y`, or where its gauge exceeds `g` the friction of a slip that belongs to it: along
//! its own line, and with an ellipse as its rule says. Of an isotropic law
//! `e_t = k_t (delta - shrink(delta - F_t / k_t, g / k_t))`, `shrink(x, s)` the vector `x` shortened by `s`. A pair that is
//! apart loses its pressure, and the friction of that pressure: where `k_n (d_n - gap) <= F_n - a < 0`, `e_t` is the part of
//! `F_t` beyond the bound `g(0)`, if that is longer. So `|e|` is not below the change of `F` to one that the pair carries.
//! It is zero exactly if the law is obeyed. Of a tie `e = k (d - reference)`, whatever the force.

use super::{Ellipse, PairLaw, State, Vector, length};
use crate::linalg::tolerances::FEW_OPERATIONS;
use crate::linalg::vector::NormSum;

/// How far a pair is outside the law, in the units of the problem; 0 where it is not.
#[derive(Clone, Copy, Debug, Default)]
pub struct Violation {
    /// `d_n - gap`, a length.
    pub penetration: f64,
    /// Tensile normal force beyond the tension that the law allows.
    pub tension: f64,
    /// `|F_t|` beyond its bound, a force.
    pub cone_excess: f64,
}

impl Violation {
    /// The larger of both in each measure.
    pub fn or_worse(self, other: Violation) -> Violation {
        Violation {
            penetration: self.penetration.max(other.penetration),
            tension: self.tension.max(other.tension),
            cone_excess: self.cone_excess.max(other.cone_excess),
        }
    }
}

/// The sum for the length of the natural map at the displacements and forces of pairs. Nothing is stored: it is measured for
/// each linear system, and every few sweeps.
#[inline]
pub fn natural_sum<'s>(
    pairs: impl Iterator<Item = (&'s PairLaw, &'s [f64], &'s [f64])>,
) -> NormSum {
    let (mut sum, mut residual) = (NormSum::default(), [0.0; 3]);
    for (law, d, force) in pairs {
        law.natural_residual(d, force, &mut residual);
        residual[..d.len()].iter().for_each(|&e| sum.add(e));
    }
    sum
}

impl PairLaw {
    /// The natural map at the displacement `d` and the force `force` of the pair.
    ///
    /// Piece by piece, so that a force is not lost in the rounding of a much larger `k_t delta`.
    #[inline]
    pub fn natural_residual(&self, d: &[f64], force: &[f64], residual: &mut [f64]) {
        if self.tied {
            residual[0] = self.k_n * (d[0] - self.gap);
            (1..self.dim).for_each(|c| residual[c] = self.k_t * self.slip_at(d, c));
            return;
        }
        // max() of both pieces, so that an infinite gap leaves the force and no NaN.
        residual[0] = (self.k_n * (d[0] - self.gap)).max(force[0] - self.tension);
        let threshold = self.threshold(force[0]);
        let mut trial = [0.0; 2];
        let trial = &mut trial[..self.dim - 1];
        for c in 1..self.dim {
            residual[c] = self.k_t * self.slip_at(d, c);
            trial[c - 1] = residual[c] - force[c];
        }
        if self.gauge(trial) > threshold {
            self.bring_to_bound(trial, threshold);
            (1..self.dim).for_each(|c| residual[c] = force[c] + trial[c - 1]);
        }
        if self.loses_friction(d, force) {
            let lost = self.beyond_bound(&force[1..self.dim], self.threshold(self.tension));
            let lost = &lost[..self.dim - 1];
            if length(lost) > length(&residual[1..self.dim]) {
                residual[1..self.dim].copy_from_slice(lost);
            }
        }
    }

    /// True if the pair is apart, and has a pressure that friction may follow.
    fn loses_friction(&self, d: &[f64], force: &[f64]) -> bool {
        let pull = force[0] - self.tension;
        pull < 0.0 && self.bound.slope > 0.0 && self.k_n * (d[0] - self.gap) <= pull
    }

    /// The part of a tangential force that the pair cannot carry under `threshold`.
    fn beyond_bound(&self, force: &[f64], threshold: f64) -> [f64; 2] {
        let mut carried = [0.0; 2];
        let carried = &mut carried[..force.len()];
        carried.copy_from_slice(force);
        self.bring_back(carried, threshold);
        std::array::from_fn(|c| force.get(c).map_or(0.0, |force| force - carried[c]))
    }

    /// Bound on the rounding of [`Self::natural_residual`] where its terms cancel, from forces that are
    /// rounded once: a normal force and the tension, and two forces on a slip. Elsewhere a component has one term, with
    /// a few roundings.
    pub fn natural_rounding(&self, d: &[f64], force: &[f64]) -> f64 {
        if self.tied {
            return 0.0;
        }
        let threshold = self.threshold(force[0]);
        // For an isotropic law the sum of sizes is above the length, and cheaper.
        let above = |t: &[f64]| t.iter().map(|t| t.abs()).sum::<f64>();
        let mut terms = above(&force[1..self.dim]) + threshold + self.bound.slope * self.tension;
        let y = &self.trial(d, force);
        let trial = &y[1..self.dim];
        // The trial force is turned into the axes of an ellipse.
        if self.ellipse.is_some() && self.gauge(trial) > 0.0 {
            let (turned, _) = self.slopes_on_bound([y[1], y[2]], threshold);
            terms += above(turned.as_flattened()) * above(trial);
        }
        // One of each force, four of the bound, and up to seven of the direction and of the sum.
        let rounding = FEW_OPERATIONS * terms;
        // Next to its bound a pair that sticks may slip.
        let sticks = self.ellipse.is_none() && above(trial) + rounding <= threshold;
        // A bound of zero is exact where it is no difference of cohesion and tension.
        let has_bound = threshold > 0.0 || self.tension > 0.0;
        let slips = has_bound && !sticks && self.gauge(trial) + rounding > threshold;
        let pull = if self.tension > 0.0 { f64::EPSILON * force[0].abs() } else { 0.0 };
        if slips || self.loses_friction(d, force) { pull + rounding } else { pull }
    }

    /// Bound on the change of [`Self::natural_residual`] by a change of the force, relative to that change.
    ///
    /// The friction of a slip changes by `mu` times the change of the normal force, and by no more than its trial force
    /// if it is the nearest point of the disc or the ellipse. On its own line, `g y / |W y|`, it changes by `1 + |W|`
    /// times as much, as `g <= |W y|`.
    pub fn sensitivity(&self) -> f64 {
        if self.tied {
            return 0.0;
        }
        let own_line = self.ellipse.as_ref().filter(|_| self.is_collinear());
        2.0 + self.bound.slope + own_line.map_or(0.0, Ellipse::norm)
    }

    /// The state of the active piece of the natural map. Pieces closer than the force `margin` are
    /// not told apart: open comes before closed, stick before slip. A pair that is open has no friction, so that its
    /// pressure and the friction under it are below `margin` too, if it is not apart.
    pub fn state(&self, d: &[f64], force: &[f64], margin: f64) -> State {
        let trial = self.trial(d, force);
        let threshold = self.threshold(force[0]);
        if self.tied {
            State::Stick
        } else if trial[0] <= 0.0
            || trial[0].max(self.tension - force[0]) * self.bound.slope.max(1.0) <= margin
        {
            State::Open
        } else if threshold > 0.0 && self.gauge(&trial[1..self.dim]) <= threshold + margin {
            State::Stick
        } else {
            State::Slip
        }
    }

    /// The force nearest to `force` that a pair in `state` can carry.
    pub fn admissible_force(&self, force: &[f64], state: State) -> Vector {
        let mut admissible = [0.0; 3];
        admissible[..self.dim].copy_from_slice(force);
        if self.tied {
            return admissible;
        }
        let tension = self.tension;
        admissible[0] = if state == State::Open { tension } else { force[0].min(tension) };
        let threshold = self.threshold(admissible[0]);
        self.bring_back(&mut admissible[1..self.dim], threshold);
        admissible
    }

    /// How far the pair is outside the law: of a tie, how far its normal displacement is from its gap.
    pub fn violation(&self, d: &[f64], force: &[f64]) -> Violation {
        if self.tied {
            return Violation { penetration: (d[0] - self.gap).abs(), ..Violation::default() };
        }
        let beyond = self.beyond_bound(&force[1..self.dim], self.threshold(force[0]));
        Violation {
            penetration: (d[0] - self.gap).max(0.0),
            tension: (force[0] - self.tension).max(0.0),
            cone_excess: length(&beyond[..self.dim - 1]),
        }
    }
}
