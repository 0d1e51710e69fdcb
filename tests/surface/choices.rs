//! Choices of the pairing: whose normals pairs have, and what becomes of nodes at rims. By mathematics alone: planes
//! and spheres, areas in closed form, statics, motions that open nothing.

use crate::surfaces::{
    SHAPES, Shape, Sheet, TwoSheets, exact_loads, line, most_moved, nodal_forces, pair, steps,
};
use fastrand::Rng;
use signorini::surface::{Normals, Pairing, Rims, SurfacePair, SurfacePairs, SurfaceSettings};

type Point = [f64; 3];

const PAIRINGS: [Pairing; 2] = [Pairing::DualMortar, Pairing::NodeToSurface];
const NORMALS: [Normals; 2] = [Normals::Averaged, Normals::Faces];
const RIMS: [Rims; 3] = [Rims::Fold, Rims::Keep, Rims::FoldLittle];

fn with_normals(pairing: Pairing, normals: Normals) -> SurfaceSettings {
    SurfaceSettings { pairing, normals, ..SurfaceSettings::default() }
}

fn with_rims(rims: Rims) -> SurfaceSettings {
    SurfaceSettings { rims, ..SurfaceSettings::default() }
}

fn dot(a: Point, b: Point) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn apart(a: Point, b: Point) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// The point that weights make of nodes.
fn point(nodes: &[Point], weights: &[(usize, f64)]) -> Point {
    std::array::from_fn(|c| weights.iter().map(|&(node, weight)| weight * nodes[node][c]).sum())
}

/// Turned about two axes and moved.
fn placed([x, y, z]: Point) -> Point {
    let ((a, b), (c, d)) = (0.4_f64.sin_cos(), 0.7_f64.sin_cos());
    let (y, z) = (b * y - a * z, a * y + b * z);
    [d * x + c * z + 3.0, y - 1.0, d * z - c * x + 0.5]
}

/// Between parallel planes there is one normal: both choices give the same pairs, to 1e-13, rounding of
/// coordinates of the size of ten; and a rigid motion moves nothing where the planes are closed.
#[test]
fn planes_have_one_normal() {
    let mut rng = Rng::with_seed(1);
    for (slave, master) in SHAPES.into_iter().flat_map(|s| SHAPES.map(|m| (s, m))) {
        for height in [0.0, 0.07] {
            let above = Sheet::rectangle(slave, [2, 3], [[0.0, 1.0]; 2], (0.25, &mut rng));
            let below = Sheet::rectangle(master, [3, 2], [[0.2, 1.2]; 2], (0.25, &mut rng));
            let above = above.turned().mapped(|[x, y, _]| placed([x, y, height]));
            let sheets = TwoSheets::new(3, above, below.mapped(placed));
            for pairing in PAIRINGS {
                let [averaged, faces] =
                    NORMALS.map(|normals| sheets.pair(&with_normals(pairing, normals)).unwrap());
                let context = format!("{slave:?} on {master:?}, {pairing:?}, {height}");
                assert!(!faces.pairs.is_empty(), "{context}");
                assert_eq!(averaged.unpaired, faces.unpaired, "{context}");
                assert_eq!(averaged.pairs.len(), faces.pairs.len(), "{context}");
                for (a, b) in averaged.pairs.iter().zip(&faces.pairs) {
                    assert_eq!((a.slave, a.slaves(), a.area), (b.slave, b.slaves(), b.area));
                    assert!(apart(a.normal, b.normal) < 1e-13, "{context}: {a:?}, {b:?}");
                    assert!((a.gap - b.gap).abs() < 1e-12, "{context}: {a:?}, {b:?}");
                    let [p, q] = [a, b].map(|pair| point(&sheets.nodes, pair.masters()));
                    assert!(apart(p, q) < 1e-12, "{context}: {a:?}, {b:?}");
                }
                if height == 0.0 {
                    let rigid = |[x, y, z]: Point| [1.0 + y - 2.0 * z, 3.0 - x + z, 2.0 * x - y];
                    let moved = most_moved(&faces, &sheets.nodes, rigid);
                    assert!(moved < 1e-10, "{context}: {moved:e}");
                }
            }
        }
    }
}

