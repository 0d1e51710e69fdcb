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
//! have drifted, the tableau is computed anew from its basis. A caller whose certificate finds the
//! end of a path inaccurate repeats it with [`Care::Thorough`].

use super::tableau::{Scaled, Tableau};
use crate::error::Error;
use crate::lcp::Lcp;
use crate::monitor::{Monitor, Stop};

/// How a run of Lemke's method ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Path {
    /// Reached `z0 = 0`: a solution up to rounding.
    Solution,
    /// Nothing blocks: the direction of `z` in which the path goes on for ever.
    Ray(Vec<f64>),
    /// Rounding made the basis singular.
    Breakdown,
    /// A budget ended it, or the caller.
    Interrupted(Stop),
}

/// Result of a run.
#[derive(Clone, Debug)]
pub struct Run {
    /// `z`, non-negative; of an interrupted run that of the last basis.
    pub z: Vec<f64>,
    /// How it ended.
    pub path: Path,
    /// Where the path turned, `z0` growing again: the first of such points.
    pub turns: Vec<Vec<f64>>,
    /// How often accuracy was lost and restored.
    pub refactorisations: u64,
}

impl Run {
    /// A run that could not begin.
    pub fn broken(size: usize) -> Self {
        Run { z: vec![0.0; size], path: Path::Breakdown, turns: Vec::new(), refactorisations: 0 }
    }
}

/// Pivots between two checks of the values against the data: the check costs about one pivot.
const CHECK: u64 = 32;

/// Residual, relative to `q`, from which on the tableau is computed anew.
const DRIFT: f64 = 1e-10;

/// When the tableau is computed anew.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Care {
    /// When its values have drifted.
    Usual,
    /// At every check.
    Thorough,
}

/// How a path is followed.
#[derive(Clone, Copy, Debug)]
pub struct Rules {
    /// When the tableau is computed anew.
    pub care: Care,
    /// The path is at its end when `z0` has fallen to this part of its start: beyond it rounding
    /// decides between the end and a false ray.
    pub end: f64,
    /// Most turning points to be kept.
    pub turns: usize,
}

impl Rules {
    /// For problems in which a ray proves something.
    pub fn usual(care: Care) -> Self {
        Rules { care, end: 1e-13, turns: 0 }
    }
}

/// Follows the path of `lcp` in the variables `z_i / scale_i`, `w_i * scale_i`.
pub fn lemke(
    lcp: &Lcp<'_>,
    scale: &[f64],
    rules: Rules,
    monitor: &mut Monitor<'_>,
) -> Result<Run, Error> {
    let n = lcp.size();
    // Of size one, as the rest of the scaled problem.
    let covering: Vec<f64> = (0..n).map(|i| lcp.covering(i) * scale[i]).collect();
    let unit = covering.iter().fold(0.0_f64, |most, d| most.max(*d)).log2().round().exp2();
    let columns = (0..n).flat_map(|j| {
        lcp.column(j).iter().zip(scale).map(move |(m, row_scale)| row_scale * m * scale[j])
    });
    let problem = Scaled {
        size: n,
        matrix: columns.collect(),
        q: lcp.q().iter().zip(scale).map(|(q, scale)| q * scale).collect(),
        covering: covering.iter().map(|d| d / unit).collect(),
    };
    let unscaled = |scaled: &mut dyn Iterator<Item = f64>| -> Vec<f64> {
        scaled.zip(scale).map(|(z, scale)| z.max(0.0) * scale).collect()
    };
    let mut tableau = Tableau::new(&problem)?;
    let mut turns = Vec::new();
    let (path, refactorisations) = follow(&problem, &mut tableau, rules, &mut turns, monitor);
    let path = match path {
        Inner::Ray(entering) => {
            Path::Ray(unscaled(&mut (n..2 * n).map(|z| tableau.rate(z, entering))))
        }
        Inner::Ended(path) => path,
    };
    let turns = turns.iter().map(|z| unscaled(&mut z.iter().copied())).collect();
    let z = unscaled(&mut (n..2 * n).map(|z| tableau.value(z)));
    Ok(Run { z, path, turns, refactorisations })
}

enum Inner {
    Ended(Path),
    Ray(usize),
}

fn follow(
    problem: &Scaled,
    tableau: &mut Tableau,
    rules: Rules,
    turns: &mut Vec<Vec<f64>>,
    monitor: &mut Monitor<'_>,
) -> (Inner, u64) {
    let n = problem.size;
    let z0 = 2 * n;
    let mut refactorisations = 0;
    let Some(mut row) = tableau.first_row() else {
        return (Inner::Ended(Path::Solution), 0);
    };
    let mut entering = z0;
    tableau.choose(entering);
    let mut start = None;
    for pivots in 1.. {
        if let Err(reason) = monitor.step() {
            return (Inner::Ended(Path::Interrupted(reason)), refactorisations);
        }
        let leaving = tableau.basic(row);
        tableau.pivot(row, entering);
        let ended = leaving == z0 || tableau.value(z0) <= rules.end * start.unwrap_or(0.0);
        if ended || pivots % CHECK == 0 {
            let drift = tableau.refine(problem);
            if drift > DRIFT || rules.care == Care::Thorough {
                if !tableau.refactorise(problem) {
                    return (Inner::Ended(Path::Breakdown), refactorisations);
                }
                refactorisations += 1;
            }
        }
        if ended {
            return (Inner::Ended(Path::Solution), refactorisations);
        }
        start.get_or_insert(tableau.value(z0));
        entering = if leaving < n { leaving + n } else { leaving - n };
        tableau.choose(entering);
        if turns.len() < rules.turns && tableau.rate(z0, entering) > 0.0 {
            turns.push((n..2 * n).map(|z| tableau.value(z)).collect());
        }
        row = match tableau.blocking_row(entering, z0) {
            Some(row) => row,
            None => return (Inner::Ray(entering), refactorisations),
        };
    }
    unreachable!("the loop has no other end")
}
