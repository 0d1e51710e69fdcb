//! Rims: what becomes of the rows of nodes with little cover.
//!
//! The area `D_j` of a node falls with a high power of the covered strip, so that `F_j / D_j` is rounding,
//! and the row holds a node in the air by masters that are far away. Leaving the row out breaks the patch
//! test. So `D_j d_j` is shared out to rows of nodes of the same faces: `Σ ψ_j = 1` stays, and with it the patch
//! test. A node whose row has gone takes in none, so that no row goes further than one face; one with hardly any
//! cover may go two.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use super::mesh::Side;
use super::pairs::{Fold, Weight};
use super::row::Row;
use super::settings::Rims;
use super::symmetry::OnPlanes;
use super::watch::Watch;
use crate::error::Error;

/// Nodes with less than this share of cover are at a rim. On 36 unstructured meshes the error of a linear pressure is
/// with a half that of meshes that are covered wholly, with three tenths twice and with a tenth three times as large.
const LEAST_COVER: f64 = 0.5;

/// Nodes with less than this are at a rim where more pairs count more than that error.
const LEAST_OF_MANY: f64 = 0.3;

/// Where so few nodes have that much that they could not hold a body, and where no node beside a rim has it, as under a
/// punch of the size of a face, the rim is of nodes with less than this: pressures are less exact then, but moments
/// are carried.
const LITTLE_COVER: f64 = 0.1;

/// Shares of cover that differ by less are the same, far above the rounding of edges: a face that lacks less is
/// covered wholly, one that has more than all of it by more lies under two faces, and a node at the end of a master
/// that ends where its faces do has half of its cover. With less than this a node does not keep a row even if it
/// shall: six digits of its area would be rounding.
pub(super) const SAME_COVER: f64 = 1e-6;

/// A node with less than this share of cover may go two faces far, if no node beside it has a row to take it: what it
/// carries is too little to be seen.
const NEXT_BUT_ONE: f64 = 0.02;

/// A node shares in a row while the least squared distance is more than this part of its own: up to 5 % further away. The
/// share falls to zero there, so that rows do not jump where one node becomes nearer than another.
const AS_NEAR: f64 = 0.9;

/// Folds the rows of nodes with little cover: each is shared out to the nearest nodes of its own faces that keep theirs. One
/// that finds none keeps its own, and takes in others.
pub(super) fn fold(
    rims: Rims,
    rows: &mut BTreeMap<usize, Row>,
    (slave, planes): (&Side<'_>, &OnPlanes),
    watch: &mut Watch<'_, '_>,
) -> Result<Vec<Fold>, Error> {
    let least = least_cover(rims, rows, slave.dim);
    // Those that keep their rows with their cover, and those that are folded with the nodes around.
    let (mut homes, mut little) = (HashMap::new(), Vec::new());
    for (&node, row) in rows.iter() {
        watch.goes_on()?;
        match row.cover() >= least {
            true => drop(homes.insert(node, row.cover())),
            false => little.push((node, row.cover())),
        }
    }
    little.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut beside = neighbours(slave, little.iter().map(|(node, _)| *node), watch)?;
    let next: Vec<usize> = beside.values().flatten().copied().collect();
    for (node, around) in neighbours(slave, next.into_iter(), watch)? {
        beside.entry(node).or_insert(around);
    }
    let mut gone: BTreeMap<usize, BTreeSet<usize>> = BTreeMap::new();
    for (node, cover) in little {
        watch.goes_on()?;
        let may = |own: &f64| *own >= least || cover < LITTLE_COVER - SAME_COVER;
        let takes = |home: &usize| homes.get(home).is_some_and(may) && planes.stays(*home, node);
        let near = beside[&node].clone();
        let further = || near.iter().flat_map(|other| &beside[other]).copied().collect();
        let far = cover < NEXT_BUT_ONE && !near.iter().any(takes);
        let around = if far { further() } else { near };
        if around.iter().any(takes) {
            gone.insert(node, around);
        } else {
            homes.insert(node, cover);
        }
    }
    let fold = |(node, around): (usize, BTreeSet<usize>)| {
        let keeps = |home: &usize| homes.contains_key(home) && planes.stays(*home, node);
        let squared = |home| (slave.position(home) - slave.position(node)).norm_squared();
        // Two nodes may stand at one place.
        let away = |home| (home, squared(home).max(f64::MIN_POSITIVE));
        let into: Vec<Weight> = around.into_iter().filter(keeps).map(away).collect();
        let nearest = into.iter().min_by(|a, b| a.1.total_cmp(&b.1));
        let &(nearest, least) = nearest.expect("a folded node has a home");
        let worth = |(_, away): &Weight| (least / away - AS_NEAR).max(0.0);
        let sum: f64 = into.iter().map(worth).sum();
        let row = rows.remove(&node).expect("each node is folded once");
        for home in into.iter().filter(|home| worth(home) > 0.0) {
            let taking = rows.get_mut(&home.0).expect("a home keeps its row");
            taking.take_in(&row, worth(home) / sum);
        }
        watch.goes_on()?;
        Ok(Fold { node, into: nearest, distance: least.sqrt() })
    };
    gone.into_iter().map(fold).collect()
}

/// The share of cover with which a node keeps its row.
fn least_cover(rims: Rims, rows: &BTreeMap<usize, Row>, dim: usize) -> f64 {
    let enough = |row: &&Row| row.cover() >= LEAST_COVER - SAME_COVER;
    match rims {
        Rims::Keep => SAME_COVER,
        _ if rows.values().filter(enough).count() < dim => LITTLE_COVER - SAME_COVER,
        Rims::FoldLittle => LEAST_OF_MANY - SAME_COVER,
        Rims::Fold => LEAST_COVER - SAME_COVER,
    }
}

/// The other nodes of the slave faces around some nodes.
fn neighbours(
    slave: &Side<'_>,
    nodes: impl Iterator<Item = usize>,
    watch: &mut Watch<'_, '_>,
) -> Result<HashMap<usize, BTreeSet<usize>>, Error> {
    let mut beside: HashMap<usize, BTreeSet<usize>> =
        nodes.map(|node| (node, BTreeSet::new())).collect();
    for at in 0..slave.count() {
        watch.goes_on()?;
        let nodes = slave.face(at).nodes;
        for node in nodes {
            if let Some(list) = beside.get_mut(node) {
                list.extend(nodes.iter().filter(|&other| other != node));
            }
        }
    }
    Ok(beside)
}
