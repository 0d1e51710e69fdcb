//! Random load cases of bodies that contact alone holds, in full space and condensed: nothing is called solved in one
//! form that has no equilibrium, and what both solve has the same forces.

use crate::common::dense::{difference, largest};
use crate::common::problems::uniform;
use crate::common::stack::Stack;
use fastrand::Rng;
use signorini::{FrictionLaw, LoadCase, Monitor, Settings, Status};

/// Random meshes, loads up to and beyond what friction carries, gaps and slips, coefficients up to 4. Forces are
/// compared up to 1: above, a second solution may be as good.
#[test]
fn random_stacks_have_the_same_answers_as_condensed() {
    let (mut both, mut dense_alone, mut full_alone, mut none) = (0, 0, 0, 0);
    for seed in 0..160 {
        let mut rng = Rng::with_seed(seed);
        let columns = [rng.usize(2..12), rng.usize(2..16)];
        let young = [2000.0, 2000.0 * 10_f64.powf(uniform(&mut rng, -1.0, 1.0))];
        let stack = Stack::new(columns, young);
        let pairs = columns[1] + 1;
        let mu: Vec<f64> = match seed % 4 {
            0 => vec![0.0; pairs],
            1 => (0..pairs).map(|_| uniform(&mut rng, 0.05, 1.0)).collect(),
            2 => vec![uniform(&mut rng, 0.05, 1.0); pairs],
            _ => vec![uniform(&mut rng, 1.0, 4.0); pairs],
        };
        let shear = uniform(&mut rng, 0.0, 9.0) * mu[0];
        let mut load = stack.load(7.0, shear);
        stack.mesh.traction(
            &stack.upper.row(3)[..2],
            [0.0, uniform(&mut rng, -20.0, 5.0)],
            &mut load,
        );
        let gap: Vec<f64> = (0..pairs).map(|_| uniform(&mut rng, -1e-3, 3e-3)).collect();
        let slip: Vec<f64> = (0..pairs).map(|_| uniform(&mut rng, -1e-3, 1e-3)).collect();
        let case = LoadCase {
            load: &load,
            prescribed: None,
            gap: &gap,
            law: FrictionLaw::Coulomb(&mu),
            reference_slip: Some(&slip),
        };
        let [dense, full] = [false, true].map(|full_space| {
            let settings = Settings { full_space, ..Settings::default() };
            let monitor = &mut Monitor::new(&settings, None);
            let stiffness = stack.mesh.stiffness();
            let pairs = stack.pairs();
            let model = stiffness.model_under(&stack.bottom(), &pairs.view(), monitor).unwrap();
            let monitor = &mut Monitor::new(&settings, None);
            model.solve(&case, &settings, None, monitor).unwrap()
        });
        let context = format!("seed {seed}: {} / {}", dense.message, full.message);
        match (dense.status, full.status) {
            (Status::Solved, Status::Solved) => both += 1,
            (Status::Solved, _) => {
                println!("{context}");
                dense_alone += 1;
            }
            (Status::NoEquilibrium, status) => {
                assert_ne!(status, Status::Solved, "{context}");
                none += 1;
            }
            (_, status) => full_alone += usize::from(status == Status::Solved),
        }
        // Certified to 1e-10 of the loads; a body on few points turns these into ten times larger forces.
        let largest_mu = mu.iter().fold(0.0, |most: f64, mu| most.max(*mu));
        if dense.status == full.status && full.status == Status::Solved && largest_mu <= 1.0 {
            let (a, b) = (&full.certificate.force, &dense.certificate.force);
            let apart = largest(&difference(a, b)) / largest(b);
            assert!(apart <= 1e-8, "{context}: {apart:e}");
        }
    }
    println!(
        "both {both}, condensed alone {dense_alone}, full space alone {full_alone}, none {none}"
    );
    assert!(both >= 100 && dense_alone <= 8, "both {both}, condensed alone {dense_alone}");
}
