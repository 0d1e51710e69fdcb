//! The over-relaxation factor, given or chosen from the measured rate.

/// Chooses `omega` while sweeps go on.
#[derive(Clone, Debug)]
pub struct Relaxation {
    omega: f64,
    adaptive: bool,
    cap: f64,
    changes: Vec<f64>,
}

impl Relaxation {
    /// `omega` as given, or chosen below `cap` if it is 0.
    pub fn new(omega: f64, cap: f64) -> Self {
        let adaptive = omega == 0.0;
        Relaxation { omega: if adaptive { 1.0 } else { omega }, adaptive, cap, changes: Vec::new() }
    }

    /// The factor to use in the next sweep.
    pub fn omega(&self) -> f64 {
        self.omega
    }

    /// Takes the size of the last sweep's change, in the norm of the diagonal of `K`.
    pub fn observe(&mut self, change: f64) {
        if !self.adaptive {
            return;
        }
        self.changes.push(change);
        let count = self.changes.len();
        let window = 6 + (2.0 / (2.0 - self.omega)) as usize;
        if count < 2 * window {
            return;
        }
        let rate =
            (self.changes[count - 1] / self.changes[count - 1 - window]).powf(1.0 / window as f64);
        if !(rate < 1.0) {
            return;
        }
        // Young: rate + omega - 1 = omega mu sqrt(rate), the best factor is 2 / (1 + sqrt(1 - mu²)).
        if rate > (self.omega - 1.0).powf(0.8) {
            let mu = (rate + self.omega - 1.0) / (self.omega * rate.sqrt());
            let best = 2.0 / (1.0 + (1.0 - mu.min(1.0).powi(2)).sqrt());
            self.omega = best.clamp(self.omega, self.cap);
            self.changes.clear();
        }
    }
}
