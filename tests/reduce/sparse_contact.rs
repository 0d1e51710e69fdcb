//! Bodies in one sparse matrix: patch test, balance, invariances, prescribed motion, flight.

use crate::common::dense::{difference, dot, largest};
use crate::common::measures::motion;
use crate::common::mesh::Pairs;
use crate::common::stack::{STEEL, Stack, close, components, solve_case, solved};
use fastrand::Rng;
use signorini::{Method, Status};

/// Contact forces of a uniform pressure on matching nodes: half an element's share at the ends.
fn uniform_forces(pressure: f64, pairs: usize) -> Vec<f64> {
    let share = pressure * 3.0 / (pairs - 1) as f64;
    (0..2 * pairs)
        .map(|i| match i {
            i if i % 2 == 1 => 0.0,
            i if i == 0 || i == 2 * pairs - 2 => -share / 2.0,
            _ => -share,
        })
        .collect()
}

/// Patch test: under uniform pressure `p` the displacements are linear, `strain_y = -p (1 - nu²) /
/// E`, `strain_x = p nu (1 + nu) / E` (plane strain), and the pressure is `p` at every node. The
/// upper block is held by contact alone; without friction its stiffness may differ from the lower
/// one's, as it slips on it, and it may be anywhere along it. To 1e-10: a thousand times the
/// tolerance.
#[test]
fn stacked_blocks_pass_the_patch_test() {
    for (young, mu, method) in [
        ([2000.0, 500.0], 0.0, Method::SorNested),
        ([2000.0, 500.0], 0.0, Method::Lemke),
        ([2000.0, 2000.0], 0.5, Method::SorNested),
        ([2000.0, 2000.0], 0.5, Method::SorDiagonal),
    ] {
        let stack = Stack::new([4, 4], young);
        let context = format!("E {young:?}, mu {mu}, {method:?}");
        let mut fixed = components(&stack.lower.row(0), 1);
        fixed.push(2 * stack.lower.node(0, 0));
        let pairs = stack.pairs();
        let model = stack.mesh.stiffness().model(&fixed, &pairs).unwrap();
        let load = stack.load(7.0, 0.0);
        let solution = solve_case(&model, &load, None, 0.0, mu, method);
        assert_eq!(solution.status, Status::Solved, "{context}: {}", solution.message);
        let force = &solution.certificate.force;
        close(force, &uniform_forces(7.0, 5), 1e-10, &format!("{context}: F"));

        let u = model.recover(Some(&load), None, &solution.d).unwrap();
        let strains = young.map(|e| (7.0 * 0.3 * 1.3 / e, -7.0 * (1.0 - 0.09) / e));
        let aside = u[2 * stack.upper.node(0, 0)];
        let exact: Vec<f64> = (0..stack.mesh.nodes.len())
            .flat_map(|node| {
                let [x, y] = stack.mesh.nodes[node];
                if stack.lower.nodes().contains(&node) {
                    [strains[0].0 * x, strains[0].1 * y]
                } else {
                    [aside + strains[1].0 * x, strains[0].1 + strains[1].1 * (y - 1.0)]
                }
            })
            .collect();
        close(&u, &exact, 1e-10, &format!("{context}: u"));
        if mu > 0.0 {
            assert!(aside.abs() <= 1e-10 * largest(&u), "{context}: it sticks");
        }
    }
}

/// Three elements against four, nodes to segments: forces and moments of the nodal contact forces
/// balance to rounding, as the weights interpolate the slaves' places; the pressure's resultant
/// passes the interface (1e-10: a thousand times the tolerance).
///
/// The pressure itself is not uniform, as nodes against segments fail the patch test. Measured
/// here: nodal forces up to 8 % off those of a uniform pressure.
#[test]
fn non_matching_interface_transmits_forces_and_moments() {
    for (columns, mu) in [([3, 4], 0.0), ([4, 3], 0.0), ([3, 4], 0.4), ([5, 7], 0.4)] {
        let stack = Stack::new(columns, [2000.0, 2000.0]);
        let context = format!("{columns:?}, mu {mu}");
        let pairs = stack.pairs();
        let stiffness = stack.mesh.stiffness();
        let model = stiffness.model(&stack.bottom(), &pairs).unwrap();
        let load = stack.load(7.0, 0.0);
        let solution = solved(&model, &load, mu);
        let force = &solution.certificate.force;
        let uniform = uniform_forces(7.0, columns[1] + 1);
        let error = largest(&difference(force, &uniform)) / largest(&uniform);
        assert!(error < 0.1, "{context}: {error}");
        let nodal = model.nodal_forces(force).unwrap();
        let (mut sums, mut parts) = ([0.0; 3], 0.0);
        for (node, [x, y]) in stack.mesh.nodes.iter().enumerate() {
            let [fx, fy] = [nodal[2 * node], nodal[2 * node + 1]];
            sums[0] += fx;
            sums[1] += fy;
            sums[2] += x * fy - y * fx;
            parts += fx.abs() + fy.abs();
        }
        assert!(largest(&sums) <= 1e-14 * 3.0 * parts, "{context}: {sums:?} of {parts}");
        let pressed: f64 = force.iter().step_by(2).sum();
        assert!((pressed + 21.0).abs() <= 21.0 * 1e-10, "{context}: {pressed}");
        // The upper block alone: loads and contact forces hold its recovered displacements.
        let u = model.recover(Some(&load), None, &solution.d).unwrap();
        let residual = difference(&difference(&stiffness.times(&u), &load), &nodal);
        let held = stack.bottom();
        let left: Vec<f64> =
            (0..residual.len()).filter(|dof| !held.contains(dof)).map(|i| residual[i]).collect();
        assert!(largest(&left) <= 1e-10 * 21.0, "{context}: {:e}", largest(&left));
    }
}
/// Forces of two blocks under pressure and shear with stick, slip and openings, by which the
/// transformed problems are measured.
fn sheared() -> (Stack, Vec<f64>, Vec<f64>) {
    let stack = Stack::new([4, 4], [2000.0, 700.0]);
    let load = stack.load(7.0, 1.5);
    let model = stack.mesh.stiffness().model(&stack.bottom(), &stack.pairs()).unwrap();
    let solution = solved(&model, &load, 0.25);
    let certificate = &solution.certificate;
    let count = |state| certificate.states.iter().filter(|s| **s == state).count();
    use signorini::State::{Slip, Stick};
    assert!(count(Slip) > 0 && count(Stick) > 0, "{:?}", certificate.states);
    let force = certificate.force.clone();
    (stack, load, force)
}

