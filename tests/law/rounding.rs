//! The bounds that the law states for its natural map: on its rounding, and on its change with the force. They hold,
//! and they are close.

use crate::common::quad::Quad;
use crate::laws::{Axes, Numbers, direction, norm, uniform};
use fastrand::Rng;
use signorini::file::Law;
use signorini::law::{Bound, PairLaw, Rule};

const POINTS: usize = 3000;

fn residual(law: &PairLaw, dim: usize, d: &[f64], force: &[f64]) -> Vec<f64> {
    let mut residual = vec![0.0; dim];
    law.natural_residual(d, force, &mut residual);
    residual
}

/// Where a pair slips, eight roundings of two forces and of the terms of the bound, and with an ellipse of what the
/// turn of its axes makes of the trial force; where it may carry a tension, two of the normal force beside it, and then a
/// bound of zero is a difference of terms too; elsewhere none, as one term alone has the digits of the data.
#[test]
fn rounding_is_that_of_two_forces_on_a_slip() {
    let rng = &mut Rng::with_seed(1);
    let mut seen = [0; 3];
    for _ in 0..POINTS {
        let numbers = Numbers::random(rng);
        let (v, p) = numbers.point(rng, 1e-6);
        let (d, force) = numbers.of_host(&v, &p);
        let rounding = numbers.law().natural_rounding(&d, &force);
        let g = numbers.threshold(p[0]);
        let has_bound = g > 0.0 || numbers.tension > 0.0;
        let slips = has_bound && norm(&v[1..]) > 0.0;
        // The sum of the sizes of two components is at most 1.5 of the length.
        let friction = norm(&p[1..]);
        let expected = 8.0 * f64::EPSILON * (friction + g + numbers.bound.slope * numbers.tension);
        let pull = if numbers.tension > 0.0 { f64::EPSILON * force[0].abs() } else { 0.0 };
        if slips {
            let beside = rounding - pull;
            // No more than the trial force is turned, and by a flat ellipse on its own line by its ratio as much.
            let turned = match numbers.axes {
                None => 0.0,
                Some(_) => {
                    16.0 * f64::EPSILON * norm(&numbers.trial(&v, &p)[1..]) * numbers.ratio()
                }
            };
            let close = beside >= 0.999 * expected && beside <= 1.5 * expected + 2.0 * turned;
            assert!(close, "{numbers:?}: {rounding:e}, {expected:e}");
        } else {
            assert_eq!(rounding, pull, "{numbers:?} {v:?} {p:?}");
        }
        seen[if slips { 2 } else { usize::from(g > 0.0) }] += 1;
    }
    assert!(seen.iter().all(|&count| count > POINTS / 20), "{seen:?}");
}

/// Next to its bound a pair that sticks may slip, and one that slips may stick: within the rounding both count it.
#[test]
fn rounding_counts_next_to_the_bound() {
    let rng = &mut Rng::with_seed(2);
    for _ in 0..POINTS {
        let numbers = Numbers::random(rng);
        if !numbers.has_obstacle() {
            continue;
        }
        let p_n = uniform(rng, 0.5, 2.0) - numbers.tension;
        let (g, h) = (numbers.threshold(p_n), direction(rng, numbers.dim));
        if g == 0.0 {
            continue;
        }
        let size = numbers.size(&h[..numbers.dim - 1]);
        for part in [1.0 - 1e-15, 1.0, 1.0 + 1e-15] {
            let p = [p_n, part * g * h[0] / size, part * g * h[1] / size];
            let (d, force) = numbers.of_host(&[0.0; 3], &p);
            assert!(numbers.law().natural_rounding(&d, &force) > 0.0, "{numbers:?} {p:?}");
        }
    }
}