/// A part of a sphere about the origin, its normal outward.
fn cap(shape: Shape, cells: usize, (radius, size): (f64, f64)) -> Sheet {
    // Eight nodes of a distorted quadrilateral do not hold all polynomials of the degree 2.
    let distortion = if shape == Shape::Q8 { 0.0 } else { 0.2 };
    let ends = [[-size, size]; 2];
    let flat = Sheet::rectangle(shape, [cells; 2], ends, (distortion, &mut Rng::with_seed(2)));
    flat.mapped(|[x, y, _]| {
        let length = (1.0 + x * x + y * y).sqrt() / radius;
        [x / length, y / length, 1.0 / length]
    })
}

/// A slave of radius 1 in a hollow master, or around a ball; gaps of 0.02.
fn spheres(shape: Shape, cells: usize, hollow: bool) -> TwoSheets {
    let slave = cap(shape, cells, (1.0, 0.4));
    let master = cap(shape, 2 * cells - 1, (if hollow { 1.02 } else { 0.98 }, 0.6));
    if hollow {
        TwoSheets::new(3, slave, master.turned())
    } else {
        TwoSheets::new(3, slave.turned(), master)
    }
}

/// The normal of a flat face of a sphere is the direction to the middle of its circumscribed circle, so that it
/// differs from those of its corners by an angle of which the sine is the radius of that circle over that of the
/// sphere. That of the slave's triangles is below 1.3 cells of 0.8 / n, those of the master are smaller. So the
/// normals of faces, and means of them, are within 1.1 of it of the slave node's, and of averaged ones within
/// twice as much: the first order. The normal of a quadratic face is of the second order itself. The differences
/// are taken in the mean square.
#[test]
fn normals_of_faces_converge_to_the_averaged_ones() {
    for (shape, order) in
        [(Shape::T3, 1), (Shape::Q4, 1), (Shape::T6, 2), (Shape::Q8, 2), (Shape::Q9, 2)]
    {
        for (pairing, hollow) in [
            (Pairing::DualMortar, true),
            (Pairing::NodeToSurface, true),
            (Pairing::NodeToSurface, false),
        ] {
            let differences = [4, 12].map(|cells| {
                let sheets = spheres(shape, cells, hollow);
                let [averaged, faces] =
                    NORMALS.map(|normals| sheets.pair(&with_normals(pairing, normals)).unwrap());
                assert_eq!(averaged.pairs.len(), faces.pairs.len());
                let sign = if hollow { 1.0 } else { -1.0 };
                let bound = 1.1 * 1.3 * 0.8 / cells as f64;
                for pair in &faces.pairs {
                    let exact = sheets.nodes[pair.slave].map(|x| sign * x);
                    let miss = apart(pair.normal, exact);
                    assert!((dot(pair.normal, pair.normal) - 1.0).abs() < 1e-14);
                    assert!(miss < bound, "{shape:?}, {pairing:?}, {hollow}: {miss} of {bound}");
                }
                let both = averaged.pairs.iter().zip(&faces.pairs);
                let squares: f64 = both.map(|(a, b)| apart(a.normal, b.normal).powi(2)).sum();
                (squares / faces.pairs.len() as f64).sqrt()
            });
            // Half an order less is asked for, as the mean depends on how the meshes lie to each other.
            let factor = 3.0_f64.powf(f64::from(order) - 0.5);
            let context = format!("{shape:?}, {pairing:?}, hollow: {hollow}");
            assert!(differences[0] > 0.0, "{context}");
            assert!(differences[1] < differences[0] / factor, "{context}: {differences:?}");
        }
    }
}

