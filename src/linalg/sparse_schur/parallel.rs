//! The parts of a factorisation on several threads, their working memory, and their progress.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use faer::dyn_stack::MemBuffer;

use super::factor_progress::{FactorProgress, Failure};
use super::lists::filled;
use super::structure::{PANEL, Structure};
use crate::linalg::dense;
use crate::linalg::watched::WORK;
pub use crate::workers::locked;
use crate::workers::{share, threads};

/// Rows of a block: products of it are fast, and its changes stay in the cache.
pub const ROWS: usize = 512;

/// The working memory of each thread, and the progress that they make together.
pub struct Parallel<'w> {
    /// That of the calling thread is the first one.
    pub workspaces: Vec<Mutex<Workspace>>,
    progress: &'w mut FactorProgress<'w>,
    /// Multiplications of all works, of those that are done, and of those that were when `progress` was asked last.
    all: f64,
    done: f64,
    asked: f64,
}

impl<'w> Parallel<'w> {
    /// Working memory for `all` multiplications.
    ///
    /// # Errors
    /// Not enough memory.
    pub fn new(
        structure: &Structure,
        progress: &'w mut FactorProgress<'w>,
        all: f64,
    ) -> Result<Self, Failure> {
        let workspaces = (0..threads()).map(|_| Workspace::new(structure).map(Mutex::new));
        let workspaces = workspaces.collect::<Result<_, _>>()?;
        Ok(Parallel { workspaces, progress, all: all.max(1.0), done: 0.0, asked: 0.0 })
    }

    /// Does the parts of a work of so many multiplications, each with the working memory of its thread.
    ///
    /// # Errors
    /// It was ended; parts may be missing.
    pub fn share(
        &mut self,
        parts: usize,
        operations: f64,
        work: &(dyn Fn(&mut Workspace, usize) + Sync),
    ) -> Result<(), Failure> {
        let Parallel { workspaces, progress, all, done, asked } = self;
        let (begun, mut answer) = (AtomicUsize::new(0), Ok(()));
        let mut go_on = || {
            let share = begun.load(Ordering::Relaxed) as f64 / parts as f64;
            let so_far = *done + share * operations;
            if so_far - *asked >= WORK as f64 {
                *asked = so_far;
                answer = progress((so_far / *all).min(1.0));
            }
            answer.is_ok()
        };
        let work = |thread: usize, part: usize| {
            begun.fetch_add(1, Ordering::Relaxed);
            work(&mut locked(&workspaces[thread]), part);
        };
        share(parts, operations, &work, &mut go_on);
        *done += operations;
        answer
    }
}

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
