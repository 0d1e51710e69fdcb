//! Two condensed bodies against the system in `(u_A, d)` from which the reduction follows.

use crate::common::dense::{condensed, difference, largest, product};
use crate::common::problems::{definite, floating, semidefinite, uniform, vector};
use fastrand::Rng;
use signorini::{
    Argument, ContactData, ContactProblem, Error, FrictionLaw, LoadCase, Method, Model, Monitor,
    Settings, Solution, Status, solve,
};

/// Two bodies with loads and contact data, each in its own outward frame.
struct Pair {
    dim: usize,
    pairs: usize,
    first: Vec<f64>,
    second: Vec<f64>,
    load: Vec<f64>,
    gap: Vec<f64>,
    mu: Vec<f64>,
}

impl Pair {
    fn size(&self) -> usize {
        self.dim * self.pairs
    }

    fn model(&self) -> Model {
        let n = self.size();
        Model::two_body(self.dim, self.pairs, (&self.first, n), (&self.second, n)).unwrap()
    }

    fn swapped(&self) -> Pair {
        let (first, second) = self.load.split_at(self.size());
        Pair {
            first: self.second.clone(),
            second: self.first.clone(),
            load: [second, first].concat(),
            gap: self.gap.clone(),
            mu: self.mu.clone(),
            ..*self
        }
    }

    fn frictionless(self) -> Pair {
        Pair { mu: vec![0.0; self.pairs], ..self }
    }

    fn solve(&self, method: Method) -> Solution {
        let case = LoadCase {
            load: &self.load,
            prescribed: None,
            gap: &self.gap,
            law: FrictionLaw::Coulomb(&self.mu),
            reference_slip: None,
        };
        let settings = Settings { method, tolerance: 1e-12, ..Settings::default() };
        let monitor = &mut Monitor::new(&settings, None);
        let solution = self.model().solve(&case, &settings, None, monitor).unwrap();
        assert_eq!(solution.status, Status::Solved, "{}", solution.message);
        solution
    }

    /// `K_rel` and `f_rel` by elimination of `u_A` from
    /// `[[K_A + K_B, -K_B], [-K_B, K_B]] [u_A; d] = [f_A - f_B; f_B] + [0; F]`.
    fn condensed(&self) -> (Vec<f64>, Vec<f64>) {
        let n = self.size();
        let mut matrix = vec![0.0; 4 * n * n];
        for j in 0..n {
            for i in 0..n {
                let (a, b) = (self.first[i + n * j], self.second[i + n * j]);
                matrix[i + 2 * n * j] = a + b;
                matrix[n + i + 2 * n * j] = -b;
                matrix[i + 2 * n * (n + j)] = -b;
                matrix[n + i + 2 * n * (n + j)] = b;
            }
        }
        let (first, second) = self.load.split_at(n);
        let right = [&difference(first, second)[..], second].concat();
        condensed(&matrix, &right, n)
    }
}

/// Both bodies definite, of condition numbers up to `condition`; loads that press more than not.
fn bodies(rng: &mut Rng, condition: f64) -> Pair {
    let dim = rng.usize(2..=3);
    let pairs = rng.usize(1..=8);
    let n = dim * pairs;
    let first = definite(rng, n, condition);
    let second = definite(rng, n, condition);
    with_loads(rng, dim, pairs, first, second)
}

fn with_loads(rng: &mut Rng, dim: usize, pairs: usize, first: Vec<f64>, second: Vec<f64>) -> Pair {
    let n = dim * pairs;
    let mut load = vector(rng, 2 * n);
    load.iter_mut().step_by(dim).for_each(|f| *f += 0.4);
    Pair {
        dim,
        pairs,
        first,
        second,
        load,
        gap: (0..pairs).map(|_| uniform(rng, -0.3, 0.5)).collect(),
        mu: (0..pairs).map(|_| uniform(rng, 0.0, 0.3)).collect(),
    }
}

