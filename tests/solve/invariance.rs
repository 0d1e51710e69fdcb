//! Bodies that are described in another way have the same forces.
//!
//! All problems have a condition number up to 1e3, friction up to 0.3 (one solution), and are
//! solved to 1e-12: answers agree to 1e-9 of their size, and 1e-8 is asked for.

use crate::common::dense::{largest, product};
use crate::common::problems::{
    Case, coulomb, decades, definite, frictionless, loaded, tresca, uniform,
};
use fastrand::Rng;
use signorini::{Method, Settings, Solution, State, Status};

const AGREEMENT: f64 = 1e-8;

fn solve(case: &Case, method: Method) -> Solution {
    let solution = case.solve(&Settings {
        method,
        tolerance: 1e-12,
        max_iterations: 50_000,
        ..Settings::default()
    });
    assert_eq!(solution.status, Status::Solved, "{case:?}\n{solution:?}");
    solution
}

/// A problem of each kind that has a method, in turn.
fn problem(rng: &mut Rng, dim: usize, kind: u64) -> (Case, Method) {
    let pairs = rng.usize(1..=6);
    let condition = decades(rng, 3.0);
    let k = definite(rng, dim * pairs, condition);
    let (law, method) = match kind % 8 {
        0 => (coulomb(rng, pairs, 0.3), Method::SorNested),
        1 => (coulomb(rng, pairs, 0.1), Method::SorDiagonal),
        2 => (tresca(rng, pairs), Method::SorNested),
        3 => (frictionless(pairs), Method::Lemke),
        4 => (coulomb(rng, pairs, 0.3), Method::Auto),
        5 => (frictionless(pairs), Method::BlockPivoting),
        6 => (tresca(rng, pairs), Method::Auto),
        _ if dim == 2 => (coulomb(rng, pairs, 0.3), Method::Lemke),
        _ => (frictionless(pairs), Method::Auto),
    };
    (loaded(rng, dim, k, law), method)
}

/// The problem in coordinates `x = Q y`, `columns[j]` being column `j` of the orthogonal `Q`; the
/// components of each pair stay among themselves, and the normal ones fixed.
fn turned(case: &Case, columns: &[Vec<f64>]) -> Case {
    let n = case.size();
    let half: Vec<Vec<f64>> = columns.iter().map(|column| product(&case.k, column)).collect();
    let mut k = vec![0.0; n * n];
    for i in 0..n {
        for j in 0..=i {
            k[i + j * n] = (0..n).map(|l| columns[i][l] * half[j][l]).sum();
            k[j + i * n] = k[i + j * n];
        }
    }
    let slip = case.slip.as_ref().map(|_| {
        let rest = |i: usize| {
            if i.is_multiple_of(case.dim) { 0.0 } else { case.rest(i / case.dim, i % case.dim - 1) }
        };
        let full: Vec<f64> = (0..n).map(rest).collect();
        let mut turned = transposed(columns, &full);
        let mut index = 0;
        turned.retain(|_| {
            index += 1;
            (index - 1) % case.dim != 0
        });
        turned
    });
    Case { k, f: transposed(columns, &case.f), slip, ..case.clone() }
}

/// `Qᵀ x`.
fn transposed(columns: &[Vec<f64>], x: &[f64]) -> Vec<f64> {
    columns.iter().map(|column| column.iter().zip(x).map(|(a, b)| a * b).sum()).collect()
}

fn assert_agree(case: &Case, a: &Solution, d: &[f64], force: &[f64], states: &[State], seed: u64) {
    let near = |a: &[f64], b: &[f64], scale: f64| {
        a.iter().zip(b).all(|(a, b)| (a - b).abs() <= AGREEMENT * scale)
    };
    let forces = largest(&case.f).max(largest(force));
    let good = near(&a.d, d, largest(d)) && near(&a.certificate.force, force, forces);
    assert!(good, "seed {seed}: {case:?}\n{a:?}\nexpected {d:?}\n{force:?}");
    assert_eq!(a.certificate.states, states, "seed {seed}: {case:?}");
}

