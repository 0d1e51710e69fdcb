//! Supports that hold both sides in one place: such a slave node has no pair of its own, and what it carries is carried beside it.

use crate::surfaces::{SHAPES, Sheet, TwoSheets, exact_loads, grid, line, nodal_forces, pair};
use fastrand::Rng;
use signorini::surface::{Rims, Sector, SurfacePair, SurfacePairs, SurfaceSettings, SymmetryPlane};

/// Pairs of two lines from 0 to 1, the body of the slave above, with supports of nodes along axes. The first node of the slave
/// is 0, that of the master the number of slave nodes.
fn lines(
    [x, y]: [&[f64]; 2],
    quadratic: bool,
    supports: &[(usize, usize)],
    rims: Rims,
) -> SurfacePairs {
    let (own, slave) = line(x, quadratic, 0);
    let (opposite, mut master) = line(y, quadratic, own.len());
    master.iter_mut().for_each(|face| face.swap(0, 1));
    let settings = SurfaceSettings { supports: supports.to_vec(), rims, ..Default::default() };
    pair(2, &[own, opposite].concat(), [&slave, &master], &settings).unwrap()
}

/// A uniform pressure loads the nodes of both lines by the integrals of their functions, up to sums of some ten products of weights
/// up to 3.
fn check_loads(found: &SurfacePairs, [x, y]: [&[f64]; 2], quadratic: bool, context: &str) {
    let [own, opposite] = [x, y].map(|x| exact_loads(x, quadratic, [0.0, 1.0]));
    let forces = nodal_forces(found, own.len() + opposite.len(), 1.0);
    for (force, load) in forces.iter().zip(own.iter().chain(&opposite)) {
        assert!((force[1].abs() - load).abs() < 1e-13, "{context}: {forces:?}");
    }
}

/// The nodes of the pairs.
fn nodes(found: &SurfacePairs) -> Vec<usize> {
    found.pairs.iter().map(|pair| pair.slave).collect()
}

/// A uniform pressure loads the nodes of both lines by the integrals of their functions, whatever supports hold. Where the first nodes of
/// both are held across the lines, that of the slave has no pair if its row names other masters too. The pairs are those without
/// supports where one of them is not held, or both are along the lines alone.
#[test]
fn a_node_between_supports_has_no_pair_and_uniform_pressure_passes() {
    let rng = &mut Rng::with_seed(5);
    for round in 0..200 {
        let (quadratic, rims) = (round % 2 == 1, [Rims::Fold, Rims::Keep][round / 2 % 2]);
        let [x, y] = [3, 4].map(|least| grid(0.0, 1.0, rng.usize(least..9), rng));
        let first = line(&x, quadratic, 0).0.len();
        let (along, across) = ([(0, 0), (first, 0)], [(0, 1), (first, 1)]);
        let free = lines([&x, &y], quadratic, &[], rims);
        let names_others = free.pairs[0].masters().len() > 1;
        for (supports, is_held) in [
            (&[along, across].concat()[..], names_others),
            (&[(first, 1), (0, 1)], names_others),
            (&along, false),
            (&across[..1], false),
            (&across[1..], false),
        ] {
            let found = lines([&x, &y], quadratic, supports, rims);
            let context = format!("{round}: {x:?} on {y:?}, {supports:?}");
            assert_eq!(!nodes(&found).contains(&0), is_held, "{context}");
            assert_eq!(found.pairs.len() + usize::from(is_held), free.pairs.len(), "{context}");
            if !is_held {
                assert_eq!(found.pairs, free.pairs, "{context}");
            }
            check_loads(&found, [&x, &y], quadratic, &context);
        }
    }
}

/// A slave that supports hold wholly, over a master that they hold at its ends, is an obstacle, as a tool that is moved by prescribed
/// values: it has the pairs that it has without supports, but where some, and less than three tenths of the masters move, and
/// uniform pressure passes.
#[test]
fn a_side_that_supports_hold_wholly_keeps_its_pairs() {
    let rng = &mut Rng::with_seed(6);
    for round in 0..100 {
        let quadratic = round % 2 == 1;
        let [x, y] = [1, 3].map(|least| grid(0.0, 1.0, rng.usize(least..9), rng));
        let first = line(&x, quadratic, 0).0.len();
        let ends = [first, first + y.len() - 1];
        let held = (0..first).chain(ends);
        let supports: Vec<(usize, usize)> = held.flat_map(|node| [(node, 0), (node, 1)]).collect();
        let [free, found] =
            [&[], &supports[..]].map(|held| lines([&x, &y], quadratic, held, Rims::Fold));
        let stays = |pair: &&SurfacePair| {
            let free = pair.masters().iter().filter(|(node, _)| !ends.contains(node));
            let parts: Vec<f64> = free.map(|(_, weight)| *weight).collect();
            parts.is_empty() || parts.iter().sum::<f64>() >= 0.3
        };
        let expected: Vec<usize> = free.pairs.iter().filter(stays).map(|pair| pair.slave).collect();
        assert_eq!(nodes(&found), expected, "{round}");
        if expected.len() == free.pairs.len() {
            assert_eq!(free.pairs, found.pairs, "{round}");
        }
        check_loads(&found, [&x, &y], quadratic, &round.to_string());
    }
}

