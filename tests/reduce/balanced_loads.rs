//! Loads on a floating body that balance to the last digit: there is an equilibrium, whatever rounding says of it.

use crate::constrained::Constrained;
use fastrand::Rng;
use signorini::{FrictionLaw, LoadCase, Monitor, Settings, Status};

/// Five nodes with springs between all of them along every axis, of whole stiffnesses: translations are free to the last digit, and loads of
/// whole numbers sum to zero. Wide gaps leave `u = A⁺ f` an equilibrium without contact. No motion proves that there is none, in
/// full space and condensed, also where several pairs share a node, so that their rows depend on each other.
#[test]
fn no_motion_is_a_proof_against_loads_that_balance() {
    let (mut solved, mut all) = (0, 0);
    for seed in 0..200 {
        let rng = &mut Rng::with_seed(seed);
        let (dim, nodes) = (rng.usize(2..=3), 5);
        let size = dim * nodes;
        let mut stiffness = vec![0.0; size * size];
        for (a, b) in (0..nodes).flat_map(|a| (0..a).map(move |b| (a, b))) {
            let spring = f64::from(rng.u32(1..4));
            for c in 0..dim {
                let [a, b] = [a, b].map(|node| dim * node + c);
                for (i, j, sign) in [(a, a, 1.0), (b, b, 1.0), (a, b, -1.0), (b, a, -1.0)] {
                    stiffness[i + size * j] += sign * spring;
                }
            }
        }
        let mut load: Vec<f64> = (0..size).map(|_| f64::from(rng.i32(-3..=3))).collect();
        for c in 0..dim {
            let sum: f64 = load.iter().skip(c).step_by(dim).sum();
            load[size - dim + c] -= sum;
        }
        let repeats = rng.bool();
        let mut slaves: Vec<usize> = (0..rng.usize(1..=3)).collect();
        slaves.extend(repeats.then_some(0));
        let unit = |axis: usize| (0..dim).map(|c| f64::from(u8::from(c == axis))).collect();
        let row = |&node: &usize| (0..dim).map(|c| (dim * node + c, unit(c))).collect();
        let mut normal = || {
            let vector: Vec<f64> = (0..dim).map(|_| rng.f64() - 0.5).collect();
            let length = vector.iter().map(|x| x * x).sum::<f64>().sqrt();
            vector.into_iter().map(|x| x / length).collect::<Vec<f64>>()
        };
        let body = Constrained {
            dim,
            stiffness,
            fixed: vec![],
            equations: vec![],
            rows: slaves.iter().map(row).collect(),
            normals: slaves.iter().flat_map(|_| normal()).collect(),
            tangents: None,
        };
        let (gap, mu) = (vec![50.0; slaves.len()], vec![0.3; slaves.len()]);
        for full_space in [false, true] {
            // A pair alone has no condensed stiffness.
            let model = body.tried(&Settings { full_space, ..Settings::default() });
            let Ok(model) = model else {
                assert!(slaves.len() == 1 && !full_space, "{seed}");
                continue;
            };
            for law in [FrictionLaw::Frictionless, FrictionLaw::Coulomb(&mu)] {
                let case = LoadCase {
                    load: &load,
                    prescribed: None,
                    gap: &gap,
                    law,
                    reference_slip: None,
                };
                let settings = Settings::default();
                let monitor = &mut Monitor::new(&settings, None);
                let found = model.solve(&case, &settings, None, monitor).unwrap();
                let context = format!("{seed}, {full_space}, {law:?}: {}", found.message);
                assert_ne!(found.status, Status::NoEquilibrium, "{context}");
                // In full space the rounding of the only pair's load is all that drives it, and may hide its displacements.
                if !full_space || slaves.len() > 2 {
                    all += 1;
                    solved += usize::from(found.status == Status::Solved);
                }
            }
        }
    }
    println!("{solved} of {all}");
    assert!(100 * solved >= 98 * all, "{solved} of {all}");
}
