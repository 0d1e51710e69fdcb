//! Scalars and arrays by reference in both widths, settings of three scalars, and states.

use super::super::args::Arrays;
use super::super::guard::{self, Failure};
use super::super::law::{LAST_LAW, SIGNORINI_LAW_FRICTIONLESS};
use super::super::settings::{SIGNORINI_METHOD_PATH, SignoriniSettings};
use crate::problem::checked_dim;
use crate::settings::check_tolerance;

/// A Fortran INTEGER.
pub(super) trait Integer: Copy {
    /// Its size.
    const BYTES: i32;
    fn wide(self) -> i64;
    /// The nearest number of this width.
    fn nearest(value: i64) -> Self;
}

impl Integer for i32 {
    const BYTES: i32 = 4;
    fn wide(self) -> i64 {
        i64::from(self)
    }
    fn nearest(value: i64) -> Self {
        value.clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32
    }
}

impl Integer for i64 {
    const BYTES: i32 = 8;
    fn wide(self) -> i64 {
        self
    }
    fn nearest(value: i64) -> Self {
        value
    }
}

/// Runs an entry and puts its status into INFO. `positions[k - 1]` is the Fortran position of the
/// k-th argument of the function of C that `body` calls; refusals of `body` itself have theirs.
///
/// # Safety
/// `info` is NULL or an integer of the caller.
pub(super) unsafe fn run<I: Integer>(
    info: *mut I,
    positions: &[i32],
    body: impl FnOnce() -> Result<i32, Failure>,
) {
    let status = guard::call(|| {
        let status = body()?;
        let argument = status.checked_neg().and_then(|k| usize::try_from(k).ok());
        let position = argument.filter(|k| *k >= 1).and_then(|k| positions.get(k - 1));
        Ok(position.map_or(status, |position| -position))
    });
    // SAFETY: by the caller's contract.
    unsafe { write(info, I::nearest(i64::from(status))) };
}

/// # Safety
/// NULL or a place of the caller, aligned or not: a caller with narrower integers aligns to those.
pub(super) unsafe fn write<T>(place: *mut T, value: T) {
    if !place.is_null() {
        // SAFETY: by the caller's contract.
        unsafe { place.write_unaligned(value) };
    }
}

/// Widens the states of the pairs in their place, where a function of C has put numbers of 4 bytes.
///
/// # Safety
/// NULL, or as many integers of the caller.
pub(super) unsafe fn widen<I: Integer>(state: *mut I, pairs: i64) {
    if state.is_null() || I::BYTES == i32::BYTES {
        return;
    }
    // From the last one: each is read before its place is written to.
    for i in (0..pairs as usize).rev() {
        // SAFETY: by the caller's contract.
        unsafe {
            let narrow = state.cast::<i32>().add(i).read_unaligned();
            write(state.add(i), I::nearest(i64::from(narrow)));
        }
    }
}

/// # Safety
/// As for [`write`], with a value.
pub(super) unsafe fn read<T: Copy>(
    position: i32,
    name: &str,
    place: *const T,
) -> Result<T, Failure> {
    if place.is_null() {
        return Err(Failure::argument(position, format!("{name} is NULL")));
    }
    // SAFETY: by the caller's contract.
    Ok(unsafe { place.read_unaligned() })
}

/// An integer that chooses something.
///
/// # Safety
/// As for [`read`].
pub(super) unsafe fn choice<I: Integer>(
    position: i32,
    name: &str,
    place: *const I,
) -> Result<i32, Failure> {
    // SAFETY: by the caller's contract.
    let value = unsafe { read(position, name, place)? }.wide();
    i32::try_from(value).map_err(|_| absurd::<I>(position, name, value))
}

/// The number of something that is in memory. A value of 2^31 or more almost certainly means that two
/// integers of 4 bytes were read as one of 8 bytes; a matrix with such a leading dimension would be
/// read far outside.
///
/// # Safety
/// As for [`read`].
pub(super) unsafe fn count<I: Integer>(
    position: i32,
    name: &str,
    place: *const I,
) -> Result<i64, Failure> {
    // SAFETY: by the caller's contract.
    let value = unsafe { choice(position, name, place)? };
    if value < 0 {
        let message = format!("{name} is {value}, it must not be negative");
        return Err(Failure::argument(position, message));
    }
    Ok(i64::from(value))
}

