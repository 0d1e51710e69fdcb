//! The bounds that a certificate states: not below what they bound, and not far above it.

use crate::common::dense::{largest, norm, product};
use crate::common::exact::{self, quads};
use crate::common::problems::{
    Case, Law, cohesive, coulomb, decades, definite, frictionless, loaded, mixed, uniform, vector,
};
use crate::common::quad::{self, Quad};
use fastrand::Rng;
use signorini::State::{Open, Slip, Stick};
use signorini::certificate::{certify, certify_pair};
use signorini::{Settings, Status};

/// Half a unit in the last digit of 1.
const UNIT: f64 = f64::EPSILON / 2.0;

/// The residual that counts rounding is above `eta` in twice the precision, and next to it. Of a pair that slips
/// eight roundings are counted, of `|F_t|_1 + 2 g` at most; with `g <= |F_n|` and `|F_t|_1 <= sqrt 2 |F_t|` that
/// is below 3.5 of the forces. The norm and the quotient add eight roundings of `eta`.
#[test]
fn the_residual_is_a_close_bound() {
    for seed in 0..2000 {
        let mut rng = Rng::with_seed(seed);
        let (dim, pairs) = (rng.usize(2..=3), rng.usize(1..=6));
        let condition = decades(&mut rng, 3.0);
        let k = definite(&mut rng, dim * pairs, condition);
        let law = if rng.bool() { coulomb(&mut rng, pairs, 1.0) } else { frictionless(pairs) };
        let mut case = loaded(&mut rng, dim, k, law);
        if rng.bool() {
            // Displacements are far larger than what contact prescribes.
            case.gap.iter_mut().for_each(|gap| *gap *= 1e-6);
            case.slip = None;
        }
        let d = vector(&mut rng, case.size());
        let eta = exact::eta(&case, &quads(&d));
        let certificate = certify(&case.problem(), &d);
        let residual = certificate.residual;
        assert!(eta <= residual, "seed {seed}: {eta:e} > {residual:e}");
        let above = f64::EPSILON * (8.0 * 3.5 + 16.0 * eta);
        assert!(residual <= eta + above, "seed {seed}: {residual:e} - {eta:e} > {above:e}");
    }
}

/// The law itself rounds: a pair that slips at `d = 0`, beyond its reference slip by 1, has the forces `-f` exactly, and
/// lacks `mu f_n - f_t`. With `f_t` the nearest double to `mu f_n` the computed lack is nothing. Of numbers with 53 digits
/// behind the point the product is a whole multiple of 2^-106, and so is its rounding.
#[test]
fn the_residual_counts_the_rounding_of_the_law() {
    const ONE: i128 = 1 << 53;
    let rng = &mut Rng::with_seed(1);
    let number = |whole: i128| whole as f64 / ONE as f64;
    let mut inexact = 0;
    for seed in 0..200 {
        let [press, mu] = [(); 2].map(|()| rng.i128(ONE / 2..ONE));
        let f = vec![number(press), number(press) * number(mu)];
        let off = press * mu - (f[1] * 2_f64.powi(106)) as i128;
        let eta = off.unsigned_abs() as f64 * 2_f64.powi(-106) / norm(&f);
        let law = Law::Coulomb(vec![number(mu)]);
        let (k, slip) = (vec![1.0, 0.0, 0.0, 1.0], Some(vec![-1.0]));
        let case = Case { dim: 2, pairs: 1, k, f, gap: vec![0.0], law, slip };
        let certificate = certify(&case.problem(), &[0.0; 2]);
        assert_eq!(certificate.states, [Slip]);
        assert!(eta <= certificate.residual, "seed {seed}: {eta:e} > {:e}", certificate.residual);
        inexact += usize::from(off != 0);
    }
    assert!(inexact > 100, "{inexact} of 200");
}

