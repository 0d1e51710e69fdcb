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
