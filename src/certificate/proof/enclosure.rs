//! The test that a solution lies next to a centre, and how near.
//!
//! With the scaled equations `G`, an approximate inverse `R` of their matrix and `z >= |R G(x)|`, the map
//! `y -> y - R G(y)` takes the box `|y - x| <= eps` into itself if `z + alpha eps <= eps`, `alpha` the row sums
//! of `|1 - R J|` for the matrices `J` of all places in the box: then `G` has a zero there (Brouwer), one only,
//! and it is at most `z + alpha eps` from `x`, component by component (R. Krawczyk, Computing 4 (1969)
//! 187-201; S. M. Rump, *Verification methods*, Acta Numerica 19 (2010) 287-449, section 13).
//!
//! Where the equations are linear and `x . J x >= l |x|²`, the zero is at most `|G(x)| / l` away.

use super::forces::{bound_of_product, enclosed_force};
use super::system::{Centre, Solver, System};
use crate::law::{EnclosedPiece, Local, Unknown};
use crate::linalg::approximate_inverse::ApproximateInverse;
use crate::linalg::ball::{Ball, BallVector, product_up, sum_up};
use crate::linalg::tolerances::FEW_OPERATIONS;
use crate::linalg::vector::first_not_finite;
use crate::linalg::watched::GoesOn;

/// The box, in units of the first correction: `alpha` may be a half.
const BOX: f64 = 2.0;

/// A box that holds a solution.
pub struct Enclosure {
    /// Bounds on the distance of its displacements from the centre.
    pub d_radius: Vec<f64>,
    /// Its forces.
    pub force: Vec<BallVector>,
}

/// A solution of the frozen equations next to the centre; `None` if it is not
/// proved, or if it is not clear of the boundaries of its pieces, or where `goes_on` says no.
pub fn enclose(
    system: &System<'_>,
    solver: &Solver,
    centre: &Centre,
    goes_on: GoesOn<'_>,
) -> Option<Enclosure> {
    let v = system.beyond_reference(centre);
    let force = enclosed_force(system.contact, (&centre.d, &centre.low), &centre.force);
    let lack = system.lack(centre, &force);
    if !goes_on() {
        return None;
    }
    match solver {
        Solver::Definite(definite) => {
            let radius = (length_up(&lack) / definite.least).next_up();
            let radii = vec![radius; system.unknowns.len()];
            Neighbourhood::new(system, &force, &v, radius).enclosure(&v, &radii)
        }
        Solver::Inverse(inverse) => by_inverse(system, inverse, &lack, (&force, &v), goes_on),
    }
}

/// A bound on the length of vectors in the balls.
fn length_up(balls: &[Ball]) -> f64 {
    // In the unit of the largest, so that no square overflows.
    let most = balls.iter().fold(0.0, |most: f64, ball| most.max(ball.size()));
    let square = |ball: &Ball| {
        let part = if most > 0.0 { (ball.size() / most).next_up() } else { ball.size() };
        product_up(part, part)
    };
    let sum = balls.iter().map(square).fold(0.0, sum_up);
    product_up(sum.sqrt().next_up(), most)
}

fn by_inverse(
    system: &System<'_>,
    inverse: &ApproximateInverse,
    lack: &[Ball],
    (force, v): (&[BallVector], &[BallVector]),
    goes_on: GoesOn<'_>,
) -> Option<Enclosure> {
    let middle: Vec<f64> = lack.iter().map(|lack| lack.middle()).collect();
    let doubt: Vec<f64> = lack.iter().map(|lack| lack.radius()).collect();
    let first = inverse.image(&middle, &doubt);
    let eps = BOX * first.iter().fold(f64::MIN_POSITIVE, |most, &z| most.max(z));
    let neighbourhood = Neighbourhood::new(system, force, v, eps);
    let alpha = inverse.contraction(&neighbourhood.doubts(), goes_on)?;
    let radius = |(z, alpha): (&f64, &f64)| {
        let radius = sum_up(*z, product_up(*alpha, eps));
        (*alpha < 1.0 && radius <= eps).then_some(radius)
    };
    let radii: Vec<f64> = first.iter().zip(&alpha).map(radius).collect::<Option<_>>()?;
    neighbourhood.enclosure(v, &radii)
}

/// The pieces on a box of the unknowns.
struct Neighbourhood<'s> {
    system: &'s System<'s>,
    force: &'s [BallVector],
    locals: Vec<Local>,
    /// The bounds `g` on the tangential forces.
    thresholds: Vec<Ball>,
    /// `|K|` on the displacements of one unit of each scaled unknown.
    moved: Vec<f64>,
}

impl<'s> Neighbourhood<'s> {
    fn new(system: &'s System<'s>, force: &'s [BallVector], v: &[BallVector], eps: f64) -> Self {
        let dim = system.contact.dim();
        let mut w: Vec<[Ball; 2]> =
            system.pairs.iter().zip(v).map(|(pair, v)| pair.slip_vector(v)).collect();
        for unknown in system.unknowns.iter().filter(|unknown| unknown.component > 0) {
            let own = &mut w[unknown.pair][unknown.component - 1];
            *own = own.widened(product_up(eps, unknown.column));
        }
        let locals: Vec<Local> =
            system.pairs.iter().zip(w).map(|(pair, w)| pair.local(w)).collect();
        let mut neighbourhood =
            Neighbourhood { system, force, locals, thresholds: Vec::new(), moved: Vec::new() };
        let ones = vec![1.0; system.unknowns.len()];
        let motion = neighbourhood.displacements(&ones);
        neighbourhood.moved = bound_of_product(system.contact.problem(), &motion);
        let threshold = |(at, pair): (usize, &EnclosedPiece)| {
            let change = product_up(neighbourhood.moved[dim * at], eps);
            pair.enclosed_threshold(force[at][0].widened(change))
        };
        neighbourhood.thresholds = system.pairs.iter().enumerate().map(threshold).collect();
        neighbourhood
    }

