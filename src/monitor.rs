//! Budgets, progress and cancellation, the same for every solver.

use std::cell::{Cell, RefCell};
use std::ops::ControlFlow;
use std::time::Instant;

use crate::error::{Error, Limit};
use crate::settings::Settings;
use crate::shortage;

/// The argument of a progress callback.
#[derive(Clone, Copy, Debug)]
pub struct Progress {
    /// Sweeps, pivots or linear systems done.
    pub iterations: u64,
    /// Latest measured `eta`; infinite before the first measurement.
    pub eta: f64,
    /// Seconds since the call began.
    pub elapsed: f64,
    /// Share of the reduction of a sparse matrix, or of a pairing of surfaces, that is done, 0 to 1; 1 while a load case
    /// is solved.
    pub reduced: f64,
    /// Bytes that this reduction needs in all, known before they are taken; 0 before that and while a load
    /// case is solved.
    pub memory: u64,
}

/// Why a solver stopped before it was done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// `max_iterations` is used up.
    IterationLimit,
    /// `time_limit` is used up.
    TimeLimit,
    /// The progress callback cancelled.
    Cancelled,
}

/// A progress callback: `Break` cancels.
pub type ProgressFn<'a> = dyn FnMut(&Progress) -> ControlFlow<()> + 'a;

/// Operations of dense linear algebra in a second until a call has measured its own: what a processor with
/// vectors of four doubles does.
const OPERATIONS: f64 = 2e10;

/// Work of fewer operations does not tell their rate: other things take most of its time.
const MEASURABLE: f64 = 1e7;

/// Counts iterations, reports progress and ends a call whose budget is used up.
pub struct Monitor<'a> {
    budget: Budget,
    /// `true` if a sparse matrix is to be left uncondensed.
    pub(crate) full_space: bool,
    /// Obtains so many bytes for a work before it begins; `false`: the system refuses them.
    pub(crate) reserve: fn(u64) -> bool,
    progress: RefCell<Option<&'a mut ProgressFn<'a>>>,
}

/// A monitor that all solvers of a call share, however long its callback lives.
pub(crate) trait Watch {
    fn budget(&self) -> &Budget;

    /// Reports progress: `true` if the callback cancels.
    fn tell(&self, now: &Progress) -> bool;
}

/// The limits of a call, and what is used up of them.
pub(crate) struct Budget {
    /// When the call began; `None` where nobody asks.
    begin: Option<Instant>,
    time_limit: f64,
    memory_limit: u64,
    max_iterations: Cell<u64>,
    iterations: Cell<u64>,
    eta: Cell<f64>,
    /// When the last long work began, and its operations.
    work: Cell<Option<(Instant, f64)>>,
    /// Operations in a second.
    rate: Cell<f64>,
    /// True once the callback has cancelled: it is not asked again.
    is_cancelled: Cell<bool>,
}

impl<'a> Monitor<'a> {
    /// A monitor with the budgets of `settings`; the clock starts now.
    pub fn new(settings: &Settings, progress: Option<&'a mut ProgressFn<'a>>) -> Self {
        let budget = Budget {
            begin: (settings.time_limit != 0.0 || progress.is_some()).then(Instant::now),
            time_limit: if settings.time_limit == 0.0 {
                f64::INFINITY
            } else {
                settings.time_limit
            },
            memory_limit: settings.memory_limit,
            max_iterations: Cell::new(settings.max_iterations),
            iterations: Cell::new(0),
            eta: Cell::new(f64::INFINITY),
            work: Cell::new(None),
            rate: Cell::new(OPERATIONS),
            is_cancelled: Cell::new(false),
        };
        let (full_space, progress) = (settings.full_space, RefCell::new(progress));
        Monitor { budget, full_space, reserve: |_| true, progress }
    }

    /// Sweeps, pivots or linear systems done so far.
    pub fn iterations(&self) -> u64 {
        self.budget.iterations.get()
    }

    /// This monitor, as others share it.
    pub(crate) fn shared(&self) -> &dyn Watch {
        self
    }
}

/// A monitor that ends nothing.
#[cfg(test)]
pub(crate) fn unwatched() -> &'static dyn Watch {
    Box::leak(Box::new(Monitor::new(&Settings::default(), None)))
}

impl Watch for Monitor<'_> {
    fn budget(&self) -> &Budget {
        &self.budget
    }

    fn tell(&self, now: &Progress) -> bool {
        // Nobody else holds the callback: it cannot reach the monitor that calls it.
        let held = self.progress.try_borrow_mut();
        held.is_ok_and(|mut progress| progress.as_mut().is_some_and(|tell| tell(now).is_break()))
    }
}

