//! The allocator of the library: the system's, and a reserve for what the system refuses.
//!
//! Stable Rust has no way to go on after a refused request: the process ends. So each call of the C interface
//! [holds](CallReserve) memory that it obtained before its work began, where a refusal is a status. What the system
//! then refuses is served from there, and noted in [`crate::shortage`]; the next check ends the call, which
//! returns everything. A call to which the system refuses nothing pays one comparison a request.
//!
//! Small calls hold a part of static memory. Nothing of the reserve is touched before it serves, but for
//! its first page. A piece that outlives its call keeps its block until it is freed.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::ptr::null_mut;
use std::sync::atomic::Ordering::Relaxed;

use super::blocks::{self, ALIGNMENT, Block, SERVED, SLOT, block_of, return_block};
use super::fork_lock::wait_at_forks;
use super::holes::Holes;
use crate::shortage;

/// Bytes that a call needs for sentences and small arrays, whatever it is given.
const ALWAYS: usize = 128 << 10;

/// Bytes up to which the memory of a thread's own cache is taken and set to zero: `calloc` of most releases of glibc
/// passes that cache by, and takes three times as long.
const CACHED: usize = 1 << 10;

thread_local! {
    /// The last block of the call that this thread is in.
    static LAST: Cell<*mut Block> = const { Cell::new(null_mut()) };
    /// Bytes that the call wants in reserve, and those that it holds.
    static WANTED: Cell<usize> = const { Cell::new(0) };
    static HELD: Cell<usize> = const { Cell::new(0) };
}

/// The memory that a call may fall back to; it ends with the outermost call of the thread.
pub(super) struct CallReserve {
    outermost: bool,
}

impl CallReserve {
    /// `None`: the system has no memory.
    #[inline(never)] // tests/c/helgrind.supp names it
    pub(super) fn begin() -> Option<Self> {
        wait_at_forks();
        let outermost = LAST.get().is_null();
        if outermost {
            shortage::forget();
            WANTED.set(ALWAYS);
            HELD.set(0);
            match blocks::take_slot() {
                // SAFETY: the memory of the slot is ours until its block is returned.
                Some(memory) => unsafe { hold(memory, SLOT, 0) },
                None if grow(SLOT) => {}
                None => return None,
            }
        }
        Some(CallReserve { outermost })
    }

    /// Gives back what a call holds that the host has left by a jump.
    pub(super) fn give_back_abandoned() {
        drop(CallReserve { outermost: true });
    }
}

impl Drop for CallReserve {
    #[inline(never)] // tests/c/helgrind.supp names it
    fn drop(&mut self) {
        if !self.outermost {
            return;
        }
        let mut block = LAST.replace(null_mut());
        shortage::forget();
        while !block.is_null() {
            // SAFETY: the blocks of this thread's call; those that have served are changed alone.
            unsafe {
                let before = (*block).before;
                if !(*block).has_served {
                    return_block(block);
                } else {
                    SERVED.alone(|first| {
                        (*block).open = false;
                        if (*block).holes.living() == 0 {
                            SERVED.release(first, block);
                        }
                    });
                }
                block = before;
            }
        }
    }
}

/// The call may need `bytes` more than what it asked for before. `false`: the system refuses them.
pub(super) fn want(bytes: u64) -> bool {
    let wanted = WANTED.get().saturating_add(bytes as usize);
    let held = HELD.get();
    // Arrays come one by one: not a block for each of them. One array of all `bytes` has a block to be in.
    let has_room = wanted <= held || grow((bytes as usize).max(held / 2));
    if has_room {
        WANTED.set(wanted);
    }
    has_room
}

fn grow(bytes: usize) -> bool {
    let Some(bytes) = bytes.checked_add(size_of::<Block>() + ALIGNMENT) else { return false };
    let Ok(layout) = Layout::from_size_align(bytes, ALIGNMENT) else { return false };
    // SAFETY: the size is not zero.
    let memory = unsafe { System.alloc(layout) };
    if memory.is_null() {
        return false;
    }
    // SAFETY: so many bytes of this alignment.
    unsafe { hold(memory, bytes, bytes) };
    true
}

