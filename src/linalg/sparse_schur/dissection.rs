//! Nested dissection for dear factorisations.
//!
//! A piece of the graph is parted by a separator ([`super::separator`]), which stands behind its parts in the order, and so
//! are these. Small pieces are ordered by minimum degree.

use super::factor_progress::{FactorProgress, Failure};
use super::links::Links;
use super::minimum_degree::minimum_degree;
use super::separator::separator;

/// Pieces of fewer vertices are ordered at once: their share of the cost is small.
const SMALL: usize = 300;

/// A connected part of the graph. Vertices ascend, and so do the neighbours of each.
struct Piece {
    links: Links,
    /// Its vertices in the whole graph.
    vertex: Vec<usize>,
}

/// The order of the vertices of a graph, whose neighbours ascend.
///
/// # Errors
/// No memory, or `progress`, which is asked before each piece and between the levels of one, ends it.
pub fn dissected(links: Links, progress: &mut FactorProgress<'_>) -> Result<Vec<usize>, Failure> {
    let vertex = (0..links.vertices()).collect();
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
            None => minimum_degree(&piece.links.start, &piece.links.neighbour)?,
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
            let (mut start, mut neighbour) = (vec![0], Vec::new());
            for &v in &part {
                // The neighbours of a part are its own and those of the separator.
                let own = self.links.neighbours(v).map(|w| place[w]);
                neighbour.extend(own.filter(|&w| w < usize::MAX));
                start.push(neighbour.len());
            }
            part.iter().for_each(|&v| place[v] = usize::MAX);
            let vertex = part.iter().map(|&v| self.vertex[v]).collect();
            Piece { links: Links { start, neighbour }, vertex }
        };
        self.links.parts(separator).into_iter().map(part).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::{Links, Piece, SMALL, dissected};
    use crate::linalg::sparse_schur::factor_progress::Failure;
    use crate::linalg::sparse_schur::separator::tests::strip;

    /// Seven paths along the strip share no vertex, so that a separator has at least seven (Menger); a column of the
    /// strip has as many. A side has at most three fifths of all, and so the other one nearly two fifths.
    #[test]
    fn a_strip_is_cut_across() {
        let links = strip(500, 7);
        let vertex = (0..).take(links.vertices()).collect();
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
        let kept: usize = parts.iter().map(|part| part.links.neighbour.len()).sum();
        let is_cut = |v: usize| separator.contains(&v);
        let inside = (0..strip.vertex.len()).filter(|&v| !is_cut(v));
        let expected: usize =
            inside.map(|v| strip.links.neighbours(v).filter(|&w| !is_cut(w)).count()).sum();
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
        let shift = one.vertices();
        let (mut start, mut neighbour) = (one.start.clone(), one.neighbour.clone());
        start.extend(one.start[1..].iter().map(|k| k + one.neighbour.len()));
        neighbour.extend(one.neighbour.iter().map(|v| v + shift));
        // And two vertices without neighbours.
        start.extend([neighbour.len(); 2]);
        let mut order = dissected(Links { start, neighbour }, &mut |_| Ok(())).unwrap();
        order.sort_unstable();
        assert!(order.into_iter().eq(0..2 * shift + 2));
    }
}
