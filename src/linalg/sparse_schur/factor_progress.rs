//! Progress of a factorisation, and the end that its caller may put to it.

/// The caller's answer that ends the work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stopped;

/// Is told the memory and the progress of a factorisation, and may end it.
pub trait FactorProgress {
    /// A long part begins that needs `bytes` of memory in all, those of its arguments included.
    ///
    /// # Errors
    /// The part must not begin.
    fn needs(&mut self, _bytes: u64) -> Result<(), Stopped> {
        Ok(())
    }

    /// Between two steps: `share` of the work is done, 0 before anything is known of it.
    ///
    /// # Errors
    /// The work must end.
    fn has_done(&mut self, share: f64) -> Result<(), Stopped>;
}

#[cfg(test)]
pub mod tests {
    use super::{FactorProgress, Stopped};

    /// Lets everything go on.
    pub struct Unwatched;

    impl FactorProgress for Unwatched {
        fn has_done(&mut self, _: f64) -> Result<(), Stopped> {
            Ok(())
        }
    }
}
