//! The structures by which a host hands over surfaces and obstacles, and how they are paired.

use super::args::{Arrays, size};
use super::guard::{self, Failure};
use super::sparse::shifted;
use super::structures;
use crate::surface::{Faces, Obstacle, Pairing, SurfaceSettings, SymmetryPlane};

/// Dual mortar, the default: a uniform pressure passes between any two flat meshes.
pub const SIGNORINI_PAIRING_DUAL_MORTAR: i32 = 0;
/// Each slave node against the point that it meets along its normal. Forces and moments balance;
/// the pressure between meshes that do not match is wrong by some percent.
pub const SIGNORINI_PAIRING_NODE_TO_SURFACE: i32 = 1;

/// A half space, in 2D a half plane.
pub const SIGNORINI_OBSTACLE_PLANE: i32 = 0;
/// A round bar of any length, 3D only.
pub const SIGNORINI_OBSTACLE_CYLINDER: i32 = 1;
/// A ball, in 2D a disc.
pub const SIGNORINI_OBSTACLE_SPHERE: i32 = 2;
/// A mesh of faces, such as the triangles of a drawing; in 2D lines.
pub const SIGNORINI_OBSTACLE_FACES: i32 = 3;

/// Faces of a surface as lists of nodes: in 2D lines of 2 or 3 nodes; in 3D triangles of 3 or 6 and
/// quadrilaterals of 4, 8 or 9 nodes, in any mixture. Corners come first, in order around the face,
/// then mid nodes, the first one between the first two corners, then the centre. Seen from outside
/// the body the corners run counterclockwise; in 2D the body lies to the left of a line that runs
/// from its first node to its second.
#[repr(C)]
pub struct SignoriniFaces {
    /// sizeof(signorini_faces).
    pub struct_size: u32,
    /// Number of nodes of each face, if start is NULL; else 0.
    pub face_nodes: i32,
    /// Number of faces.
    pub count: i64,
    /// Start of each face in nodes, count + 1 entries, counted from index_base; NULL: all faces
    /// have face_nodes nodes.
    pub start: *const i64,
    /// The nodes, counted from index_base.
    pub nodes: *const i64,
}

/// A surface that does not deform. Unused numbers are not read.
#[repr(C)]
pub struct SignoriniObstacle {
    /// sizeof(signorini_obstacle).
    pub struct_size: u32,
    /// SIGNORINI_OBSTACLE_...
    pub kind: i32,
    /// A point of the plane or of the cylinder's axis, or the centre; in 2D two entries are read.
    pub point: [f64; 3],
    /// Plane: the direction out of the obstacle. Cylinder: its axis. Of any length.
    pub direction: [f64; 3],
    /// Radius of the cylinder or the sphere.
    pub radius: f64,
    /// Nonzero: the body is inside, as in a bore or a bowl.
    pub hollow: i32,
    /// 0.
    pub reserved: i32,
    /// Faces: number of nodes of the obstacle's own mesh.
    pub nodes: i64,
    /// Faces: dim for each node of the obstacle; length.
    pub coordinates: *const f64,
    /// Faces: in nodes of the obstacle, counted from index_base. Seen from the body that may touch
    /// them the corners run counterclockwise; in 2D the obstacle lies to the left of a line.
    pub faces: *const SignoriniFaces,
}

/// An obstacle as the host gave it.
pub(super) enum Rigid<'a> {
    Shape(Obstacle),
    /// Coordinates and faces.
    Faces(&'a [f64], [Vec<usize>; 2]),
}

/// How surfaces are paired. Fill it by signorini_surface_settings_default(), then change what you
/// like.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SignoriniSurfaceSettings {
    /// sizeof(signorini_surface_settings).
    pub struct_size: u32,
    /// SIGNORINI_PAIRING_...; default SIGNORINI_PAIRING_DUAL_MORTAR.
    pub pairing: i32,
    /// Largest distance along the normal at which surfaces are paired, open or overlapping; length.
    /// Default 0: the size of the largest slave face; against an obstacle that is not of faces no
    /// limit, as +infinity.
    pub search_distance: f64,
    /// 0 or 1: the number of the first node, of the first entry of start and of the first degree of
    /// freedom, here and in what the pairs tell; default 0. Take the one of your matrix.
    pub index_base: i32,
    /// Degrees of freedom of each node, of which the first dim are its displacements, such as 6;
    /// default 0: dim. Not read if node_dofs is given.
    pub dofs_per_node: i32,
    /// Degrees of freedom of each node, dim for each, counted from index_base; default NULL:
    /// dofs_per_node * node + axis.
    pub node_dofs: *const i64,
    /// Number of planes of symmetry of a half or quarter model; default 0. A pair whose slave node
    /// stands on one neither moves nor carries a force across it, as in the whole body, and its
    /// normal is in the plane. Fix the nodes on the plane across it as without contact.
    pub symmetry_planes: i64,
    /// The axis across each plane, counted from index_base.
    pub symmetry_axes: *const i32,
    /// Where each plane stands along its axis; length.
    pub symmetry_at: *const f64,
}

