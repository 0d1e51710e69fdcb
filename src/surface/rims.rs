//! Rims: what becomes of the rows of nodes with little cover.
//!
//! The area `D_j` of a node falls with a high power of the covered strip, so that `F_j / D_j` is rounding,
//! and the row holds a node in the air by masters that are far away. Leaving the row out breaks the patch
//! test. So `D_j d_j` is shared out to rows of nodes of the same faces: `Σ ψ_j = 1` stays, and with it the patch
//! test. A node whose row has gone takes in none, so that no row goes further than one face; one with hardly any
//! cover may go two. So does `D_j d_j` of a node that supports hold, over masters some of which they hold, up to three faces to nodes
//! that move.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use super::digits::ON_PLANE;
use super::face::Face;
use super::mesh::Side;
use super::pairs::{Fold, Weight};
use super::row::{Moves, Row};
use super::settings::{Rims, SurfaceSettings};
use super::shape::MANY_FACES;
use super::symmetry::OnPlanes;
use crate::error::Error;
use crate::linalg::vector3::Vector3;

/// Nodes with less than this share of cover are at a rim. On 36 unstructured meshes the error of a linear pressure is
/// with a half that of meshes that are covered wholly, with three tenths twice and with a tenth three times as large.
const LEAST_COVER: f64 = 0.5;

/// Nodes with less than this are at a rim where more pairs count more than that error, and always corners of quadratic faces.
/// These have the area of two or three mid nodes. With such a share it is as large as that of a home, and where the contact ends
/// beside one, one home's pressure on both moves as much force as the end of the contact has.
const LEAST_OF_MANY: f64 = 0.3;

/// Where the nodes within [`NEAR`] that have so much could not hold a body, as under a punch of the size of a face, and
/// where no node beside a rim has it, the rim is of nodes with less than this: pressures are less exact then, but moments
/// are carried. Where even these could not, as under a punch that is smaller than a face, those with most cover keep their
/// rows until they can. What is further away does not count, so that a part has the rows of its whole.
const LITTLE_COVER: f64 = 0.1;

/// How many faces away nodes count that hold a body with a node. Rows at the boundary of a part depend on the cover of nodes
/// five faces further, so that images of so many layers of faces make it the whole.
const NEAR: usize = 3;

/// Shares of cover that differ by less are the same, far above the rounding of edges: a face that lacks less is
/// covered wholly, one that has more than all of it by more lies under two faces, and a node at the end of a master
/// that ends where its faces do has half of its cover. With less than this a node does not keep a row even if it
/// shall: six digits of its area would be rounding.
pub(super) const SAME_COVER: f64 = 1e-6;

/// A node with less than this share of cover may go two faces far, if no node beside it has a row to take it: what it
/// carries is too little to be seen.
const NEXT_BUT_ONE: f64 = 0.02;

/// A node shares in a row while the least squared distance of middles is more than this part of its own: up to 5 % further away.
/// The share falls to zero there, so that rows do not jump where one node becomes nearer than another.
const AS_NEAR: f64 = 0.9;

