//! The structures of the C interface, each led by its size, and their way in and out.

use std::ffi::c_void;
use std::ops::ControlFlow;

use super::guard::Failure;
use crate::law::State;
use crate::monitor::Progress;
use crate::settings::{Method, Settings};
use crate::solve::{LcpSolution, Solution};

/// Coulomb friction as a sequence of Tresca problems, g <- mu |F_n|, each by projected
/// over-relaxed Gauss-Seidel. The default.
pub const SIGNORINI_METHOD_SOR_NESTED: i32 = 1;
/// Projected over-relaxed Gauss-Seidel with the friction threshold updated inside the sweep.
pub const SIGNORINI_METHOD_SOR_DIAGONAL: i32 = 2;
/// Lemke's method, for frictionless contact: every mu must be 0.
pub const SIGNORINI_METHOD_LEMKE: i32 = 3;

/// A pair is apart: no contact force.
pub const SIGNORINI_OPEN: i32 = 0;
/// A pair slides: |F_t| = mu |F_n|; also every frictionless contact.
pub const SIGNORINI_SLIP: i32 = 1;
/// A pair sticks: d_t = slip.
pub const SIGNORINI_STICK: i32 = 2;

/// What a progress callback is told. New fields may follow in later versions.
#[repr(C)]
pub struct SignoriniProgress {
    /// Sweeps or pivots done.
    pub iterations: i64,
    /// Latest measured eta; infinite before the first measurement.
    pub eta: f64,
    /// Seconds since the call began.
    pub elapsed: f64,
}

/// Called before each sweep or pivot; a nonzero result cancels the call (SIGNORINI_CANCELLED).
/// It runs on the calling thread in the default floating-point environment. It must return: no
/// longjmp, no exception, and no call of this library.
pub type SignoriniProgressFn =
    Option<unsafe extern "C" fn(user: *mut c_void, progress: *const SignoriniProgress) -> i32>;

/// How to solve. Fill it by signorini_settings_default(), then change what you like.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SignoriniSettings {
    /// sizeof(signorini_settings) of the program; later fields than it covers have their defaults.
    pub struct_size: u32,
    /// SIGNORINI_METHOD_...; default SIGNORINI_METHOD_SOR_NESTED.
    pub method: i32,
    /// Solved means eta <= tolerance; 1e-15 to 0.1, default 1e-10.
    pub tolerance: f64,
    /// Over-relaxation factor between 0 and 2; default 0: chosen from the measured rate.
    pub omega: f64,
    /// Damping of the nested method's threshold update, in (0, 1]; default 0: chosen from the
    /// measured rate.
    pub damping: f64,
    /// Most sweeps (SOR) or pivots (Lemke), at least 1; default 200000.
    pub max_iterations: i64,
    /// Most seconds of wall time; default 0: no limit.
    pub time_limit: f64,
    /// Nonzero: the iteration starts from what d holds; default 0: it starts from zero.
    /// Lemke's method does not use a start.
    pub warm_start: i32,
    /// Must be 0.
    pub reserved: i32,
    /// Called before each sweep or pivot; default NULL.
    pub progress: SignoriniProgressFn,
    /// Handed to progress; default NULL.
    pub user: *mut c_void,
}

/// How good a result is. Set struct_size before the call; all else is written by it.
/// Forces and lengths are in the units of the problem.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SignoriniReport {
    /// sizeof(signorini_report) of the program: no more than that is written.
    pub struct_size: u32,
    /// What the call returned.
    pub status: i32,
    /// The method that ended it, SIGNORINI_METHOD_...
    pub method: i32,
    /// 0.
    pub reserved: i32,
    /// Sweeps or pivots.
    pub iterations: i64,
    /// Threshold updates of the nested method.
    pub outer_iterations: i64,
    /// How often Lemke's tableau was computed anew because accuracy was lost.
    pub refactorisations: i64,
    /// Residual of the natural map relative to the forces, without unit; 0 at exact solutions
    /// only.
    pub eta: f64,
    /// Rounding of K d relative to the forces, without unit; beyond 1e-6 nothing is certified.
    pub rounding: f64,
    /// Largest d_n - gap, a length; 0 if none.
    pub penetration: f64,
    /// Largest tensile (positive) normal component of K d - f, a force; 0 if none.
    pub tension: f64,
    /// Largest excess of the tangential part of K d - f over its bound, a force; 0 if none.
    pub cone_excess: f64,
    /// Largest component of K d - f - F, a force.
    pub equilibrium: f64,
    /// Over-relaxation factor at the end; 0 if there is none.
    pub omega: f64,
    /// Damping at the end; 0 if there is none.
    pub damping: f64,
    /// Pairs that are open.
    pub open: i64,
    /// Pairs that slide.
    pub slip: i64,
    /// Pairs that stick.
    pub stick: i64,
}