impl SignoriniFaces {
    /// Start and nodes of the faces, counted from 0.
    ///
    /// # Safety
    /// The structure and its arrays are as the header demands.
    pub(super) unsafe fn read(
        (position, name): (i32, &str),
        pointer: *const Self,
        base: i64,
    ) -> Result<[Vec<usize>; 2], Failure> {
        let refuse = |message: String| Err(Failure::argument(position, message));
        // SAFETY: by the caller's contract.
        let given = unsafe { structures::whole(position, name, pointer)? };
        let count = size(position, &format!("{name}: count"), given.count)?;
        let mut arrays = Arrays::default();
        let start = if given.start.is_null() {
            let each = size(position, &format!("{name}: face_nodes"), given.face_nodes.into())?;
            if count > 0 && each == 0 {
                return refuse(format!(
                    "{name}: start is NULL and face_nodes is 0: set one of them"
                ));
            }
            if count.checked_mul(each).is_none_or(|nodes| isize::try_from(nodes).is_err()) {
                return refuse(format!("{name}: {count} faces are too many"));
            }
            (0..=count).map(|face| face * each).collect()
        } else {
            if given.face_nodes != 0 {
                return refuse(format!("{name}: start is given, and face_nodes too: set it to 0"));
            }
            let Some(entries) = count.checked_add(1) else {
                return refuse(format!("{name}: {count} faces are too many"));
            };
            // SAFETY: as above.
            let start = unsafe { arrays.required(position, "start", given.start, entries)? };
            shifted(position, &format!("{name}: start"), start, base)?
        };
        // SAFETY: as above; the last start tells the number of nodes.
        let nodes = unsafe { arrays.required(position, "nodes", given.nodes, start[count])? };
        Ok([start, shifted(position, &format!("{name}: nodes"), nodes, base)?])
    }

    pub(super) fn view([start, nodes]: &[Vec<usize>; 2]) -> Faces<'_> {
        Faces { start, nodes }
    }
}

impl SignoriniObstacle {
    /// # Safety
    /// The structure is as the header demands.
    pub(super) unsafe fn read<'a>(
        position: i32,
        dim: usize,
        base: i64,
        pointer: *const Self,
    ) -> Result<Rigid<'a>, Failure> {
        // SAFETY: by the caller's contract.
        let given = unsafe { structures::whole(position, "obstacle", pointer)? };
        if given.kind == SIGNORINI_OBSTACLE_FACES {
            // SAFETY: as above.
            return unsafe { given.mesh(position, dim, base) };
        }
        let in_dim = |mut v: [f64; 3]| {
            v[dim..].fill(0.0);
            v
        };
        let (point, direction) = (in_dim(given.point), in_dim(given.direction));
        let (radius, hollow) = (given.radius, given.hollow != 0);
        let shape = match given.kind {
            SIGNORINI_OBSTACLE_PLANE => Obstacle::Plane { point, outward: direction },
            SIGNORINI_OBSTACLE_CYLINDER => {
                Obstacle::Cylinder { point, axis: direction, radius, hollow }
            }
            SIGNORINI_OBSTACLE_SPHERE => Obstacle::Sphere { centre: point, radius, hollow },
            other => {
                let message = format!("obstacle: there is no kind {other}");
                return Err(Failure::argument(position, message));
            }
        };
        Ok(Rigid::Shape(shape))
    }

    /// # Safety
    /// The structure's arrays are as the header demands.
    unsafe fn mesh<'a>(&self, position: i32, dim: usize, base: i64) -> Result<Rigid<'a>, Failure> {
        let nodes = size(position, "obstacle: nodes", self.nodes)?;
        let Some(length) = nodes.checked_mul(dim) else {
            let message = format!("obstacle: nodes is {nodes}, too large");
            return Err(Failure::argument(position, message));
        };
        // SAFETY: by the caller's contract.
        unsafe {
            let name = "obstacle: coordinates";
            let coordinates =
                Arrays::default().required(position, name, self.coordinates, length)?;
            let faces = SignoriniFaces::read((position, "obstacle: faces"), self.faces, base)?;
            Ok(Rigid::Faces(coordinates, faces))
        }
    }
}

