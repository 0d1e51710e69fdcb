//! From relative displacements and contact forces back to the host, and what a load case condenses
//! to.

use super::args::c_entry;
use super::case_arguments::times;
use super::guard::{self, refused};
use super::model::SignoriniModel;
use crate::error::Argument;
use crate::reduce::SolvedCase;

/// Your displacements from the relative ones, a column for each case; many cases of a sparse
/// model in one call cost a fraction of as many calls. If u overflows in a case, those before it
/// may be written.
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
        let model = arrays.model(model)?;
        let cases = arrays.at(2, "cases").size(cases)?;
        let (host, fixed) = (model.host_size(), model.fixed_count());
        let n = model.dim() * model.pairs();
        let lengths = (times(cases, host)?, times(cases, fixed)?, times(cases, n)?);
        let at = |position, name| arrays.at(position, name).matrix();
        let load = at(3, "f").optional(f, lengths.0)?;
        let values = at(4, "prescribed").optional(prescribed, lengths.1)?;
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
        model.recover_each(cases, case, write).map_err(refused(position))?;
        Ok(0)
    })
}

/// Number of the argument of [`signorini_model_recover`] that an error is about.
fn position(argument: Argument) -> i32 {
    match argument {
        Argument::Matrix => 1,
        Argument::Load => 3,
        Argument::Prescribed => 4,
        _ => 5,
    }
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
        let model = arrays.model(model)?;
        let n = model.dim() * model.pairs();
        let force = arrays.at(2, "F").required(F, n)?;
        let out = arrays.at(3, "nodal").output(nodal, model.host_size())?;
        arrays.check_overlap()?;
        out.write(&model.nodal_forces(force).map_err(refused(|_| 2))?);
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
        let model = arrays.model(model)?;
        let given = arrays.at(2, "f").required(f, model.host_size())?;
        let values = arrays.at(3, "prescribed").optional(prescribed, model.fixed_count())?;
        let out = arrays.at(4, "load").output(load, model.dim() * model.pairs())?;
        arrays.check_overlap()?;
        let position = |argument| match argument {
            Argument::Matrix => 1,
            Argument::Prescribed => 3,
            _ => 2,
        };
        out.write(&model.condensed_load(given, values).map_err(refused(position))?);
        Ok(0)
    })
}
