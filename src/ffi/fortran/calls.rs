//! SGSOLV, SGLCPS: everything in one call. SGCASE, SGRECV, SGFREE: models known by numbers. SGMESG: the last sentence,
//! whose numbers count from 1.

use std::ptr::{null, null_mut};
use std::sync::Arc;

use libc::c_char;

use super::super::guard::Outcome;
use super::super::lcp::signorini_lcp_solve;
use super::super::model::SignoriniModel;
use super::super::model_recover::signorini_model_recover;
use super::super::model_solve::signorini_model_solve;
use super::super::report::SignoriniReport;
use super::super::solve::signorini_solve;
use super::super::status::last_counted_from_one;
use super::super::structures::Structure;
use super::arguments::{Argument, Integer, fill, run, settings, widen, write};
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
) -> Outcome<i32> {
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
    sgsolv_ sgsolv_64_
    calls [NDIM, NPAIR, K, LDK, F, GAP, LAW, FRIC, SLIP0, METHOD, D, R, STATE],
    (
        NDIM: *const I, NPAIR: *const I, K: *const f64, LDK: *const I, F: *const f64,
        GAP: *const f64, LAW: *const I, FRIC: *const f64, SLIP0: *const f64, METHOD: *const I,
        TOL: *const f64, MAXIT: *const I, D: *mut f64, R: *mut f64, STATE: *mut I, ETA: *mut f64,
        ITER: *mut I,
    ) {
        let (dim, pairs) = (NDIM.dimension()?, NPAIR.count()?);
        let ldk = LDK.leading((dim, pairs))?;
        let law = LAW.law()?;
        let settings = settings(METHOD, TOL, MAXIT)?;
        let mut report = SignoriniReport::default_one();
        let status = signorini_solve(
            dim, pairs, K.place, ldk, F.place, GAP.place, law, FRIC.place, SLIP0.place,
            &raw const settings, D.place, R.place, STATE.place.cast(), &raw mut report, null(),
        );
        tell(status, (STATE.place, pairs), (ETA.place, ITER.place), &report)
    }
}

entry! {
    sglcps_ sglcps_64_ calls [N, M, LDM, Q, Q, METHOD, W, Z],
    (
        N: *const I, M: *const f64, LDM: *const I, Q: *const f64, METHOD: *const I,
        TOL: *const f64, MAXIT: *const I, W: *mut f64, Z: *mut f64, ETA: *mut f64, ITER: *mut I,
    ) {
        let (n, ldm) = (N.count()?, LDM.count()?);
        let settings = settings(METHOD, TOL, MAXIT)?;
        let mut report = SignoriniReport::default_one();
        let (cover, y) = (null(), null_mut());
        let status = signorini_lcp_solve(
            n, M.place, ldm, Q.place, cover, &raw const settings, W.place, Z.place, y,
            &raw mut report,
        );
        tell(status, (null_mut(), 0), (ETA.place, ITER.place), &report)
    }
}

entry! {
    // Argument 2 of the function of C is the number of cases.
    sgcase_ sgcase_64_
    calls [HANDLE, HANDLE, F, PRESC, GAP, LAW, FRIC, SLIP0, METHOD, D, R, STATE],
    (
        HANDLE: *const i64, F: *const f64, PRESC: *const f64, GAP: *const f64, LAW: *const I,
        FRIC: *const f64, SLIP0: *const f64, METHOD: *const I, TOL: *const f64, MAXIT: *const I,
        D: *mut f64, R: *mut f64, STATE: *mut I, ETA: *mut f64, ITER: *mut I,
    ) {
        let model = find::<SignoriniModel>(HANDLE)?;
        let law = LAW.law()?;
        let settings = settings(METHOD, TOL, MAXIT)?;
        let mut report = SignoriniReport::default_one();
        let status = signorini_model_solve(
            Arc::as_ptr(&model), 1, F.place, PRESC.place, GAP.place, law, FRIC.place, SLIP0.place,
            &raw const settings, D.place, R.place, STATE.place.cast(), null_mut(),
            &raw mut report, null(),
        );
        let pairs = model.model.pairs() as i64;
        tell(status, (STATE.place, pairs), (ETA.place, ITER.place), &report)
    }
}

entry! {
    // As above.
    sgrecv_ sgrecv_64_ calls [HANDLE, HANDLE, F, PRESC, D, U],
    (HANDLE: *const i64, F: *const f64, PRESC: *const f64, D: *const f64, U: *mut f64) {
        let model = find::<SignoriniModel>(HANDLE)?;
        let model = Arc::as_ptr(&model);
        Ok(signorini_model_recover(model, 1, F.place, PRESC.place, D.place, U.place))
    }
}

entry! {
    sgfree_ sgfree_64_ calls [],
    (HANDLE: *mut i64) {
        free::<SignoriniModel>(HANDLE)
    }
}

export! {
    // Its length is an argument, so that it does not matter how, and whether, a compiler hands over the length of a
    // CHARACTER on its own.
    sgmesg_ sgmesg_64_ (TEXT: *mut c_char, LTEXT: *const I) {
        if let Ok(length) = Argument::of(LTEXT, 2, "LTEXT").wide() {
            fill(TEXT, length, &last_counted_from_one());
        }
    }
}
