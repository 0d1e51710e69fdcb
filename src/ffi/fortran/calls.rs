//! SGSOLV, SGLCPS: everything in one call. SGCASE, SGRECV, SGFREE: models known by numbers.

use std::ptr::{null, null_mut};
use std::sync::Arc;

use super::super::guard::Failure;
use super::super::lcp::signorini_lcp_solve;
use super::super::model::SignoriniModel;
use super::super::model_recover::signorini_model_recover;
use super::super::model_solve::signorini_model_solve;
use super::super::report::SignoriniReport;
use super::super::solve::signorini_solve;
use super::super::structures::Structure;
use super::arguments::{Given, Integer, run, settings, widen, write};
use super::handles::{find, free};

/// Hands over STATE, ETA and ITER of a call with results, and its status.
///
/// # Safety
/// Each is NULL or of the caller; STATE has a place for each of the pairs.
unsafe fn tell<I: Integer>(
    status: i32,
    (state, pairs): (*mut I, i64),
    (eta, iter): (*mut f64, *mut I),
    report: &SignoriniReport,
) -> Result<i32, Failure> {
    if status >= 0 {
        // SAFETY: by the caller's contract.
        unsafe {
            widen(state, pairs);
            write(eta, report.eta);
            write(iter, I::nearest(report.iterations));
        }
    }
    Ok(status)
}

entry! {
    sgsolv_ sgsolv_64_ positions [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 13, 14, 15],
    (
        ndim: Given<I>,
        npair: Given<I>,
        k: *const f64,
        ldk: Given<I>,
        f: *const f64,
        gap: *const f64,
        law: Given<I>,
        fric: *const f64,
        slip0: *const f64,
        method: Given<I>,
        tol: Given<f64>,
        maxit: Given<I>,
        d: *mut f64,
        r: *mut f64,
        state: *mut I,
        eta: *mut f64,
        iter: *mut I,
    ) {
        let (dim, pairs) = (ndim.dimension(1)?, npair.count(2, "NPAIR")?);
        let ldk = ldk.leading(4, (dim, pairs))?;
        let law = law.law(7)?;
        let settings = settings(10, method, tol, maxit)?;
        let mut report = SignoriniReport::default_one();
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
            state.cast(),
            &raw mut report,
            null(),
        );
        tell(status, (state, pairs), (eta, iter), &report)
    }
}

entry! {
    sglcps_ sglcps_64_ positions [1, 2, 3, 4, 4, 5, 8, 9],
    (
        n: Given<I>,
        m: *const f64,
        ldm: Given<I>,
        q: *const f64,
        method: Given<I>,
        tol: Given<f64>,
        maxit: Given<I>,
        w: *mut f64,
        z: *mut f64,
        eta: *mut f64,
        iter: *mut I,
    ) {
        let (n, ldm) = (n.count(1, "N")?, ldm.count(3, "LDM")?);
        let settings = settings(5, method, tol, maxit)?;
        let mut report = SignoriniReport::default_one();
        let (settings, report_place) = (&raw const settings, &raw mut report);
        let (cover, y) = (null(), null_mut());
        let status = signorini_lcp_solve(n, m, ldm, q, cover, settings, w, z, y, report_place);
        tell(status, (null_mut(), 0), (eta, iter), &report)
    }
}

entry! {
    // Argument 2 of the function of C is the number of cases.
    sgcase_ sgcase_64_ positions [1, 1, 2, 3, 4, 5, 6, 7, 8, 11, 12, 13],
    (
        handle: Given<i64>,
        f: *const f64,
        presc: *const f64,
        gap: *const f64,
        law: Given<I>,
        fric: *const f64,
        slip0: *const f64,
        method: Given<I>,
        tol: Given<f64>,
        maxit: Given<I>,
        d: *mut f64,
        r: *mut f64,
        state: *mut I,
        eta: *mut f64,
        iter: *mut I,
    ) {
        let model = find::<SignoriniModel>(1, handle)?;
        let law = law.law(5)?;
        let settings = settings(8, method, tol, maxit)?;
        let mut report = SignoriniReport::default_one();
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
            state.cast(),
            null_mut(),
            &raw mut report,
            null(),
        );
        tell(status, (state, model.model().pairs() as i64), (eta, iter), &report)
    }
}

entry! {
    // As above.
    sgrecv_ sgrecv_64_ positions [1, 1, 2, 3, 4, 5],
    (handle: Given<i64>, f: *const f64, presc: *const f64, d: *const f64, u: *mut f64) {
        let model = find::<SignoriniModel>(1, handle)?;
        Ok(signorini_model_recover(Arc::as_ptr(&model), 1, f, presc, d, u))
    }
}

entry! {
    sgfree_ sgfree_64_ positions [],
    (handle: *mut i64) {
        free::<SignoriniModel>(handle)
    }
}
