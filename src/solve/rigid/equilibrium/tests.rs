//! Motions of a body of three pairs that nothing holds, in closed form.

use super::{Balance, STOPPED, escape, solved};
use crate::law::Contact;
use crate::linalg::gmres::extend_basis;
use crate::monitor::unwatched;
use crate::problem::{ContactProblem, FrictionLaw};
use crate::solve::result::Ending;
use crate::solve::rigid::motions::RigidMotions;
use fastrand::Rng;

/// Three pairs on one line, tied to each other by springs of 1, each touching its obstacle.
fn body(law: FrictionLaw<'static>) -> ContactProblem<'static> {
    let mut k = vec![0.0; 36];
    for (pair, component) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        let (i, j) = (2 * pair + component, 2 * pair + component + 2);
        (k[7 * i], k[7 * j]) = (k[7 * i] + 1.0, k[7 * j] + 1.0);
        (k[6 * i + j], k[6 * j + i]) = (-1.0, -1.0);
    }
    ContactProblem::of_test(2, (k.leak(), &[0.0; 6]), (&[0.0; 3], law, None))
}

/// The motion by `by` of all pairs along the normals.
fn along_normals(by: f64) -> [f64; 6] {
    [by, 0.0, by, 0.0, by, 0.0]
}

/// A body that moves away from its obstacles, of whatever length its motion is, has no equilibrium where the motion proves
/// that, and only there. One that moves towards them is stopped, and proves nothing, even if it is taken for a proof.
#[test]
fn only_a_motion_that_nothing_stops_and_that_proves_it_is_a_recession() {
    let problem = body(FrictionLaw::Frictionless);
    let contact = Contact::new(&problem);
    for length in [1.0, 2.0_f64.powi(30), 2.0_f64.powi(-30)] {
        for (by, proves, expected) in [
            (-length, true, true),
            (-length, false, false),
            (length, true, false),
            (length, false, false),
        ] {
            let motion = along_normals(by);
            let motions = RigidMotions::along(&problem, &motion);
            // A motion that is turned away from the obstacles is another one, which is not taken for a proof.
            let balance = Balance::of(&contact, motions, unwatched(), |r| {
                proves && r[0] * by > 0.5 * by * by
            });
            match balance.ending_away(&motion) {
                Ending::Recession(_) => assert!(expected, "{by}, {proves}"),
                Ending::RunsAway(_) => assert!(!expected, "{by}, {proves}"),
                _ => panic!("{by}, {proves}: another ending"),
            }
        }
    }
}

/// The pairs that a motion brings nearer to their obstacles are told, the one that comes nearest first; others are not.
#[test]
fn pairs_that_approach_are_told_in_order() {
    let problem = body(FrictionLaw::Frictionless);
    let contact = Contact::new(&problem);
    let balance = Balance::of(
        &contact,
        RigidMotions::along(&problem, &along_normals(1.0)),
        unwatched(),
        |_| true,
    );
    for (normals, expected) in [
        ([1.0, -1.0, 2.0], vec![2, 0]),
        ([-1.0, 0.5, 0.25], vec![1, 2]),
        ([-1.0, 0.0, -2.0], vec![]),
    ] {
        // Units are diagonal entries, 1 at the ends and 2 in the middle.
        let root = [1.0, 2.0_f64.sqrt(), 1.0];
        let motion: Vec<f64> =
            normals.iter().zip(root).flat_map(|(normal, root)| [normal / root, 0.0]).collect();
        assert_eq!(balance.worst(&motion), expected, "{normals:?}");
    }
}

