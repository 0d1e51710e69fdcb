//! Contact pairs from surfaces: made, released, and told about; and slave nodes that move onto the other side, once.

use std::ffi::CString;
use std::mem::take;
use std::ptr::null;
use std::sync::Arc;

use super::args::{Arrays, c_entry};
use super::guard::Outcome;
use super::handle::release;
use super::pairs::SignoriniPairs;
use super::settings::ParsedSettings;
use super::structures::{Structure, address};
use super::surface::{SIGNORINI_OBSTACLE_FACES, SignoriniFaces, SignoriniObstacle};
use super::surface_settings::{Numbering, SignoriniSurfaceSettings};
use crate::error::{Argument, Error, Message};
use crate::monitor::Monitor;
use crate::problem;
use crate::settings::Settings;
use crate::surface::{
    KeptSurfaces, Master, PairArrays, SurfacePairs, SurfaceSettings, Surfaces, pair_surfaces,
};

/// Contact pairs that the library made from surfaces. It does not change: several threads may use
/// one at once. It holds copies: your arrays may go once it is made. signorini_surface_free
/// releases it.
pub struct SignoriniSurfacePairs {
    pub(super) found: Arc<SurfacePairs>,
    /// Both sides, of joined pairs those of each zone.
    pub(super) kept: Vec<Kept>,
    /// Nodes of the host.
    pub(super) nodes: usize,
    pub(super) numbering: Numbering,
    /// Start and nodes of the slave faces; none of joined pairs.
    pub(super) slave_faces: [Vec<usize>; 2],
    pub(super) zones: JoinedZones,
    pub(super) arrays: PairArrays,
    pub(super) points: Vec<f64>,
    pub(super) slaves: Vec<i64>,
    pub(super) unpaired: Vec<i64>,
    pub(super) uncovered: Vec<i64>,
    pub(super) folded: Vec<i64>,
    pub(super) folded_distances: Vec<f64>,
    pub(super) beyond: Vec<i64>,
    pub(super) beyond_distances: Vec<f64>,
    pub(super) summary: CString,
    pub(super) rows: SignoriniPairs,
    /// Memory that `rows` points to beside `arrays`.
    _indices: [Vec<i64>; 2],
}

/// The sides of a zone, with its own pairs.
#[derive(Clone)]
pub(super) struct Kept {
    pub(super) pairs: Arc<SurfacePairs>,
    pub(super) surfaces: Arc<KeptSurfaces>,
}

// SAFETY: the pointers of `rows` are to arrays that the pairs hold themselves and nobody changes.
unsafe impl Send for SignoriniSurfacePairs {}
// SAFETY: as above.
unsafe impl Sync for SignoriniSurfacePairs {}

/// Makes contact pairs from two surfaces that may touch. signorini_surface_view shows them.
///
/// Surfaces that never meet are no error: there are no pairs, and data.summary says why. Faces of
/// one side that lie upon each other are refused, as their area would count twice; those of masters
/// with SIGNORINI_PAIRING_DUAL_MORTAR alone. Then a slave face is refused too if masters lie over
/// each other above it; without a search_distance of yours only if they are no further apart than
/// the size of the largest slave face.
///
/// @param dim          space dimension, 2 or 3
/// @param nodes        number of nodes of your mesh
/// @param coordinates  dim for each node, of all nodes; length
/// @param slave        the side whose nodes become slaves, each with a pressure; better the coarser
///                     one: pressures of a finer one follow the other side's facets
/// @param master       the other side; its nodes must not be on the slave side
/// @param settings     NULL: the defaults
/// @param contact      out: the pairs; NULL unless 0 is returned
/// @return the status; signorini_last_error names side, face and node
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_surface_pair(
    dim: i32,
    nodes: i64,
    coordinates: *const f64,
    slave: *const SignoriniFaces,
    master: *const SignoriniFaces,
    settings: *const SignoriniSurfaceSettings,
    contact: *mut *mut SignoriniSurfacePairs,
) -> i32 {
    c_entry!(|arrays| {
        let place = arrays.at(7, "contact").out_pointer(contact)?;
        let host = Host::read(arrays, (dim, nodes, coordinates), slave, settings)?;
        let base = host.numbering.base;
        let at = arrays.at(5, "master").is(Argument::MasterFaces);
        let master = SignoriniFaces::read(at, master, base)?;
        let pairs = host.pairs(Master::Faces(SignoriniFaces::view(&master)));
        place.fill(pairs.map_err(arrays.refused(SLAVE))?)
    })
}

