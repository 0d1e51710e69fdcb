//! Settings of the pairing.

use super::exact_shape::Obstacle;
use super::sector::Sector;
use crate::error::{Argument, Error, index};
use crate::linalg::tolerances::NEGLIGIBLE;
use crate::linalg::vector3::{self, Vector3, unit};

/// How the rows are made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pairing {
    /// Dual mortar: a uniform pressure passes between any two flat meshes.
    #[default]
    DualMortar,
    /// Each slave node against the point of the master that it meets along its normal, with the
    /// master's shape functions as weights. Forces and moments balance; the pressure between meshes that
    /// do not match is wrong by some percent.
    NodeToSurface,
}

/// The normal of a pair.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Normals {
    /// The mean of the unit normals of all slave faces at the slave node: it varies smoothly over meshes of
    /// curved surfaces. By dual mortar without faces around a sharp edge that lie over nothing.
    #[default]
    Averaged,
    /// The normal of the faces in contact. By dual mortar the mean of the unit normals at the node of the slave faces that
    /// lie over the master, by the node's share of the area that does: faces around a sharp edge that face
    /// nothing do not turn it. Nodes against surfaces: opposite to the normal of the master face that the node stands
    /// nearest to, at the foot of the perpendicular; beyond an edge of the master, where there is no foot,
    /// that of the face which the averaged normal meets, where it meets it; of several faces that are equally near the mean of their
    /// normals, where the averaged normal meets them. Which nodes have pairs does not depend on it.
    Faces,
}

/// The treatment of slave nodes at rims: those that have less than half of their area, corners of faces with mid nodes less
/// than three tenths, on all slave faces around them that look the same way, over the master. Of dual mortar; nodes against surfaces have no cover.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rims {
    /// Each gives its row to a node of its own faces; if none can take it, it keeps it. Uniform pressure stays exact. Where
    /// a master is so small or narrow that the others could not carry moments, nodes with a tenth keep their rows, or as many with
    /// less as can.
    #[default]
    Fold,
    /// Those alone that have less than three tenths: pressures at the rim are resolved by more pairs, and those that are not
    /// uniform have up to twice the errors there.
    FoldLittle,
    /// They keep pairs of their own, with small areas. Uniform pressure stays exact, but under others the
    /// pressures of these nodes may be large, and their rows hold points in the air by masters beside them. With
    /// less than a millionth of cover, where a row would be rounding, they are folded all the same.
    Keep,
}

/// The true shape of a side, to which gaps are measured. Rows, areas and normals are those of its faces.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum TrueShape {
    /// Its faces.
    #[default]
    Facets,
    /// A shape near all its nodes. Its faces tell where the body is: `hollow` and `outward` have no say.
    Exact(Obstacle),
    /// Curves and patches through its nodes, with normals that are fitted to the nodes around. Edges at which faces turn by
    /// more than 35 degrees stay sharp.
    Fitted,
}

/// A plane of symmetry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SymmetryPlane {
    /// The direction across it, of any length.
    pub normal: [f64; 3],
    /// Where it stands along that direction, from the origin; length.
    pub at: f64,
}

impl SymmetryPlane {
    /// The plane across an axis, 0, 1 or 2.
    ///
    /// # Panics
    /// If there is no such axis.
    pub fn across(axis: usize, at: f64) -> SymmetryPlane {
        SymmetryPlane { normal: vector3::axis(axis).into(), at }
    }

    /// Its place for a message.
    pub(super) fn name(&self) -> String {
        let [x, y, z] = self.normal;
        let axis = (0..3).find(|&axis| self.normal == SymmetryPlane::across(axis, self.at).normal);
        let across =
            axis.map_or_else(|| format!("{x}, {y}, {z}"), |axis| format!("axis {}", index(axis)));
        format!("across {across} at {}", self.at)
    }

    /// The height of a point above it.
    pub(super) fn height(&self, normal: &Vector3, x: Vector3, scale: f64) -> f64 {
        normal.dot(&x) - scale * self.at
    }
}

/// Settings of the pairing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurfaceSettings {
    /// How the rows are made.
    pub pairing: Pairing,
    /// The largest distance along the normal at which surfaces are paired, open or overlapping. `None`: overlapping ones up
    /// to the size of the largest slave face, the largest distance of two of its nodes, and not through the body behind the
    /// slave face; open ones up to that size too, or if that is larger to the radius of the smaller side, the largest distance
    /// of a node from the mean of all of its nodes, with mirror images and all sectors, and of masters behind each other the
    /// nearest; against an obstacle without faces no limit. Over a step or an edge of the master a slave face is paired with the nearer part alone.
    pub search_distance: Option<f64>,
    /// Planes of symmetry of half and quarter models. Pairs see the mirror images of both sides, and are those of the whole
    /// body. A pair whose slave node stands on a plane neither moves nor carries a force across it, and its normal is in the
    /// plane.
    pub symmetry: Vec<SymmetryPlane>,
    /// The sector of a body that repeats about an axis or along a line, whose nodes on the second boundary are images of those on the first.
    /// Pairs see the neighbours, and are those of the whole body: of two nodes that are images of each other the first has the
    /// pair, and the host's displacements obey `u = Q u'`.
    pub sector: Option<Sector>,
    /// Nodes of both sides with an axis along which supports hold them, in any order. The row of a slave node that is held along
    /// its normal, as are some of its masters, goes to nodes up to three faces away that move, as at rims: all that is left of such a row
    /// are small weights of masters beside the support, which forces without end would pull at. Where the nodes beside it are held too, as
    /// of a die, it stays if three tenths of its masters move. Of dual mortar.
    pub supports: Vec<(usize, usize)>,
    /// Normals of the pairs.
    pub normals: Normals,
    /// The treatment of nodes with little cover.
    pub rims: Rims,
    /// `true`: lines of the plane are meridians of bodies of revolution about the axis `x = 0`, with the radius
    /// `x >= 0`. Areas are those of whole rings, `2 π ∫ r ds`, and so must be stiffness, loads and forces. The axis
    /// is a plane of symmetry without being named.
    pub axisymmetric: bool,
    /// The true shapes of slave and master. Of dual mortar.
    pub shapes: [TrueShape; 2],
    /// Gaps of at most this size, open or overlapping, become zero. 0: none.
    pub close_within: f64,
    /// What is added to every gap then: a clearance, or an interference if it is negative. Half the thicknesses of
    /// shells are an interference.
    pub clearance: f64,
    /// The direction that first tangents have in space, as nearly as the tangent plane of each pair allows, and from which the
    /// angle of orthotropic friction counts; of any length. `None`: the axis that is most across the normals of all pairs, of
    /// equal ones the first. A pair whose normal is along it has the axis that is most across its own normal. At
    /// a plane of symmetry one tangent is across the plane: the first is the nearer one.
    pub tangent: Option<[f64; 3]>,
    /// `true`: rows keep rigid turns of both bodies, whose facets do not fit: those of ties. Forces of the pairs balance in moments too,
    /// and rows have numbers by degree of freedom.
    pub keep_turns: bool,
}

