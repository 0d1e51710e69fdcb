//! The law of a pair against its statement: the normal map and the natural map describe the same law,
//! and the pieces have the derivative of the normal map.

use crate::laws::{Numbers, dot, norm, uniform};
use fastrand::Rng;
use signorini::law::Boundary;
use signorini::law::{Planar, State, Vector};

const POINTS: usize = 20_000;

/// Rounding of a few operations on forces up to about 100: 50 units of 100 eps.
const ROUNDING: f64 = 1e-12;

/// Any trial force, 0 and `-inf` (no obstacle) among them.
fn any(rng: &mut Rng, law: &Numbers) -> Vector {
    let mut y = [0.0; 3];
    for y in &mut y[..law.dim] {
        *y = if rng.u8(0..10) == 0 { 0.0 } else { uniform(rng, -3.0, 3.0) };
    }
    if !law.has_obstacle() {
        y[0] = f64::NEG_INFINITY;
    }
    y
}

fn is_near(a: &Vector, b: &Vector) -> bool {
    a.iter().zip(b).all(|(a, b)| a == b || (a - b).abs() <= ROUNDING)
}

#[test]
fn every_point_of_the_normal_map_obeys_the_law() {
    let rng = &mut Rng::with_seed(1);
    for _ in 0..POINTS {
        let law = Numbers::random(rng);
        let y = any(rng, &law);
        let (v, p) = law.map(&y);
        assert!(law.defect(&v, &p) <= ROUNDING, "{law:?} at {y:?}: {v:?} {p:?}");
        assert!(is_near(&law.trial(&v, &p), &y), "{law:?} at {y:?}");
    }
}

#[test]
fn every_point_of_the_law_is_one_of_the_normal_map() {
    let rng = &mut Rng::with_seed(2);
    for _ in 0..POINTS {
        let law = Numbers::random(rng);
        let (v, p) = law.point(rng, 0.0);
        assert!(law.defect(&v, &p) <= ROUNDING, "a wrong test: {law:?} {v:?} {p:?}");
        let (v_again, p_again) = law.map(&law.trial(&v, &p));
        assert!(is_near(&v, &v_again) && is_near(&p, &p_again), "{law:?} at {v:?} {p:?}");
        // In terms of the host's displacement and force.
        let (d, force) = law.of_host(&v, &p);
        assert!(is_near(&law.law().trial(&d, &force), &law.trial(&v, &p)), "{law:?}");
    }
}

#[test]
fn the_natural_map_is_zero_on_the_law() {
    let rng = &mut Rng::with_seed(3);
    for _ in 0..POINTS {
        let law = Numbers::random(rng);
        let (v, p) = law.point(rng, 0.0);
        let (d, force) = law.of_host(&v, &p);
        let mut residual = vec![f64::NAN; law.dim];
        law.law().natural_residual(&d, &force, &mut residual);
        assert!(norm(&residual) <= ROUNDING, "{law:?} at {v:?} {p:?}: {residual:?}");
        let violation = law.law().violation(&d, &force);
        let worst = violation.tension.max(violation.cone_excess).max(violation.penetration);
        assert!(worst <= ROUNDING, "{law:?} at {v:?} {p:?}: {violation:?}");
    }
}

/// With the residual `e`, `tau + e_t` is the point of the disc nearest to `k delta + tau`: it lies in
/// the disc, and `k delta - e_t` is along it, `g |k delta - e_t| = (k delta - e_t) . (tau + e_t)`. So
///
/// `|tau| - g <= |e_t|`   and   `g |k delta| - k delta . tau <= |e_t| (g + |k delta| + |tau|)`.
///
/// The normal component is exact: `|e_n|` is the penetration, the tension, or the smaller of clearance
/// and pressure; pressures are those beside the tension that the law allows.
#[test]
fn the_natural_map_is_not_zero_off_the_law() {
    let rng = &mut Rng::with_seed(4);
    let mut off = 0;
    for _ in 0..POINTS {
        let law = Numbers::random(rng);
        // A point of the law for some displacements and another for the forces.
        let ((mut v, _), (_, p)) = (law.point(rng, 0.0), law.point(rng, 0.0));
        if law.has_obstacle() && rng.bool() {
            v[0] = uniform(rng, -1.0, 1.0);
        }
        let (d, force) = law.of_host(&v, &p);
        let mut residual = vec![f64::NAN; law.dim];
        law.law().natural_residual(&d, &force, &mut residual);
        let penetration = law.k.0 * v[0];
        let pressure = p[0] + law.tension;
        let normal = penetration.max(-pressure).max(pressure.min(-penetration));
        let (e_n, e_t) = (residual[0].abs(), norm(&residual[1..]));
        assert!((e_n - normal).abs() <= ROUNDING, "{law:?} at {v:?} {p:?}: {residual:?}");
        if law.axes.is_none() {
            let moved = law.scaled(&v[1..law.dim]);
            let tau = &p[1..law.dim];
            let g = law.threshold(p[0]);
            let lost = g * norm(&moved) - dot(&moved, tau);
            let size = g + norm(&moved) + norm(tau);
            assert!(norm(tau) - g <= e_t + ROUNDING, "{law:?} at {v:?} {p:?}: {residual:?}");
            assert!(lost <= e_t * size + ROUNDING, "{law:?} at {v:?} {p:?}: {residual:?}");
        }
        if law.defect(&v, &p) > 1e-3 {
            off += 1;
            assert!(norm(&residual) > ROUNDING, "{law:?} at {v:?} {p:?}");
        }
    }
    assert!(off > POINTS / 4, "{off} points were off the law");
}

