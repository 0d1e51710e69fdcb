//! Contact pairs from two surfaces of a mesh, or from a surface and a rigid obstacle.
//!
//! In: coordinates, and the faces of two sides that may touch. Out: rows over nodes with their normals,
//! tangents, gaps and areas, and what found no partner. Lengths are in the host's unit.
//!
//! ```
//! use signorini::surface::{Faces, SurfaceSettings, Surfaces, pair_surfaces};
//!
//! // A line of one element, 0 to 1, stands on one of two elements.
//! let coordinates = [0.0, 0.1, 1.0, 0.1, -1.0, 0.0, 0.5, 0.0, 2.0, 0.0];
//! let slave = Faces { start: &[0, 2], nodes: &[0, 1] };
//! let master = Faces { start: &[0, 2, 4], nodes: &[4, 3, 3, 2] };
//! let surfaces = Surfaces { dim: 2, coordinates: &coordinates, slave, master };
//! let found = pair_surfaces(&surfaces, &SurfaceSettings::default())?;
//! assert_eq!(found.pairs.len(), 2);
//! assert!((found.pairs[0].gap - 0.1).abs() < 1e-15);
//! assert!((found.pairs[0].area - 0.5).abs() < 1e-15);
//! # Ok::<(), signorini::Error>(())
//! ```

mod bilinear;
mod candidates;
mod clip;
mod control;
mod face;
mod fields;
mod mesh;
mod mortar;
mod node_to_surface;
mod normals;
mod obstacle;
mod overlap;
mod pairs;
mod plane;
mod projected_shapes;
mod quadrature;
mod rigid;
mod rims;
mod row;
mod self_overlap;
mod settings;
mod shape;
mod symmetry;
mod tree;
mod whole_faces;

pub use fields::{NodalFields, PairResults, Resultant};
pub use mesh::{Faces, Surfaces};
pub use obstacle::{Obstacle, pair_with_obstacle};
pub use pairs::{NodeDofs, PairArrays, SurfacePair, SurfacePairs, SurfaceReport, Weight};
pub use rigid::{RigidSurface, pair_with_rigid_surface};
pub use settings::{Normals, Pairing, Rims, SurfaceSettings};
pub use shape::FaceKind;
pub use symmetry::SymmetryPlane;

#[cfg(doc)]
use crate::error::Argument;
use crate::error::Error;
use candidates::{Candidates, SearchFaces};
use mesh::Side;
use symmetry::OnPlanes;

/// Pairs two surfaces. Surfaces that never meet give no pairs, which is no error.
///
/// # Errors
/// - [`Argument::Dimension`], [`Argument::Coordinates`]: a dimension other than 2 and 3, coordinates that are
///   not finite;
/// - [`Argument::SlaveFaces`], [`Argument::MasterFaces`]: what is wrong with which face: number of nodes,
///   repeated or missing nodes, no area, folded, turned over against its neighbour, nodes on both
///   sides, faces of one side that lie upon each other, master faces over each other (of masters with
///   [`Pairing::DualMortar`] alone: otherwise the nearest counts);
/// - [`Argument::Settings`]: a search distance that is not positive; a plane of symmetry across no axis of the space,
///   with slave nodes on both sides, or with slave faces in it; a choice for rims with
///   [`Pairing::NodeToSurface`].
pub fn pair_surfaces(
    surfaces: &Surfaces<'_>,
    settings: &SurfaceSettings,
) -> Result<SurfacePairs, Error> {
    let [slave, master] = surfaces.sides()?;
    pair_sides([&slave, &master], surfaces.dim, settings)
}

fn pair_sides(
    [slave, master]: [&Side<'_>; 2],
    dim: usize,
    settings: &SurfaceSettings,
) -> Result<SurfacePairs, Error> {
    settings.check()?;
    let largest = || (0..slave.count()).map(|face| slave.face(face).size()).fold(0.0, f64::max);
    let reach = settings::reach(settings.search_distance, largest)?;
    let planes = OnPlanes::new(slave, dim, &settings.symmetry)?;
    self_overlap::check(slave, &SearchFaces::new(slave), dim, reach)?;
    let opposite = SearchFaces::new(master);
    if settings.pairing == Pairing::DualMortar {
        self_overlap::check(master, &opposite, dim, reach)?;
    }
    let candidates = Candidates::new(opposite, reach);
    let sides = [slave, master];
    match settings.pairing {
        Pairing::DualMortar => mortar::pairs(sides, dim, &planes, candidates, settings),
        Pairing::NodeToSurface => {
            node_to_surface::pairs(sides, dim, &planes, candidates, settings.normals)
        }
    }
}
