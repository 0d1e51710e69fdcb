//! A host may offer one of the two kinds of solutions alone, and its own units: pairs that do not feel each other
//! have closed forms.

use signorini::reduce::{self, HostOperator};
use signorini::{FrictionLaw, LoadCase, Model, Monitor, Settings, Status};

/// Normal and tangential stiffness of every pair.
const STIFFNESS: [f64; 2] = [2.0, 1.0];

/// One pair that sticks, one that is open, one that slips.
const LOAD: [f64; 6] = [4.0, 0.3, -1.0, 0.7, 4.0, 3.0];
const GAP: [f64; 3] = [1.0, 0.5, 1.0];
const MU: f64 = 0.5;

/// A closed pair is at its gap and carries `F_n = k_n gap - f_n = -2`. The first one's load is below `mu 2 = 1`; that
/// of the third is above, so that `F_t = -1` and `d_t = (3 - 1) / k_t`. The second one moves by its loads alone.
const D: [f64; 6] = [1.0, 0.0, -0.5, 0.7, 1.0, 2.0];
const F: [f64; 6] = [-2.0, -0.3, 0.0, 0.0, -2.0, -1.0];

fn product(x: &[f64], y: &mut [f64]) {
    (0..x.len()).for_each(|i| y[i] = STIFFNESS[i % 2] * x[i]);
}

/// Products and inverse alone.
struct Inverse;

impl HostOperator for Inverse {
    fn stiffness(&self, x: &[f64], y: &mut [f64]) -> Result<(), i32> {
        product(x, y);
        Ok(())
    }

    fn has_inverse(&self) -> bool {
        true
    }

    fn inverse(&self, x: &[f64], y: &mut [f64]) -> Result<(), i32> {
        (0..x.len()).for_each(|i| y[i] = x[i] / STIFFNESS[i % 2]);
        Ok(())
    }
}

/// Products and solutions with components held alone.
struct Held;

impl HostOperator for Held {
    fn stiffness(&self, x: &[f64], y: &mut [f64]) -> Result<(), i32> {
        product(x, y);
        Ok(())
    }

    fn has_held(&self) -> bool {
        true
    }

    fn held(&self, held: &reduce::Held<'_>, x: &[f64], y: &mut [f64]) -> Result<(), i32> {
        let held = held.components;
        (0..x.len()).for_each(|i| y[i] = if held[i] { 0.0 } else { x[i] / STIFFNESS[i % 2] });
        Ok(())
    }
}

fn hosts() -> [Box<dyn HostOperator>; 2] {
    [Box::new(Inverse), Box::new(Held)]
}

/// Products with an error of this part, which is not symmetric: as of an inner iteration.
struct Inexact(f64);

/// The accuracy of that host, which its products keep.
const ACCURACY: f64 = 1e-5;

impl HostOperator for Inexact {
    fn accuracy(&self) -> f64 {
        self.0
    }

    fn stiffness(&self, x: &[f64], y: &mut [f64]) -> Result<(), i32> {
        product(x, y);
        y[0] += 0.1 * ACCURACY * x[1];
        Ok(())
    }

    fn has_inverse(&self) -> bool {
        true
    }

    fn inverse(&self, x: &[f64], y: &mut [f64]) -> Result<(), i32> {
        Inverse.inverse(x, y)
    }
}

/// What is not symmetric by less than the accuracy that the host tells is taken, and the answers are those to a tolerance
/// above it; without that accuracy it is refused, and so is one that is none.
#[test]
fn what_a_host_agrees_to_is_its_own_accuracy() {
    let made = |accuracy| Model::operator(2, 3, Box::new(Inexact(accuracy)), None);
    let words = |accuracy| made(accuracy).err().unwrap().message().to_string();
    assert!(words(1e-9).contains("K_rel is not symmetric"), "{}", words(1e-9));
    for wrong in [0.0, 1.0, -1.0, f64::NAN] {
        assert!(words(wrong).contains("it must be between 0 and 1"), "{}", words(wrong));
    }
    let (model, mu) = (made(ACCURACY).unwrap(), [MU; 3]);
    let law = FrictionLaw::Coulomb(&mu);
    let case = LoadCase { load: &LOAD, prescribed: None, gap: &GAP, law, reference_slip: None };
    let settings = Settings { tolerance: 10.0 * ACCURACY, ..Settings::default() };
    let monitor = &mut Monitor::new(&settings, None);
    let solution = model.solve(&case, &settings, None, monitor).unwrap();
    assert_eq!(solution.status, Status::Solved, "{}", solution.message);
    for (i, d) in D.iter().enumerate() {
        // The tolerance of all forces, which are of the size of 10.
        assert!((solution.d[i] - d).abs() <= 100.0 * ACCURACY, "d[{i}]: {}", solution.d[i]);
    }
}

/// A trait's own answers say that the host does not offer a kind.
#[test]
fn what_is_not_offered_fails() {
    let (x, y) = ([1.0; 6], &mut [0.0; 6]);
    let nothing = reduce::Held { components: &[false; 6], springs: &[], changed: true };
    assert!(!Inverse.has_held() && Inverse.held(&nothing, &x, y).is_err());
    assert!(!Held.has_inverse() && Held.inverse(&x, y).is_err());
}

/// One kind of solutions is enough, with the units of the host and without.
#[test]
fn one_kind_of_solutions_is_enough() {
    let units = STIFFNESS.repeat(3);
    for units in [None, Some(units.as_slice())] {
        for host in hosts() {
            let model = Model::operator(2, 3, host, units).unwrap();
            let mu = [MU; 3];
            let law = FrictionLaw::Coulomb(&mu);
            let case =
                LoadCase { load: &LOAD, prescribed: None, gap: &GAP, law, reference_slip: None };
            let settings = Settings::default();
            let monitor = &mut Monitor::new(&settings, None);
            let solution = model.solve(&case, &settings, None, monitor).unwrap();
            assert_eq!(solution.status, Status::Solved, "{}", solution.message);
            for (i, (d, f)) in D.iter().zip(&F).enumerate() {
                // The tolerance asked for is 1e-10 of all forces, which are of the size of 1.
                assert!((solution.d[i] - d).abs() <= 1e-9, "d[{i}]: {}", solution.d[i]);
                let force = solution.certificate.force[i];
                assert!((force - f).abs() <= 1e-9, "F[{i}]: {force}");
            }
            // Displacements and forces of the host are those of the pairs.
            assert_eq!(model.host_size(), 6);
            assert_eq!(model.condensed_load(&LOAD, None).unwrap(), LOAD);
            assert_eq!(model.nodal_forces(&F).unwrap(), F);
        }
    }
}

/// No pairs, nothing to ask.
#[test]
fn no_pairs_are_a_model() {
    for host in hosts() {
        let model = Model::operator(2, 0, host, None).unwrap();
        assert_eq!((model.pairs(), model.host_size()), (0, 0));
    }
}
