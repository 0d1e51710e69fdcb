//! Doubts of a box, against the matrices at its corners.

use super::{
    BOX, Ball, BallVector, Centre, Enclosure, Neighbourhood, Solver, System, by_inverse, enclose,
    enclosed_force,
};
use crate::law::{Contact, State};
use crate::linalg::tolerances::ROUNDING_OF_SUM;
use crate::linalg::vector::largest_of;
use crate::problem::{ContactProblem, FrictionLaw};
use fastrand::Rng;

/// Systems of each kind.
const SYSTEMS: usize = 50;

/// The scaled matrix of a system, column-major.
fn matrix(system: &System<'_>) -> Vec<f64> {
    let size = system.unknowns.len();
    let (mut all, columns) = (vec![0.0; size * size], system.columns());
    all.chunks_exact_mut(size).enumerate().for_each(|(j, column)| columns(j, column));
    all
}

/// The centre at another corner of the box: unknowns changed by `by`, those of a slip in space being
/// `w`, of which the slip is `unit (1 - 1 / |w|) w`.
fn moved(system: &System<'_>, centre: &Centre, by: &[f64]) -> Centre {
    let dim = system.contact.dim();
    let mut d = centre.d.clone();
    let mut w: Vec<[f64; 2]> = system
        .beyond_reference(centre)
        .iter()
        .zip(&system.pairs)
        .map(|(v, pair)| pair.slip_vector(v).map(Ball::middle))
        .collect();
    for (unknown, by) in system.unknowns.iter().zip(by) {
        let turns = unknown.component > 0 && dim == 3 && w[unknown.pair] != [0.0; 2];
        match turns {
            true => w[unknown.pair][unknown.component - 1] += by * unknown.column,
            false => d[dim * unknown.pair + unknown.component] += by * unknown.column,
        }
    }
    for (pair, w) in w.iter().enumerate().filter(|(_, w)| **w != [0.0; 2]) {
        let rest = system.pairs[pair].unit() * (1.0 - 1.0 / w[0].hypot(w[1]));
        (0..2).for_each(|c| d[dim * pair + 1 + c] = rest * w[c]);
    }
    let low = vec![0.0; d.len()];
    let force = system.contact.problem().force_of_parts(&d, &low);
    Centre { d, low, force }
}

/// A random definite matrix and states.
fn random(rng: &mut Rng, dim: usize) -> (Vec<f64>, Vec<State>) {
    let pairs = 4;
    let n = dim * pairs;
    let root: Vec<f64> = (0..n * n).map(|_| rng.f64() - 0.5).collect();
    let product = |i: usize, j: usize| (0..n).map(|k| root[i + n * k] * root[j + n * k]).sum();
    let mut k: Vec<f64> = (0..n * n).map(|at| product(at % n, at / n)).collect();
    (0..n).for_each(|i| k[i + n * i] += 1.0);
    let mut state = || [State::Open, State::Slip, State::Slip, State::Stick][rng.usize(0..4)];
    (k, (0..pairs).map(|_| state()).collect())
}

