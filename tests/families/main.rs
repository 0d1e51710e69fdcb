//! Families of random problems and closed forms, which take longer than the other tests.

#[path = "../bench/bar.rs"]
#[allow(dead_code)] // Each test uses a part.
mod bar;
#[path = "../common/mod.rs"]
mod common;
#[path = "../common/rows.rs"]
#[allow(dead_code)] // Each test uses a part.
mod rows;
#[path = "../common/wall.rs"]
mod wall;

mod blocks_3d;
mod contact_alone;
mod flexible;
mod floating_3d;
mod forms;
mod free_bodies;
mod half_space;
mod judged;
mod never_worse;
mod properties;
mod random_3d;
mod relaxation;
mod rolling;
