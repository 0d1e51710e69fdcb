//! The flexibility form with a sparse `W`: islands against the dense form of the whole, and the refusals of a
//! sparse matrix.

use crate::common::dense::{difference, dot, largest, product};
use crate::common::flexible::{Case, gram};
use crate::common::problems::{definite, uniform, vector};
use fastrand::Rng;
use signorini::reduce::{Indices, SparseMatrix, Triangle};
use signorini::{
    Error, FlexibilityData, FlexibilityProblem, FrictionLaw, Limit, Method, Monitor, Settings,
    Solution, Status, Uniqueness, memory_flexibility, solve_flexibility,
};

/// A matrix by columns, as a host has it.
#[derive(Clone)]
struct Stored {
    size: usize,
    col_start: Vec<i64>,
    row: Vec<i64>,
    values: Vec<f64>,
    base: i64,
    triangle: Triangle,
}

impl Stored {
    /// The entries of a dense matrix that are not zero.
    fn of(size: usize, dense: &[f64], triangle: Triangle, base: i64) -> Stored {
        let mut stored =
            Stored { size, col_start: vec![base], row: vec![], values: vec![], base, triangle };
        for j in 0..size {
            for i in 0..size {
                let is_stored = match triangle {
                    Triangle::Lower => i >= j,
                    Triangle::Upper => i <= j,
                    Triangle::Full => true,
                };
                if is_stored && dense[i + size * j] != 0.0 {
                    stored.row.push(base + i as i64);
                    stored.values.push(dense[i + size * j]);
                }
            }
            stored.col_start.push(base + stored.row.len() as i64);
        }
        stored
    }

    fn view(&self) -> SparseMatrix<'_> {
        SparseMatrix {
            size: self.size,
            col_start: Indices::Wide(&self.col_start),
            row: Indices::Wide(&self.row),
            values: &self.values,
            index_base: self.base,
            triangle: self.triangle,
        }
    }
}

/// A case with its matrix stored as a sparse one.
fn problem<'a>(case: &'a Case, stored: &'a Stored) -> Result<FlexibilityProblem<'a>, Error> {
    FlexibilityProblem::from_sparse(FlexibilityData {
        dim: case.dim,
        pairs: case.gap.len(),
        flexibility: stored.view(),
        free: &case.q,
        gap: &case.gap,
        law: FrictionLaw::Coulomb(&case.mu),
        reference_slip: Some(&case.slip0),
    })
}

fn lower(case: &Case) -> Stored {
    Stored::of(case.q.len(), &case.w, Triangle::Lower, 0)
}

fn solve_by(case: &Case, settings: &Settings, start: Option<&[f64]>) -> Result<Solution, Error> {
    let stored = lower(case);
    let problem = problem(case, &stored)?;
    let solution = solve_flexibility(&problem, settings, start, &mut Monitor::new(settings, None))?;
    assert_eq!(solution.uniqueness, Uniqueness::NotKnown);
    Ok(solution)
}

fn solve(case: &Case) -> Solution {
    solve_by(case, &Settings::default(), None).expect("valid data")
}

/// The solution, which must be certified and pass the judge.
fn solved(case: &Case) -> Solution {
    let solution = solve(case);
    assert_eq!(solution.status, Status::Solved, "{}", solution.message);
    assert!(solution.certificate.eta <= Settings::default().tolerance);
    let error = case.judged(&solution.d, &solution.certificate.force);
    // As in `Case::solved`.
    assert!(error <= 1e-9, "{error:e}");
    solution
}

/// Cases side by side, the pair `order[k]` of the whole is pair `k` of the sequence of all. Nothing ties one case
/// to another.
fn together(cases: &[Case], order: &[usize]) -> Case {
    let dim = cases[0].dim;
    let n = dim * order.len();
    let mut whole = Case::new(dim, vec![0.0; n * n], vec![0.0; n], 0.0);
    let mut first = 0;
    for case in cases {
        let own = case.q.len();
        let place = |i: usize| dim * order[first + i / dim] + i % dim;
        for j in 0..own {
            for i in 0..own {
                whole.w[place(i) + n * place(j)] = case.w[i + own * j];
            }
            whole.q[place(j)] = case.q[j];
        }
        for pair in 0..case.gap.len() {
            let to = order[first + pair];
            (whole.gap[to], whole.mu[to]) = (case.gap[pair], case.mu[pair]);
            let slips = dim - 1;
            whole.slip0[slips * to..slips * (to + 1)]
                .copy_from_slice(&case.slip0[slips * pair..slips * (pair + 1)]);
        }
        first += case.gap.len();
    }
    whole
}

