//! Columns of `J⁻¹ (K / k - 1)` on the pieces that were factorised, kept for the changes of pairs.
//!
//! A change needs one or two of them for each pair. Many right-hand sides together take a tenth of the time that they
//! take one after the other, because the factor is read once.

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
    pub fn none(components: usize) -> Self {
        Columns { place: vec![None; components], values: Vec::new() }
    }

    /// The column of a component.
    pub fn of(&self, component: usize) -> Option<&[f64]> {
        let size = self.place.len();
        self.place[component].map(|place| &self.values[size * place..size * (place + 1)])
    }

    /// The components of these parts whose columns are not known, each once.
    pub fn lacking(&self, parts: impl Iterator<Item = (usize, f64)>) -> Vec<usize> {
        let mut components: Vec<usize> =
            parts.map(|(i, _)| i).filter(|&i| self.place[i].is_none()).collect();
        components.dedup();
        components
    }

    /// Forgets all columns if there is no room for so many more; true if none was forgotten.
    pub fn make_room(&mut self, more: usize) -> bool {
        let known = self.values.len() / self.place.len().max(1);
        let has_room = known == 0 || (known + more) as f64 <= KEPT * self.place.len() as f64;
        if !has_room {
            self.place.fill(None);
            self.values.clear();
        }
        has_room
    }

    /// Takes in the columns of `components`.
    pub fn add(&mut self, components: &[usize], columns: &[f64]) {
        for (&component, column) in
            components.iter().zip(columns.chunks_exact(self.place.len().max(1)))
        {
            self.place[component] = Some(self.values.len() / self.place.len());
            self.values.extend_from_slice(column);
        }
    }
}
