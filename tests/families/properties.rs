//! Bodies that are described in another way have the same displacements and forces: properties of random
//! problems, which shrink to the smallest problem where they fail.
//!
//! A failure writes that problem to `target/tmp/property-NAME.mtx`; `replay_problem` of the examples solves it.
//! The problems of a run are always the same. `SIGNORINI_PROPERTY_CASES=100000 cargo test --release --test
//! properties` tries the same ones and more.
//!
//! Why one solution, and how near two answers must be. `K = I + A A'` with small integers, so that all its
//! eigenvalues are at least 1 (at least 1/2 for two bodies and for a doubled pair, which are springs in a row and
//! halves). Friction stays below 0.9 of the bound where the map of thresholds contracts,
//! `mu (|K_nn| |(K^-1)_tt|)^(1/2) < 1` in spectral norms, here bounded by a trace and by 2. A residual of 1e-12 of
//! the forces is then less than 1e-8 of the forces in `d` and `F`: 10 from contraction by 0.9, 500 from the
//! condition number, 4 from the root of twelve components. Ten times that is allowed.

use std::path::Path;

use crate::common::dense::{Elimination, difference, largest, product};
use crate::common::problems::{Case, Law};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngAlgorithm, TestError, TestRng, TestRunner};
use signorini::{
    ContactData, FlexibilityData, FlexibilityProblem, FrictionLaw, LoadCase, Model, Monitor,
    Settings, Solution, State, Status, solve_flexibility,
};

const AGREEMENT: f64 = 1e-7;
const TOLERANCE: f64 = 1e-12;
/// Problems of a property where nothing else is asked for.
const CASES: u32 = 3000;
/// Steps of a search for a smaller problem.
const SHRINKING: u32 = 20_000;

// ---- problems ----

/// One pair in small integers, for three dimensions; a problem in the plane leaves the last component out.
#[derive(Clone, Debug)]
struct Recipe {
    factors: [[i8; 3]; 3],
    load: [i8; 3],
    gap: Option<i8>,
    slip: [i8; 2],
    friction: u8,
    tension: u8,
}

fn recipe() -> impl Strategy<Value = Recipe> {
    let number = || -3_i8..=3;
    let gap = prop_oneof![4 => Just(Some(0)), 4 => (-4_i8..=8).prop_map(Some), 1 => Just(None)];
    let factors = prop::array::uniform3(prop::array::uniform3(number()));
    let slip = [number(), number()];
    // The normal component mostly presses.
    let load = [-2_i8..=12, -8..=8, -8..=8];
    (factors, load, gap, slip, 0_u8..=8, 0_u8..=4).prop_map(
        |(factors, load, gap, slip, friction, tension)| Recipe {
            factors,
            load,
            gap,
            slip,
            friction,
            tension,
        },
    )
}

/// Problems of one to four pairs under each law that has one solution, and with a law for each pair.
fn problems() -> impl Strategy<Value = Case> {
    (2_usize..=3, 0_u8..4, any::<bool>(), prop::collection::vec(recipe(), 1..=4))
        .prop_map(|(dim, law, slips, recipes)| case(dim, law, slips, &recipes))
}

