//! Models in full space: the condensed matrix is never formed, and the answers are the same.

use crate::common::blocks::block;
use crate::common::brick::{Support, Vector};
use crate::common::dense::{difference, largest};
use crate::common::mesh::{Mesh, Pairs, steps};
use fastrand::Rng;
use signorini::{FrictionLaw, LoadCase, Model, Monitor, Settings, Solution, Status};

/// Settings of a model in full space.
fn full() -> Settings {
    Settings { full_space: true, ..Settings::default() }
}

/// Half of the bar on the plane (paper, section 4.1), refined towards the contact.
struct Bar {
    stiffness: crate::common::mesh::Stiffness,
    load: Vec<f64>,
    fixed: Vec<usize>,
    pairs: Pairs,
}

impl Bar {
    fn new(columns: usize) -> Bar {
        let mut heights = vec![40.0 / columns as f64];
        while heights.iter().sum::<f64>() < 40.0 {
            heights.push(1.25 * heights[heights.len() - 1]);
        }
        let stretch = 40.0 / heights.iter().sum::<f64>();
        let mut lines = vec![0.0];
        for height in &heights {
            lines.push(lines[lines.len() - 1] + stretch * height);
        }
        let mut mesh = Mesh::default();
        let block = mesh.block(&steps(0.0, 40.0, columns), &lines, (13000.0, 0.2));
        let mut load = vec![0.0; mesh.size()];
        mesh.traction(&block.row(block.rows), [0.0, -5.0], &mut load);
        mesh.traction(&block.column(0), [10.0, 0.0], &mut load);
        let fixed: Vec<usize> = block.column(columns).iter().map(|node| 2 * node).collect();
        let pairs = Pairs::on_obstacle(&block.row(0), [0.0, -1.0]);
        Bar { stiffness: mesh.stiffness(), load, fixed, pairs }
    }

    fn model(&self, settings: &Settings) -> Model {
        let monitor = &mut Monitor::new(settings, None);
        self.stiffness.model_under(&self.fixed, &self.pairs.view(), monitor).expect("a valid model")
    }
}

fn solved(model: &Model, case: &LoadCase<'_>) -> Solution {
    let settings = full();
    let solution =
        model.solve(case, &settings, None, &mut Monitor::new(&settings, None)).expect("a case");
    assert_eq!(solution.status, Status::Solved, "{}", solution.message);
    solution
}

/// Both forms are certified to 1e-10 of the forces; the displacements of these meshes follow forces with at most
/// ten times that.
fn same(full: &Solution, dense: &Solution, context: &str) {
    for (what, a, b) in
        [("d", &full.d, &dense.d), ("F", &full.certificate.force, &dense.certificate.force)]
    {
        let apart = largest(&difference(a, b)) / largest(b).max(f64::MIN_POSITIVE);
        assert!(apart <= 1e-9, "{context}: {what} is {apart:e} apart");
    }
}

#[test]
fn bars_have_the_same_answers_as_condensed() {
    for columns in [32, 128, 512] {
        let bar = Bar::new(columns);
        let (dense, full) = (bar.model(&Settings::default()), bar.model(&full()));
        let gap: Vec<f64> = (0..=columns)
            .map(|i| if columns == 128 { 2e-4 * (0.3 * i as f64).sin() } else { 0.0 })
            .collect();
        for mu in [0.0, 0.1, 0.3, 1.0] {
            let context = format!("{} pairs, mu {mu}", columns + 1);
            let mu = vec![mu; columns + 1];
            let case = LoadCase {
                load: &bar.load,
                prescribed: None,
                gap: &gap,
                law: FrictionLaw::Coulomb(&mu),
                reference_slip: None,
            };
            let (a, b) = (solved(&full, &case), solved(&dense, &case));
            println!(
                "{context}: {} systems, {} factorisations, {} solves",
                a.iterations, a.factorisations, a.outer_iterations
            );
            same(&a, &b, &context);
        }
    }
}

