//! The certificate measures what its formulas say.

use crate::common::dense::{largest, norm, product};
use crate::common::measures::{eta, force, rounding};
use crate::common::problems::{
    Case, Law, add_spring, coulomb, decades, definite, floating, frictionless, loaded, tresca,
    vector,
};
use fastrand::Rng;
use signorini::State::{Open, Slip, Stick};
use signorini::certificate::{self, Certificate, certify};

fn measure(case: &Case, d: &[f64]) -> Certificate {
    certify(&case.problem(), d)
}

/// `eta` by the formulas of the module's documentation, at arbitrary candidates.
#[test]
fn eta_is_the_residual_of_the_natural_map() {
    for seed in 0..4000 {
        let mut rng = Rng::with_seed(seed);
        let (dim, pairs) = (rng.usize(2..=3), rng.usize(1..=6));
        let condition = decades(&mut rng, 6.0);
        let k = match dim == 2 && rng.bool() {
            true => floating(&mut rng, pairs, condition).0,
            false => definite(&mut rng, dim * pairs, condition),
        };
        let law = match rng.u8(0..3) {
            0 => coulomb(&mut rng, pairs, 5.0),
            1 => tresca(&mut rng, pairs),
            _ => frictionless(pairs),
        };
        let case = loaded(&mut rng, dim, k, law);
        let mut d = vector(&mut rng, case.size());
        // Some pairs at their reference slip, some gaps closed.
        for (i, d) in d.iter_mut().enumerate() {
            match (rng.bool(), i % dim) {
                (true, 0) => *d = d.min(case.gap[i / dim]),
                (true, c) => *d = case.rest(i / dim, c - 1),
                _ => {}
            }
        }
        let own = eta(&case, &d);
        let certificate = measure(&case, &d);
        let error = rounding(&case, &d) + 1e-14 * own;
        let range = own - error..=own + error;
        assert!(range.contains(&certificate.eta), "seed {seed}: {own}, {certificate:?}");
        let plain = certificate::eta(&case.problem(), &d, &force(&case, &d));
        assert!((plain - own).abs() <= error, "seed {seed}: {own}, {plain}");
    }
}

/// Solutions made from whole numbers: displacements and forces that obey the law are chosen, the
/// load is `K d - F`. Nothing rounds but lengths and shrinkage.
#[test]
fn exact_solutions_have_no_residual() {
    for seed in 0..2000 {
        let mut rng = Rng::with_seed(seed);
        let (dim, pairs) = (rng.usize(2..=3), rng.usize(1..=5));
        let n = dim * pairs;
        let mut k = vec![0.0; n * n];
        for i in 0..n {
            k[i + i * n] = 1.0;
        }
        for _ in 0..n {
            let strain: Vec<f64> = (0..n).map(|_| f64::from(rng.i32(-2..=2))).collect();
            add_spring(&mut k, &strain, 1.0);
        }
        let given = rng.bool();
        let (mut d, mut force, mut gap, mut slip) = (vec![], vec![], vec![], vec![]);
        let (mut bounds, mut states) = (vec![], vec![]);
        for _ in 0..pairs {
            let state = [Open, Slip, Stick][rng.usize(0..3)];
            let whole = |rng: &mut Rng| f64::from(rng.i32(1..=9));
            let rest: Vec<f64> = (1..dim).map(|_| whole(&mut rng) - 5.0).collect();
            let place = whole(&mut rng) - 5.0;
            // Lengths 5, 10, … of whole numbers; pressures that mu = 1/2 makes such.
            let direction = if dim == 2 { vec![5.0] } else { vec![-3.0, 4.0] };
            let (pressure, distance) = (10.0 * whole(&mut rng), whole(&mut rng));
            // A pair of given threshold may slip, or stick, without touching.
            let slides = if state == Open && given { rng.bool() } else { state == Slip };
            let bound = if state == Open && !given { 0.0 } else { 0.5 * pressure };
            let along = match (state, slides) {
                (Open, _) if !given => whole(&mut rng) - 5.0,
                (_, true) => distance,
                _ => 0.0,
            };
            let share = if slides { -bound / 5.0 } else { (bound / 5.0).floor() - 1.0 };
            let share = if bound == 0.0 { 0.0 } else { share };
            d.push(place);
            d.extend(rest.iter().zip(&direction).map(|(rest, e)| rest + along * e));
            slip.extend(rest);
            gap.push(if state == Open { place + distance } else { place });
            force.push(if state == Open { 0.0 } else { -pressure });
            force.extend(direction.iter().map(|e| share * e));
            bounds.push(if given { bound } else { 0.5 });
            states.push(state);
        }
        let f: Vec<f64> =
            product(&k, &d).iter().zip(&force).map(|(kd, force)| kd - force).collect();
        let law = if given { Law::Tresca(bounds) } else { Law::Coulomb(bounds) };
        let case = Case { dim, pairs, k, f, gap, law, slip: Some(slip) };
        let certificate = measure(&case, &d);
        let scale = largest(&force).max(1.0);
        let context = || format!("seed {seed}: {case:?}\n{d:?}\n{certificate:?}");
        assert!(certificate.eta <= 1e-14, "{}", context());
        assert_eq!(certificate.penetration, 0.0, "{}", context());
        assert_eq!(certificate.tension, 0.0, "{}", context());
        assert!(certificate.cone_excess <= 1e-14 * scale, "{}", context());
        assert!(certificate.equilibrium <= 1e-14 * scale, "{}", context());
        assert!(certificate.holds(1e-14), "{}", context());
        assert_eq!(certificate.states, states, "{}", context());
        let error: Vec<f64> = certificate.force.iter().zip(&force).map(|(a, b)| a - b).collect();
        assert!(norm(&error) <= 1e-14 * scale, "{}", context());
    }
}

