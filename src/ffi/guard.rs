//! The frame of every call: its surroundings, its reserve and the panic barrier.

use std::cell::Cell;

use super::reserve::{self, CallReserve};
use super::status::{
    SIGNORINI_STATUS_INTERNAL, SIGNORINI_STATUS_OUT_OF_MEMORY, caught, remember, remember_plain,
};
use super::surroundings::Surroundings;
use crate::error::Message;
use crate::linalg::products;
use crate::shortage::Shortage;

/// The result of a step of a call, or why the call ends.
pub(super) type Outcome<T> = Result<T, Failure>;

/// Why a call ends without a result.
pub(super) struct Failure {
    /// The status.
    pub(super) code: i32,
    pub(super) message: Message,
}

impl Failure {
    /// The `position`-th argument is wrong.
    pub(super) fn argument(position: i32, message: impl Into<Message>) -> Self {
        Failure { code: -position, message: message.into() }
    }

    /// This failure with an explanation.
    pub(super) fn explained(self, why: &str) -> Self {
        let message = format!("{}: {why}", self.message.marked());
        Failure { message: message.into(), ..self }
    }

    /// The memory that a call holds in reserve could not be had.
    fn no_reserve(bytes: usize) -> Self {
        let megabytes = bytes as f64 / 1e6;
        let message = format!(
            "not enough memory: the call may need {megabytes:.1} MB, which the system refuses; \
             nothing was done"
        );
        Failure { code: SIGNORINI_STATUS_OUT_OF_MEMORY, message: message.into() }
    }
}

/// Runs the body of an entry. Panics become `SIGNORINI_STATUS_INTERNAL`; the C library prints none of them.
pub(super) fn call(body: impl FnOnce() -> Outcome<i32>) -> i32 {
    let _surroundings = Surroundings::of_call();
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    super::static_link::keep();
    // Nothing has happened so far.
    remember_plain("");
    let Some(_held) = CallReserve::begin() else {
        remember_plain("not enough memory for a call; nothing was done");
        return SIGNORINI_STATUS_OUT_OF_MEMORY;
    };
    match caught(body) {
        Ok(Ok(code)) => code,
        Ok(Err(failure)) => {
            remember(failure.message);
            failure.code
        }
        Err(reason) => match reason.downcast_ref::<Shortage>() {
            Some(Shortage { bytes }) => {
                remember(format!("not enough memory: the system refused {bytes} bytes"));
                SIGNORINI_STATUS_OUT_OF_MEMORY
            }
            None => SIGNORINI_STATUS_INTERNAL,
        },
    }
}

/// Obtains memory for a call that may need so much, before its work begins.
pub(super) fn reserve(bytes: usize) -> Outcome<()> {
    if reserve::want(bytes as u64) { Ok(()) } else { Err(Failure::no_reserve(bytes)) }
}

/// As [`reserve`], for what the library estimates.
pub(super) fn reserve_estimate(bytes: u64) -> Outcome<()> {
    prepare_thread()?;
    reserve(bytes as usize)
}

/// Lets the thread obtain what it keeps for matrix products while that is held in reserve: faer obtains it at
/// the first product of a thread, and has no way to be refused.
pub(super) fn prepare_thread() -> Outcome<()> {
    thread_local! {
        static READY: Cell<bool> = const { Cell::new(false) };
    }
    if !READY.get() {
        reserve(products::MOST)?;
        products::prepare().map_err(|_| Failure::no_reserve(products::MOST))?;
        READY.set(true);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::status::signorini_last_error;
    use super::*;

    #[test]
    fn a_panic_becomes_a_status_and_a_message() {
        let code = call(|| panic!("bug number {}", 7));
        assert_eq!(code, SIGNORINI_STATUS_INTERNAL);
        // SAFETY: the library's own zero-terminated buffer.
        let text = unsafe { std::ffi::CStr::from_ptr(signorini_last_error()) };
        assert!(text.to_str().unwrap().contains("bug number 7"), "{text:?}");
    }
}
