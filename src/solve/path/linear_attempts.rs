//! The walks along the linear path that are tried, in turn.

use super::linear_walk::Rules;

/// Events that any walk may take.
const LEAST: usize = 100;

/// Events of a walk from the swept start, for each pair: on the hard families with 513 and 1025 pairs most of those that
/// arrive take fewer.
const SHORT: f64 = 0.4;

/// The same where the start is the solution of fewer pairs in question.
const SHORT_OF_FEWER: f64 = 0.6;

/// Events of a walk from a sure start, for each pair, at first and later: after a hundred sweeps and more most take
/// between 0.6 and 1.2 with all pairs in their states, and between 0.7 and 1.8 lifted, and others more than 4.
const SURE: f64 = 1.2;
const LIFTED: f64 = 1.5;
const SURE_LATER: f64 = 2.0;
const LIFTED_LATER: f64 = 3.0;

/// The same where no other start follows.
const LONG: f64 = 10.0;

/// Changes after which a system is factorised again, and the same for each pair: a factorisation then costs about as
/// much as the changes.
const LEAST_AGE: usize = 60;
const AGE: f64 = 0.3;

/// Changes after which a system is factorised again where rounding has spoilt a walk.
const CAREFUL_AGE: usize = 4;

/// Where a walk starts.
#[derive(Clone, Copy, PartialEq)]
pub enum Start {
    /// At the coordinates after the sweeps; without any at those of the given displacements, as far as the law has
    /// some.
    Swept,
    /// The same with all pairs open but one, as far as that makes them sure: no other coordinates share their loads.
    Lifted,
    /// At sure ones with all pairs in their states.
    Sure,
    /// The same with all pairs closed.
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
    /// Whether rounding has spoilt the walks before.
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

/// The start is the best iterate of Newton's method after some sweeps, or what walks on the pairs in question have come
/// to. How long a walk is varies much with the sweeps before it, and the next one may be ten times as long: so that short
/// walks from several starts end sooner than a long one. A walk with all pairs in their states does not need the
/// supports, without which a lifted body is free.
pub const ATTEMPTS: [Attempt; 14] = [
    walk(0, Start::Swept, SHORT),
    walk(30, Start::Swept, SHORT),
    walk(70, Start::Swept, SHORT),
    walk(100, Start::Swept, SHORT),
    walk(0, Start::Sure, SURE),
    walk(100, Start::Swept, SHORT),
    walk(0, Start::Lifted, LIFTED),
    walk(100, Start::Swept, SHORT),
    walk(100, Start::Sure, SURE_LATER),
    walk(100, Start::Swept, SHORT),
    walk(0, Start::Lifted, LIFTED_LATER),
    walk(200, Start::Sure, LONG),
    Attempt { sweeps: 0, start: Start::Sure, events: LONG, careful: true },
    Attempt { sweeps: 0, start: Start::Pressed, events: LONG, careful: true },
];

/// Where the last ones begin, which are given all the events that they need.
pub const LAST: usize = 11;

/// The same on the pairs in question, where each costs less.
pub const ON_UNDECIDED: [Attempt; 8] = [
    walk(0, Start::Swept, SHORT_OF_FEWER),
    walk(50, Start::Swept, SHORT),
    walk(50, Start::Swept, SHORT),
    walk(0, Start::Sure, SURE),
    walk(50, Start::Swept, SHORT),
    walk(0, Start::Lifted, LIFTED),
    walk(50, Start::Swept, SHORT),
    walk(50, Start::Sure, SURE_LATER),
];

/// Which of them is the first one where no fewer pairs have been solved: without sweeps on these pairs few walks arrive.
pub const FIRST_ON_UNDECIDED: usize = 1;
