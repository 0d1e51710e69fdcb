//! A part of a body that repeats along a line has the rows that a part in the middle of many has.

use std::collections::{BTreeMap, HashMap};
use std::f64::consts::TAU;

use crate::surfaces::{SHAPES, Shape, Sheet, TwoSheets};
use fastrand::Rng;
use signorini::surface::{Pairing, Sector, SurfacePair, SurfacePairs, SurfaceSettings};

/// Places in numbers of periods, of a strip, and heights; the period and the strip are skewed, and waves go along.
fn place([x, y, z]: [f64; 3]) -> [f64; 3] {
    [x, y + 0.2 * x, z + 0.1 * x + 0.02 * (TAU * x).sin()]
}

const PERIOD: [f64; 3] = [1.0, 0.2, 0.1];

/// Copies on each side of the part. Rows depend on nodes up to five faces away, and the part has four.
const COPIES: i32 = 2;

/// A number of a node that all of its images have: that of its place in the part, of the slave's side or the master's.
type Key = (bool, i64, i64);

fn key(is_master: bool, [x, y, _]: [f64; 3], x_of: impl Fn(f64) -> f64) -> Key {
    // Places are thousandths and more apart.
    let rounded = |x: f64| (1e6 * x).round() as i64;
    (is_master, rounded(x_of(x)), rounded(y))
}

/// The part, and many of it. Sides are open at the ends of the strip, and the master begins elsewhere along it.
struct Bodies {
    part: TwoSheets,
    many: TwoSheets,
    /// The key of each node of both.
    keys: [Vec<Key>; 2],
    /// Each node of the part among the many.
    among: Vec<usize>,
}

fn bodies(shape: Shape, rng: &mut Rng) -> Bodies {
    let slave = Sheet::rectangle(shape, [4, 3], [[0.0, 1.0], [0.0, 2.0]], (0.2, rng));
    let master = Sheet::rectangle(shape, [3, 3], [[0.3, 1.3], [0.2, 1.7]], (0.2, rng));
    let mut part = TwoSheets::new(3, slave.mapped(|x| [x[0], x[1], 0.01]).turned(), master);
    let slaves = part.nodes.iter().filter(|x| x[2] > 0.0).count();
    let mut many =
        TwoSheets { nodes: Vec::new(), slave: Vec::new(), master: Vec::new(), ..part.clone() };
    let mut keys = [Vec::new(), Vec::new()];
    let modulo = |x: f64| (x + 1e-9).rem_euclid(1.0);
    keys[0] = part.nodes.iter().enumerate().map(|(at, x)| key(at >= slaves, *x, modulo)).collect();
    let (mut known, mut among) = (HashMap::new(), vec![0; part.nodes.len()]);
    for copy in -COPIES..=COPIES {
        let mut numbers = Vec::new();
        for (at, [x, y, z]) in part.nodes.iter().copied().enumerate() {
            let x = x + f64::from(copy);
            let number =
                *known.entry(key(at >= slaves, [x, y, z], |x| x)).or_insert(many.nodes.len());
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
        if copy == 0 {
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
    for shape in SHAPES {
        for pairing in [Pairing::DualMortar, Pairing::NodeToSurface] {
            let Bodies { part, many, keys, among } = bodies(shape, &mut rng);
            let sector = Some(Sector { period: PERIOD, ..Sector::default() });
            let settings =
                SurfaceSettings { pairing, search_distance: Some(0.5), ..Default::default() };
            let whole = many.pair(&settings).unwrap();
            let found = part.pair(&SurfaceSettings { sector, ..settings }).unwrap();
            let context = format!("{shape:?}, {pairing:?}");
            // Nodes of the second boundary have no pair of their own.
            let is_first = |node: &usize| (part.nodes[*node][0] - 1.0).abs() > 1e-9;
            let expected = whole.pairs.iter().filter(|pair| {
                among
                    .iter()
                    .position(|node| *node == pair.slave)
                    .is_some_and(|node| is_first(&node))
            });
            assert_eq!(found.pairs.len(), expected.count(), "{context}");
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
    let bent = bodies(Shape::Q4, &mut Rng::with_seed(12)).part;
    for (part, period, words) in [
        (
            &flat,
            [0.875, 0.0, 0.0],
            "image of slave node 0, shifted by the period, lies on slave face",
        ),
        (&bent, [0.875, 0.175, 0.0875], "and the number of sectors, or the period"),
        (&flat, [f64::NAN, 0.0, 0.0], "its period NaN, 0, 0 is no way"),
    ] {
        let sector = Some(Sector { period, ..Sector::default() });
        let settings = SurfaceSettings { sector, ..Default::default() };
        let error = part.pair(&settings).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    }
}
