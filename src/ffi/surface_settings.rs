//! How a host wants surfaces to be paired.

use libc::c_void;

use super::args::{At, c_entry};
use super::guard::Outcome;
use super::numbers::{Numbered, numbers};
use super::settings::{ParsedSettings, SignoriniProgressFn, SignoriniSettings};
use super::structures::Structure;
use super::surface::SignoriniObstacle;
use crate::linalg::vector3::vector;
use crate::surface::{
    NodeDofs, Normals, Pairing, Rims, Sector, SurfaceSettings, SymmetryPlane, TrueShape,
};

/// Dual mortar, the default: a uniform pressure passes between any two flat meshes.
pub const SIGNORINI_PAIRING_DUAL_MORTAR: i32 = 0;
/// Each slave node against the point that it meets along its normal. Forces and moments balance;
/// the pressure between meshes that do not match is wrong by some percent.
pub const SIGNORINI_PAIRING_NODE_TO_SURFACE: i32 = 1;

/// The default: the mean of the unit normals of all slave faces at the slave node. Dual mortar:
/// without faces around a sharp edge that lie over nothing.
pub const SIGNORINI_NORMALS_AVERAGED: i32 = 0;
/// Normals of the faces in contact. Dual mortar: the mean at the slave node over the faces that lie
/// over the master, weighted by the node's area there; around a sharp edge other faces do not turn
/// it. Nodes against surfaces: opposite to the normal of the nearest master face, at the foot of
/// the perpendicular on it; above an edge without one, of the face that the averaged normal meets.
/// Of faces that are equally near it is the mean, where that normal meets them.
/// The choice does not change which nodes have pairs.
pub const SIGNORINI_NORMALS_FACES: i32 = 1;

