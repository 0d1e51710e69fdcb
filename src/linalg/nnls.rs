//! Non-negative least squares (Lawson and Hanson, *Solving Least Squares Problems*, 1974, chapter 23).

use super::least_squares::Columns;
use super::vector::{dot, norm, opposite};

/// Slopes above this part of what is left of the target would still lower the distance: ten times the rounding of one
/// sum, as the residual itself is a sum. No more left of the target than this part is nothing.
const SLOPE: f64 = 1e-13;

/// Steps, relative to the number of unknowns. Lawson and Hanson's program stops after 3; each step
/// lowers the distance, so that no set of columns comes twice, and ten leave room for ties.
const MOST_STEPS: usize = 10;

/// `target + sum x_j columns_j` of least length with `x >= 0`; `None` if that is zero up to rounding.
pub fn nearest(target: &[f64], columns: &[Vec<f64>]) -> Option<Vec<f64>> {
    let size = norm(target);
    let mut active: Vec<usize> = Vec::new();
    let mut x: Vec<f64> = Vec::new();
    let mut rest = target.to_vec();
    for _ in 0..MOST_STEPS * (target.len() + columns.len()) {
        let Some(entering) = steepest(&rest, columns, &active) else { break };
        active.push(entering);
        x.push(0.0);
        // A column that depends on the active ones: its remaining slope is rounding.
        let Some(left) = descend(target, columns, &mut active, &mut x) else { break };
        rest = left;
        if norm(&rest) <= SLOPE * size {
            return None;
        }
    }
    (size > 0.0).then_some(rest)
}

/// The column along which the length of `rest` falls fastest, if it falls by more than rounding.
fn steepest(rest: &[f64], columns: &[Vec<f64>], active: &[usize]) -> Option<usize> {
    let least = SLOPE * norm(rest);
    (0..columns.len())
        .filter(|j| !active.contains(j))
        .map(|j| (dot(&columns[j], rest) / dot(&columns[j], &columns[j]).sqrt(), j))
        .filter(|(slope, _)| *slope < -least)
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, j)| j)
}

/// Moves `x` to the least squares solution on the active columns; a column whose coefficient reaches
/// zero on the way becomes inactive. `None`: the active columns are dependent.
fn descend(
    target: &[f64],
    columns: &[Vec<f64>],
    active: &mut Vec<usize>,
    x: &mut Vec<f64>,
) -> Option<Vec<f64>> {
    loop {
        let (wanted, rest) = shortest(target, columns, active)?;
        let blocking = (0..x.len())
            .filter(|&k| wanted[k] <= 0.0)
            .map(|k| (x[k] / (x[k] - wanted[k]).max(f64::MIN_POSITIVE), k))
            .min_by(|a, b| a.0.total_cmp(&b.0));
        let Some((part, leaving)) = blocking else {
            *x = wanted;
            return Some(rest);
        };
        for (x, wanted) in x.iter_mut().zip(&wanted) {
            *x += part * (wanted - *x);
        }
        active.remove(leaving);
        x.remove(leaving);
    }
}

/// The `x` for which `target + sum x_j columns_j` is shortest, and that sum; `None` if the columns are dependent. By
/// orthogonal directions: products of the columns with each other would lose half the digits of columns next to each
/// other, and a sum of columns that nearly balances the target its direction.
fn shortest(
    target: &[f64],
    columns: &[Vec<f64>],
    active: &[usize],
) -> Option<(Vec<f64>, Vec<f64>)> {
    let basis = Columns::new(active.iter().map(|&j| columns[j].clone()), SLOPE);
    let mut rest = opposite(target);
    let shares = basis.take_out(&mut rest);
    basis.are_independent().then(|| (basis.coefficients(shares), opposite(&rest)))
}
