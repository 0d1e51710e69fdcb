//! Proofs that a solution exists: they succeed on ordinary problems, hold the truth, and fail where they must.
//! The truth is a solution in twice the precision (`common::exact`), which shares nothing with the library.

mod common;
#[path = "bench/bar.rs"]
mod generator;

use common::brick::{Brick, Support};
use common::edges::{CLASSES, problem};
use common::exact::{force, parts, quads, refined, states};
use common::problems::{Case, Law, decades, definite, uniform, vector};
use common::quad::Quad;
use fastrand::Rng;
use generator::{Top, bar_with_top};
use signorini::certificate::{Proof, prove};
use signorini::{
    ContactData, ContactProblem, Existence, FrictionLaw, Method, Monitor, Settings, Solution,
    State, Status,
};

const STATES: [State; 3] = [State::Open, State::Slip, State::Stick];

/// Digits of the judge: 31, less what sums and the solution of systems cost.
const JUDGE: f64 = 1e-26;

/// Loads, gaps and slips of order 1.
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

fn solved(case: &Case) -> Option<Solution> {
    let solution = case.solve(&Settings::default());
    (solution.status == Status::Solved).then_some(solution)
}

fn proof_of(case: &Case, solution: &Solution) -> Option<Proof> {
    prove(&case.problem(), &solution.d, &solution.certificate.states)
}

fn size(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most: f64, value| most.max(value.abs()))
}

/// The exact solution, which must be in the enclosure.
fn assert_holds(case: &Case, proof: &Proof, context: &str) -> Vec<Quad> {
    let middle: Vec<Quad> =
        proof.d.iter().zip(&proof.d_low).map(|(&d, &low)| Quad::sum(d, low)).collect();
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

/// From a condition number of 1e12 on proofs may fail, and hold the truth where they do not. The judge
/// solves systems to 31 digits less those of the condition number.
#[test]
fn ill_conditioned_problems_are_not_proved_wrongly() {
    let mut rng = Rng::with_seed(9);
    for number in 0..300 {
        let dim = rng.usize(2..4);
        let condition = 10_f64.powf(uniform(&mut rng, 12.0, 18.0));
        let case = random(&mut rng, dim, condition, 1.0);
        let Ok(problem) = ContactProblem::new(case.data()) else { continue };
        let solution = case.solve(&Settings::default());
        let Some(proof) = prove(&problem, &solution.d, &solution.certificate.states) else {
            continue;
        };
        let middle: Vec<Quad> =
            proof.d.iter().zip(&proof.d_low).map(|(&d, &low)| Quad::sum(d, low)).collect();
        let exact = refined(&case, &middle, Some(&solution.certificate.states));
        let exact = exact.unwrap_or_else(|| panic!("{number}: nothing near"));
        for i in 0..case.size() {
            let off = (exact[i] - middle[i]).abs().value();
            let radius = proof.d_radius[i] + condition * JUDGE * size(&proof.d);
            assert!(off <= radius, "{number}: d[{i}] {off:e} > {radius:e}");
        }
    }
}

/// Problems at the edges of doubles: whatever is proved holds the truth, and has its states; the ordinary classes
/// are proved. A pair that touches without friction is said to slip, whether it moves or not.
#[test]
fn proofs_at_the_edges_hold_the_truth() {
    const ORDINARY: usize = 3;
    let mut counts = [[0; 2]; CLASSES.len()];
    for seed in 0..2400 {
        let at_edge = problem(seed);
        let case = &at_edge.case;
        let Ok(checked) = ContactProblem::new(case.data()) else { continue };
        let solution = case.solve(&Settings { tolerance: 1e-10, ..Settings::default() });
        if solution.status != Status::Solved {
            continue;
        }
        let count = &mut counts[at_edge.class];
        count[0] += 1;
        let told = &solution.certificate.states;
        let Some(proof) = prove(&checked, &solution.d, told) else { continue };
        count[1] += 1;
        let middle: Vec<Quad> =
            proof.d.iter().zip(&proof.d_low).map(|(&d, &low)| Quad::sum(d, low)).collect();
        let exact = refined(case, &middle, None).or_else(|| refined(case, &middle, Some(told)));
        let exact = exact.unwrap_or_else(|| panic!("{seed}: nothing near"));
        let (forces, terms) = (force(case, &exact), parts(case, &exact));
        for i in 0..case.size() {
            let off = (exact[i] - middle[i]).abs().value();
            // The judge's digits less those of condition numbers up to 1e15, of a few unknowns.
            let digits = 1e-24 * size(&proof.d);
            assert!(off <= proof.d_radius[i] + digits, "{seed}: d[{i}] {off:e}");
            let off = (forces[i] - Quad::from(proof.force[i])).abs().value();
            let digits = JUDGE * (terms[i] + size(&proof.force));
            assert!(off <= proof.force_radius[i] + digits, "{seed}: F[{i}] {off:e}");
        }
        for (pair, (found, told)) in states(case, &exact).iter().zip(told).enumerate() {
            let slips = *told == State::Slip && case.law.values()[pair] == 0.0;
            assert!(found == told || slips && *found == State::Stick, "{seed}: {found:?} {told:?}");
        }
    }
    for (class, [solved, proved]) in counts.iter().enumerate() {
        println!("{}: {proved} of {solved} proved", CLASSES[class].0);
        assert!(class >= ORDINARY || 100 * proved >= 99 * solved);
    }
}

/// Data that a problem is solved with under another law, which is the same one there.
fn solve_under(case: &Case, law: FrictionLaw<'_>, f: &[f64]) -> (Solution, Option<Proof>) {
    let data = ContactData { law, load: f, ..case.data() };
    let problem = ContactProblem::new(data).expect("the data is valid");
    let settings = Settings::default();
    let solution =
        signorini::solve(&problem, &settings, None, &mut Monitor::new(&settings, None)).unwrap();
    let proof = prove(&problem, &solution.d, &solution.certificate.states);
    (solution, proof)
}

/// Cohesion `b = mu a` with the tension `a` is Coulomb's law under `f_n + a`, with `F_n - a`: exactly, where
/// the sums are. An ellipse with two equal coefficients is Coulomb's disc, whatever its angle.
#[test]
fn all_laws_are_proved_and_hold_the_truth_of_coulombs() {
    let mut rng = Rng::with_seed(10);
    let (mut tried, mut proved) = (0, 0);
    for number in 0..200 {
        let dim = rng.usize(2..4);
        let mut case = random(&mut rng, dim, 1e3, 1.0);
        // Loads of 12 binary digits, coefficients and tensions of one: b = mu a and f + a are exact.
        case.f.iter_mut().for_each(|f| *f = (*f * 4096.0).round() / 4096.0);
        let mu = 0.25;
        case.law = Law::Coulomb(vec![mu; case.pairs]);
        let tension = 0.5;
        let shifted: Vec<f64> = (0..case.size())
            .map(|i| if i % dim == 0 { case.f[i] - tension } else { case.f[i] })
            .collect();
        let numbers = [mu, mu * tension, tension].repeat(case.pairs);
        let mut check = |law: FrictionLaw<'_>, f: &[f64], tension: f64| {
            let (solution, proof) = solve_under(&case, law, f);
            if solution.status != Status::Solved {
                return;
            }
            tried += 1;
            let Some(mut proof) = proof else { return };
            proved += 1;
            for (force, radius) in proof.force.iter_mut().zip(&mut proof.force_radius).step_by(dim)
            {
                // F_n - a is rounded here.
                (*force, *radius) = (*force - tension, *radius + 1e-15);
            }
            assert_holds(&case, &proof, &format!("{number}"));
        };
        check(FrictionLaw::Cohesive(&numbers), &shifted, tension);
        if dim == 3 {
            let angle = uniform(&mut rng, -4.0, 4.0);
            let numbers = [mu, mu, angle].repeat(case.pairs);
            check(FrictionLaw::Orthotropic(&numbers), &case.f, 0.0);
            check(FrictionLaw::OrthotropicCollinear(&numbers), &case.f, 0.0);
        }
    }
    println!("{proved} of {tried} proved");
    assert!(100 * proved >= 99 * tried && tried > 300);
}

