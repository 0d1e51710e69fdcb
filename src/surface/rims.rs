//! Rims: what becomes of the rows of nodes with little cover.
//!
//! The area `D_j` of a node falls with a high power of the covered strip, so that `F_j / D_j` is rounding,
//! and the row holds a node in the air by masters that are far away. Leaving the row out breaks the patch
//! test. So `D_j d_j` is added to the row of a node of the same face: `Σ ψ_j = 1` stays, and with it the patch
//! test. A node whose row has gone takes in none, so that no row goes further than one face; one with hardly any
//! cover may go two.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use super::mesh::Side;
use super::pairs::Fold;
use super::row::Row;
use super::settings::Rims;
use super::symmetry::OnPlanes;

/// Nodes with less than this share of cover are at a rim. On 36 unstructured meshes the error of a linear pressure is
/// with a half that of meshes that are covered wholly, with 0.3 twice and with a tenth three times as large.
const LEAST_COVER: f64 = 0.5;

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

/// Folds the rows of nodes with little cover. Each goes to a node of its own faces that keeps its row: that with the
/// largest area over the square of the distance. One that finds none keeps its own, and may take in others.
pub(super) fn fold(
    rims: Rims,
    rows: &mut BTreeMap<usize, Row>,
    (slave, dim, planes): (&Side<'_>, usize, &OnPlanes),
) -> Vec<Fold> {
    let enough = |row: &&Row| row.cover() >= LEAST_COVER - SAME_COVER;
    let least = match rims {
        Rims::Keep => SAME_COVER,
        Rims::Fold if rows.values().filter(enough).count() < dim => LITTLE_COVER - SAME_COVER,
        Rims::Fold => LEAST_COVER - SAME_COVER,
    };
    let mut little: Vec<(usize, f64)> = rows
        .iter()
        .map(|(&node, row)| (node, row.cover()))
        .filter(|(_, cover)| !(*cover >= least))
        .collect();
    little.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut beside = neighbours(slave, little.iter().map(|(node, _)| *node));
    let next: Vec<usize> = beside.values().flatten().copied().collect();
    for (node, around) in neighbours(slave, next.into_iter()) {
        beside.entry(node).or_insert(around);
    }
    // The node that each of them goes to; itself, if it keeps its row.
    let mut homes: HashMap<usize, usize> =
        little.iter().map(|(node, _)| (*node, usize::MAX)).collect();
    for (node, cover) in little {
        let is_home = |other: &usize| {
            let takes = |home: &usize| home == other && cover < LITTLE_COVER - SAME_COVER;
            rows.contains_key(other) && homes.get(other).is_none_or(takes)
        };
        let best = |among: BTreeSet<usize>| {
            let homes = among.into_iter().filter(is_home);
            let ranked = homes.filter_map(|home| {
                let worth = planes.in_whole_body(home, node)? * rows[&home].area;
                let away = slave.position(home) - slave.position(node);
                Some((home, worth / away.norm_squared()))
            });
            first_alone(ranked.collect())
        };
        let near = || beside[&node].iter().copied();
        let further = || near().flat_map(|other| beside[&other].iter().copied()).collect();
        let far = || if cover < NEXT_BUT_ONE { best(further()) } else { None };
        let home = best(near().collect()).or_else(far);
        homes.insert(node, home.unwrap_or(node));
    }
    let mut folded: Vec<(usize, usize)> = homes.into_iter().filter(|(a, b)| a != b).collect();
    folded.sort_unstable();
    let fold = |(node, into): (usize, usize)| {
        let row = rows.remove(&node).expect("each node is folded once");
        rows.get_mut(&into).expect("a home keeps its row").take_in(row);
        let distance = (slave.position(into) - slave.position(node)).norm();
        Fold { node, into, distance }
    };
    folded.into_iter().map(fold).collect()
}

/// Of homes with what they are worth the best one that is as good as no other, as nodes on the two sides of a plane of
/// symmetry are: rounding would choose. If there is none, the first of the best.
fn first_alone(mut ranked: Vec<(usize, f64)>) -> Option<usize> {
    ranked.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut groups = ranked.chunk_by(|a, b| b.1 >= (1.0 - SAME_COVER) * a.1);
    let alone = groups.clone().find(|group| matches!(group, [_]));
    alone.or_else(|| groups.next())?.iter().map(|(home, _)| *home).min()
}

/// The other nodes of the slave faces around some nodes.
fn neighbours(slave: &Side<'_>, nodes: impl Iterator<Item = usize>) -> HashMap<usize, Vec<usize>> {
    let mut beside: HashMap<usize, Vec<usize>> = nodes.map(|node| (node, Vec::new())).collect();
    for at in 0..slave.count() {
        let nodes = slave.face(at).nodes;
        for node in nodes {
            if let Some(list) = beside.get_mut(node) {
                list.extend(nodes.iter().filter(|&other| other != node));
            }
        }
    }
    beside
}
