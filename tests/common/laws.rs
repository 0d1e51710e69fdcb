//! Random laws of a pair, points that obey them, and the law itself, stated without the library.

use fastrand::Rng;
use signorini::law::{Bound, PairLaw, Vector, coulomb, frictionless, tresca};

/// A law with its numbers.
#[derive(Clone, Copy, Debug)]
pub struct Numbers {
    pub dim: usize,
    pub gap: f64,
    pub slip0: [f64; 2],
    pub bound: Bound,
    pub k: (f64, f64),
}

/// Uniform in (low, high).
pub fn uniform(rng: &mut Rng, low: f64, high: f64) -> f64 {
    low + (high - low) * rng.f64()
}

/// A unit vector of one or two components.
pub fn direction(rng: &mut Rng, dim: usize) -> [f64; 2] {
    if dim == 2 {
        return [if rng.bool() { 1.0 } else { -1.0 }, 0.0];
    }
    let angle = uniform(rng, 0.0, std::f64::consts::TAU);
    [angle.cos(), angle.sin()]
}

pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

pub fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

impl Numbers {
    /// Frictionless, Coulomb, Tresca, and both together; gaps positive, zero, negative and infinite;
    /// with and without a reference slip; stiffnesses over two decades.
    pub fn random(rng: &mut Rng) -> Numbers {
        let dim = rng.usize(2..=3);
        let bound = match rng.u8(0..6) {
            0 => frictionless::bound(),
            1 | 2 => coulomb::bound(uniform(rng, 0.01, 3.0)),
            3 | 4 => tresca::bound(uniform(rng, 0.01, 2.0)),
            _ => Bound { slope: uniform(rng, 0.0, 2.0), offset: uniform(rng, 0.0, 1.0) },
        };
        let gap = match rng.u8(0..5) {
            0 => f64::INFINITY,
            1 => 0.0,
            _ => uniform(rng, -1.0, 1.0),
        };
        let mut slip0 = [0.0; 2];
        if rng.bool() {
            slip0[..dim - 1].iter_mut().for_each(|slip| *slip = uniform(rng, -1.0, 1.0));
        }
        let stiffness = |rng: &mut Rng| 10_f64.powf(uniform(rng, -1.0, 1.0));
        let k = (stiffness(rng), stiffness(rng));
        Numbers { dim, gap, slip0, bound, k }
    }

    pub fn law(&self) -> PairLaw {
        PairLaw::new(self.dim, self.gap, self.slip0, self.bound, self.k)
    }

    pub fn has_obstacle(&self) -> bool {
        self.gap.is_finite()
    }

    /// `g(p)`.
    pub fn threshold(&self, p: f64) -> f64 {
        self.bound.slope * p + self.bound.offset
    }

    /// `y = P + k v`.
    pub fn trial(&self, v: &Vector, p: &Vector) -> Vector {
        let (k_n, k_t) = self.k;
        [p[0] + k_n * v[0], p[1] + k_t * v[1], p[2] + k_t * v[2]]
    }

    /// The displacement and the force of `(v, P)`; without an obstacle `d_n = 0.5`.
    pub fn of_host(&self, v: &Vector, p: &Vector) -> (Vec<f64>, Vec<f64>) {
        let normal = if self.has_obstacle() { self.gap + v[0] } else { 0.5 };
        let d = [normal, self.slip0[0] + v[1], self.slip0[1] + v[2]];
        (d[..self.dim].to_vec(), p[..self.dim].iter().map(|p| -p).collect())
    }

    /// How far `(v, P)` is from the law, a force:
    ///
    /// `v_n <= 0`, `p >= 0`, one of them 0; `|tau| <= g(p)`; and, with `|tau| <= g`, `delta` along `tau`
    /// and zero where `|tau| < g`, which together are `delta . tau = g |delta|`.
    pub fn defect(&self, v: &Vector, p: &Vector) -> f64 {
        let (k_n, k_t) = self.k;
        let penetration = k_n * v[0];
        let apart = if p[0] == 0.0 { 0.0 } else { p[0].min(-penetration) };
        let (slip, tau) = (&v[1..self.dim], &p[1..self.dim]);
        let g = self.threshold(p[0].max(0.0));
        let along = k_t * norm(slip);
        let off = if along == 0.0 { 0.0 } else { g - dot(slip, tau) / norm(slip) };
        [penetration, -p[0], apart, norm(tau) - g, off.min(along)].into_iter().fold(0.0, f64::max)
    }

    /// A point `(v, P)` of the law, no nearer to where its branches meet than `clear` in forces.
    pub fn point(&self, rng: &mut Rng, clear: f64) -> (Vector, Vector) {
        let (k_n, k_t) = self.k;
        let (mut v, mut p) = ([0.0; 3], [0.0; 3]);
        if !self.has_obstacle() {
            v[0] = f64::NEG_INFINITY;
        } else if rng.bool() {
            v[0] = -uniform(rng, clear, 2.0) / k_n;
        } else {
            p[0] = uniform(rng, clear, 2.0);
        }
        let g = self.threshold(p[0]);
        let h = direction(rng, self.dim);
        let slips = g <= clear || rng.bool();
        let length = if slips { uniform(rng, clear, 2.0) / k_t } else { 0.0 };
        let force = if slips { g } else { uniform(rng, 0.0, g - clear) };
        // A slip without friction has any direction, and its force none.
        for c in 0..self.dim - 1 {
            (v[1 + c], p[1 + c]) = (length * h[c], force * h[c]);
        }
        (v, p)
    }
}