fn case(dim: usize, law: u8, slips: bool, recipes: &[Recipe]) -> Case {
    let pairs = recipes.len();
    let rows: Vec<[f64; 3]> = recipes
        .iter()
        .flat_map(|r| r.factors[..dim].iter().map(|row| row.map(f64::from)))
        .collect();
    let k = one_and_square(&rows);
    let normals: f64 = (0..pairs).map(|p| k[dim * p * (dim * pairs + 1)]).sum();
    // |K_nn| <= trace + 2 where a pair is doubled, |(K^-1)_tt| <= 2.
    let most = 0.9 / (2.0 * (normals + 2.0)).sqrt();
    let mu = |r: &Recipe| most * f64::from(r.friction) / 8.0;
    let quarter = |number: i8| f64::from(number) / 4.0;
    let threshold = |r: &Recipe| f64::from(r.friction) / 4.0;
    let cohesion = |r: &Recipe| {
        let a = f64::from(r.tension) / 4.0;
        [mu(r), mu(r) * a + f64::from(r.slip[0].unsigned_abs()) / 4.0, a]
    };
    Case {
        dim,
        pairs,
        k,
        f: recipes.iter().flat_map(|r| r.load[..dim].iter().map(|&f| quarter(f))).collect(),
        gap: recipes.iter().map(|r| r.gap.map_or(f64::INFINITY, quarter)).collect(),
        law: match law {
            0 => Law::Coulomb(recipes.iter().map(mu).collect()),
            1 => Law::Tresca(recipes.iter().map(threshold).collect()),
            2 => Law::Cohesive(recipes.iter().flat_map(cohesion).collect()),
            _ => {
                let own = |r: &Recipe| match r.load[0].rem_euclid(5) {
                    0 => vec![0.0; 4],
                    1 => vec![1.0, mu(r), 0.0, 0.0],
                    2 => vec![2.0, threshold(r), 0.0, 0.0],
                    3 => vec![7.0, 0.0, 0.0, 0.0],
                    _ => [&[3.0][..], &cohesion(r)].concat(),
                };
                Law::ByPair(recipes.iter().flat_map(own).collect())
            }
        },
        slip: slips.then(|| {
            recipes.iter().flat_map(|r| r.slip[..dim - 1].iter().map(|&s| quarter(s))).collect()
        }),
    }
}

/// `I + A A'` of the rows of `A`.
fn one_and_square(rows: &[[f64; 3]]) -> Vec<f64> {
    let n = rows.len();
    let entry = |i: usize, j: usize| {
        let product: f64 = rows[i].iter().zip(&rows[j]).map(|(a, b)| a * b).sum();
        product + f64::from(u8::from(i == j))
    };
    (0..n * n).map(|at| entry(at % n, at / n)).collect()
}

// ---- running ----

/// Displacements and forces.
type Answer = (Vec<f64>, Vec<f64>);

/// Tries a property of a problem and of one change to it.
fn property<T: std::fmt::Debug>(
    name: &str,
    changes: impl Strategy<Value = T>,
    holds: impl Fn(&Case, &T) -> Result<(), String>,
) {
    let asked = std::env::var("SIGNORINI_PROPERTY_CASES").ok();
    let cases = asked.map_or(CASES, |text| text.parse().expect("SIGNORINI_PROPERTY_CASES counts"));
    let config = Config {
        cases,
        max_shrink_iters: SHRINKING,
        failure_persistence: None,
        ..Config::default()
    };
    let random = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let result = TestRunner::new_with_rng(config, random)
        .run(&(problems(), changes), |(case, change)| {
            holds(&case, &change).map_err(TestCaseError::fail)
        });
    match result {
        Ok(()) => println!("{name}: {cases} problems"),
        Err(TestError::Fail(why, (case, change))) => {
            let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("property-{name}.mtx"));
            let remark = format!("the property {name} fails");
            signorini::file::write(&path, &case.problem(), Some(&remark)).expect("target is ours");
            panic!("{name}: {why}\nchange: {change:?}\n{case:?}\nwritten to {}", path.display());
        }
        Err(TestError::Abort(why)) => panic!("{name}: {why}"),
    }
}

fn settings() -> Settings {
    Settings { tolerance: TOLERANCE, ..Settings::default() }
}

fn solved(solution: Solution) -> Result<Answer, String> {
    match solution.status {
        Status::Solved => Ok((solution.d, solution.certificate.force)),
        other => Err(format!("{other:?}: {}", solution.message)),
    }
}

fn answer(case: &Case) -> Result<Answer, String> {
    solved(case.solve(&settings()))
}

/// The answer of the case, and another one that is in its units and its order.
fn agree(case: &Case, one: &Answer, two: &Answer) -> Result<(), String> {
    let allowed = AGREEMENT * largest(&case.f).max(largest(&one.1));
    let apart = |a: &[f64], b: &[f64]| largest(&difference(a, b));
    let (d, force) = (apart(&one.0, &two.0), apart(&one.1, &two.1));
    match d.max(force) <= allowed {
        true => Ok(()),
        false => Err(format!("d {d:e}, F {force:e} apart, {allowed:e} allowed\n{one:?}\n{two:?}")),
    }
}

