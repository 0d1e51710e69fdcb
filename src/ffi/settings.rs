//! Settings of the C interface, led by their size, and the progress callback.

use libc::c_void;
use std::ops::ControlFlow;

use super::args::{At, c_entry};
use super::guard::Outcome;
use super::numbers::{Numbered, numbers};
use super::reserve;
use super::structures::Structure;
use super::surroundings::in_host;
use super::threads;
use crate::monitor::{Monitor, Progress, ProgressFn};
use crate::settings::{Method, Search, Settings};

/// Methods in turn, until one finds a solution.
pub const SIGNORINI_METHOD_AUTO: i32 = 0;
/// Projected over-relaxed Gauss-Seidel (SOR) on a sequence of Tresca problems, g <- mu |F_n|.
pub const SIGNORINI_METHOD_SOR_NESTED: i32 = 1;
/// Sweeps that update the threshold after each pair; not for Tresca's law.
pub const SIGNORINI_METHOD_SOR_DIAGONAL: i32 = 2;
/// Lemke's method, without friction or in 2D. If K is positive definite it ends at a solution.
pub const SIGNORINI_METHOD_LEMKE: i32 = 3;
/// Block principal pivoting, without friction.
pub const SIGNORINI_METHOD_BLOCK_PIVOTING: i32 = 4;
/// Newton's method; it may fail.
pub const SIGNORINI_METHOD_NEWTON: i32 = 5;
/// With friction: a path that ends at a solution; it exists if K is definite.
pub const SIGNORINI_METHOD_PATH: i32 = 6;

/// settings.warm_start of signorini_model_solve: each case starts from the solution of the last
/// one that was solved, in this call or in earlier ones on the model with this setting; the first
/// one as with 0. They share factors: the model keeps 32 N N bytes at most, until it is released
/// or a call has another start. The same calls in the same order give the same bits; another
/// order may change last digits, and which of several solutions is found. Only one thread of
/// those that share a model may use it. Other calls take it as 0.
pub const SIGNORINI_START_PREVIOUS: i32 = 2;

/// Report only what the solution itself proves about other solutions.
pub const SIGNORINI_SEARCH_OFF: i32 = 0;
/// Prove that the solution is unique, or look for a second one. It costs several solutions.
pub const SIGNORINI_SEARCH_OTHERS: i32 = 1;

/// Later versions may add fields at the end.
#[repr(C)]
pub struct SignoriniProgress {
    /// Sweeps, pivots or linear systems done.
    pub iterations: i64,
    /// Latest measured eta; infinite before the first measurement.
    pub eta: f64,
    /// Seconds since the call began.
    pub elapsed: f64,
    /// Share of a reduction or a pairing that is done, 0 to 1; 1 in a load case.
    pub reduced: f64,
    /// Bytes that this reduction needs in all, told before they are taken; otherwise 0.
    pub memory: i64,
}

/// Called before each sweep, pivot or linear system, between them in long work, and often while
/// models are made or surfaces paired. A nonzero result cancels: SIGNORINI_STATUS_CANCELLED, or
/// what was found. It runs on the calling thread, in the default floating-point environment. It
/// must return (no longjmp, no exception), and not call this library.
pub type SignoriniProgressFn =
    Option<unsafe extern "C" fn(user: *mut c_void, progress: *const SignoriniProgress) -> i32>;

/// Fill it by signorini_settings_default(), then change what you like.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SignoriniSettings {
    /// sizeof(signorini_settings).
    pub struct_size: u32,
    /// SIGNORINI_METHOD_...; default SIGNORINI_METHOD_AUTO.
    pub method: i32,
    /// Solved means eta <= tolerance; 1e-15 to 0.1, default 1e-10.
    pub tolerance: f64,
    /// Over-relaxation factor, 0 to 2; default 0: chosen from the measured rate.
    pub omega: f64,
    /// Damping of the threshold update, 0 to 1; default 0: chosen likewise.
    pub damping: f64,
    /// Most sweeps, pivots or linear systems, at least 1; default 200000.
    pub max_iterations: i64,
    /// Most seconds of wall time; 0, the default, and infinity: no limit. A factorisation that would
    /// take longer is not begun.
    pub time_limit: f64,
    /// Nonzero: start from what d holds, block pivoting from its states. Default 0: start from d =
    /// 0, block pivoting from all pairs closed. Lemke's method has no start.
    /// SIGNORINI_START_PREVIOUS: from the case before.
    pub warm_start: i32,
    /// SIGNORINI_SEARCH_...; default SIGNORINI_SEARCH_OFF.
    pub search: i32,
    /// Progress callback; default NULL.
    pub progress: SignoriniProgressFn,
    /// First argument of progress; default NULL.
    pub user: *mut c_void,
    /// Nonzero: prove that the solution exists, and where: report.proof, extra.radius_d and
    /// radius_F; default 0. It costs one to five solutions.
    pub proof: i32,
    /// 0.
    pub reserved: i32,
    /// Most bytes that a solution, or making a model, may need; default 0: no limit.
    pub memory_limit: i64,
    /// Nonzero: a sparse model is always in full space; default 0.
    pub full_space: i32,
    /// Most threads of a call, at most one a processor; default 1; 0 stands for 1. They end before
    /// the call does, and get no signals. If the system refuses memory to a thread that begins, the
    /// process may end.
    ///
    /// Several cases of signorini_model_solve: each thread solves a part of them, and takes
    /// signorini_model_data.memory, to which memory_limit applies. The same number gives the same
    /// bits.
    ///
    /// One case, a callback, SIGNORINI_START_PREVIOUS, and other calls: at most 64 share large
    /// factorisations and products. Any number gives the same bits. In those of a sparse matrix
    /// each takes 8 bytes an unknown and up to 1 MB.
    pub threads: i32,
}

