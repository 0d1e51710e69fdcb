//! Copositive LCPs of random graphs, in which many ratios tie at every pivot: Lemke's method neither cycles
//! nor strays, against the lexicographic method in whole numbers.
//!
//! A standard quadratic programme `min xᵀ Q x`, `x >= 0`, `sum x = 1` with a strictly copositive `Q` has its
//! Karush-Kuhn-Tucker points at the solutions of `w = -1 + Q z` (`z = x / λ`). With the adjacency matrix `A` of a
//! graph, `Q = 4 E - 2 A - I` has the maximum clique at its minimum (Bomze 1997), `Q = I + A` the maximum
//! stable set (Motzkin and Straus 1965), and `t (E - A) - E` is strictly copositive
//! above `t = ω`, the clique number (de Klerk and Pasechnik 2002).

use crate::common::bare::Bare;
use fastrand::Rng;
use signorini::{Method, Settings, Status};

/// The lexicographic method of Lemke with the covering vector of ones, in whole numbers: the tableau
/// `[I, -M, -1 | q]` without fractions (Bareiss 1968), all entries over one common denominator.
struct Exact {
    n: usize,
    rows: Vec<Vec<i128>>,
    denominator: i128,
    basic: Vec<usize>,
}

/// End of a run.
#[derive(Debug, PartialEq)]
enum End {
    Solved {
        pivots: u64,
    },
    Ray {
        pivots: u64,
    },
    /// A number has more than 127 bits.
    TooLarge,
}

impl Exact {
    fn new(data: &Bare) -> Self {
        let n = data.n;
        let row = |i: usize| {
            let mut row = vec![0; 2 * n + 2];
            (row[i], row[2 * n], row[2 * n + 1]) = (1, -1, data.q[i] as i128);
            for j in 0..n {
                row[n + j] = -data.m[i + j * n] as i128;
            }
            row
        };
        Exact { n, rows: (0..n).map(row).collect(), denominator: 1, basic: (0..n).collect() }
    }

    fn run(mut self) -> End {
        let (n, z0, q) = (self.n, 2 * self.n, 2 * self.n + 1);
        let least = self.rows.iter().map(|row| row[q]).min().unwrap_or(0);
        if least >= 0 {
            return End::Solved { pivots: 0 };
        }
        // The last of ties: its perturbation is the smallest.
        let mut row = (0..n).rev().find(|&i| self.rows[i][q] == least).unwrap();
        self.rows[row].iter_mut().for_each(|entry| *entry = -*entry);
        let mut entering = z0;
        let mut pivots = 0;
        loop {
            let leaving = self.basic[row];
            if self.pivot(row, entering).is_none() {
                return End::TooLarge;
            }
            pivots += 1;
            if leaving == z0 {
                return End::Solved { pivots };
            }
            entering = if leaving < n { leaving + n } else { leaving - n };
            row = match self.leaving(entering) {
                Some(Some(row)) => row,
                Some(None) => return End::Ray { pivots },
                None => return End::TooLarge,
            };
        }
    }

    fn pivot(&mut self, row: usize, column: usize) -> Option<()> {
        let pivot = self.rows[row][column];
        let own = self.rows[row].clone();
        for i in (0..self.n).filter(|&i| i != row) {
            let factor = self.rows[i][column];
            for (entry, own) in self.rows[i].iter_mut().zip(&own) {
                let product = entry.checked_mul(pivot)?.checked_sub(factor.checked_mul(*own)?)?;
                *entry = product / self.denominator;
            }
        }
        self.denominator = pivot;
        self.basic[row] = column;
        Some(())
    }

    /// The row that leaves; `Some(None)` on a ray, `None` if a number is too large.
    fn leaving(&self, entering: usize) -> Option<Option<usize>> {
        let z0 = 2 * self.n;
        let mut ties: Vec<usize> = (0..self.n).filter(|&i| self.rows[i][entering] > 0).collect();
        for key in std::iter::once(z0 + 1).chain(0..self.n) {
            let mut least: Vec<usize> = Vec::new();
            for &i in &ties {
                let order = match least.first() {
                    Some(&first) => {
                        let (a, b) = (&self.rows[i], &self.rows[first]);
                        let one = a[key].checked_mul(b[entering])?;
                        one.cmp(&b[key].checked_mul(a[entering])?)
                    }
                    None => std::cmp::Ordering::Less,
                };
                match order {
                    std::cmp::Ordering::Less => least = vec![i],
                    std::cmp::Ordering::Equal => least.push(i),
                    std::cmp::Ordering::Greater => {}
                }
            }
            ties = least;
            if let Some(&row) = ties.iter().find(|&&row| self.basic[row] == z0) {
                return Some(Some(row));
            }
            if ties.len() <= 1 {
                break;
            }
        }
        Some(ties.first().copied())
    }
}

