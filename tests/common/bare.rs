//! LCPs `w = q + M z`, all their solutions, and what is wrong with
//! an answer.

use signorini::{Lcp, LcpSolution, Monitor, Settings, Status, solve_lcp};

use super::dense::{Elimination, best_margin, dot, largest, norm};

/// A problem with its arrays, `m` column-major.
#[derive(Clone, Debug)]
pub struct Bare {
    pub n: usize,
    pub m: Vec<f64>,
    pub q: Vec<f64>,
}

impl Bare {
    pub fn solve(&self, settings: &Settings) -> LcpSolution {
        self.solve_covered(settings, None)
    }

    /// With a covering vector.
    pub fn solve_covered(&self, settings: &Settings, cover: Option<&[f64]>) -> LcpSolution {
        let lcp = Lcp::new(self.n, &self.m, self.n.max(1), &self.q, cover).unwrap();
        solve_lcp(&lcp, settings, &mut Monitor::new(settings, None)).unwrap()
    }

    pub fn row(&self, i: usize) -> Vec<f64> {
        (0..self.n).map(|j| self.m[i + j * self.n]).collect()
    }

    pub fn column(&self, j: usize) -> &[f64] {
        &self.m[j * self.n..(j + 1) * self.n]
    }

    /// How strictly the best complementary basis can be filled, relative to `q`; negative: there is
    /// no solution. In each, `w_i` or `z_i` is free to be positive for every `i`, a square system;
    /// a singular one that is consistent has a flat of candidates, searched by elimination.
    pub fn margin(&self) -> f64 {
        let n = self.n;
        let unit = largest(&self.q).max(f64::MIN_POSITIVE);
        let mut best = f64::NEG_INFINITY;
        for choice in 0..1_usize << n {
            // Rows of: sum over chosen z of -M_j z_j + sum over chosen w of e_j w_j = q.
            let mut basis = vec![0.0; n * n];
            for j in 0..n {
                for i in 0..n {
                    basis[i * n + j] = match choice >> j & 1 {
                        0 => f64::from(u8::from(i == j)),
                        _ => -self.m[i + j * n],
                    };
                }
            }
            let elimination = Elimination::new(n, &basis);
            let (point, left) = elimination.solve(&self.q);
            if left <= 1e-9 * unit {
                best = best.max(best_margin(&point, &elimination.kernel()) / unit);
            }
        }
        best
    }

    /// Why `solution` is not one, or proves nothing.
    pub fn flaw(&self, solution: &LcpSolution, tolerance: f64) -> Option<String> {
        let LcpSolution { w, z, .. } = solution;
        if w.iter().chain(z).any(|x| !(*x >= 0.0)) {
            return Some("negative".into());
        }
        match solution.status {
            Status::Solved => {
                if (0..self.n).any(|i| w[i] != 0.0 && z[i] != 0.0) {
                    return Some("not complementary".into());
                }
                // The tolerance is on min(w, m z) with w = q + M z; the returned w is cut off by
                // that much at most. Twice, as norms are; and the rounding of sums here.
                let mut rounding = vec![0.0; self.n];
                let mut error = vec![0.0; self.n];
                for i in 0..self.n {
                    let row = self.row(i);
                    let low =
                        if solution.z_low.is_empty() { 0.0 } else { dot(&row, &solution.z_low) };
                    error[i] = self.q[i] + dot(&row, z) + low - w[i];
                    let sizes: Vec<f64> = row.iter().map(|m| m.abs()).collect();
                    rounding[i] = self.n as f64 * f64::EPSILON * (dot(&sizes, z) + w[i]);
                }
                let excess = norm(&error) > 2.0 * tolerance * norm(&self.q) + norm(&rounding);
                excess.then(|| format!("w = q + M z is {error:?} off"))
            }
            Status::NoEquilibrium => {
                let Some(y) = &solution.infeasible_by else { return Some("no proof".into()) };
                if y.iter().any(|y| !(*y >= 0.0)) {
                    return Some("negative".into());
                }
                // Farkas: y >= 0, Mᵀ y <= 0, q.y < 0 leave no w, z >= 0, as w.y = q.y + z.Mᵀy.
                // Zero is what 8 units in the last digits of the entries explain, and the rounding of sums here.
                let part = (8.0 + self.n as f64) * f64::EPSILON;
                let terms = |j: usize| -> f64 {
                    self.column(j).iter().zip(y).map(|(m, y)| (m * y).abs()).sum()
                };
                let bad = (0..self.n).find(|&j| dot(self.column(j), y) > part * terms(j));
                match bad {
                    Some(j) => Some(format!("(Mᵀ y)[{j}] = {:e} > 0", dot(self.column(j), y))),
                    None if dot(&self.q, y) < 0.0 => None,
                    None => Some("q.y is not negative".into()),
                }
            }
            Status::Stalled => None,
            other => Some(format!("no reason to end with {other:?}")),
        }
    }
}
