//! Rigid balls that contact alone holds, in a ring on soft springs, and other rounding of stiff springs beside soft ones.

use std::f64::consts::TAU;

use crate::common::problems::{uniform, vector};
use crate::constrained::{Constrained, close, solved};
use fastrand::Rng;
use signorini::{Error, FrictionLaw, LoadCase, Monitor, Settings, Status};

/// Adds `k v vᵀ`.
fn add_spring(stiffness: &mut [f64], k: f64, v: &[f64]) {
    let size = v.len();
    for (j, b) in v.iter().enumerate() {
        v.iter().enumerate().for_each(|(i, a)| stiffness[i + size * j] += k * a * b);
    }
}

/// The row of a pair of a node against a rigid plane.
fn row(node: usize) -> Vec<(usize, Vec<f64>)> {
    vec![(2 * node, vec![1.0, 0.0]), (2 * node + 1, vec![0.0, 1.0])]
}

/// A ring of balls, each between a node of the ring and a fixed shaft, rigid and held by nothing else. The nodes stand at equal
/// angles from `start`, with springs of 1 between them, along both axes, and soft ones to the ground.
fn ring(count: usize, start: f64, soft: f64) -> Constrained {
    let (first, size) = (2 * count, 5 * count);
    let mut stiffness = vec![0.0; size * size];
    for dof in 0..first {
        let mut v = vec![0.0; size];
        (v[dof], v[(dof + 2) % first]) = (1.0, -1.0);
        add_spring(&mut stiffness, 1.0, &v);
        stiffness[(size + 1) * dof] += soft;
    }
    let (mut rows, mut normals) = (vec![], vec![]);
    for (node, [x, y]) in directions(count, start).into_iter().enumerate() {
        let ball = first + 3 * node;
        for side in [1.0, -1.0] {
            let turn = vec![-side * BALL * y, side * BALL * x];
            let mut row =
                vec![(ball, vec![1.0, 0.0]), (ball + 1, vec![0.0, 1.0]), (ball + 2, turn)];
            if side > 0.0 {
                row.extend([(2 * node, vec![-1.0, 0.0]), (2 * node + 1, vec![0.0, -1.0])]);
            }
            rows.push(row);
            normals.extend([side * x, side * y]);
        }
    }
    let (fixed, equations, tangents) = (vec![], vec![], None);
    Constrained { dim: 2, stiffness, fixed, equations, rows, normals, tangents }
}

/// The radius of a ball.
const BALL: f64 = 0.15;

/// So many directions, at equal angles from `start`.
fn directions(count: usize, start: f64) -> Vec<[f64; 2]> {
    let angle = |k: usize| start + TAU * k as f64 / count as f64;
    (0..count).map(|k| [angle(k).cos(), angle(k).sin()]).collect()
}

/// Nothing resists the rolling of a ball, whatever holds the ring, so that the tangents have rows of zeros: rounding mixes
/// these motions with those of the ring on its springs. A load of 1 on each node towards the shaft presses each ball with 1 from
/// both sides: by symmetry the ring does not move. To ten times the tolerance.
#[test]
fn balls_roll_freely_in_a_ring_on_soft_springs() {
    for exponent in 0..=9 {
        for (count, start) in [(2, 0.7), (3, 0.3), (5, 0.1), (12, 0.2)] {
            let name = format!("springs of 1e-{exponent}, {count} balls");
            let structure = ring(count, start, 0.1_f64.powi(exponent));
            let model = structure.tried(&Settings::default()).expect(&name);
            let size = 4 * count;
            let rows = |i: usize| model.stiffness().iter().skip(i).step_by(size);
            assert!((1..size).step_by(2).all(|i| rows(i).all(|entry| *entry == 0.0)), "{name}");
            let mut load: Vec<f64> =
                directions(count, start).concat().iter().map(|part| -part).collect();
            load.resize(5 * count, 0.0);
            let solution = solved(&model, &load, &vec![0.0; 2 * count], 0.2);
            close(&solution.certificate.force, &[-1.0, 0.0].repeat(2 * count), 1e-11, &name);
            // Whatever the load of the ring is, a ball that rolls has the same force on both sides, and no friction.
            load[0] += 0.3;
            let solution = solved(&model, &load, &vec![0.0; 2 * count], 0.2);
            for force in solution.certificate.force.chunks_exact(4) {
                close(force, &[force[0], 0.0, force[0], 0.0], 1e-11, &name);
            }
        }
    }
}

