//! The walks along the linear path that are tried, in turn, and where they start: at coordinates after some sweeps,
//! moved by a little at random so that no two pairs change at once.

use super::curved::PERTURBATION;
use super::linear_walk::Rules;
use crate::law::{PairLaw, Planar};
use crate::linalg::perturbation::Perturbation;
use crate::solve::result::Call;
use crate::solve::sweeps::sweep_pairs;

/// Events that any walk may take.
const LEAST: usize = 100;

/// Events of a walk from the swept start, for each pair: on the hard families with 513 and 1025 pairs most of those that
/// arrive take fewer.
const SHORT: f64 = 0.5;

/// Events of a walk from pressed pairs, for each pair, at first: where the pairs of a beam stay closed, sweeps lead far
/// away, while each pair leaves its state about once on the way from this start.
const ONCE: f64 = 2.0;

/// Events of a walk from a start which the theorem says arrives, for each pair: rounding alone keeps it from there. On clamped beams with
/// mu to 5, each pair pushed at random, the longest takes 263 with 300 pairs; with 10 a third of 30 with 100 pairs were lost.
const LONG: f64 = 1000.0;

/// Changes after which a system is factorised again, at least and for each pair: a factorisation then costs about as
/// much as the changes.
const LEAST_AGE: usize = 60;
const AGE: f64 = 0.3;

/// Changes after which a system is factorised again where rounding has spoilt a walk.
const CAREFUL_AGE: usize = 4;

/// The start of a walk.
#[derive(Clone, Copy, PartialEq)]
pub enum Start {
    /// The coordinates after the sweeps; without any those of the given displacements, as far as the law has some.
    Swept,
    /// Sure coordinates: no others share their loads.
    Sure,
    /// Coordinates of pairs that are pressed on their obstacles and stick.
    Pressed,
}

/// A walk that is tried.
#[derive(Clone, Copy)]
pub struct Attempt {
    /// Sweeps before it, beside those of earlier ones.
    pub sweeps: usize,
    pub start: Start,
    /// Events after which it is given up, for each pair.
    pub events: f64,
    /// True where rounding has spoilt the walks before: it factorises at nearly every event.
    pub is_careful: bool,
}

impl Attempt {
    /// How far the walk may go with so many pairs.
    pub fn rules(&self, pairs: usize) -> Rules {
        let of = |part: f64| (part * pairs as f64) as usize;
        let age = if self.is_careful { CAREFUL_AGE } else { LEAST_AGE.max(of(AGE)) };
        Rules { most: LEAST.max(of(self.events)), age }
    }
}

pub const fn walk(sweeps: usize, start: Start, events: f64) -> Attempt {
    Attempt { sweeps, start, events, is_careful: false }
}

/// Walks on all pairs, from the best iterate of Newton's method or from the end of walks on the pairs in question. The
/// length of a walk varies much with the sweeps before it, and the next one may be ten times as long: short walks from
/// several starts end sooner than a long one. `cargo bench --features counters --bench mechanisms` counts which decide.
pub const ATTEMPTS: [Attempt; 6] = [
    walk(0, Start::Swept, SHORT),
    walk(0, Start::Pressed, ONCE),
    walk(30, Start::Swept, SHORT),
    walk(70, Start::Swept, SHORT),
    walk(400, Start::Sure, LONG),
    Attempt { is_careful: true, ..walk(0, Start::Pressed, LONG) },
];

/// Walks where thresholds are given, so that every start is sure.
pub fn with_given_thresholds() -> &'static [Attempt] {
    let first = ATTEMPTS.iter().position(|attempt| attempt.start == Start::Sure);
    &ATTEMPTS[first.unwrap_or(0)..]
}

/// Walks on the pairs in question, where an event costs less than on all: so a sure start is the last one. The first is
/// left out where no fewer pairs have been solved: without sweeps on these pairs few walks arrive.
pub const ON_UNCERTAIN_PAIRS: [Attempt; 3] =
    [walk(0, Start::Swept, SHORT), walk(50, Start::Swept, SHORT), walk(50, Start::Sure, LONG)];

/// How much the forces of [`Start::Pressed`] differ.
const VARIED: f64 = 0.1;

/// The sweeps before the walks, and their randomness.
pub struct Starts<'p> {
    call: Call<'p>,
    root: &'p [f64],
    /// Displacements after the sweeps, and their force; at first those of the start, which may break the law.
    d: Vec<f64>,
    force: Vec<f64>,
    /// Mean size of the loads, in the unit that its diagonal entry of `K` gives each.
    mean: f64,
    random: Perturbation,
}

impl<'p> Starts<'p> {
    /// Begins at the start of the call; `size` is the length of the loads, `root` gives the units.
    pub fn new(call: &Call<'p>, root: &'p [f64], size: f64) -> Self {
        let (contact, d) = (call.contact, call.start_or_zero());
        let (force, mean) = (contact.problem().force(&d), size / (root.len() as f64).sqrt());
        Starts { call: *call, root, d, force, mean, random: Perturbation::new(0) }
    }

    /// Sweeps on while there is time; then the coordinates at which a walk starts.
    pub fn next(&mut self, attempt: Attempt) -> Vec<Planar> {
        let (laws, matrix) = (self.call.contact.pairs(), self.call.contact.problem().stiffness());
        if attempt.sweeps > 0 {
            self.d = self.call.contact.admissible(&self.d);
            self.force = self.call.contact.problem().force(&self.d);
        }
        let iterate = (&mut self.d[..], &mut self.force[..]);
        sweep_pairs(laws, matrix, iterate, (attempt.sweeps, 1.0), self.call.monitor);
        let swept = self.swept();
        let pairs = self.call.contact.pairs().iter().zip(swept).zip(self.root.chunks_exact(2));
        let start = |((law, y), root): ((&PairLaw, Planar), &[f64])| match attempt.start {
            Start::Swept => y,
            Start::Sure => law.sure_start(y),
            Start::Pressed => {
                let varied = 1.0 + VARIED * self.random.next();
                law.pressed(y, self.mean * root[0] * varied)
            }
        };
        pairs.map(start).collect()
    }

    /// The coordinates after the sweeps, moved at random.
    fn swept(&mut self) -> Vec<Planar> {
        let (part, random) = (PERTURBATION * self.mean, &mut self.random);
        let mut roots = self.root.chunks_exact(2);
        let moved = |(law, d, force): (&PairLaw, &[f64], &[f64])| {
            let root = roots.next().expect("every pair has roots");
            let y = law.released(d, force, part * root[0] * (2.0 + random.next()));
            std::array::from_fn(|c| y[c] + part * root[c] * random.next())
        };
        self.call.contact.each(&self.d, &self.force).map(moved).collect()
    }
}
