//! Pairs from surfaces.

#[path = "../common/mod.rs"]
mod common;
#[path = "../common/surfaces.rs"]
#[allow(dead_code)] // Each test uses a part.
mod surfaces;

mod adjust;
mod bodies;
mod both_ways;
mod choices;
mod corners;
mod curved_edges;
mod facets;
mod fields;
mod geometry;
mod hertz;
mod linalg;
mod models;
mod overlap;
mod parts_of_faces;
mod patch;
mod penetration;
mod periods;
mod press_fit;
mod quadrilaterals;
mod reach;
mod resultants;
mod rounded_mids;
mod rows;
mod scatter;
mod sectors;
mod small_patches;
mod steps;
mod supports;
mod symmetry;
mod tangents;
mod ties;
mod ties_of_choice;
mod true_shapes;
mod turns;
mod whole_skins;
mod zones;