impl dyn Watch + '_ {
    /// Sweeps, pivots or linear systems done so far.
    pub(crate) fn iterations(&self) -> u64 {
        self.budget().iterations.get()
    }

    /// Runs `work` with at most `steps` further iterations. Returns its result, and whether the
    /// iterations of the whole call are used up.
    pub(crate) fn within<T>(&self, steps: u64, work: impl FnOnce() -> T) -> (T, bool) {
        let Budget { max_iterations, iterations, .. } = self.budget();
        let all = max_iterations.get();
        max_iterations.set(all.min(iterations.get().saturating_add(steps)));
        let result = work();
        max_iterations.set(all);
        (result, iterations.get() >= all)
    }

    /// Records `eta` for the next progress report.
    pub(crate) fn measured(&self, eta: f64) {
        self.budget().eta.set(eta);
    }

    /// To be called before each sweep, pivot or linear system: counts it, or returns why to stop.
    pub(crate) fn step(&self) -> Result<(), Stop> {
        shortage::check();
        let Budget { max_iterations, iterations, .. } = self.budget();
        if iterations.get() >= max_iterations.get() {
            return Err(Stop::IterationLimit);
        }
        self.goes_on()?;
        iterations.set(iterations.get() + 1);
        Ok(())
    }

    /// To be called now and then in a long one: nothing is counted.
    pub(crate) fn goes_on(&self) -> Result<(), Stop> {
        self.learn();
        self.ask()
    }

    /// Asks in the middle of a work, between two parts of it: `false` ends it.
    pub(crate) fn asking(&self) -> impl FnMut() -> bool + use<'_> {
        || self.ask().is_ok()
    }

    fn ask(&self) -> Result<(), Stop> {
        if self.budget().is_cancelled.get() {
            return Err(Stop::Cancelled);
        }
        let elapsed = self.elapsed();
        if elapsed > self.budget().time_limit {
            return Err(Stop::TimeLimit);
        }
        if self.cancels(elapsed, 1.0, 0) { Err(Stop::Cancelled) } else { Ok(()) }
    }

    /// Reports progress: `true` if the callback cancels.
    fn cancels(&self, elapsed: f64, reduced: f64, memory: u64) -> bool {
        let Budget { iterations, eta, is_cancelled, .. } = self.budget();
        let (iterations, eta) = (iterations.get(), eta.get());
        is_cancelled.set(self.tell(&Progress { iterations, eta, elapsed, reduced, memory }));
        is_cancelled.get()
    }

    /// To be called before so many `operations` of dense linear algebra: why not to begin, if they would pass the time
    /// limit, or the callback cancels. The last ones in this call tell how long they take.
    pub(crate) fn affords(&self, operations: f64) -> Result<(), Stop> {
        if operations >= MEASURABLE {
            self.goes_on()?;
        }
        self.learn();
        if self.is_late_after(operations / self.budget().rate.get()) {
            return Err(self.reason());
        }
        let work = (operations >= MEASURABLE).then(|| (Instant::now(), operations));
        self.budget().work.set(work);
        Ok(())
    }

    /// The rate of the work that has ended.
    fn learn(&self) {
        let Budget { work, rate, .. } = self.budget();
        if let Some((begin, operations)) = work.take() {
            rate.set(operations / begin.elapsed().as_secs_f64());
        }
    }

    /// `true` if the time limit is used up, or the callback, which is asked, cancels or has cancelled: for sweeps, and
    /// questions about a result that is there already, which are then left open.
    pub(crate) fn is_late(&self) -> bool {
        shortage::check();
        self.goes_on().is_err()
    }

    fn is_late_after(&self, seconds: f64) -> bool {
        self.budget().is_cancelled.get() || self.elapsed() + seconds > self.budget().time_limit
    }

    /// Seconds since the call began, 0 where nobody asks.
    fn elapsed(&self) -> f64 {
        self.budget().begin.map_or(0.0, |begin| begin.elapsed().as_secs_f64())
    }

    /// Why the call is to end, if it is; the callback is not asked.
    pub(crate) fn stop(&self) -> Option<Stop> {
        self.is_late_after(0.0).then(|| self.reason())
    }

    /// Why a call ends for which there is no time.
    pub(crate) fn reason(&self) -> Stop {
        if self.budget().is_cancelled.get() { Stop::Cancelled } else { Stop::TimeLimit }
    }

    /// To be called while a matrix is reduced: `share` of the work is done, which needs `memory` bytes.
    ///
    /// # Errors
    /// [`Error::Stopped`]: the limit that is passed, or the callback.
    pub(crate) fn reducing(&self, share: f64, memory: u64) -> Result<(), Error> {
        shortage::check();
        if self.budget().memory_limit > 0 && memory > self.budget().memory_limit {
            let (limit, needed) = (self.budget().memory_limit, megabytes(memory));
            let most = megabytes(limit);
            let message = format!(
                "the reduction needs {needed:.1} MB, settings: memory_limit allows {limit} bytes ({most:.1} MB); \
                 nothing was factorised"
            );
            return Err(Error::stopped(Limit::Memory, message));
        }
        self.does("reduction", share, memory)
    }

    /// To be called while surfaces are paired, of which `share` is done.
    ///
    /// # Errors
    /// As `reducing`.
    pub(crate) fn pairing(&self, share: f64) -> Result<(), Error> {
        shortage::check();
        self.does("pairing", share, 0)
    }

    fn does(&self, work: &str, share: f64, memory: u64) -> Result<(), Error> {
        let elapsed = self.elapsed();
        let done = 100.0 * share;
        if elapsed > self.budget().time_limit {
            let message = format!(
                "the time limit of {} s is used up with {done:.0} % of the {work} done",
                self.budget().time_limit
            );
            return Err(Error::stopped(Limit::Time, message));
        }
        if self.cancels(elapsed, share, memory) {
            let message = format!("cancelled with {done:.0} % of the {work} done");
            return Err(Error::stopped(Limit::Cancelled, message));
        }
        Ok(())
    }
}

fn megabytes(bytes: u64) -> f64 {
    bytes as f64 / 1e6
}
