//! The exact solution of one pair, its block coupled: `A v + P' = r` with `(v, P)` on the law; `r` holds
//! the tension of the pair.
//!
//! Given the bound `g` on the tangential force, the problem is convex. With the pair closed,
//! `A_tt delta + tau = r_t`, `|tau| <= g`, has one solution `delta(g)`, and the pressure that belongs to
//! it is `r_n - A_nt delta(g)`. So:
//!
//! - Under the bound of zero pressure the pressure is not positive: the pair is open.
//! - Otherwise `h(p) = p - r_n + A_nt delta(g(p))` is negative at 0 and positive where `g(p)` holds the
//!   pair and `p > r_n`. It is continuous: a zero between them is a solution, for every coefficient.
//!
//! With the ellipse of the associated rule the same holds in the variables of the disc. Under the
//! collinear rule a solution `delta(g)` exists, but others may too, and where it jumps the pair returned
//! is none of the law: there is no theorem for that rule here.

use super::{Block, PairLaw, Plane, Rule, Vector, ellipse, length};

/// Halvings of the interval of a root: they end at its last bit, and at the latest when it has shrunk
/// to 1e-60 of its length, for roots near zero.
const BISECTIONS: usize = 200;

impl PairLaw {
    /// The displacement `d` of the pair with `block d = c + F` and the law obeyed. `block` is
    /// symmetric positive definite; entries beyond the dimension are not read.
    pub fn solve(&self, block: &Block, c: &Vector) -> Vector {
        let reference = self.reference();
        let mut r = *c;
        for (r, row) in r.iter_mut().zip(block).take(self.dim) {
            *r -= (0..self.dim).map(|j| row[j] * reference[j]).sum::<f64>();
        }
        r[0] += self.tension;
        let v = self.closed(block, &r).unwrap_or_else(|| self.open(block, &r));
        let mut d = [0.0; 3];
        for c in 0..self.dim {
            d[c] = v[c] + reference[c];
        }
        d
    }

    /// `v` of the closed pair; `None` if it would have to pull.
    fn closed(&self, block: &Block, r: &Vector) -> Option<Vector> {
        if !self.has_obstacle() {
            return None;
        }
        let tangential = [[block[1][1], block[1][2]], [block[2][1], block[2][2]]];
        let delta = |p: f64| self.slip_under(tangential, [r[1], r[2]], self.bound.at(p));
        let h = |p: f64| {
            let delta = delta(p);
            p - r[0] + (1..self.dim).map(|c| block[0][c] * delta[c - 1]).sum::<f64>()
        };
        if h(0.0) >= 0.0 {
            return None;
        }
        let mut above = r.iter().fold(f64::MIN_POSITIVE, |most, r| most.max(r.abs()));
        while h(above) < 0.0 {
            above *= 2.0;
        }
        let p = root(0.0, above, h);
        let delta = delta(p);
        Some([0.0, delta[0], delta[1]])
    }

    /// `v` of the open pair, its normal component eliminated.
    fn open(&self, block: &Block, r: &Vector) -> Vector {
        let schur = |i: usize, j: usize| block[i][j] - block[i][0] * block[0][j] / block[0][0];
        let rest = |i: usize| r[i] - block[i][0] * r[0] / block[0][0];
        let tangential = match self.dim {
            2 => [[schur(1, 1), 0.0], [0.0; 2]],
            _ => [[schur(1, 1), schur(1, 2)], [schur(2, 1), schur(2, 2)]],
        };
        let right = if self.dim == 2 { [rest(1), 0.0] } else { [rest(1), rest(2)] };
        let delta = self.slip_under(tangential, right, self.bound.at(0.0));
        let coupled: f64 = (1..self.dim).map(|c| block[0][c] * delta[c - 1]).sum();
        [(r[0] - coupled) / block[0][0], delta[0], delta[1]]
    }

    /// `delta` with `a delta + tau = r`, the gauge of `tau` at most `g`, and the slip of the law.
    fn slip_under(&self, a: Plane, r: [f64; 2], g: f64) -> [f64; 2] {
        if self.dim == 2 {
            let size = r[0].abs();
            return if size <= g { [0.0; 2] } else { [(r[0] - g * (r[0] / size)) / a[0][0], 0.0] };
        }
        match &self.ellipse {
            Some(ellipse) if ellipse.rule() == Rule::Associated => {
                let (a, r) = (ellipse.block_to_disc(&a), ellipse.to_disc(r));
                ellipse.slip_from_disc(slip_along_force(&a, r, g, |t| length(&t)))
            }
            _ => slip_along_force(&a, r, g, |t| self.gauge(&t)),
        }
    }
}

/// `delta` with `a delta + tau = r`, `gauge(tau) <= g`, `delta` along `tau` and zero where the gauge is
/// smaller: `(a + lambda) delta = r` with a `lambda` for which `lambda gauge(delta) = g`. The left-hand
/// side grows with `lambda` if the gauge is the length.
fn slip_along_force(a: &Plane, r: [f64; 2], g: f64, gauge: impl Fn([f64; 2]) -> f64) -> [f64; 2] {
    if gauge(r) <= g {
        return [0.0; 2];
    }
    let delta = |lambda: f64| {
        let stiffened = [[a[0][0] + lambda, a[0][1]], [a[1][0], a[1][1] + lambda]];
        ellipse::product(&ellipse::inverse(&stiffened), r)
    };
    let excess = |lambda: f64| lambda * gauge(delta(lambda)) - g;
    let mut above = a[0][0].max(a[1][1]);
    while excess(above) < 0.0 {
        above *= 2.0;
    }
    delta(root(0.0, above, excess))
}

/// A zero of a continuous function that is not positive at `below` and not negative at `above`, to the
/// last bit.
fn root(mut below: f64, mut above: f64, of: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..BISECTIONS {
        let middle = below + (above - below) / 2.0;
        if middle <= below || middle >= above {
            break;
        }
        if of(middle) <= 0.0 { below = middle } else { above = middle }
    }
    above
}
