//! Doubts of a box, against the matrices at its corners.

use super::{
    BOX, Ball, BallVector, Centre, Neighbourhood, Solver, System, by_inverse, enclosed_force,
};
use crate::law::{Contact, State};
use crate::linalg::vector::largest_of;
use crate::problem::{ContactData, ContactProblem, FrictionLaw};
use fastrand::Rng;

const PAIRS: usize = 4;

/// Systems of each kind.
const SYSTEMS: usize = 50;

/// A corner of the box comes to this part of a doubt in most systems.
const CLOSE: f64 = 0.1;

/// Below this a doubt is rounding alone.
const ROUNDING: f64 = 1e-12;

const FRICTION: f64 = 0.5;

/// The scaled matrix of a system, column-major.
fn matrix(system: &System<'_>) -> Vec<f64> {
    let size = system.unknowns.len();
    let (mut all, mut columns) = (vec![0.0; size * size], system.columns());
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
    let n = dim * PAIRS;
    let root: Vec<f64> = (0..n * n).map(|_| rng.f64() - 0.5).collect();
    let product = |i: usize, j: usize| (0..n).map(|k| root[i + n * k] * root[j + n * k]).sum();
    let mut k: Vec<f64> = (0..n * n).map(|at| product(at % n, at / n)).collect();
    (0..n).for_each(|i| k[i + n * i] += 1.0);
    let mut state = || [State::Open, State::Slip, State::Slip, State::Stick][rng.usize(0..4)];
    (k, (0..PAIRS).map(|_| state()).collect())
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
    let (mu, gap) = (vec![mu; states.len()], vec![0.0; states.len()]);
    let problem = ContactProblem::new(ContactData {
        dim,
        pairs: states.len(),
        stiffness: k,
        ld: n,
        load: &load,
        gap: &gap,
        law: FrictionLaw::Coulomb(&mu),
        reference_slip: None,
    })
    .unwrap();
    let contact = Contact::new(&problem);
    let low = vec![0.0; n];
    let centre = Centre { force: problem.force_of_parts(&d, &low), d, low };
    let frozen = contact.each(&centre.d, &centre.force).zip(states);
    let pairs = frozen
        .map(|((law, v, force), state)| law.enclosed_piece(*state, v, force).unwrap())
        .collect();
    let system = System::new(&contact, pairs, &centre);
    said(&system, &centre)
}

/// The largest part of a doubt that one of 20 corners of the box, taken just inside, comes to: at most 1.
fn check(rng: &mut Rng, dim: usize, eps: f64, given: (&[f64], &[State], f64)) -> f64 {
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
        if largest_of(doubts.iter().copied()) > ROUNDING { closest } else { 1.0 }
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
            check(rng, dim, eps, (&k, &states, FRICTION)) > CLOSE
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
    for (k, mu) in [(&soft, FRICTION), (&coupled, 100.0 * FRICTION)] {
        for eps in [1e-8, 1e-5, 1e-3] {
            let close = |_: &usize| check(rng, 3, eps, (k, &[State::Slip], mu)) > CLOSE;
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
        of_system(rng, 3, (&k, &[State::Slip], FRICTION), |system, centre| {
            let Some(Solver::Inverse(inverse)) = system.solver() else { return };
            let (v, force) = place(system, centre);
            let size = system.unknowns.len();
            // From 1e-6 on.
            for lack in (0..140).map(|step| 1.1_f64.powi(step - 140)) {
                let balls = vec![Ball::exact(lack); size];
                let first = inverse.image(&vec![lack; size], &vec![0.0; size]);
                let eps = BOX * largest_of(first.iter().copied());
                let doubts = Neighbourhood::new(system, &force, &v, eps).doubts();
                let alpha = inverse.contraction(&doubts);
                let into = first.iter().zip(&alpha).all(|(z, alpha)| z + alpha * eps <= eps);
                let found = by_inverse(system, &inverse, &balls, (&force, &v));
                assert!(into || found.is_none(), "{lack:e}: {alpha:?}");
                proved += usize::from(found.is_some());
                contracts += usize::from(!into && largest_of(alpha.iter().copied()) < 1.0);
            }
        });
    }
    assert!(proved > SYSTEMS && contracts > SYSTEMS, "{proved}, {contracts}");
}
