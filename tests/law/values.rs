//! The law's answers for all pairs together, each by its own definition: which obstacles are out of reach, whether
//! gaps contradict each other, how far pairs may move, and forces beside their tension.

use crate::common::dense::product;
use crate::common::problems::{Case, Law, decades, definite, loaded, uniform, vector};
use crate::laws::Numbers;
use fastrand::Rng;
use signorini::law::Tangential;
use signorini::law::complementarity::lower_bounds;
use signorini::law::{
    Bound, Contact, PairLaw, Piece, Rule, State, bounded, exceed_gaps, friction_is_large,
    gaps_within_reach, length, touching,
};
use signorini::{ContactData, ContactProblem, FrictionLaw};

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
                let force = bounded(&case.problem(), &[-1.0, -9.0, -1.0, 9.0, 4.0, 9.0]);
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
        let mut motion = vector(&mut rng, case.size());
        motion.iter_mut().filter(|_| rng.u8(0..3) == 0).for_each(|r| *r = 0.0);
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
            // No larger part of it can be taken.
            assert!(clearance(part + 1e-3) < 0.0, "seed {seed}: {part}");
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
        let mut force = contact.force_without_tension(&d);
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

/// Zero displacement without a force is admissible if it obeys the law: whatever the bound of friction is.
#[test]
fn zero_is_admissible_where_it_obeys_the_law() {
    let rng = &mut Rng::with_seed(6);
    let mut seen = [0; 2];
    for _ in 0..3000 {
        let numbers = Numbers { slip0: [0.0; 2], ..Numbers::random(rng) };
        let v = [-numbers.gap, 0.0, 0.0];
        let admits = numbers.defect(&v, &[0.0; 3]) == 0.0;
        assert_eq!(numbers.law().admits_zero(), admits, "{numbers:?}");
        seen[usize::from(admits)] += 1;
    }
    assert!(seen.iter().all(|&count| count > 300), "{seen:?}");
}

/// Two kinds of pairs are decided: one that is open and carries nothing, and one that sticks. The point on which it is
/// held obeys the law, as its own does; a slip, and an open pair that may carry a force, have no such point.
#[test]
fn pairs_are_held_where_their_state_says_where() {
    let rng = &mut Rng::with_seed(7);
    let mut seen = [0; 3];
    for _ in 0..3000 {
        let numbers = Numbers::random(rng);
        let (v, p) = numbers.point(rng, 1e-6);
        let (d, force) = numbers.of_host(&v, &p);
        let law = numbers.law();
        let held = law.decided(law.piece(&law.trial(&d, &force)));
        let open = p[0] == -numbers.tension;
        let slips = v[1..].iter().any(|slip| *slip != 0.0);
        let free = numbers.bound.offset == 0.0 && numbers.tension == 0.0;
        let acts = numbers.threshold(p[0]) > 0.0;
        let expected = match (open, slips) {
            (true, _) => free.then_some(Piece::OPEN),
            (false, false) if acts => Some(law.stick()),
            _ => None,
        };
        assert_eq!(held, expected, "{numbers:?} {v:?} {p:?}");
        seen[held.map_or(0, |held| 1 + usize::from(held == Piece::OPEN))] += 1;
    }
    assert!(seen.iter().all(|&count| count > 300), "{seen:?}");
}

