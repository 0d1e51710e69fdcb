//! Sets of variables that come back: on a matrix that is no P-matrix single exchanges may cycle, and on one that is
//! rounding may make them.

/// One of the past sets, of which any cycle has a member in the end (Brent 1980): it is replaced after 1, 2, 4, 8 ... more.
#[derive(Default)]
pub struct Past {
    basic: Vec<bool>,
    /// Sets since.
    age: u64,
    /// Sets after which it is replaced.
    span: u64,
}

impl Past {
    /// True if this set is the one of the past.
    pub fn repeats(&mut self, basic: &[bool]) -> bool {
        self.age += 1;
        if self.basic == basic {
            return true;
        }
        if self.age >= self.span {
            *self = Past { basic: basic.to_vec(), age: 0, span: 2 * self.span.max(1) };
        }
        false
    }
}
