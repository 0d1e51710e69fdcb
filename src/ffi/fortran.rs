//! The Fortran 77 entries: by reference, `name_` for 4-byte and `name_64_` for 8-byte integers.
//!
//! `include/signorini.inc` is their reference. They count from 1, return nothing but their last
//! argument INFO, and call the entries of C: what is here translates arguments and their positions;
//! indices in sentences are counted by [`crate::error`]. Models and pairs of surfaces are known by numbers, of
//! 8 bytes in both widths, so that a wrong one is refused and not followed.

mod arguments;
mod flat;
mod gate;
mod handles;
mod message;
mod models;
mod operator;
mod pairing;
mod sparse;
mod surface_results;
mod surfaces;

/// Exports one generic function for each width of integers; `I` is the integer in the types.
macro_rules! entries {
    ($($short:ident $long:ident = $body:path, ($($argument:ident: $type:ty),* $(,)?);)*) => {
        mod narrow {
            type I = i32;
            $(
                #[unsafe(no_mangle)]
                unsafe extern "C" fn $short($($argument: $type),*) {
                    // SAFETY: the caller's contract, which include/signorini.inc states.
                    unsafe { $body($($argument),*) }
                }
            )*
        }
        mod wide {
            type I = i64;
            $(
                #[unsafe(no_mangle)]
                unsafe extern "C" fn $long($($argument: $type),*) {
                    // SAFETY: the caller's contract, which include/signorini.inc states.
                    unsafe { $body($($argument),*) }
                }
            )*
        }
    };
}

