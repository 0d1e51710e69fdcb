//! The boundaries of the law's pieces, where a straight way crosses them, and how friction turns with a slip:
//! against their definitions, on random laws.

use crate::laws::{Numbers, uniform};
use fastrand::Rng;
use signorini::law::{Bound, Boundary, PairLaw, Piece, Rule, State, Tangential, Vector};

const POINTS: usize = 3000;

/// Rounding of some operations on numbers up to about 1000: forces on long ways.
const ROUNDING: f64 = 1e-11;

const BOUNDARIES: [Boundary; 2] = [Boundary::Contact, Boundary::Slip];

/// A piece in space.
pub fn piece_of(closed: bool, slips: bool) -> Piece {
    let tangential = if slips { Tangential::Slip { side: 0 } } else { Tangential::Stick };
    Piece { closed, tangential }
}

fn vector(rng: &mut Rng, dim: usize, most: f64) -> Vector {
    let mut y = [0.0; 3];
    y[..dim].iter_mut().for_each(|y| *y = uniform(rng, -most, most));
    y
}

/// Coordinates on the chart; `y_n` of a pair without an obstacle is that of an infinite gap.
fn coordinates(rng: &mut Rng, numbers: &Numbers) -> Vector {
    let y = vector(rng, numbers.dim, 3.0);
    if numbers.has_obstacle() { y } else { [f64::NEG_INFINITY, y[1], y[2]] }
}

/// A way that a pair without an obstacle goes too.
fn way(rng: &mut Rng, numbers: &Numbers) -> Vector {
    let t = vector(rng, numbers.dim, 1.0);
    if numbers.has_obstacle() { t } else { [0.0, t[1], t[2]] }
}

fn along(y: &Vector, t: &Vector, q: f64) -> Vector {
    std::array::from_fn(|c| y[c] + if t[c] == 0.0 { 0.0 } else { q * t[c] })
}

/// The bound at `y` on a piece; negative beyond where the pressure of a closed one is none.
fn threshold(numbers: &Numbers, piece: Piece, y: &Vector) -> f64 {
    numbers.bound.at(if piece.closed { y[0] } else { 0.0 })
}

/// How far `y` is outside a piece, by the table of the pieces.
fn outside(numbers: &Numbers, piece: Piece, boundary: Boundary, y: &Vector) -> f64 {
    let size = numbers.size(&y[1..numbers.dim]);
    match boundary {
        Boundary::Contact if piece.closed => -y[0],
        Boundary::Contact => y[0],
        Boundary::Slip if piece.slips() => threshold(numbers, piece, y) - size,
        Boundary::Slip => size - threshold(numbers, piece, y),
    }
}

fn boundaries(law: &PairLaw, piece: Piece) -> impl Iterator<Item = Boundary> {
    BOUNDARIES.into_iter().filter(move |&boundary| law.has_boundary(piece, boundary))
}

/// How far a point is outside a piece, its own or another, is what the table of the pieces says.
#[test]
fn a_boundary_is_where_its_function_is_zero() {
    let rng = &mut Rng::with_seed(1);
    for _ in 0..POINTS {
        let numbers = Numbers::random(rng);
        let (law, y) = (numbers.law(), coordinates(rng, &numbers));
        for (closed, slips) in [(false, false), (false, true), (true, false), (true, true)] {
            let piece = piece_of(closed, slips);
            if closed && !numbers.has_obstacle() {
                continue;
            }
            for boundary in boundaries(&law, piece) {
                let excess = law.excess(piece, boundary, &y);
                let expected = outside(&numbers, piece, boundary, &y);
                assert!((excess - expected).abs() <= ROUNDING, "{numbers:?} {piece:?} {y:?}");
                let (value, _) = law.boundary(piece, boundary, &y);
                assert_eq!(value.abs(), excess.abs());
            }
        }
    }
}

