//! The C interface: the only room with `unsafe`.
//!
//! Every entry runs inside [`guard::call`], which keeps the host's floating-point environment and
//! stops panics. The [`args::Arrays`] of a call stand for the contract of the header: they turn pointers
//! into slices, structures and outputs after checking them. Nothing is written before every argument has
//! been accepted.

// Pointer requirements are documented for each @param, where a C programmer reads them. Plain
// arrays make long parameter lists. Arguments and fields have the names of the mechanics, which the
// header shows.
#![allow(clippy::missing_safety_doc, clippy::too_many_arguments, non_snake_case)]

#[cfg(c_library)]
mod allocator;
mod args;
#[cfg(c_library)]
mod blocks;
mod case_arguments;
mod certify;
mod fork_lock;
mod fortran;
mod guard;
mod handle;
#[cfg(c_library)]
mod holes;
mod law;
mod mesh;
mod model;
mod model_new;
mod model_solve;
mod numbers;
mod operator;
mod outputs;
mod pairs;
mod place;
mod problem_file;
mod report;
mod reserve;
mod settings;
mod solve;
mod sparse;
#[cfg(all(target_os = "linux", target_env = "gnu"))]
mod static_link;
mod status;
mod structures;
mod surface;
mod surface_fields;
mod surface_join;
mod surface_new;
mod surface_settings;
mod surface_view;
mod surroundings;
mod threads;
