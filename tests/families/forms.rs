//! Bodies that contact alone holds, in each form of their problem: that no equilibrium exists is proved in every one
//! where rigid statics says so, and in none where it says otherwise.
//!
//! `SIGNORINI_FORMS=1000` tries so many of each kind.

use crate::common::brick::Vector;
use crate::common::contact_alone::{ContactAlone, KINDS};
use crate::common::dense::{dot, norm};
use crate::common::problems::uniform;
use crate::common::rigid_statics::{Statics, distance};
use crate::rows::Host;
use crate::wall::Wall;
use fastrand::Rng;
use signorini::{
    ContactData, ContactProblem, FrictionLaw, LoadCase, Model, Monitor, Settings, Solution, Status,
    solve,
};

/// Problems of each kind in the ordinary run.
const FEW: usize = 60;

/// The rest of the loads that no forces balance, relative to them: up to the first it is rounding, from the second on
/// it is not.
const ROUNDING: f64 = 1e-12;
const CLEAR: f64 = 1e-8;

fn count() -> usize {
    let wanted = std::env::var("SIGNORINI_FORMS").ok();
    wanted.map_or(FEW, |wanted| wanted.parse().expect("a number of problems"))
}

/// A host with loads and coefficients.
struct Problem {
    host: Host,
    load: Vec<f64>,
    gap: Vec<f64>,
    mu: Vec<f64>,
}

impl Problem {
    fn case(&self) -> LoadCase<'_> {
        let law = FrictionLaw::Coulomb(&self.mu);
        LoadCase { load: &self.load, prescribed: None, gap: &self.gap, law, reference_slip: None }
    }

    fn solved(&self, model: &Model) -> Solution {
        let settings = &Settings::default();
        model.solve(&self.case(), settings, None, &mut Monitor::new(settings, None)).unwrap()
    }

    /// The solution of each form, with its name; none if the model is refused.
    fn forms(&self) -> Vec<(&'static str, Solution)> {
        let Ok(condensed) = self.host.model() else { return vec![] };
        let mut all = vec![("condensed", self.solved(&condensed))];
        let mut add = |name, problem: &Problem| {
            all.extend(problem.host.model().ok().map(|model| (name, problem.solved(&model))));
        };
        add("in the opposite order", &self.reversed());
        if self.host.dim == 2 {
            [0.3, 1.0].into_iter().for_each(|angle| add("turned", &self.turned(angle)));
        }
        if condensed.dependent_pairs().is_empty() {
            let settings = Settings { full_space: true, ..Settings::default() };
            let full = self.host.model_with(&settings).unwrap();
            all.push(("in full space", self.solved(&full)));
            all.push(("dense", self.dense(&condensed)));
        }
        all
    }

    /// The condensed stiffness, solved by itself.
    fn dense(&self, model: &Model) -> Solution {
        let load = model.condensed_load(&self.load, None).unwrap();
        let data = ContactData {
            dim: self.host.dim,
            pairs: self.mu.len(),
            stiffness: model.stiffness(),
            ld: load.len(),
            load: &load,
            gap: &self.gap,
            law: FrictionLaw::Coulomb(&self.mu),
            reference_slip: None,
        };
        let settings = &Settings::default();
        let problem = ContactProblem::new(data).unwrap();
        solve(&problem, settings, None, &mut Monitor::new(settings, None)).unwrap()
    }

    /// In axes that are turned by an angle.
    fn turned(&self, angle: f64) -> Problem {
        let (sin, cos) = angle.sin_cos();
        let turn = |values: &[f64]| -> Vec<f64> {
            let each = values.chunks_exact(2);
            each.flat_map(|v| [cos * v[0] - sin * v[1], sin * v[0] + cos * v[1]]).collect()
        };
        let mut host = self.host.clone();
        let n = host.size();
        for _ in 0..2 {
            let columns: Vec<f64> = host.stiffness.chunks_exact(n).flat_map(turn).collect();
            let transposed = (0..n * n).map(|k| columns[k / n + n * (k % n)]);
            host.stiffness = transposed.collect();
        }
        host.normals = turn(&host.normals);
        host.tangents = host.tangents.map(|tangents| turn(&tangents));
        Problem { host, load: turn(&self.load), gap: self.gap.clone(), mu: self.mu.clone() }
    }

    /// The pairs in the opposite order.
    fn reversed(&self) -> Problem {
        let (mut host, dim) = (self.host.clone(), self.host.dim);
        host.rows.reverse();
        let vectors =
            |of: &[f64]| of.chunks_exact(dim).rev().flatten().copied().collect::<Vec<f64>>();
        host.normals = vectors(&host.normals);
        host.tangents = host.tangents.map(|tangents| vectors(&tangents));
        let back = |values: &[f64]| values.iter().rev().copied().collect();
        Problem { host, load: self.load.clone(), gap: back(&self.gap), mu: back(&self.mu) }
    }
}

