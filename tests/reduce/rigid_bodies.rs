//! Rigid bodies whose stiffness is rounding: the change of variables, or the product with the matrix, cancels.

use crate::common::problems::{uniform, vector};
use crate::constrained::{Constrained, Terms, close, solved};
use fastrand::Rng;
use signorini::{Error, Settings};

/// Equations of a node of a plane rigid body at the arm `r`: `u = U + theta x r`, its motion from degree of freedom `first` on.
fn rigid(node: usize, [x, y]: [f64; 2], first: usize) -> [(usize, Terms); 2] {
    [
        (2 * node, vec![(first, 1.0), (first + 2, -y)]),
        (2 * node + 1, vec![(first + 1, 1.0), (first + 2, x)]),
    ]
}

/// The row of a pair of a node against a rigid plane.
fn row(node: usize) -> Vec<(usize, Vec<f64>)> {
    vec![(2 * node, vec![1.0, 0.0]), (2 * node + 1, vec![0.0, 1.0])]
}

/// Adds `k v vᵀ`.
fn add_spring(stiffness: &mut [f64], k: f64, v: &[f64]) {
    let size = (0..).find(|n| n * n == stiffness.len()).unwrap();
    for (j, b) in v.iter().enumerate() {
        v.iter().enumerate().for_each(|(i, a)| stiffness[i + size * j] += k * a * b);
    }
}

/// A rigid body of one node on springs to another node turns freely about its node, on whatever arm: this motion is named, in
/// any units, where the node is the slave of a pair and the turn is left over.
#[test]
fn the_free_turn_of_a_rigid_body_of_one_node_is_named() {
    for seed in 0..200 {
        let rng = &mut Rng::with_seed(seed);
        let arm = [uniform(rng, -1.0, 1.0), uniform(rng, -1.0, 1.0)];
        let units = 10_f64.powi(rng.i32(-6..=6));
        let mut stiffness = vec![0.0; 49];
        for _ in 0..4 {
            let v = vector(rng, 2);
            add_spring(&mut stiffness, units, &[v[0], v[1], -v[0], -v[1], 0.0, 0.0, 0.0]);
        }
        (0..2).for_each(|i| stiffness[8 * i] += units);
        let structure = Constrained {
            dim: 2,
            stiffness,
            fixed: vec![],
            equations: rigid(1, arm, 4).into(),
            rows: vec![row(1)],
            normals: vec![1.0, 0.0],
            tangents: None,
        };
        let full_space = seed % 2 == 1;
        match structure.tried(&Settings { full_space, ..Settings::default() }) {
            Err(Error::Invalid { message, .. }) => {
                let said = message.to_string();
                let part = "a motion remains that no support and no pair holds: it moves 3 of the degrees of freedom 4 to 6";
                assert!(said.contains(part), "seed {seed}: {said}");
            }
            Err(other) => panic!("seed {seed}: {other}"),
            Ok(_) => panic!("seed {seed}: nothing holds the turn, and the model was made"),
        }
    }
}

/// Two nodes of a rigid body rest on a rigid plane, under a load of 2 in the middle: 1 each. A node on springs of 2 has a load
/// of 1 and a gap of 0.1: it meets 0.8. Stiffness between nodes that are one rigid body changes nothing; it resists no motion but
/// by rounding.
#[test]
fn stiffness_within_a_rigid_body_is_none() {
    for seed in 0..100 {
        let rng = &mut Rng::with_seed(seed);
        let angle = uniform(rng, 0.0, 6.0);
        let (along, normal) = ([angle.cos(), angle.sin()], [angle.sin(), -angle.cos()]);
        let middle = [uniform(rng, -1.0, 1.0), uniform(rng, -1.0, 1.0)];
        let mut stiffness = vec![0.0; 81];
        let k = 10_f64.powi(rng.i32(-3..=6));
        add_spring(
            &mut stiffness,
            k,
            &[along[0], along[1], -along[0], -along[1], 0.0, 0.0, 0.0, 0.0, 0.0],
        );
        [4, 5].iter().for_each(|i| stiffness[10 * i] = 2.0);
        let node = |node: usize, side: f64| {
            rigid(node, [middle[0] + side * along[0], middle[1] + side * along[1]], 6)
        };
        let structure = Constrained {
            dim: 2,
            stiffness,
            fixed: vec![],
            equations: [node(0, -1.0), node(1, 1.0)].concat(),
            rows: (0..3).map(row).collect(),
            normals: normal.repeat(3),
            tangents: None,
        };
        let [x, y] = [2.0 * normal[0], 2.0 * normal[1]];
        let turn = middle[0] * y - middle[1] * x;
        let load = [0.0, 0.0, 0.0, 0.0, normal[0], normal[1], x, y, turn];
        let model = structure.whole(&Settings::default());
        let force = solved(&model, &load, &[0.0, 0.0, 0.1], 0.0).certificate.force;
        let pressed: Vec<f64> = force.chunks(2).map(|force| force[0]).collect();
        close(&pressed, &[-1.0, -1.0, -0.8], 1e-9, &format!("seed {seed}"));
    }
}
