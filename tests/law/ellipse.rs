//! The friction of a slip on an ellipse, from forces whose nearest point is known.

use crate::laws::{Axes, Numbers, uniform};
use fastrand::Rng;
use signorini::file::Law;
use signorini::law::{Bound, Piece, Rule, Tangential};

/// The point `tau` of the ellipse with the half-axes `g c` is the nearest one of `y_i = (1 + q / (g c_i²)) tau_i`, along its
/// normal: outside with `q > 0`, and a little inside with `q` down to half of the smaller `-g c²`. Forces over twelve decades,
/// half-axes up to a thousand times apart.
#[test]
fn the_friction_of_a_slip_is_the_nearest_point_of_the_ellipse() {
    let rng = &mut Rng::with_seed(1);
    for _ in 0..5000 {
        let decades = |rng: &mut Rng, most: f64| 10_f64.powf(uniform(rng, -most, most));
        let g = decades(rng, 6.0);
        let (mu, angle) = ([1.0, decades(rng, 3.0)], uniform(rng, -4.0, 4.0));
        let axes = Axes { mu, angle, rule: Rule::Associated };
        let largest = mu[1].max(1.0);
        let squares = mu.map(|mu| g * (mu / largest).powi(2));
        let (sin, cos) = uniform(rng, -4.0, 4.0).sin_cos();
        let tau = [g / largest * mu[0] * cos, g / largest * mu[1] * sin];
        let q = match rng.bool() {
            true => g * 10_f64.powf(uniform(rng, -6.0, 1.0)),
            false => -uniform(rng, 0.0, 0.45) * squares[0].min(squares[1]),
        };
        let along = [0, 1].map(|c| (1.0 + q / squares[c]) * tau[c]);
        let (y, expected) = (axes.of(along), axes.of(tau));
        let bound = Bound::tresca(g);
        let law = Numbers { axes: Some(axes), bound, ..Numbers::of(3, (Law::Tresca, &[g])) }.law();
        let slip = Piece { closed: false, tangential: Tangential::Slip { side: 0 } };
        let push = law.push_on(slip, &[-1.0, y[0], y[1]]);
        // Rounding of the axes' directions, beside the shorter one.
        let size = (y[0].hypot(y[1]) + g) * largest / mu[1].min(1.0);
        let off = (push[1] - expected[0]).hypot(push[2] - expected[1]);
        assert!(off <= 1e-13 * size, "{axes:?}, {g:e}, {q:e}: {push:?}, {expected:?}");
    }
}