/// The opening of a pair by displacements.
fn opens(pair: &SurfacePair, u: &[Point]) -> f64 {
    let [slave, master] = [pair.slaves(), pair.masters()].map(|weights| point(u, weights));
    dot(slave, pair.normal) - dot(master, pair.normal)
}

/// Forces of nodes against surfaces act along the line from point to point, with either normal: a rotation opens
/// nothing, though the surfaces are curved and apart, and so they balance moments. Where a node looks into the wedge
/// over an edge of a convex master, of which there are some and not many, the normal is that of a face, and
/// translations alone open nothing.
#[test]
fn a_rigid_motion_opens_nothing_between_curved_surfaces() {
    for (shape, hollow) in [Shape::T3, Shape::Q4].into_iter().flat_map(|s| [(s, true), (s, false)])
    {
        let sheets = spheres(shape, 8, hollow);
        for normals in NORMALS {
            let found = sheets.pair(&with_normals(Pairing::NodeToSurface, normals)).unwrap();
            let mut wedges = 0;
            for pair in &found.pairs {
                let turned: Vec<Point> = sheets
                    .nodes
                    .iter()
                    .map(|[x, y, z]| [y - 2.0 * z, 3.0 * z - x, 2.0 * x - 3.0 * y])
                    .collect();
                let moved = vec![[1.0, -2.0, 0.5]; sheets.nodes.len()];
                assert!(opens(pair, &moved).abs() < 1e-13, "{pair:?}");
                if opens(pair, &turned).abs() > 1e-11 {
                    wedges += 1;
                }
            }
            let context = format!("{shape:?}, {normals:?}, hollow: {hollow}: {wedges} wedges");
            if normals == Normals::Averaged || hollow {
                assert_eq!(wedges, 0, "{context}");
            }
            assert!(4 * wedges < found.pairs.len(), "{context}");
        }
    }
}

/// The slave is the bottom of a block and its side, one line around a sharp edge, over a floor. The averaged normal of nodes against
/// surfaces is between the two at the edge; by dual mortar the side, which lies over nothing, has no say. That of the face in
/// contact is that of the bottom.
#[test]
fn a_sharp_edge_has_the_normal_of_the_face_in_contact() {
    let nodes =
        [[0.0, 1.1, 0.0], [0.0, 0.1, 0.0], [1.0, 0.1, 0.0], [-1.0, 0.0, 0.0], [2.0, 0.0, 0.0]];
    let (slave, master) = (vec![vec![0, 1], vec![1, 2]], vec![vec![4, 3]]);
    for pairing in PAIRINGS {
        let at_edge = |normals| {
            let settings =
                SurfaceSettings { search_distance: Some(0.5), ..with_normals(pairing, normals) };
            let found = pair(2, &nodes, [&slave, &master], &settings).unwrap();
            assert_eq!(found.unpaired, [0], "{pairing:?}");
            found.pairs[0].clone()
        };
        let half = 0.5_f64.sqrt();
        let averaged = at_edge(Normals::Averaged);
        let normal = match pairing {
            Pairing::DualMortar => [0.0, -1.0, 0.0],
            Pairing::NodeToSurface => [-half, -half, 0.0],
        };
        assert!(apart(averaged.normal, normal) < 1e-15, "{averaged:?}");
        let of_face = at_edge(Normals::Faces);
        assert!(apart(of_face.normal, [0.0, -1.0, 0.0]) < 1e-15, "{of_face:?}");
        assert!((of_face.gap - 0.1).abs() < 1e-15, "{of_face:?}");
        assert!(apart(point(&nodes, of_face.masters()), [0.0; 3]) < 1e-14, "{of_face:?}");
    }
}