/// A straight way leaves its piece at the first place where it is on the boundary and not inside beyond; before
/// it no place is outside. Then, on the piece across, the same way is inside, and the way back leaves at once.
#[test]
fn a_straight_way_leaves_a_piece_at_its_boundary() {
    let rng = &mut Rng::with_seed(2);
    let (mut left, mut stayed) = ([0; 4], [0; 4]);
    for _ in 0..POINTS {
        let numbers = Numbers::random(rng);
        let law = numbers.law();
        let (y, t) = (coordinates(rng, &numbers), way(rng, &numbers));
        let piece = law.piece(&y);
        let kind = usize::from(piece.closed) + 2 * usize::from(piece.slips());
        for boundary in boundaries(&law, piece) {
            let exit = law.exit(piece, boundary, &y, &t);
            assert!(exit >= 0.0, "{numbers:?}: {exit}");
            // Over four decades, to where a closed pair has no bound left.
            for sample in 0..60 {
                let q = 10_f64.powf(-2.0 + f64::from(sample) / 15.0);
                let at = along(&y, &t, q);
                if threshold(&numbers, piece, &at) < 0.0 {
                    break;
                }
                let out = outside(&numbers, piece, boundary, &at);
                assert!(out <= ROUNDING || q >= exit, "{numbers:?} {y:?} {t:?}: {q} {out:e}");
            }
            let count = if exit < 1e2 { &mut left } else { &mut stayed };
            count[kind] += 1;
            let at = along(&y, &t, exit);
            if exit >= 1e2 || threshold(&numbers, piece, &at) < 0.0 {
                continue;
            }
            let out = |q: f64| outside(&numbers, piece, boundary, &along(&at, &t, q));
            // Where the way grazes the boundary its place has half the digits.
            assert!(out(0.0).abs() <= 1e-6, "{numbers:?} {y:?} {t:?}: {exit}");
            let (step, back) = (1e-6, t.map(|t| -t));
            if (out(step) - out(-step)) / (2.0 * step) < 0.1 {
                continue;
            }
            assert!(out(0.0).abs() <= ROUNDING, "{numbers:?} {y:?} {t:?}: {exit}");
            let across = law.across(piece, boundary);
            let (on, again) =
                (law.exit(across, boundary, &at, &t), law.exit(across, boundary, &at, &back));
            assert!(on > step, "{numbers:?} {at:?} {t:?}: {on:e}");
            // The rounding of the place over the slope.
            assert!(again <= 100.0 * ROUNDING, "{numbers:?} {at:?} {t:?}: {again:e}");
        }
    }
    assert!(left.iter().chain(&stayed).all(|&count| count > POINTS / 100), "{left:?} {stayed:?}");
}

/// A change of `k v` and the change of the displacement that makes it.
#[test]
fn displacements_are_forces_over_the_scale() {
    let rng = &mut Rng::with_seed(3);
    for _ in 0..POINTS {
        let numbers = Numbers::random(rng);
        let by = vector(rng, numbers.dim, 3.0);
        let moved = numbers.law().displacement_by(&by);
        let [first, second] = numbers.scaled(&moved[1..]);
        for (a, b) in [numbers.k.0 * moved[0], first, second].iter().zip(by) {
            assert!((a - b).abs() <= ROUNDING, "{numbers:?}: {by:?} {moved:?}");
        }
    }
}

/// How friction turns with the slip at a given pressure: the derivative of the friction that belongs to a slip, by
/// differences. And how the slip follows the trial force, `1 - T`.
#[test]
fn friction_turns_with_the_slip() {
    let rng = &mut Rng::with_seed(4);
    for _ in 0..POINTS {
        let numbers = Numbers::random_in(rng, 3);
        let law = numbers.law();
        let angle = uniform(rng, 0.0, std::f64::consts::TAU);
        let length = uniform(rng, 0.5, 2.0) / numbers.k.1;
        let (slip, g) = ([length * angle.cos(), length * angle.sin()], uniform(rng, 0.1, 2.0));
        // The force of gauge g that belongs to a slip, by the rule of the law.
        let friction = |delta: [f64; 2]| {
            let along = match numbers.axes {
                Some(axes) => match axes.rule {
                    Rule::Collinear => delta,
                    Rule::Associated => {
                        let [one, two] = axes.along(&delta);
                        axes.of([one * axes.mu[0].powi(2), two * axes.mu[1].powi(2)])
                    }
                },
                None => delta,
            };
            along.map(|part| part * g / numbers.size(&along))
        };
        let tau = friction(slip);
        let moved = numbers.scaled(&slip);
        let law = law.with_bound(Bound { slope: 0.0, offset: g });
        let y = [-1.0, tau[0] + moved[0], tau[1] + moved[1]];
        let linearised = law.linearised(law.piece(&y), &y);
        let curvature = linearised.curvature();
        let step = 1e-5 * length;
        for column in 0..2 {
            let shifted = |by: f64| {
                let mut delta = slip;
                delta[column] += by;
                friction(delta)
            };
            let (one, other) = (shifted(step), shifted(-step));
            for row in 0..2 {
                let slope = (one[row] - other[row]) / (2.0 * step);
                // Central differences, relative to the largest derivative: a ratio of axes of ten.
                let most = 1e2 * g / length;
                let error = (curvature[row][column] - slope).abs();
                assert!(error <= 1e-6 * most, "{numbers:?} {slip:?}: {slope} {curvature:?}");
            }
        }
        // The slip and the friction that follow an unknown are the trial force that it changes: 1 - T and T k.
        let signorini::law::Slopes { motion, turn, .. } = linearised.slopes;
        for row in 0..2 {
            for column in 0..2 {
                let unit = if row == column { numbers.k.1 } else { 0.0 };
                let sum = numbers.k.1 * motion[row][column] + turn[row][column];
                assert!((sum - unit).abs() <= ROUNDING, "{numbers:?}: {motion:?} {turn:?}");
            }
        }
    }
}

