//! Threads that do the parts of a work: the calling one, or several that the C interface starts.

/// Threads that share the parts of a work. The results of the library do not depend on them: a part does the same on
/// any thread.
pub trait Workers {
    /// Most parts that are done at once, at least 1.
    fn threads(&self) -> usize;

    /// Does `work(thread, part)` for each part from 0 to `parts - 1`, once each, and returns when all that began have
    /// ended. Parts that are done at once have different threads, each below [`Self::threads`]. `go_on` is asked on the
    /// calling thread between parts; once it says `false` no further part begins.
    fn run(
        &self,
        parts: usize,
        work: &(dyn Fn(usize, usize) + Sync),
        go_on: &mut dyn FnMut() -> bool,
    );
}

/// The calling thread, which does one part after the other.
#[derive(Clone, Copy, Debug, Default)]
pub struct SingleThread;

impl Workers for SingleThread {
    fn threads(&self) -> usize {
        1
    }

    fn run(
        &self,
        parts: usize,
        work: &(dyn Fn(usize, usize) + Sync),
        go_on: &mut dyn FnMut() -> bool,
    ) {
        for part in 0..parts {
            if !go_on() {
                return;
            }
            work(0, part);
        }
    }
}