fn shuffled(rng: &mut Rng, pairs: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..pairs).collect();
    rng.shuffle(&mut order);
    order
}

/// A flexibility of full rank: without friction, and with little of it, the forces are unique.
fn full(rng: &mut Rng, dim: usize, pairs: usize, most: f64) -> Case {
    let n = dim * pairs;
    let mut case = Case::new(dim, definite(rng, n, 100.0), vector(rng, n), 0.0);
    case.gap.fill_with(|| uniform(rng, -0.2, 0.3));
    case.mu.fill_with(|| uniform(rng, 0.0, most));
    case.slip0.fill_with(|| uniform(rng, -0.2, 0.2));
    case
}

/// A frictionless flexibility of low rank, at free displacements that a motion undoes: `d` is unique, as the least
/// distance from `q` in the energy of `W`.
fn low_rank(rng: &mut Rng, dim: usize, pairs: usize) -> Case {
    let n = dim * pairs;
    let rank = rng.usize(1..=n.min(4));
    let rows: Vec<Vec<f64>> = (0..n).map(|_| vector(rng, rank)).collect();
    let z = vector(rng, rank);
    let q = rows.iter().map(|row| dot(row, &z)).collect();
    let mut case = Case::new(dim, gram(&rows), q, 0.0);
    case.gap.fill_with(|| uniform(rng, 0.01, 0.1));
    case
}

#[test]
fn islands_with_full_rank_have_the_forces_of_the_dense_form() {
    let rng = &mut Rng::with_seed(1);
    for round in 0..40 {
        let dim = 2 + round % 2;
        let islands = rng.usize(1..=5);
        let most = if round % 4 < 2 { 0.0 } else { 0.05 };
        let cases: Vec<Case> = (0..islands)
            .map(|_| {
                let pairs = rng.usize(1..=5);
                full(rng, dim, pairs, most)
            })
            .collect();
        let pairs = cases.iter().map(|case| case.gap.len()).sum();
        let whole = together(&cases, &shuffled(rng, pairs));
        let (sparse, dense) = (solved(&whole), whole.solved());
        let apart = largest(&difference(&sparse.certificate.force, &dense.certificate.force));
        // Both are solved to 1e-10, where a force of a unit moves at least 1/100 of the largest flexibility.
        assert!(apart <= 1e-9 * largest(&dense.certificate.force).max(1.0), "{apart:e}");
        assert!(largest(&difference(&sparse.d, &dense.d)) <= 1e-9);
        assert_eq!(sparse.certificate.states.len(), pairs);
    }
}

/// Forces at which the load is taken away. Where `W` is definite none are left without friction, and with friction where
/// no pair has slipped before: `F . d` of a pair is never positive then, while their sum is `F . W F`.
#[test]
fn unloaded_islands_have_no_forces() {
    let rng = &mut Rng::with_seed(11);
    let mut from_forces = 0;
    for round in 0..200 {
        let dim = 2 + round % 2;
        let pairs = rng.usize(1..=6);
        let mut loaded = full(rng, dim, pairs, 0.3);
        loaded.gap.fill(0.0);
        if round % 4 < 2 {
            loaded.mu.fill(0.0);
        } else {
            loaded.slip0.fill(0.0);
        }
        let start = loaded.solve().certificate.force;
        from_forces += usize::from(largest(&start) > 0.0);
        let other = full(rng, dim, 2, 0.0);
        let unloaded = Case { q: vec![0.0; dim * pairs], ..loaded };
        let settings = Settings::default();
        let monitor = &mut Monitor::new(&settings, None);
        let dense = FlexibilityProblem::from_flexibility(unloaded.data()).expect("valid data");
        let dense = solve_flexibility(&dense, &settings, Some(&start), monitor);
        let sparse = solve_by(&unloaded, &settings, Some(&start));
        // Beside an island that stays loaded.
        let order: Vec<usize> = (0..pairs + 2).collect();
        let both = together(&[unloaded, other], &order);
        let begin = [start, vec![0.0; 2 * dim]].concat();
        let beside = solve_by(&both, &settings, Some(&begin));
        for solution in [dense, sparse, beside].map(|solution| solution.expect("valid data")) {
            assert_eq!(solution.status, Status::Solved, "{round}: {}", solution.message);
            let forces = &solution.certificate.force[..dim * pairs];
            // Newton's method may halve a force until it underflows.
            assert!(largest(forces) < f64::MIN_POSITIVE, "{round}: {:e}", largest(forces));
        }
    }
    assert!(from_forces >= 150, "{from_forces}");
}

