//! Laws with cohesion, with tension and with a friction ellipse, against closed forms and each other.

use std::f64::consts::PI;

use crate::common::problems::{decades, definite, uniform, vector};
use crate::laws::{Axes, Numbers, norm};
use fastrand::Rng;
use signorini::law::Rule;
use signorini::{
    ContactData, ContactProblem, FrictionLaw, Method, Monitor, Search, Settings, Solution, State,
    Status, Uniqueness, solve,
};

/// Rounding of one small system, far below any difference that is looked for.
const ROUNDING: f64 = 1e-12;

/// A problem in `dim` components a pair; columns of `k` one after the other.
#[derive(Clone, Copy)]
struct Body<'a> {
    dim: usize,
    k: &'a [f64],
    f: &'a [f64],
    gap: &'a [f64],
    slip: Option<&'a [f64]>,
}

impl Body<'_> {
    fn solve_by(&self, method: Method, law: FrictionLaw<'_>) -> Solution {
        let problem = ContactProblem::new(ContactData {
            dim: self.dim,
            pairs: self.gap.len(),
            stiffness: self.k,
            ld: self.f.len(),
            load: self.f,
            gap: self.gap,
            law,
            reference_slip: self.slip,
        })
        .expect("the data is valid");
        let settings = Settings { method, tolerance: 1e-12, ..Settings::default() };
        solve(&problem, &settings, None, &mut Monitor::new(&settings, None)).expect("they fit")
    }

    fn solve(&self, law: FrictionLaw<'_>) -> Solution {
        let solution = self.solve_by(Method::Auto, law);
        assert_eq!(solution.status, Status::Solved, "{}", solution.message);
        solution
    }
}

fn assert_near(one: &[f64], other: &[f64], tolerance: f64, what: &str) {
    assert!(
        one.iter().zip(other).all(|(a, b)| (a - b).abs() <= tolerance),
        "{what}: {one:?}, {other:?}"
    );
}

/// One pair on springs `k_n` and `k_t`.
fn springs(dim: usize, k_n: f64, k_t: f64) -> Vec<f64> {
    let at = |i: usize, j: usize| {
        if i != j {
            0.0
        } else if i == 0 {
            k_n
        } else {
            k_t
        }
    };
    (0..dim * dim).map(|e| at(e % dim, e / dim)).collect()
}

/// Two pairs of a body that nothing but contact holds, tied together by a spring in each direction: a
/// motion of both resists nothing.
fn tied(dim: usize) -> Vec<f64> {
    let n = 2 * dim;
    let mut k = vec![0.0; n * n];
    for c in 0..dim {
        let stiffness = 1.0 + c as f64;
        for (i, j, sign) in
            [(c, c, 1.0), (c + dim, c + dim, 1.0), (c, c + dim, -1.0), (c + dim, c, -1.0)]
        {
            k[i + n * j] = sign * stiffness;
        }
    }
    k
}

/// A pair on a spring carries what pulls it up to its tension, and opens beyond.
#[test]
fn a_pulled_pair_opens_at_its_tension() {
    for dim in [2, 3] {
        let (k, a) = (springs(dim, 4.0, 3.0), 0.5);
        for mu in [0.0, 0.3] {
            let numbers = [mu, mu * a + 0.2, a];
            for pull in [0.1, 0.499, 0.501, 2.0] {
                let mut f = vec![0.0; dim];
                f[0] = -pull;
                let body = Body { dim, k: &k, f: &f, gap: &[0.0], slip: None };
                let solution = body.solve(FrictionLaw::Cohesive(&numbers));
                let (carried, opened) = (pull.min(a), (pull - a).max(0.0) / 4.0);
                assert!((solution.certificate.force[0] - carried).abs() <= ROUNDING, "{pull}");
                assert!((solution.d[0] + opened).abs() <= ROUNDING, "{pull}: {:?}", solution.d);
                let expected = if pull > a { State::Open } else { State::Stick };
                assert_eq!(solution.certificate.states, [expected]);
                assert_eq!(solution.certificate.tension, 0.0);
            }
        }
    }
}