/// Central differences over `2 h` are off by `h² / 6` times the third derivative and by the rounding of
/// `P` over `h`. On a slip the third derivative is at most `6 g / |y_t|³ <= 6 / |y_t|²`, below 70 where
/// `|y_t| >= 0.3`; with `h = 1e-5` that is 1.2e-9, and the rounding 1e-10. With an ellipse this holds in
/// the variables in which it is a disc, in which `h` is as much larger as the ratio of the axes.
#[test]
fn branches_have_the_derivative_of_the_normal_map() {
    const H: f64 = 1e-5;
    const TOLERANCE: f64 = 5e-9;
    let rng = &mut Rng::with_seed(5);
    let mut slips = [0; 2];
    for _ in 0..POINTS {
        let law = Numbers::random(rng);
        let y = any(rng, &law);
        let (size, g) = (law.size(&y[1..law.dim]), law.threshold(y[0].max(0.0) - law.tension));
        // The kinks: y_n = 0, |y_t| = g.
        let kink = if g > 0.0 { y[0].abs().min((size - g).abs()) } else { y[0].abs() };
        if kink <= 10.0 * H || size < 0.3 {
            continue;
        }
        slips[law.dim - 2] += usize::from(g > 0.0 && size > g);
        let distance = law.law().distance_to_kink(&y);
        assert!(distance == kink || (distance - kink).abs() <= ROUNDING, "{law:?} at {y:?}");
        let tolerance = TOLERANCE * law.ratio().powi(3);
        let linearised = law.law().linearised(law.law().piece(&y), &y);
        for j in usize::from(!law.has_obstacle())..law.dim {
            let moved = |h: f64| {
                let mut y = y;
                y[j] += h;
                law.map(&y)
            };
            let unit: Vector = std::array::from_fn(|i| f64::from(u8::from(i == j)));
            let followed = linearised.moved(&unit);
            let ((v_after, after), (v_before, before)) = (moved(H), moved(-H));
            for i in 0..law.dim {
                let slope = (after[i] - before[i]) / (2.0 * H);
                let pushed = unit[i] - followed[i];
                assert!((pushed - slope).abs() <= tolerance, "{law:?} at {y:?}: {i} {j}");
                // k dv/dy = 1 - dP/dy.
                if i > 0 || law.has_obstacle() {
                    let moved = |c: usize| (v_after[c] - v_before[c]) / (2.0 * H);
                    let slope = match i {
                        0 => law.k.0 * moved(0),
                        _ => law.scaled(&[moved(1), moved(2)])[i - 1],
                    };
                    assert!((followed[i] - slope).abs() <= tolerance, "{law:?} at {y:?}");
                }
            }
        }
    }
    assert!(slips.iter().all(|&slips| slips > POINTS / 20), "{slips:?} slips were seen");
}