/// Makes contact pairs from a surface and a rigid obstacle. Nodes may lie on either side of the
/// obstacle's surface: the gap is negative inside. An obstacle of faces is paired as a master is,
/// with the same search distance; its nodes are its own.
///
/// @param dim,nodes,coordinates  as for signorini_surface_pair
/// @param slave     the faces that may touch the obstacle
/// @param obstacle  the obstacle
/// @param settings  NULL: the defaults; pairing, normals, rims, symmetry_... and master_shape are
///                  for faces alone. slave_shape and fitted tell where mid nodes on chords belong
/// @param contact   out: the pairs; NULL unless 0 is returned
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_surface_pair_obstacle(
    dim: i32,
    nodes: i64,
    coordinates: *const f64,
    slave: *const SignoriniFaces,
    obstacle: *const SignoriniObstacle,
    settings: *const SignoriniSurfaceSettings,
    contact: *mut *mut SignoriniSurfacePairs,
) -> i32 {
    c_entry!(|arrays| {
        let place = arrays.at(7, "contact").out_pointer(contact)?;
        let host = Host::read(arrays, (dim, nodes, coordinates), slave, settings)?;
        let at = arrays.at(5, "obstacle").is(Argument::MasterFaces).is(Argument::Obstacle);
        let given = at.whole(obstacle)?;
        let pairs = if given.kind == SIGNORINI_OBSTACLE_FACES {
            let base = host.numbering.base;
            let (coordinates, faces) = given.mesh(at, host.dim, base)?;
            let faces = SignoriniFaces::view(&faces);
            host.pairs(Master::RigidFaces { coordinates, faces })
        } else {
            let shape = given.shape(at, host.dim)?;
            host.pairs(Master::RigidShape(shape))
        };
        place.fill(pairs.map_err(arrays.refused(SLAVE))?)
    })
}

/// Releases pairs. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_surface_free(contact: *mut SignoriniSurfacePairs) {
    // SAFETY: NULL, or by the header's contract it came from signorini_surface_pair..., once.
    unsafe { release(contact) }
}

/// Moves slave nodes so that the two points of each pair meet, as little as that takes; of pairs
/// whose points are no further apart than `within`. A tie of curved sides then follows a rigid turn
/// but for little; rows with settings.keep_turns follow it wholly.
/// Of an obstacle the point is where the measured gap ends: close_within and clearance have no say.
/// Assemble your matrix with the moved nodes, and pair again. Where single pairs of quadratic faces
/// count, pair and move a second time before: a tenth is left of the largest.
///
/// @param contact      the pairs
/// @param within       largest distance that is closed, also +infinity; length
/// @param coordinates  in: those that were paired, dim for each node; out: moved
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_surface_adjust(
    contact: *const SignoriniSurfacePairs,
    within: f64,
    coordinates: *mut f64,
) -> i32 {
    c_entry!(|arrays| {
        let contact = arrays.at(1, "contact").handle(contact)?;
        let length = contact.found.dim * contact.nodes;
        let place = arrays.at(3, "coordinates").output(coordinates, length)?;
        let mut moved = place.read();
        let monitor = &mut Monitor::new(&Settings::default(), None);
        arrays.at(2, "within").is(Argument::Settings);
        contact.found.adjust(within, &mut moved, monitor).map_err(arrays.refused(3))?;
        place.write(&moved);
        Ok(0)
    })
}

/// Number of the slave's faces among the arguments of both calls.
const SLAVE: i32 = 4;

/// Arguments that both calls have.
struct Host<'h> {
    dim: usize,
    coordinates: &'h [f64],
    slave: [Vec<usize>; 2],
    settings: SurfaceSettings,
    limits: ParsedSettings,
    numbering: Numbering,
}

impl<'h> Host<'h> {
    fn read(
        arrays: &'h Arrays,
        (dim, nodes, coordinates): (i32, i64, *const f64),
        slave: *const SignoriniFaces,
        settings: *const SignoriniSurfaceSettings,
    ) -> Outcome<Self> {
        let dim = problem::checked_dim(dim).map_err(arrays.refused(1))?;
        let at_nodes = arrays.at(2, "nodes");
        let nodes = at_nodes.size(nodes)?;
        let Some(length) = nodes.checked_mul(dim) else {
            return at_nodes.refuse(format!("is {nodes}, too large"));
        };
        let at_coordinates = arrays.at(3, "coordinates").is(Argument::Coordinates);
        let coordinates = at_coordinates.required(coordinates, length)?;
        let at_settings = arrays.at(6, "settings").is(Argument::Settings);
        let (settings, limits, numbering) =
            SignoriniSurfaceSettings::read(at_settings, settings, (dim, nodes))?;
        let slave = SignoriniFaces::read(arrays.at(SLAVE, "slave"), slave, numbering.base)?;
        Ok(Host { dim, coordinates, slave, settings, limits, numbering })
    }