/// A body that hangs on two pairs: it is held up to twice the tension, and beyond that the motion away
/// proves that nothing holds it. Without friction, and with it.
#[test]
fn a_hanging_body_falls_beyond_its_tension() {
    for dim in [2, 3] {
        let k = tied(dim);
        for mu in [0.0, 0.5] {
            let law = [mu, mu * 0.3 + mu, 0.3, mu, mu * 0.3 + mu, 0.3];
            for (pull, held) in [(0.59, true), (0.599999, true), (0.600001, false), (1.0, false)] {
                let mut f = vec![0.0; 2 * dim];
                (f[0], f[dim]) = (-0.7 * pull, -0.3 * pull);
                let body = Body { dim, k: &k, f: &f, gap: &[0.0, 0.0], slip: None };
                let solution = body.solve_by(Method::Auto, FrictionLaw::Cohesive(&law));
                let expected = if held { Status::Solved } else { Status::NoEquilibrium };
                assert_eq!(solution.status, expected, "{dim} {mu} {pull}: {}", solution.message);
            }
        }
    }
}

/// A body under the pressure `N` in all begins to slip at `mu N + 2 b`, in every direction: below there
/// is an equilibrium, beyond a proof that there is none.
#[test]
fn a_sheared_body_slips_at_friction_and_cohesion() {
    for dim in [2, 3] {
        let k = tied(dim);
        let (mu, b, pressure) = (0.4, 0.25, 1.5);
        let most = mu * pressure + 2.0 * b;
        for a in [0.0, 0.2] {
            for step in 0..8 {
                let (sin, cos) = (PI / 4.0 * f64::from(step) + 0.1).sin_cos();
                for (part, held) in [(0.9999, true), (1.0001, false)] {
                    let shear = part * most / 2.0;
                    let load = if dim == 2 {
                        vec![pressure / 2.0, shear * cos.signum()]
                    } else {
                        vec![pressure / 2.0, shear * cos, shear * sin]
                    };
                    let f = [load.clone(), load].concat();
                    let body = Body { dim, k: &k, f: &f, gap: &[0.0, 0.0], slip: None };
                    let law = [mu, b, a, mu, b, a];
                    let solution = body.solve_by(Method::Auto, FrictionLaw::Cohesive(&law));
                    let expected = if held { Status::Solved } else { Status::NoEquilibrium };
                    assert_eq!(solution.status, expected, "{dim} {a} {part}: {}", solution.message);
                }
            }
        }
    }
}

/// One pair on springs: pressed or pulled by `f_n` it slips by `(|f_t| - mu p - b) / k_t` along the load,
/// with `p = f_n`, or `-a` if it opens.
#[test]
fn one_pair_with_cohesion_has_a_closed_form() {
    let rng = &mut Rng::with_seed(1);
    let mut seen = [0; 3];
    for _ in 0..2000 {
        let dim = rng.usize(2..=3);
        let (k_n, k_t) = (uniform(rng, 0.5, 5.0), uniform(rng, 0.5, 5.0));
        let (mu, a) = (uniform(rng, 0.0, 2.0), uniform(rng, 0.0, 1.0));
        let b = mu * a + uniform(rng, 0.0, 1.0);
        let f = vector(rng, dim).iter().map(|f| 3.0 * f).collect::<Vec<f64>>();
        let p = f[0].max(-a);
        let shear = norm(&f[1..]);
        let slip = (shear - mu * p - b).max(0.0) / k_t;
        let mut d = vec![(f[0] + a).min(0.0) / k_n];
        d.extend(f[1..].iter().map(|f| slip * f / shear));
        let k = springs(dim, k_n, k_t);
        let body = Body { dim, k: &k, f: &f, gap: &[0.0], slip: None };
        let solution = body.solve(FrictionLaw::Cohesive(&[mu, b, a]));
        assert_near(&solution.d, &d, ROUNDING, "d");
        seen[solution.certificate.states[0] as usize] += 1;
    }
    assert!(seen.iter().all(|&seen| seen > 200), "{seen:?}");
}

/// A random definite problem with gaps and a reference slip, condition up to 100.
fn random(rng: &mut Rng, dim: usize, pairs: usize) -> (Vec<f64>, Vec<f64>, Vec<f64>, Vec<f64>) {
    let condition = decades(rng, 2.0);
    let k = definite(rng, dim * pairs, condition);
    let mut f = vector(rng, dim * pairs);
    f.iter_mut().step_by(dim).for_each(|f| *f += 0.5);
    let gap = (0..pairs).map(|_| if rng.bool() { 0.0 } else { uniform(rng, -0.5, 1.0) }).collect();
    (k, f, gap, vector(rng, (dim - 1) * pairs))
}

