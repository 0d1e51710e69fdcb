//! The surroundings of a call: it changes the floating-point environment and the cancellation of its thread, and
//! gives both back to the host as they were.
//!
//! Cancellation unwinds as an exception of C++ does, which may not pass through Rust: a thread that is cancelled during a
//! call ends after it.
//!
//! A host may leave a call by `longjmp`, from a callback or from a handler of a signal, though the header forbids
//! it. What the call had allocated is lost then. What it had changed of the thread, and the memory that it held in
//! reserve, the next outer call finds and gives back first. A call is an outer one unless it comes from a callback
//! that is running: such a one lies deeper in the stack than the place from which the callback was called.

use std::cell::Cell;

use super::reserve::CallReserve;

/// The host's surroundings.
#[derive(Clone, Copy)]
struct Host {
    environment: Environment,
    #[cfg(any(target_os = "linux", target_os = "macos"))]
    cancellation: libc::c_int,
}

/// The outer call that a thread is in.
#[derive(Clone, Copy)]
struct Outer {
    host: Host,
    /// The place in the stack from which a callback was called that is running; 0 if none is.
    callback: usize,
}

thread_local! {
    static OUTER: Cell<Option<Outer>> = const { Cell::new(None) };
}

/// Holds the surroundings of a call, until it is dropped.
pub(super) struct Surroundings {
    host: Host,
    is_outer: bool,
}

impl Surroundings {
    /// Keeps the host's surroundings and sets those that a call needs.
    pub(super) fn of_call() -> Self {
        let outer = OUTER.get();
        if let Some(outer) = outer.filter(|outer| place_in_stack() >= outer.callback) {
            OUTER.set(None);
            outer.host.restore();
            CallReserve::give_back_abandoned();
        }
        let is_outer = OUTER.get().is_none();
        let host = Host::change();
        if is_outer {
            OUTER.set(Some(Outer { host, callback: 0 }));
        }
        Surroundings { host, is_outer }
    }
}

impl Drop for Surroundings {
    fn drop(&mut self) {
        if self.is_outer {
            OUTER.set(None);
        }
        self.host.restore();
    }
}

/// True if the thread is in a call.
#[cfg(c_library)]
pub(super) fn is_in_call() -> bool {
    OUTER.get().is_some()
}

/// Runs a callback of the host.
pub(super) fn in_host<T>(callback: impl FnOnce() -> T) -> T {
    let set = |place: usize| {
        let outer = OUTER.get();
        OUTER.set(outer.map(|outer| Outer { callback: place, ..outer }));
        outer.map_or(0, |outer| outer.callback)
    };
    let before = set(place_in_stack());
    let result = callback();
    set(before);
    result
}

/// An address of the frame of the caller, or next to it. Stacks grow towards smaller ones.
#[inline(always)]
fn place_in_stack() -> usize {
    let here = 0_u8;
    std::hint::black_box(&raw const here).addr()
}

#[cfg(any(target_os = "linux", target_os = "macos"))]
unsafe extern "C" {
    fn pthread_setcancelstate(state: libc::c_int, old: *mut libc::c_int) -> libc::c_int;
}

/// `PTHREAD_CANCEL_DISABLE`.
#[cfg(any(target_os = "linux", target_os = "macos"))]
const DISABLE: libc::c_int = if cfg!(target_os = "linux") { 1 } else { 0 };

impl Host {
    #[cfg(any(target_os = "linux", target_os = "macos"))]
    fn change() -> Self {
        let mut cancellation = DISABLE;
        // SAFETY: a state that the system knows, and a place for the old one.
        unsafe { pthread_setcancelstate(DISABLE, &raw mut cancellation) };
        Host { environment: Environment::begin(), cancellation }
    }

    /// Windows has no cancellation.
    #[cfg(not(any(target_os = "linux", target_os = "macos")))]
    fn change() -> Self {
        Host { environment: Environment::begin() }
    }