/// In 3D the tangential axes of a pair are a choice: turned, or mirrored, the tangential forces
/// and displacements turn with them.
#[test]
fn tangential_axes_may_be_turned() {
    for seed in 0..400 {
        let mut rng = Rng::with_seed(seed);
        let (case, method) = problem(&mut rng, 3, seed);
        let n = case.size();
        let mut columns = vec![vec![0.0; n]; n];
        for pair in 0..case.pairs {
            let (sin, cos) = uniform(&mut rng, 0.0, std::f64::consts::TAU).sin_cos();
            let mirror = if rng.bool() { 1.0 } else { -1.0 };
            let (t, u) = (3 * pair + 1, 3 * pair + 2);
            columns[3 * pair][3 * pair] = 1.0;
            (columns[t][t], columns[t][u]) = (cos, sin);
            (columns[u][t], columns[u][u]) = (-mirror * sin, mirror * cos);
        }
        let before = solve(&case, method);
        let other = turned(&case, &columns);
        let after = solve(&other, method);
        let d = transposed(&columns, &before.d);
        let force = transposed(&columns, &before.certificate.force);
        assert_agree(&other, &after, &d, &force, &before.certificate.states, seed);
    }
}

/// In 2D the tangential direction of a pair is a choice of sign, which rounding does not see.
#[test]
fn tangential_signs_may_be_changed_bit_by_bit() {
    for seed in 0..400 {
        let mut rng = Rng::with_seed(seed);
        let (case, method) = problem(&mut rng, 2, seed);
        let n = case.size();
        let signs: Vec<f64> =
            (0..n).map(|i| if i % 2 == 1 && rng.bool() { -1.0 } else { 1.0 }).collect();
        let flip = |x: &[f64]| x.iter().zip(&signs).map(|(x, s)| x * s).collect::<Vec<f64>>();
        let other = Case {
            k: (0..n * n).map(|k| case.k[k] * signs[k % n] * signs[k / n]).collect(),
            f: flip(&case.f),
            slip: case
                .slip
                .as_ref()
                .map(|slip| (0..slip.len()).map(|i| slip[i] * signs[2 * i + 1]).collect()),
            ..case.clone()
        };
        let (before, after) = (solve(&case, method), solve(&other, method));
        if seed % 8 == 7 {
            // Lemke's method has an unknown for each side, in an order.
            let (d, force) = (flip(&before.d), flip(&before.certificate.force));
            assert_agree(&other, &after, &d, &force, &before.certificate.states, seed);
            continue;
        }
        assert_eq!(after.d, flip(&before.d), "seed {seed}");
        assert_eq!(after.certificate.force, flip(&before.certificate.force), "seed {seed}");
        assert_eq!(after.certificate.states, before.certificate.states, "seed {seed}");
        assert_eq!(after.certificate.eta, before.certificate.eta, "seed {seed}");
        assert_eq!(after.iterations, before.iterations, "seed {seed}");
    }
}

/// Pairs in another order.
#[test]
fn pairs_may_be_permuted() {
    for seed in 0..400 {
        let mut rng = Rng::with_seed(seed);
        let dim = rng.usize(2..=3);
        let (case, method) = problem(&mut rng, dim, seed);
        let mut order: Vec<usize> = (0..case.pairs).collect();
        rng.shuffle(&mut order);
        let n = case.size();
        let from = |i: usize| dim * order[i / dim] + i % dim;
        let pick = |x: &[f64]| (0..n).map(|i| x[from(i)]).collect::<Vec<f64>>();
        let pair = |x: &[f64]| order.iter().map(|&p| x[p]).collect::<Vec<f64>>();
        let other = Case {
            k: (0..n * n).map(|k| case.stiffness(from(k % n), from(k / n))).collect(),
            f: pick(&case.f),
            gap: pair(&case.gap),
            law: case.law.with(pair(case.law.values())),
            slip: case.slip.as_ref().map(|_| {
                order
                    .iter()
                    .flat_map(|&p| (0..dim - 1).map(move |c| (p, c)))
                    .map(|(p, c)| case.rest(p, c))
                    .collect()
            }),
            ..case.clone()
        };
        let (before, after) = (solve(&case, method), solve(&other, method));
        let states: Vec<State> = order.iter().map(|&p| before.certificate.states[p]).collect();
        let (d, force) = (pick(&before.d), pick(&before.certificate.force));
        assert_agree(&other, &after, &d, &force, &states, seed);
    }
}

