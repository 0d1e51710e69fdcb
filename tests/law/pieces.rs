//! Pieces and boundaries of the law's map, against the map itself and their definitions.

use crate::boundaries::piece_of;
use crate::laws::{Numbers, norm, uniform};
use fastrand::Rng;
use signorini::law::{Bound, Boundary, PairLaw, Piece, Tangential, Vector, first_penetration};

const POINTS: usize = 5000;

/// Rounding of a few operations on numbers up to about 100.
const ROUNDING: f64 = 1e-12;

fn near(a: f64, b: f64) -> bool {
    a == b || (a - b).abs() <= ROUNDING
}

fn coordinates(rng: &mut Rng, law: &Numbers) -> Vector {
    let mut y = [0.0; 3];
    y[..law.dim].iter_mut().for_each(|y| *y = uniform(rng, -3.0, 3.0));
    if !law.has_obstacle() {
        y[0] = f64::NEG_INFINITY;
    }
    y
}

/// The point of the map at any coordinates obeys the equations of its piece there; of a slip in the plane.
#[test]
fn a_point_obeys_the_equations_of_its_branch() {
    let rng = &mut Rng::with_seed(1);
    for _ in 0..POINTS {
        let numbers = Numbers::random(rng);
        let (law, y) = (numbers.law(), coordinates(rng, &numbers));
        let ((v, p), piece) = (numbers.map(&y), law.piece(&y));
        if numbers.dim == 3 && matches!(piece.tangential, Tangential::Slip { .. }) {
            continue;
        }
        let normal = if piece.closed { v[0] } else { p[0] + numbers.tension };
        assert!(normal.abs() <= ROUNDING, "{numbers:?} at {y:?}: {normal:e}");
        for c in 1..numbers.dim {
            let lack = match piece.tangential {
                Tangential::Free => p[c],
                Tangential::Stick => v[c],
                Tangential::Slip { side } => p[c] - f64::from(side) * numbers.threshold(p[0]),
            };
            assert!(lack.abs() <= ROUNDING, "{numbers:?} at {y:?}, {c}: {lack:e}");
        }
    }
}

/// In the plane the map is linear on a piece: its constant and its slopes give every push.
#[test]
fn the_push_of_a_branch_is_its_constant_and_its_slopes() {
    let rng = &mut Rng::with_seed(2);
    for _ in 0..POINTS {
        let numbers = Numbers::random_in(rng, 2);
        let law = numbers.law();
        let mut y = coordinates(rng, &numbers);
        let (piece, (_, p)) = (law.piece(&y), numbers.map(&y));
        if !numbers.has_obstacle() {
            y[0] = -1.0;
        }
        // The slopes at another point of the piece.
        let [normal, tangential] =
            [[y[0], 0.0, 0.0], [0.0, y[1], 0.0]].map(|y| law.linearised_on(piece).moved(&y));
        let constant = law.constant(piece);
        for c in 0..2 {
            let push = constant[c] + y[c] - normal[c] - tangential[c];
            assert!(near(push, p[c]), "{numbers:?} at {y:?}: {push:e}, {p:?}");
        }
    }
}

/// The four pieces in the plane are those on which points are: open, stick, and slip to both sides.
#[test]
fn the_branches_in_the_plane_are_all() {
    let rng = &mut Rng::with_seed(3);
    for _ in 0..POINTS {
        let numbers = Numbers::random_in(rng, 2);
        let (law, y) = (numbers.law(), coordinates(rng, &numbers));
        let piece = law.piece(&y);
        // Under a bound that is no cone an open pair has friction: those pieces are not among them.
        if piece.closed || law.is_free_when_open() {
            assert!(law.planar_pieces().contains(&piece), "{numbers:?} at {y:?}");
        }
    }
}

