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
//! have drifted, the tableau is refactorised. Rounding may also break a tie the wrong way, and then the path may
//! cycle. So a path is followed thoroughly where that is cheap beside it, after as many pivots as there are equations
//! of a small problem, and from its start where the certificate of a caller finds its end inaccurate: a tableau that is
//! refactorised after a few pivots has lost less than what ties are told by.

use super::scaled::Scaled;
use super::tableau::Tableau;
use crate::error::Error;
use crate::linalg::tolerances::{NEGLIGIBLE, ROUNDING};
use crate::monitor::Watch;
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

/// Pivots between two checks of the values against the data: the check costs about one pivot.
const CHECK: u64 = 32;

/// Residual, relative to `q`, from which on the tableau is refactorised: ten times what a check's own
/// refinement can mend.
const DRIFT: f64 = 10.0 * NEGLIGIBLE;

/// Up to so many equations a path is followed thoroughly from the `n`-th pivot on: to refactorise the tableau takes a
/// tenth of a millisecond here.
const FEW: usize = 64;

/// How a path is followed.
#[derive(Clone, Copy, Debug)]
pub struct LemkeRules {
    /// True if the tableau is refactorised at every check, and there are twice as many.
    pub thorough: bool,
    /// The path is at its end when `z0` has fallen to this part of its start: beyond it rounding
    /// decides between the end and a false ray.
    pub end: f64,
    /// Most turning points to be kept.
    pub turns: usize,
    /// The path of [`super::bimatrix`] that lacks this label.
    pub label: Option<usize>,
}

impl LemkeRules {
    /// For problems in which a ray proves something: at its end ten times the rounding of the last pivots is forgiven.
    pub fn usual(thorough: bool) -> Self {
        LemkeRules { thorough, end: 10.0 * ROUNDING, turns: 0, label: None }
    }
}

/// Follows the path of `problem`.
pub fn follow(
    problem: &Scaled<'_>,
    rules: LemkeRules,
    monitor: &dyn Watch,
) -> Result<LemkeRun, Error> {
    let n = problem.size();
    let tableau = match Tableau::new(problem, monitor) {
        Ok(tableau) => tableau,
        Err(Ending::Failed(error)) => return Err(error),
        Err(ending) => {
            let (z, turns) = (vec![0.0; n], Vec::new());
            return Ok(LemkeRun { z, ending, turns, refactorisations: 0 });
        }
    };
    let mut path =
        Path { problem, tableau, rules, monitor, turns: Vec::new(), refactorisations: 0 };
    let ending = path.run().unwrap_or_else(|ending| ending);
    let turns = path.turns.iter().map(|z| problem.unscaled(z.iter().copied())).collect();
    let z = problem.unscaled((n..2 * n).map(|z| path.tableau.value(z)));
    Ok(LemkeRun { z, ending, turns, refactorisations: path.refactorisations })
}

/// A path that is being followed.
struct Path<'p> {
    problem: &'p Scaled<'p>,
    tableau: Tableau,
    rules: LemkeRules,
    monitor: &'p dyn Watch,
    turns: Vec<Vec<f64>>,
    refactorisations: u64,
}

impl Path<'_> {
    /// Follows the path to its end; `Err`: it ends where something failed.
    fn run(&mut self) -> Result<Ending, Ending> {
        let n = self.problem.size();
        let z0 = 2 * n;
        // The path ends when one of these leaves.
        let last = self.rules.label.map_or([z0, z0], |label| [label, n + label]);
        let Some((mut row, mut entering)) = self.first_exchange() else { return Ok(Ending::Done) };
        let (mut start, mut pivots) = (None, 0);
        loop {
            let work = self.tableau.pivot_work();
            self.monitor.step().and_then(|()| self.monitor.affords(work))?;
            pivots += 1;
            let leaving = self.tableau.basic[row];
            self.tableau.pivot(row, entering);
            let falls_to_end = |start: f64| self.tableau.value(z0) <= self.rules.end * start;
            let ended = last.contains(&leaving) || start.is_some_and(falls_to_end);
            let thorough = self.rules.thorough || (n <= FEW && pivots > n as u64);
            let interval = if thorough { CHECK / 2 } else { CHECK };
            if ended || pivots % interval == 0 {
                self.check(thorough)?;
            }
            if ended {
                return Ok(Ending::Done);
            }
            if self.rules.label.is_none() {
                start.get_or_insert(self.tableau.value(z0));
            }
            // `z_i` of `w_i`, and `w_i` of `z_i`.
            entering = if leaving < n { leaving + n } else { leaving - n };
            self.tableau.choose(entering);
            if self.turns.len() < self.rules.turns && self.tableau.rate(z0, entering) > 0.0 {
                self.turns.push((n..z0).map(|z| self.tableau.value(z)).collect());
            }
            let Some(next) = self.tableau.blocking_row(entering, last) else {
                let rates = (n..z0).map(|z| self.tableau.rate(z, entering));
                return Ok(Ending::Recession(self.problem.unscaled_ray(rates)));
            };
            row = next;
        }
    }

    /// The row that leaves and the variable that enters at the start of the path; `None` if that is a solution.
    fn first_exchange(&mut self) -> Option<(usize, usize)> {
        let n = self.problem.size();
        let mut entering = 2 * n;
        if let Some(label) = self.rules.label {
            self.tableau.choose(n + label);
            let row = self.tableau.last_to_rise()?;
            self.tableau.pivot(row, n + label);
            entering = n + row;
        }
        self.tableau.choose(entering);
        Some((self.tableau.last_to_rise()?, entering))
    }

    /// Refines the values, and refactorises where they have drifted, or always.
    fn check(&mut self, always: bool) -> Result<(), Ending> {
        self.monitor.affords(self.tableau.refinement_work())?;
        let drift = self.tableau.refine(self.problem);
        self.monitor.goes_on()?;
        if drift <= DRIFT && !always {
            return Ok(());
        }
        self.monitor.affords(self.tableau.refactorisation_work())?;
        self.refactorisations += 1;
        let done = self.tableau.refactorise(self.problem, &mut self.monitor.asking());
        done.ok_or_else(|| self.monitor.stop().map_or(BREAKDOWN, Ending::Stopped))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::matrix::Matrix;
    use crate::linalg::vector::largest_of;
    use crate::monitor::Monitor;

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
            let fill = |j: usize, column: &mut [f64]| column.copy_from_slice(matrix.column(j));
            let lcp = Scaled::new(fill, &q, &ones, ones.clone());
            let run = |thorough| {
                let settings = crate::settings::Settings::default();
                let monitor = &mut Monitor::new(&settings, None);
                let run =
                    follow(&lcp, LemkeRules::usual(thorough), monitor).expect("enough memory");
                assert_eq!(run.ending, Ending::Done);
                (run, monitor.iterations())
            };
            let ((usual, pivots), (thorough, same_pivots)) = (run(false), run(true));
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
