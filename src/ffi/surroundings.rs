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
    #[cfg(any(target_os = "linux", target_os = "macos"))]
    environment: posix::Environment,
    #[cfg(any(target_os = "linux", target_os = "macos"))]
    cancellation: libc::c_int,
    #[cfg(all(windows, target_arch = "x86_64"))]
    registers: registers::Registers,
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
mod posix {
    use libc::c_int;

    /// At least as large and as aligned as `fenv_t` of any Linux or macOS (32 bytes on x86).
    #[repr(C, align(16))]
    #[derive(Clone, Copy)]
    pub struct Environment(pub [u8; 128]);

    #[cfg(target_os = "linux")]
    pub const DISABLE: c_int = 1;
    #[cfg(target_os = "macos")]
    pub const DISABLE: c_int = 0;

    unsafe extern "C" {
        pub fn pthread_setcancelstate(state: c_int, old: *mut c_int) -> c_int;
    }

    #[link(name = "m")]
    unsafe extern "C" {
        pub fn fegetenv(environment: *mut Environment) -> c_int;
        pub fn fesetenv(environment: *const Environment) -> c_int;
        #[cfg(target_os = "macos")]
        #[link_name = "_FE_DFL_ENV"]
        static FE_DFL_ENV: Environment;
    }

    /// `FE_DFL_ENV` of the C header.
    pub fn default() -> *const Environment {
        // glibc and musl define it as the address -1 on every processor but PowerPC.
        #[cfg(target_os = "linux")]
        let default = std::ptr::without_provenance(usize::MAX);
        #[cfg(target_os = "macos")]
        let default = &raw const FE_DFL_ENV;
        default
    }
}

#[cfg(any(target_os = "linux", target_os = "macos"))]
impl Host {
    fn change() -> Self {
        let mut host =
            Host { environment: posix::Environment([0; 128]), cancellation: posix::DISABLE };
        // SAFETY: a state that the system knows, and a place for the old one; `environment` is large and aligned
        // enough for fenv_t; the default environment is the one that Rust code must run in.
        unsafe {
            posix::pthread_setcancelstate(posix::DISABLE, &raw mut host.cancellation);
            posix::fegetenv(&raw mut host.environment);
            posix::fesetenv(posix::default());
        }
        host
    }

    /// Nothing is raised on the way back.
    fn restore(&self) {
        let mut ours = posix::DISABLE;
        // SAFETY: `environment` was filled by fegetenv on this thread; a state that the system has told.
        unsafe {
            posix::fesetenv(&raw const self.environment);
            posix::pthread_setcancelstate(self.cancellation, &raw mut ours);
        }
    }
}

/// The registers of floating-point numbers themselves: the C libraries of Windows differ in what `fenv_t` is.
#[cfg(all(windows, target_arch = "x86_64"))]
mod registers {
    use std::arch::asm;

    #[derive(Clone, Copy)]
    pub struct Registers {
        /// Control and status of SSE, by which Rust computes.
        sse: u32,
        /// The environment of x87, which functions of MinGW's C library use.
        x87: [u32; 7],
    }

    impl Registers {
        /// All exceptions masked, to nearest, no flag, as a thread begins; returns what was there.
        pub fn begin() -> Self {
            static SSE: u32 = 0x1F80;
            let mut old = Registers { sse: SSE, x87: [0; 7] };
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

/// Windows has no cancellation.
#[cfg(all(windows, target_arch = "x86_64"))]
impl Host {
    fn change() -> Self {
        Host { registers: registers::Registers::begin() }
    }

    fn restore(&self) {
        self.registers.restore();
    }
}

#[cfg(not(any(target_os = "linux", target_os = "macos", all(windows, target_arch = "x86_64"))))]
impl Host {
    fn change() -> Self {
        Host {}
    }

    fn restore(&self) {}
}
