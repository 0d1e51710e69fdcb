//! A Rust program that depends on the crate, and has an allocator and a panic hook of its own.

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use signorini::{ContactData, ContactProblem, FrictionLaw, Monitor, Settings, Status, solve};

struct Counting;

static REQUESTS: AtomicUsize = AtomicUsize::new(0);
static PANICS: AtomicUsize = AtomicUsize::new(0);

// SAFETY: the system's allocator does the work.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        REQUESTS.fetch_add(1, Relaxed);
        // SAFETY: the caller's.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        // SAFETY: the caller's.
        unsafe { System.dealloc(memory, layout) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

unsafe extern "C" {
    fn signorini_settings_default(settings: *mut u8, struct_size: u32) -> i32;
}

fn main() {
    // A hook with a place in memory, by which it is known again.
    let seen = Box::new([0_u8; 32]);
    let hook = Box::new(move |_: &std::panic::PanicHookInfo<'_>| {
        std::hint::black_box(&seen);
        PANICS.fetch_add(1, Relaxed);
    });
    let address = std::ptr::from_ref(&*hook).cast::<u8>().addr();
    std::panic::set_hook(hook);

    let before = REQUESTS.load(Relaxed);
    // One pair in the plane, pressed by 1 and pulled by .1: it sticks.
    let problem = ContactProblem::new(ContactData {
        dim: 2,
        pairs: 1,
        stiffness: &[1.0, 0.0, 0.0, 1.0],
        ld: 2,
        load: &[1.0, 0.1],
        gap: &[0.0],
        law: FrictionLaw::Coulomb(&[0.5]),
        reference_slip: None,
    });
    let problem = problem.expect("a valid problem");
    let settings = Settings::default();
    let found = solve(&problem, &settings, None, &mut Monitor::new(&settings, None));
    assert_eq!(found.expect("valid settings").status, Status::Solved);
    assert!(REQUESTS.load(Relaxed) > before, "the program's allocator was not asked");

    // An entry of the C interface, which refuses its first argument.
    // SAFETY: NULL is refused.
    let code = unsafe { signorini_settings_default(std::ptr::null_mut(), 0) };
    assert_eq!(code, -1);
    assert!(std::panic::catch_unwind(|| panic!("the program's own")).is_err());
    assert_eq!(PANICS.load(Relaxed), 1, "the program's hook was not called");
    let hook = std::panic::take_hook();
    assert_eq!(std::ptr::from_ref(&*hook).cast::<u8>().addr(), address, "another hook was set");
}
