//! A stiff body that a soft one alone holds, pulled away: statics says that no forces balance the loads, whatever the stiffnesses.

use crate::common::mesh::{Mesh, Pairs, steps};
use fastrand::Rng;
use signorini::{FrictionLaw, LoadCase, Model, Monitor, Settings, Status};

/// A plate on a block that is fixed below, so many times as stiff, in so many columns; the plate is guided along one side or
/// free. Its loads lift every node of its top.
fn lifted(
    ratio: f64,
    (columns, guided): (usize, bool),
    full_space: bool,
    rng: &mut Rng,
) -> (Model, Vec<f64>) {
    let mut mesh = Mesh::default();
    let x = steps(0.0, 1.0, columns);
    let soft = mesh.block(&x, &steps(-1.0, 0.0, columns), (1.0, 0.3));
    let stiff = mesh.block(&x, &steps(0.0, 0.1 + 0.4 * rng.f64(), 1), (ratio, 0.3));
    let mut fixed: Vec<usize> =
        soft.row(0).into_iter().flat_map(|node| [2 * node, 2 * node + 1]).collect();
    if guided {
        fixed.extend(stiff.column(0).iter().map(|node| 2 * node));
    }
    let mut load = vec![0.0; mesh.size()];
    stiff.row(stiff.rows).iter().for_each(|node| load[2 * node + 1] = 0.01 * rng.f64());
    let pairs = Pairs::matching(&stiff.row(0), &soft.row(soft.rows), [0.0, -1.0]);
    let settings = Settings { full_space, ..Settings::default() };
    let monitor = &mut Monitor::new(&settings, None);
    let model = mesh.stiffness().model_under(&fixed, &pairs.view(), monitor);
    (model.expect("stiffnesses"), load)
}

/// All forces of contact point upwards on the plate, as its loads do: no equilibrium under any law. In doubles the condensation
/// leaves rounding of the stiff body on its free motion, which must not pass for stiffness of the soft one.
#[test]
fn a_stiff_body_that_is_pulled_off_a_soft_one_has_no_equilibrium() {
    let rng = &mut Rng::with_seed(1);
    for exponent in 0..=7 {
        for kind in [(4, true), (13, true), (16, false), (24, true), (24, false)] {
            // In full space rounding hides the forces from 1e5 on, under given friction: no answer.
            for full_space in [false, true].into_iter().take(if exponent > 4 { 1 } else { 2 }) {
                let ratio = 10_f64.powi(exponent);
                let (model, load) = lifted(ratio, kind, full_space, rng);
                let gap = vec![0.0; model.pairs()];
                let (mu, given) = (vec![0.3; model.pairs()], vec![0.02; model.pairs()]);
                let laws = [
                    FrictionLaw::Frictionless,
                    FrictionLaw::Coulomb(&mu),
                    FrictionLaw::Tresca(&given),
                ];
                for law in laws {
                    let gap = &gap[..];
                    let case =
                        LoadCase { load: &load, prescribed: None, gap, law, reference_slip: None };
                    let settings = Settings::default();
                    let monitor = &mut Monitor::new(&settings, None);
                    let found =
                        model.solve(&case, &settings, None, monitor).expect("data that fit");
                    let name = format!("{ratio:e}, {kind:?}, full space: {full_space}, {law:?}");
                    assert_eq!(found.status, Status::NoEquilibrium, "{name}: {}", found.message);
                }
            }
        }
    }
}