/// Without cohesion and tension it is Coulomb's law, without friction under pressure Tresca's: the same
/// bits.
#[test]
fn cohesion_without_a_part_is_another_law() {
    for seed in 0..60 {
        let rng = &mut Rng::with_seed(seed);
        let (dim, pairs) = (rng.usize(2..=3), rng.usize(1..=6));
        let (k, f, gap, slip) = random(rng, dim, pairs);
        let body = Body { dim, k: &k, f: &f, gap: &gap, slip: Some(&slip) };
        let given: Vec<f64> = (0..pairs).map(|_| uniform(rng, 0.0, 0.8)).collect();
        let as_mu: Vec<f64> = given.iter().flat_map(|&mu| [mu, 0.0, 0.0]).collect();
        let as_b: Vec<f64> = given.iter().flat_map(|&b| [0.0, b, 0.0]).collect();
        for (one, other) in [
            (FrictionLaw::Coulomb(&given), FrictionLaw::Cohesive(&as_mu)),
            (FrictionLaw::Tresca(&given), FrictionLaw::Cohesive(&as_b)),
        ] {
            let (one, other) = (body.solve(one), body.solve(other));
            assert_eq!(one.d, other.d, "seed {seed}");
            assert_eq!(one.certificate.force, other.certificate.force, "seed {seed}");
            assert_eq!(one.certificate.states, other.certificate.states, "seed {seed}");
        }
    }
}

/// Equal coefficients are Coulomb's law, by either rule, whatever the axes. Friction is so low that the
/// solution is the only one; both are exact to 1e-12 of the forces, and the condition is 100.
#[test]
fn equal_coefficients_are_coulombs_law() {
    for seed in 0..60 {
        let rng = &mut Rng::with_seed(seed);
        let pairs = rng.usize(1..=5);
        let (k, f, gap, slip) = random(rng, 3, pairs);
        let body = Body { dim: 3, k: &k, f: &f, gap: &gap, slip: Some(&slip) };
        let mu: Vec<f64> = (0..pairs).map(|_| uniform(rng, 0.01, 0.3)).collect();
        let three: Vec<f64> = mu.iter().flat_map(|&mu| [mu, mu, uniform(rng, -4.0, 4.0)]).collect();
        for method in [Method::Newton, Method::SorNested, Method::Auto] {
            let coulomb = body.solve_by(method, FrictionLaw::Coulomb(&mu));
            for law in [FrictionLaw::Orthotropic(&three), FrictionLaw::OrthotropicCollinear(&three)]
            {
                let solution = body.solve_by(method, law);
                assert_eq!(solution.status, coulomb.status, "seed {seed}, {method:?}");
                assert_near(&solution.d, &coulomb.d, 1e-9, "d");
            }
        }
    }
}

/// Little friction on a matrix of condition 100 is a contraction: proved with the associated rule, with
/// cohesion and tension, and nothing is said with the collinear one.
#[test]
fn uniqueness_is_proved_where_friction_is_monotone() {
    let rng = &mut Rng::with_seed(3);
    let (k, f, gap, slip) = random(rng, 3, 4);
    let (axes, glue) = ([0.002, 0.001, 0.7].repeat(4), [0.002, 0.5, 0.1].repeat(4));
    for (law, expected) in [
        (FrictionLaw::Orthotropic(&axes), Uniqueness::Unique),
        (FrictionLaw::Cohesive(&glue), Uniqueness::Unique),
        (FrictionLaw::OrthotropicCollinear(&axes), Uniqueness::NotKnown),
    ] {
        let problem = ContactProblem::new(ContactData {
            dim: 3,
            pairs: 4,
            stiffness: &k,
            ld: 12,
            load: &f,
            gap: &gap,
            law,
            reference_slip: Some(&slip),
        })
        .unwrap();
        let settings = Settings { search: Search::Others, ..Settings::default() };
        let solution =
            solve(&problem, &settings, None, &mut Monitor::new(&settings, None)).unwrap();
        assert_eq!(solution.status, Status::Solved);
        assert_eq!(solution.uniqueness, expected, "{law:?}");
    }
}