/// A statement on the system of a problem on pieces at a place.
fn on_pieces<T>(
    (dim, k, load): (usize, &[f64], &[f64]),
    (states, mu): (&[State], f64),
    (d, force): (Vec<f64>, &[f64]),
    said: impl FnOnce(&System<'_>, &Centre) -> T,
) -> T {
    let (mu, gap) = (vec![mu; states.len()], vec![0.0; states.len()]);
    let problem = ContactProblem::of_test(dim, (k, load), (&gap, FrictionLaw::Coulomb(&mu), None));
    let contact = Contact::new(&problem);
    let pieces = contact.each(&d, force).zip(states);
    let pairs =
        pieces.map(|((law, v, force), state)| law.enclosed_piece(*state, v, force).unwrap());
    let (pairs, low) = (pairs.collect(), vec![0.0; d.len()]);
    let centre = Centre { force: problem.force_of_parts(&d, &low), d, low };
    said(&System::new(&contact, pairs, &centre), &centre)
}

/// A statement on a system at a random place where the states are possible, whether it is a solution or not.
fn of_system<T>(
    rng: &mut Rng,
    dim: usize,
    (k, states, mu): (&[f64], &[State], f64),
    said: impl FnOnce(&System<'_>, &Centre) -> T,
) -> T {
    let n = dim * states.len();
    let component = |i: usize, rng: &mut Rng| match (i % dim, states[i / dim]) {
        (0, State::Open) => [-rng.f64(), 0.0],
        (0, _) => [0.0, -1.0 - rng.f64()],
        (_, State::Stick) => [0.0; 2],
        _ => [rng.f64() - 0.5, rng.f64() - 0.5],
    };
    let (d, force): (Vec<f64>, Vec<f64>) =
        (0..n).map(|i| component(i, rng)).map(|[d, force]| (d, force)).unzip();
    let load: Vec<f64> =
        (0..n).map(|i| (0..n).map(|j| k[i + n * j] * d[j]).sum::<f64>() - force[i]).collect();
    on_pieces((dim, k, &load), (states, mu), (d, &force), said)
}

/// No doubt is exceeded at 20 corners of the box, taken just inside; `true` if one of them comes to a tenth of some doubt.
fn check(rng: &mut Rng, dim: usize, eps: f64, given: (&[f64], &[State], f64)) -> bool {
    let corners: Vec<u64> = (0..20).map(|_| rng.u64(..)).collect();
    of_system(rng, dim, given, |system, centre| {
        let (v, force) = place(system, centre);
        let doubts = Neighbourhood::new(system, &force, &v, eps).doubts();
        let size = system.unknowns.len();
        assert_eq!(doubts.len(), size);
        let (here, mut closest) = (matrix(system), 0.0_f64);
        for corner in corners {
            let inside = 0.999 * eps;
            let side = |j: usize| if corner >> j & 1 == 1 { inside } else { -inside };
            let by: Vec<f64> = (0..size).map(side).collect();
            let there = moved(system, centre, &by);
            let other = matrix(&System::new(system.contact, system.pairs.clone(), &there));
            for (i, doubt) in doubts.iter().enumerate() {
                let sum: f64 =
                    (0..size).map(|j| (other[i + size * j] - here[i + size * j]).abs()).sum();
                assert!(sum <= *doubt, "{dim}D, row {i}: {sum:e} > {doubt:e}");
                closest = closest.max(sum / doubt);
            }
        }
        // A smaller doubt is rounding alone.
        closest > 0.1 || largest_of(doubts.iter().copied()) <= ROUNDING_OF_SUM
    })
}

/// Where the centre is, and the forces that it needs.
fn place(system: &System<'_>, centre: &Centre) -> (Vec<BallVector>, Vec<BallVector>) {
    let force = enclosed_force(system.contact, (&centre.d, &centre.low), &centre.force);
    (system.beyond_reference(centre), force)
}

/// The matrices at corners of a box differ from that at its centre by the doubts at most; and in most systems some
/// row does by a tenth of them. In the plane all but rounding is the same.
#[test]
fn matrices_in_a_box_differ_by_the_doubts_at_most() {
    let rng = &mut Rng::with_seed(1);
    for (dim, eps) in [(2, 1e-3), (3, 1e-8), (3, 1e-5), (3, 1e-3)] {
        let close = |_: &usize| {
            let (k, states) = random(rng, dim);
            check(rng, dim, eps, (&k, &states, 0.5))
        };
        let close = (0..SYSTEMS).filter(close).count();
        assert!(2 * close > SYSTEMS, "{dim}D, {eps:e}: {close}");
    }
}

/// The statement for one pair that slips in space where the turn of the friction decides, as nearly nothing resists one
/// direction, and where its drag does, as the coefficient is large.
#[test]
fn doubts_hold_where_friction_turns_and_drags() {
    let rng = &mut Rng::with_seed(2);
    let soft = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1e-3];
    let coupled = [1.0, 0.5, 0.5, 0.5, 1.0, 0.0, 0.5, 0.0, 1.0];
    for (k, mu) in [(&soft, 0.5), (&coupled, 50.0)] {
        for eps in [1e-8, 1e-5, 1e-3] {
            let close = |_: &usize| check(rng, 3, eps, (k, &[State::Slip], mu));
            assert!(2 * (0..SYSTEMS).filter(close).count() > SYSTEMS, "{mu}, {eps:e}");
        }
    }
}

/// A box that the map does not take into itself proves nothing, though the map contracts there: what the equations
/// lack grows from a box that is certain to one that is not.
#[test]
fn a_box_that_is_not_taken_into_itself_proves_nothing() {
    let rng = &mut Rng::with_seed(3);
    let k = [1.0, 0.2, 0.2, 0.2, 1.0, 0.0, 0.2, 0.0, 0.5];
    let (mut proved, mut contracts) = (0, 0);
    for _ in 0..SYSTEMS {
        of_system(rng, 3, (&k, &[State::Slip], 0.5), |system, centre| {
            let Some(Solver::Inverse(inverse)) = system.solver(&mut || true) else { return };
            let (v, force) = place(system, centre);
            let size = system.unknowns.len();
            // From 1e-6 on.
            for lack in (0..140).map(|step| 1.1_f64.powi(step - 140)) {
                let balls = vec![Ball::exact(lack); size];
                let first = inverse.image(&vec![lack; size], &vec![0.0; size]);
                let eps = BOX * largest_of(first.iter().copied());
                let doubts = Neighbourhood::new(system, &force, &v, eps).doubts();
                let alpha = inverse.contraction(&doubts, &mut || true).expect("it is not ended");
                let into = first.iter().zip(&alpha).all(|(z, alpha)| z + alpha * eps <= eps);
                let found = by_inverse(system, &inverse, &balls, (&force, &v), &mut || true);
                assert!(into || found.is_none(), "{lack:e}: {alpha:?}");
                proved += usize::from(found.is_some());
                contracts += usize::from(!into && largest_of(alpha.iter().copied()) < 1.0);
            }
        });
    }
    assert!(proved > SYSTEMS && contracts > SYSTEMS, "{proved}, {contracts}");
}

/// The enclosure of a place that is off by `off` from a solution at the displacements `d`, all of whose numbers are
/// powers of two or small multiples of them, so that sums are exact.
fn enclosed_off(
    (k, mu): (&[f64; 4], f64),
    state: State,
    (d, force): ([f64; 2], [f64; 2]),
    off: [f64; 2],
) -> Enclosure {
    let load = [0, 1].map(|i| k[i] * d[0] + k[i + 2] * d[1] - force[i]);
    let place = [0, 1].map(|i| d[i] + off[i]);
    on_pieces((2, k, &load), (&[state], mu), (place.to_vec(), &force), |system, centre| {
        let goes_on = &mut || true;
        enclose(system, &system.solver(goes_on).unwrap(), centre, goes_on).unwrap()
    })
}

/// The stiffness `[[2, 1], [1, 2]]` of an open pair resists the direction `(1, -1)` by 1, its least eigenvalue:
/// a place that is off along it lacks a force of the same length. The solution is off by `1 / sqrt(2)` of the radius
/// then, and by all of it where the stiffness is 1 in both directions and the place is off along one.
#[test]
fn a_solution_at_the_rim_of_a_ball_is_in_the_enclosure() {
    for exponent in [-40, -20, -4] {
        let off = 2_f64.powi(exponent);
        let cases = [([2.0, 1.0, 1.0, 2.0], [off, -off]), ([1.0, 0.0, 0.0, 1.0], [off, 0.0])];
        for (k, off) in cases {
            let enclosure = enclosed_off((&k, 0.5), State::Open, ([-1.0, 2.0], [0.0; 2]), off);
            assert!((0..2).all(|i| off[i].abs() <= enclosure.d_radius[i]), "{off:?}");
        }
    }
}

/// A pair that slips has one unknown, its slip, and an equation that is linear with the coefficient `k_tt - mu k_nt`:
/// the first correction is the whole distance.
#[test]
fn a_solution_at_the_rim_of_a_box_is_in_the_enclosure() {
    for exponent in [-40, -20, -4] {
        let off = [0.0, 2_f64.powi(exponent)];
        let truth = ([0.0, 2.0], [-1.0, -0.5]);
        let enclosure = enclosed_off((&[1.0, 0.25, 0.25, 1.0], 0.5), State::Slip, truth, off);
        assert!(off[1] <= enclosure.d_radius[1], "{off:?}: {:?}", enclosure.d_radius);
    }
}

/// The coefficient of a slip, `k_tt -+ mu k_nt`, is rounded twice. Of numbers below one with 53 digits behind the point
/// products are whole multiples of 2^-106, and so are the coefficient and its error.
#[test]
fn doubts_hold_the_rounding_of_the_coefficients() {
    let one = 1_i128 << 53;
    let rng = &mut Rng::with_seed(4);
    let number = |whole: i128| whole as f64 / one as f64;
    let mut inexact = 0;
    for _ in 0..SYSTEMS {
        // Between a half and one: scales are 1, and the stiffness is definite.
        let [k_tt, mu] = [(); 2].map(|()| rng.i128(one / 2..one));
        let k_nt = rng.i128(one / 8..one / 2);
        let k = [1.0, number(k_nt), number(k_nt), number(k_tt)];
        let (d, needed) = (vec![0.0, 1.0], [-1.0, -number(mu)]);
        let load = [number(k_nt) + 1.0, number(k_tt) + number(mu)];
        let pieces = (&[State::Slip][..], number(mu));
        on_pieces((2, &k, &load), pieces, (d, &needed), |system, centre| {
            let (v, force) = place(system, centre);
            let doubt = Neighbourhood::new(system, &force, &v, 0.0).doubts()[0];
            let drag = if system.slopes[0].drag[0] < 0.0 { -mu } else { mu };
            let scale = system.unknowns[0].row * system.unknowns[0].column;
            let unit = scale * 2_f64.powi(-106);
            let exact = k_tt * one - drag * k_nt;
            let error = (exact - (matrix(system)[0] / unit) as i128).unsigned_abs() as f64 * unit;
            assert!(error <= doubt, "{error:e} > {doubt:e}");
            inexact += usize::from(error > 0.0);
        });
    }
    assert!(2 * inexact > SYSTEMS, "{inexact}");
}