/// A force that overflows is no number, which neither the branches of the law nor the larger of two see: a pair that
/// touches at a displacement whose force overflows lacks nothing that could be seen. Nothing is certified there, nor at
/// displacements that are no numbers.
#[test]
fn what_is_no_number_is_not_certified() {
    let large = 1e200;
    let (k, f, gap) = (vec![large, 0.0, 0.0, 1.0], vec![1.0, 0.0], vec![large]);
    let law = Law::Coulomb(vec![0.5]);
    let case = Case { dim: 2, pairs: 1, k, f, gap, law, slip: None };
    for d in [large, f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
        let certificate = certify(&case.problem(), &[d, 0.0]);
        assert!(!certificate.holds(0.1), "{d}: {certificate:?}");
        assert_eq!(certificate.eta, f64::INFINITY, "{d}");
    }
}

/// One pair on unit stiffness and a second one far away, displaced by `far`. `slip0` is the reference slip of the
/// first pair, which sticks where it is.
fn displaced(gap: f64, slip0: f64, far: f64, load: f64) -> (Case, Vec<f64>) {
    let mut k = vec![0.0; 16];
    (0..4).for_each(|i| k[5 * i] = 1.0);
    let f = vec![0.0, 0.0, load, 0.0];
    let (gap, slip) = (vec![gap, f64::INFINITY], Some(vec![slip0, 0.0]));
    let law = Law::Tresca(vec![1e3, 0.0]);
    (Case { dim: 2, pairs: 2, k, f, gap: gap.clone(), law, slip }, vec![gap[0], slip0, far, 0.0])
}

/// `rounding` is half a unit of `|K| |d|`, relative to the larger of loads and forces, and what the law makes of it: at
/// least once, and at most four times without friction that depends on the pressure.
#[test]
fn rounding_is_that_of_the_product() {
    let check = |(case, d): (Case, Vec<f64>)| {
        let certificate = certify(&case.problem(), &d);
        let forces: Vec<f64> =
            product(&case.k, &d).iter().zip(&case.f).map(|(a, f)| a - f).collect();
        let scale = norm(&case.f).max(norm(&forces));
        let once = UNIT * norm(&d) / scale;
        let told = certificate.rounding;
        // Components up to what is prescribed and those beyond are summed apart: twice at most for two of them.
        assert!(told >= once && told <= 8.0 * once, "{d:?}: {once:e}, {certificate:?}");
    };
    for load in [0.0, 8.0, 5000.0] {
        check(displaced(0.0, 0.0, 5000.0, load));
        for (gap, slip) in [(2.0, 0.0), (-2.0, 0.0), (0.0, 2.0), (0.0, -2.0), (1.0, -2.0)] {
            check(displaced(gap, slip, 1500.0, load));
            check(displaced(gap, slip, 5000.0, load));
        }
    }
}

/// Displacements that are rounded to doubles have an `eta` no further away than `rounding` says, whatever the
/// friction and with loads or without: `d` and `d + low` with the largest `low` that rounding leaves, each
/// sign by chance, measured in twice the precision.
#[test]
fn rounding_bounds_what_rounded_displacements_do() {
    for seed in 0..6000 {
        let mut rng = Rng::with_seed(seed);
        let (dim, pairs) = (rng.usize(2..=3), rng.usize(1..=4));
        let condition = 10_f64.powf(uniform(&mut rng, 0.0, 12.0));
        let k = definite(&mut rng, dim * pairs, condition);
        let mu = 10_f64.powf(uniform(&mut rng, -1.0, 3.0));
        let law = coulomb(&mut rng, pairs, mu);
        let mut case = loaded(&mut rng, dim, k, law);
        if rng.bool() {
            case.f.fill(0.0);
            case.gap.iter_mut().for_each(|gap| *gap = -1.0);
        }
        let d = case.solve(&Settings::default()).d;
        let low: Vec<f64> =
            d.iter().map(|d| if rng.bool() { UNIT * d } else { -UNIT * d }).collect();
        let moved: Vec<Quad> = d.iter().zip(&low).map(|(&d, &low)| Quad::sum(d, low)).collect();
        let (one, other) = (exact::eta(&case, &quads(&d)), exact::eta(&case, &moved));
        let told = certify(&case.problem(), &d).rounding;
        // The scale, the larger of loads and forces, changes as the forces do.
        let bound = told * (1.0 + one.max(other));
        assert!((one - other).abs() <= bound, "seed {seed}: {one:e}, {other:e}, {told:e}");
    }
}

