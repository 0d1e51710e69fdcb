//! A graph by the neighbours of its vertices.

use std::ops::Range;

/// The neighbours of each vertex, ascending, and where they begin.
#[derive(Clone)]
pub struct Links {
    pub start: Vec<usize>,
    pub neighbour: Vec<usize>,
}

impl Links {
    /// Number of vertices.
    pub fn vertices(&self) -> usize {
        self.start.len() - 1
    }

    /// The places of the neighbours of a vertex.
    pub fn range(&self, v: usize) -> Range<usize> {
        self.start[v]..self.start[v + 1]
    }

    /// The neighbours of a vertex.
    pub fn neighbours(&self, v: usize) -> impl Iterator<Item = usize> {
        self.neighbour[self.range(v)].iter().copied()
    }

    /// The connected parts of the vertices that are not in the separator, each ascending.
    pub fn parts(&self, separator: &[usize]) -> Vec<Vec<usize>> {
        let mut is_open = vec![true; self.vertices()];
        separator.iter().for_each(|&v| is_open[v] = false);
        let mut parts = Vec::new();
        for from in 0..self.vertices() {
            if !std::mem::take(&mut is_open[from]) {
                continue;
            }
            let (mut part, mut done) = (vec![from], 0);
            while let Some(&v) = part.get(done) {
                done += 1;
                part.extend(self.neighbours(v).filter(|&w| std::mem::take(&mut is_open[w])));
            }
            part.sort_unstable();
            parts.push(part);
        }
        parts
    }
}