fn times(values: &[f64], factor: f64) -> Vec<f64> {
    values.iter().map(|value| value * factor).collect()
}

/// The numbers of a law, pair by pair.
fn by_pair(law: &Law, pairs: usize) -> Vec<Vec<f64>> {
    law.values().chunks(law.values().len() / pairs).map(<[f64]>::to_vec).collect()
}

// ---- the properties ----

/// Lengths and forces in other units, by factors of up to 1e9 that are no powers of two.
#[test]
fn units_may_be_changed() {
    property("units", (-9.0..9.0_f64, -9.0..9.0_f64), |case, &(length, force)| {
        let (length, force) = (10_f64.powf(length), 10_f64.powf(force));
        let other = Case {
            k: times(&case.k, force / length),
            f: times(&case.f, force),
            gap: times(&case.gap, length),
            law: case.law.with_forces(force),
            slip: case.slip.as_ref().map(|slip| times(slip, length)),
            ..case.clone()
        };
        let (d, f) = answer(&other)?;
        agree(case, &answer(case)?, &(times(&d, 1.0 / length), times(&f, 1.0 / force)))
    });
}

/// Pairs in another order.
#[test]
fn pairs_may_be_renumbered() {
    property("renumbered", prop::array::uniform4(any::<u16>()), |case, keys| {
        let (dim, n) = (case.dim, case.size());
        let mut order: Vec<usize> = (0..case.pairs).collect();
        order.sort_by_key(|&pair| (keys[pair], pair));
        let from = |i: usize| dim * order[i / dim] + i % dim;
        let numbers = by_pair(&case.law, case.pairs);
        let other = Case {
            k: (0..n * n).map(|at| case.stiffness(from(at % n), from(at / n))).collect(),
            f: (0..n).map(|i| case.f[from(i)]).collect(),
            gap: order.iter().map(|&pair| case.gap[pair]).collect(),
            law: case.law.with(order.iter().flat_map(|&pair| numbers[pair].clone()).collect()),
            slip: case.slip.as_ref().map(|slip| {
                order.iter().flat_map(|&p| slip[(dim - 1) * p..][..dim - 1].to_vec()).collect()
            }),
            ..case.clone()
        };
        let back = |values: &[f64]| {
            let mut all = vec![0.0; n];
            (0..n).for_each(|i| all[from(i)] = values[i]);
            all
        };
        let (d, f) = answer(&other)?;
        agree(case, &answer(case)?, &(back(&d), back(&f)))
    });
}

/// Tangents turned, and mirrored: by any angle in space, by their sign in the plane.
#[test]
fn frames_may_be_turned() {
    let turn = (0.0..std::f64::consts::TAU, any::<bool>());
    property("turned", prop::array::uniform4(turn), |case, turns| {
        let (dim, n) = (case.dim, case.size());
        // Column j of Q is the j-th new axis in the old ones: x = Q y.
        let mut columns = vec![vec![0.0; n]; n];
        for (pair, &(angle, mirror)) in turns.iter().take(case.pairs).enumerate() {
            let (normal, sign) = (dim * pair, if mirror { -1.0 } else { 1.0 });
            columns[normal][normal] = 1.0;
            let t = normal + 1;
            match dim {
                2 => columns[t][t] = sign,
                _ => {
                    let (sin, cos) = angle.sin_cos();
                    (columns[t][t], columns[t][t + 1]) = (cos, sin);
                    (columns[t + 1][t], columns[t + 1][t + 1]) = (-sign * sin, sign * cos);
                }
            }
        }
        let to = |x: &[f64]| -> Vec<f64> {
            columns.iter().map(|q| q.iter().zip(x).map(|(q, x)| q * x).sum()).collect()
        };
        let back = |y: &[f64]| -> Vec<f64> {
            (0..n).map(|i| (0..n).map(|j| columns[j][i] * y[j]).sum()).collect()
        };
        let half: Vec<Vec<f64>> = columns.iter().map(|q| to(&product(&case.k, q))).collect();
        // Symmetric to the last bit, as the library asks for.
        let k = (0..n * n).map(|at| half[(at % n).max(at / n)][(at % n).min(at / n)]).collect();
        let full: Vec<f64> = (0..n)
            .map(|i| if i % dim == 0 { 0.0 } else { case.rest(i / dim, i % dim - 1) })
            .collect();
        let slip = to(&full).into_iter().enumerate().filter(|(i, _)| i % dim != 0);
        let other = Case {
            k,
            f: to(&case.f),
            slip: case.slip.as_ref().map(|_| slip.map(|(_, slip)| slip).collect()),
            ..case.clone()
        };
        let (d, f) = answer(&other)?;
        agree(case, &answer(case)?, &(back(&d), back(&f)))
    });
}

