//! Working memory of a thread.

use faer::dyn_stack::MemBuffer;

use super::failure::Failure;
use super::graph::filled;
use super::structure::{PANEL, Structure};
use crate::linalg::dense;

/// Rows of a block: products of it are fast, and its changes stay in the cache.
pub const ROWS: usize = 512;

/// Working memory for any panel.
pub struct Workspace {
    /// The place of each row in the panel that is made.
    pub place: Vec<usize>,
    /// A product that is then subtracted.
    pub product: Vec<f64>,
    pub memory: MemBuffer,
}

impl Workspace {
    /// Working memory for the panels of a factor.
    ///
    /// # Errors
    /// Not enough memory.
    pub fn new(structure: &Structure) -> Result<Self, Failure> {
        Ok(Workspace {
            place: filled(structure.size, 0)?,
            product: filled(largest_product(structure), 0.0)?,
            memory: MemBuffer::try_new(dense::scratch(widest(structure)))
                .map_err(|_| Failure::OutOfMemory)?,
        })
    }

    /// Its bytes, but for those of the factorisation of a diagonal block.
    pub fn bytes(structure: &Structure) -> usize {
        structure.size * size_of::<usize>() + largest_product(structure) * size_of::<f64>()
    }
}

fn widest(structure: &Structure) -> usize {
    (0..structure.panels()).map(|s| structure.columns(s).len()).max().unwrap_or(0)
}

/// Entries of the largest product of blocks.
fn largest_product(structure: &Structure) -> usize {
    let rows = (0..structure.panels()).map(|s| structure.rows(s).len()).max().unwrap_or(0);
    let columns = widest(structure).max(structure.kept().min(PANEL));
    columns * rows.max(columns).min(ROWS)
}