/// Pairs that slide, with normal displacements of rounding, are lifted off their obstacles where a rigid motion lifts all of
/// them, by a motion that is rigid and as small as the rounding. Two rigid motions do not bring three pairs to rest, so that
/// equations alone leave a pair that approaches.
#[test]
fn what_rounding_leaves_of_an_approach_is_lifted() {
    let rng = &mut Rng::with_seed(3);
    for seed in 0..1000 {
        let mu = [0.0, 0.5, 100.0][seed % 3];
        let problem = body(FrictionLaw::Coulomb(vec![mu; 3].leak()));
        let contact = Contact::new(&problem);
        let mut motions = RigidMotions { root: problem.unit_roots(), basis: Vec::new() };
        for lift in [0.1, -1.0] {
            let normal: [f64; 3] = std::array::from_fn(|_| -lift - (1.0 - lift) * rng.f64());
            let scaled = normal.into_iter().flat_map(|normal| [normal, 0.0]).collect();
            extend_basis(&mut motions.basis, scaled);
        }
        let noise = 10_f64.powf(-13.0 + 3.0 * rng.f64());
        let slides = |root: &[f64]| {
            let slip = 2.0 * rng.f64() - 1.0;
            [noise * (2.0 * rng.f64() - 1.0) / root[0] - mu * slip.abs(), slip]
        };
        let motion: Vec<f64> = motions.root.chunks_exact(2).flat_map(slides).collect();
        let balance = Balance::of(&contact, motions.clone(), unwatched(), |_| true);
        let cleared = balance.cleared(motion.clone());
        let nearest = balance.nearest(&cleared);
        assert!(nearest <= STOPPED * motions.size(&cleared), "{seed}: {nearest:e}");
        let moved: Vec<f64> = cleared.iter().zip(&motion).map(|(a, b)| a - b).collect();
        let rigid = motions.part(&moved);
        // The sums of motions up to 100 round.
        let strain = moved.iter().zip(&rigid).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(strain <= 1e-13, "{seed}: {strain:e}");
        assert!(motions.size(&moved) <= 1e3 * noise, "{seed}: {moved:?}");
    }
}

/// A pair of two that nearly rests while the other one leaves is lifted so far that no force of its cone does negative work
/// on it, wherever it was going, and no further than along the normal: by `r_n + sqrt(2) mu |r_t|` at most, as four forces
/// stand for the cone. A millionth of the largest motion is rest, in any unit.
#[test]
fn a_pair_that_nearly_rests_is_lifted_off_all_forces_of_its_cone() {
    let k: Vec<f64> = (0..36).map(|i| if i % 7 == 0 { 1.0 } else { 0.0 }).collect();
    let rng = &mut Rng::with_seed(1);
    for seed in 0..100 {
        let mu = [0.1, 0.5, 2.0][seed % 3];
        let mus = [mu; 2];
        let of_pairs = (&[0.0; 2][..], FrictionLaw::Coulomb(&mus), None);
        let problem = ContactProblem::of_test(3, (&k, &[0.0; 6]), of_pairs);
        let contact = Contact::new(&problem);
        let unit = |i: usize| (0..6).map(|j| if i == j { 1.0 } else { 0.0 }).collect();
        let basis = (0..4).map(unit).collect();
        let motions = RigidMotions { root: problem.unit_roots(), basis };
        let balance = Balance::of(&contact, motions, unwatched(), |_| true);
        let size = 2.0_f64.powi(rng.i32(-30..=30));
        let own: [f64; 3] = std::array::from_fn(|_| size * 1e-8 * (rng.f64() - 0.5));
        let motion = [own[0].abs(), own[1], own[2], -size, 0.0, 0.0];
        assert!(balance.moves(1, &motion[3..], size) && !balance.moves(0, &motion[..3], size));
        let approach = motion[0] + mu * own[1].hypot(own[2]);
        // The rounding of a length, of a product and of a sum.
        assert!((balance.nearest(&motion) - approach).abs() <= 4.0 * f64::EPSILON * approach);
        let lift = balance.least_lift(&motion, approach).expect("the normal is free");
        let lifted: Vec<f64> = motion.iter().zip(&lift).map(|(r, lift)| r + lift).collect();
        // Ten times the slope of the projection that is still taken for rounding, 1e-13.
        assert!(balance.nearest(&lifted) <= 1e-12 * approach, "{seed}: {lifted:?}");
        let length = lift.iter().map(|r| r * r).sum::<f64>().sqrt();
        let most = motion[0] + 2.0_f64.sqrt() * mu * own[1].hypot(own[2]);
        assert!(length <= (1.0 + 1e-12) * most, "{seed}: {length:e} {most:e}");
    }
}

