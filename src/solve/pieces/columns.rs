//! Columns of `J⁻¹ (K / k - 1)` on the pieces that were factorised, kept for the changes of pairs.
//!
//! A change needs one or two of them for each pair. Many right-hand sides together take a tenth of the time that they
//! take one after the other, because the factor is read once.

use super::term::Term;
use crate::linalg::watched::{BLOCK, GoesOn};

/// Most columns that are kept, as a part of all: they take memory.
const KEPT: f64 = 0.25;

/// The columns that are known.
pub struct Columns {
    /// The components whose columns are known, in their order.
    components: Vec<usize>,
    /// Where the column of each component is.
    place: Vec<Option<usize>>,
    /// The columns, contiguous.
    values: Vec<f64>,
}

impl Columns {
    /// None yet, of so many components.
    pub fn none(components: usize) -> Self {
        Columns { components: Vec::new(), place: vec![None; components], values: Vec::new() }
    }

    /// The components whose columns are known, in the order of [`Self::values`].
    pub fn components(&self) -> &[usize] {
        &self.components
    }

    /// The known columns, contiguous.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The known columns of which the column of a term is made, each with its part.
    pub fn parts(&self, term: &Term) -> impl Iterator<Item = (usize, f64)> {
        term.parts().filter_map(|(i, u)| Some((self.place[i]?, u)))
    }

    /// The components of these parts whose columns are not known, each once.
    pub fn lacking(&self, parts: impl Iterator<Item = (usize, f64)>) -> Vec<usize> {
        let mut components: Vec<usize> =
            parts.map(|(i, _)| i).filter(|&i| self.place[i].is_none()).collect();
        components.dedup();
        components
    }

    /// Makes the columns that terms need, at most so many, so far as they are not known; `None` where `goes_on` says no.
    pub fn prepare(
        &mut self,
        terms: &[Term],
        most: usize,
        goes_on: GoesOn<'_>,
        mut made: impl FnMut(&[usize]) -> Vec<f64>,
    ) -> Option<()> {
        let lacking = |columns: &Self| {
            let mut components = columns.lacking(terms.iter().flat_map(Term::parts));
            components.truncate(most);
            components
        };
        let mut components = lacking(self);
        if !self.make_room(components.len()) {
            components = lacking(self);
        }
        for components in components.chunks(BLOCK) {
            if !goes_on() {
                return None;
            }
            self.add(components, &made(components));
        }
        Some(())
    }

    /// Forgets all columns if there is no room for so many more; true if none was forgotten.
    fn make_room(&mut self, more: usize) -> bool {
        let known = self.components.len();
        let has_room = known == 0 || (known + more) as f64 <= KEPT * self.place.len() as f64;
        if !has_room {
            self.place.fill(None);
            self.components.clear();
            self.values.clear();
        }
        has_room
    }

    /// Takes in the columns of `components`.
    fn add(&mut self, components: &[usize], columns: &[f64]) {
        let known = self.components.len();
        (known..).zip(components).for_each(|(place, &i)| self.place[i] = Some(place));
        self.components.extend_from_slice(components);
        self.values.extend_from_slice(columns);
    }
}
