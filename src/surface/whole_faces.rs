//! Rows of slave nodes whose faces count as covered wholly, and integrals over whole faces.

use std::collections::BTreeMap;

use super::control::Edges;
use super::mesh::Side;
use super::pairs::{SurfacePair, SurfacePairs, SurfaceReport};
use super::row::Row;
use super::shape::{MOST_NODES, Values};
use crate::error::Error;

/// The slave's part of the rows of all nodes, as if every face were covered wholly.
fn whole_rows(side: &Side<'_>) -> BTreeMap<usize, Row> {
    let faces = || (0..side.count()).map(|face| side.face(face));
    let mut edges = Edges::default();
    faces().for_each(|face| edges.add(face.kind, face.nodes, true));
    let mut rows: BTreeMap<usize, Row> = BTreeMap::new();
    for face in faces() {
        let basis = edges.basis(face.kind, face.nodes, true);
        let areas = basis.functions(face.integrals());
        for (node, unit) in face.nodes.iter().zip(unit_values(face.kind.nodes())) {
            let values = basis.control_values(unit);
            // A node that a row does not move is not named by it: it may face nothing.
            for (j, own) in face.nodes.iter().enumerate().filter(|(j, _)| values[*j] != 0.0) {
                rows.entry(*own).or_default().slaves.push((*node, areas[j] * values[j]));
            }
        }
        for (node, area) in face.nodes.iter().zip(areas) {
            rows.entry(*node).or_default().area += area;
        }
    }
    rows
}

/// The pairs of rows all of whose slave nodes meet something; other nodes are unpaired. Areas are added to the report.
///
/// # Errors
/// Those of `pair`, which makes a pair of a node and its row.
pub(super) fn paired(
    (side, dim): (&Side<'_>, usize),
    mut report: SurfaceReport,
    meets: impl Fn(usize) -> bool,
    pair: impl Fn(usize, Row) -> Result<SurfacePair, Error>,
) -> Result<SurfacePairs, Error> {
    let mut found = SurfacePairs { dim, ..SurfacePairs::default() };
    for (node, row) in whole_rows(side) {
        report.slave_area += row.area;
        if row.slaves.iter().all(|(node, _)| meets(*node)) {
            report.covered_area += row.area;
            found.pairs.push(pair(node, row)?);
        } else {
            found.unpaired.push(node);
        }
    }
    Ok(SurfacePairs { report, ..found })
}

/// Nodal values that are one at a node each.
pub(super) fn unit_values(nodes: usize) -> impl Iterator<Item = Values> {
    (0..nodes).map(|node| {
        let mut values = [0.0; MOST_NODES];
        values[node] = 1.0;
        values
    })
}