/// A node of a pair hangs on another one by stiff springs, and this one on one soft spring to the ground, askew: the matrix has
/// rank 1, and rounding of the stiff springs. The model stands. A spring that pushes
/// instead is no stiffness, and is refused.
#[test]
fn rounding_of_stiff_springs_beside_a_soft_one_is_no_negative_energy() {
    for seed in 0..200 {
        let rng = &mut Rng::with_seed(seed);
        let exponent = rng.i32(1..=11);
        let made = |sign: f64, rng: &mut Rng| {
            let mut stiffness = vec![0.0; 16];
            for _ in 0..4 {
                let v = vector(rng, 2);
                add_spring(&mut stiffness, 1.0, &[v[0], v[1], -v[0], -v[1]]);
            }
            let angle = uniform(rng, 0.0, TAU);
            let spring = sign * 0.1_f64.powi(exponent);
            add_spring(&mut stiffness, spring, &[0.0, 0.0, angle.cos(), angle.sin()]);
            let (fixed, equations, tangents) = (vec![], vec![], None);
            let (rows, normals) = (vec![row(0)], vec![0.0, -1.0]);
            let structure =
                Constrained { dim: 2, stiffness, fixed, equations, rows, normals, tangents };
            structure.tried(&Settings::default())
        };
        let (other, name) = (&mut rng.clone(), format!("seed {seed}, 1e-{exponent}"));
        if let Err(error) = made(1.0, rng) {
            panic!("{name}: {error}");
        }
        match made(-1.0, other) {
            Err(Error::Invalid { message, .. }) => {
                let said = message.to_string();
                assert!(said.contains("is not positive semi-definite"), "{name}: {said}");
            }
            _ => panic!("{name}: a negative energy passes"),
        }
    }
}

/// Two squares of four nodes on bars of random stiffness, one on the other on a slope steeper than friction; springs hold the lower
/// one. The upper one slides: the balance of its rigid motions proves that no equilibrium exists. Rounding moves the pairs
/// of the lower square in these motions, and forces of these pairs, however large, would seem to hold the upper one.
#[test]
fn a_body_slides_off_another_one_that_springs_hold() {
    for seed in 0..100 {
        let rng = &mut Rng::with_seed(seed);
        let spring = 10_f64.powi(rng.i32(-5..=1));
        let mut stiffness = vec![0.0; 256];
        let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0_f64]];
        for body in [0, 4] {
            for (i, j) in (0..4).flat_map(|j| (0..j).map(move |i| (i, j))) {
                let mut v = vec![0.0; 16];
                for axis in 0..2 {
                    let along = corners[j][axis] - corners[i][axis];
                    (v[2 * (body + i) + axis], v[2 * (body + j) + axis]) = (along, -along);
                }
                add_spring(&mut stiffness, uniform(rng, 0.5, 2.0), &v);
            }
        }
        (0..8).for_each(|dof| stiffness[17 * dof] += spring);
        let onto = |node: usize, below: usize| {
            let other = row(below).into_iter().map(|(dof, v)| (dof, vec![-v[0], -v[1]]));
            row(node).into_iter().chain(other).collect()
        };
        let structure = Constrained {
            dim: 2,
            stiffness,
            fixed: vec![],
            equations: vec![],
            rows: vec![row(0), row(1), onto(4, 2), onto(5, 3)],
            normals: [0.0, -1.0].repeat(4),
            tangents: None,
        };
        let model = structure.tried(&Settings::default()).expect("it stands");
        let (settings, mu) = (Settings::default(), vec![0.1; 4]);
        let load = [0.2_f64.sin(), -0.2_f64.cos()].repeat(8);
        let case = LoadCase {
            load: &load,
            prescribed: None,
            gap: &[0.0; 4],
            law: FrictionLaw::Coulomb(&mu),
            reference_slip: None,
        };
        let monitor = &mut Monitor::new(&settings, None);
        let solution = model.solve(&case, &settings, None, monitor).unwrap();
        assert_eq!(solution.status, Status::NoEquilibrium, "seed {seed}: {}", solution.message);
        // Sweeps, whose drift proves it at the earliest after 256 of them, are not asked.
        assert!(solution.iterations < 256, "seed {seed}: {}", solution.iterations);
    }
}
