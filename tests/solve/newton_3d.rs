//! Newton's method on the normal map, with friction in space.

use crate::common::dense::largest;
use crate::common::exact::{self, quads};
use crate::common::measures::{eta, rounding};
use crate::common::problems::{
    Case, Law, add_spring, coulomb, definite, loaded, tresca, uniform, vector,
};
use fastrand::Rng;
use signorini::{Method, Settings, Status};

fn settings(method: Method) -> Settings {
    Settings { method, tolerance: 1e-12, ..Settings::default() }
}

/// Definite problems of 1 to 20 pairs. By Newton's method alone all are solved up to the condition
/// number 1e2 and mu 1, where theory has the map of thresholds contract or nearly so. What it leaves the
/// path solves: `tests/families/random_3d.rs`.
#[test]
fn solves_random_definite_problems() {
    for (condition, most, unsolved_at_most) in
        [(1e1, 1.0, 0), (1e2, 0.3, 0), (1e2, 1.0, 0), (1e4, 0.3, 2), (1e4, 1.0, 6)]
    {
        let mut unsolved = 0;
        for seed in 0..200 {
            let mut rng = Rng::with_seed(seed);
            let pairs = rng.usize(1..=20);
            let k = definite(&mut rng, 3 * pairs, condition);
            let law = match seed % 4 {
                0 => tresca(&mut rng, pairs),
                _ => coulomb(&mut rng, pairs, most),
            };
            let case = loaded(&mut rng, 3, k, law);
            let solution = case.solve(&settings(Method::Newton));
            if solution.status != Status::Solved {
                unsolved += 1;
                continue;
            }
            let allowed = 1.1e-12 + rounding(&case, &solution.d);
            assert!(eta(&case, &solution.d) <= allowed, "seed {seed}: {case:?}\n{solution:?}");
        }
        println!("condition {condition:e}, mu up to {most}: {unsolved} of 200 unsolved");
        assert!(unsolved <= unsolved_at_most, "condition {condition:e}, mu {most}: {unsolved}");
    }
}

/// A problem in the plane with a second tangent that nothing loads or couples: the answer is that of
/// the plane, found there by another method. Both obey the law to 1e-12 of the forces, which a condition
/// number of 1e2 makes 1e-10 of the displacements.
#[test]
fn an_extruded_problem_has_the_answer_of_the_plane() {
    for seed in 0..200 {
        let mut rng = Rng::with_seed(seed);
        let pairs = rng.usize(1..=12);
        let k = definite(&mut rng, 2 * pairs, 1e2);
        let law = coulomb(&mut rng, pairs, 0.3);
        let plane = loaded(&mut rng, 2, k, law);
        let space = plane.extruded(|| uniform(&mut rng, 0.5, 2.0));
        let (two, three) =
            (plane.solve(&settings(Method::Auto)), space.solve(&settings(Method::Newton)));
        assert_eq!((two.status, three.status), (Status::Solved, Status::Solved), "seed {seed}");
        let size = two.d.iter().fold(0.0_f64, |most, d| most.max(d.abs()));
        for pair in 0..pairs {
            for c in 0..2 {
                let apart = (two.d[2 * pair + c] - three.d[3 * pair + c]).abs();
                assert!(apart <= 1e-9 * size, "seed {seed}, pair {pair}: {apart:e} of {size}");
            }
        }
    }
}

/// As above where supports nearly hold the pairs along the second tangent, up to 1e10 times as stiff: a few systems find
/// the answer of the plane all the same.
#[test]
fn a_stiff_second_tangent_changes_nothing() {
    for seed in 0..200 {
        let mut rng = Rng::with_seed(seed);
        let pairs = rng.usize(1..=40);
        let k = definite(&mut rng, 2 * pairs, 1e2);
        let law = coulomb(&mut rng, pairs, 0.3);
        let plane = loaded(&mut rng, 2, k, law);
        let space = plane.extruded(|| 10_f64.powf(uniform(&mut rng, 1.5, 10.0)));
        let (two, three) =
            (plane.solve(&settings(Method::Auto)), space.solve(&settings(Method::Newton)));
        assert_eq!((two.status, three.status), (Status::Solved, Status::Solved), "seed {seed}");
        assert!(three.factorisations <= 20, "seed {seed}: {}", three.factorisations);
        let size = largest(&two.d);
        for (two, three) in two.d.chunks_exact(2).zip(three.d.chunks_exact(3)) {
            let apart = (two[0] - three[0]).abs().max((two[1] - three[1]).abs());
            assert!(apart <= 1e-9 * size, "seed {seed}: {apart:e} of {size}");
        }
    }
}

