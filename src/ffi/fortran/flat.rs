//! SGSOLV, SGCERT, SGPROV, SGLCPS: everything in one call.

use super::super::certify::signorini_certify;
use super::super::guard;
use super::super::lcp::signorini_lcp_solve;
use super::super::prove::signorini_prove;
use super::super::solve::signorini_solve;
use super::arguments::{
    Integer, Results, choice, count, law as read_law, leading, read, run, settings, sizes,
    tolerance_or_default,
};
use crate::solve::memory;

/// # Safety
/// As include/signorini.inc demands, as for all entries.
pub(super) unsafe fn solve<I: Integer>(
    ndim: *const I,
    npair: *const I,
    k: *const f64,
    ldk: *const I,
    f: *const f64,
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
            let (dim, pairs) = sizes(1, ndim, npair)?;
            let ldk = leading(4, "LDK", ldk, (dim, pairs))?;
            let law = read_law(7, law)?;
            let settings = settings(10, method, tol, maxit)?;
            let mut results = Results::new(pairs)?;
            let status = signorini_solve(
                dim,
                pairs,
                k,
                ldk,
                f,
                gap,
                law,
                fric,
                slip0,
                &raw const settings,
                d,
                r,
                results.state.as_mut_ptr(),
                &raw mut results.report,
                std::ptr::null(),
            );
            Ok(results.send(status, state, eta, iter))
        }
    };
    // SAFETY: by the caller's contract.
    unsafe { run(info, &[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 13, 14], body) }
}

/// # Safety
/// As above.
pub(super) unsafe fn certify<I: Integer>(
    ndim: *const I,
    npair: *const I,
    k: *const f64,
    ldk: *const I,
    f: *const f64,
    gap: *const f64,
    law: *const I,
    fric: *const f64,
    slip0: *const f64,
    tol: *const f64,
    d: *const f64,
    r: *mut f64,
    state: *mut I,
    eta: *mut f64,
    info: *mut I,
) {
    let body = || {
        // SAFETY: by the caller's contract.
        unsafe {
            let (dim, pairs) = sizes(1, ndim, npair)?;
            let ldk = leading(4, "LDK", ldk, (dim, pairs))?;
            let law = read_law(7, law)?;
            let tolerance = tolerance_or_default(10, read(10, "TOL", tol)?)?;
            let mut results = Results::new(pairs)?;
            let status = signorini_certify(
                dim,
                pairs,
                k,
                ldk,
                f,
                gap,
                law,
                fric,
                slip0,
                tolerance,
                d,
                r,
                results.state.as_mut_ptr(),
                &raw mut results.report,
            );
            Ok(results.send(status, state, eta, std::ptr::null_mut()))
        }
    };
    // SAFETY: by the caller's contract.
    unsafe { run(info, &[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12], body) }
}

/// # Safety
/// As above.
pub(super) unsafe fn prove<I: Integer>(
    ndim: *const I,
    npair: *const I,
    k: *const f64,
    ldk: *const I,
    f: *const f64,
    gap: *const f64,
    law: *const I,
    fric: *const f64,
    slip0: *const f64,
    d: *const f64,
    state: *const I,
    r: *mut f64,
    radd: *mut f64,
    radr: *mut f64,
    info: *mut I,
) {
    let body = || {
        // SAFETY: by the caller's contract.
        unsafe {
            let (dim, pairs) = sizes(1, ndim, npair)?;
            let ldk = leading(4, "LDK", ldk, (dim, pairs))?;
            let law = read_law(7, law)?;
            // Before STATE is read, which would end where NPAIR is wrong.
            let size = usize::try_from(i64::from(dim) * pairs).unwrap_or(usize::MAX);
            guard::reserve_estimate(memory(size))?;
            let mut results = Results::new(pairs)?;
            for (i, code) in results.state.iter_mut().enumerate() {
                let place = if state.is_null() { state } else { state.wrapping_add(i) };
                *code = choice(11, "STATE", place)?;
            }
            let states = results.state.as_ptr();
            Ok(signorini_prove(
                dim, pairs, k, ldk, f, gap, law, fric, slip0, d, states, r, radd, radr,
            ))
        }
    };
    // SAFETY: by the caller's contract.
    unsafe { run(info, &[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14], body) }
}

/// # Safety
/// As above.
pub(super) unsafe fn lcp<I: Integer>(
    n: *const I,
    m: *const f64,
    ldm: *const I,
    q: *const f64,
    method: *const I,
    tol: *const f64,
    maxit: *const I,
    w: *mut f64,
    z: *mut f64,
    eta: *mut f64,
    iter: *mut I,
    info: *mut I,
) {
    let body = || {
        // SAFETY: by the caller's contract.
        unsafe {
            let n = count(1, "N", n)?;
            let ldm = count(3, "LDM", ldm)?;
            let settings = settings(5, method, tol, maxit)?;
            let mut results = Results::new(0)?;
            let report = &raw mut results.report;
            let status = signorini_lcp_solve(
                n,
                m,
                ldm,
                q,
                &raw const settings,
                w,
                z,
                std::ptr::null_mut(),
                report,
            );
            Ok(results.send(status, std::ptr::null_mut(), eta, iter))
        }
    };
    // SAFETY: by the caller's contract.
    unsafe { run(info, &[1, 2, 3, 4, 5, 8, 9], body) }
}
