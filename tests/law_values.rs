//! What the law says of all pairs together, each by its own definition: which obstacles are out of reach, whether
//! gaps contradict each other, how far pairs may move, and forces beside their tension.

mod common;

use common::dense::product;
use common::problems::{Case, Law, decades, definite, loaded, uniform, vector};
use fastrand::Rng;
use signorini::law::{Bound, Contact, PairLaw, exceed_gaps, gaps_within_reach, pressing};

/// An obstacle is within reach if its gap is at most `far` times what moves some component: a load over the root
/// of its stiffness, and times that root a known displacement, a slip, an interference, and the gap of an
/// obstacle within reach. Here the set grows until it stays; the numbers are far enough from the limits that
/// rounding decides nothing.
#[test]
fn obstacles_out_of_reach_are_those_that_nothing_comes_near() {
    let (mut some, mut all) = (0, 0);
    for seed in 0..3000 {
        let mut rng = Rng::with_seed(seed);
        let (dim, pairs) = (rng.usize(2..=3), rng.usize(1..=5));
        let n = dim * pairs;
        let size = |rng: &mut Rng, most: f64| decades(rng, most) * 1e-12;
        let signed = |rng: &mut Rng| match rng.u8(0..4) {
            0 => 0.0,
            1 => -size(rng, 12.0),
            _ => size(rng, 12.0),
        };
        let unit: Vec<f64> = (0..n).map(|_| decades(&mut rng, 8.0)).collect();
        let k = (0..n * n).map(|at| if at % (n + 1) == 0 { unit[at / n] } else { 0.0 }).collect();
        let f = (0..n).map(|_| signed(&mut rng)).collect();
        let moved: Vec<f64> = (0..n).map(|_| signed(&mut rng)).collect();
        let slip = rng.bool().then(|| (0..n - pairs).map(|_| signed(&mut rng)).collect());
        let gap = (0..pairs).map(|_| match rng.u8(0..4) {
            0 => f64::INFINITY,
            1 => -size(&mut rng, 12.0),
            _ => size(&mut rng, 24.0),
        });
        let gap: Vec<f64> = gap.collect();
        let case = Case { dim, pairs, k, f, gap, law: Law::Coulomb(vec![0.3; pairs]), slip };
        let far = 1e3;
        let length = |pair: usize| case.gap[pair] * unit[dim * pair].sqrt();
        let mut reach = 0.0_f64;
        for i in 0..n {
            let root = unit[i].sqrt();
            reach = reach.max(case.f[i].abs() / root).max(moved[i].abs() * root);
            let (pair, c) = (i / dim, i % dim);
            reach = reach.max(match c {
                0 => (-length(pair)).max(0.0),
                c => case.rest(pair, c - 1).abs() * root,
            });
        }
        let mut near = vec![false; pairs];
        for _ in 0..pairs {
            for (pair, near) in near.iter_mut().enumerate() {
                *near = length(pair) <= far * reach;
                reach = if *near { reach.max(length(pair)) } else { reach };
            }
        }
        let expected: Vec<f64> = near
            .iter()
            .zip(&case.gap)
            .map(|(n, gap)| if *n { *gap } else { f64::INFINITY })
            .collect();
        let nothing_far = expected == case.gap;
        let problem = case.problem();
        let found = gaps_within_reach(&Contact::new(&problem), &moved, far);
        some += usize::from(!nothing_far);
        all += usize::from(nothing_far);
        let nothing_moves = reach == 0.0;
        let expected = (!nothing_far && !nothing_moves).then_some(expected);
        assert_eq!(found, expected, "seed {seed}: {case:?}, {moved:?}");
    }
    assert!(some > 300 && all > 300, "{some}, {all}");
}

