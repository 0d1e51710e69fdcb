//! The smallest separator of a graph near a given one, by a largest flow.
//!
//! Each vertex of a band around the separator carries one unit of flow from the one side to the other at most: by
//! Menger's theorem as many paths that share no vertex cross the band as a smallest separator in it has vertices.
//! Dinic's method: shortest paths, all those of one length together.

use super::sides::{Links, Side, band};

/// Of a vertex on no path, or a place that is not reached.
const NONE: usize = usize::MAX;

/// The flow comes from the side of the source.
const SOURCE: usize = usize::MAX - 1;

/// Makes the separator the smallest one nearby, in a band that has at most `most` vertices of each side, and of equal
/// ones one that leaves sides of about the same size.
pub fn shrink(links: Links<'_>, side: &mut [Side], most: usize) {
    let is_band = band(links, side, most);
    shrink_in(links, side, is_band);
}

/// The same in a band.
fn shrink_in(links: Links<'_>, side: &mut [Side], is_band: Vec<bool>) {
    let outside = |which: Side| {
        side.iter().zip(&is_band).filter(|&(&s, &is_band)| s == which && !is_band).count()
    };
    let (first, second) = (outside(Side::First), outside(Side::Second));
    let Some(mut flow) = Flow::new(links, side, is_band) else { return };
    while flow.levels() {
        flow.augment();
    }
    flow.balance(first, second);
    // Levels are now those of all places on the side of the source.
    for &v in &flow.band {
        side[v] = match (flow.level[2 * v] != NONE, flow.level[2 * v + 1] != NONE) {
            (_, true) => Side::First,
            (true, false) => Side::Separator,
            (false, false) => Side::Second,
        };
    }
}

/// A flow through the band. Each vertex `v` is entered in place `2 v` and left from place `2 v + 1`.
struct Flow<'a> {
    links: Links<'a>,
    /// The vertices of the band, and whether each one has neighbours beyond it, on the side of the source and of the
    /// sink.
    band: Vec<usize>,
    inlet: Vec<bool>,
    outlet: Vec<bool>,
    is_band: Vec<bool>,
    /// From which vertex the unit of flow comes that each one carries.
    before: Vec<usize>,
    /// Steps from the source.
    level: Vec<usize>,
    /// The neighbour that is tried next.
    next: Vec<usize>,
}

impl<'a> Flow<'a> {
    /// None where a side has no vertex outside the band.
    fn new(links: Links<'a>, side: &[Side], is_band: Vec<bool>) -> Option<Self> {
        let size = side.len();
        let band: Vec<usize> = (0..size).filter(|&v| is_band[v]).collect();
        let beyond = |which: Side| {
            let mut touches = vec![false; size];
            for &v in &band {
                touches[v] = links.of(v).any(|w| side[w] == which && !is_band[w]);
            }
            touches
        };
        let (inlet, outlet) = (beyond(Side::First), beyond(Side::Second));
        let serves = |door: &[bool]| door.iter().any(|&is_door| is_door);
        (serves(&inlet) && serves(&outlet)).then(|| Flow {
            links,
            band,
            inlet,
            outlet,
            is_band,
            before: vec![NONE; size],
            level: vec![NONE; 2 * size],
            next: vec![0; 2 * size],
        })
    }

    /// Numbers the places that the source reaches. Returns whether the sink is among them.
    fn levels(&mut self) -> bool {
        for &v in &self.band {
            (self.level[2 * v], self.level[2 * v + 1]) = (NONE, NONE);
            (self.next[2 * v], self.next[2 * v + 1]) = (0, 0);
        }
        let inlets = self.band.iter().filter(|&&v| self.inlet[v]);
        let mut queue: Vec<usize> = inlets.map(|&v| 2 * v).collect();
        queue.iter().for_each(|&place| self.level[place] = 0);
        let (mut done, mut arrives) = (0, false);
        while let Some(&place) = queue.get(done) {
            done += 1;
            arrives |= place % 2 == 1 && self.outlet[place / 2];
            for k in 0..self.ways(place) {
                if let Some(to) = self.way(place, k)
                    && self.level[to] == NONE
                {
                    self.level[to] = self.level[place] + 1;
                    queue.push(to);
                }
            }
        }
        arrives
    }

