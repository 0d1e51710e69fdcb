//! Tools that the tests share: random problems, a dense solver of their own, and enumeration of states.

#![allow(dead_code)] // Every test file uses a part.

pub mod all_states;
pub mod bare;
pub mod beam;
pub mod blocks;
pub mod brick;
pub mod brick20;
pub mod contact_alone;
pub mod dense;
pub mod edges;
pub mod ellipses;
pub mod escape;
pub mod exact;
pub mod flexible;
pub mod folder;
pub mod half_space;
pub mod judge;
pub mod measures;
pub mod mesh;
pub mod oracle;
pub mod plane_families;
pub mod problems;
pub mod proofs;
pub mod quad;
pub mod rigid_statics;
pub mod rolling;
pub mod solids;
pub mod stack;
pub mod verdict;
pub mod wavy;
