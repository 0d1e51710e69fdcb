//! The values of a panel, assembled by one thread or by several, and eliminated.

use std::sync::Mutex;

use super::factor_progress::Failure;
use super::panel::{Before, Panel, Source, Weakest};
use super::parallel::{Parallel, Workspace, locked};

/// Makes a panel on the calling thread. Returns its weakest pivot, or the place of one that is not positive.
pub fn by_one_thread(
    source: Source<'_>,
    number: usize,
    before: Before<'_>,
    values: &mut [f64],
    workspace: &mut Workspace,
) -> Result<Weakest, usize> {
    let Workspace { place, product, memory } = workspace;
    let panel = Panel::filled(source, number, before, place, values);
    let (mut top, mut below) = panel.divided(values);
    panel.change_top(top.as_mut(), product);
    for rows in panel.blocks() {
        let block = below.as_mut().subrows_mut(rows.start, rows.len());
        panel.change_block(rows, block, product);
    }
    panel.eliminate(values, memory)
}

/// Makes a panel on all threads, with the same bits. The entries of `place` are overwritten with the places of the
/// rows.
pub fn by_all_threads(
    source: Source<'_>,
    number: usize,
    before: Before<'_>,
    values: &mut [f64],
    place: &mut [usize],
    parallel: &mut Parallel<'_>,
) -> Result<Weakest, Failure> {
    let panel = Panel::filled(source, number, before, place, values);
    let (top, mut below) = panel.divided(values);
    let top = Mutex::new(top);
    let mut blocks = Vec::new();
    for rows in panel.blocks() {
        let (block, rest) = below.split_at_row_mut(rows.len());
        blocks.push(Mutex::new((rows, block)));
        below = rest;
    }
    let operations = source.schedule.of_panel[number];
    parallel.share(1 + blocks.len(), operations, &|workspace, part| match part.checked_sub(1) {
        None => panel.change_top(locked(&top).as_mut(), &mut workspace.product),
        Some(k) => {
            let (rows, block) = &mut *locked(&blocks[k]);
            panel.change_block(rows.clone(), block.as_mut(), &mut workspace.product);
        }
    })?;
    let eliminated = panel.eliminate(values, &mut locked(&parallel.workspaces[0]).memory);
    eliminated.map_err(|place| Failure::Indefinite(source.structure.order[place]))
}
