//! The step of one pair in a sweep of projected over-relaxation: normal, then tangential.
//!
//! The normal step minimises the energy of the pair in `d_n <= gap` exactly for `omega = 1`; the
//! tangential one is the proximal map of `g |delta|`, `delta <- shrink(delta - omega r_t / k_t,
//! omega g / k_t)`, the exact minimum in the plane and for isotropic blocks, and a majorised one for
//! others. A sticking pair has `delta = 0` exactly.
//!
//! With an ellipse the trial slip is `x = delta - omega r_t / k_t`, and `z = k_t x / omega` its force:
//! `delta <- x - omega back(z) / k_t`, `back` the law's friction ([`super::ellipse`]). Under the associated rule this is
//! the proximal map of the most work of friction; under the collinear one no energy has it for its minimum, but the
//! points that it leaves where they are obey the law.

use super::{PairLaw, Vector, length};

impl PairLaw {
    /// Steps of a pair at the displacement `d` with the force `force = K d - f`, over-relaxed by
    /// `omega`; `coupling` holds `K_tn` of the pair. The bound follows the pressure after the normal
    /// step. `d` is moved; returns the steps and their squared length in the norm of `k`.
    ///
    /// Steps come from forces, not from differences of displacements, so that small ones survive
    /// next to a large slip.
    #[inline(always)]
    pub fn relax(
        &self,
        d: &mut [f64],
        force: &[f64],
        coupling: &[f64],
        omega: f64,
    ) -> (Vector, f64) {
        let mut steps = [0.0; 3];
        let normal = (d[0] - omega * (force[0] - self.tension) / self.k_n).min(self.gap);
        steps[0] = normal - d[0];
        d[0] = normal;
        let mut change = self.k_n * steps[0] * steps[0];

        let pressure = (self.tension - force[0] - self.k_n * steps[0]).max(0.0);
        if self.ellipse.is_some() {
            let mut friction = [0.0; 2];
            for c in 0..2 {
                friction[c] = force[1 + c] + coupling[c] * steps[0];
            }
            let threshold = self.bound.at(pressure);
            let ([t1, t2], moved) = self.relax_on_ellipse(d, friction, threshold, omega);
            return ([steps[0], t1, t2], change + moved);
        }
        let shrinkage = omega * self.bound.at(pressure) / self.k_t;
        let rate = omega / self.k_t;
        let mut trial = [0.0; 2];
        let trial = &mut trial[..self.dim - 1];
        for c in 1..self.dim {
            steps[c] = -rate * (force[c] + coupling[c - 1] * steps[0]);
            trial[c - 1] = d[c] - self.slip0[c - 1] + steps[c];
        }
        let length = length(trial);
        for c in 1..self.dim {
            if length > shrinkage {
                steps[c] -= shrinkage * (trial[c - 1] / length);
                d[c] += steps[c];
            } else {
                steps[c] = self.slip0[c - 1] - d[c];
                d[c] = self.slip0[c - 1];
            }
            change += self.k_t * steps[c] * steps[c];
        }
        (steps, change)
    }

    /// The tangential step of a pair with an ellipse and the force `friction`, under a threshold, and its
    /// squared length in the norm of `k`. Not inlined, and all by value: else it would slow down the
    /// isotropic step.
    #[inline(never)]
    fn relax_on_ellipse(
        &self,
        d: &mut [f64],
        friction: [f64; 2],
        threshold: f64,
        omega: f64,
    ) -> ([f64; 2], f64) {
        let (rate, mut steps) = (omega / self.k_t, [0.0; 2]);
        let slip = [self.slip_at(d, 1), self.slip_at(d, 2)];
        let moved = friction.map(|r| -rate * r);
        let mut force = [0, 1].map(|c| (slip[c] + moved[c]) / rate);
        let slips = self.gauge(&force) > threshold;
        if slips {
            self.bring_to_bound(&mut force, threshold);
        }
        for c in 0..2 {
            if slips {
                steps[c] = moved[c] - rate * force[c];
                d[1 + c] += steps[c];
            } else {
                steps[c] = -slip[c];
                d[1 + c] = self.slip0[c];
            }
        }
        (steps, self.k_t * (steps[0] * steps[0] + steps[1] * steps[1]))
    }
}
