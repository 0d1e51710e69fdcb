//! Points of the law that are drawn at random, on each of its pieces as often.

use super::{PairLaw, Vector};

impl PairLaw {
    /// Coordinates on a piece that is drawn: open, stick or slip, each as likely as the others. Scaled displacements and
    /// the force are of the `size`, the root of an energy; `random` gives numbers between -1 and 1.
    pub fn drawn(&self, size: f64, mut random: impl FnMut() -> f64) -> Vector {
        let (piece, direction) = (3.0 * random().abs(), std::f64::consts::PI * random());
        let (normal, tangential) = (random().abs() * size, random().abs());
        let [root_n, root_t] = [self.k_n.sqrt(), self.k_t.sqrt()];
        let beyond = tangential * size * root_t;
        // The force of a pair that slips is of the size, its friction included.
        let friction = (self.bound.slope * root_n / root_t).max(1.0);
        let pressure = normal * root_n / friction;
        let threshold = self.bound.at(pressure);
        let (normal, length) = match piece {
            piece if piece < 1.0 || !self.has_obstacle() => (-normal * root_n, beyond),
            piece if piece < 2.0 => (pressure, tangential * threshold),
            _ => (pressure, threshold + beyond),
        };
        let (sin, cos) = direction.sin_cos();
        let along = if self.dim == 2 { [direction.signum(), 0.0] } else { [cos, sin] };
        let gauge = self.gauge(&along[..self.dim - 1]);
        [normal, length / gauge * along[0], length / gauge * along[1]]
    }
}
