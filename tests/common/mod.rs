//! What the tests share: random problems, a dense solver of their own, and enumeration of states.

#![allow(dead_code)] // Every test file uses a part.

pub mod bare;
pub mod brick;
pub mod dense;
pub mod folder;
pub mod half_space;
pub mod measures;
pub mod mesh;
pub mod oracle;
pub mod problems;
pub mod rigid_statics;
pub mod stack;
pub mod verdict;
