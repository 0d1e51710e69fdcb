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