/// Adjacency of a random graph.
fn graph(rng: &mut Rng, n: usize, density: f64) -> Vec<bool> {
    let mut adjacent = vec![false; n * n];
    for i in 0..n {
        for j in 0..i {
            let edge = rng.f64() < density;
            (adjacent[i + j * n], adjacent[j + i * n]) = (edge, edge);
        }
    }
    adjacent
}

/// The kinds of problem: clique, stable set and copositive above a bound of the clique number with `q = -1`;
/// the same three, and the last with a smaller `t`, with a `q` of few or of more whole numbers.
fn problem(seed: u64, n: usize) -> Bare {
    let mut rng = Rng::with_seed(seed);
    let density = 0.1 + 0.8 * rng.f64();
    let adjacent = graph(&mut rng, n, density);
    let kind = seed % 8;
    // Above every clique number: strictly copositive.
    let t = if kind == 7 { 6.0 } else { n as f64 + 1.0 };
    let entry = |k: usize| {
        let (diagonal, edge) = (k % n == k / n, f64::from(u8::from(adjacent[k])));
        match kind % 4 {
            1 => edge + f64::from(u8::from(diagonal)),
            2 | 3 => t * (1.0 - edge) - 1.0,
            _ => 4.0 - 2.0 * edge - f64::from(u8::from(diagonal)),
        }
    };
    let m = (0..n * n).map(entry).collect();
    let whole = [-1..=-1, -3..=1, -20..=20][[0, 0, 0, 1, 1, 2, 2, 2][kind as usize]].clone();
    let q = (0..n).map(|_| f64::from(rng.i32(whole.clone()))).collect();
    Bare { n, m, q }
}

/// Every path ends within `10 n` pivots: in a solution, as strictly copositive matrices promise for all `q`
/// (Cottle, Pang and Stone, *The Linear Complementarity Problem*, 4.4), or in the ray of the exact method.
fn assert_ends(n: usize, seeds: std::ops::Range<u64>) {
    let budget = 10 * n as u64;
    let settings =
        Settings { method: Method::Lemke, max_iterations: budget, ..Settings::default() };
    let (mut known, mut most) = (0, 0);
    for seed in seeds {
        let data = problem(seed, n);
        let solution = data.solve(&settings);
        let exact = Exact::new(&data).run();
        let context =
            || format!("{n} {seed} {exact:?}: {} {}", solution.iterations, solution.message);
        println!("{}", context());
        assert_eq!(data.flaw(&solution, settings.tolerance), None, "{}", context());
        match exact {
            End::Solved { pivots } => {
                assert_eq!(solution.status, Status::Solved, "{}", context());
                assert_eq!(solution.iterations, pivots, "{}", context());
                (known, most) = (known + 1, pivots.max(most));
            }
            End::Ray { pivots } => {
                assert_ne!(solution.status, Status::Solved, "{}", context());
                assert_eq!(solution.iterations, pivots, "{}", context());
                (known, most) = (known + 1, pivots.max(most));
            }
            End::TooLarge => assert_eq!(solution.status, Status::Solved, "{}", context()),
        }
    }
    println!("{n}: {known} known, up to {most} pivots");
    assert!(known > 0);
}

/// Ones on the diagonal and at a tenth to a third of the other places, not symmetric: nothing is negative, so
/// that it is strictly copositive. With `q = -1` all ratios are those of small whole numbers, and
/// exact paths take up to ten times as many pivots as there are equations.
fn directed(seed: u64, n: usize) -> Bare {
    let mut rng = Rng::with_seed(seed);
    let density = 0.1 + 0.2 * rng.f64();
    let entry = |k: usize| f64::from(u8::from(k % n == k / n || rng.f64() < density));
    Bare { n, m: (0..n * n).map(entry).collect(), q: vec![-1.0; n] }
}

#[test]
fn directed_graphs_end_where_the_exact_method_does() {
    let n = 40;
    let (mut longest, mut same) = (0, 0);
    for seed in 0..200 {
        let data = directed(seed, n);
        let End::Solved { pivots } = Exact::new(&data).run() else { continue };
        // Rounding may cost the pivots before it is noticed.
        let budget = pivots.max(10 * n as u64);
        let settings =
            Settings { method: Method::Lemke, max_iterations: budget, ..Settings::default() };
        let solution = data.solve(&settings);
        println!("{seed}: {pivots} {} {}", solution.iterations, solution.message);
        assert_eq!(solution.status, Status::Solved, "{seed} {pivots}: {}", solution.message);
        assert_eq!(data.flaw(&solution, settings.tolerance), None, "{seed}");
        longest = pivots.max(longest);
        same += u64::from(solution.iterations == pivots);
    }
    println!("longest {longest}, same {same}");
    assert!(longest > 3 * n as u64, "{longest}: no long path among them");
}

#[test]
fn small_problems_take_the_pivots_of_the_exact_method() {
    for n in 2..=16 {
        assert_ends(n, 0..40);
    }
}

#[test]
fn problems_of_40_end_within_10_n_pivots() {
    assert_ends(40, 0..400);
}