/// A closed pair that slips and then would slip against that direction sticks first; nothing else changes.
#[test]
fn a_slip_that_reverses_passes_through_stick() {
    let rng = &mut Rng::with_seed(4);
    let mut reversed = [0; 2];
    for _ in 0..POINTS {
        let numbers = Numbers::random(rng);
        let law = numbers.law();
        let (before, after) = (coordinates(rng, &numbers), coordinates(rng, &numbers));
        let along: f64 = (1..numbers.dim).map(|c| before[c] * after[c]).sum();
        let (was, is) = (law.piece(&before), law.piece(&after));
        let slips = |piece: &Piece| matches!(piece.tangential, Tangential::Slip { .. });
        let reverses = slips(&was) && slips(&is) && is.closed && along < 0.0;
        // A pair that was closed sticks, and keeps pressure and direction.
        let y = law.without_reversal(&before, after);
        if reverses && was.closed {
            assert_eq!(law.piece(&y).tangential, Tangential::Stick, "{numbers:?} {after:?}");
            assert!(y[0] == after[0] && norm(&y) > 0.0 && near(y[1] * after[2], y[2] * after[1]));
            assert!(y[1] * after[1] >= 0.0 && y[2] * after[2] >= 0.0);
        } else {
            assert_eq!(y, after, "{numbers:?} {before:?}");
        }
        reversed[usize::from(reverses)] += 1;
    }
    assert!(reversed.iter().all(|&count| count > POINTS / 20), "{reversed:?}");
}

/// Across a boundary one of both things that a piece says is the other way, and across it again is the same piece.
#[test]
fn a_boundary_has_two_sides() {
    let rng = &mut Rng::with_seed(9);
    for _ in 0..POINTS {
        let numbers = Numbers::random_in(rng, 3);
        let law = numbers.law();
        let piece = law.piece(&coordinates(rng, &numbers));
        for boundary in [Boundary::Contact, Boundary::Slip] {
            if !law.has_boundary(piece, boundary) {
                continue;
            }
            let other = law.across(piece, boundary);
            let is_contact = boundary == Boundary::Contact;
            assert_eq!(other.closed != piece.closed, is_contact, "{numbers:?} {piece:?}");
            assert_eq!(other.slips() != piece.slips(), !is_contact, "{numbers:?} {piece:?}");
            assert_eq!(law.across(other, boundary), piece, "{numbers:?}");
        }
    }
}

/// The distance of the point at `y` from its own piece is zero; with another displacement, or another force, it
/// is what is added to the component that the piece gives.
#[test]
fn the_distance_to_a_piece_is_what_was_added() {
    let rng = &mut Rng::with_seed(5);
    for _ in 0..POINTS {
        let numbers = Numbers::random(rng);
        if !numbers.has_obstacle() {
            continue;
        }
        let (law, y) = (numbers.law(), coordinates(rng, &numbers));
        let piece = law.piece(&y);
        let ((v, p), dim) = (numbers.map(&y), numbers.dim);
        let (mut d, mut force) = numbers.of_host(&v, &p);
        let distance = law.distance_to_piece(piece, &y, &d, &force);
        assert!(norm(&distance) <= 10.0 * ROUNDING, "{numbers:?} at {y:?}: {distance:?}");
        let (more, push) = (uniform(rng, 0.5, 1.0), uniform(rng, 0.5, 1.0));
        (d[0], force[0]) = (d[0] + more, force[0] + push);
        force[dim - 1] += push;
        let distance = law.distance_to_piece(piece, &y, &d, &force);
        let normal = if piece.closed { numbers.k.0 * more } else { push };
        let tangential = if piece.slips() { push } else { 0.0 };
        assert!((distance[0] - normal).abs() <= 1e-10, "{numbers:?} at {y:?}: {distance:?}");
        assert!((distance[dim - 1] - tangential).abs() <= 1e-10, "{numbers:?}: {distance:?}");
    }
}

