//! The values of the factor and the Schur complement.
//!
//! First the panels of subtrees, each subtree by one thread; then those above, each by all threads; at last the
//! products of all panels are subtracted from the Schur complement. Nothing of the result depends on the number of
//! threads.

use std::ops::Range;
use std::sync::Mutex;

use super::entries::Entries;
use super::factor_progress::{FactorProgress, Failure};
use super::lists::filled;
use super::panel::{Before, Source, Weakest, weaker};
use super::panel_assembly::{by_all_threads, by_one_thread};
use super::parallel::{Parallel, Workspace, locked};
use super::schedule::Schedule;
use super::schur_update;
use super::structure::Structure;
use crate::linalg::dense::mirror;
use crate::linalg::sparse_matrix::{Csc, OutOfMemory};

/// Numbers that are cleared between two questions whether to go on: some milliseconds.
const CLEARED: usize = 1 << 21;

/// The results of a factorisation beside the values of the panels.
pub struct Numeric {
    /// The Schur complement, column-major, both triangles.
    pub schur: Vec<f64>,
    /// The pivot that is smallest relative to the diagonal.
    pub weakest: Weakest,
}

/// Bytes that a factorisation on so many threads holds beside its arguments.
pub fn bytes(structure: &Structure, lower: &Csc, threads: usize) -> usize {
    let numbers = structure.stored() + structure.kept() * structure.kept();
    let places = structure.size * size_of::<usize>();
    let room = threads * Workspace::bytes(structure) + places;
    numbers * size_of::<f64>() + Entries::bytes(structure, lower) + room
}

/// Computes everything; `values` become those of the panels, in the memory that they have. A pivot that is not positive is
/// [`Failure::Indefinite`] with its row.
pub fn factorised(
    (structure, schedule): (&Structure, &Schedule),
    lower: &Csc,
    values: &mut Vec<f64>,
    progress: &mut FactorProgress<'_>,
) -> Result<Numeric, Failure> {
    let (kept, mut schur) = (structure.kept(), Vec::new());
    clear(values, structure.stored(), progress)?;
    clear(&mut schur, kept * kept, progress)?;
    progress(0.0)?;
    let entries = &Entries::new(structure, lower, &mut schur)?;
    progress(0.0)?;
    let parallel = &mut Parallel::new(structure, progress, schedule.operations)?;
    let source = Source { structure, schedule, entries };
    let below = subtrees(source, values, parallel)?;
    let above = above(source, values, parallel)?;
    schur_update::subtract(structure, values, &mut schur, parallel)?;
    mirror(&mut schur, kept);
    progress(1.0)?;
    let weakest = weaker(below, above);
    Ok(Numeric { schur, weakest })
}

/// Makes zeros of `numbers`. The system hands out the pages as they are written.
fn clear(
    numbers: &mut Vec<f64>,
    length: usize,
    progress: &mut FactorProgress<'_>,
) -> Result<(), Failure> {
    numbers.clear();
    numbers.try_reserve_exact(length).map_err(|_| OutOfMemory)?;
    while numbers.len() < length {
        progress(0.0)?;
        numbers.resize(length.min(numbers.len() + CLEARED), 0.0);
    }
    Ok(())
}

/// The panels of a subtree.
struct Subtree<'v> {
    panels: Range<usize>,
    values: &'v mut [f64],
    weakest: Result<Weakest, usize>,
}

/// Makes the panels of all subtrees.
fn subtrees(
    source: Source<'_>,
    values: &mut [f64],
    parallel: &mut Parallel<'_>,
) -> Result<Weakest, Failure> {
    let Schedule { subtrees, .. } = source.schedule;
    let (mut all, mut rest, mut at) = (Vec::new(), values, 0);
    let mut operations = 0.0;
    for panels in subtrees {
        let begin = source.structure.values(panels.start).start;
        let end = source.structure.values(panels.end - 1).end;
        let (_, from) = rest.split_at_mut(begin - at);
        let (values, after) = from.split_at_mut(end - begin);
        operations += source.schedule.of_panel[panels.clone()].iter().sum::<f64>();
        all.push(Mutex::new(Subtree { panels: panels.clone(), values, weakest: Ok(None) }));
        (rest, at) = (after, end);
    }
    parallel.share(all.len(), operations, &|workspace, part| {
        locked(&all[part]).make(source, workspace);
    })?;
    // The first one in the order of the panels, whoever came to it first.
    all.iter().try_fold(None, |weakest, subtree| match locked(subtree).weakest {
        Ok(other) => Ok(weaker(weakest, other)),
        Err(place) => Err(Failure::Indefinite(source.structure.order[place])),
    })
}

impl Subtree<'_> {
    fn make(&mut self, source: Source<'_>, workspace: &mut Workspace) {
        let start = source.structure.values(self.panels.start).start;
        self.weakest = self.panels.clone().try_fold(None, |weakest, s| {
            let place = source.structure.values(s);
            let (before, rest) = self.values.split_at_mut(place.start - start);
            let before = Before { values: before, start };
            let other = by_one_thread(source, s, before, &mut rest[..place.len()], workspace)?;
            Ok(weaker(weakest, other))
        });
    }
}

/// Makes the panels above the subtrees.
fn above(
    source: Source<'_>,
    values: &mut [f64],
    parallel: &mut Parallel<'_>,
) -> Result<Weakest, Failure> {
    let mut places = filled(source.structure.size, 0)?;
    let mut weakest = None;
    for &s in &source.schedule.above {
        let own = source.structure.values(s);
        let (before, rest) = values.split_at_mut(own.start);
        let (before, panel) = (Before { values: before, start: 0 }, &mut rest[..own.len()]);
        let pivot = by_all_threads(source, s, before, panel, &mut places, parallel)?;
        weakest = weaker(weakest, pivot);
    }
    Ok(weakest)
}
