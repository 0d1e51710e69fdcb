//! Motions along which a frictionless solution may move without any force: a body on few points turns off them.
//!
//! Beams and plates whose entries are whole numbers, so that rigid motions strain nothing, however large they are.

use crate::common::dense::{difference, dot, largest, norm, product};
use crate::common::measures::{eta, rounding};
use crate::common::problems::{Case, add_spring, frictionless};
use fastrand::Rng;
use signorini::{Method, Monitor, Settings, Solution, Status};

/// The default, and a method that begins at the start.
const METHODS: [Method; 2] = [Method::Auto, Method::Newton];

const TOLERANCE: f64 = 1e-10;

/// Places of pairs, one apart: of a beam (`y = 0`), or of a plate of two rows.
fn places(dim: usize, length: usize) -> Vec<[f64; 2]> {
    let rows = dim - 1;
    (0..length).flat_map(|x| (0..rows).map(move |y| [x as f64, y as f64])).collect()
}

/// A beam or a plate on such places, `length` pairs long. Springs of whole numbers resist its bending and twist, one to each
/// three pairs along it and each square; springs between neighbours resist its stretching along the first tangent, and each
/// pair has one of its own along the second. No force acts.
fn body(rng: &mut Rng, dim: usize, length: usize) -> Case {
    let (rows, pairs) = (dim - 1, (dim - 1) * length);
    let n = dim * pairs;
    let mut k = vec![0.0; n * n];
    let mut add = |parts: &[(usize, usize, f64)], stiffness: f64| {
        let mut strain = vec![0.0; n];
        parts.iter().for_each(|&(pair, c, part)| strain[dim * pair + c] = part);
        add_spring(&mut k, &strain, stiffness);
    };
    let at = |x: usize, y: usize| rows * x + y;
    for y in 0..rows {
        for x in 0..length - 1 {
            add(&[(at(x, y), 1, 1.0), (at(x + 1, y), 1, -1.0)], f64::from(rng.i32(1..=4)));
        }
        for x in 1..length - 1 {
            let bend = [(at(x - 1, y), 0, 1.0), (at(x, y), 0, -2.0), (at(x + 1, y), 0, 1.0)];
            add(&bend, f64::from(rng.i32(1..=4)));
        }
    }
    if dim == 3 {
        for x in 0..length {
            (0..rows).for_each(|y| add(&[(at(x, y), 2, 1.0)], 1.0));
            add(&[(at(x, 0), 1, 1.0), (at(x, 1), 1, -1.0)], 1.0);
        }
        for x in 0..length - 1 {
            let (near, far) = ([at(x, 0), at(x, 1)], [at(x + 1, 0), at(x + 1, 1)]);
            let twist =
                [(near[0], 0, 1.0), (near[1], 0, -1.0), (far[0], 0, -1.0), (far[1], 0, 1.0)];
            add(&twist, f64::from(rng.i32(1..=4)));
        }
    }
    let gap = vec![f64::INFINITY; pairs];
    Case { dim, pairs, k, f: vec![0.0; n], gap, law: frictionless(pairs), slip: None }
}

/// Normal displacements `at` of all pairs.
fn normals(dim: usize, places: &[[f64; 2]], mut at: impl FnMut([f64; 2]) -> f64) -> Vec<f64> {
    places.iter().flat_map(|&place| [at(place), 0.0, 0.0].into_iter().take(dim)).collect()
}

/// A body that is pressed against obstacles at the pairs `pressed`, with one of its solutions, whole numbers: displacements by
/// chance, obstacles where they are, and the loads that they need. The other pairs have none.
fn pressed(rng: &mut Rng, dim: usize, length: usize, pressed: &[usize]) -> (Case, Vec<f64>) {
    let mut case = body(rng, dim, length);
    let d = normals(dim, &places(dim, length), |_| f64::from(rng.i32(-3..=3)));
    case.f = product(&case.k, &d);
    for &pair in pressed {
        case.f[dim * pair] += f64::from(rng.i32(1..=4));
        case.gap[pair] = d[dim * pair];
    }
    (case, d)
}

