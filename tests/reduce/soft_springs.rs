//! Bodies on springs so soft that loads move them by many times the gaps.

use crate::common::dense::{difference, largest};
use crate::constrained::Constrained;
use signorini::{FrictionLaw, LoadCase, Model, Monitor, Settings, Solution, State, Status};
use std::f64::consts::TAU;

/// Of the pin; of its hole; of both.
const RADIUS: f64 = 0.1;
const CLEARANCE: f64 = 1e-3;
const FRICTION: f64 = 0.3;

/// A rigid link with springs `k diag(1, 1, 0.1)` at its middle, and at (-1/2, 0) a pin in a hole that five planes bound.
fn link(k: f64) -> Constrained {
    let normals: Vec<[f64; 2]> =
        (0..5).map(|j| TAU * f64::from(j) / 5.0).map(|angle| [angle.cos(), angle.sin()]).collect();
    let row = |[x, y]: &[f64; 2]| {
        let turn = vec![-RADIUS * y, RADIUS * x - 0.5];
        vec![(0, vec![1.0, 0.0]), (1, vec![0.0, 1.0]), (2, turn)]
    };
    Constrained {
        dim: 2,
        stiffness: vec![k, 0.0, 0.0, 0.0, k, 0.0, 0.0, 0.0, 0.1 * k],
        fixed: vec![],
        equations: vec![],
        rows: normals.iter().map(row).collect(),
        normals: normals.concat(),
        tangents: None,
    }
}

/// The link under the load (1, -0.1) at its middle.
fn drawn(model: &Model, settings: &Settings) -> Solution {
    let (load, gap) = (&[1.0, -0.1, 0.0], &[CLEARANCE; 5]);
    let law = FrictionLaw::Coulomb(&[FRICTION; 5]);
    let case = LoadCase { load, prescribed: None, gap, law, reference_slip: None };
    model.solve(&case, settings, None, &mut Monitor::new(settings, None)).unwrap()
}

/// The load (1, -0.1) at the middle draws the pin into the corner of the first two planes, at angles 0 and a, and the link turns
/// until its springs hold it: both pairs slip, `F_t = mu p`. With `p` and `q` on them, the forces along x and y, and the moment about
/// the pin, whose turn `theta` is twice `u_y` less the corner's height `h`:
///
/// ```text
/// p + q (cos a + mu sin a) = 1 - k c                       k u_y = -0.1 + mu p - q (sin a - mu cos a)
/// 0.1 k theta = 0.1 mu (p + q) - (k u_y + 0.1) / 2         theta = 2 (u_y - h)
/// ```
///
/// On the softest springs, which loads would move by 1e8, a link that has jammed across its hole meets the tolerance too, with
/// 1.5 clearances of penetration and forces that are none of these. To 1e-8: a hundred tolerances.
#[test]
fn a_link_on_soft_springs_turns_and_does_not_jam() {
    let (sin, cos) = (TAU / 5.0).sin_cos();
    let height = CLEARANCE * (1.0 - cos) / sin;
    for k in [1e-4, 1e-6, 1e-7, 1e-8] {
        let model = link(k).whole(&Settings::default());
        assert_eq!(model.dependent_pairs().len(), 4);
        let solution = drawn(&model, &Settings::default());
        assert_eq!(solution.status, Status::Solved, "{k:e}: {}", solution.message);
        // 0.2 k (u_y - h) = 0.1 mu (p + q) - (k u_y + 0.1) / 2, with the other two put in.
        let (across, down) = (cos + FRICTION * sin, sin - FRICTION * cos);
        let along = 1.0 - k * CLEARANCE;
        let [of_p, of_q] = [0.6 * FRICTION, -(0.7 * down + 0.1 * FRICTION)];
        let right = 0.02 + 0.2 * k * height;
        let q = (right - of_p * along) / (of_q - of_p * across);
        let p = along - q * across;
        let mut force = vec![0.0; 10];
        force[..4].copy_from_slice(&[-p, FRICTION * p, -q, FRICTION * q]);
        let certificate = &solution.certificate;
        let error = largest(&difference(&certificate.force, &force));
        assert!(error < 1e-8, "{k:e}: {:?}, not {force:?}", certificate.force);
        assert_eq!(certificate.states[..2], [State::Slip; 2], "{k:e}");
        assert_eq!(certificate.states[2..], [State::Open; 3], "{k:e}");
        // The root of the tolerance, 1e-5 of the clearance, is what rounds go on to.
        let penetration = certificate.penetration;
        assert!(penetration < 1e-5 * CLEARANCE, "{k:e}: {penetration:e}");
        assert!(!solution.remarks.gaps_passed, "{k:e}: {}", solution.message);
    }
}

/// A call whose iterations end while the link is still jammed has what meets the tolerance, and is told what passes the gaps: where
/// the penetration is above the root of the tolerance, 1e-5, beside the largest gap or normal displacement, and nowhere else.
#[test]
fn what_passes_the_gaps_is_told() {
    let model = link(1e-8).whole(&Settings::default());
    let mut counts = [0; 2];
    for max_iterations in 1..=40 {
        let solution = drawn(&model, &Settings { max_iterations, ..Settings::default() });
        if solution.status != Status::Solved {
            continue;
        }
        let normal = || solution.d.iter().step_by(2);
        let size = normal().fold(CLEARANCE, |size, d| size.max(d.abs()));
        let passes = normal().any(|d| d - CLEARANCE > 1e-5 * size);
        let said =
            solution.message.to_string().contains("of the largest gap or normal displacement");
        assert_eq!((solution.remarks.gaps_passed, said), (passes, passes), "{}", solution.message);
        counts[usize::from(passes)] += 1;
    }
    assert!(counts.iter().all(|&count| count > 5), "{counts:?}");
}
