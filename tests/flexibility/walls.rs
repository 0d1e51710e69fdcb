//! Walls of bricks that nothing but the floor and each other hold: at corners that meet, rows depend on each other.

use crate::common::problems::uniform;
use crate::wall::Wall;
use fastrand::Rng;
use signorini::{FrictionLaw, LoadCase, Monitor, Settings, Status};

/// Loads near the limit of what friction balances: with some the wall slides or turns for ever, though statics alone does not
/// show it. Nothing is found then, and the call ends when the default method, sweeps too, has failed once and is no nearer: springs
/// in series, let go or not, would go on for `max_iterations`. Sweeps are told to be hopeless after some 15,000.
#[test]
fn a_wall_without_a_solution_ends_soon() {
    let mut statuses = [0; 3];
    for seed in 0..150 {
        let rng = &mut Rng::with_seed(seed);
        let wall = Wall::new([rng.usize(2..=3), rng.usize(1..=4)], 0.7, 0, true);
        let host = wall.host();
        let load = wall.load([uniform(rng, -1.0, 1.0), uniform(rng, -1.0, 0.5)]);
        let mu = vec![uniform(rng, 0.2, 1.0); host.rows.len()];
        let model = host.model().unwrap();
        assert!(!model.dependent_pairs().is_empty());
        let gap = vec![0.0; mu.len()];
        let law = FrictionLaw::Coulomb(&mu);
        let case = LoadCase { load: &load, prescribed: None, gap: &gap, law, reference_slip: None };
        let settings = Settings::default();
        let mut monitor = Monitor::new(&settings, None);
        let solution = model.solve(&case, &settings, None, &mut monitor).unwrap();
        let context = format!("seed {seed}: {}", solution.message);
        match solution.status {
            Status::Solved => {
                host.assert_balanced(&model, &case, &solution, 1e-9);
                statuses[0] += 1;
            }
            Status::NoEquilibrium => statuses[1] += 1,
            Status::Stalled => {
                assert!(context.contains("wanted 1.0e-10"), "{context}");
                statuses[2] += 1;
            }
            _ => panic!("{context}"),
        }
        assert!(solution.iterations < 30_000, "{context}");
    }
    assert!(statuses.iter().all(|count| *count > 0), "{statuses:?}");
}
