//! A part of a body that repeats along a line, or along two, has the rows that a part in the middle of many has.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::f64::consts::TAU;

use crate::surfaces::{SHAPES, Shape, Sheet, TwoSheets};
use fastrand::Rng;
use signorini::surface::{Pairing, Sector, SurfacePair, SurfacePairs, SurfaceSettings};

/// Places in numbers of periods, and heights; the periods are skewed, and waves go along both.
fn place([x, y, z]: [f64; 3]) -> [f64; 3] {
    [x + 0.15 * y, y + 0.2 * x, z + 0.1 * x + 0.02 * (TAU * x).sin() + 0.01 * (TAU * y).cos()]
}

const PERIODS: [[f64; 3]; 2] = [[1.0, 0.2, 0.1], [0.15, 1.0, 0.0]];
const NONE: [f64; 3] = [0.0; 3];

/// Copies on each side of the part. Rows depend on nodes up to eight faces away, and the part has four.
const COPIES: i32 = 2;

/// A number of a node that all of its images have: that of its place in the part, of the slave's side or the master's.
type Key = (bool, i64, i64);

fn key(is_master: bool, [x, y]: [f64; 2]) -> Key {
    // Places are thousandths and more apart.
    let rounded = |x: f64| (1e6 * x).round() as i64;
    (is_master, rounded(x), rounded(y))
}

/// The part, and many of it, along one line or two. Along one sides are open at the ends of a strip. The master begins elsewhere.
struct Bodies {
    part: TwoSheets,
    many: TwoSheets,
    /// The key of each node of both.
    keys: [Vec<Key>; 2],
    /// Each node of the part among the many.
    among: Vec<usize>,
}

fn bodies(shape: Shape, ways: usize, rng: &mut Rng) -> Bodies {
    let along = if ways == 2 { [[0.0, 1.0], [0.2, 1.2]] } else { [[0.0, 2.0], [0.2, 1.7]] };
    let slave = Sheet::rectangle(shape, [4, 4], [[0.0, 1.0], along[0]], (0.2, rng));
    let master = Sheet::rectangle(shape, [3, 3], [[0.3, 1.3], along[1]], (0.2, rng));
    let mut part = TwoSheets::new(3, slave.mapped(|x| [x[0], x[1], 0.01]).turned(), master);
    let slaves = part.nodes.iter().filter(|x| x[2] > 0.0).count();
    let mut many =
        TwoSheets { nodes: Vec::new(), slave: Vec::new(), master: Vec::new(), ..part.clone() };
    let mut keys = [Vec::new(), Vec::new()];
    let modulo = |way: usize, x: f64| if way < ways { (x + 1e-9).rem_euclid(1.0) } else { x };
    let of_part =
        |(at, x): (usize, &[f64; 3])| key(at >= slaves, [modulo(0, x[0]), modulo(1, x[1])]);
    keys[0] = part.nodes.iter().enumerate().map(of_part).collect();
    let (mut known, mut among) = (HashMap::new(), vec![0; part.nodes.len()]);
    let across = if ways == 2 { COPIES } else { 0 };
    let copies = || (-across..=across).flat_map(|b| (-COPIES..=COPIES).map(move |a| (a, b)));
    for copy in copies() {
        let mut numbers = Vec::new();
        for (at, [x, y, z]) in part.nodes.iter().copied().enumerate() {
            let [x, y] = [x + f64::from(copy.0), y + f64::from(copy.1)];
            let number = *known.entry(key(at >= slaves, [x, y])).or_insert(many.nodes.len());
            if number == many.nodes.len() {
                many.nodes.push([x, y, z]);
                keys[1].push(keys[0][at]);
            }
            numbers.push(number);
        }
        let there = |faces: &[Vec<usize>]| -> Vec<Vec<usize>> {
            faces.iter().map(|face| face.iter().map(|node| numbers[*node]).collect()).collect()
        };
        many.slave.extend(there(&part.slave));
        many.master.extend(there(&part.master));
        if copy == (0, 0) {
            among = numbers;
        }
    }
    for nodes in [&mut part.nodes, &mut many.nodes] {
        nodes.iter_mut().for_each(|x| *x = place(*x));
    }
    Bodies { part, many, keys, among }
}

/// Weights of slaves and of masters, by the node of which all are images.
fn weights(found: &SurfacePairs, pair: &SurfacePair, keys: &[Key]) -> BTreeMap<(bool, Key), f64> {
    let mut sums = BTreeMap::new();
    for (at, (node, weight)) in pair.nodes.iter().enumerate() {
        let (node, turn) = found.images.of(*node);
        assert!(turn == turn.transpose() * turn, "a shift does not turn");
        *sums.entry((at >= pair.slave_count, keys[node])).or_default() += weight;
    }
    sums
}

