//! The walks along the linear path that are tried, in turn.

use super::linear_walk::Rules;

/// Events that any walk may take.
const LEAST: usize = 100;

/// Events of a walk from the swept start, for each pair: on the hard families with 513 and 1025 pairs most of those that
/// arrive take fewer.
const SHORT: f64 = 0.5;

/// Events of a walk from a sure start, for each pair, at first: after a hundred sweeps and more most take between 0.6 and
/// 1.2, and others more than 4.
const SURE: f64 = 1.2;

/// Events of a walk that no other kind of start follows.
const LONG: f64 = 10.0;

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
    /// True if rounding has spoilt the walks before.
    pub careful: bool,
}

impl Attempt {
    /// How far the walk may go with so many pairs.
    pub fn rules(&self, pairs: usize) -> Rules {
        let of = |part: f64| (part * pairs as f64) as usize;
        let age = if self.careful { CAREFUL_AGE } else { LEAST_AGE.max(of(AGE)) };
        Rules { most: LEAST.max(of(self.events)), age }
    }
}

/// A walk that rounding has not spoilt.
const fn walk(sweeps: usize, start: Start, events: f64) -> Attempt {
    Attempt { sweeps, start, events, careful: false }
}

/// Walks on all pairs, from the best iterate of Newton's method or from the end of walks on the pairs in question. The
/// length of a walk varies much with the sweeps before it, and the next one may be ten times as long: short walks from
/// several starts end sooner than a long one. `cargo bench --features counters --bench mechanisms` counts which decide.
pub const ATTEMPTS: [Attempt; 6] = [
    walk(0, Start::Swept, SHORT),
    walk(30, Start::Swept, SHORT),
    walk(70, Start::Swept, SHORT),
    walk(100, Start::Sure, SURE),
    walk(300, Start::Sure, LONG),
    Attempt { sweeps: 0, start: Start::Pressed, events: LONG, careful: true },
];

/// Where the last ones begin, which are given all the events that they need.
pub const LAST: usize = 4;

/// Walks on the pairs in question, where an event costs less than on all: so a sure start is the last one.
pub const ON_UNCERTAIN_PAIRS: [Attempt; 3] =
    [walk(0, Start::Swept, SHORT), walk(50, Start::Swept, SHORT), walk(50, Start::Sure, LONG)];

/// The first of them where no fewer pairs have been solved: without sweeps on these pairs few walks arrive.
pub const FIRST_ON_UNCERTAIN_PAIRS: usize = 1;