/// Settings as the solvers know them, with what only the C interface has.
pub(super) struct Received {
    pub(super) settings: Settings,
    pub(super) warm_start: bool,
    progress: SignoriniProgressFn,
    user: *mut c_void,
}

impl SignoriniSettings {
    fn default_one() -> Self {
        let default = Settings::default();
        SignoriniSettings {
            struct_size: size_of::<Self>() as u32,
            method: method_code(default.method),
            tolerance: default.tolerance,
            omega: default.omega,
            damping: default.damping,
            max_iterations: default.max_iterations as i64,
            time_limit: default.time_limit,
            warm_start: 0,
            reserved: 0,
            progress: None,
            user: std::ptr::null_mut(),
        }
    }

    /// Reads the caller's structure, NULL for the defaults.
    ///
    /// # Safety
    /// A pointer that is not NULL has as many readable bytes as its first field says.
    pub(super) unsafe fn receive(position: i32, pointer: *const Self) -> Result<Received, Failure> {
        let mut settings = Self::default_one();
        if !pointer.is_null() {
            // SAFETY: the caller's structure begins with its size; `copied` is at most that and
            // at most ours.
            unsafe {
                let copied = sized::<Self>(position, "settings", pointer)?;
                let target = (&raw mut settings).cast::<u8>();
                std::ptr::copy_nonoverlapping(pointer.cast::<u8>(), target, copied);
            }
        }
        settings.checked(position)
    }

    fn checked(self, position: i32) -> Result<Received, Failure> {
        let refuse = |message: String| Err(Failure::argument(position, message));
        let method = match self.method {
            SIGNORINI_METHOD_SOR_NESTED => Method::SorNested,
            SIGNORINI_METHOD_SOR_DIAGONAL => Method::SorDiagonal,
            SIGNORINI_METHOD_LEMKE => Method::Lemke,
            other => return refuse(format!("settings: there is no method {other}")),
        };
        let Ok(max_iterations) = u64::try_from(self.max_iterations) else {
            let given = self.max_iterations;
            return refuse(format!("settings: max_iterations is {given}, it must be at least 1"));
        };
        if self.reserved != 0 {
            return refuse(format!("settings: reserved is {}, it must be 0", self.reserved));
        }
        Ok(Received {
            settings: Settings {
                method,
                tolerance: self.tolerance,
                omega: self.omega,
                damping: self.damping,
                max_iterations,
                time_limit: self.time_limit,
            },
            warm_start: self.warm_start != 0,
            progress: self.progress,
            user: self.user,
        })
    }
}

impl Received {
    /// The caller's callback as a closure, if there is one.
    pub(super) fn progress(&self) -> Option<impl FnMut(&Progress) -> ControlFlow<()> + use<>> {
        let (callback, user) = (self.progress?, self.user);
        Some(move |progress: &Progress| {
            let progress = SignoriniProgress {
                iterations: progress.iterations as i64,
                eta: progress.eta,
                elapsed: progress.elapsed,
            };
            // SAFETY: the header demands a function of this type that returns normally.
            match unsafe { callback(user, &raw const progress) } {
                0 => ControlFlow::Continue(()),
                _ => ControlFlow::Break(()),
            }
        })
    }
}

impl SignoriniReport {
    /// Checks the size that the caller set; NULL is allowed.
    ///
    /// # Safety
    /// A pointer that is not NULL has at least 4 readable bytes.
    pub(super) unsafe fn accept(position: i32, pointer: *mut Self) -> Result<(), Failure> {
        if !pointer.is_null() {
            // SAFETY: by the caller's contract.
            unsafe { sized::<Self>(position, "report", pointer.cast_const())? };
        }
        Ok(())
    }

    /// Writes as much of the report as the caller's structure holds.
    ///
    /// # Safety
    /// A pointer that is not NULL was accepted and has as many bytes as its first field says.
    pub(super) unsafe fn send(mut self, pointer: *mut Self) {
        if pointer.is_null() {
            return;
        }
        // SAFETY: by the caller's contract; the size was checked by `accept`.
        unsafe {
            self.struct_size = pointer.cast::<u32>().read();
            let bytes = self.struct_size as usize;
            std::ptr::copy_nonoverlapping(
                (&raw const self).cast::<u8>(),
                pointer.cast::<u8>(),
                bytes,
            );
        }
    }

