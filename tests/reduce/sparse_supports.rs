//! Parts without supports, supports on both sides of a pair, weights and normals.

use crate::common::mesh::{Mesh, Pairs, steps};
use crate::common::stack::{STEEL, Stack, close, components, solved};
use signorini::reduce::ContactPairs;
use signorini::{Argument, Error, FrictionLaw, LoadCase, Monitor, Settings};

/// A part that neither supports nor pairs hold is refused by one of its degrees of freedom.
#[test]
fn a_part_that_nothing_holds_is_refused() {
    for place in 0..3 {
        let mut mesh = Mesh::default();
        let mut loose = None;
        let mut add = |mesh: &mut Mesh, at: usize| {
            if at == place {
                let y = steps(7.0, 8.0, 2);
                loose = Some(mesh.block(&steps(0.0, 2.0, 3), &y, STEEL));
            }
        };
        add(&mut mesh, 0);
        let lower = mesh.block(&steps(0.0, 3.0, 3), &steps(0.0, 1.0, 2), STEEL);
        add(&mut mesh, 1);
        let upper = mesh.block(&steps(0.0, 3.0, 3), &steps(1.0, 2.0, 2), STEEL);
        add(&mut mesh, 2);
        let loose = loose.unwrap();
        let line = lower.row(0);
        let mut fixed = [components(&line, 0), components(&line, 1)].concat();
        let pairs = Pairs::matching(&upper.row(0), &lower.row(2), [0.0, -1.0]);
        let stiffness = mesh.stiffness();
        // Not held at all, held against motion upwards only, and but for one rotation.
        let corner = loose.node(0, 0);
        for held in [vec![], vec![2 * corner + 1], vec![2 * corner, 2 * corner + 1]] {
            fixed.extend(&held);
            let Err(Error::Invalid { argument, message }) = stiffness.model(&fixed, &pairs) else {
                panic!("place {place}: a part is loose");
            };
            fixed.truncate(fixed.len() - held.len());
            assert_eq!(argument, Argument::Matrix, "{message}");
            // All that it names, three at the most, are of the loose part.
            let named: Vec<usize> = message
                .split("degree of freedom ")
                .skip(1)
                .map(|rest| rest.split(' ').next().unwrap().parse().expect("a number"))
                .collect();
            assert!(!named.is_empty(), "{message}");
            let loose = |dof: &usize| loose.nodes().contains(&(dof / 2));
            assert!(named.iter().all(loose), "place {place}: {message}");
        }
        fixed.extend([2 * corner, 2 * corner + 1, 2 * loose.node(0, 2)]);
        assert!(stiffness.model(&fixed, &pairs).is_ok());
    }
}
/// Half models: where the plane of symmetry meets the interface, slave and master are both held
/// along it. The component between them is a row of its own, zero and without force.
#[test]
fn a_slave_held_with_its_master_is_decoupled() {
    let stack = Stack::new([4, 4], [2000.0, 700.0]);
    let mut fixed = components(&stack.lower.row(0), 1);
    fixed.extend(components(&stack.lower.column(0), 0));
    fixed.extend(components(&stack.upper.column(0), 0));
    let model = stack.mesh.stiffness().model(&fixed, &stack.pairs()).unwrap();
    let (n, held) = (10, 1);
    for j in 0..n {
        let (row, column) = (model.stiffness()[held + n * j], model.stiffness()[j + n * held]);
        if j == held {
            assert!(row > 0.0);
        } else {
            assert_eq!((row, column), (0.0, 0.0), "{j}");
        }
    }
    // Loads and reactions of the support do not pass through the pair.
    let mut load = stack.load(7.0, 1.0);
    load[2 * stack.upper.node(0, 0)] = 100.0;
    for mu in [0.0, 0.3] {
        let solution = solved(&model, &load, mu);
        assert_eq!(solution.d[held], 0.0, "mu {mu}");
        assert_eq!(solution.certificate.force[held], 0.0, "mu {mu}");
    }
}