#[test]
fn a_period_has_the_rows_of_many() {
    let mut rng = Rng::with_seed(11);
    for (shape, ways) in SHAPES.into_iter().flat_map(|shape| [(shape, 1), (shape, 2)]) {
        for pairing in [Pairing::DualMortar, Pairing::NodeToSurface] {
            let Bodies { part, many, keys, among } = bodies(shape, ways, &mut rng);
            let periods = [PERIODS[0], if ways == 2 { PERIODS[1] } else { NONE }];
            let sector = Some(Sector { periods, ..Sector::default() });
            let settings =
                SurfaceSettings { pairing, search_distance: Some(0.5), ..Default::default() };
            let whole = many.pair(&settings).unwrap();
            let found = part.pair(&SurfaceSettings { sector, ..settings }).unwrap();
            let context = format!("{shape:?}, {ways}, {pairing:?}");
            // One of nodes that are images of each other has the pair.
            let of_part = |node: &usize| among.iter().position(|other| other == node);
            let slaves = whole.pairs.iter().filter_map(|pair| of_part(&pair.slave));
            let expected: BTreeSet<Key> = slaves.map(|node| keys[0][node]).collect();
            let own: Vec<Key> = found.pairs.iter().map(|pair| keys[0][pair.slave]).collect();
            assert_eq!(own.len(), expected.len(), "{context}");
            assert_eq!(own.into_iter().collect::<BTreeSet<_>>(), expected, "{context}");
            for own in &found.pairs {
                let at = whole.pairs.binary_search_by_key(&among[own.slave], |pair| pair.slave);
                let other = &whole.pairs[at.unwrap_or_else(|_| panic!("{context}: {own:?}"))];
                // Rounding of integrals over faces whose places differ by rounding.
                let near = |a: f64, b: f64| (a - b).abs() < 1e-10;
                assert!(near(own.area, other.area) && near(own.gap, other.gap), "{context}");
                assert!((0..3).all(|i| near(own.normal[i], other.normal[i])), "{context}");
                let [a, b] = [weights(&found, own, &keys[0]), weights(&whole, other, &keys[1])];
                assert!(a.keys().eq(b.keys()), "{context}: {a:?}, {b:?}");
                assert!(a.values().zip(b.values()).all(|(a, b)| near(*a, *b)), "{context}");
            }
        }
    }
}

/// A period of another length than that of the mesh, and one that is none, are refused.
#[test]
fn wrong_periods_are_refused() {
    let mut rng = Rng::with_seed(12);
    let sheet = |up| {
        let sheet = Sheet::rectangle(Shape::Q4, [4, 3], [[0.0, 1.0], [0.0, 2.0]], (0.0, &mut rng));
        sheet.mapped(|x| [x[0], x[1], up])
    };
    let [slave, master] = [0.01, 0.0].map(sheet);
    let flat = TwoSheets::new(3, slave.turned(), master);
    let bent = bodies(Shape::Q4, 1, &mut Rng::with_seed(12)).part;
    let along = [1.0, 0.0, 0.0];
    for (part, periods, words) in [
        (
            &flat,
            [[0.875, 0.0, 0.0], NONE],
            "image of slave node 0, shifted by a period, lies on slave face",
        ),
        (&flat, [along, [0.0, 1.75, 0.0]], "shifted by a period, lies on slave face"),
        (&bent, [[0.875, 0.175, 0.0875], NONE], "and the number of sectors, or the period"),
        (&flat, [[f64::NAN, 0.0, 0.0], NONE], "its period NaN, 0, 0 is no way"),
        (&flat, [along, [0.0, f64::INFINITY, 0.0]], "its period 0, inf, 0 is no way"),
        (&flat, [along, [-2.0, 0.0, 0.0]], "its two periods are along one line"),
    ] {
        let sector = Some(Sector { periods, ..Sector::default() });
        let settings = SurfaceSettings { sector, ..Default::default() };
        let error = part.pair(&settings).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    }
}

/// Where the period has more digits than the coordinates, nodes of the boundaries match up to these, and pairs are those of
/// exact places but for what rounding moves.
#[test]
fn coordinates_of_few_digits_match() {
    let scale = 0.765_432_1;
    for (shape, ways) in [(Shape::Q4, 1), (Shape::Q8, 2), (Shape::T3, 2), (Shape::T6, 1)] {
        let mut part = bodies(shape, ways, &mut Rng::with_seed(13)).part;
        part.nodes.iter_mut().flatten().for_each(|x| *x *= scale);
        let mut periods = PERIODS.map(|way| way.map(|x| scale * x));
        periods[ways..].fill(NONE);
        let sector = Some(Sector { periods, ..Sector::default() });
        let settings = SurfaceSettings { sector, ..Default::default() };
        let exact = part.pair(&settings).unwrap();
        for digits in [1e8, 1e6, 1e5, 1e4] {
            let mut rounded = part.clone();
            rounded.nodes.iter_mut().flatten().for_each(|x| *x = (digits * *x).round() / digits);
            let found = rounded.pair(&settings).unwrap();
            assert_eq!(slaves_of(&found), slaves_of(&exact), "{shape:?} {digits}");
            for (own, exact) in found.pairs.iter().zip(&exact.pairs) {
                // Areas and gaps of the order of 0.05 and 0.01 by edges of 0.2, whose ends move by half of the last digit.
                assert!((own.area - exact.area).abs() < 1.0 / digits);
                assert!((own.gap - exact.gap).abs() < 3.0 / digits);
            }
        }
        // A node that was moved along the boundary by more than a digit has no partner.
        let node = slaves_of(&exact)[0];
        let mut moved = part.clone();
        let (from, way) = (moved.nodes[node], periods[0]);
        let is_image = |x: &[f64; 3]| (0..3).all(|c| (x[c] - from[c] - way[c]).abs() < 1e-9);
        let image = moved.nodes.iter().position(is_image);
        if let Some(image) = image {
            moved.nodes[image][1] += 0.002;
            let error = moved.pair(&settings).unwrap_err().to_string();
            assert!(error.contains("nodes of the two boundaries that match"), "{error}");
        }
    }
}

fn slaves_of(found: &SurfacePairs) -> Vec<usize> {
    found.pairs.iter().map(|pair| pair.slave).collect()
}
