//! Tangents along which a pair is as stiff: the block of stiffness, displacements, forces and the law in them.

use fastrand::Rng;
use signorini::law::{Bound, Ellipse, LevelledTangents, PairLaw, Rule};

const BOUND: Bound = Bound { slope: 0.5, offset: 0.0 };

/// A block with these stiffnesses, its axes turned by `(c, s) = (4, 3) / 5`, so that few numbers are rounded.
fn block([first, second]: [f64; 2]) -> [f64; 3] {
    let (c, s) = (0.8, 0.6);
    [first * c * c + second * s * s, (first - second) * c * s, first * s * s + second * c * c]
}

/// What the head of this file says: the block is `k_1` in both directions, a displacement comes back, and forces do the
/// same work. Rounding of the larger stiffness, 1e4 times the smaller one at most, hides twelve digits at least.
#[test]
fn a_pair_is_as_stiff_along_both_tangents() {
    let rng = &mut Rng::with_seed(1);
    let law = PairLaw::new(3, 1.0, [2.0, -3.0], BOUND, (1.0, 1.0));
    for stiffnesses in [[2.0, 1024.0], [4096.0, 2.0], [3.0, 30_000.0]] {
        let [a, b, c] = block(stiffnesses);
        let levelled = LevelledTangents::of(&law, [a, b, c]).expect("they are far apart");
        let softer = stiffnesses[0].min(stiffnesses[1]);
        let force_of = |d: [f64; 2]| {
            let [x, y] = levelled.displacement(d);
            levelled.force([a * x + b * y, b * x + c * y])
        };
        for (i, unit) in [[1.0, 0.0], [0.0, 1.0]].into_iter().enumerate() {
            let force = force_of(unit);
            for j in 0..2 {
                let exact = if i == j { softer } else { 0.0 };
                assert!((force[j] - exact).abs() <= 1e-10 * softer, "{force:?}");
            }
        }
        let [d, f] = [(); 2].map(|()| [(); 2].map(|()| rng.f64() - 0.5));
        let [own, back] = [levelled.levelled(d), levelled.displacement(levelled.levelled(d))];
        let force = levelled.force(f);
        let work = f[0] * d[0] + f[1] * d[1];
        assert!((force[0] * own[0] + force[1] * own[1] - work).abs() <= 1e-12, "{d:?}, {f:?}");
        assert!((0..2).all(|i| (back[i] - d[i]).abs() <= 1e-12), "{d:?}, {back:?}");
        // The law slips from the same place, with the softer stiffness, and a force on the disc is one on its ellipse.
        let own = levelled.law(&law);
        assert_eq!(own.reference()[1..], levelled.levelled([2.0, -3.0]));
        assert!((own.scale()[1] - softer).abs() <= 1e-10 * softer, "{own:?}");
        assert!((own.gauge(&force) - f[0].hypot(f[1])).abs() <= 1e-12, "{f:?}, {force:?}");
    }
}

/// Other coordinates are for pairs in space, with a disc of their own, whose stiffnesses are both positive and more than
/// 100 times apart.
#[test]
fn other_coordinates_are_for_unlike_stiffnesses_alone() {
    let in_space = PairLaw::new(3, 1.0, [0.0; 2], BOUND, (1.0, 1.0));
    let ellipse = Ellipse::new([1.0, 0.5], 0.0, Rule::Associated);
    let plane = PairLaw::new(2, 1.0, [0.0; 2], BOUND, (1.0, 1.0));
    for (stiffnesses, expected) in [
        ([1.0, 1.0], false),
        ([1.0, 90.0], false),
        ([90.0, 1.0], false),
        ([1e6, 9e7], false),
        ([1.0, 110.0], true),
        ([110.0, 1.0], true),
        ([1.0, 1e8], true),
        ([-1.0, 1e3], false),
        ([-1e3, 1.0], false),
        ([-1e3, -1.0], false),
        ([0.0, 0.0], false),
    ] {
        let block = block(stiffnesses);
        assert_eq!(LevelledTangents::of(&in_space, block).is_some(), expected, "{stiffnesses:?}");
        for other in [plane, in_space.with_ellipse(ellipse)] {
            assert!(LevelledTangents::of(&other, block).is_none(), "{stiffnesses:?}");
        }
    }
    assert!(LevelledTangents::of(&in_space, [0.0, 0.0, 1.0]).is_none(), "nothing resists");
}

/// An ellipse is no flatter than the header admits for one of a host, one millionth, however far apart the stiffnesses are.
#[test]
fn a_levelled_ellipse_is_no_flatter_than_one_of_a_host() {
    let law = PairLaw::new(3, 1.0, [0.0; 2], BOUND, (1.0, 1.0));
    for (stiffer, expected) in [(1e6, 1e-3), (1e10, 1e-5), (1e14, 1e-6), (1e16, 1e-6)] {
        let levelled = LevelledTangents::of(&law, [1.0, 0.0, stiffer]).expect("they are far apart");
        let [along, across] = levelled.force([0.0, 1.0]);
        // Some roundings of the root.
        assert!((along.hypot(across) / expected - 1.0).abs() <= 1e-12, "{stiffer:e}: {across:e}");
        assert!((levelled.law(&law).gauge(&[0.0, 1.0]) * expected - 1.0).abs() <= 1e-12);
    }
}