/// A master of weight zero, as interpolation leaves it at the end of a segment, does not count:
/// it need not be held where the slave is.
#[test]
fn a_master_of_weight_zero_does_not_count() {
    let stack = Stack::new([4, 4], [2000.0, 700.0]);
    let mut fixed = stack.bottom();
    fixed.extend(components(&stack.lower.column(0)[1..], 0));
    fixed.extend(components(&stack.upper.column(0), 0));
    let pairs = stack.pairs();
    let mut masters = pairs.masters.clone();
    masters[0].push((stack.lower.node(1, 2), 0.0));
    let stiffness = stack.mesh.stiffness();
    let weighted = Pairs::new(&pairs.slaves, &masters, [0.0, -1.0]);
    let models = [&pairs, &weighted].map(|pairs| stiffness.model(&fixed, pairs).unwrap());
    assert_eq!(models[0].stiffness(), models[1].stiffness());
}

/// A part that may still turn about a node within it is refused on fine meshes too, where rounding
/// leaves resistance of its own to that motion.
#[test]
fn a_finely_meshed_part_that_may_turn_is_refused() {
    for (columns, rows, width, height) in [(100, 100, 1.0, 1.0), (200, 10, 1.0, 1.0)] {
        for young in [1.0, 2.1e5, 2.1e11] {
            let mut mesh = Mesh::default();
            let body = mesh.block(&steps(0.0, 3.0, 3), &steps(0.0, 1.0, 2), STEEL);
            let (x, y) = (steps(7.0, 7.0 + width, columns), steps(0.1, 0.1 + height, rows));
            let loose = mesh.block(&x, &y, (young, 0.3));
            let pin = loose.node(columns / 3, rows / 2);
            let pairs = Pairs::on_obstacle(&body.row(0), [0.0, -1.0]);
            let context = format!("{columns} x {rows}, E {young}");
            match mesh.stiffness().model(&[2 * pin, 2 * pin + 1], &pairs) {
                Ok(_) => panic!("{context}: it is taken for held"),
                Err(error) => {
                    let message = error.to_string();
                    let most = message.split("most of all degree of freedom ").nth(1);
                    let named = most.and_then(|most| most.split(' ').next()?.parse().ok());
                    let named: usize = named.unwrap_or_else(|| panic!("{context}: {message}"));
                    assert!(loose.nodes().contains(&(named / 2)), "{context}: {message}");
                }
            }
            let held = [2 * pin, 2 * pin + 1, 2 * loose.node(0, 0) + 1];
            assert!(mesh.stiffness().model(&held, &pairs).is_ok(), "{context}: it is held");
        }
    }
}

/// A slender cantilever is weak at its tip, and held: 2 high, 10000 long, `3 E I / l³` is `2e-12` of
/// its elements' stiffness.
#[test]
fn a_slender_part_is_held() {
    for length in [100, 1000, 10_000] {
        let mut mesh = Mesh::default();
        let x = steps(0.0, length as f64, length);
        let beam = mesh.block(&x, &steps(0.0, 2.0, 2), STEEL);
        let root = beam.column(0);
        let fixed = [components(&root, 0), components(&root, 1)].concat();
        for first in [1, length - 2] {
            let pairs = Pairs::on_obstacle(&beam.row(0)[first..first + 3], [0.0, -1.0]);
            let made = mesh.stiffness().model(&fixed, &pairs);
            assert!(made.is_ok(), "length {length}, pairs from {first}: {:?}", made.err());
        }
    }
}

