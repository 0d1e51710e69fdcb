//! Lemke's method with friction, block pivoting and Newton's method, each alone, against the
//! enumeration of all states: 2D problems of up to four pairs.

use crate::common::problems::{coulomb, definite_case, floating_case, frictionless, tresca};
use crate::common::verdict::{Verdict, run};
use fastrand::Rng;
use signorini::{Method, Settings};

fn settings(method: Method, max_iterations: u64) -> Settings {
    Settings { method, max_iterations, ..Settings::default() }
}

/// Block pivoting flips what is infeasible, and single indices when that does not help, which is
/// finite for a definite `K` (Júdice and Pires, Computers & Operations Research 21 (1994) 587-596).
#[test]
fn block_pivoting_solves_every_definite_frictionless_problem() {
    let make = |rng: &mut Rng| definite_case(rng, 6.0, |_, pairs| frictionless(pairs));
    let solved = |verdict| verdict == Verdict::Solved;
    run(2000, settings(Method::BlockPivoting, 1000), make, solved);
    // Bodies that only contact holds meet singular systems: never wrong.
    let make = |rng: &mut Rng| floating_case(rng, 6.0, |_, pairs| frictionless(pairs));
    let unsolved = run(2000, settings(Method::BlockPivoting, 1000), make, |_| true);
    println!("{unsolved} of 2000 floating ones unsolved");
}

/// With a covering vector that presses and holds every pair a ray leaves no room: it would be a
/// motion `v` with `v.K v <= 0`. So Lemke's method solves every definite problem with friction.
#[test]
fn lemke_solves_every_definite_problem_with_law() {
    let make = |rng: &mut Rng| definite_case(rng, 6.0, |rng, pairs| coulomb(rng, pairs, 5.0));
    run(2000, settings(Method::Lemke, 10_000), make, |verdict| verdict == Verdict::Solved);
    let make = |rng: &mut Rng| floating_case(rng, 6.0, |rng, pairs| coulomb(rng, pairs, 5.0));
    let unsolved = run(2000, settings(Method::Lemke, 10_000), make, |_| true);
    println!("{unsolved} of 2000 floating ones unsolved");
}

/// Newton's method has no such theorem: it is never wrong, and is the end of most problems.
#[test]
fn newton_is_never_wrong() {
    let high = |rng: &mut Rng| definite_case(rng, 6.0, |rng, pairs| coulomb(rng, pairs, 5.0));
    let unsolved = run(2000, settings(Method::Newton, 1000), high, |_| true);
    println!("{unsolved} of 2000 with high friction unsolved");
    assert!(unsolved <= 1000, "{unsolved} of 2000");
    let little = |rng: &mut Rng| definite_case(rng, 2.0, |rng, pairs| coulomb(rng, pairs, 0.3));
    let unsolved = run(2000, settings(Method::Newton, 1000), little, |_| true);
    println!("{unsolved} of 2000 with little friction unsolved");
    assert!(unsolved <= 100, "{unsolved} of 2000");
    let given = |rng: &mut Rng| definite_case(rng, 6.0, tresca);
    let unsolved = run(2000, settings(Method::Newton, 1000), given, |_| true);
    println!("{unsolved} of 2000 with given thresholds unsolved");
    let floating = |rng: &mut Rng| floating_case(rng, 6.0, |rng, pairs| coulomb(rng, pairs, 5.0));
    let unsolved = run(2000, settings(Method::Newton, 1000), floating, |_| true);
    println!("{unsolved} of 2000 floating ones unsolved");
}
