//! Memory that a call holds in reserve, where the library has its own allocator.

#[cfg(c_library)]
pub(super) use super::allocator::{CallReserve, want};

/// Nothing is held: a refused request ends the process, as everywhere in Rust.
#[cfg(not(c_library))]
pub(super) struct CallReserve;

#[cfg(not(c_library))]
impl CallReserve {
    pub(super) fn begin() -> Option<Self> {
        Some(CallReserve)
    }

    pub(super) fn give_back_abandoned() {}
}

#[cfg(not(c_library))]
pub(super) fn want(_: u64) -> bool {
    true
}