/// The default. A slave node with less than half of its area over the master, a corner of a face
/// with mid nodes with less than three tenths, gives its row to the nodes of its faces whose covered
/// parts are nearest; if none can take it, it keeps it. Its area is that on all slave faces around
/// it that look the same way. Uniform pressure stays exact, and others are as exact as
/// elsewhere. Where a master is so small or narrow that few nodes have half, and on one line in
/// 3D, nodes with a tenth keep their rows, or as many with less as carry moments. For dual mortar:
/// nodes against surfaces have no cover, and take the default alone.
pub const SIGNORINI_RIMS_FOLD: i32 = 0;
/// They keep pairs of their own with small areas. Uniform pressure stays exact; other pressures may
/// be large there, as the rows reach into the air. Below a millionth they are folded all the same.
pub const SIGNORINI_RIMS_KEEP: i32 = 1;
/// As SIGNORINI_RIMS_FOLD, of all nodes with less than three tenths of their area: more pairs
/// resolve the rim, and pressures that are not uniform have up to twice the errors there.
pub const SIGNORINI_RIMS_FOLD_LITTLE: i32 = 2;

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
    /// Default 0. Then surfaces overlap by the size of the largest slave face at most, the largest
    /// distance of two of its nodes, and not through the body behind the slave face. Open surfaces
    /// are paired up to that size too, or if that is larger to the radius of the smaller side, the
    /// largest distance of a node from the mean of its nodes, with mirror images and all sectors:
    /// half the diagonal of a rectangle. Of masters behind each other the nearest counts, and over
    /// a step or an edge of the master the nearer part alone. An obstacle without faces has no
    /// limit.
    pub search_distance: f64,
    /// Number of the first node, degree of freedom and entry of start, 0 or 1, here and in the
    /// pairs; default 0. Take that of your matrix.
    pub index_base: i32,
    /// Degrees of freedom of each node, such as 6, the first dim of which are its displacements;
    /// default 0: dim. Not read if node_dofs is given.
    pub dofs_per_node: i32,
    /// Displacements of each node, dim for each; default NULL: dofs_per_node * node + axis.
    pub node_dofs: *const i64,
    /// Number of planes of symmetry of a half or quarter model; default 0. Pairs see the mirror
    /// images of both sides, and are those of the whole body. A pair whose slave node stands on a
    /// plane neither moves nor carries a force across it, and its normal is in the plane. Fix the
    /// nodes on the plane across it as without contact. Where a row reaches beyond a plane, and in
    /// sectors, rows have row_vectors, not row_weights.
    pub symmetry_planes: i64,
    /// The axis across each plane, counted from index_base.
    pub symmetry_axes: *const i32,
    /// Where each plane stands along its axis; length.
    pub symmetry_at: *const f64,
    /// SIGNORINI_NORMALS_...; default SIGNORINI_NORMALS_AVERAGED.
    pub normals: i32,
    /// SIGNORINI_RIMS_...; default SIGNORINI_RIMS_FOLD.
    pub rims: i32,
    /// Nonzero: lines in 2D are meridians of bodies of revolution about the axis x = 0, with the
    /// radius x >= 0. Areas are those of whole rings, with the factor 2 pi r: hand over stiffness
    /// and loads of whole rings too. The axis is a plane of symmetry without being named.
    /// Default 0.
    pub axisymmetric: i32,
    /// Nonzero: a side without slave_shape or master_shape is curved through its nodes, by normals
    /// that are fitted to the nodes around, and to their images at planes of symmetry; where faces
    /// turn by more than 35 degrees it stays sharp.
    /// Default 0.
    pub fitted: i32,
    /// Most seconds of wall time; default 0, and infinity: no limit.
    pub time_limit: f64,
    /// Progress callback as in signorini_settings, called often; default NULL.
    pub progress: SignoriniProgressFn,
    /// First argument of progress; default NULL.
    pub user: *mut c_void,
    /// The true shape of the slave side, of which its faces are facets, for dual mortar; default
    /// NULL: its faces, or as fitted says. Gaps are measured to it, and rows stay those of the
    /// faces. These tell on which side the body is: hollow has no say.
    pub slave_shape: *const SignoriniObstacle,
    /// That of the master side.
    pub master_shape: *const SignoriniObstacle,
    /// Gaps of at most this size, open or overlapping, become zero; length; default 0: none.
    pub close_within: f64,
    /// What is added to every gap then: a clearance, or if it is negative an interference, such as
    /// half the thicknesses of shells; length; default 0.
    pub clearance: f64,
    /// The direction across each plane of symmetry, dim for each, of any length, along which
    /// symmetry_at counts from the origin. Default NULL: symmetry_axes. Of nodes on a skewed plane
    /// give u . m = 0 as equations.
    pub symmetry_normals: *const f64,
    /// The number of sectors of a body that repeats about an axis, of which the mesh is one; default
    /// 0: none. Pairs see the neighbours, and are those of the whole body. The nodes of the second
    /// boundary are images of those of the first, u = Q u', which you give as equations; the pair of
    /// both is at the first. A right-handed turn about the axis leads from the first to the second.
    pub sectors: i64,
    /// A point of the axis, dim coordinates.
    pub sector_point: *const f64,
    /// The direction of the axis, 3 entries, of any length; in 2D not read.
    pub sector_axis: *const f64,
    /// In 3D the direction of first tangents, as nearly as the tangent plane of each pair allows,
    /// of any length: the angle of orthotropic friction counts from it. Default 0, 0, 0: the axis
    /// most across the normals of all pairs, of equal ones the first; where the normal is along it,
    /// the axis most across that. At a plane of symmetry one tangent is across the plane.
    pub tangent: [f64; 3],
    /// In the place of sectors, of a body that repeats along a line: the way from the first boundary
    /// of the mesh to the second, dim entries; default 0, 0, 0: none. Displacements of both are the
    /// same, which you give as equations.
    pub period: [f64; 3],
    /// The way along a second line, of a body that repeats along two; default 0, 0, 0: none.
    pub second_period: [f64; 3],
    /// Nonzero, for surfaces that are tied: rows keep rigid turns of both bodies, also where facets
    /// of curved sides do not fit. Forces of pairs then balance in moments too, and rows have
    /// row_vectors, not row_weights. Default 0.
    pub keep_turns: i32,
    /// 0.
    pub reserved: i32,
    /// Number of degrees of freedom that are fixed, and of those that equations derive from fixed
    /// ones alone; default 0. Give them with dual mortar where supports hold both sides in one
    /// place: a slave node that they hold along its normal, over masters some of which they hold,
    /// then has no pair, as at rims. Its force would be any number. It keeps its pair where all
    /// around it is held, as of a die, and three tenths of its masters move, and rests where they
    /// hold all of these. Of a penetration gaps have the part that moves; where nothing does, it is
    /// refused.
    pub n_fixed: i64,
    /// These degrees of freedom, numbered as for signorini_model_new_sparse.
    pub fixed: *const i64,
}

