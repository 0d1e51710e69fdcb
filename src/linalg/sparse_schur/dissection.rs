//! Nested dissection for dear factorisations: several separators are tried, each is made the smallest one nearby, and
//! the best is taken. Coarsening, first halves and their refinement are those of feral-metis; small pieces are ordered
//! by feral-scotch.
//!
//! Separators of a large graph make nearly all of the cost of its factor, and what refinement leaves in them is
//! a step here and there in what could be a plane: the largest flow finds that.

use std::panic::{UnwindSafe, catch_unwind};

use feral_metis::MetisOptions;
use feral_metis::internals::coarsen::{CoarseGraph, CoarsenCounters, coarsen};
use feral_metis::internals::fm_refine::{refine_bisection, refine_separator_fm};
use feral_metis::internals::graph::Graph;
use feral_metis::internals::initial_partition::{
    PART_A, PART_B, initial_bisect_bfs, initial_bisect_ggp,
};
use feral_metis::internals::rng::SplitMix;
use feral_metis::internals::separator::construct_separator;
use feral_scotch::{CscPattern, scotch_order};

use super::failure::Failure;
use super::sides::{Links, Side};
use super::vertex_cut::shrink;
use super::watch::{Watch, go_on};

/// Pieces of fewer vertices are left to feral-scotch: their share of the cost is small.
const SMALL: usize = 1500;

/// Separators that are tried for each piece.
const TRIALS: u64 = 2;

/// First halves that are tried for each of them, on the coarsest graph.
const HALVES: usize = 5;

/// A half may be so much heavier than half of the whole.
const IMBALANCE: f64 = 0.1;

/// Passes of each refinement.
const PASSES: u32 = 10;

/// A side of a separator may lose at most this share of all vertices to the band in which a smaller one is sought.
const BAND: usize = 12;

/// A connected part of the graph.
struct Piece {
    graph: Graph,
    /// Its vertices in the whole graph.
    vertex: Vec<i32>,
    /// Where they begin in the order.
    first: usize,
}

/// The order of the vertices of a graph, given with the begins of their neighbours; `None` if it fails in any way.
///
/// # Errors
/// `watch`, who is asked before each separator, ends it.
pub fn dissected(
    start: Vec<i32>,
    neighbour: Vec<i32>,
    watch: &mut dyn Watch,
) -> Result<Option<Vec<i32>>, Failure> {
    let count = start.len() - 1;
    let mut order = vec![-1; count];
    let vertex = (0..count as i32).collect();
    let whole = Piece { graph: graph(start, neighbour), vertex, first: 0 };
    let mut open = whole.divided(&vec![Side::First; count], &mut order);
    while let Some(piece) = open.pop() {
        go_on(watch)?;
        let sides = match piece.vertex.len() {
            SMALL.. => guarded(|| separated(&piece.graph)),
            _ => None,
        };
        match sides {
            Some(sides) => open.append(&mut piece.divided(&sides, &mut order)),
            None => match guarded(|| piece.ordered()) {
                Some(inner) => piece.write(&inner, &mut order),
                None => return Ok(None),
            },
        }
    }
    Ok(Some(order))
}

/// What `work` finds; `None` if it panics.
fn guarded<T>(work: impl FnOnce() -> Option<T> + UnwindSafe) -> Option<T> {
    catch_unwind(work).ok().flatten()
}

fn graph(xadj: Vec<i32>, adjncy: Vec<i32>) -> Graph {
    let (vwgt, adjwgt) = (vec![1; xadj.len() - 1], vec![1; adjncy.len()]);
    Graph { nvtxs: vwgt.len() as i32, xadj, adjncy, vwgt, adjwgt }
}

impl Piece {
    /// Puts the separator behind all others in the order, and returns the connected parts of these.
    fn divided(&self, side: &[Side], order: &mut [i32]) -> Vec<Piece> {
        let count = side.len();
        let mut last = self.first + count;
        for v in (0..count).rev().filter(|&v| side[v] == Side::Separator) {
            last -= 1;
            order[last] = self.vertex[v];
        }
        let mut place: Vec<Option<i32>> = vec![None; count];
        let (mut parts, mut first) = (Vec::new(), self.first);
        for v in 0..count {
            if side[v] != Side::Separator && place[v].is_none() {
                parts.push(self.part(v, side, &mut place, first));
                first += parts[parts.len() - 1].vertex.len();
            }
        }
        parts
    }