/// A definite `W` has a solution with any friction (Brouwer's theorem on the thresholds, which stay bounded), and of a pair
/// alone each is found, also where `W` ties its tangents to its normal so that it wedges.
#[test]
fn pairs_alone_are_solved_with_any_friction() {
    let rng = &mut Rng::with_seed(7);
    for dim in [2, 3] {
        let cases: Vec<Case> = (0..150).map(|_| full(rng, dim, 1, 5.0)).collect();
        let whole = together(&cases, &shuffled(rng, cases.len()));
        // `solved` judges the whole, whose loads may hide the error of one pair: each is judged by itself too.
        let solution = solved(&whole);
        let n = whole.q.len();
        for pair in 0..cases.len() {
            let own = dim * pair..dim * (pair + 1);
            let block = own.clone().flat_map(|j| own.clone().map(move |i| (i, j)));
            let w = block.map(|(i, j)| whole.w[i + n * j]).collect();
            let mut alone = Case::new(dim, w, whole.q[own.clone()].to_vec(), whole.mu[pair]);
            alone.gap[0] = whole.gap[pair];
            alone.slip0 = whole.slip0[(dim - 1) * pair..(dim - 1) * (pair + 1)].to_vec();
            let force = &solution.certificate.force[own.clone()];
            let error = alone.judged(&solution.d[own], force);
            // As in `solved`: 1e-10 of norms, and the judge's unit is up to twice the library's.
            assert!(error <= 1e-9, "pair {pair}: {error:e}");
        }
    }
}

#[test]
fn islands_of_low_rank_have_the_displacements_of_the_dense_form() {
    let rng = &mut Rng::with_seed(2);
    for round in 0..40 {
        let dim = 2 + round % 2;
        let islands = rng.usize(1..=5);
        let cases: Vec<Case> = (0..islands)
            .map(|_| {
                let pairs = rng.usize(1..=6);
                if rng.bool() { low_rank(rng, dim, pairs) } else { full(rng, dim, pairs, 0.0) }
            })
            .collect();
        let pairs = cases.iter().map(|case| case.gap.len()).sum();
        let whole = together(&cases, &shuffled(rng, pairs));
        let (sparse, dense) = (solved(&whole), whole.solved());
        let apart = largest(&difference(&sparse.d, &dense.d));
        // The energy of an error of 1e-10 is 1e-10 of that of the load at most: the root of it, and far less where
        // states are the same.
        assert!(apart <= 1e-8 * largest(&whole.q), "{apart:e}");
    }
}

#[test]
fn one_island_is_the_dense_problem() {
    let rng = &mut Rng::with_seed(3);
    for round in 0..20 {
        let dim = 2 + round % 2;
        let pairs = rng.usize(1..=8);
        let case = if round % 4 < 2 {
            full(rng, dim, pairs, 0.4)
        } else {
            Case { mu: vec![0.3; pairs], ..low_rank(rng, dim, pairs) }
        };
        let (sparse, dense) = (solve(&case), case.solve());
        assert_eq!(sparse.status, dense.status);
        // One method solves the same numbers; sums are taken in another order at the end.
        let size = largest(&dense.certificate.force);
        let apart = largest(&difference(&sparse.certificate.force, &dense.certificate.force));
        assert!(apart <= 1e-12 * size, "{apart:e}");
        assert!(largest(&difference(&sparse.d, &dense.d)) <= 1e-12 * largest(&dense.d));
        assert_eq!(sparse.iterations, dense.iterations);
        assert_eq!(sparse.factorisations, dense.factorisations);
    }
}

