//! The sides of a separator in a graph.

/// A graph: where the neighbours of each vertex begin, and the neighbours.
#[derive(Clone, Copy)]
pub struct Links<'a> {
    pub start: &'a [i32],
    pub neighbour: &'a [i32],
}

impl<'a> Links<'a> {
    /// Neighbours of a vertex.
    pub fn of(self, vertex: usize) -> impl Iterator<Item = usize> + 'a {
        self.range(vertex).map(move |k| self.neighbour[k] as usize)
    }

    /// Where its neighbours stand.
    pub fn range(self, vertex: usize) -> std::ops::Range<usize> {
        self.start[vertex] as usize..self.start[vertex + 1] as usize
    }
}

/// Where a vertex is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    First,
    Second,
    Separator,
}

/// Whether each vertex is in a band around the separator, which has at most `most` vertices of each side.
pub fn band(links: Links<'_>, side: &[Side], most: usize) -> Vec<bool> {
    let mut is_band: Vec<bool> = side.iter().map(|&s| s == Side::Separator).collect();
    for which in [Side::First, Side::Second] {
        grow(links, side, which, most, &mut is_band);
    }
    is_band
}

/// Puts the vertices of a side that are near the separator into the band, layer by layer, at most so many.
fn grow(links: Links<'_>, side: &[Side], which: Side, most: usize, is_band: &mut [bool]) {
    let mut layer: Vec<usize> = (0..side.len()).filter(|&v| side[v] == Side::Separator).collect();
    let mut count = 0;
    while !layer.is_empty() {
        let mut further = Vec::new();
        for &v in &layer {
            for w in links.of(v).filter(|&w| side[w] == which) {
                if !is_band[w] {
                    is_band[w] = true;
                    further.push(w);
                }
            }
        }
        count += further.len();
        if count > most {
            further.iter().for_each(|&w| is_band[w] = false);
            return;
        }
        layer = further;
    }
}
