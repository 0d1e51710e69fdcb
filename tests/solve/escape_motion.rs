//! The motion with which bodies escape: what statics and the law of friction say of it.

use crate::common::dense::{dot, largest, norm, product};
use crate::common::problems::{Case, Law, block, uniform};
use crate::common::rigid_statics::distance;
use fastrand::Rng;
use signorini::{Escape, Settings, Status};

/// Rest that rounding and the accuracy of the motion leave, relative to the motion or the loads.
const SMALL: f64 = 1e-8;

/// A block of four pairs on a plane, 1 apart, under forces `(normal, tangential)` of its pairs.
fn escape_of(loads: [[f64; 2]; 4], mu: f64) -> Escape {
    let k = block(&mut Rng::with_seed(1), 4);
    let law = Law::Coulomb(vec![mu; 4]);
    let case = Case { dim: 2, pairs: 4, k, f: loads.concat(), gap: vec![0.0; 4], law, slip: None };
    let solution = case.solve(&Settings::default());
    assert_eq!(solution.status, Status::NoEquilibrium, "{}", solution.message);
    let escape = solution.escape.expect("a motion");
    let left = format!("contact leaves {:.3e} of it", dot(&escape.unbalanced, &escape.motion));
    assert!(solution.message.contains(&left), "{}", solution.message);
    escape
}

fn moves(escape: &Escape, wanted: [[f64; 2]; 4]) {
    let off = escape.motion.iter().zip(wanted.as_flattened()).map(|(r, w)| (r - w).abs());
    assert!(off.fold(0.0, f64::max) <= SMALL, "{escape:?}");
}

/// Pressed by N = 4 and pushed by T = 6 with mu = 0.5 a block slides on its plane: T - mu N = 4 is left.
#[test]
fn a_block_slides_without_a_lift() {
    for direction in [1.0, -1.0] {
        let escape = escape_of([[1.0, 1.5 * direction]; 4], 0.5);
        moves(&escape, [[0.0, direction]; 4]);
        let left: Vec<f64> = escape.unbalanced.iter().skip(1).step_by(2).copied().collect();
        assert!((left.iter().sum::<f64>() - 4.0 * direction).abs() <= 4.0 * SMALL, "{left:?}");
    }
}

/// Pulled off evenly it lifts without turning where the pairs resist alike; the whole pull is left.
#[test]
fn a_block_that_is_pulled_leaves_the_plane() {
    let escape = escape_of([[-1.0, 0.0]; 4], 0.5);
    assert!(escape.motion.iter().step_by(2).all(|r| *r < -0.1), "{escape:?}");
    let left: f64 = escape.unbalanced.iter().step_by(2).sum();
    assert!((left + 4.0).abs() <= 4.0 * SMALL, "{escape:?}");
}

/// The pull 1 at one end and the press 3 at the other press beyond the base, 1.5 from the edge: the block
/// turns about the edge, and the moment 1 * 3 about it is left, the work on `(-1, -2/3, -1/3, 0)`.
#[test]
fn a_block_tips_about_its_edge() {
    let mut loads = [[0.0; 2]; 4];
    (loads[0][0], loads[3][0]) = (-1.0, 3.0);
    let escape = escape_of(loads, 0.7);
    moves(&escape, [[-1.0, 0.0], [-2.0 / 3.0, 0.0], [-1.0 / 3.0, 0.0], [0.0, 0.0]]);
    assert!((dot(&escape.unbalanced, &escape.motion) - 1.0).abs() <= SMALL, "{escape:?}");
}

/// The same about either edge, in words: the pair at the edge rests, and the other end moves most, away from its obstacle.
#[test]
fn the_sentence_tells_what_moves() {
    for (pulled, pressed) in [(0, 3), (3, 0)] {
        let mut f = vec![0.0; 8];
        (f[2 * pulled], f[2 * pressed]) = (-1.0, 3.0);
        let (k, law) = (block(&mut Rng::with_seed(1), 4), Law::Coulomb(vec![0.7; 4]));
        let case = Case { dim: 2, pairs: 4, k, f, gap: vec![0.0; 4], law, slip: None };
        let solution = case.solve(&Settings::default());
        let words =
            format!("moves 3 of 4 pairs, most of all pair {pulled}, away from the obstacle;");
        assert!(solution.message.contains(&words), "{}", solution.message);
    }
}

