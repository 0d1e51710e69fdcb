//! Blocks of bricks on a plane, with friction in space: pressed, shifted, twisted, tilted, on a wavy plane
//! and with a lifted rim. Newton's method solves them from nothing in a few linear systems.

use std::f64::consts::TAU;

use crate::common::blocks::{LOADINGS, Loading, MU, PRESS, TOLERANCE, block, flaw, loaded, solve};
use crate::common::brick::{Brick, Support, Vector};
use crate::common::dense::{difference, largest};
use crate::common::measures::most_with_one_solution;
use crate::common::problems::vector;
use fastrand::Rng;
use nalgebra::DMatrix;
use signorini::{Method, Model, Settings, State};

/// Systems for a block, and for a slender column, whose condition number is up to 4e6.
const SYSTEMS: u64 = 7;
const SYSTEMS_OF_COLUMNS: u64 = 10;

/// Systems for a step of a load history.
const SYSTEMS_OF_STEPS: u64 = 5;

/// Solves a block under all loadings and coefficients by Newton's method, each in at most `most` systems.
/// Returns how many pairs are open, stick and slip, in all.
fn by_newton(brick: &Brick, model: &Model, most: u64) -> [usize; 3] {
    let (mut counts, mut failed) = ([0; 3], Vec::new());
    let height = brick.nodes[brick.nodes.len() - 1][2];
    for loading in LOADINGS {
        for mu in MU {
            let case = loaded(brick, model, loading, mu);
            let solution = solve(&case, Method::Newton, None);
            let pairs = brick.pairs();
            let what = format!("{pairs} pairs, height {height}, {loading:?}, mu {mu}");
            let states = [State::Open, State::Stick, State::Slip];
            let here = states.map(|state| solution.certificate.count(state));
            println!("{what}: {} systems, open, stick, slip {here:?}", solution.factorisations);
            if let Some(flaw) = flaw(&case, &solution) {
                failed.push(format!("{what}: {flaw}"));
            } else if solution.factorisations > most {
                failed.push(format!("{what}: {} systems", solution.factorisations));
            }
            counts.iter_mut().zip(here).for_each(|(all, here)| *all += here);
        }
    }
    assert!(failed.is_empty(), "{} failed: {failed:#?}", failed.len());
    counts
}

/// The families are worth solving: a fair part of the pairs is in each state.
fn assert_mixed([open, stick, slip]: [usize; 3]) {
    let all = open + stick + slip;
    assert!(open > all / 20 && stick > all / 5 && slip > all / 5, "{open} {stick} {slip}");
}

#[test]
fn newton_solves_blocks_in_a_few_systems() {
    for n in [5, 15] {
        let brick = block(n, Support::Clamped);
        assert_mixed(by_newton(&brick, &brick.model(), SYSTEMS));
    }
    // A stiffness of the springs as that of the block: E times an area of 4 over 25 nodes.
    let brick = block(5, Support::Springs(4.0 / 25.0));
    assert_mixed(by_newton(&brick, &brick.model(), SYSTEMS));
}

#[test]
fn newton_solves_a_block_of_961_pairs() {
    let brick = block(31, Support::Clamped);
    assert_mixed(by_newton(&brick, &brick.model(), SYSTEMS));
}

/// Columns of 25 pairs, 10 to 40 times as high as wide: bending is as much softer than the contact.
#[test]
fn newton_solves_slender_columns() {
    let mut worst = 0.0;
    for slenderness in [10, 20, 40] {
        let size = [1.0, 1.0, slenderness as f64];
        let brick = Brick::new([4, 4, 2 * slenderness], size, Support::Clamped);
        let model = brick.model();
        let n = 3 * brick.pairs();
        let values = DMatrix::from_column_slice(n, n, model.stiffness()).symmetric_eigenvalues();
        worst = values.max() / values.min();
        println!("slenderness {slenderness}: condition number {worst:.1e}");
        assert_mixed(by_newton(&brick, &model, SYSTEMS_OF_COLUMNS));
    }
    assert!(worst > 3e6, "the columns are slender: {worst:e}");
}

