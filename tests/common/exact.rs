//! A contact problem in twice the precision: forces, the natural residual, and solutions by Newton's
//! method. Formulas are those of the problem's statement; nothing is shared with the library.

use signorini::State;

use super::ellipses::axes;
use super::problems::{Case, Law};
use super::quad::{Quad, norm, solve};

/// Half a unit in the last place of 1: the rounding of one double.
pub const UNIT: f64 = f64::EPSILON / 2.0;

/// Steps of Newton's method: it doubles the digits, from the few that an ill-conditioned answer has.
const STEPS: usize = 40;

/// A residual below this part of the sums that it comes from is zero: 30 digits, less a few for long sums.
const ZERO: f64 = 1e-27;

pub fn quads(values: &[f64]) -> Vec<Quad> {
    values.iter().map(|&value| Quad::from(value)).collect()
}

fn dot(a: &[Quad], b: &[Quad]) -> Quad {
    a.iter().zip(b).map(|(&a, &b)| a * b).sum()
}

/// `K d - f`.
pub fn force(case: &Case, d: &[Quad]) -> Vec<Quad> {
    let n = case.size();
    let row = |i: usize| -> Quad { (0..n).map(|j| d[j] * case.stiffness(i, j)).sum() };
    (0..n).map(|i| row(i) - Quad::from(case.f[i])).collect()
}

/// `sum |K| |d| + |f|`, row by row: the size of the sums that make `K d - f`.
pub fn parts(case: &Case, d: &[Quad]) -> Vec<f64> {
    let n = case.size();
    let row = |i: usize| (0..n).map(|j| (d[j].value() * case.stiffness(i, j)).abs()).sum::<f64>();
    (0..n).map(|i| row(i) + case.f[i].abs()).collect()
}

/// The largest entry of a stiffness.
pub fn largest_stiffness(case: &Case) -> f64 {
    (0..case.size()).map(|i| case.stiffness(i, i)).fold(0.0, f64::max)
}

/// `max(|f|, |F|)`.
pub fn scale(case: &Case, force: &[Quad]) -> Quad {
    norm(&quads(&case.f)).max(norm(force))
}

/// `K_tt` of a pair, in 3D the largest eigenvalue of its block.
pub fn tangential_stiffness(case: &Case, pair: usize) -> Quad {
    let t = case.dim * pair + 1;
    let a = Quad::from(case.stiffness(t, t));
    if case.dim == 2 {
        return a;
    }
    let (b, c) = (Quad::from(case.stiffness(t, t + 1)), Quad::from(case.stiffness(t + 1, t + 1)));
    let half = (a - c).scaled(0.5);
    (a + c).scaled(0.5) + (half * half + b * b).sqrt()
}

/// Bound on the tangential force under the normal force `normal`. Where `b` is the rounded `mu a` of a cone it is zero at
/// its tip, not what the rounding has left below.
pub fn threshold(case: &Case, pair: usize, normal: Quad) -> Quad {
    let [slope, offset, tension] = case.law.of(pair);
    ((-normal).max(Quad::from(-tension)) * slope + Quad::from(offset)).max(Quad::ZERO)
}

/// One pair at a displacement and the force there.
struct Point {
    force: Vec<Quad>,
    /// `F_n - a`.
    pull: Quad,
    /// `d_t - slip0`.
    slip: Vec<Quad>,
    /// `k_t slip - F_t`, and its length, or with an ellipse the bound on whose ellipse it lies.
    trial: Vec<Quad>,
    length: Quad,
    threshold: Quad,
    /// `k_n (d_n - gap)`, `None` without an obstacle.
    penetration: Option<Quad>,
}

