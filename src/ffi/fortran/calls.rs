//! SGSOLV, SGLCPS: everything in one call. SGSPAR, SGCASE, SGRECV, SGFREE: models of whole sparse matrices, known by
//! numbers. SGMESG: the last sentence, whose numbers count from 1.

use std::ptr::{null, null_mut};
use std::sync::Arc;

use libc::c_char;

use super::super::guard::{Failure, Outcome};
use super::super::model::{SignoriniModel, signorini_model_recover};
use super::super::model_new::signorini_model_new_sparse;
use super::super::model_solve::signorini_model_solve;
use super::super::pairs::SignoriniPairs;
use super::super::report::SignoriniReport;
use super::super::settings::SignoriniSettings;
use super::super::solve::{signorini_lcp_solve, signorini_solve};
use super::super::sparse::{SIGNORINI_TRIANGLE_FULL, SIGNORINI_TRIANGLE_LOWER, SignoriniSparse};
use super::super::status::last_counted_from_one;
use super::super::structures::Structure;
use super::arguments::{Argument, Integer, fill, run, settings, widen, write};
use super::handles::{create, find, free};

/// Solves by a function of C, which is handed settings and report, and hands over STATE, ETA and ITER of its results. Returns
/// its status.
///
/// # Safety
/// Each is NULL or of the caller; STATE has a place for each of the pairs.
unsafe fn solved<I: Integer>(
    settings: &SignoriniSettings,
    (state, pairs): (*mut I, i64),
    (eta, iter): (*mut f64, *mut I),
    solve: impl FnOnce(*const SignoriniSettings, *mut SignoriniReport) -> i32,
) -> Outcome<i32> {
    let mut report = SignoriniReport::default_one();
    let status = solve(settings, &raw mut report);
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
        let (ldk, n) = (LDK.count()?, i64::from(dim) * pairs);
        if ldk < n.max(1) {
            return LDK.refuse(format!(
                "is {ldk}, it must be at least NDIM * NPAIR, which is {n}; NPAIR counts pairs"
            ));
        }
        let law = LAW.law()?;
        let settings = settings(METHOD, TOL, MAXIT)?;
        let (state, told) = ((STATE.pointer, pairs), (ETA.pointer, ITER.pointer));
        solved(&settings, state, told, |settings, report| signorini_solve(
            dim, pairs, K.pointer, ldk, F.pointer, GAP.pointer, law, FRIC.pointer, SLIP0.pointer,
            settings, D.pointer, R.pointer, STATE.pointer.cast(), report, null(),
        ))
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
        let (cover, y, told) = (null(), null_mut(), (ETA.pointer, ITER.pointer));
        solved(&settings, (null_mut(), 0), told, |settings, report| signorini_lcp_solve(
            n, M.pointer, ldm, Q.pointer, cover, settings, W.pointer, Z.pointer, y, report,
        ))
    }
}

entry! {
    // The function of C tells that the matrix is wrong, and not which array of it: here its values. Likewise the
    // pairs: here SLAVE.
    sgspar_ sgspar_64_ calls [VALUES, NFIX, FIXED, SLAVE, HANDLE, HANDLE],
    (
        N: *const I, NNZ: *const I, COLPTR: *const I, ROWIND: *const I, VALUES: *const f64,
        TRI: *const I, NFIX: *const I, FIXED: *const I, NDIM: *const I, NPAIR: *const I,
        SLAVE: *const I, NMAST: *const I, MSTART: *const I, MASTER: *const I, WEIGHT: *const f64,
        NORMAL: *const f64, NTAN: *const I, TANGNT: *const f64, HANDLE: *mut i64,
    ) {
        create(HANDLE, |model| {
            let matrix = Matrix { N, NNZ, COLPTR, ROWIND, VALUES, TRI, NFIX, FIXED };
            let pairs = Pairs {
                NDIM, NPAIR, SLAVE, NMAST, MSTART, MASTER, WEIGHT, NORMAL, NTAN, TANGNT,
            };
            pairs.with(|pairs| matrix.with(pairs, model))
        })
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
        let state = (STATE.pointer, model.model.pairs() as i64);
        solved(&settings, state, (ETA.pointer, ITER.pointer), |settings, report| signorini_model_solve(
            Arc::as_ptr(&model), 1, F.pointer, PRESC.pointer, GAP.pointer, law, FRIC.pointer, SLIP0.pointer,
            settings, D.pointer, R.pointer, STATE.pointer.cast(), null_mut(), report, null(),
        ))
    }
}