/// One body that a plane does not hold, the other held; in either place. The loads on the floating
/// one do no work on its free motions: they are orthogonal to the kernel, and so are in balance
/// without contact.
fn with_floating_body(rng: &mut Rng) -> Pair {
    let pairs = rng.usize(2..=8);
    let (free, motions) = floating(rng, pairs, 100.0);
    let held = definite(rng, 2 * pairs, 100.0);
    let mut pair = with_loads(rng, 2, pairs, free.clone(), held.clone());
    let n = pair.size();
    // In the range of the stiffness: K x, about as large as the other loads.
    let load = product(&free, &vector(rng, n));
    let size = largest(&load).max(1e-3);
    pair.load[..n].iter_mut().zip(&load).for_each(|(f, load)| *f = load / size);
    assert!(motions.iter().all(|motion| largest(&product(&free, motion)) < 1e-12));
    if rng.bool() { pair.swapped() } else { pair }
}

fn close(a: &[f64], b: &[f64], tolerance: f64, what: &str) {
    let error = largest(&difference(a, b)) / largest(b).max(f64::MIN_POSITIVE);
    assert!(error <= tolerance, "{what}: {error:e}");
}

/// Rounding of the elimination: 24 unknowns, condition numbers up to 100, 1e-16: below 1e-12.
#[test]
fn stiffness_and_load_are_the_schur_complement_in_u_a_and_d() {
    for seed in 0..300 {
        let mut rng = Rng::with_seed(seed);
        let pair =
            if seed % 2 == 0 { bodies(&mut rng, 100.0) } else { with_floating_body(&mut rng) };
        let (stiffness, load) = pair.condensed();
        close(pair.model().stiffness(), &stiffness, 1e-12, &format!("seed {seed}: K_rel"));
        // The force that the solver certifies on belongs to K_rel and f_rel: with everything
        // open, d = K_rel^-1 f_rel, so that f_rel = K_rel d.
        if seed % 2 == 0 {
            let open = Pair { gap: vec![f64::INFINITY; pair.pairs], ..pair };
            let d = open.solve(Method::SorNested).d;
            close(&product(&stiffness, &d), &load, 1e-10, &format!("seed {seed}: f_rel"));
        }
    }
}

/// The model of two bodies and the contact problem on the eliminated system agree, to the accuracy
/// of 1e-12 on which both are certified times condition numbers of 100.
#[test]
fn solution_is_that_of_the_eliminated_system() {
    for seed in 0..100 {
        let pair = bodies(&mut Rng::with_seed(seed), 100.0);
        let (stiffness, load) = pair.condensed();
        // Mirrored, as the elimination leaves the rounding of 1e-15 between the triangles.
        let problem = ContactProblem::new(ContactData {
            dim: pair.dim,
            pairs: pair.pairs,
            stiffness: &stiffness,
            ld: pair.size(),
            load: &load,
            gap: &pair.gap,
            law: FrictionLaw::Coulomb(&pair.mu),
            reference_slip: None,
        })
        .unwrap();
        let settings = Settings { tolerance: 1e-12, ..Settings::default() };
        let monitor = &mut Monitor::new(&settings, None);
        let other = solve(&problem, &settings, None, monitor).unwrap();
        let solution = pair.solve(Method::SorNested);
        close(&solution.d, &other.d, 1e-9, &format!("seed {seed}: d"));
        close(
            &solution.certificate.force,
            &other.certificate.force,
            1e-9,
            &format!("seed {seed}: F"),
        );
    }
}

