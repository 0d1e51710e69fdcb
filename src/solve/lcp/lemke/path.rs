//! Lemke's method for linear complementarity problems, lexicographic, on the compact tableau.
//!
//! | matrix `M` | what the method does (exact arithmetic) |
//! |---|---|
//! | positive definite, P | solves |
//! | positive semi-definite, copositive-plus | solves, or its ray proves that nothing is feasible |
//! | any other | solves, or ends in a ray that proves nothing |
//!
//! It never cycles. The number of pivots is of the order of `n` in mechanics and `2^n` at worst.
//! Cottle, Pang and Stone, *The Linear Complementarity Problem*, 4.4; Lemke (1965).
//!
//! Rounding: every [`CHECK`] pivots the values are refined on the data; where they were found to
//! have drifted, the tableau is refactorised. A caller whose certificate finds the
//! end of a path inaccurate repeats it with [`Refactorising::Thorough`].
//!
//! Rounding may also break a tie the wrong way, and then the path may cycle. So close ratios are decided in
//! twice the precision where that is cheap beside the path, after as many pivots as there are equations of a
//! small problem, and where a path has returned to a basis: it begins again.

use super::scaled::{Entries, Scaled};
use super::tableau::Tableau;
use super::trail::Trail;
use crate::error::Error;
use crate::linalg::matrix::Matrix;
use crate::linalg::power_of_two::{largest_exponent, times_power_of_two};
use crate::linalg::tolerances::NEGLIGIBLE;
use crate::monitor::{Monitor, Stop};
use crate::solve::result::Ending;

/// Result of a run.
#[derive(Clone, Debug)]
pub struct LemkeRun {
    /// `z`, non-negative; of a run that was stopped that of the last basis.
    pub z: Vec<f64>,
    /// How it ended: done (`z0 = 0`, a solution up to rounding), on a secondary ray with its direction
    /// in `z` ([`Ending::Recession`]), in a basis that rounding made singular, or stopped.
    pub ending: Ending,
    /// First turning points of the path, where `z0` starts to increase.
    pub turns: Vec<Vec<f64>>,
    /// How often accuracy was lost and restored.
    pub refactorisations: u64,
}

/// Rounding made a basis of Lemke's method singular.
pub const BREAKDOWN: Ending = Ending::Stalled("rounding made Lemke's basis singular");

/// Pivots between two checks of the values against the data: the check costs about one pivot. While close ratios are
/// decided in twice the precision, checks are four times as many.
const CHECK: u64 = 32;

/// Residual, relative to `q`, from which on the tableau is refactorised: ten times what a check's own
/// refinement can mend.
const DRIFT: f64 = 10.0 * NEGLIGIBLE;

/// Ratios and values that differ by less are close: far more than a tableau of that age has lost.
const CLOSE: f64 = 1e-7;

/// Up to so many equations close ratios are decided in twice the precision from the `n`-th pivot on: a
/// decision costs about `100 n²` operations for each row, 0.1 ms here.
const FEW: usize = 64;

/// That ends after `SPAN n` pivots: longer paths are those of problems built to have them.
const SPAN: u64 = 20;

/// A path that returned to a basis although its ties were decided in twice the precision.
const CYCLE: Ending = Ending::Stalled("rounding made Lemke's path return to a basis");

/// When the tableau is refactorised.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Refactorising {
    /// When its values have drifted.
    Usual,
    /// At every check.
    Thorough,
}

/// How a path is followed.
#[derive(Clone, Copy, Debug)]
pub struct LemkeRules {
    /// When the tableau is refactorised.
    pub care: Refactorising,
    /// The path is at its end when `z0` has fallen to this part of its start: beyond it rounding
    /// decides between the end and a false ray.
    pub end: f64,
    /// Most turning points to be kept.
    pub turns: usize,
}

/// End of the path where a ray proves something: only the rounding of the last pivots is forgiven, ten
/// units of [`crate::linalg::tolerances::ROUNDING`].
const END: f64 = 1e-13;

impl LemkeRules {
    /// For problems in which a ray proves something.
    pub fn usual(care: Refactorising) -> Self {
        LemkeRules { care, end: END, turns: 0 }
    }
}

/// An LCP to be solved in the variables `z_i / scale_i`, `w_i * scale_i`.
#[derive(Clone, Copy)]
pub struct ScaledLcp<'p> {
    /// `M`.
    pub matrix: &'p dyn Entries,
    /// `q`.
    pub q: &'p [f64],
    /// Covering vector, positive.
    pub covering: &'p [f64],
    /// Scales.
    pub scale: &'p [f64],
}

impl Entries for Matrix<'_> {
    fn write_column(&self, j: usize, column: &mut [f64]) {
        column.copy_from_slice(self.column(j));
    }
}