fn point(case: &Case, pair: usize, d: &[Quad], force: &[Quad]) -> Point {
    let i = case.dim * pair;
    let k_t = tangential_stiffness(case, pair);
    let slip: Vec<Quad> =
        (1..case.dim).map(|c| d[i + c] - Quad::from(case.rest(pair, c - 1))).collect();
    let trial: Vec<Quad> = (1..case.dim).map(|c| slip[c - 1] * k_t - force[i + c]).collect();
    let gap = case.gap[pair];
    let penetration = gap.is_finite().then(|| (d[i] - Quad::from(gap)) * case.stiffness(i, i));
    Point {
        force: force[i..i + case.dim].to_vec(),
        pull: force[i] - Quad::from(case.law.of(pair)[2]),
        length: axes(case, pair).map_or_else(|| norm(&trial), |axes| axes.size(&trial)),
        threshold: threshold(case, pair, force[i]),
        slip,
        trial,
        penetration,
    }
}

/// The natural residual `e` at `d`, a force for each component:
/// `e_n = max(k_n (d_n - gap), F_n - a)`, `e_t = F_t + g h` where the trial `h |y|` is longer than the bound
/// `g`, else `k_t (d_t - slip0)`. With an ellipse `-g h` is the friction that belongs to the trial, by its rule.
pub fn residual(case: &Case, d: &[Quad], force: &[Quad]) -> Vec<Quad> {
    let mut residual = Vec::new();
    for pair in 0..case.pairs {
        let at = point(case, pair, d, force);
        residual.push(at.penetration.map_or(at.pull, |closed| closed.max(at.pull)));
        let k_t = tangential_stiffness(case, pair);
        if at.length > at.threshold {
            let (friction, ..) = slip(case, pair, &at, at.threshold);
            residual.extend(at.force[1..].iter().zip(friction).map(|(&force, own)| force + own));
        } else {
            residual.extend(at.slip.iter().map(|&slip| k_t * slip));
        }
    }
    residual
}

/// The friction of a slip under the bound `g`, its derivatives by the trial force, by columns, and that by the bound.
fn slip(case: &Case, pair: usize, at: &Point, g: Quad) -> (Vec<Quad>, Vec<Vec<Quad>>, Vec<Quad>) {
    if let Some(axes) = axes(case, pair) {
        let (turned, by_bound) = axes.slopes(&at.trial, g);
        return (axes.friction(&at.trial, g), turned.to_vec(), by_bound);
    }
    let h: Vec<Quad> = at.trial.iter().map(|&y| y / at.length).collect();
    let column = |j: usize| {
        let one = |i: usize| if i == j { Quad::ONE } else { Quad::ZERO };
        (0..h.len()).map(|i| g / at.length * (one(i) - h[i] * h[j])).collect()
    };
    (h.iter().map(|&h| g * h).collect(), (0..h.len()).map(column).collect(), h)
}

/// The friction beyond `g(0)` of a pair that is apart, `k_n (d_n - gap) <= F_n - a < 0`: it carries the tension alone.
/// The bound of an ellipse is zero then.
fn lost(case: &Case, pair: usize, at: &Point) -> Vec<Quad> {
    let is_apart = at.pull < Quad::ZERO && at.penetration.is_none_or(|closed| !(closed > at.pull));
    let friction = &at.force[1..];
    let (size, carried) = (norm(friction), threshold(case, pair, case.law.of(pair)[2].into()));
    let lost = if is_apart && size > carried { (size - carried) / size } else { Quad::ZERO };
    friction.iter().map(|&force| force * lost).collect()
}

/// `eta` of `d`: `|e| / max(|f|, |F|)`, with the friction that a pair loses for `e_t` where that is longer; 0 of loads and
/// forces that are below the last digits of the judge's own sums.
pub fn eta(case: &Case, d: &[Quad]) -> f64 {
    let force = force(case, d);
    let mut residual = residual(case, d, &force);
    for (pair, own) in residual.chunks_exact_mut(case.dim).enumerate() {
        let lost = lost(case, pair, &point(case, pair, d, &force));
        if norm(&lost) > norm(&own[1..]) {
            own[1..].copy_from_slice(&lost);
        }
    }
    let (size, scale) = (norm(&residual), scale(case, &force));
    let digits = ZERO * parts(case, d).into_iter().fold(0.0, f64::max);
    if size == Quad::ZERO || scale.value() <= digits { 0.0 } else { (size / scale).value() }
}

