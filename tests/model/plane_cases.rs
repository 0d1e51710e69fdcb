//! Load cases in the plane in one call, each from nothing, beside each one alone: a slender beam above an uneven floor, on
//! which most pairs stay open.

use fastrand::Rng;
use signorini::{FrictionLaw, LoadCase, Model, Monitor, Settings, Solution, Starts, Status};

use crate::common::dense::{difference, largest};

const PAIRS: usize = 120;
const CASES: usize = 12;
const THICKNESS: f64 = 0.1;

/// The stiffness of the lower fibre of a beam of length 1 that is clamped at both ends: it bends by second differences of the
/// deflections `w`, and its axis is stretched by first differences of `u + h/2 w'`.
fn beam() -> Vec<f64> {
    let (n, step) = (2 * PAIRS, 1.0 / (PAIRS + 1) as f64);
    let bending = THICKNESS.powi(2) / 12.0;
    let mut k = vec![0.0; n * n];
    let mut add = |weight: f64, terms: &[(isize, usize, f64)]| {
        let inside = |node: isize| (1..=PAIRS as isize).contains(&node);
        let terms: Vec<(usize, f64)> = (terms.iter())
            .filter(|(node, ..)| inside(*node))
            .map(|(node, component, part)| (2 * (*node as usize - 1) + component, *part))
            .collect();
        for (i, a) in &terms {
            terms.iter().for_each(|(j, b)| k[i + n * j] += weight * a * b);
        }
    };
    for node in 0..=PAIRS as isize + 1 {
        let curvature = [-1, 0, 1].map(|to| (node + to, 0, if to == 0 { -2.0 } else { 1.0 }));
        add(bending / step.powi(3), &curvature);
    }
    for node in 0..=PAIRS as isize {
        let half = THICKNESS / 2.0;
        let stretched = [(node, 1, -1.0), (node + 1, 1, 1.0)];
        let turned = [(node - 1, 0, half), (node, 0, -half), (node + 1, 0, -half)];
        let last = [(node + 2, 0, half)];
        let turned = turned.iter().chain(&last).map(|(i, c, part)| (*i, *c, part / (2.0 * step)));
        let terms: Vec<_> = stretched.into_iter().chain(turned).collect();
        add(1.0 / step, &terms);
    }
    k
}

/// The first case has nothing of others, and takes what it takes by itself; all together take no more than by themselves.
/// Displacements differ by the tolerance times a condition of 1e7.
#[test]
fn cases_from_nothing_cost_no_more_in_one_call() {
    let settings = Settings { tolerance: 1e-12, ..Settings::default() };
    let k = beam();
    let model = Model::condensed(2, PAIRS, &k, 2 * PAIRS).unwrap();
    let mut rng = Rng::with_seed(3);
    let gap: Vec<f64> = (0..PAIRS).map(|_| 1e-3 * rng.f64()).collect();
    let law = FrictionLaw::Coulomb(&[0.3; PAIRS]);
    let loads: Vec<Vec<f64>> = (0..CASES)
        .map(|_| {
            let pushed = |i: usize| if i.is_multiple_of(2) { rng.f64() } else { 0.4 * rng.f64() };
            (0..2 * PAIRS).map(pushed).map(|part| 1e-2 * part).collect()
        })
        .collect();
    let case = |load| LoadCase { load, prescribed: None, gap: &gap, law, reference_slip: None };
    let cases: Vec<LoadCase<'_>> = loads.iter().map(|load| case(load)).collect();
    let alone = |case| model.solve(case, &settings, None, &mut Monitor::new(&settings, None));
    let alone: Vec<Solution> = cases.iter().map(|case| alone(case).unwrap()).collect();
    let solved = model.solve_cases(&cases, &settings, Starts::Cold, None);
    let together: Vec<Solution> = solved.into_iter().map(|solution| solution.unwrap()).collect();
    for (k, (one, other)) in together.iter().zip(&alone).enumerate() {
        assert_eq!([one.status, other.status], [Status::Solved; 2], "case {k}");
        assert!(largest(&difference(&one.d, &other.d)) <= 1e-5 * largest(&other.d), "case {k}");
    }
    assert!(together[0].d == alone[0].d);
    for count in [|one: &Solution| one.iterations, |one: &Solution| one.factorisations] {
        let cost = |all: &[Solution]| all.iter().map(count).sum::<u64>();
        assert_eq!(count(&together[0]), count(&alone[0]));
        assert!(cost(&together) <= cost(&alone), "{} beside {}", cost(&together), cost(&alone));
    }
}