/// The associated ellipse with the axes `t1` and `t2` and the coefficients `mu` and `mu / 2` is Coulomb's law in
/// `(tau_1, 2 tau_2)` and `(delta_1, delta_2 / 2)`: exactly, as the factors are powers of two.
#[test]
fn an_ellipse_is_enclosed_as_the_disc_that_it_is() {
    let mut rng = Rng::with_seed(11);
    let (mut tried, mut proved) = (0, 0);
    for number in 0..100 {
        let mut case = random(&mut rng, 3, 1e2, 1.0);
        let mu: Vec<f64> = (0..case.pairs).map(|_| uniform(&mut rng, 0.1, 1.0)).collect();
        case.law = Law::Coulomb(mu.clone());
        // Forces of the case are 1 or 2 times those of the ellipse, displacements 1 or 1 / 2 times.
        let factor = |i: usize| if i % 3 == 2 { 2.0 } else { 1.0 };
        let n = case.size();
        let mut k = case.k.clone();
        for j in 0..n {
            for i in 0..n {
                k[i + n * j] /= factor(i) * factor(j);
            }
        }
        let f: Vec<f64> = (0..n).map(|i| case.f[i] / factor(i)).collect();
        let slip = case.slip.as_ref().map(|slip| {
            slip.iter().enumerate().map(|(i, s)| s * factor(3 * (i / 2) + 1 + i % 2)).collect()
        });
        let ellipse = Case { k, f, slip, ..case.clone() };
        let numbers: Vec<f64> = mu.iter().flat_map(|mu| [*mu, mu / 2.0, 0.0]).collect();
        let (solution, proof) =
            solve_under(&ellipse, FrictionLaw::Orthotropic(&numbers), &ellipse.f);
        if solution.status != Status::Solved {
            continue;
        }
        tried += 1;
        let Some(mut proof) = proof else { continue };
        proved += 1;
        for i in 0..n {
            let factor = factor(i);
            for d in [&mut proof.d, &mut proof.d_low, &mut proof.d_radius] {
                d[i] /= factor;
            }
            for force in [&mut proof.force, &mut proof.force_radius] {
                force[i] *= factor;
            }
        }
        assert_holds(&case, &proof, &format!("{number}"));
    }
    assert!(100 * proved >= 99 * tried && tried > 90, "{proved} of {tried}");
}

