//! Supports that hold both sides in one place: such a slave node has no pair of its own, and what it carries is carried beside it.

use crate::surfaces::{SHAPES, Sheet, TwoSheets, exact_loads, grid, line, nodal_forces, pair};
use fastrand::Rng;
use signorini::surface::{Rims, SurfacePairs, SurfaceSettings, SymmetryPlane};

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

/// The nodes of the pairs.
fn nodes(found: &SurfacePairs) -> Vec<usize> {
    found.pairs.iter().map(|pair| pair.slave).collect()
}

/// A uniform pressure loads the nodes of both lines by the integrals of their functions, whatever supports hold: the first node of both
/// has no pair where both are held across the lines, and the pairs are those without supports where one of them is not, or both
/// are held along the lines alone.
#[test]
fn a_node_between_supports_has_no_pair_and_uniform_pressure_passes() {
    let rng = &mut Rng::with_seed(5);
    for round in 0..200 {
        let (quadratic, rims) = (round % 2 == 1, [Rims::Fold, Rims::Keep][round / 2 % 2]);
        let [x, y] = [3, 4].map(|least| grid(0.0, 1.0, rng.usize(least..9), rng));
        let first = line(&x, quadratic, 0).0.len();
        let (along, across) = ([(0, 0), (first, 0)], [(0, 1), (first, 1)]);
        let free = lines([&x, &y], quadratic, &[], rims);
        for (supports, is_held) in [
            (&[along, across].concat()[..], true),
            (&[(first, 1), (0, 1)], true),
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
            let forces = nodal_forces(&found, first + line(&y, quadratic, 0).0.len(), 1.0);
            let [own, opposite] = [&x, &y].map(|x| exact_loads(x, quadratic, [0.0, 1.0]));
            for (force, load) in forces.iter().zip(own.iter().chain(&opposite)) {
                // Sums of some ten products of weights up to 3.
                assert!((force[1].abs() - load).abs() < 1e-13, "{context}: {forces:?}");
            }
        }
    }
}

/// A slave that supports hold wholly, over a master that they hold at its ends, is an obstacle, as a tool that is moved by prescribed
/// values: it has the pairs that it has without supports.
#[test]
fn a_side_that_supports_hold_wholly_keeps_its_pairs() {
    let rng = &mut Rng::with_seed(6);
    for round in 0..100 {
        let quadratic = round % 2 == 1;
        let [x, y] = [1, 3].map(|least| grid(0.0, 1.0, rng.usize(least..9), rng));
        let (first, all) = (line(&x, quadratic, 0).0.len(), line(&y, quadratic, 0).0.len());
        let held = (0..first).chain([first, first + y.len() - 1]);
        let supports: Vec<(usize, usize)> = held.flat_map(|node| [(node, 0), (node, 1)]).collect();
        let [free, found] =
            [&[], &supports[..]].map(|held| lines([&x, &y], quadratic, held, Rims::Fold));
        assert_eq!(free.pairs, found.pairs, "{round}, {all} nodes");
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