/// Makes a block the last one of the call.
///
/// # Safety
/// `memory` has `size` bytes, aligned to [`ALIGNMENT`], for the block alone.
unsafe fn hold(memory: *mut u8, size: usize, bytes: usize) {
    let block = memory.cast::<Block>();
    let head = size_of::<Block>().next_multiple_of(ALIGNMENT);
    // SAFETY: by the caller's contract; every size here is larger than the head.
    unsafe {
        let holes = Holes::new(memory.add(head), size - head);
        block.write(Block {
            bytes,
            before: LAST.get(),
            next: null_mut(),
            has_served: false,
            open: true,
            holes,
        });
    }
    LAST.set(block);
    HELD.set(HELD.get() + size);
}

/// A piece of the reserve of this thread's call; NULL if it has none, or none that is large enough.
#[cold]
fn serve(layout: Layout) -> *mut u8 {
    let mut block = LAST.try_with(Cell::get).unwrap_or(null_mut());
    while !block.is_null() {
        // SAFETY: the blocks of this thread's call, which are changed alone.
        let piece = SERVED.alone(|first| unsafe {
            let piece = (*block).holes.take(layout);
            if !piece.is_null() && !(*block).has_served {
                (*block).has_served = true;
                (*block).next = first.replace(block);
                SERVED.count.fetch_add(1, Relaxed);
            }
            piece
        });
        if !piece.is_null() {
            shortage::note(layout.size());
            return piece;
        }
        // SAFETY: as above.
        block = unsafe { (*block).before };
    }
    null_mut()
}

/// `true` if a reserve has served the piece. A thread that got the piece from another one sees the count that was
/// raised when its block served.
fn is_served(piece: *mut u8) -> bool {
    SERVED.count.load(Relaxed) != 0 && SERVED.alone(|first| !block_of(first, piece).is_null())
}

/// # Safety
/// A piece of a reserve with its layout, not used any more.
#[cold]
unsafe fn give_back(piece: *mut u8, layout: Layout) {
    // SAFETY: the block is in the list; by the caller's contract.
    SERVED.alone(|first| unsafe {
        let block = block_of(first, piece);
        (*block).holes.give_back(piece, layout);
        if !(*block).open && (*block).holes.living() == 0 {
            SERVED.release(first, block);
        }
    });
}

/// The system's allocator with the reserve behind it.
struct Reserved;

// SAFETY: memory comes from the system's allocator, or it is a piece of a block that no other owner has; no function
// unwinds.
unsafe impl GlobalAlloc for Reserved {
    #[inline(never)]
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller's.
        let memory = unsafe { System.alloc(layout) };
        if memory.is_null() { serve(layout) } else { memory }
    }

    #[inline(never)]
    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        let is_cached = layout.size() <= CACHED;
        if !is_cached {
            // SAFETY: the caller's.
            let memory = unsafe { System.alloc_zeroed(layout) };
            if !memory.is_null() {
                return memory;
            }
        }
        // SAFETY: the caller's.
        let piece = if is_cached { unsafe { self.alloc(layout) } } else { serve(layout) };
        if !piece.is_null() {
            // SAFETY: it has so many bytes.
            unsafe { piece.write_bytes(0, layout.size()) };
        }
        piece
    }

    #[inline(never)]
    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        // SAFETY: by the caller's contract; the memory goes back to the allocator from which it came.
        unsafe {
            if is_served(memory) {
                give_back(memory, layout);
            } else {
                System.dealloc(memory, layout);
            }
        }
    }

    #[inline(never)]
    unsafe fn realloc(&self, memory: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        if !is_served(memory) {
            // SAFETY: the caller's.
            let moved = unsafe { System.realloc(memory, layout, size) };
            if !moved.is_null() {
                return moved;
            }
        }
        // SAFETY: the caller's size is valid with this alignment; the two do not overlap.
        unsafe {
            let new = self.alloc(Layout::from_size_align_unchecked(size, layout.align()));
            if !new.is_null() {
                new.copy_from_nonoverlapping(memory, layout.size().min(size));
                self.dealloc(memory, layout);
            }
            new
        }
    }
}

#[global_allocator]
static RESERVED: Reserved = Reserved;