/// `equilibrium` is the largest component of `K d - f - F` with the force that is returned, whichever force is
/// given: on springs without coupling, worked out by components.
#[test]
fn equilibrium_is_measured_with_the_force_that_is_returned() {
    for seed in 0..500 {
        let mut rng = Rng::with_seed(seed);
        let (dim, pairs) = (rng.usize(2..=3), rng.usize(1..=4));
        let k = definite(&mut rng, dim * pairs, 10.0);
        let law = coulomb(&mut rng, pairs, 1.0);
        let case = loaded(&mut rng, dim, k, law);
        let (d, force) = (vector(&mut rng, case.size()), vector(&mut rng, case.size()));
        let problem = case.problem();
        for certificate in [certify(&problem, &d), certify_pair(&problem, &d, &force)] {
            let lacking = product(&case.k, &d);
            let lacking = lacking.iter().zip(&case.f).zip(&certificate.force);
            let lacking: Vec<f64> = lacking.map(|((kd, f), force)| kd - f - force).collect();
            // Sums of some ten numbers of order 10.
            let error = (certificate.equilibrium - largest(&lacking)).abs();
            assert!(error <= 1e-13, "seed {seed}: {lacking:?}, {certificate:?}");
        }
    }
}

/// The forces that are returned lack no more to equilibrium than `eta` of the larger of loads and forces, under every law,
/// at displacements by chance and in twice the precision. An open pair has no pressure and no friction below 1e-11 of the
/// largest force. Without the friction that a pair loses where it is apart, the residual is below that in many cases.
#[test]
fn forces_lack_no_more_than_eta() {
    let mut beyond = 0;
    for seed in 0..4000 {
        let mut rng = Rng::with_seed(seed);
        let (dim, pairs) = (rng.usize(2..=3), rng.usize(1..=4));
        let condition = decades(&mut rng, 6.0);
        let k = definite(&mut rng, dim * pairs, condition);
        let mu = 10_f64.powf(uniform(&mut rng, -1.0, 3.0));
        let law = match rng.u8(0..3) {
            0 => coulomb(&mut rng, pairs, mu),
            1 => cohesive(&mut rng, pairs, mu),
            _ => mixed(&mut rng, (dim, pairs), mu),
        };
        let case = loaded(&mut rng, dim, k, law);
        let d = vector(&mut rng, case.size());
        let certificate = certify(&case.problem(), &d);
        let needed = exact::force(&case, &quads(&d));
        let scale = exact::scale(&case, &needed).value();
        let lacking: Vec<Quad> = needed
            .iter()
            .zip(&certificate.force)
            .map(|(&needed, &force)| needed - Quad::from(force))
            .collect();
        let lacking = quad::norm(&lacking).value() / scale;
        let told = certificate.eta + 2e-11 * pairs as f64;
        assert!(lacking <= told, "seed {seed}: {lacking:e} > {told:e}: {case:?} {d:?}");
        let natural = quad::norm(&exact::residual(&case, &quads(&d), &needed)).value() / scale;
        beyond += usize::from(lacking > 1.1 * natural);
    }
    assert!(beyond > 100, "{beyond}");
}

