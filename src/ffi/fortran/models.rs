//! SGMODL, SGTWOB, SGFRAM, SGCASE, SGRECV, SGNODF, SGFREE: models known by numbers.

use std::sync::Arc;

use super::super::model::SignoriniModel;
use super::super::model_new::{
    signorini_model_frames, signorini_model_new_condensed, signorini_model_new_two_body,
    signorini_model_pairs,
};
use super::super::model_recover::{signorini_model_nodal_forces, signorini_model_recover};
use super::super::model_solve::signorini_model_solve;
use super::arguments::{Integer, Results, law as read_law, leading, run, settings, sizes};
use super::handles::Handles;

/// The models that live.
pub(super) static MODELS: Handles<SignoriniModel> =
    Handles::new("HANDLE", "is no such model", *b"SG");

/// # Safety
/// As include/signorini.inc demands, as for all entries.
pub(super) unsafe fn condensed<I: Integer>(
    ndim: *const I,
    npair: *const I,
    k: *const f64,
    ldk: *const I,
    handle: *mut i64,
    info: *mut I,
) {
    // SAFETY: by the caller's contract.
    let make = |model| unsafe {
        let (dim, pairs) = sizes(1, ndim, npair)?;
        let ldk = leading(4, "LDK", ldk, (dim, pairs))?;
        Ok(signorini_model_new_condensed(dim, pairs, k, ldk, model))
    };
    // SAFETY: by the caller's contract.
    unsafe { run(info, &[1, 2, 3, 4, 5], || MODELS.create(5, handle, make)) }
}

/// # Safety
/// As above.
pub(super) unsafe fn two_body<I: Integer>(
    ndim: *const I,
    npair: *const I,
    ka: *const f64,
    lda: *const I,
    kb: *const f64,
    ldb: *const I,
    handle: *mut i64,
    info: *mut I,
) {
    // SAFETY: by the caller's contract.
    let make = |model| unsafe {
        let (dim, pairs) = sizes(1, ndim, npair)?;
        let lda = leading(4, "LDA", lda, (dim, pairs))?;
        let ldb = leading(6, "LDB", ldb, (dim, pairs))?;
        Ok(signorini_model_new_two_body(dim, pairs, ka, lda, kb, ldb, model))
    };
    // SAFETY: by the caller's contract.
    unsafe { run(info, &[1, 2, 3, 4, 5, 6, 7], || MODELS.create(7, handle, make)) }
}

/// # Safety
/// As above.
pub(super) unsafe fn case<I: Integer>(
    handle: *const i64,
    f: *const f64,
    presc: *const f64,
    gap: *const f64,
    law: *const I,
    fric: *const f64,
    slip0: *const f64,
    method: *const I,
    tol: *const f64,
    maxit: *const I,
    d: *mut f64,
    r: *mut f64,
    state: *mut I,
    eta: *mut f64,
    iter: *mut I,
    info: *mut I,
) {
    let body = || {
        // SAFETY: by the caller's contract.
        unsafe {
            let model = MODELS.find(1, handle)?;
            let law = read_law(5, law)?;
            let settings = settings(8, method, tol, maxit)?;
            let pairs = signorini_model_pairs(Arc::as_ptr(&model));
            let mut results = Results::new(pairs)?;
            let status = signorini_model_solve(
                Arc::as_ptr(&model),
                1,
                f,
                presc,
                gap,
                law,
                fric,
                slip0,
                &raw const settings,
                d,
                r,
                results.state.as_mut_ptr(),
                std::ptr::null_mut(),
                &raw mut results.report,
                std::ptr::null(),
            );
            Ok(results.send(status, state, eta, iter))
        }
    };
    // The entry of C has the number of cases at its second position.
    // SAFETY: by the caller's contract.
    unsafe { run(info, &[1, 1, 2, 3, 4, 5, 6, 7, 8, 11, 12], body) }
}

/// # Safety
/// As above.
pub(super) unsafe fn frames<I: Integer>(handle: *const i64, frames: *mut f64, info: *mut I) {
    // SAFETY: by the caller's contract.
    let body = || unsafe {
        let model = MODELS.find(1, handle)?;
        Ok(signorini_model_frames(Arc::as_ptr(&model), frames))
    };
    // SAFETY: by the caller's contract.
    unsafe { run(info, &[1, 2], body) }
}

/// # Safety
/// As above.
pub(super) unsafe fn recover<I: Integer>(
    handle: *const i64,
    f: *const f64,
    presc: *const f64,
    d: *const f64,
    u: *mut f64,
    info: *mut I,
) {
    // SAFETY: by the caller's contract.
    let body = || unsafe {
        let model = MODELS.find(1, handle)?;
        Ok(signorini_model_recover(Arc::as_ptr(&model), f, presc, d, u))
    };
    // SAFETY: by the caller's contract.
    unsafe { run(info, &[1, 2, 3, 4, 5], body) }
}

/// # Safety
/// As above.
pub(super) unsafe fn nodal_forces<I: Integer>(
    handle: *const i64,
    r: *const f64,
    p: *mut f64,
    info: *mut I,
) {
    // SAFETY: by the caller's contract.
    let body = || unsafe {
        let model = MODELS.find(1, handle)?;
        Ok(signorini_model_nodal_forces(Arc::as_ptr(&model), r, p))
    };
    // SAFETY: by the caller's contract.
    unsafe { run(info, &[1, 2, 3], body) }
}

/// SGFREE. A handle of 0, which is no model, is allowed.
///
/// # Safety
/// As above.
pub(super) unsafe fn free<I: Integer>(handle: *mut i64, info: *mut I) {
    // SAFETY: by the caller's contract.
    unsafe { run(info, &[], || MODELS.free(handle)) }
}