/// From where a solution starts.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum WarmStart {
    None,
    /// From the caller's d.
    Given,
    /// From the case before.
    Previous,
}

/// Settings as the solvers know them, with what only the C interface has.
pub(super) struct ParsedSettings {
    pub(super) settings: Settings,
    pub(super) warm_start: WarmStart,
    /// At least 1.
    pub(super) threads: usize,
    pub(super) progress: SignoriniProgressFn,
    pub(super) user: *mut c_void,
}

// SAFETY: led by its size; numbers, a pointer and a callback.
unsafe impl Structure for SignoriniSettings {
    fn default_one() -> Self {
        let default = Settings::default();
        SignoriniSettings {
            method: default.method.number(),
            tolerance: default.tolerance,
            omega: default.omega,
            damping: default.damping,
            max_iterations: default.max_iterations as i64,
            time_limit: default.time_limit,
            search: SIGNORINI_SEARCH_OFF,
            threads: 1,
            ..Self::zeros()
        }
    }
}

impl SignoriniSettings {
    /// Reads and checks the caller's structure, NULL for the defaults.
    pub(super) fn read(at: At<'_>, pointer: *const Self) -> Outcome<ParsedSettings> {
        at.copy(pointer)?.parsed(at)
    }

    /// Checks settings.
    pub(super) fn parsed(self, at: At<'_>) -> Outcome<ParsedSettings> {
        let natural = |field, value: i64, wanted: &str| {
            let wrong = |_| at.field(field).refuse(format!("is {value}, it must be {wanted}"));
            u64::try_from(value).or_else(wrong)
        };
        let max_iterations = natural("max_iterations", self.max_iterations, "at least 1")?;
        let memory_limit = natural("memory_limit", self.memory_limit, "0 (none) or bytes")?;
        let threads = natural("threads", self.threads.into(), "0 (one thread) or more")?;
        at.check_reserved(self.reserved)?;
        let settings = Settings {
            method: at.chosen("method", self.method)?,
            tolerance: self.tolerance,
            omega: self.omega,
            damping: self.damping,
            max_iterations,
            time_limit: self.time_limit,
            search: at.chosen("search", self.search)?,
            proof: self.proof != 0,
            memory_limit,
            full_space: self.full_space != 0,
        };
        settings.validate().map_err(at.refused())?;
        Ok(ParsedSettings {
            settings,
            warm_start: match self.warm_start {
                0 => WarmStart::None,
                SIGNORINI_START_PREVIOUS => WarmStart::Previous,
                _ => WarmStart::Given,
            },
            threads: usize::try_from(threads).unwrap_or(usize::MAX).max(1),
            progress: self.progress,
            user: self.user,
        })
    }
}

impl ParsedSettings {
    /// Does work that the settings limit, the caller's callback watches, and the caller's number of
    /// threads share.
    pub(super) fn monitored<T>(&self, work: impl FnOnce(&mut Monitor<'_>) -> T) -> T {
        threads::with_threads(self.threads, 0, || {
            let mut progress = self.progress();
            let progress = progress.as_mut().map(|progress| progress as &mut ProgressFn<'_>);
            let mut monitor = Monitor::new(&self.settings, progress);
            monitor.reserve = reserve::want;
            work(&mut monitor)
        })
    }

    /// The caller's callback as a closure, if there is one.
    pub(super) fn progress(&self) -> Option<impl FnMut(&Progress) -> ControlFlow<()> + use<>> {
        let (progress, user) = (self.progress?, self.user);
        Some(move |told: &Progress| {
            let told = SignoriniProgress {
                iterations: told.iterations as i64,
                eta: told.eta,
                elapsed: told.elapsed,
                reduced: told.reduced,
                memory: told.memory as i64,
            };
            // SAFETY: the header demands a function of this type that returns normally.
            match in_host(|| unsafe { progress(user, &raw const told) }) {
                0 => ControlFlow::Continue(()),
                _ => ControlFlow::Break(()),
            }
        })
    }
}

numbers! {
    Method {
        Auto = SIGNORINI_METHOD_AUTO,
        SorNested = SIGNORINI_METHOD_SOR_NESTED,
        SorDiagonal = SIGNORINI_METHOD_SOR_DIAGONAL,
        Lemke = SIGNORINI_METHOD_LEMKE,
        BlockPivoting = SIGNORINI_METHOD_BLOCK_PIVOTING,
        Newton = SIGNORINI_METHOD_NEWTON,
        Path = SIGNORINI_METHOD_PATH,
    }
}

numbers! { Search { Off = SIGNORINI_SEARCH_OFF, Others = SIGNORINI_SEARCH_OTHERS } }

/// Fills settings with their defaults; struct_size is sizeof(signorini_settings).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_settings_default(
    settings: *mut SignoriniSettings,
    struct_size: u32,
) -> i32 {
    c_entry!(|arrays| { arrays.at(1, "settings").fill(settings, struct_size) })
}
