//! Random problems for proofs, and the truth that an enclosure must hold: a solution in twice the precision
//! (`exact`), which shares nothing with the library.

use fastrand::Rng;
use signorini::certificate::{Proof, prove};
use signorini::{Settings, Solution, Status};

use super::exact::{force, parts, refined};
use super::problems::{Case, Law, definite, uniform, vector};
use super::quad::Quad;

/// Digits of the judge: 31, less what sums and the solution of systems cost.
pub const JUDGE: f64 = 1e-26;

/// Loads, gaps and slips of order 1.
pub fn random(rng: &mut Rng, dim: usize, condition: f64, most_mu: f64) -> Case {
    let pairs = rng.usize(1..8);
    let n = dim * pairs;
    let numbers: Vec<f64> = (0..pairs).map(|_| uniform(rng, 0.0, most_mu)).collect();
    Case {
        dim,
        pairs,
        k: definite(rng, n, condition),
        f: vector(rng, n),
        gap: (0..pairs).map(|_| if rng.bool() { 0.0 } else { uniform(rng, -0.2, 1.0) }).collect(),
        law: if rng.u8(0..4) == 0 { Law::Tresca(numbers) } else { Law::Coulomb(numbers) },
        slip: rng.bool().then(|| vector(rng, n - pairs)),
    }
}

pub fn solved(case: &Case) -> Option<Solution> {
    let solution = case.solve(&Settings::default());
    (solution.status == Status::Solved).then_some(solution)
}

pub fn proof_of(case: &Case, solution: &Solution) -> Option<Proof> {
    prove(&case.problem(), &solution.d, &solution.certificate.states)
}

pub fn size(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most: f64, value| most.max(value.abs()))
}

/// The exact solution, which must be in the enclosure.
pub fn assert_holds(case: &Case, proof: &Proof, context: &str) -> Vec<Quad> {
    let middle = middle(proof);
    let exact = refined(case, &middle, None).unwrap_or_else(|| panic!("{context}: nothing near"));
    let (forces, terms) = (force(case, &exact), parts(case, &exact));
    let condition = 1e4; // of the problems that are judged by it, at most
    for i in 0..case.size() {
        let off = (exact[i] - middle[i]).abs().value();
        let radius = proof.d_radius[i] + condition * JUDGE * size(&proof.d);
        assert!(off <= radius, "{context}: d[{i}] {off:e} > {radius:e}");
        let off = (forces[i] - Quad::from(proof.force[i])).abs().value();
        let radius = proof.force_radius[i] + JUDGE * size(&terms);
        assert!(off <= radius, "{context}: F[{i}] {off:e} > {radius:e}");
    }
    exact
}

/// The middle of an enclosure of displacements.
pub fn middle(proof: &Proof) -> Vec<Quad> {
    proof.d.iter().zip(&proof.d_low).map(|(&d, &low)| Quad::sum(d, low)).collect()
}
