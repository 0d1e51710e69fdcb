//! Proofs that a solution exists: they succeed on ordinary problems, and fail on falsified states, at boundaries
//! of states, and where the equations are singular.

use crate::bar::{Top, bar_with_top};
use crate::common::brick::{Brick, Support};
use crate::common::exact::states;
use crate::common::problems::{Case, Law, decades};
use crate::common::proofs::{assert_holds, proof_of, random, size, solved};
use fastrand::Rng;
use signorini::certificate::{Proof, prove};
use signorini::{Settings, State};

const STATES: [State; 3] = [State::Open, State::Slip, State::Stick];

/// The goal is 99 %. Radii: the condition number, 1e4 at most, times some hundred roundings.
#[test]
fn ordinary_problems_are_proved_and_enclosed() {
    for dim in [2, 3] {
        let mut rng = Rng::with_seed(7);
        let (mut tried, mut proved) = (0, 0);
        for number in 0..500 {
            let condition = decades(&mut rng, 4.0);
            let case = random(&mut rng, dim, condition, 1.5);
            let Some(solution) = solved(&case) else { continue };
            tried += 1;
            let Some(proof) = proof_of(&case, &solution) else { continue };
            proved += 1;
            let context = format!("{dim}D {number}");
            let exact = assert_holds(&case, &proof, &context);
            assert_eq!(states(&case, &exact), solution.certificate.states, "{context}");
            assert!(size(&proof.d_radius) <= 1e-10 * size(&proof.d), "{context}");
            let forces = size(&case.f).max(size(&proof.force));
            assert!(size(&proof.force_radius) <= 1e-10 * forces, "{context}");
        }
        println!("{dim}D: {proved} of {tried} proved");
        assert!(100 * proved >= 99 * tried && tried > 450);
    }
}

/// With another state of one pair nothing is proved, unless it is the state of another solution.
#[test]
fn falsified_states_are_not_proved() {
    let mut rng = Rng::with_seed(8);
    let (mut tried, mut others) = (0, 0);
    for number in 0..400 {
        let dim = rng.usize(2..4);
        let case = random(&mut rng, dim, 1e3, 1.5);
        let Some(solution) = solved(&case) else { continue };
        let problem = case.problem();
        let first = proof_of(&case, &solution);
        for pair in 0..case.pairs {
            for state in STATES {
                let mut falsified = solution.certificate.states.clone();
                if falsified[pair] == state {
                    continue;
                }
                falsified[pair] = state;
                tried += 1;
                let Some(proof) = prove(&problem, &solution.d, &falsified) else { continue };
                others += 1;
                let exact = assert_holds(&case, &proof, &format!("{dim}D {number}, pair {pair}"));
                assert_eq!(states(&case, &exact), falsified);
                let first = first.as_ref().expect("the solution itself is proved");
                let apart: Vec<f64> = first.d.iter().zip(&proof.d).map(|(a, b)| a - b).collect();
                assert!(size(&apart) > size(&first.d_radius) + size(&proof.d_radius));
            }
        }
    }
    println!("{tried} falsified, {others} of them the states of another solution");
    assert!(tried > 2000 && 200 * others < tried);
}

/// The bar of the paper and blocks in space, of hundreds of pairs; and nothing with a pair turned.
#[test]
fn structures_are_proved() {
    let mut cases = Vec::new();
    for (pairs, top) in [(33, Top::Pressed), (129, Top::Pressed), (65, Top::Clamped(0.1))] {
        let bar = bar_with_top(pairs - 1, 10, 1.5, 10.0, top);
        cases.extend([0.0, 0.3, 1.0, 3.0].map(|mu| Case {
            dim: 2,
            pairs: bar.pairs,
            k: bar.stiffness.clone(),
            f: bar.load.clone(),
            gap: vec![0.0; bar.pairs],
            law: Law::Coulomb(vec![mu; bar.pairs]),
            slip: None,
        }));
    }
    let brick = Brick::new([5, 5, 3], [1.0, 1.0, 0.5], Support::Clamped);
    let model = brick.model();
    for mu in [0.0, 0.2, 0.6] {
        let motion = |[x, y, _]: [f64; 3]| [0.004 - 0.02 * y, 0.003 + 0.02 * x, 0.05 * x - 0.01];
        cases.push(brick.case(&model, motion, mu));
    }
    for (number, case) in cases.iter().enumerate() {
        let solution = solved(case).expect("it is solved");
        assert!(proof_of(case, &solution).is_some(), "{number}");
        for pair in [0, case.pairs / 2, case.pairs - 1] {
            for state in STATES {
                let mut falsified = solution.certificate.states.clone();
                if falsified[pair] != state {
                    falsified[pair] = state;
                    let proof = prove(&case.problem(), &solution.d, &falsified);
                    assert!(proof.is_none(), "{number}: pair {pair} {state:?}");
                }
            }
        }
    }
}