/// Of displacements in two parts `equilibrium` is that of the first alone: not below `|K d - f - F|`, in twice the precision,
/// and the forces returned are those of both parts. With condition numbers of 1e10 the second part is needed.
#[test]
fn equilibrium_counts_what_the_second_part_of_displacements_does() {
    let (mut counted, mut seed) = (0, 0);
    while counted < 50 {
        seed += 1;
        let mut rng = Rng::with_seed(seed);
        let (dim, pairs) = (rng.usize(2..=3), rng.usize(1..=4));
        let k = definite(&mut rng, dim * pairs, 1e10);
        let law = coulomb(&mut rng, pairs, 1.0);
        let case = loaded(&mut rng, dim, k, law);
        let solution = case.solve(&Settings::default());
        if solution.d_low.iter().all(|&low| low == 0.0) {
            continue;
        }
        counted += 1;
        let needed = exact::force(&case, &quads(&solution.d));
        let lacking: Vec<Quad> = needed
            .iter()
            .zip(&solution.certificate.force)
            .map(|(needed, &force)| Quad::sum(needed.value(), -force))
            .collect();
        let most = lacking.iter().fold(0.0, |most: f64, lack| most.max(lack.abs().value()));
        let told = solution.certificate.equilibrium;
        assert!(most <= told, "seed {seed}: {most:e} > {told:e}");
    }
}

/// Forces so small that products have lost their digits are not certified: of two components and two roundings, four times
/// the smallest number, beside half an epsilon of the terms, twice the load: 2^-1072 against 2^-1052 of it.
#[test]
fn forces_without_digits_are_not_certified() {
    for (exponent, holds) in [(-1000, true), (-1018, true), (-1022, false), (-1040, false)] {
        let load = 2_f64.powi(exponent / 2) * 2_f64.powi(exponent / 2);
        let (k, f, gap) = (vec![1.0, 0.0, 0.0, 1.0], vec![load, 0.0], vec![f64::INFINITY]);
        let law = frictionless(1);
        let case = Case { dim: 2, pairs: 1, k, f, gap, law, slip: None };
        let certificate = certify_pair(&case.problem(), &[load, 0.0], &[0.0; 2]);
        assert_eq!((certificate.eta, certificate.count(Open)), (0.0, 1), "2^{exponent}");
        assert_eq!(certificate.holds(1e-10), holds, "2^{exponent}: {certificate:?}");
    }
}

/// The energy that resists a motion is that of the stiffness, whatever contact forces act. Two parts hold each
/// other, `[[1, -1], [-1, 1 + e]]`; with `e` of 2^-44 rounding alone holds them as a whole. They stand against an
/// obstacle at `1/e`, which presses as the load does.
#[test]
fn contact_forces_do_not_resist_a_motion() {
    let e = 2_f64.powi(-44);
    let mut k = vec![0.0; 16];
    (k[0], k[2], k[8], k[10]) = (1.0, -1.0, -1.0, 1.0 + e);
    (k[5], k[15]) = (1.0, 1.0);
    for press in [0.0, 1.0, 1024.0] {
        let f = vec![press, 0.0, 1.0, 0.0];
        let gap = vec![1.0 / e, f64::INFINITY];
        let law = Law::Coulomb(vec![0.0; 2]);
        let case = Case { dim: 2, pairs: 2, k: k.clone(), f, gap, law, slip: None };
        let certificate = certify(&case.problem(), &[1.0 / e, 0.0, 1.0 / e, 0.0]);
        assert_eq!(certificate.eta, 0.0, "{certificate:?}");
        assert_eq!(certificate.force, [-press, 0.0, 0.0, 0.0]);
        assert!(!certificate.holds(1e-2), "{certificate:?}");
    }
}

/// Where displacements do not determine the forces, `K d` is not known and no energy of it resists a motion: parts
/// that `e` of 2^-36 holds are a solution by the energy of their stiffness, and none without it.
#[test]
fn only_a_stiffness_resists_a_motion() {
    let e = 2_f64.powi(-36);
    let mut k = vec![0.0; 16];
    (k[0], k[2], k[8], k[10]) = (1.0, -1.0, -1.0, 1.0 + e);
    (k[5], k[15]) = (1.0, 1.0);
    let (f, gap) = (vec![0.0, 0.0, 1.0, 0.0], vec![f64::INFINITY; 2]);
    let law = Law::Coulomb(vec![0.0; 2]);
    let case = Case { dim: 2, pairs: 2, k, f, gap, law, slip: None };
    let d = [1.0 / e, 0.0, 1.0 / e, 0.0];
    assert!(certify(&case.problem(), &d).holds(1e-14));
    let certificate = certify_pair(&case.problem(), &d, &[0.0; 4]);
    assert_eq!(certificate.eta, 0.0);
    assert!(!certificate.holds(1e-2), "{certificate:?}");
}

