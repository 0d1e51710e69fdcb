//! Supports that hold both sides in one place: such a slave node has no pair of its own, and what it carries is carried beside it.

use crate::surfaces::{SHAPES, Sheet, TwoSheets, exact_loads, grid, line, nodal_forces, pair};
use fastrand::Rng;
use signorini::surface::{Rims, SurfacePairs, SurfaceSettings};

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

/// A slave that supports hold wholly, over a master that they hold at its end, is an obstacle: pairs are left, and a uniform pressure
/// passes.
#[test]
fn a_side_that_supports_hold_wholly_keeps_pairs() {
    let (x, y) = ([0.0, 1.0], [0.0, 0.2, 0.4, 0.6, 0.8, 1.0]);
    let supports: Vec<(usize, usize)> =
        [0, 1, 2].into_iter().flat_map(|node| [(node, 0), (node, 1)]).collect();
    let found = lines([&x, &y], false, &supports, Rims::Fold);
    assert!(!found.pairs.is_empty());
    let forces = nodal_forces(&found, 8, 1.0);
    for (force, load) in forces[2..].iter().zip(exact_loads(&y, false, [0.0, 1.0])) {
        assert!((force[1].abs() - load).abs() < 1e-14, "{forces:?}");
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