/// Where slave and master are both held along a component, and moved differently, the answer obeys
/// `u_slave = u_master + R d` all the same, or is refused.
#[test]
fn supports_that_part_a_pair_are_not_overlooked() {
    let stack = Stack::new([4, 4], [2000.0, 700.0]);
    let held = components(&stack.upper.column(0), 0);
    let mut fixed = stack.bottom();
    fixed.extend(components(&stack.lower.column(0)[1..], 0));
    let mut values = vec![0.0; fixed.len()];
    fixed.extend(&held);
    values.extend(vec![0.01; held.len()]);
    let model = stack.mesh.stiffness().model(&fixed, &stack.pairs()).unwrap();
    let load = stack.load(7.0, 0.0);
    let case = LoadCase {
        load: &load,
        prescribed: Some(&values),
        gap: &[0.0; 5],
        law: FrictionLaw::Coulomb(&[0.2; 5]),
        reference_slip: None,
    };
    let settings = Settings::default();
    let monitor = &mut Monitor::new(&settings, None);
    match model.solve(&case, &settings, None, monitor) {
        Err(Error::Invalid { argument, .. }) => assert_eq!(argument, Argument::Prescribed),
        Err(error) => panic!("{error}"),
        Ok(solution) => {
            let u = model.recover(Some(&load), Some(&values), &solution.d).unwrap();
            let (slave, master) = (stack.upper.node(0, 0), stack.lower.node(0, 2));
            let apart = u[2 * slave] - u[2 * master];
            assert!((apart - solution.d[1]).abs() < 1e-12, "{apart} apart, d_t {}", solution.d[1]);
        }
    }
}

/// Supports that move both sides of a pair alike: with all other supports along that axis it is a translation of the
/// whole, which changes no force. A motion that is linear along the interface parts no pair either, as masters
/// interpolate it. A slave that is moved by more than its masters is refused, with the distance. In
/// both forms of the rows.
#[test]
fn supports_may_move_both_sides_of_a_pair_alike() {
    let stack = Stack::new([3, 4], [2000.0, 700.0]);
    let (pairs, interface) = (stack.pairs(), stack.lower.row(stack.lower.rows));
    let slaves = components(&pairs.slaves[1..3], 0);
    let bottom = components(&stack.lower.row(0), 0);
    let mut fixed = [bottom, components(&interface, 0), slaves].concat();
    let along = fixed.len();
    fixed.extend(components(&stack.lower.row(0), 1));
    let last_slave = along - 1;
    let place = |dof: usize| stack.mesh.nodes[dof / 2][0];
    // General rows of these pairs: all nodes with signed weights.
    let view = pairs.view();
    let (mut start, mut dofs, mut weights) = (vec![0], vec![], vec![]);
    for (slave, masters) in pairs.slaves.iter().zip(&pairs.masters) {
        let row = std::iter::once((*slave, 1.0)).chain(masters.iter().map(|(n, w)| (*n, -w)));
        for (node, weight) in row {
            dofs.extend([2 * node, 2 * node + 1]);
            weights.push(weight);
        }
        start.push(weights.len());
    }
    let general = ContactPairs {
        slaves: &[],
        master_start: &start,
        masters: &dofs,
        weights: &weights,
        ..view
    };
    let load = stack.load(7.0, 1.0);
    for rows in [view, general] {
        let monitor = &mut Monitor::new(&Settings::default(), None);
        let model = stack.mesh.stiffness().model_under(&fixed, &rows, monitor).unwrap();
        let solve = |values: &[f64]| {
            let case = LoadCase {
                load: &load,
                prescribed: Some(values),
                gap: &[0.0; 5],
                law: FrictionLaw::Coulomb(&[0.2; 5]),
                reference_slip: None,
            };
            let settings = Settings { tolerance: 1e-12, ..Settings::default() };
            model.solve(&case, &settings, None, &mut Monitor::new(&settings, None))
        };
        let moved = |motion: &dyn Fn(f64) -> f64| -> Vec<f64> {
            let value =
                |(k, dof): (usize, &usize)| if k < along { motion(place(*dof)) } else { 0.0 };
            fixed.iter().enumerate().map(value).collect()
        };
        let rest = solve(&moved(&|_| 0.0)).unwrap();
        let translated = solve(&moved(&|_| 0.25)).unwrap();
        // Both are solved to 1e-12; the stiffness of 2000 makes 1e-12 of the motion's internal forces.
        let (force, other) = (&rest.certificate.force, &translated.certificate.force);
        close(other, force, 1e-9, "forces of a translation");
        let stretched = solve(&moved(&|x| 0.02 - 0.01 * x)).unwrap();
        assert_eq!((stretched.d[3], stretched.d[5]), (0.0, 0.0));
        for (motion, apart) in [(0.25, 0.125), (-0.5, -0.25)] {
            let mut values = moved(&|_| motion);
            values[last_slave] += apart;
            let Err(Error::Invalid { argument, message }) = solve(&values) else {
                panic!("a slave is moved by {apart} more than its masters");
            };
            assert_eq!(argument, Argument::Prescribed, "{message}");
            let told = message.split("apart by ").nth(1).and_then(|rest| rest.split(',').next());
            let told: f64 = told.and_then(|told| told.parse().ok()).expect("a distance");
            // The weights, thirds of an interval, are rounded.
            assert!((told.abs() - apart.abs()).abs() <= 1e-14, "{message}");
            assert!(message.contains("pair 2"), "{message}");
        }
    }
}

