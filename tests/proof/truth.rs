//! Enclosures hold the truth: of all laws, at the edges of doubles, in all units; and what a result says of its
//! errors is true.

use crate::common::edges::{CLASSES, problem};
use crate::common::exact::{force, parts, quads, refined, states};
use crate::common::problems::{Case, Law, uniform};
use crate::common::proofs::{JUDGE, assert_holds, middle, proof_of, random, size, solved};
use crate::common::quad::Quad;
use fastrand::Rng;
use signorini::certificate::{Proof, certify, prove};
use signorini::{
    ContactData, ContactProblem, Existence, FrictionLaw, Method, Monitor, Settings, Solution,
    State, Status,
};

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

/// Ellipses of any axes at any angle, by both rules: what is proved is what the natural map of the law says, which
/// knows nothing of frozen pieces. Condition numbers of 100 leave some 1e-13 of rounding.
#[test]
fn turned_ellipses_are_enclosed_as_their_law_says() {
    let mut rng = Rng::with_seed(15);
    let (mut tried, mut proved, mut slips) = (0, 0, 0);
    for number in 0..150 {
        let case = random(&mut rng, 3, 1e2, 1.0);
        let axes = |rng: &mut Rng| {
            [uniform(rng, 0.05, 0.8), uniform(rng, 0.05, 0.8), uniform(rng, -4.0, 4.0)]
        };
        let numbers: Vec<f64> = (0..case.pairs).flat_map(|_| axes(&mut rng)).collect();
        for law in [FrictionLaw::Orthotropic(&numbers), FrictionLaw::OrthotropicCollinear(&numbers)]
        {
            let (solution, proof) = solve_under(&case, law, &case.f);
            if solution.status != Status::Solved {
                continue;
            }
            tried += 1;
            let Some(proof) = proof else { continue };
            proved += 1;
            let states = &solution.certificate.states;
            slips += states.iter().filter(|state| **state == State::Slip).count();
            let data = ContactData { law, ..case.data() };
            let certificate = certify(&ContactProblem::new(data).unwrap(), &proof.d);
            assert!(certificate.eta <= 1e-12, "{number}: {certificate:?}");
            let forces = size(&case.f).max(size(&proof.force));
            for (a, b) in certificate.force.iter().zip(&proof.force) {
                assert!((a - b).abs() <= 1e-11 * forces, "{number}: {a} {b}");
            }
        }
    }
    println!("{proved} of {tried} proved, {slips} slips");
    assert!(100 * proved >= 99 * tried && tried > 250 && slips > 100);
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
        let middle = middle(&proof);
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
    for seed in 0..1200 {
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
        let middle = middle(&proof);
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
            let [mu, cohesion, _] = case.law.of(pair);
            let is_smooth = mu == 0.0 && cohesion == 0.0 && *told == State::Slip;
            assert!(
                found == told || is_smooth && *found == State::Stick,
                "{seed}: {found:?} {told:?}"
            );
        }
    }
    for (class, [solved, proved]) in counts.iter().enumerate() {
        println!("{}: {proved} of {solved} proved", CLASSES[class].0);
        assert!(class >= ORDINARY || 100 * proved >= 99 * solved);
    }
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