/// One more pair, in any place of the order, that never touches: `C` couples it, and elimination takes away
/// what `[[K + C C', C], [C', I]]` has more than `K`.
#[test]
fn a_pair_that_never_touches_may_be_added() {
    let couplings = prop::collection::vec(prop::array::uniform3(-2_i8..=2), 12);
    let load = prop::array::uniform3(-8_i8..=8);
    property("never_touches", (couplings, load, 0_usize..=4), |case, (couplings, load, place)| {
        let (dim, n, pairs) = (case.dim, case.size(), case.pairs + 1);
        let place = place % pairs;
        // Entries of the larger problem: those of the case, then those of the new pair.
        let from = |i: usize| match i / dim {
            pair if pair < place => Ok(i),
            pair if pair == place => Err(i % dim),
            _ => Ok(i - dim),
        };
        let c = |i: usize, a: usize| f64::from(couplings[i][a]) / 2.0;
        let entry = |i: usize, j: usize| match (from(i), from(j)) {
            (Ok(i), Ok(j)) => {
                case.stiffness(i, j) + (0..dim).map(|a| c(i, a) * c(j, a)).sum::<f64>()
            }
            (Ok(i), Err(a)) | (Err(a), Ok(i)) => c(i, a),
            (Err(a), Err(b)) => f64::from(u8::from(a == b)),
        };
        let m = dim * pairs;
        let load: Vec<f64> = load[..dim].iter().map(|&f| f64::from(f) / 4.0).collect();
        // C f_2 comes back in the elimination.
        let full = |i: usize| case.f[i] + (0..dim).map(|a| c(i, a) * load[a]).sum::<f64>();
        let mut numbers = by_pair(&case.law, case.pairs);
        numbers.insert(place, vec![0.0; numbers[0].len()]);
        let mut gap = case.gap.clone();
        gap.insert(place, f64::INFINITY);
        let slip = case.slip.as_ref().map(|slip| {
            let (before, after) = slip.split_at((dim - 1) * place);
            [before, &vec![0.0; dim - 1], after].concat()
        });
        let other = Case {
            dim,
            pairs,
            k: (0..m * m).map(|at| entry(at % m, at / m)).collect(),
            f: (0..m).map(|i| from(i).map_or_else(|a| load[a], full)).collect(),
            gap,
            law: case.law.with(numbers.concat()),
            slip,
        };
        let (d, f) = answer(&other)?;
        let apart = (dim * place..dim * (place + 1)).all(|i| f[i] == 0.0);
        let pick = |x: &[f64]| {
            let kept = (0..m).filter(|&i| from(i).is_ok());
            kept.map(|i| x[i]).collect::<Vec<f64>>()
        };
        assert_eq!(pick(&d).len(), n);
        if !apart {
            return Err(format!("the pair that never touches has a force: {f:?}"));
        }
        // Its loads have their rounding too.
        let loads = Case { f: other.f, ..case.clone() };
        agree(&loads, &answer(case)?, &(pick(&d), pick(&f)))
    });
}

