//! Curved bodies that contact alone holds, pressed on a block and pushed.
//!
//! A push rolls such a body until its contact stands under the resultant of weight and push, which the shapes here
//! allow before their edge is reached; friction carries a push of less than `mu` times the weight. So each has an
//! equilibrium. `SIGNORINI_ROLLING=1` runs all of them.

use crate::common::problems::uniform;
use crate::common::rolling::{Rolling, Shape, Side};
use fastrand::Rng;
use signorini::{Settings, State, Status};

/// The effort of a load case.
struct Effort {
    systems: Vec<u64>,
    failed: Vec<String>,
}

impl Effort {
    fn new() -> Effort {
        Effort { systems: Vec::new(), failed: Vec::new() }
    }

    fn add(&mut self, body: &Rolling, loads: (f64, [f64; 2]), mu: f64, context: &str) {
        let (weight, push) = loads;
        let begin = std::time::Instant::now();
        let solution = body.solve(weight, push, mu, &Settings::default());
        let closed = solution.certificate.states.iter().filter(|s| **s != State::Open).count();
        println!(
            "{context}: mu {mu}, push {push:.4?}: {} systems, {closed} of {} closed, {:.3} s, {:?} {}",
            solution.factorisations,
            body.gap.len(),
            begin.elapsed().as_secs_f64(),
            solution.method,
            solution.message
        );
        if solution.status != Status::Solved {
            self.failed.push(format!("{context}: mu {mu}, push {push:?}: {}", solution.message));
        }
        self.systems.push(solution.factorisations);
    }

    /// The median and the largest number of systems.
    fn systems(mut self) -> (u64, u64) {
        assert!(
            self.failed.is_empty(),
            "{} of {}: {:#?}",
            self.failed.len(),
            self.systems.len(),
            self.failed
        );
        self.systems.sort_unstable();
        let all = &self.systems;
        println!(
            "{} load cases: median {}, most {}",
            all.len(),
            all[all.len() / 2],
            all[all.len() - 1]
        );
        (all[all.len() / 2], all[all.len() - 1])
    }
}

/// A half cylinder of radius 10 with 138 pairs. Twenty loads that friction carries, each pair with the coefficient that
/// stands before it.
#[test]
fn a_half_cylinder_on_a_block() {
    let shape = Shape {
        side: Side::Cylinder(10.0),
        size: [9.0, 5.0, 10.0],
        cells: [22, 5, 6],
        young: [2e5, 2e5],
    };
    let body = shape.model();
    assert_eq!(body.gap.len(), 138);
    let loads = [
        (0.1, [100.0, 300.0, 500.0, 700.0]),
        (0.2, [100.0, 500.0, 1000.0, 1500.0]),
        (0.3, [200.0, 800.0, 1400.0, 2000.0]),
        (0.5, [300.0, 900.0, 1500.0, 2000.0]),
        (1.0, [100.0, 700.0, 1300.0, 2000.0]),
    ];
    let mut effort = Effort::new();
    for (mu, pushes) in loads {
        for push in pushes {
            effort.add(&body, (8000.0, [push, 0.0]), mu, "half cylinder");
        }
    }
    let (median, most) = effort.systems();
    assert!(median <= 40 && most <= 200, "median {median}, most {most}");
}

/// Bodies that roll: a ball, a cylinder and the foot of a rocker, whose curvature is that of a larger circle than its
/// height; two stiffnesses of body and block, and pushes of .3 to .95 of `mu` times the weight along random directions.
/// In the ordinary run one in ten.
#[test]
fn rolling_bodies() {
    let all = std::env::var("SIGNORINI_ROLLING").is_ok();
    let sides = [
        (Side::Ball(1.25), [0.7, 0.7, 0.6], [10, 10, 3]),
        (Side::Cylinder(1.25), [1.0, 0.6, 0.7], [20, 7, 3]),
        (Side::Cylinder(3.0), [1.0, 0.7, 0.7], [24, 9, 3]),
    ];
    let mut rng = Rng::with_seed(1);
    let mut effort = Effort::new();
    for (kind, (side, size, cells)) in sides.into_iter().enumerate() {
        for young in [[1e3, 1e3], [1e5, 1e4]] {
            let body = Shape { side, size, cells, young }.model();
            for number in 0..17 {
                let mu = uniform(&mut rng, 0.1, 1.0);
                let push = uniform(&mut rng, 0.3, 0.95) * mu;
                // A cylinder is not pushed far along its axis, about which nothing rolls.
                let angle = match side {
                    Side::Ball(_) => uniform(&mut rng, 0.0, 6.3),
                    Side::Cylinder(_) => uniform(&mut rng, -0.5, 0.5),
                };
                let push = [push * angle.cos(), push * angle.sin()];
                if all || number % 8 == 0 {
                    effort.add(&body, (1.0, push), mu, &format!("kind {kind}, {young:?}"));
                }
            }
        }
    }
    effort.systems();
}
