//! Pieces in the plane: places inside, derivatives and their changes, and where paths go on.

use crate::laws::{Numbers, uniform};
use fastrand::Rng;
use signorini::law::{Linearised, PairLaw, Piece, Tangential, Vector};

const POINTS: usize = 5000;

/// Rounding of a few operations on numbers up to about 10.
const ROUNDING: f64 = 1e-12;

/// Coordinates at random; the normal one of a pair without an obstacle is negative.
fn coordinates(rng: &mut Rng, numbers: &Numbers) -> Vector {
    let mut y = [0.0; 3];
    y[..numbers.dim].iter_mut().for_each(|y| *y = uniform(rng, -3.0, 3.0));
    if !numbers.has_obstacle() {
        y[0] = -y[0].abs();
    }
    y
}

/// A place that is inside a piece is on that piece, and no pair there carries a force on the open piece alone.
#[test]
fn a_place_inside_a_piece_is_on_it() {
    let rng = &mut Rng::with_seed(1);
    for _ in 0..POINTS {
        let numbers = Numbers::random_in(rng, 2);
        let law = numbers.law();
        let piece = law.piece(&coordinates(rng, &numbers));
        let inside = law.inside(piece, uniform(rng, 0.1, 2.0));
        assert_eq!(law.piece(&inside), piece, "{numbers:?}: {inside:?}");
        let (_, push) = law.point(&inside);
        let pushes = push[0] + numbers.tension != 0.0 || push[1] != 0.0;
        assert!(!pushes || piece.carries_force(), "{numbers:?}: {push:?}");
        assert_eq!(piece.carries_force(), piece != law.planar_pieces()[0], "{numbers:?}");
    }
}

/// A pair leaves a symmetric system symmetric unless it slips with a friction that follows its pressure or, in space,
/// turns with its slip.
#[test]
fn friction_that_follows_nothing_is_plain() {
    let rng = &mut Rng::with_seed(2);
    let mut counts = [0; 2];
    for _ in 0..POINTS {
        let numbers = Numbers::random(rng);
        let (law, y) = (numbers.law(), coordinates(rng, &numbers));
        let piece = law.piece(&y);
        let slips = matches!(piece.tangential, Tangential::Slip { .. });
        let follows = piece.closed && numbers.bound.slope > 0.0 || numbers.dim == 3;
        let plain = law.linearised(piece, &y).slopes.is_plain();
        assert_eq!(plain, !(slips && follows), "{numbers:?} at {y:?}");
        counts[usize::from(plain)] += 1;
    }
    assert!(counts.iter().all(|&count| count > POINTS / 20), "{counts:?}");
}

/// `1 - dP/dy`, by rows.
fn derivative(pair: &Linearised) -> [[f64; 2]; 2] {
    let columns = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(|unit| pair.moved(&unit));
    [0, 1].map(|row| [columns[0][row], columns[1][row]])
}

/// The change of the derivative between two pieces is the sum of the products that are told, as many as its rank: none from
/// a piece to itself, and one at most across one boundary.
#[test]
fn a_change_of_pieces_is_a_sum_of_as_many_products_as_its_rank() {
    let rng = &mut Rng::with_seed(3);
    let mut counts = [0; 3];
    for _ in 0..POINTS {
        let numbers = Numbers::random_in(rng, 2);
        let law: PairLaw = numbers.law();
        let y = coordinates(rng, &numbers);
        let (here, there) = (law.piece(&y), law.piece(&coordinates(rng, &numbers)));
        let rate = [uniform(rng, -1.0, 1.0), uniform(rng, -1.0, 1.0)];
        let next = law.planar_exit(here, [y[0], y[1]], rate).map_or(here, |exit| exit.beyond);
        let [from, to, beside] = [here, there, next].map(|piece: Piece| law.linearised_on(piece));
        assert!(from.change_to(&from).is_empty() && from.change_to(&beside).len() <= 1);
        let terms = from.change_to(&to);
        let (before, after) = (derivative(&from), derivative(&to));
        let change = [0, 1].map(|r| [0, 1].map(|c| after[r][c] - before[r][c]));
        let sum = |r: usize, c: usize| terms.iter().map(|(u, n)| u[r] * n[c]).sum::<f64>();
        for (r, row) in change.iter().enumerate() {
            for (c, entry) in row.iter().enumerate() {
                assert!((sum(r, c) - entry).abs() <= ROUNDING, "{numbers:?}: {terms:?}");
            }
        }
        let determinant = change[0][0] * change[1][1] - change[0][1] * change[1][0];
        let rank = match (change == [[0.0; 2]; 2], determinant == 0.0) {
            (true, _) => 0,
            (false, true) => 1,
            (false, false) => 2,
        };
        assert_eq!(terms.len(), rank, "{numbers:?} {here:?} {there:?}");
        counts[rank] += 1;
    }
    assert!(counts.iter().all(|&count| count > POINTS / 50), "{counts:?}");
}

/// A pair that touches, and does not slip, goes on with forces that the law allows: its own, if they are, else it sticks with
/// the pressure of `least` at least, and with its friction as far as its bound goes. One that is open, or slips, by more than
/// `least` stays where it is.
#[test]
fn a_released_pair_that_sticks_has_forces_of_the_law() {
    let rng = &mut Rng::with_seed(4);
    let mut counts = [0; 3];
    for _ in 0..POINTS {
        let numbers = Numbers::random_in(rng, 2);
        let (law, least) = (numbers.law(), uniform(rng, 1e-3, 1.0));
        let force = [uniform(rng, -3.0, 3.0), uniform(rng, -3.0, 3.0)];
        // Displacements by more than `least` along one component, or by less along both.
        let [normal, tangential] = match rng.u8(0..3) {
            0 => [-uniform(rng, 1.1, 3.0), uniform(rng, -3.0, 3.0)],
            1 => [uniform(rng, -0.9, 0.9), [1.0, -1.0][rng.usize(0..2)] * uniform(rng, 1.1, 3.0)],
            _ => [uniform(rng, -0.9, 0.9), uniform(rng, -0.9, 0.9)],
        };
        let reference = law.reference();
        let d = [
            reference[0] + normal * least / numbers.k.0,
            reference[1] + tangential * least / numbers.k.1,
        ];
        let y = law.chart(&d, &force);
        let released = law.released(&d, &force, least);
        let touches = numbers.has_obstacle() && normal.abs().max(tangential.abs()) < 1.0;
        let is_stuck = y[0] > 0.0 && y[1].abs() <= numbers.bound.at(y[0]);
        if !touches || is_stuck {
            assert_eq!(released, [y[0], y[1]], "{numbers:?}");
            counts[usize::from(touches)] += 1;
            continue;
        }
        counts[2] += 1;
        assert_eq!(released[0], y[0].max(least), "{numbers:?} at {y:?}");
        let bound = numbers.bound.at(released[0]);
        assert!(released[1].abs() <= bound * (1.0 - 1e-3), "{numbers:?} at {y:?}: {released:?}");
        assert!(released[1].abs() >= y[1].abs().min(0.9 * bound), "{numbers:?} at {y:?}");
        assert!(released[1] * y[1] >= 0.0, "{numbers:?} at {y:?}: {released:?}");
    }
    assert!(counts.iter().all(|&count| count > POINTS / 50), "{counts:?}");
}
