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

#[cfg(test)]
mod tests {
    use super::*;

    #[repr(align(64))]
    struct Memory([u8; 4096]);

    fn layout(size: usize, align: usize) -> Layout {
        Layout::from_size_align(size, align).unwrap()
    }

    #[test]
    fn pieces_do_not_overlap_and_the_block_becomes_whole_again() {
        let mut memory = Box::new(Memory([0; 4096]));
        // SAFETY: the block lives as long as its holes.
        let mut holes = unsafe { Holes::new(memory.0.as_mut_ptr(), 4096) };
        let mut random = 1_u32;
        let mut next = |most: u32| {
            random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            ((random >> 16) % most) as usize
        };
        let mut living: Vec<(*mut u8, Layout)> = Vec::new();
        for _ in 0..10_000 {
            if next(2) == 0 || living.is_empty() {
                let layout = layout(1 + next(300), 1 << next(8));
                let piece = holes.take(layout);
                if piece.is_null() {
                    continue;
                }
                assert_eq!(piece.addr() % layout.align(), 0);
                assert!(holes.has(piece) && holes.has(piece.wrapping_add(layout.size() - 1)));
                for (other, of) in &living {
                    let apart = piece.addr() + layout.size() <= other.addr()
                        || other.addr() + of.size() <= piece.addr();
                    assert!(apart);
                }
                living.push((piece, layout));
            } else {
                let (piece, layout) = living.swap_remove(next(living.len() as u32));
                // SAFETY: it came from `take` with this layout.
                unsafe { holes.give_back(piece, layout) };
            }
        }
        assert_eq!(holes.living(), living.len());
        for (piece, layout) in living {
            // SAFETY: as above.
            unsafe { holes.give_back(piece, layout) };
        }
        let whole = holes.take(layout(4096, 64));
        assert!(!whole.is_null());
        assert!(holes.take(layout(1, 1)).is_null());
        // SAFETY: as above.
        unsafe { holes.give_back(whole, layout(4096, 64)) };
        assert_eq!(holes.living(), 0);
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        let mut memory = Box::new(Memory([0; 4096]));
        // SAFETY: the block lives as long as its holes.
        let mut holes = unsafe { Holes::new(memory.0.as_mut_ptr(), 4096) };
        assert!(holes.take(layout(4097, 1)).is_null());
        assert!(holes.take(layout(isize::MAX as usize - 64, 1)).is_null());
        assert!(!holes.take(layout(4096, 1)).is_null());
    }
}
