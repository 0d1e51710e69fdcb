//! A block that stands on a plane by friction alone, with six rigid motions: statics decides whether it
//! is in equilibrium. Coulomb's friction is the same in all directions of the plane.
//!
//! The block is 4 wide, presses with `N = 1` and has 25 pairs, one apart. Loads act on the pairs' nodes. To
//! those of a rigid block come loads that balance each other, and strain it: forces `K x` have no
//! resultant. So statics is that of the rigid block, and the displacements are not zero.

use std::f64::consts::{SQRT_2, TAU};

use crate::common::brick::{Brick, Support};
use crate::common::dense::{dot, largest, product};
use crate::common::measures::{eta, flaw_of_escape, force, motion, rounding};
use crate::common::problems::{Case, Law, vector};
use fastrand::Rng;
use signorini::{Method, Model, Settings, Solution, Status};

const MU: f64 = 0.4;

/// Half the width of the block.
const HALF: f64 = 2.0;

/// Sum of the squares of the pairs' distances from the axis: 25 pairs on {-2, …, 2}².
const POLAR: f64 = 100.0;

const TOLERANCE: f64 = 1e-10;

/// Directions of a push.
const ANGLES: u32 = 16;

/// Loads that balance each other, beside those of a pair's share `N / 25` of the pressure.
const INNER: f64 = 0.3 / 25.0;

struct Block {
    brick: Brick,
    model: Model,
    motions: [Vec<f64>; 6],
}

impl Block {
    /// The tangents lie halfway between the directions of the loads. A polygon of 16 corners in place of
    /// the disc of friction would be 2 % off there.
    fn new() -> Block {
        let mut brick = Brick::new([4, 4, 2], [2.0 * HALF, 2.0 * HALF, 2.0], Support::Free);
        let (sin, cos) = (TAU / f64::from(2 * ANGLES)).sin_cos();
        brick.tangents = Some(vec![[cos, sin, 0.0]; brick.pairs()]);
        let model = brick.model();
        let motions = brick.rigid_motions(&model);
        Block { brick, model, motions }
    }

    /// The block under the force `load` (down, along the two tangents x and y) of each pair by its
    /// place, and loads that balance each other.
    fn loaded(&self, seed: Option<u64>, load: impl Fn(f64, f64) -> [f64; 3]) -> Case {
        let pairs = self.brick.pairs();
        let loads = (0..pairs).map(|pair| {
            let [x, y, _] = self.brick.place(pair);
            let [down, along_x, along_y] = load(x, y);
            [along_x, along_y, -down]
        });
        let mut f = Brick::in_frames(&self.model, loads);
        let k = self.model.stiffness().to_vec();
        if let Some(seed) = seed {
            let inner = product(&k, &vector(&mut Rng::with_seed(seed), f.len()));
            let size = largest(&inner);
            f.iter_mut().zip(&inner).for_each(|(f, inner)| *f += INNER * inner / size);
        }
        Case {
            dim: 3,
            pairs,
            k,
            f,
            gap: vec![0.0; pairs],
            law: Law::Coulomb(vec![MU; pairs]),
            slip: None,
        }
    }

    /// The fault of an answer, if there is an equilibrium.
    fn unbalanced(&self, case: &Case, solution: &Solution) -> Option<String> {
        if solution.status != Status::Solved {
            return Some(format!("{:?}: {}", solution.status, solution.message));
        }
        let eta = eta(case, &solution.d);
        if eta > TOLERANCE + rounding(case, &solution.d) {
            return Some(format!("eta is {eta:e}"));
        }
        // The six balances: to 100 times the tolerance, for sums of 75 forces and arms up to 3.
        let force = force(case, &solution.d);
        let size = largest(&case.f);
        let lacking = |force: &[f64], r: &[f64]| {
            let balance = dot(force, r) + dot(&case.f, r);
            balance.abs() > 1e-8 * size
        };
        let returned = &solution.certificate.force;
        let bad = self.motions.iter().position(|r| lacking(&force, r) || lacking(returned, r));
        bad.map(|index| format!("the rigid motion {index} is not in balance"))
    }
}

fn solve(case: &Case) -> Solution {
    case.solve(&Settings {
        method: Method::Auto,
        tolerance: TOLERANCE,
        // Exact methods take some hundred systems at most; sweeps shall not take the time.
        max_iterations: 20_000,
        ..Settings::default()
    })
}

/// The fault of an answer, if there is no equilibrium.
fn unproved(case: &Case, solution: &Solution) -> Option<String> {
    if solution.status != Status::NoEquilibrium {
        return Some(format!("{:?}: {}", solution.status, solution.message));
    }
    flaw_of_escape(case, motion(solution))
}

fn report(what: &str, failed: &[String], of: usize) {
    println!("{what}: {} of {of} are right", of - failed.len());
    assert!(failed.is_empty(), "{what}: {} of {of} are wrong: {failed:#?}", failed.len());
}

