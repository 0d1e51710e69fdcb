//! SGOPER, SGOPEH: models of which subroutines of the host give products and solutions alone.

use super::super::args;
use super::super::guard::Failure;
use super::super::model_new::Place;
use super::super::operator;
use super::arguments::{Integer, run, sizes};
use super::models::MODELS;
use crate::reduce::HostOperator;

/// SUBROUTINE PRODUCT(N, X, Y, IFAIL)
pub(super) type Product<I> = Option<unsafe extern "C" fn(*const I, *const f64, *mut f64, *mut I)>;

/// SUBROUTINE HELD(N, MASK, NEW, X, Y, IFAIL)
pub(super) type Held<I> =
    Option<unsafe extern "C" fn(*const I, *const I, *const I, *const f64, *mut f64, *mut I)>;

/// The subroutines of a host.
struct Subroutines<I> {
    stiffness: Product<I>,
    inverse: Product<I>,
    held: Held<I>,
}

/// IFAIL of a subroutine, which it may leave as it is.
fn answered<I: Integer>(fail: I) -> Result<(), i32> {
    if fail.wide() == 0 { Ok(()) } else { Err(i32::try_from(fail.wide()).unwrap_or(-1)) }
}

fn product<I: Integer>(routine: Product<I>, x: &[f64], y: &mut [f64]) -> Result<(), i32> {
    let Some(routine) = routine else { return Err(-1) };
    let (size, mut fail) = (I::nearest(x.len() as i64), I::nearest(0));
    // SAFETY: signorini.inc demands a subroutine with these arguments that returns and writes N entries.
    unsafe { routine(&raw const size, x.as_ptr(), y.as_mut_ptr(), &raw mut fail) };
    answered(fail)
}

impl<I: Integer + Send + Sync> HostOperator for Subroutines<I> {
    fn stiffness(&self, x: &[f64], y: &mut [f64]) -> Result<(), i32> {
        product(self.stiffness, x, y)
    }

    fn has_inverse(&self) -> bool {
        self.inverse.is_some()
    }

    fn inverse(&self, x: &[f64], y: &mut [f64]) -> Result<(), i32> {
        product(self.inverse, x, y)
    }

    fn has_held(&self) -> bool {
        self.held.is_some()
    }

    fn held(&self, held: &[bool], changed: bool, x: &[f64], y: &mut [f64]) -> Result<(), i32> {
        let Some(routine) = self.held else { return Err(-1) };
        let number = |is: bool| I::nearest(i64::from(is));
        let mask: Vec<I> = held.iter().map(|&held| number(held)).collect();
        let (size, new, mut fail) = (I::nearest(x.len() as i64), number(changed), number(false));
        // SAFETY: as above; MASK has N entries too.
        unsafe {
            routine(
                &raw const size,
                mask.as_ptr(),
                &raw const new,
                x.as_ptr(),
                y.as_mut_ptr(),
                &raw mut fail,
            );
        }
        answered(fail)
    }
}

/// # Safety
/// As include/signorini.inc demands, as for all entries.
pub(super) unsafe fn with_inverse<I: Integer + Send + Sync + 'static>(
    ndim: *const I,
    npair: *const I,
    stiff: Product<I>,
    winv: Product<I>,
    handle: *mut i64,
    info: *mut I,
) {
    let host = Subroutines { stiffness: stiff, inverse: winv, held: None };
    let given = [("STIFF", stiff.is_some()), ("WINV", winv.is_some())];
    // SAFETY: by the caller's contract.
    unsafe { make((ndim, npair), host, given, handle, info) }
}

/// # Safety
/// As above.
pub(super) unsafe fn with_held<I: Integer + Send + Sync + 'static>(
    ndim: *const I,
    npair: *const I,
    stiff: Product<I>,
    held: Held<I>,
    handle: *mut i64,
    info: *mut I,
) {
    let host = Subroutines { stiffness: stiff, inverse: None, held };
    let given = [("STIFF", stiff.is_some()), ("HELD", held.is_some())];
    // SAFETY: by the caller's contract.
    unsafe { make((ndim, npair), host, given, handle, info) }
}

/// # Safety
/// As above.
unsafe fn make<I: Integer + Send + Sync + 'static>(
    (ndim, npair): (*const I, *const I),
    host: Subroutines<I>,
    given: [(&str, bool); 2],
    handle: *mut i64,
    info: *mut I,
) {
    const SUBROUTINES: i32 = 3;
    let create = |model| {
        // SAFETY: by the caller's contract.
        let (dim, pairs) = unsafe { sizes(1, ndim, npair)? };
        let (dim, pairs, _) = args::sizes(1, dim, pairs)?;
        for (position, (name, is_there)) in (SUBROUTINES..).zip(given) {
            if !is_there {
                return Err(Failure::argument(position, format!("{name} is NULL")));
            }
        }
        operator::create(Place::new(5, model)?, (dim, pairs), Box::new(host), None, SUBROUTINES)
    };
    // SAFETY: by the caller's contract.
    unsafe { run(info, &[1, 2, 3, 4, 5], || MODELS.create(5, handle, create)) }
}