/// How the host numbers nodes and degrees of freedom.
#[derive(Clone, PartialEq)]
pub(super) struct Numbering {
    pub(super) base: i64,
    pub(super) dofs: NodeDofs,
}

// SAFETY: led by its size; numbers, pointers and a callback.
unsafe impl Structure for SignoriniSurfaceSettings {
    fn default_one() -> Self {
        SignoriniSurfaceSettings {
            pairing: SIGNORINI_PAIRING_DUAL_MORTAR,
            normals: SIGNORINI_NORMALS_AVERAGED,
            rims: SIGNORINI_RIMS_FOLD,
            ..Self::zeros()
        }
    }
}

impl SignoriniSurfaceSettings {
    /// Reads the caller's structure, NULL for the defaults, for `nodes` nodes of `dim` coordinates: settings, the limit of time
    /// with the callback, and the numbering.
    pub(super) fn read(
        at: At<'_>,
        pointer: *const Self,
        (dim, nodes): (usize, usize),
    ) -> Outcome<(SurfaceSettings, ParsedSettings, Numbering)> {
        let given = at.copy(pointer)?;
        at.check_reserved(given.reserved)?;
        let pairing = at.chosen("pairing", given.pairing)?;
        let normals = at.chosen("choice of normals", given.normals)?;
        let rims = at.chosen("choice of rims", given.rims)?;
        let base = at.index_base(given.index_base)?;
        let per_node = match given.dofs_per_node {
            0 => dim,
            other => usize::try_from(other).unwrap_or_default(),
        };
        if per_node < dim {
            let told = given.dofs_per_node;
            let wrong = format!("is {told}, it must be 0 or at least dim {dim}");
            return at.field("dofs_per_node").refuse(wrong);
        }
        // The coordinates have as many entries.
        let dofs = at.named("node_dofs").optional(given.node_dofs, dim * nodes)?;
        let dofs = match dofs {
            Some(dofs) => NodeDofs::Listed(at.field("node_dofs").shifted(dofs, base)?),
            None => NodeDofs::PerNode(per_node),
        };
        let symmetry = given.symmetry(at, dim)?;
        let settings = SurfaceSettings {
            pairing,
            search_distance: Some(given.search_distance).filter(|distance| *distance != 0.0),
            symmetry,
            sector: given.sector(at, dim)?,
            normals,
            rims,
            axisymmetric: given.axisymmetric != 0,
            shapes: [
                given.shape(at.named("settings: slave_shape"), dim, given.slave_shape)?,
                given.shape(at.named("settings: master_shape"), dim, given.master_shape)?,
            ],
            close_within: given.close_within,
            clearance: given.clearance,
            tangent: Some(given.tangent).filter(|along| along.iter().any(|part| *part != 0.0)),
            keep_turns: given.keep_turns != 0,
            supports: dofs.held(&given.fixed(at, base)?, (nodes, dim)),
        };
        let limits = SignoriniSettings {
            time_limit: given.time_limit,
            progress: given.progress,
            user: given.user,
            ..SignoriniSettings::default_one()
        };
        let limits = limits.parsed(at)?;
        Ok((settings, limits, Numbering { base, dofs }))
    }

    /// The degrees of freedom that supports hold.
    fn fixed(&self, at: At<'_>, base: i64) -> Outcome<Vec<usize>> {
        let count = at.field("n_fixed").size(self.n_fixed)?;
        at.field("fixed").indices(self.fixed, count, base)
    }

