//! A thread of the system. Those of the standard library obtain memory in ways that end the process where it is
//! refused, which no reserve can serve.

/// What a thread does; it does not unwind.
pub(super) trait Run: Sync {
    /// Does it.
    fn run(&self);
}

/// A thread that runs, and that must be joined.
pub(super) struct Thread(own::Handle);

impl Thread {
    /// Starts a thread that gets no signals: they are the host's. `None`: the system has no more of them.
    ///
    /// # Safety
    /// `job` lives until the thread is joined.
    pub(super) unsafe fn start<J: Run>(job: &J) -> Option<Self> {
        #[cfg(unix)]
        let _masked = own::Masked::new();
        // SAFETY: by the caller's contract.
        unsafe { own::start(job) }.map(Thread)
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

    use super::Run;

    /// Stack of a thread, in bytes: that of the threads of Rust's standard library.
    const STACK: usize = 2 << 20;

    pub(super) type Handle = libc::pthread_t;

    pub(super) unsafe fn start<J: Run>(job: &J) -> Option<Handle> {
        extern "C" fn begin<J: Run>(job: *mut c_void) -> *mut c_void {
            // SAFETY: the job of `start`, which lives until the thread is joined.
            unsafe { (*job.cast::<J>()).run() };
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
                libc::pthread_create(thread.as_mut_ptr(), attributes.as_ptr(), begin::<J>, job);
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

    use super::Run;

    pub(super) type Handle = JoinHandle<()>;

    pub(super) unsafe fn start<J: Run>(job: &J) -> Option<Handle> {
        // SAFETY: by the caller's contract the job lives until the thread is joined.
        unsafe { Builder::new().spawn_unchecked(|| job.run()) }.ok()
    }

    pub(super) fn join(thread: Handle) {
        // The job does not unwind.
        let _ = thread.join();
    }
}
