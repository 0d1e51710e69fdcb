//! Rims: what becomes of the rows of nodes with little cover.
//!
//! The area `D_j` of a node falls with a high power of the covered strip, so that `F_j / D_j` is rounding,
//! and the row holds a node in the air by masters that are far away. Leaving the row out breaks the patch
//! test. So by default `D_j d_j` is added to the row of a neighbour: `Σ ψ_j = 1` stays, and with it the patch
//! test.

use std::collections::{BTreeMap, HashMap};

use super::row::Row;
use super::settings::Rims;
use crate::linalg::vector3::Vector3;

/// Nodes with less than this share of cover are at a rim. If they are folded, the patch test is as good with a
/// twentieth and a fifth; with a hundredth it loses a digit.
const LEAST_COVER: f64 = 0.1;

/// Shares of cover that differ by less are the same, far above the rounding of edges: a face that lacks less is
/// covered wholly, one that has more than all of it by more lies under two faces, and of two nodes the nearer is
/// chosen. With less than this a node does not keep a row even if it shall: six digits of its area would be rounding.
pub(super) const SAME_COVER: f64 = 1e-6;

/// The nodes with little cover, folded or dropped.
pub(super) struct Little {
    /// Each folded one with the node that has its row.
    pub(super) folded: Vec<(usize, usize)>,
    /// Those left out.
    pub(super) dropped: Vec<usize>,
}

/// Does with the rows of nodes with little cover what `rims` says. `faces` are the nodes of each covered face.
pub(super) fn settle<'a>(
    rims: Rims,
    rows: &mut BTreeMap<usize, Row>,
    faces: impl Iterator<Item = &'a [usize]>,
    place: impl Fn(usize) -> Vector3,
) -> Little {
    let least = match rims {
        Rims::Fold => LEAST_COVER,
        Rims::Keep => SAME_COVER,
        Rims::Drop => {
            let all: Vec<usize> = rows.keys().copied().collect();
            rows.retain(|_, row| row.cover() >= LEAST_COVER);
            let dropped = all.into_iter().filter(|node| !rows.contains_key(node)).collect();
            return Little { folded: Vec::new(), dropped };
        }
    };
    Little { folded: fold(rows, faces, place, least), dropped: Vec::new() }
}

/// Folds the rows of nodes with less than the least cover.
fn fold<'a>(
    rows: &mut BTreeMap<usize, Row>,
    faces: impl Iterator<Item = &'a [usize]>,
    place: impl Fn(usize) -> Vector3,
    least: f64,
) -> Vec<(usize, usize)> {
    let mut little: Vec<(usize, f64)> = rows
        .iter()
        .map(|(&node, row)| (node, row.cover()))
        .filter(|(_, cover)| !(*cover >= least))
        .collect();
    // The best covered first, so that what it folds into is known to its neighbours.
    little.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut beside: HashMap<usize, Vec<usize>> =
        little.iter().map(|(node, _)| (*node, Vec::new())).collect();
    for nodes in faces {
        for node in nodes {
            if let Some(list) = beside.get_mut(node) {
                list.extend(nodes.iter().filter(|&other| other != node));
            }
        }
    }
    let mut home: HashMap<usize, usize> = HashMap::new();
    for &(node, _) in &little {
        let target = |other: usize| match rows[&other].cover() >= least {
            true => Some(other),
            false => home.get(&other).copied(),
        };
        let rank = |target: usize| {
            let steps = (rows[&target].cover() / SAME_COVER).round();
            (steps, -(place(target) - place(node)).norm())
        };
        let best = beside[&node].iter().filter_map(|&other| target(other)).max_by(|&a, &b| {
            let (a, b) = (rank(a), rank(b));
            a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
        });
        // Without such a neighbour the whole contact is small, and this node holds it.
        home.insert(node, best.unwrap_or(node));
    }
    let mut folded: Vec<(usize, usize)> = home.into_iter().filter(|(a, b)| a != b).collect();
    folded.sort_unstable();
    for (node, target) in &folded {
        let row = rows.remove(node).expect("each node is folded once");
        rows.get_mut(target).expect("a target keeps its row").take_in(row);
    }
    folded
}