    pub(super) fn of(status: i32, method: Method, solution: &Solution) -> Self {
        let certificate = &solution.certificate;
        SignoriniReport {
            outer_iterations: solution.outer_iterations as i64,
            rounding: certificate.rounding,
            penetration: certificate.penetration,
            tension: certificate.tension,
            cone_excess: certificate.cone_excess,
            equilibrium: certificate.equilibrium,
            omega: solution.omega,
            damping: solution.damping,
            open: certificate.count(State::Open) as i64,
            slip: certificate.count(State::Slip) as i64,
            stick: certificate.count(State::Stick) as i64,
            eta: certificate.eta,
            iterations: solution.iterations as i64,
            refactorisations: solution.refactorisations as i64,
            ..Self::empty(status, method)
        }
    }

    pub(super) fn of_lcp(status: i32, solution: &LcpSolution) -> Self {
        SignoriniReport {
            eta: solution.eta,
            iterations: solution.iterations as i64,
            refactorisations: solution.refactorisations as i64,
            ..Self::empty(status, Method::Lemke)
        }
    }

    fn empty(status: i32, method: Method) -> Self {
        SignoriniReport {
            struct_size: size_of::<Self>() as u32,
            status,
            method: method_code(method),
            reserved: 0,
            iterations: 0,
            outer_iterations: 0,
            refactorisations: 0,
            eta: 0.0,
            rounding: 0.0,
            penetration: 0.0,
            tension: 0.0,
            cone_excess: 0.0,
            equilibrium: 0.0,
            omega: 0.0,
            damping: 0.0,
            open: 0,
            slip: 0,
            stick: 0,
        }
    }
}

/// Smallest structure of any version: its size, the first word and a number. Fields that an older
/// program does not have come after it.
const LEAST: usize = 16;

/// The size in the first field of a structure, if it is one that a version of this library has.
///
/// # Safety
/// `pointer` has at least 4 readable bytes.
unsafe fn sized<T>(position: i32, name: &str, pointer: *const T) -> Result<usize, Failure> {
    if !pointer.is_aligned() {
        return Err(Failure::argument(position, format!("{name} is not aligned")));
    }
    // SAFETY: by the caller's contract, and aligned.
    let size = unsafe { pointer.cast::<u32>().read() } as usize;
    let ours = size_of::<T>();
    if size > ours {
        let message = format!(
            "{name}: struct_size is {size}, this version of the library knows {ours} bytes"
        );
        return Err(Failure::argument(position, message));
    }
    if size < LEAST || !size.is_multiple_of(8) {
        let message = format!("{name}: struct_size is {size}, set it to sizeof ({ours})");
        return Err(Failure::argument(position, message));
    }
    Ok(size)
}

fn method_code(method: Method) -> i32 {
    match method {
        Method::SorNested => SIGNORINI_METHOD_SOR_NESTED,
        Method::SorDiagonal => SIGNORINI_METHOD_SOR_DIAGONAL,
        Method::Lemke => SIGNORINI_METHOD_LEMKE,
    }
}

pub(super) fn state_code(state: State) -> i32 {
    match state {
        State::Open => SIGNORINI_OPEN,
        State::Slip => SIGNORINI_SLIP,
        State::Stick => SIGNORINI_STICK,
    }
}

/// Fills settings with their defaults and sets struct_size.
///
/// @param settings     not NULL
/// @param struct_size  sizeof(signorini_settings); no more than that is written
/// @return 0, or -1 or -2 for the argument that is wrong
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_settings_default(
    settings: *mut SignoriniSettings,
    struct_size: u32,
) -> i32 {
    super::guard::call(|| {
        if settings.is_null() {
            return Err(Failure::argument(1, "settings is NULL"));
        }
        if !settings.is_aligned() {
            return Err(Failure::argument(1, "settings is not aligned"));
        }
        let mut default = SignoriniSettings::default_one();
        default.struct_size = struct_size;
        // SAFETY: `default` is ours; the caller's structure has `struct_size` bytes by contract,
        // and `bytes` is at most that and at most ours.
        unsafe {
            let bytes = sized::<SignoriniSettings>(2, "settings", &raw const default)?;
            let source = (&raw const default).cast::<u8>();
            std::ptr::copy_nonoverlapping(source, settings.cast::<u8>(), bytes);
        }
        Ok(0)
    })
}
