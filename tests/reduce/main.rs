//! From a host's matrices to the relation between displacements and forces, and back.

#[path = "../bench/bar.rs"]
#[allow(dead_code)] // Each test uses a part.
mod bar;
#[path = "../common/mod.rs"]
mod common;
#[path = "../common/rows.rs"]
#[allow(dead_code)] // Each test uses a part.
mod rows;

mod balanced_loads;
mod constrained;
mod equations;
mod frames;
mod free_balls;
mod general_rows;
mod motion_words;
mod reductions;
mod rigid_bodies;
mod rigid_bodies_on_springs;
mod soft_springs;
mod sparse_condensation;
mod sparse_contact;
mod sparse_messages;
mod sparse_order;
mod sparse_pairs;
mod sparse_supports;
mod stiff_on_soft;
mod two_body;
mod whole_models;
