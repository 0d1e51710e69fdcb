//! Statics of a rigid body on feet with friction, decided by non-negative least squares of the tests'
//! own.

use super::brick::{Vector, cross};
use super::dense::{dot, norm};

/// The answer of rigid statics to loads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Statics {
    /// Forces of the feet balance the loads.
    Balanced,
    /// None do.
    Driven,
    /// The loads are between a polygon in the circle of friction and one around it, or as near to the
    /// limit as rounding.
    Undecided,
}

/// Edges of a polygon in the place of the circle.
const EDGES: usize = 48;

/// The rest of the loads that no forces balance, relative to them: below the first it is the rounding of the
/// sums, above the second it is not.
const ROUNDING: f64 = 1e-12;
const CLEAR: f64 = 1e-8;

/// Decides whether forces at `feet`, against the outward `normal` and with friction, balance the forces
/// `loads` at places. In the plane all third components are zero.
pub fn statics(
    dim: usize,
    feet: &[Vector],
    normal: Vector,
    mu: f64,
    loads: &[(Vector, Vector)],
) -> Statics {
    let centre: Vector =
        std::array::from_fn(|i| feet.iter().map(|foot| foot[i]).sum::<f64>() / feet.len() as f64);
    let arm = |place: Vector| -> Vector { std::array::from_fn(|i| place[i] - centre[i]) };
    let length = feet.iter().map(|&foot| norm(&arm(foot))).fold(0.0, f64::max);
    let wrench = |place: Vector, force: Vector| -> Vec<f64> {
        let moment = cross(arm(place), force).map(|m| m / length);
        match dim {
            2 => vec![force[0], force[1], moment[2]],
            _ => [force, moment].concat(),
        }
    };
    let mut target = vec![0.0; if dim == 2 { 3 } else { 6 }];
    let mut size = 0.0;
    for &(place, force) in loads {
        let wrench = wrench(place, force);
        size += norm(&wrench);
        target.iter_mut().zip(&wrench).for_each(|(sum, part)| *sum += part);
    }
    target.iter_mut().for_each(|sum| *sum /= size);
    let rest = |mu: f64| {
        let edges = edges(dim, normal, mu);
        let columns: Vec<Vec<f64>> = feet
            .iter()
            .flat_map(|&foot| edges.iter().map(move |&edge| (foot, edge)))
            .map(|(foot, edge)| wrench(foot, edge))
            .collect();
        distance(&target, &columns)
    };
    let around = if dim == 2 { 1.0 } else { (std::f64::consts::PI / EDGES as f64).cos().recip() };
    match (rest(mu), rest(mu * around)) {
        (inner, _) if inner <= ROUNDING => Statics::Balanced,
        (_, outer) if outer >= CLEAR => Statics::Driven,
        _ => Statics::Undecided,
    }
}

/// The edges of a cone of forces on the body.
pub fn edges(dim: usize, normal: Vector, mu: f64) -> Vec<Vector> {
    let up = normal.map(|n| -n);
    if mu == 0.0 {
        return vec![up];
    }
    let along = |direction: Vector| std::array::from_fn(|i| up[i] + mu * direction[i]);
    if dim == 2 {
        let tangent = [-normal[1], normal[0], 0.0];
        return vec![along(tangent), along(tangent.map(|t| -t))];
    }
    let least = (0..3).min_by(|&a, &b| normal[a].abs().total_cmp(&normal[b].abs())).unwrap();
    let mut axis = [0.0; 3];
    axis[least] = 1.0;
    let one = cross(normal, axis);
    let size = norm(&one);
    let one = one.map(|t| t / size);
    let two = cross(normal, one);
    let direction = |k: usize| {
        let (sin, cos) = (std::f64::consts::TAU * k as f64 / EDGES as f64).sin_cos();
        std::array::from_fn(|i| cos * one[i] + sin * two[i])
    };
    (0..EDGES).map(|k| along(direction(k))).collect()
}

/// Distance of `-target` from the cone of the columns (Lawson and Hanson's non-negative least squares, the
/// active columns solved by an orthogonal basis).
pub fn distance(target: &[f64], columns: &[Vec<f64>]) -> f64 {
    let mut active: Vec<usize> = Vec::new();
    let mut x: Vec<f64> = Vec::new();
    let mut rest = target.to_vec();
    for _ in 0..100 * columns.len() {
        let slope = |j: usize| dot(&columns[j], &rest) / norm(&columns[j]);
        let entering = (0..columns.len())
            .filter(|j| !active.contains(j))
            .min_by(|&a, &b| slope(a).total_cmp(&slope(b)));
        let Some(entering) = entering.filter(|&j| slope(j) < -1e-14) else { break };
        active.push(entering);
        x.push(0.0);
        loop {
            let Some(wanted) = least_squares(target, columns, &active) else {
                active.pop();
                return norm(&rest);
            };
            let blocking = (0..x.len())
                .filter(|&k| wanted[k] <= 0.0)
                .map(|k| (x[k] / (x[k] - wanted[k]).max(f64::MIN_POSITIVE), k))
                .min_by(|a, b| a.0.total_cmp(&b.0));
            let Some((part, leaving)) = blocking else {
                x = wanted;
                break;
            };
            x.iter_mut().zip(&wanted).for_each(|(x, wanted)| *x += part * (wanted - *x));
            active.remove(leaving);
            x.remove(leaving);
        }
        rest = target.to_vec();
        for (&j, x) in active.iter().zip(&x) {
            rest.iter_mut().zip(&columns[j]).for_each(|(rest, part)| *rest += x * part);
        }
    }
    norm(&rest)
}

/// The `x` for which `target + sum x_j columns_j` is shortest; `None`: the columns are dependent.
fn least_squares(target: &[f64], columns: &[Vec<f64>], active: &[usize]) -> Option<Vec<f64>> {
    let (mut basis, mut upper): (Vec<Vec<f64>>, Vec<Vec<f64>>) = (Vec::new(), Vec::new());
    for &j in active {
        let mut v = columns[j].clone();
        let mut shares = vec![0.0; basis.len()];
        for _ in 0..2 {
            for (share, unit) in shares.iter_mut().zip(&basis) {
                let part = dot(unit, &v);
                *share += part;
                v.iter_mut().zip(unit).for_each(|(v, unit)| *v -= part * unit);
            }
        }
        let size = norm(&v);
        if size <= 1e-12 * norm(&columns[j]) {
            return None;
        }
        v.iter_mut().for_each(|v| *v /= size);
        basis.push(v);
        shares.push(size);
        upper.push(shares);
    }
    let mut x: Vec<f64> = basis.iter().map(|unit| -dot(unit, target)).collect();
    for k in (0..x.len()).rev() {
        x[k] /= upper[k][k];
        for i in 0..k {
            x[i] -= upper[k][i] * x[k];
        }
    }
    Some(x)
}
