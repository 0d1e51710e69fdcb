//! SGMODL, SGTWOB, SGCASE, SGRECV, SGNODF, SGFREE: models known by numbers.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::super::guard::Failure;
use super::super::law::SIGNORINI_LAW_COULOMB;
use super::super::model_new::{
    SignoriniModel, read as read_model, signorini_model_new_condensed, signorini_model_new_two_body,
};
use super::super::model_recover::{signorini_model_nodal_forces, signorini_model_recover};
use super::super::model_solve::signorini_model_solve;
use super::arguments::{Integer, Results, choice, count, read, run, settings, write};

/// The models that live. Fortran has no pointer type of its own: an address in an INTEGER*8 would
/// be followed whatever it holds, a number that is not here is refused.
struct Models {
    next: i64,
    living: BTreeMap<i64, Arc<SignoriniModel>>,
}

/// Both halves of a number are not 0: half of one, in a variable of 4 bytes, is none.
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
        let dim = choice(1, "NDIM", ndim)?;
        let pairs = count(2, "NPAIR", npair)?;
        let ldk = count(4, "LDK", ldk)?;
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
        let dim = choice(1, "NDIM", ndim)?;
        let pairs = count(2, "NPAIR", npair)?;
        let lda = count(4, "LDA", lda)?;
        let ldb = count(6, "LDB", ldb)?;
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
    mu: *const f64,
    slip: *const f64,
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
            let settings = settings(7, method, tol, maxit)?;
            let pairs = read_model(Arc::as_ptr(&model))?.pairs();
            let mut results = Results::new(pairs as i64)?;
            let status = signorini_model_solve(
                Arc::as_ptr(&model),
                1,
                f,
                presc,
                gap,
                SIGNORINI_LAW_COULOMB,
                mu,
                slip,
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
    unsafe { run(info, &[1, 1, 2, 3, 4, 5, 5, 6, 7, 10, 11], body) }
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
