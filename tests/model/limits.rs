//! A time limit and a callback end the making of models of condensed matrices.

use std::ops::ControlFlow;

use signorini::{Error, Limit, Model, Monitor, Progress, Settings};

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
