//! From rows of slave nodes to pairs; and the rows of faces that count as covered wholly.

use std::collections::BTreeMap;

use super::control::Edges;
use super::mesh::Side;
use super::pairs::{SurfacePair, SurfacePairs, SurfaceReport, without_rounding};
use super::row::{Row, add_face};
use super::symmetry::OnPlanes;
use crate::error::Error;
use crate::linalg::vector3::Vector3;

/// The pair of a slave node and its row, in the planes of symmetry on which the node stands. The gap is that between the
/// points of both sides, and 0 without masters.
pub(super) fn pair_of_row(
    [slave, master]: [&Side<'_>; 2],
    planes: &OnPlanes,
    (node, row): (usize, Row),
    normal: Vector3,
) -> SurfacePair {
    let (area, normal) = (row.area, planes.turned(node, normal));
    let (nodes, slave_count) = row.into_nodes();
    let point = slave.point(&nodes[..slave_count]);
    let gap = match &nodes[slave_count..] {
        [] => 0.0,
        masters => {
            let opposite = master.point(masters);
            let size = normal.abs().dot(&(opposite.abs() + point.abs()));
            without_rounding(normal.dot(&(opposite - point)), size)
        }
    };
    SurfacePair {
        slave: node,
        nodes,
        slave_count,
        turns: Vec::new(),
        point: point.into(),
        normal: normal.into(),
        // They follow once all normals are known.
        tangents: Default::default(),
        gap,
        measured_gap: gap,
        area,
    }
}

/// The pairs of rows; slave nodes without a row are unpaired. The number of slave faces and the covered area are added to
/// the report.
///
/// # Errors
/// Those of `pair`, which makes a pair of a node and its row; what stops the pairing.
pub(super) fn pairs_of_rows(
    slave: &Side<'_>,
    rows: BTreeMap<usize, Row>,
    mut report: SurfaceReport,
    pair: impl Fn(usize, Row) -> Result<SurfacePair, Error>,
) -> Result<SurfacePairs, Error> {
    let kept = |(node, row)| {
        slave.progress.goes_on()?;
        pair(node, row)
    };
    let pairs: Vec<SurfacePair> = rows.into_iter().map(kept).collect::<Result<_, Error>>()?;
    report.slave_faces = slave.count();
    report.covered_area = pairs.iter().map(|pair| pair.area).sum();
    let mut unpaired = slave.all_nodes();
    slave.progress.goes_on()?;
    let mut next = pairs.iter().peekable();
    unpaired.retain(|node| next.next_if(|pair| pair.slave == *node).is_none());
    Ok(SurfacePairs { dim: slave.dim, pairs, unpaired, report, ..SurfacePairs::default() })
}

/// The slave's part of the rows all of whose slave nodes meet something, as if every face were covered wholly. The area of
/// the host's faces is added to the report.
///
/// # Errors
/// What stops the pairing.
pub(super) fn whole_rows(
    meets: impl Fn(usize) -> bool,
    side: &Side<'_>,
    report: &mut SurfaceReport,
) -> Result<BTreeMap<usize, Row>, Error> {
    let mut edges = Edges::default();
    for face in side.each_face() {
        let (_, face) = face?;
        edges.add(face.kind, face.nodes, !face.is_at_axis());
    }
    let mut rows: BTreeMap<usize, Row> = BTreeMap::new();
    for face in side.each_face() {
        let (at, face) = face?;
        let basis = edges.basis(face.kind, face.nodes, true);
        let (on, integrals) = ((face.nodes, &basis), ([face.integrals(); 2], Default::default()));
        report.slave_area += side.own_area(at, integrals.0[0]);
        add_face(&mut rows, on, integrals, std::iter::empty(), Default::default());
    }
    rows.retain(|_, row| row.slaves().all(|(node, _)| meets(node)));
    Ok(rows)
}
