//! Measures of an answer, computed here from the data and the formulas, not by the library.

use nalgebra::DMatrix;
use signorini::Solution;

use super::dense::{difference, dot, norm, product};
use super::problems::{Case, Law};

/// The motion that proves that there is no equilibrium.
pub fn motion(solution: &Solution) -> &[f64] {
    solution.recession.as_deref().expect("a proof of no equilibrium has its motion")
}

/// `K d - f`.
pub fn force(case: &Case, d: &[f64]) -> Vec<f64> {
    difference(&product(&case.k, d), &case.f)
}

/// `|e| / max(|f|, |F|)` of the natural map that the documentation of `certificate` defines,
///
/// `e_n = K_nn (d_n - min(gap, d_n - F_n / K_nn))`,
/// `e_t = K_tt (delta - shrink(delta - F_t / K_tt, g / K_tt))`, `g = mu max(0, -F_n)` or given; with
/// cohesion `F_n - a` for `F_n` in `e_n`, and `g = mu max(-a, -F_n) + b`;
///
/// case by case, so that displacements do not hide the forces in their rounding. Where `K_nn (d_n - gap) <= F_n - a < 0`
/// the part of `F_t` beyond `g(a)` stands for `e_t`, if it is longer.
pub fn eta(case: &Case, d: &[f64]) -> f64 {
    let force = force(case, d);
    let mut residual = Vec::new();
    for pair in 0..case.pairs {
        let i = case.dim * pair;
        // d_n - gap or F_n / K_nn, whichever is larger.
        residual.push(
            (case.stiffness(i, i) * (d[i] - case.gap[pair])).max(force[i] - case.law.of(pair)[2]),
        );
        let k_t = tangential_stiffness(case, pair);
        let delta: Vec<f64> = (1..case.dim).map(|c| d[i + c] - case.rest(pair, c - 1)).collect();
        let trial: Vec<f64> = (1..case.dim).map(|c| k_t * delta[c - 1] - force[i + c]).collect();
        let (bound, length) = (case.bound(pair, force[i]), norm(&trial));
        let mut along: Vec<f64> = (0..case.dim - 1)
            .map(|c| match length > bound {
                true => force[i + 1 + c] + bound * (trial[c] / length),
                false => k_t * delta[c],
            })
            .collect();
        let (tension, friction) = (case.law.of(pair)[2], &force[i + 1..i + case.dim]);
        let (size, carried) = (norm(friction), case.bound(pair, tension));
        let apart = case.stiffness(i, i) * (d[i] - case.gap[pair]) <= force[i] - tension;
        if apart && force[i] < tension && size - carried > norm(&along) {
            along = friction.iter().map(|f| f * (1.0 - carried / size)).collect();
        }
        residual.extend(along);
    }
    let scale = norm(&case.f).max(norm(&force));
    if norm(&residual) == 0.0 { 0.0 } else { norm(&residual) / scale }
}

/// Bound on the rounding of `K d`, relative as `eta` is: how far two computations of `eta` may be
/// apart (`n` units each, half an epsilon), and what the library leaves out of account (16 units).
/// Without loads, forces are zero or come from gaps and previous slip, whose rounding then counts.
pub fn rounding(case: &Case, d: &[f64]) -> f64 {
    let absolute: Vec<f64> = case.k.iter().map(|k| k.abs()).collect();
    let unloaded = case.f.iter().all(|&f| f == 0.0);
    let size: Vec<f64> = (0..case.size())
        .map(|i| {
            let prescribed = match i % case.dim {
                0 => case.gap[i / case.dim],
                c => case.rest(i / case.dim, c - 1),
            };
            d[i].abs().max(if unloaded && prescribed.is_finite() { prescribed.abs() } else { 0.0 })
        })
        .collect();
    let parts = norm(&product(&absolute, &size)) + norm(&case.f);
    let scale = norm(&case.f).max(norm(&force(case, d)));
    let units = 2.0 * case.size() as f64 + 16.0;
    if parts == 0.0 { 0.0 } else { units * f64::EPSILON / 2.0 * parts / scale }
}

