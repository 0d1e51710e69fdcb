//! From relative displacements and contact forces back to the host, and what a load case condenses
//! to.

use super::args::{c_entry, size};
use super::case_arguments::times;
use super::guard::{self, Failure};
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
        let cases = size(2, "cases", cases)?;
        let (host, fixed) = (model.host_size(), model.fixed_count());
        let n = model.dim() * model.pairs();
        let lengths = (times(cases, host)?, times(cases, fixed)?, times(cases, n)?);
        let (load, values, d, out) = arrays.matrices(|arrays| {
            let load = arrays.optional(3, "f", f, lengths.0)?;
            let values = arrays.optional(4, "prescribed", prescribed, lengths.1)?;
            let d = arrays.required(5, "d", d, lengths.2)?;
            Ok((load, values, d, arrays.output(6, "u", u, lengths.0)?))
        })?;
        arrays.check_overlap()?;
        guard::reserve_estimate(model.memory_of_recovery(cases))?;
        let case = |k: usize| SolvedCase {
            load: load.map(|load| &load[host * k..host * (k + 1)]),
            prescribed: values.map(|values| &values[fixed * k..fixed * (k + 1)]),
            d: &d[n * k..n * (k + 1)],
        };
        let write = |k: usize, u: Vec<f64>| out.part(host * k, host).write(&u);
        let recovered = model.recover_each(cases, case, write);
        recovered.map_err(|error| Failure::from_error(error, position))?;
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
        let force = arrays.required(2, "F", F, n)?;
        let out = arrays.output(3, "nodal", nodal, model.host_size())?;
        arrays.check_overlap()?;
        let forces = model.nodal_forces(force);
        out.write(&forces.map_err(|error| Failure::from_error(error, |_| 2))?);
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
        let given = arrays.required(2, "f", f, model.host_size())?;
        let values = arrays.optional(3, "prescribed", prescribed, model.fixed_count())?;
        let out = arrays.output(4, "load", load, model.dim() * model.pairs())?;
        arrays.check_overlap()?;
        let condensed = model.condensed_load(given, values).map_err(|error| {
            Failure::from_error(error, |argument| match argument {
                Argument::Matrix => 1,
                Argument::Prescribed => 3,
                _ => 2,
            })
        })?;
        out.write(&condensed);
        Ok(0)
    })
}
