//! Nested dissection for dear factorisations, by the ordering call of feral-scotch.
//!
//! The call orders small pieces of the graph. A large piece is parted by a separator ([`super::separator`]), which the call
//! finds in a smaller graph: if it leaves everything below the size of that graph to minimum degree, it makes one cut,
//! whose vertices it puts last and counts. So each call is short, and between two of them it is asked if the work goes on.

use std::panic::{UnwindSafe, catch_unwind};

use feral_scotch::{CscPattern, ScotchOptions, scotch_order, scotch_order_full};

use super::factor_progress::{FactorProgress, FactorStep, Failure, Stopped};
use super::separator::{Links, separator};

/// Pieces of fewer vertices are ordered at once: their share of the cost is small.
const SMALL: usize = 3000;

/// A connected part of the graph. Vertices ascend, and so do the neighbours of each.
struct Piece {
    links: Links,
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
    let links = Links { start, neighbour };
    let vertex: Vec<i32> = (0..).take(links.vertices()).collect();
    let mut open = Piece { links, vertex }.cut(&[]).parts;
    // From the last vertex of the order to the first: a separator stands behind its parts.
    let mut backwards = Vec::new();
    while let Some(piece) = open.pop() {
        progress(FactorStep::HasDone(0.0))?;
        if let Some(cut) = piece.best_cut(progress)? {
            backwards.extend(cut.separator.iter().rev());
            open.extend(cut.parts);
        } else if let Some(order) = guarded(|| piece.ordered()) {
            backwards.extend(order.iter().rev());
        } else {
            return Ok(None);
        }
    }
    backwards.reverse();
    Ok(Some(backwards))
}

/// The result of `work`; `None` if it panics.
fn guarded<T>(work: impl FnOnce() -> Option<T> + UnwindSafe) -> Option<T> {
    catch_unwind(work).ok().flatten()
}

fn pattern(links: &Links) -> Option<CscPattern<'_>> {
    CscPattern::new(links.vertices(), &links.start, &links.neighbour)
}

/// A separator of the call.
fn separator_by_call(links: &Links, seed: u64) -> Option<Vec<i32>> {
    let amd_switch = u32::try_from(links.vertices()).ok()? - 1;
    let options = ScotchOptions { seed, compress: false, amd_switch, ..ScotchOptions::default() };
    let (mut order, _, statistics) = scotch_order_full(&pattern(links)?, &options).ok()?;
    let inside = order.len().checked_sub(statistics.n_separator_vertices as usize)?;
    Some(order.split_off(inside))
}

impl Piece {
    /// Its vertices in the order of the call.
    fn ordered(&self) -> Option<Vec<i32>> {
        let order = scotch_order(&pattern(&self.links)?).ok()?;
        order.iter().map(|&v| self.vertex.get(v as usize).copied()).collect()
    }

    /// A cut by a separator; `None` for a small piece, or if none is found.
    fn best_cut(&self, progress: &mut FactorProgress<'_>) -> Result<Option<Cut>, Stopped> {
        if self.vertex.len() < SMALL {
            return Ok(None);
        }
        let call = |links: &Links, seed: u64| guarded(|| separator_by_call(links, seed));
        let found = separator(&self.links, SMALL, call, progress)?;
        Ok(found.map(|separator| self.cut(&separator)).filter(|cut| cut.parts.len() > 1))
    }

    /// Takes a separator out, and finds the connected parts of the others.
    fn cut(&self, separator: &[i32]) -> Cut {
        let mut place = vec![-1; self.vertex.len()];
        let mut parts = Vec::new();
        for part in self.links.parts(separator) {
            (0..).zip(&part).for_each(|(k, &v)| place[v] = k);
            let (mut start, mut neighbour) = (vec![0], Vec::new());
            for &v in &part {
                // The neighbours of a part are its own and those of the separator.
                let own = self.links.neighbours(v).map(|w| place[w]);
                neighbour.extend(own.filter(|&w| w >= 0));
                start.push(neighbour.len() as i32);
            }
            part.iter().for_each(|&v| place[v] = -1);
            let vertex = part.iter().map(|&v| self.vertex[v]).collect();
            parts.push(Piece { links: Links { start, neighbour }, vertex });
        }
        let separator = separator.iter().map(|&v| self.vertex[v as usize]).collect();
        Cut { separator, parts }
    }
}

#[cfg(test)]
mod tests {
    use super::{Links, Piece, SMALL, dissected, guarded};
    use crate::linalg::sparse_schur::factor_progress::{Failure, Stopped};
    use crate::linalg::sparse_schur::separator::tests::strip;

    /// Seven paths along the strip share no vertex, so that a separator has at least seven (Menger); a column of the
    /// strip has as many. A side has at most three fifths of all, and so the other one nearly two fifths.
    #[test]
    fn a_strip_is_cut_across() {
        let links = strip(500, 7);
        let vertex = (0..).take(links.vertices()).collect();
        let strip = Piece { links, vertex };
        let cut = strip.best_cut(&mut |_| Ok(())).unwrap().expect("a strip has separators");
        assert!((7..=14).contains(&cut.separator.len()), "{:?}", cut.separator);
        assert_eq!(cut.parts.len(), 2);
        for part in &cut.parts {
            assert!(3 * part.vertex.len() >= strip.vertex.len(), "{}", part.vertex.len());
        }
        // No edge leads from one part to the other: all that a part lacks are edges to the separator.
        let kept: usize = cut.parts.iter().map(|part| part.links.neighbour.len()).sum();
        let is_cut = |v: usize| cut.separator.contains(&(v as i32));
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
            let Links { start, neighbour } = strip(2000, 9);
            let mut asked = 0;
            let result = dissected(start, neighbour, &mut |_| {
                asked += 1;
                if asked < most { Ok(()) } else { Err(Stopped) }
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
        let shift = one.vertices() as i32;
        let (mut start, mut neighbour) = (one.start.clone(), one.neighbour.clone());
        start.extend(one.start[1..].iter().map(|k| k + one.neighbour.len() as i32));
        neighbour.extend(one.neighbour.iter().map(|v| v + shift));
        // And two vertices without neighbours.
        start.extend([neighbour.len() as i32; 2]);
        let mut order = dissected(start, neighbour, &mut |_| Ok(())).unwrap().unwrap();
        order.sort_unstable();
        assert!(order.into_iter().eq(0..2 * shift + 2));
    }

    #[test]
    fn a_defect_of_another_crate_is_no_order() {
        assert_eq!(guarded(|| Some(3)), Some(3));
        assert_eq!(guarded(|| None::<usize>), None);
        assert_eq!(guarded(|| -> Option<usize> { panic!("a defect of another crate") }), None);
    }
}
