//! Models of which the host gives products and solutions alone.

use libc::c_void;

use super::args::{Arrays, c_entry};
use super::guard::{self, Outcome};
use super::model::SignoriniModel;
use super::structures::Structure;
use super::surroundings::in_host;
use crate::error::Error;
use crate::linalg::tolerances::AGREES;
use crate::model::Model;
use crate::reduce::{Held, HostOperator};

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

/// Your preconditioner, with unknowns set: z near the solution of A z = r with components of d held
/// and springs. No accuracy is asked, nor that it is linear or symmetric: one cycle of multigrid
/// serves. held has N entries, nonzero where held; r and z do not count there. springs are to be
/// added to A between the tangential components of each pair: force / length, one number for each
/// pair in 2D, in 3D four, a symmetric, positive semi-definite matrix; those of held components do
/// not count. changed is as in signorini_held_fn, for springs too. Returns as signorini_product_fn.
pub type SignoriniPreconditionFn = Option<
    unsafe extern "C" fn(
        user: *mut c_void,
        held: *const i32,
        springs: *const f64,
        changed: i32,
        r: *const f64,
        z: *mut f64,
    ) -> i32,
>;

/// Functions in the place of a matrix that lies on several processes or is never formed. K_rel is
/// the K of signorini_solve.
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
    /// In the place of W. May be NULL if inverse is given.
    pub held: SignoriniHeldFn,
    /// Positive numbers of the size of the diagonal of K_rel, N; force / length. NULL: one for each
    /// direction, from products.
    pub units: *const f64,
    /// First argument of the functions.
    pub user: *mut c_void,
    /// 0: vectors have N entries, those of the pairs. Otherwise H, the number of all your unknowns,
    /// of which the components of d are some: then stiffness is y = A x on all of them, exact but
    /// for rounding; units is given, H; inverse and held are NULL.
    pub unknowns: i64,
    /// With unknowns set: the unknown that is each component of d, from 0, N.
    pub place: *const i64,
    /// With unknowns set.
    pub precondition: SignoriniPreconditionFn,
    /// Without unknowns: what products and solutions agree to, relative to their sizes; no smaller
    /// tolerance can be met. 0: 1e-9.
    pub accuracy: f64,
}

// SAFETY: it begins with its size; numbers, pointers and functions that may be NULL.
unsafe impl Structure for SignoriniOperator {
    const OLDER: &'static [usize] =
        &[std::mem::offset_of!(Self, unknowns), std::mem::offset_of!(Self, accuracy)];
}

/// The functions of a host: those that a checked structure names.
struct Functions(SignoriniOperator);

// SAFETY: the header demands that a host's functions may be called from the threads on which it calls the library
// with this model; its arrays are not read any more.
unsafe impl Send for Functions {}
// SAFETY: as above.
unsafe impl Sync for Functions {}

impl Functions {
    /// The answer of a function of the host to its first argument; -1 where there is no function.
    fn asked<F>(
        &self,
        function: Option<F>,
        ask: impl FnOnce(F, *mut c_void) -> i32,
    ) -> Result<(), i32> {
        let Some(function) = function else { return Err(-1) };
        match in_host(|| ask(function, self.0.user)) {
            0 => Ok(()),
            number => Err(number),
        }
    }

    fn product(&self, function: SignoriniProductFn, x: &[f64], y: &mut [f64]) -> Result<(), i32> {
        // SAFETY: the header demands a function of this type that returns normally and writes as many entries as it reads.
        self.asked(function, |function, user| unsafe { function(user, x.as_ptr(), y.as_mut_ptr()) })
    }
}

impl HostOperator for Functions {
    fn stiffness(&self, x: &[f64], y: &mut [f64]) -> Result<(), i32> {
        self.product(self.0.stiffness, x, y)
    }

    fn accuracy(&self) -> f64 {
        if self.0.accuracy == 0.0 { AGREES } else { self.0.accuracy }
    }

    fn has_inverse(&self) -> bool {
        self.0.inverse.is_some()
    }