/// NDIM and NPAIR, at consecutive positions.
///
/// # Safety
/// As for [`read`].
pub(super) unsafe fn sizes<I: Integer>(
    first: i32,
    ndim: *const I,
    npair: *const I,
) -> Result<(i32, i64), Failure> {
    // SAFETY: by the caller's contract.
    unsafe { Ok((dimension(first, ndim)?, count(first + 1, "NPAIR", npair)?)) }
}

/// NDIM.
///
/// # Safety
/// As for [`read`].
pub(super) unsafe fn dimension<I: Integer>(position: i32, ndim: *const I) -> Result<i32, Failure> {
    // SAFETY: by the caller's contract.
    let dim = unsafe { choice(position, "NDIM", ndim)? };
    let wrong = |_| Failure::argument(position, format!("NDIM is {dim}, it must be 2 or 3"));
    checked_dim(dim).map_err(wrong)?;
    Ok(dim)
}

/// LDK, the leading dimension of a matrix of all components of pairs.
///
/// # Safety
/// As for [`read`].
pub(super) unsafe fn leading<I: Integer>(
    position: i32,
    place: *const I,
    (dim, pairs): (i32, i64),
) -> Result<i64, Failure> {
    // SAFETY: by the caller's contract.
    let leading = unsafe { count(position, "LDK", place)? };
    let n = i64::from(dim) * pairs;
    if leading < n.max(1) {
        let message = format!(
            "LDK is {leading}, it must be at least NDIM * NPAIR, which is {n}; NPAIR counts pairs"
        );
        return Err(Failure::argument(position, message));
    }
    Ok(leading)
}

pub(super) fn absurd<I: Integer>(position: i32, name: &str, value: i64) -> Failure {
    let bytes = I::BYTES;
    let message =
        format!("{name} is {value}: this entry takes integers of {bytes} bytes, were they others?");
    Failure::argument(position, message)
}

/// A copy of an integer array in the width of the functions of C.
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

/// LAW.
///
/// # Safety
/// As for [`read`].
pub(super) unsafe fn law<I: Integer>(position: i32, place: *const I) -> Result<i32, Failure> {
    // SAFETY: by the caller's contract.
    let law = unsafe { choice(position, "LAW", place)? };
    if !(SIGNORINI_LAW_FRICTIONLESS..=LAST_LAW).contains(&law) {
        let message = format!(
            "LAW is {law}, it must be a law of signorini.inc, from SGNOFR ({SIGNORINI_LAW_FRICTIONLESS}) to {LAST_LAW}"
        );
        return Err(Failure::argument(position, message));
    }
    Ok(law)
}

/// METHOD, TOL and MAXIT at consecutive positions; 0 stands for the default of each.
///
/// # Safety
/// As for [`read`].
pub(super) unsafe fn settings<I: Integer>(
    first: i32,
    method: *const I,
    tol: *const f64,
    maxit: *const I,
) -> Result<SignoriniSettings, Failure> {
    // SAFETY: by the caller's contract.
    let (method, tolerance, most) = unsafe {
        (
            choice(first, "METHOD", method)?,
            read(first + 1, "TOL", tol)?,
            read(first + 2, "MAXIT", maxit)?.wide(),
        )
    };
    if !(0..=SIGNORINI_METHOD_PATH).contains(&method) {
        let message = format!("METHOD is {method}, it must be 0 or SGNEST (1) to SGPATH (6)");
        return Err(Failure::argument(first, message));
    }
    if most < 0 {
        let message = format!("MAXIT is {most}, it must not be negative");
        return Err(Failure::argument(first + 2, message));
    }
    let mut settings = SignoriniSettings::default_one();
    settings.method = method;
    if tolerance != 0.0 {
        let wrong = |message| {
            let rest = "or be 0 (the default); is it DOUBLE PRECISION, 1D-10 and not 1E-10?";
            Failure::argument(first + 1, format!("{message}, {rest}"))
        };
        check_tolerance("TOL", tolerance).map_err(wrong)?;
        settings.tolerance = tolerance;
    }
    if most > 0 {
        settings.max_iterations = most;
    }
    Ok(settings)
}
