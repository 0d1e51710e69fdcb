//! The C interface: the only room with `unsafe`.
//!
//! Every entry runs inside [`guard::call`], which keeps the host's floating-point environment and
//! stops panics; [`args`] turns pointers into slices after checking them; nothing is written before
//! every argument has been accepted.

// What pointers must be stands at the parameters, where a C programmer reads it; plain arrays make
// long parameter lists.
#![allow(clippy::missing_safety_doc, clippy::too_many_arguments)]

mod args;
mod cases;
mod check;
mod flat;
mod fortran;
mod guard;
mod host;
mod lcp;
mod load;
mod model;
mod report;
mod save;
mod settings;
#[cfg(all(target_os = "linux", target_env = "gnu"))]
mod static_link;
mod status;
