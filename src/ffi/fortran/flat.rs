//! SGSOLV, SGTRES, SGCERT, SGLCPS: everything in one call.

use super::super::certify::signorini_certify;
use super::super::law::{SIGNORINI_LAW_COULOMB, SIGNORINI_LAW_TRESCA};
use super::super::lcp::signorini_lcp_solve;
use super::super::solve::signorini_solve;
use super::arguments::{
    Integer, Results, choice, count, read, run, settings, tolerance_or_default,
};

/// # Safety
/// As include/signorini.inc demands, as for all entries.
pub(super) unsafe fn solve<I: Integer>(
    ndim: *const I,
    npair: *const I,
    k: *const f64,
    ldk: *const I,
    f: *const f64,
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
    let arguments = Arguments {
        ndim,
        npair,
        k,
        ldk,
        f,
        gap,
        friction: mu,
        slip,
        method,
        tol,
        maxit,
        d,
        r,
        state,
        eta,
        iter,
        info,
    };
    // SAFETY: by the caller's contract.
    unsafe { arguments.run(SIGNORINI_LAW_COULOMB) }
}

/// # Safety
/// As above.
pub(super) unsafe fn tresca<I: Integer>(
    ndim: *const I,
    npair: *const I,
    k: *const f64,
    ldk: *const I,
    f: *const f64,
    gap: *const f64,
    g: *const f64,
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
    let arguments = Arguments {
        ndim,
        npair,
        k,
        ldk,
        f,
        gap,
        friction: g,
        slip,
        method,
        tol,
        maxit,
        d,
        r,
        state,
        eta,
        iter,
        info,
    };
    // SAFETY: by the caller's contract.
    unsafe { arguments.run(SIGNORINI_LAW_TRESCA) }
}

/// What SGSOLV and SGTRES have in common: all.
struct Arguments<I> {
    ndim: *const I,
    npair: *const I,
    k: *const f64,
    ldk: *const I,
    f: *const f64,
    gap: *const f64,
    friction: *const f64,
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
}

impl<I: Integer> Arguments<I> {
    /// # Safety
    /// As above.
    unsafe fn run(&self, law: i32) {
        let body = || {
            // SAFETY: by the caller's contract.
            unsafe {
                let dim = choice(1, "NDIM", self.ndim)?;
                let pairs = count(2, "NPAIR", self.npair)?;
                let ldk = count(4, "LDK", self.ldk)?;
                let settings = settings(9, self.method, self.tol, self.maxit)?;
                let mut results = Results::new(pairs)?;
                let status = signorini_solve(
                    dim,
                    pairs,
                    self.k,
                    ldk,
                    self.f,
                    self.gap,
                    law,
                    self.friction,
                    self.slip,
                    &raw const settings,
                    self.d,
                    self.r,
                    results.state.as_mut_ptr(),
                    &raw mut results.report,
                    std::ptr::null(),
                );
                Ok(results.send(status, self.state, self.eta, self.iter))
            }
        };
        // SAFETY: by the caller's contract.
        unsafe { run(self.info, &[1, 2, 3, 4, 5, 6, 7, 7, 8, 9, 12, 13], body) }
    }
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
    mu: *const f64,
    slip: *const f64,
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
            let dim = choice(1, "NDIM", ndim)?;
            let pairs = count(2, "NPAIR", npair)?;
            let ldk = count(4, "LDK", ldk)?;
            let tolerance = tolerance_or_default(9, read(9, "TOL", tol)?)?;
            let mut results = Results::new(pairs)?;
            let status = signorini_certify(
                dim,
                pairs,
                k,
                ldk,
                f,
                gap,
                SIGNORINI_LAW_COULOMB,
                mu,
                slip,
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
    unsafe { run(info, &[1, 2, 3, 4, 5, 6, 7, 7, 8, 9, 10, 11], body) }
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