/// Springs across one direction of the tangent plane of each pair, from 1e2 to 1e10 times as stiff as the bodies, on pairs
/// that are loaded along them too. Friction is that for which the bodies alone have one solution; Newton's method
/// finds one of each problem.
#[test]
fn pairs_that_are_stiff_across_some_direction_are_solved() {
    for seed in 0..300 {
        let mut rng = Rng::with_seed(seed);
        let pairs = rng.usize(1..=12);
        let mut k = definite(&mut rng, 3 * pairs, 1e2);
        for pair in 0..pairs {
            let (sin, cos) = uniform(&mut rng, 0.0, std::f64::consts::TAU).sin_cos();
            let mut strain = vec![0.0; 3 * pairs];
            (strain[3 * pair + 1], strain[3 * pair + 2]) = (cos, sin);
            add_spring(&mut k, &strain, 10_f64.powf(uniform(&mut rng, 2.0, 10.0)));
        }
        let law = coulomb(&mut rng, pairs, 0.3);
        let found = loaded(&mut rng, 3, k, law).solve(&settings(Method::Newton));
        assert_eq!(found.status, Status::Solved, "seed {seed}: {}", found.factorisations);
    }
}

/// The tangents of each pair turned by an angle of its own turn the answer by it, and nothing else.
#[test]
fn turned_tangents_turn_the_answer() {
    for seed in 0..200 {
        let mut rng = Rng::with_seed(seed);
        let pairs = rng.usize(1..=12);
        let n = 3 * pairs;
        let k = definite(&mut rng, n, 1e2);
        let law = coulomb(&mut rng, pairs, 0.3);
        let case = loaded(&mut rng, 3, k, law.clone());
        let turns: Vec<(f64, f64)> =
            (0..pairs).map(|_| uniform(&mut rng, 0.0, std::f64::consts::TAU).sin_cos()).collect();
        let turned = |values: &[f64], width: usize| -> Vec<f64> {
            let mut values = values.to_vec();
            for (pair, &(sin, cos)) in values.chunks_exact_mut(width).zip(&turns) {
                let (a, b) = (pair[width - 2], pair[width - 1]);
                (pair[width - 2], pair[width - 1]) = (cos * a - sin * b, sin * a + cos * b);
            }
            values
        };
        // Columns, then rows.
        let mut k = case.k.clone();
        for _ in 0..2 {
            let columns: Vec<f64> =
                k.chunks_exact(n).flat_map(|column| turned(column, 3)).collect();
            for i in 0..n {
                for j in 0..n {
                    k[i + n * j] = columns[j + n * i];
                }
            }
        }
        let slip = case.slip.as_ref().map(|slip| turned(slip, 2));
        let other = Case { k, f: turned(&case.f, 3), slip, gap: case.gap.clone(), law, ..case };
        let (one, two) =
            (case.solve(&settings(Method::Newton)), other.solve(&settings(Method::Newton)));
        assert_eq!((one.status, two.status), (Status::Solved, Status::Solved), "seed {seed}");
        let expected = turned(&one.d, 3);
        let size = expected.iter().fold(0.0_f64, |most, d| most.max(d.abs()));
        for (d, expected) in two.d.iter().zip(&expected) {
            assert!((d - expected).abs() <= 1e-9 * size, "seed {seed}: {d} and {expected}");
        }
    }
}

/// One pair under any load, near its obstacle: judged in twice the precision.
#[test]
fn one_pair_is_solved_to_the_last_digits() {
    for seed in 0..500 {
        let mut rng = Rng::with_seed(seed);
        let k = definite(&mut rng, 3, 10.0);
        let mu = uniform(&mut rng, 0.0, 0.3);
        let f = vector(&mut rng, 3);
        let gap = uniform(&mut rng, -0.5, 0.5);
        let case = Case {
            dim: 3,
            pairs: 1,
            k,
            f,
            gap: vec![gap],
            law: Law::Coulomb(vec![mu]),
            slip: None,
        };
        let solution = case.solve(&settings(Method::Newton));
        assert_eq!(solution.status, Status::Solved, "seed {seed}");
        // Rounding of d on a condition number of 10.
        let residual = exact::eta(&case, &quads(&solution.d));
        assert!(residual <= 1e-12, "seed {seed}: {residual:e}");
    }
}