/// `T < mu N` is held, `T > mu N` slides, whatever the direction. Close to the limit the motion of the proof
/// may slide only within the disc of friction itself.
fn push(ratios: [f64; 2]) {
    let block = Block::new();
    let (mut failed, mut count) = (Vec::new(), 0);
    for ratio in ratios {
        for step in 0..ANGLES {
            for seed in [None, Some(u64::from(step))] {
                let (sin, cos) = (TAU * f64::from(step) / f64::from(ANGLES)).sin_cos();
                let case =
                    block.loaded(seed, |_, _| [1.0, ratio * cos, ratio * sin].map(|f| f / 25.0));
                let solution = solve(&case);
                let flaw = match ratio < MU {
                    true => block.unbalanced(&case, &solution),
                    false => unproved(&case, &solution),
                };
                count += 1;
                failed.extend(flaw.map(|flaw| format!("T/N {ratio}, {step}, {seed:?}: {flaw}")));
            }
        }
    }
    report(&format!("pushed by T/N = {ratios:?}"), &failed, count);
}

#[test]
fn a_pushed_block_rests_below_the_limit_of_friction_and_slides_above() {
    push([0.399, 0.401]);
}

#[test]
fn the_limit_of_friction_is_sharp_to_a_few_parts_in_ten_thousand() {
    push([0.3999, 0.4001]);
}

/// The resultant of the pressure at the distance `arm` from the axis: it must press within the base, the
/// square of half the width 2.
#[test]
fn a_block_overturns_when_its_resultant_leaves_the_base() {
    let block = Block::new();
    let (mut failed, mut count) = (Vec::new(), 0);
    for step in 0..ANGLES {
        for (share, seed) in [(0.95, None), (0.95, Some(1)), (1.005, None), (1.005, Some(2))] {
            let (sin, cos) = (TAU * f64::from(step) / f64::from(ANGLES)).sin_cos();
            // 1.9 and 2.01 along the sides.
            let arm = share * HALF / sin.abs().max(cos.abs());
            // The sum of x² over the pairs is that of y², half the polar one.
            let tilt = 25.0 * arm / (POLAR / 2.0);
            let case =
                block.loaded(seed, |x, y| [(1.0 + tilt * (x * cos + y * sin)) / 25.0, 0.0, 0.0]);
            let solution = solve(&case);
            let flaw = match share < 1.0 {
                true => block.unbalanced(&case, &solution),
                false => unproved(&case, &solution),
            };
            count += 1;
            failed.extend(flaw.map(|flaw| format!("arm {arm}, {step}, {seed:?}: {flaw}")));
        }
    }
    report("overturning", &failed, count);
}

/// A moment about the normal.
fn spun(block: &Block, moment: f64, seed: Option<u64>) -> Case {
    let turn = moment / POLAR;
    block.loaded(seed, |x, y| [1.0 / 25.0, -turn * y, turn * x])
}

/// Under loads that the friction of each node's own pressure takes, the block that rests is a solution;
/// loads that balance each other, up to a third of the pressure, leave as much friction in all. Beyond
/// `mu N` times the half diagonal no pressures can hold it: only the four corners reach so far.
#[test]
fn a_spun_block_rests_below_the_limit_of_friction_and_turns_beyond_that_of_statics() {
    let block = Block::new();
    let corner = SQRT_2 * HALF;
    // |F_t| = M r / 100 is at most mu / 25 at the corners.
    let rest = MU / 25.0 * POLAR / corner;
    let statics = MU * corner;
    let (mut failed, mut count) = (Vec::new(), 0);
    for seed in [None, Some(1), Some(2), Some(3)] {
        for sign in [1.0, -1.0] {
            for share in [0.5, 0.9, 0.99] {
                let case = spun(&block, sign * share * rest, seed);
                let flaw = block.unbalanced(&case, &solve(&case));
                count += 1;
                failed.extend(flaw.map(|flaw| format!("rest {share}, {seed:?}: {flaw}")));
            }
            for share in [1.001, 1.01, 1.5] {
                let case = spun(&block, sign * share * statics, seed);
                let flaw = unproved(&case, &solve(&case));
                count += 1;
                failed.extend(flaw.map(|flaw| format!("statics {share}, {seed:?}: {flaw}")));
            }
        }
    }
    report("spin", &failed, count);
}

/// Below the limit of statics some pressures hold the block, and no motion proves the contrary.
#[test]
fn no_proof_contradicts_statics() {
    let block = Block::new();
    for share in [0.9, 0.999] {
        let case = spun(&block, share * MU * SQRT_2 * HALF, None);
        let solution = solve(&case);
        assert_ne!(solution.status, Status::NoEquilibrium, "{share}: {}", solution.message);
    }
}