    fn pairs(self, master: Master<'_>) -> Result<SignoriniSurfacePairs, Error> {
        let Host { dim, coordinates, slave, settings, limits, numbering } = self;
        let faces = SignoriniFaces::view(&slave);
        let surfaces = Surfaces { dim, coordinates, slave: faces, master };
        let (found, kept) = limits.monitored(|monitor| {
            let found = pair_surfaces(&surfaces, &settings, monitor)?;
            Ok((found, KeptSurfaces::new(&surfaces, settings.clearance)))
        })?;
        let zones = JoinedZones { summary: found.summary(), ..JoinedZones::default() };
        let pairs = SignoriniSurfacePairs::new(found, coordinates.len() / dim, numbering, zones);
        let kept = Kept { pairs: Arc::clone(&pairs.found), surfaces: Arc::new(kept) };
        Ok(SignoriniSurfacePairs { kept: vec![kept], slave_faces: slave, ..pairs })
    }
}

/// The zones of joined pairs, as they hold them; none of pairs that were not joined.
#[derive(Default)]
pub(super) struct JoinedZones {
    pub(super) names: Vec<String>,
    /// The first pair of each zone, and their number.
    pub(super) starts: Vec<i64>,
    /// Four numbers a pair.
    pub(super) friction: Vec<f64>,
    pub(super) summary: Message,
}

impl SignoriniSurfacePairs {
    /// Pairs without faces, of so many nodes of the host.
    pub(super) fn new(
        found: SurfacePairs,
        nodes: usize,
        numbering: Numbering,
        zones: JoinedZones,
    ) -> Self {
        let base = numbering.base;
        // In the memory of the given list.
        let counted = |values: Vec<usize>| -> Vec<i64> {
            values.into_iter().map(|value| value as i64 + base).collect()
        };
        let mut arrays = found.rows_on(&numbering.dofs);
        let indices =
            [&mut arrays.master_start, &mut arrays.masters].map(|list| counted(take(list)));
        let slaves: Vec<usize> = found.pairs.iter().map(|pair| pair.slave).collect();
        let points = found.pairs.iter().flat_map(|pair| &pair.point[..found.dim]).copied();
        let folds = &found.report.folded;
        let folded: Vec<usize> = folds.iter().flat_map(|fold| [fold.node, fold.into]).collect();
        let (beyond, beyond_distances): (Vec<usize>, _) =
            found.report.beyond.iter().copied().unzip();
        let summary = &zones.summary;
        let summary = if base == 1 { summary.counted_from_one() } else { summary.to_string() };
        let by_dof = !arrays.vectors.is_empty();
        let rows = SignoriniPairs {
            dim: found.dim as i32,
            count: found.pairs.len() as i64,
            normals: arrays.normals.as_ptr(),
            tangents: arrays.tangents.as_ptr(),
            row_start: indices[0].as_ptr(),
            row_nodes: indices[1].as_ptr(),
            row_weights: if by_dof { null() } else { arrays.weights.as_ptr() },
            row_vectors: address(&arrays.vectors),
            ..SignoriniPairs::zeros()
        };
        SignoriniSurfacePairs {
            slaves: counted(slaves),
            unpaired: counted(found.unpaired.clone()),
            uncovered: counted(found.report.uncovered_faces.clone()),
            folded: counted(folded),
            folded_distances: folds.iter().map(|fold| fold.distance).collect(),
            beyond: counted(beyond),
            beyond_distances,
            points: points.collect(),
            summary: CString::new(summary).unwrap_or_default(),
            rows,
            _indices: indices,
            nodes,
            numbering,
            slave_faces: [vec![0], Vec::new()],
            zones,
            arrays,
            found: Arc::new(found),
            kept: Vec::new(),
        }
    }

    /// Degrees of freedom of all nodes of the host, `dim` for each.
    pub(super) fn dofs(&self) -> Vec<usize> {
        let Numbering { dofs, .. } = &self.numbering;
        (0..self.nodes).flat_map(|node| dofs.of(node, self.found.dim)).collect()
    }
}
