//! The content of a model, as one structure.

use super::args::c_entry;
use super::model::SignoriniModel;
use super::numbers::{Numbered, numbers};
use super::structures::address;
use crate::model::ModelKind;

/// A condensed stiffness matrix K.
pub const SIGNORINI_MODEL_STIFFNESS: i32 = 0;
/// Factors of the sparse stiffness matrix.
pub const SIGNORINI_MODEL_FULL_SPACE: i32 = 1;
/// Your products and solutions.
pub const SIGNORINI_MODEL_OPERATOR: i32 = 2;
/// The flexibility form, d = W F + q.
pub const SIGNORINI_MODEL_FLEXIBILITY: i32 = 3;

numbers! {
    ModelKind {
        Stiffness = SIGNORINI_MODEL_STIFFNESS,
        FullSpace = SIGNORINI_MODEL_FULL_SPACE,
        Operator = SIGNORINI_MODEL_OPERATOR,
        Flexibility = SIGNORINI_MODEL_FLEXIBILITY,
    }
}

/// The content of a model.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SignoriniModelData {
    /// sizeof(signorini_model_data).
    pub struct_size: u32,
    /// Space dimension.
    pub dim: i32,
    /// Number of pairs.
    pub pairs: i64,
    /// H.
    pub host_size: i64,
    /// Number of fixed degrees of freedom.
    pub fixed: i64,
    /// Most bytes that a load case may take beside the model and your arrays. A call works on up to
    /// 32 cases at once, each with some more vectors of H entries.
    pub memory: i64,
    /// SIGNORINI_MODEL_...
    pub kind: i32,
    /// Number of pairs whose rows follow from other pairs or supports.
    pub dependent: i32,
    /// Stiffness in relative displacements, N columns of N entries. NULL if kind is not
    /// SIGNORINI_MODEL_STIFFNESS, or pairs depend on each other.
    pub K: *const f64,
    /// Frames of the pairs, to turn d and F to global axes: normal and tangents, unit vectors of
    /// dim entries, vector = n d_n + t d_t. NULL: you condensed in frames of your own.
    pub frames: *const f64,
}

/// Fills data, whose struct_size you set. Its arrays live as long as the model.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_model_view(
    model: *const SignoriniModel,
    data: *mut SignoriniModelData,
) -> i32 {
    c_entry!(|arrays| {
        let model = arrays.model(model)?;
        let shown = SignoriniModelData {
            struct_size: size_of::<SignoriniModelData>() as u32,
            dim: model.dim() as i32,
            pairs: model.pairs() as i64,
            host_size: model.host_size() as i64,
            fixed: model.fixed_count() as i64,
            memory: i64::try_from(model.memory()).unwrap_or(i64::MAX),
            kind: model.kind().number(),
            dependent: i32::try_from(model.dependent_pairs().len()).unwrap_or(i32::MAX),
            K: address(model.stiffness()),
            frames: model.frames().map_or(std::ptr::null(), address),
        };
        arrays.out_structure(2, "data", data)?.write(0, &shown);
        Ok(0)
    })
}