/// Two walls closer than a body: `p = (-1, -1)` moves nothing, and 0.1 - 0.2 < 0.
fn too_close() -> Case {
    let rows = [[0.5, 0.0], [0.0, 0.5], [-0.5, 0.0], [0.0, -0.5]].map(|row| row.to_vec());
    let mut case = Case::new(2, gram(&rows), vec![0.3, 0.1, -0.3, -0.1], 0.3);
    case.gap = vec![0.1, -0.2];
    case
}

#[test]
fn an_island_without_equilibrium_is_named_and_the_others_are_solved() {
    let rng = &mut Rng::with_seed(4);
    for at in 0..4 {
        let mut cases: Vec<Case> = (0..3).map(|_| full(rng, 2, 3, 0.0)).collect();
        cases.insert(at, too_close());
        let order = shuffled(rng, 11);
        let whole = together(&cases, &order);
        let solution = solve(&whole);
        assert_eq!(solution.status, Status::NoEquilibrium, "{}", solution.message);
        let mut closed = [order[3 * at], order[3 * at + 1]];
        closed.sort_unstable();
        let said = format!("the gaps of pairs {}, {} contradict each other", closed[0], closed[1]);
        assert!(solution.message.contains(&said), "{}", solution.message);
        let proof = solution.recession.as_ref().expect("a proof");
        for (i, p) in proof.iter().enumerate() {
            let presses = i % 2 == 0 && closed.contains(&(i / 2));
            assert!((p + f64::from(u8::from(presses))).abs() <= 1e-9, "p[{i}] is {p}");
        }
        // The library takes 1e-12 of the terms of W for its rounding.
        assert!(largest(&product(&whole.w, proof)) <= 1e-11);
        // The other islands are those of the whole without this one.
        cases.remove(at);
        let rest: Vec<usize> = (0..9).collect();
        let others = solved(&together(&cases, &rest));
        for k in 0..9 {
            let place = order[if k < 3 * at { k } else { k + 2 }];
            for i in 0..2 {
                let forces = (&solution.certificate.force, &others.certificate.force);
                let apart = (forces.0[2 * place + i] - forces.1[2 * k + i]).abs();
                assert!(apart <= 1e-9 * largest(forces.1).max(1.0), "pair {place}: {apart:e}");
            }
        }
    }
}

/// A node in a groove of half angle 20 degrees whose walls overlap it, as in `flexibility.rs`: with `tan a <= mu` no
/// forces lift it out. Nothing is proved, and the other islands are solved.
#[test]
fn an_island_that_wedges_is_named_and_the_others_are_solved() {
    let rng = &mut Rng::with_seed(10);
    let (sin, cos) = 20.0_f64.to_radians().sin_cos();
    let rows = [[cos, -sin], [sin, cos], [-cos, -sin], [sin, -cos]].map(|row| row.to_vec());
    let mut wedge = Case::new(2, gram(&rows), vec![0.0; 4], 1.1);
    wedge.gap.fill(-0.1);
    let mut case = full(rng, 2, 3, 0.0);
    case.mu.fill(0.0);
    let alone = case.solved();
    let whole = together(&[case, wedge], &[4, 1, 2, 3, 0]);
    let solution = solve(&whole);
    assert_eq!(solution.status, Status::Stalled, "{}", solution.message);
    let said = "pairs 0, 3 grow without end";
    assert!(solution.message.contains(said), "{}", solution.message);
    assert!(solution.message.contains("island of pairs 0, 3"), "{}", solution.message);
    for (k, place) in [4, 1, 2].into_iter().enumerate() {
        let forces = (&solution.certificate.force, &alone.certificate.force);
        let apart = difference(&forces.0[2 * place..2 * place + 2], &forces.1[2 * k..2 * k + 2]);
        assert!(largest(&apart) <= 1e-9 * largest(forces.1).max(1.0), "pair {place}: {apart:?}");
    }
}