/// `K_A u_A = f_A + F`, `K_B u_B = f_B + F`, `u_A + u_B = d`, to 1e-10 of the forces: a hundred
/// times the tolerance.
#[test]
fn recovered_displacements_are_in_equilibrium_in_both_bodies() {
    for seed in 0..300 {
        let mut rng = Rng::with_seed(seed);
        let pair =
            if seed % 3 > 0 { bodies(&mut rng, 100.0) } else { with_floating_body(&mut rng) };
        let solution = pair.solve(Method::SorNested);
        let n = pair.size();
        let u = pair.model().recover(Some(&pair.load), None, &solution.d).unwrap();
        let (first, second) = u.split_at(n);
        let force = &solution.certificate.force;
        let sizes = largest(&pair.load).max(largest(force));
        for (name, k, u, f) in [
            ("A", &pair.first, first, &pair.load[..n]),
            ("B", &pair.second, second, &pair.load[n..]),
        ] {
            let residual = difference(&difference(&product(k, u), f), force);
            assert!(largest(&residual) <= 1e-10 * sizes, "seed {seed}: body {name}: {residual:?}");
        }
        let sum: Vec<f64> = first.iter().zip(second).map(|(a, b)| a + b).collect();
        close(
            &sum,
            &solution.d,
            1e-14 * (largest(&u) / largest(&solution.d)).max(1.0),
            "u_A + u_B",
        );
        let nodal = pair.model().nodal_forces(force).unwrap();
        assert_eq!(nodal, [&force[..], force].concat());
    }
}

/// Which body is called A means nothing, whatever their stiffness: also where one is a million
/// times the stiffer. To the tolerance of 1e-12 times a condition number of 100 of the solution.
#[test]
fn swapped_bodies_give_the_same_answer() {
    for ratio in [1.0, 1e3, 1e6] {
        for seed in 0..100 {
            let mut pair = bodies(&mut Rng::with_seed(seed), 100.0);
            pair.second.iter_mut().for_each(|k| *k *= ratio);
            let (one, two) =
                (pair.solve(Method::SorNested), pair.swapped().solve(Method::SorNested));
            let context = format!("ratio {ratio}, seed {seed}");
            close(&one.d, &two.d, 1e-9, &format!("{context}: d"));
            close(&one.certificate.force, &two.certificate.force, 1e-9, &format!("{context}: F"));
        }
    }
}

/// The stiffness of the pair is that of springs in a row: `K_rel⁻¹ = K_A⁻¹ + K_B⁻¹`, so that with
/// `K_B = r K_A` it is `r / (1 + r) K_A`, whatever `r`. Rounding of condition numbers of 100.
#[test]
fn proportional_bodies_are_springs_in_a_row() {
    let mut rng = Rng::with_seed(7);
    for ratio in [1e-12, 1e-8, 1e-4, 1.0, 1e4, 1e8, 1e12] {
        let first = definite(&mut rng, 12, 100.0);
        let second: Vec<f64> = first.iter().map(|k| ratio * k).collect();
        let model = Model::two_body(2, 6, (&first, 12), (&second, 12)).unwrap();
        let exact: Vec<f64> = first.iter().map(|k| ratio / (1.0 + ratio) * k).collect();
        close(model.stiffness(), &exact, 1e-12, &format!("K_B = {ratio} K_A"));
    }
}

/// Bodies of 1e308 each have a sum that is no double, of which nothing else must be said. Half of that is solved: two springs
/// in a row, pressed by `1e300`, give `1e300 / 2.5e307`.
#[test]
fn a_stiffness_beyond_doubles_is_named() {
    let body = |k: f64| [k, 0.0, 0.0, k];
    let refused = Model::two_body(2, 1, (&body(1e308), 2), (&body(1e308), 2)).err().unwrap();
    let message = refused.message().to_string();
    assert!(message.contains("K_A + K_B: component 0 overflows; choose units"), "{message}");
    let model = Model::two_body(2, 1, (&body(5e307), 2), (&body(5e307), 2)).unwrap();
    let case = LoadCase {
        load: &[1e300, 0.0, 1e300, 0.0],
        prescribed: None,
        gap: &[f64::INFINITY],
        law: FrictionLaw::Frictionless,
        reference_slip: None,
    };
    let settings = Settings::default();
    let solution = model.solve(&case, &settings, None, &mut Monitor::new(&settings, None)).unwrap();
    assert_eq!(solution.status, Status::Solved, "{}", solution.message);
    // Each operation rounds once, and certified to 1e-10.
    assert!((solution.d[0] / (1e300 / 2.5e307) - 1.0).abs() <= 1e-10, "{:e}", solution.d[0]);
}

