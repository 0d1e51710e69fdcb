//! Vectors by which an operator is checked and measured.

/// A vector without a pattern, of either sign and sizes between 1 and 2: the same in each run. Two vectors of
/// signs alone would hide what is wrong with few components. (G. Marsaglia, *Xorshift RNGs*, J. Stat. Softw.
/// 8 (2003), number 14.)
pub(super) fn probe(size: usize, seed: u64) -> Vec<f64> {
    let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        let sign = if state.leading_zeros() == 0 { 1.0 } else { -1.0 };
        sign * (1.0 + (state >> 32) as f64 / f64::from(u32::MAX))
    };
    (0..size).map(|_| next()).collect()
}

/// A unit for each direction of the pairs: a mean of the diagonal, by vectors `x` of random signs, of which
/// `x . K x` has the sum of `x_i^2 K_ii` as its mean (M. F. Hutchinson, *A stochastic estimator of the trace of the
/// influence matrix*, Commun. Stat. Simul. Comput. 19 (1990) 433-450). `None`: it is not positive.
pub(super) fn measured_units(
    dim: usize,
    probes: &[Vec<f64>; 2],
    products: &[Vec<f64>; 2],
) -> Option<Vec<f64>> {
    let mean = |first: usize, step: usize| {
        let (mut energy, mut weight) = (0.0, 0.0);
        for (x, product) in probes.iter().zip(products) {
            for (x, product) in x.iter().zip(product).skip(first).step_by(step) {
                energy += x * product;
                weight += x * x;
            }
        }
        energy / weight
    };
    let all = mean(0, 1);
    if !is_unit(all) {
        return None;
    }
    let unit = |c: usize| if is_unit(mean(c, dim)) { mean(c, dim) } else { all };
    let of_pair: Vec<f64> = (0..dim).map(unit).collect();
    Some(of_pair.iter().copied().cycle().take(probes[0].len()).collect())
}

pub(super) fn is_unit(unit: f64) -> bool {
    unit > 0.0 && unit.is_finite()
}

#[cfg(test)]
mod tests {
    use super::{measured_units, probe};

    /// Sizes between 1 and 2 with the mean 1.5, as many of one sign as of the other, neighbours and two probes
    /// without a relation: sums of 4096 independent numbers are within five of their deviations.
    #[test]
    fn probes_have_no_pattern() {
        let n: usize = 1 << 12;
        let root = (n as f64).sqrt();
        let probes: Vec<Vec<f64>> = (1..4).map(|seed| probe(n, seed)).collect();
        for (k, x) in probes.iter().enumerate() {
            assert!(x.iter().all(|x| (1.0..=2.0).contains(&x.abs())));
            let sum = |of: fn(f64) -> f64| x.iter().map(|x| of(*x)).sum::<f64>();
            assert!(sum(f64::signum).abs() <= 5.0 * root);
            assert!((sum(f64::abs) - 1.5 * n as f64).abs() <= 5.0 * root / 12.0_f64.sqrt());
            let y = &probes[(k + 1) % probes.len()];
            for lag in 0..8 {
                // The mean square of a number is 7/3.
                let other = x.iter().zip(y.iter().cycle().skip(lag)).map(|(x, y)| x * y);
                assert!(other.sum::<f64>().abs() <= 5.0 * root * 7.0 / 3.0, "{k}, {lag}");
                let own = x.iter().zip(x.iter().cycle().skip(lag + 1)).map(|(x, y)| x * y);
                assert!(own.sum::<f64>().abs() <= 5.0 * root * 7.0 / 3.0, "{k}, {lag}");
            }
        }
    }

    /// If springs are the same in each direction, the units are the springs; where one direction resists
    /// nothing, it has the mean of all.
    #[test]
    fn units_are_means_of_the_diagonal() {
        let probes = [probe(30, 1), probe(30, 2)];
        let units = |springs: [f64; 3]| {
            let times = |x: &Vec<f64>| -> Vec<f64> {
                x.iter().enumerate().map(|(i, x)| springs[i % 3] * x).collect()
            };
            measured_units(3, &probes, &[times(&probes[0]), times(&probes[1])])
        };
        let found = units([2.0, 5e-3, 7e5]).unwrap();
        for (i, unit) in found.iter().enumerate() {
            assert!((unit / [2.0, 5e-3, 7e5][i % 3] - 1.0).abs() <= 1e-14, "{found:?}");
        }
        let found = units([3.0, 0.0, 3.0]).unwrap();
        assert_eq!(found.len(), 30);
        // A third of the squares, which lie between 1 and 4, is missing.
        assert!(found[1] > 1.0 && found[1] < 3.0 && (found[0] - 3.0).abs() <= 1e-14, "{found:?}");
        assert_eq!(units([0.0; 3]), None);
    }
}