/// Coordinates from which the linear path in the plane may start: a closed pair sticks with the friction of no
/// pressure, up to a small part, and an open one has slipped less than its clearance over the slope. What is
/// well inside stays, and pressures and clearances do.
#[test]
fn a_sure_start_slips_less_than_its_clearance_allows() {
    let rng = &mut Rng::with_seed(6);
    let mut cut = [0; 2];
    for _ in 0..POINTS {
        let numbers = Numbers::random_in(rng, 2);
        let law = numbers.law();
        let mut y = coordinates(rng, &numbers);
        // Clearances and pressures over four decades.
        y[0] *= 10_f64.powf(uniform(rng, -4.0, 0.0));
        let start = law.sure_start([y[0], y[1]]);
        assert_eq!(start[0], y[0]);
        // Pressed on its obstacle, if it has one, it is stuck up to the same small part.
        let force = uniform(rng, 0.1, 2.0);
        let pressed = law.pressed([y[0], y[1]], force);
        match numbers.has_obstacle() {
            true => assert_eq!(pressed, law.sure_start([force, y[1]])),
            false => assert_eq!(pressed, [y[0], y[1]]),
        }
        let (slope, offset) = (numbers.bound.slope, numbers.bound.offset);
        if slope == 0.0 || !numbers.has_obstacle() {
            assert_eq!(start[1], y[1]);
            continue;
        }
        let most =
            if y[0] > 0.0 { offset } else { offset + numbers.k.1 * (-y[0] / numbers.k.0) / slope };
        let small = if y[0] > 0.0 { 1e-6 * slope * y[0] } else { 0.0 };
        assert!(start[1].abs() <= most + small + ROUNDING, "{numbers:?} at {y:?}: {start:?}");
        let kept = if y[0] > 0.0 { most } else { 0.9 * most };
        let expected = if y[1].abs() <= kept { y[1] } else { start[1] };
        assert!(near(start[1], expected), "{numbers:?} at {y:?}: {start:?}");
        if y[1].abs() > kept {
            cut[usize::from(y[0] > 0.0)] += 1;
            let least = if y[0] > 0.0 { most + 1e-9 * slope * y[0] } else { 0.9 * most };
            assert!(start[1].abs() >= least.min(y[1].abs()) - ROUNDING, "{numbers:?} at {y:?}");
            assert!(start[1] * y[1] >= 0.0);
        }
    }
    assert!(cut.iter().all(|&count| count > POINTS / 50), "{cut:?}");
}

/// A pair that penetrates is released: it stands open by `least` at least, and no lower than before. It keeps its slip, whose
/// product with the slope is less than its clearance, by a tenth at most. Its friction is that of no pressure along the
/// slip; without a slip it stays, as far as no pressure holds it.
#[test]
fn a_released_pair_keeps_its_slip_and_has_room_for_it() {
    let rng = &mut Rng::with_seed(7);
    let mut counts = [0; 2];
    for _ in 0..POINTS {
        let numbers = Numbers::random_in(rng, 2);
        let (law, force) = (numbers.law(), coordinates(rng, &numbers));
        let least = uniform(rng, 1e-3, 1.0);
        if !numbers.has_obstacle() {
            continue;
        }
        let depth = uniform(rng, 1.5, 3.0) * least / numbers.k.0;
        let slip = if rng.bool() { 0.0 } else { uniform(rng, -1.0, 1.0) };
        let d = [law.reference()[0] + depth, law.reference()[1] + slip];
        let y = law.chart(&d, &force[..2]);
        let lifted = law.released(&d, &force[..2], least);
        let at = |y0, y1| {
            let (d, push) = law.point(&[y0, y1, 0.0]);
            (d[1] - law.reference()[1], push[1])
        };
        let before = d[1] - law.reference()[1];
        let (slip, friction) = at(lifted[0], lifted[1]);
        assert!(near(slip, before), "{numbers:?} at {y:?}: {slip}, {before}");
        let needed = numbers.k.0 * numbers.bound.slope * slip.abs();
        let (height, others) = (-lifted[0], least.max(-y[0]));
        assert!(height >= others.max(needed) - ROUNDING, "{numbers:?} at {y:?}: {height}");
        assert!(height <= others.max(1.1 * needed) + ROUNDING, "{numbers:?} at {y:?}: {height}");
        let offset = numbers.bound.offset;
        let expected =
            if before == 0.0 { y[1].max(-offset).min(offset) } else { offset * before.signum() };
        assert!(near(friction, expected), "{numbers:?} at {y:?}: {friction}, {expected}");
        counts[usize::from(needed > others)] += 1;
    }
    assert!(counts.iter().all(|&count| count > POINTS / 50), "{counts:?}");
}

