//! Models: made of what a host has, reduced once.

use super::args::{Arrays, matrix_length, size, sizes};
use super::guard::{self, Failure};
use super::model::{SignoriniModel, read};
use super::pairs::SignoriniPairs;
use super::settings::SignoriniSettings;
use super::sparse::{STIFFNESS, SignoriniSparse, shifted};
use crate::error::{Argument, Error};
use crate::model::Model;
use crate::reduce;
use crate::shortage;

/// Makes a model of a body that you have condensed, on a rigid obstacle: d = u. Loads and
/// displacements of the host have H = N entries.
///
/// @param dim    space dimension, 2 or 3
/// @param pairs  number of contact pairs
/// @param K      condensed stiffness, N = dim * pairs columns, as for signorini_solve
/// @param ldk    entries from one column to the next, at least max(1, N)
/// @param model  out: the model; NULL unless 0 is returned
/// @return 0; -k: the k-th argument is wrong; <= -1000: out of memory or a defect
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
        let (dim, pairs, n) = sizes(1, dim, pairs)?;
        let ld = size(4, "ldk", ldk)?;
        let length = matrix_length(4, "K", n, ld)?;
        let mut arrays = Arrays::default();
        // SAFETY: the length is that of the header.
        let k = unsafe { arrays.matrix(3, "K", K, length)? };
        guard::reserve_estimate(reduce::memory(n))?;
        place.fill(Model::condensed(dim, pairs, k, ld), |argument| match argument {
            Argument::Dimension => 1,
            Argument::Size => 2,
            Argument::LeadingDimension => 4,
            _ => 3,
        })
    })
}

/// Makes a model of two bodies that you have condensed on matching contact nodes, each in its own
/// outward frame: n_B = -n_A and t_B = -t_A, so that d = u_A + u_B. One body may float. A motion
/// that neither body resists is refused. Loads and displacements of the host are [A; B], H = 2 N
/// entries.
///
/// @param dim    space dimension, 2 or 3
/// @param pairs  number of contact pairs
/// @param K_A    condensed stiffness of body A, N = dim * pairs columns
/// @param lda    entries from one column to the next, at least max(1, N)
/// @param K_B    condensed stiffness of body B
/// @param ldb    entries from one column to the next, at least max(1, N)
/// @param model  out: the model; NULL unless 0 is returned
/// @return 0; -k: the k-th argument is wrong; <= -1000: out of memory or a defect
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
        let (dim, pairs, n) = sizes(1, dim, pairs)?;
        let (ld_a, ld_b) = (size(4, "lda", lda)?, size(6, "ldb", ldb)?);
        let (length_a, length_b) =
            (matrix_length(4, "K_A", n, ld_a)?, matrix_length(6, "K_B", n, ld_b)?);
        let mut arrays = Arrays::default();
        // SAFETY: the lengths are those of the header.
        let (k_a, k_b) = unsafe {
            (arrays.matrix(3, "K_A", K_A, length_a)?, arrays.matrix(5, "K_B", K_B, length_b)?)
        };
        guard::reserve_estimate(reduce::memory(n))?;
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

/// Makes a model of your whole sparse stiffness matrix with contact pairs, for any number of bodies
/// and contact zones. Bodies that only contact supports are allowed. Loads and displacements of the
/// host have H = K->size entries.
///
/// @param K        the stiffness matrix of all degrees of freedom, the fixed ones too
/// @param n_fixed  number of fixed degrees of freedom
/// @param fixed    the fixed degrees of freedom, counted from K->index_base; may be NULL if n_fixed
///                 is 0
/// @param pairs    the contact pairs
/// @param model    out: the model; NULL unless 0 is returned
/// @return 0; -k: the k-th argument is wrong; <= -1000: out of memory or a defect
#[unsafe(no_mangle)]
#[allow(non_snake_case)] // as above
pub unsafe extern "C" fn signorini_model_new_sparse(
    K: *const SignoriniSparse,
    n_fixed: i64,
    fixed: *const i64,
    pairs: *const SignoriniPairs,
    model: *mut *mut SignoriniModel,
) -> i32 {
    guard::call(|| {
        let place = Place::new(5, model)?;
        let settings = std::ptr::null();
        // SAFETY: the structures and arrays are those of the header.
        unsafe { sparse(K, (n_fixed, fixed), pairs, (5, settings), place) }
    })
}

