//! Random laws of a pair, points that obey them, and the law itself, stated without the library.

use fastrand::Rng;
use signorini::file::Law;
use signorini::law::{Bound, Ellipse, PairLaw, Rule, Vector};

/// A law with its numbers.
#[derive(Clone, Copy, Debug)]
pub struct Numbers {
    pub dim: usize,
    pub gap: f64,
    pub slip0: [f64; 2],
    pub bound: Bound,
    /// `a`: the bound holds for `p + a`.
    pub tension: f64,
    pub axes: Option<Axes>,
    pub k: (f64, f64),
}

/// An orthotropic law: coefficients along two axes, the first at `angle` from t1 towards t2.
#[derive(Clone, Copy, Debug)]
pub struct Axes {
    pub mu: [f64; 2],
    pub angle: f64,
    pub rule: Rule,
}

impl Axes {
    pub fn random(rng: &mut Rng) -> Axes {
        let mu = [uniform(rng, 0.2, 2.0), uniform(rng, 0.2, 2.0)];
        let rule = if rng.bool() { Rule::Associated } else { Rule::Collinear };
        Axes { mu, angle: uniform(rng, -4.0, 4.0), rule }
    }

    /// Components along the axes.
    pub fn along(&self, t: &[f64]) -> [f64; 2] {
        let (sin, cos) = self.angle.sin_cos();
        [cos * t[0] + sin * t[1], cos * t[1] - sin * t[0]]
    }

    /// The vector with these components along the axes.
    pub fn of(&self, t: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = self.angle.sin_cos();
        [cos * t[0] - sin * t[1], sin * t[0] + cos * t[1]]
    }

    /// The pressure on whose ellipse the force `t` lies.
    pub fn pressure(&self, t: &[f64]) -> f64 {
        let [one, two] = self.along(t);
        (one / self.mu[0]).hypot(two / self.mu[1])
    }

    /// The most work on the slip `delta` of forces in the ellipse of pressure 1.
    pub fn work(&self, delta: &[f64]) -> f64 {
        let [one, two] = self.along(delta);
        (one * self.mu[0]).hypot(two * self.mu[1])
    }

    /// The slip of the rule at the force `t` in the direction `t` or the outward normal, of any length.
    pub fn slip(&self, t: &[f64]) -> [f64; 2] {
        let [one, two] = self.along(t);
        match self.rule {
            Rule::Associated => self.of([one / self.mu[0].powi(2), two / self.mu[1].powi(2)]),
            Rule::Collinear => [t[0], t[1]],
        }
    }
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
    /// Frictionless, Coulomb, Tresca, cohesive, orthotropic (in space) with given thresholds too, and
    /// bounds with slope and offset; gaps positive, zero, negative and infinite; with and without a
    /// reference slip; stiffnesses over two decades.
    pub fn random(rng: &mut Rng) -> Numbers {
        let dim = rng.usize(2..=3);
        Numbers::random_in(rng, dim)
    }