    /// The connected part of a vertex. `place` gets where its vertices stand in it.
    fn part(&self, from: usize, side: &[Side], place: &mut [Option<i32>], first: usize) -> Piece {
        let near = |v: usize| {
            let links = links(&self.graph);
            links.of(v).filter(|&w| side[w] != Side::Separator)
        };
        let (mut found, mut done) = (vec![from], 0);
        place[from] = Some(0);
        while let Some(&v) = found.get(done) {
            done += 1;
            for w in near(v) {
                if place[w].is_none() {
                    place[w] = Some(found.len() as i32);
                    found.push(w);
                }
            }
        }
        let (mut start, mut neighbour) = (vec![0], Vec::new());
        for &v in &found {
            neighbour.extend(near(v).filter_map(|w| place[w]));
            start.push(neighbour.len() as i32);
        }
        let vertex = found.iter().map(|&v| self.vertex[v]).collect();
        Piece { graph: graph(start, neighbour), vertex, first }
    }

    /// Its vertices in an order.
    fn ordered(&self) -> Option<Vec<i32>> {
        let mut row = self.graph.adjncy.clone();
        for ends in self.graph.xadj.windows(2) {
            row[ends[0] as usize..ends[1] as usize].sort_unstable();
        }
        let pattern = CscPattern::new(self.vertex.len(), &self.graph.xadj, &row)?;
        let order = scotch_order(&pattern).ok()?;
        order.iter().map(|&v| self.vertex.get(v as usize).copied()).collect()
    }

    fn write(&self, vertices: &[i32], order: &mut [i32]) {
        order[self.first..][..vertices.len()].copy_from_slice(vertices);
    }
}

fn links(graph: &Graph) -> Links<'_> {
    Links { start: &graph.xadj, neighbour: &graph.adjncy }
}

/// The best separator of those that are tried, if there is one.
fn separated(graph: &Graph) -> Option<Vec<Side>> {
    let count = graph.nvtxs as usize;
    let (mut best, mut least) = (None, f64::INFINITY);
    for trial in 0..TRIALS {
        let labels = halved(graph, &mut SplitMix::new(trial));
        let mut side: Vec<Side> = labels
            .iter()
            .map(|&label| match label {
                PART_A => Side::First,
                PART_B => Side::Second,
                _ => Side::Separator,
            })
            .collect();
        shrink(links(graph), &mut side, count / BAND);
        let of = |which: Side| side.iter().filter(|&&s| s == which).count() as f64;
        let (first, second) = (of(Side::First), of(Side::Second));
        let quality = (count as f64 - first - second) / (first * second);
        if quality < least {
            (best, least) = (Some(side), quality);
        }
    }
    best
}

/// A separator by coarsening: of the coarsest graph the best of several, refined in each finer one.
fn halved(graph: &Graph, random: &mut SplitMix) -> Vec<u8> {
    let levels = coarsen(graph, &MetisOptions::default(), random, &mut CoarsenCounters::default());
    let coarsest = levels.last().map_or(graph, |level| &level.graph);
    let half = coarsest.vwgt.iter().map(|&weight| i64::from(weight)).sum::<i64>() / 2;
    let (mut labels, mut least) = (Vec::new(), i64::MAX);
    for k in 0..HALVES {
        let mut found = match k % 2 {
            0 => initial_bisect_ggp(coarsest, random, half),
            _ => initial_bisect_bfs(coarsest, random, half),
        };
        refine_bisection(coarsest, &mut found, IMBALANCE, PASSES);
        construct_separator(coarsest, &mut found);
        let weight = refine_separator_fm(coarsest, &mut found, IMBALANCE, PASSES);
        if weight < least {
            (labels, least) = (found, weight);
        }
    }
    for (k, CoarseGraph { cmap, .. }) in levels.iter().enumerate().rev() {
        let finer = k.checked_sub(1).map_or(graph, |k| &levels[k].graph);
        labels = cmap.iter().map(|&coarse| labels[coarse as usize]).collect();
        refine_separator_fm(finer, &mut labels, IMBALANCE, PASSES);
    }
    labels
}

#[cfg(test)]
mod tests {
    use super::guarded;

    #[test]
    fn a_defect_of_another_crate_is_no_order() {
        assert_eq!(guarded(|| Some(3)), Some(3));
        assert_eq!(guarded(|| None::<usize>), None);
        assert_eq!(guarded(|| -> Option<usize> { panic!("a defect of another crate") }), None);
    }
}
