//! Measures and proofs in other units than those of the host.

use super::measure::{Certificate, LEAST};
use super::proof::Proof;
use crate::problem::Units;

impl Certificate {
    /// The certificate in the host's units. Forces among the smallest doubles are rounded, which
    /// [`Certificate::equilibrium`] counts; a force beyond doubles is no solution.
    pub(crate) fn to_host(&self, units: Units) -> Self {
        let force: Vec<f64> = self.force.iter().map(|&force| units.force.host(force)).collect();
        let rounded = if units.force.keeps(&self.force) { 0.0 } else { LEAST };
        let beyond = force.iter().any(|force| force.abs() == f64::MAX);
        Certificate {
            eta: if beyond { self.eta.max(1.0) } else { self.eta },
            residual: if beyond { self.residual.max(1.0) } else { self.residual },
            penetration: units.length.host(self.penetration),
            tension: units.force.host(self.tension),
            cone_excess: units.force.host(self.cone_excess),
            equilibrium: units.force.host(self.equilibrium) + rounded,
            force,
            states: self.states.clone(),
            raw: self.raw.iter().map(|&force| units.force.host(force)).collect(),
            ..*self
        }
    }
}

impl Proof {
    /// The proof in the host's units. Radii count the rounding of what is among the smallest doubles.
    pub(crate) fn to_host(&self, units: Units) -> Self {
        let lengths =
            |values: &[f64]| values.iter().map(|&value| units.length.host(value)).collect();
        let widened = |radius: f64, exact: bool| if exact { radius } else { radius + 3.0 * LEAST };
        let mut lengths_of = [&self.d, &self.d_low, &self.d_radius].into_iter();
        let keeps_lengths = lengths_of.all(|d| units.length.keeps(d));
        let keeps_forces = units.force.keeps(&self.force) && units.force.keeps(&self.force_radius);
        let d_radius = |&radius| widened(units.length.host(radius), keeps_lengths);
        let force_radius = |&radius| widened(units.force.host(radius), keeps_forces);
        Proof {
            d: lengths(&self.d),
            d_low: lengths(&self.d_low),
            d_radius: self.d_radius.iter().map(d_radius).collect(),
            force: self.force.iter().map(|&force| units.force.host(force)).collect(),
            force_radius: self.force_radius.iter().map(force_radius).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::certify;
    use crate::problem::{ContactProblem, FrictionLaw};
    use fastrand::Rng;

    /// Units and a certificate of a problem whose numbers are 2^-1000 and stiffnesses of 1.
    fn small() -> (Units, Certificate) {
        let load = [host(1.0), 0.0];
        let of_pairs = (&[f64::INFINITY][..], FrictionLaw::Frictionless, None);
        let problem = ContactProblem::of_test(2, (&[1.0, 0.0, 0.0, 1.0], &load), of_pairs);
        let units = Units::of(&problem).unwrap();
        assert_eq!((units.length.host(1.0), units.force.host(1.0)), (load[0], load[0]));
        (units, certify(&problem, &load))
    }

    /// The host's numbers are ours times 2^-1000.
    fn host(value: f64) -> f64 {
        value * 2_f64.powi(-500) * 2_f64.powi(-500)
    }

    fn ours(value: f64) -> f64 {
        value * 2_f64.powi(500) * 2_f64.powi(500)
    }

    /// A whole number of 2^-80: the smallest double of the host is 2^-74 here.
    fn fine(rng: &mut Rng, most: i32) -> f64 {
        f64::from(rng.i32(-most..=most)) * 2_f64.powi(-80)
    }

    /// What a proof encloses it encloses in the host's units, where numbers are rounded to the smallest doubles, and where
    /// nothing is rounded by no more. The numbers are exact: they have twenty digits or fewer.
    #[test]
    fn an_enclosure_counts_the_rounding_of_the_smallest_doubles() {
        let (units, rng) = (small().0, &mut Rng::with_seed(1));
        for seed in 0..2000 {
            let fine_or = |rng: &mut Rng, coarse: f64| match rng.bool() {
                true => fine(rng, 1000),
                false => coarse,
            };
            let [d, low, force] = [0.5, 0.25, -2.0].map(|coarse| vec![fine_or(rng, coarse)]);
            let [d_radius, force_radius] =
                [0.5, 0.25].map(|coarse| vec![fine_or(rng, coarse).abs()]);
            let proof = Proof { d, d_low: low, d_radius, force, force_radius };
            let told = proof.to_host(units);
            let check = |(middle, radius): (f64, f64), (of, around): (f64, f64), exact: bool| {
                let needed = (middle - ours(of)).abs() + radius;
                assert!(needed <= ours(around), "seed {seed}: {proof:?}, {told:?}");
                assert!(!exact || ours(around) == radius, "seed {seed}: {proof:?}, {told:?}");
                assert!(ours(around) <= radius + 4.0 * ours(LEAST), "seed {seed}: {told:?}");
            };
            let is_kept = |values: &[f64]| values.iter().all(|&value| ours(host(value)) == value);
            let middle = proof.d[0] + proof.d_low[0];
            let kept = is_kept(&[proof.d[0], proof.d_low[0], proof.d_radius[0]]);
            let of = told.d[0] + told.d_low[0];
            check((middle, proof.d_radius[0]), (of, told.d_radius[0]), kept);
            let kept = is_kept(&[proof.force[0], proof.force_radius[0]]);
            check(
                (proof.force[0], proof.force_radius[0]),
                (told.force[0], told.force_radius[0]),
                kept,
            );
        }
    }

    /// The rounding of a force counts in its imbalance.
    #[test]
    fn equilibrium_counts_the_rounding_of_the_smallest_forces() {
        let ((units, certificate), rng) = (small(), &mut Rng::with_seed(2));
        for seed in 0..200 {
            let force = vec![fine(rng, 1000), fine(rng, 1000)];
            let measured = Certificate { force, equilibrium: 0.0, ..certificate.clone() };
            let told = measured.to_host(units);
            let forces = measured.force.iter().zip(&told.force);
            let off = forces.map(|(force, told)| (force - ours(*told)).abs());
            assert!(off.fold(0.0, f64::max) <= ours(told.equilibrium), "seed {seed}: {told:?}");
        }
    }
}
