//! Small dense linear algebra, independent of the library's.

/// Pivots below this part of the largest are zero. Regular problems of the tests have condition
/// numbers up to 1e6, singular ones leave 1e-15.
const RANK: f64 = 1e-10;

/// Gaussian elimination with full pivoting of a square matrix given by rows.
pub struct Elimination {
    n: usize,
    /// `L` below the diagonal, `U` on and above it, in pivot order.
    factors: Vec<f64>,
    rows: Vec<usize>,
    columns: Vec<usize>,
    pub rank: usize,
}

impl Elimination {
    pub fn new(n: usize, matrix: &[f64]) -> Self {
        let mut a = matrix.to_vec();
        let (mut rows, mut columns): (Vec<_>, Vec<_>) = ((0..n).collect(), (0..n).collect());
        let mut rank = 0;
        let mut first = 0.0;
        while rank < n {
            let (mut i, mut j, mut most) = (rank, rank, 0.0);
            for p in rank..n {
                for q in rank..n {
                    if a[p * n + q].abs() > most {
                        (i, j, most) = (p, q, a[p * n + q].abs());
                    }
                }
            }
            if rank == 0 {
                first = most;
            }
            if most <= RANK * first {
                break;
            }
            for q in 0..n {
                a.swap(rank * n + q, i * n + q);
            }
            for p in 0..n {
                a.swap(p * n + rank, p * n + j);
            }
            rows.swap(rank, i);
            columns.swap(rank, j);
            for p in rank + 1..n {
                let share = a[p * n + rank] / a[rank * n + rank];
                a[p * n + rank] = share;
                for q in rank + 1..n {
                    a[p * n + q] -= share * a[rank * n + q];
                }
            }
            rank += 1;
        }
        Elimination { n, factors: a, rows, columns, rank }
    }

    /// One solution of `A x = b` (the free unknowns are zero) and the largest error left in the
    /// dependent equations.
    pub fn solve(&self, b: &[f64]) -> (Vec<f64>, f64) {
        let n = self.n;
        let mut y: Vec<f64> = self.rows.iter().map(|&i| b[i]).collect();
        for p in 0..n {
            for q in 0..p.min(self.rank) {
                y[p] -= self.factors[p * n + q] * y[q];
            }
        }
        let left = y[self.rank..].iter().fold(0.0, |most: f64, y| most.max(y.abs()));
        y.truncate(self.rank);
        (self.back_substituted(y, &vec![0.0; n - self.rank]), left)
    }

    /// A basis of the kernel.
    pub fn kernel(&self) -> Vec<Vec<f64>> {
        let free = self.n - self.rank;
        let unit = |k: usize| (0..free).map(|i| f64::from(u8::from(i == k))).collect::<Vec<_>>();
        (0..free).map(|k| self.back_substituted(vec![0.0; self.rank], &unit(k))).collect()
    }

    /// Sign of the determinant; 0 of a singular matrix.
    pub fn orientation(&self) -> i8 {
        if self.rank < self.n {
            return 0;
        }
        let pivots = (0..self.n).filter(|p| self.factors[p * self.n + p] < 0.0).count();
        let odd = (pivots + swaps(&self.rows) + swaps(&self.columns)) % 2 == 1;
        if odd { -1 } else { 1 }
    }

    /// Frobenius norm of the map from `b` to the solution.
    pub fn inverse_norm(&self) -> f64 {
        let mut square = 0.0;
        for k in 0..self.n {
            let mut b = vec![0.0; self.n];
            b[k] = 1.0;
            square += self.solve(&b).0.iter().map(|x| x * x).sum::<f64>();
        }
        square.sqrt()
    }

    fn back_substituted(&self, mut y: Vec<f64>, free: &[f64]) -> Vec<f64> {
        let (n, r) = (self.n, self.rank);
        for p in (0..r).rev() {
            for q in p + 1..n {
                let x = if q < r { y[q] } else { free[q - r] };
                y[p] -= self.factors[p * n + q] * x;
            }
            y[p] /= self.factors[p * n + p];
        }
        let mut x = vec![0.0; n];
        for (p, &column) in self.columns.iter().enumerate() {
            x[column] = if p < r { y[p] } else { free[p - r] };
        }
        x
    }
}

/// Exchanges of two that make a permutation: its length less its cycles.
fn swaps(permutation: &[usize]) -> usize {
    let mut seen = vec![false; permutation.len()];
    let mut cycles = 0;
    for start in 0..permutation.len() {
        cycles += usize::from(!seen[start]);
        let mut at = start;
        while !seen[at] {
            seen[at] = true;
            at = permutation[at];
        }
    }
    permutation.len() - cycles
}

/// The largest `t` with `values[i] + sum_k c_k rates[k][i] >= t` for all `i` and some `c`: how
/// strictly the system of inequalities `>= 0` can be met. By Fourier's and Motzkin's elimination
/// of one `c_k` after the other; infinite if nothing bounds it.
pub fn best_margin(values: &[f64], rates: &[Vec<f64>]) -> f64 {
    // Rows (value, rates); each stands for value + rates . c >= t and stays so under elimination,
    // which forms convex combinations.
    let mut rows: Vec<Vec<f64>> = (0..values.len())
        .map(|i| std::iter::once(values[i]).chain(rates.iter().map(|rate| rate[i])).collect())
        .collect();
    for k in 1..=rates.len() {
        let most = rows.iter().fold(0.0, |most: f64, row| most.max(row[k].abs()));
        let sign = |row: &Vec<f64>| if row[k].abs() <= 1e-9 * most { 0.0 } else { row[k].signum() };
        let of = |s: f64| rows.iter().filter(move |row| sign(row) == s);
        let mut next: Vec<Vec<f64>> = of(0.0).cloned().collect();
        for up in of(1.0) {
            for down in of(-1.0) {
                let share = -down[k] / (up[k] - down[k]);
                next.push(
                    up.iter().zip(down).map(|(u, d)| share * u + (1.0 - share) * d).collect(),
                );
            }
        }
        rows = next;
    }
    rows.iter().fold(f64::INFINITY, |least, row| least.min(row[0]))
}

/// `A x`, `A` symmetric (or column-major) of the size of `x`.
pub fn product(a: &[f64], x: &[f64]) -> Vec<f64> {
    let n = x.len();
    (0..n).map(|i| (0..n).map(|j| a[i + j * n] * x[j]).sum()).collect()
}

pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

pub fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

pub fn largest(a: &[f64]) -> f64 {
    a.iter().fold(0.0, |most, a| a.abs().max(most))
}

pub fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

/// The rest of a symmetric system `A x = b` once its first `free` unknowns are eliminated: matrix,
/// column-major, and right side.
pub fn condensed(a: &[f64], b: &[f64], free: usize) -> (Vec<f64>, Vec<f64>) {
    let n = b.len();
    let rest = n - free;
    let block: Vec<f64> = (0..free * free).map(|k| a[k / free + n * (k % free)]).collect();
    let elimination = Elimination::new(free, &block);
    assert_eq!(elimination.rank, free, "the first unknowns can be eliminated");
    let column = |j: usize| &a[n * j..n * (j + 1)];
    let mut matrix = Vec::new();
    for j in free..n {
        let carried = elimination.solve(&column(j)[..free]).0;
        matrix.extend((free..n).map(|i| column(j)[i] - dot(&column(i)[..free], &carried)));
    }
    let carried = elimination.solve(&b[..free]).0;
    let right = (free..n).map(|i| b[i] - dot(&column(i)[..free], &carried)).collect();
    assert_eq!(matrix.len(), rest * rest);
    (matrix, right)
}
