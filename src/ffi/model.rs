//! Models: made of what a host has, reduced once.

use super::args::{Arrays, matrix_length, size};
use super::guard::{self, Failure};
use super::host::{SignoriniPairs, SignoriniSparse, shifted};
use crate::error::{Argument, Error};
use crate::model::Model;

/// A structure, reduced to its contact pairs: what every load case shares. Made by
/// signorini_model_new_..., released by signorini_model_free. It does not change, and every function
/// that takes it const may be called from several threads at once.
pub struct SignoriniModel(Model);

/// Makes a model of a body that the host has condensed, on an obstacle: d = u.
///
/// @param dim    space dimension, 2 or 3
/// @param pairs  number of contact pairs
/// @param K      condensed stiffness, N = dim * pairs columns, as in signorini_solve; copied
/// @param ldk    entries from one column to the next, at least max(1, N)
/// @param model  out: the model, NULL unless 0 is returned
/// @return 0; -k the k-th argument is wrong; <= -1000 internal
#[unsafe(no_mangle)]
#[allow(non_snake_case)] // the names of the mechanics, which the header shows
pub unsafe extern "C" fn signorini_model_new_condensed(
    dim: i32,
    pairs: i64,
    K: *const f64,
    ldk: i64,
    model: *mut *mut SignoriniModel,
) -> i32 {
    guard::call(|| {
        let place = Place::new(5, model)?;
        let (dim, pairs, n) = dimensions(dim, pairs)?;
        let ld = size(4, "ldk", ldk)?;
        let length = matrix_length(4, "K", n, ld)?;
        let mut arrays = Arrays::default();
        // SAFETY: the length is that of the header.
        let k = unsafe { arrays.input(3, "K", K, length, true)? }.unwrap_or_default();
        place.fill(Model::condensed(dim, pairs, k, ld), |argument| match argument {
            Argument::Dimension => 1,
            Argument::Size => 2,
            Argument::LeadingDimension => 4,
            _ => 3,
        })
    })
}

/// Makes a model of two bodies that the host has condensed on matching contact nodes. Each body is
/// in its own outward frame, n_B = -n_A and t_B = -t_A, so that d = u_A + u_B. A motion that neither
/// body resists is refused; one body may float.
///
/// Loads and displacements of the host are [A; B], 2 N entries.
///
/// @param dim    space dimension, 2 or 3
/// @param pairs  number of contact pairs
/// @param K_A    condensed stiffness of body A, N = dim * pairs columns; copied
/// @param lda    entries from one column to the next, at least max(1, N)
/// @param K_B    the same of body B
/// @param ldb    the same of body B
/// @param model  out: the model, NULL unless 0 is returned
/// @return 0; -k the k-th argument is wrong; <= -1000 internal
#[unsafe(no_mangle)]
#[allow(non_snake_case)] // as above
pub unsafe extern "C" fn signorini_model_new_two_body(
    dim: i32,
    pairs: i64,
    K_A: *const f64,
    lda: i64,
    K_B: *const f64,
    ldb: i64,
    model: *mut *mut SignoriniModel,
) -> i32 {
    guard::call(|| {
        let place = Place::new(7, model)?;
        let (dim, pairs, n) = dimensions(dim, pairs)?;
        let (ld_a, ld_b) = (size(4, "lda", lda)?, size(6, "ldb", ldb)?);
        let (length_a, length_b) =
            (matrix_length(4, "K_A", n, ld_a)?, matrix_length(6, "K_B", n, ld_b)?);
        let mut arrays = Arrays::default();
        // SAFETY: the lengths are those of the header.
        let (k_a, k_b) = unsafe {
            (
                arrays.input(3, "K_A", K_A, length_a, true)?.unwrap_or_default(),
                arrays.input(5, "K_B", K_B, length_b, true)?.unwrap_or_default(),
            )
        };
        let made = Model::two_body(dim, pairs, (k_a, ld_a), (k_b, ld_b));
        place.fill(made, |argument| match argument {
            Argument::Dimension => 1,
            Argument::Size => 2,
            Argument::LeadingDimension => 4,
            Argument::SecondMatrix => 5,
            Argument::SecondLeadingDimension => 6,
            _ => 3,
        })
    })
}

