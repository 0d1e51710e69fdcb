//! Objects other than models known by numbers. Fortran has no pointer type of its own: an address in an INTEGER*8 would be
//! followed whatever it holds, a number that is not here is refused.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::super::guard::Failure;
use super::arguments::{read, write};

/// The objects of one kind that live.
pub(super) struct Handles<T> {
    /// The name of the argument, and what it stands for.
    name: &'static str,
    what: &'static str,
    living: Mutex<Living<T>>,
}

struct Living<T> {
    next: i64,
    by_number: BTreeMap<i64, Arc<T>>,
}

impl<T> Handles<T> {
    /// The upper half of a handle is `letters`, two characters of ASCII other than the "SG" of models, the lower
    /// half counts from 1: neither is 0, so that a handle cut to an INTEGER*4 is never one, and kinds do not meet.
    pub(super) const fn new(name: &'static str, what: &'static str, letters: [u8; 2]) -> Self {
        let kind = i64::from_be_bytes([0, 0, letters[0], letters[1], 0, 0, 0, 0]);
        let living = Living { next: kind + 1, by_number: BTreeMap::new() };
        Handles { name, what, living: Mutex::new(living) }
    }

    fn living(&self) -> MutexGuard<'_, Living<T>> {
        // The map is whole whenever a panic can happen.
        self.living.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Makes an object by an entry of C and puts its number into the handle, 0 if there is none.
    ///
    /// # Safety
    /// `handle` is NULL or a place of the caller; `make` puts a boxed object where it is told, if it returns 0.
    pub(super) unsafe fn create(
        &self,
        position: i32,
        handle: *mut i64,
        make: impl FnOnce(*mut *mut T) -> Result<i32, Failure>,
    ) -> Result<i32, Failure> {
        if handle.is_null() {
            return Err(Failure::argument(position, format!("{} is NULL", self.name)));
        }
        // SAFETY: by the caller's contract.
        unsafe { write(handle, 0) };
        let mut made = std::ptr::null_mut();
        let status = make(&raw mut made)?;
        if status == 0 {
            // SAFETY: a new object, which is ours alone.
            let made = Arc::from(unsafe { Box::from_raw(made) });
            let mut living = self.living();
            let number = living.next;
            living.next += 1;
            living.by_number.insert(number, made);
            // SAFETY: by the caller's contract.
            unsafe { write(handle, number) };
        }
        Ok(status)
    }

    /// The object of a handle, which lives on during the call even if another thread releases it.
    ///
    /// # Safety
    /// `handle` is NULL or a number of the caller.
    pub(super) unsafe fn find(&self, position: i32, handle: *const i64) -> Result<Arc<T>, Failure> {
        // SAFETY: by the caller's contract.
        let number = unsafe { read(position, self.name, handle)? };
        let found = self.living().by_number.get(&number).cloned();
        found.ok_or_else(|| self.unknown(position, number))
    }

    /// Releases the object of a handle, the first argument, which becomes 0. A handle of 0 is allowed.
    ///
    /// # Safety
    /// `handle` is NULL or a number of the caller.
    pub(super) unsafe fn free(&self, handle: *mut i64) -> Result<i32, Failure> {
        // SAFETY: by the caller's contract.
        let number = unsafe { read(1, self.name, handle)? };
        if number != 0 && self.living().by_number.remove(&number).is_none() {
            return Err(self.unknown(1, number));
        }
        // SAFETY: by the caller's contract.
        unsafe { write(handle, 0) };
        Ok(0)
    }

    fn unknown(&self, position: i32, number: i64) -> Failure {
        let Handles { name, what, .. } = self;
        Failure::argument(position, format!("{name} is {number}, there {what}; is it INTEGER*8?"))
    }
}
