//! What a call holds in reserve, where the library has its own allocator.

#[cfg(feature = "c-allocator")]
pub(super) use super::allocator::{Held, want};

/// Nothing is held: a refused request ends the process, as everywhere in Rust.
#[cfg(not(feature = "c-allocator"))]
pub(super) struct Held;

#[cfg(not(feature = "c-allocator"))]
impl Held {
    pub(super) fn begin() -> Option<Self> {
        Some(Held)
    }
}

#[cfg(not(feature = "c-allocator"))]
pub(super) fn want(_: usize) -> bool {
    true
}