/// As signorini_model_new_sparse, with settings of which it takes progress, user, time_limit,
/// memory_limit, full_space and threads. The callback is told the share that is done and, before
/// memory is taken, how much is needed. The choice of the order, before that, asks nobody. After a
/// call that was ended nothing is held, and your arrays are as before.
///
/// If the condensed matrix needs more than memory_limit, or settings->full_space is set, the model
/// is in full space: no condensed matrix is formed. Load cases are solved by Newton's method with
/// GMRES on a sparse factor, which each load case makes anew a few times; methods AUTO and NEWTON
/// alone, no search, no proof. signorini_model_stiffness and _write have nothing to tell then. Pairs
/// that depend on each other are condensed all the same. K->order is not read for it.
///
/// @param K         the stiffness matrix of all degrees of freedom, the fixed ones too
/// @param n_fixed   number of fixed degrees of freedom
/// @param fixed     the fixed degrees of freedom, counted from K->index_base; may be NULL if
///                  n_fixed is 0
/// @param pairs     the contact pairs
/// @param settings  may be NULL: no callback, no limits
/// @param model     out: the model; NULL unless 0 is returned
/// @return 0; SIGNORINI_STATUS_CANCELLED, _TIME_LIMIT or _MEMORY_LIMIT; -k: the k-th argument is
///         wrong; <= -1000: out of memory or a defect
#[unsafe(no_mangle)]
#[allow(non_snake_case)] // as above
pub unsafe extern "C" fn signorini_model_new_sparse_within(
    K: *const SignoriniSparse,
    n_fixed: i64,
    fixed: *const i64,
    pairs: *const SignoriniPairs,
    settings: *const SignoriniSettings,
    model: *mut *mut SignoriniModel,
) -> i32 {
    guard::call(|| {
        let place = Place::new(6, model)?;
        // SAFETY: the structures and arrays are those of the header.
        unsafe { sparse(K, (n_fixed, fixed), pairs, (5, settings), place) }
    })
}

/// # Safety
/// The structures and arrays are those of the header.
#[allow(non_snake_case)] // as above
unsafe fn sparse(
    K: *const SignoriniSparse,
    (n_fixed, fixed): (i64, *const i64),
    pairs: *const SignoriniPairs,
    (position, settings): (i32, *const SignoriniSettings),
    place: Place,
) -> Result<i32, Failure> {
    // SAFETY: by the caller's contract.
    let made = unsafe {
        let matrix = SignoriniSparse::read(&mut Arrays::default(), 1, &STIFFNESS, K)?;
        let order = SignoriniSparse::order(1, K)?;
        let count = size(2, "n_fixed", n_fixed)?;
        let fixed = Arrays::default().required(3, "fixed", fixed, count)?;
        let fixed = shifted(3, "fixed", fixed, matrix.index_base)?;
        let pairs = SignoriniPairs::read(4, pairs, matrix.index_base)?;
        let view = pairs.view();
        guard::reserve_estimate(reduce::memory(view.dim * view.count))?;
        let received = SignoriniSettings::read(position, settings)?;
        let wrong = |error| Failure::from_error(error, |_| position);
        received.settings.validate().map_err(wrong)?;
        received.monitored(|monitor| {
            Model::sparse_within(&matrix, &fixed, &view, order.as_deref(), monitor)
        })
    };
    place.fill(made, |argument| match argument {
        Argument::Matrix | Argument::Order => 1,
        Argument::Fixed => 3,
        _ => 4,
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

/// Space dimension, 2 or 3; -1 if model is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_model_dim(model: *const SignoriniModel) -> i32 {
    // SAFETY: NULL or a model, by the header's contract.
    unsafe { model.as_ref() }.map_or(-1, |model| model.model().dim() as i32)
}

/// Number of contact pairs; -1 if model is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_model_pairs(model: *const SignoriniModel) -> i64 {
    // SAFETY: as above.
    unsafe { model.as_ref() }.map_or(-1, |model| model.model().pairs() as i64)
}

/// H, the entries of a load or displacement vector of the host; -1 if model is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_model_host_size(model: *const SignoriniModel) -> i64 {
    // SAFETY: as above.
    unsafe { model.as_ref() }.map_or(-1, |model| model.model().host_size() as i64)
}

