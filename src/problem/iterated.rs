//! Solutions with the products and the preconditioner of bodies that have no factor.

use super::{GoesOn, HeldSet, StiffnessOperator};
use crate::error::Error;
use crate::linalg::gmres::gmres;
use crate::linalg::vector::{combination, norm};

/// Most preconditionings of one solution: with a preconditioner that takes more nothing is solved in time.
const MOST: usize = 200;

/// The solution `x` of `A x = forces` with components held, no springs among the others, that leaves `left` of the
/// forces, each in its unit; with the number of preconditionings that it has taken. The components are those of the last
/// [`StiffnessOperator::hold`]. `None` where `goes_on` says no.
///
/// # Errors
/// A failure in the host.
pub fn iterated(
    bodies: &mut dyn StiffnessOperator,
    held_set: &HeldSet,
    (forces, left): (&[f64], f64),
    goes_on: GoesOn<'_>,
) -> Result<Option<(Vec<f64>, u64)>, Error> {
    let root: Vec<f64> = bodies.units().iter().map(|unit| unit.sqrt()).collect();
    let scaled = |forces: &[f64]| {
        let mut scaled: Vec<f64> = forces.iter().zip(&root).map(|(f, root)| f / root).collect();
        held_set.clear(&mut scaled);
        scaled
    };
    let right = scaled(forces);
    let mut directions: Vec<Vec<f64>> = Vec::new();
    // It ends early by an error of the host, or by none where `goes_on` says no.
    let found = gmres(&right, left * norm(&right), MOST, |v| -> Result<Vec<f64>, Option<Error>> {
        let forces: Vec<f64> = v.iter().zip(&root).map(|(v, root)| v * root).collect();
        let Some(z) = bodies.solve(Some(held_set), &forces, goes_on)? else { return Err(None) };
        let image = scaled(&bodies.product(&z)?);
        directions.push(z);
        Ok(image)
    });
    let shares = match found {
        Ok((shares, _)) => shares,
        Err(None) => return Ok(None),
        Err(Some(error)) => return Err(error),
    };
    let x = combination(forces.len(), shares.into_iter().zip(&directions));
    Ok(Some((x, directions.len() as u64)))
}