/// A line of elements of the length one from 0 to 4 over a master that ends within the last one.
fn over_the_rim(end: f64, rims: Rims) -> SurfacePairs {
    let (mut nodes, slave) = line(&steps(0.0, 4.0, 4), false, 0);
    let (below, mut master) = line(&steps(-1.0, end, 3), false, nodes.len());
    master.iter_mut().for_each(|face| face.swap(0, 1));
    nodes.extend(below);
    pair(2, &nodes, [&slave, &master], &with_rims(rims)).unwrap()
}

/// Nodes with those that they are folded into.
fn folds(found: &SurfacePairs) -> Vec<(usize, usize)> {
    found.report.folded.iter().map(|fold| (fold.node, fold.into)).collect()
}

/// A last element is covered by the share `c`: the last node of the line has `c²` of its area covered, and the one
/// before `1/2 + c - c²/2`. Below a half, or if that is chosen below three tenths, the node is folded or kept; above nothing is a
/// rim and the choices are the same; kept ones below a millionth are folded.
#[test]
fn rims_are_told_by_their_cover() {
    for c in [0.9, 0.71, 0.7, 0.55, 0.54, 0.3, 0.1, 0.003, 3e-4, 1e-6] {
        let [fold, keep, fold_little] = RIMS.map(|rims| over_the_rim(3.0 + c, rims));
        let [little, very_little] = [0.5, 0.3].map(|least| c * c < least);
        let kept = c * c >= 1e-6;
        let slaves =
            |found: &SurfacePairs| found.pairs.iter().map(|pair| pair.slave).collect::<Vec<_>>();
        let (all, but_last) = (vec![0, 1, 2, 3, 4], vec![0, 1, 2, 3]);
        for (found, is) in [(&fold, little), (&keep, !kept), (&fold_little, very_little)] {
            assert_eq!(slaves(found), if is { but_last.clone() } else { all.clone() }, "{c}");
            assert_eq!(found.unpaired, if is { vec![4] } else { vec![] }, "{c}");
            assert_eq!(folds(found), if is { vec![(4, 3)] } else { vec![] }, "{c}");
            assert!(found.report.folded.iter().all(|fold| fold.distance == 1.0), "{c}");
            let sum: f64 = found.pairs.iter().map(|pair| pair.area).sum();
            assert!((sum - found.report.covered_area).abs() < 1e-15, "{c}");
            assert!((sum - (3.0 + c)).abs() < 1e-14, "{c}: {sum}");
            let told = found.summary().ends_with("of neighbours, at most 1 away (4 in that of 3)");
            assert_eq!(told, is, "{}", found.summary());
        }
        if kept {
            let areas = [0.5, 1.0, 1.0, 0.5 + c - 0.5 * c * c, 0.5 * c * c];
            for (pair, area) in keep.pairs.iter().zip(areas) {
                assert!((pair.area - area).abs() < 1e-14, "{c}: {pair:?}");
            }
        }
    }
}

/// Cover is counted on all faces around a node: at the end of a master that ends where a slave face does it is a half,
/// enough, whatever is left of it by rounding; a tenth before that it is less.
#[test]
fn cover_is_counted_on_all_faces() {
    for (end, folded) in [(2.0, vec![]), (2.0 - 1e-9, vec![]), (1.9, vec![(2, 1)])] {
        assert_eq!(folds(&over_the_rim(end, Rims::Fold)), folded, "{end}");
    }
}

