//! Masters that are as small as a slave face: their pairs carry moments, and neither other masters far away nor boundaries of
//! a part change them.

use crate::surfaces::{Shape, Sheet, TwoSheets, nodal_forces};
use fastrand::Rng;
use signorini::surface::{Sector, SurfacePairs, SurfaceSettings, SymmetryPlane};

type Window = [[f64; 2]; 2];

/// A slave plate of faces of the size 1 with a master of one face under each window.
fn over(shape: Shape, plate: Window, windows: &[Window]) -> TwoSheets {
    let rng = &mut Rng::with_seed(1);
    let cells = plate.map(|[from, to]| (to - from).round() as usize);
    let above = Sheet::rectangle(shape, cells, plate, (0.0, rng)).turned();
    let mut below = Sheet { nodes: Vec::new(), faces: Vec::new() };
    for window in windows {
        let post = Sheet::rectangle(Shape::Q4, [1, 1], *window, (0.0, rng));
        let first = below.nodes.len();
        let faces = post.faces.iter().map(|face| face.iter().map(|node| node + first).collect());
        below.faces.extend(faces);
        below.nodes.extend(post.nodes);
    }
    TwoSheets::new(3, above, below)
}

fn square([x, y]: [f64; 2], size: f64) -> Window {
    [[x, x + size], [y, y + size]]
}

/// Where pairs have their nodes, with their areas, the place by the area and the number of nodes, in the order of places.
fn told(sheets: &TwoSheets, found: &SurfacePairs) -> Vec<[f64; 6]> {
    let of_pair = |pair: &signorini::surface::SurfacePair| {
        let [x, y, _] = sheets.nodes[pair.slave];
        [x, y, pair.area, pair.point[0], pair.point[1], pair.nodes.len() as f64]
    };
    let mut told: Vec<_> = found.pairs.iter().map(of_pair).collect();
    told.sort_by(|a, b| a.partial_cmp(b).unwrap());
    told
}

/// Rounding of sums of numbers of the size ten.
fn are_same(a: &[[f64; 6]], b: &[[f64; 6]], context: &str) {
    assert_eq!(a.len(), b.len(), "{context}: {a:?}, {b:?}");
    let apart = a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| (a - b).abs());
    let apart = apart.fold(0.0, f64::max);
    assert!(apart < 1e-12, "{context}: {apart:e}, {a:?}, {b:?}");
}

/// Sizes of masters, from a fiftieth of a face to more than one, and where they begin in a face.
fn posts() -> impl Iterator<Item = (f64, [f64; 2])> {
    let begins = [[0.7, 0.7], [0.3, 0.45], [0.9, 0.1], [0.4, 0.0]];
    [0.02, 0.1, 0.2, 0.6, 1.0, 1.3, 1.6].into_iter().flat_map(move |s| begins.map(|b| (s, b)))
}

/// The pairs of a post are not on a line, so that they balance every force within it with its moments: those of the areas
/// about its middle cancel, and forces of a uniform pressure are in its middle on either side. The area is its own.
#[test]
fn pairs_of_a_post_carry_moments() {
    for (shape, (size, [x, y])) in [Shape::Q4, Shape::T3, Shape::Q8, Shape::T6]
        .into_iter()
        .flat_map(|s| posts().map(move |p| (s, p)))
    {
        let sheets = over(shape, [[0.0, 7.0]; 2], &[square([x + 2.0, y + 2.0], size)]);
        let found = sheets.pair(&SurfaceSettings::default()).unwrap();
        let context = format!("{shape:?}, {size}, {x}, {y}");
        let places: Vec<[f64; 2]> =
            found.pairs.iter().map(|pair| [pair.point[0], pair.point[1]]).collect();
        let from = |[x, y]: [f64; 2]| [x - places[0][0], y - places[0][1]];
        let cross = |a: [f64; 2], b: [f64; 2]| (a[0] * b[1] - a[1] * b[0]).abs();
        let span = places.iter().flat_map(|a| places.iter().map(|b| cross(from(*a), from(*b))));
        // The nodes of a triangle of a twentieth of a face at least: those of the mid nodes' rows are nearer.
        assert!(span.fold(0.0, f64::max) > 0.05 * size * size, "{context}: {places:?}");
        let forces = nodal_forces(&found, sheets.nodes.len(), 1.0);
        let middle = [x + 2.0 + 0.5 * size, y + 2.0 + 0.5 * size, 0.0];
        let first_of_master = sheets.nodes.len() - 4;
        for (nodes, sign) in
            [(0..first_of_master, -1.0), (first_of_master..sheets.nodes.len(), 1.0)]
        {
            let (mut sum, mut moments) = (0.0, [0.0; 2]);
            for node in nodes {
                sum += sign * forces[node][2];
                (0..2).for_each(|c| {
                    moments[c] += forces[node][2] * (sheets.nodes[node][c] - middle[c])
                });
            }
            assert!((sum.abs() - size * size).abs() < 1e-13, "{context}: {sum}");
            assert!(moments.iter().all(|moment| moment.abs() < 1e-13), "{context}: {moments:?}");
        }
    }
}

