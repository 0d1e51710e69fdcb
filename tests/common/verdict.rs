//! Answers judged by the enumeration of all states.

use fastrand::Rng;
use signorini::{Monitor, Settings, Solution, Status};

use super::measures::{eta, flaw_of_escape, motion, rounding};
use super::oracle::Enumeration;
use super::problems::{Case, vector};

/// The verdict on an answer; a wrong one panics.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    Solved,
    NoEquilibrium,
    /// The library gave up and says so.
    Unsolved {
        solvable: bool,
    },
}

/// Judges an answer to a 2D problem of few pairs; what is wrong with it, if anything.
pub fn judge(case: &Case, solution: &Solution, tolerance: f64) -> Result<Verdict, String> {
    let enumeration = Enumeration::new(case);
    let solvable = enumeration.solutions().next().is_some();
    match solution.status {
        Status::Solved => {
            let residual = eta(case, &solution.d);
            if residual > tolerance + rounding(case, &solution.d) {
                return Err(format!("'solved' with a residual of {residual:e}"));
            }
            let found = enumeration.identify(&solution.d, tolerance);
            if found.is_empty() {
                return Err("'solved', but it is none of the solutions".into());
            }
            if let [only] = &found[..]
                && only.strict
            {
                let states: Vec<_> = only.piece.local.iter().map(|local| local.state()).collect();
                if states != solution.certificate.states {
                    return Err(format!("the states are {states:?}"));
                }
            }
            Ok(Verdict::Solved)
        }
        Status::NoEquilibrium => match flaw_of_escape(case, motion(solution)) {
            Some(flaw) => Err(format!("its motion of escape proves nothing: {flaw}")),
            None if solvable => Err("'no equilibrium', but there is one".into()),
            None => Ok(Verdict::NoEquilibrium),
        },
        Status::Stalled | Status::IterationLimit => Ok(Verdict::Unsolved { solvable }),
        other => Err(format!("no reason to end with {other:?}")),
    }
}

/// Solves `count` problems and judges the answers, which `allowed` may restrict further.
/// Returns how many were unsolved although they have a solution.
pub fn run(
    count: u64,
    settings: Settings,
    make: impl Fn(&mut Rng) -> Case,
    allowed: impl Fn(Verdict) -> bool,
) -> usize {
    let mut unsolved = 0;
    for seed in 0..count {
        let mut rng = Rng::with_seed(seed);
        let case = make(&mut rng);
        let start = rng.bool().then(|| vector(&mut rng, case.size()));
        let mut monitor = Monitor::new(&settings, None);
        let solution =
            signorini::solve(&case.problem(), &settings, start.as_deref(), &mut monitor).unwrap();
        let verdict = judge(&case, &solution, settings.tolerance);
        let fine = verdict.as_ref().is_ok_and(|&verdict| allowed(verdict));
        assert!(fine, "seed {seed}: {verdict:?}\n{case:?}\n{start:?}\n{solution:?}");
        unsolved += usize::from(verdict == Ok(Verdict::Unsolved { solvable: true }));
    }
    unsolved
}
