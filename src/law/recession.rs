//! The conditions under which a motion proves that no equilibrium exists.
//!
//! Let `|r_t|*` be the largest work of tangential forces of gauge 1 on `r_t`; of an isotropic law it is
//! the length. With `p' = p + a >= 0`, and `p' = 0` without an obstacle, an admissible force does the work
//!
//! ```text
//! F . r = -p r_n - tau . r_t >= p' (-r_n - slope |r_t|*) + a r_n - offset |r_t|*
//! ```
//!
//! on a motion `r`. A rigid motion (`K r = 0`) with `r_n + slope |r_t|* <= 0` at every pair that has an
//! obstacle is a recession direction: `F . r >= sum (a r_n - offset |r_t|*)`, while equilibrium asks for
//! `F . r = -f . r`. So `f . r + sum a r_n > sum offset |r_t|*` excludes equilibrium: the tension of the
//! pairs counts as a part of the loads ([`super::Contact::load_with_tension`]). Of a pair that has an obstacle
//! `r_n <= 0`: tension takes the work `a |r_n|`.

use super::{PairLaw, Vector, length};

/// A motion of a pair, as its law sees it.
#[derive(Clone, Copy, Debug)]
pub struct Recession {
    /// `r_n + slope |r_t|*`, which must not be positive; `-inf` without an obstacle; of a tie the length of the motion,
    /// tangential components by the roots of their stiffness.
    pub approach: f64,
    /// `slope |r_t|*`: the lift that keeps contact forces from doing negative work on the slip.
    pub lift: f64,
    /// `offset |r_t|*`: most work that friction takes.
    pub resisted: f64,
}

/// Lifts a pair off its obstacle: adds to its motion `r`.
pub fn lift(r: &mut [f64], by: f64) {
    r[0] -= by;
}

impl PairLaw {
    /// The motion `r` of the pair.
    pub fn recession(&self, r: &[f64]) -> Recession {
        if self.tied {
            let along = (self.k_t / self.k_n).sqrt() * length(&r[1..self.dim]);
            return Recession { approach: r[0].hypot(along), lift: 0.0, resisted: 0.0 };
        }
        let slip = self.dual_gauge(&r[1..self.dim]);
        let lift = self.bound.slope * slip;
        let approach = if self.has_obstacle() { r[0] + lift } else { f64::NEG_INFINITY };
        Recession { approach, lift, resisted: self.bound.offset * slip }
    }

    /// Where `motion` of the pair's component goes, in words.
    pub fn direction(&self, component: usize, motion: f64) -> String {
        match (component, motion < 0.0) {
            (0, true) => "away from the obstacle".to_owned(),
            (0, false) => "towards where its obstacle would be".to_owned(),
            (c, backwards) => {
                let axis = if self.dim == 2 { "t".to_owned() } else { format!("t{c}") };
                format!("along {}{axis}", if backwards { "-" } else { "+" })
            }
        }
    }

    /// Some edges of the cone of the forces without bound that the pair can carry, each with the normal
    /// component −1: all in the plane, four in space; none without an obstacle. A tie carries all forces.
    pub fn cone_edges(&self) -> Vec<Vector> {
        let mu = self.bound.slope;
        match self.dim {
            dim if self.tied => {
                let along = |c: usize, force: f64| {
                    std::array::from_fn(|k| if k == c { force } else { 0.0 })
                };
                (0..dim).flat_map(|c| [along(c, 1.0), along(c, -1.0)]).collect()
            }
            _ if !self.has_obstacle() => Vec::new(),
            _ if mu == 0.0 => vec![[-1.0, 0.0, 0.0]],
            2 => vec![[-1.0, mu, 0.0], [-1.0, -mu, 0.0]],
            _ => [[mu, 0.0], [-mu, 0.0], [0.0, mu], [0.0, -mu]]
                .map(|edge| {
                    let edge =
                        self.ellipse.as_ref().map_or(edge, |ellipse| ellipse.from_disc(edge));
                    [-1.0, edge[0], edge[1]]
                })
                .to_vec(),
        }
    }

    /// The edge of the cone whose force does the least work on the motion `r`: the work is
    /// `-(r_n + slope |r_t|*)`.
    pub fn opposing_edge(&self, r: &[f64]) -> Vector {
        if self.tied {
            let against = |c: usize| r.get(c).map_or(0.0, |r| -r);
            return [against(0), against(1), against(2)];
        }
        let mut edge = [-1.0, 0.0, 0.0];
        let mut against = [0.0; 2];
        against[..self.dim - 1].copy_from_slice(&r[1..self.dim]);
        if let Some(ellipse) = &self.ellipse {
            against = ellipse.from_disc(ellipse.dual_of(against));
        }
        let gauge = self.gauge(&against[..self.dim - 1]);
        if gauge > 0.0 {
            for c in 1..self.dim {
                edge[c] = -self.bound.slope * against[c - 1] / gauge;
            }
        }
        edge
    }
}
