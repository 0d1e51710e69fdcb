//! Facets that are larger than the interference between two sides: gaps that differ within a face by more than they overlap.

use super::mesh::Side;
use super::pairs::SurfacePairs;
use super::watch::Watch;
use crate::error::Error;

/// The slave faces whose pairs overlap the other side in the mean, and those of them on which gaps differ by more than that.
///
/// # Errors
/// What ends the watch.
pub(super) fn overlapping_and_rough(
    slave: &Side<'_>,
    found: &SurfacePairs,
    watch: &mut Watch<'_, '_>,
) -> Result<[usize; 2], Error> {
    let mut gap_at = vec![None; found.pairs.last().map_or(0, |pair| pair.slave + 1)];
    found.pairs.iter().for_each(|pair| gap_at[pair.slave] = Some(pair.gap));
    let [mut overlapping, mut rough] = [0, 0];
    for at in 0..slave.count() {
        watch.goes_on()?;
        let of_nodes = slave.face(at).nodes.iter().map(|&node| *gap_at.get(node)?);
        let gaps: Vec<f64> = of_nodes.flatten().collect();
        let [least, most] = [f64::min, f64::max].map(|of| gaps.iter().copied().reduce(of));
        let (Some(least), Some(most)) = (least, most) else { continue };
        let overlap = -gaps.iter().sum::<f64>() / gaps.len() as f64;
        overlapping += usize::from(overlap > 0.0);
        rough += usize::from(overlap > 0.0 && most - least > overlap);
    }
    Ok([overlapping, rough])
}
