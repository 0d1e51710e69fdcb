//! The equations of frozen pieces: the unknowns, their scales, the matrix, and Newton's steps.
//!
//! A row for each component that moves, with the force `F = K d - f` that equilibrium needs:
//! `F_n - a` of an open pair, `F_t + g A h` of a slip. Rows and unknowns are scaled by powers of two, exactly.

use super::forces::enclosed_force;
use crate::law::{Contact, FrozenPair, Local, Plane};
use crate::linalg::approximate_inverse::ApproximateInverse;
use crate::linalg::ball::{Ball, BallVector};
use crate::linalg::double_double::two_sum;
use crate::linalg::power_of_two::{exponent, times_power_of_two};

/// Most steps of refinement, and by what part each must be smaller than the one before.
const MOST_STEPS: usize = 6;
const FALL: f64 = 0.25;

/// An unknown, with the equation of the same component.
pub struct Unknown {
    pub pair: usize,
    /// Component of the pair, 0 the normal one.
    pub component: usize,
    /// Scale of its equation, one over a force, and of the unknown itself.
    pub row: f64,
    pub column: f64,
}

/// The derivatives that the matrix is made of.
#[derive(Clone, Copy, Default)]
pub struct Slopes {
    pub drag: [f64; 2],
    pub motion: Plane,
    pub turn: Plane,
}

/// Displacements in two parts.
#[derive(Clone)]
pub struct Centre {
    pub d: Vec<f64>,
    pub low: Vec<f64>,
}

/// The equations at a centre.
pub struct State {
    pub force: Vec<BallVector>,
    /// What the scaled equations lack.
    pub lack: Vec<Ball>,
}

/// A system whose pieces are frozen.
pub struct System<'c> {
    pub contact: &'c Contact<'c>,
    pub pairs: Vec<FrozenPair>,
    pub unknowns: Vec<Unknown>,
    pub slopes: Vec<Slopes>,
}

impl<'c> System<'c> {
    /// The system of pieces at displacements.
    pub fn new(contact: &'c Contact<'c>, pairs: Vec<FrozenPair>, centre: &Centre) -> Self {
        let dim = contact.dim();
        let root = contact.problem().stiffness().diagonal_roots();
        let power = |x: f64| times_power_of_two(1.0, -exponent(x));
        let mut unknowns = Vec::new();
        for (pair, frozen) in pairs.iter().enumerate() {
            for component in (0..dim).filter(|&c| frozen.moves(c)) {
                let root = root[dim * pair + component];
                let unit = if component == 0 { 1.0 } else { frozen.unit() };
                unknowns.push(Unknown {
                    pair,
                    component,
                    row: power(root),
                    column: power(root * unit),
                });
            }
        }
        let mut system = System { contact, pairs, unknowns, slopes: Vec::new() };
        let force = enclosed_force(contact, &centre.d, &centre.low);
        let locals = system.locals(centre);
        let slopes = |((frozen, local), force): ((&FrozenPair, &Local), &BallVector)| {
            let threshold = frozen.enclosed_threshold(force[0]).middle();
            Slopes {
                drag: frozen.drag(local).map(Ball::middle),
                motion: local.motion.map(|row| row.map(Ball::middle)),
                turn: local.turn.map(|row| row.map(|entry| threshold * entry.middle())),
            }
        };
        system.slopes = system.pairs.iter().zip(&locals).zip(&force).map(slopes).collect();
        system
    }

    /// `d - reference` of each pair.
    pub fn beyond_reference(&self, centre: &Centre) -> Vec<BallVector> {
        let parts = self.contact.each(&centre.d, &centre.low);
        parts.map(|(law, d, low)| law.enclosed_beyond_reference(d, low)).collect()
    }

    fn locals(&self, centre: &Centre) -> Vec<Local> {
        let v = self.beyond_reference(centre);
        self.pairs.iter().zip(&v).map(|(pair, v)| pair.local(pair.slip_vector(v))).collect()
    }

    /// Forces and what the equations lack.
    pub fn at(&self, centre: &Centre) -> State {
        let force = enclosed_force(self.contact, &centre.d, &centre.low);
        let locals = self.locals(centre);
        let lacks: Vec<BallVector> =
            (0..force.len()).map(|at| self.pairs[at].lack(&locals[at], &force[at])).collect();
        let scaled =
            |unknown: &Unknown| lacks[unknown.pair][unknown.component] * Ball::exact(unknown.row);
        let lack = self.unknowns.iter().map(scaled).collect();
        State { force, lack }
    }

    /// The approximate inverse of the scaled matrix.
    pub fn inverse(&self) -> Option<ApproximateInverse> {
        let (dim, matrix) = (self.contact.dim(), self.contact.problem().stiffness());
        let mut column = vec![0.0; matrix.size()];
        ApproximateInverse::new(self.unknowns.len(), |j, entries| {
            let unknown = &self.unknowns[j];
            let first = dim * unknown.pair;
            column.fill(0.0);
            for (c, part) in self.motion_of(unknown).into_iter().enumerate().take(dim) {
                if part != 0.0 {
                    let source = matrix.column(first + c);
                    column.iter_mut().zip(source).for_each(|(sum, k)| *sum += part * k);
                }
            }
            for (entry, equation) in entries.iter_mut().zip(&self.unknowns) {
                let at = dim * equation.pair;
                let mut value = column[at + equation.component];
                if equation.component > 0 {
                    let slopes = &self.slopes[equation.pair];
                    let along = equation.component - 1;
                    value -= slopes.drag[along] * column[at];
                    if equation.pair == unknown.pair && unknown.component > 0 {
                        value += slopes.turn[along][unknown.component - 1] * unknown.column;
                    }
                }
                *entry = equation.row * value;
            }
        })
    }

    /// Displacements of the pair by a unit of the scaled unknown.
    pub fn motion_of(&self, unknown: &Unknown) -> [f64; 3] {
        let motion = &self.slopes[unknown.pair].motion;
        match unknown.component {
            0 => [unknown.column, 0.0, 0.0],
            c => [0.0, motion[0][c - 1] * unknown.column, motion[1][c - 1] * unknown.column],
        }
    }

    /// Refines the centre by residuals in twice the precision until steps fall no further, and returns the
    /// equations there.
    pub fn refine(&self, inverse: &ApproximateInverse, centre: &mut Centre) -> State {
        let mut state = self.at(centre);
        let mut last = f64::INFINITY;
        for _ in 0..MOST_STEPS {
            let lack: Vec<f64> = state.lack.iter().map(|lack| lack.middle()).collect();
            let step = inverse.product(&lack);
            let size = step.iter().fold(0.0, |most: f64, step| most.max(step.abs()));
            if !(size > 0.0 && size < FALL * last) {
                break;
            }
            last = size;
            self.move_by(&step, centre);
            state = self.at(centre);
        }
        state
    }

    /// Subtracts a step of the scaled unknowns.
    fn move_by(&self, step: &[f64], centre: &mut Centre) {
        let dim = self.contact.dim();
        let mut change = vec![0.0; centre.d.len()];
        for (unknown, step) in self.unknowns.iter().zip(step) {
            let parts = self.motion_of(unknown);
            let own = &mut change[dim * unknown.pair..dim * (unknown.pair + 1)];
            own.iter_mut().zip(parts).for_each(|(own, part)| *own -= part * step);
        }
        for ((d, low), change) in centre.d.iter_mut().zip(&mut centre.low).zip(change) {
            let (sum, lost) = two_sum(*d, change);
            (*d, *low) = two_sum(sum, lost + *low);
        }
    }
}