/// A rigid body on pairs at random places, its inner stiffness random: the rigid motions of the pairs, and
/// the problem.
fn body(rng: &mut Rng) -> (Vec<Vec<f64>>, Case) {
    let (dim, pairs) = (2 + rng.usize(0..2), 2 + rng.usize(0..5));
    let n = dim * pairs;
    let places: Vec<[f64; 3]> =
        (0..pairs).map(|_| [0; 3].map(|_| uniform(rng, -1.0, 1.0))).collect();
    // Normals along -z (in the plane -y), tangents along x and y.
    let frames: Vec<[[f64; 3]; 3]> = (0..pairs)
        .map(|_| match dim {
            2 => [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0; 3]],
            _ => [[0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0]],
        })
        .collect();
    let motion = |at: &dyn Fn([f64; 3]) -> [f64; 3]| -> Vec<f64> {
        let parts = places.iter().zip(&frames);
        parts
            .flat_map(|(place, frame)| {
                frame[..dim].iter().map(|axis| dot(axis, &at(*place))).collect::<Vec<_>>()
            })
            .collect()
    };
    let unit = |i: usize| std::array::from_fn(|c| f64::from(u8::from(c == i)));
    let turn = |axis: usize, p: [f64; 3]| crate::common::brick::cross(unit(axis), p);
    let mut rigid: Vec<Vec<f64>> = (0..dim).map(|i| motion(&|_| unit(i))).collect();
    match dim {
        2 => rigid.push(motion(&|p| turn(2, p))),
        _ => rigid.extend((0..3).map(|axis| motion(&|p| turn(axis, p)))),
    }
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for mut v in rigid {
        for _ in 0..2 {
            for unit in &basis {
                let share = dot(unit, &v);
                v.iter_mut().zip(unit).for_each(|(v, unit)| *v -= share * unit);
            }
        }
        let size = norm(&v);
        if size > 1e-3 {
            basis.push(v.iter().map(|v| v / size).collect());
        }
    }
    let k = crate::common::problems::semidefinite(rng, n, 10.0, &basis);
    let mu = [0.0, 0.3, 1.0][rng.usize(0..3)];
    let mut f: Vec<f64> = (0..n).map(|_| uniform(rng, -1.0, 1.0)).collect();
    f.iter_mut().step_by(dim).for_each(|f| *f += 0.7);
    let gap = (0..pairs).map(|_| if rng.u8(0..6) == 0 { f64::INFINITY } else { 0.0 }).collect();
    (basis, Case { dim, pairs, k, f, gap, law: Law::Coulomb(vec![mu; pairs]), slip: None })
}

/// The forces that contact can have in a motion, in the coordinates of the rigid motions: of a pair that
/// leaves its obstacle none, of one that slips along the edge of its cone against the slip, of one that
/// sticks the edges of a cone a little wider than its own, 200 in space.
fn forces_in(case: &Case, basis: &[Vec<f64>], r: &[f64]) -> Vec<Vec<f64>> {
    let (dim, edges) = (case.dim, 200);
    let mut columns = Vec::new();
    for pair in (0..case.pairs).filter(|&pair| case.gap[pair].is_finite()) {
        let own = &r[dim * pair..dim * (pair + 1)];
        let (mu, slip) = (case.law.values()[pair], norm(&own[1..]));
        let directions: Vec<Vec<f64>> = match (slip > SMALL, dim) {
            _ if own[0] < -SMALL => continue,
            (true, _) => vec![own[1..].iter().map(|t| -t / slip).collect()],
            (false, 2) => vec![vec![1.0], vec![-1.0]],
            _ => (0..edges)
                .map(|k| (std::f64::consts::TAU * k as f64 / edges as f64).sin_cos())
                .map(|(sin, cos)| vec![cos * 1.001, sin * 1.001])
                .collect(),
        };
        for direction in directions {
            let mut force = vec![0.0; dim * case.pairs];
            force[dim * pair] = -1.0;
            for (c, part) in direction.iter().enumerate() {
                force[dim * pair + 1 + c] = mu * part;
            }
            columns.push(basis.iter().map(|v| dot(v, &force)).collect());
        }
    }
    columns
}

/// The motion is rigid and goes into no obstacle, and forces that obey the law in this very motion leave of
/// the loads what moves the viscosity, and no more.
#[test]
fn random_bodies_move_as_friction_lets_them() {
    let mut escaped = 0;
    for seed in 0..600 {
        let (basis, case) = body(&mut Rng::with_seed(seed));
        let solution = case.solve(&Settings::default());
        let Some(Escape { motion, unbalanced }) = &solution.escape else {
            assert_ne!(solution.status, Status::NoEquilibrium, "seed {seed}");
            continue;
        };
        assert_eq!(largest(motion), 1.0, "seed {seed}");
        let strain = largest(&product(&case.k, motion)) / largest(&case.k);
        assert!(strain <= SMALL, "seed {seed}: {strain:.1e}");
        assert!(dot(&case.f, motion) > 0.0, "seed {seed}");
        if solution.status == Status::Stalled {
            // The motion of bodies that move away as springs are let go is known to a hundredth.
            assert!(solution.recession.is_none(), "seed {seed}");
            continue;
        }
        assert_eq!(solution.status, Status::NoEquilibrium, "seed {seed}");
        escaped += 1;
        let into = (0..case.pairs).filter(|&pair| case.gap[pair].is_finite());
        let into = into.map(|pair| motion[case.dim * pair]).fold(0.0, f64::max);
        assert!(into <= SMALL, "seed {seed}: {into:.1e}");
        let left: Vec<f64> = case.f.iter().zip(unbalanced).map(|(f, rest)| f - rest).collect();
        let target: Vec<f64> = basis.iter().map(|v| dot(v, &left)).collect();
        let off = distance(&target, &forces_in(&case, &basis, motion)) / norm(&case.f);
        assert!(off <= 1e-7, "seed {seed}: {off:.1e} is not balanced: {motion:?}");
    }
    assert!(escaped > 200, "{escaped}");
}
