//! Hosts whose bodies have a motion that nothing resists: functions are never asked with numbers that are not finite, and
//! what carries a load along that motion is not called solved.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

use crate::common::dense::{Elimination, product};
use fastrand::Rng;
use signorini::reduce::{Held, HostOperator};
use signorini::{FrictionLaw, LoadCase, Model, Monitor, Settings, Status};

/// A dense matrix, whose first unknowns are the components of pairs in the plane, with solutions by elimination.
struct Host {
    matrix: Vec<f64>,
    was_asked_with_none: Arc<AtomicBool>,
}

impl Host {
    fn asked_with(&self, x: &[f64]) {
        if x.iter().any(|x| !x.is_finite()) {
            self.was_asked_with_none.store(true, Relaxed);
        }
    }
}

impl HostOperator for Host {
    fn stiffness(&self, x: &[f64], y: &mut [f64]) -> Result<(), i32> {
        self.asked_with(x);
        y.copy_from_slice(&product(&self.matrix, x));
        Ok(())
    }

    fn held(&self, held: &Held<'_>, r: &[f64], z: &mut [f64]) -> Result<(), i32> {
        self.asked_with(r);
        let free: Vec<usize> =
            (0..r.len()).filter(|&i| !held.components.get(i).is_some_and(|held| *held)).collect();
        let mut own = Vec::new();
        for &i in &free {
            own.extend(free.iter().map(|&j| {
                let is_tangent = i == j && i < held.components.len() && i % 2 == 1;
                self.matrix[i * r.len() + j] + if is_tangent { held.springs[i / 2] } else { 0.0 }
            }));
        }
        let forces: Vec<f64> = free.iter().map(|&i| r[i]).collect();
        z.fill(0.0);
        let (solution, _) = Elimination::new(free.len(), &own).solve(&forces);
        free.iter().zip(solution).for_each(|(&i, displacement)| z[i] = displacement);
        Ok(())
    }
}

/// `B Bᵀ + 1/10` of random numbers, without the row and the column of the first tangent.
fn loose_along_a_tangent(size: usize, rng: &mut Rng) -> Vec<f64> {
    let b: Vec<f64> = (0..size * size).map(|_| 4.0 * rng.f64() - 2.0).collect();
    let mut matrix = vec![0.0; size * size];
    for i in 0..size {
        for j in 0..size {
            let sum: f64 = (0..size).map(|k| b[i * size + k] * b[j * size + k]).sum();
            let is_loose = i == 1 || j == 1;
            let entry = sum + if i == j { 0.1 } else { 0.0 };
            matrix[i * size + j] = if is_loose { 0.0 } else { entry };
        }
    }
    matrix
}

#[test]
fn a_host_is_not_asked_with_numbers_that_are_not_finite() {
    for seed in 0..400 {
        let mut rng = Rng::with_seed(seed);
        let (size, pairs) = [(4, 1), (4, 2), (5, 2), (6, 2), (7, 3)][rng.usize(0..5)];
        let (none, law) =
            (Arc::new(AtomicBool::new(false)), FrictionLaw::Coulomb(&[0.0; 3][..pairs]));
        let matrix = loose_along_a_tangent(size, &mut rng);
        let units: Vec<f64> = (0..size).map(|i| matrix[i * size + i] + 1e-2).collect();
        let host = Host { matrix, was_asked_with_none: none.clone() };
        let components: Vec<usize> = (0..2 * pairs).collect();
        let model = Model::preconditioned(2, Box::new(host), &units, &components).unwrap();
        let load: Vec<f64> = (0..size).map(|_| 20.0 * rng.f64() - 10.0).collect();
        let gap = &[0.0; 3][..pairs];
        let case = LoadCase { load: &load, prescribed: None, gap, law, reference_slip: None };
        let settings = Settings::default();
        let solution = model.solve(&case, &settings, None, &mut Monitor::new(&settings, None));
        assert!(!none.load(Relaxed), "{seed}");
        let solution = solution.unwrap();
        assert_ne!(solution.status, Status::Solved, "{seed}: {}", solution.message);
    }
}
