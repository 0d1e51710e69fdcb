//! Nested dissection for dear factorisations.
//!
//! A piece of the graph is parted by a separator ([`super::separator`]), which stands behind its parts in the order, and so
//! are these. Small pieces are ordered by minimum degree.

use std::mem::take;

use super::factor_progress::{FactorProgress, Failure};
use super::lists::Lists;
use super::minimum_degree::minimum_degree;
use super::separator::separator;

/// Pieces of fewer vertices are ordered at once: their share of the cost is small.
const SMALL: usize = 300;

/// A connected part of the graph. Vertices ascend, and so do the neighbours of each.
struct Piece {
    links: Lists,
    /// Its vertices in the whole graph.
    vertex: Vec<usize>,
}

/// The order of the vertices of a graph, whose neighbours ascend.
///
/// # Errors
/// No memory, or `progress`, which is asked before each piece and between the levels of one, ends it.
pub fn dissected(links: Lists, progress: &mut FactorProgress<'_>) -> Result<Vec<usize>, Failure> {
    let vertex = (0..links.count()).collect();
    let mut open = Piece { links, vertex }.without(&[]);
    // From the last vertex of the order to the first: a separator stands behind its parts.
    let mut backwards = Vec::new();
    while let Some(piece) = open.pop() {
        progress(0.0)?;
        let last = match piece.separator(progress)? {
            Some(separator) => {
                open.extend(piece.without(&separator));
                separator
            }
            None => minimum_degree(&piece.links)?,
        };
        backwards.extend(last.iter().rev().map(|&v| piece.vertex[v]));
    }
    backwards.reverse();
    Ok(backwards)
}

impl Piece {
    /// A separator; `None` of a small piece, or if none is found.
    fn separator(&self, progress: &mut FactorProgress<'_>) -> Result<Option<Vec<usize>>, Failure> {
        if self.vertex.len() < SMALL {
            return Ok(None);
        }
        separator(&self.links, SMALL, progress)
    }

    /// The connected parts of the vertices that are not in a separator.
    fn without(&self, separator: &[usize]) -> Vec<Piece> {
        let mut place = vec![usize::MAX; self.vertex.len()];
        let part = |part: Vec<usize>| {
            (0..).zip(&part).for_each(|(k, &v)| place[v] = k);
            // The neighbours of a part are its own and those of the separator.
            let own = |&v: &usize| self.links.of(v).map(|w| place[w]).filter(|&w| w < usize::MAX);
            let links = part.iter().map(own).collect();
            part.iter().for_each(|&v| place[v] = usize::MAX);
            let vertex = part.iter().map(|&v| self.vertex[v]).collect();
            Piece { links, vertex }
        };
        parts(&self.links, separator).into_iter().map(part).collect()
    }
}

/// The connected parts of the vertices that are not in the separator, each ascending.
fn parts(links: &Lists, separator: &[usize]) -> Vec<Vec<usize>> {
    let mut is_open = vec![true; links.count()];
    separator.iter().for_each(|&v| is_open[v] = false);
    let mut parts = Vec::new();
    for from in 0..links.count() {
        if !take(&mut is_open[from]) {
            continue;
        }
        let (mut part, mut done) = (vec![from], 0);
        while let Some(&v) = part.get(done) {
            done += 1;
            part.extend(links.of(v).filter(|&w| take(&mut is_open[w])));
        }
        part.sort_unstable();
        parts.push(part);
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::{Piece, SMALL, dissected};
    use crate::linalg::sparse_schur::factor_progress::Failure;
    use crate::linalg::sparse_schur::separator::tests::strip;

    /// Seven paths along the strip share no vertex, so that a separator has at least seven (Menger); a column of the
    /// strip has as many. A side has at most three fifths of all, and so the other one nearly two fifths.
    #[test]
    fn a_strip_is_cut_across() {
        let links = strip(500, 7);
        let vertex = (0..).take(links.count()).collect();
        let strip = Piece { links, vertex };
        let found = strip.separator(&mut |_| Ok(())).unwrap();
        let separator = found.expect("a strip has separators");
        assert!((7..=14).contains(&separator.len()), "{separator:?}");
        let parts = strip.without(&separator);
        assert_eq!(parts.len(), 2);
        for part in &parts {
            assert!(3 * part.vertex.len() >= strip.vertex.len(), "{}", part.vertex.len());
        }
        // No edge leads from one part to the other: all that a part lacks are edges to the separator.
        let kept: usize = parts.iter().map(|part| part.links.entries.len()).sum();
        let is_cut = |v: usize| separator.contains(&v);
        let inside = (0..strip.vertex.len()).filter(|&v| !is_cut(v));
        let expected: usize =
            inside.map(|v| strip.links.of(v).filter(|&w| !is_cut(w)).count()).sum();
        assert_eq!(kept, expected);
    }

    /// Between two questions less is done than for a piece of `SMALL` vertices alone, so that there are at least as many as
    /// such pieces; and whichever is answered with no, it ends there.
    #[test]
    fn it_is_asked_often_and_ends_at_once() {
        let ordered = |most: usize| {
            let mut asked = 0;
            let result = dissected(strip(2000, 9), &mut |_| {
                asked += 1;
                if asked < most { Ok(()) } else { Err(Failure::Stopped) }
            });
            (result, asked)
        };
        let all = ordered(usize::MAX).1;
        assert!(all > 2000 * 9 / SMALL, "{all}");
        for most in (1..=all).step_by(7) {
            let (result, asked) = ordered(most);
            assert_eq!((result, asked), (Err(Failure::Stopped), most));
        }
    }

    #[test]
    fn a_graph_of_several_parts_is_ordered_whole() {
        let one = strip(SMALL / 7 + 1, 7);
        let shift = one.count();
        let mut links = one.clone();
        (0..shift).for_each(|v| _ = links.push(one.of(v).map(|w| w + shift)));
        (0..2).for_each(|_| _ = links.push([]));
        let mut order = dissected(links, &mut |_| Ok(())).unwrap();
        order.sort_unstable();
        assert!(order.into_iter().eq(0..2 * shift + 2));
    }
}