/// Settings of a pairing as the host gave them.
pub(super) struct Received {
    pub(super) settings: SurfaceSettings,
    pub(super) base: i64,
    /// Degrees of freedom of each node if they are in order.
    pub(super) per_node: usize,
    /// Or all of them.
    pub(super) listed: Option<Vec<usize>>,
}

impl SignoriniSurfaceSettings {
    fn default_one() -> Self {
        SignoriniSurfaceSettings {
            struct_size: size_of::<Self>() as u32,
            pairing: SIGNORINI_PAIRING_DUAL_MORTAR,
            search_distance: 0.0,
            index_base: 0,
            dofs_per_node: 0,
            node_dofs: std::ptr::null(),
            symmetry_planes: 0,
            symmetry_axes: std::ptr::null(),
            symmetry_at: std::ptr::null(),
        }
    }

    /// Reads the caller's structure, NULL for the defaults, for `nodes` nodes of `dim` coordinates.
    ///
    /// # Safety
    /// The structure and its array are as the header demands.
    pub(super) unsafe fn read(
        position: i32,
        pointer: *const Self,
        (dim, nodes): (usize, usize),
    ) -> Result<Received, Failure> {
        let refuse = |message: String| Err(Failure::argument(position, message));
        let mut given = Self::default_one();
        if !pointer.is_null() {
            // SAFETY: by the caller's contract.
            given = unsafe { structures::read(position, "settings", pointer, given)? };
        }
        let pairing = match given.pairing {
            SIGNORINI_PAIRING_DUAL_MORTAR => Pairing::DualMortar,
            SIGNORINI_PAIRING_NODE_TO_SURFACE => Pairing::NodeToSurface,
            other => return refuse(format!("settings: there is no pairing {other}")),
        };
        let base = i64::from(given.index_base);
        if base != 0 && base != 1 {
            return refuse(format!("settings: index_base is {base}, it must be 0 or 1"));
        }
        let per_node = match given.dofs_per_node {
            0 => dim,
            other => usize::try_from(other).unwrap_or_default(),
        };
        if per_node < dim {
            let told = given.dofs_per_node;
            return refuse(format!(
                "settings: dofs_per_node is {told}, it must be 0 or at least dim {dim}"
            ));
        }
        // SAFETY: an array of `dim` for each node by contract; the coordinates have as many.
        let dofs = unsafe {
            Arrays::default().optional(position, "node_dofs", given.node_dofs, dim * nodes)?
        };
        let listed = match dofs {
            Some(dofs) => Some(shifted(position, "settings: node_dofs", dofs, base)?),
            None => None,
        };
        let search_distance = Some(given.search_distance).filter(|distance| *distance != 0.0);
        // SAFETY: arrays of as many entries as there are planes, by contract.
        let symmetry = unsafe { given.symmetry(position)? };
        let settings = SurfaceSettings { pairing, search_distance, symmetry };
        Ok(Received { settings, base, per_node, listed })
    }

    /// The planes of symmetry.
    ///
    /// # Safety
    /// The structure's arrays are as the header demands.
    unsafe fn symmetry(&self, position: i32) -> Result<Vec<SymmetryPlane>, Failure> {
        let count = size(position, "settings: symmetry_planes", self.symmetry_planes)?;
        let mut arrays = Arrays::default();
        // SAFETY: by the caller's contract.
        let (axes, places) = unsafe {
            let name = "settings: symmetry_axes";
            let axes = arrays.required(position, name, self.symmetry_axes, count)?;
            let name = "settings: symmetry_at";
            (axes, arrays.required(position, name, self.symmetry_at, count)?)
        };
        let plane = |(&axis, &at): (&i32, &f64)| {
            let counted = i64::from(axis) - i64::from(self.index_base);
            let Ok(axis) = usize::try_from(counted) else {
                let message = format!("settings: symmetry_axes has {axis}, there is no such axis");
                return Err(Failure::argument(position, message));
            };
            Ok(SymmetryPlane { axis, at })
        };
        axes.iter().zip(places).map(plane).collect()
    }
}

/// Fills settings with their defaults and sets struct_size.
///
/// @param settings     not NULL
/// @param struct_size  sizeof(signorini_surface_settings); no more than that is written
/// @return 0, or -1 or -2 for the argument that is wrong
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_surface_settings_default(
    settings: *mut SignoriniSurfaceSettings,
    struct_size: u32,
) -> i32 {
    guard::call(|| {
        let default = SignoriniSurfaceSettings::default_one();
        // SAFETY: the caller's structure has `struct_size` bytes, as the header demands.
        unsafe { structures::fill("settings", settings, struct_size, &default)? };
        Ok(0)
    })
}