/// A statement about all pairs together holds if it holds of each, or of one.
#[test]
fn what_is_said_of_all_pairs_is_so_of_each() {
    let mut seen = [[0; 2]; 5];
    for seed in 0..3000 {
        let mut rng = Rng::with_seed(seed);
        let (dim, pairs) = (rng.usize(2..=3), rng.usize(1..=3));
        let k = definite(&mut rng, dim * pairs, 10.0);
        let number = |rng: &mut Rng| [0.0, 0.5][rng.usize(0..2)];
        let law = match rng.u8(0..3) {
            0 => Law::Coulomb((0..pairs).map(|_| number(&mut rng)).collect()),
            1 => Law::Tresca((0..pairs).map(|_| number(&mut rng)).collect()),
            _ => {
                let (mu, tension) = (number(&mut rng), number(&mut rng));
                Law::Cohesive([mu, mu * tension + number(&mut rng), tension].repeat(pairs))
            }
        };
        let mut case = loaded(&mut rng, dim, k, law);
        for pair in 0..pairs {
            case.gap[pair] = [0.0, 1.0, f64::INFINITY, -1.0][rng.usize(0..4)];
        }
        if rng.u8(0..4) > 0 {
            case.f.fill(0.0);
        }
        case.slip = rng.bool().then(|| (0..(dim - 1) * pairs).map(|_| number(&mut rng)).collect());
        let problem = case.problem();
        let contact = Contact::new(&problem);
        let each = |said: &dyn Fn(usize) -> bool| (0..pairs).all(said);
        let unloaded = case.f.iter().all(|f| *f == 0.0)
            && each(&|pair| {
                let (gap, tension) = (case.gap[pair], case.law.of(pair)[2]);
                if tension > 0.0 { gap == 0.0 } else { gap >= 0.0 }
            });
        let no_slip = each(&|pair| (0..dim - 1).all(|c| case.rest(pair, c) == 0.0));
        // Without an obstacle no pressure acts beside the tension, and friction is what the bound is then.
        let frictionless = each(&|pair| {
            let [mu, b, a] = case.law.of(pair);
            b == mu * a && (mu == 0.0 || case.gap[pair].is_infinite())
        });
        let coupled = !each(&|pair| case.law.of(pair)[0] == 0.0);
        let found = [
            (contact.is_unloaded(), unloaded),
            (contact.is_at_rest(), unloaded && no_slip),
            (contact.is_frictionless(), frictionless),
            (contact.is_coupled(), coupled),
            (contact.has_collinear_slip(), false),
        ];
        for ((found, expected), seen) in found.into_iter().zip(&mut seen) {
            assert_eq!(found, expected, "seed {seed}: {case:?}");
            seen[usize::from(found)] += 1;
        }
    }
    assert!(seen[..4].iter().flatten().all(|&count| count > 100), "{seen:?}");
}

/// Only a pair with an ellipse slips along its friction in the place of the normal, and by one rule.
#[test]
fn collinear_slip_is_that_of_its_rule() {
    let rng = &mut Rng::with_seed(8);
    let mut seen = 0;
    for _ in 0..1000 {
        let numbers = Numbers::random(rng);
        let collinear = numbers.axes.is_some_and(|axes| axes.rule == Rule::Collinear);
        assert_eq!(numbers.law().is_collinear(), collinear, "{numbers:?}");
        assert!(!matches!(numbers.law().stick().tangential, Tangential::Slip { .. }));
        let coupled = numbers.has_obstacle() && numbers.bound.slope > 0.0;
        assert_eq!(numbers.law().is_coupled(), coupled, "{numbers:?}");
        seen += usize::from(collinear);
    }
    assert!(seen > 50, "{seen}");
    let case =
        loaded(rng, 3, definite(&mut Rng::with_seed(9), 6, 10.0), Law::Coulomb(vec![0.3; 2]));
    let numbers = [0.3, 0.5, 0.1, 0.2, 0.4, 0.0];
    for (law, expected) in [
        (FrictionLaw::Orthotropic(&numbers), false),
        (FrictionLaw::OrthotropicCollinear(&numbers), true),
    ] {
        let problem = ContactProblem::new(ContactData { law, ..case.data() }).unwrap();
        assert_eq!(Contact::new(&problem).has_collinear_slip(), expected);
    }
}

