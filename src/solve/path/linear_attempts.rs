//! The walks along the linear path that are tried, in turn.

/// Events of a walk from the swept start, for each pair: those that arrive nearly always take fewer, at most
/// 42 on the hard families with 257 pairs.
const SHORT: f64 = 0.3;

/// Events of a walk from a sure start, for each pair: those that arrived in tests took up to 4.
const LONG: f64 = 10.0;

/// The same on the pairs in question: those that arrived took up to 2.8.
const ENOUGH: f64 = 3.0;

/// Changes after which a system is factorised again: a factorisation then costs about as much as the
/// changes.
const AGE: usize = 60;

/// The same where rounding has spoilt a walk.
const CAREFUL_AGE: usize = 4;

/// Where a walk starts.
#[derive(Clone, Copy, PartialEq)]
pub enum Start {
    /// At the coordinates after the sweeps.
    Swept,
    /// At those that no other coordinates share their loads with.
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
    /// Events after which a system is factorised again.
    pub age: usize,
}

/// A sweep costs a third of an event. `auto` starts at the best iterate of Newton's method, where a few
/// sweeps are enough; where the path comes back from there, more of them are a start of another kind.
/// Further ones spare the sure start a third of its events.
pub const ATTEMPTS: [Attempt; 5] = [
    Attempt { sweeps: 20, start: Start::Swept, events: SHORT, age: AGE },
    Attempt { sweeps: 100, start: Start::Swept, events: SHORT, age: AGE },
    Attempt { sweeps: 200, start: Start::Sure, events: LONG, age: AGE },
    Attempt { sweeps: 0, start: Start::Sure, events: LONG, age: CAREFUL_AGE },
    Attempt { sweeps: 0, start: Start::Pressed, events: LONG, age: CAREFUL_AGE },
];

/// The same on the pairs in question, where each costs little: short walks from several starts end sooner than a
/// long one.
pub const ON_UNDECIDED: [Attempt; 5] = [
    Attempt { sweeps: 3, start: Start::Swept, events: SHORT, age: AGE },
    Attempt { sweeps: 20, start: Start::Swept, events: SHORT, age: AGE },
    Attempt { sweeps: 80, start: Start::Swept, events: SHORT, age: AGE },
    Attempt { sweeps: 200, start: Start::Swept, events: SHORT, age: AGE },
    Attempt { sweeps: 0, start: Start::Sure, events: ENOUGH, age: AGE },
];

/// Where attempts begin that are sure.
pub const SURE: usize = 2;
