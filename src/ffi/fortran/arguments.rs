//! Scalars and arrays by reference in both widths, settings of three scalars, and states.

use std::ops::RangeInclusive;

use libc::c_void;

use super::super::args::Arrays;
use super::super::guard::{self, Failure};
use super::super::law::{LAST_LAW, SIGNORINI_LAW_FRICTIONLESS};
use super::super::settings::{SIGNORINI_METHOD_PATH, SignoriniSettings};
use super::super::structures::Structure;
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

/// An argument by reference that is read. It comes from the caller of an entry alone: NULL, or as many values as
/// include/signorini.inc demands, of which the first may be unaligned, as for [`write`].
#[derive(Clone, Copy)]
#[repr(transparent)]
pub(super) struct Given<T>(*const T);

impl<T: Copy> Given<T> {
    /// # Safety
    /// NULL or a value of the caller of an entry.
    pub(super) unsafe fn of(place: *const T) -> Self {
        Given(place)
    }

    /// The value of a scalar.
    pub(super) fn read(self, position: i32, name: &str) -> Result<T, Failure> {
        if self.0.is_null() {
            return Err(Failure::argument(position, format!("{name} is NULL")));
        }
        // SAFETY: not NULL, and a value by the caller's contract.
        Ok(unsafe { self.0.read_unaligned() })
    }
}

impl<I: Integer> Given<I> {
    /// The pointer, for a function of C.
    pub(super) fn address(self) -> *const c_void {
        self.0.cast()
    }

    /// An integer that chooses something.
    pub(super) fn choice(self, position: i32, name: &str) -> Result<i32, Failure> {
        let value = self.read(position, name)?.wide();
        i32::try_from(value).map_err(|_| absurd::<I>(position, name, value))
    }

    /// An integer that chooses one of several constants, which `wanted` tells.
    pub(super) fn one_of(
        self,
        position: i32,
        name: &str,
        constants: RangeInclusive<i32>,
        wanted: &str,
    ) -> Result<i32, Failure> {
        let value = self.choice(position, name)?;
        if constants.contains(&value) {
            return Ok(value);
        }
        Err(Failure::argument(position, format!("{name} is {value}, it must be {wanted}")))
    }

    /// The number of something that is in memory. A value of 2^31 or more almost certainly means that two
    /// integers of 4 bytes were read as one of 8 bytes; a matrix with such a leading dimension would be
    /// read far outside.
    pub(super) fn count(self, position: i32, name: &str) -> Result<i64, Failure> {
        let value = self.choice(position, name)?;
        if value < 0 {
            let message = format!("{name} is {value}, it must not be negative");
            return Err(Failure::argument(position, message));
        }
        Ok(i64::from(value))
    }

    /// An integer array of `length` entries.
    pub(super) fn slice(
        &self,
        position: i32,
        name: &'static str,
        length: i64,
    ) -> Result<&[I], Failure> {
        // SAFETY: the contract of `Given`.
        unsafe { Arrays::of_call() }.required(position, name, self.0, length as usize)
    }

    /// A copy of an integer array in the width of the functions of C.
    pub(super) fn numbers(
        self,
        position: i32,
        name: &'static str,
        length: i64,
    ) -> Result<Vec<i64>, Failure> {
        Ok(self.slice(position, name, length)?.iter().map(|value| value.wide()).collect())
    }

    /// NDIM.
    pub(super) fn dimension(self, position: i32) -> Result<i32, Failure> {
        let dim = self.choice(position, "NDIM")?;
        let wrong = |_| Failure::argument(position, format!("NDIM is {dim}, it must be 2 or 3"));
        checked_dim(dim).map_err(wrong)?;
        Ok(dim)
    }

    /// LDK, the leading dimension of a matrix of all components of pairs.
    pub(super) fn leading(self, position: i32, (dim, pairs): (i32, i64)) -> Result<i64, Failure> {
        let leading = self.count(position, "LDK")?;
        let n = i64::from(dim) * pairs;
        if leading < n.max(1) {
            let message = format!(
                "LDK is {leading}, it must be at least NDIM * NPAIR, which is {n}; NPAIR counts pairs"
            );
            return Err(Failure::argument(position, message));
        }
        Ok(leading)
    }

    /// LAW.
    pub(super) fn law(self, position: i32) -> Result<i32, Failure> {
        let (first, last) = (SIGNORINI_LAW_FRICTIONLESS, LAST_LAW);
        let wanted = format!("a law of signorini.inc, from SGNOFR ({first}) to {last}");
        self.one_of(position, "LAW", first..=last, &wanted)
    }
}

pub(super) fn absurd<I: Integer>(position: i32, name: &str, value: i64) -> Failure {
    let bytes = I::BYTES;
    let message =
        format!("{name} is {value}: this entry takes integers of {bytes} bytes, were they others?");
    Failure::argument(position, message)
}

/// METHOD, TOL and MAXIT at consecutive positions; 0 stands for the default of each.
pub(super) fn settings<I: Integer>(
    first: i32,
    method: Given<I>,
    tol: Given<f64>,
    maxit: Given<I>,
) -> Result<SignoriniSettings, Failure> {
    let methods = 0..=SIGNORINI_METHOD_PATH;
    let method = method.one_of(first, "METHOD", methods, "0 or SGNEST (1) to SGPATH (6)")?;
    let tolerance = tol.read(first + 1, "TOL")?;
    let most = maxit.read(first + 2, "MAXIT")?.wide();
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
