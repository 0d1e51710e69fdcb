//! A separator by way of smaller graphs, between which it is asked if the work goes on.
//!
//! Vertices that are tied the most become one, two by two, until the graph is small. There halves grow from some vertices,
//! and the best of the separators beside them are carried back from graph to graph. In each they are refined: a vertex of the
//! separator goes to one side, and those of its neighbours that are on the other side come into the separator (C. M.
//! Fiduccia and R. M. Mattheyses 1982; B. Hendrickson and E. Rothberg, SIAM J. Sci. Comput. 20 (1998) 468-489).

use std::borrow::Cow;
use std::cmp::Reverse;
use std::collections::{BinaryHeap, VecDeque};

use super::factor_progress::{FactorProgress, Failure};
use super::lists::Lists;

/// Halves that grow in the smallest graph, and how many of their separators are carried back.
const STARTS: usize = 16;
const CARRIED: usize = 3;

/// The best separator of `links` that is found by way of a graph of fewer than `small` vertices, if it can be made so
/// small. `None` if there is none.
///
/// # Errors
/// `progress` ends it.
pub fn separator(
    links: &Lists,
    small: usize,
    progress: &mut FactorProgress<'_>,
) -> Result<Option<Vec<usize>>, Failure> {
    let mut graph = Level::finest(links, small, progress)?;
    let mut finer: Vec<(Level<'_>, Vec<usize>)> = Vec::new();
    while graph.links.count() >= small {
        progress(0.0)?;
        let (coarse, one) = graph.coarse();
        // A graph in which few vertices find another one becomes no smaller.
        let least = graph.links.count() / 10;
        if coarse.links.count() + least > graph.links.count() {
            break;
        }
        finer.push((std::mem::replace(&mut graph, coarse), one));
    }
    let mut grown = Vec::new();
    for start in 0..STARTS {
        let from = start * graph.links.count() / STARTS;
        grown.push(Sides::refined(&graph, graph.halves(from), progress)?);
    }
    grown.sort_by(|one, other| one.badness().total_cmp(&other.badness()));
    grown.dedup_by(|one, other| one.side == other.side);
    let mut best: Option<(f64, Vec<usize>)> = None;
    for mut sides in grown.into_iter().take(CARRIED) {
        for (graph, one) in finer.iter().rev() {
            progress(0.0)?;
            let side = one.iter().map(|&v| sides.side[v]).collect();
            sides = Sides::refined(graph, side, progress)?;
        }
        let badness = sides.badness();
        if badness.is_finite() && best.as_ref().is_none_or(|(least, _)| badness < *least) {
            best = Some((badness, sides.side));
        }
    }
    let between = |side: Vec<usize>| (0..side.len()).filter(|&v| side[v] == BETWEEN).collect();
    Ok(best.map(|(_, side)| between(side)))
}

/// The mark of a vertex of the separator; others have that of their side, 0 or 1.
const BETWEEN: usize = 2;

/// A graph whose vertices stand for several of the first one.
struct Level<'l> {
    links: Cow<'l, Lists>,
    /// The weight of the tie to each neighbour: the sum over the edges of the first graph.
    strength: Vec<i32>,
    /// Vertices of the first graph.
    weight: Vec<i64>,
}

impl<'l> Level<'l> {
    /// The first graph. Instead of one edge, an edge counts as the ways from end to end over at most one other vertex: what
    /// becomes one has its neighbours in common, and a mesh stays one.
    fn finest(
        links: &'l Lists,
        small: usize,
        progress: &mut FactorProgress<'_>,
    ) -> Result<Self, Failure> {
        let mut strength = vec![1; links.entries.len()];
        let mut next = links.start.clone();
        // The last vertex whose neighbour this one is.
        let mut beside = vec![usize::MAX; links.count()];
        for v in 0..links.count() {
            if v.is_multiple_of(small) {
                progress(0.0)?;
            }
            links.of(v).for_each(|w| beside[w] = v);
            for (k, w) in links.range(v).zip(links.of(v)).filter(|&(_, w)| w > v) {
                strength[k] += links.of(w).filter(|&x| beside[x] == v).count() as i32;
                // Vertices ascend, so that each is the next neighbour of those above it.
                strength[next[w]] = strength[k];
                next[w] += 1;
            }
        }
        let weight = vec![1; links.count()];
        Ok(Level { links: Cow::Borrowed(links), strength, weight })
    }

