//! Friction ellipses at every ratio of axes that the interface admits, one in a million: solved, and the residual of
//! what is returned measured in twice the precision.

use crate::common::ellipses::axes;
use crate::common::exact::{eta, quads};
use crate::common::problems::{Case, Law, definite, loaded, uniform};
use crate::common::quad::{Quad, norm};
use fastrand::Rng;
use signorini::{Settings, Solution, Status};

/// The numbers of a pair: coefficients `ratio` apart, axes at any angle.
fn numbers(rng: &mut Rng, ratio: f64) -> [f64; 3] {
    let mu = 10_f64.powf(uniform(rng, -2.0, 2.0));
    let angle = uniform(rng, -10.0, 10.0);
    if rng.bool() { [mu, mu / ratio, angle] } else { [mu / ratio, mu, angle] }
}

fn displacements(solution: &Solution) -> Vec<Quad> {
    solution.d.iter().zip(&solution.d_low).map(|(&d, &low)| Quad::sum(d, low)).collect()
}

/// One pair on springs of stiffness 1 in all directions.
fn on_unit_springs(f: [f64; 3], slip: [f64; 2], law: Law) -> Case {
    let k = (0..9).map(|i| if i % 4 == 0 { 1.0 } else { 0.0 }).collect();
    let (f, slip) = (f.to_vec(), Some(slip.to_vec()));
    Case { dim: 3, pairs: 1, k, f, gap: vec![0.0], law, slip }
}

fn solved(case: &Case) -> Solution {
    let solution = case.solve(&Settings::default());
    assert_eq!(solution.status, Status::Solved, "{case:?}: {}", solution.message);
    let eta = eta(case, &displacements(&solution));
    assert!(eta <= Settings::default().tolerance, "{case:?}: {eta:e}");
    solution
}

/// On unit springs `d = f + F` is `v = f - P` beside the reference, so that the pressure is `f_n` and the friction the
/// point of its ellipse that is nearest to `f_t - slip0`, by the associated rule; along that force by the other.
#[test]
fn a_pair_on_unit_springs_has_the_friction_of_its_ellipse() {
    let mut rng = Rng::with_seed(1);
    let recipe =
        on_unit_springs([2.0, -3.0, 1.0], [0.0, -1.0], Law::Orthotropic(vec![50.0, 7.8e-4, 9.06]));
    let mut cases = vec![recipe];
    for ratio in [1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 999_999.0] {
        for round in 0..200 {
            let law = numbers(&mut rng, ratio).to_vec();
            let law = if round % 2 == 0 { Law::Orthotropic(law) } else { Law::Collinear(law) };
            let mut some = |size: f64| uniform(&mut rng, -size, size);
            let (f, slip) = ([some(2.0) + 2.0, some(3.0), some(3.0)], [some(1.0), some(1.0)]);
            cases.push(on_unit_springs(f, slip, law));
        }
    }
    for case in cases {
        let solution = solved(&case);
        let axes = axes(&case, 0).expect("the law has an ellipse");
        let bound = Quad::from(case.law.of(0)[0]) * case.f[0];
        let trial: Vec<Quad> =
            (0..2).map(|c| Quad::from(case.f[1 + c]) - Quad::from(case.rest(0, c))).collect();
        let slips = axes.size(&trial) > bound;
        let expected = if slips { axes.friction(&trial, bound) } else { trial };
        // A residual of the tolerance, 1e-10 of forces up to 6, stands for a change of the loads by as much, which the
        // nearest point does not enlarge; along its own line friction changes by the ratio times as much.
        let enlarged = if matches!(case.law, Law::Collinear(_)) { axes.ratio() } else { 1.0 };
        let force = quads(&solution.certificate.force[1..]);
        let error = norm(&[force[0] + expected[0], force[1] + expected[1]]).value();
        assert!(error <= 1e-9 * enlarged, "{case:?}: {error:e}");
    }
}

/// Some pairs on a definite matrix, each with an ellipse of its own.
#[test]
fn ellipses_of_any_ratio_are_solved_on_definite_matrices() {
    let mut rng = Rng::with_seed(2);
    for round in 0..600 {
        let pairs = rng.usize(1..=4);
        let k = definite(&mut rng, 3 * pairs, [1.0, 1e2, 1e4][round % 3]);
        let law = (0..pairs).flat_map(|_| {
            let ratio = 10_f64.powf(uniform(&mut rng, 0.0, 5.999));
            let mut numbers = numbers(&mut rng, ratio);
            // Friction of the size of the loads.
            let most = numbers[0].max(numbers[1]);
            numbers[..2].iter_mut().for_each(|mu| *mu *= most.min(2.0) / most);
            numbers
        });
        let law = law.collect();
        let law = if round % 2 == 0 { Law::Orthotropic(law) } else { Law::Collinear(law) };
        solved(&loaded(&mut rng, 3, k, law));
    }
}
