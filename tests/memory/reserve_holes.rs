//! The pieces of a reserve: a file of the library by itself, since nothing outside can ask for a piece.

use std::alloc::Layout;

use holes::Holes;

#[path = "../../src/ffi/holes.rs"]
mod holes;

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
