//! The content of pairs from surfaces, as one structure.

use libc::c_char;

use super::args::c_entry;
use super::pairs::SignoriniPairs;
use super::structures::address;
use super::surface_new::SignoriniSurfacePairs;

/// Pairs from surfaces, and the faces and nodes without any. Arrays live as long as the pairs; one
/// without entries is NULL. Nodes and faces are counted from index_base.
#[repr(C)]
pub struct SignoriniSurfaceData {
    /// sizeof(signorini_surface_data).
    pub struct_size: u32,
    /// Space dimension.
    pub dim: i32,
    /// Number of pairs.
    pub pairs: i64,
    /// The pairs for signorini_model_new_sparse, as general rows.
    pub rows: *const SignoriniPairs,
    /// Initial gap of each pair; length; negative where the surfaces overlap.
    pub gaps: *const f64,
    /// Area of each pair; its pressure is -F_n over this area.
    pub areas: *const f64,
    /// Unit normals, dim for each pair, outward from the slave's body.
    pub normals: *const f64,
    /// First unit tangents, dim for each pair; in 3D as settings.tangent says, and t2 = n x t1.
    pub tangents: *const f64,
    /// Where the force of each pair acts on the slave's body, dim for each.
    pub points: *const f64,
    /// The slave node of each pair, ascending in each zone.
    pub nodes: *const i64,
    /// Number of slave nodes without a pair: nothing lies over them, or they are folded.
    pub n_unpaired: i64,
    /// These nodes.
    pub unpaired: *const i64,
    /// Number of those whose row is in pairs of nodes of their faces, for their little cover.
    pub n_folded: i64,
    /// Each of these nodes with the nearest such neighbour, 2 entries for each.
    pub folded: *const i64,
    /// Number of slave faces that lie over nothing within the search distance.
    pub n_uncovered: i64,
    /// These faces.
    pub uncovered: *const i64,
    /// One sentence on what was found, ASCII text for a log.
    pub summary: *const c_char,
    /// Number of slave faces.
    pub slave_faces: i64,
    /// Area of the slave faces.
    pub slave_area: f64,
    /// The part of it that lies over the other side: the areas of all pairs.
    pub covered_area: f64,
    /// The largest open distance that was looked at; summary names that of overlaps.
    pub search_distance: f64,
    /// How often a master face was near a slave with a normal that does not oppose the slave's. If
    /// it is not 0 and there are no pairs, one side is turned over.
    pub not_opposed: i64,
    /// Boxes that the search looked at: its cost.
    pub boxes_searched: i64,
    /// Pairs whose slave node stands on a plane of symmetry.
    pub on_symmetry: i64,
    /// Number of slave faces that lie over nothing within the search distance, but point at a master
    /// beyond it, or overlap one by more: contact there is not seen. Give a larger search_distance
    /// if it may come to it.
    pub n_beyond: i64,
    /// These faces.
    pub beyond: *const i64,
    /// How far away the nearest master is, one for each of them; length; negative where they
    /// overlap.
    pub beyond_distances: *const f64,
    /// The distance between a folded node and its neighbour, one for each; length.
    pub folded_distances: *const f64,
    /// Number of zones that signorini_surface_join has joined; else 0. Lists of faces are those of
    /// each zone's own pairs then, and empty here.
    pub n_zones: i64,
    /// The first pair of each zone, counted from 0, and the number of all pairs: n_zones + 1.
    pub zone_start: *const i64,
    /// Friction for SIGNORINI_LAW_BY_PAIR, 4 numbers for each pair: the law of its zone and its
    /// parameters.
    pub friction: *const f64,
}

/// Fills data, whose struct_size you set. Its arrays live as long as the pairs.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_surface_view(
    contact: *const SignoriniSurfacePairs,
    data: *mut SignoriniSurfaceData,
) -> i32 {
    c_entry!(|arrays| {
        let shown = arrays.at(1, "contact").handle(contact)?.shown();
        arrays.at(2, "data").out_structure(data)?.write(0, &shown);
        Ok(0)
    })
}

impl SignoriniSurfacePairs {
    fn shown(&self) -> SignoriniSurfaceData {
        let (arrays, report) = (&self.arrays, &self.found.report);
        SignoriniSurfaceData {
            struct_size: size_of::<SignoriniSurfaceData>() as u32,
            dim: self.found.dim as i32,
            pairs: arrays.count as i64,
            rows: &raw const self.rows,
            gaps: address(&arrays.gaps),
            areas: address(&arrays.areas),
            normals: address(&arrays.normals),
            tangents: address(&arrays.tangents),
            points: address(&self.points),
            nodes: address(&self.slaves),
            n_unpaired: self.unpaired.len() as i64,
            unpaired: address(&self.unpaired),
            n_folded: report.folded.len() as i64,
            folded: address(&self.folded),
            n_uncovered: self.uncovered.len() as i64,
            uncovered: address(&self.uncovered),
            summary: self.summary.as_ptr(),
            slave_faces: report.slave_faces as i64,
            slave_area: report.slave_area,
            covered_area: report.covered_area,
            search_distance: report.search_distance,
            not_opposed: report.not_opposed as i64,
            boxes_searched: report.boxes_searched as i64,
            on_symmetry: self.found.on_symmetry().count() as i64,
            n_beyond: report.beyond.len() as i64,
            beyond: address(&self.beyond),
            beyond_distances: address(&self.beyond_distances),
            folded_distances: address(&self.folded_distances),
            n_zones: self.zones.names.len() as i64,
            zone_start: address(&self.zones.starts),
            friction: address(&self.zones.friction),
        }
    }
}