/// Makes a model of the host's whole sparse stiffness matrix with contact pairs, for any number of
/// bodies and zones. Parts that only contact holds are fine.
///
/// Loads and displacements of the host are K->size entries.
///
/// @param K       the stiffness matrix, without supports; copied
/// @param fixed   number of degrees of freedom that are held
/// @param dofs    these, counted from K->base; NULL if there are none
/// @param pairs   the contact pairs; copied
/// @param model   out: the model, NULL unless 0 is returned
/// @return 0; -k the k-th argument is wrong; <= -1000 internal
#[unsafe(no_mangle)]
#[allow(non_snake_case)] // as above
pub unsafe extern "C" fn signorini_model_new_sparse(
    K: *const SignoriniSparse,
    fixed: i64,
    dofs: *const i64,
    pairs: *const SignoriniPairs,
    model: *mut *mut SignoriniModel,
) -> i32 {
    guard::call(|| {
        let place = Place::new(5, model)?;
        // SAFETY: the structures and arrays are those of the header.
        let made = unsafe {
            let matrix = SignoriniSparse::receive(1, K)?;
            let count = size(2, "fixed", fixed)?;
            let mut arrays = Arrays::default();
            let dofs = arrays.input(3, "dofs", dofs, count, true)?.unwrap_or_default();
            let fixed = shifted(3, "dofs", dofs, matrix.index_base)?;
            let pairs = SignoriniPairs::receive(4, pairs, matrix.index_base)?;
            Model::sparse(&matrix, &fixed, &pairs.view())
        };
        place.fill(made, |argument| match argument {
            Argument::Matrix => 1,
            Argument::Fixed => 3,
            _ => 4,
        })
    })
}

/// Releases a model. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_model_free(model: *mut SignoriniModel) {
    guard::call(|| {
        if !model.is_null() {
            // SAFETY: by the header's contract it came from signorini_model_new_..., once.
            drop(unsafe { Box::from_raw(model) });
        }
        Ok(0)
    });
}

/// Entries of a load or displacement vector of the model's host; -1 if model is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_model_host_size(model: *const SignoriniModel) -> i64 {
    // SAFETY: NULL or a model, by the header's contract.
    unsafe { model.as_ref() }.map_or(-1, |model| model.0.host_size() as i64)
}

/// Copies the stiffness matrix in relative displacements, K_rel.
///
/// @param model  the model
/// @param K      out: N = dim * pairs columns of N entries, without space between them
/// @return 0; -k the k-th argument is wrong
#[unsafe(no_mangle)]
#[allow(non_snake_case)] // as above
pub unsafe extern "C" fn signorini_model_stiffness(
    model: *const SignoriniModel,
    K: *mut f64,
) -> i32 {
    guard::call(|| {
        // SAFETY: a model and an array as the header demands.
        unsafe {
            let model = receive(model)?;
            let stiffness = model.stiffness();
            Arrays::default().output(2, "K", K, stiffness.len(), true)?.write(stiffness);
        }
        Ok(0)
    })
}

/// Where a new model goes; NULL until it exists.
struct Place(*mut *mut SignoriniModel);

impl Place {
    fn new(position: i32, model: *mut *mut SignoriniModel) -> Result<Self, Failure> {
        if model.is_null() || !model.is_aligned() {
            return Err(Failure::argument(position, "model is NULL or not aligned"));
        }
        // SAFETY: a place for a pointer, by the header's contract.
        unsafe { model.write(std::ptr::null_mut()) };
        Ok(Place(model))
    }

    fn fill(
        self,
        made: Result<Model, Error>,
        position: impl Fn(Argument) -> i32,
    ) -> Result<i32, Failure> {
        let model = made.map_err(|error| Failure::from_error(error, position))?;
        // SAFETY: as above.
        unsafe { self.0.write(Box::into_raw(Box::new(SignoriniModel(model)))) };
        Ok(0)
    }
}

/// # Safety
/// NULL or a model that lives during the call.
pub(super) unsafe fn receive<'a>(model: *const SignoriniModel) -> Result<&'a Model, Failure> {
    // SAFETY: by the caller's contract.
    match unsafe { model.as_ref() } {
        Some(model) => Ok(&model.0),
        None => Err(Failure::argument(1, "model is NULL")),
    }
}

fn dimensions(dim: i32, pairs: i64) -> Result<(usize, usize, usize), Failure> {
    if dim != 2 && dim != 3 {
        return Err(Failure::argument(1, format!("dim is {dim}, it must be 2 or 3")));
    }
    let (dim, pairs) = (dim as usize, size(2, "pairs", pairs)?);
    let n = pairs.checked_mul(dim).filter(|n| *n <= isize::MAX as usize / size_of::<f64>());
    let n = n.ok_or_else(|| Failure::argument(2, format!("pairs is {pairs}, too many")))?;
    Ok((dim, pairs, n))
}
