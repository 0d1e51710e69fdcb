//! Non-negative least squares (Lawson and Hanson, *Solving Least Squares Problems*, 1974, chapter 23).

use super::least_squares::Columns;
use super::vector::{dot, opposite};

/// Slopes above this part of the length of the target would still lower the distance: ten times the
/// rounding of one sum, as the residual itself is a sum.
const SLOPE: f64 = 1e-13;

/// Steps, relative to the number of unknowns. Lawson and Hanson's program stops after 3; each step
/// lowers the distance, so that no set of columns comes twice, and ten leave room for ties.
const MOST_STEPS: usize = 10;

/// `target + sum x_j columns_j` of least length with `x >= 0`; `None` if that is zero up to rounding.
pub fn nearest(target: &[f64], columns: &[Vec<f64>]) -> Option<Vec<f64>> {
    let size = dot(target, target).sqrt();
    let mut active: Vec<usize> = Vec::new();
    let mut x: Vec<f64> = Vec::new();
    let mut rest = target.to_vec();
    for _ in 0..MOST_STEPS * (target.len() + columns.len()) {
        let Some(entering) = steepest(&rest, columns, &active, SLOPE * size) else { break };
        active.push(entering);
        x.push(0.0);
        // A column that depends on the active ones: its remaining slope is rounding.
        if descend(target, columns, &mut active, &mut x).is_none() {
            break;
        }
        rest = target.to_vec();
        for (&j, x) in active.iter().zip(&x) {
            rest.iter_mut().zip(&columns[j]).for_each(|(rest, column)| *rest += x * column);
        }
    }
    (dot(&rest, &rest).sqrt() > SLOPE * size).then_some(rest)
}

/// The column along which the length of `rest` falls fastest, if it falls faster than `least`.
fn steepest(rest: &[f64], columns: &[Vec<f64>], active: &[usize], least: f64) -> Option<usize> {
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
) -> Option<()> {
    loop {
        let wanted = shortest(target, columns, active)?;
        let blocking = (0..x.len())
            .filter(|&k| wanted[k] <= 0.0)
            .map(|k| (x[k] / (x[k] - wanted[k]).max(f64::MIN_POSITIVE), k))
            .min_by(|a, b| a.0.total_cmp(&b.0));
        let Some((part, leaving)) = blocking else {
            *x = wanted;
            return Some(());
        };
        for (x, wanted) in x.iter_mut().zip(&wanted) {
            *x += part * (wanted - *x);
        }
        active.remove(leaving);
        x.remove(leaving);
    }
}

/// The `x` for which `target + sum x_j columns_j` is shortest; `None` if the columns are dependent. By orthogonal
/// directions: products of the columns with each other would lose half the digits of columns next to each other.
fn shortest(target: &[f64], columns: &[Vec<f64>], active: &[usize]) -> Option<Vec<f64>> {
    let basis = Columns::new(active.iter().map(|&j| columns[j].clone()), SLOPE);
    basis.are_independent().then(|| basis.coefficients(basis.take_out(&mut opposite(target))))
}