/// A problem turned by any angle, with its normals and loads, has the same contact forces in the
/// pairs' own frames. The tolerance of 1e-13 times a condition number of 1e3, and more for slip.
#[test]
fn a_turned_problem_has_the_same_forces() {
    let (stack, load, force) = sheared();
    for angle in [0.3, 1.0, 2.5, -1.9, std::f64::consts::FRAC_PI_2] {
        let (sin, cos) = f64::sin_cos(angle);
        let turn = |v: [f64; 2]| [cos * v[0] - sin * v[1], sin * v[0] + cos * v[1]];
        let mut mesh = stack.mesh.clone();
        mesh.nodes.iter_mut().for_each(|node| *node = turn(*node));
        let load: Vec<f64> = load.chunks(2).flat_map(|f| turn([f[0], f[1]])).collect();
        let pairs = stack.pairs();
        let pairs = Pairs::new(&pairs.slaves, &pairs.masters, turn([0.0, -1.0]));
        let model = mesh.stiffness().model(&stack.bottom(), &pairs).unwrap();
        close(&solved(&model, &load, 0.25).certificate.force, &force, 1e-9, "turned");
    }
}

/// Numbering the nodes anew changes nothing.
#[test]
fn a_renumbered_problem_has_the_same_forces() {
    let (stack, load, force) = sheared();
    for seed in 0..5 {
        let mut place: Vec<usize> = (0..stack.mesh.nodes.len()).collect();
        Rng::with_seed(seed).shuffle(&mut place);
        let mut mesh = stack.mesh.clone();
        let mut turned = load.clone();
        for (old, &new) in place.iter().enumerate() {
            mesh.nodes[new] = stack.mesh.nodes[old];
            turned[2 * new..2 * new + 2].copy_from_slice(&load[2 * old..2 * old + 2]);
        }
        mesh.elements.iter_mut().for_each(|(nodes, _)| *nodes = nodes.map(|node| place[node]));
        let fixed: Vec<usize> =
            stack.bottom().iter().map(|dof| 2 * place[dof / 2] + dof % 2).collect();
        let pairs = stack.pairs();
        let slaves: Vec<usize> = pairs.slaves.iter().map(|&node| place[node]).collect();
        let masters: Vec<Vec<_>> = pairs
            .masters
            .iter()
            .map(|masters| masters.iter().map(|&(node, weight)| (place[node], weight)).collect())
            .collect();
        let pairs = Pairs::new(&slaves, &masters, [0.0, -1.0]);
        let model = mesh.stiffness().model(&fixed, &pairs).unwrap();
        let renumbered = solved(&model, &turned, 0.25).certificate.force;
        close(&renumbered, &force, 1e-9, &format!("seed {seed}"));
    }
}

/// On matching nodes, slaves and masters may change places, with the normals reversed.
#[test]
fn slaves_and_masters_may_change_places() {
    let (stack, load, force) = sheared();
    let (upper, lower) = (stack.upper.row(0), stack.lower.row(2));
    let pairs = Pairs::matching(&lower, &upper, [0.0, 1.0]);
    let model = stack.mesh.stiffness().model(&stack.bottom(), &pairs).unwrap();
    let solution = solved(&model, &load, 0.25);
    close(&solution.certificate.force, &force, 1e-9, "exchanged");
    let kept = stack.mesh.stiffness().model(&stack.bottom(), &stack.pairs()).unwrap();
    close(
        &model.nodal_forces(&force).unwrap(),
        &kept.nodal_forces(&force).unwrap(),
        1e-14,
        "nodal forces",
    );
}