/// On its own piece the map of a piece is the normal map; a line leaves the piece where the function of
/// the boundary is zero, and that function has the gradient that is said.
#[test]
fn pieces_are_those_of_the_normal_map_and_end_at_their_boundaries() {
    const H: f64 = 1e-6;
    let rng = &mut Rng::with_seed(8);
    let mut left = [0; 2];
    for _ in 0..POINTS {
        let law = Numbers::random(rng);
        let (y, t) = (any(rng, &law), any(rng, &law));
        if !law.has_obstacle() || norm(&y[1..law.dim]) < 0.3 {
            continue;
        }
        let pair = law.law();
        let piece = pair.piece(&y);
        let (v, p) = law.map(&y);
        let push = pair.push_on(piece, &y);
        let d = pair.displacement(&y, &push);
        assert!(is_near(&push, &p), "{law:?} at {y:?}: {push:?}");
        let moved = law.of_host(&v, &p).0;
        let off = d.iter().zip(&moved).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        // The displacements are forces divided by k, at least 0.1.
        assert!(off <= 10.0 * ROUNDING, "{law:?} at {y:?}: {d:?} {moved:?}");
        for (boundary, left) in [Boundary::Contact, Boundary::Slip].into_iter().zip(&mut left) {
            if !pair.has_boundary(piece, boundary) {
                continue;
            }
            assert!(pair.excess(piece, boundary, &y) <= 0.0, "{law:?} at {y:?}");
            let along = |q: f64| -> Vector { std::array::from_fn(|c| y[c] + q * t[c]) };
            let q = pair.exit(piece, boundary, &y, &t);
            // Beyond the end of contact the bound is negative, and its square has zeros of no meaning.
            if q < 100.0 && q <= pair.exit(piece, Boundary::Contact, &y, &t) {
                *left += 1;
                let (value, _) = pair.boundary(piece, boundary, &along(q));
                // A root of a quadratic: half the digits where it touches.
                assert!(
                    value.abs() <= 1e-6 * (1.0 + q),
                    "{law:?} at {y:?} along {t:?}: {q} {value}"
                );
            }
            let (_, gradient) = pair.boundary(piece, boundary, &y);
            let difference = (pair.boundary(piece, boundary, &along(H)).0
                - pair.boundary(piece, boundary, &along(-H)).0)
                / (2.0 * H);
            // H² over |y_t|² and rounding over H, in the variables of the disc.
            let slope = dot(&gradient, &t);
            assert!((slope - difference).abs() <= 1e-8 * law.ratio().powi(3), "{law:?} at {y:?}");
        }
    }
    assert!(left.iter().all(|&left| left > POINTS / 20), "{left:?}");
}

#[test]
fn states_are_those_of_the_points() {
    let rng = &mut Rng::with_seed(7);
    for _ in 0..POINTS {
        let law = Numbers::random(rng);
        let (v, p) = law.point(rng, 1e-6);
        let (d, force) = law.of_host(&v, &p);
        let slips = norm(&v[1..law.dim]) > 0.0;
        let expected = match p[0] + law.tension > 0.0 {
            false => State::Open,
            true if law.threshold(p[0]) == 0.0 || slips => State::Slip,
            true => State::Stick,
        };
        assert_eq!(law.law().state(&d, &force, 1e-9), expected, "{law:?} at {v:?} {p:?}");
        let admissible = law.law().admissible_force(&force, expected);
        assert!(is_near(&admissible, &p.map(|p| -p)), "{law:?} at {v:?} {p:?}: {admissible:?}");
    }
}

/// A way leaves its piece where the normal map says so: just before that it is on the piece, just
/// after it on the one beyond; and no earlier.
#[test]
fn a_straight_way_leaves_a_piece_at_its_exit() {
    let rng = &mut Rng::with_seed(8);
    let mut exits = 0;
    for _ in 0..POINTS {
        let numbers = Numbers::random(rng);
        if numbers.dim != 2 {
            continue;
        }
        let law = numbers.law();
        let mut random = || -> Planar { [uniform(rng, -3.0, 3.0), uniform(rng, -3.0, 3.0)] };
        let (y, rate) = (random(), random());
        let at = |step: f64| [y[0] + step * rate[0], y[1] + step * rate[1], 0.0];
        let piece = law.piece(&at(0.0));
        // Coordinates up to 300 have a rounding of 1e-13: a boundary is crossed within so much by all
        // ways that are not nearly along it, and hardly any crosses two.
        let (near, far) = (1e-6, 100.0);
        let end = match law.planar_exit(piece, y, rate) {
            Some(exit) if exit.step < far => {
                exits += 1;
                assert_eq!(law.piece(&at(exit.step + near)), exit.beyond, "{numbers:?}");
                exit.step
            }
            _ => far,
        };
        for part in [0.0, 0.1, 0.5, 0.9, 1.0] {
            let step = (part * end - near).max(0.0);
            assert_eq!(law.piece(&at(step)), piece, "{numbers:?}");
        }
    }
    assert!(exits > 1000, "{exits}");
}
