//! The walks along the linear path that are tried, in turn.

use super::linear_walk::Rules;

/// Events that any walk may take.
const LEAST: usize = 100;

/// Events of a walk from the swept start, for each pair: those that arrive nearly always take fewer, at most
/// 42 on the hard families with 257 pairs.
const SHORT: f64 = 0.3;

/// Events of a walk from a sure start, for each pair: those that arrived in tests took up to 4, nearly all from a lifted
/// one less than 1.8.
const LONG: f64 = 10.0;

/// The same where another start follows, which is rarely as long as one that has not ended by then.
const ENOUGH: f64 = 3.0;

/// The same on the pairs in question.
const ENOUGH_ON_UNDECIDED: f64 = 2.0;

/// Changes after which a system is factorised again, and the same for each pair: a factorisation then costs about as
/// much as the changes.
const LEAST_AGE: usize = 60;
const AGE: f64 = 0.3;

/// Changes after which a system is factorised again where rounding has spoilt a walk.
const CAREFUL_AGE: usize = 4;

/// Where a walk starts.
#[derive(Clone, Copy, PartialEq)]
pub enum Start {
    /// At the coordinates after the sweeps.
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

/// The start is the best iterate of Newton's method after a few sweeps, or what walks on the pairs in question have come
/// to. A walk from a lifted start takes about as many events as there are pairs. One that keeps the closed pairs
/// varies much with the sweeps before it: from 750 events to more than 9000 on the hardest problem with 1025 pairs. But
/// it does not need the supports, without which a lifted body is free.
pub const ATTEMPTS: [Attempt; 7] = [
    Attempt { sweeps: 0, start: Start::Swept, events: SHORT, careful: false },
    Attempt { sweeps: 20, start: Start::Swept, events: SHORT, careful: false },
    Attempt { sweeps: 30, start: Start::Lifted, events: ENOUGH, careful: false },
    Attempt { sweeps: 100, start: Start::Sure, events: ENOUGH, careful: false },
    Attempt { sweeps: 200, start: Start::Sure, events: LONG, careful: false },
    Attempt { sweeps: 0, start: Start::Sure, events: LONG, careful: true },
    Attempt { sweeps: 0, start: Start::Pressed, events: LONG, careful: true },
];

/// The same on the pairs in question, where each costs little: short walks from several starts end sooner than a
/// long one.
pub const ON_UNDECIDED: [Attempt; 3] = [
    Attempt { sweeps: 3, start: Start::Swept, events: SHORT, careful: false },
    Attempt { sweeps: 20, start: Start::Swept, events: SHORT, careful: false },
    Attempt { sweeps: 30, start: Start::Lifted, events: ENOUGH_ON_UNDECIDED, careful: false },
];

/// Where attempts begin that are sure with all pairs in their states.
pub const WITH_STATES: usize = 3;
