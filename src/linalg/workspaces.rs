//! Working memory of a factor's solves, kept from one solve to the next.

use std::sync::{Mutex, PoisonError};

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};

/// Buffers of one size. Threads that solve at once have one each.
pub struct Workspaces {
    size: StackReq,
    idle: Mutex<Vec<MemBuffer>>,
}

impl Workspaces {
    /// No buffers yet; each will have `size`.
    pub fn new(size: StackReq) -> Self {
        Workspaces { size, idle: Mutex::new(Vec::new()) }
    }

    /// Runs `work` with a buffer that no other thread uses meanwhile.
    pub fn lend<R>(&self, work: impl FnOnce(&mut MemStack) -> R) -> R {
        // Buffers hold nothing between solves: a panic of another thread spoils none.
        let idle = || self.idle.lock().unwrap_or_else(PoisonError::into_inner);
        let kept = idle().pop();
        let mut memory = kept.unwrap_or_else(|| MemBuffer::new(self.size));
        let result = work(MemStack::new(&mut memory));
        idle().push(memory);
        result
    }
}