/// By how much `eta` may change if each entry of `d` is rounded to a double, and its denominator is
/// `scale`: with `a = u |K| |d|` the change of `F` is `a`, of `e_n` no more, and of `e_t` at most
/// `2 a_t + mu a_n + u k_t |d_t|`, as the direction of the trial `y` turns by `|change of y| / |y|` and
/// `g <= |y|`. The friction of an ellipse that is the nearest point moves as much at most, and that along the trial by
/// its length over the smaller half-axis as much.
pub fn rounding(case: &Case, d: &[Quad], scale: f64) -> f64 {
    let n = case.size();
    let a = |i: usize| -> f64 {
        let row = (0..n).map(|j| (d[j].value() * case.stiffness(i, j)).abs());
        UNIT * row.sum::<f64>()
    };
    let mut sum = 0.0_f64;
    for pair in 0..case.pairs {
        let i = case.dim * pair;
        let k_t = tangential_stiffness(case, pair).value();
        sum = sum.hypot(a(i));
        for (c, d) in d.iter().enumerate().take(i + case.dim).skip(i + 1) {
            let own = UNIT * k_t * d.value().abs();
            let turned = own_line(case, pair) * (a(c) + own);
            sum = sum.hypot(2.0 * a(c) + case.law.of(pair)[0] * a(i) + own + turned);
        }
    }
    if sum == 0.0 { 0.0 } else { sum / scale }
}

/// The ratio of the axes of an ellipse along whose trial the friction is; 0 for others.
pub fn own_line(case: &Case, pair: usize) -> f64 {
    match case.law.own(pair) {
        Law::Collinear(_) => axes(case, pair).map_or(0.0, |axes| axes.ratio()),
        _ => 0.0,
    }
}

/// The states of the pairs on whose branches of the natural map `d` is.
pub fn states(case: &Case, d: &[Quad]) -> Vec<State> {
    let force = force(case, d);
    let state = |pair: usize| {
        let at = point(case, pair, d, &force);
        let open = at.penetration.is_none_or(|closed| closed < at.pull);
        match at.length > at.threshold {
            _ if open => State::Open,
            true => State::Slip,
            false => State::Stick,
        }
    };
    (0..case.pairs).map(state).collect()
}

/// The solution of the law next to `d`, by Newton's method on the natural map. `held` holds the states
/// of the pairs; otherwise they follow the iterate. `None` if none is reached, or a system is singular.
pub fn refined(case: &Case, d: &[Quad], held: Option<&[State]>) -> Option<Vec<Quad>> {
    let mut d = d.to_vec();
    for _ in 0..STEPS {
        let force = force(case, &d);
        let limit = ZERO * parts(case, &d).iter().fold(0.0, |most: f64, part| most.max(*part));
        if norm(&residual(case, &d, &force)).value() <= limit {
            return Some(d);
        }
        let (matrix, rhs) = system(case, &d, &force, held);
        let step = solve(matrix, rhs)?;
        d.iter_mut().zip(&step).for_each(|(d, step)| *d -= *step);
    }
    None
}

/// True if a state names the equations of a pair.
fn is_of_states(case: &Case) -> bool {
    let of_state = |law| matches!(law, Law::Coulomb(_) | Law::Orthotropic(_) | Law::Collinear(_));
    (0..case.pairs).all(|pair| of_state(case.law.own(pair)))
}