/// One pair, `k_n = 4`, `k_t = 2`, gap 1, `mu = 1/2`, reference slip 3; the load that makes `force` of
/// `d`.
fn one_pair(d: [f64; 2], force: [f64; 2]) -> (Case, Vec<f64>) {
    let case = Case {
        dim: 2,
        pairs: 1,
        k: vec![4.0, 0.0, 0.0, 2.0],
        f: vec![4.0 * d[0] - force[0], 2.0 * d[1] - force[1]],
        gap: vec![1.0],
        law: Law::Coulomb(vec![0.5]),
        slip: Some(vec![3.0]),
    };
    (case, d.to_vec())
}

/// Every way to violate the law, one at a time: what is measured, and `|e|`, worked out by hand.
#[test]
fn each_violation_raises_its_own_measure() {
    let check = |d, force, residual: f64, expected: [f64; 4], state| {
        let (case, d) = one_pair(d, force);
        let certificate = measure(&case, &d);
        let scale = norm(&case.f).max(norm(&force));
        let measures = [
            certificate.eta * scale,
            certificate.penetration,
            certificate.tension,
            certificate.cone_excess,
            certificate.equilibrium,
        ];
        // Sums of a few numbers of order 10.
        let all = std::iter::once(&residual).chain(&expected);
        let agree = measures.iter().zip(all).all(|(a, b)| (a - b).abs() <= 1e-13);
        assert!(agree, "{d:?} {force:?}: {certificate:?}");
        assert_eq!(certificate.states, [state], "{d:?} {force:?}");
    };
    // None: stick; slip under F_t = -mu |F_n| sign(slip); open.
    check([1.0, 3.0], [-8.0, 1.0], 0.0, [0.0; 4], Stick);
    check([1.0, 4.0], [-8.0, -4.0], 0.0, [0.0; 4], Slip);
    check([-1.0, 4.0], [0.0, 0.0], 0.0, [0.0; 4], Open);
    // Penetration by 0.5: e_n = k_n 0.5.
    check([1.5, 3.0], [-8.0, 1.0], 2.0, [0.5, 0.0, 0.0, 0.0], Stick);
    // Tension 6, apart: e_n = 6; no force is left of it.
    check([-1.0, 3.0], [6.0, 0.0], 6.0, [0.0, 6.0, 0.0, 6.0], Open);
    // Tension 6, touching.
    check([1.0, 3.0], [6.0, 0.0], 6.0, [0.0, 6.0, 0.0, 6.0], Open);
    // Pressure 8 at a distance 1: e_n = -min(k_n, 8) = -4.
    check([0.0, 3.0], [-8.0, 0.0], 4.0, [0.0; 4], Stick);
    // Pressure 2 at a distance 1: e_n = -2; the pair counts as open, without force.
    check([0.0, 3.0], [-2.0, 0.0], 2.0, [0.0, 0.0, 0.0, 2.0], Open);
    // |F_t| = 7 without slip, bound 4: e_t = 3.
    check([1.0, 3.0], [-8.0, 7.0], 3.0, [0.0, 0.0, 3.0, 3.0], Slip);
    // Slip 1 against F_t = -7, bound 4: e_t = k_t 1 - (2 + 7 - 4) = -3.
    check([1.0, 4.0], [-8.0, -7.0], 3.0, [0.0, 0.0, 3.0, 3.0], Slip);
    // Slip 1 inside the cone, F_t = -3: the trial 2 + 3 = 5 exceeds 4 by 1; e_t = 2 - 1.
    check([1.0, 4.0], [-8.0, -3.0], 1.0, [0.0; 4], Slip);
    // Slip 1 along the force F_t = 4 instead of against it: trial 2 - 4 inside; e_t = 2.
    check([1.0, 4.0], [-8.0, 4.0], 2.0, [0.0; 4], Stick);
    // Tangential force 5 on an open pair: e_t = 2 * 1 - (2 * 1 - 5).
    check([-1.0, 4.0], [0.0, 5.0], 5.0, [0.0, 0.0, 5.0, 5.0], Open);
}

