//! SGSPAR: a model of a whole sparse matrix.

use super::super::args::Arrays;
use super::super::guard::Failure;
use super::super::model_new::signorini_model_new_sparse;
use super::super::sparse::{SignoriniPairs, SignoriniSparse};
use super::arguments::{Integer, absurd, choice, count, read, run};
use super::models::create;

/// # Safety
/// As include/signorini.inc demands.
pub(super) unsafe fn new<I: Integer>(
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
    info: *mut I,
) {
    // SAFETY: by the caller's contract.
    let make = |model| unsafe {
        let size = count(1, "N", n)?;
        let entries = read(2, "NNZ", nnz)?.wide();
        // More than a triangle has. In 8 bytes there may be more than 2^31 of them.
        if entries < 0 || entries > size.saturating_mul(size) {
            return Err(absurd::<I>(2, "NNZ", entries));
        }
        let triangle = choice(6, "TRI", tri)?;
        if !(0..=2).contains(&triangle) {
            let message = format!("TRI is {triangle}, it must be 0, 1 or 2");
            return Err(Failure::argument(6, message));
        }
        check_begins(size, entries, colptr)?;
        let held = count(7, "NFIX", nfix)?;
        let dim = choice(9, "NDIM", ndim)?;
        if dim != 2 && dim != 3 {
            return Err(Failure::argument(9, format!("NDIM is {dim}, it must be 2 or 3")));
        }
        let pairs = count(10, "NPAIR", npair)?;
        let masters = count(12, "NMAST", nmast)?;
        let tangents = count(17, "NTAN", ntan)?;
        if tangents != 0 && tangents != pairs {
            let message = format!("NTAN is {tangents}, it must be 0 or NPAIR ({pairs})");
            return Err(Failure::argument(17, message));
        }
        let fixed = numbers(8, "FIXED", fixed, held)?;
        let slaves = numbers(11, "SLAVE", slave, pairs * i64::from(dim))?;
        let mut begins = Vec::new();
        if masters > 0 {
            begins = numbers(13, "MSTART", mstart, pairs + 1)?;
            if begins.last() != Some(&(masters + 1)) {
                let last = begins[pairs as usize];
                let message = format!(
                    "MSTART({}) is {last}, it must be NMAST + 1 ({})",
                    pairs + 1,
                    masters + 1
                );
                return Err(Failure::argument(13, message));
            }
        }
        let masters = numbers(14, "MASTER", master, masters * i64::from(dim))?;
        let matrix = SignoriniSparse {
            struct_size: size_of::<SignoriniSparse>() as u32,
            index_bytes: I::BYTES,
            index_base: 1,
            triangle,
            size,
            nnz: entries,
            col_start: colptr.cast(),
            row: rowind.cast(),
            values,
        };
        let interface = SignoriniPairs {
            struct_size: size_of::<SignoriniPairs>() as u32,
            dim,
            count: pairs,
            slaves: slaves.as_ptr(),
            master_start: if begins.is_empty() { std::ptr::null() } else { begins.as_ptr() },
            masters: if begins.is_empty() { std::ptr::null() } else { masters.as_ptr() },
            weights: if begins.is_empty() { std::ptr::null() } else { weight },
            normals: normal,
            tangents: if tangents == 0 { std::ptr::null() } else { tangnt },
        };
        let (matrix, interface) = (&raw const matrix, &raw const interface);
        Ok(signorini_model_new_sparse(matrix, held, fixed.as_ptr(), interface, model))
    };
    // Of the matrix the entry of C tells the argument, not which array of it: here its values.
    // SAFETY: by the caller's contract.
    unsafe { run(info, &[5, 7, 8, 11, 19], || create(19, handle, make)) }
}

/// The begins of the columns, before ROWIND and VALUES are believed to be as long as NNZ says.
///
/// # Safety
/// `colptr` has `size` + 1 entries.
unsafe fn check_begins<I: Integer>(
    size: i64,
    entries: i64,
    colptr: *const I,
) -> Result<(), Failure> {
    let length = size as usize + 1;
    // SAFETY: by the caller's contract.
    let begins = unsafe { Arrays::default().required(3, "COLPTR", colptr, length)? };
    let refuse = |i: usize, wanted: String| {
        let value = begins[i].wide();
        Err(Failure::argument(3, format!("COLPTR({}) is {value}, it must be {wanted}", i + 1)))
    };
    if begins[0].wide() != 1 {
        return refuse(0, "1: indices count from 1, in integers of this entry".to_owned());
    }
    if begins[length - 1].wide() != entries + 1 {
        return refuse(length - 1, format!("NNZ + 1 ({})", entries + 1));
    }
    Ok(())
}

/// A copy of an integer array in the width of the entries of C.
///
/// # Safety
/// `array` has `length` entries.
unsafe fn numbers<I: Integer>(
    position: i32,
    name: &'static str,
    array: *const I,
    length: i64,
) -> Result<Vec<i64>, Failure> {
    // SAFETY: by the caller's contract.
    let values = unsafe { Arrays::default().required(position, name, array, length as usize)? };
    Ok(values.iter().map(|value| value.wide()).collect())
}