/// Every way to store the matrix gives the same bits; stored zeros tie nothing.
#[test]
fn all_forms_of_the_matrix_are_one() {
    let rng = &mut Rng::with_seed(5);
    let cases = [full(rng, 3, 2, 0.2), full(rng, 3, 3, 0.2)];
    let case = together(&cases, &shuffled(rng, 5));
    let reference = solved(&case);
    for triangle in [Triangle::Lower, Triangle::Upper, Triangle::Full] {
        for base in [0, 1] {
            let stored = Stored::of(15, &case.w, triangle, base);
            let narrow = |values: &[i64]| values.iter().map(|i| *i as i32).collect::<Vec<i32>>();
            let (starts, rows) = (narrow(&stored.col_start), narrow(&stored.row));
            let narrow = SparseMatrix {
                col_start: Indices::Narrow(&starts),
                row: Indices::Narrow(&rows),
                ..stored.view()
            };
            for flexibility in [stored.view(), narrow] {
                let problem = FlexibilityProblem::from_sparse(FlexibilityData {
                    dim: 3,
                    pairs: 5,
                    flexibility,
                    free: &case.q,
                    gap: &case.gap,
                    law: FrictionLaw::Coulomb(&case.mu),
                    reference_slip: Some(&case.slip0),
                });
                let settings = Settings::default();
                let monitor = &mut Monitor::new(&settings, None);
                let problem = problem.expect("valid data");
                let same = solve_flexibility(&problem, &settings, None, monitor).unwrap();
                assert_eq!(same.certificate.force, reference.certificate.force);
                assert_eq!(same.d, reference.d);
            }
        }
    }
    let mut all = lower(&case);
    (all.row, all.values, all.col_start) = (vec![], vec![], vec![0]);
    for j in 0..15 {
        all.row.extend((j..15).map(|i| i as i64));
        all.values.extend((j..15).map(|i| case.w[i + 15 * j]));
        all.col_start.push(all.row.len() as i64);
    }
    let settings = Settings::default();
    let problem = problem(&case, &all).expect("valid data");
    let monitor = &mut Monitor::new(&settings, None);
    let same = solve_flexibility(&problem, &settings, None, monitor).unwrap();
    assert_eq!(same.certificate.force, reference.certificate.force);
}

/// A component that nothing moves, stored or not, and a pair that nothing moves at all: it keeps its gap without a
/// force, or no force can make it keep it.
#[test]
fn what_nothing_moves_keeps_its_gap_or_proves_that_nothing_does() {
    let mut case = Case::new(2, vec![0.0; 36], vec![0.4, 0.0, -0.1, 0.2, 0.3, 0.0], 0.5);
    (case.w[0], case.w[28]) = (2.0, 1.0);
    let solution = solved(&case);
    let expected = [-0.2, 0.0, 0.0, 0.0, -0.3, 0.0];
    assert!(largest(&difference(&solution.certificate.force, &expected)) <= 1e-9);
    assert_eq!(solution.d[2..4], [-0.1, 0.2]);
    case.q[2] = 0.1;
    let solution = solve(&case);
    assert_eq!(solution.status, Status::NoEquilibrium, "{}", solution.message);
    assert_eq!(solution.recession, Some(vec![0.0, 0.0, -1.0, 0.0, 0.0, 0.0]));
    assert_eq!(case.solve().status, Status::NoEquilibrium);
}

/// An island is solved to the tolerance beside its own forces, and the whole is certified: forces of one island are
/// 1e8 times those of another.
#[test]
fn islands_of_other_sizes_are_as_accurate() {
    let rng = &mut Rng::with_seed(6);
    for _ in 0..10 {
        let small = full(rng, 2, 4, 0.0);
        let mut large = full(rng, 2, 4, 0.0);
        let by = |values: &mut Vec<f64>, by: f64| values.iter_mut().for_each(|value| *value *= by);
        by(&mut large.w, 1e-8);
        let whole = together(&[small, large], &(0..8).collect::<Vec<_>>());
        let solution = solved(&whole);
        let part = Case::new(2, part(&whole, 0..8), whole.q[..8].to_vec(), 0.0);
        let part = Case { gap: whole.gap[..4].to_vec(), slip0: whole.slip0[..4].to_vec(), ..part };
        let alone = part.solved().certificate.force;
        let apart = largest(&difference(&solution.certificate.force[..8], &alone));
        assert!(apart <= 1e-9 * largest(&alone).max(1.0), "{apart:e}");
    }
}