    /// In the plane or in space.
    pub fn random_in(rng: &mut Rng, dim: usize) -> Numbers {
        let (mut tension, mut axes) = (0.0, None);
        let bound = match rng.u8(0..10) {
            0 => Bound::FRICTIONLESS,
            1 | 2 => Bound::coulomb(uniform(rng, 0.01, 3.0)),
            3 | 4 => Bound::tresca(uniform(rng, 0.01, 2.0)),
            5 => Bound { slope: uniform(rng, 0.0, 2.0), offset: uniform(rng, 0.0, 1.0) },
            6 | 7 => {
                // Numbers of 24 bits have an exact product, so that `b` is `mu a` where nothing is added.
                let short = |value: f64| f64::from(value as f32);
                let mu = if rng.bool() { 0.0 } else { short(uniform(rng, 0.0, 2.0)) };
                tension = short(uniform(rng, 0.01, 2.0));
                let more = if rng.bool() { 0.0 } else { uniform(rng, 0.01, 2.0) };
                Bound::cohesive(mu, mu * tension + more, tension)
            }
            _ if dim == 2 => Bound::coulomb(uniform(rng, 0.01, 3.0)),
            kind => {
                let drawn = Axes::random(rng);
                axes = Some(drawn);
                match kind {
                    8 => Bound::orthotropic(drawn.mu),
                    _ => Bound::tresca(uniform(rng, 0.01, 2.0)),
                }
            }
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
        Numbers { dim, gap, slip0, bound, tension, axes, k }
    }

    /// The statement of a friction law with its parameters, of a pair without a gap.
    pub fn of(dim: usize, (law, n): (Law, &[f64])) -> Numbers {
        let axes = |rule| Axes { mu: [n[0], n[1]], angle: n[2], rule };
        let (bound, tension, axes) = match law {
            Law::Frictionless => (Bound::FRICTIONLESS, 0.0, None),
            Law::Coulomb => (Bound::coulomb(n[0]), 0.0, None),
            Law::Tresca => (Bound::tresca(n[0]), 0.0, None),
            Law::Cohesive => (Bound::cohesive(n[0], n[1], n[2]), n[2], None),
            Law::Orthotropic => {
                (Bound::orthotropic([n[0], n[1]]), 0.0, Some(axes(Rule::Associated)))
            }
            Law::OrthotropicCollinear => {
                (Bound::orthotropic([n[0], n[1]]), 0.0, Some(axes(Rule::Collinear)))
            }
            Law::ByPair | Law::Tied => unreachable!("no bound of one pair"),
        };
        Numbers { dim, gap: 0.0, slip0: [0.0; 2], bound, tension, axes, k: (1.0, 1.0) }
    }

    pub fn law(&self) -> PairLaw {
        let law = PairLaw::new(self.dim, self.gap, self.slip0, self.bound, self.k);
        let law = law.with_tension(self.tension);
        match self.axes {
            None => law,
            Some(Axes { mu, angle, rule }) => law.with_ellipse(Ellipse::new(mu, angle, rule)),
        }
    }

    pub fn has_obstacle(&self) -> bool {
        self.gap.is_finite()
    }

    /// `g(p)`, `p >= -a`.
    pub fn threshold(&self, p: f64) -> f64 {
        self.bound.slope * (p + self.tension) + self.bound.offset
    }

    /// The larger of both coefficients over the other, 1 without axes: how much rounding and derivatives
    /// grow in the variables in which the ellipse is a disc.
    pub fn ratio(&self) -> f64 {
        let mu = self.axes.map_or([1.0; 2], |axes| axes.mu);
        mu[0].max(mu[1]) / mu[0].min(mu[1])
    }

    /// The size that the threshold limits: with axes the force along the axis of the larger coefficient on whose
    /// ellipse `t` lies.
    pub fn size(&self, t: &[f64]) -> f64 {
        match self.axes {
            None => norm(t),
            Some(axes) => axes.mu[0].max(axes.mu[1]) * axes.pressure(t),
        }
    }

    /// The most work on the slip `delta` of forces within the threshold `g`.
    pub fn most_work(&self, g: f64, delta: &[f64]) -> f64 {
        match self.axes {
            None => g * norm(delta),
            Some(axes) => g / axes.mu[0].max(axes.mu[1]) * axes.work(delta),
        }
    }

    /// `k delta`.
    pub fn scaled(&self, delta: &[f64]) -> [f64; 2] {
        let second = delta.get(1).copied().unwrap_or(0.0);
        [self.k.1 * delta[0], self.k.1 * second]
    }

    /// `y = P + (a, 0, 0) + k v`.
    pub fn trial(&self, v: &Vector, p: &Vector) -> Vector {
        let moved = self.scaled(&v[1..]);
        [p[0] + self.tension + self.k.0 * v[0], p[1] + moved[0], p[2] + moved[1]]
    }

    /// `(v, P)` at the coordinates `y`.
    pub fn map(&self, y: &Vector) -> (Vector, Vector) {
        let law = self.law();
        let ((d, push), reference) = (law.point(y), law.reference());
        (std::array::from_fn(|c| d[c] - reference[c]), push)
    }

    /// The displacement and the force of `(v, P)`; without an obstacle `d_n = 0.5`.
    pub fn of_host(&self, v: &Vector, p: &Vector) -> (Vec<f64>, Vec<f64>) {
        let normal = if self.has_obstacle() { self.gap + v[0] } else { 0.5 };
        let d = [normal, self.slip0[0] + v[1], self.slip0[1] + v[2]];
        (d[..self.dim].to_vec(), p[..self.dim].iter().map(|p| -p).collect())
    }

    /// How far `(v, P)` is from the law, a force:
    ///
    /// `v_n <= 0`, `p >= -a`, one of them equal; `tau` within the threshold; and
    ///
    /// - isotropic, and by the associated rule: `tau` takes the most work from `delta`, `delta . tau = g
    ///   |delta|` of a disc;
    /// - by the collinear rule: `tau` is the force on the ellipse along `delta`, if that is not zero.
    pub fn defect(&self, v: &Vector, p: &Vector) -> f64 {
        let (k_n, k_t) = self.k;
        let penetration = k_n * v[0];
        let pressure = p[0] + self.tension;
        let apart = if pressure == 0.0 { 0.0 } else { pressure.min(-penetration) };
        let (slip, tau) = (&v[1..self.dim], &p[1..self.dim]);
        let g = self.threshold(p[0].max(-self.tension));
        let along = k_t * norm(slip);
        let collinear = self.axes.is_some_and(|axes| axes.rule == Rule::Collinear);
        let off = if along == 0.0 {
            0.0
        } else if collinear {
            let on_ellipse = g / self.size(slip);
            let lack = norm(&[tau[0] - on_ellipse * slip[0], tau[1] - on_ellipse * slip[1]]);
            // A force turned by as much as the slip, or the slip turned.
            lack.min(lack * along / g)
        } else {
            (self.most_work(g, slip) - dot(slip, tau)) / norm(slip)
        };
        let beyond = self.size(tau) - g;
        [penetration, -pressure, apart, beyond, off.min(along)].into_iter().fold(0.0, f64::max)
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
        p[0] -= self.tension;
        let g = self.threshold(p[0]);
        let h = direction(rng, self.dim);
        let slips = g <= clear || rng.bool();
        let length = if slips { uniform(rng, clear, 2.0) / k_t } else { 0.0 };
        let force = if slips { g } else { uniform(rng, 0.0, g - clear) };
        // A slip without friction has any direction, and its force none.
        let size = self.size(&h[..self.dim - 1]);
        let along = self.axes.map_or(h, |axes| axes.slip(&h));
        for c in 0..self.dim - 1 {
            (v[1 + c], p[1 + c]) = (length * along[c] / norm(&along), force * h[c] / size);
        }
        (v, p)
    }
}
