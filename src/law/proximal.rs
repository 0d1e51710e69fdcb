//! The step of one pair in a sweep of projected over-relaxation: normal, then tangential.
//!
//! The normal step minimises the energy of the pair in `d_n <= gap` exactly for `omega = 1`; the
//! tangential one is the proximal map of `g |delta|`, `delta <- shrink(delta - omega r_t / k_t,
//! omega g / k_t)`, the exact minimum in the plane and for isotropic blocks, and a majorised one for
//! others. A sticking pair has `delta = 0` exactly.
//!
//! With an ellipse the trial slip is `x = delta - omega k⁻¹ r_t` and `z = k x / omega` its force:
//! `delta <- x (1 - g / gauge(z))`, or 0. Under the associated rule this is the proximal map in the
//! variables of the disc; under the collinear one no energy has it for its minimum, but the points that
//! it leaves where they are obey the law.

use super::{Ellipse, PairLaw, Vector, length};

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
        if let Some(ellipse) = &self.ellipse {
            let mut friction = [0.0; 2];
            for c in 0..2 {
                friction[c] = force[1 + c] + coupling[c] * steps[0];
            }
            let threshold = self.bound.at(pressure);
            let ([t1, t2], moved) = self.relax_on(ellipse, d, friction, threshold, omega);
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
    fn relax_on(
        &self,
        ellipse: &Ellipse,
        d: &mut [f64],
        friction: [f64; 2],
        threshold: f64,
        omega: f64,
    ) -> ([f64; 2], f64) {
        let mut steps = [0.0; 2];
        let (slip, moved) = (self.slip_at(d), ellipse.unscaled(friction).map(|r| -omega * r));
        let trial = [slip[0] + moved[0], slip[1] + moved[1]];
        let gauge = ellipse.gauge(ellipse.scaled(trial)) / omega;
        for c in 0..2 {
            if gauge > threshold {
                steps[c] = moved[c] - trial[c] * (threshold / gauge);
                d[1 + c] += steps[c];
            } else {
                steps[c] = -slip[c];
                d[1 + c] = self.slip0[c];
            }
        }
        let scaled = ellipse.scaled(steps);
        (steps, scaled[0] * steps[0] + scaled[1] * steps[1])
    }
}
