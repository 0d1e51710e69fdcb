//! The sentence of a panic inside a call, for `signorini_last_error`.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

#[cfg(not(c_library))]
use super::status::remember;
use crate::shortage::Shortage;

/// Runs the body of a call, and remembers the sentence of a panic that ends it.
pub(super) fn caught<T>(body: impl FnOnce() -> T) -> Result<T, Box<dyn Any + Send>> {
    #[cfg(c_library)]
    hook::set();
    // Unwind safety: only the caller's outputs can be half-written, and they are undefined with
    // SIGNORINI_STATUS_INTERNAL.
    let result = catch_unwind(AssertUnwindSafe(body));
    if let Err(reason) = &result
        && !reason.is::<Shortage>()
    {
        tell(reason.as_ref());
    }
    result
}

/// The hook has noted the sentence, with the place in the source.
#[cfg(c_library)]
fn tell(_: &dyn Any) {
    super::status::tell_panic();
}

#[cfg(not(c_library))]
fn tell(reason: &dyn Any) {
    let text = reason.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| reason.downcast_ref::<&str>().copied()).unwrap_or("a panic");
    remember(format!("internal error: {text}"));
}

/// The hook of the C library. Rust's default hook prints to the host's stderr; inside a call the
/// sentence goes to `signorini_last_error` instead. Panics elsewhere keep the hook of before. A Rust
/// program has its own hook, which stays.
#[cfg(c_library)]
mod hook {
    use std::panic::PanicHookInfo;
    use std::sync::{Once, OnceLock};

    use super::super::status::note_panic;
    use super::super::surroundings::is_in_call;

    type Hook = Box<dyn Fn(&PanicHookInfo<'_>) + Sync + Send + 'static>;

    pub(super) fn set() {
        static ONCE: Once = Once::new();
        static OUTER: OnceLock<Hook> = OnceLock::new();
        ONCE.call_once(|| {
            // A hook without captures: it takes no memory that dlclose would lose.
            OUTER.get_or_init(std::panic::take_hook);
            std::panic::set_hook(Box::new(|panic| {
                if is_in_call() {
                    note_panic(&format!("internal error: {panic}"));
                } else if let Some(outer) = OUTER.get() {
                    outer(panic);
                }
            }));
        });
    }
}