/// Asserts of so many problems what statics says, for each that it decides; `make` makes one of a seed.
fn each_form_agrees(make: impl Fn(usize) -> (Problem, Statics)) {
    let (mut odd, mut driven, mut proved, mut solved) = (Vec::new(), 0, 0, 0);
    for seed in 0..count() {
        let (problem, statics) = make(seed);
        driven += usize::from(statics == Statics::Driven);
        for (form, solution) in problem.forms() {
            let is_proved = solution.status == Status::NoEquilibrium;
            proved += usize::from(is_proved);
            solved += usize::from(solution.status == Status::Solved);
            let agrees = match statics {
                Statics::Driven => is_proved,
                Statics::Balanced => !is_proved,
                Statics::Undecided => true,
            };
            if !agrees {
                odd.push(format!("{seed} {form}, {statics:?}: {}", solution.message));
            }
        }
    }
    println!("{driven} driven, {proved} forms proved, {solved} solved, {} odd", odd.len());
    assert!(odd.is_empty(), "{}", odd.join("\n"));
    assert!(driven > 0 && solved > 0);
}

/// If forces in the cones of the pairs balance the loads on rigid bricks.
fn statics(motions: &[Vec<f64>], problem: &Problem) -> Statics {
    let on_motions = |force: &[f64]| motions.iter().map(|r| dot(r, force)).collect::<Vec<f64>>();
    let loads = on_motions(&problem.load);
    let target: Vec<f64> = loads.iter().map(|load| load / norm(&loads)).collect();
    let normals = problem.host.normals.chunks_exact(2).zip(&problem.mu);
    let edges = problem.host.rows.iter().zip(normals).flat_map(|(row, (n, mu))| {
        [*mu, -mu].map(|slope| {
            let mut force = vec![0.0; problem.load.len()];
            for &(node, weight) in row {
                force[2 * node] += weight * (slope * n[1] - n[0]);
                force[2 * node + 1] -= weight * (slope * n[0] + n[1]);
            }
            on_motions(&force)
        })
    });
    match distance(&target, &edges.collect::<Vec<_>>()) {
        rest if rest <= ROUNDING => Statics::Balanced,
        rest if rest >= CLEAR => Statics::Driven,
        _ => Statics::Undecided,
    }
}

/// A wall with its answer.
fn random_wall(seed: usize, all_meet: bool) -> (Problem, Statics) {
    let rng = &mut Rng::with_seed(seed as u64);
    let (sizes, shift) = ([rng.usize(2..=4), rng.usize(1..=4)], uniform(rng, 0.1, 1.9));
    let wall = Wall::new(sizes, shift, rng.usize(0..=sizes[1]), all_meet);
    let (host, load) = (wall.host(), wall.load([uniform(rng, -1.0, 1.0), uniform(rng, -1.0, 0.5)]));
    let mu = uniform(rng, 0.2, 1.0) * [0.0, 0.1, 1.0, 2.0][seed % 4];
    let pairs = host.rows.len();
    let problem = Problem { host, load, gap: vec![0.0; pairs], mu: vec![mu; pairs] };
    let statics = statics(&wall.motions(), &problem);
    (problem, statics)
}

#[test]
fn walls_of_independent_pairs() {
    each_form_agrees(|seed| random_wall(seed, false));
}

/// Between abutments bricks press on each other without a load: a motion of such bricks that rounding makes must not
/// take away what drives the others.
#[test]
fn walls_of_dependent_pairs() {
    each_form_agrees(|seed| random_wall(seed, true));
}

#[test]
fn random_bodies() {
    each_form_agrees(|seed| {
        let kind = KINDS[seed % KINDS.len()];
        let bodies = ContactAlone::random(&mut Rng::with_seed(seed as u64), kind);
        let (whole, dim) = (&bodies.whole, bodies.raw.dim);
        let row = |&(slave, master): &(usize, Option<usize>)| {
            [(slave, 1.0)].into_iter().chain(master.map(|master| (master, -1.0))).collect()
        };
        let axes = |k: usize| {
            let own = |frame: &Vec<Vector>| frame[k][..dim].to_vec();
            whole.frames.iter().flat_map(own).collect::<Vec<f64>>()
        };
        let host = Host {
            dim,
            stiffness: whole.stiffness.clone(),
            fixed: vec![],
            rows: whole.nodes.iter().map(row).collect(),
            normals: axes(0),
            tangents: Some(axes(1)),
        };
        let mu = (0..bodies.raw.pairs).map(|pair| bodies.raw.law.of(pair)[0]).collect();
        let problem = Problem { host, load: whole.load.clone(), gap: bodies.raw.gap.clone(), mu };
        (problem, bodies.statics())
    });
}
