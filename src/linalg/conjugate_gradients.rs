//! The method of conjugate gradients for a matrix that is well conditioned, by its products alone.

use super::tolerances::ROUNDING;
use super::vector::dot;

/// `x` with `A x = b` for a symmetric, positive definite `A`; at most as many steps as unknowns, and each asks `goes_on`,
/// which may end it with an error. The residual falls to rounding beside `b`.
pub fn conjugate_gradients<E>(
    times: impl Fn(&[f64]) -> Vec<f64>,
    b: &[f64],
    mut goes_on: impl FnMut() -> Result<(), E>,
) -> Result<Vec<f64>, E> {
    let (mut x, mut rest, mut along) = (vec![0.0; b.len()], b.to_vec(), b.to_vec());
    let mut square = dot(&rest, &rest);
    let least = ROUNDING * ROUNDING * square;
    for _ in 0..b.len() {
        goes_on()?;
        if square <= least {
            break;
        }
        let image = times(&along);
        let step = square / dot(&along, &image);
        x.iter_mut().zip(&along).for_each(|(x, along)| *x += step * along);
        rest.iter_mut().zip(&image).for_each(|(rest, image)| *rest -= step * image);
        let next = dot(&rest, &rest);
        along
            .iter_mut()
            .zip(&rest)
            .for_each(|(along, rest)| *along = rest + next / square * *along);
        square = next;
    }
    Ok(x)
}

#[cfg(test)]
mod tests {
    use super::conjugate_gradients;

    /// `[4 1; 1 3] [1; -2] = [2; -5]`, exact after two steps but for rounding.
    #[test]
    fn two_unknowns_take_two_steps() {
        let times = |x: &[f64]| vec![4.0 * x[0] + x[1], x[0] + 3.0 * x[1]];
        let x = conjugate_gradients(times, &[2.0, -5.0], || Ok::<(), ()>(())).unwrap();
        assert!((x[0] - 1.0).abs() < 1e-14 && (x[1] + 2.0).abs() < 1e-14, "{x:?}");
    }
}