/// The `eta` that a solution reports counts the rounding of its evaluation, which is far below the tolerance here.
#[test]
fn what_is_reported_counts_rounding() {
    let mut above = 0;
    for seed in 0..100 {
        let mut rng = Rng::with_seed(seed);
        let (dim, pairs) = (rng.usize(2..=3), rng.usize(1..=4));
        let k = definite(&mut rng, dim * pairs, 10.0);
        let law = coulomb(&mut rng, pairs, 0.5);
        let case = loaded(&mut rng, dim, k, law);
        let solution = case.solve(&Settings::default());
        assert_eq!(solution.status, Status::Solved, "seed {seed}: {}", solution.message);
        let (eta, residual) = (solution.certificate.eta, solution.certificate.residual);
        assert_eq!(eta, residual, "seed {seed}");
        above += usize::from(eta > certify(&case.problem(), &solution.d).eta);
    }
    assert!(above > 10, "{above} with rounding");
}

/// The margin between states is 1e-11 of the largest load or force. Two pairs on unit stiffness; the second carries
/// `small` beside 1. Where friction under that pressure is above the margin, with a coefficient of 1024, it
/// is no open pair.
#[test]
fn forces_below_the_margin_tell_no_states() {
    for (exponent, mu, expected) in [
        (-34, 0.0, Slip),
        (-36, 0.0, Slip),
        (-37, 0.0, Open),
        (-40, 0.0, Open),
        (-40, 1024.0, Stick),
        (-46, 1024.0, Stick),
        (-47, 1024.0, Open),
    ] {
        let small = 2_f64.powi(exponent);
        let k = (0..16).map(|i| if i % 5 == 0 { 1.0 } else { 0.0 }).collect();
        let f = vec![1.0, 0.0, small, 0.0];
        let law = Law::Coulomb(vec![1.0, mu]);
        let case = Case { dim: 2, pairs: 2, k, f, gap: vec![0.0; 2], law, slip: None };
        let certificate = certify(&case.problem(), &[0.0; 4]);
        assert_eq!(certificate.states, [Stick, expected], "2^{exponent}, {mu}");
    }
}

/// The first pair has gone so far that its stiffness of 1e-13 makes a force of 1, which the load doubles where it should balance it.
/// Its coupling presses the second pair with 3e11: beside that the 2 which are left are 7e-12, a solution by `eta`, although the
/// load alone makes all forces and is 1. It is none; with a load that balances it is.
#[test]
fn what_is_left_is_no_more_than_the_loads() {
    let (away, coupling) = (1e13, 0.03);
    for (load, is_solution) in [(1.0, false), (-1.0, true)] {
        let mut k = vec![0.0; 16];
        for (i, entry) in [1e-13, 1.0, 1e10, 1.0].into_iter().enumerate() {
            k[5 * i] = entry;
        }
        (k[2], k[8]) = (coupling, coupling);
        let f = vec![load, 0.0, 0.0, 0.0];
        let law = Law::Coulomb(vec![0.3; 2]);
        let case = Case { dim: 2, pairs: 2, k, f, gap: vec![0.0; 2], law, slip: None };
        let certificate = certify(&case.problem(), &[-away, 0.0, 0.0, 0.0]);
        assert!(certificate.eta < 1e-11, "{load}: {:e}", certificate.eta);
        assert_eq!(certificate.holds(1e-10), is_solution, "{load}");
    }
}
