//! Numbers that no data are tied to, the same in every run.

/// A sequence in (-1, 1): the SplitMix64 generator (Steele, Lea and Flood 2014).
pub struct Perturbation {
    state: u64,
}

impl Perturbation {
    /// The sequence of a seed.
    pub fn new(seed: u64) -> Self {
        Perturbation { state: seed }
    }

    /// The next number.
    pub fn next(&mut self) -> f64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        (z >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}
