//! Sparse models whose pairs are rows over any nodes: chains, nodes in several pairs, supports at slaves.

use crate::common::dense::{difference, dot, largest};
use crate::common::problems::{uniform, vector};
use crate::rows::{Host, solved, springs};
use fastrand::Rng;
use signorini::{Argument, Error, FrictionLaw, LoadCase, Monitor, Settings, Status};

/// A host with `pairs` rows of one slave each (its first node) against up to three masters; slaves are not
/// masters.
fn slaves_and_masters(rng: &mut Rng) -> Host {
    let dim = rng.usize(2..=3);
    let (nodes, pairs) = (rng.usize(8..=14), rng.usize(1..=4));
    let stiffness = springs(rng, dim * nodes);
    let mut order: Vec<usize> = (0..nodes).collect();
    rng.shuffle(&mut order);
    let mut rows = Vec::new();
    for &slave in &order[..pairs] {
        let count = rng.usize(0..=3);
        let mut weights: Vec<f64> = (0..count).map(|_| uniform(rng, -0.3, 1.0)).collect();
        let rest: f64 = weights.iter().skip(1).sum();
        weights.iter_mut().take(1).for_each(|first| *first = 1.0 - rest);
        let mut row = vec![(slave, 1.0)];
        row.extend(weights.iter().map(|weight| (order[rng.usize(pairs..nodes)], -weight)));
        rows.push(row);
    }
    let is_slave = |dof: &usize| order[..pairs].contains(&(dof / dim));
    let fixed = (0..dim * nodes).filter(|dof| !is_slave(dof) && rng.u8(0..5) == 0).collect();
    let normals = vector(rng, dim * pairs);
    let tangents = rng.bool().then(|| {
        let mut tangents = vector(rng, dim * pairs);
        for (tangent, normal) in tangents.chunks_mut(dim).zip(normals.chunks(dim)) {
            let part = dot(tangent, normal) / dot(normal, normal);
            tangent.iter_mut().zip(normal).for_each(|(t, n)| *t -= part * n);
        }
        tangents
    });
    Host { dim, stiffness, fixed, rows, normals, tangents }
}

/// A host whose rows name any nodes, with supports anywhere.
fn any_rows(rng: &mut Rng) -> Host {
    let dim = rng.usize(2..=3);
    let (nodes, pairs) = (rng.usize(8..=12), rng.usize(2..=6));
    let mut rows = Vec::new();
    for _ in 0..pairs {
        let count = rng.usize(2..=4);
        let mut weights: Vec<f64> = (0..count).map(|_| uniform(rng, -1.0, 1.0)).collect();
        let wanted = f64::from(rng.u8(0..2));
        let rest: f64 = weights.iter().skip(1).sum();
        weights[0] = wanted - rest;
        rows.push(weights.into_iter().map(|weight| (rng.usize(0..nodes), weight)).collect());
    }
    let fixed = (0..dim * nodes).filter(|_| rng.u8(0..8) == 0).collect();
    let stiffness = springs(rng, dim * nodes);
    Host { dim, stiffness, fixed, rows, normals: vector(rng, dim * pairs), tangents: None }
}

/// The rows are the same, so all that a model gives is: to 1e-12 of the largest, a thousand roundings.
#[test]
fn a_signed_list_is_the_pair_of_one_slave() {
    for seed in 0..200 {
        let rng = &mut Rng::with_seed(seed);
        let host = slaves_and_masters(rng);
        let (named, listed) = (host.model_of_slaves().unwrap(), host.model().unwrap());
        let close = |a: &[f64], b: &[f64], what: &str| {
            let error = largest(&difference(a, b));
            assert!(error <= 1e-12 * largest(b), "seed {seed}: {what}: {error:e}");
        };
        assert_eq!(named.frames(), listed.frames());
        close(listed.stiffness(), named.stiffness(), "K_rel");
        let load = vector(rng, host.size());
        let values = vector(rng, host.fixed.len());
        let d = vector(rng, host.dim * host.rows.len());
        let condensed =
            |model: &signorini::Model| model.condensed_load(&load, Some(&values)).unwrap();
        close(&condensed(&listed), &condensed(&named), "f");
        let recovered =
            |model: &signorini::Model| model.recover(Some(&load), Some(&values), &d).unwrap();
        close(&recovered(&listed), &recovered(&named), "u");
        close(&listed.nodal_forces(&d).unwrap(), &named.nodal_forces(&d).unwrap(), "Bᵀ F");
    }
}