/// The rigid motions that move none of the pairs at `held`.
fn idle(dim: usize, places: &[[f64; 2]], held: &[usize]) -> Vec<Vec<f64>> {
    let of = |at: &dyn Fn([f64; 2]) -> f64| normals(dim, places, at);
    let at = |k: usize| places[held[k]];
    let all = match held.len() {
        0 => {
            let slide =
                (0..dim * places.len()).map(|i| f64::from(u8::from(i % dim == 1))).collect();
            vec![of(&|_| 1.0), of(&|[x, _]| x), of(&|[_, y]| y), slide]
        }
        1 => vec![of(&|[x, _]| x - at(0)[0]), of(&|[_, y]| y - at(0)[1])],
        _ => {
            let along = [at(1)[0] - at(0)[0], at(1)[1] - at(0)[1]];
            vec![of(&|[x, y]| (y - at(0)[1]) * along[0] - (x - at(0)[0]) * along[1])]
        }
    };
    all.into_iter().filter(|motion| norm(motion) > 0.0).collect()
}

/// The solution that a method finds from a start, to a tolerance.
fn from(case: &Case, (method, tolerance): (Method, f64), start: &[f64]) -> Solution {
    let settings = Settings { method, tolerance, ..Settings::default() };
    let monitor = &mut Monitor::new(&settings, None);
    let solution = signorini::solve(&case.problem(), &settings, Some(start), monitor);
    let solution = solution.expect("the settings fit");
    let context = || format!("{method:?} from {start:?}: {solution:?}\n{case:?}");
    assert_eq!(solution.status, Status::Solved, "{}", context());
    assert!(eta(case, &solution.d) <= tolerance + rounding(case, &solution.d), "{}", context());
    solution
}

/// Displacements along a motion, in the units of the diagonal: `d . r / r . r`.
fn part(case: &Case, d: &[f64], motion: &[f64]) -> f64 {
    let unit = |i: usize| case.stiffness(i, i);
    let scaled: Vec<f64> = motion.iter().enumerate().map(|(i, r)| unit(i) * r).collect();
    dot(&scaled, d) / dot(&scaled, motion)
}

/// Bound on the rounding of parts of displacements along a motion: of products and sums over all components, an epsilon each.
fn rounding_of_parts(d: &[f64]) -> f64 {
    2.0 * d.len() as f64 * f64::EPSILON * largest(d)
}

/// `d + by motion`.
fn moved(d: &[f64], by: f64, motion: &[f64]) -> Vec<f64> {
    d.iter().zip(motion).map(|(d, r)| d + by * r).collect()
}

/// Bodies on no, one or two points, far off one of their solutions along motions that no force resists: the result is the one
/// solution of all these that is least in the norm of the diagonal. The way back keeps roundings of the start.
#[test]
fn a_far_start_ends_at_the_least_of_its_solutions() {
    let rng = &mut Rng::with_seed(1);
    for seed in 0..60 {
        let (dim, length) = (2 + seed % 2, rng.usize(3..=5));
        let places = places(dim, length);
        let mut held: Vec<usize> = (0..places.len()).collect();
        rng.shuffle(&mut held);
        held.truncate(rng.usize(0..dim));
        let (mut case, d) = pressed(rng, dim, length, &held);
        // Units of force.
        let unit = 2_f64.powi([0, 40, -40][seed / 2 % 3]);
        case.k.iter_mut().chain(&mut case.f).for_each(|force| *force *= unit);
        let motions = idle(dim, &places, &held);
        let mut start = d.clone();
        for motion in &motions {
            let far = f64::from(rng.i32(1 << 26..=1 << 27));
            start = moved(&start, if rng.bool() { far } else { -far }, motion);
        }
        let rest = rounding_of_parts(&start);
        for method in METHODS {
            let solution = from(&case, (method, TOLERANCE), &start);
            for motion in &motions {
                let part = part(&case, &solution.d, motion);
                assert!(part.abs() <= rest, "seed {seed}, {method:?}: {part:e}\n{case:?}");
            }
        }
    }
}