/// One pair of the unit stiffness: `d = f` where it is open, `F = -f` where it sticks.
fn single(dim: usize, f: &[f64], gap: f64, mu: f64) -> Case {
    let mut k = vec![0.0; dim * dim];
    (0..dim).for_each(|i| k[i * (dim + 1)] = 1.0);
    let law = Law::Coulomb(vec![mu]);
    Case { dim, pairs: 1, k, f: f.to_vec(), gap: vec![gap], law, slip: None }
}

/// A gap that just closes, friction that is just enough, a slip of zero length; and next to them.
#[test]
fn at_a_boundary_nothing_is_proved() {
    let any = |case: &Case, d: &[f64]| {
        STATES.into_iter().find(|state| prove(&case.problem(), d, &[*state]).is_some())
    };
    let closes = |load: f64| single(2, &[load, 0.25], 0.5, 0.5);
    assert_eq!(any(&closes(0.5), &[0.5, 0.25]), None);
    assert_eq!(any(&closes(0.5_f64.next_down()), &[0.5, 0.25]), Some(State::Open));
    assert_eq!(any(&closes(1.5), &[0.5, 0.0]), Some(State::Stick));
    let pushed = |side: f64| single(2, &[1.0, side], 0.0, 0.5);
    assert_eq!(any(&pushed(0.5), &[0.0, 0.0]), None);
    assert_eq!(any(&pushed(0.5 - 1e-13), &[0.0, 0.0]), Some(State::Stick));
    assert_eq!(any(&pushed(0.5 + 1e-13), &[0.0, 1e-13]), Some(State::Slip));
    let in_space = |part: f64| single(3, &[1.0, 0.3 * part, 0.4 * part], 0.0, 0.5);
    assert_eq!(any(&in_space(1.0), &[0.0; 3]), None);
    assert_eq!(any(&in_space(1.0 - 1e-12), &[0.0; 3]), Some(State::Stick));
    assert_eq!(any(&in_space(1.0 + 1e-9), &[0.0, 3e-10, 4e-10]), Some(State::Slip));
}

/// Klarbring's pair, `K = [[2, 1], [1, 1]]`, `f = (1, 1.5)`, mu 2, has three solutions in closed form
/// (Ingenieur-Archiv 60 (1990) 529-541); the sliding one has a determinant below zero.
#[test]
fn each_of_several_solutions_is_proved() {
    let case = Case {
        dim: 2,
        pairs: 1,
        k: vec![2.0, 1.0, 1.0, 1.0],
        f: vec![1.0, 1.5],
        gap: vec![0.0],
        law: Law::Coulomb(vec![2.0]),
        slip: None,
    };
    let known = [([-0.5, 2.0], State::Open), ([0.0, 0.5], State::Slip), ([0.0, 0.0], State::Stick)];
    for (d, state) in known {
        let near = d.map(|d| d * (1.0 + 1e-3));
        let proof = prove(&case.problem(), &near, &[state]).expect("it is a solution");
        let about = proof.radius_about(&d);
        assert!(about.iter().all(|&radius| radius <= 1e-14), "{about:?}");
        let about = proof.radius_about(&near);
        assert!(about.iter().zip(near).all(|(radius, near)| *radius >= 0.0009 * near.abs()));
    }
}

/// A body that rolls freely along the plane: no equation tells where it is. Pushed, it has no solution.
#[test]
fn what_is_singular_is_not_proved() {
    let k = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -1.0, 0.0, 0.0, 1.0, 0.0, 0.0, -1.0, 0.0, 1.0];
    for side in [0.0, 0.1] {
        let f = vec![1.0, side, 1.0, 0.0];
        let law = Law::Coulomb(vec![0.0; 2]);
        let gap = vec![0.0; 2];
        let case = Case { dim: 2, pairs: 2, k: k.to_vec(), f, gap, law, slip: None };
        let states = [State::Slip; 2];
        assert!(prove(&case.problem(), &[0.0; 4], &states).is_none());
    }
}