/// `K_rel` of any independent rows is that of the saddle point problem, by dense elimination. To 1e-9 of
/// the largest entry: rows are random, and nearly dependent at times.
#[test]
fn stiffness_is_that_of_the_saddle_point_problem() {
    let mut independent = 0;
    for seed in 0..200 {
        let host = any_rows(&mut Rng::with_seed(seed));
        let Ok(model) = host.model() else { continue };
        if !model.dependent_pairs().is_empty() {
            continue;
        }
        let expected = host.relative_stiffness(&model);
        let error = largest(&difference(model.stiffness(), &expected)) / largest(&expected);
        assert!(error <= 1e-9, "seed {seed}: {error:e}");
        independent += 1;
    }
    assert!(independent > 80, "{independent}");
}

/// Loads, prescribed values and contact forces balance in the host's full size, whatever the rows are; to
/// 1e-9 of the forces, a thousand times the tolerance. Prescribed values may leave dependent rows no solution,
/// or may be refused where they alone open a pair.
#[test]
fn any_rows_balance_in_the_host() {
    let (mut dependent, mut driven) = (0, 0);
    for (seed, drives) in (0..300).flat_map(|seed| [(seed, false), (seed, true)]) {
        let rng = &mut Rng::with_seed(seed);
        let host = any_rows(rng);
        let Ok(model) = host.model() else { continue };
        let pairs = host.rows.len();
        let load: Vec<f64> = vector(rng, host.size()).iter().map(|f| 3.0 * f).collect();
        let gap: Vec<f64> = vector(rng, pairs).iter().map(|gap| gap.abs()).collect();
        let mu: Vec<f64> = (0..pairs).map(|_| uniform(rng, 0.0, 0.4)).collect();
        let values: Vec<f64> = vector(rng, host.fixed.len()).iter().map(|u| 0.3 * u).collect();
        let case = LoadCase {
            load: &load,
            prescribed: drives.then_some(&values[..]),
            gap: &gap,
            law: FrictionLaw::Coulomb(&mu),
            reference_slip: None,
        };
        let settings = Settings { tolerance: 1e-12, ..Settings::default() };
        let solution = model.solve(&case, &settings, None, &mut Monitor::new(&settings, None));
        let is_dependent = !model.dependent_pairs().is_empty();
        match solution {
            Ok(solution) if solution.status == Status::Solved => {
                host.assert_balanced(&model, &case, &solution, 1e-9);
                dependent += usize::from(is_dependent);
                driven += usize::from(drives && is_dependent);
            }
            Ok(solution) => {
                assert!(drives && is_dependent, "seed {seed}: {}", solution.message);
            }
            Err(Error::Invalid { argument: Argument::Prescribed, .. }) => assert!(drives),
            Err(error) => panic!("seed {seed}: {error}"),
        }
    }
    assert!(dependent > 40 && driven > 15, "{dependent} dependent, {driven} of them driven");
}

/// A slave on a plane of symmetry x = 0 that faces an inclined obstacle: a tangent along x neither moves nor
/// carries, and the pair has a stiffness. Tangents across the plane move by one motion, with one friction.
#[test]
fn tangents_along_supports_are_held() {
    let mut stiffness = vec![0.0; 9];
    (0..3).for_each(|i| stiffness[4 * i] = 2.0);
    let mut host = Host {
        dim: 3,
        stiffness,
        fixed: vec![0],
        rows: vec![vec![(0, 1.0)]],
        normals: vec![0.0, -0.6, -0.8],
        tangents: None,
    };
    let held = host.model().unwrap();
    assert!(held.dependent_pairs().is_empty());
    host.tangents = Some(vec![1.0, 0.8, -0.6]);
    let across = host.model().unwrap();
    assert_eq!(across.dependent_pairs(), [0]);
    // Pressed by 1 along the normal and pushed by 1 along the plane: mu 0.3 holds 0.3, springs the rest.
    let load = [0.0, -0.6 + 0.8, -0.8 - 0.6];
    for model in [held, across] {
        let solution = solved(&model, &load, &[0.0], &[0.3]);
        assert_eq!(solution.status, Status::Solved, "{}", solution.message);
        let u = model.recover(Some(&load), None, &solution.d).unwrap();
        let nodal = model.nodal_forces(&solution.certificate.force).unwrap();
        // The friction of tangents across the plane has a part along x, which the support carries.
        let along = [0.0, 0.8, -0.6];
        let moved = dot(&u, &along);
        assert!((2.0 * moved - 1.0 - dot(&nodal, &along)).abs() < 1e-10);
        let friction = dot(&nodal, &along);
        assert!((friction + 0.3).abs() < 1e-9, "{friction}");
    }
}

