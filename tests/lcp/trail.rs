//! Cycles of a path of Lemke's method, found by the file that looks for them.

#[path = "../../src/solve/lcp/lemke/trail.rs"]
mod bases;

use bases::Trail;

#[test]
fn a_cycle_is_found() {
    let mut trail = Trail::new();
    assert!((0..10).all(|k| !trail.returns_by(k + 1, k)));
    // Three exchanges that end where they began.
    let mut cycle = [(20, 1), (30, 20), (1, 30)].into_iter().cycle();
    assert!((0..40).any(|_| cycle.next().is_some_and(|(a, b)| trail.returns_by(a, b))));
}
