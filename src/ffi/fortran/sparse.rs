//! SGSPAR, SGSPAW: a model of a whole sparse matrix.

use super::super::args::Arrays;
use super::super::guard::Failure;
use super::super::model_new::{SignoriniModel, signorini_model_new_sparse_within};
use super::super::pairs::SignoriniPairs;
use super::super::settings::SignoriniSettings;
use super::super::sparse::{SIGNORINI_TRIANGLE_FULL, SIGNORINI_TRIANGLE_LOWER, SignoriniSparse};
use super::arguments::{Integer, absurd, choice, count, read, run, sizes};
use super::models::create;
use crate::error::entry;

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
    let order = std::ptr::null();
    let matrix = Matrix { n, nnz, colptr, rowind, values, tri, order };
    let pairs = Pairs { ndim, npair, slave, nmast, mstart, master, weight, normal, ntan, tangnt };
    let settings = SignoriniSettings::default_one();
    // Of the matrix the entry of C tells the argument, not which array of it: here its values. Of
    // the pairs likewise: here SLAVE.
    // SAFETY: by the caller's contract.
    unsafe {
        let make = |model| made(&matrix, (nfix, fixed), &pairs, &settings, model);
        run(info, &[5, 7, 8, 11, 19], || create(19, handle, make))
    }
}

/// SGSPAR with the host's order of elimination and limits.
///
/// # Safety
/// As include/signorini.inc demands.
pub(super) unsafe fn within<I: Integer>(
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
    nord: *const I,
    order: *const I,
    maxmem: *const f64,
    maxsec: *const f64,
    handle: *mut i64,
    info: *mut I,
) {
    let pairs = Pairs { ndim, npair, slave, nmast, mstart, master, weight, normal, ntan, tangnt };
    // SAFETY: by the caller's contract.
    let make = |model| unsafe {
        let (size, given) = (count(1, "N", n)?, count(19, "NORD", nord)?);
        if given != 0 && given != size {
            let message = format!("NORD is {given}, it must be 0 or N ({size})");
            return Err(Failure::argument(19, message));
        }
        let order = if given == 0 { std::ptr::null() } else { order };
        let matrix = Matrix { n, nnz, colptr, rowind, values, tri, order };
        let bytes = limit(21, "MAXMEM", maxmem)?;
        let settings = SignoriniSettings {
            memory_limit: bytes as i64,
            time_limit: limit(22, "MAXSEC", maxsec)?,
            ..SignoriniSettings::default_one()
        };
        made(&matrix, (nfix, fixed), &pairs, &settings, model)
    };
    // SAFETY: by the caller's contract.
    unsafe { run(info, &[5, 7, 8, 11, 22, 23], || create(23, handle, make)) }
}

/// A limit, 0 for none.
///
/// # Safety
/// As include/signorini.inc demands.
unsafe fn limit(position: i32, name: &str, value: *const f64) -> Result<f64, Failure> {
    // SAFETY: by the caller's contract.
    let value = unsafe { read(position, name, value)? };
    if value >= 0.0 {
        return Ok(value);
    }
    Err(Failure::argument(position, format!("{name} is {value}, it must be 0 (none) or more")))
}

/// # Safety
/// As include/signorini.inc demands.
unsafe fn made<I: Integer>(
    matrix: &Matrix<I>,
    (nfix, fixed): (*const I, *const I),
    pairs: &Pairs<I>,
    settings: &SignoriniSettings,
    model: *mut *mut SignoriniModel,
) -> Result<i32, Failure> {
    // SAFETY: by the caller's contract.
    unsafe {
        let matrix = matrix.read()?;
        let n_fixed = count(7, "NFIX", nfix)?;
        let fixed = numbers(8, "FIXED", fixed, n_fixed)?;
        let numbers = pairs.numbers()?;
        let interface = pairs.read(&numbers)?;
        let (matrix, interface) = (&raw const matrix, &raw const interface);
        let (fixed, settings) = (fixed.as_ptr(), &raw const *settings);
        Ok(signorini_model_new_sparse_within(matrix, n_fixed, fixed, interface, settings, model))
    }
}

