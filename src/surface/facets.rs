//! Facets that are larger than the interference between two sides: gaps that differ within a face by more than they overlap.

use super::mesh::Side;
use super::pairs::SurfacePairs;

/// The slave faces whose pairs overlap the other side in the mean, and those of them on which gaps differ by more than that.
pub(super) fn overlapping_and_rough(slave: &Side<'_>, found: &SurfacePairs) -> [usize; 2] {
    let gap = |node: &usize| {
        let at = found.pairs.binary_search_by_key(node, |pair| pair.slave).ok()?;
        Some(found.pairs[at].gap)
    };
    let [mut overlapping, mut rough] = [0, 0];
    for at in 0..slave.count() {
        let gaps: Vec<f64> = slave.face(at).nodes.iter().filter_map(gap).collect();
        let [least, most] = [f64::min, f64::max].map(|of| gaps.iter().copied().reduce(of));
        let (Some(least), Some(most)) = (least, most) else { continue };
        let overlap = -gaps.iter().sum::<f64>() / gaps.len() as f64;
        overlapping += usize::from(overlap > 0.0);
        rough += usize::from(overlap > 0.0 && most - least > overlap);
    }
    [overlapping, rough]
}