    /// Nothing is raised on the way back.
    fn restore(&self) {
        self.environment.restore();
        #[cfg(any(target_os = "linux", target_os = "macos"))]
        // SAFETY: a state that the system has told, and a place for ours.
        unsafe {
            let mut ours = DISABLE;
            pthread_setcancelstate(self.cancellation, &raw mut ours);
        }
    }
}

/// The registers of floating-point numbers themselves: on Linux the functions of C take twice as long, a tenth of a small call,
/// and on Windows C libraries differ in what `fenv_t` is.
#[cfg(all(any(target_os = "linux", windows), target_arch = "x86_64"))]
mod registers {
    use std::arch::asm;

    #[derive(Clone, Copy)]
    pub struct Environment {
        /// Control and status of SSE, by which Rust computes.
        sse: u32,
        /// The environment of x87, which functions of C libraries use.
        x87: [u32; 7],
    }

    impl Environment {
        /// All exceptions masked, to nearest, no flag, as a thread begins; returns what was there.
        pub fn begin() -> Self {
            static SSE: u32 = 0x1F80;
            let mut old = Environment { sse: SSE, x87: [0; 7] };
            // SAFETY: stores to places of their sizes, and loads a value without reserved bits.
            unsafe {
                asm!("stmxcsr [{}]", in(reg) &raw mut old.sse, options(nostack));
                asm!("ldmxcsr [{}]", in(reg) &raw const SSE, options(nostack));
                asm!("fnstenv [{}]", "fninit", in(reg) &raw mut old.x87, options(nostack));
            }
            old
        }

        pub fn restore(&self) {
            // SAFETY: loads what `begin` has stored on this thread; the stack of x87 is empty between functions.
            unsafe {
                asm!("fldenv [{}]", in(reg) &raw const self.x87, options(nostack));
                asm!("ldmxcsr [{}]", in(reg) &raw const self.sse, options(nostack));
            }
        }
    }
}
#[cfg(all(any(target_os = "linux", windows), target_arch = "x86_64"))]
use registers::Environment;

#[cfg(any(all(target_os = "linux", not(target_arch = "x86_64")), target_os = "macos"))]
mod posix {
    use libc::c_int;

    /// At least as large and as aligned as `fenv_t` of any Linux or macOS (32 bytes on x86).
    #[repr(C, align(16))]
    #[derive(Clone, Copy)]
    pub struct Environment([u8; 128]);

    #[link(name = "m")]
    unsafe extern "C" {
        fn fegetenv(environment: *mut Environment) -> c_int;
        fn fesetenv(environment: *const Environment) -> c_int;
        #[cfg(target_os = "macos")]
        #[link_name = "_FE_DFL_ENV"]
        static FE_DFL_ENV: Environment;
    }

    impl Environment {
        /// The environment that Rust code must run in; returns what was there.
        pub fn begin() -> Self {
            let mut old = Environment([0; 128]);
            // glibc and musl define `FE_DFL_ENV` as the address -1 on every processor but PowerPC.
            #[cfg(target_os = "linux")]
            let default = std::ptr::without_provenance(usize::MAX);
            #[cfg(target_os = "macos")]
            let default = &raw const FE_DFL_ENV;
            // SAFETY: `old` is large and aligned enough for fenv_t; the default of the C header.
            unsafe {
                fegetenv(&raw mut old);
                fesetenv(default);
            }
            old
        }

        pub fn restore(&self) {
            // SAFETY: filled by fegetenv on this thread.
            unsafe { fesetenv(&raw const *self) };
        }
    }
}
#[cfg(any(all(target_os = "linux", not(target_arch = "x86_64")), target_os = "macos"))]
use posix::Environment;

/// Other systems: nothing is known of the environment.
#[cfg(not(any(target_os = "linux", target_os = "macos", all(windows, target_arch = "x86_64"))))]
#[derive(Clone, Copy)]
struct Environment;

#[cfg(not(any(target_os = "linux", target_os = "macos", all(windows, target_arch = "x86_64"))))]
impl Environment {
    fn begin() -> Self {
        Environment
    }

    fn restore(&self) {}
}
