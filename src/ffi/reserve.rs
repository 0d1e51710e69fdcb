//! Memory that a call holds in reserve, where the library has its own allocator.

#[cfg(c_library)]
pub(super) use super::allocator::{Held, want};

/// Nothing is held: a refused request ends the process, as everywhere in Rust.
#[cfg(not(c_library))]
pub(super) struct Held;

#[cfg(not(c_library))]
impl Held {
    pub(super) fn begin() -> Option<Self> {
        Some(Held)
    }
}

#[cfg(not(c_library))]
pub(super) fn want(_: usize) -> bool {
    true
}
