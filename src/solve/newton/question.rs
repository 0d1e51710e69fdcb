//! Which pairs are in question: those that sweeps leave undecided, and those that a solution contradicts.

use crate::law::Piece;
use crate::law::{Contact, FixedState, PairLaw};
use crate::monitor::Monitor;
use crate::solve::sweeps::Sweeper;

/// Sweeps before pairs are watched, and as many in which they are: a pair whose piece changes in these is in question.
const SWEEPS: usize = 10;

/// Pairs that a pair takes along to either side when it joins. What joins one by one takes many rounds.
const BESIDE: usize = 4;

/// Which pairs are in question, and the pieces of all.
pub struct InQuestion {
    pairs: Vec<bool>,
    pub pieces: Vec<Piece>,
}

impl InQuestion {
    /// The pairs whose piece changes in sweeps from `d`, or that are not held on it; and the displacements after
    /// the sweeps.
    pub fn after_sweeps(
        contact: &Contact<'_>,
        d: &[f64],
        monitor: &Monitor<'_>,
    ) -> (Vec<f64>, Self) {
        let mut d = contact.admissible(d);
        let mut force = contact.problem().force(&d);
        let sweeper = Sweeper::new();
        let mut sweep = |d: &mut Vec<f64>| {
            if !monitor.is_late() {
                sweeper.sweep(contact, (&mut *d, &mut force), 1.0);
            }
            contact.pieces(d, &force)
        };
        let mut pieces = Vec::new();
        for _ in 0..SWEEPS {
            pieces = sweep(&mut d);
        }
        let mut pairs = vec![false; pieces.len()];
        for _ in 0..SWEEPS {
            let next = sweep(&mut d);
            for (is_in, (before, after)) in pairs.iter_mut().zip(pieces.iter().zip(&next)) {
                *is_in |= before != after;
            }
            pieces = next;
        }
        for (is_in, (law, piece)) in pairs.iter_mut().zip(contact.pairs().iter().zip(&pieces)) {
            *is_in |= law.fixed_state(*piece).is_none();
        }
        (d, InQuestion { pairs, pieces })
    }

    /// True if at most `part` of the pairs is in question, and not none.
    pub fn is_fewer_than(&self, part: f64) -> bool {
        let (count, all) = (self.pairs.iter().filter(|is_in| **is_in).count(), self.pairs.len());
        count > 0 && count as f64 <= part * all as f64
    }

    /// How each pair is held; `None` of those in question.
    pub fn held(&self, contact: &Contact<'_>) -> Vec<Option<FixedState>> {
        let pairs = contact.pairs().iter().zip(self.pairs.iter().zip(&self.pieces));
        pairs
            .map(|(law, (is_in, piece))| if *is_in { None } else { law.fixed_state(*piece) })
            .collect()
    }

    /// Puts the pairs whose state the displacements `d` contradict, and those before and after them, in question;
    /// whether there are any. The pieces become those at `d`.
    pub fn join_contradicted(&mut self, contact: &Contact<'_>, d: &[f64]) -> bool {
        let next = contact.pieces(d, &contact.problem().force(d));
        let laws = contact.pairs().iter().zip(self.pieces.iter().zip(&next));
        let is_other = |(law, (before, after)): (&PairLaw, (&Piece, &Piece))| {
            law.fixed_state(*before) != law.fixed_state(*after)
        };
        let others: Vec<bool> = laws.map(is_other).collect();
        let joining: Vec<usize> =
            (0..others.len()).filter(|&pair| others[pair] && !self.pairs[pair]).collect();
        for &pair in &joining {
            let end = (pair + BESIDE + 1).min(self.pairs.len());
            self.pairs[pair.saturating_sub(BESIDE)..end].fill(true);
        }
        self.pieces = next;
        !joining.is_empty()
    }
}
