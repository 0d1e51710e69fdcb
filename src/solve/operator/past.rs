//! The results that load cases of a series leave for the next ones.

use super::point::Displacements;
use crate::linalg::gmres::orthogonalised;
use crate::linalg::tolerances::ROUNDING;

/// Most loads that are kept: a host combines few, such as a pressure, a shear and a weight.
const MOST: usize = 4;

/// The past of a series.
#[derive(Default)]
pub struct CasePast {
    /// Loads, orthonormal, with the displacements under each where those of the pairs are zero.
    loads: Vec<Vec<f64>>,
    at_zero: Vec<Displacements>,
    /// The last solution.
    last: Option<Displacements>,
}

impl CasePast {
    /// The displacements under a load where those of the pairs are zero: the sum of known ones, if it is a sum of loads
    /// that are known, and otherwise what `made` gives for it, which is kept.
    ///
    /// # Errors
    /// Those of `made`.
    pub fn at_zero<E>(
        &mut self,
        load: &[f64],
        made: impl FnOnce() -> Result<Displacements, E>,
    ) -> Result<Displacements, E> {
        let mut rest = load.to_vec();
        let (shares, left, was) = orthogonalised(&mut rest, &self.loads);
        let parts = self.at_zero.iter().zip(&shares);
        let is_known = left <= ROUNDING * was;
        if let Some(first) = self.at_zero.first().filter(|_| is_known) {
            let nothing = Displacements::zero(load.len(), first.low.len());
            return Ok(parts.fold(nothing, |sum, (x, share)| sum.plus(*share, x)));
        }
        let found = made()?;
        if !is_known && self.loads.len() < MOST {
            let own = parts.fold(found.clone(), |rest, (x, share)| rest.plus(-share, x));
            let nothing = Displacements::zero(load.len(), own.low.len());
            self.at_zero.push(nothing.plus(left.recip(), &own));
            self.loads.push(rest.iter().map(|part| part / left).collect());
        }
        Ok(found)
    }

    /// Keeps a solution.
    pub fn solved(&mut self, at: Displacements) {
        self.last = Some(at);
    }

    /// The last solution, if `d` are its displacements of the pairs.
    pub fn last(&self, d: &[f64]) -> Option<&Displacements> {
        self.last.as_ref().filter(|last| &last.x[last.low.len()..] == d)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Displacements follow loads linearly: `x = 2 b` here. What is no sum of known loads is not known.
    #[test]
    fn sums_of_known_loads_are_known() {
        let mut past = CasePast::default();
        let twice = |load: &[f64]| {
            let x = load.iter().map(|b| 2.0 * b).collect();
            Displacements { x, ..Displacements::zero(load.len(), load.len() - 1) }
        };
        let loads = [[1.0, 2.0, 0.0, 3.0], [0.5, -1.0, 4.0, 1.0]];
        for load in &loads {
            assert!(past.at_zero(load, || Err(())).is_err());
            assert_eq!(past.at_zero::<()>(load, || Ok(twice(load))).unwrap().x, twice(load).x);
        }
        let sum: Vec<f64> = loads[0].iter().zip(&loads[1]).map(|(a, b)| 3.0 * a - b).collect();
        let found = past.at_zero(&sum, || Err(())).unwrap();
        for (x, b) in found.x.iter().zip(&sum) {
            // Rounding of a few products of numbers up to 20.
            assert!((x - 2.0 * b).abs() <= 1e-13, "{x} {b}");
        }
        assert!(past.at_zero(&[1.0, 2.0, 0.0, 3.1], || Err(())).is_err());
    }
}