/// Follows the path of `lcp`.
pub fn follow(
    lcp: ScaledLcp<'_>,
    rules: LemkeRules,
    monitor: &mut Monitor<'_>,
) -> Result<LemkeRun, Error> {
    let ScaledLcp { matrix, q, scale, .. } = lcp;
    let n = q.len();
    // The values get size one, as the rest of the scaled problem. Powers of two: the pivots stay the same.
    let of_size_one = |values: &[f64]| -> (Vec<f64>, i32) {
        let first = largest_exponent(values.iter().copied()).unwrap_or(0);
        let scaled = values.iter().zip(scale);
        let scaled = scaled.map(|(&value, scale)| times_power_of_two(value, -first) * scale);
        let scaled: Vec<f64> = scaled.collect();
        let second = largest_exponent(scaled.iter().copied()).unwrap_or(0);
        let of_size_one = scaled.iter().map(|&value| times_power_of_two(value, -second));
        (of_size_one.collect(), first + second)
    };
    let ((q, unit), (covering, _)) = (of_size_one(q), of_size_one(lcp.covering));
    let problem = Scaled { matrix, scale, q, covering };
    let in_unit = |z: &mut dyn Iterator<Item = f64>, unit: i32| -> Vec<f64> {
        let unscaled = z.zip(scale).map(|(z, scale)| z.max(0.0) * scale);
        unscaled.map(|z| times_power_of_two(z, unit)).collect()
    };
    let nothing =
        |ending| LemkeRun { z: vec![0.0; n], ending, turns: Vec::new(), refactorisations: 0 };
    if let Err(stop) = monitor.affords(Tableau::work(n)) {
        return Ok(nothing(Ending::Stopped(stop)));
    }
    let tableau = match Tableau::new(&problem, monitor)? {
        Ok(tableau) => tableau,
        Err(stop) => return Ok(nothing(Ending::Stopped(stop))),
    };
    if !tableau.is_finite() || problem.covering.contains(&0.0) {
        return Ok(nothing(Ending::Stalled("numbers overflow or underflow in the LCP")));
    }
    let mut path =
        Path { problem: &problem, tableau, rules, turns: Vec::new(), refactorisations: 0 };
    let mut end = path.run(false, monitor);
    if let LemkeEnd::Cycle = end {
        end = match Tableau::new(&problem, monitor)? {
            Ok(tableau) => {
                path.tableau = tableau;
                path.turns.clear();
                path.run(true, monitor)
            }
            Err(stop) => LemkeEnd::Ended(Ending::Stopped(stop)),
        };
    }
    let ending = match end {
        LemkeEnd::Ray(entering) => {
            Ending::Recession(in_unit(&mut (n..2 * n).map(|z| path.tableau.rate(z, entering)), 0))
        }
        LemkeEnd::Cycle => CYCLE,
        LemkeEnd::Ended(ending) => ending,
    };
    let turns = path.turns.iter().map(|z| in_unit(&mut z.iter().copied(), unit)).collect();
    let z = in_unit(&mut (n..2 * n).map(|z| path.tableau.value(z)), unit);
    Ok(LemkeRun { z, ending, turns, refactorisations: path.refactorisations })
}

/// A path that is being followed.
struct Path<'p> {
    problem: &'p Scaled<'p>,
    tableau: Tableau,
    rules: LemkeRules,
    turns: Vec<Vec<f64>>,
    refactorisations: u64,
}

/// The end of a path in terms of the tableau.
enum LemkeEnd {
    Ended(Ending),
    /// Nothing blocks the entering variable.
    Ray(usize),
    /// It returned to a basis.
    Cycle,
}