/// Of several posts each has the pairs that it has alone.
#[test]
fn posts_far_apart_have_the_pairs_of_one() {
    for (shape, (size, begin)) in
        [Shape::Q4, Shape::T3, Shape::Q8].into_iter().flat_map(|s| posts().map(move |p| (s, p)))
    {
        let plate = [[0.0, 14.0]; 2];
        let corners = [[2.0, 2.0], [8.0, 2.0], [2.0, 8.0], [8.0, 8.0]];
        let windows = corners.map(|at| square([at[0] + begin[0], at[1] + begin[1]], size));
        let pairs = |windows: &[Window]| {
            let sheets = over(shape, plate, windows);
            told(&sheets, &sheets.pair(&SurfaceSettings::default()).unwrap())
        };
        let mut alone: Vec<_> = windows.iter().flat_map(|window| pairs(&[*window])).collect();
        alone.sort_by(|a, b| a.partial_cmp(b).unwrap());
        are_same(&pairs(&windows), &alone, &format!("{shape:?}, {size}, {begin:?}"));
    }
}

/// A quarter with planes of symmetry has the pairs of its whole, wherever the posts are: within it, or cut by the planes. A node on
/// a plane has its part of the area.
#[test]
fn a_quarter_has_the_pairs_of_its_whole() {
    for (size, begin) in posts() {
        for away in [0.0, 3.0] {
            let own = square(begin.map(|x| if away == 0.0 { 0.0 } else { x + away }), size);
            let mirrored = |[from, to]: [f64; 2], sign: f64| {
                if sign < 0.0 { [-to, -from] } else { [from, to] }
            };
            let signs = [[1.0, 1.0], [-1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]];
            let all = match away {
                0.0 => vec![[[-size, size]; 2]],
                _ => signs.map(|[a, b]| [mirrored(own[0], a), mirrored(own[1], b)]).to_vec(),
            };
            let quarter = over(Shape::Q4, [[0.0, 7.0]; 2], &[own]);
            let whole = over(Shape::Q4, [[-7.0, 7.0]; 2], &all);
            let symmetry = vec![SymmetryPlane::across(0, 0.0), SymmetryPlane::across(1, 0.0)];
            let settings = SurfaceSettings { symmetry, ..SurfaceSettings::default() };
            let found = quarter.pair(&settings).unwrap();
            let mut expected = told(&whole, &whole.pair(&SurfaceSettings::default()).unwrap());
            expected.retain(|[x, y, ..]| *x > -0.5 && *y > -0.5);
            let context = format!("{size}, {begin:?}, {away}");
            let areas = |told: &[[f64; 6]]| -> Vec<[f64; 3]> {
                told.iter().map(|x| [x[0], x[1], x[2]]).collect()
            };
            let (own, expected) = (areas(&told(&quarter, &found)), areas(&expected));
            assert_eq!(own.len(), expected.len(), "{context}: {own:?}, {expected:?}");
            for ([x, y, area], [a, b, whole]) in own.into_iter().zip(expected) {
                let half = |x: f64| if x.abs() < 1e-9 { 0.5 } else { 1.0 };
                let apart =
                    (x - a).abs() + (y - b).abs() + (area - half(x) * half(y) * whole).abs();
                assert!(apart < 1e-12, "{context}: {x}, {y}, {area}, {whole}");
            }
        }
    }
}

/// A wall under a strip that is narrower than a face, across a period: its pairs are those of the wall under four periods,
/// and under a straight one they are not on a line. Faces along waves have some nodes with much cover and most with little.
#[test]
fn a_narrow_wall_has_the_pairs_of_more_periods() {
    for (width, begin) in
        [0.1, 0.4, 0.6, 0.9].into_iter().flat_map(|w| [0.1, 0.35, 0.8].map(|b| (w, b)))
    {
        for skew in [0.0, 0.15] {
            let wall = |periods: usize| {
                let length = 3.0 * periods as f64;
                let mut sheets = over(
                    Shape::Q4,
                    [[0.0, length], [0.0, 7.0]],
                    &[[[0.0, length], [2.0 + begin, 2.0 + begin + width]]],
                );
                let across = |x: f64| skew * (x * std::f64::consts::TAU / 3.0).sin();
                let slaves = sheets.nodes.len() - 4;
                sheets.nodes[..slaves].iter_mut().for_each(|node| node[1] += across(node[0]));
                let sector =
                    Some(Sector { periods: [[length, 0.0, 0.0], [0.0; 3]], ..Sector::default() });
                let settings = SurfaceSettings { sector, ..SurfaceSettings::default() };
                let found = sheets.pair(&settings).unwrap();
                let mut told = told(&sheets, &found);
                told.iter_mut().for_each(|pair| {
                    pair[0] = pair[0].round().rem_euclid(3.0);
                });
                told.sort_by(|a, b| a.partial_cmp(b).unwrap());
                told
            };
            let (one, four) = (wall(1), wall(4));
            let context = format!("{width}, {begin}, {skew}");
            assert_eq!(4 * one.len(), four.len(), "{context}");
            for (at, of_four) in four.chunks(4).enumerate() {
                for other in of_four {
                    assert!(
                        (other[2] - one[at][2]).abs() < 1e-12,
                        "{context}: {other:?}, {:?}",
                        one[at]
                    );
                }
            }
            let lines = one.iter().map(|pair| pair[1]);
            let [low, high] = [f64::min, f64::max].map(|of| lines.clone().reduce(of).unwrap());
            assert!(skew > 0.0 || high - low > 0.5, "{context}: {one:?}");
        }
    }
}
