//! Random problems at the edges of double precision, judged in twice the precision by code that shares
//! nothing with the library.
//!
//! `SIGNORINI_JUDGED=1000000 cargo test --release --test families -- judged:: --nocapture` judges as many;
//! `SIGNORINI_JUDGED_FROM=2000000` begins at another seed than 0, and `SIGNORINI_JUDGED_SEED=17` prints the problem of one
//! seed and what is said of it.

use crate::common::all_states::all_solutions;
use crate::common::dense::largest;
use crate::common::edges::{CLASSES, Problem, problem, problem_among};
use crate::common::exact::{UNIT, differ, eta, force, quads, refined, scale, states};
use crate::common::judge::{Answer, FAULTS, Fault, Faults, Finding, judge, without_answer};
use crate::common::problems::{Case, Law};
use crate::common::quad::Quad;
use signorini::{ContactProblem, Model, Monitor, Search, Settings, Solution, Status, Uniqueness};

/// How many problems without the variable: 200 of each class in each dimension.
const PROBLEMS: u64 = 9600;

/// Problems of a long run between two tables.
const BETWEEN_PRINTS: u64 = 100_000;

fn number(name: &str) -> Option<u64> {
    std::env::var(name).ok().map(|text| text.parse().expect("a number"))
}

/// The class of which a host makes models, as the header says: the flat call takes what rounding leaves on
/// the diagonal of a free body as it is.
const ON_FEW_POINTS: usize = 8;

/// The class of bodies that nothing but contact with cohesion holds.
const COHESIVE_BODIES: usize = 15;

/// A problem whose matrix is that of a model, which knows it without the rounding of rigid motions. Without
/// the error `E` of the given one, `(1 - V V') (K + E) (1 - V V') = K`: the change is `2 |E|` at most, and
/// `|E|` is at most `n` times its largest entry; the motions `V` of `K + E` are those of `K` turned by as much again.
fn of_model(problem: &Problem) -> Result<Problem, String> {
    let data = problem.case.data();
    let model = Model::condensed(data.dim, data.pairs, data.stiffness, data.ld)
        .map_err(|error| format!("{error:?}"))?;
    let n = data.dim * data.pairs;
    let error = problem.noise + UNIT * largest(data.stiffness);
    let change = data.stiffness.iter().zip(model.stiffness()).map(|(given, k)| (given - k).abs());
    let change = change.fold(0.0, f64::max);
    if change > 4.0 * n as f64 * error {
        return Err(format!("a model changes K by {change:.1e}, its error is {error:.1e}"));
    }
    let mut of_model = problem.clone();
    of_model.case.k = model.stiffness().to_vec();
    Ok(of_model)
}

/// The problem that is solved, and what is said of it.
fn answered(problem: &Problem) -> (Problem, Result<Solution, String>) {
    if problem.class != ON_FEW_POINTS {
        return (problem.clone(), solve_by_default(problem));
    }
    match of_model(problem) {
        Ok(of_model) => {
            let answer = solve_by_default(&of_model);
            (of_model, answer)
        }
        Err(why) => (problem.clone(), Err(why)),
    }
}

fn solve_by_default(problem: &Problem) -> Result<Solution, String> {
    let settings = Settings {
        tolerance: problem.tolerance,
        search: if problem.search { Search::Others } else { Search::Off },
        ..Settings::default()
    };
    let checked = ContactProblem::new(problem.case.data()).map_err(|error| format!("{error:?}"))?;
    signorini::solve(&checked, &settings, None, &mut Monitor::new(&settings, None))
        .map_err(|error| format!("{error:?}"))
}

/// The false statements of an answer, or that there is none.
fn faults(problem: &Problem, answer: &Result<Solution, String>) -> Faults {
    match answer {
        Err(why) => vec![Finding { fault: Fault::Refused, size: 1.0, text: why.clone() }],
        Ok(solution) => judge(problem, &Answer::new(solution), problem.tolerance),
    }
}

