//! SGSOLV, SGLCPS: everything in one call.

use std::ptr::{null, null_mut};

use super::super::lcp::signorini_lcp_solve;
use super::super::report::SignoriniReport;
use super::super::solve::signorini_solve;
use super::arguments::{
    Integer, count, law as read_law, leading, run, settings, sizes, widen, write,
};

entry! {
    sgsolv_ sgsolv_64_ positions [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 13, 14, 15],
    (
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
    ) {
        let (dim, pairs) = sizes(1, ndim, npair)?;
        let ldk = leading(4, ldk, (dim, pairs))?;
        let law = read_law(7, law)?;
        let settings = settings(10, method, tol, maxit)?;
        let mut report = SignoriniReport::blank();
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
        if status >= 0 {
            widen(state, pairs);
            write(eta, report.eta);
            write(iter, I::nearest(report.iterations));
        }
        Ok(status)
    }
}

entry! {
    sglcps_ sglcps_64_ positions [1, 2, 3, 4, 4, 5, 8, 9],
    (
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
    ) {
        let (n, ldm) = (count(1, "N", n)?, count(3, "LDM", ldm)?);
        let settings = settings(5, method, tol, maxit)?;
        let mut report = SignoriniReport::blank();
        let (settings, report_place) = (&raw const settings, &raw mut report);
        let (cover, y) = (null(), null_mut());
        let status = signorini_lcp_solve(n, m, ldm, q, cover, settings, w, z, y, report_place);
        if status >= 0 {
            write(eta, report.eta);
            write(iter, I::nearest(report.iterations));
        }
        Ok(status)
    }
}
