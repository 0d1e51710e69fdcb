//! SGSPAR: a model of a whole sparse matrix.

use std::ptr::null;

use super::super::args::Arrays;
use super::super::guard::Failure;
use super::super::model::SignoriniModel;
use super::super::model_new::signorini_model_new_sparse;
use super::super::pairs::SignoriniPairs;
use super::super::sparse::{SIGNORINI_TRIANGLE_FULL, SIGNORINI_TRIANGLE_LOWER, SignoriniSparse};
use super::arguments::{Integer, absurd, choice, count, numbers, read, run, sizes};
use super::handles::create;
use crate::error::entry;

entry! {
    // The function of C tells that the matrix is wrong, and not which array of it: here its values. Likewise the
    // pairs: here SLAVE.
    sgspar_ sgspar_64_ positions [5, 7, 8, 11, 19, 19],
    (
        n: *const I,
        nnz: *const I,
        colptr: *const I,
        rowind: *const I,
        values: *const f64,
        tri: *const I,
        nfix: *const I,
        fixed: *const I,
        ndim: *const I,
        npair: *const I,
        slave: *const I,
        nmast: *const I,
        mstart: *const I,
        master: *const I,
        weight: *const f64,
        normal: *const f64,
        ntan: *const I,
        tangnt: *const f64,
        handle: *mut i64,
    ) {
        create(19, handle, |model| {
            let matrix = Matrix { n, nnz, colptr, rowind, values, tri, nfix, fixed };
            let lists = Lists { ndim, npair, slave, nmast, mstart, master };
            let lists = lists.read()?;
            let pairs = pairs(&lists, (weight, normal), (ntan, tangnt))?;
            matrix.with(&raw const pairs, model)
        })
    }
}

/// The arguments from N to FIXED, the first ones.
pub(super) struct Matrix<I> {
    pub(super) n: *const I,
    pub(super) nnz: *const I,
    pub(super) colptr: *const I,
    pub(super) rowind: *const I,
    pub(super) values: *const f64,
    pub(super) tri: *const I,
    pub(super) nfix: *const I,
    pub(super) fixed: *const I,
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
    ) -> Result<i32, Failure> {
        // SAFETY: by the caller's contract.
        unsafe {
            let matrix = self.read()?;
            let held = count(7, "NFIX", self.nfix)?;
            let fixed = numbers(8, "FIXED", self.fixed, held)?;
            let (matrix, fixed) = (&raw const matrix, fixed.as_ptr());
            Ok(signorini_model_new_sparse(matrix, held, fixed, pairs, null(), model))
        }
    }

    /// # Safety
    /// As above.
    unsafe fn read(&self) -> Result<SignoriniSparse, Failure> {
        // SAFETY: by the caller's contract.
        let (size, nnz, triangle) = unsafe {
            (count(1, "N", self.n)?, read(2, "NNZ", self.nnz)?.wide(), choice(6, "TRI", self.tri)?)
        };
        // More than a full matrix has. In 8 bytes there may be more than 2^31 of them.
        if nnz < 0 || nnz > size.saturating_mul(size) {
            return Err(absurd::<I>(2, "NNZ", nnz));
        }
        if !(SIGNORINI_TRIANGLE_LOWER..=SIGNORINI_TRIANGLE_FULL).contains(&triangle) {
            let message = format!("TRI is {triangle}, it must be 0 (lower), 1 (upper) or 2 (all)");
            return Err(Failure::argument(6, message));
        }
        // SAFETY: as above.
        unsafe { check_begins(size, nnz, self.colptr)? };
        Ok(SignoriniSparse {
            struct_size: size_of::<SignoriniSparse>() as u32,
            index_bytes: I::BYTES,
            index_base: 1,
            triangle,
            size,
            nnz,
            col_start: self.colptr.cast(),
            row: self.rowind.cast(),
            values: self.values,
            order: null(),
        })
    }
}