    fn edges(&self, v: usize) -> impl Iterator<Item = (usize, i32)> {
        self.links.of(v).zip(self.strength[self.links.range(v)].iter().copied())
    }

    /// The graph of twos, and the vertex that each one became.
    fn coarse(&self) -> (Level<'static>, Vec<usize>) {
        let size = self.links.count();
        let (mut one, mut twos) = (vec![usize::MAX; size], Vec::new());
        for v in 0..size {
            if one[v] < usize::MAX {
                continue;
            }
            let tie = |&(w, strength): &(usize, i32)| f64::from(strength) / self.weight[w] as f64;
            let free = self.edges(v).filter(|&(w, _)| one[w] == usize::MAX);
            // The first one of those that are tied the most.
            let mate = free.reduce(|a, b| if tie(&b) > tie(&a) { b } else { a });
            let two = [Some(v), mate.map(|(w, _)| w)];
            two.iter().flatten().for_each(|&v| one[v] = twos.len());
            twos.push(two);
        }
        let mut place = vec![usize::MAX; twos.len()];
        let (mut start, mut edges, mut weight) = (vec![0], Vec::new(), Vec::new());
        for (k, two) in twos.iter().enumerate() {
            let begin = edges.len();
            for (w, strength) in two.iter().flatten().flat_map(|&v| self.edges(v)) {
                let w = one[w];
                if w != k && (place[w] < begin || place[w] >= edges.len()) {
                    place[w] = edges.len();
                    edges.push((w, strength));
                } else if w != k {
                    edges[place[w]].1 += strength;
                }
            }
            edges[begin..].sort_unstable();
            start.push(edges.len());
            weight.push(two.iter().flatten().map(|&v| self.weight[v]).sum());
        }
        let (entries, strength) = edges.into_iter().unzip();
        (Level { links: Cow::Owned(Lists { start, entries }), strength, weight }, one)
    }

    /// The marks of a half that grows from a vertex, neighbours first, of a separator beside it, and of the others.
    fn halves(&self, from: usize) -> Vec<usize> {
        let half = self.weight.iter().sum::<i64>() / 2;
        let mut side = vec![1; self.links.count()];
        let (mut beside, mut size) = (VecDeque::from([from]), 0);
        side[from] = BETWEEN;
        while size < half
            && let Some(v) = beside.pop_front()
        {
            side[v] = 0;
            size += self.weight[v];
            for w in self.links.of(v) {
                if side[w] == 1 {
                    side[w] = BETWEEN;
                    beside.push_back(w);
                }
            }
        }
        side
    }
}

/// Two sides of a graph with the separator between them.
struct Sides<'g> {
    graph: &'g Level<'g>,
    /// The mark of each vertex.
    side: Vec<usize>,
    /// The weight of each side and of the separator.
    size: [i64; 3],
    /// The weight of the neighbours on each side, of a vertex of the separator.
    beside: Vec<[i64; 2]>,
    /// Vertices that have left the separator.
    has_left: Vec<bool>,
    /// Vertices of the separator by their gain, what it loses if they go to one side and to the other.
    queues: [BinaryHeap<(i64, Reverse<usize>)>; 2],
    /// Changes in their order: the vertex, and its mark before.
    changes: Vec<(usize, usize)>,
}

impl<'g> Sides<'g> {
    /// The sides of these marks, refined as long as that makes the separator better.
    fn refined(
        graph: &'g Level<'g>,
        side: Vec<usize>,
        progress: &mut FactorProgress<'_>,
    ) -> Result<Self, Failure> {
        let mut sides = Sides::new(graph, side);
        while sides.improve() {
            progress(0.0)?;
        }
        Ok(sides)
    }