/// A pair cut into two halves with a spring between them, each with half of its stiffness and load: the
/// spring stays slack, and the halves share the force.
#[test]
fn a_pair_may_be_doubled() {
    property("doubled", 0_usize..4, |case, place| {
        let (dim, n, pairs) = (case.dim, case.size(), case.pairs + 1);
        let (place, m) = (place % case.pairs, dim * pairs);
        let from = |i: usize| if i < n { i } else { dim * place + i - n };
        let half = |i: usize| if from(i) / dim == place { 0.5 } else { 1.0 };
        // (a - b)^2 / 2: as stiff as the halves can be at least.
        let spring = |i: usize, j: usize| match from(i) == from(j) && half(i) < 1.0 {
            true if i == j => 1.0,
            true => -1.0,
            false => 0.0,
        };
        let mut numbers = by_pair(&case.law, case.pairs);
        numbers[place] = by_pair(&case.law.with_forces(0.5), case.pairs).swap_remove(place);
        numbers.push(numbers[place].clone());
        let entry = |i: usize, j: usize| {
            case.stiffness(from(i), from(j)) * half(i) * half(j) + spring(i, j)
        };
        let other = Case {
            dim,
            pairs,
            k: (0..m * m).map(|at| entry(at % m, at / m)).collect(),
            f: (0..m).map(|i| case.f[from(i)] * half(i)).collect(),
            gap: (0..pairs).map(|p| case.gap[from(dim * p) / dim]).collect(),
            law: case.law.with(numbers.concat()),
            slip: case.slip.as_ref().map(|slip| {
                let own = &slip[(dim - 1) * place..(dim - 1) * (place + 1)];
                [slip, own].concat()
            }),
        };
        let (d, mut f) = answer(&other)?;
        let slack: Vec<f64> = (0..dim).map(|c| d[n + c] - d[dim * place + c]).collect();
        (0..dim).for_each(|c| f[dim * place + c] += f[n + c]);
        let (d, f) = (d[..n].to_vec(), f[..n].to_vec());
        let one = answer(case)?;
        if largest(&slack) > AGREEMENT * largest(&case.f).max(largest(&one.1)) {
            return Err(format!("the halves are {slack:?} apart"));
        }
        agree(case, &one, &(d, f))
    });
}

/// In flexibility form a pair may stand there twice, rows and columns of `W` and all: the displacements are
/// those of one, and the two forces add up to its force.
#[test]
fn a_pair_may_stand_twice_in_a_flexibility() {
    property("twice", 0_usize..4, |case, place| {
        let Law::Coulomb(mu) = &case.law else { return Ok(()) };
        let (dim, n, pairs) = (case.dim, case.size(), case.pairs + 1);
        let (place, m) = (place % case.pairs, dim * pairs);
        let from = |i: usize| if i < n { i } else { dim * place + i - n };
        let inverse = Elimination::new(n, &case.k);
        let column = |j: usize| {
            let unit: Vec<f64> = (0..n).map(|i| f64::from(u8::from(i == j))).collect();
            inverse.solve(&unit).0
        };
        let w: Vec<Vec<f64>> = (0..n).map(column).collect();
        let free = inverse.solve(&case.f).0;
        let entry = |i: usize, j: usize| w[from(i).max(from(j))][from(i).min(from(j))];
        let doubled = |p: usize| from(dim * p) / dim;
        let slip: Vec<f64> = (0..m)
            .filter(|i| i % dim != 0)
            .map(|i| case.rest(from(i) / dim, i % dim - 1))
            .collect();
        let twice: Vec<f64> = (0..m * m).map(|at| entry(at % m, at / m)).collect();
        let data = FlexibilityData {
            dim,
            pairs,
            flexibility: (&twice[..], m),
            free: &(0..m).map(|i| free[from(i)]).collect::<Vec<f64>>(),
            gap: &(0..pairs).map(|p| case.gap[doubled(p)]).collect::<Vec<f64>>(),
            law: FrictionLaw::Coulomb(&(0..pairs).map(|p| mu[doubled(p)]).collect::<Vec<f64>>()),
            reference_slip: Some(&slip),
        };
        let problem = FlexibilityProblem::from_flexibility(data).map_err(|why| why.to_string())?;
        let settings = settings();
        let monitor = &mut Monitor::new(&settings, None);
        let solution = solve_flexibility(&problem, &settings, None, monitor);
        let (d, mut f) = solved(solution.map_err(|why| why.to_string())?)?;
        (0..dim).for_each(|c| f[dim * place + c] += f[n + c]);
        agree(case, &answer(case)?, &(d[..n].to_vec(), f[..n].to_vec()))
    });
}