    fn inverse(&self, x: &[f64], y: &mut [f64]) -> Result<(), i32> {
        self.product(self.0.inverse, x, y)
    }

    fn has_held(&self) -> bool {
        self.0.held.is_some()
    }

    fn held(&self, held: &Held<'_>, x: &[f64], y: &mut [f64]) -> Result<(), i32> {
        let (springs, changed) = (held.springs.as_ptr(), i32::from(held.changed));
        let held: Vec<i32> = held.components.iter().map(|held| i32::from(*held)).collect();
        let (held, x, y) = (held.as_ptr(), x.as_ptr(), y.as_mut_ptr());
        if self.0.precondition.is_none() {
            // SAFETY: as above; `held` has N entries too.
            return self
                .asked(self.0.held, |solve, user| unsafe { solve(user, held, changed, x, y) });
        }
        self.asked(self.0.precondition, |solve, user| {
            // SAFETY: as above; `held` and `springs` have as many entries as the header says.
            unsafe { solve(user, held, springs, changed, x, y) }
        })
    }
}

/// Makes a model of your functions. They run on the calling threads. Load cases are solved as in
/// full space.
///
/// With products and solutions of the pairs H = N: loads and displacements are relative. A load
/// case mostly takes up to 160 products (2D: 110) with each of K_rel and W, or 70 solutions with
/// held; bad conditioning, more.
///
/// With unknowns set A is symmetric, positive semi-definite, and takes the place of a sparse
/// matrix: supports and the turn to the frames of the pairs are in it. A load case takes some 100
/// preconditionings. No motion of a body that nothing holds is found. In eta the size of the loads
/// is known to a thousandth.
///
/// The call asks for some products, which must be finite, linear, symmetric, positive and the same
/// each time, to 1e-9 or K->accuracy. Later calls return -1 if a function fails or gives a number
/// that is not finite; the model can be used again.
///
/// @param K      the functions; the structure is copied, with units and place
/// @param model  out: the model
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_model_new_operator(
    K: *const SignoriniOperator,
    model: *mut *mut SignoriniModel,
) -> i32 {
    c_entry!(|arrays| {
        let place = arrays.at(2, "model").out_pointer(model)?;
        let given = arrays.at(1, "K").required_copy(K)?;
        place.fill(of_functions(arrays, given)?.map_err(arrays.refused(1))?)
    })
}

/// The model of products and solutions of the pairs, or of products and a preconditioner on all unknowns.
fn of_functions(arrays: &Arrays, given: SignoriniOperator) -> Outcome<Result<Model, Error>> {
    let at = arrays.at(1, "K");
    let [dim, pairs, n] = arrays.sizes([1, 1], given.dim, given.pairs)?;
    let unknowns = at.named("unknowns").size(given.unknowns)?;
    if given.stiffness.is_none() {
        return at.refuse_part("stiffness is NULL");
    }
    let functions = Box::new(Functions(given));
    let reserve = |vector: usize| {
        guard::reserve(VECTORS.saturating_mul(vector).saturating_mul(size_of::<f64>()))
    };
    let at_units = at.named("units");
    if unknowns == 0 {
        if given.precondition.is_some() {
            return at.refuse_part("precondition needs unknowns, their number");
        }
        let units = at_units.optional(given.units, n)?;
        reserve(n)?;
        return Ok(Model::operator(dim, pairs, functions, units));
    }
    if given.precondition.is_none() {
        return at.refuse_part("precondition is NULL");
    }
    if given.inverse.is_some() || given.held.is_some() {
        return at.refuse_part(
            "inverse and held are those of the pairs: with unknowns give precondition alone",
        );
    }
    let units = at_units.required(given.units, unknowns)?;
    let place = at.named("place").indices(given.place, n, 0)?;
    reserve(unknowns)?;
    Ok(Model::preconditioned(dim, functions, units, &place))
}

/// Vectors that the check of an operator takes.
const VECTORS: usize = 32;