/// Copies the stiffness matrix in relative displacements. There is none if pairs depend on each
/// other, such as those of a node on two planes, and in full space.
///
/// @param model  the model
/// @param K      out: N = dim * pairs columns of N entries; leading dimension N
/// @return 0; -k: the k-th argument is wrong; -1 too: there is no such matrix
#[unsafe(no_mangle)]
#[allow(non_snake_case)] // as above
pub unsafe extern "C" fn signorini_model_stiffness(
    model: *const SignoriniModel,
    K: *mut f64,
) -> i32 {
    guard::call(|| {
        // SAFETY: a model and an array as the header demands.
        unsafe {
            let model = read(model)?;
            let wrong = |error| Failure::from_error(error, |_| 1);
            model.check_independent().map_err(wrong)?;
            model.check_formed().map_err(wrong)?;
            let stiffness = model.stiffness();
            Arrays::default().output_matrix(2, "K", K, stiffness.len())?.write(stiffness);
        }
        Ok(0)
    })
}

/// Copies the frames of the pairs of a sparse model, to turn d and F to global axes:
/// vector = n d_n + t d_t (2D) or n d_n + t1 d_t1 + t2 d_t2 (3D). Other models have no frames: they
/// were condensed in frames of your own.
///
/// @param model   a model of signorini_model_new_sparse
/// @param frames  out: for each pair the normal, then the tangents, each a unit vector of dim
///                entries; dim * dim entries a pair
/// @return 0; -k: the k-th argument is wrong; -1 too: the model has no frames
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_model_frames(
    model: *const SignoriniModel,
    frames: *mut f64,
) -> i32 {
    guard::call(|| {
        // SAFETY: a model and an array as the header demands.
        unsafe {
            let Some(given) = read(model)?.frames() else {
                let message = "this model has no frames: its matrix was condensed by the host, in \
                               frames that only the host knows";
                return Err(Failure::argument(1, message));
            };
            Arrays::default().output(2, "frames", frames, given.len())?.write(given);
        }
        Ok(0)
    })
}

/// Where a new model goes; NULL until it exists.
pub(super) struct Place(*mut *mut SignoriniModel);

impl Place {
    pub(super) fn new(position: i32, model: *mut *mut SignoriniModel) -> Result<Self, Failure> {
        if model.is_null() || !model.is_aligned() {
            return Err(Failure::argument(position, "model is NULL or not aligned"));
        }
        // SAFETY: a place for a pointer, by the header's contract.
        unsafe { model.write(std::ptr::null_mut()) };
        Ok(Place(model))
    }

    pub(super) fn fill(
        self,
        made: Result<Model, Error>,
        position: impl Fn(Argument) -> i32,
    ) -> Result<i32, Failure> {
        let model = made.map_err(|error| Failure::from_error(error, position))?;
        let model = Box::new(SignoriniModel::new(model));
        // Nothing that lives on may stand in the reserve of the call.
        shortage::check();
        // SAFETY: as above.
        unsafe { self.0.write(Box::into_raw(model)) };
        Ok(0)
    }
}
