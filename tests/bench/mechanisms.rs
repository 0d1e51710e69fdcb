//! How often each attempt, fallback and special case of the solvers is asked, and how often it decides, on families of
//! problems that are hard.
//!
//! `cargo bench --features counters --bench mechanisms -- PROBLEMS`: as many problems of the classes at the edges of
//! double precision (default: 4800), and a share of that of the other families.

#[path = "../common/mod.rs"]
mod common;

use std::collections::BTreeMap;

use common::blocks::{LOADINGS, block, loaded as loaded_block};
use common::brick::Support;
use common::edges::problem;
use common::plane_families::{SUPPORTS, Structure};
use common::problems::{Case, Law, coulomb, decades, definite, floating_case, loaded, uniform};
use common::rolling::{Shape, Side};
use fastrand::Rng;
use signorini::{
    ContactData, ContactProblem, FrictionLaw, Model, Monitor, Settings, Status, counters,
};

/// Counts of a mechanism: how often asked, and how often decisive.
type Counts = BTreeMap<(&'static str, usize), [u64; 2]>;

/// Counts of a family's problems.
#[derive(Default)]
struct Family {
    problems: u64,
    solved: u64,
    proved: u64,
    counts: Counts,
}

impl Family {
    fn add(&mut self, status: Status) {
        self.problems += 1;
        self.solved += u64::from(status == Status::Solved);
        self.proved += u64::from(status == Status::NoEquilibrium);
        for (mechanism, [asked, decisive]) in counters::take() {
            let counts = self.counts.entry(mechanism).or_default();
            *counts = [counts[0] + asked, counts[1] + decisive];
        }
    }

    fn print(&self, name: &str) {
        let Family { problems, solved, proved, counts } = self;
        println!(
            "{name}: {problems} problems, {solved} solved, {proved} proved to have no equilibrium"
        );
        for ((mechanism, number), [asked, decisive]) in counts {
            println!("    {mechanism:40} {number:3}: asked {asked:6}, decides {decisive:6}");
        }
    }
}

fn solve(problem: &ContactProblem<'_>, tolerance: f64) -> Status {
    let settings = Settings { tolerance, ..Settings::default() };
    let mut monitor = Monitor::new(&settings, None);
    signorini::solve(problem, &settings, None, &mut monitor).expect("the settings fit").status
}

fn solve_case(case: &Case) -> Status {
    solve(&case.problem(), Settings::default().tolerance)
}

/// Random problems at the edges of double precision.
fn edges(problems: u64) -> Family {
    let mut family = Family::default();
    for seed in 0..problems {
        let mut given = problem(seed);
        if ContactProblem::new(given.case.data()).is_err() {
            // A host makes a model of a body on few points, which knows its rigid motions without rounding.
            let data = given.case.data();
            let model = Model::condensed(data.dim, data.pairs, data.stiffness, data.ld);
            given.case.k = model.expect("a model of the matrix").stiffness().to_vec();
        }
        family.add(solve(&given.case.problem(), given.tolerance));
    }
    family
}

/// Graded meshes in the plane.
fn plane(pairs: usize, problems: u64) -> Family {
    let mut family = Family::default();
    for support in SUPPORTS {
        let structure = Structure::new(support, pairs);
        for seed in 0..problems {
            let case = structure.case(&mut Rng::with_seed(seed));
            let problem = ContactProblem::new(ContactData {
                dim: 2,
                pairs,
                stiffness: &structure.stiffness,
                ld: 2 * pairs,
                load: &case.load,
                gap: &case.gap,
                law: FrictionLaw::Coulomb(&case.mu),
                reference_slip: case.slip.as_deref(),
            });
            family.add(solve(&problem.expect("the data is valid"), Settings::default().tolerance));
        }
    }
    family
}

/// Dense random matrices, up to 24 pairs, the condition number up to 1e6, `mu` up to 30.
fn dense(dim: usize, problems: u64) -> Family {
    let mut family = Family::default();
    for seed in 0..problems {
        let rng = &mut Rng::with_seed(seed);
        let pairs = rng.usize(1..=24);
        let condition = decades(rng, 6.0);
        let k = definite(rng, dim * pairs, condition);
        let most = uniform(rng, 0.0, 30.0);
        let law = coulomb(rng, pairs, most);
        family.add(solve_case(&loaded(rng, dim, k, law)));
    }
    family
}

/// Bodies that contact alone holds.
fn floating(problems: u64) -> Family {
    let mut family = Family::default();
    for seed in 0..problems {
        let rng = &mut Rng::with_seed(seed);
        let most = [0.3, 1.0, 3.0][rng.usize(0..3)];
        let law = |rng: &mut Rng, pairs: usize| -> Law { coulomb(rng, pairs, most) };
        family.add(solve_case(&floating_case(rng, 6.0, law)));
    }
    family
}

/// Blocks of bricks under a plate that shifts, twists and tilts.
fn blocks() -> Family {
    let mut family = Family::default();
    for n in [5, 9] {
        let brick = block(n, Support::Clamped);
        let model = brick.model();
        for loading in LOADINGS {
            for mu in [0.1, 0.3, 1.0, 3.0, 30.0] {
                family.add(solve_case(&loaded_block(&brick, &model, loading, mu)));
            }
        }
    }
    family
}

/// Half cylinders and balls on a block, pushed.
fn rolling() -> Family {
    let mut family = Family::default();
    for side in [Side::Cylinder(10.0), Side::Ball(20.0)] {
        let shape = Shape { side, size: [9.0, 5.0, 10.0], cells: [12, 4, 4], young: [2e5, 2e5] };
        let body = shape.model();
        for mu in [0.1, 0.3, 1.0] {
            for part in [0.1, 0.3, 0.5, 0.7, 0.9] {
                let weight = 8000.0;
                let push = [part * mu * weight, 0.0];
                family.add(body.solve(weight, push, mu, &Settings::default()).status);
            }
        }
    }
    family
}

fn main() {
    let mut numbers = std::env::args().filter_map(|argument| argument.parse().ok());
    let problems: u64 = numbers.next().unwrap_or(4800);
    let mut all = Family::default();
    let families: [(&str, &dyn Fn() -> Family); 8] = [
        ("edges of double precision", &|| edges(problems)),
        ("plane, 33 pairs", &|| plane(33, problems / 20)),
        ("plane, 129 pairs", &|| plane(129, problems / 80)),
        ("dense, 2D", &|| dense(2, problems / 2)),
        ("dense, 3D", &|| dense(3, problems / 2)),
        ("floating, 2D", &|| floating(problems / 2)),
        ("blocks, 3D", &blocks),
        ("rolling, 3D", &rolling),
    ];
    for (name, make) in families {
        counters::take();
        let family = make();
        family.print(name);
        all.problems += family.problems;
        all.solved += family.solved;
        all.proved += family.proved;
        for (mechanism, [asked, decisive]) in family.counts {
            let counts = all.counts.entry(mechanism).or_default();
            *counts = [counts[0] + asked, counts[1] + decisive];
        }
    }
    all.print("all");
}
