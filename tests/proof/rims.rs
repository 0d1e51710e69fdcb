//! Proofs where the truth is at the rim of what is said: forces off by half of their last digit, results that are not
//! solved, and forces too small to tell a state.

use crate::common::problems::{Case, Law};
use crate::common::proofs::random;
use fastrand::Rng;
use signorini::certificate::prove;
use signorini::{Existence, Method, Settings, State, Status};

/// Numbers below one are multiples of its inverse.
const ONE: i128 = 1 << 53;

fn number(whole: i128) -> f64 {
    whole as f64 / ONE as f64
}

/// Two pairs that stick at their gaps: `F = K d - f` has nothing to be solved for. Products of numbers with 53 digits
/// behind the point are whole multiples of 2^-106, and so is the exact force. The nearest double is off by up to half of
/// its last digit.
#[test]
fn forces_of_pairs_that_stick_are_enclosed_to_the_last_digit() {
    let rng = &mut Rng::with_seed(1);
    let mut at_the_rim = 0;
    for seed in 0..200 {
        let mut k = [0; 16];
        for (i, j) in (0..4).flat_map(|j| (j..4).map(move |i| (i, j))) {
            let entry = if i == j { rng.i128(ONE / 2..ONE) } else { rng.i128(-ONE / 8..ONE / 8) };
            (k[i + 4 * j], k[j + 4 * i]) = (entry, entry);
        }
        let gap = [(); 2].map(|()| rng.i128(0..ONE / 16));
        let d = [gap[0], 0, gap[1], 0];
        let push = |i: usize, rng: &mut Rng| match i % 2 {
            0 => rng.i128(ONE / 2..ONE),
            _ => rng.i128(-ONE / 8..ONE / 8),
        };
        let f = [0, 1, 2, 3].map(|i| push(i, rng));
        let case = Case {
            dim: 2,
            pairs: 2,
            k: k.map(number).to_vec(),
            f: f.map(number).to_vec(),
            gap: gap.map(number).to_vec(),
            law: Law::Coulomb(vec![2.0; 2]),
            slip: None,
        };
        let proof = prove(&case.problem(), &d.map(number), &[State::Stick; 2]).expect("it sticks");
        for i in 0..4 {
            let exact = (0..4).map(|j| k[i + 4 * j] * d[j]).sum::<i128>() - f[i] * ONE;
            // A double times a power of two is exact, and whole where it is not far below one.
            let stated = proof.force[i] * 2_f64.powi(106);
            assert_eq!(stated.fract(), 0.0, "seed {seed}");
            let off = (exact - stated as i128).unsigned_abs() as f64 * 2_f64.powi(-106);
            assert!(off <= proof.force_radius[i], "seed {seed}: {off:e} {:?}", proof.force_radius);
            at_the_rim += usize::from(off > 0.5 * proof.force_radius[i]);
        }
    }
    assert!(at_the_rim > 100, "{at_the_rim} of 800");
}

/// A proof is asked of solutions alone: of a result that has used up its sweeps nothing is said, though it may lie so near
/// that a proof would succeed.
#[test]
fn a_result_that_is_not_solved_is_not_proved() {
    let (mut ended, mut near) = (0, 0);
    let mut rng = Rng::with_seed(2);
    for _ in 0..40 {
        let case = random(&mut rng, 2, 1e2, 0.3);
        let settings = Settings {
            method: Method::SorNested,
            tolerance: 1e-12,
            max_iterations: 20,
            proof: true,
            ..Settings::default()
        };
        let solution = case.solve(&settings);
        if solution.status == Status::Solved {
            continue;
        }
        ended += 1;
        let is_near = prove(&case.problem(), &solution.d, &solution.certificate.states).is_some();
        near += usize::from(is_near);
        assert!(!matches!(solution.existence, Existence::Proved(_)));
        assert!(solution.errors.is_none());
    }
    assert!(near > 10, "{near} of {ended}");
}

/// Three pairs of which two are free and coupled to the second, which touches with a force of 2^-38 of the load. Sweeps to
/// a rough tolerance find a force there that is wrong by more and tells a state. That of the proved solution is too small
/// to tell one. The states of the result remain those that were proved.
#[test]
fn a_result_keeps_the_states_that_are_proved() {
    let (free, touching) = (-1.0, 2_f64.powi(-38));
    let mut told = 0;
    for (step, share) in (1..=60).flat_map(|step| [0.25, -0.25].map(|share| (step, share))) {
        let mut k = vec![0.0; 36];
        (0..6).for_each(|i| k[7 * i] = 1.0);
        for (i, j, entry) in [(0, 2, share), (2, 4, 0.25), (0, 4, 0.5)] {
            (k[i + 6 * j], k[j + 6 * i]) = (entry, entry);
        }
        let d = [free, 0.0, 0.0, 0.0, free, 0.0];
        let mut f: Vec<f64> = (0..6).map(|i| (0..6).map(|j| k[i + 6 * j] * d[j]).sum()).collect();
        f[2] += touching;
        let gap = vec![f64::INFINITY, 0.0, f64::INFINITY];
        let law = Law::Coulomb(vec![0.5; 3]);
        let case = Case { dim: 2, pairs: 3, k, f, gap, law, slip: None };
        let tolerance = 10_f64.powf(-1.0 - 0.1 * f64::from(step));
        let rough = Settings { method: Method::SorNested, tolerance, ..Settings::default() };
        let states = case.solve(&rough).certificate.states;
        let solution = case.solve(&Settings { proof: true, ..rough });
        let Existence::Proved(proof) = &solution.existence else { continue };
        if states[1] != State::Open {
            told += 1;
            assert!(proof.force[2] + proof.force_radius[2] < 0.0, "it touches");
            assert_eq!(solution.certificate.states, states, "{tolerance:e}");
        }
    }
    assert!(told > 10, "{told}");
}