/// No change of the force changes the residual by more than the bound times its length; and some change of one law
/// in a hundred comes to a fourth of the bound, with an ellipse as well.
#[test]
fn a_change_of_the_force_changes_the_residual_by_the_bound_at_most() {
    let rng = &mut Rng::with_seed(3);
    let (mut closest, mut elliptic) = (0.0_f64, 0.0_f64);
    for _ in 0..POINTS {
        let mut numbers = Numbers::random(rng);
        if let Some(axes) = &mut numbers.axes {
            axes.mu[0] *= 10_f64.powf(uniform(rng, -2.0, 2.0));
            numbers.bound.slope = axes.mu[0].max(axes.mu[1]);
        }
        let (v, p) = numbers.point(rng, 0.0);
        let (d, force) = numbers.of_host(&v, &p);
        let (law, dim) = (numbers.law(), numbers.dim);
        let before = residual(&law, dim, &d, &force);
        let most = law.sensitivity();
        for _ in 0..20 {
            let by: Vec<f64> = (0..dim).map(|_| uniform(rng, -1.0, 1.0)).collect();
            let length = 10_f64.powf(uniform(rng, -3.0, 0.0)) / norm(&by);
            let moved: Vec<f64> = force.iter().zip(&by).map(|(f, by)| f + length * by).collect();
            let after = residual(&law, dim, &d, &moved);
            let change: Vec<f64> = after.iter().zip(&before).map(|(a, b)| a - b).collect();
            let part = norm(&change) / (length * norm(&by));
            // Rounding of forces up to 100 over a change of 1e-3.
            assert!(part <= most * (1.0 + 1e-9) + 1e-9, "{numbers:?}: {part} > {most}");
            let closest = if numbers.axes.is_some() { &mut elliptic } else { &mut closest };
            *closest = closest.max(part / most);
        }
    }
    assert!(closest > 0.25 && elliptic > 0.25, "{closest}, {elliptic}");
}

/// On its own line the friction `g y / |W y|` of a flat ellipse turns with the force by about `|W|`: with `y = (1, 1e-4)`, half-axes
/// 1 and 1e-4 and `g = 1` it is `y / 2^½` and changes by `-(y_1 / 2^½) 1e4 / 2` along the long axis.
#[test]
fn a_flat_ellipse_turns_its_friction_by_its_norm() {
    let flat = 1e-4;
    let axes = Axes { mu: [1.0, flat], angle: 0.0, rule: Rule::Collinear };
    let numbers = Numbers { axes: Some(axes), ..Numbers::of(3, (Law::Coulomb, &[1.0])) };
    let (law, d, by) = (numbers.law(), [0.0, 1.0, flat], 1e-9);
    let [before, after] = [0.0, by].map(|by| residual(&law, 3, &d, &[-1.0, 0.0, -by]));
    let change = (after[1] - before[1]).hypot(after[2] - before[2]) / by;
    let expected = 1.0 / (2.0 * 2_f64.sqrt() * flat);
    // A change by 1e-5 of the length along the short axis, and rounding of 1 over it.
    assert!((change / expected - 1.0).abs() <= 1e-3, "{change:e}");
    assert!(change <= law.sensitivity(), "{change:e} > {:e}", law.sensitivity());
}

/// An ellipse turns the trial force into its axes, where a flat one multiplies the rounding: the bound holds against the friction
/// `g y / |W y|` in twice the precision, near the long axis, where `|W y|` is a sum of cancelled terms. All but the axes'
/// direction are powers of two.
#[test]
fn the_rounding_of_a_flat_ellipse_is_bounded() {
    let (rng, flat) = (&mut Rng::with_seed(4), 2_f64.powi(-14));
    let mut beyond = [0; 2];
    for seed in 0..POINTS {
        let [g, angle] = [[2_f64.powi(20), 2_f64.powi(-20)][seed % 2], uniform(rng, -4.0, 4.0)];
        let axes = Axes { mu: [1.0, flat], angle, rule: Rule::Collinear };
        let bound = Bound::tresca(g);
        let law = Numbers { axes: Some(axes), bound, ..Numbers::of(3, (Law::Tresca, &[g])) }.law();
        let along = [g * uniform(rng, 0.5, 2.0), flat * g * uniform(rng, 1.0, 2.0)];
        let [y1, y2] = axes.of(along);
        let found = residual(&law, 3, &[0.0, y1, y2], &[0.0; 3]);
        let (sin, cos) = angle.sin_cos();
        let first = Quad::product(cos, y1) + Quad::product(sin, y2);
        let second = (Quad::product(cos, y2) - Quad::product(sin, y1)).scaled(1.0 / flat);
        let size = (first * first + second * second).sqrt();
        let off = |c: usize, y: f64| Quad::product(g, y) / size - Quad::from(found[c]);
        let off = norm(&[off(1, y1).value(), off(2, y2).value()]);
        let bound = law.natural_rounding(&[0.0, y1, y2], &[0.0; 3]);
        assert!(off <= bound, "{angle}, {along:?}: {off:e} > {bound:e}");
        // Roundings of the bound alone are fewer.
        beyond[seed % 2] += usize::from(off > 16.0 * f64::EPSILON * g);
    }
    assert!(beyond.iter().all(|&count| count > POINTS / 20), "{beyond:?}");
}
