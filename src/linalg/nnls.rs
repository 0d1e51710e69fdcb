//! Non-negative least squares (Lawson and Hanson, *Solving Least Squares Problems*, 1974, chapter 23).

use super::least_squares::Columns;
use super::vector::{dot, norm, opposite};
use super::watched::GoesOn;

/// Slopes above this part of what is left of the target would still lower the distance: ten times the rounding of one
/// sum, as the residual itself is a sum. No more left of the target than this part is nothing.
const SLOPE: f64 = 1e-13;

/// Steps, relative to the number of unknowns. Lawson and Hanson's program stops after 3; each step
/// lowers the distance, so that no set of columns comes twice, and ten leave room for ties.
const MOST_STEPS: usize = 10;

/// What columns with coefficients of no less than zero leave of a target.
pub enum Nearest {
    /// The least that they leave.
    Left(Vec<f64>),
    /// Nothing but rounding, with these coefficients, each with its column.
    Nothing(Vec<(usize, f64)>),
}

/// `target + sum x_j columns_j` of least length with `x >= 0`; `None` where `goes_on` says no.
pub fn nearest(target: &[f64], columns: &[Vec<f64>], goes_on: GoesOn<'_>) -> Option<Nearest> {
    let size = norm(target);
    let lengths: Vec<f64> = columns.iter().map(|column| norm(column)).collect();
    let mut active =
        Active { columns, which: Vec::new(), x: Vec::new(), basis: Columns::default() };
    let mut rest = target.to_vec();
    for _ in 0..MOST_STEPS * (target.len() + columns.len()) {
        let Some(entering) = steepest(&rest, (columns, &lengths), &active.which) else { break };
        if !goes_on() {
            return None;
        }
        active.enter(entering);
        // A column that depends on the active ones: its remaining slope is rounding.
        let Some(left) = active.descend(target) else { break };
        rest = left;
        if norm(&rest) <= SLOPE * size {
            return Some(Nearest::Nothing(active.which.into_iter().zip(active.x).collect()));
        }
    }
    Some(if size > 0.0 { Nearest::Left(rest) } else { Nearest::Nothing(Vec::new()) })
}

/// The column along which the length of `rest` falls fastest, if it falls by more than rounding.
fn steepest(
    rest: &[f64],
    (columns, lengths): (&[Vec<f64>], &[f64]),
    active: &[usize],
) -> Option<usize> {
    let least = SLOPE * norm(rest);
    let slopes = columns.iter().zip(lengths).map(|(column, length)| dot(column, rest) / length);
    slopes
        .enumerate()
        .filter(|(j, slope)| *slope < -least && !active.contains(j))
        .min_by(|(_, a), (_, b)| a.total_cmp(b))
        .map(|(j, _)| j)
}

/// The columns whose coefficients are not zero, in the order in which they have entered.
struct Active<'c> {
    columns: &'c [Vec<f64>],
    which: Vec<usize>,
    x: Vec<f64>,
    basis: Columns,
}

impl Active<'_> {
    fn enter(&mut self, column: usize) {
        self.which.push(column);
        self.x.push(0.0);
        self.basis.push(self.columns[column].clone(), SLOPE);
    }

    fn leave(&mut self, place: usize) {
        self.which.remove(place);
        self.x.remove(place);
        self.basis.truncate(place);
        let behind = self.which[place..].iter();
        behind.for_each(|&column| self.basis.push(self.columns[column].clone(), SLOPE));
    }

    /// Moves `x` to the least squares solution on the active columns, and returns what these leave; a column whose coefficient
    /// reaches zero on the way becomes inactive. `None`: the active columns are dependent.
    fn descend(&mut self, target: &[f64]) -> Option<Vec<f64>> {
        loop {
            let (wanted, rest) = self.shortest(target)?;
            let blocking = (0..self.x.len())
                .filter(|&k| wanted[k] <= 0.0)
                .map(|k| (self.x[k] / (self.x[k] - wanted[k]).max(f64::MIN_POSITIVE), k))
                .min_by(|a, b| a.0.total_cmp(&b.0));
            let Some((part, leaving)) = blocking else {
                self.x = wanted;
                return Some(rest);
            };
            for (x, wanted) in self.x.iter_mut().zip(&wanted) {
                *x += part * (wanted - *x);
            }
            self.leave(leaving);
        }
    }

    /// The `x` for which `target + sum x_j columns_j` is shortest, and that sum; `None` if the columns are dependent. By
    /// orthogonal directions: products of the columns with each other would lose half the digits of columns next to each
    /// other, and a sum of columns that nearly balances the target its direction.
    fn shortest(&self, target: &[f64]) -> Option<(Vec<f64>, Vec<f64>)> {
        let mut rest = opposite(target);
        let shares = self.basis.take_out(&mut rest);
        let independent = self.basis.are_independent();
        independent.then(|| (self.basis.coefficients(shares), opposite(&rest)))
    }
}