/// Halves of lines up to a plane of symmetry, both held there along the normal: a uniform pressure loads all nodes as without supports,
/// since the images of what is held are held.
#[test]
fn supports_on_a_plane_of_symmetry_are_those_of_the_whole() {
    let rng = &mut Rng::with_seed(7);
    for round in 0..100 {
        let quadratic = round % 2 == 1;
        let [x, y] = [3, 4].map(|least| grid(0.0, 1.0, rng.usize(least..9), rng));
        let (own, slave) = line(&x, quadratic, 0);
        let (opposite, mut master) = line(&y, quadratic, own.len());
        master.iter_mut().for_each(|face| face.swap(0, 1));
        let (first, nodes) = (own.len(), [own, opposite].concat());
        let forces = [vec![], vec![(0, 1), (first, 1)]].map(|supports| {
            let symmetry = vec![SymmetryPlane::across(0, 0.0)];
            let settings = SurfaceSettings { supports, symmetry, ..Default::default() };
            let found = pair(2, &nodes, [&slave, &master], &settings).unwrap();
            let mut forces = vec![0.0; nodes.len()];
            for pair in &found.pairs {
                for &(node, weight) in pair.slaves().iter().chain(pair.masters()) {
                    // Of images those of the model, on either side of the plane.
                    forces[found.images.of(node).0] += pair.area * weight;
                }
            }
            forces
        });
        let [own, opposite] = [&x, &y].map(|x| exact_loads(x, quadratic, [0.0, 1.0]));
        for ((a, b), load) in forces[0].iter().zip(&forces[1]).zip(own.iter().chain(&opposite)) {
            assert!((a - load).abs() < 1e-13, "{round}: {forces:?}");
            assert!((b - load).abs() < 1e-13, "{round}: {forces:?}");
        }
    }
}

/// Rectangles of all kinds of faces with one edge of both held: its slave nodes have no pairs, and uniform pressure loads all nodes
/// as it does without supports.
#[test]
fn an_edge_between_supports_has_no_pairs_in_space() {
    let rng = &mut Rng::with_seed(8);
    for (slave, master) in SHAPES.into_iter().flat_map(|s| SHAPES.map(|m| (s, m))) {
        let own = Sheet::rectangle(slave, [3, 3], [[0.0, 1.0]; 2], (0.2, rng));
        let opposite = Sheet::rectangle(master, [4, 5], [[0.0, 1.0]; 2], (0.2, rng));
        let (own_nodes, sheets) = (own.nodes.len(), TwoSheets::new(3, own.turned(), opposite));
        let held = |node: &usize| sheets.nodes[*node][0] == 0.0;
        let supports = (0..sheets.nodes.len()).filter(held);
        let supports = supports.flat_map(|node| (0..3).map(move |axis| (node, axis))).collect();
        let free = sheets.pair(&SurfaceSettings::default()).unwrap();
        let found = sheets.pair(&SurfaceSettings { supports, ..Default::default() }).unwrap();
        let inside = (0..own_nodes).filter(|node| !held(node)).collect::<Vec<usize>>();
        assert_eq!(nodes(&found), inside, "{slave:?} on {master:?}");
        let [a, b] = [&free, &found].map(|found| nodal_forces(found, sheets.nodes.len(), 1.0));
        for (a, b) in a.as_flattened().iter().zip(b.as_flattened()) {
            assert!((a - b).abs() < 1e-13, "{slave:?} on {master:?}: {a} {b}");
        }
    }
}

