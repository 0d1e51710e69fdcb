//! Nested dissection for dear factorisations, by the ordering call of feral-scotch.
//!
//! The call orders small pieces of the graph. A large piece is parted by a separator, and the call finds it too: if it
//! leaves everything below the size of the piece to minimum degree, it makes one cut, whose vertices it puts last and
//! counts. Of two such cuts the better one is taken; that saves a twelfth of the operations that one call for all
//! takes (33³ nodes), because the separators of a large graph make nearly all of the cost of its factor.

use std::panic::{UnwindSafe, catch_unwind};

use feral_scotch::{CscPattern, ScotchOptions, scotch_order, scotch_order_full};

use super::factor_progress::{FactorProgress, FactorStep, Failure, Stopped};

/// Pieces of fewer vertices are ordered at once: their share of the cost is small.
const SMALL: usize = 3000;

/// Separators that are tried for each large piece.
const TRIALS: u64 = 2;

/// A connected part of the graph. Vertices ascend, and so do the neighbours of each.
struct Piece {
    /// Where the neighbours of each vertex begin.
    start: Vec<i32>,
    neighbour: Vec<i32>,
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
    let mut open = Piece { start, neighbour, vertex }.cut(&[]).parts;
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

impl Piece {
    fn pattern(&self) -> Option<CscPattern<'_>> {
        CscPattern::new(self.vertex.len(), &self.start, &self.neighbour)
    }

    /// Its vertices in the order of the call.
    fn ordered(&self) -> Option<Vec<i32>> {
        let order = scotch_order(&self.pattern()?).ok()?;
        order.iter().map(|&v| self.vertex.get(v as usize).copied()).collect()
    }

    /// The best cut of those that are tried; `None` for a small piece, or if the call finds none.
    fn best_cut(&self, progress: &mut FactorProgress<'_>) -> Result<Option<Cut>, Stopped> {
        let mut cuts = Vec::new();
        if self.vertex.len() >= SMALL {
            for seed in 0..TRIALS {
                progress(FactorStep::HasDone(0.0))?;
                cuts.extend(guarded(|| self.cut_by_call(seed)));
            }
        }
        let cuts = cuts.into_iter().filter(|cut| cut.parts.len() > 1);
        Ok(cuts.min_by(|a, b| a.badness().total_cmp(&b.badness())))
    }

    /// A cut with a separator of the call.
    fn cut_by_call(&self, seed: u64) -> Option<Cut> {
        let amd_switch = u32::try_from(self.vertex.len()).ok()? - 1;
        let options =
            ScotchOptions { seed, compress: false, amd_switch, ..ScotchOptions::default() };
        let (order, _, statistics) = scotch_order_full(&self.pattern()?, &options).ok()?;
        let inside = order.len().checked_sub(statistics.n_separator_vertices as usize)?;
        Some(self.cut(&order[inside..]))
    }

    /// Takes a separator out, and finds the connected parts of the others.
    fn cut(&self, separator: &[i32]) -> Cut {
        let mut is_open = vec![true; self.vertex.len()];
        separator.iter().for_each(|&v| is_open[v as usize] = false);
        let (mut place, mut parts) = (vec![None; self.vertex.len()], Vec::new());
        for from in 0..self.vertex.len() {
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
            parts.push(Piece { start, neighbour, vertex });
        }
        let separator = separator.iter().map(|&v| self.vertex[v as usize]).collect();
        Cut { separator, parts }
    }

    fn neighbours(&self, v: usize) -> impl Iterator<Item = usize> {
        let range = self.start[v] as usize..self.start[v + 1] as usize;
        self.neighbour[range].iter().map(|&w| w as usize)
    }
}

impl Cut {
    /// Small for a small separator between halves of one size.
    fn badness(&self) -> f64 {
        let sizes = self.parts.iter().map(|part| part.vertex.len());
        let (largest, all) = (sizes.clone().max().unwrap_or(0), sizes.sum::<usize>());
        self.separator.len() as f64 / (largest as f64 * (all - largest) as f64)
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
        Piece { start, neighbour, vertex: (0..).take(length * width).collect() }
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
        let kept: usize = cut.parts.iter().map(|part| part.neighbour.len()).sum();
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