/// A block that is pressed and whose plate then goes round a circle, each step from the slip and the
/// displacements of the one before. Where theory has one solution, starts change nothing: both answers
/// obey the law to 1e-12, which the condition number of the block, 56, makes 1e-10 of the displacements.
#[test]
fn a_warm_start_takes_few_systems_and_changes_nothing() {
    let (brick, steps) = (block(15, Support::Clamped), 20);
    let model = brick.model();
    let limit = most_with_one_solution(&brick.case(&model, |_| [0.0; 3], 0.0));
    for mu in [0.15, 0.3, 1.0] {
        let mut slip = vec![0.0; 2 * brick.pairs()];
        let mut last: Option<Vec<f64>> = None;
        let (mut systems, mut slipping) = (Vec::new(), 0);
        for step in 0..=steps {
            let (sin, cos) = (TAU * f64::from(step) / f64::from(steps)).sin_cos();
            let slide = 1.5 * mu * PRESS;
            let mut case = brick.case(&model, |_| [slide * cos, slide * sin, -PRESS], mu);
            case.slip = Some(slip.clone());
            let warm = solve(&case, Method::Newton, last.as_deref());
            let cold = solve(&case, Method::Newton, None);
            assert_eq!((flaw(&case, &warm), flaw(&case, &cold)), (None, None), "{mu}, step {step}");
            let apart = largest(&difference(&warm.d, &cold.d)) / largest(&cold.d);
            assert!(mu > limit || apart <= 1e-9, "mu {mu}, step {step}: {apart:e}");
            if step > 0 {
                systems.push(warm.factorisations);
                slipping += warm.certificate.count(State::Slip);
            }
            // The next slip counts from here: pairs that stick have not moved, open ones have no
            // friction.
            slip = warm.d.chunks_exact(3).flat_map(|d| [d[1], d[2]]).collect();
            last = Some(warm.d);
        }
        systems.sort_unstable();
        println!("mu {mu}: {systems:?} systems, {slipping} slips in all");
        assert!(systems.iter().all(|&systems| systems <= SYSTEMS_OF_STEPS), "mu {mu}: {systems:?}");
    }
    assert!(limit > 0.15, "theory has one solution up to {limit}");
}

/// Where theory has one solution every start leads to it, near or far.
#[test]
fn the_start_changes_nothing_where_there_is_one_solution() {
    let brick = block(5, Support::Clamped);
    let model = brick.model();
    let mu = 0.9 * most_with_one_solution(&brick.case(&model, |_| [0.0; 3], 0.0));
    for loading in LOADINGS {
        let case = loaded(&brick, &model, loading, mu);
        let cold = solve(&case, Method::Newton, None);
        assert_eq!(flaw(&case, &cold), None, "{loading:?}");
        for seed in 0..40 {
            let mut rng = Rng::with_seed(seed);
            let size = PRESS * 10_f64.powi(rng.i32(-3..=3));
            let start: Vec<f64> = vector(&mut rng, case.size()).iter().map(|d| size * d).collect();
            let other = solve(&case, Method::Newton, Some(&start));
            assert_eq!(flaw(&case, &other), None, "{loading:?}, seed {seed}");
            let apart = largest(&difference(&other.d, &cold.d)) / largest(&cold.d);
            assert!(apart <= 1e-9, "{loading:?}, seed {seed}, start {size:e}: {apart:e}");
        }
    }
}

/// A symmetric block under symmetric loads has pairs that change together, and friction of 30 wedges.
#[test]
fn symmetric_blocks_with_much_friction_are_solved() {
    let (brick, mu) = (block(5, Support::Clamped), 30.0);
    let model = brick.model();
    let motions: [fn(Vector) -> Vector; 5] = [
        |_| [0.0, 0.0, -PRESS],
        |_| [PRESS, 0.0, -PRESS],
        |_| [PRESS, PRESS, -PRESS / 10.0],
        |[x, y, _]| [-PRESS * y, PRESS * x, -PRESS / 10.0],
        |[x, _, _]| [PRESS, 0.0, -PRESS * x],
    ];
    for (index, motion) in motions.into_iter().enumerate() {
        for lifted in [0.0, 0.5] {
            let mut case = brick.case(&model, motion, mu);
            for pair in 0..brick.pairs() {
                let [x, y, _] = brick.place(pair);
                case.gap[pair] = lifted * PRESS * (x * x + y * y);
            }
            let flaw = flaw(&case, &solve(&case, Method::Auto, None));
            assert_eq!(flaw, None, "motion {index}, rim lifted by {lifted}");
        }
    }
}

/// Fine meshes with much friction, where a line search alone comes to a halt between branches: a path
/// takes some tens of systems. Sweeps, which may take thousands, are cut short.
#[test]
fn fine_blocks_with_much_friction_are_solved() {
    let hard = [
        (17, Loading::Tilt, 10.0),
        (22, Loading::Twist, 3.0),
        (22, Loading::Shift, 10.0),
        (23, Loading::Tilt, 10.0),
    ];
    let settings = Settings { tolerance: TOLERANCE, max_iterations: 500, ..Settings::default() };
    let mut failed = Vec::new();
    for (n, loading, mu) in hard {
        let brick = block(n, Support::Clamped);
        let case = loaded(&brick, &brick.model(), loading, mu);
        let solution = case.solve(&settings);
        let what = format!("{} pairs, {loading:?}, mu {mu}", n * n);
        println!("{what}: {:?}, {} systems", solution.method, solution.factorisations);
        failed.extend(flaw(&case, &solution).map(|flaw| format!("{what}: {flaw}")));
    }
    assert!(failed.is_empty(), "{failed:#?}");
}
