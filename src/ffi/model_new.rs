//! Models: made of what a host has, reduced once.

use super::args::c_entry;
use super::guard;
use super::handle::release;
use super::model::SignoriniModel;
use super::pairs::SignoriniPairs;
use super::settings::SignoriniSettings;
use super::sparse::SignoriniSparse;
use crate::error::Argument::{Fixed, Matrix, Order, SecondMatrix};
use crate::model::Model;
use crate::reduce;

/// Makes a model of a body that you have condensed, on a rigid obstacle: d = u, H = N.
///
/// @param dim,pairs,K,ldk  as for signorini_solve
/// @param settings,model   as for signorini_model_new_sparse; full_space has no effect
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_model_new_condensed(
    dim: i32,
    pairs: i64,
    K: *const f64,
    ldk: i64,
    settings: *const SignoriniSettings,
    model: *mut *mut SignoriniModel,
) -> i32 {
    c_entry!(|arrays| {
        let place = arrays.at(6, "model").out_pointer(model)?;
        let [dim, pairs, n] = arrays.sizes([1, 2], dim, pairs)?;
        let k = arrays.at(3, "K").square(K, ("ldk", ldk), n)?;
        let received = SignoriniSettings::read(arrays.at(5, "settings"), settings)?;
        guard::reserve_estimate(reduce::memory(n))?;
        let made = received.monitored(|monitor| Model::condensed_within(dim, pairs, k, monitor));
        place.fill(made.map_err(arrays.refused(3))?)
    })
}

/// Makes a model of two bodies that you have condensed on matching contact nodes, each in its own
/// outward frame: n_B = -n_A and t_B = -t_A, so that d = u_A + u_B. One body may float; a motion
/// that neither resists is refused. Loads and displacements are [A; B], H = 2 N.
///
/// @param dim,pairs,settings,model  as for signorini_model_new_condensed
/// @param K_A,lda,K_B,ldb  stiffness of each body, as K and ldk for signorini_solve
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_model_new_two_body(
    dim: i32,
    pairs: i64,
    K_A: *const f64,
    lda: i64,
    K_B: *const f64,
    ldb: i64,
    settings: *const SignoriniSettings,
    model: *mut *mut SignoriniModel,
) -> i32 {
    c_entry!(|arrays| {
        let place = arrays.at(8, "model").out_pointer(model)?;
        let [dim, pairs, n] = arrays.sizes([1, 2], dim, pairs)?;
        let first = arrays.at(3, "K_A").square(K_A, ("lda", lda), n)?;
        let second = arrays.at(5, "K_B").is(SecondMatrix).square(K_B, ("ldb", ldb), n)?;
        let received = SignoriniSettings::read(arrays.at(7, "settings"), settings)?;
        guard::reserve_estimate(reduce::memory(n))?;
        let made = received
            .monitored(|monitor| Model::two_body_within(dim, pairs, [first, second], monitor));
        place.fill(made.map_err(arrays.refused(3))?)
    })
}

/// Makes a model of your whole sparse stiffness matrix with contact pairs, for any number of bodies
/// and contact zones. H = K->size.
///
/// If the condensed model needs more than memory_limit, or than the system has, the model is in
/// full space (data.kind): load cases are solved by Newton's method; methods other than AUTO and
/// NEWTON, search and settings.proof are refused. Dependent pairs are condensed.
///
/// @param K         the stiffness of all degrees of freedom, the fixed ones too
/// @param n_fixed,fixed  number of fixed degrees of freedom, and these
/// @param pairs     the contact pairs
/// @param settings  NULL: the defaults. It reads progress, user, time_limit, memory_limit, threads
///                  and full_space
/// @param model     out: the model
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_model_new_sparse(
    K: *const SignoriniSparse,
    n_fixed: i64,
    fixed: *const i64,
    pairs: *const SignoriniPairs,
    settings: *const SignoriniSettings,
    model: *mut *mut SignoriniModel,
) -> i32 {
    c_entry!(|arrays| {
        let place = arrays.at(6, "model").out_pointer(model)?;
        let at = arrays.at(1, "K").is(Matrix).is(Order);
        let (given, matrix) = SignoriniSparse::read(at, K)?;
        let order = given.order(at)?;
        let count = arrays.at(2, "n_fixed").size(n_fixed)?;
        let base = matrix.index_base;
        let fixed = arrays.at(3, "fixed").is(Fixed).indices(fixed, count, base)?;
        let received = SignoriniSettings::read(arrays.at(5, "settings"), settings)?;
        let made = SignoriniPairs::with(arrays.at(4, "pairs"), pairs, base, |pairs| {
            guard::reserve_estimate(reduce::memory_of_vectors(pairs.dim * pairs.count))?;
            Ok(received.monitored(|monitor| {
                Model::sparse_within(&matrix, &fixed, pairs, order.as_deref(), monitor)
            }))
        })?;
        place.fill(made.map_err(arrays.refused(4))?)
    })
}

