//! LCPs of games between two, by Lemke's method and by the default one: bimatrix games, which every covering vector
//! leads into a ray, games whose variables stand in groups, and small LCPs that other programs are tested with.

use crate::common::bare::Bare;
use fastrand::Rng;
use signorini::{LcpSolution, Method, Settings, Status};

/// The answers of both methods, each of which is a solution or a proof where it says so.
fn answers(data: &Bare, context: &str) -> [LcpSolution; 2] {
    [Method::Lemke, Method::Auto].map(|method| {
        // No path of these games takes half of it.
        let budget = 40 * data.n as u64;
        let settings = Settings { method, max_iterations: budget, ..Settings::default() };
        let solution = data.solve(&settings);
        assert_eq!(data.flaw(&solution, settings.tolerance), None, "{context}\n{data:?}");
        solution
    })
}

fn assert_solved(data: &Bare, context: &str) {
    for solution in answers(data, context) {
        assert_eq!(
            solution.status,
            Status::Solved,
            "{context}: {:?} {}\n{data:?}",
            solution.method,
            solution.message
        );
    }
}

/// The kinds of `n` variables in a random order, one of each kind at least.
fn kinds(rng: &mut Rng, n: usize) -> Vec<bool> {
    let first = rng.usize(1..n);
    let mut kinds: Vec<bool> = (0..n).map(|i| i < first).collect();
    rng.shuffle(&mut kinds);
    kinds
}

/// A cost: of few whole numbers, of many, or any over some decades.
fn cost(rng: &mut Rng, sort: u64) -> f64 {
    match sort % 3 {
        0 => f64::from(rng.i32(1..=3)),
        1 => f64::from(rng.i32(1..=250)),
        _ => 10_f64.powf(4.0 * rng.f64() - 2.0),
    }
}

/// `M = [0 A; B 0]` with `A, B > 0`, its variables in a random order. `q` is -1; or has entries of any sign, a
/// negative one of each kind.
fn bimatrix(seed: u64, n: usize) -> Bare {
    let mut rng = Rng::with_seed(seed);
    let kinds = kinds(&mut rng, n);
    let entry = |k: usize| if kinds[k % n] == kinds[k / n] { 0.0 } else { cost(&mut rng, seed) };
    let m = (0..n * n).map(entry).collect();
    let mut q = vec![-1.0; n];
    if seed.is_multiple_of(2) {
        let any = |rng: &mut Rng| match rng.u8(0..3) {
            0 => 0.0,
            1 => f64::from(rng.i32(-3..=3)),
            _ => 2.0 * rng.f64() - 1.0,
        };
        q.iter_mut().for_each(|q| *q = any(&mut rng));
        for kind in [false, true] {
            let of_kind = kinds.iter().zip(&mut q).filter(|(of, _)| **of == kind);
            let least = of_kind.map(|(_, q)| q).min_by(|a, b| a.total_cmp(b)).unwrap();
            *least = -least.abs().max(0.5);
        }
    }
    Bare { n, m, q }
}

/// Every game has an equilibrium, and the path of Lemke and Howson finds one (Cottle, Pang and Stone, *The Linear
/// Complementarity Problem*, 4.4); all complementary bases agree that there is one.
#[test]
fn bimatrix_games_are_solved() {
    for n in 2..=8 {
        for seed in 0..300 {
            let data = bimatrix(seed, n);
            // Bases of condition 1e6 leave less.
            assert!(data.margin() > -1e-7, "{seed}\n{data:?}");
            assert_solved(&data, &format!("n {n}, seed {seed}"));
        }
    }
    for seed in 0..200 {
        assert_solved(&bimatrix(seed, 10 + seed as usize % 50), &format!("seed {seed}"));
    }
}

/// With `q < 0` of one kind alone there is no solution, though `w = q + M z >= 0` has many: `w` of the other kind is
/// positive where a `z` is, so that the `z` that could help are zero. Nothing is claimed.
#[test]
fn a_game_without_a_solution_is_not_solved() {
    let m = vec![0.0, 2.0, 1.0, 0.0];
    let data = Bare { n: 2, m, q: vec![-1.0, 1.0] };
    assert!(data.margin() < 0.0);
    for solution in answers(&data, "one kind") {
        assert_eq!(solution.status, Status::Stalled);
    }
}

