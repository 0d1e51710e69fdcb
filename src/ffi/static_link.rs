//! Functions of the C library that a statically linked Fortran program needs.
//!
//! libgfortran refers to the functions of threads weakly, and calls them where one of them is
//! there. In a program linked with `-static` Rust's standard library brings that one, but weak
//! references bring none of the others, so that the first lock calls address zero. The strong
//! references below bring them.

/// The address of a function of any type.
struct Address(#[allow(dead_code)] *const ());

// SAFETY: nobody follows it.
unsafe impl Sync for Address {}

#[used]
static FUNCTIONS: [Address; 14] = [
    Address(libc::pthread_mutex_init as *const ()),
    Address(libc::pthread_mutex_lock as *const ()),
    Address(libc::pthread_mutex_trylock as *const ()),
    Address(libc::pthread_mutex_unlock as *const ()),
    Address(libc::pthread_mutex_destroy as *const ()),
    Address(libc::pthread_cond_init as *const ()),
    Address(libc::pthread_cond_wait as *const ()),
    Address(libc::pthread_cond_broadcast as *const ()),
    Address(libc::pthread_cond_destroy as *const ()),
    Address(libc::pthread_getspecific as *const ()),
    Address(libc::pthread_setspecific as *const ()),
    Address(libc::pthread_key_delete as *const ()),
    Address(libc::pthread_join as *const ()),
    Address(libc::pthread_self as *const ()),
];

/// In the same object as what every entry calls, so that it is linked.
pub(super) fn keep() {
    std::hint::black_box(&raw const FUNCTIONS);
}
