//! A time limit and a callback end the making of models of condensed matrices.

use std::ops::ControlFlow;

use signorini::{Error, FrictionLaw, Limit, LoadCase, Model, Monitor, Progress, Settings};
use signorini::{Starts, Status};

use crate::common::wavy::Wavy;

/// Pairs in the plane: the check factorises five panels.
const PAIRS: usize = 600;

/// Springs in a row, each tied to the ground too: diagonally dominant.
fn springs() -> Vec<f64> {
    let n = 2 * PAIRS;
    let mut k = vec![0.0; n * n];
    for i in 0..n {
        k[i + n * i] = 3.0;
        if i > 0 {
            k[i + n * (i - 1)] = -1.0;
            k[i - 1 + n * i] = -1.0;
        }
    }
    k
}

/// Makes a model of one body or of two.
fn made(bodies: usize, k: &[f64], monitor: &mut Monitor<'_>) -> Result<Model, Error> {
    let matrix = (k, 2 * PAIRS);
    match bodies {
        1 => Model::condensed_within(2, PAIRS, matrix, monitor),
        _ => Model::two_body_within(2, PAIRS, [matrix, matrix], monitor),
    }
}

/// Whenever the callback cancels there is no model, and without it the model is that without a monitor.
#[test]
fn a_callback_ends_the_making() {
    let (k, settings) = (springs(), Settings::default());
    for bodies in [1, 2] {
        let run = |most: u64| {
            let mut calls = 0;
            let mut progress = |_: &Progress| {
                calls += 1;
                if calls > most { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            };
            let result = made(bodies, &k, &mut Monitor::new(&settings, Some(&mut progress)));
            (result, calls)
        };
        let (whole, calls) = run(u64::MAX);
        let whole = whole.unwrap();
        assert!(calls > 4, "{bodies}: {calls} calls");
        for most in 0..calls {
            let (result, asked) = run(most);
            assert!(matches!(result, Err(Error::Stopped { limit: Limit::Cancelled, .. })));
            assert_eq!(asked, most + 1);
        }
        let matrix = (&k[..], 2 * PAIRS);
        let plain = match bodies {
            1 => Model::condensed(2, PAIRS, matrix.0, matrix.1),
            _ => Model::two_body(2, PAIRS, matrix, matrix),
        };
        assert_eq!(plain.unwrap().stiffness(), whole.stiffness());
    }
}

#[test]
fn a_time_limit_ends_the_making() {
    let (k, settings) =
        (springs(), Settings { time_limit: f64::MIN_POSITIVE, ..Settings::default() });
    for bodies in [1, 2] {
        let result = made(bodies, &k, &mut Monitor::new(&settings, None));
        assert!(matches!(result, Err(Error::Stopped { limit: Limit::Time, .. })), "{bodies}");
    }
}

/// The results of six load cases of a model, and how often its callback was called, which cancels after `most` calls.
fn six_cases(model: &Model, load: &[f64], most: u64) -> (Vec<Result<Status, Limit>>, u64) {
    let (gap, mu) = (vec![0.0; model.pairs()], vec![0.3; model.pairs()]);
    let law = FrictionLaw::Coulomb(&mu);
    let case = LoadCase { load, prescribed: None, gap: &gap, law, reference_slip: None };
    let mut calls = 0;
    let mut progress = |_: &Progress| {
        calls += 1;
        if calls > most { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let settings = Settings::default();
    let solved = model.solve_cases(&[case; 6], &settings, Starts::Cold, Some(&mut progress));
    let told = solved.into_iter().map(|solved| match solved {
        Ok(solution) => Ok(solution.status),
        Err(Error::Stopped { limit, .. }) => Err(limit),
        Err(other) => panic!("{other:?}"),
    });
    (told.collect(), calls)
}

/// A callback that cancels ends the whole call: cases before are solved, the one in work is cancelled, unless it is
/// solved already, or not begun while the loads of all are condensed, and the callback is not called again.
#[test]
fn a_callback_ends_the_load_cases_behind_too() {
    let springs = Model::condensed(2, PAIRS, &springs(), 2 * PAIRS).unwrap();
    let of_springs = vec![-1.0; 2 * PAIRS];
    // Its factor has so many values that the condensation of six loads asks.
    let wavy = Wavy::space(24);
    let sparse = wavy.try_model(&mut Monitor::new(&Settings::default(), None)).unwrap();
    let mut asked_while_condensed = 0;
    for (model, load) in [(&springs, &of_springs), (&sparse, &wavy.load)] {
        let (told, calls) = six_cases(model, load, u64::MAX);
        assert_eq!(told, [Ok(Status::Solved); 6]);
        // All of the first questions, and some of the others.
        for most in (0..10).chain((10..calls).step_by(9)) {
            let (told, asked) = six_cases(model, load, most);
            let begun = told.iter().take_while(|told| told.is_ok()).count();
            assert!(told[begun..].iter().all(|told| *told == Err(Limit::Cancelled)), "{told:?}");
            let last = begun.saturating_sub(1);
            assert!(told[..last].iter().all(|told| *told == Ok(Status::Solved)), "{told:?}");
            if begun > 0 {
                let known = [Ok(Status::Cancelled), Ok(Status::Solved)];
                assert!(known.contains(&told[last]), "{most}: {told:?}");
            }
            asked_while_condensed += u64::from(begun == 0);
            assert_eq!(asked, most + 1);
        }
    }
    assert!(asked_while_condensed > 0);
}
