//! How far gaps scatter: what they have beside the polynomial of second degree that is nearest around each pair.
//!
//! True surfaces are smooth, and so is the distance between them. The rest is of the faces: inside of those that are curved two ways, where
//! edges do not tell it, of mid nodes beside the middle of their arcs, of fits; each pair carries it by weights of both signs, a corner of a
//! triangle with mid nodes enlarged by ten. [`super::facets`] tells in closed form what edges tell.

use super::digits::ON_PLANE;
use super::facets::{ALLOWED, Large, is_clear_of_digits};
use super::fitted_normals::SMOOTH;
use super::mesh::Side;
use super::pairs::{SurfacePair, SurfacePairs};
use super::settings::SurfaceSettings;
use crate::error::Error;
use crate::linalg::least_squares::Columns;
use crate::linalg::vector::norm;
use crate::linalg::vector3::Vector3;

/// Number of pairs whose interference scatters by more than it allows, and the most by which one does; `None`: these are few, or no pair has one.
///
/// # Errors
/// What stops the pairing.
pub(super) fn too_large(
    found: &SurfacePairs,
    (slave, settings): (&Side<'_>, &SurfaceSettings),
) -> Result<Option<(usize, f64)>, Error> {
    let depth = |pair: &SurfacePair| -settings.gap(pair.measured_gap, pair.moving);
    let depths: Vec<f64> = found.pairs.iter().map(depth).collect();
    if !depths.iter().any(|depth| *depth > 0.0) {
        return Ok(None);
    }
    let around = Around::of(slave, &found.pairs)?;
    let (mut large, mut of_all) = (Large::default(), 0.0);
    for (at, pair) in found.pairs.iter().enumerate() {
        slave.progress.goes_on()?;
        let scatter = around.scatter(at, (&found.pairs, slave.dim), &depths);
        let weight = pair.area * scatter;
        of_all += weight;
        if depths[at] > 0.0 && scatter > ALLOWED * depths[at] {
            large.add(scatter, weight);
        }
    }
    let is_told = large.is_many_of(of_all) && is_clear_of_digits(large.most, slave);
    Ok(is_told.then_some((large.count, large.most)))
}

/// The pairs whose nodes are around those of others.
struct Around<'a> {
    slave: &'a Side<'a>,
    /// The faces at each node.
    faces: Vec<Vec<usize>>,
    /// The pair of each node.
    pairs: Vec<Option<usize>>,
}

impl<'a> Around<'a> {
    fn of(slave: &'a Side<'a>, all: &[SurfacePair]) -> Result<Around<'a>, Error> {
        let count = slave.coordinates.len() / slave.dim;
        let (mut faces, mut pairs) = (vec![Vec::new(); count], vec![None; count]);
        for face in slave.each_face() {
            let (at, face) = face?;
            face.nodes.iter().for_each(|&node| faces[node].push(at));
        }
        all.iter().enumerate().for_each(|(at, pair)| pairs[pair.slave] = Some(at));
        Ok(Around { slave, faces, pairs })
    }

    /// The pairs at the faces around a node, and where these have no mid nodes at those around them.
    fn near(&self, node: usize) -> Vec<usize> {
        let has_mids = |&at: &usize| self.slave.corners(at).len() < self.slave.nodes(at).len();
        let rings = if self.faces[node].iter().any(has_mids) { 1 } else { 2 };
        let mut nodes = vec![node];
        for _ in 0..rings {
            let faces = nodes.iter().flat_map(|&node| &self.faces[node]);
            nodes = faces.flat_map(|&at| self.slave.nodes(at)).copied().collect();
            nodes.sort_unstable();
            nodes.dedup();
        }
        nodes.into_iter().filter_map(|node| self.pairs[node]).collect()
    }

    /// The root mean square of what is left of depths around a pair, for each degree of freedom that is left; where depths differ by
    /// little, by how much they do.
    fn scatter(&self, at: usize, (pairs, dim): (&[SurfacePair], usize), depths: &[f64]) -> f64 {
        let own = &pairs[at];
        let (origin, normal) = (Vector3::from(own.point), Vector3::from(own.normal));
        let mut near = self.near(own.slave);
        // Beyond a chamfer, where surfaces do not overlap, is another surface.
        near.retain(|&other| {
            (depths[other] > 0.0 || depths[at] <= 0.0)
                && normal.dot(&Vector3::from(pairs[other].normal)) > SMOOTH
        });
        let near_depths = || near.iter().map(|&other| depths[other]);
        let [least, most] =
            [near_depths().fold(depths[at], f64::min), near_depths().fold(depths[at], f64::max)];
        // No more is left than that: enough where it is little.
        if most - least <= ALLOWED * depths[at].abs() {
            return most - least;
        }
        let tangents = own.tangents.iter().take(dim - 1).map(|tangent| Vector3::from(*tangent));
        let along = |tangent: Vector3| {
            let place = |&other: &usize| tangent.dot(&(Vector3::from(pairs[other].point) - origin));
            near.iter().map(place).collect::<Vec<f64>>()
        };
        let mut columns = vec![vec![1.0; near.len()]];
        columns.extend(tangents.map(along));
        for (first, second) in (1..dim).flat_map(|one| (one..dim).map(move |two| (one, two))) {
            let product = columns[first].iter().zip(&columns[second]).map(|(a, b)| a * b);
            columns.push(product.collect());
        }
        let mut left: Vec<f64> = near_depths().collect();
        let degree = Columns::new(columns.into_iter(), ON_PLANE).take_out(&mut left).len();
        let free = near.len() - degree;
        if free > 0 { norm(&left) / (free as f64).sqrt() } else { 0.0 }
    }
}