impl Path<'_> {
    /// Follows the path; `always`: with close ratios decided in twice the precision from start to end.
    fn run(&mut self, always: bool, monitor: &mut Monitor<'_>) -> LemkeEnd {
        let n = self.problem.size();
        let z0 = 2 * n;
        let Some(mut row) = self.tableau.first_row() else { return LemkeEnd::Ended(Ending::Done) };
        let mut entering = z0;
        self.tableau.choose(entering);
        let mut start = None;
        let mut pivots = 0;
        let (mut trail, mut careful) = (Trail::new(), always);
        loop {
            let work = self.tableau.pivot_work();
            if let Err(stop) = monitor.step().and_then(|()| monitor.affords(work)) {
                return LemkeEnd::Ended(Ending::Stopped(stop));
            }
            pivots += 1;
            let leaving = self.tableau.basic(row);
            self.tableau.pivot(row, entering);
            let limit = self.rules.end * start.unwrap_or(0.0);
            let ended = leaving == z0 || self.tableau.value(z0) <= limit;
            let interval = if careful { CHECK / 4 } else { CHECK };
            if ended || pivots % interval == 0 {
                match self.check(careful, monitor) {
                    Ok(true) => {}
                    Ok(false) => return LemkeEnd::Ended(BREAKDOWN),
                    Err(stop) => return LemkeEnd::Ended(Ending::Stopped(stop)),
                }
            }
            if ended {
                return LemkeEnd::Ended(Ending::Done);
            }
            if trail.returns_by(entering, leaving) {
                return LemkeEnd::Cycle;
            }
            careful = always || (n <= FEW && (n as u64..SPAN * n as u64).contains(&pivots));
            start.get_or_insert(self.tableau.value(z0));
            entering = if leaving < n { leaving + n } else { leaving - n };
            self.tableau.choose(entering);
            if self.turns.len() < self.rules.turns && self.tableau.rate(z0, entering) > 0.0 {
                self.turns.push((n..2 * n).map(|z| self.tableau.value(z)).collect());
            }
            row = match self.blocking_row(careful, entering) {
                Some(row) => row,
                None => return LemkeEnd::Ray(entering),
            };
        }
    }

    /// The row that leaves for the chosen variable `entering`; `careful`: close ratios are decided in twice
    /// the precision, if need be from fresh factors.
    fn blocking_row(&mut self, careful: bool, entering: usize) -> Option<usize> {
        let z0 = 2 * self.problem.size();
        for fresh in [false, true] {
            if !careful || (fresh && !self.tableau.refactorise(self.problem)) {
                break;
            }
            if fresh {
                self.refactorisations += 1;
                self.tableau.choose(entering);
            }
            let ties = self.tableau.ties(entering, CLOSE, CLOSE);
            if ties.len() <= 1 {
                return ties.first().copied();
            }
            let first = self.tableau.first_of_ties(self.problem, entering, z0, &ties);
            if first.is_some() {
                return first;
            }
        }
        self.tableau.blocking_row(entering, z0)
    }

    /// Refines the values, and refactorises where they have drifted; false if the basis is singular.
    fn check(&mut self, careful: bool, monitor: &mut Monitor<'_>) -> Result<bool, Stop> {
        monitor.affords(self.tableau.refinement_work())?;
        let drift = self.tableau.refine(self.problem);
        if drift <= DRIFT && self.rules.care == Refactorising::Usual && !careful {
            return Ok(true);
        }
        monitor.affords(self.tableau.refactorisation_work())?;
        self.refactorisations += 1;
        Ok(self.tableau.refactorise(self.problem))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::vector::largest_of;

    /// Both ways of keeping the tableau end at the one solution of a definite problem. `M = B Bᵀ / n + 1`
    /// has a condition number of about 10, so that rounding is far below 1e-10 of `z`.
    #[test]
    fn a_refactorised_tableau_follows_the_same_path() {
        // Fewer rows than the tableau keeps changes for, and more.
        for n in [40, 300] {
            let mut rng = fastrand::Rng::with_seed(n as u64);
            let mut random =
                |count: usize| -> Vec<f64> { (0..count).map(|_| 2.0 * rng.f64() - 1.0).collect() };
            let (b, q) = (random(n * n), random(n));
            let mut entries = vec![0.0; n * n];
            for (at, entry) in entries.iter_mut().enumerate() {
                let (i, j) = (at % n, at / n);
                let product: f64 = (0..n).map(|k| b[i + n * k] * b[j + n * k]).sum();
                *entry = product / n as f64 + if i == j { 1.0 } else { 0.0 };
            }
            let ones = vec![1.0; n];
            let matrix = Matrix::new(n, &entries, n);
            let lcp = ScaledLcp { matrix: &matrix, q: &q, covering: &ones, scale: &ones };
            let run = |care| {
                let settings = crate::settings::Settings::default();
                let monitor = &mut Monitor::new(&settings, None);
                let run = follow(lcp, LemkeRules::usual(care), monitor).expect("enough memory");
                assert_eq!(run.ending, Ending::Done);
                (run, monitor.iterations())
            };
            let ((usual, pivots), (thorough, same_pivots)) =
                (run(Refactorising::Usual), run(Refactorising::Thorough));
            assert_eq!(pivots, same_pivots);
            assert_eq!(usual.refactorisations, 0);
            assert!(thorough.refactorisations >= pivots / CHECK);
            let size = largest_of(usual.z.iter().copied());
            let apart = usual.z.iter().zip(&thorough.z).map(|(a, b)| a - b);
            assert!(largest_of(apart) <= 1e-10 * size);
            let w = matrix.product(&thorough.z);
            let least = w.iter().zip(&q).map(|(w, q)| w + q).fold(0.0, f64::min);
            assert!(least >= -1e-10, "w = {least}");
        }
    }
}