/// `K_tt` of a pair, in 3D the largest eigenvalue of its tangential block.
pub fn tangential_stiffness(case: &Case, pair: usize) -> f64 {
    let i = case.dim * pair + 1;
    let a = case.stiffness(i, i);
    if case.dim == 2 {
        return a;
    }
    let (b, c) = (case.stiffness(i, i + 1), case.stiffness(i + 1, i + 1));
    (a + c) / 2.0 + ((a - c) / 2.0).hypot(b)
}

/// Why `r` does not prove that there is no equilibrium, if it does not.
///
/// It does if it strains nothing, `K r = 0`; if contact forces can only do non-negative work on
/// it, `-r_n >= mu |r_t|` where there is an obstacle (given thresholds: `r_n <= 0`, and they do at
/// least `-sum g |r_t|`; with cohesion `F_n <= a` and `|F_t| <= mu (a - F_n) + b - mu a`, so at least
/// `sum a r_n - (b - mu a) |r_t|`); and if the loads drive it. Then `F . r = -f . r` is impossible.
///
/// Zero is anything below 1e-10 of the strain's parts: far above rounding (1e-15), far below the
/// least stiffness in the tests (1e-6 of the largest). Work counts from 1e-12 of what the loads
/// could do on a motion of that size.
pub fn flaw_of_escape(case: &Case, r: &[f64]) -> Option<String> {
    const ZERO: f64 = 1e-10;
    let n = case.size();
    let root: Vec<f64> = (0..n).map(|i| case.stiffness(i, i).sqrt()).collect();
    let size = (0..n).fold(0.0, |most: f64, i| most.max(root[i] * r[i].abs()));
    if !(size > 0.0) {
        return Some("it is zero".into());
    }
    let strain = product(&case.k, r);
    if let Some(i) = (0..n).find(|&i| strain[i].abs() > ZERO * root[i] * size) {
        return Some(format!("it strains: (K r)[{i}] = {}", strain[i]));
    }
    let (mut resisted, mut pulled) = (0.0, 0.0);
    for pair in 0..case.pairs {
        let i = case.dim * pair;
        let slide = norm(&r[i + 1..i + case.dim]);
        if matches!(case.law.own(pair), Law::Tied) {
            if case.gap[pair].is_finite() && r[i].hypot(slide) * root[i] > ZERO * size {
                return Some(format!("it moves the tie {pair}"));
            }
            continue;
        }
        let [mu, b, a] = case.law.of(pair);
        let lift = mu * slide;
        resisted += (b - mu * a) * slide - a * r[i];
        pulled += size * a / root[i];
        if case.gap[pair].is_finite() && (r[i] + lift) * root[i] > ZERO * size {
            return Some(format!("contact can stop it at pair {pair}"));
        }
    }
    let work = dot(&case.f, r);
    let parts: f64 = size * (0..n).map(|i| case.f[i].abs() / root[i]).sum::<f64>() + pulled;
    let driven = work - resisted > 1e-12 * parts;
    (!driven).then(|| format!("the loads do not drive it: {work} against {resisted}"))
}

/// The coefficient of friction below which theory proves one solution in 3D: there the map of
/// thresholds contracts, `mu (|K_nn| |(K⁻¹)_tt|)^½ < 1` in the spectral norm.
pub fn most_with_one_solution(case: &Case) -> f64 {
    let (n, pairs) = (case.size(), case.pairs);
    let k = DMatrix::from_column_slice(n, n, &case.k);
    let w = k.clone().cholesky().expect("the stiffness is definite").inverse();
    let normal = DMatrix::from_fn(pairs, pairs, |i, j| k[(3 * i, 3 * j)]);
    let place = |i: usize| 3 * (i / 2) + 1 + i % 2;
    let tangential = DMatrix::from_fn(2 * pairs, 2 * pairs, |i, j| w[(place(i), place(j))]);
    let largest = |matrix: DMatrix<f64>| matrix.symmetric_eigenvalues().max();
    1.0 / (largest(normal) * largest(tangential)).sqrt()
}