/// How many of the `PROBLEMS` of a class may still be judged so, in the plane and in space; no others. Lower a number as
/// soon as the library allows it. They have a quarter and three in reserve, as rounding differs from machine to machine.
const STILL: [(&str, Fault, [u64; 2]); 3] = [
    ("definite, condition 1e3 to 1e15", Fault::Unsolved, [5, 15]),
    ("definite, condition 1e3 to 1e15", Fault::UnsolvedTo1e12, [0, 4]),
    ("soft springs beside stiff ones, to 1e-15", Fault::Unsolved, [38, 42]),
];

/// Part of the problems of a long run that may have no answer, of those with a definite matrix by its condition; beyond
/// 1e12 nothing is asked.
const UNSOLVED: [(Fault, f64); 3] =
    [(Fault::UnsolvedRegular, 1e-4), (Fault::UnsolvedTo1e12, 1e-2), (Fault::Unsolved, 1.0)];

/// Counts of one class in one dimension.
#[derive(Default)]
struct Row {
    problems: u64,
    solved: u64,
    no_equilibrium: u64,
    unique: u64,
    several: u64,
    /// Problems by what it means that they have no answer, as in `UNSOLVED`.
    answerable: [u64; 3],
    faults: [u64; FAULTS.len()],
    /// The worst of each fault: how bad it is, and how to see it again.
    worst: [(f64, String); FAULTS.len()],
}

impl Row {
    fn add(&mut self, seed: u64, given: &Problem) {
        let (problem, answer) = answered(given);
        let faults = faults(&problem, &answer);
        self.problems += 1;
        for ((kind, _), count) in UNSOLVED.iter().zip(&mut self.answerable) {
            *count += u64::from(*kind == without_answer(&problem.case));
        }
        if let Ok(Solution { status, uniqueness, .. }) = answer {
            self.solved += u64::from(status == Status::Solved);
            self.no_equilibrium += u64::from(status == Status::NoEquilibrium);
            self.unique += u64::from(uniqueness == Uniqueness::Unique);
            self.several += u64::from(uniqueness == Uniqueness::Several);
        }
        for (at, fault) in FAULTS.iter().enumerate() {
            let Some(found) = faults.iter().find(|found| found.fault == *fault) else { continue };
            self.faults[at] += 1;
            if self.faults[at] == 1 || found.size > self.worst[at].0 {
                let Problem { case, tolerance, .. } = &problem;
                let what = format!("{} pairs, tolerance {tolerance:.0e}", case.pairs);
                let line =
                    format!("SIGNORINI_JUDGED_SEED={seed}: {what}: {fault:?}: {}", found.text);
                self.worst[at] = (found.size, line);
            }
        }
    }
}

fn print(rows: &[Row]) {
    println!("Columns: {FAULTS:?}");
    let mut total = [0; FAULTS.len()];
    for (at, row) in rows.iter().enumerate() {
        let (name, _) = CLASSES[at % CLASSES.len()];
        let Row { problems, solved, no_equilibrium, unique, several, faults, .. } = row;
        let ends = format!("{solved} solved, {no_equilibrium} without equilibrium");
        let counts = format!("{problems}: {ends}, {unique} unique, {several} several");
        println!("{}D {name}: {counts}\n    {faults:?}", 2 + at / CLASSES.len());
        let worst = row.worst.iter().filter(|(_, line)| !line.is_empty());
        worst.for_each(|(_, line)| println!("  {line}"));
        total.iter_mut().zip(faults).for_each(|(total, count)| *total += count);
    }
    println!("All: {total:?}");
    for (kind, (fault, _)) in UNSOLVED.iter().enumerate() {
        println!("{fault:?}: {} of {}", count(rows, *fault), answerable(rows, kind));
    }
}

fn answerable(rows: &[Row], kind: usize) -> u64 {
    rows.iter().map(|row| row.answerable[kind]).sum()
}

