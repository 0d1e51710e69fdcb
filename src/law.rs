//! The law of one contact pair: projections, shrinkage, and its three states.
//!
//! Tangential vectors are slices of one (2D) or two (3D) components.

/// What a contact pair does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum State {
    /// Apart: no force (of a Tresca problem: no normal force).
    Open,
    /// In contact with the tangential force on its bound; also every frictionless contact.
    Slip,
    /// In contact with the tangential displacement at rest.
    Stick,
}

/// Euclidean length of a tangential vector.
pub fn length(vector: &[f64]) -> f64 {
    match *vector {
        [] => 0.0,
        [a] => a.abs(),
        [a, b] => a.hypot(b),
        _ => unreachable!("a pair has at most two tangential components"),
    }
}

/// Shortens `vector` by `amount >= 0`, to exactly zero where it is not longer than that:
/// the proximal map of `amount |.|`.
pub fn shrink(vector: &mut [f64], amount: f64) {
    let length = length(vector);
    let keep = if length > amount { 1.0 - amount / length } else { 0.0 };
    for component in vector {
        *component *= keep;
    }
}

/// Brings `vector` back to the disc of radius `radius >= 0`.
pub fn project_disc(vector: &mut [f64], radius: f64) {
    let length = length(vector);
    if length > radius {
        for component in vector {
            *component *= radius / length;
        }
    }
}

/// One pair as its law sees it.
#[derive(Clone, Copy, Debug)]
pub struct Pair<'a> {
    /// `d_n - gap`, never positive for an admissible displacement; `-inf` without an obstacle.
    pub opening: f64,
    /// `d_t - slip`.
    pub slip: &'a [f64],
    /// `F_n`.
    pub normal_force: f64,
    /// `F_t`.
    pub tangential_force: &'a [f64],
    /// Bound on `|F_t|`.
    pub threshold: f64,
    /// Normal diagonal entry of the stiffness.
    pub k_n: f64,
    /// Largest eigenvalue of the tangential block.
    pub k_t: f64,
}

impl Pair<'_> {
    /// Normal part of the natural map, a force: `k_n (d_n - min(gap, d_n - F_n / k_n))`.
    /// Zero exactly if `d_n <= gap`, `F_n <= 0` and `(d_n - gap) F_n = 0`.
    pub fn normal_residual(&self) -> f64 {
        // max() first, so that an infinite gap leaves the force and no NaN.
        (self.k_n * self.opening).max(self.normal_force)
    }

    /// Tangential part of the natural map, a force, into `residual`:
    /// `k_t (delta - shrink(delta - F_t / k_t, threshold / k_t))`.
    /// Zero exactly if `|F_t| <= threshold` and the slip opposes `F_t` where it is on the bound.
    ///
    /// Written branch by branch: forces do not drown in the rounding of a much larger `k_t delta`.
    pub fn tangential_residual(&self, residual: &mut [f64]) {
        self.trial(residual);
        let length = length(residual);
        if length > self.threshold {
            for (residual, force) in residual.iter_mut().zip(self.tangential_force) {
                *residual = force + self.threshold * (*residual / length);
            }
        } else {
            for (residual, slip) in residual.iter_mut().zip(self.slip) {
                *residual = self.k_t * slip;
            }
        }
    }

    /// The state on whose branch the natural map is; branches closer than the force `margin`
    /// count as open before closed and stick before slip.
    pub fn state(&self, margin: f64) -> State {
        let pressure = -self.normal_force + self.k_n * self.opening;
        if pressure <= margin {
            return State::Open;
        }
        let mut trial = [0.0; 2];
        let trial = &mut trial[..self.slip.len()];
        self.trial(trial);
        if self.threshold > 0.0 && length(trial) <= self.threshold + margin {
            State::Stick
        } else {
            State::Slip
        }
    }

    fn trial(&self, trial: &mut [f64]) {
        for ((trial, slip), force) in trial.iter_mut().zip(self.slip).zip(self.tangential_force) {
            *trial = self.k_t * slip - force;
        }
    }
}
