//! Full space, and hosts that multiply and solve by themselves.

#[path = "../common/mod.rs"]
mod common;
#[path = "../common/surfaces.rs"]
#[allow(dead_code)] // Each test uses a part.
mod surfaces;

mod far_loads;
mod full_space;
mod full_space_bodies;
mod full_space_escape;
mod full_space_floating;
mod full_space_hard;
mod full_space_random;
mod parts;
mod preconditioned;
mod probes;
mod products;
mod singular_hosts;
