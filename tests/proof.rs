//! Proofs that a solution exists: they succeed on ordinary problems, hold the truth, and fail where they must.

mod common;

use common::exact::{quads, refined, states};
use common::problems::{Case, Law, decades, definite, uniform, vector};
use common::quad::Quad;
use fastrand::Rng;
use signorini::certificate::{Proof, prove};
use signorini::{Settings, State, Status};

const STATES: [State; 3] = [State::Open, State::Slip, State::Stick];

/// A problem with loads, gaps and slips of order 1.
fn random(rng: &mut Rng, dim: usize, condition: f64, most_mu: f64) -> Case {
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

fn solved(case: &Case) -> Option<signorini::Solution> {
    let solution = case.solve(&Settings::default());
    (solution.status == Status::Solved).then_some(solution)
}

/// Whether the exact solution is in the enclosure, by numbers of twice the precision.
fn assert_holds(case: &Case, proof: &Proof, context: &str) {
    let middle: Vec<Quad> =
        proof.d.iter().zip(&proof.d_low).map(|(&d, &low)| Quad::sum(d, low)).collect();
    let Some(exact) = refined(case, &middle, None) else { panic!("{context}: nothing near") };
    let force = common::exact::force(case, &exact);
    for i in 0..case.size() {
        let off = (exact[i] - middle[i]).abs().value();
        // The judge has 30 digits.
        let digits = 1e-25 * middle.iter().fold(0.0, |most: f64, d| most.max(d.value().abs()));
        assert!(
            off <= proof.d_radius[i] + digits,
            "{context}: d[{i}] {off:e} > {:e}",
            proof.d_radius[i]
        );
        let off = (force[i] - Quad::from(proof.force[i])).abs().value();
        let radius = proof.force_radius[i];
        assert!(off <= radius + 1e-25, "{context}: F[{i}] {off:e} > {radius:e}");
    }
}

#[test]
fn ordinary_problems_are_proved_and_enclosed() {
    for dim in [2, 3] {
        let mut rng = Rng::with_seed(7);
        let (mut tried, mut proved, mut worst, mut worst_force) = (0, 0, 0.0_f64, 0.0_f64);
        for number in 0..500 {
            let condition = decades(&mut rng, 4.0);
            let case = random(&mut rng, dim, condition, 1.5);
            let Some(solution) = solved(&case) else { continue };
            tried += 1;
            let Some(proof) = prove(&case.problem(), &solution.d, &solution.certificate.states)
            else {
                println!(
                    "{dim}D {number}: not proved, condition {condition:e}, {:?}",
                    solution.certificate.states
                );
                continue;
            };
            proved += 1;
            let context = format!("{dim}D {number}");
            assert_holds(&case, &proof, &context);
            assert_eq!(states(&case, &quads(&proof.d)), solution.certificate.states, "{context}");
            let size = |v: &[f64]| v.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
            worst = worst.max(size(&proof.d_radius) / size(&proof.d));
            worst_force =
                worst_force.max(size(&proof.force_radius) / size(&case.f).max(size(&proof.force)));
        }
        println!("{dim}D: {proved} of {tried} proved, radius {worst:e}, of forces {worst_force:e}");
        assert!(100 * proved >= 99 * tried && tried > 450);
    }
}

/// Another state of one pair: proved only if it is the state of another solution.
#[test]
fn falsified_states_are_not_proved() {
    let mut rng = Rng::with_seed(8);
    let (mut tried, mut others) = (0, 0);
    for number in 0..400 {
        let dim = rng.usize(2..4);
        let case = random(&mut rng, dim, 1e3, 1.5);
        let Some(solution) = solved(&case) else { continue };
        for pair in 0..case.pairs {
            for state in STATES {
                let mut falsified = solution.certificate.states.clone();
                if falsified[pair] == state {
                    continue;
                }
                falsified[pair] = state;
                tried += 1;
                if let Some(proof) = prove(&case.problem(), &solution.d, &falsified) {
                    others += 1;
                    println!("{dim}D {number}, pair {pair}: {state:?}, {:?}", case.law);
                    assert_holds(&case, &proof, "another solution");
                    assert_eq!(states(&case, &quads(&proof.d)), falsified);
                }
            }
        }
    }
    println!("{tried} falsified, {others} of them another solution");
}
