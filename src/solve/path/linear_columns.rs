//! Columns of `J⁻¹ (K / k - 1)` on the pieces that were factorised, kept for the changes of pairs.
//!
//! A change needs one or two of them. Where the factor does not stay in a cache, many right-hand sides together take
//! a tenth of the time that they take one after the other, because the factor is read once. There columns are made in
//! blocks: with those of a change those of the pairs whose boundaries are the next ones on the way. Most of these change
//! before the system is factorised again, many of them more than once.

/// Columns that are made together.
pub const BLOCK: usize = 48;

/// Up to so many components the factor stays in a cache, and no columns are kept.
const IN_CACHE: usize = 400;

/// Most columns that are kept, as a part of all: they take memory.
const KEPT: f64 = 0.25;

/// The columns that are known.
pub struct Columns {
    /// Where the column of each component is.
    place: Vec<Option<usize>>,
    /// The columns, contiguous.
    values: Vec<f64>,
}

impl Columns {
    /// None yet, of so many components.
    pub fn none(size: usize) -> Self {
        Columns { place: vec![None; size], values: Vec::new() }
    }

    /// The column of a component.
    pub fn of(&self, component: usize) -> Option<&[f64]> {
        let size = self.place.len();
        self.place[component].map(|place| &self.values[size * place..size * (place + 1)])
    }

    /// Whether columns are kept.
    pub fn are_kept(&self) -> bool {
        self.place.len() > IN_CACHE
    }

    /// Forgets all columns if there is no room for a further block.
    pub fn make_room(&mut self) {
        let size = self.place.len();
        let known = self.values.len() / size;
        if known > 0 && (known + BLOCK) as f64 > KEPT * size as f64 {
            self.place.fill(None);
            self.values.clear();
        }
    }

    /// Takes in the columns of `components`.
    pub fn add(&mut self, components: &[usize], columns: &[f64]) {
        let size = self.place.len();
        for (&component, column) in components.iter().zip(columns.chunks_exact(size)) {
            self.place[component] = Some(self.values.len() / size);
            self.values.extend_from_slice(column);
        }
    }
}