/// A body on one that is `1e8` times the stiffer is the body on an obstacle, up to `1e-8` times
/// the condition numbers of 100 and what the contact law makes of it: below 1e-5.
#[test]
fn a_very_stiff_second_body_is_an_obstacle() {
    for seed in 0..100 {
        let mut pair = bodies(&mut Rng::with_seed(seed), 100.0);
        pair.second.iter_mut().for_each(|k| *k *= 1e8);
        let n = pair.size();
        let alone = Model::condensed(pair.dim, pair.pairs, &pair.first, n).unwrap();
        let case = LoadCase {
            load: &pair.load[..n],
            prescribed: None,
            gap: &pair.gap,
            law: FrictionLaw::Coulomb(&pair.mu),
            reference_slip: None,
        };
        let settings = Settings::default();
        let monitor = &mut Monitor::new(&settings, None);
        let obstacle = alone.solve(&case, &settings, None, monitor).unwrap();
        let solution = pair.solve(Method::SorNested);
        close(&solution.d, &obstacle.d, 1e-5, &format!("seed {seed}: d"));
        close(
            &solution.certificate.force,
            &obstacle.certificate.force,
            1e-5,
            &format!("seed {seed}: F"),
        );
    }
}

/// Frictionless, Lemke's method and relaxation find the same, one body floating or not. To 1e-8:
/// the tolerance of 1e-12 times the condition of `K_rel`, some 1e3 on its range. The part of `d` in
/// the kernel of `K_rel` is not unique, the strains `K_rel d` are.
#[test]
fn lemke_and_relaxation_agree_without_friction() {
    for seed in 0..200 {
        let mut rng = Rng::with_seed(seed);
        let floats = seed % 2 == 1;
        let pair = if floats { with_floating_body(&mut rng) } else { bodies(&mut rng, 100.0) };
        let pair = pair.frictionless();
        let (lemke, sor) = (pair.solve(Method::Lemke), pair.solve(Method::SorNested));
        let context = format!("seed {seed}");
        let size = largest(&pair.load);
        let apart = difference(&lemke.certificate.force, &sor.certificate.force);
        assert!(largest(&apart) <= 1e-8 * size, "{context}: F {:e}", largest(&apart));
        let strains = |d: &[f64]| product(pair.model().stiffness(), d);
        let apart = difference(&strains(&lemke.d), &strains(&sor.d));
        assert!(largest(&apart) <= 1e-8 * size, "{context}: K d {:e}", largest(&apart));
        if !floats {
            close(&lemke.d, &sor.d, 1e-8, &format!("{context}: d"));
        }
    }
}

/// A motion that strains neither body is refused, by one of its components.
#[test]
fn a_motion_free_in_both_bodies_is_refused() {
    let mut rng = Rng::with_seed(3);
    for first in 0..4 {
        let n = 12;
        let mut motion = vec![0.0; n];
        let support = 2 * first + 1..2 * first + 4;
        motion[support.clone()].iter_mut().for_each(|r| *r = uniform(&mut rng, 0.5, 1.0));
        let kernel = [motion];
        let a = semidefinite(&mut rng, n, 10.0, &kernel);
        let b = semidefinite(&mut rng, n, 10.0, &kernel);
        let held = definite(&mut rng, n, 10.0);
        assert!(Model::two_body(2, 6, (&a, n), (&held, n)).is_ok());
        assert!(Model::two_body(2, 6, (&held, n), (&b, n)).is_ok());
        let Err(Error::Invalid { argument, message }) = Model::two_body(2, 6, (&a, n), (&b, n))
        else {
            panic!("the motion is free in both bodies");
        };
        assert_eq!(argument, Argument::Matrix);
        let named = message.rsplit(' ').next().and_then(|word| word.parse::<usize>().ok());
        assert!(named.is_some_and(|component| support.contains(&component)), "{message}");
    }
}

