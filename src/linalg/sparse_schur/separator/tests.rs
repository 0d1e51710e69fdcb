//! Separators of small graphs, whose properties are counted.

use std::collections::BTreeSet;

use super::{BETWEEN, Level, Lists, Sides, separator};
use fastrand::Rng;

/// A strip of `length` x `width` nodes, each beside the eight around it.
pub fn strip(length: usize, width: usize) -> Lists {
    let beside = |v: usize| {
        let near = move |w: &usize| {
            (w / width).abs_diff(v / width) <= 1 && (w % width).abs_diff(v % width) <= 1
        };
        let around = v.saturating_sub(2 * width)..(v + 2 * width).min(length * width);
        around.filter(near).filter(move |&w| w != v)
    };
    (0..length * width).map(beside).collect()
}

/// A connected graph by chance: a path with more edges.
fn random(rng: &mut Rng, size: usize, more: usize) -> Lists {
    let mut edges: Vec<_> = (1..size).map(|v| (v - 1, v)).collect();
    edges.extend((0..more).map(|_| (rng.usize(0..size), rng.usize(0..size))));
    let mut beside = vec![BTreeSet::new(); size];
    for (v, w) in edges.into_iter().filter(|(v, w)| v != w) {
        beside[v].insert(w);
        beside[w].insert(v);
    }
    beside.into_iter().collect()
}

fn finest(links: &Lists) -> Level<'_> {
    Level::finest(links, usize::MAX, &mut |_| Ok(())).unwrap()
}

/// In graphs of twos as in the first one: no edge leads from side to side, sizes are sums of weights, and what is
/// refined is no worse.
#[test]
fn what_is_refined_is_a_separator_that_is_no_worse() {
    let rng = &mut Rng::with_seed(1);
    for _ in 0..200 {
        let size = rng.usize(10..200);
        let links = random(rng, size, size / 2);
        let first = finest(&links);
        let coarse = first.coarse().0;
        for graph in [first, coarse] {
            // A vertex beside the other side is in the separator.
            let half = graph.links.count() / 2;
            let other = |v: usize| graph.links.of(v).any(|w| (w < half) != (v < half));
            let mark = |v| if other(v) { BETWEEN } else { usize::from(v < half) };
            let side: Vec<usize> = (0..graph.links.count()).map(mark).collect();
            let before = Sides::new(&graph, side.clone()).badness();
            let sides = Sides::refined(&graph, side, &mut |_| Ok(())).unwrap();
            assert!(!(sides.badness() > before), "{} > {before}", sides.badness());
            let mut size = [0; 3];
            for (v, &side) in sides.side.iter().enumerate() {
                size[side] += graph.weight[v];
                let across = graph.links.of(v).any(|w| sides.side[w] + side == 1);
                assert!(!across, "{v}: {:?}", sides.side);
            }
            assert_eq!(sides.size, size);
        }
    }
}

/// Each vertex becomes a part of one other, with a neighbour or alone; weights are counts, and what ties two of the
/// new ones is the sum of what ties their parts.
#[test]
fn twos_have_the_weights_and_ties_of_their_parts() {
    let rng = &mut Rng::with_seed(2);
    for _ in 0..100 {
        let size = rng.usize(2..60);
        let links = random(rng, size, size);
        let fine = finest(&links);
        for v in 0..size {
            for (w, strength) in fine.edges(v) {
                let common = links.of(v).filter(|&x| links.of(w).any(|y| y == x));
                assert_eq!(strength, 1 + common.count() as i32);
            }
        }
        let (coarse, one) = fine.coarse();
        let of = |k: usize| one.iter().enumerate().filter(move |&(_, &one)| one == k);
        for k in 0..coarse.links.count() {
            let parts: Vec<usize> = of(k).map(|(v, _)| v).collect();
            assert_eq!(coarse.weight[k], parts.len() as i64);
            let tied =
                |[v, w]: [usize; 2]| fine.edges(v).find(|edge| edge.0 == w).map(|edge| edge.1);
            assert!(parts.len() == 1 || tied([parts[0], parts[1]]).is_some(), "{parts:?}");
            assert!(coarse.links.of(k).is_sorted());
            for other in (0..coarse.links.count()).filter(|&other| other != k) {
                let pairs = parts.iter().flat_map(|&v| of(other).map(move |(w, _)| [v, w]));
                let sum: i32 = pairs.filter_map(tied).sum();
                let told = coarse.edges(k).find(|edge| edge.0 == other).map_or(0, |edge| edge.1);
                assert_eq!(told, sum);
            }
        }
    }
}

/// Where all are neighbours nothing parts two of them.
#[test]
fn what_nothing_parts_has_no_separator() {
    let size = 40;
    let links = (0..size).map(|v| (0..size).filter(move |&w| w != v)).collect();
    for small in [size / 2, size + 1] {
        assert_eq!(separator(&links, small, &mut |_| Ok(())).unwrap(), None);
    }
}