/// An obstacle stops the normal component of its pair, from its gap on. A pair touches there, within 1e-11 of the
/// largest displacement, and wherever its state is not open.
#[test]
fn obstacles_stop_normal_components_at_their_gaps() {
    for seed in 0..500 {
        let mut rng = Rng::with_seed(seed);
        let (dim, pairs) = (rng.usize(2..=3), rng.usize(1..=4));
        let k = definite(&mut rng, dim * pairs, 10.0);
        let mut case = loaded(&mut rng, dim, k, Law::Coulomb(vec![0.3; pairs]));
        let unit = [1e-6, 1.0, 1e6][rng.usize(0..3)];
        for gap in &mut case.gap {
            *gap = [1.0, -1.0, 0.5, f64::INFINITY][rng.usize(0..4)] * unit;
        }
        let mut d: Vec<f64> =
            (0..case.size()).map(|_| unit * uniform(&mut rng, -2.0, 2.0)).collect();
        let largest = d.iter().fold(0.0_f64, |most, d| most.max(d.abs()));
        let mut states = Vec::new();
        let mut expected = Vec::new();
        for pair in 0..pairs {
            let gap = case.gap[pair];
            let kind = rng.usize(0..4);
            if gap.is_finite() {
                let off = [0.0, 1e-13, 1e-9, -0.5][kind];
                d[dim * pair] = gap - off * largest;
            }
            states.push([State::Open, State::Slip, State::Stick][rng.usize(0..3)]);
            let near = gap.is_finite() && kind != 2;
            if near || states[pair] != State::Open {
                expected.push(pair);
            }
        }
        let problem = case.problem();
        let contact = Contact::new(&problem);
        let found: Vec<usize> = touching(&contact, &d, &states).collect();
        assert_eq!(found, expected, "seed {seed}: {case:?} {d:?}");
        let lower = lower_bounds(&contact);
        assert_eq!(lower.len(), case.size());
        for (i, lower) in lower.into_iter().enumerate() {
            let bounded = i % dim == 0 && case.gap[i / dim].is_finite();
            let bound = if bounded { -case.gap[i / dim] } else { f64::NEG_INFINITY };
            assert_eq!(lower, bound);
        }
    }
}

/// A coefficient above 10 is large; an angle, a cohesion and a tension are no coefficients.
#[test]
fn only_coefficients_are_large_friction() {
    let large = friction_is_large;
    assert!(large(FrictionLaw::Coulomb(&[0.1, 10.5])) && !large(FrictionLaw::Coulomb(&[10.0])));
    assert!(!large(FrictionLaw::Tresca(&[11.0])) && !large(FrictionLaw::Frictionless));
    let cohesive = |numbers: [f64; 3]| large(FrictionLaw::Cohesive(&numbers));
    assert!(cohesive([11.0, 400.0, 20.0]) && !cohesive([0.3, 400.0, 20.0]));
    for (numbers, expected) in
        [([0.3, 0.3, 30.0], false), ([0.3, 11.0, 0.0], true), ([11.0, 0.3, 0.0], true)]
    {
        assert_eq!(large(FrictionLaw::Orthotropic(&numbers)), expected, "{numbers:?}");
        assert_eq!(large(FrictionLaw::OrthotropicCollinear(&numbers)), expected, "{numbers:?}");
    }
}

/// Contact prescribes a displacement by a slip that has been, and by a gap that has closed: the largest of these lengths.
#[test]
fn contact_prescribes_closed_gaps_and_earlier_slips() {
    let law = |gap| {
        let bound = Bound { slope: 0.3, offset: 0.0 };
        PairLaw::new(3, gap, [2.0, -3.0], bound, (1.0, 1.0))
    };
    for (gap, d_n, expected) in [
        (5.0, 5.0, 5.0),
        (5.0, 6.0, 5.0),
        (5.0, 4.0, 3.0),
        (-7.0, 0.0, 7.0),
        (-7.0, -8.0, 3.0),
        (1.0, 1.0, 3.0),
        (f64::INFINITY, 9.0, 3.0),
    ] {
        assert_eq!(law(gap).prescribed(d_n), expected, "{gap}, {d_n}");
    }
    assert_eq!(law(5.0).with_tie().prescribed(0.0), 5.0);
}

/// Sides of 3 and 4 in units of every power of two, down to the smallest number.
#[test]
fn a_triangle_in_any_units() {
    for power in -1074..=1021 {
        // 2^power, also where it is subnormal.
        let unit = 2.0_f64.powi(power.max(-1000)) * 2.0_f64.powi((power + 1000).min(0));
        assert_eq!(length(&[3.0 * unit, -4.0 * unit]), 5.0 * unit, "{power}");
    }
    assert_eq!(length(&[0.0, 0.0]), 0.0);
    assert!(length(&[f64::NAN, 1.0]).is_nan());
}
