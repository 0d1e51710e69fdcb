//! One pair in the plane: two equations.
//!
//! On a piece the law is linear, and Newton's step ends at the solution if the piece is that of the solution. For one pair
//! in the plane that is Cramer's rule, which takes a tenth of the time of a system that is assembled and factorised. What
//! it leaves open, where pieces change, equations are nearly singular or digits are lost, is left to Newton's method.

use super::iteration::Ended;
use super::polish::ROUNDING_OF_ETA;
use crate::law::Vector;
use crate::linalg::tolerances::SUSPICIOUS_PIVOT;
use crate::monitor::Monitor;
use crate::solve::pieces::Equations;
use crate::solve::result::Ending;

/// The solution of the equations of one pair in the plane, if it is on the piece of the coordinates `y`, up to rounding of
/// its forces.
pub(super) fn solve(
    equations: &Equations<'_>,
    y: &[Vector],
    monitor: &mut Monitor<'_>,
) -> Option<Ended> {
    let ([law], [y], 2) = (&*equations.laws, y, equations.dim) else { return None };
    monitor.step().ok()?;
    let (piece, matrix) = (law.piece(y), equations.matrix);
    let product = |d: [f64; 2]| [0, 1].map(|i| matrix.at(i, 0) * d[0] + matrix.at(i, 1) * d[1]);
    let at = |y: &Vector| {
        let push = law.push_on(piece, y);
        let [n, t, _] = law.displacement(y, &push);
        let [normal, tangential] = product([n, t]);
        let force = [normal - equations.load[0], tangential - equations.load[1]];
        ([n, t], force, [force[0] + push[0], force[1] + push[1]])
    };
    let pair = law.linearised(piece, y);
    let column = |dy: Vector| {
        let moved = pair.moved(&dy);
        let [n, t, _] = law.displacement_by(&moved);
        let [normal, tangential] = product([n, t]);
        [normal + dy[0] - moved[0], tangential + dy[1] - moved[1]]
    };
    let [normal, tangential] = [column([1.0, 0.0, 0.0]), column([0.0, 1.0, 0.0])];
    let determinant = |one: [f64; 2], two: [f64; 2]| one[0] * two[1] - one[1] * two[0];
    let all = determinant(normal, tangential);
    if !(all.abs() > SUSPICIOUS_PIVOT) {
        return None;
    }
    let (_, _, lack) = at(y);
    let step = [determinant(lack, tangential) / all, determinant(normal, lack) / all];
    let y = [y[0] - step[0], y[1] - step[1], 0.0];
    let (d, force, _) = at(&y);
    let is_solution = law.piece(&y) == piece && equations.eta(&d, &force) <= ROUNDING_OF_ETA;
    let orientation = if all > 0.0 { 1 } else { -1 };
    is_solution.then(|| {
        let (d, force, y) = (d.to_vec(), force.to_vec(), vec![y]);
        Ended { d, force, y, ending: Ending::Done, systems: 1, orientation }
    })
}