/// At the centre of the chart, where nothing slips and nothing pushes along the obstacle, all that the law gives are
/// numbers: no friction, no step, no way out along a way that goes nowhere.
#[test]
fn where_nothing_slips_the_law_gives_numbers() {
    let rng = &mut Rng::with_seed(5);
    for _ in 0..POINTS {
        let numbers = Numbers::random(rng);
        let (law, dim) = (numbers.law(), numbers.dim);
        let y = [if numbers.has_obstacle() { uniform(rng, -1.0, 1.0) } else { -1.0 }, 0.0, 0.0];
        let piece = law.piece(&y);
        let push = law.push_on(piece, &y);
        assert_eq!(push, [y[0].max(0.0) - numbers.tension, 0.0, 0.0], "{numbers:?}");
        let derivative = law.linearised(piece, &y).moved(&[1.0; 3]);
        assert!(derivative.iter().all(|entry| entry.is_finite()), "{numbers:?}");
        assert_eq!(law.opposing_edge(&[1.0, 0.0, 0.0][..dim]), [-1.0, 0.0, 0.0]);
        if dim == 2 {
            let exit = law.planar_exit(law.piece(&y), [y[0], y[1]], [0.0; 2]);
            assert!(exit.is_none(), "{numbers:?}: {exit:?}");
        }
        // The pair hangs free of its obstacle, without a force beside its tension.
        let (v, p) = ([f64::min(y[0], 0.0), 0.0, 0.0], [-numbers.tension, 0.0, 0.0]);
        let (mut d, force) = numbers.of_host(&v, &p);
        let before = d.clone();
        let (steps, change) = law.relax(&mut d, &force, &[0.0; 2], 1.0);
        assert_eq!((steps, change, d), ([0.0; 3], 0.0, before), "{numbers:?}");
    }
}

/// Pieces closer than the margin are not told apart: open comes before closed, stick before slip.
#[test]
fn states_next_to_a_boundary_are_open_and_stick() {
    let rng = &mut Rng::with_seed(6);
    for _ in 0..POINTS {
        let numbers = Numbers::random(rng);
        if !numbers.has_obstacle() {
            continue;
        }
        let (law, margin) = (numbers.law(), 1e-3);
        let slope = numbers.bound.slope.max(1.0);
        let at = |pressure: f64, beyond: f64| {
            let p_n = pressure - numbers.tension;
            let size = numbers.threshold(p_n) + beyond;
            let t = [size / numbers.size(&[1.0, 0.0][..numbers.dim - 1]), 0.0];
            let (d, force) = numbers.of_host(&[0.0; 3], &[p_n, t[0], t[1]]);
            law.state(&d, &force, margin)
        };
        assert_eq!(at(0.9 * margin / slope, 0.0), State::Open, "{numbers:?}");
        assert_ne!(at(1.1 * margin / slope, 0.0), State::Open, "{numbers:?}");
        if numbers.threshold(1.0 - numbers.tension) > 0.0 {
            assert_eq!(at(1.0, 0.9 * margin), State::Stick, "{numbers:?}");
            assert_eq!(at(1.0, 1.1 * margin), State::Slip, "{numbers:?}");
        }
    }
}

/// A way along which the bound grows as the friction does, or nearly so: it meets its boundary at a place that is
/// exact, on a cone of slope 1, and is found to some roundings.
#[test]
fn a_way_nearly_along_a_boundary_leaves_at_its_exact_place() {
    let law = PairLaw::new(2, 0.0, [0.0; 2], Bound { slope: 1.0, offset: 0.0 }, (1.0, 1.0));
    let (slip, stick) = (piece_of(true, true), piece_of(true, false));
    let exit = |piece, y: [f64; 2], t: [f64; 2]| {
        law.exit(piece, Boundary::Slip, &[y[0], y[1], 0.0], &[t[0], t[1], 0.0])
    };
    for side in [1.0, -1.0] {
        // 3 - q = 1 + q, and 1 + q = 3 - q.
        assert_eq!(exit(slip, [1.0, side * 3.0], [1.0, -side]), 1.0);
        assert_eq!(exit(stick, [3.0, side], [-1.0, side]), 1.0);
        // 1 + q and 2 + q never meet.
        assert_eq!(exit(stick, [2.0, side], [1.0, side]), f64::INFINITY);
        for exponent in [-40, -30, -20, -10] {
            let e = 2_f64.powi(exponent);
            // 1 + q = (1 + e) q + 1/2: after 1 / (2 e). 2 + q (1 - e) = 1 + q: after 1 / e.
            let far = exit(stick, [1.0, side * 0.5], [1.0, side * (1.0 + e)]);
            assert!((2.0 * e * far - 1.0).abs() <= 1e-14 / e.min(1e-2), "{e:e}: {far:e}");
            // 2 - q (1 - e) = 1 + q.
            let near = exit(slip, [1.0, side * 2.0], [1.0, -side * (1.0 - e)]);
            let expected = 1.0 / (2.0 - e);
            assert!((near - expected).abs() <= 1e-15, "{e:e}: {near:e}");
        }
    }
}