    /// Moves the separator away from the source, as long as it is a smallest one, until the sides are of one size.
    /// Outside the band stand `first` and `second` vertices.
    fn balance(&mut self, first: usize, second: usize) {
        let leads_out = self.leading_out();
        let is_passed = |v: &usize| self.level[2 * v + 1] != NONE;
        let is_cut = |v: &usize| self.level[2 * v] != NONE && !is_passed(v);
        let passed = self.band.iter().filter(|v| is_passed(v)).count();
        let mut queue: Vec<usize> = self.band.iter().copied().filter(is_cut).collect();
        let (width, mut nearer) = (queue.len(), first + passed);
        let all = first + second + self.band.len() - width;
        let mut done = 0;
        while let Some(&v) = queue.get(done) {
            done += 1;
            if 2 * nearer >= all {
                return;
            }
            if self.level[2 * v + 1] != NONE || leads_out[2 * v + 1] {
                continue;
            }
            self.level[2 * v + 1] = 0;
            nearer += 1;
            let mut open = vec![2 * v + 1];
            while let Some(place) = open.pop() {
                for k in 0..self.ways(place) {
                    if let Some(to) = self.way(place, k)
                        && self.level[to] == NONE
                    {
                        self.level[to] = 0;
                        nearer += to % 2;
                        open.push(to);
                        queue.push(to / 2);
                    }
                }
            }
        }
    }

    /// Whether the sink can be reached from each place.
    fn leading_out(&self) -> Vec<bool> {
        let mut after = vec![NONE; self.before.len()];
        for &v in &self.band {
            if self.before[v] < SOURCE {
                after[self.before[v]] = v;
            }
        }
        let mut leads = vec![false; self.level.len()];
        let mut open: Vec<usize> =
            self.band.iter().filter(|&&v| self.outlet[v]).map(|&v| 2 * v + 1).collect();
        open.iter().for_each(|&place| leads[place] = true);
        while let Some(place) = open.pop() {
            let v = place / 2;
            let is_idle = self.before[v] == NONE;
            let mut from: Vec<usize> = Vec::new();
            if place % 2 == 1 {
                from.extend(is_idle.then_some(2 * v));
                from.extend((after[v] != NONE).then(|| 2 * after[v]));
            } else {
                from.extend((!is_idle).then_some(2 * v + 1));
                from.extend(self.links.of(v).filter(|&w| self.is_band[w]).map(|w| 2 * w + 1));
            }
            for place in from {
                if !leads[place] {
                    leads[place] = true;
                    open.push(place);
                }
            }
        }
        leads
    }

    /// How many ways lead from a place, at most.
    fn ways(&self, place: usize) -> usize {
        if place.is_multiple_of(2) { 1 } else { 1 + self.links.range(place / 2).len() }
    }

    /// Where one of them leads, if it is open. Whoever enters a vertex that carries flow takes the place of that flow,
    /// which looks for another way from where it came.
    fn way(&self, place: usize, k: usize) -> Option<usize> {
        let v = place / 2;
        if place.is_multiple_of(2) {
            return match self.before[v] {
                NONE => Some(place + 1),
                SOURCE => None,
                before => Some(2 * before + 1),
            };
        }
        let Some(k) = k.checked_sub(1) else {
            return (self.before[v] != NONE).then_some(place - 1);
        };
        let to = self.links.neighbour[self.links.range(v).start + k] as usize;
        self.is_band[to].then_some(2 * to)
    }

    /// Sends flow along shortest paths until none is left.
    fn augment(&mut self) {
        for k in 0..self.band.len() {
            let v = self.band[k];
            if self.inlet[v] && self.before[v] != SOURCE {
                self.send(2 * v);
            }
        }
    }

    /// Sends one unit from an inlet, if a path is left.
    fn send(&mut self, from: usize) {
        let mut path = vec![from];
        while let Some(&place) = path.last() {
            if place % 2 == 1 && self.outlet[place / 2] {
                return self.carry(&path);
            }
            let found = (self.next[place]..self.ways(place)).find_map(|k| {
                let to = self.way(place, k)?;
                (self.level[to] == self.level[place] + 1).then_some((k, to))
            });
            match found {
                Some((k, to)) => {
                    self.next[place] = k;
                    path.push(to);
                }
                None => {
                    self.next[place] = usize::MAX;
                    path.pop();
                    if let Some(&place) = path.last() {
                        self.next[place] += 1;
                    }
                }
            }
        }
    }

