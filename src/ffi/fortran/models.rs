//! SGMODL, SGTWOB, SGFRAM, SGCASE, SGRECV, SGNODF, SGFREE: models known by numbers.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::super::guard::Failure;
use super::super::model_new::{
    SignoriniModel, signorini_model_frames, signorini_model_new_condensed,
    signorini_model_new_two_body, signorini_model_pairs,
};
use super::super::model_recover::{signorini_model_nodal_forces, signorini_model_recover};
use super::super::model_solve::signorini_model_solve;
use super::arguments::{
    Integer, Results, law as read_law, leading, read, run, settings, sizes, write,
};

/// The models that live. Fortran has no pointer type of its own: an address in an INTEGER*8 would
/// be followed whatever it holds, a number that is not here is refused.
struct Models {
    next: i64,
    living: BTreeMap<i64, Arc<SignoriniModel>>,
}

/// The upper half of a handle is "SG" in ASCII, the lower half counts from 1: neither is 0, so that a
/// handle cut to an INTEGER*4 is never one.
const FIRST: i64 = (0x5347 << 32) + 1;

static MODELS: Mutex<Models> = Mutex::new(Models { next: FIRST, living: BTreeMap::new() });

fn models() -> MutexGuard<'static, Models> {
    // The map is whole whenever a panic can happen.
    MODELS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Makes a model by an entry of C and puts its number into HANDLE, 0 if there is none.
///
/// # Safety
/// `handle` is NULL or a place of the caller.
pub(super) unsafe fn create(
    position: i32,
    handle: *mut i64,
    make: impl FnOnce(*mut *mut SignoriniModel) -> Result<i32, Failure>,
) -> Result<i32, Failure> {
    if handle.is_null() {
        return Err(Failure::argument(position, "HANDLE is NULL"));
    }
    // SAFETY: by the caller's contract.
    unsafe { write(handle, 0) };
    let mut model = std::ptr::null_mut();
    let status = make(&raw mut model)?;
    if status == 0 {
        // SAFETY: a new model, which is ours alone.
        let model = Arc::from(unsafe { Box::from_raw(model) });
        let mut models = models();
        let number = models.next;
        models.next += 1;
        models.living.insert(number, model);
        // SAFETY: by the caller's contract.
        unsafe { write(handle, number) };
    }
    Ok(status)
}

/// The model of HANDLE, which lives on during the call even if another thread releases it.
///
/// # Safety
/// As above.
unsafe fn find(handle: *const i64) -> Result<Arc<SignoriniModel>, Failure> {
    // SAFETY: by the caller's contract.
    let number = unsafe { read(1, "HANDLE", handle)? };
    models().living.get(&number).cloned().ok_or_else(|| unknown(number))
}

fn unknown(number: i64) -> Failure {
    Failure::argument(1, format!("HANDLE is {number}, there is no such model; is it INTEGER*8?"))
}

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
    unsafe { run(info, &[1, 2, 3, 4, 5], || create(5, handle, make)) }
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
    unsafe { run(info, &[1, 2, 3, 4, 5, 6, 7], || create(7, handle, make)) }
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
            let model = find(handle)?;
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
        let model = find(handle)?;
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
        let model = find(handle)?;
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
        let model = find(handle)?;
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
    let body = || {
        // SAFETY: by the caller's contract.
        let number = unsafe { read(1, "HANDLE", handle)? };
        if number != 0 && models().living.remove(&number).is_none() {
            return Err(unknown(number));
        }
        // SAFETY: by the caller's contract.
        unsafe { write(handle, 0) };
        Ok(0)
    };
    // SAFETY: by the caller's contract.
    unsafe { run(info, &[], body) }
}
