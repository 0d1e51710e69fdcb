//! A thread of the system, with a reserve of its own. Threads of the standard library obtain memory in ways that end the process where it is
//! refused, which no reserve can serve.

use std::sync::Barrier;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::ffi::guard;
use crate::shortage;

/// The life of a further thread.
pub(super) struct Job {
    /// Bytes that the thread holds in reserve.
    memory: u64,
    /// It does not unwind.
    work: Box<dyn Fn() + Send + Sync>,
    is_prepared: AtomicBool,
    /// The caller waits here until the thread has obtained the memory that it keeps. The C library ends the process if
    /// it is refused memory there: no other request is made meanwhile.
    ready: Barrier,
}

impl Job {
    /// A job for a thread.
    pub(super) fn new(memory: u64, work: Box<dyn Fn() + Send + Sync>) -> Self {
        Job { memory, work, is_prepared: AtomicBool::new(false), ready: Barrier::new(2) }
    }

    /// `true` if its thread has what it keeps for itself, and does the work.
    pub(super) fn is_prepared(&self) -> bool {
        self.is_prepared.load(Ordering::Relaxed)
    }

    /// Runs as an entry of the C interface. Without memory the work is not done.
    fn run(&self) {
        guard::call(|| {
            guard::reserve_estimate(self.memory)?;
            self.is_prepared.store(true, Ordering::Relaxed);
            self.ready.wait();
            (self.work)();
            // The reserve of the thread holds nothing that outlives its work.
            shortage::check();
            Ok(0)
        });
        if !self.is_prepared() {
            self.ready.wait();
        }
    }
}

/// Processors that the calling thread may run on. The standard library reads files for it on Linux.
#[cfg(target_os = "linux")]
pub(super) fn processors() -> usize {
    // SAFETY: a set of processors, which is written to its place.
    let count = unsafe {
        let mut set: libc::cpu_set_t = std::mem::zeroed();
        libc::sched_getaffinity(0, size_of_val(&set), &raw mut set);
        libc::CPU_COUNT(&set)
    };
    // 0: the system has more processors than a set.
    usize::try_from(count).ok().filter(|count| *count > 0).unwrap_or(usize::MAX)
}

/// Processors that the process may run on.
#[cfg(not(target_os = "linux"))]
pub(super) fn processors() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// A thread that runs, and that must be joined.
pub(super) struct Thread(own::Handle);

impl Thread {
    /// Starts a thread that gets no signals, which are the host's, and waits until it is prepared. `None`: the system
    /// has no more of them.
    ///
    /// # Safety
    /// `job` lives until the thread is joined.
    pub(super) unsafe fn start(job: &Job) -> Option<Self> {
        #[cfg(unix)]
        let masked = own::Masked::new();
        // SAFETY: by the caller's contract.
        let handle = unsafe { own::start(job) }?;
        #[cfg(unix)]
        drop(masked);
        job.ready.wait();
        Some(Thread(handle))
    }

    /// Waits until the thread is gone.
    pub(super) fn join(self) {
        own::join(self.0);
    }
}

#[cfg(unix)]
mod own {
    use std::ffi::c_void;
    use std::mem::{MaybeUninit, zeroed};
    use std::ptr::null_mut;

    use super::Job;

    /// Stack of a thread, in bytes: that of the threads of Rust's standard library.
    const STACK: usize = 2 << 20;

    pub(super) type Handle = libc::pthread_t;

    pub(super) unsafe fn start(job: &Job) -> Option<Handle> {
        extern "C" fn begin(job: *mut c_void) -> *mut c_void {
            // SAFETY: the job of `start`, which lives until the thread is joined.
            unsafe { (*job.cast::<Job>()).run() };
            null_mut()
        }
        let (mut attributes, mut thread) = (MaybeUninit::uninit(), MaybeUninit::uninit());
        // SAFETY: attributes are initialised before they are used, the handle is written where the thread begins.
        unsafe {
            if libc::pthread_attr_init(attributes.as_mut_ptr()) != 0 {
                return None;
            }
            libc::pthread_attr_setstacksize(attributes.as_mut_ptr(), STACK);
            let job = std::ptr::from_ref(job).cast_mut().cast();
            let refused =
                libc::pthread_create(thread.as_mut_ptr(), attributes.as_ptr(), begin, job);
            libc::pthread_attr_destroy(attributes.as_mut_ptr());
            (refused == 0).then(|| thread.assume_init())
        }
    }

    pub(super) fn join(thread: Handle) {
        // SAFETY: a thread of `start`, joined once.
        unsafe { libc::pthread_join(thread, null_mut()) };
    }

    /// The calling thread, and those that it starts, get no signals until it is dropped.
    pub(super) struct Masked(libc::sigset_t);

    impl Masked {
        pub(super) fn new() -> Self {
            // SAFETY: sets of signals, filled before they are read.
            unsafe {
                let (mut all, mut before) = (zeroed(), zeroed());
                libc::sigfillset(&raw mut all);
                libc::pthread_sigmask(libc::SIG_SETMASK, &raw const all, &raw mut before);
                Masked(before)
            }
        }
    }

    impl Drop for Masked {
        fn drop(&mut self) {
            // SAFETY: the set that `new` has read.
            unsafe {
                libc::pthread_sigmask(libc::SIG_SETMASK, &raw const self.0, null_mut());
            }
        }
    }
}

#[cfg(not(unix))]
mod own {
    use std::thread::{Builder, JoinHandle};

    use super::Job;

    pub(super) type Handle = JoinHandle<()>;

    pub(super) unsafe fn start(job: &Job) -> Option<Handle> {
        // SAFETY: by the caller's contract the job lives until the thread is joined.
        unsafe { Builder::new().spawn_unchecked(|| job.run()) }.ok()
    }

    pub(super) fn join(thread: Handle) {
        // The job does not unwind.
        let _ = thread.join();
    }
}
