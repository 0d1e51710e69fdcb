//! The first load case of `large_rows.rs` in a file, for other libraries.
//!
//! Three int64, unknowns, contact unknowns and entries; column starts and rows (int64, from 0) of the lower triangle,
//! without fixed unknowns and with the contact unknowns last; then in doubles its values, the loads that the motion
//! of the clamped face makes, one for each unknown, and the gaps, one for each pair.

use std::path::Path;

use super::common::mesh::Stiffness;

/// The stiffness; fixed degrees of freedom with their motion; those of the pairs; gaps.
pub type Problem<'a> = (&'a Stiffness, (&'a [usize], &'a [f64]), &'a [usize], &'a [f64]);

pub fn write(path: &Path, (stiffness, (fixed, motion), contact, gaps): Problem<'_>) {
    let mut moved = vec![0.0; stiffness.size];
    fixed.iter().zip(motion).for_each(|(&i, motion)| moved[i] = *motion);
    let mut is_inner = vec![true; stiffness.size];
    fixed.iter().chain(contact).for_each(|&i| is_inner[i] = false);
    let inner = (0..stiffness.size).filter(|&i| is_inner[i]);
    let order: Vec<usize> = inner.chain(contact.iter().copied()).collect();
    let mut place = vec![usize::MAX; stiffness.size];
    order.iter().enumerate().for_each(|(to, &from)| place[from] = to);
    let (mut columns, mut loads) = (vec![Vec::new(); order.len()], vec![0.0; order.len()]);
    for (i, j, value) in stiffness.entries() {
        for (row, column) in [(i, j), (j, i)].into_iter().take(if i == j { 1 } else { 2 }) {
            if let Some(load) = loads.get_mut(place[row]) {
                *load -= value * moved[column];
            }
        }
        let (i, j) = (place[i].max(place[j]), place[i].min(place[j]));
        if i < usize::MAX {
            columns[j].push((i as i64, value));
        }
    }
    let mut starts = vec![0_i64];
    for column in &mut columns {
        column.sort_by_key(|(i, _)| *i);
        starts.push(starts[starts.len() - 1] + column.len() as i64);
    }
    let head = [order.len() as i64, contact.len() as i64, starts[order.len()]];
    let entries = || columns.iter().flatten();
    let whole = head.iter().chain(&starts).chain(entries().map(|(i, _)| i));
    let real = entries().map(|(_, value)| value).chain(&loads).chain(gaps);
    let bytes = whole.flat_map(|number| number.to_ne_bytes());
    let bytes: Vec<u8> = bytes.chain(real.flat_map(|number| number.to_ne_bytes())).collect();
    std::fs::write(path, bytes).expect("the file can be written");
}
