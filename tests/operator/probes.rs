//! The vectors by which an operator is checked, and the units that it is measured in.

use std::sync::{Arc, Mutex};

use signorini::reduce::{HostOperator, OperatorReduction, Reduction};

/// Springs of the three directions of each pair, and the vectors that they were asked for.
struct Springs {
    each: [f64; 3],
    asked: Arc<Mutex<Vec<Vec<f64>>>>,
}

impl HostOperator for Springs {
    fn stiffness(&self, x: &[f64], y: &mut [f64]) -> Result<(), i32> {
        self.asked.lock().unwrap().push(x.to_vec());
        (0..x.len()).for_each(|i| y[i] = self.each[i % 3] * x[i]);
        Ok(())
    }

    fn has_inverse(&self) -> bool {
        true
    }

    fn inverse(&self, x: &[f64], y: &mut [f64]) -> Result<(), i32> {
        y.copy_from_slice(x);
        Ok(())
    }
}

/// The units of so many pairs on springs, and the probes: the first two vectors.
fn measured(each: [f64; 3], pairs: usize) -> (Option<Vec<f64>>, Vec<Vec<f64>>) {
    let asked = Arc::new(Mutex::new(Vec::new()));
    let host = Springs { each, asked: asked.clone() };
    let reduction = OperatorReduction::new(Box::new(host), (3, pairs), None).ok();
    let units = |reduction: &OperatorReduction| reduction.bodies().unwrap().units().to_vec();
    let mut asked = std::mem::take(&mut *asked.lock().unwrap());
    asked.truncate(2);
    (reduction.as_ref().map(units), asked)
}

/// Sizes between 1 and 2 with the mean 1.5, as many of one sign as of the other, neighbours and two probes
/// without a relation: sums of 4095 independent numbers are within five of their deviations.
#[test]
fn probes_have_no_pattern() {
    let (_, probes) = measured([1.0; 3], 1365);
    let root = (probes[0].len() as f64).sqrt();
    for (k, x) in probes.iter().enumerate() {
        assert!(x.iter().all(|x| (1.0..=2.0).contains(&x.abs())));
        let sum = |of: fn(f64) -> f64| x.iter().map(|x| of(*x)).sum::<f64>();
        assert!(sum(f64::signum).abs() <= 5.0 * root);
        assert!((sum(f64::abs) - 1.5 * x.len() as f64).abs() <= 5.0 * root / 12.0_f64.sqrt());
        let y = &probes[1 - k];
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
    let units = |each: [f64; 3]| measured(each, 10).0;
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