/// The begins of the columns, before ROWIND and VALUES are believed to be as long as NNZ says.
///
/// # Safety
/// `colptr` has `size` + 1 entries.
unsafe fn check_begins<I: Integer>(size: i64, nnz: i64, colptr: *const I) -> Result<(), Failure> {
    let last = size as usize;
    // SAFETY: by the caller's contract.
    let begins = unsafe { Arrays::default().required(3, "COLPTR", colptr, last + 1)? };
    let refuse = |i: usize, wanted: String| {
        let (place, value) = (entry("COLPTR", [i]), begins[i].wide());
        Err(Failure::argument(3, format!("{place} is {value}, it must be {wanted}")))
    };
    if begins[0].wide() != 1 {
        let bytes = I::BYTES;
        return refuse(0, format!("1: indices count from 1, in integers of {bytes} bytes"));
    }
    if begins[last].wide() != nnz + 1 {
        return refuse(last, format!("NNZ + 1 ({})", nnz + 1));
    }
    Ok(())
}

/// `SLAVE(1,1)` of pairs that are general rows.
const GENERAL_ROWS: i64 = -1;

/// The arguments from NDIM, the ninth, to MASTER.
struct Lists<I> {
    ndim: *const I,
    npair: *const I,
    slave: *const I,
    nmast: *const I,
    mstart: *const I,
    master: *const I,
}

/// Their integers in the width of the functions of C.
struct Wide {
    dim: i32,
    pairs: i64,
    /// Empty in general rows.
    slaves: Vec<i64>,
    /// Empty without masters, as `masters` is.
    begins: Vec<i64>,
    masters: Vec<i64>,
}

impl<I: Integer> Lists<I> {
    /// # Safety
    /// As include/signorini.inc demands.
    unsafe fn read(&self) -> Result<Wide, Failure> {
        // SAFETY: by the caller's contract.
        unsafe {
            let (dim, pairs) = sizes(9, self.ndim, self.npair)?;
            let first = numbers(11, "SLAVE", self.slave, pairs.min(1))?;
            let general = first == [GENERAL_ROWS];
            let slaves = if general { 0 } else { pairs * i64::from(dim) };
            let slaves = numbers(11, "SLAVE", self.slave, slaves)?;
            let masters = count(12, "NMAST", self.nmast)?;
            if general && masters == 0 {
                let message = "SLAVE(1,1) is -1, which means general rows, but NMAST is 0: list all nodes of \
                               the pairs in MASTER";
                return Err(Failure::argument(12, message));
            }
            let mut begins = Vec::new();
            if masters > 0 {
                begins = numbers(13, "MSTART", self.mstart, pairs + 1)?;
                let last = begins[pairs as usize];
                if last != masters + 1 {
                    let place = entry("MSTART", [pairs]);
                    let message =
                        format!("{place} is {last}, it must be NMAST + 1 ({})", masters + 1);
                    return Err(Failure::argument(13, message));
                }
            }
            let masters = numbers(14, "MASTER", self.master, masters * i64::from(dim))?;
            Ok(Wide { dim, pairs, slaves, begins, masters })
        }
    }
}

/// The pairs of these lists.
///
/// # Safety
/// As include/signorini.inc demands.
unsafe fn pairs<I: Integer>(
    Wide { dim, pairs, slaves, begins, masters }: &Wide,
    (weights, normals): (*const f64, *const f64),
    (ntan, tangnt): (*const I, *const f64),
) -> Result<SignoriniPairs, Failure> {
    // SAFETY: by the caller's contract.
    let tangents = unsafe { count(17, "NTAN", ntan)? };
    if tangents != 0 && tangents != *pairs {
        let message = format!("NTAN is {tangents}, it must be 0 or NPAIR ({pairs})");
        return Err(Failure::argument(17, message));
    }
    let mut view = SignoriniPairs {
        struct_size: size_of::<SignoriniPairs>() as u32,
        dim: *dim,
        count: *pairs,
        normals,
        tangents: if tangents == 0 { null() } else { tangnt },
        ..SignoriniPairs::EMPTY
    };
    if slaves.is_empty() && *pairs > 0 {
        view.row_start = begins.as_ptr();
        view.row_nodes = masters.as_ptr();
        view.row_weights = weights;
        return Ok(view);
    }
    view.slaves = slaves.as_ptr();
    if !begins.is_empty() {
        view.master_start = begins.as_ptr();
        view.masters = masters.as_ptr();
        view.weights = weights;
    }
    Ok(view)
}
