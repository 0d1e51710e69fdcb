//! The structures by which a host hands over surfaces and obstacles.

use super::args::At;
use super::guard::Outcome;
use crate::surface::{Faces, Obstacle};

/// A half space, in 2D a half plane.
pub const SIGNORINI_OBSTACLE_PLANE: i32 = 0;
/// A round bar of any length, 3D only.
pub const SIGNORINI_OBSTACLE_CYLINDER: i32 = 1;
/// A ball, in 2D a disc.
pub const SIGNORINI_OBSTACLE_SPHERE: i32 = 2;
/// A mesh of faces, such as the triangles of a drawing; in 2D lines.
pub const SIGNORINI_OBSTACLE_FACES: i32 = 3;
/// A cone that widens from its apex without end, 3D only.
pub const SIGNORINI_OBSTACLE_CONE: i32 = 4;
/// A torus, 3D only.
pub const SIGNORINI_OBSTACLE_TORUS: i32 = 5;

/// Faces of a surface as lists of nodes: in 2D lines of 2 or 3 nodes; in 3D triangles of 3 or 6 and
/// quadrilaterals of 4, 8 or 9 nodes, in any mixture. Corners come first, in order around the face,
/// then mid nodes, the first one between the first two corners, then the centre. Seen from outside
/// the body the corners run counterclockwise; in 2D the body lies to the left of a line that runs
/// from its first node to its second.
#[repr(C)]
pub struct SignoriniFaces {
    /// sizeof(signorini_faces).
    pub struct_size: u32,
    /// Nodes of each face, if start is NULL; else 0.
    pub face_nodes: i32,
    /// Number of faces.
    pub count: i64,
    /// Start of each face in nodes, count + 1 entries from index_base; NULL: all have face_nodes
    /// nodes.
    pub start: *const i64,
    /// The nodes, counted from index_base.
    pub nodes: *const i64,
}

/// A surface that does not deform, or the true shape of a side. Unused numbers are not read.
#[repr(C)]
pub struct SignoriniObstacle {
    /// sizeof(signorini_obstacle).
    pub struct_size: u32,
    /// SIGNORINI_OBSTACLE_...
    pub kind: i32,
    /// A point of the plane or of the cylinder's axis, or the centre; in 2D two entries. Cone: the
    /// middle of one of its circles.
    pub point: [f64; 3],
    /// Plane: the direction out of the obstacle. Cylinder: its axis. Of any length. Cone: from point
    /// to the apex. Torus: its axis, as long as the radius of the circle in the middle of its tube.
    pub direction: [f64; 3],
    /// Radius of the cylinder, of the sphere, of that circle of the cone, or of the torus' tube.
    pub radius: f64,
    /// Nonzero: the body is inside, as in a bore or a bowl.
    pub hollow: i32,
    /// 0.
    pub reserved: i32,
    /// Faces: number of nodes of the obstacle's own mesh.
    pub nodes: i64,
    /// Faces: dim for each node of the obstacle; length.
    pub coordinates: *const f64,
    /// Faces: in nodes of the obstacle, from index_base. Seen from the body that may touch them the
    /// corners run counterclockwise; in 2D the obstacle lies to the left of a line.
    pub faces: *const SignoriniFaces,
}

impl SignoriniFaces {
    /// Start and nodes of the faces, counted from 0.
    pub(super) fn read(at: At<'_>, pointer: *const Self, base: i64) -> Outcome<[Vec<usize>; 2]> {
        let given = at.whole(pointer)?;
        let count = at.field("count").size(given.count)?;
        let too_many = || at.refuse_part(format!("{count} faces are too many"));
        let start = if given.start.is_null() {
            let each = at.field("face_nodes").size(given.face_nodes.into())?;
            if count > 0 && each == 0 {
                return at.refuse_part("start is NULL and face_nodes is 0: set one of them");
            }
            if count.checked_mul(each).is_none_or(|nodes| isize::try_from(nodes).is_err()) {
                return too_many();
            }
            (0..=count).map(|face| face * each).collect()
        } else {
            if given.face_nodes != 0 {
                return at.refuse_part("start is given, and face_nodes too: set it to 0");
            }
            let Some(entries) = count.checked_add(1) else { return too_many() };
            let start = at.named("start").required(given.start, entries)?;
            at.field("start").shifted(start, base)?
        };
        // The last start tells the number of nodes.
        let nodes = at.named("nodes").required(given.nodes, start[count])?;
        Ok([start, at.field("nodes").shifted(nodes, base)?])
    }

    pub(super) fn view([start, nodes]: &[Vec<usize>; 2]) -> Faces<'_> {
        Faces { start, nodes }
    }
}

impl SignoriniObstacle {
    /// A shape that is no mesh.
    pub(super) fn shape(&self, at: At<'_>, dim: usize) -> Outcome<Obstacle> {
        at.check_reserved(self.reserved)?;
        let in_dim = |mut v: [f64; 3]| {
            v[dim..].fill(0.0);
            v
        };
        let (point, direction) = (in_dim(self.point), in_dim(self.direction));
        let (radius, hollow) = (self.radius, self.hollow != 0);
        let shape = match self.kind {
            SIGNORINI_OBSTACLE_PLANE => Obstacle::Plane { point, outward: direction },
            SIGNORINI_OBSTACLE_CYLINDER => {
                Obstacle::Cylinder { point, axis: direction, radius, hollow }
            }
            SIGNORINI_OBSTACLE_SPHERE => Obstacle::Sphere { centre: point, radius, hollow },
            SIGNORINI_OBSTACLE_CONE => Obstacle::Cone { point, to_apex: direction, radius, hollow },
            SIGNORINI_OBSTACLE_TORUS => {
                let ring = direction.iter().fold(0.0, |length: f64, x| length.hypot(*x));
                let (centre, axis) = (point, direction);
                Obstacle::Torus { centre, axis, radius, ring, hollow }
            }
            SIGNORINI_OBSTACLE_FACES => {
                return at.refuse_part("faces are no shape that gaps are measured to");
            }
            other => return at.refuse_part(format!("there is no kind {other}")),
        };
        Ok(shape)
    }

    /// Coordinates and faces of a mesh.
    pub(super) fn mesh<'a>(
        &self,
        at: At<'a>,
        dim: usize,
        base: i64,
    ) -> Outcome<(&'a [f64], [Vec<usize>; 2])> {
        at.check_reserved(self.reserved)?;
        let nodes = at.field("nodes").size(self.nodes)?;
        let Some(length) = nodes.checked_mul(dim) else {
            return at.refuse_part(format!("nodes is {nodes}, too large"));
        };
        let coordinates = at.field("coordinates").required(self.coordinates, length)?;
        Ok((coordinates, SignoriniFaces::read(at.named("obstacle: faces"), self.faces, base)?))
    }
}
