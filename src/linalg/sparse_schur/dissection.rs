//! Nested dissection for dear factorisations, with the parts of feral-metis.
//!
//! Small pieces of the graph are ordered at once. A large piece is parted by a separator: vertices that are tied to each
//! other are joined, level by level, the small graph is cut in halves, and its separator is refined on each level on the
//! way back. It is asked before each level whether to go on. Of two such cuts the better one is taken: the separators of a
//! large graph make nearly all of the cost of its factor.

use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};

use feral_metis::internals::coarsen::{CoarseGraph, CoarsenCounters, coarsen_level};
use feral_metis::internals::fm_refine::{PART_SEP, refine_bisection, refine_separator_fm};
use feral_metis::internals::graph::Graph;
use feral_metis::internals::initial_partition::{initial_bisect_bfs, initial_bisect_ggp};
use feral_metis::internals::rng::SplitMix;
use feral_metis::internals::separator::construct_separator;
use feral_metis::{CscPattern, metis_order};

use super::factor_progress::{FactorProgress, FactorStep, Failure, Stopped};

/// Pieces of fewer vertices are ordered at once: their share of the cost is small.
const SMALL: usize = 1000;

/// Seeds of the separators that are tried for each large piece.
const SEEDS: Range<u64> = 13..15;

/// A graph of at most so many vertices is parted, in so many ways, of which the best is taken.
const COARSEST: i32 = 100;
const TRIALS: usize = 5;

/// A level that keeps more than this part of the vertices is the last one.
const STALLED: f64 = 0.95;

/// Above this part, vertices with a common neighbour are joined too.
const MATCHED_BADLY: f64 = 0.85;

/// A half may be larger than the half of all by this part.
const IMBALANCE: f64 = 0.05;

/// Passes of a refinement, which ends before if a pass finds nothing better.
const PASSES: u32 = 32;

/// A connected part of the graph. Vertices ascend, and so do the neighbours of each.
struct Piece {
    graph: Graph,
    /// Its vertices in the whole graph.
    vertex: Vec<i32>,
}

/// A separator of a piece, and the connected parts of the others.
struct Cut {
    separator: Vec<i32>,
    parts: Vec<Piece>,
}

/// The order of the vertices of a graph, given with the begins of their neighbours, which ascend; `None` if it fails
/// in any way.
///
/// # Errors
/// `progress`, which is asked before each call, ends it.
pub fn dissected(
    start: Vec<i32>,
    neighbour: Vec<i32>,
    progress: &mut FactorProgress<'_>,
) -> Result<Option<Vec<i32>>, Failure> {
    let vertex: Vec<i32> = (0..).take(start.len() - 1).collect();
    let mut open = Piece::new(start, neighbour, vertex).cut(|_| false).parts;
    // From the last vertex of the order to the first: a separator stands behind its parts.
    let mut backwards = Vec::new();
    while let Some(piece) = open.pop() {
        progress(FactorStep::HasDone(0.0))?;
        if let Some(cut) = piece.best_cut(progress)? {
            backwards.extend(cut.separator.iter().rev());
            open.extend(cut.parts);
        } else if let Some(order) = piece.ordered() {
            backwards.extend(order.iter().rev());
        } else {
            return Ok(None);
        }
    }
    backwards.reverse();
    Ok(Some(backwards))
}

/// The result of `work`; `None` if it panics. What it has changed is not used then.
fn guarded<T>(work: impl FnOnce() -> T) -> Option<T> {
    catch_unwind(AssertUnwindSafe(work)).ok()
}

impl Piece {
    fn new(start: Vec<i32>, neighbour: Vec<i32>, vertex: Vec<i32>) -> Self {
        let (vwgt, adjwgt) = (vec![1; vertex.len()], vec![1; neighbour.len()]);
        let nvtxs = vertex.len() as i32;
        Piece { graph: Graph { nvtxs, xadj: start, adjncy: neighbour, vwgt, adjwgt }, vertex }
    }

    /// Its vertices in an order that serves a small piece.
    fn ordered(&self) -> Option<Vec<i32>> {
        let graph = &self.graph;
        let pattern = CscPattern::new(self.vertex.len(), &graph.xadj, &graph.adjncy)?;
        let order = guarded(|| metis_order(&pattern))?.ok()?;
        order.iter().map(|&v| self.vertex.get(v as usize).copied()).collect()
    }

