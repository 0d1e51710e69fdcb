//! Load cases in the plane in one call, each from nothing, beside each one alone: a slender beam above an uneven floor, on
//! which most pairs stay open.

use fastrand::Rng;
use signorini::{FrictionLaw, LoadCase, Model, Monitor, Settings, Solution, Starts, Status};

use crate::common::beam::beam;
use crate::common::dense::{difference, largest};

const PAIRS: usize = 120;
const CASES: usize = 12;

/// The first case has nothing of others, and takes what it takes by itself; all together take no more than by themselves.
/// Displacements differ by the tolerance times a condition of 1e7.
#[test]
fn cases_from_nothing_cost_no_more_in_one_call() {
    let settings = Settings { tolerance: 1e-12, ..Settings::default() };
    let k = beam(PAIRS, 0.1);
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
