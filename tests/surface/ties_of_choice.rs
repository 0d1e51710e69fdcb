//! Where two answers are equally near, rounding and the order of faces do not choose.

use crate::surfaces::{SHAPES, Sheet, TwoSheets, pair};
use fastrand::Rng;
use signorini::surface::{Normals, Pairing, Sector, SurfacePairs, SurfaceSettings, SymmetryPlane};

fn of_faces(symmetry: Vec<SymmetryPlane>) -> SurfaceSettings {
    let (pairing, normals) = (Pairing::NodeToSurface, Normals::Faces);
    SurfaceSettings { pairing, normals, symmetry, ..SurfaceSettings::default() }
}

/// A mesh far from the origin has the pairs of the same mesh there, but for the rounding of its coordinates: places of 2000 have
/// roundings of 2e-13, normals of faces of the size .5 those of 1e-12, and points at the distance .1 less.
#[test]
fn pairs_do_not_depend_on_where_the_mesh_stands() {
    let mut rng = Rng::with_seed(61);
    let wave = |[x, y, z]: [f64; 3]| [x, y, z + 0.05 * (2.0 * x).sin() * (1.5 * y).cos()];
    for shape in SHAPES {
        let slave = Sheet::rectangle(shape, [4; 2], [[0.0, 2.0]; 2], (0.1, &mut rng));
        let master = Sheet::rectangle(shape, [3, 5], [[-0.1, 2.1]; 2], (0.1, &mut rng));
        let master = master.mapped(|[x, y, z]| wave([x, y, z - 0.1]));
        let both = TwoSheets::new(3, slave.turned().mapped(wave), master);
        let found = both.pair(&of_faces(vec![])).unwrap();
        for away in [1e1, 1e2, 1e3] {
            let mut there = both.clone();
            let move_by = [away, -0.5 * away, 0.4 * away];
            there.nodes.iter_mut().for_each(|p| (0..3).for_each(|c| p[c] += move_by[c]));
            let other = there.pair(&of_faces(vec![])).unwrap();
            assert_eq!(found.pairs.len(), other.pairs.len());
            for (own, moved) in found.pairs.iter().zip(&other.pairs) {
                let close =
                    |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-10);
                let context = format!("{shape:?}, {away}: {own:?}, {moved:?}");
                assert!(
                    close(&own.normal, &moved.normal) && (own.gap - moved.gap).abs() < 1e-10,
                    "{context}"
                );
                let weight = |found: &[(usize, f64)], node: usize| {
                    found
                        .iter()
                        .find(|(other, _)| *other == node)
                        .map_or(0.0, |(_, weight)| *weight)
                };
                for (node, _) in own.nodes.iter().chain(&moved.nodes) {
                    let [a, b] = [own, moved].map(|pair| weight(pair.masters(), *node));
                    assert!((a - b).abs() < 1e-10, "{context}");
                }
            }
        }
    }
}

/// A regular polygon in another one, turned: all sides are alike by symmetry, hexagons among them, whose corners turn by 60 degrees.
#[test]
fn sides_of_a_polygon_are_alike() {
    for sides in 3..=12 {
        for (clearance, turned) in [(0.02, 0.02), (-0.01, 0.13)] {
            for by in [0.0, 0.1, 0.7, 1.1] {
                let corner =
                    |radius: f64, angle: f64| [radius * angle.cos(), radius * angle.sin(), 0.0];
                let angle = |i: usize| by + std::f64::consts::TAU * i as f64 / sides as f64;
                let inner = (0..sides).map(|i| corner(2.0, angle(i) + turned));
                let outer = (0..sides).map(|i| corner(2.0 + clearance, angle(i)));
                let nodes: Vec<[f64; 3]> = inner.chain(outer).collect();
                let master: Vec<Vec<usize>> =
                    (0..sides).map(|i| vec![i, (i + 1) % sides]).collect();
                let slave: Vec<Vec<usize>> =
                    (0..sides).map(|i| vec![sides + (i + 1) % sides, sides + i]).collect();
                let found =
                    pair(2, &nodes, [&slave, &master], &SurfaceSettings::default()).unwrap();
                let context = format!("{sides}, {clearance}, {by}: {:?}", found.pairs);
                for pair in &found.pairs {
                    let first = &found.pairs[0];
                    assert!((pair.gap - first.gap).abs() < 1e-12, "{context}");
                    assert!((pair.area - first.area).abs() < 1e-12, "{context}");
                }
            }
        }
    }
}

/// A node over a notch is equally near to both flanks, and over a ridge its ray meets both. Its normal is their mean and its gap that to
/// the bottom or to the ridge, whichever flank is first in the list, and in the half model; also where it touches, but for the rounding
/// of coordinates.
#[test]
fn a_node_over_two_flanks_has_their_mean() {
    for (rise, level) in [(0.3, 0.1), (0.02, 0.1), (-0.3, 0.1), (-0.3, 0.0), (-0.3, 3e-17)] {
        let nodes = vec![
            [-1.0, level, 0.0],
            [0.0, level, 0.0],
            [1.0, level, 0.0],
            [-1.0, rise, 0.0],
            [0.0, 0.0, 0.0],
            [1.0, rise, 0.0],
        ];
        let slave = [vec![0, 1], vec![1, 2]];
        let flanks = [vec![4, 3], vec![5, 4]];
        let turned = [flanks[1].clone(), flanks[0].clone()];
        let of_node = |found: SurfacePairs| {
            let pair = found.pairs.into_iter().find(|pair| pair.slave == 1).expect("a pair");
            (pair.normal, pair.gap)
        };
        let whole = |flanks: &[Vec<usize>]| {
            of_node(pair(2, &nodes, [&slave[..], flanks], &of_faces(vec![])).unwrap())
        };
        let half = of_faces(vec![SymmetryPlane::across(0, 0.0)]);
        let half = of_node(pair(2, &nodes, [&slave[1..], &flanks[1..]], &half).unwrap());
        for (normal, gap) in [whole(&flanks), whole(&turned), half] {
            assert!(
                normal[0].abs() < 1e-15 && (normal[1] + 1.0).abs() < 1e-15,
                "{rise}: {normal:?}"
            );
            assert!((gap - level).abs() < 1e-15, "{rise}: {gap}");
        }
    }
}

/// No slave faces are no pairs in a sector too.
#[test]
fn no_slave_faces_are_no_pairs_in_a_sector() {
    let sheet = Sheet::rectangle(SHAPES[0], [2; 2], [[1.0, 2.0]; 2], (0.0, &mut Rng::with_seed(1)));
    for count in [2, 3, 4, 9] {
        let axis = [0.0, 0.0, 1.0];
        let sector = Some(Sector { axis, count, ..Sector::default() });
        let settings = SurfaceSettings { sector, ..SurfaceSettings::default() };
        let found = pair(3, &sheet.nodes, [&[][..], &sheet.faces], &settings).unwrap();
        assert!(found.summary().to_string().contains("there are no slave faces"));
    }
}
