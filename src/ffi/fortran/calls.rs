//! SGSOLV, SGLCPS: everything in one call.

use std::ptr::{null, null_mut};

use super::super::lcp::signorini_lcp_solve;
use super::super::report::SignoriniReport;
use super::super::solve::signorini_solve;
use super::super::structures::Structure;
use super::arguments::{Given, Integer, run, settings, widen, write};

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
        if status >= 0 {
            write(eta, report.eta);
            write(iter, I::nearest(report.iterations));
        }
        Ok(status)
    }
}
