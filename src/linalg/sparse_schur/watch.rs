//! Who is asked whether a factorisation goes on.

use std::ops::ControlFlow;

use super::failure::Failure;

/// Is told what a factorisation needs and how far it is, and may end it.
pub trait Watch {
    /// Before a long part that needs `bytes` of memory in all, those of its arguments included.
    fn announce(&mut self, bytes: u64) -> ControlFlow<()>;

    /// Between two steps; `share` of the work is done.
    fn step(&mut self, share: f64) -> ControlFlow<()>;
}

/// Asks before anything is known of the work.
pub fn go_on(watch: &mut dyn Watch) -> Result<(), Failure> {
    answered(watch.step(0.0))
}

/// An answer as a result.
pub fn answered(answer: ControlFlow<()>) -> Result<(), Failure> {
    if answer.is_break() { Err(Failure::Stopped) } else { Ok(()) }
}

/// Asks after so many operations: some milliseconds.
const OPERATIONS_BETWEEN: f64 = 3e8;

/// Counts operations, and asks now and then.
pub struct Work<'w> {
    watch: &'w mut dyn Watch,
    all: f64,
    done: f64,
    asked: f64,
}

impl<'w> Work<'w> {
    /// Nothing is done of `all` operations.
    pub fn new(watch: &'w mut dyn Watch, all: f64) -> Self {
        Work { watch, all: all.max(1.0), done: 0.0, asked: 0.0 }
    }

    /// So many operations more are done.
    pub fn did(&mut self, operations: f64) -> Result<(), Failure> {
        self.done += operations;
        if self.done - self.asked < OPERATIONS_BETWEEN {
            return Ok(());
        }
        self.asked = self.done;
        answered(self.watch.step((self.done / self.all).min(1.0)))
    }
}