/// In the variables `tau_k / mu_k` and `mu_k delta_k` the associated rule is Coulomb's with `mu = 1`.
#[test]
fn the_associated_rule_is_coulombs_law_in_scaled_variables() {
    let mut solved = 0;
    for seed in 0..60 {
        let rng = &mut Rng::with_seed(seed);
        let pairs = rng.usize(1..=5);
        let n = 3 * pairs;
        let (k, f, gap, slip) = random(rng, 3, pairs);
        let mu: Vec<f64> = (0..2 * pairs).map(|_| uniform(rng, 0.05, 0.4)).collect();
        let three: Vec<f64> = mu.chunks_exact(2).flat_map(|mu| [mu[0], mu[1], 0.0]).collect();
        let body = Body { dim: 3, k: &k, f: &f, gap: &gap, slip: Some(&slip) };
        let solution = body.solve(FrictionLaw::Orthotropic(&three));

        let scale: Vec<f64> =
            mu.chunks_exact(2).flat_map(|mu| [1.0, 1.0 / mu[0], 1.0 / mu[1]]).collect();
        let scaled_k: Vec<f64> = (0..n * n).map(|e| scale[e % n] * k[e] * scale[e / n]).collect();
        let scaled_f: Vec<f64> = f.iter().zip(&scale).map(|(f, s)| f * s).collect();
        let scaled_slip: Vec<f64> = slip.iter().zip(&mu).map(|(slip, mu)| slip * mu).collect();
        let scaled = Body { k: &scaled_k, f: &scaled_f, slip: Some(&scaled_slip), ..body };
        let other = scaled.solve_by(Method::Auto, FrictionLaw::Coulomb(&vec![1.0; pairs]));
        if other.status != Status::Solved {
            continue;
        }
        solved += 1;
        let d: Vec<f64> = other.d.iter().zip(&scale).map(|(d, s)| d * s).collect();
        assert_near(&solution.d, &d, 1e-8, &format!("seed {seed}"));
    }
    assert!(solved >= 55, "{solved}");
}

/// Tangents turned by an angle of their own in each pair, and the axes of the ellipse with them: the
/// answer turns.
#[test]
fn turned_tangents_turn_the_answer() {
    for seed in 0..40 {
        let rng = &mut Rng::with_seed(seed);
        let pairs = rng.usize(1..=5);
        let n = 3 * pairs;
        let (k, f, gap, slip) = random(rng, 3, pairs);
        let three: Vec<f64> = (0..pairs)
            .flat_map(|_| {
                [uniform(rng, 0.05, 0.4), uniform(rng, 0.05, 0.4), uniform(rng, -4.0, 4.0)]
            })
            .collect();
        let turns: Vec<f64> = (0..pairs).map(|_| uniform(rng, -4.0, 4.0)).collect();
        // Components in the turned tangents of a vector with `width` components a pair.
        let turned = |x: &[f64], width: usize| -> Vec<f64> {
            let pair = |(x, turn): (&[f64], &f64)| {
                let (sin, cos) = turn.sin_cos();
                let t = &x[width - 2..];
                let mut x = x[..width - 2].to_vec();
                x.extend([cos * t[0] + sin * t[1], cos * t[1] - sin * t[0]]);
                x
            };
            x.chunks_exact(width).zip(&turns).flat_map(pair).collect()
        };
        let columns: Vec<Vec<f64>> = k.chunks_exact(n).map(|column| turned(column, 3)).collect();
        let mut turned_k = vec![0.0; n * n];
        for i in 0..n {
            let row: Vec<f64> = columns.iter().map(|column| column[i]).collect();
            for (j, entry) in turned(&row, 3).into_iter().enumerate() {
                turned_k[i + n * j] = entry;
            }
        }
        let (turned_f, turned_slip) = (turned(&f, 3), turned(&slip, 2));
        let after: Vec<f64> = three
            .chunks_exact(3)
            .zip(&turns)
            .flat_map(|(law, turn)| [law[0], law[1], law[2] - turn])
            .collect();
        let body = Body { dim: 3, k: &k, f: &f, gap: &gap, slip: Some(&slip) };
        let other = Body { k: &turned_k, f: &turned_f, slip: Some(&turned_slip), ..body };
        for law in [FrictionLaw::Orthotropic, FrictionLaw::OrthotropicCollinear] {
            let (one, two) = (body.solve(law(&three)), other.solve(law(&after)));
            assert_near(&turned(&one.d, 3), &two.d, 1e-9, &format!("seed {seed}"));
            assert_eq!(one.certificate.states, two.certificate.states, "seed {seed}");
        }
    }
}