entry! {
    // As above.
    sgrecv_ sgrecv_64_ calls [HANDLE, HANDLE, F, PRESC, D, U],
    (HANDLE: *const i64, F: *const f64, PRESC: *const f64, D: *const f64, U: *mut f64) {
        let model = find::<SignoriniModel>(HANDLE)?;
        let model = Arc::as_ptr(&model);
        Ok(signorini_model_recover(model, 1, F.pointer, PRESC.pointer, D.pointer, U.pointer))
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

/// An integer, or an array of them.
pub(super) type Integers<I> = Argument<*const I>;

/// The arguments from N to FIXED, the first ones.
pub(super) struct Matrix<I> {
    pub(super) N: Integers<I>,
    pub(super) NNZ: Integers<I>,
    pub(super) COLPTR: Integers<I>,
    pub(super) ROWIND: Integers<I>,
    pub(super) VALUES: Argument<*const f64>,
    pub(super) TRI: Integers<I>,
    pub(super) NFIX: Integers<I>,
    pub(super) FIXED: Integers<I>,
}

impl<I: Integer> Matrix<I> {
    /// The model of the matrix and of these pairs.
    ///
    /// # Safety
    /// As include/signorini.inc demands.
    pub(super) unsafe fn with(
        &self,
        pairs: *const SignoriniPairs,
        model: *mut *mut SignoriniModel,
    ) -> Outcome<i32> {
        let matrix = self.read()?;
        let held = self.NFIX.count()?;
        let fixed = self.FIXED.numbers(held)?;
        let (matrix, fixed) = (&raw const matrix, fixed.as_ptr());
        // SAFETY: by the caller's contract.
        Ok(unsafe { signorini_model_new_sparse(matrix, held, fixed, pairs, null(), model) })
    }

    fn read(&self) -> Outcome<SignoriniSparse> {
        let size = self.N.count()?;
        let nnz = self.NNZ.wide()?;
        // More than a full matrix has. In 8 bytes there may be more than 2^31 of them.
        if nnz < 0 || nnz > size.saturating_mul(size) {
            return self.NNZ.refuse_width(nnz);
        }
        let triangles = SIGNORINI_TRIANGLE_LOWER..=SIGNORINI_TRIANGLE_FULL;
        let triangle = self.TRI.one_of(triangles, "0 (lower), 1 (upper) or 2 (all)")?;
        self.check_begins(size, nnz)?;
        Ok(SignoriniSparse {
            index_bytes: I::BYTES,
            index_base: 1,
            triangle,
            size,
            nnz,
            col_start: self.COLPTR.pointer.cast(),
            row: self.ROWIND.pointer.cast(),
            values: self.VALUES.pointer,
            ..SignoriniSparse::zeros()
        })
    }

    /// The begins of the columns, before ROWIND and VALUES are believed to be as long as NNZ says.
    fn check_begins(&self, size: i64, nnz: i64) -> Outcome<()> {
        let ends = |begins: &[I]| [begins[0], begins[begins.len() - 1]].map(I::into);
        let [first, last] = self.COLPTR.entries(size + 1, ends)?;
        if first != 1 {
            let bytes = I::BYTES;
            let wanted = format!("1: indices count from 1, in integers of {bytes} bytes");
            return self.COLPTR.refuse_entry(0, format!("is {first}, it must be {wanted}"));
        }
        if last != nnz + 1 {
            let wrong = format!("is {last}, it must be NNZ + 1 ({})", nnz + 1);
            return self.COLPTR.refuse_entry(size, wrong);
        }
        Ok(())
    }
}

/// `SLAVE(1,1)` of pairs that are general rows.
const GENERAL_ROWS: i64 = -1;

/// The arguments from NDIM to TANGNT.
struct Pairs<I> {
    NDIM: Integers<I>,
    NPAIR: Integers<I>,
    SLAVE: Integers<I>,
    NMAST: Integers<I>,
    MSTART: Integers<I>,
    MASTER: Integers<I>,
    WEIGHT: Argument<*const f64>,
    NORMAL: Argument<*const f64>,
    NTAN: Integers<I>,
    TANGNT: Argument<*const f64>,
}

impl<I: Integer> Pairs<I> {
    /// Hands the pairs to `work` in the form of C.
    fn with<T>(&self, work: impl FnOnce(*const SignoriniPairs) -> Outcome<T>) -> Outcome<T> {
        let (dim, pairs) = (self.NDIM.dimension()?, self.NPAIR.count()?);
        let first = self.SLAVE.numbers(pairs.min(1))?;
        let is_general = first == [GENERAL_ROWS];
        let slaves = if is_general { 0 } else { pairs * i64::from(dim) };
        let slaves = self.SLAVE.numbers(slaves)?;
        let masters = self.NMAST.count()?;
        if is_general && masters == 0 {
            let message = "SLAVE(1,1) is -1, which means general rows, but NMAST is 0: list all nodes of \
                           the pairs in MASTER";
            return Err(Failure::argument(self.NMAST.position, message));
        }
        let begins = self.begins(pairs, masters)?;
        let nodes = self.MASTER.numbers(masters * i64::from(dim))?;
        let given = self.NTAN.count()?;
        if given != 0 && given != pairs {
            return self.NTAN.refuse(format!("is {given}, it must be 0 or NPAIR ({pairs})"));
        }
        let mut view = SignoriniPairs {
            dim,
            count: pairs,
            normals: self.NORMAL.pointer,
            tangents: if given == 0 { null() } else { self.TANGNT.pointer },
            ..SignoriniPairs::zeros()
        };
        let rows = (begins.as_ptr(), nodes.as_ptr(), self.WEIGHT.pointer);
        if is_general {
            (view.row_start, view.row_nodes, view.row_weights) = rows;
        } else {
            view.slaves = slaves.as_ptr();
            if masters > 0 {
                (view.master_start, view.masters, view.weights) = rows;
            }
        }
        work(&raw const view)
    }

    /// MSTART; empty without masters.
    fn begins(&self, pairs: i64, masters: i64) -> Outcome<Vec<i64>> {
        if masters == 0 {
            return Ok(Vec::new());
        }
        let begins = self.MSTART.numbers(pairs + 1)?;
        let last = begins[pairs as usize];
        if last != masters + 1 {
            let wrong = format!("is {last}, it must be NMAST + 1 ({})", masters + 1);
            return self.MSTART.refuse_entry(pairs, wrong);
        }
        Ok(begins)
    }
}