    /// Bounds on displacements, of bounds on the scaled unknowns.
    fn displacements(&self, size: &[f64]) -> Vec<f64> {
        self.sums(size, |unknown, c| {
            self.locals[unknown.pair].motion[c][unknown.component - 1].size()
        })
    }

    /// Sums over the unknowns of a bound on the derivative of each displacement; of normal ones it is 1.
    fn sums(&self, size: &[f64], tangential: impl Fn(&Unknown, usize) -> f64) -> Vec<f64> {
        let dim = self.system.contact.dim();
        let mut sums = vec![0.0; self.system.contact.unknowns()];
        for (unknown, size) in self.system.unknowns.iter().zip(size) {
            let size = product_up(unknown.column, *size);
            let own = &mut sums[dim * unknown.pair..dim * (unknown.pair + 1)];
            if unknown.component == 0 {
                own[0] = sum_up(own[0], size);
                continue;
            }
            for (c, own) in own[1..].iter_mut().enumerate() {
                *own = sum_up(*own, product_up(tangential(unknown, c), size));
            }
        }
        sums
    }

    /// Bounds on the row sums of the difference between the scaled matrix as it was computed and those of all
    /// places in the box.
    fn doubts(&self) -> Vec<f64> {
        let (system, dim) = (self.system, self.system.contact.dim());
        let ones = vec![1.0; system.unknowns.len()];
        // Displacements of a normal unknown are exact: what is rounded there is the product.
        let mut change = self.sums(&ones, |unknown, c| {
            let slopes = &system.slopes[unknown.pair];
            let (column, used) = (unknown.component - 1, slopes.motion[c][unknown.component - 1]);
            difference(self.locals[unknown.pair].motion[c][column], used)
        });
        for unknown in system.unknowns.iter().filter(|unknown| unknown.component == 0) {
            change[dim * unknown.pair] = product_up(FEW_OPERATIONS, unknown.column);
        }
        let changed = bound_of_product(system.contact.problem(), &change);
        let doubt = |row: &Unknown| {
            let (at, c) = (dim * row.pair, row.component);
            let mut doubt = sum_up(changed[at + c], self.turned(row));
            // A pair that is dragged is closed: its normal component is no unknown.
            if system.pairs[row.pair].is_dragged() {
                let drag = system.pairs[row.pair].drag(&self.locals[row.pair])[c - 1];
                let used = system.slopes[row.pair].drag[c - 1];
                let size = sum_up(used.abs(), difference(drag, used));
                doubt = sum_up(doubt, product_up(size, changed[at]));
                doubt = sum_up(doubt, product_up(difference(drag, used), self.moved[at]));
            }
            sum_up(product_up(row.row, doubt), f64::MIN_POSITIVE)
        };
        system.unknowns.iter().map(doubt).collect()
    }

    /// The bound for the part of a row by which the friction of its pair turns.
    fn turned(&self, row: &Unknown) -> f64 {
        if row.component == 0 {
            return 0.0;
        }
        let (turn, threshold) = (&self.locals[row.pair].turn, self.thresholds[row.pair]);
        let own = self.system.unknowns.iter().filter(|unknown| unknown.pair == row.pair);
        let along = row.component - 1;
        own.filter(|unknown| unknown.component > 0).fold(0.0, |sum, unknown| {
            let column = unknown.component - 1;
            let used = self.system.slopes[row.pair].turn[along][column];
            let doubt = difference(threshold * turn[along][column], used);
            sum_up(sum, product_up(doubt, unknown.column))
        })
    }

    /// The enclosure, if it is inside the pieces.
    fn enclosure(&self, v: &[BallVector], radii: &[f64]) -> Option<Enclosure> {
        let (system, dim) = (self.system, self.system.contact.dim());
        let d_radius = self.displacements(radii);
        let f_radius = bound_of_product(system.contact.problem(), &d_radius);
        let widened = |ball: &BallVector, at: usize, by: &[f64]| {
            let mut ball = *ball;
            (0..dim).for_each(|c| ball[c] = ball[c].widened(by[dim * at + c]));
            ball
        };
        let mut forces = Vec::with_capacity(v.len());
        for (at, (pair, local)) in system.pairs.iter().zip(&self.locals).enumerate() {
            let needed = widened(&self.force[at], at, &f_radius);
            let v = widened(&v[at], at, &d_radius);
            if !pair.is_inside(local, &v, &needed) {
                return None;
            }
            forces.push(pair.force(local, &needed));
        }
        let all = first_not_finite(&d_radius).is_none()
            && forces.iter().flatten().all(|ball| ball.radius().is_finite());
        all.then_some(Enclosure { d_radius, force: forces })
    }
}

/// Not below the distance of any number of the ball to the one that was used, with the rounding of what was
/// made with it.
fn difference(ball: Ball, used: f64) -> f64 {
    sum_up(ball.distance_to(used), product_up(FEW_OPERATIONS, used.abs()))
}

#[cfg(test)]
mod tests;