fn count(rows: &[Row], fault: Fault) -> u64 {
    let at = FAULTS.iter().position(|other| *other == fault).unwrap();
    rows.iter().map(|row| row.faults[at]).sum()
}

/// The short run keeps the limits above; the long one asks for the goal, that nothing is false.
#[test]
fn nothing_false_is_said() {
    if let Some(seed) = number("SIGNORINI_JUDGED_SEED") {
        let (problem, answer) = answered(&problem(seed));
        println!("{problem:?}\n{answer:?}\n{:?}", faults(&problem, &answer));
        return;
    }
    let long = number("SIGNORINI_JUDGED");
    let mut rows: Vec<Row> = (0..2 * CLASSES.len()).map(|_| Row::default()).collect();
    let from = number("SIGNORINI_JUDGED_FROM").unwrap_or(0);
    for seed in from..from + long.unwrap_or(PROBLEMS) {
        rows[seed as usize % (2 * CLASSES.len())].add(seed, &problem(seed));
        if (seed + 1) % BETWEEN_PRINTS == 0 {
            println!("{} problems", seed + 1 - from);
            print(&rows);
        }
    }
    print(&rows);
    let mut wrong = Vec::new();
    for (at, row) in rows.iter().enumerate() {
        let (name, _) = CLASSES[at % CLASSES.len()];
        for (fault, &count) in FAULTS.iter().zip(&row.faults) {
            let still = STILL.iter().find(|(class, kind, _)| *class == name && kind == fault);
            let of_long_run = long.is_some() && UNSOLVED.iter().any(|(kind, _)| kind == fault);
            let limit = if long.is_some() {
                0
            } else {
                still.map_or(0, |still| still.2[at / CLASSES.len()])
            };
            if count > limit && !of_long_run {
                let dim = 2 + at / CLASSES.len();
                wrong.push(format!("{dim}D {name}: {count} times {fault:?}, allowed {limit}"));
            }
        }
    }
    for (kind, &(fault, part)) in UNSOLVED.iter().enumerate() {
        let (count, all) = (count(&rows, fault), answerable(&rows, kind));
        if long.is_some() && count as f64 > part * all as f64 {
            wrong.push(format!("{count} times {fault:?} of {all}, allowed a part of {part:.0e}"));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// Problems of a long run of twelve classes of which "several" was said with a second answer that is next to no solution:
/// at a coarse tolerance, and beside springs of 8e-14.
#[test]
fn answers_next_to_no_solution_are_no_second_one() {
    for seed in [230_271, 414_145, 43_013] {
        let (problem, answer) = answered(&problem_among(seed, 12));
        assert!(faults(&problem, &answer).is_empty(), "seed {seed}: {answer:?}");
    }
}

/// Problems of long runs in which a pair without an obstacle moves against the others as the body turns, one in which
/// another pair would approach as one is lifted, three whose pairs slide, so that the least lift
/// alone leaves an approach, and two of which a pair nearly rests.
/// The motion that proves that there is no equilibrium is lifted off the obstacles that there are, and approaches none, not
/// by 1e-11, nor by what is left where rounding of the motions contradicts itself.
#[test]
fn motions_are_lifted_off_the_obstacles_that_there_are() {
    let of_long_runs = [
        (19, &[333_484, 399_557, 76_367, 175_518][..]),
        (24, &[349_486, 224_686, 24_999, 40_942, 52_782, 85_671, 106_663]),
    ];
    for (classes, seed) in
        of_long_runs.into_iter().flat_map(|(n, s)| s.iter().map(move |&s| (n, s)))
    {
        let (problem, answer) = answered(&problem_among(seed, classes));
        assert!(faults(&problem, &answer).is_empty(), "seed {seed}: {answer:?}");
    }
}

/// Problems of long runs: a residual that meets the tolerance by less than its own rounding, and a pair whose cohesion is
/// `mu` times its tension but for rounding, so that the bound of its friction is zero in doubles alone.
#[test]
fn a_residual_is_not_above_the_reported_one() {
    for (seed, classes) in [(202_871, 22), (164_607, 24)] {
        let (problem, answer) = answered(&problem_among(seed, classes));
        assert!(faults(&problem, &answer).is_empty(), "{answer:?}");
    }
}

/// Bodies that cohesion holds, at coarse tolerances, and one of a long run: a pair far from its obstacle was told to carry
/// the tension alone, and the friction of the pressure that it lost was without balance.
#[test]
fn loads_are_balanced_to_a_coarse_tolerance() {
    let class = COHESIVE_BODIES as u64;
    let bodies = (0..400).map(|k| class + k * CLASSES.len() as u64);
    for (seed, tolerance) in
        bodies.flat_map(|seed| [(seed, 0.1), (seed, 0.03)]).chain([(665_319, 0.1)])
    {
        let problem = Problem { tolerance, ..problem(seed) };
        let (problem, answer) = answered(&problem);
        let found = faults(&problem, &answer);
        assert!(found.is_empty(), "seed {seed}, tolerance {tolerance}: {found:?}");
    }
}

/// A problem of a long run of twenty-two classes of which a path leaves displacements that are no numbers. The last
/// iterate beside the proof that there is no equilibrium has numbers.
#[test]
fn displacements_that_are_no_numbers_are_not_returned() {
    let (problem, answer) = answered(&problem_among(899_111, 22));
    assert!(faults(&problem, &answer).is_empty(), "{answer:?}");
}

/// Sums, products, quotients and roots of twice the precision against integers of 100 bits, which are
/// exact.
#[test]
fn the_judges_numbers_have_thirty_digits() {
    let mut rng = fastrand::Rng::with_seed(1);
    let quad = |x: i128| Quad::sum((x >> 50 << 50) as f64, (x - (x >> 50 << 50)) as f64);
    for _ in 0..1000 {
        let mut some = || rng.i128(-(1 << 99)..1 << 99);
        let (a, b) = (some(), some());
        let sum = quad(a) + quad(b) - quad(a + b);
        assert!(sum.abs().value() <= (a + b).abs() as f64 * 1e-31, "{a} + {b}");
        let back = quad(a) * quad(b) / quad(b) - quad(a);
        assert!(back.abs().value() <= a.abs() as f64 * 1e-30, "{a} * {b} / {b}");
        let root = quad(a.abs()).sqrt();
        assert!(
            (root * root - quad(a.abs())).abs().value() <= a.abs() as f64 * 1e-30,
            "root of {a}"
        );
        let small = (a >> 50, b >> 50);
        let product = quad(small.0) * quad(small.1) - quad(small.0 * small.1);
        assert_eq!(product.value(), 0.0, "{small:?}");
    }
}

/// An exact answer, rounded, has no fault but that its residual is not the zero that it reports; with
/// one state turned, one force changed, a displacement moved, or the words "unique" and "no
/// equilibrium" in the wrong place, it has.
#[test]
fn the_judge_finds_what_is_falsified() {
    let mut examined = 0;
    for seed in (0..PROBLEMS).filter(|seed| seed % CLASSES.len() as u64 == 0).take(100) {
        let problem = problem(seed);
        let case = &problem.case;
        let Ok(solution) = solve_by_default(&problem) else { continue };
        let Some(exact) = refined(case, &quads(&solution.d), None) else { continue };
        let rounded = |values: &[Quad]| values.iter().map(|x| x.value()).collect::<Vec<f64>>();
        let (d, now) = (rounded(&exact), states(case, &exact));
        let mut forces = rounded(&force(case, &exact));
        // A rest of a zero counts for nothing: with it no law would be obeyed.
        let scale = scale(case, &quads(&forces)).value();
        forces
            .iter_mut()
            .filter(|force| force.abs() < 1e-25 * scale)
            .for_each(|force| *force = 0.0);
        let given = Answer::new(&solution);
        let true_eta = eta(case, &quads(&d));
        let answer = |d: &[f64], forces: &[f64], status: Status, eta: f64| {
            let mut answer = Answer { d: quads(d), status, eta, ..Answer::new(&solution) };
            (answer.uniqueness, answer.second) = (Uniqueness::NotKnown, None);
            let answer = Answer { force: forces, states: &now, equilibrium: 1.0, ..answer };
            judge(&problem, &answer, problem.tolerance)
        };
        // Zero displacements are not moved by a factor.
        let at_rest = d.iter().all(|d| *d == 0.0);
        if at_rest || differ(case, &given.d, &exact) || true_eta > problem.tolerance {
            continue;
        }
        examined += 1;
        let has = |faults: &Faults, fault| faults.iter().any(|found| found.fault == fault);
        let clean = answer(&d, &forces, Status::Solved, true_eta);
        assert!(clean.is_empty(), "seed {seed}: {clean:?}");
        let most = (0..d.len()).max_by(|&a, &b| d[a].abs().total_cmp(&d[b].abs())).unwrap();
        let mut moved = d.clone();
        moved[most] *= 1.0 + 1e4 * UNIT;
        let faults = answer(&moved, &forces, Status::Solved, true_eta);
        assert!(has(&faults, Fault::BeyondRounding), "seed {seed}: {faults:?}");
        let mut pulled = forces.clone();
        pulled[0] += 1e-6 * (1.0 + pulled[0].abs());
        let faults = answer(&d, &pulled, Status::Solved, true_eta);
        assert!(has(&faults, Fault::Forces), "seed {seed}: {faults:?}");
        let faults = answer(&d, &forces, Status::NoEquilibrium, true_eta);
        assert!(has(&faults, Fault::WrongProof) && has(&faults, Fault::Motion), "seed {seed}");
        let faults = answer(&d, &forces, Status::Stalled, true_eta);
        assert!(has(&faults, Fault::UnsolvedRegular), "seed {seed}");
    }
    assert!(examined > 50, "{examined}");
}

/// Klarbring's pair, `K = [[2, 1], [1, 1]]`, `f = (1, 1.5)`: three solutions with `mu = 2`, one with 0.9
/// (A. Klarbring, Ingenieur-Archiv 60 (1990) 529-541): open `(-0.5, 2)`, slipping `(0, 0.5)`, sticking.
#[test]
fn the_judge_counts_klarbrings_solutions() {
    for (mu, count) in [(2.0, 3), (0.9, 1)] {
        let case = Case {
            dim: 2,
            pairs: 1,
            k: vec![2.0, 1.0, 1.0, 1.0],
            f: vec![1.0, 1.5],
            gap: vec![0.0],
            law: Law::Coulomb(vec![mu]),
            slip: None,
        };
        let all = all_solutions(&case);
        assert!(all.solutions.len() == count && !all.singular);
        let (motions, tolerance) = (Vec::new(), 1e-10);
        let problem = Problem { class: 0, case, motions, noise: 0.0, tolerance, search: true };
        let solution = solve_by_default(&problem).unwrap();
        for (said, fault, wrong) in [
            (Uniqueness::Unique, Fault::Unique, count > 1),
            (Uniqueness::Several, Fault::Several, count == 1),
        ] {
            let answer = Answer { uniqueness: said, ..Answer::new(&solution) };
            let faults = judge(&problem, &answer, tolerance);
            assert_eq!(faults.iter().any(|found| found.fault == fault), wrong, "{faults:?}");
        }
        // Two copies of one solution are not two.
        let second = Some(quads(&solution.d));
        let answer = Answer { uniqueness: Uniqueness::Several, second, ..Answer::new(&solution) };
        let faults = judge(&problem, &answer, tolerance);
        assert!(faults.iter().any(|found| found.fault == Fault::Several), "{faults:?}");
    }
}