    /// The true shape of a side.
    fn shape(&self, at: At<'_>, dim: usize, given: *const SignoriniObstacle) -> Outcome<TrueShape> {
        if given.is_null() {
            let fitted = self.fitted != 0;
            return Ok(if fitted { TrueShape::Fitted } else { TrueShape::Facets });
        }
        Ok(TrueShape::Exact(at.whole(given)?.shape(at, dim)?))
    }

    /// The planes of symmetry.
    fn symmetry(&self, at: At<'_>, dim: usize) -> Outcome<Vec<SymmetryPlane>> {
        let count = at.field("symmetry_planes").size(self.symmetry_planes)?;
        let entries = count.saturating_mul(dim);
        let normals = at.field("symmetry_normals").optional(self.symmetry_normals, entries)?;
        let axes = match normals {
            Some(_) => &[],
            None => at.field("symmetry_axes").required(self.symmetry_axes, count)?,
        };
        let places = at.field("symmetry_at").required(self.symmetry_at, count)?;
        let across: Vec<[f64; 3]> = match normals {
            Some(normals) => {
                normals.chunks_exact(dim).map(|normal| vector(normal).into()).collect()
            }
            None => self.across(at.field("symmetry_axes"), axes, dim)?,
        };
        let plane = |(normal, &at)| SymmetryPlane { normal, at };
        Ok(across.into_iter().zip(places).map(plane).collect())
    }

    /// Directions along axes.
    fn across(&self, at: At<'_>, axes: &[i32], dim: usize) -> Outcome<Vec<[f64; 3]>> {
        let base = i64::from(self.index_base);
        let across = |(k, &given): (usize, &i32)| match usize::try_from(i64::from(given) - base) {
            Ok(axis) if axis < dim => Ok(SymmetryPlane::across(axis, 0.0).normal),
            Ok(_) => at.refuse_part(format!(
                "plane of symmetry {}: there is no axis {given}, the last one is {}",
                k as i64 + base,
                dim as i64 - 1 + base
            )),
            Err(_) => at.refuse(format!("has {given}, there is no such axis")),
        };
        axes.iter().enumerate().map(across).collect()
    }

    /// The sector.
    fn sector(&self, at: At<'_>, dim: usize) -> Outcome<Option<Sector>> {
        let count = at.field("sectors").size(self.sectors)?;
        let periods = [self.period, self.second_period];
        match (count, periods.as_flattened().iter().any(|part| *part != 0.0)) {
            (0, false) => return Ok(None),
            (0, true) => return Ok(Some(Sector { periods, ..Sector::default() })),
            (_, false) => {}
            (_, true) => return at.refuse_part("has sectors and a period: leave one of them out"),
        }
        let point = vector(at.field("sector_point").required(self.sector_point, dim)?).into();
        let axis = match dim {
            2 => [0.0, 0.0, 1.0],
            _ => vector(at.field("sector_axis").required(self.sector_axis, 3)?).into(),
        };
        Ok(Some(Sector { point, axis, count, ..Sector::default() }))
    }
}

numbers! {
    Pairing {
        DualMortar = SIGNORINI_PAIRING_DUAL_MORTAR,
        NodeToSurface = SIGNORINI_PAIRING_NODE_TO_SURFACE,
    }
}

numbers! {
    Normals { Averaged = SIGNORINI_NORMALS_AVERAGED, Faces = SIGNORINI_NORMALS_FACES }
}

numbers! { Rims { Fold = SIGNORINI_RIMS_FOLD, Keep = SIGNORINI_RIMS_KEEP, FoldLittle = SIGNORINI_RIMS_FOLD_LITTLE } }

/// Fills settings with their defaults; struct_size is sizeof(signorini_surface_settings).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_surface_settings_default(
    settings: *mut SignoriniSurfaceSettings,
    struct_size: u32,
) -> i32 {
    c_entry!(|arrays| { arrays.at(1, "settings").fill(settings, struct_size) })
}