/// A normal has any length.
#[test]
fn the_length_of_a_normal_does_not_matter() {
    let stack = Stack::new([3, 4], [2000.0, 700.0]);
    let (stiffness, pairs) = (stack.mesh.stiffness(), stack.pairs());
    let reference = stiffness.model(&stack.bottom(), &pairs).unwrap();
    for length in [1e-300, 1e-200, 0.1, 3.0, 1e200, 1e300] {
        let pairs = Pairs::new(&pairs.slaves, &pairs.masters, [0.0, -length]);
        let model = stiffness.model(&stack.bottom(), &pairs);
        let model = model.unwrap_or_else(|error| panic!("length {length:e}: {error}"));
        close(model.stiffness(), reference.stiffness(), 1e-14, "K_rel");
    }
}

/// Supports that hold both sides of a pair along its normal leave no displacement that could take a penetration
/// away: it is refused with its place. A gap of 0 or more is as good as none.
#[test]
fn a_penetration_between_two_supports_is_refused() {
    let stack = Stack::new([4, 4], [2000.0, 700.0]);
    let mut fixed = components(&stack.lower.row(0), 1);
    fixed.extend(components(&stack.lower.column(0), 0));
    fixed.extend(components(&stack.upper.column(0), 0));
    // The first pair is held along the normal too.
    fixed.extend([2 * stack.upper.node(0, 0) + 1, 2 * stack.lower.column(0).last().unwrap() + 1]);
    let model = stack.mesh.stiffness().model(&fixed, &stack.pairs()).unwrap();
    let load = stack.load(7.0, 0.0);
    let solve = |gap: &[f64]| {
        let case = LoadCase {
            load: &load,
            prescribed: None,
            gap,
            law: FrictionLaw::Frictionless,
            reference_slip: None,
        };
        let settings = Settings::default();
        model.solve(&case, &settings, None, &mut Monitor::new(&settings, None))
    };
    let mut gap = vec![0.0; model.pairs()];
    for open in [0.0, 1e-3, f64::INFINITY] {
        gap[0] = open;
        let solution = solve(&gap).unwrap();
        // No more than rounding of the loads beside the displacements, 1e-2.
        assert!(solution.d[0].abs() <= 1e-15, "{open}: {:e}", solution.d[0]);
        assert_eq!(solution.certificate.force[0], 0.0, "{open}");
    }
    for penetration in [-1e-12, -1e-3] {
        gap[0] = penetration;
        let Err(Error::Invalid { argument, message }) = solve(&gap) else {
            panic!("a penetration of {penetration} is accepted");
        };
        assert_eq!(argument, Argument::Gap, "{message}");
        assert!(
            message.contains("gap[0]") && message.contains("fixed along its normal"),
            "{message}"
        );
    }
    // Another pair may penetrate: it is free to part.
    (gap[0], gap[1]) = (0.0, -1e-3);
    assert!(solve(&gap).is_ok());
}