/// Forces far below the rounding of `K_tt` times the slip are measured all the same: at `d = 0`
/// nothing rounds. A tangential force along the slip instead of against it has `e_t = F_t + g`.
#[test]
fn forces_that_are_small_against_the_slip_are_still_measured() {
    for size in [1.0, 1e-10, 1e-20, 1e-30] {
        let case = |tangential: f64| Case {
            dim: 2,
            pairs: 1,
            k: vec![4.0, 0.0, 0.0, 2.0],
            f: vec![8.0 * size, -tangential * size],
            gap: vec![0.0],
            law: Law::Coulomb(vec![0.5]),
            slip: Some(vec![-10.0]),
        };
        let (right, wrong) = (case(-4.0), case(4.0));
        assert!(measure(&right, &[0.0; 2]).eta <= 1e-15, "{size}");
        let eta = measure(&wrong, &[0.0; 2]).eta;
        assert!((eta - 8.0 / 80_f64.sqrt()).abs() <= 1e-14, "{size}: {eta}");
    }
}

/// In 3D a tangential block `[[3, 1], [1, 3]]` has the largest eigenvalue 4.
#[test]
fn in_space_the_cone_is_round() {
    let check = |slip: [f64; 2], force: [f64; 2], residual: f64, excess: f64, state| {
        let k = vec![2.0, 0.0, 0.0, 0.0, 3.0, 1.0, 0.0, 1.0, 3.0];
        let d = vec![0.0, slip[0], slip[1]];
        let force = [-10.0, force[0], force[1]];
        let f: Vec<f64> = product(&k, &d).iter().zip(&force).map(|(kd, f)| kd - f).collect();
        let law = Law::Coulomb(vec![0.5]);
        let case = Case { dim: 3, pairs: 1, k, f, gap: vec![0.0], law, slip: None };
        let certificate = measure(&case, &d);
        let scale = norm(&case.f).max(norm(&force));
        assert!((certificate.eta * scale - residual).abs() <= 1e-13, "{certificate:?}");
        assert!((certificate.cone_excess - excess).abs() <= 1e-13, "{certificate:?}");
        assert_eq!(certificate.states, [state], "{certificate:?}");
    };
    // On the bound 5, against the slip: a solution.
    check([3.0, 4.0], [-3.0, -4.0], 0.0, 0.0, Slip);
    // Inside the round cone though outside the square one: it sticks.
    check([0.0, 0.0], [3.0, -4.0], 0.0, 0.0, Stick);
    // Outside the round cone though inside the square one: |F_t| = 10 against 5.
    check([0.0, 0.0], [6.0, 8.0], 5.0, 5.0, Slip);
    // On the bound across the slip: trial 4 (1, 0) - (0, 5), of length sqrt 41, shrinks by 5; the
    // residual is 4 (1, 0) less what is left.
    let left = 1.0 - 5.0 / 41_f64.sqrt();
    let residual = (4.0 - 4.0 * left).hypot(5.0 * left);
    check([1.0, 0.0], [0.0, 5.0], residual, 0.0, Slip);
}

/// On a body that nothing holds large displacements hide forces in rounding. Whatever their size,
/// a motion that the loads drive is no solution: neither without obstacles nor far away from them
/// (1e30 is what hosts write for "never touches").
#[test]
fn no_size_of_displacements_certifies_a_body_that_flies_away() {
    for seed in 0..300 {
        let mut rng = Rng::with_seed(seed);
        let pairs = rng.usize(1..=5);
        let (k, motions) = floating(&mut rng, pairs, 100.0);
        let r = &motions[0];
        let law = coulomb(&mut rng, pairs, 1.0);
        // The loads drive the motion, and something elastic.
        let elastic = product(&k, &vector(&mut rng, 2 * pairs));
        let f = elastic.iter().zip(r).map(|(elastic, r)| elastic + r).collect();
        let case = Case { f, ..loaded(&mut rng, 2, k, law) };
        for (gap, most) in [(f64::INFINITY, 300), (1e30, 29)] {
            let case = Case { gap: vec![gap; pairs], ..case.clone() };
            for exponent in 0..=most {
                let d: Vec<f64> = r.iter().map(|r| r * 10_f64.powi(exponent)).collect();
                let certificate = measure(&case, &d);
                let context = || format!("seed {seed}, 1e{exponent}, {gap}: {certificate:?}");
                assert!(!certificate.holds(1e-2), "{}", context());
            }
        }
    }
}