/// The arguments from N to TRI, the first ones.
pub(super) struct Matrix<I> {
    pub(super) n: *const I,
    pub(super) nnz: *const I,
    pub(super) colptr: *const I,
    pub(super) rowind: *const I,
    pub(super) values: *const f64,
    pub(super) tri: *const I,
    /// NULL: chosen.
    pub(super) order: *const I,
}

impl<I: Integer> Matrix<I> {
    /// # Safety
    /// As include/signorini.inc demands.
    pub(super) unsafe fn read(&self) -> Result<SignoriniSparse, Failure> {
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
            order: self.order.cast(),
        })
    }
}

/// The arguments from NDIM, the ninth, to TANGNT.
struct Pairs<I> {
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
}

/// What `SLAVE(1,1)` is if the pairs are general rows.
const GENERAL_ROWS: i64 = -1;

/// Its sizes, and its integer arrays in the width of the entries of C.
struct Numbers {
    dim: i32,
    pairs: i64,
    /// Empty in general rows.
    slaves: Vec<i64>,
    /// Empty without masters, as `masters` is.
    begins: Vec<i64>,
    masters: Vec<i64>,
}

impl<I: Integer> Pairs<I> {
    /// # Safety
    /// As include/signorini.inc demands.
    unsafe fn numbers(&self) -> Result<Numbers, Failure> {
        // SAFETY: by the caller's contract.
        unsafe {
            let (dim, pairs) = sizes(9, self.ndim, self.npair)?;
            let first = numbers(11, "SLAVE", self.slave, pairs.min(1))?;
            let slaves = match first[..] {
                [GENERAL_ROWS] => Vec::new(),
                _ => numbers(11, "SLAVE", self.slave, pairs * i64::from(dim))?,
            };
            let masters = count(12, "NMAST", self.nmast)?;
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
            Ok(Numbers { dim, pairs, slaves, begins, masters })
        }
    }

    /// # Safety
    /// As above.
    unsafe fn read(&self, numbers: &Numbers) -> Result<SignoriniPairs, Failure> {
        let Numbers { dim, pairs, slaves, begins, masters } = numbers;
        // SAFETY: by the caller's contract.
        let tangents = unsafe { count(17, "NTAN", self.ntan)? };
        if tangents != 0 && tangents != *pairs {
            let message = format!("NTAN is {tangents}, it must be 0 or NPAIR ({pairs})");
            return Err(Failure::argument(17, message));
        }
        let null = std::ptr::null();
        let general = slaves.is_empty() && *pairs > 0;
        if general && begins.is_empty() {
            let message = "SLAVE(1,1) is -1, which means general rows, but NMAST is 0: list all nodes of \
                           the pairs in MASTER";
            return Err(Failure::argument(12, message));
        }
        let rigid = begins.is_empty() || general;
        let rows = |numbers: &Vec<i64>| if general { numbers.as_ptr() } else { std::ptr::null() };
        Ok(SignoriniPairs {
            struct_size: size_of::<SignoriniPairs>() as u32,
            dim: *dim,
            count: *pairs,
            slaves: if general { std::ptr::null() } else { slaves.as_ptr() },
            master_start: if rigid { std::ptr::null() } else { begins.as_ptr() },
            masters: if rigid { std::ptr::null() } else { masters.as_ptr() },
            weights: if rigid { null } else { self.weight },
            normals: self.normal,
            tangents: if tangents == 0 { null } else { self.tangnt },
            row_start: rows(begins),
            row_nodes: rows(masters),
            row_weights: if general { self.weight } else { null },
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

/// A copy of an integer array in the width of the entries of C.
///
/// # Safety
/// `array` has `length` entries.
pub(super) unsafe fn numbers<I: Integer>(
    position: i32,
    name: &'static str,
    array: *const I,
    length: i64,
) -> Result<Vec<i64>, Failure> {
    // SAFETY: by the caller's contract.
    let values = unsafe { Arrays::default().required(position, name, array, length as usize)? };
    Ok(values.iter().map(|value| value.wide()).collect())
}
