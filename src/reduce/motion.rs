//! Displacements in words: which part moves, and what moves most.

use crate::error::index;
use crate::linalg::tolerances::MOVING;
use crate::linalg::vector::norm_inf;

/// How many of what moves most are named: a node's translation in space, or one point of a rotation.
const MOST_NAMED: usize = 3;

/// Places of the entries that move, and of those that move most, the largest first.
pub(super) fn moving(values: &[f64]) -> (Vec<usize>, Vec<usize>) {
    let least = MOVING * norm_inf(values);
    let moving: Vec<usize> = (0..values.len()).filter(|&i| values[i].abs() > least).collect();
    let mut most = moving.clone();
    most.sort_by(|&a, &b| values[b].abs().total_cmp(&values[a].abs()));
    most.truncate(MOST_NAMED);
    (moving, most)
}

/// Displacements of a host's degrees of freedom: `5 of the degrees of freedom 2 to 9, most of all
/// degree of freedom 4 by 1.000, 6 by 0.500, ...`, relative to the largest.
pub(super) fn of_host(u: &[f64]) -> String {
    let (moving, most) = moving(u);
    let (Some(first), Some(last)) = (moving.first(), moving.last()) else {
        return "nothing".into();
    };
    let most: Vec<String> = most
        .iter()
        .map(|&dof| format!("{} by {:.3}", index(dof), u[dof] / u[most[0]].abs()))
        .collect();
    let count = moving.len();
    let (first, last) = (index(first), index(last));
    format!(
        "{count} of the degrees of freedom {first} to {last}, most of all degree of freedom {}",
        most.join(", ")
    )
}

/// Displacements of contact nodes, components (n, t) or (n, t1, t2) node after node: `3 of 9 pairs, most
/// of all pair 4 by (1.000, 0.000) along its normal and tangent`, relative to the largest.
pub(super) fn of_pairs(dim: usize, d: &[f64]) -> String {
    let sizes: Vec<f64> = d.chunks_exact(dim).map(norm_inf).collect();
    let (moving, most) = moving(&sizes);
    let Some(&pair) = most.first() else { return "nothing".into() };
    let components = components(&d[dim * pair..dim * (pair + 1)]);
    let frame = if dim == 2 { "normal and tangent" } else { "normal and tangents" };
    format!(
        "{} of {} pairs, most of all pair {} by {components} along its {frame}",
        moving.len(),
        sizes.len(),
        index(pair)
    )
}

/// `(1.000, -0.500)`: components relative to the largest one.
pub(super) fn components(vector: &[f64]) -> String {
    let most = norm_inf(vector).max(f64::MIN_POSITIVE);
    let parts: Vec<String> = vector.iter().map(|c| format!("{:.3}", rounded(c / most))).collect();
    format!("({})", parts.join(", "))
}

/// To three decimals, never minus zero.
fn rounded(value: f64) -> f64 {
    (value * 1e3).round() / 1e3 + 0.0
}
