//! Status codes, their sentences, the last error, that of a panic inside a call, and the version.

use libc::c_char;
use std::any::Any;
use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind};

use super::numbers::{Numbered, numbers};
use crate::error::Message;
use crate::shortage::Shortage;
use crate::solve::{Remarks, Solution, Status};

/// Solved and certified.
pub const SIGNORINI_STATUS_SOLVED: i32 = 0;
/// max_iterations is used up: best iterate.
pub const SIGNORINI_STATUS_ITERATION_LIMIT: i32 = 1;
/// time_limit is used up: best iterate.
pub const SIGNORINI_STATUS_TIME_LIMIT: i32 = 2;
/// The progress callback cancelled: best iterate.
pub const SIGNORINI_STATUS_CANCELLED: i32 = 3;
/// Proved: no equilibrium exists (LCP: no w, z >= 0 satisfy w = q + M z). extra->motion (LCP: y) is
/// the proof. d, F and state hold the last iterate.
pub const SIGNORINI_STATUS_NO_EQUILIBRIUM: i32 = 4;
/// The method, or each that AUTO tries, cannot go on; nothing is proved: best iterate.
pub const SIGNORINI_STATUS_STALLED: i32 = 5;
/// Certify: the displacements are no solution.
pub const SIGNORINI_STATUS_NOT_A_SOLUTION: i32 = 6;
/// Prove: no solution is proved to exist; there may be one.
pub const SIGNORINI_STATUS_NOT_PROVED: i32 = 7;
/// The call may need more than memory_limit: nothing was computed or written.
pub const SIGNORINI_STATUS_MEMORY_LIMIT: i32 = 8;
/// A caught defect of the library: results undefined.
pub const SIGNORINI_STATUS_INTERNAL: i32 = -1000;
/// Out of memory: only earlier load cases were written.
pub const SIGNORINI_STATUS_OUT_OF_MEMORY: i32 = -1001;
/// A file cannot be read or written.
pub const SIGNORINI_STATUS_FILE: i32 = -1002;

/// Major version.
pub const SIGNORINI_VERSION_MAJOR: i32 = 0;
/// Minor version.
pub const SIGNORINI_VERSION_MINOR: i32 = 9;
/// Patch version.
pub const SIGNORINI_VERSION_PATCH: i32 = 0;
/// Binary interface of this header.
pub const SIGNORINI_ABI_VERSION: i32 = 3;

// The header's numbers are written out for C; here they are held to the package's version.
const _: () = {
    let major = i32::from_str_radix(env!("CARGO_PKG_VERSION_MAJOR"), 10);
    let minor = i32::from_str_radix(env!("CARGO_PKG_VERSION_MINOR"), 10);
    let patch = i32::from_str_radix(env!("CARGO_PKG_VERSION_PATCH"), 10);
    assert!(matches!(major, Ok(SIGNORINI_VERSION_MAJOR)));
    assert!(matches!(minor, Ok(SIGNORINI_VERSION_MINOR)));
    assert!(matches!(patch, Ok(SIGNORINI_VERSION_PATCH)));
};

numbers! {
    Status {
        Solved = SIGNORINI_STATUS_SOLVED,
        IterationLimit = SIGNORINI_STATUS_ITERATION_LIMIT,
        TimeLimit = SIGNORINI_STATUS_TIME_LIMIT,
        Cancelled = SIGNORINI_STATUS_CANCELLED,
        NoEquilibrium = SIGNORINI_STATUS_NO_EQUILIBRIUM,
        Stalled = SIGNORINI_STATUS_STALLED,
    }
}

/// Version, such as "0.9.0"; static text.
#[unsafe(no_mangle)]
pub extern "C" fn signorini_version() -> *const c_char {
    concat!(env!("CARGO_PKG_VERSION"), "\0").as_ptr().cast()
}

/// Binary interface of the library; after dlopen compare SIGNORINI_ABI_VERSION.
#[unsafe(no_mangle)]
pub extern "C" fn signorini_abi_version() -> i32 {
    SIGNORINI_ABI_VERSION
}

/// Statuses from this one to -1 are reserved for arguments.
const LAST_ARGUMENT: i32 = -99;

/// Static text for any status, such as "solved"; never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn signorini_status_string(status: i32) -> *const c_char {
    let text = match status {
        SIGNORINI_STATUS_SOLVED => c"solved",
        SIGNORINI_STATUS_ITERATION_LIMIT => c"iteration limit reached",
        SIGNORINI_STATUS_TIME_LIMIT => c"time limit reached",
        SIGNORINI_STATUS_CANCELLED => c"cancelled",
        SIGNORINI_STATUS_NO_EQUILIBRIUM => c"no equilibrium exists",
        SIGNORINI_STATUS_STALLED => c"stalled",
        SIGNORINI_STATUS_NOT_A_SOLUTION => c"not a solution",
        SIGNORINI_STATUS_NOT_PROVED => c"not proved",
        SIGNORINI_STATUS_MEMORY_LIMIT => c"memory limit reached",
        SIGNORINI_STATUS_INTERNAL => c"internal error",
        SIGNORINI_STATUS_OUT_OF_MEMORY => c"out of memory",
        SIGNORINI_STATUS_FILE => c"a file cannot be read or written",
        LAST_ARGUMENT..=-1 => c"an argument is wrong (status -k: the k-th)",
        _ => c"unknown status",
    };
    text.as_ptr()
}

