//! The relation of general rows, dense and small, and the host from which it comes; what its symbols
//! mean stands in the test that uses it.

use fastrand::Rng;
use signorini::Relation;

use crate::common::dense::{Elimination, dot, product};
use crate::common::problems::{definite, semidefinite, vector};

/// A host's structure of `size` unknowns with rows that make its contact pairs.
pub struct Host {
    size: usize,
    k: Vec<f64>,
    f: Vec<f64>,
    /// `B`, row by row.
    pub rows: Vec<Vec<f64>>,
}

/// The relation of any rows.
pub struct GeneralRows {
    /// `S`, symmetric.
    s: Vec<f64>,
    /// Diagonal of `D^½`.
    root: Vec<f64>,
    /// `D d0`.
    pub load: Vec<f64>,
}

impl Relation for GeneralRows {
    fn size(&self) -> usize {
        self.root.len()
    }

    fn block(&self, i: usize, j: usize) -> f64 {
        if i == j { self.root[i] * self.root[i] } else { 0.0 }
    }

    fn load(&self) -> &[f64] {
        &self.load
    }

    fn residual(&self, d: &[f64], force: &[f64]) -> Vec<f64> {
        let n = self.size();
        // R = P - v, up to gaps and slips: v + S R = q.
        let v: Vec<f64> = (0..n).map(|i| self.root[i] * d[i]).collect();
        let r: Vec<f64> = (0..n).map(|i| -force[i] / self.root[i] - v[i]).collect();
        let s_r = product(&self.s, &r);
        (0..n).map(|i| self.root[i] * (v[i] + s_r[i]) - self.load[i]).collect()
    }

    fn magnitude(&self, size: &[f64]) -> Vec<f64> {
        let n = self.size();
        let entry = |i: usize, j: usize| {
            let one = if i == j { 1.0 } else { 0.0 };
            (self.root[i] * (one - self.s[i + n * j]) * self.root[j]).abs()
        };
        (0..n).map(|i| (0..n).map(|j| entry(i, j) * size[j]).sum()).collect()
    }
}

impl Host {
    /// `pairs` independent pairs on a structure that is held, or on one with a free motion.
    pub fn random(rng: &mut Rng, dim: usize, pairs: usize) -> Host {
        let size = dim * pairs + rng.usize(1..=4);
        let k = if rng.bool() {
            definite(rng, size, 30.0)
        } else {
            let motion = vector(rng, size);
            semidefinite(rng, size, 30.0, &[motion])
        };
        // Each row has a component of its own, and some of the others.
        let row = |rng: &mut Rng, i: usize| -> Vec<f64> {
            let mut row: Vec<f64> = vector(rng, size).iter().map(|b| 0.2 * b).collect();
            row[i] += 1.0;
            row
        };
        let rows: Vec<Vec<f64>> = (0..dim * pairs).map(|i| row(rng, i)).collect();
        let mut f: Vec<f64> = vector(rng, size).iter().map(|f| 0.3 * f).collect();
        // Pressed on the obstacles.
        for row in rows.iter().step_by(dim) {
            f.iter_mut().zip(row).for_each(|(f, b)| *f += b);
        }
        Host { size, k, f, rows }
    }

    /// `D`: the host's diagonal in series over the nodes of a row, the same along all tangents.
    pub fn diagonal(&self, dim: usize) -> Vec<f64> {
        let series = |row: &Vec<f64>| -> f64 {
            let parts = row.iter().enumerate();
            parts.map(|(j, b)| b * b / self.k[j + self.size * j]).sum::<f64>().recip()
        };
        let mut diagonal: Vec<f64> = self.rows.iter().map(series).collect();
        for pair in diagonal.chunks_exact_mut(dim) {
            let least = pair[1..].iter().copied().fold(f64::INFINITY, f64::min);
            pair[1..].fill(least);
        }
        diagonal
    }

    /// `G` and `d0`.
    pub fn flexibility(&self, diagonal: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let (size, count) = (self.size, self.rows.len());
        let mut a = self.k.clone();
        for (row, d) in self.rows.iter().zip(diagonal) {
            for i in 0..size {
                for j in 0..size {
                    a[i + size * j] += d * row[i] * row[j];
                }
            }
        }
        let a = Elimination::new(size, &a);
        assert_eq!(a.rank, size, "every motion is held by K or by a pair");
        let solved: Vec<Vec<f64>> = self.rows.iter().map(|row| a.solve(row).0).collect();
        let g = |k: usize| dot(&self.rows[k % count], &solved[k / count]);
        let d0 = solved.iter().map(|column| dot(column, &self.f)).collect();
        ((0..count * count).map(g).collect(), d0)
    }

    pub fn general_rows(&self, dim: usize) -> GeneralRows {
        let diagonal = self.diagonal(dim);
        let (g, d0) = self.flexibility(&diagonal);
        let root: Vec<f64> = diagonal.iter().map(|d| d.sqrt()).collect();
        let n = root.len();
        let s = (0..n * n).map(|k| root[k % n] * g[k] * root[k / n]).collect();
        let load = diagonal.iter().zip(&d0).map(|(d, d0)| d * d0).collect();
        GeneralRows { s, root, load }
    }

    /// `K_rel` and its loads, of independent rows.
    pub fn stiffness(&self, dim: usize) -> (Vec<f64>, Vec<f64>) {
        let diagonal = self.diagonal(dim);
        let (g, d0) = self.flexibility(&diagonal);
        let n = d0.len();
        let inverse = Elimination::new(n, &g);
        assert_eq!(inverse.rank, n, "the rows are independent");
        let column = |j: usize| {
            let unit: Vec<f64> = (0..n).map(|i| f64::from(u8::from(i == j))).collect();
            inverse.solve(&unit).0
        };
        let columns: Vec<Vec<f64>> = (0..n).map(column).collect();
        let entry = |i: usize, j: usize| (columns[j][i] + columns[i][j]) / 2.0;
        let less = |i: usize, j: usize| if i == j { diagonal[i] } else { 0.0 };
        let k = (0..n * n).map(|k| entry(k % n, k / n) - less(k % n, k / n)).collect();
        (k, inverse.solve(&d0).0)
    }

    /// The rows with a second copy of the first pair behind them.
    pub fn doubled(&self, dim: usize) -> Host {
        let rows = self.rows[..dim].iter().chain(&self.rows).cloned().collect();
        Host { size: self.size, k: self.k.clone(), f: self.f.clone(), rows }
    }
}
