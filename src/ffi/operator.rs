//! Models of which the host gives products and solutions alone.

use libc::c_void;

use super::args::{c_entry, sizes};
use super::guard::{self, Failure};
use super::model::SignoriniModel;
use super::surroundings::in_host;
use crate::model::Model;
use crate::reduce::HostOperator;

/// Your product, y = K_rel x or y = W x, with N entries. Returns 0; another number ends the call of
/// the library, whose sentence tells it. As a progress callback it must return, and not call this
/// library.
pub type SignoriniProductFn =
    Option<unsafe extern "C" fn(user: *mut c_void, x: *const f64, y: *mut f64) -> i32>;

/// Your solution with components held: y is 0 where held is nonzero, and K_rel y = x in the other
/// components; x counts only there. All have N entries. changed is 0 if the same components are
/// held as in the call before on this model, and that call has not failed: then a factor may serve
/// again. Returns as signorini_product_fn.
pub type SignoriniHeldFn = Option<
    unsafe extern "C" fn(
        user: *mut c_void,
        held: *const i32,
        changed: i32,
        x: *const f64,
        y: *mut f64,
    ) -> i32,
>;

/// Functions in the place of a matrix, say of a code on several processes. K_rel is the K of
/// signorini_solve.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SignoriniOperator {
    /// sizeof(signorini_operator).
    pub struct_size: u32,
    /// Space dimension.
    pub dim: i32,
    /// Number of pairs.
    pub pairs: i64,
    /// y = K_rel x; symmetric, positive semi-definite; as exact as the tolerance asks for.
    pub stiffness: SignoriniProductFn,
    /// y = W x, W close to the inverse of K_rel, symmetric, positive definite: a solution with the
    /// contact free. NULL: held is used alone.
    pub inverse: SignoriniProductFn,
    /// A solution with components held, in the place of W. May be NULL if inverse is given.
    pub held: SignoriniHeldFn,
    /// Positive numbers of the size of the diagonal of K_rel, N; force / length. NULL: one for each
    /// direction, from products.
    pub units: *const f64,
    /// First argument of the functions.
    pub user: *mut c_void,
}

/// The functions of a host.
struct Functions {
    stiffness: unsafe extern "C" fn(*mut c_void, *const f64, *mut f64) -> i32,
    inverse: SignoriniProductFn,
    held: SignoriniHeldFn,
    user: *mut c_void,
}

// SAFETY: the header demands that a host's functions may be called from the threads on which it calls the library
// with this model.
unsafe impl Send for Functions {}
// SAFETY: as above.
unsafe impl Sync for Functions {}

fn answered(number: i32) -> Result<(), i32> {
    if number == 0 { Ok(()) } else { Err(number) }
}

impl HostOperator for Functions {
    fn stiffness(&self, x: &[f64], y: &mut [f64]) -> Result<(), i32> {
        // SAFETY: the header demands a function of this type that returns normally and writes N entries.
        answered(in_host(|| unsafe { (self.stiffness)(self.user, x.as_ptr(), y.as_mut_ptr()) }))
    }

    fn has_inverse(&self) -> bool {
        self.inverse.is_some()
    }

    fn inverse(&self, x: &[f64], y: &mut [f64]) -> Result<(), i32> {
        let Some(inverse) = self.inverse else { return Err(-1) };
        // SAFETY: as above.
        answered(in_host(|| unsafe { inverse(self.user, x.as_ptr(), y.as_mut_ptr()) }))
    }

    fn has_held(&self) -> bool {
        self.held.is_some()
    }

    fn held(&self, held: &[bool], changed: bool, x: &[f64], y: &mut [f64]) -> Result<(), i32> {
        let Some(solve) = self.held else { return Err(-1) };
        let held: Vec<i32> = held.iter().map(|held| i32::from(*held)).collect();
        let (changed, x, y) = (i32::from(changed), x.as_ptr(), y.as_mut_ptr());
        // SAFETY: as above; `held` has N entries too.
        answered(in_host(|| unsafe { solve(self.user, held.as_ptr(), changed, x, y) }))
    }
}

/// Makes a model of products and solutions alone: no matrix is formed. H = N: loads and
/// displacements are the relative ones. Load cases are solved as in full space. They take up to 110
/// products with K_rel and as many with W in 2D, 160 in 3D; or with held up to 70 solutions, with
/// 14 changes of the components that are held.
///
/// The call asks for some products, which must be finite, linear, symmetric, positive and the same
/// each time, to 1e-9. Later calls return -1 if a function fails or gives a number that is not
/// finite; the model can be used again. Your functions run on the threads that call the library.
///
/// @param K      the functions; the structure is copied, with units
/// @param model  out: the model
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_model_new_operator(
    K: *const SignoriniOperator,
    model: *mut *mut SignoriniModel,
) -> i32 {
    c_entry!(|arrays| {
        let place = arrays.out_pointer(2, "model", model)?;
        let given = arrays.whole(1, "K", K)?;
        let wrong = |message: &str| Failure::argument(1, message.to_owned());
        let (dim, pairs, n) = sizes(1, given.dim, given.pairs).map_err(|failure| failure.at(1))?;
        let stiffness = given.stiffness.ok_or_else(|| wrong("K: stiffness is NULL"))?;
        let units = arrays.optional(1, "units", given.units, n)?;
        let SignoriniOperator { inverse, held, user, .. } = *given;
        let functions = Box::new(Functions { stiffness, inverse, held, user });
        guard::reserve(VECTORS.saturating_mul(n).saturating_mul(size_of::<f64>()))?;
        place.fill(Model::operator(dim, pairs, functions, units), |_| 1)
    })
}

/// Vectors of N entries that the check of an operator takes.
const VECTORS: usize = 32;
