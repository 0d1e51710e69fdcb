//! Scalars and arrays by reference in both widths, settings of three scalars, states, and texts.

use std::ops::{Deref, RangeInclusive};

use libc::c_char;

use super::super::args::{Arrays, Output};
use super::super::guard::{self, Failure, Outcome};
use super::super::law::{LAST_LAW, SIGNORINI_LAW_FRICTIONLESS};
use super::super::place::Place;
use super::super::settings::{SIGNORINI_METHOD_PATH, SignoriniSettings};
use super::super::structures::Structure;
use crate::settings::check_tolerance;

/// A Fortran INTEGER.
pub(super) trait Integer: Copy + Into<i64> {
    /// Its size.
    const BYTES: i32 = size_of::<Self>() as i32;
    /// The nearest number of this width.
    fn nearest(value: i64) -> Self;
}

impl Integer for i32 {
    fn nearest(value: i64) -> Self {
        value.clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32
    }
}

impl Integer for i64 {
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
    body: impl FnOnce() -> Outcome<i32>,
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

/// Puts a sentence into a CHARACTER, padded with blanks.
///
/// # Safety
/// `text` is NULL or has `length` characters.
pub(super) unsafe fn fill(text: *mut c_char, length: i64, sentence: &str) {
    // No CHARACTER for a sentence is longer: such a length is refused, not written to.
    let Some(length) = usize::try_from(length).ok().filter(|n| *n <= i32::MAX as usize) else {
        return;
    };
    if text.is_null() {
        return;
    }
    let bytes = sentence.bytes().chain(std::iter::repeat(b' ')).take(length);
    for (i, byte) in bytes.enumerate() {
        // SAFETY: i < length.
        unsafe { text.add(i).write(byte as c_char) };
    }
}

/// An argument by reference, with its position and its name.
#[derive(Clone, Copy)]
pub(super) struct Argument<P> {
    pub(super) pointer: P,
    place: Place,
}

impl<P> Argument<P> {
    /// # Safety
    /// `pointer` comes from the caller of an entry: NULL, or as many values as include/signorini.inc demands, of which
    /// the first may be unaligned, as for [`write`].
    pub(super) unsafe fn of(pointer: P, position: i32, name: &'static str) -> Self {
        Argument { pointer, place: Place::of(position, name) }
    }
}

impl<P> Deref for Argument<P> {
    type Target = Place;

    fn deref(&self) -> &Place {
        &self.place
    }
}

impl<T> Argument<*mut T> {
    /// An array of `length` entries to write.
    pub(super) fn output(self, length: usize) -> Outcome<Output<T>> {
        // SAFETY: the contract of `of`.
        let arrays = unsafe { Arrays::of_call() };
        arrays.at(self.position, self.name).output(self.pointer, length)
    }

    /// The argument, to be read.
    pub(super) fn constant(self) -> Argument<*const T> {
        Argument { pointer: self.pointer.cast_const(), place: self.place }
    }
}

impl<T: Copy> Argument<*const T> {
    /// The value of a scalar.
    pub(super) fn read(self) -> Outcome<T> {
        if self.pointer.is_null() {
            return self.refuse("is NULL");
        }
        // SAFETY: not NULL, and a value by the contract of `of`.
        Ok(unsafe { self.pointer.read_unaligned() })
    }
}

impl<I: Integer> Argument<*const I> {
    /// The value of a scalar.
    pub(super) fn wide(self) -> Outcome<i64> {
        self.read().map(I::into)
    }

    /// An integer that chooses something.
    pub(super) fn choice(self) -> Outcome<i32> {
        let value = self.wide()?;
        i32::try_from(value).or_else(|_| self.refuse_width(value))
    }

    /// Refuses an integer that is none of this width.
    pub(super) fn refuse_width<T>(self, value: i64) -> Outcome<T> {
        let bytes = I::BYTES;
        self.refuse(format!(
            "is {value}: this entry takes integers of {bytes} bytes, were they others?"
        ))
    }

    /// An integer that chooses one of several constants, which `wanted` tells.
    pub(super) fn one_of(self, constants: RangeInclusive<i32>, wanted: &str) -> Outcome<i32> {
        let value = self.choice()?;
        if constants.contains(&value) {
            return Ok(value);
        }
        self.refuse(format!("is {value}, it must be {wanted}"))
    }

    /// The number of something that is in memory. A value of 2^31 or more almost certainly means that two
    /// integers of 4 bytes were read as one of 8 bytes; a matrix with such a leading dimension would be
    /// read far outside.
    pub(super) fn count(self) -> Outcome<i64> {
        let value = i64::from(self.choice()?);
        self.size(value)?;
        Ok(value)
    }

    /// The result of `take` for an integer array of `length` entries.
    pub(super) fn entries<T>(self, length: i64, take: impl FnOnce(&[I]) -> T) -> Outcome<T> {
        // SAFETY: the contract of `of`.
        let arrays = unsafe { Arrays::of_call() };
        arrays.at(self.position, self.name).required(self.pointer, length as usize).map(take)
    }

    /// A copy of an integer array in the width of the functions of C.
    pub(super) fn numbers(self, length: i64) -> Outcome<Vec<i64>> {
        self.entries(length, |entries| entries.iter().map(|value| (*value).into()).collect())
    }

    /// NDIM.
    pub(super) fn dimension(self) -> Outcome<i32> {
        self.one_of(2..=3, "2 or 3")
    }

    /// LAW.
    pub(super) fn law(self) -> Outcome<i32> {
        let (first, last) = (SIGNORINI_LAW_FRICTIONLESS, LAST_LAW);
        let wanted = format!("a law of signorini.inc, from SGNOFR ({first}) to SGTIED ({last})");
        self.one_of(first..=last, &wanted)
    }
}

/// METHOD, TOL and MAXIT; 0 stands for the default of each.
pub(super) fn settings<I: Integer>(
    method: Argument<*const I>,
    tol: Argument<*const f64>,
    maxit: Argument<*const I>,
) -> Outcome<SignoriniSettings> {
    let mut settings = SignoriniSettings::default_one();
    settings.method = method.one_of(0..=SIGNORINI_METHOD_PATH, "0 or SGNEST (1) to SGPATH (6)")?;
    let (tolerance, most) = (tol.read()?, maxit.wide()?);
    maxit.size(most)?;
    if tolerance != 0.0 {
        let wrong = |message| {
            let rest = "or be 0 (the default); is it DOUBLE PRECISION, 1D-10 and not 1E-10?";
            Failure::argument(tol.position, format!("{message}, {rest}"))
        };
        check_tolerance("TOL", tolerance).map_err(wrong)?;
        settings.tolerance = tolerance;
    }
    if most > 0 {
        settings.max_iterations = most;
    }
    Ok(settings)
}
