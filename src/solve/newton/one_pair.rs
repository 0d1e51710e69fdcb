//! One pair in the plane: two equations.
//!
//! On a piece the law is linear, and Newton's step ends at the solution if the piece is that of the solution. For one pair
//! in the plane a step is Cramer's rule, which takes a tenth of the time of a system that is assembled and factorised, so that
//! no sweeps are worth while before it. What it leaves open, where pieces do not settle, equations are nearly singular or
//! digits are lost, is left to sweeps and Newton's method on the systems of all problems.

use super::descent::ROUNDING_OF_ETA;
use super::iteration::FULL_STEPS;
use crate::certificate::eta_of;
use crate::law::{PairLaw, Piece, Vector};
use crate::linalg::matrix::Matrix;
use crate::linalg::tolerances::SUSPICIOUS_PIVOT;
use crate::solve::result::{Call, Candidate, Effort, Ending};

/// The solution of one pair in the plane, up to rounding of its forces, if some steps from the start lead there. If there is
/// no start, the pair is closed without slip.
pub fn solve(call: &Call<'_>) -> Option<Candidate> {
    let contact = call.contact;
    let ([law], [n, t]) = (contact.pairs(), contact.problem().load()) else { return None };
    let equations = TwoEquations { law, matrix: contact.problem().stiffness(), load: [*n, *t] };
    let [reference_n, reference_t, _] = law.reference();
    let (n, t) = call.start.map_or((reference_n, reference_t), |start| (start[0], start[1]));
    let d = [law.admissible(n), t];
    let mut y = law.chart(&d, &equations.force(d));
    let mut piece = law.piece(&y);
    for _ in 0..FULL_STEPS {
        call.monitor.step().ok()?;
        let (step, orientation) = equations.step(piece, &y)?;
        y = [y[0] - step[0], y[1] - step[1], 0.0];
        let before = std::mem::replace(&mut piece, law.piece(&y));
        if piece == before {
            let (d, force, _) = equations.at(piece, &y);
            // Nothing is factorised.
            let (ending, effort) = (Ending::Done, Effort::default());
            let mut found = Candidate::new(d.to_vec(), force.to_vec(), ending, effort);
            found.orientation = orientation;
            return (eta_of(contact, &d, &force) <= ROUNDING_OF_ETA).then_some(found);
        }
    }
    None
}

/// The equations `K d - f + P = 0` of the pair.
struct TwoEquations<'e> {
    law: &'e PairLaw,
    matrix: Matrix<'e>,
    load: [f64; 2],
}

impl TwoEquations<'_> {
    fn product(&self, d: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|i| self.matrix.at(i, 0) * d[0] + self.matrix.at(i, 1) * d[1])
    }

    fn force(&self, d: [f64; 2]) -> [f64; 2] {
        let [n, t] = self.product(d);
        [n - self.load[0], t - self.load[1]]
    }

    /// The displacement at coordinates on a piece, the force that it needs, and the lack of equilibrium.
    fn at(&self, piece: Piece, y: &Vector) -> ([f64; 2], [f64; 2], [f64; 2]) {
        let push = self.law.push_on(piece, y);
        let [n, t, _] = self.law.displacement(y, &push);
        let force = self.force([n, t]);
        ([n, t], force, [force[0] + push[0], force[1] + push[1]])
    }

    /// The way back from coordinates to the solution on a piece, and the sign of the determinant; `None` if that is next to
    /// zero.
    fn step(&self, piece: Piece, y: &Vector) -> Option<([f64; 2], i8)> {
        let pair = self.law.linearised(piece, y);
        let column = |dy: Vector| {
            let moved = pair.moved(&dy);
            let [n, t, _] = self.law.displacement_by(&moved);
            let product = self.product([n, t]);
            [product[0] + dy[0] - moved[0], product[1] + dy[1] - moved[1]]
        };
        let (normal, tangential) = (column([1.0, 0.0, 0.0]), column([0.0, 1.0, 0.0]));
        let (_, _, lack) = self.at(piece, y);
        let determinant = |one: [f64; 2], two: [f64; 2]| one[0] * two[1] - one[1] * two[0];
        let all = determinant(normal, tangential);
        let step = [determinant(lack, tangential) / all, determinant(normal, lack) / all];
        (all.abs() > SUSPICIOUS_PIVOT).then_some((step, if all > 0.0 { 1 } else { -1 }))
    }
}
