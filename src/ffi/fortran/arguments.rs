//! Scalars by reference in both widths, settings of three scalars, and states.

use std::alloc::{Layout, alloc_zeroed};

use super::super::guard::{self, Failure};
use super::super::law::{LAST_LAW, SIGNORINI_LAW_FRICTIONLESS};
use super::super::report::SignoriniReport;
use super::super::settings::{SIGNORINI_METHOD_PATH, SignoriniSettings};
use crate::problem::checked_dim;
use crate::settings::{Settings, check_tolerance};

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
/// k-th argument of the entry of C that `body` calls; refusals of `body` itself have theirs.
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

/// The leading dimension of a matrix of all components of pairs.
///
/// # Safety
/// As for [`read`].
pub(super) unsafe fn leading<I: Integer>(
    position: i32,
    name: &str,
    place: *const I,
    (dim, pairs): (i32, i64),
) -> Result<i64, Failure> {
    // SAFETY: by the caller's contract.
    let leading = unsafe { count(position, name, place)? };
    let n = i64::from(dim) * pairs;
    if leading < n.max(1) {
        let message = format!(
            "{name} is {leading}, it must be at least NDIM * NPAIR, which is {n}; NPAIR counts pairs"
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

/// LAW.
///
/// # Safety
/// As for [`read`].
pub(super) unsafe fn law<I: Integer>(position: i32, place: *const I) -> Result<i32, Failure> {
    // SAFETY: by the caller's contract.
    let law = unsafe { choice(position, "LAW", place)? };
    if !(SIGNORINI_LAW_FRICTIONLESS..=LAST_LAW).contains(&law) {
        let message = format!(
            "LAW is {law}, it must be SGNOFR (0), SGCOUL (1), SGTRSC (2), SGCOHE (3), SGORTH (4) or \
             SGORTC (5)"
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
    settings.tolerance = tolerance_or_default(first + 1, tolerance)?;
    if most > 0 {
        settings.max_iterations = most;
    }
    Ok(settings)
}

/// TOL, 0 for the default.
pub(super) fn tolerance_or_default(position: i32, tolerance: f64) -> Result<f64, Failure> {
    if tolerance == 0.0 {
        Ok(Settings::default().tolerance)
    } else {
        let wrong = |message| {
            let rest = "or be 0 (the default); is it DOUBLE PRECISION, 1D-10 and not 1E-10?";
            Failure::argument(position, format!("{message}, {rest}"))
        };
        check_tolerance("TOL", tolerance).map_err(wrong)?;
        Ok(tolerance)
    }
}

/// What an entry of C fills in and Fortran has otherwise: states of 4 bytes, and a report.
pub(super) struct Results {
    pub(super) state: Vec<i32>,
    pub(super) report: SignoriniReport,
}

impl Results {
    pub(super) fn new(pairs: i64) -> Result<Self, Failure> {
        let refused = || Failure::out_of_memory(format!("no memory for {pairs} states"));
        let count = usize::try_from(pairs).map_err(|_| refused())?;
        Ok(Results { state: zeros(count).ok_or_else(refused)?, report: SignoriniReport::blank() })
    }

    /// Hands them over, if the call of C has written them.
    ///
    /// # Safety
    /// Places of the caller: one state for each pair, a number, and an integer that may be NULL.
    pub(super) unsafe fn send<I: Integer>(
        &self,
        status: i32,
        state: *mut I,
        eta: *mut f64,
        iter: *mut I,
    ) -> i32 {
        if status >= 0 {
            // SAFETY: by the caller's contract.
            unsafe {
                if !state.is_null() {
                    for (i, &value) in self.state.iter().enumerate() {
                        write(state.wrapping_add(i), I::nearest(i64::from(value)));
                    }
                }
                write(eta, self.report.eta);
                write(iter, I::nearest(self.report.iterations));
            }
        }
        status
    }
}

/// Zeros that the system has not to write, so that a wrong number of pairs touches no memory before it is
/// refused; `None` without memory.
fn zeros(count: usize) -> Option<Vec<i32>> {
    let layout = Layout::array::<i32>(count).ok()?;
    if count == 0 {
        return Some(Vec::new());
    }
    // SAFETY: the size is not zero.
    let memory = unsafe { alloc_zeroed(layout) };
    // SAFETY: memory of the global allocator for so many numbers, all of them zero.
    (!memory.is_null()).then(|| unsafe { Vec::from_raw_parts(memory.cast(), count, count) })
}