entries! {
    sgsolv_ sgsolv_64_ = super::flat::solve, (ndim: *const I, npair: *const I, k: *const f64,
        ldk: *const I, f: *const f64, gap: *const f64, law: *const I, fric: *const f64,
        slip0: *const f64, method: *const I, tol: *const f64, maxit: *const I, d: *mut f64,
        r: *mut f64, state: *mut I, eta: *mut f64, iter: *mut I, info: *mut I);
    sgcert_ sgcert_64_ = super::flat::certify, (ndim: *const I, npair: *const I, k: *const f64,
        ldk: *const I, f: *const f64, gap: *const f64, law: *const I, fric: *const f64,
        slip0: *const f64, tol: *const f64, d: *const f64, r: *mut f64, state: *mut I,
        eta: *mut f64, info: *mut I);
    sgprov_ sgprov_64_ = super::flat::prove, (ndim: *const I, npair: *const I, k: *const f64,
        ldk: *const I, f: *const f64, gap: *const f64, law: *const I, fric: *const f64,
        slip0: *const f64, d: *const f64, state: *const I, r: *mut f64, radd: *mut f64,
        radr: *mut f64, info: *mut I);
    sglcps_ sglcps_64_ = super::flat::lcp, (n: *const I, m: *const f64, ldm: *const I,
        q: *const f64, method: *const I, tol: *const f64, maxit: *const I, w: *mut f64,
        z: *mut f64, eta: *mut f64, iter: *mut I, info: *mut I);
    sgmodl_ sgmodl_64_ = super::models::condensed, (ndim: *const I, npair: *const I,
        k: *const f64, ldk: *const I, handle: *mut i64, info: *mut I);
    sgtwob_ sgtwob_64_ = super::models::two_body, (ndim: *const I, npair: *const I,
        ka: *const f64, lda: *const I, kb: *const f64, ldb: *const I, handle: *mut i64,
        info: *mut I);
    sgoper_ sgoper_64_ = super::operator::with_inverse, (ndim: *const I, npair: *const I,
        stiff: super::operator::Product<I>, winv: super::operator::Product<I>, handle: *mut i64,
        info: *mut I);
    sgopeh_ sgopeh_64_ = super::operator::with_held, (ndim: *const I, npair: *const I,
        stiff: super::operator::Product<I>, held: super::operator::Held<I>, handle: *mut i64,
        info: *mut I);
    sgspar_ sgspar_64_ = super::sparse::new, (n: *const I, nnz: *const I, colptr: *const I,
        rowind: *const I, values: *const f64, tri: *const I, nfix: *const I, fixed: *const I,
        ndim: *const I, npair: *const I, slave: *const I, nmast: *const I, mstart: *const I,
        master: *const I, weight: *const f64, normal: *const f64, ntan: *const I,
        tangnt: *const f64, handle: *mut i64, info: *mut I);
    sgspaw_ sgspaw_64_ = super::sparse::within, (n: *const I, nnz: *const I, colptr: *const I,
        rowind: *const I, values: *const f64, tri: *const I, nfix: *const I, fixed: *const I,
        ndim: *const I, npair: *const I, slave: *const I, nmast: *const I, mstart: *const I,
        master: *const I, weight: *const f64, normal: *const f64, ntan: *const I,
        tangnt: *const f64, nord: *const I, order: *const I, maxmem: *const f64,
        maxsec: *const f64, handle: *mut i64, info: *mut I);
    sgcase_ sgcase_64_ = super::models::case, (handle: *const i64, f: *const f64,
        presc: *const f64, gap: *const f64, law: *const I, fric: *const f64, slip0: *const f64,
        method: *const I, tol: *const f64, maxit: *const I, d: *mut f64, r: *mut f64,
        state: *mut I, eta: *mut f64, iter: *mut I, info: *mut I);
    sgfram_ sgfram_64_ = super::models::frames, (handle: *const i64, frames: *mut f64,
        info: *mut I);
    sgrecv_ sgrecv_64_ = super::models::recover, (handle: *const i64, f: *const f64,
        presc: *const f64, d: *const f64, u: *mut f64, info: *mut I);
    sgnodf_ sgnodf_64_ = super::models::nodal_forces, (handle: *const i64, r: *const f64,
        p: *mut f64, info: *mut I);
    sgfree_ sgfree_64_ = super::models::free, (handle: *mut i64, info: *mut I);
    sgsurf_ sgsurf_64_ = super::pairing::pair, (ndim: *const I, nnode: *const I,
        x: *const f64, ndof: *const I, lsl: *const I, nsl: *const I, slave: *const I,
        lma: *const I, nma: *const I, master: *const I, pairng: *const I, dist: *const f64,
        hsurf: *mut i64, npair: *mut I, info: *mut I);
    sgsurc_ sgsurc_64_ = super::pairing::pair_chosen, (ndim: *const I, nnode: *const I,
        x: *const f64, ndof: *const I, lsl: *const I, nsl: *const I, slave: *const I,
        lma: *const I, nma: *const I, master: *const I, pairng: *const I, dist: *const f64,
        nplane: *const I, axis: *const I, place: *const f64, normls: *const I, rims: *const I,
        hsurf: *mut i64, npair: *mut I, info: *mut I);
    sgsmod_ sgsmod_64_ = super::surfaces::model, (n: *const I, nnz: *const I, colptr: *const I,
        rowind: *const I, values: *const f64, tri: *const I, nfix: *const I, fixed: *const I,
        hsurf: *const i64, handle: *mut i64, info: *mut I);
    sgsgap_ sgsgap_64_ = super::surfaces::gaps, (hsurf: *const i64, node: *mut I,
        gap: *mut f64, area: *mut f64, normal: *mut f64, info: *mut I);
    sgsfld_ sgsfld_64_ = super::surface_results::fields, (hsurf: *const i64, gap: *const f64,
        slip0: *const f64, d: *const f64, r: *const f64, press: *mut f64, tract: *mut f64,
        clear: *mut f64, slip: *mut f64, info: *mut I);
    sgsvtu_ sgsvtu_64_ = super::surface_results::write_vtu, (hsurf: *const i64,
        path: *const libc::c_char, lpath: *const I, x: *const f64, vtktyp: *const I,
        lcell: *const I, ncell: *const I, cell: *const I, gap: *const f64, slip0: *const f64,
        u: *const f64, d: *const f64, r: *const f64, state: *const I, info: *mut I);
    sgsumm_ sgsumm_64_ = super::surfaces::summary, (hsurf: *const i64,
        text: *mut libc::c_char, ltext: *const I, info: *mut I);
    sgsfre_ sgsfre_64_ = super::surfaces::free, (hsurf: *mut i64, info: *mut I);
    sgmesg_ sgmesg_64_ = super::message::copy, (text: *mut libc::c_char, ltext: *const I);
}
