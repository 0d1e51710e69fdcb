//! The methods on condensed problems with friction, one by one and as the default.

#[path = "../bench/bar.rs"]
#[allow(dead_code)] // Each test uses a part.
mod bar;
#[path = "../common/mod.rs"]
mod common;

mod auto;
mod auto_floating;
mod bars;
mod bricks_3d;
mod cancelled;
mod direct_methods;
mod ellipses;
mod enumeration;
mod escape_motion;
mod far_gaps;
mod far_slips;
mod floating;
mod free_motion;
mod idle_motions;
mod ill_conditioned;
mod invariance;
mod invariance_3d;
mod klarbring;
mod newton_3d;
mod paper_variables;
mod path_2d;
mod path_3d;
mod peers_failures;