impl SurfaceSettings {
    /// The gap of a pair from the measured one. Of sides within each other the part that moves counts: what supports hold there is not
    /// left to the rest.
    pub(super) fn gap(&self, measured: f64, moving: f64) -> f64 {
        let closed = measured.abs() <= self.close_within;
        let apart = self.clearance + if closed { 0.0 } else { measured };
        apart.max(moving * apart)
    }

    /// The settings, checked, with a unit vector as axis of the sector.
    ///
    /// # Errors
    /// A search distance that is not positive; a choice for rims where nodes have no cover; bodies of revolution in
    /// space, or of which a sector or turns are given; a sector that is none.
    pub(super) fn checked(&self, dim: usize) -> Result<SurfaceSettings, Error> {
        let refuse = |message: &str| Err(Error::invalid(Argument::Settings, message));
        // Written so that NaN is refused.
        if let Some(distance) = self.search_distance.filter(|distance| !(*distance > 0.0)) {
            return refuse(&format!("search_distance is {distance}, it must be positive"));
        }
        let of_rings = [
            (dim == 3, "axisymmetric: faces of bodies of revolution are lines, in 2 dimensions"),
            (
                self.keep_turns,
                "keep_turns: meridians of a body of revolution do not turn, leave it out",
            ),
            (
                self.sector.is_some(),
                "axisymmetric: a body of revolution has no sector, leave one of them out",
            ),
        ];
        if let Some((_, what)) =
            of_rings.iter().find(|(is_given, _)| self.axisymmetric && *is_given)
        {
            return refuse(what);
        }
        let symmetry = self.planes()?;
        let (within, shift) = (self.close_within, self.clearance);
        if !(within >= 0.0) {
            return refuse(&format!("close_within is {within}, it must not be negative"));
        }
        if !shift.is_finite() {
            return refuse(&format!("clearance is {shift}, it must be finite"));
        }
        if self.pairing == Pairing::NodeToSurface && self.shapes != [TrueShape::Facets; 2] {
            return refuse(
                "true shapes are for dual mortar: nodes against surfaces are measured where they stand",
            );
        }
        if self.pairing == Pairing::NodeToSurface && self.rims != Rims::Fold {
            return refuse(
                "rims: nodes against surfaces have no cover that a rim could be told by: leave the \
                           default, or pair by dual mortar",
            );
        }
        if let Some([x, y, z]) =
            self.tangent.filter(|along| dim == 3 && unit((*along).into()).is_none())
        {
            return refuse(&format!("tangent: {x}, {y}, {z} is no direction"));
        }
        let sector = self.sector.map(|sector| sector.checked(dim)).transpose()?;
        let mut supports = self.supports.clone();
        supports.sort_unstable();
        Ok(SurfaceSettings { sector, symmetry, supports, ..self.clone() })
    }

    /// True for a node that supports hold along a direction, of any length.
    pub(super) fn is_supported(&self, node: usize, along: Vector3) -> bool {
        let is_free = |axis: usize| self.supports.binary_search(&(node, axis)).is_err();
        let left = Vector3::from_fn(|axis, _| if is_free(axis) { along[axis] } else { 0.0 });
        left.norm() <= NEGLIGIBLE * along.norm()
    }

    /// The planes of symmetry. The axis of bodies of revolution is none of them: it need not be named.
    ///
    /// # Errors
    /// A plane that no body of revolution has.
    fn planes(&self) -> Result<Vec<SymmetryPlane>, Error> {
        let mut planes = self.symmetry.clone();
        if self.axisymmetric {
            let axis = |plane: &SymmetryPlane| plane.at == 0.0 && plane.normal[1] == 0.0;
            planes.retain(|plane| plane.normal[0] == 0.0 || !axis(plane));
            if let Some(plane) = planes.iter().find(|plane| plane.normal[0] != 0.0) {
                let message = format!(
                    "axisymmetric: a plane of symmetry {} is none of a body of revolution: its planes are across the axis x = 0, \
                     which itself need not be named",
                    plane.name()
                );
                return Err(Error::invalid(Argument::Settings, message));
            }
        }
        Ok(planes)
    }
}