/// Which of two bodies is the first means nothing, and two bodies are springs in a row:
/// `K_rel^-1 = K_A^-1 + K_B^-1`.
#[test]
fn bodies_may_be_swapped() {
    let factors = prop::collection::vec(prop::array::uniform3(-3_i8..=3), 12);
    let loads = prop::collection::vec(-8_i8..=8, 12);
    property("swapped", (factors, loads), |case, (factors, loads)| {
        let n = case.size();
        let rows: Vec<[f64; 3]> = factors[..n].iter().map(|row| row.map(f64::from)).collect();
        let second = one_and_square(&rows);
        let load: Vec<f64> = loads[..n].iter().map(|&f| f64::from(f) / 4.0).collect();
        let ContactData { law, reference_slip, .. } = case.data();
        let solve = |k: [&[f64]; 2], f: [&[f64]; 2]| -> Result<Answer, String> {
            let model = Model::two_body(case.dim, case.pairs, (k[0], n), (k[1], n));
            let load = f.concat();
            let given =
                LoadCase { load: &load, prescribed: None, gap: &case.gap, law, reference_slip };
            let settings = settings();
            let monitor = &mut Monitor::new(&settings, None);
            let model = model.map_err(|why| why.to_string())?;
            let solution = model.solve(&given, &settings, None, monitor);
            solved(solution.map_err(|why| why.to_string())?)
        };
        let one = solve([&case.k, &second], [&case.f, &load])?;
        let two = solve([&second, &case.k], [&load, &case.f])?;
        let loads = Case { f: [&case.f[..], &load].concat(), ..case.clone() };
        agree(&loads, &one, &two)
    });
}

/// The problems are not idle: all laws, and pairs of each state in plenty.
#[test]
fn the_problems_have_pairs_of_every_state() {
    let random = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let mut runner = TestRunner::new_with_rng(Config::default(), random);
    let (mut seen, mut laws) = ([0; 3], [0; 4]);
    for _ in 0..CASES {
        let case = problems().new_tree(&mut runner).expect("nothing is filtered").current();
        laws[match case.law {
            Law::Coulomb(_) => 0,
            Law::Tresca(_) => 1,
            Law::ByPair(_) => 2,
            _ => 3,
        }] += 1;
        for state in case.solve(&settings()).certificate.states {
            seen[match state {
                State::Open => 0,
                State::Slip => 1,
                State::Stick => 2,
            }] += 1;
        }
    }
    println!("laws {laws:?}; open, slip, stick {seen:?}");
    // A twentieth of all at least.
    assert!(laws.iter().all(|&count| 20 * count >= CASES), "{laws:?}");
    let all: u32 = seen.iter().sum();
    assert!(seen.iter().all(|&count| 20 * count >= all), "open, slip, stick: {seen:?}");
}

/// A failure leaves the smallest problem behind, as a file that the library reads.
#[test]
fn a_failure_shrinks_to_a_problem_file() {
    let failed = std::panic::catch_unwind(|| {
        property("example", Just(()), |case, ()| match case.pairs {
            0 | 1 => Ok(()),
            _ => Err("more than one pair".into()),
        });
    });
    assert!(failed.is_err());
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("property-example.mtx");
    let file = signorini::file::read(&path).expect("a problem file");
    let contact = file.contact().expect("a contact problem");
    assert_eq!((contact.dim, contact.pairs), (2, 2));
    assert!(contact.load.iter().all(|&f| f == 0.0));
    assert_eq!(contact.stiffness, [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1].map(f64::from));
}