/// Units of length and force by powers of two, far apart: the same proof.
#[test]
fn proofs_do_not_depend_on_units() {
    let mut rng = Rng::with_seed(12);
    for number in 0..50 {
        let dim = rng.usize(2..4);
        let mut case = random(&mut rng, dim, 1e3, 1.0);
        case.law = Law::Coulomb(case.law.values().to_vec());
        let Some(solution) = solved(&case) else { continue };
        let Some(proof) = proof_of(&case, &solution) else { continue };
        for (length, unit) in
            [(2_f64.powi(200), 2_f64.powi(-150)), (2_f64.powi(-180), 2_f64.powi(300))]
        {
            let by =
                |values: &[f64], unit: f64| values.iter().map(|v| v * unit).collect::<Vec<_>>();
            let other = Case {
                k: by(&case.k, unit / length),
                f: by(&case.f, unit),
                gap: by(&case.gap, length),
                slip: case.slip.as_ref().map(|slip| by(slip, length)),
                ..case.clone()
            };
            let states = &solution.certificate.states;
            let scaled = prove(&other.problem(), &by(&solution.d, length), states);
            let scaled = scaled.unwrap_or_else(|| panic!("{number}: not proved"));
            let about = scaled.radius_about(&by(&proof.d, length));
            let most = 2.0 * size(&proof.d_radius) + f64::EPSILON * size(&proof.d);
            assert!(size(&about) <= 2.0 * most * length, "{number}");
        }
    }
}

/// Asked for in the settings: the result is the middle of the enclosure, with proved errors, from a method
/// that ends far from rounding.
#[test]
fn a_result_is_proved_on_request() {
    let mut rng = Rng::with_seed(13);
    let mut proved = 0;
    for _ in 0..100 {
        let dim = rng.usize(2..4);
        let case = random(&mut rng, dim, 1e2, 0.5);
        let rough = Settings { method: Method::SorNested, tolerance: 1e-7, ..Settings::default() };
        let plain = case.solve(&rough);
        assert!(matches!(plain.existence, Existence::NotAsked));
        let solution = case.solve(&Settings { proof: true, ..rough });
        let Existence::Proved(proof) = &solution.existence else { continue };
        proved += 1;
        let exact = assert_holds(&case, proof, "on request");
        let errors = solution.errors.expect("they are proved");
        let off: Vec<f64> = exact
            .iter()
            .zip(&solution.d)
            .map(|(exact, d)| (*exact - Quad::from(*d)).value())
            .collect();
        assert!(size(&off) <= errors.d * size(&solution.d) && errors.d < 1e-11, "{errors:?}");
        let radius = proof.radius_about(&solution.d);
        let digits = 1e4 * JUDGE * size(&proof.d);
        assert!(off.iter().zip(radius).all(|(off, radius)| off.abs() <= radius + digits));
        let forces = force(&case, &exact);
        let radius = proof.force_radius_about(&solution.certificate.force);
        for i in 0..case.size() {
            let off = (forces[i] - Quad::from(solution.certificate.force[i])).abs().value();
            assert!(off <= radius[i] + JUDGE, "{off:e} {radius:?}");
        }
        assert_eq!(states(&case, &quads(&solution.d)).len(), case.pairs);
    }
    assert!(proved >= 97, "{proved}");
    // No solution, no proof.
    let mut free = single(2, &[-1.0, 0.0], 0.0, 0.0);
    free.k = vec![1.0, -1.0, -1.0, 1.0];
    let none = free.solve(&Settings { proof: true, ..Settings::default() });
    assert!(none.status == Status::Solved || matches!(none.existence, Existence::NotProved));
}

/// Where a refinement ran, the errors that its contraction tells are those of the answer: of ill-conditioned
/// problems, which need one.
#[test]
fn refinement_tells_its_errors() {
    let mut rng = Rng::with_seed(14);
    let (mut told, mut held) = (0, 0);
    for _ in 0..300 {
        let dim = rng.usize(2..4);
        let condition = 10_f64.powf(uniform(&mut rng, 7.0, 11.0));
        let case = random(&mut rng, dim, condition, 1.0);
        let solution = case.solve(&Settings { tolerance: 1e-14, ..Settings::default() });
        let Some(errors) = solution.errors else { continue };
        let Some(exact) = refined(&case, &quads(&solution.d), None) else { continue };
        told += 1;
        let off = |(exact, d): (&Quad, &f64)| (*exact - Quad::from(*d)).value();
        let off: Vec<f64> = exact.iter().zip(&solution.d).map(off).collect();
        held += usize::from(size(&off) <= errors.d * size(&solution.d));
    }
    println!("{held} of {told} hold");
    assert!(told > 50 && 100 * held >= 99 * told);
}