/// Derivative and value of the equations of the states.
fn system(
    case: &Case,
    d: &[Quad],
    force: &[Quad],
    held: Option<&[State]>,
) -> (Vec<Vec<Quad>>, Vec<Quad>) {
    let n = case.size();
    let row = |i: usize| -> Vec<Quad> { (0..n).map(|j| case.stiffness(i, j).into()).collect() };
    let (mut matrix, mut rhs) = (Vec::new(), Vec::new());
    for pair in 0..case.pairs {
        let (i, at) = (case.dim * pair, point(case, pair, d, force));
        let state = held.map(|held| held[pair]);
        let closed = at.penetration.filter(|closed| match state {
            Some(state) if is_of_states(case) => state != State::Open,
            _ => *closed >= at.pull,
        });
        let mut unit = vec![Quad::ZERO; n];
        unit[i] = Quad::from(case.stiffness(i, i));
        matrix.push(if closed.is_some() { unit } else { row(i) });
        rhs.push(closed.unwrap_or(at.pull));
        let [slope, offset, tension] = case.law.of(pair);
        let (slope, offset) = match closed {
            Some(_) => (slope, Quad::from(offset)),
            None => (0.0, threshold(case, pair, Quad::from(tension))),
        };
        let threshold = (-at.force[0]) * slope + offset;
        let k_t = tangential_stiffness(case, pair);
        let sticks = match state {
            Some(state) if is_of_states(case) => state == State::Stick,
            _ => at.length <= threshold,
        };
        for c in 0..case.dim - 1 {
            let t = i + 1 + c;
            if sticks {
                let mut unit = vec![Quad::ZERO; n];
                unit[t] = k_t;
                matrix.push(unit);
                rhs.push(k_t * at.slip[c]);
                continue;
            }
            if at.length == Quad::ZERO || threshold == Quad::ZERO {
                matrix.push(row(t));
                rhs.push(at.force[1 + c]);
                continue;
            }
            // F_t + tau: dF_t + G dg + T (k_t d(d_t) - dF_t).
            let (friction, turned, by_bound) = slip(case, pair, &at, threshold);
            let mut sum = row(t);
            for (sum, normal) in sum.iter_mut().zip(row(i)) {
                *sum -= by_bound[c] * normal * slope;
            }
            for (b, turned) in turned.iter().enumerate() {
                for (sum, tangential) in sum.iter_mut().zip(row(i + 1 + b)) {
                    *sum -= turned[c] * tangential;
                }
                sum[i + 1 + b] += turned[c] * k_t;
            }
            matrix.push(sum);
            rhs.push(at.force[1 + c] + friction[c]);
        }
    }
    (matrix, rhs)
}

/// Units of rounding in each of the `n` entries of a row that an eigenvalue is above, if rounding cannot
/// be its cause: twice one.
pub const BEYOND_ROUNDING: f64 = 2.0;

/// `true` if all eigenvalues of `K`, its diagonal scaled to 1, are above `units` of rounding in each of the
/// `n` entries of a row; with 0: if `K` is definite as it is given.
pub fn is_definite(case: &Case, units: f64) -> bool {
    let n = case.size();
    let root: Vec<Quad> = (0..n).map(|i| Quad::from(case.stiffness(i, i)).sqrt()).collect();
    if root.contains(&Quad::ZERO) {
        return false;
    }
    let shift = Quad::from(units * n as f64 * UNIT);
    let entry = |i: usize, j: usize| {
        let scaled = Quad::from(case.stiffness(i, j)) / (root[i] * root[j]);
        if i == j { scaled - shift } else { scaled }
    };
    super::quad::is_definite((0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect())
}

/// `true` if two displacements differ by more than 1e-9 in some component, beside 1e-20 of the largest.
pub fn differ(case: &Case, a: &[Quad], b: &[Quad]) -> bool {
    let root = |i: usize| case.stiffness(i, i).abs().sqrt();
    let size = |i: usize| root(i) * a[i].value().abs().max(b[i].value().abs());
    let most = (0..a.len()).map(size).fold(0.0, f64::max);
    (0..a.len()).any(|i| root(i) * (a[i] - b[i]).abs().value() > 1e-9 * size(i) + 1e-20 * most)
}

/// `a . b` of doubles.
pub fn work(a: &[f64], b: &[f64]) -> f64 {
    dot(&quads(a), &quads(b)).value()
}
