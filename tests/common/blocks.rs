//! Blocks of bricks on a plane, pressed and moved in several ways, solved and measured.

use signorini::{Method, Model, Monitor, Settings, Solution, Status};

use super::brick::{Brick, Support, Vector};
use super::measures::{eta, rounding};
use super::problems::Case;

pub const TOLERANCE: f64 = 1e-12;

/// Coefficients of friction.
pub const MU: [f64; 4] = [0.1, 0.3, 1.0, 3.0];

/// How far the plate goes down, for a block of the height 1: strains of a twentieth.
pub const PRESS: f64 = 0.05;

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Loading {
    Shift,
    Twist,
    Tilt,
    WavyGaps,
    LiftedRim,
}

pub const LOADINGS: [Loading; 5] =
    [Loading::Shift, Loading::Twist, Loading::Tilt, Loading::WavyGaps, Loading::LiftedRim];

/// A block of 2 x 2 on the plane, with `n²` pairs; bricks are about cubes.
pub fn block(n: usize, support: Support) -> Brick {
    Brick::new([n - 1, n - 1, n.div_ceil(2)], [2.0, 2.0, 1.0], support)
}

/// A block whose plate presses and moves along the plane as far as friction makes slip and stick meet;
/// that of a column bends it until it nearly tips, or does.
pub fn loaded(brick: &Brick, model: &Model, loading: Loading, mu: f64) -> Case {
    let [x, _, height] = brick.nodes[brick.nodes.len() - 1];
    let press = PRESS * height;
    let slide = mu * press;
    let bend = slide * (height / (2.0 * x)).max(1.0);
    let motion = |[x, y, _]: Vector| match loading {
        Loading::Shift => [1.5 * bend, 0.5 * bend, -press],
        Loading::Twist => [-2.0 * slide * y, 2.0 * slide * x, -press],
        Loading::Tilt => [bend, 0.0, -press * (1.0 + x + 0.3 * y)],
        Loading::WavyGaps => [0.5 * bend - slide * y, slide * x, -press],
        Loading::LiftedRim => [bend - 0.5 * slide * y, 0.5 * slide * x, -press],
    };
    let mut case = brick.case(model, motion, mu);
    for pair in 0..brick.pairs() {
        let [x, y, _] = brick.place(pair);
        case.gap[pair] = PRESS
            * match loading {
                Loading::WavyGaps => 0.4 * (5.0 * x).sin() * (4.0 * y + 1.0).cos(),
                Loading::LiftedRim => 0.8 * x.hypot(y).powi(2),
                _ => 0.0,
            };
    }
    case
}

pub fn solve(case: &Case, method: Method, start: Option<&[f64]>) -> Solution {
    let settings = Settings { method, tolerance: TOLERANCE, ..Settings::default() };
    let mut monitor = Monitor::new(&settings, None);
    signorini::solve(&case.problem(), &settings, start, &mut monitor).expect("the settings fit")
}

/// Why it is not solved, as measured here: to the tolerance and the rounding of another sum.
pub fn flaw(case: &Case, solution: &Solution) -> Option<String> {
    if solution.status != Status::Solved {
        return Some(solution.message.to_string());
    }
    let (eta, rounding) = (eta(case, &solution.d), rounding(case, &solution.d));
    (eta > TOLERANCE + rounding).then(|| format!("eta is {eta:e}, rounding {rounding:e}"))
}
