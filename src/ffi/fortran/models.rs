//! SGCASE, SGRECV, SGFREE: models known by numbers.

use std::sync::Arc;

use super::super::model::SignoriniModel;
use super::super::model_recover::signorini_model_recover;
use super::super::model_solve::signorini_model_solve;
use super::super::report::SignoriniReport;
use super::super::structures::Structure;
use super::arguments::{Given, Integer, run, settings, widen, write};
use super::handles::{find, free};

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
            std::ptr::null_mut(),
            &raw mut report,
            std::ptr::null(),
        );
        if status >= 0 {
            widen(state, model.model().pairs() as i64);
            write(eta, report.eta);
            write(iter, I::nearest(report.iterations));
        }
        Ok(status)
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
