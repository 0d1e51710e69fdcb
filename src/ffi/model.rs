//! The handle of a model, its content, and the way from relative displacements and contact forces back to the host.

use std::ptr::null;
use std::sync::Mutex;

use super::args::{Arrays, c_entry};
use super::case_arguments::times;
use super::guard::{self, Outcome};
use super::numbers::{Numbered, numbers};
use super::structures::address;
use crate::error::Argument;
use crate::model::{Model, ModelKind, Past};
use crate::reduce::SolvedCase;

/// A structure reduced to its contact pairs, for all load cases.
pub struct SignoriniModel {
    pub(super) model: Model,
    /// The result that calls with SIGNORINI_START_PREVIOUS have left; nothing while one is at work.
    past: Mutex<Option<Past>>,
}

impl From<Model> for SignoriniModel {
    fn from(model: Model) -> Self {
        SignoriniModel { model, past: Mutex::new(None) }
    }
}

impl SignoriniModel {
    /// Puts what is left for further calls, and returns what earlier ones have left.
    #[inline(never)] // tests/c/helgrind.supp names it
    pub(super) fn replace_past(&self, past: Option<Past>) -> Option<Past> {
        // A call that ends early, by a shortage of memory too, has nothing in hand. No call waits for the lock: after
        // a fork it may belong to a thread that is not there.
        self.past.try_lock().map_or(None, |mut place| std::mem::replace(&mut place, past))
    }
}

impl Arrays {
    /// The first argument, a model.
    pub(super) fn model(&self, model: *const SignoriniModel) -> Outcome<&SignoriniModel> {
        guard::prepare_thread()?;
        self.at(1, "model").is(Argument::Matrix).handle(model)
    }
}

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
    /// Number of pairs whose rows (nearly) follow from other pairs or supports.
    pub dependent: i32,
    /// Stiffness in relative displacements, N columns of N entries. NULL if kind is not
    /// SIGNORINI_MODEL_STIFFNESS, or pairs depend on each other.
    pub K: *const f64,
    /// Frames of the pairs, to turn d and F to global axes: normal and tangents, unit vectors of
    /// dim entries, vector = n d_n + t d_t. NULL: you condensed in frames of your own.
    pub frames: *const f64,
}

/// Fills data. Its arrays live as long as the model.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_model_view(
    model: *const SignoriniModel,
    data: *mut SignoriniModelData,
) -> i32 {
    c_entry!(|arrays| {
        let model = &arrays.model(model)?.model;
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
            frames: model.frames().map_or(null(), address),
        };
        arrays.at(2, "data").out_structure(data)?.write(0, &shown);
        Ok(0)
    })
}

/// Your displacements from the relative ones; many cases cost less in one call. If u overflows in a
/// case, those before it may be written.
///
/// @param model,cases,prescribed  as for signorini_model_solve
/// @param f  nodal loads, H a case; NULL: zero, as for a motion of escape
/// @param d  relative displacements, N a case
/// @param u  out: displacements, H a case
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_model_recover(
    model: *const SignoriniModel,
    cases: i64,
    f: *const f64,
    prescribed: *const f64,
    d: *const f64,
    u: *mut f64,
) -> i32 {
    c_entry!(|arrays| {
        let model = &arrays.model(model)?.model;
        let cases = arrays.at(2, "cases").size(cases)?;
        let (host, fixed) = (model.host_size(), model.fixed_count());
        let n = model.dim() * model.pairs();
        let lengths = (times(cases, host)?, times(cases, fixed)?, times(cases, n)?);
        let at = |position, name| arrays.at(position, name).matrix();
        let load = at(3, "f").is(Argument::Load).optional(f, lengths.0)?;
        let at_values = at(4, "prescribed").is(Argument::Prescribed);
        let values = at_values.optional(prescribed, lengths.1)?;
        let d = at(5, "d").required(d, lengths.2)?;
        let out = at(6, "u").output(u, lengths.0)?;
        arrays.check_overlap()?;
        guard::reserve_estimate(model.memory_of_recovery(cases))?;
        let case = |k: usize| SolvedCase {
            load: load.map(|load| &load[host * k..host * (k + 1)]),
            prescribed: values.map(|values| &values[fixed * k..fixed * (k + 1)]),
            d: &d[n * k..n * (k + 1)],
        };
        let write = |k: usize, u: Vec<f64>| out.part(host * k, host).write(&u);
        model.recover_each(cases, case, write).map_err(arrays.refused(5))?;
        Ok(0)
    })
}

/// Contact forces as your nodal forces. Sparse model: F by the signed weights. Two bodies: F on
/// both, each in its own frame. Condensed model: F itself.
///
/// @param model  the model
/// @param F      contact forces, N
/// @param nodal  out: nodal forces, H
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_model_nodal_forces(
    model: *const SignoriniModel,
    F: *const f64,
    nodal: *mut f64,
) -> i32 {
    c_entry!(|arrays| {
        let model = &arrays.model(model)?.model;
        let n = model.dim() * model.pairs();
        let force = arrays.at(2, "F").required(F, n)?;
        let out = arrays.at(3, "nodal").output(nodal, model.host_size())?;
        arrays.check_overlap()?;
        out.write(&model.nodal_forces(force).map_err(arrays.refused(2))?);
        Ok(0)
    })
}

/// Relative loads of a load case: the f that signorini_solve takes with the K of
/// signorini_model_data. There are none if pairs depend on each other.
///
/// @param model,f,prescribed  as for signorini_model_solve
/// @param load  out: relative loads, N
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_model_condensed_load(
    model: *const SignoriniModel,
    f: *const f64,
    prescribed: *const f64,
    load: *mut f64,
) -> i32 {
    c_entry!(|arrays| {
        let model = &arrays.model(model)?.model;
        let given = arrays.at(2, "f").required(f, model.host_size())?;
        let at_values = arrays.at(3, "prescribed").is(Argument::Prescribed);
        let values = at_values.optional(prescribed, model.fixed_count())?;
        let out = arrays.at(4, "load").output(load, model.dim() * model.pairs())?;
        arrays.check_overlap()?;
        out.write(&model.condensed_load(given, values).map_err(arrays.refused(2))?);
        Ok(0)
    })
}