/// Folds the rows of nodes with little cover: each is shared out to those nodes of its own faces that keep theirs whose
/// middles are nearest: there the pressures are that the row shall have. One that finds none keeps its own, and takes in others. So are
/// the rows of nodes that supports hold, and most of the masters under them.
pub(super) fn fold(
    settings: &SurfaceSettings,
    rows: &mut BTreeMap<usize, Row>,
    (slave, uncovered, planes): (&Side<'_>, &[usize], &OnPlanes),
) -> Result<Vec<Fold>, Error> {
    let moving = Moving::new(rows, settings, slave)?;
    // Those that keep their rows, `true` if their cover says so, and those that are folded with the nodes around.
    let (kept, little) = by_cover((settings.rims, &moving), rows, (slave, uncovered))?;
    let mut homes: HashMap<usize, bool> = kept.into_iter().map(|node| (node, true)).collect();
    let layers = if moving.little.is_empty() { 2 } else { NEAR };
    let beside = beside((slave, &[]), little.iter().map(|(node, _)| *node), layers)?;
    let fits = |home, node| planes.stays(home, node) && moving.takes(home, node);
    let mut gone: BTreeMap<usize, BTreeSet<usize>> = BTreeMap::new();
    for (node, cover) in little {
        slave.progress.goes_on()?;
        let may = |by_cover: &bool| *by_cover || cover < LITTLE_COVER - SAME_COVER;
        let takes = |home: &usize| homes.get(home).is_some_and(may) && fits(*home, node);
        let most = match cover < NEXT_BUT_ONE {
            true if moving.little.contains(&node) => NEAR,
            little => 1 + usize::from(little),
        };
        let around = around(node, &beside, most, takes);
        if around.iter().any(takes) {
            gone.insert(node, around);
        } else {
            homes.insert(node, false);
        }
    }
    let shares = |(node, around): (usize, BTreeSet<usize>)| {
        let keeps = |home: &usize| homes.contains_key(home) && fits(*home, node);
        let squared = |home| (rows[&home].middle() - rows[&node].middle()).norm_squared();
        // Two rows may have one middle.
        let away = |home| (home, squared(home).max(f64::MIN_POSITIVE));
        let mut into: Vec<Weight> = around.into_iter().filter(keeps).map(away).collect();
        into.sort_by(|a, b| a.1.total_cmp(&b.1));
        // Where a rim goes through the point at which slivers meet each would have all masters under them.
        into.truncate(MANY_FACES);
        let least = into.first().expect("a folded node has a home").1;
        into.iter_mut().for_each(|(_, away)| *away = (least / *away - AS_NEAR).max(0.0));
        (node, into)
    };
    // Middles are those of rows that have taken in none.
    let gone: Vec<(usize, Vec<Weight>)> = gone.into_iter().map(shares).collect();
    let fold = |(node, into): (usize, Vec<Weight>)| {
        let row = rows.remove(&node).expect("each node is folded once");
        let sum: f64 = into.iter().map(|(_, worth)| worth).sum();
        for (home, worth) in into.iter().filter(|(_, worth)| *worth > 0.0) {
            let home = rows.get_mut(home).expect("a home keeps its row");
            home.take_in((&row, moving.of(node)), worth / sum);
        }
        slave.progress.goes_on()?;
        let distance = (slave.position(into[0].0) - slave.position(node)).norm();
        Ok(Fold { node, into: into[0].0, distance })
    };
    gone.into_iter().map(fold).collect()
}

/// What supports leave of rows.
struct Moving {
    /// Those of which they do not leave all.
    rows: HashMap<usize, Moves>,
    /// Nodes that are held, as are some of the masters of their rows, beside nodes that move: their rows would hold masters by the support
    /// beside these. Where all is held around, the slave is an obstacle, and such rows are right if enough of them moves.
    little: BTreeSet<usize>,
}

impl Moving {
    fn new(
        rows: &BTreeMap<usize, Row>,
        settings: &SurfaceSettings,
        slave: &Side<'_>,
    ) -> Result<Moving, Error> {
        let moves = rows.iter().map(|(node, row)| (*node, row.moves(*node, settings)));
        let held = moves.filter(|(_, moves)| *moves != Moves::Wholly).collect();
        let mut moving = Moving { rows: held, little: BTreeSet::new() };
        let some = moving.rows.keys().copied().filter(|node| !moving.rests(*node));
        let beside = beside((slave, &[]), some.clone(), NEAR)?;
        let is_most = |node: &usize| rows.contains_key(node) && moving.of(*node) >= LEAST_OF_MANY;
        let is_little = |&node: &usize| {
            let moves = |other: &usize| !settings.is_supported(*other, rows[&node].normal);
            let is_little = moving.of(node) < LEAST_OF_MANY || beside[&node].iter().any(moves);
            is_little && around(node, &beside, NEAR, is_most).iter().any(is_most)
        };
        moving.little = some.filter(is_little).collect();
        Ok(moving)
    }

    /// The part of a row that moves.
    fn of(&self, node: usize) -> f64 {
        match self.rows.get(&node) {
            None | Some(Moves::Wholly) => 1.0,
            Some(Moves::InPart(part)) => part.clamp(0.0, 1.0),
            Some(Moves::Nothing) => 0.0,
        }
    }

    fn rests(&self, node: usize) -> bool {
        self.rows.get(&node) == Some(&Moves::Nothing)
    }

    /// True if a home may take in the row of a node.
    fn takes(&self, home: usize, node: usize) -> bool {
        !self.little.contains(&node) || self.of(home) >= LEAST_OF_MANY
    }
}

/// The nodes with enough cover, and those with little, the most first. Rows of which little moves are as without cover.
fn by_cover(
    (rims, moving): (Rims, &Moving),
    rows: &BTreeMap<usize, Row>,
    on: (&Side<'_>, &[usize]),
) -> Result<(Vec<usize>, Vec<Weight>), Error> {
    let (mut enough, mut little) = (Vec::new(), Vec::new());
    let least = least_covers(rims, rows, on)?;
    for (&node, row) in rows {
        on.0.progress.goes_on()?;
        match least.get(&node).is_none_or(|least| row.cover() >= *least) {
            true if moving.little.contains(&node) => little.push((node, 0.0)),
            true => enough.push(node),
            false => little.push((node, row.cover())),
        }
    }
    little.sort_by(|a, b| b.1.total_cmp(&a.1));
    Ok((enough, little))
}

/// The share of cover with which each node would keep its row, of those that have less than [`LEAST_COVER`].
fn least_covers(
    rims: Rims,
    rows: &BTreeMap<usize, Row>,
    (slave, uncovered): (&Side<'_>, &[usize]),
) -> Result<HashMap<usize, f64>, Error> {
    let few = |row: &Row| row.cover() < LEAST_COVER - SAME_COVER;
    let at_rims: Vec<usize> =
        rows.iter().filter(|(_, row)| few(row)).map(|(node, _)| *node).collect();
    if rims == Rims::Keep {
        return Ok(at_rims.into_iter().map(|node| (node, SAME_COVER)).collect());
    }
    let beside = beside((slave, uncovered), at_rims.iter().copied(), NEAR)?;
    // From node to node go the best ones alone: where many faces meet in a node all are near each other.
    let mut best: HashMap<usize, Vec<Weight>> = HashMap::new();
    let covered = |at: usize| (at, rows[&at].cover());
    for _ in 0..NEAR {
        let mut next = HashMap::with_capacity(beside.len());
        for (&node, around) in &beside {
            slave.progress.goes_on()?;
            let known = |at: &usize| best.get(at).cloned().unwrap_or_else(|| vec![covered(*at)]);
            let near = around.iter().chain([&node]).flat_map(known).collect();
            next.insert(node, holders(near, (slave, rows[&node].normal.normalize())));
        }
        best = next;
    }
    let least_of = |node: usize| {
        let holders = &best[&node];
        let holds = holders.len() == slave.dim;
        // Those with as much keep theirs too.
        let last = holders.last().filter(|_| holds).map_or(0.0, |(_, cover)| *cover);
        let has = |least: f64| last >= least - SAME_COVER;
        let is_small = rims == Rims::Fold && !rows[&node].is_large;
        let least = match [LEAST_COVER, LITTLE_COVER].map(has) {
            [true, _] if is_small => LEAST_COVER,
            [true, _] => LEAST_OF_MANY,
            [_, true] => LITTLE_COVER,
            _ => last,
        };
        (node, (least - SAME_COVER).max(SAME_COVER))
    };
    Ok(at_rims.into_iter().map(least_of).collect())
}

/// Of some nodes with their covers those with most that hold a body, in the order of their covers: forces at their places along a normal balance
/// all moments of such forces. The best of more nodes are among the best of each part of them.
fn holders(mut nodes: Vec<Weight>, (slave, normal): (&Side<'_>, Vector3)) -> Vec<Weight> {
    nodes.sort_unstable_by_key(|(node, _)| *node);
    nodes.dedup_by_key(|(node, _)| *node);
    nodes.sort_by(|(_, a), (_, b)| b.total_cmp(a));
    let mut found: Vec<Weight> = Vec::with_capacity(slave.dim);
    for (node, cover) in nodes {
        let from_first = |at: usize| slave.position(at) - slave.position(found[0].0);
        let adds = match found[..] {
            [] => true,
            [_] => from_first(node) != Vector3::zeros(),
            // Of a curved surface as its normal sees it: a strip around a cylinder is a line.
            [_, (second, _), ..] => {
                let (a, b) = (from_first(second), from_first(node));
                let longest = a.norm_squared().max(b.norm_squared());
                normal.dot(&a.cross(&b)).abs() > ON_PLANE * longest
            }
        };
        if adds {
            found.push((node, cover));
        }
        if found.len() == slave.dim {
            break;
        }
    }
    found
}

/// The nodes within one face of a node, or within so many more that some are `wanted`, up to the `most`.
fn around(
    node: usize,
    beside: &HashMap<usize, BTreeSet<usize>>,
    most: usize,
    wanted: impl Fn(&usize) -> bool,
) -> BTreeSet<usize> {
    let mut found = beside[&node].clone();
    for _ in 1..most {
        if found.iter().any(&wanted) {
            break;
        }
        found = found.iter().flat_map(|other| &beside[other]).copied().collect();
    }
    found
}

/// The nodes beside some nodes, beside these, and so on, by all faces of a side but some: of each the other nodes of its faces.
pub(super) fn beside(
    (side, without): (&Side<'_>, &[usize]),
    nodes: impl Iterator<Item = usize>,
    layers: usize,
) -> Result<HashMap<usize, BTreeSet<usize>>, Error> {
    let mut found: HashMap<usize, BTreeSet<usize>> = HashMap::new();
    let mut next: BTreeSet<usize> = nodes.collect();
    for _ in 0..layers {
        if next.is_empty() {
            break;
        }
        let mut around: HashMap<usize, BTreeSet<usize>> =
            next.into_iter().map(|node| (node, BTreeSet::new())).collect();
        for face in side.each_face() {
            let (at, Face { nodes, .. }) = face?;
            if without.binary_search(&at).is_ok() {
                continue;
            }
            for node in nodes {
                if let Some(list) = around.get_mut(node) {
                    list.extend(nodes.iter().filter(|&other| other != node));
                }
            }
        }
        next = around.values().flatten().copied().collect();
        found.extend(around);
        next.retain(|node| !found.contains_key(node));
    }
    Ok(found)
}
