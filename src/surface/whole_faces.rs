//! Rows of slave nodes whose faces count as covered wholly.

use std::collections::BTreeMap;

use super::control::Edges;
use super::mesh::Side;
use super::pairs::{SurfacePair, SurfacePairs, SurfaceReport};
use super::row::{Row, add_face};
use super::symmetry::OnPlanes;
use super::watch::Watch;
use crate::error::Error;

/// The slave's part of the rows of all nodes, as if every face were covered wholly.
fn whole_rows(
    side: &Side<'_>,
    planes: &OnPlanes,
    watch: &mut Watch<'_, '_>,
) -> Result<BTreeMap<usize, Row>, Error> {
    let faces = || (0..side.count()).map(|face| side.face(face));
    let mut edges = Edges::default();
    for face in faces() {
        watch.goes_on()?;
        edges.add(face.kind, face.nodes, !planes.touch_axis(&face));
    }
    let mut rows: BTreeMap<usize, Row> = BTreeMap::new();
    for face in faces() {
        watch.goes_on()?;
        let basis = edges.basis(face.kind, face.nodes, true);
        let (on, integrals) = ((face.nodes, &basis), [face.integrals(); 2]);
        add_face(
            &mut rows,
            on,
            integrals,
            std::iter::empty(),
            (&Default::default(), Default::default()),
        );
    }
    Ok(rows)
}

/// The pairs of rows all of whose slave nodes meet something; other nodes are unpaired. Areas are added to the report.
///
/// # Errors
/// Those of `pair`, which makes a pair of a node and its row; what ends the watch.
pub(super) fn paired(
    (side, dim, planes): (&Side<'_>, usize, &OnPlanes),
    mut report: SurfaceReport,
    meets: impl Fn(usize) -> bool,
    pair: impl Fn(usize, Row) -> Result<SurfacePair, Error>,
    watch: &mut Watch<'_, '_>,
) -> Result<SurfacePairs, Error> {
    let mut found = SurfacePairs { dim, ..SurfacePairs::default() };
    for (node, row) in whole_rows(side, planes, watch)? {
        watch.goes_on()?;
        report.slave_area += row.area;
        if row.slaves().all(|(node, _)| meets(node)) {
            report.covered_area += row.area;
            found.pairs.push(pair(node, row)?);
        } else {
            found.unpaired.push(node);
        }
    }
    Ok(SurfacePairs { report, ..found })
}
