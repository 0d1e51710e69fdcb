//! Blocks of memory that calls hold in reserve, and the list of those that have served.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::UnsafeCell;
use std::ptr::null_mut;
use std::sync::atomic::Ordering::{Acquire, Relaxed, Release};
use std::sync::atomic::{AtomicBool, AtomicUsize};

use super::fork_lock::BLOCKS;
use super::holes::Holes;

/// Static blocks: as many threads at once call without a request for their first reserve.
const SLOTS: usize = 8;

/// Size of a static block: sentences, small arrays, and all of a problem of some twenty pairs.
pub(super) const SLOT: usize = 512 << 10;

pub(super) const ALIGNMENT: usize = 64;

#[repr(C, align(64))]
struct Slot {
    memory: UnsafeCell<[u8; SLOT]>,
    taken: AtomicBool,
}

// SAFETY: the memory is used by who has set `taken`, until it is reset.
unsafe impl Sync for Slot {}

static STATIC: [Slot; SLOTS] =
    [const { Slot { memory: UnsafeCell::new([0; SLOT]), taken: AtomicBool::new(false) } }; SLOTS];

/// The memory of a static block that no call holds, aligned to [`ALIGNMENT`], if there is one.
pub(super) fn take_slot() -> Option<*mut u8> {
    let taken = |slot: &&Slot| !slot.taken.swap(true, Acquire);
    STATIC.iter().find(taken).map(|slot| slot.memory.get().cast())
}

/// The beginning of a block of a reserve.
pub(super) struct Block {
    /// Bytes from the system; 0: a static block.
    pub(super) bytes: usize,
    /// The block that the same call obtained before.
    pub(super) before: *mut Block,
    /// The next block that has served. Another thread changes it when it frees the last piece of that one.
    pub(super) next: *mut Block,
    /// `true` once a piece of it was served. The thread of the call alone changes it.
    pub(super) has_served: bool,
    /// `true` while the call goes on.
    pub(super) open: bool,
    pub(super) holes: Holes,
}

/// The blocks that have served, of all threads: whoever frees a piece finds its block here.
pub(super) struct Served {
    pub(super) count: AtomicUsize,
    first: UnsafeCell<*mut Block>,
}

// SAFETY: `first`, and the blocks from there on, are used under the lock of the blocks.
unsafe impl Sync for Served {}

pub(super) static SERVED: Served =
    Served { count: AtomicUsize::new(0), first: UnsafeCell::new(null_mut()) };

impl Served {
    /// Runs `work` alone.
    pub(super) fn alone<T>(&self, work: impl FnOnce(*mut *mut Block) -> T) -> T {
        BLOCKS.alone(|| work(self.first.get()))
    }

    /// Takes a block out of the list, and returns it to where it came from.
    ///
    /// # Safety
    /// No other thread changes the list; the block is in it, and no piece of it is in use.
    pub(super) unsafe fn release(&self, first: *mut *mut Block, block: *mut Block) {
        let mut link = first;
        // SAFETY: by the caller's contract.
        unsafe {
            while *link != block {
                link = &raw mut (**link).next;
            }
            *link = (*block).next;
            self.count.fetch_sub(1, Relaxed);
            return_block(block);
        }
    }
}

/// # Safety
/// A block that nobody uses any more.
pub(super) unsafe fn return_block(block: *mut Block) {
    // SAFETY: by the caller's contract; the layout is the one of `grow`.
    unsafe {
        match (*block).bytes {
            0 => {
                let slot = STATIC.iter().find(|slot| slot.memory.get().cast() == block);
                slot.inspect(|slot| slot.taken.store(false, Release));
            }
            bytes => {
                let layout = Layout::from_size_align_unchecked(bytes, ALIGNMENT);
                System.dealloc(block.cast(), layout);
            }
        }
    }
}

/// The block that has served the piece, or NULL; to be asked alone.
pub(super) fn block_of(first: *mut *mut Block, piece: *mut u8) -> *mut Block {
    // SAFETY: alone; every block of the list is there until it is taken out.
    unsafe {
        let mut block = *first;
        while !block.is_null() && !(*block).holes.has(piece) {
            block = (*block).next;
        }
        block
    }
}
