//! Points of the law that are drawn: which numbers give which point.

use crate::laws::{Numbers, uniform};
use fastrand::Rng;

/// The first number, in thirds, tells open, stick and slip; the second one the direction of the trial force. The third and
/// the fourth are parts of what the normal and the tangential component may be: scaled displacements of the `size`, a pressure
/// whose force and friction are of the `size`, the friction of stick up to its bound. With numbers of 1 each of them is that
/// large, and none is larger.
#[test]
fn a_drawn_point_is_on_its_piece_and_of_its_size() {
    let rng = &mut Rng::with_seed(1);
    for _ in 0..5000 {
        let numbers = Numbers::random(rng);
        let law = numbers.law();
        let ([root_n, root_t], size) =
            ([numbers.k.0.sqrt(), numbers.k.1.sqrt()], uniform(rng, 0.1, 5.0));
        let drawn: [f64; 4] = std::array::from_fn(|_| uniform(rng, -1.0, 1.0));
        let mut next = drawn.into_iter();
        let y = law.drawn(size, || next.next().expect("four numbers"));
        let [third, turn, normal, tangential] = drawn;
        let third = if numbers.has_obstacle() { (3.0 * third.abs()) as usize } else { 0 };
        let near = |a: f64, b: f64| assert!((a - b).abs() <= 1e-12, "{numbers:?} {drawn:?}: {y:?}");
        let (pressure, gauge) = (y[0], numbers.size(&y[1..numbers.dim]));
        if third == 0 {
            near(-y[0] / root_n, normal.abs() * size);
            near(gauge / root_t, tangential.abs() * size);
        } else {
            let friction = numbers.bound.slope * pressure / root_t;
            near((pressure / root_n).max(friction), normal.abs() * size);
            let bound = numbers.bound.at(pressure);
            match third {
                1 => near(gauge, tangential.abs() * bound),
                _ => near(gauge, bound + tangential.abs() * size * root_t),
            }
        }
        match numbers.dim {
            2 => assert!(y[1] * turn >= 0.0 && y[2] == 0.0, "{numbers:?} {drawn:?}: {y:?}"),
            _ => {
                let (sin, cos) = (std::f64::consts::PI * turn).sin_cos();
                near(y[1] * sin, y[2] * cos);
                assert!(y[1] * cos + y[2] * sin >= 0.0, "{numbers:?} {drawn:?}: {y:?}");
            }
        }
    }
}