/// Blocks between smooth walls, pressed by a prescribed motion `v` of the top: the strain is `(v -
/// gap) / height`, the pressure `E (1 - nu) / ((1 + nu) (1 - 2 nu))` times that.
#[test]
fn prescribed_motion_presses_a_confined_column() {
    let (young, nu) = STEEL;
    let modulus = young * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
    let motion = 0.02;
    for two in [false, true] {
        for gap in [0.0, 0.005, -0.01, 0.03] {
            let stack = Stack::new([4, 4], [young; 2]);
            let mesh = &stack.mesh;
            let (upper, lower) = (stack.upper, stack.lower);
            let mut pairs = stack.pairs();
            let mut walls = Vec::new();
            for i in [0, 4] {
                walls.extend(components(&upper.column(i), 0));
                walls.extend(components(&lower.column(i), 0));
            }
            let mut bottom = components(&lower.row(0), 1);
            let mut height = 2.5;
            let top = components(&upper.row(3), 1);
            if !two {
                // The lower block is held as a whole, and the upper one meets an obstacle.
                pairs = Pairs::on_obstacle(&upper.row(0), [0.0, -1.0]);
                bottom = components(&lower.nodes().collect::<Vec<_>>(), 1);
                walls.extend(components(&lower.nodes().collect::<Vec<_>>(), 0));
                walls.sort_unstable();
                walls.dedup();
                height = 1.5;
            }
            let fixed = [walls.clone(), bottom.clone(), top.clone()].concat();
            let mut values = vec![0.0; walls.len() + bottom.len()];
            values.extend(vec![-motion; top.len()]);
            let model = mesh.stiffness().model(&fixed, &pairs).unwrap();
            let load = vec![0.0; mesh.size()];
            for mu in [0.0, 0.5] {
                let solution = solve_case(&model, &load, Some(&values), gap, mu, Method::SorNested);
                let context = format!("two {two}, gap {gap}, mu {mu}");
                assert_eq!(solution.status, Status::Solved, "{context}: {}", solution.message);
                let pressure = modulus * (motion - gap).max(0.0) / height;
                let exact = uniform_forces(pressure, 5);
                let error = difference(&solution.certificate.force, &exact);
                assert!(largest(&error) <= 1e-10 * modulus * motion, "{context}: {error:?}");
                let u = model.recover(Some(&load), Some(&values), &solution.d).unwrap();
                for (&dof, value) in fixed.iter().zip(&values) {
                    assert_eq!(u[dof], *value, "{context}: {dof}");
                }
                let strain = (motion - gap).max(0.0) / height;
                for node in upper.nodes() {
                    let uy = -motion + strain * (2.5 - mesh.nodes[node][1]);
                    assert!((u[2 * node + 1] - uy).abs() <= 1e-12, "{context}: node {node}");
                    assert!(u[2 * node].abs() <= 1e-12, "{context}: node {node}");
                }
            }
        }
    }
}
/// A block that is pulled off its support flies: the proof is a rigid motion of it, whose strain
/// energy is zero in the host's matrix (1e-12 of what the size of the motion could store), and all
/// else rests. Lemke's method.
#[test]
fn a_part_that_flies_off_moves_rigidly() {
    let stack = Stack::new([3, 4], [2000.0, 500.0]);
    let stiffness = stack.mesh.stiffness();
    let model = stiffness.model(&stack.bottom(), &stack.pairs()).unwrap();
    for (pressure, moment) in [(-1.0, 0.0), (-1.0, 1.0), (1.0, 30.0)] {
        let mut load = stack.load(pressure, 0.0);
        // A couple on the ends of the top, in excess of what the base can take.
        load[2 * stack.upper.node(0, 3) + 1] += moment;
        load[2 * stack.upper.node(4, 3) + 1] -= moment;
        let solution = solve_case(&model, &load, None, 0.0, 0.0, Method::Lemke);
        let context = format!("pressure {pressure}, moment {moment}");
        assert_eq!(solution.status, Status::NoEquilibrium, "{context}: {}", solution.message);
        let motion = motion(&solution);
        let u = model.recover(None, None, motion).unwrap();
        let most = largest(&u);
        assert!(most > 0.1, "{context}");
        let energy = dot(&u, &stiffness.times(&u));
        let stored = largest(&stiffness.values) * dot(&u, &u);
        assert!(energy.abs() <= 1e-12 * stored, "{context}: {energy:e} of {stored:e}");
        for node in stack.lower.nodes() {
            for dof in [2 * node, 2 * node + 1] {
                assert!(u[dof].abs() <= 1e-12 * most, "{context}: {dof} moves by {}", u[dof]);
            }
        }
        assert!(dot(&u, &load) > 0.0, "{context}: the loads drive it");
        assert!(motion.iter().step_by(2).all(|d| *d <= 1e-10), "{context}: it leaves");
    }
}