/// Makes a model in flexibility form: d = W F + q takes the place of K d = f + F. Contact, friction
/// and signs stay. In load cases f holds q, the relative displacements without contact forces, and
/// F the start if settings.warm_start is set; H = N. W may be singular, as with redundant pairs:
/// then contact forces are not unique, and report.uniqueness is never UNIQUE.
///
/// Codes with u = W r + q, where u_N >= 0 opens a contact and r_N >= 0 presses (FCLIB, Siconos,
/// most multibody codes), hand over -q; then u = -d and r = -F. Velocities and impulses may take
/// the places of displacements and forces.
///
/// report.eta is relative to the larger of F and q, the latter turned into a force. If open pairs
/// move freely by far more than forces undo elsewhere, ask for a smaller tolerance.
/// SIGNORINI_STATUS_NO_EQUILIBRIUM proves that the gaps contradict each other. If friction wedges
/// bodies, SIGNORINI_STATUS_STALLED follows, and the sentence names the pairs whose forces grow.
///
/// @param dim,pairs,model  as for signorini_model_new_condensed
/// @param W,ldw  flexibility, as K and ldk for signorini_solve, but length / force, and not zero. A
///               row of zeros is a component that nothing moves
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_model_new_flexibility(
    dim: i32,
    pairs: i64,
    W: *const f64,
    ldw: i64,
    model: *mut *mut SignoriniModel,
) -> i32 {
    c_entry!(|arrays| {
        let place = arrays.at(5, "model").out_pointer(model)?;
        let [dim, pairs, n] = arrays.sizes([1, 2], dim, pairs)?;
        let (w, ld) = arrays.at(3, "W").square(W, ("ldw", ldw), n)?;
        guard::reserve(n.saturating_mul(n).saturating_mul(size_of::<f64>()))?;
        place.fill(Model::flexibility(dim, pairs, w, ld).map_err(arrays.refused(3))?)
    })
}

/// Makes a model in flexibility form of a sparse matrix. Pairs that no entry of W ties to each
/// other are islands, each solved as a dense problem of its own; the largest decides the memory.
///
/// The status is that of the worst island; an island without equilibrium does not stop the others.
/// At a limit, or where the callback cancels, islands that are left keep the start. report.method,
/// omega and damping are those of the largest island with the status; counts are sums.
///
/// @param dim,pairs,model  as for signorini_model_new_condensed
/// @param W  W->size = N; rows of zeros need not be stored; stored zeros tie nothing
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_model_new_flexibility_sparse(
    dim: i32,
    pairs: i64,
    W: *const SignoriniSparse,
    model: *mut *mut SignoriniModel,
) -> i32 {
    c_entry!(|arrays| {
        let place = arrays.at(4, "model").out_pointer(model)?;
        let [dim, pairs, _] = arrays.sizes([1, 2], dim, pairs)?;
        let (_, w) = SignoriniSparse::read(arrays.at(3, "W"), W)?;
        place.fill(Model::flexibility_sparse(dim, pairs, &w).map_err(arrays.refused(3))?)
    })
}

/// Releases a model. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_model_free(model: *mut SignoriniModel) {
    // SAFETY: NULL, or by the header's contract it came from signorini_model_new_..., once.
    unsafe { release(model) }
}