/// The tip of a triangle over the end of a master: with the height 1 and the base 1 the strip of the height `c` has
/// `c²/2 - c³/3` of the tip's area, and `(1 - (1-c)³)/6` of that of each of the two nodes at the base, wherever above the base
/// the tip stands. The two share the tip's row: halves if their middles are as near to its own, all to the nearer one if the other
/// one is 6 % further away, in between more as it comes nearer, and nowhere in a jump: over a tenth of the squared distance a
/// share grows at most ten times as fast as that. Middles are integrals over lines across the strip, and over the triangle below.
#[test]
fn the_nearest_nodes_share_a_row() {
    let c: f64 = 0.4;
    let (tip, base) = (c * c / 2.0 - c.powi(3) / 3.0, (1.0 - (1.0 - c).powi(3)) / 6.0);
    // Of (1-y)³, of y (1-y)² / 2 and of y² (1-y).
    let cubes = (1.0 - (1.0 - c).powi(4)) / 4.0;
    let (up, of_tip) = (base - cubes / 2.0, c.powi(3) / 3.0 - c.powi(4) / 4.0);
    let own = base + 1.0 / 6.0;
    let mut before: Option<(f64, f64)> = None;
    for step in -80..=80 {
        let x = 3e-3 * f64::from(step);
        let slave = [[-0.5, 0.0], [0.5, 0.0], [0.0, -1.0], [x, 1.0]];
        let master = [[-2.0, -2.0], [2.0, -2.0], [2.0, c], [-2.0, c]];
        let nodes: Vec<Point> =
            [&slave[..], &master].concat().iter().map(|[x, y]| [*x, *y, 0.0]).collect();
        let faces = [vec![0, 1, 3], vec![0, 2, 1]];
        let found = pair(3, &nodes, [&faces, &[vec![7, 6, 5, 4]]], &with_rims(Rims::Fold)).unwrap();
        // In the middle rounding tells which one is named.
        let named = if step == 0 { folds(&found)[0].1 } else { usize::from(step > 0) };
        assert_eq!(folds(&found), [(3, named)], "{x}");
        let [left, right] = [0, 1].map(|k| (found.pairs[k].area - own) / tip);
        assert!((left + right - 1.0).abs() < 1e-13, "{x}: {left} and {right}");
        let squared = |side: f64| {
            let across = (x * up + side * (cubes / 12.0 + 1.0 / 48.0)) / own - x * of_tip / tip;
            let along = (up - 1.0 / 24.0) / own - of_tip / tip;
            across * across + along * along
        };
        let ratio = squared(1.0) / squared(-1.0);
        if step == 0 {
            assert!((right - 0.5).abs() < 1e-13, "{right}");
        }
        if ratio.max(1.0 / ratio) > 1.06 * 1.06 {
            assert!((right - f64::from(u8::from(step > 0))).abs() < 1e-13, "{x}: {right}");
        }
        if let Some((last, was)) = before {
            assert!(right > last - 1e-13, "{x}: {last}, then {right}");
            let change = (1.0 / ratio - 1.0 / was).abs().max((ratio - was).abs());
            assert!(right - last < 10.0 * change + 1e-13, "{x}: {last}, then {right}");
        }
        before = Some((right, ratio));
    }
}

/// A surface all of whose nodes have little cover, from the middle: they hold the body by two pairs, however little it is;
/// below a millionth, which no node keeps, one of them is folded into the other. The area is that of the master.
#[test]
fn a_contact_of_rims_alone() {
    for (rims, width, pairs) in [
        (Rims::Fold, 0.1, 2),
        (Rims::Fold, 0.08, 2),
        (Rims::FoldLittle, 1e-3, 2),
        (Rims::Keep, 0.08, 2),
        (Rims::Fold, 8e-7, 1),
        (Rims::Keep, 8e-7, 1),
    ] {
        let (mut nodes, slave) = line(&[0.0, 1.0], false, 0);
        nodes.extend([-0.5, 0.5].map(|side| [0.5 + side * width, 0.0, 0.0]));
        let found = pair(2, &nodes, [&slave, &[vec![3, 2]]], &with_rims(rims)).unwrap();
        assert_eq!((found.pairs.len(), found.unpaired.len()), (pairs, 2 - pairs), "{rims:?}");
        let area: f64 = found.pairs.iter().map(|pair| pair.area).sum();
        assert!((area - width).abs() < 1e-15, "{rims:?}: {area}");
    }
}