/// Two players with costs `P > 0`, each with strategies in groups, whose sums are at least 1 with the multipliers `u`:
/// `M = [P -E; Eᵀ 0]`, `q = (0, -1)`. `M` is copositive, and `z = 0` alone solves the LCP with `q = 0`: `zᵀ M z = 0` leaves
/// no strategy, and `-E u >= 0` no multiplier. So Lemke's method solves all (Cottle, Pang and Stone, 4.4). `q`
/// has ties in all strategies. The problem `tobenna` of Siconos' tests (numerics/src/LCP/test/data) has this form, with
/// two times four groups of four; rounding led its path back to a basis.
fn groups(seed: u64, groups: usize, members: usize) -> Bare {
    let mut rng = Rng::with_seed(seed);
    let (strategies, n) = (groups * members, groups * members + groups);
    let mut m = vec![0.0; n * n];
    for j in 0..strategies {
        for i in 0..strategies {
            let is_own = (i < strategies / 2) == (j < strategies / 2);
            m[i + n * j] = if is_own { 1.0 } else { cost(&mut rng, seed % 2) };
        }
        let of_group = strategies + j / members;
        (m[of_group + n * j], m[j + n * of_group]) = (1.0, -1.0);
    }
    let q = (0..n).map(|i| if i < strategies { 0.0 } else { -1.0 }).collect();
    Bare { n, m, q }
}

#[test]
fn games_in_groups_are_solved() {
    for seed in 0..300 {
        let data = groups(seed, 2, 1 + seed as usize % 3);
        assert!(data.margin() > -1e-7, "{seed}\n{data:?}");
        assert_solved(&data, &format!("small, seed {seed}"));
    }
    for seed in 0..100 {
        assert_solved(&groups(seed, 8, 4), &format!("seed {seed}"));
    }
}

/// Small LCPs that Siconos is tested with (numerics/src/LCP/test/data, column by column), most of them examples of
/// Cottle, Pang and Stone: one that all complementary bases find a solution of is solved, no other is called so.
#[test]
fn small_problems_of_other_programs() {
    let problems: [(&str, &[f64], &[f64]); 9] = [
        ("CPS_1", &[1.0, 1.0, 1.0, 1.0], &[-1.0, -1.0]),
        ("CPS_2", &[0.0, 2.0, -1.0, -1.0, 0.0, 1.0, 2.0, -2.0, 0.0], &[-3.0, 6.0, -1.0]),
        (
            "CPS_3",
            &[0., 0., 10., 30., 0., 0., 20., 15., 10., 30., 0., 0., 20., 15., 0., 0.],
            &[-1.0; 4],
        ),
        (
            "CPS_4",
            &[11., 0., 10., 1., 0., 11., 10., 1., 10., 10., 21., 1., -1., -1., -1., 0.],
            &[50.0, 50.0, 10.0, -6.0],
        ),
        (
            "CPS_4bis",
            &[11., 0., 10., 1., 0., 11., 10., 1., 10., 10., 21., 1., -1., -1., -1., 0.],
            &[50.0, 50.0, 23.0, -6.0],
        ),
        ("CPS_5", &[1.0, -1.0, -1.0, 1.0], &[1.0, -1.0]),
        ("Pang_isolated_sol", &[0., 1., -1., -1., 0., 0., -1., 0., 0.], &[0.0, -1.0, 1.0]),
        (
            "Pang_isolated_sol_perturbed",
            &[0., 1., -1., -1., 0., 0., -1., 0., 0.],
            &[-0.0001, -1.0, 1.0],
        ),
        ("inf_sol_perturbed", &[0., 1., -1., -1., 0., 0., 1., 0., 0.], &[-0.0001, -1.0, 1.0]),
    ];
    for (name, m, q) in problems {
        let data = Bare { n: q.len(), m: m.to_vec(), q: q.to_vec() };
        // Whole numbers and a ten thousandth: a margin is zero, or far from it.
        let is_solvable = data.margin() > -1e-9;
        for solution in answers(&data, name) {
            assert_eq!(solution.status == Status::Solved, is_solvable, "{name}: {solution:?}");
        }
    }
}
