//! Friction ellipses in twice the precision, by their statement: `(F_1 / mu1)² + (F_2 / mu2)² <= F_n²` in the axes of the
//! ellipse, and the slip along its normal or against the force.

use super::problems::{Case, Law};
use super::quad::{Quad, norm};

/// The ellipse of a pair, relative to the larger coefficient.
pub struct Axes {
    /// Cosine and sine of the angle from t1 to the first axis.
    turn: [Quad; 2],
    /// Half-axes, the larger 1.
    half: [Quad; 2],
    /// The slip is along the normal.
    associated: bool,
}

/// Halvings of an angle before the series of its sine, which then has a few terms.
const HALVINGS: i32 = 12;
const TERMS: u32 = 14;

/// Steps of Newton's method to the nearest point: far more than double the digits of any start.
const STEPS: usize = 200;

/// The ellipse of a pair; `None`: a disc.
pub fn axes(case: &Case, pair: usize) -> Option<Axes> {
    let (numbers, associated) = match case.law.own(pair) {
        Law::Orthotropic(numbers) => (numbers, true),
        Law::Collinear(numbers) => (numbers, false),
        _ => return None,
    };
    let [first, second, angle] = [0, 1, 2].map(|k| numbers[k]);
    let most = Quad::from(first.max(second));
    let half = [first, second].map(|mu| Quad::from(mu) / most);
    Some(Axes { turn: cos_sin(angle), half, associated })
}

/// Of a part of the angle by the series, then of twice the angle.
pub fn cos_sin(angle: f64) -> [Quad; 2] {
    let part = Quad::from(angle).scaled(2_f64.powi(-HALVINGS));
    let (mut sin, mut cos, mut term) = (Quad::ZERO, Quad::ZERO, Quad::ONE);
    for k in 0..TERMS {
        let signed = if k % 4 < 2 { term } else { -term };
        let sum = if k % 2 == 0 { &mut cos } else { &mut sin };
        *sum += signed;
        term = term * part / Quad::from(f64::from(k + 1));
    }
    for _ in 0..HALVINGS {
        (sin, cos) = ((sin * cos).scaled(2.0), Quad::ONE - (sin * sin).scaled(2.0));
    }
    [cos, sin]
}

impl Axes {
    /// The larger half-axis over the smaller one.
    pub fn ratio(&self) -> f64 {
        (self.half[0] / self.half[1]).max(self.half[1] / self.half[0]).value()
    }

    fn along(&self, t: &[Quad]) -> [Quad; 2] {
        let [cos, sin] = self.turn;
        [cos * t[0] + sin * t[1], cos * t[1] - sin * t[0]]
    }

    fn of(&self, t: [Quad; 2]) -> Vec<Quad> {
        let [cos, sin] = self.turn;
        vec![cos * t[0] - sin * t[1], sin * t[0] + cos * t[1]]
    }

    /// The bound of whose ellipse a force lies.
    pub fn size(&self, t: &[Quad]) -> Quad {
        let [one, two] = self.along(t);
        norm(&[one / self.half[0], two / self.half[1]])
    }

    /// The most work on the slip `delta` of forces of the bound 1.
    pub fn work(&self, delta: &[Quad]) -> Quad {
        let [one, two] = self.along(delta);
        norm(&[one * self.half[0], two * self.half[1]])
    }

    /// The friction under the bound `g` that belongs to a trial force outside of the ellipse.
    pub fn friction(&self, trial: &[Quad], g: Quad) -> Vec<Quad> {
        if self.associated {
            return self.nearest(trial, g);
        }
        let size = self.size(trial);
        trial.iter().map(|&t| t / size * g).collect()
    }

    /// The derivatives of the friction by the trial force, by columns, and by the bound.
    pub fn slopes(&self, trial: &[Quad], g: Quad) -> ([Vec<Quad>; 2], Vec<Quad>) {
        let units = [[Quad::ONE, Quad::ZERO], [Quad::ZERO, Quad::ONE]];
        if !self.associated {
            let (along, size) = (self.along(trial), self.size(trial));
            let gradient = self.of([0, 1].map(|i| along[i] / (self.half[i] * self.half[i] * size)));
            let h: Vec<Quad> = trial.iter().map(|&t| t / size).collect();
            let column =
                |j: usize| (0..2).map(|i| g / size * (units[i][j] - h[i] * gradient[j])).collect();
            return ([column(0), column(1)], h);
        }
        // tau = W t with W = g c² / (g c² + q), and n . dtau = g dg with the gradient n = tau / c²: so
        // dtau = W dt - W n dq, with the dq that keeps the point on the ellipse.
        let tau = self.along(&self.nearest(trial, g));
        let along = self.along(trial);
        let n = [0, 1].map(|i| tau[i] / (self.half[i] * self.half[i]));
        let ratio = |i: usize| if along[i] == Quad::ZERO { Quad::ZERO } else { tau[i] / along[i] };
        let w = [ratio(0), ratio(1)];
        let whole = w[0] * n[0] * n[0] + w[1] * n[1] * n[1];
        let by_bound = self.of([0, 1].map(|i| g * w[i] * n[i] / whole));
        let column = |j: usize| {
            let unit = self.along(&units[j]);
            let dq = (n[0] * w[0] * unit[0] + n[1] * w[1] * unit[1]) / whole;
            self.of([0, 1].map(|i| w[i] * unit[i] - w[i] * n[i] * dq))
        };
        ([column(0), column(1)], by_bound)
    }

    /// The point of the ellipse of the bound `g` nearest to a force outside of it: in the axes the force is that point
    /// plus `q` times its gradient, `t = tau + q tau / c²`, with the `q` that brings `tau` on the ellipse.
    pub fn nearest(&self, t: &[Quad], g: Quad) -> Vec<Quad> {
        let along = self.along(t);
        let sides = [0, 1].map(|i| along[i] * self.half[i]);
        let squares = self.half.map(|half| half * half * g);
        let mut q = (sides[0].abs() - squares[0]).max(sides[1].abs() - squares[1]);
        let mut unit = [Quad::ZERO; 2];
        for _ in 0..STEPS {
            let divisors = squares.map(|square| square + q);
            let on = [sides[0] / divisors[0], sides[1] / divisors[1]];
            let size = norm(&on);
            unit = on.map(|part| part / size);
            let slope = on[0] * on[0] / divisors[0] + on[1] * on[1] / divisors[1];
            let next = q + (size - Quad::ONE) * size * size / slope;
            if !(next > q) {
                break;
            }
            q = next;
        }
        self.of([0, 1].map(|i| self.half[i] * unit[i] * g))
    }
}