/// Masters of the size of a slave face under two of many: each node there has a quarter of cover, and the pairs of all
/// of them carry the moments of the masters.
#[test]
fn masters_of_one_face_are_held_by_its_nodes() {
    let rng = &mut Rng::with_seed(9);
    let above = Sheet::rectangle(Shape::Q4, [5, 3], [[0.0, 5.0], [0.0, 3.0]], (0.0, rng)).turned();
    let mut below = Sheet::rectangle(Shape::Q4, [1, 1], [[1.0, 2.0]; 2], (0.0, rng));
    below.nodes.extend([[3.0, 1.0, 0.0], [4.0, 1.0, 0.0], [3.0, 2.0, 0.0], [4.0, 2.0, 0.0]]);
    below.faces.push(below.faces[0].iter().map(|node| node + 4).collect());
    let found = TwoSheets::new(3, above, below).pair(&SurfaceSettings::default()).unwrap();
    let slaves: Vec<usize> = found.pairs.iter().map(|pair| pair.slave).collect();
    assert_eq!(slaves, [7, 8, 9, 10, 13, 14, 15, 16]);
    assert!(found.pairs.iter().all(|pair| (pair.area - 0.25).abs() < 1e-14));
}

/// Loads of a unit pressure on a node of a grid of rectangles in a window: products of those of lines.
fn on_grid(cells: [usize; 2], window: [[f64; 2]; 2]) -> Vec<f64> {
    let [x, y] = [0, 1].map(|c| exact_loads(&steps(0.0, 1.0, cells[c]), false, window[c]));
    y.iter().flat_map(|b| x.iter().map(move |a| a * b)).collect()
}

/// Faces of all kinds hang over a corner by 3 to 95 % of an element. Nodes that keep their pairs load both sides as
/// folded ones do, and rigid motions open and slip nothing; areas are those of a grid in closed form; folded nodes
/// are those whose share of these is below a half, and each goes to a node of its own faces. Forces to 1e-11, a hundred roundings of coordinates of ten. Motions
/// to 1e-8: from a twentieth of a face polynomials of the degree 2 in both directions lead to the other end, where they
/// are up to 20⁴ times as large, and control values take another ten.
#[test]
fn kept_nodes_pass_the_patch_test_and_folded_ones_go_one_face_far() {
    let mut rng = Rng::with_seed(5);
    for (slave, master) in SHAPES.into_iter().flat_map(|s| SHAPES.map(|m| (s, m))) {
        for part in [0.03, 0.3, 0.8, 0.95] {
            let shift = [part * 0.5, part / 3.0];
            let above = Sheet::rectangle(slave, [2, 3], [[0.0, 1.0]; 2], (0.0, &mut rng));
            let ends = shift.map(|shift| [shift, 1.0 + shift]);
            let below = Sheet::rectangle(master, [3, 2], ends, (0.0, &mut rng));
            let sheets = TwoSheets::new(3, above.turned().mapped(placed), below.mapped(placed));
            let [fold, keep, fold_little] = RIMS.map(|rims| sheets.pair(&with_rims(rims)).unwrap());
            let context = format!("{slave:?} on {master:?}, overhang {part}");
            let forces = [&fold, &keep, &fold_little]
                .map(|found| nodal_forces(found, sheets.nodes.len(), 1.0));
            for ((a, b), c) in forces[0].iter().zip(&forces[1]).zip(&forces[2]) {
                assert!(apart(*a, *b).max(apart(*a, *c)) < 1e-11, "{context}: {a:?}, {b:?}, {c:?}");
            }
            let rigid = |[x, y, z]: Point| [1.0 + y - 2.0 * z, 3.0 - x + z, 2.0 * x - y];
            let moved = most_moved(&keep, &sheets.nodes, rigid);
            assert!(moved < 1e-8, "{context}: {moved:e}");
            assert!(keep.pairs.iter().all(|pair| pair.area > 0.0), "{context}");
            for (node, into) in folds(&fold) {
                let of_one = |face: &Vec<usize>| face.contains(&node) && face.contains(&into);
                // Two faces far with less than a fiftieth of cover, of nodes that have a sixth of the area at most.
                let area =
                    keep.pairs.iter().find(|pair| pair.slave == node).map_or(0.0, |pair| pair.area);
                let is_near = sheets.slave.iter().any(of_one) || area < 0.02 / 6.0;
                assert!(is_near, "{context}: {node}, {into}, {area}");
                assert!(fold.unpaired.contains(&node) && !fold.unpaired.contains(&into));
            }
            if slave == Shape::Q4 {
                let window = shift.map(|shift| [shift, 1.0]);
                let (covered, whole) = (on_grid([2, 3], window), on_grid([2, 3], [[0.0, 1.0]; 2]));
                for pair in &keep.pairs {
                    assert!((pair.area - covered[pair.slave]).abs() < 1e-14, "{context}: {pair:?}");
                }
                let little = (0..whole.len()).filter(|&node| covered[node] < 0.499 * whole[node]);
                let kept = little.clone().filter(|&node| covered[node] >= 1e-6 * whole[node]);
                assert!(kept.clone().all(|node| keep.pairs.iter().any(|pair| pair.slave == node)));
                let folded: Vec<usize> = folds(&fold).iter().map(|(node, _)| *node).collect();
                assert_eq!(folded, little.collect::<Vec<_>>(), "{context}");
            }
        }
    }
}

