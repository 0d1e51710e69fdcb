//! Panels made by one thread, or by several together.

use std::sync::{Mutex, PoisonError};

use super::failure::Failure;
use super::panel::{Before, Panel, Room, Source, Weakest, fill, weakest};
use super::team::{Team, locked};

/// Makes a panel on the calling thread. Returns its weakest pivot, or the place of one that is not positive.
pub fn alone(
    source: Source<'_>,
    number: usize,
    before: Before<'_>,
    values: &mut [f64],
    room: &mut Room,
) -> Result<Weakest, usize> {
    fill(source, number, &mut room.place, values);
    let panel = Panel { source, number, before, place: &room.place };
    let (mut top, mut below) = panel.divided(values);
    panel.change_top(top.as_mut(), &mut room.product);
    for rows in panel.blocks() {
        let block = below.as_mut().subrows_mut(rows.start, rows.len());
        panel.change_block(rows, block, &mut room.product);
    }
    panel.eliminate(top.as_mut(), &mut room.memory)?;
    for rows in panel.blocks() {
        panel.divide(top.as_ref(), below.as_mut().subrows_mut(rows.start, rows.len()));
    }
    Ok(weakest(source, number, values))
}

/// The same by all threads of a team. `place` is room for the places of the rows.
pub fn together(
    source: Source<'_>,
    number: usize,
    before: Before<'_>,
    values: &mut [f64],
    place: &mut [usize],
    (rooms, team): (&[Mutex<Room>], &mut Team<'_>),
) -> Result<Result<Weakest, usize>, Failure> {
    fill(source, number, place, values);
    let panel = Panel { source, number, before, place };
    let (top, mut below) = panel.divided(values);
    let top = Mutex::new(top);
    let mut blocks = Vec::new();
    for rows in panel.blocks() {
        let (block, rest) = below.split_at_row_mut(rows.len());
        blocks.push(Mutex::new((rows, block)));
        below = rest;
    }
    team.share(1 + blocks.len(), source.schedule.operations(number), &|lane, part| {
        let product = &mut locked(&rooms[lane]).product;
        match part.checked_sub(1) {
            None => panel.change_top(locked(&top).as_mut(), product),
            Some(k) => {
                let (rows, block) = &mut *locked(&blocks[k]);
                panel.change_block(rows.clone(), block.as_mut(), product);
            }
        }
    })?;
    let mut top = top.into_inner().unwrap_or_else(PoisonError::into_inner);
    if let Err(place) = panel.eliminate(top.as_mut(), &mut locked(&rooms[0]).memory) {
        return Ok(Err(place));
    }
    let (width, rows) = (top.ncols(), source.structure.rows(number).len());
    team.share(blocks.len(), (width * width * rows) as f64, &|_, k| {
        panel.divide(top.as_ref(), locked(&blocks[k]).1.as_mut());
    })?;
    drop(blocks);
    Ok(Ok(weakest(source, number, values)))
}
