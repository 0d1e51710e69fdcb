//! When a frictionless solution is said to move freely, whatever a method has factorised on its way: on problems of which
//! the pivots are known in closed form, small ones and such as are solved by changes of a factor.

use signorini::{ContactData, ContactProblem, FrictionLaw, Monitor, Settings, Status};

/// Pairs beside the two that open: so few that each system is factorised anew, and so many that the systems of open pairs
/// are changes of the first one, which has more than 64 unknowns.
const OTHERS: [usize; 2] = [1, 80];

/// If the solution moves freely: springs of stiffness 1 on pairs that are pressed, and two pairs that are pulled off, with
/// `coupling` between their normal components. The tangential spring of the first one is `tangential`.
fn moves_freely(others: usize, coupling: f64, tangential: f64) -> bool {
    let pairs = others + 2;
    let size = 2 * pairs;
    let mut stiffness = vec![0.0; size * size];
    stiffness.iter_mut().step_by(size + 1).for_each(|entry| *entry = 1.0);
    // In the midst of the others, so that no order of the pivots is the one of the components.
    let first = 2 * (others / 2);
    let second = first + 2;
    stiffness[first + size * second] = coupling;
    stiffness[second + size * first] = coupling;
    stiffness[(first + 1) * (size + 1)] = tangential;
    let mut load = vec![0.0; size];
    load.iter_mut().step_by(2).for_each(|normal| *normal = 1.0);
    (load[first], load[second]) = (-1.0, -1.0);
    let gap = vec![0.0; pairs];
    let problem = ContactProblem::new(ContactData {
        dim: 2,
        pairs,
        stiffness: &stiffness,
        ld: size,
        load: &load,
        gap: &gap,
        law: FrictionLaw::Frictionless,
        reference_slip: None,
    });
    let (settings, problem) = (Settings::default(), problem.expect("the data is valid"));
    let solution = signorini::solve(&problem, &settings, None, &mut Monitor::new(&settings, None));
    let solution = solution.expect("the settings fit");
    assert_eq!(solution.status, Status::Solved, "{others}, {coupling}: {}", solution.message);
    // Both open by f / (1 + c).
    let opened = -1.0 / (1.0 + coupling);
    for i in [first, second] {
        assert!((solution.d[i] - opened).abs() <= 1e-3, "{others}: {}", solution.d[i]);
    }
    solution.remarks.free_motion
}

/// The last pivot of the pairs that open is `1 - c²`. Below 1e-11 it is the rounding of a zero: nothing resists the motion
/// that parts the pairs.
#[test]
fn pairs_that_open_move_freely_where_their_last_pivot_is_rounding() {
    for others in OTHERS {
        for (pivot, free) in [(0.75, false), (1e-6, false), (1e-9, false), (4e-12, true)] {
            let coupling = f64::sqrt(1.0 - pivot);
            assert_eq!(moves_freely(others, coupling, 1.0), free, "{others}, pivot {pivot:e}");
        }
    }
}

/// A diagonal entry below 1e-13 of the largest of its pair is no stiffness, though it is a pivot of size 1 beside itself.
#[test]
fn a_component_moves_freely_where_its_own_stiffness_is_rounding_beside_its_pair() {
    for others in OTHERS {
        for (tangential, free) in [(1e-10, false), (1e-14, true)] {
            assert_eq!(moves_freely(others, 0.5, tangential), free, "{others}, {tangential:e}");
        }
    }
}