/// A block of the weight `W` on an incline of the slope `alpha`, t1 uphill, pulled by `T` along the
/// incline at `theta` from t1. It holds as long as the force `(T cos theta - W sin alpha, T sin theta)`
/// lies in the ellipse of the pressure `W cos alpha`; the largest such `T` solves a quadratic equation.
/// By either rule: the rule is about the slip.
#[test]
fn a_block_on_an_incline_slips_at_the_ellipse() {
    let k = tied(3);
    let (weight, alpha, mu, angle) = (2.0_f64, 0.2_f64, [0.6, 0.3], 0.5);
    let axes = Axes { mu, angle, rule: Rule::Associated };
    let (down, pressure) = (weight * alpha.sin(), weight * alpha.cos());
    for step in 0..12 {
        let theta = PI / 6.0 * f64::from(step);
        // |A (T h + g)|² = pressure², with A the gauge of the ellipse.
        let scaled = |t: [f64; 2]| {
            let [one, two] = axes.along(&t);
            [one / mu[0], two / mu[1]]
        };
        let (h, g) = (scaled([theta.cos(), theta.sin()]), scaled([-down, 0.0]));
        let (hh, hg) = (h[0] * h[0] + h[1] * h[1], h[0] * g[0] + h[1] * g[1]);
        let rest = pressure * pressure - g[0] * g[0] - g[1] * g[1];
        let most = (-hg + (hg * hg + hh * rest).sqrt()) / hh;
        for (pull, held) in [(0.9999 * most, true), (1.0001 * most, false)] {
            let (f1, f2) = (pull * theta.cos() - down, pull * theta.sin());
            let pair = [pressure / 2.0, f1 / 2.0, f2 / 2.0];
            let f = [pair, pair].concat();
            let body = Body { dim: 3, k: &k, f: &f, gap: &[0.0, 0.0], slip: None };
            let law = [mu[0], mu[1], angle, mu[0], mu[1], angle];
            for law in [FrictionLaw::Orthotropic(&law), FrictionLaw::OrthotropicCollinear(&law)] {
                let solution = body.solve_by(Method::Auto, law);
                let expected = if held { Status::Solved } else { Status::NoEquilibrium };
                let message = &solution.message;
                assert_eq!(solution.status, expected, "{step} {pull} {law:?}: {message}");
            }
        }
    }
}

/// The block on a spring that is the same in all directions, `k delta = T - tau`: for any force `tau` on
/// the ellipse and any length of slip there is the pull that belongs to them. The slip is along the
/// normal of the ellipse, or along the force.
#[test]
fn a_block_slips_as_its_rule_says() {
    let rng = &mut Rng::with_seed(2);
    for _ in 0..500 {
        let axes = Axes::random(rng);
        let pressure = uniform(rng, 0.5, 2.0);
        let around = uniform(rng, 0.0, 2.0 * PI);
        let tau =
            axes.of([axes.mu[0] * pressure * around.cos(), axes.mu[1] * pressure * around.sin()]);
        let along = axes.slip(&tau);
        let length = uniform(rng, 0.01, 3.0) / norm(&along);
        let slip = [length * along[0], length * along[1]];
        let stiffness = uniform(rng, 0.5, 3.0);
        let f = [pressure, tau[0] + stiffness * slip[0], tau[1] + stiffness * slip[1]];
        let k = springs(3, 1.0, stiffness);
        let numbers = [axes.mu[0], axes.mu[1], axes.angle];
        let law = match axes.rule {
            Rule::Associated => FrictionLaw::Orthotropic(&numbers),
            Rule::Collinear => FrictionLaw::OrthotropicCollinear(&numbers),
        };
        let body = Body { dim: 3, k: &k, f: &f, gap: &[0.0], slip: None };
        for method in [Method::Newton, Method::SorNested, Method::SorDiagonal] {
            let solution = body.solve_by(method, law);
            assert_eq!(solution.status, Status::Solved, "{axes:?}, {method:?}");
            // The axes are up to 10 to 1: their curvature makes 1e-12 of the forces 1e-10 of the slip.
            assert_near(&solution.d, &[0.0, slip[0], slip[1]], 1e-9, "d");
            assert_eq!(solution.certificate.states, [State::Slip]);
        }
    }
}