const CAPACITY: usize = 512;

/// The end of a sentence that is cut.
const CUT: &str = " ...";

thread_local! {
    // The sentence as C counts, and as Fortran does. Fixed buffers: a pointer to one stays valid while a later call in
    // the same printf writes.
    static LAST: RefCell<[Sentence; 2]> = const { RefCell::new([Sentence::EMPTY; 2]) };
    // The sentence of the last panic, which may be caught inside a call that then takes another way.
    #[cfg(c_library)]
    static PANIC: RefCell<Sentence> = const { RefCell::new(Sentence::EMPTY) };
}

#[derive(Clone, Copy)]
struct Sentence {
    text: [u8; CAPACITY],
    used: usize,
}

impl Sentence {
    const EMPTY: Self = Sentence { text: [0; CAPACITY], used: 0 };

    /// Text that does not fit is cut between words, so that no number loses its last digits, and ends with dots.
    fn set(&mut self, text: &str) {
        let mut parts = [text, ""];
        if text.len() >= CAPACITY {
            let most = CAPACITY - 1 - CUT.len();
            let ends = (0..=most).rev().filter(|&i| text.is_char_boundary(i));
            let between_words = ends.clone().find(|&i| text[i..].starts_with(' '));
            parts = [&text[..between_words.or_else(|| ends.max()).unwrap_or(0)], CUT];
        }
        self.used = 0;
        for part in parts {
            self.text[self.used..self.used + part.len()].copy_from_slice(part.as_bytes());
            self.used += part.len();
        }
        self.text[self.used] = 0;
    }
}

/// Keeps what happened for `signorini_last_error` and for SGMESG.
pub(super) fn remember(message: impl Into<Message>) {
    let message = message.into();
    let from_one = message.counted_from_one();
    LAST.with_borrow_mut(|[c, fortran]| (c.set(&message), fortran.set(&from_one)));
}

/// True if a host should read the sentence of a result: why it is no solution, or the remarks on one.
pub(super) fn is_told(solution: &Solution) -> bool {
    solution.status != Status::Solved || solution.remarks != Remarks::default()
}

/// A sentence without indices: it needs no memory.
pub(super) fn remember_plain(sentence: &str) {
    LAST.with_borrow_mut(|last| last.iter_mut().for_each(|last| last.set(sentence)));
}

/// Does work that leaves the sentence of the call before as it is.
pub(super) fn keeping_sentence(work: impl FnOnce()) {
    let kept = LAST.with_borrow(|last| *last);
    work();
    LAST.set(kept);
}

/// The sentence of the last call on this thread, as Fortran counts.
pub(super) fn last_counted_from_one() -> String {
    let [_, Sentence { text, used }] = LAST.with_borrow(|last| *last);
    String::from_utf8_lossy(&text[..used]).into_owned()
}

/// Says in one sentence what was wrong in the last call on this thread, such as "K[12,7] is not
/// finite" (row, column; entries count from 0); after a solution its remarks, else nothing. A call
/// that releases leaves it. UTF-8, at most 511 bytes, never NULL. The text belongs to the thread,
/// until its next call.
#[unsafe(no_mangle)]
pub extern "C" fn signorini_last_error() -> *const c_char {
    LAST.with_borrow(|[c, _]| c.text.as_ptr().cast())
}

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
    LAST.set([PANIC.with_borrow(|sentence| *sentence); 2]);
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

    use super::super::surroundings::is_in_call;
    use super::PANIC;

    type Hook = Box<dyn Fn(&PanicHookInfo<'_>) + Sync + Send + 'static>;

    pub(super) fn set() {
        static ONCE: Once = Once::new();
        static OUTER: OnceLock<Hook> = OnceLock::new();
        ONCE.call_once(|| {
            // A hook without captures: it takes no memory that dlclose would lose.
            OUTER.get_or_init(std::panic::take_hook);
            std::panic::set_hook(Box::new(|panic| {
                if is_in_call() {
                    let sentence = format!("internal error: {panic}");
                    PANIC.with_borrow_mut(|noted| noted.set(&sentence));
                } else if let Some(outer) = OUTER.get() {
                    outer(panic);
                }
            }));
        });
    }
}
