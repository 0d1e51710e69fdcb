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

macro_rules! addresses {
    ($($function:ident)*) => { [$(Address(libc::$function as *const ())),*] };
}

#[used]
static FUNCTIONS: [Address; 14] = addresses! {
    pthread_mutex_init pthread_mutex_lock pthread_mutex_trylock pthread_mutex_unlock pthread_mutex_destroy
    pthread_cond_init pthread_cond_wait pthread_cond_broadcast pthread_cond_destroy
    pthread_getspecific pthread_setspecific pthread_key_delete pthread_join pthread_self
};

/// In the same object as what every entry calls, so that it is linked.
pub(super) fn keep() {
    std::hint::black_box(&raw const FUNCTIONS);
}
