//! The C interface: the only room with `unsafe`.
//!
//! Every entry runs inside [`guard::call`], which keeps the host's floating-point environment and
//! stops panics; [`args`] turns pointers into slices after checking them; nothing is written before
//! every argument has been accepted.

mod args;
mod flat;
mod guard;
mod lcp;
mod status;
mod types;