/// An arc within a shorter one: the normals of nodes of even steps along a circle are its radii, and with them the mean of
/// those that a row has taken in, by its areas, which is that of their places. So the force of each pair passes
/// through the centre: without friction they turn nothing. To 1e-14, rounding of the sums.
#[test]
fn folded_rows_press_through_the_centre_of_a_circle() {
    for (around, c) in [0.1, 0.3, 0.45, 0.7].into_iter().flat_map(|c| [(20, c), (40, c)]) {
        let angle = std::f64::consts::FRAC_PI_2 / around as f64;
        let arc = |radius: f64, places: Vec<f64>| -> Vec<Point> {
            let angles = places.into_iter().map(|place| (angle * place).sin_cos());
            angles.map(|(sin, cos)| [radius * cos, radius * sin, 0.0]).collect()
        };
        let last = around as f64 - 5.0 + c;
        let inner = arc(1.0, steps(0.0, around as f64, around));
        let outer = arc(1.001, steps(2.0 + c, last, 13));
        let chain = |first: usize, count: usize| (first..first + count - 1).map(|k| vec![k, k + 1]);
        let slave: Vec<Vec<usize>> =
            chain(0, inner.len()).map(|face| vec![face[1], face[0]]).collect();
        let master: Vec<Vec<usize>> = chain(inner.len(), outer.len()).collect();
        let found =
            pair(2, &[inner, outer].concat(), [&slave, &master], &with_rims(Rims::Fold)).unwrap();
        assert_eq!(found.report.folded.len(), 2);
        for SurfacePair { point: [x, y, _], normal, .. } in &found.pairs {
            let arm = x * normal[1] - y * normal[0];
            assert!(arm.abs() < 1e-14, "{around}, {c}: {arm:e}");
        }
    }
}

/// Nodes against surfaces have no cover: a choice for rims is refused, not ignored.
#[test]
fn rims_are_refused_where_nodes_have_no_cover() {
    let (mut nodes, slave) = line(&[0.0, 1.0], false, 0);
    nodes.extend([[0.0; 3], [1.0, 0.0, 0.0]]);
    let settings = SurfaceSettings { pairing: Pairing::NodeToSurface, ..with_rims(Rims::Keep) };
    let error = pair(2, &nodes, [&slave, &[vec![3, 2]]], &settings).unwrap_err().to_string();
    assert!(error.starts_with("rims: nodes against surfaces have no cover"), "{error}");
}
