//! The step of one pair in a sweep of projected over-relaxation: normal, then tangential.
//!
//! The normal step minimises the energy of the pair in `d_n <= gap` exactly for `omega = 1`; the
//! tangential one is the proximal map of `g |delta|`, `delta <- shrink(delta - omega r_t / k_t,
//! omega g / k_t)`, the exact minimum in the plane and for isotropic blocks, and a majorised one for
//! others. A sticking pair has `delta = 0` exactly.

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
        let normal = (d[0] - omega * force[0] / self.k_n).min(self.gap);
        steps[0] = normal - d[0];
        d[0] = normal;
        let mut change = self.k_n * steps[0] * steps[0];

        let pressure = (-force[0] - self.k_n * steps[0]).max(0.0);
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
}