fn part(case: &Case, range: std::ops::Range<usize>) -> Vec<f64> {
    let n = case.q.len();
    range.clone().flat_map(|j| range.clone().map(move |i| case.w[i + n * j])).collect()
}

#[test]
fn a_start_of_forces_is_taken() {
    let rng = &mut Rng::with_seed(7);
    let cases = [full(rng, 2, 4, 0.05), full(rng, 2, 3, 0.05)];
    let case = together(&cases, &shuffled(rng, 7));
    let first = solved(&case);
    let start = Some(&first.certificate.force[..]);
    let again = solve_by(&case, &Settings::default(), start).expect("valid data");
    assert_eq!(again.status, Status::Solved);
    assert!(again.iterations <= first.iterations);
    let wrong = solve_by(&case, &Settings::default(), Some(&[0.0; 3])).unwrap_err();
    assert!(wrong.message().contains("the start has 3 entries, it must have 14"));
}

/// The memory is that of the largest island, which the refusal names before any work.
#[test]
fn memory_is_that_of_the_largest_island() {
    let rng = &mut Rng::with_seed(8);
    let cases: Vec<Case> = [1, 2, 40, 2, 3].map(|pairs| full(rng, 2, pairs, 0.0)).into();
    let whole = together(&cases, &(0..48).collect::<Vec<_>>());
    let bytes = |case: &Case| {
        let stored = lower(case);
        memory_flexibility(&problem(case, &stored).expect("valid data"))
    };
    let (all, largest) = (bytes(&whole), bytes(&cases[2]));
    // The 16 unknowns of the others have 32 vectors and the copies of their triangles, of 2, 4, 4 and 6 rows.
    assert_eq!(all - largest, 32 * 8 * 16 + 16 * (3 + 10 + 10 + 21));
    let limited = |memory_limit| Settings { memory_limit, ..Settings::default() };
    let within = solve_by(&whole, &limited(all), None).expect("memory enough");
    assert_eq!(within.status, Status::Solved, "{}", within.message);
    let refused = solve_by(&whole, &limited(all - 1), None).unwrap_err();
    assert!(matches!(refused, Error::Stopped { limit: Limit::Memory, .. }), "{refused}");
    let said = "the largest island has 40 pairs: 3, 4, 5, 6, ...";
    assert!(refused.message().contains(said), "{refused}");
}

#[test]
fn a_call_that_is_stopped_keeps_what_is_solved() {
    let rng = &mut Rng::with_seed(9);
    // The largest first, which is solved last.
    let cases: Vec<Case> = [9, 4, 4, 4, 4, 5].map(|pairs| full(rng, 2, pairs, 0.3)).into();
    let whole = together(&cases, &(0..30).collect::<Vec<_>>());
    let all = solved(&whole).iterations;
    let settings = Settings { max_iterations: all / 2, ..Settings::default() };
    let solution = solve_by(&whole, &settings, None).expect("valid data");
    assert_eq!(solution.status, Status::IterationLimit, "{}", solution.message);
    assert!(solution.message.contains("of 6 islands are solved"), "{}", solution.message);
    assert!(solution.iterations <= all / 2);
    assert!(solution.certificate.force[18..26].iter().any(|force| *force != 0.0));
    assert!(solution.certificate.force[..18].iter().all(|force| *force == 0.0));
    assert_eq!(solution.d[..18], whole.q[..18]);
    let mut calls = 0;
    let mut cancel = |_: &signorini::Progress| {
        calls += 1;
        std::ops::ControlFlow::Break(())
    };
    let settings = Settings::default();
    let stored = lower(&whole);
    let problem = problem(&whole, &stored).expect("valid data");
    let monitor = &mut Monitor::new(&settings, Some(&mut cancel));
    let solution = solve_flexibility(&problem, &settings, None, monitor).unwrap();
    assert_eq!(solution.status, Status::Cancelled, "{}", solution.message);
    assert_eq!(calls, 1, "a callback that has cancelled is not asked again");
}