/// A beam on its first pair, turned far off it. Its last pair meets its obstacle on the way to the least solution, and stops the
/// way there; or the obstacle is behind that solution, and stops nothing. The tolerance is above the rounding of a far start,
/// 1e-8. With one below, a pair that rounding brings beyond its obstacle would be no solution, and the start stays.
#[test]
fn an_obstacle_stops_the_way_to_the_least_solution() {
    let rng = &mut Rng::with_seed(2);
    for seed in 0..40 {
        let length = rng.usize(3..=6);
        let (mut case, d) = pressed(rng, 2, length, &[0]);
        let motion = &idle(2, &places(2, length), &[0])[0];
        let least = moved(&d, -part(&case, &d, motion), motion);
        let (last, start) = (2 * (length - 1), moved(&d, -f64::from(1 << 27), motion));
        let rest = rounding_of_parts(&start);
        for behind in [-2.0, -1.0, 1.0, 2.0] {
            case.gap[length - 1] = least[last].round() + behind;
            let stopped = (case.gap[length - 1] - least[last]).min(0.0) / motion[last];
            let expected = moved(&least, stopped, motion);
            for method in METHODS {
                from(&case, (method, TOLERANCE), &start);
                let solution = from(&case, (method, 1e-6), &start);
                let off = largest(&difference(&solution.d, &expected));
                assert!(off <= rest, "seed {seed}, {behind}, {method:?}: {off:e}\n{case:?}");
            }
        }
    }
}

/// A solution that is not far is its own result, to the last bit: whole numbers have no rounding.
#[test]
fn a_solution_that_is_not_far_stays_where_it_is() {
    let rng = &mut Rng::with_seed(3);
    for seed in 0..60 {
        let (dim, length) = (2 + seed % 2, rng.usize(3..=5));
        let held = [rng.usize(0..(dim - 1) * length)];
        let (case, d) = pressed(rng, dim, length, &held);
        for far in [0.0, 1.0, -8.0, 1000.0] {
            let motions = idle(dim, &places(dim, length), &held);
            let start = motions.iter().fold(d.clone(), |d, motion| moved(&d, far, motion));
            for method in METHODS {
                let solution = from(&case, (method, TOLERANCE), &start);
                assert_eq!(solution.d, start, "seed {seed}, {method:?}, {far}\n{case:?}");
            }
        }
    }
}

/// A gap that closes lets a body fall as far as it is wide, and this is not far: the solution stays where it is. It is turned
/// about its only point, by as much again. No unit of a tangent, here smaller by 2^30, is that of the gap.
#[test]
fn a_gap_lets_a_body_fall_no_further_than_it_must() {
    let rng = &mut Rng::with_seed(5);
    for (dim, length) in [2, 3].into_iter().flat_map(|dim| (3..=5).map(move |length| (dim, length)))
    {
        for held in 0..(dim - 1) * length {
            let mut case = pressed(rng, dim, length, &[held]).0;
            let n = case.size();
            let is_tangential = |i: usize| !(i % n).is_multiple_of(dim);
            let entries = case.k.iter_mut().enumerate();
            entries.filter(|(i, _)| is_tangential(*i)).for_each(|(_, k)| *k *= 2_f64.powi(-30));
            case.f = (0..n).map(|i| f64::from(u8::from(i == dim * held))).collect();
            case.gap[held] = 2_f64.powi(22);
            let places = places(dim, length);
            let fallen = normals(dim, &places, |_| case.gap[held]);
            let start = moved(&fallen, case.gap[held], &idle(dim, &places, &[held])[0]);
            for method in METHODS {
                let solution = from(&case, (method, TOLERANCE), &start);
                assert_eq!(solution.d, start, "{held}, {method:?}\n{case:?}");
                assert!(!solution.remarks.held_by_rounding, "{held}, {method:?}\n{case:?}");
            }
        }
    }
}

