//! Which pairs are in question: those that sweeps leave undecided, and those that a solution contradicts.

use crate::law::branch::Branch;
use crate::law::{Contact, Held, PairLaw};
use crate::monitor::Monitor;
use crate::solve::sweeps::Sweeper;

/// Sweeps before pairs are watched, and sweeps in which they are: a pair whose branch changes in these is in
/// question.
const SWEEPS: usize = 10;
const WATCHED: usize = 10;

/// Fewer pairs that are decided are not worth their elimination.
const WORTHWHILE: usize = 12;

/// Pairs that a pair takes along to either side when it joins, beside its neighbour: so many, and a part of all. What
/// joins one by one takes many rounds.
const LEAST_BESIDE: usize = 3;
const BESIDE: f64 = 0.005;

/// Which pairs are in question, and the branches of all.
pub struct InQuestion {
    pairs: Vec<bool>,
    pub branches: Vec<Branch>,
}

impl InQuestion {
    /// The pairs whose branch changes in sweeps from `d`, or that are not held on it; and the displacements after
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
            contact.branches(d, &force)
        };
        let mut branches = Vec::new();
        for _ in 0..SWEEPS {
            branches = sweep(&mut d);
        }
        let mut pairs = vec![false; branches.len()];
        for _ in 0..WATCHED {
            let next = sweep(&mut d);
            for (is_in, (before, after)) in pairs.iter_mut().zip(branches.iter().zip(&next)) {
                *is_in |= before != after;
            }
            branches = next;
        }
        for (is_in, (law, branch)) in pairs.iter_mut().zip(contact.pairs().iter().zip(&branches)) {
            *is_in |= law.held(*branch).is_none();
        }
        (d, InQuestion { pairs, branches })
    }

    /// Whether at most `part` of the pairs is in question, not none, and enough are decided.
    pub fn is_fewer_than(&self, part: f64) -> bool {
        let (count, all) = (self.pairs.iter().filter(|is_in| **is_in).count(), self.pairs.len());
        count > 0 && count as f64 <= part * all as f64 && all - count >= WORTHWHILE
    }

    /// How each pair is held; `None` of those in question.
    pub fn held(&self, contact: &Contact<'_>) -> Vec<Option<Held>> {
        let pairs = contact.pairs().iter().zip(self.pairs.iter().zip(&self.branches));
        pairs.map(|(law, (is_in, branch))| if *is_in { None } else { law.held(*branch) }).collect()
    }

    /// Puts the pairs whose state the displacements `d` contradict, and those before and after them, in question;
    /// whether there are any. The branches become those at `d`.
    pub fn join_contradicted(&mut self, contact: &Contact<'_>, d: &[f64]) -> bool {
        let next = contact.branches(d, &contact.problem().force(d));
        let laws = contact.pairs().iter().zip(self.branches.iter().zip(&next));
        let is_other = |(law, (before, after)): (&PairLaw, (&Branch, &Branch))| {
            law.held(*before) != law.held(*after)
        };
        let others: Vec<bool> = laws.map(is_other).collect();
        let joining: Vec<usize> =
            (0..others.len()).filter(|&pair| others[pair] && !self.pairs[pair]).collect();
        let beside = LEAST_BESIDE.max((BESIDE * self.pairs.len() as f64) as usize);
        for &pair in &joining {
            let end = (pair + beside + 2).min(self.pairs.len());
            self.pairs[pair.saturating_sub(beside + 1)..end].fill(true);
        }
        self.branches = next;
        !joining.is_empty()
    }
}