/// Pressing forces that balance each other on two gaps that face each other, 1 and `-1 - e`: the sum is `-e`, and
/// its terms 2. From a millionth of them on it is a contradiction; beside it a pair that carries nothing has no
/// say, obstacle or not.
#[test]
fn gaps_contradict_each_other_from_a_millionth_on() {
    for (excess, expected) in
        [(2_f64.powi(-18), true), (2_f64.powi(-20), false), (0.0, false), (-1.0, false)]
    {
        for unit in [-60, 0, 60].map(|exponent| 2_f64.powi(exponent)) {
            for other in [f64::INFINITY, -7.0] {
                let k = (0..36).map(|i| if i % 7 == 0 { 1.0 } else { 0.0 }).collect();
                let gap = vec![3.0 * unit, -(1.0 + excess) * unit, other];
                let law = Law::Coulomb(vec![0.3; 3]);
                let case = Case { dim: 2, pairs: 3, k, f: vec![0.0; 6], gap, law, slip: None };
                // The first row is held at 2: its obstacle is 1 away.
                let offset = [2.0 * unit, 5.0, 0.0, 5.0, 0.0, 5.0];
                let force = pressing(2, &[-1.0, -9.0, -1.0, 9.0, 4.0, 9.0]);
                assert_eq!(force, [-1.0, 0.0, -1.0, 0.0, 0.0, 0.0]);
                let found = exceed_gaps(&case.problem(), &force, &offset);
                assert_eq!(found, expected, "{excess:e}, {other}");
            }
        }
    }
}

/// The largest part of a motion that can be taken back without penetration leaves no pair inside its obstacle, and
/// one on it if it is less than the whole.
#[test]
fn the_admissible_part_of_a_motion_ends_at_an_obstacle() {
    let mut less = 0;
    for seed in 0..2000 {
        let mut rng = Rng::with_seed(seed);
        let (dim, pairs) = (rng.usize(2..=3), rng.usize(1..=4));
        let k = definite(&mut rng, dim * pairs, 10.0);
        let case = loaded(&mut rng, dim, k, Law::Coulomb(vec![0.3; pairs]));
        let problem = case.problem();
        let contact = Contact::new(&problem);
        let d = contact.admissible(&vector(&mut rng, case.size()));
        let motion = vector(&mut rng, case.size());
        let part = contact.admissible_part(&d, &motion);
        let clearance = |part: f64| {
            let normal = |pair: usize| d[dim * pair] - part * motion[dim * pair];
            (0..pairs).map(|pair| case.gap[pair] - normal(pair)).fold(f64::INFINITY, f64::min)
        };
        // Numbers of order 1 and a few roundings.
        assert!((0.0..=1.0).contains(&part) && clearance(part) >= -1e-15, "seed {seed}: {part}");
        if part < 1.0 {
            less += 1;
            assert!(clearance(part) <= 1e-15, "seed {seed}: {part}");
        }
    }
    assert!(less > 300, "{less}");
}

/// Forces beside the tension, and the tension, are the forces of equilibrium: `K d - f`.
#[test]
fn forces_are_those_beside_the_tension_and_the_tension() {
    for seed in 0..200 {
        let mut rng = Rng::with_seed(seed);
        let (dim, pairs) = (rng.usize(2..=3), rng.usize(1..=4));
        let k = definite(&mut rng, dim * pairs, 10.0);
        let law = (0..pairs).flat_map(|_| [0.3, 2.0, uniform(&mut rng, 0.0, 3.0)]).collect();
        let case = loaded(&mut rng, dim, k, Law::Cohesive(law));
        let problem = case.problem();
        let contact = Contact::new(&problem);
        let d = vector(&mut rng, case.size());
        let mut force = contact.shifted_force(&d);
        contact.add_tension(&mut force);
        for ((force, kd), f) in force.iter().zip(product(&case.k, &d)).zip(&case.f) {
            // Sums of some ten numbers of order 10.
            assert!((force - (kd - f)).abs() <= 1e-13, "seed {seed}: {case:?}");
        }
    }
}

/// Displacements in two parts lose nothing where the first and the reference cancel.
#[test]
fn the_lower_part_of_a_displacement_counts_beyond_the_reference() {
    let bound = Bound { slope: 0.3, offset: 0.0 };
    let law = PairLaw::new(3, 1.0, [2.0, -4.0], bound, (1.0, 1.0));
    let low = [2_f64.powi(-60), -(2_f64.powi(-61)), 2_f64.powi(-62)];
    assert_eq!(law.beyond_reference(&[1.0, 2.0, -4.0], &low), low);
    // 1 - 2^-53 is a double, and 2 less 2^-60 is none.
    let tiny = PairLaw::new(3, 2_f64.powi(-60), [0.0; 2], bound, (1.0, 1.0));
    assert_eq!(tiny.beyond_reference(&[2.0, 0.0, 0.0], &[2_f64.powi(-60), 0.0, 0.0])[0], 2.0);
    let beyond = tiny.beyond_reference(&[2_f64.powi(-60), 0.0, 0.0], &low);
    assert_eq!(beyond, low);
}
