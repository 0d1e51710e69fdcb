//! Pieces of one block of memory, first fit.
//!
//! Free memory is a list of holes in the order of their addresses; neighbours are joined. A piece needs no
//! header, since Rust tells its size when it is freed.

use std::alloc::Layout;
use std::ptr::null_mut;

/// Sizes are multiples of it: a hole must hold its own description.
const GRAIN: usize = 16;
const _: () = assert!(size_of::<Hole>() <= GRAIN);

struct Hole {
    size: usize,
    next: *mut Hole,
}

/// A block and its holes.
pub(super) struct Holes {
    begin: *mut u8,
    size: usize,
    first: *mut Hole,
    /// Pieces that are not free.
    living: usize,
}

impl Holes {
    /// One hole.
    ///
    /// # Safety
    /// `begin`, a multiple of 16, has `size` bytes, which belong to nobody else while the holes live.
    pub(super) unsafe fn new(begin: *mut u8, size: usize) -> Self {
        let size = size & !(GRAIN - 1);
        let first = begin.cast::<Hole>();
        // SAFETY: by the caller's contract; a block is larger than a hole.
        unsafe { first.write(Hole { size, next: null_mut() }) };
        Holes { begin, size, first, living: 0 }
    }

    /// Number of pieces that are not free.
    pub(super) fn living(&self) -> usize {
        self.living
    }

    /// `true` if the block has this address.
    pub(super) fn has(&self, piece: *const u8) -> bool {
        piece.addr().wrapping_sub(self.begin.addr()) < self.size
    }

    /// A piece; NULL if no hole is large enough.
    pub(super) fn take(&mut self, layout: Layout) -> *mut u8 {
        let Some(size) = rounded(layout) else { return null_mut() };
        let mut link = &raw mut self.first;
        // SAFETY: `link` is `self.first` or the link of a hole; holes are free memory of the block, which
        // nobody but `self` changes.
        unsafe {
            while !(*link).is_null() {
                let hole = *link;
                let Hole { size: room, next } = hole.read();
                let skipped = hole.addr().next_multiple_of(layout.align()) - hole.addr();
                let Some(rest) = room.checked_sub(size).and_then(|rest| rest.checked_sub(skipped))
                else {
                    link = &raw mut (*hole).next;
                    continue;
                };
                let piece = hole.cast::<u8>().add(skipped);
                let after = if rest > 0 { put(piece.add(size), rest, next) } else { next };
                *link = if skipped > 0 { put(hole.cast(), skipped, after) } else { after };
                self.living += 1;
                return piece;
            }
        }
        null_mut()
    }

    /// Takes a piece back.
    ///
    /// # Safety
    /// The piece came from [`Self::take`] with this layout, and is not used any more.
    pub(super) unsafe fn give_back(&mut self, piece: *mut u8, layout: Layout) {
        let Some(mut size) = rounded(layout) else { return };
        let (mut below, mut above): (*mut Hole, _) = (null_mut(), self.first);
        // SAFETY: as above; the piece is free memory from here on.
        unsafe {
            while !above.is_null() && above.addr() < piece.addr() {
                below = above;
                above = (*above).next;
            }
            if !above.is_null() && piece.addr() + size == above.addr() {
                size += (*above).size;
                above = (*above).next;
            }
            if !below.is_null() && below.addr() + (*below).size == piece.addr() {
                (*below).size += size;
                (*below).next = above;
            } else {
                let hole = put(piece, size, above);
                *(if below.is_null() { &raw mut self.first } else { &raw mut (*below).next }) =
                    hole;
            }
        }
        self.living -= 1;
    }
}

fn rounded(layout: Layout) -> Option<usize> {
    layout.size().max(1).checked_next_multiple_of(GRAIN)
}

/// # Safety
/// The `size` bytes are free memory of the block, aligned as a hole.
unsafe fn put(place: *mut u8, size: usize, next: *mut Hole) -> *mut Hole {
    let hole = place.cast::<Hole>();
    // SAFETY: by the caller's contract.
    unsafe { hole.write(Hole { size, next }) };
    hole
}
