//! A static library of somebody else, with its own copy of Rust's standard library and, with
//! `--cfg faer`, of a crate that signorini uses too. It unwinds, allocates and multiplies.

/// The sum of the squares below `n`; -1 if that made it panic.
#[unsafe(no_mangle)]
pub extern "C" fn other_work(n: i32) -> f64 {
    std::panic::set_hook(Box::new(|_| {}));
    std::panic::catch_unwind(|| {
        let values: Vec<f64> = (0..usize::try_from(n).unwrap()).map(|i| i as f64).collect();
        square(&values)
    })
    .unwrap_or(-1.0)
}

#[cfg(not(faer))]
fn square(values: &[f64]) -> f64 {
    values.iter().map(|x| x * x).sum()
}

#[cfg(faer)]
fn square(values: &[f64]) -> f64 {
    let x = faer::Mat::from_fn(values.len(), values.len(), |i, j| values[i] * f64::from(j == 0));
    (x.transpose() * &x)[(0, 0)]
}