/// Friction along a slip, not against it: a pair on unit stiffness with the bound 0.3 under a load 0.1 would slip
/// by -0.2, and is in equilibrium with the force -0.3. It sticks. Under the load 0.5 it slips by 0.2.
#[test]
fn friction_along_its_slip_is_no_solution() {
    for dim in [2, 3] {
        let k = (0..dim * dim).map(|i| if i % (dim + 1) == 0 { 1.0 } else { 0.0 }).collect();
        let vector = |[n, t]: [f64; 2]| [&[n, t], &[0.0][..dim - 2]].concat();
        let (gap, law) = (vec![0.0], Law::Coulomb(vec![0.3]));
        let mut case = Case { dim, pairs: 1, k, f: vector([1.0, 0.1]), gap, law, slip: None };
        let backwards = prove(&case.problem(), &vector([0.0, -0.2]), &[State::Slip]);
        assert!(backwards.is_none(), "{dim}: {backwards:?}");
        assert!(prove(&case.problem(), &vector([0.0, 0.0]), &[State::Stick]).is_some());
        case.f = vector([1.0, 0.5]);
        assert!(prove(&case.problem(), &vector([0.0, 0.2]), &[State::Slip]).is_some());
    }
}

/// The distance to other displacements counts what rounding has left out of the proved ones.
#[test]
fn a_radius_about_other_displacements_counts_both_parts() {
    let (unit, low) = (2_f64.powi(-53), 2_f64.powi(-54));
    let proof = Proof {
        d: vec![1.0; 3],
        d_low: vec![low, low, -low],
        d_radius: vec![unit, 0.0, 0.0],
        force: vec![0.0; 3],
        force_radius: vec![0.0; 3],
    };
    let about = proof.radius_about(&[1.0, 1.0 - unit, 1.0 - unit]);
    // A radius is rounded up by some units in its last digit.
    for (radius, exact) in about.iter().zip([unit + low, unit + low, unit - low]) {
        assert!(*radius >= exact && *radius <= exact * (1.0 + 1e-12), "{about:?}");
    }
}

/// Errors are relative: lengths and forces in other units do not change them.
#[test]
fn proved_errors_have_no_unit() {
    let mut rng = Rng::with_seed(14);
    let mut proved = 0;
    for number in 0..50 {
        let dim = rng.usize(2..4);
        let case = random(&mut rng, dim, 1e2, 0.5);
        let errors = |length: f64, unit: f64| {
            let by = |values: &[f64], unit: f64| values.iter().map(|v| v * unit).collect();
            let other = Case {
                k: by(&case.k, unit / length),
                f: by(&case.f, unit),
                gap: by(&case.gap, length),
                slip: case.slip.as_ref().map(|slip| by(slip, length)),
                law: match case.law {
                    Law::Tresca(_) => case.law.with(by(case.law.values(), unit)),
                    _ => case.law.clone(),
                },
                ..case.clone()
            };
            let solution = other.solve(&Settings { proof: true, ..Settings::default() });
            solution.errors.map(|errors| [errors.d, errors.force])
        };
        let Some(one) = errors(1.0, 1.0) else { continue };
        proved += 1;
        for (length, unit) in [(2_f64.powi(30), 2_f64.powi(-20)), (2_f64.powi(-40), 2_f64.powi(50))]
        {
            let other = errors(length, unit).unwrap_or_else(|| panic!("{number}: not proved"));
            // Powers of two change no digit, but units of unknowns are roots of stiffnesses.
            for (one, other) in one.iter().zip(other) {
                // Next to nothing where all pairs stick and the answer is exact.
                let (one, other) = (one.max(1e-300), other.max(1e-300));
                assert!(other <= 4.0 * one && one <= 4.0 * other, "{number}: {one:e} {other:e}");
            }
        }
    }
    assert!(proved > 40, "{proved}");
}

/// The solution of `m d = 1` is no double; the proof tells it in two parts, and encloses it to twice the precision: `16 (n + 4)²`
/// roundings of 2^-106, here 576, are counted for each of both terms, and ten thousand are more than they become.
#[test]
fn what_is_no_double_is_enclosed_in_twice_the_precision() {
    for m in [3.0, 7.0, 49.0, 1e3 + 1.0] {
        let (k, f, gap) = (vec![m, 0.0, 0.0, m], vec![1.0, 1.0], vec![f64::INFINITY]);
        let case = Case { dim: 2, pairs: 1, k, f, gap, law: Law::Coulomb(vec![0.5]), slip: None };
        let proof = prove(&case.problem(), &[1.0 / m; 2], &[State::Open]).expect("a proof");
        assert_holds(&case, &proof, &format!("{m}"));
        assert!(size(&proof.d_radius) <= 1e4 * 2_f64.powi(-106) / m, "{m}: {proof:?}");
    }
}
