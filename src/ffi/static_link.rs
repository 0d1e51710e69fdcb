//! Functions of the C library that a statically linked Fortran program needs.
//!
//! libgfortran refers to the functions of threads weakly, and calls them where one of them is
//! there. In a program linked with `-static` Rust's standard library brings that one, but weak
//! references bring none of the others, so that the first lock calls address zero. The strong
//! references below bring them.

use libc::{c_int, c_void, pthread_cond_t, pthread_key_t, pthread_mutex_t, pthread_t};

type OnMutex = unsafe extern "C" fn(*mut pthread_mutex_t) -> c_int;
type OnCondition = unsafe extern "C" fn(*mut pthread_cond_t) -> c_int;

#[used]
static MUTEXES: [OnMutex; 4] = [
    libc::pthread_mutex_lock,
    libc::pthread_mutex_trylock,
    libc::pthread_mutex_unlock,
    libc::pthread_mutex_destroy,
];

#[used]
static CONDITIONS: [OnCondition; 2] = [libc::pthread_cond_broadcast, libc::pthread_cond_destroy];

#[used]
static WAIT: unsafe extern "C" fn(*mut pthread_cond_t, *mut pthread_mutex_t) -> c_int =
    libc::pthread_cond_wait;

#[used]
static JOIN: unsafe extern "C" fn(pthread_t, *mut *mut c_void) -> c_int = libc::pthread_join;

#[used]
static SELF: unsafe extern "C" fn() -> pthread_t = libc::pthread_self;

#[used]
static VALUES: (
    unsafe extern "C" fn(pthread_key_t) -> *mut c_void,
    unsafe extern "C" fn(pthread_key_t, *const c_void) -> c_int,
    unsafe extern "C" fn(pthread_key_t) -> c_int,
) = (libc::pthread_getspecific, libc::pthread_setspecific, libc::pthread_key_delete);

#[used]
static BEGINNINGS: (
    unsafe extern "C" fn(*mut pthread_mutex_t, *const libc::pthread_mutexattr_t) -> c_int,
    unsafe extern "C" fn(*mut pthread_cond_t, *const libc::pthread_condattr_t) -> c_int,
) = (libc::pthread_mutex_init, libc::pthread_cond_init);

/// In the same object as what every entry calls, so that it is linked.
pub(super) fn keep() {
    std::hint::black_box(&raw const MUTEXES);
}