/// Equations of whole numbers that have a solution are solved by it, in whatever units the unknowns are, and an unknown that
/// none of them has is 0. A determinant of columns of length 1 below .1 is not tried: it multiplies the rounding.
#[test]
fn least_squares_solve_what_can_be_solved() {
    let rng = &mut Rng::with_seed(1);
    let mut tried = 0;
    while tried < 100 {
        let rows: Vec<[f64; 2]> =
            (0..3).map(|_| [(); 2].map(|()| f64::from(rng.i32(-9..=9)))).collect();
        let product = |i: usize, j: usize| rows.iter().map(|row| row[i] * row[j]).sum::<f64>();
        let determinant = product(0, 0) * product(1, 1) - product(0, 1).powi(2);
        if !(determinant > 0.1 * product(0, 0) * product(1, 1)) {
            continue;
        }
        tried += 1;
        let exact = [f64::from(rng.i32(-9..=9)), f64::from(rng.i32(-9..=9))];
        let units = [2.0_f64.powi(rng.i32(-20..=20)), 2.0_f64.powi(rng.i32(-20..=20))];
        let equations: Vec<(Vec<f64>, f64)> = rows
            .iter()
            .map(|row| {
                let right = row[0] * exact[0] + row[1] * exact[1];
                (vec![row[0] * units[0], row[1] * units[1], 0.0], right)
            })
            .collect();
        let x = solved(&equations, 3);
        for i in 0..2 {
            let error = (x[i] * units[i] - exact[i]).abs();
            assert!(error <= 1e-12, "{rows:?}: {x:?}, {exact:?}, {units:?}");
        }
        assert_eq!(x[2], 0.0);
    }
}

/// Four feet in space, tied by springs that resist all but translations, under loads whose resultant is steeper than
/// friction by a part `eps` of it, or flatter: there is no equilibrium in the first case alone. The resultant's work on the
/// slide that friction lifts is `eps mu` of the normal load: `eps` is far above the roundings of 1e-16, and a work above
/// 1e-9 of all loads is one for the certificate.
#[test]
fn a_slope_that_is_too_steep_by_little_has_a_proof() {
    let ties = |i: usize, j: usize| match (i % 3 == j % 3, i == j) {
        (true, true) => 3.0,
        (true, false) => -1.0,
        _ => 0.0,
    };
    let k: Vec<f64> = (0..144).map(|at| ties(at / 12, at % 12)).collect();
    let rng = &mut Rng::with_seed(8);
    for seed in 0..200 {
        let mu = 10_f64.powf(rng.f64() - 0.7);
        let eps = [-1.0, 1.0][seed % 2] * 10_f64.powf(-6.0 - 2.0 * rng.f64());
        let (sine, cosine) = (rng.f64() * std::f64::consts::TAU).sin_cos();
        let slide = mu * (1.0 + eps);
        let foot = |_| (0.5 + rng.f64()) * 2.0_f64.powi(-2);
        let load: Vec<f64> =
            (0..4).map(foot).flat_map(|p| [p, slide * cosine * p, slide * sine * p]).collect();
        let mus = [mu; 4];
        let of_pairs = (&[0.0; 4][..], FrictionLaw::Coulomb(&mus), None);
        let problem = ContactProblem::of_test(3, (&k, &load), of_pairs);
        let proof = escape(&Contact::new(&problem), unwatched());
        assert_eq!(proof.is_some(), eps > 0.0, "{seed}: mu {mu}, eps {eps:e}");
    }
}