/// A result called solved obeys the statement of its law, pair by pair. Ordinary friction in space is
/// solved by Newton's method, by nested sweeps and, as its theorem says for all these laws, by the path.
#[test]
fn solutions_in_space_obey_the_statement_of_their_law() {
    let mut solved = [0; 3];
    for seed in 0..200 {
        let rng = &mut Rng::with_seed(seed);
        let pairs = rng.usize(1..=8);
        let (k, f, gap, slip) = random(rng, 3, pairs);
        let body = Body { dim: 3, k: &k, f: &f, gap: &gap, slip: Some(&slip) };
        let axes: Vec<Axes> = (0..pairs).map(|_| Axes::random(rng)).collect();
        let ellipses: Vec<f64> =
            axes.iter().flat_map(|axes| [axes.mu[0] / 4.0, axes.mu[1] / 4.0, axes.angle]).collect();
        let cohesion: Vec<f64> = (0..pairs)
            .flat_map(|_| {
                let (mu, a) = (uniform(rng, 0.0, 0.5), uniform(rng, 0.0, 0.5));
                [mu, mu * a + uniform(rng, 0.0, 0.5), a]
            })
            .collect();
        let own = |pair: usize| {
            let three = |numbers: &[f64]| [0, 1, 2].map(|k| numbers[3 * pair + k]);
            let (cohesion, ellipse) = (three(&cohesion), three(&ellipses));
            match (pair + seed as usize) % 6 {
                0 => [0.0; 4],
                1 => [1.0, cohesion[0], 0.0, 0.0],
                2 => [2.0, cohesion[1], 0.0, 0.0],
                3 => [3.0, cohesion[0], cohesion[1], cohesion[2]],
                rule => [rule as f64, ellipse[0], ellipse[1], ellipse[2]],
            }
        };
        let mixed: Vec<f64> = (0..pairs).flat_map(own).collect();
        for law in [
            FrictionLaw::Orthotropic(&ellipses),
            FrictionLaw::OrthotropicCollinear(&ellipses),
            FrictionLaw::Cohesive(&cohesion),
            FrictionLaw::ByPair(&mixed),
        ] {
            for (method, solved) in
                [Method::Newton, Method::SorNested, Method::Path].into_iter().zip(&mut solved)
            {
                let solution = body.solve_by(method, law);
                if solution.status != Status::Solved {
                    continue;
                }
                *solved += 1;
                let defect = defect(&body, law, &solution.d);
                // 1e-12 of forces of a few units, in the variables of a disc up to 100 times that.
                assert!(defect <= 1e-9, "seed {seed}, {law:?} by {method:?}: {defect}");
            }
        }
    }
    assert!(solved.iter().all(|&solved| solved >= 792) && solved[2] == 800, "{solved:?} of 800");
}

/// The largest distance of a pair from the statement of its law at `d`.
fn defect(body: &Body<'_>, law: FrictionLaw<'_>, d: &[f64]) -> f64 {
    let n = d.len();
    let entry = |i: usize, j: usize| body.k[i + n * j];
    let force = |i: usize| (0..n).map(|j| entry(i, j) * d[j]).sum::<f64>() - body.f[i];
    let pair = |pair: usize| {
        let i = 3 * pair;
        let block = [
            [entry(i + 1, i + 1), entry(i + 1, i + 2)],
            [entry(i + 2, i + 1), entry(i + 2, i + 2)],
        ];
        let (trace, gap) =
            (block[0][0] + block[1][1], (block[0][0] - block[1][1]).hypot(2.0 * block[0][1]));
        let slip = body.slip.map_or([0.0; 2], |slip| [slip[2 * pair], slip[2 * pair + 1]]);
        let numbers = Numbers {
            gap: body.gap[pair],
            slip0: slip,
            k: (entry(i, i), (trace + gap) / 2.0),
            ..Numbers::of(3, law.of_pair(pair))
        };
        let v = [d[i] - numbers.gap, d[i + 1] - slip[0], d[i + 2] - slip[1]];
        let mut p = [-force(i), -force(i + 1), -force(i + 2)];
        // Equality to rounding: the statement takes it by the letter.
        if (p[0] + numbers.tension).abs() < 1e-11 {
            p[0] = -numbers.tension;
        }
        let v = v.map(|v| if v.abs() < 1e-11 { 0.0 } else { v });
        numbers.defect(&v, &p)
    };
    (0..body.gap.len()).map(pair).fold(0.0, f64::max)
}
