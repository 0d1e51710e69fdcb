//! All solutions of a small 2D problem in twice the precision: in each state of all pairs the law is a
//! square linear system and some inequalities.

use super::exact::{differ, force, parts, quads};
use super::problems::Case;
use super::quad::{Quad, solve};

/// A state's inequality holds if it is missed by no more than this part of the sums that it comes from:
/// what 30 digits leave after a system of condition number 1e10.
const FEASIBLE: f64 = 1e-20;

/// Forces obey an inequality for certain if they miss it by no more than this part: elimination leaves so much in the
/// equations, whatever the condition number.
const CERTAIN: f64 = 1e-26;

/// Most pairs: 4 states each under Coulomb's law, 6 under Tresca's.
pub const MOST_PAIRS: usize = 4;

#[derive(Clone, Copy)]
struct Local {
    closed: bool,
    /// The sign of the slip; `None` sticks, 0 where nothing resists.
    slip: Option<f64>,
}

/// Solutions that differ from each other, and whether some state's system is singular: then there may
/// be others.
pub struct AllSolutions {
    pub solutions: Vec<Vec<Quad>>,
    pub singular: bool,
}

pub fn all_solutions(case: &Case) -> AllSolutions {
    assert!(case.dim == 2 && case.pairs <= MOST_PAIRS);
    let options: Vec<Vec<Local>> = (0..case.pairs).map(|pair| options(case, pair)).collect();
    let mut all = AllSolutions { solutions: Vec::new(), singular: false };
    let mut choice = vec![0; case.pairs];
    loop {
        let local: Vec<Local> = options.iter().zip(&choice).map(|(o, &c)| o[c]).collect();
        match candidate(case, &local) {
            None => all.singular = true,
            Some(d) => {
                let new = || all.solutions.iter().all(|other| differ(case, other, &d));
                // Soft springs may need a tension that digits of displacements do not show: then there may be one more.
                if obeys(case, &local, &d, CERTAIN) && new() {
                    all.solutions.push(d);
                } else if obeys(case, &local, &d, FEASIBLE) && new() {
                    all.singular = true;
                }
            }
        }
        let Some(pair) = (0..case.pairs).find(|&p| choice[p] + 1 < options[p].len()) else {
            return all;
        };
        choice[pair] += 1;
        choice[..pair].fill(0);
    }
}

fn options(case: &Case, pair: usize) -> Vec<Local> {
    let [slope, offset, _] = case.law.of(pair);
    let slips = match (slope, offset) {
        (0.0, 0.0) => vec![Some(0.0)],
        _ => vec![None, Some(1.0), Some(-1.0)],
    };
    let local = |closed: bool| move |&slip: &Option<f64>| Local { closed, slip };
    let mut options = Vec::new();
    if open_bound(case, pair) != Quad::ZERO {
        options.extend(slips.iter().map(local(false)));
    } else {
        options.push(Local { closed: false, slip: Some(0.0) });
    }
    if case.gap[pair].is_finite() {
        options.extend(slips.iter().map(local(true)));
    }
    options
}

/// The bound on the tangential force of an open pair, `b - mu a`.
fn open_bound(case: &Case, pair: usize) -> Quad {
    let [slope, offset, tension] = case.law.of(pair);
    Quad::from(offset) - Quad::from(tension) * slope
}

/// Displacements that solve the equations of a state.
fn candidate(case: &Case, local: &[Local]) -> Option<Vec<Quad>> {
    let n = case.size();
    let row = |i: usize| -> Vec<Quad> {
        quads(&(0..n).map(|j| case.stiffness(i, j)).collect::<Vec<_>>())
    };
    let unit = |i: usize| -> Vec<Quad> {
        (0..n).map(|j| if i == j { Quad::ONE } else { Quad::ZERO }).collect()
    };
    let (mut matrix, mut rhs) = (Vec::new(), Vec::new());
    for (pair, now) in local.iter().enumerate() {
        let (i, t) = (2 * pair, 2 * pair + 1);
        let (normal, load) = (row(i), Quad::from(case.f[i]));
        if now.closed {
            matrix.push(unit(i));
            rhs.push(Quad::from(case.gap[pair]));
        } else {
            matrix.push(normal.clone());
            rhs.push(load + Quad::from(case.law.of(pair)[2]));
        }
        let Some(side) = now.slip else {
            matrix.push(unit(t));
            rhs.push(Quad::from(case.rest(pair, 0)));
            continue;
        };
        // Against the slip: F_t = side (mu F_n - b), of an open pair with F_n = a.
        let [slope, offset, _] = case.law.of(pair);
        let (slope, offset) = (side * slope, side * offset);
        matrix.push(row(t).iter().zip(&normal).map(|(&k_t, &k_n)| k_t - k_n * slope).collect());
        rhs.push(Quad::from(case.f[t]) - load * slope - Quad::from(offset));
    }
    solve(matrix, rhs)
}

/// `true` if the inequalities of a state hold, those of forces up to a part `of_forces`.
fn obeys(case: &Case, local: &[Local], d: &[Quad], of_forces: f64) -> bool {
    let (force, parts) = (force(case, d), parts(case, d));
    local.iter().enumerate().all(|(pair, now)| {
        let (i, t) = (2 * pair, 2 * pair + 1);
        let positive = |value: Quad, size: f64| value.value() >= -FEASIBLE * size;
        let admissible = |value: Quad, size: f64| value.value() >= -of_forces * size;
        let gap = case.gap[pair];
        let normal = match now.closed {
            true => {
                let tension = Quad::from(case.law.of(pair)[2]);
                admissible(tension - force[i], parts[i] + tension.value())
            }
            false if gap.is_finite() => {
                positive(Quad::from(gap) - d[i], d[i].value().abs().max(gap.abs()))
            }
            false => true,
        };
        let rest = case.rest(pair, 0);
        let tangential = match now.slip {
            None => {
                let [slope, offset, _] = case.law.of(pair);
                let bound = match now.closed {
                    true => Quad::from(offset) - force[i] * slope,
                    false => open_bound(case, pair),
                };
                let size = parts[t] + bound.value().abs() + offset;
                admissible(bound - force[t].abs(), size)
            }
            Some(0.0) => true,
            Some(side) => {
                positive((d[t] - Quad::from(rest)) * side, d[t].value().abs().max(rest.abs()))
            }
        };
        normal && tangential
    })
}
