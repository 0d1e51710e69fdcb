//! Memory that the solution of a problem leaves for the next one with the same matrix.

use std::any::Any;
use std::fmt;
use std::sync::{Mutex, PoisonError};

/// One thing that a method has worked out of a matrix, whatever the loads: a factor, or an elimination. The next problem
/// with that matrix takes it out, and leaves its own.
#[derive(Default)]
pub struct Remembered(Mutex<Option<Box<dyn Any + Send>>>);

impl Remembered {
    /// Takes out what was left; `None` if it is no `T`, which is then gone: nothing is kept while a method needs the memory.
    pub fn take<T: 'static>(&self) -> Option<T> {
        let left = self.0.lock().unwrap_or_else(PoisonError::into_inner).take();
        left?.downcast().ok().map(|left| *left)
    }

    /// True if a `T` was left.
    pub fn is<T: 'static>(&self) -> bool {
        let left = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        left.as_ref().is_some_and(|left| left.is::<T>())
    }

    /// Leaves this for the next problem.
    pub fn leave<T: Send + 'static>(&self, left: T) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = Some(Box::new(left));
    }
}

impl fmt::Debug for Remembered {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Remembered")
    }
}