#[test]
fn what_no_sparse_flexibility_has_is_refused() {
    let sound = || {
        let w = [2.0, 0.5, 0.0, 0.0, 0.5, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0];
        let case = Case::new(2, w.to_vec(), vec![0.4, 0.0, 0.3, 0.1], 0.3);
        let stored = Stored::of(4, &case.w, Triangle::Full, 0);
        (case, stored)
    };
    type Change<'a> = &'a dyn Fn(&mut Case, &mut Stored);
    let wrong: [(Change<'_>, &str); 18] = [
        (&|_, w| w.values[1] = 0.25, "W is not symmetric: W[1,0] is 0.25, W[0,1] is 0.5"),
        (&|_, w| w.values[2] = f64::NAN, "W[0,1] is not finite"),
        (&|_, w| w.values[3] = -1.0, "W[1,1] is -1, it must be positive"),
        (&|_, w| w.values[3] = 0.0, "W[1,1] is 0, it must be positive"),
        (
            &|_, w| (w.values[1], w.values[2]) = (3.0, 3.0),
            "W is not positive semi-definite: W[1,0] is 3, more than its diagonal allows",
        ),
        (&|_, w| w.values.fill(0.0), "W is zero: no contact force moves anything"),
        (&|_, w| w.row[5] = 4, "row[5], in column 3, is 4"),
        (&|_, w| w.row[1] = -1, "row[1], in column 0, is -1"),
        (&|_, w| w.row[1] = 0, "row 0 is listed twice"),
        (&|_, w| w.row.swap(0, 1), "row indices must be strictly ascending"),
        (&|_, w| w.triangle = Triangle::Lower, "W[0,1] is not in the triangle that was named"),
        (&|_, w| w.base = 1, "col_start[0] is 0, but index_base is 1"),
        (&|_, w| w.col_start[2] = 1, "col_start must not descend"),
        (&|_, w| w.col_start.truncate(4), "col_start has 4 entries"),
        (&|_, w| *w = Stored::of(2, &[1.0, 0.0, 0.0, 1.0], Triangle::Full, 0), "W: size is 2"),
        (&|case, _| case.q.truncate(3), "q has 3 entries, it must have 4"),
        (&|case, _| case.q[1] = f64::INFINITY, "q[1] is not finite"),
        (&|case, _| case.gap[1] = f64::NAN, "gap[1] is NaN"),
    ];
    for (change, said) in wrong {
        let (mut case, mut stored) = sound();
        change(&mut case, &mut stored);
        let message = problem(&case, &stored).map(drop).unwrap_err().message().to_string();
        assert!(message.contains(said), "{said}: {message}");
    }
    // Each block of two is allowed, all three together are not; the island is the second one.
    let n = 6;
    let mut case = Case::new(2, vec![0.0; n * n], vec![0.3; n], 0.0);
    (0..n).for_each(|i| case.w[i * (n + 1)] = 1.0);
    for (i, j) in [(2, 3), (3, 4), (2, 4)] {
        (case.w[i + n * j], case.w[j + n * i]) = (-0.9, -0.9);
    }
    let refused = solve_by(&case, &Settings::default(), None).unwrap_err().message().to_string();
    assert!(refused.contains("W is not positive semi-definite"), "{refused}");
    assert!(refused.contains("island of pairs 1, 2"), "{refused}");
    let lemke = Settings { method: Method::Lemke, ..Settings::default() };
    let (case, _) = sound();
    let case =
        Case::new(3, vec![1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0], case.q[..3].into(), 0.3);
    assert!(solve_by(&case, &lemke, None).is_err());
}

#[test]
fn nothing_is_solved_by_nothing() {
    let solution = solve(&Case::new(3, vec![], vec![], 0.0));
    assert_eq!(solution.status, Status::Solved);
    assert!(solution.d.is_empty());
}
