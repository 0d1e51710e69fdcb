//! SGSPAR: a model of a whole sparse matrix.

use std::ptr::null;

use super::super::guard::Failure;
use super::super::model::SignoriniModel;
use super::super::model_new::signorini_model_new_sparse;
use super::super::pairs::SignoriniPairs;
use super::super::sparse::{SIGNORINI_TRIANGLE_FULL, SIGNORINI_TRIANGLE_LOWER, SignoriniSparse};
use super::super::structures::Structure;
use super::arguments::{Given, Integer, absurd, run};
use super::handles::create;
use crate::error::entry;

entry! {
    // The function of C tells that the matrix is wrong, and not which array of it: here its values. Likewise the
    // pairs: here SLAVE.
    sgspar_ sgspar_64_ positions [5, 7, 8, 11, 19, 19],
    (
        n: Given<I>,
        nnz: Given<I>,
        colptr: Given<I>,
        rowind: Given<I>,
        values: *const f64,
        tri: Given<I>,
        nfix: Given<I>,
        fixed: Given<I>,
        ndim: Given<I>,
        npair: Given<I>,
        slave: Given<I>,
        nmast: Given<I>,
        mstart: Given<I>,
        master: Given<I>,
        weight: *const f64,
        normal: *const f64,
        ntan: Given<I>,
        tangnt: *const f64,
        handle: *mut i64,
    ) {
        create(19, handle, |model| {
            let matrix = Matrix { n, nnz, colptr, rowind, values, tri, nfix, fixed };
            let nodes = Nodes { slave, nmast, mstart, master, weight };
            let pairs = (ndim.dimension(9)?, npair.count(10, "NPAIR")?);
            nodes.with_pairs(pairs, normal, (ntan, tangnt), |pairs| matrix.with(pairs, model))
        })
    }
}

/// The arguments from N to FIXED, the first ones.
pub(super) struct Matrix<I> {
    pub(super) n: Given<I>,
    pub(super) nnz: Given<I>,
    pub(super) colptr: Given<I>,
    pub(super) rowind: Given<I>,
    pub(super) values: *const f64,
    pub(super) tri: Given<I>,
    pub(super) nfix: Given<I>,
    pub(super) fixed: Given<I>,
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
        let matrix = self.read()?;
        let held = self.nfix.count(7, "NFIX")?;
        let fixed = self.fixed.numbers(8, "FIXED", held)?;
        let (matrix, fixed) = (&raw const matrix, fixed.as_ptr());
        // SAFETY: by the caller's contract.
        Ok(unsafe { signorini_model_new_sparse(matrix, held, fixed, pairs, null(), model) })
    }

    fn read(&self) -> Result<SignoriniSparse, Failure> {
        let size = self.n.count(1, "N")?;
        let nnz = self.nnz.read(2, "NNZ")?.wide();
        // More than a full matrix has. In 8 bytes there may be more than 2^31 of them.
        if nnz < 0 || nnz > size.saturating_mul(size) {
            return Err(absurd::<I>(2, "NNZ", nnz));
        }
        let triangles = SIGNORINI_TRIANGLE_LOWER..=SIGNORINI_TRIANGLE_FULL;
        let triangle = self.tri.one_of(6, "TRI", triangles, "0 (lower), 1 (upper) or 2 (all)")?;
        check_begins(size, nnz, self.colptr)?;
        Ok(SignoriniSparse {
            index_bytes: I::BYTES,
            index_base: 1,
            triangle,
            size,
            nnz,
            col_start: self.colptr.address(),
            row: self.rowind.address(),
            values: self.values,
            ..SignoriniSparse::zeros()
        })
    }
}

/// The begins of the columns, before ROWIND and VALUES are believed to be as long as NNZ says.
fn check_begins<I: Integer>(size: i64, nnz: i64, colptr: Given<I>) -> Result<(), Failure> {
    let begins = colptr.slice(3, "COLPTR", size + 1)?;
    let last = begins.len() - 1;
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

/// The arguments from SLAVE, the eleventh, to WEIGHT.
struct Nodes<I> {
    slave: Given<I>,
    nmast: Given<I>,
    mstart: Given<I>,
    master: Given<I>,
    weight: *const f64,
}

impl<I: Integer> Nodes<I> {
    /// Hands pairs of these nodes to `work` in the form of C.
    fn with_pairs<T>(
        &self,
        (dim, pairs): (i32, i64),
        normals: *const f64,
        (ntan, tangents): (Given<I>, *const f64),
        work: impl FnOnce(*const SignoriniPairs) -> Result<T, Failure>,
    ) -> Result<T, Failure> {
        let first = self.slave.numbers(11, "SLAVE", pairs.min(1))?;
        let is_general = first == [GENERAL_ROWS];
        let slaves = if is_general { 0 } else { pairs * i64::from(dim) };
        let slaves = self.slave.numbers(11, "SLAVE", slaves)?;
        let masters = self.nmast.count(12, "NMAST")?;
        if is_general && masters == 0 {
            let message = "SLAVE(1,1) is -1, which means general rows, but NMAST is 0: list all nodes of \
                           the pairs in MASTER";
            return Err(Failure::argument(12, message));
        }
        let begins = self.begins(pairs, masters)?;
        let nodes = self.master.numbers(14, "MASTER", masters * i64::from(dim))?;
        let given = ntan.count(17, "NTAN")?;
        if given != 0 && given != pairs {
            let message = format!("NTAN is {given}, it must be 0 or NPAIR ({pairs})");
            return Err(Failure::argument(17, message));
        }
        let mut view = SignoriniPairs {
            dim,
            count: pairs,
            normals,
            tangents: if given == 0 { null() } else { tangents },
            ..SignoriniPairs::zeros()
        };
        let rows = (begins.as_ptr(), nodes.as_ptr(), self.weight);
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
    fn begins(&self, pairs: i64, masters: i64) -> Result<Vec<i64>, Failure> {
        if masters == 0 {
            return Ok(Vec::new());
        }
        let begins = self.mstart.numbers(13, "MSTART", pairs + 1)?;
        let last = begins[pairs as usize];
        if last != masters + 1 {
            let place = entry("MSTART", [pairs]);
            let message = format!("{place} is {last}, it must be NMAST + 1 ({})", masters + 1);
            return Err(Failure::argument(13, message));
        }
        Ok(begins)
    }
}