/// Bodies that are pulled off: which one moves, which pair most, and the resultant, 1 on each of two
/// nodes. Body A resists no translation, body B is held.
#[test]
fn the_body_that_flies_off_is_named() {
    let mut free = vec![0.0; 16];
    let mut held = vec![0.0; 16];
    for i in 0..4 {
        free[5 * i] = 1.0;
        free[i + 4 * ((i + 2) % 4)] = -1.0;
        held[5 * i] = 4.0;
    }
    let pull = [-1.0, 0.0, -1.0, 0.0];
    let two = Model::two_body(2, 2, (&free, 4), (&held, 4)).unwrap();
    let one = Model::condensed(2, 2, &free, 4).unwrap();
    let moves = "2 of 2 pairs, most of all pair 0 by (-1.000, 0.000) along its normal and tangent";
    for (model, load, words) in [
        (two, [pull, [0.0; 4]].concat(), format!("it moves body A: {moves}; body B not at all;")),
        (one, pull.to_vec(), format!("it moves {moves};")),
    ] {
        let case = LoadCase {
            load: &load,
            prescribed: None,
            gap: &[0.0; 2],
            law: FrictionLaw::Coulomb(&[0.5; 2]),
            reference_slip: None,
        };
        let settings = Settings::default();
        let monitor = &mut Monitor::new(&settings, None);
        let solution = model.solve(&case, &settings, None, monitor).unwrap();
        assert_eq!(solution.status, Status::NoEquilibrium, "{}", solution.message);
        assert!(solution.message.contains(&words), "{}", solution.message);
        let resultant = "the resultant of the loads along it is 2.000e0";
        assert!(solution.message.contains(resultant), "{}", solution.message);
    }
}

/// A support weaker than a host's condensation leaves of nothing (1e-12 of the body's stiffness) does not hold it:
/// pulled off, it has no equilibrium, alone and on another body.
#[test]
fn a_body_that_rounding_holds_flies_off() {
    for exponent in [-46, -42] {
        let (mut held, mut stiff) = (vec![0.0; 16], vec![0.0; 16]);
        for i in 0..4 {
            held[5 * i] = 1.0;
            stiff[5 * i] = 1024.0;
        }
        (held[2], held[8], held[10]) = (-1.0, -1.0, 1.0 + 2_f64.powi(exponent));
        let pull = [-1.0, 0.0, -1.0, 0.0];
        let two = Model::two_body(2, 2, (&held, 4), (&stiff, 4)).unwrap();
        let one = Model::condensed(2, 2, &held, 4).unwrap();
        for (model, load) in [(two, [pull, [0.0; 4]].concat()), (one, pull.to_vec())] {
            let case = LoadCase {
                load: &load,
                prescribed: None,
                gap: &[0.0; 2],
                law: FrictionLaw::Coulomb(&[0.5; 2]),
                reference_slip: None,
            };
            let settings = Settings::default();
            let monitor = &mut Monitor::new(&settings, None);
            let solution = model.solve(&case, &settings, None, monitor).unwrap();
            assert_eq!(solution.status, Status::NoEquilibrium, "{}", solution.message);
        }
    }
}

/// Two bodies on one spring each, in directions that differ: together they move every way without a force, so that the pair
/// meets no stiffness, and what rounding leaves of it is none.
#[test]
fn bodies_that_yield_every_way_have_no_stiffness() {
    let rng = &mut Rng::with_seed(88);
    for _ in 0..200 {
        let mut spring = |stiffness: f64| {
            let angle = std::f64::consts::TAU * rng.f64();
            let (c, s) = (angle.cos(), angle.sin());
            [c * c, c * s, c * s, s * s].map(|k| stiffness * k)
        };
        let (first, second) = (spring(1.0), spring(7.0));
        // Beside nearly the same direction the rounding of the sum is not small.
        let sine = (first[0] * second[3] + first[3] * second[0] - 2.0 * first[1] * second[1]) / 7.0;
        if sine < 0.01 {
            continue;
        }
        let Err(Error::Invalid { message, .. }) = Model::two_body(2, 1, (&first, 2), (&second, 2))
        else {
            panic!("{first:?} and {second:?} have a common stiffness");
        };
        let words = "K_rel is zero: no motion of the pairs meets a stiffness";
        assert!(message.to_string().starts_with(words), "{message}");
    }
}
