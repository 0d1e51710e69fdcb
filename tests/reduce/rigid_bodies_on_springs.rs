//! Rigid bodies with elements within them and a spring at one node: the elements resist no motion, the spring resists some.

use crate::common::problems::uniform;
use crate::constrained::{Constrained, close, solved};
use crate::rigid_bodies::{add_spring, rigid};
use fastrand::Rng;
use nalgebra::{Matrix3, Vector3};
use signorini::{FrictionLaw, LoadCase, Monitor, Settings, Status};

/// A rigid body with nodes at `places`, springs of about `k` between all of them, and springs of 2 along each axis at the node
/// `held`. Each of its first nodes meets one of `others` nodes with springs of 2. The motion of the body has the last three numbers.
fn body(
    rng: &mut Rng,
    (places, held): (&[[f64; 2]], usize),
    (k, sign): (f64, f64),
    others: usize,
) -> Constrained {
    let bodies = places.len();
    let turn = 2 * (bodies + others);
    let size = turn + 3;
    let mut stiffness = vec![0.0; size * size];
    for (a, b) in (0..bodies).flat_map(|b| (0..b).map(move |a| (a, b))) {
        let mut v = vec![0.0; size];
        for c in 0..2 {
            v[2 * a + c] = places[a][c] - places[b][c];
            v[2 * b + c] = -v[2 * a + c];
        }
        add_spring(&mut stiffness, k * uniform(rng, 0.1, 1.0), &v);
    }
    let springs = (2 * bodies..turn).chain([2 * held, 2 * held + 1]);
    springs.for_each(|i| stiffness[i + size * i] += 2.0);
    let side =
        |node: usize, sign: f64| [(2 * node, vec![sign, 0.0]), (2 * node + 1, vec![0.0, sign])];
    let pair = |k: usize| [side(k, sign), side(bodies + k, -sign)].concat();
    Constrained {
        dim: 2,
        stiffness,
        fixed: vec![],
        equations: (0..bodies).flat_map(|k| rigid(k, places[k], turn)).collect(),
        rows: (0..others).map(pair).collect(),
        normals: [0.0, -sign].repeat(others),
        tangents: None,
    }
}

/// Springs between all nodes of a rigid body that stands with three of them on nodes with springs change nothing, where a fourth
/// node has a spring to the ground: the four carry its load by three equations, whichever side is the slave, condensed and in full
/// space, and nothing slips.
#[test]
fn stiffness_within_a_rigid_body_on_a_spring_is_none() {
    let mut compared = 0;
    for seed in 0..120 {
        let rng = &mut Rng::with_seed(seed);
        let mut places: Vec<[f64; 2]> =
            (0..12).map(|_| [uniform(rng, -1.0, 1.0), uniform(rng, 0.0, 1.0)]).collect();
        (0..3).for_each(|k| places[k][0] = k as f64 - 1.0);
        let (k, held) = (10_f64.powi(rng.i32(-1..=6)), 5);
        let sign = if seed % 2 == 0 { 1.0 } else { -1.0 };
        let structure = body(rng, (&places, held), (k, sign), 3);
        let loads = [uniform(rng, -0.2, 0.2), -3.0, uniform(rng, -0.5, 0.5)];
        // The springs: 2 sum (U + turn x r), and their moments.
        let mut springs = Matrix3::zeros();
        let standing = places[..3].iter().chain([&places[held]]);
        let motions = standing.flat_map(|[x, y]| [[1.0, 0.0, -y], [0.0, 1.0, *x]]);
        let motions: Vec<Vector3<f64>> = motions.map(Into::into).collect();
        motions.iter().for_each(|v| springs += 2.0 * v * v.transpose());
        let moved = springs.try_inverse().unwrap() * Vector3::from(loads);
        let pressed: Vec<f64> =
            motions[1..6].iter().step_by(2).map(|v| 2.0 * v.dot(&moved)).collect();
        if pressed.iter().any(|push| *push > -0.05) {
            continue;
        }
        compared += 1;
        let mut load = vec![0.0; structure.size()];
        load[30..].copy_from_slice(&loads);
        for full_space in [false, true] {
            let model = structure.whole(&Settings { full_space, ..Settings::default() });
            let found = solved(&model, &load, &[0.0; 3], 10.0).certificate.force;
            let normal: Vec<f64> = found.chunks(2).map(|force| force[0]).collect();
            // The stiffness is known to 1e-16 of 1e6 springs of 1e0.
            close(&normal, &pressed, 1e-7, &format!("seed {seed}, full space: {full_space}"));
        }
    }
    assert!(compared > 60, "{compared}");
}

/// A rigid body with springs between its nodes turns about the one that has a spring to the ground, off the only node that it could meet:
/// no equilibrium exists, and the turn proves it.
#[test]
fn a_rigid_body_turns_freely_about_a_spring() {
    for seed in 0..120 {
        let rng = &mut Rng::with_seed(seed);
        let mut places: Vec<[f64; 2]> =
            (0..5).map(|_| [uniform(rng, -1.0, 1.0), uniform(rng, 0.0, 1.0)]).collect();
        places[0] = [0.0; 2];
        let (k, held) = (10_f64.powi(rng.i32(-1..=6)), 3);
        let structure = body(rng, (&places, held), (k, 1.0), 1);
        let mut load = vec![0.0; structure.size()];
        // Node 0 rises.
        load[14] = -places[held][0].signum();
        for full_space in [false, true] {
            let settings = Settings { full_space, ..Settings::default() };
            let model = structure.whole(&settings);
            let law = FrictionLaw::Coulomb(&[0.0]);
            let case =
                LoadCase { load: &load, prescribed: None, gap: &[0.0], law, reference_slip: None };
            let monitor = &mut Monitor::new(&settings, None);
            let status = model.solve(&case, &settings, None, monitor).unwrap().status;
            let context = format!("seed {seed}, k = {k:e}, full space: {full_space}");
            assert_eq!(status, Status::NoEquilibrium, "{context}");
        }
    }
}