    /// Puts a path into the flow.
    fn carry(&mut self, path: &[usize]) {
        self.before[path[0] / 2] = SOURCE;
        for step in path.windows(2) {
            let (from, to) = (step[0], step[1]);
            match (from % 2, to % 2) {
                (1, 0) if from / 2 == to / 2 => self.before[to / 2] = NONE,
                (1, 0) => self.before[to / 2] = from / 2,
                _ => {}
            }
        }
        // A place of a shortest path is passed once.
        path.iter().for_each(|&place| self.next[place] = usize::MAX);
    }
}

#[cfg(test)]
mod tests {
    use super::{shrink, shrink_in};
    use crate::linalg::sparse_schur::sides::{Links, Side};

    /// Neighbours of each vertex, one after the other.
    type Lists = (Vec<i32>, Vec<i32>);

    fn lists(count: usize, near: impl Fn(usize, usize) -> bool) -> Lists {
        let (mut start, mut neighbour) = (vec![0], Vec::new());
        for v in 0..count {
            neighbour.extend((0..count).filter(|&w| v != w && near(v, w)).map(|w| w as i32));
            start.push(neighbour.len() as i32);
        }
        (start, neighbour)
    }

    fn separates((start, neighbour): &Lists, side: &[Side]) -> bool {
        let links = Links { start, neighbour };
        (0..side.len()).all(|v| {
            let apart = |w: usize| side[v] == side[w] || side[w] == Side::Separator;
            side[v] == Side::Separator || links.of(v).all(apart)
        })
    }

    fn size(side: &[Side]) -> usize {
        side.iter().filter(|&&s| s == Side::Separator).count()
    }

    /// A strip of 30 x 7 nodes, each beside the eight around it: 7 paths along it share no node, and each of its
    /// columns separates it.
    #[test]
    fn a_step_in_a_strip_becomes_a_line() {
        let place = |v: usize| (v / 7, v % 7);
        let near = |v: usize, w: usize| {
            let ((a, b), (c, d)) = (place(v), place(w));
            a.abs_diff(c) <= 1 && b.abs_diff(d) <= 1
        };
        let strip = lists(210, near);
        let mut side: Vec<Side> = (0..210)
            .map(|v| match place(v) {
                (x, y) if x < 12 || x == 12 && y > 3 => Side::First,
                (12..=16, 0..=2) | (12, 3) => Side::Separator,
                (13..=16, 3) | (16, _) => Side::Separator,
                (13..=15, _) => Side::First,
                _ => Side::Second,
            })
            .collect();
        assert!(separates(&strip, &side) && size(&side) > 7);
        shrink(Links { start: &strip.0, neighbour: &strip.1 }, &mut side, 60);
        assert!(separates(&strip, &side));
        assert_eq!(size(&side), 7);
    }

    /// Random graphs of 14 vertices, 0 and 1 at the ends: all sets of the others are tried.
    #[test]
    fn separators_are_the_smallest_that_enumeration_finds() {
        let mut random = fastrand::Rng::with_seed(5);
        for _ in 0..200 {
            let count = 14;
            let edges: Vec<bool> = (0..count * count).map(|_| random.f64() < 0.3).collect();
            let near = |v: usize, w: usize| edges[v.min(w) * count + v.max(w)] && v + w != 1;
            let graph = lists(count, near);
            let of_set = |set: usize| {
                let mut side = vec![Side::Second; count];
                (2..count).filter(|v| set >> v & 1 == 1).for_each(|v| side[v] = Side::Separator);
                let mut open = vec![0];
                side[0] = Side::First;
                while let Some(v) = open.pop() {
                    for w in (0..count).filter(|&w| near(v, w)) {
                        if side[w] == Side::Second {
                            side[w] = Side::First;
                            open.push(w);
                        }
                    }
                }
                (side[1] == Side::Second).then_some(side)
            };
            let sets = (0..1_usize << count).step_by(4);
            let least = sets.filter(|&set| of_set(set).is_some()).map(usize::count_ones).min();
            // From all neighbours of vertex 0; the band is all but the two ends.
            let around = (2..count).filter(|&v| near(0, v)).map(|v| 1 << v).sum();
            let mut side = of_set(around).expect("the ends are no neighbours");
            let is_band = (0..count).map(|v| v > 1).collect();
            let links = Links { start: &graph.0, neighbour: &graph.1 };
            shrink_in(links, &mut side, is_band);
            assert!(separates(&graph, &side));
            assert_eq!((side[0], side[1]), (Side::First, Side::Second));
            assert_eq!(size(&side), least.expect("all others together separate") as usize);
        }
    }
}
