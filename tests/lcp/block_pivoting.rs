//! Block pivoting takes no more linear systems than its textbook form.

use crate::common::dense::Elimination;
use crate::common::measures::force;
use crate::common::problems::{Case, decades, definite, frictionless, loaded, vector};
use fastrand::Rng;
use signorini::{Method, Monitor, Settings, Status};

/// The textbook: from all pairs open, exchange all that violate their condition, until none does; a
/// single one, the last, after ten exchanges that have not lowered their number. Returns the number
/// of systems. J. J. Júdice and F. M. Pires, Computers & Operations Research 21 (1994) 587-596.
fn textbook(case: &Case) -> u64 {
    let n = case.size();
    let mut closed = vec![false; case.pairs];
    let (mut fewest, mut patience) = (usize::MAX, 10);
    for systems in 1.. {
        let (mut matrix, mut right) = (vec![0.0; n * n], vec![0.0; n]);
        for i in 0..n {
            if i % 2 == 0 && closed[i / 2] {
                (matrix[i * n + i], right[i]) = (1.0, case.gap[i / 2]);
            } else {
                (0..n).for_each(|j| matrix[i * n + j] = case.stiffness(i, j));
                right[i] = case.f[i];
            }
        }
        let (d, _) = Elimination::new(n, &matrix).solve(&right);
        let force = force(case, &d);
        // Loads are about 1, stiffnesses 1e-6 to 1: signs are certain beyond this.
        let violated: Vec<usize> = (0..case.pairs)
            .filter(|&pair| match closed[pair] {
                true => force[2 * pair] > 1e-10,
                false => {
                    case.stiffness(2 * pair, 2 * pair) * (d[2 * pair] - case.gap[pair]) > 1e-10
                }
            })
            .collect();
        if violated.is_empty() {
            return systems;
        }
        if violated.len() < fewest {
            (fewest, patience) = (violated.len(), 10);
        }
        let exchanged = if patience > 0 { &violated[..] } else { &violated[violated.len() - 1..] };
        patience -= i32::from(patience > 0);
        exchanged.iter().for_each(|&pair| closed[pair] = !closed[pair]);
    }
    unreachable!("it is finite")
}

fn random(seed: u64, pairs: std::ops::RangeInclusive<usize>) -> Case {
    let mut rng = Rng::with_seed(seed);
    let pairs = rng.usize(pairs);
    let condition = decades(&mut rng, 6.0);
    let k = definite(&mut rng, 2 * pairs, condition);
    loaded(&mut rng, 2, k, frictionless(pairs))
}

/// All together at most twice as many, and none more than 25 beyond its own: from rest, and from
/// displacements that have nothing to do with the solution.
#[test]
fn takes_about_as_many_systems_as_the_textbook_form() {
    let settings = Settings { method: Method::BlockPivoting, ..Settings::default() };
    let (mut total, mut known, mut worst) = (0, 0, (0, 0, 0));
    for seed in 0..400 {
        let case = random(seed, 1..=30);
        let systems = textbook(&case);
        let start = vector(&mut Rng::with_seed(seed), case.size());
        for start in [None, Some(&start[..])] {
            let mut monitor = Monitor::new(&settings, None);
            let solution =
                signorini::solve(&case.problem(), &settings, start, &mut monitor).unwrap();
            assert_eq!(solution.status, Status::Solved, "seed {seed}: {}", solution.message);
            worst = worst.max((solution.iterations, systems, seed));
            (total, known) = (total + solution.iterations, known + systems);
        }
    }
    println!("{total} systems, the textbook form {known}; worst {worst:?}");
    let (most, systems, seed) = worst;
    assert!(total <= 2 * known, "{total} systems, the textbook form takes {known}");
    assert!(most <= systems + 25, "seed {seed}: {most} systems, the textbook form takes {systems}");
}