/// A body in two parts that hold each other, `[[1, -1], [-1, 1 + e]]`, under the load 1: it moves by `1 / e`, by the energy
/// `1 / e` of `e` alone. Rounding of a condensed matrix of these units may hold it so up to 100 times 3e-12 of
/// `(2 + e) / e²`: `e` up to 6e-10. In units of length and force that are powers of two the same is said.
#[test]
fn the_remark_tells_what_rounding_may_hold() {
    for (exponent, expected) in [(-37, true), (-34, true), (-31, true), (-30, false), (-24, false)]
    {
        let e = 2_f64.powi(exponent);
        for (length, force) in [(0, 0), (20, 0), (-20, 0), (0, 20), (0, -20)] {
            let [length, force] = [length, force].map(|power| 2_f64.powi(power));
            let mut k = vec![0.0; 16];
            (k[0], k[2], k[8], k[10]) = (1.0, -1.0, -1.0, 1.0 + e);
            (k[5], k[15]) = (1.0, 1.0);
            k.iter_mut().for_each(|k| *k *= force / length);
            let (f, gap) = (vec![0.0, 0.0, force, 0.0], vec![f64::INFINITY; 2]);
            let case = Case { dim: 2, pairs: 2, k, f, gap, law: frictionless(2), slip: None };
            let start = [length / e, 0.0, length / e, 0.0];
            for method in METHODS {
                let told = from(&case, (method, TOLERANCE), &start).remarks.held_by_rounding;
                assert_eq!(told, expected, "2^{exponent}, {length}, {force}, {method:?}");
            }
        }
    }
}

/// The motions that are left to a body are those that move no pair which touches its obstacle along its normal, pressed or not:
/// as many as the normals of these leave of its rigid motions.
#[test]
fn the_remark_tells_what_the_normals_leave_free() {
    let rng = &mut Rng::with_seed(4);
    let mut free = 0;
    for seed in 0..200 {
        let (dim, length) = (2 + seed % 2, rng.usize(3..=5));
        let places = places(dim, length);
        let mut touching: Vec<usize> = (0..places.len()).collect();
        rng.shuffle(&mut touching);
        touching.truncate(rng.usize(0..=4));
        let pressing = rng.usize(0..=touching.len());
        let (mut case, d) = pressed(rng, dim, length, &touching[..pressing]);
        touching[pressing..].iter().for_each(|&pair| case.gap[pair] = d[dim * pair]);
        // A spring of its own holds the first pair along its first tangent, and with it all.
        let n = case.size();
        case.k[n + 1] += 1.0;
        let rows = touching.iter().map(|&pair| [1.0, places[pair][0], places[pair][1]]);
        let rank = rank(rows.collect());
        for method in METHODS {
            let solution = from(&case, (method, TOLERANCE), &d);
            let is_free = solution.remarks.free_motion;
            assert_eq!(is_free, rank < dim, "seed {seed}, {method:?}: rank {rank}\n{case:?}");
            free += usize::from(is_free);
        }
    }
    assert!((100..350).contains(&free), "{free} of 400 are free");
}

/// The rank of a matrix of small whole numbers, by elimination without division.
fn rank(mut rows: Vec<[f64; 3]>) -> usize {
    let mut rank = 0;
    for column in 0..3 {
        let Some(at) = (rank..rows.len()).find(|&i| rows[i][column] != 0.0) else { continue };
        rows.swap(rank, at);
        let pivot = rows[rank];
        for row in &mut rows[rank + 1..] {
            let factor = row[column];
            *row = [0, 1, 2].map(|j| row[j] * pivot[column] - pivot[j] * factor);
        }
        rank += 1;
    }
    rank
}