/// Blocks in space that are pressed, shifted and turned, or whose rim is lifted.
#[test]
fn blocks_have_the_same_answers_as_condensed() {
    for (nodes, lifted, support) in
        [(5, 0.0, Support::Clamped), (9, 0.04, Support::Springs(0.5)), (15, 0.04, Support::Clamped)]
    {
        let brick = block(nodes, support);
        let matrix = brick.stiffness();
        let model = |settings: &Settings| {
            brick.model_within(&matrix, None, &mut Monitor::new(settings, None)).unwrap()
        };
        let (dense, full) = (model(&Settings::default()), model(&full()));
        let gap: Vec<f64> = (0..brick.pairs())
            .map(|pair| lifted * brick.place(pair)[0].hypot(brick.place(pair)[1]).powi(2))
            .collect();
        for mu in [0.0, 0.1, 0.3, 1.0] {
            let motion = |[x, y, _]: Vector| {
                [0.02 * mu - 0.03 * mu * y, 0.01 * mu + 0.03 * mu * x, -0.05 * (1.0 + 0.3 * x)]
            };
            let (load, prescribed) = brick.moved(motion);
            let context = format!("{} pairs, mu {mu}", brick.pairs());
            let mu = vec![mu; brick.pairs()];
            let case = LoadCase {
                load: &load,
                prescribed: prescribed.as_deref(),
                gap: &gap,
                law: FrictionLaw::Coulomb(&mu),
                reference_slip: None,
            };
            let (a, b) = (solved(&full, &case), solved(&dense, &case));
            println!(
                "{context}: {} systems, {} factorisations, {} solves",
                a.iterations, a.factorisations, a.outer_iterations
            );
            same(&a, &b, &context);
        }
    }
}

/// Two blocks of very unlike stiffness, both held on their far sides, whose prescribed displacements and loads have the size that
/// the softer one bears. The stiffness is definite, so that there is a solution for every law and all data; the forces inside the
/// stiffer block are larger than the loads by as much, and rounding of displacements by as much as that.
#[test]
fn unlike_blocks_that_are_held_are_solved() {
    let rng = &mut Rng::with_seed(1);
    for problem in 0..200 {
        let ratio = 10_f64.powi([6, -3, 5, -5][problem % 4]);
        let mut mesh = Mesh::default();
        let x = steps(0.0, 1.0, rng.usize(1..5));
        let lower = mesh.block(&x, &steps(-1.0, 0.0, rng.usize(1..4)), (1.0, 0.3));
        let upper = mesh.block(&x, &steps(0.0, 1.0, rng.usize(1..4)), (ratio, 0.3));
        let held = [lower.row(0), upper.row(upper.rows)].concat();
        let fixed: Vec<usize> = held.iter().flat_map(|node| [2 * node, 2 * node + 1]).collect();
        let mut random = |size: f64, count: usize| -> Vec<f64> {
            (0..count).map(|_| size * (2.0 * rng.f64() - 1.0)).collect()
        };
        let (prescribed, load) = (random(0.01, fixed.len()), random(0.05, mesh.size()));
        let pairs = Pairs::matching(&upper.row(0), &lower.row(lower.rows), [0.0, -1.0]);
        let (gap, slip) = (random(0.02, pairs.count()), random(0.01, pairs.count()));
        let mu: Vec<f64> = random(1.0, pairs.count()).iter().map(|mu| mu.abs()).collect();
        let case = LoadCase {
            load: &load,
            prescribed: Some(&prescribed),
            gap: &gap,
            law: FrictionLaw::Coulomb(&mu),
            reference_slip: Some(&slip),
        };
        let settings = Settings { full_space: true, ..Settings::default() };
        let monitor = &mut Monitor::new(&settings, None);
        let model = mesh.stiffness().model_under(&fixed, &pairs.view(), monitor).expect("a model");
        let found = model.solve(&case, &settings, None, monitor).expect("a case");
        assert_eq!(found.status, Status::Solved, "{problem}, {ratio:e}: {}", found.message);
    }
}