    /// The best cut of those that are tried; `None` for a small piece, or if none parts it.
    fn best_cut(&self, progress: &mut FactorProgress<'_>) -> Result<Option<Cut>, Stopped> {
        let mut cuts = Vec::new();
        if self.vertex.len() >= SMALL {
            for seed in SEEDS {
                let sides = sides(&self.graph, seed, progress)?;
                cuts.extend(sides.map(|sides| self.cut(|v| sides[v] == PART_SEP)));
            }
        }
        let cuts = cuts.into_iter().filter(|cut| cut.parts.len() > 1);
        Ok(cuts.min_by(|a, b| a.badness().total_cmp(&b.badness())))
    }

    /// Takes a separator out, and finds the connected parts of the others.
    fn cut(&self, is_in_separator: impl Fn(usize) -> bool) -> Cut {
        let all = 0..self.vertex.len();
        let mut is_open: Vec<bool> = all.clone().map(|v| !is_in_separator(v)).collect();
        let (mut place, mut parts) = (vec![None; self.vertex.len()], Vec::new());
        for from in all.clone() {
            if !std::mem::take(&mut is_open[from]) {
                continue;
            }
            let (mut found, mut done) = (vec![from], 0);
            while let Some(&v) = found.get(done) {
                done += 1;
                let new = self.neighbours(v).filter(|&w| std::mem::take(&mut is_open[w]));
                found.extend(new);
            }
            found.sort_unstable();
            (0_i32..).zip(&found).for_each(|(k, &v)| place[v] = Some(k));
            let (mut start, mut neighbour) = (vec![0], Vec::new());
            for &v in &found {
                neighbour.extend(self.neighbours(v).filter_map(|w| place[w]));
                start.push(neighbour.len() as i32);
            }
            // The neighbours of a part are its own and those of the separator.
            found.iter().for_each(|&v| place[v] = None);
            let vertex = found.iter().map(|&v| self.vertex[v]).collect();
            parts.push(Piece::new(start, neighbour, vertex));
        }
        let separator = all.filter(|&v| is_in_separator(v)).map(|v| self.vertex[v]).collect();
        Cut { separator, parts }
    }

    fn neighbours(&self, v: usize) -> impl Iterator<Item = usize> {
        self.graph.neighbors(v as i32).iter().map(|&w| w as usize)
    }
}

/// The part of each vertex, one of two or the separator; `None` if it fails.
fn sides(
    graph: &Graph,
    seed: u64,
    progress: &mut FactorProgress<'_>,
) -> Result<Option<Vec<u8>>, Stopped> {
    let random = &mut SplitMix::new(seed);
    let mut levels: Vec<CoarseGraph> = Vec::new();
    let mut sides = loop {
        progress(FactorStep::HasDone(0.0))?;
        let finer = levels.last().map_or(graph, |level| &level.graph);
        let counters = &mut CoarsenCounters::default();
        let next = || coarsen_level(finer, random, MATCHED_BADLY, counters);
        if finer.nvtxs > COARSEST {
            let Some(level) = guarded(next) else { return Ok(None) };
            if f64::from(level.graph.nvtxs) <= STALLED * f64::from(finer.nvtxs) {
                levels.push(level);
                continue;
            }
        }
        let Some(sides) = guarded(|| parted(finer, random)) else { return Ok(None) };
        break sides;
    };
    while let Some(level) = levels.pop() {
        progress(FactorStep::HasDone(0.0))?;
        let finer = levels.last().map_or(graph, |level| &level.graph);
        sides = level.cmap.iter().map(|&v| sides[v as usize]).collect();
        let refined = || refine_separator_fm(finer, &mut sides, IMBALANCE, PASSES);
        if guarded(refined).is_none() {
            return Ok(None);
        }
    }
    Ok(Some(sides))
}