/// A plane problem in space: a second tangential direction that nothing couples to and nothing
/// loads sticks without force. Its stiffness does not matter.
#[test]
fn plane_problems_may_be_embedded_in_space() {
    for seed in 0..400 {
        let mut rng = Rng::with_seed(seed);
        // Without the last kind, for which there is no method in space.
        let (case, method) = problem(&mut rng, 2, seed % 7);
        let n = 3 * case.pairs;
        let stiff = (0..case.size()).fold(0.0, |most: f64, i| most.max(case.stiffness(i, i)));
        let stiff = stiff * uniform(&mut rng, 0.1, 4.0);
        let spread = |x: &[f64]| {
            x.chunks_exact(2).flat_map(|pair| [pair[0], pair[1], 0.0]).collect::<Vec<f64>>()
        };
        let of_plane = |i: usize| (i % 3 < 2).then_some(2 * (i / 3) + i % 3);
        let other = Case {
            dim: 3,
            k: (0..n * n)
                .map(|k| match (of_plane(k % n), of_plane(k / n)) {
                    (Some(i), Some(j)) => case.stiffness(i, j),
                    _ if k % n == k / n => stiff,
                    _ => 0.0,
                })
                .collect(),
            f: spread(&case.f),
            slip: case
                .slip
                .as_ref()
                .map(|slip| slip.iter().flat_map(|&slip| [slip, 0.0]).collect()),
            ..case.clone()
        };
        let (before, after) = (solve(&case, method), solve(&other, method));
        let (d, force) = (spread(&before.d), spread(&before.certificate.force));
        assert_agree(&other, &after, &d, &force, &before.certificate.states, seed);
        assert!(after.d.iter().skip(2).step_by(3).all(|&d| d == 0.0), "seed {seed}");
    }
}

/// Without gaps and previous slip the law is a cone: answers are proportional to the loads.
#[test]
fn without_gaps_and_slip_answers_are_proportional_to_the_load() {
    for seed in 0..400 {
        let mut rng = Rng::with_seed(seed);
        let dim = rng.usize(2..=3);
        // Thresholds are forces: no cone.
        let kind = [0, 1, 3, 4, 5, 7][seed as usize % 6];
        let (mut case, method) = problem(&mut rng, dim, kind);
        case.gap.iter_mut().filter(|gap| gap.is_finite()).for_each(|gap| *gap = 0.0);
        case.slip = None;
        let factor = 10_f64.powf(uniform(&mut rng, -9.0, 9.0));
        let times = |x: &[f64]| x.iter().map(|x| x * factor).collect::<Vec<f64>>();
        let other = Case { f: times(&case.f), ..case.clone() };
        let (before, after) = (solve(&case, method), solve(&other, method));
        let (d, force) = (times(&before.d), times(&before.certificate.force));
        assert_agree(&other, &after, &d, &force, &before.certificate.states, seed);
    }
}

/// Displacements may be counted from closed pairs at their reference slip: both become loads
/// `-K (gap, slip)`.
#[test]
fn gaps_and_slip_may_be_replaced_by_loads() {
    for seed in 0..400 {
        let mut rng = Rng::with_seed(seed);
        let dim = rng.usize(2..=3);
        let (case, method) = problem(&mut rng, dim, seed);
        let origin: Vec<f64> = (0..case.size())
            .map(|i| match i % dim {
                0 if case.gap[i / dim].is_finite() => case.gap[i / dim],
                0 => 0.0,
                c => case.rest(i / dim, c - 1),
            })
            .collect();
        let shift = product(&case.k, &origin);
        let other = Case {
            f: case.f.iter().zip(&shift).map(|(f, shift)| f - shift).collect(),
            gap: case.gap.iter().map(|gap| if gap.is_finite() { 0.0 } else { *gap }).collect(),
            slip: None,
            ..case.clone()
        };
        let (before, after) = (solve(&case, method), solve(&other, method));
        let d: Vec<f64> = before.d.iter().zip(&origin).map(|(d, origin)| d - origin).collect();
        let force = &before.certificate.force;
        assert_agree(&other, &after, &d, force, &before.certificate.states, seed);
    }
}