/// Supports of both lines along both axes up to 0.4, where the sides touch, are apart, or are within each other: no row is left between
/// supports, uniform pressure passes, and where the lines are within each other, a pair closes as the nodes that move have left.
#[test]
fn clamps_of_any_width_leave_no_row_between_supports() {
    let rng = &mut Rng::with_seed(9);
    for round in 0..200 {
        let (quadratic, apart) = (round % 2 == 1, [0.0, 0.1, -0.01][round / 2 % 3]);
        let [x, y] = [0, 0].map(|_| grid(0.0, 1.0, rng.usize(6..10), rng));
        let (mut own, slave) = line(&x, quadratic, 0);
        own.iter_mut().for_each(|x| x[1] += apart);
        let (opposite, mut master) = line(&y, quadratic, own.len());
        master.iter_mut().for_each(|face| face.swap(0, 1));
        let all = [own, opposite].concat();
        let is_held = |node: usize| all[node][0] <= 0.4;
        let held = (0..all.len()).filter(|node| is_held(*node));
        let supports = held.flat_map(|node| [(node, 0), (node, 1)]).collect();
        let settings = SurfaceSettings { supports, ..Default::default() };
        let found = pair(2, &all, [&slave, &master], &settings).unwrap();
        let context = format!("{round}: {x:?} on {y:?}, {apart}");
        for pair in &found.pairs {
            let masters = || pair.masters().iter().map(|(node, _)| is_held(*node));
            let is_between = masters().any(|held| held) && masters().any(|held| !held);
            assert!(!is_held(pair.slave) || !is_between, "{context}: {pair:?}");
            // The weights of linear functions are those of their nodes.
            if is_held(pair.slave) || quadratic {
                continue;
            }
            let moved = pair.slaves().iter().filter(|(node, _)| !is_held(*node));
            let left: f64 = moved.map(|(_, weight)| weight * apart).sum();
            let most = if apart < 0.0 { left } else { apart };
            let gap = pair.gap;
            assert!(apart - 1e-14 < gap && gap < most + 1e-14, "{context}: {pair:?}");
        }
        check_loads(&found, [&x, &y], quadratic, &context);
    }
}

/// Two plates on each other with one edge held and pulled apart, of faces with mid nodes that end there or not: no row of a held node is
/// left that names nodes which move, of either side, so that nothing holds what is pulled apart.
#[test]
fn no_pair_of_a_held_node_names_nodes_that_move() {
    let rng = &mut Rng::with_seed(11);
    for (slave, master) in SHAPES.into_iter().flat_map(|s| SHAPES.map(|m| (s, m))) {
        for width in [0.1, 0.2, 0.3, 0.4, 0.5] {
            let own = Sheet::rectangle(slave, [5, 2], [[0.0, 1.0]; 2], (0.0, rng));
            let opposite = Sheet::rectangle(master, [6, 3], [[0.0, 1.0]; 2], (0.0, rng));
            let sheets = TwoSheets::new(3, own.turned(), opposite);
            let is_held = |node: usize| sheets.nodes[node][0] <= width + 1e-9;
            let held = (0..sheets.nodes.len()).filter(|node| is_held(*node));
            let supports = held.flat_map(|node| (0..3).map(move |axis| (node, axis))).collect();
            let found = sheets.pair(&SurfaceSettings { supports, ..Default::default() }).unwrap();
            for pair in found.pairs.iter().filter(|pair| is_held(pair.slave)) {
                let moves = |entry: &&(usize, f64)| !is_held(entry.0);
                let slaves = pair.slaves().iter().filter(moves).count();
                let masters = pair.masters().iter().filter(moves).count();
                let rests = slaves + masters == 0 || masters == pair.masters().len();
                assert!(rests, "{slave:?} on {master:?}, {width}: {pair:?}");
            }
        }
    }
}

/// A strip that repeats along x, with the edge y = 0 of both sides held: the host's supports are those of the first boundary, as the
/// second follows by equations. The pairs are those with supports on both.
#[test]
fn supports_on_a_second_boundary_are_those_of_the_first() {
    let rng = &mut Rng::with_seed(10);
    for (slave, master) in SHAPES.into_iter().flat_map(|s| SHAPES.map(|m| (s, m))) {
        // Triangles match where the numbers of their cells are even.
        let own = Sheet::rectangle(slave, [4, 3], [[0.0, 1.0], [0.0, 2.0]], (0.0, rng));
        let opposite = Sheet::rectangle(master, [2, 5], [[0.0, 1.0], [0.0, 2.0]], (0.0, rng));
        let sheets = TwoSheets::new(3, own.turned(), opposite);
        let found = [1.0, 2.0].map(|end| {
            let held = |node: &usize| sheets.nodes[*node][1] == 0.0 && sheets.nodes[*node][0] < end;
            let supports = (0..sheets.nodes.len()).filter(held);
            let supports = supports.flat_map(|node| (0..3).map(move |axis| (node, axis))).collect();
            let sector = Some(Sector { periods: [[1.0, 0.0, 0.0], [0.0; 3]], ..Sector::default() });
            sheets.pair(&SurfaceSettings { supports, sector, ..Default::default() }).unwrap()
        });
        assert_eq!(found[0].pairs, found[1].pairs, "{slave:?} on {master:?}");
        assert!(!found[0].report.folded.is_empty(), "{slave:?} on {master:?}");
    }
}