    fn new(graph: &'g Level<'g>, side: Vec<usize>) -> Self {
        let mut size = [0; 3];
        side.iter().zip(&graph.weight).for_each(|(&side, weight)| size[side] += weight);
        let (beside, has_left) = (vec![[0; 2]; side.len()], vec![false; side.len()]);
        let (queues, changes) = (Default::default(), Vec::new());
        Sides { graph, side, size, beside, has_left, queues, changes }
    }

    /// Small for a small separator between halves of one size.
    fn badness(&self) -> f64 {
        self.size[BETWEEN] as f64 / (self.size[0] as f64 * self.size[1] as f64)
    }

    /// Moves each vertex at most once out of the separator, the one of the largest gain first, until as many moves as the
    /// separator has vertices make nothing better. Goes back to the best that was met: `true` if that is better than before.
    fn improve(&mut self) -> bool {
        self.has_left.fill(false);
        self.changes.clear();
        self.queues = Default::default();
        let between: Vec<usize> =
            (0..self.side.len()).filter(|&v| self.side[v] == BETWEEN).collect();
        between.iter().for_each(|&v| self.enter(v));
        let (mut least, mut best) = (self.badness(), 0);
        let mut patience = between.len();
        while patience > 0
            && let Some((v, to)) = self.next()
        {
            self.leave(v, to);
            patience -= 1;
            if self.badness() < least {
                (least, best, patience) = (self.badness(), self.changes.len(), between.len());
            }
        }
        while self.changes.len() > best
            && let Some((v, before)) = self.changes.pop()
        {
            self.mark(v, before);
        }
        best > 0
    }

    fn mark(&mut self, v: usize, to: usize) {
        self.size[self.side[v]] -= self.graph.weight[v];
        self.size[to] += self.graph.weight[v];
        self.side[v] = to;
    }

    fn gain(&self, v: usize, to: usize) -> i64 {
        self.graph.weight[v] - self.beside[v][1 - to]
    }

    fn queue(&mut self, v: usize, to: usize) {
        if !self.has_left[v] {
            self.queues[to].push((self.gain(v, to), Reverse(v)));
        }
    }

    /// The vertex of the largest gain, and where it goes; a side has at most three fifths of all.
    fn next(&mut self) -> Option<(usize, usize)> {
        let most = self.size.iter().sum::<i64>() * 3 / 5;
        let mut found: Option<((i64, Reverse<i64>), usize, usize)> = None;
        for to in [0, 1] {
            while let Some(&(gain, Reverse(v))) = self.queues[to].peek() {
                let holds = self.side[v] == BETWEEN && !self.has_left[v];
                if !holds || gain != self.gain(v, to) {
                    self.queues[to].pop();
                    continue;
                }
                let fits = self.size[to] + self.graph.weight[v] <= most;
                let rank = (gain, Reverse(self.size[to]));
                if fits && found.is_none_or(|(other, ..)| other < rank) {
                    found = Some((rank, v, to));
                }
                break;
            }
        }
        found.map(|(_, v, to)| (v, to))
    }

    /// A vertex leaves the separator for one side; its neighbours on the other side come in.
    fn leave(&mut self, v: usize, to: usize) {
        let graph = self.graph;
        self.changes.push((v, BETWEEN));
        self.mark(v, to);
        self.has_left[v] = true;
        for w in graph.links.of(v) {
            if self.side[w] == BETWEEN {
                self.beside[w][to] += graph.weight[v];
                self.queue(w, 1 - to);
            }
        }
        for w in graph.links.of(v) {
            if self.side[w] == 1 - to {
                self.changes.push((w, 1 - to));
                self.mark(w, BETWEEN);
                self.enter(w);
                for x in graph.links.of(w).filter(|&x| x != w) {
                    if self.side[x] == BETWEEN {
                        self.beside[x][1 - to] -= graph.weight[w];
                        self.queue(x, to);
                    }
                }
            }
        }
    }

    /// A vertex is in the separator.
    fn enter(&mut self, v: usize) {
        let mut beside = [0; 3];
        for w in self.graph.links.of(v) {
            beside[self.side[w]] += self.graph.weight[w];
        }
        self.beside[v] = [beside[0], beside[1]];
        [0, 1].into_iter().for_each(|to| self.queue(v, to));
    }
}

#[cfg(test)]
pub mod tests;