/// The parts of a small graph, the best of several trials.
fn parted(graph: &Graph, random: &mut SplitMix) -> Vec<u8> {
    let half = graph.vwgt.iter().map(|&weight| i64::from(weight)).sum::<i64>() / 2;
    let trials = (0..TRIALS).map(|trial| {
        let grown = if trial % 2 == 0 { initial_bisect_ggp } else { initial_bisect_bfs };
        let mut sides = grown(graph, random, half);
        refine_bisection(graph, &mut sides, IMBALANCE, PASSES);
        construct_separator(graph, &mut sides);
        refine_separator_fm(graph, &mut sides, IMBALANCE, PASSES);
        let mut weights = [0.0; 3];
        sides.iter().zip(&graph.vwgt).for_each(|(&s, &w)| weights[usize::from(s)] += f64::from(w));
        let [one, other, separator] = weights;
        (badness(separator, one, other), sides)
    });
    trials.min_by(|(a, _), (b, _)| a.total_cmp(b)).map(|(_, sides)| sides).unwrap_or_default()
}

/// Small for a small separator between halves of one size.
fn badness(separator: f64, one: f64, other: f64) -> f64 {
    separator / (one * other)
}

impl Cut {
    fn badness(&self) -> f64 {
        let sizes = self.parts.iter().map(|part| part.vertex.len());
        let (largest, all) = (sizes.clone().max().unwrap_or(0), sizes.sum::<usize>());
        badness(self.separator.len() as f64, largest as f64, (all - largest) as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::{Piece, SMALL, dissected, guarded};

    /// A strip of `length` x `width` nodes, each beside the eight around it.
    fn strip(length: usize, width: usize) -> Piece {
        let (mut start, mut neighbour) = (vec![0], Vec::new());
        for v in 0..length * width {
            let near = |w: &usize| {
                (w / width).abs_diff(v / width) <= 1 && (w % width).abs_diff(v % width) <= 1
            };
            let around = v.saturating_sub(2 * width)..(v + 2 * width).min(length * width);
            neighbour.extend(around.filter(near).filter(|&w| w != v).map(|w| w as i32));
            start.push(neighbour.len() as i32);
        }
        Piece::new(start, neighbour, (0..).take(length * width).collect())
    }

    /// Seven paths along the strip share no vertex, so that a separator has at least seven (Menger); a column of the
    /// strip has as many. Both parts have at least a third of the vertices: the call keeps halves within a twentieth.
    #[test]
    fn a_strip_is_cut_across() {
        let strip = strip(500, 7);
        let cut = strip.best_cut(&mut |_| Ok(())).unwrap().expect("a strip has separators");
        assert!((7..=14).contains(&cut.separator.len()), "{:?}", cut.separator);
        assert_eq!(cut.parts.len(), 2);
        for part in &cut.parts {
            assert!(3 * part.vertex.len() >= strip.vertex.len(), "{}", part.vertex.len());
        }
        // No edge leads from one part to the other: all that a part lacks are edges to the separator.
        let kept: usize = cut.parts.iter().map(|part| part.graph.adjncy.len()).sum();
        let is_cut = |v: usize| cut.separator.contains(&(v as i32));
        let inside = (0..strip.vertex.len()).filter(|&v| !is_cut(v));
        let expected: usize =
            inside.map(|v| strip.neighbours(v).filter(|&w| !is_cut(w)).count()).sum();
        assert_eq!(kept, expected);
    }

    #[test]
    fn a_graph_of_several_parts_is_ordered_whole() {
        let one = strip(SMALL / 7 + 1, 7);
        let shift = one.vertex.len() as i32;
        let one = one.graph;
        let (mut start, mut neighbour) = (one.xadj.clone(), one.adjncy.clone());
        start.extend(one.xadj[1..].iter().map(|k| k + one.adjncy.len() as i32));
        neighbour.extend(one.adjncy.iter().map(|v| v + shift));
        // And two vertices without neighbours.
        start.extend([neighbour.len() as i32; 2]);
        let mut order = dissected(start, neighbour, &mut |_| Ok(())).unwrap().unwrap();
        order.sort_unstable();
        assert!(order.into_iter().eq(0..2 * shift + 2));
    }

    #[test]
    fn a_defect_of_another_crate_is_no_order() {
        assert_eq!(guarded(|| 3), Some(3));
        assert_eq!(guarded(|| -> usize { panic!("a defect of another crate") }), None);
    }
}
