//! What became of the faces and nodes of a pairing, in numbers.

use crate::surface::SurfacePairs;

/// What became of the faces and nodes of a pairing. Set struct_size before the call; the call writes
/// all other fields.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SignoriniSurfaceReport {
    /// sizeof(signorini_surface_report) in your program; no more is written.
    pub struct_size: u32,
    /// Space dimension.
    pub dim: i32,
    /// Number of pairs.
    pub pairs: i64,
    /// Slave nodes without a pair: signorini_surface_unpaired.
    pub unpaired: i64,
    /// Of these, nodes with little cover whose row is in that of a neighbour:
    /// signorini_surface_folded.
    pub folded: i64,
    /// Slave faces.
    pub slave_faces: i64,
    /// Slave faces that lie over nothing (dual mortar): signorini_surface_uncovered.
    pub uncovered: i64,
    /// Area of the slave faces.
    pub slave_area: f64,
    /// The part of it that lies over the other side: the areas of all pairs.
    pub covered_area: f64,
    /// The search distance that was used.
    pub search_distance: f64,
    /// How often a master face was near a slave whose normal does not oppose the slave's. If there
    /// are no pairs, and this is not 0, one side is turned over.
    pub not_opposed: i64,
    /// Boxes that the search looked at: its cost.
    pub boxes_searched: i64,
    /// Pairs whose slave node stands on a plane of symmetry.
    pub on_symmetry: i64,
    /// Of the unpaired nodes those with little cover that SIGNORINI_RIMS_DROP has left out.
    pub dropped: i64,
}

impl SignoriniSurfaceReport {
    /// What is to be told of pairs.
    pub(super) fn of(found: &SurfacePairs) -> Self {
        let report = &found.report;
        SignoriniSurfaceReport {
            struct_size: size_of::<SignoriniSurfaceReport>() as u32,
            dim: found.dim as i32,
            pairs: found.pairs.len() as i64,
            unpaired: found.unpaired.len() as i64,
            folded: report.folded.len() as i64,
            slave_faces: report.slave_faces as i64,
            uncovered: report.uncovered_faces.len() as i64,
            slave_area: report.slave_area,
            covered_area: report.covered_area,
            search_distance: report.search_distance,
            not_opposed: report.not_opposed as i64,
            boxes_searched: report.boxes_searched as i64,
            on_symmetry: found.on_symmetry().count() as i64,
            dropped: report.dropped.len() as i64,
        }
    }
}
