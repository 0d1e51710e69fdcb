//! A rigid obstacle whose surface is a mesh of its own: paired as a master is, and then left out of the
//! rows, as it does not move.

use super::mesh::{Faces, Side};
use super::pair_surfaces::pair_sides;
use super::pairs::{SurfacePair, SurfacePairs};
use super::settings::SurfaceSettings;
use crate::error::{Argument, Error};
use crate::monitor::Monitor;

/// A surface that does not deform, with coordinates of its own: triangles of a scan or of a drawing, or any
/// other faces.
#[derive(Clone, Copy, Debug)]
pub struct RigidSurface<'a> {
    /// Coordinates of its nodes, `dim` for each node.
    pub coordinates: &'a [f64],
    /// Its faces, in nodes of its own counted from 0; seen from the body that may touch them the corners
    /// run counterclockwise, in the plane the obstacle lies to the left of a line.
    pub faces: Faces<'a>,
}

/// Pairs a surface with a rigid one. Rows have slaves alone; gaps are those that two deformable surfaces of
/// the same places have.
///
/// # Errors
/// As [`super::pair_surfaces`]; what is wrong with the rigid surface has [`Argument::Obstacle`].
pub fn pair_with_rigid_surface(
    dim: usize,
    coordinates: &[f64],
    slave: Faces<'_>,
    rigid: &RigidSurface<'_>,
    settings: &SurfaceSettings,
    monitor: &mut Monitor<'_>,
) -> Result<SurfacePairs, Error> {
    let slave = Side::slave(dim, coordinates, slave)?;
    let RigidSurface { coordinates, faces } = *rigid;
    let obstacle = Side::new("obstacle", Argument::Obstacle, (dim, coordinates), faces)?;
    let found = pair_sides([slave, obstacle], dim, settings, monitor)?;
    let pairs = found.pairs.into_iter().map(SurfacePair::without_masters).collect();
    Ok(SurfacePairs { pairs, ..found })
}
