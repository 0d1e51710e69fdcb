//! Lists of numbers in one memory, such as the neighbours of the vertices of a graph; and memory that may be refused.

use std::ops::Range;

use crate::linalg::sparse_matrix::OutOfMemory;
use crate::shortage;

/// Lists, one after the other, and where they begin. Those of a graph are the neighbours of each vertex, ascending.
#[derive(Clone)]
pub struct Lists {
    pub start: Vec<usize>,
    pub entries: Vec<usize>,
}

impl Default for Lists {
    fn default() -> Self {
        Lists { start: vec![0], entries: Vec::new() }
    }
}

impl Lists {
    /// No list, with room for so many lists and entries.
    pub fn reserved(count: usize, entries: usize) -> Result<Self, OutOfMemory> {
        let mut lists = Lists { start: reserved(count + 1)?, entries: reserved(entries)? };
        lists.start.push(0);
        Ok(lists)
    }

    /// Number of lists.
    pub fn count(&self) -> usize {
        self.start.len() - 1
    }

    /// The places of the entries of a list.
    pub fn range(&self, k: usize) -> Range<usize> {
        self.start[k]..self.start[k + 1]
    }

    /// The entries of a list.
    pub fn of(&self, k: usize) -> impl Iterator<Item = usize> {
        self.entries[self.range(k)].iter().copied()
    }

    /// Adds a list, and shows it.
    pub fn push(&mut self, list: impl IntoIterator<Item = usize>) -> &mut [usize] {
        let begin = self.entries.len();
        self.entries.extend(list);
        self.start.push(self.entries.len());
        &mut self.entries[begin..]
    }
}

impl<L: IntoIterator<Item = usize>> FromIterator<L> for Lists {
    fn from_iter<I: IntoIterator<Item = L>>(all: I) -> Self {
        let mut lists = Lists::default();
        all.into_iter().for_each(|list| _ = lists.push(list));
        lists
    }
}

/// An empty vector with room.
pub fn reserved<T>(length: usize) -> Result<Vec<T>, OutOfMemory> {
    let mut vector = Vec::new();
    vector.try_reserve_exact(length).map_err(|_| OutOfMemory)?;
    // The reserve of a call is not for arrays that can be refused.
    if shortage::is_noted() { Err(OutOfMemory) } else { Ok(vector) }
}

/// A vector of equal entries.
pub fn filled<T: Clone>(length: usize, value: T) -> Result<Vec<T>, OutOfMemory> {
    let mut vector = reserved(length)?;
    vector.resize(length, value);
    Ok(vector)
}