/// Three springs of 1: node 0 is pressed by 1 upon node 1, and by a second pair upon a point that is off node 1 by `off` of
/// the way to node 2, as rounded coordinates leave it. That point yields less than node 1, so that the second pair carries all:
/// `F (1 + (1 - off)² + off²) = 1`. To 1e-10, the tolerance. Rows that agree to 1e-9 are one, and share the force.
#[test]
fn pairs_that_nearly_repeat_others_carry_the_force() {
    for friction in [None, Some(0.5)] {
        for (off, full_space) in (0..=13).flat_map(|k| [(k, false), (k, true)]) {
            let off = if off == 0 { 0.0 } else { 10f64.powi(-off) };
            let mut stiffness = vec![0.0; 36];
            (0..6).for_each(|i| stiffness[7 * i] = 1.0);
            let host = Host {
                dim: 2,
                stiffness,
                fixed: vec![],
                rows: vec![vec![(0, 1.0), (1, -1.0)], vec![(0, 1.0), (1, off - 1.0), (2, -off)]],
                normals: [0.0, -1.0].repeat(2),
                tangents: None,
            };
            let settings = Settings { full_space, ..Settings::default() };
            let model = host.model_with(&settings).unwrap();
            let mu = [friction.unwrap_or_default(); 2];
            let case = LoadCase {
                load: &[0.0, -1.0, 0.0, 0.0, 0.0, 0.0],
                prescribed: None,
                gap: &[0.0; 2],
                law: if friction.is_some() {
                    FrictionLaw::Coulomb(&mu)
                } else {
                    FrictionLaw::Frictionless
                },
                reference_slip: None,
            };
            let solution =
                model.solve(&case, &settings, None, &mut Monitor::new(&settings, None)).unwrap();
            assert_eq!(
                solution.status,
                Status::Solved,
                "{off:e} {friction:?}: {}",
                solution.message
            );
            let force = &solution.certificate.force;
            let carried = (1.0 + (1.0 - off).powi(2) + off * off).recip();
            let error = (force[0] + force[2] + carried).abs();
            let as_one = if off <= 1e-9 { off } else { 0.0 };
            assert!(error <= 1e-10 + as_one, "{off:e} {friction:?}: {error:e}");
            assert!(force[0].abs() <= 1e-10 || off <= 1e-9, "{off:e} {friction:?}: {force:?}");
        }
    }
}

/// Grains of size 1 in a box, packed row by row into the hollows of the row below, each on a spring of its own and pressed by
/// its weight; contacts have clearances up to a thousandth. There are more contacts than a grain has ways to move, so
/// that rows depend on each other. The springs are definite: whatever the coefficient of friction there is a solution.
#[test]
fn packed_grains_find_their_equilibrium() {
    for (columns, layers) in
        (2..=5).flat_map(|columns| (1..=5).map(move |layers| (columns, layers)))
    {
        let places: Vec<[f64; 2]> = (0..layers)
            .flat_map(|j| (0..columns - j % 2).map(move |i| (i, j)))
            .map(|(i, j)| [i as f64 + 0.5 * (j % 2) as f64, j as f64 * 0.75_f64.sqrt()])
            .collect();
        let (mut rows, mut normals) = (Vec::new(), Vec::new());
        for (a, from) in places.iter().enumerate() {
            for (b, to) in places.iter().enumerate().skip(a + 1) {
                let apart = [to[0] - from[0], to[1] - from[1]];
                if (apart[0].hypot(apart[1]) - 1.0).abs() < 0.1 {
                    rows.push(vec![(a, 1.0), (b, -1.0)]);
                    normals.extend(apart);
                }
            }
            let walls = [
                (from[1] == 0.0, [0.0, -1.0]),
                (from[0] == 0.0, [-1.0, 0.0]),
                (from[0] == (columns - 1) as f64, [1.0, 0.0]),
            ];
            for (_, normal) in walls.into_iter().filter(|(touches, _)| *touches) {
                rows.push(vec![(a, 1.0)]);
                normals.extend(normal);
            }
        }
        let pairs = rows.len();
        let gap: Vec<f64> = (1..=pairs).map(|pair| 2e-4 * (7 * pair % 5) as f64).collect();
        let load = [0.0, -1.0].repeat(places.len());
        for (mu, spring) in [0.1, 0.3, 0.5, 1.0].into_iter().flat_map(|mu| [(mu, 1e-2), (mu, 1e-3)])
        {
            let size = 2 * places.len();
            let mut stiffness = vec![0.0; size * size];
            stiffness.iter_mut().step_by(size + 1).for_each(|entry| *entry = spring);
            let (rows, normals) = (rows.clone(), normals.clone());
            let host = Host { dim: 2, stiffness, fixed: vec![], rows, normals, tangents: None };
            let settings = Settings::default();
            let mu_of_pairs = vec![mu; pairs];
            let law = FrictionLaw::Coulomb(&mu_of_pairs);
            let case =
                LoadCase { load: &load, prescribed: None, gap: &gap, law, reference_slip: None };
            let model = host.model().unwrap();
            let monitor = &mut Monitor::new(&settings, None);
            let solution = model.solve(&case, &settings, None, monitor).unwrap();
            assert_eq!(
                solution.status,
                Status::Solved,
                "{columns} x {layers}, mu {mu}, springs {spring:e}: {}",
                solution.message
            );
        }
    }
}