/// The first of the pairs asked for that is closer than its obstacle, with its gap.
#[test]
fn the_first_penetration_is_found() {
    let gaps = [1.0, -2.0, 0.0, -3.0, f64::INFINITY];
    assert_eq!(first_penetration(&gaps, [0, 2, 3, 1].into_iter()), Some((3, -3.0)));
    assert_eq!(first_penetration(&gaps, 0..5), Some((1, -2.0)));
    assert_eq!(first_penetration(&gaps, [0, 2, 4, 9].into_iter()), None);
}

/// The chart holds every point of the law, of pairs without an obstacle too, whose normal displacement is free: a
/// displacement and a force that obey the law come back.
#[test]
fn the_chart_gives_back_its_points() {
    let rng = &mut Rng::with_seed(7);
    for _ in 0..POINTS {
        let numbers = Numbers::random(rng);
        let law = numbers.law();
        let (v, p) = numbers.point(rng, 0.0);
        let (mut d, force) = numbers.of_host(&v, &p);
        if !numbers.has_obstacle() {
            d[0] = uniform(rng, -2.0, 2.0);
        }
        let (back, push) = law.point(&law.chart(&d, &force));
        for c in 0..numbers.dim {
            assert!((back[c] - d[c]).abs() <= 1e-10, "{numbers:?}: {d:?} {back:?}");
            assert!((push[c] + force[c]).abs() <= 1e-10, "{numbers:?}: {force:?} {push:?}");
        }
    }
}

/// A pair meets its obstacle if there is one, and slips beside sticking where its bound is not zero.
#[test]
fn pieces_have_the_boundaries_of_their_bounds() {
    let rng = &mut Rng::with_seed(8);
    for _ in 0..POINTS {
        let numbers = Numbers::random(rng);
        let law = numbers.law();
        for (closed, slips) in [(false, false), (false, true), (true, false), (true, true)] {
            let piece = piece_of(closed, slips);
            let has = |boundary| law.has_boundary(piece, boundary);
            assert_eq!(has(Boundary::Contact), numbers.has_obstacle());
            if closed && !numbers.has_obstacle() {
                continue;
            }
            let Bound { slope, offset } = numbers.bound;
            let expected = offset > 0.0 || (closed && slope > 0.0);
            assert_eq!(has(Boundary::Slip), expected, "{numbers:?} {piece:?}");
        }
    }
}

/// Where a motion goes is said with the sign and the name of its axis.
#[test]
fn a_direction_has_a_name() {
    let bound = Bound { slope: 0.0, offset: 0.0 };
    let [plane, space] =
        [2, 3].map(|dim| PairLaw::new(dim, f64::INFINITY, [0.0; 2], bound, (1.0, 1.0)));
    assert_eq!(plane.direction(1, 2.0), "along +t");
    assert_eq!(plane.direction(1, -2.0), "along -t");
    assert_eq!(space.direction(1, 2.0), "along +t1");
    assert_eq!(space.direction(2, -2.0), "along -t2");
    assert!(space.direction(0, -1.0).contains("away from"));
    assert!(space.direction(0, 1.0).contains("towards"));
}
