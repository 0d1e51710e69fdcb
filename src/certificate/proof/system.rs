//! The equations of frozen pieces: the unknowns, their scales, the matrix, and Newton's steps.
//!
//! A row for each component that moves, with the force `F = K d - f` that equilibrium needs:
//! `F_n - a` of an open pair, `F_t + g A h` of a slip. Rows and unknowns are scaled by powers of two, exactly.

use crate::law::{Assembly, Contact, EnclosedPiece, Local, Slopes, Unknown, by_pairs};
use crate::linalg::approximate_inverse::ApproximateInverse;
use crate::linalg::ball::{Ball, BallVector};
use crate::linalg::definite::Definite;
use crate::linalg::double_double::add_to_parts;
use crate::linalg::power_of_two::{exponent, times_power_of_two};
use crate::linalg::vector::norm_inf;
use crate::linalg::watched::GoesOn;

/// Most steps of refinement, and by what part each must be smaller than the one before.
const MOST_STEPS: usize = 6;
const FALL: f64 = 0.25;

/// Displacements in two parts, with the force that they need.
pub struct Centre {
    pub d: Vec<f64>,
    pub low: Vec<f64>,
    pub force: Vec<f64>,
}

/// The proof that the scaled matrix is regular, which solves with it too.
pub enum Solver {
    Definite(Definite),
    Inverse(ApproximateInverse),
}

impl Solver {
    /// The approximate solution of the scaled equations.
    fn product(&mut self, mut rhs: Vec<f64>) -> Vec<f64> {
        match self {
            Solver::Definite(definite) => {
                definite.solve(&mut rhs);
                rhs
            }
            Solver::Inverse(inverse) => inverse.product(&rhs),
        }
    }
}

/// A system whose pieces are frozen.
pub struct System<'c> {
    pub contact: &'c Contact<'c>,
    pub pairs: Vec<EnclosedPiece>,
    pub unknowns: Vec<Unknown>,
    pub slopes: Vec<Slopes>,
}

impl<'c> System<'c> {
    /// The system of pieces at displacements.
    pub fn new(contact: &'c Contact<'c>, pairs: Vec<EnclosedPiece>, centre: &Centre) -> Self {
        let unknowns = unknowns(contact, &pairs);
        let mut system = System { contact, pairs, unknowns, slopes: Vec::new() };
        let locals = system.locals(centre);
        let slopes = |(at, (frozen, local)): (usize, (&EnclosedPiece, &Local))| {
            let threshold =
                frozen.enclosed_threshold(Ball::exact(centre.force[at * contact.dim()]));
            Slopes {
                drag: frozen.drag(local).map(Ball::middle),
                motion: local.motion.map(|row| row.map(Ball::middle)),
                turn: local.turn.map(|row| row.map(|entry| threshold.middle() * entry.middle())),
            }
        };
        system.slopes = system.pairs.iter().zip(&locals).enumerate().map(slopes).collect();
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

    /// The residual of the scaled equations at the centre with the forces that it needs.
    pub fn lack(&self, centre: &Centre, force: &[BallVector]) -> Vec<Ball> {
        let locals = self.locals(centre);
        let lacks: Vec<BallVector> =
            (0..force.len()).map(|at| self.pairs[at].lack(&locals[at], &force[at])).collect();
        let scaled =
            |unknown: &Unknown| lacks[unknown.pair][unknown.component] * Ball::exact(unknown.row);
        self.unknowns.iter().map(scaled).collect()
    }

    /// The proof that the scaled matrix is regular: it is definite, where its pieces are symmetric,
    /// otherwise an approximate inverse. `None` too where `goes_on` says no.
    pub fn solver(&self, goes_on: GoesOn<'_>) -> Option<Solver> {
        let size = self.unknowns.len();
        let definite = match self.pairs.iter().all(EnclosedPiece::is_symmetric) {
            true => Definite::new(size, self.columns(), goes_on),
            false => None,
        };
        match definite {
            Some(definite) => Some(Solver::Definite(definite)),
            None => ApproximateInverse::new(size, self.columns(), goes_on).map(Solver::Inverse),
        }
    }

    /// Writes columns of the scaled matrix.
    pub fn columns(&self) -> impl Fn(usize, &mut [f64]) + Sync {
        let (dim, matrix) = (self.contact.dim(), self.contact.problem().stiffness());
        let assembly = Assembly::new(dim, matrix, &self.unknowns, self.slopes.iter());
        move |j, entries| assembly.coefficients(j, 0, &assembly.image(j, 0), entries)
    }

    /// Refines the centre by residuals in twice the precision until steps fall no further, or `goes_on` says no.
    pub fn refine(&self, solver: &mut Solver, centre: &mut Centre, goes_on: GoesOn<'_>) {
        let (dim, problem) = (self.contact.dim(), self.contact.problem());
        let mut last = f64::INFINITY;
        for _ in 0..MOST_STEPS {
            if !goes_on() {
                break;
            }
            let force: Vec<Ball> = centre.force.iter().map(|&force| Ball::exact(force)).collect();
            let lack = self.lack(centre, &by_pairs(dim, &force));
            let step = solver.product(lack.iter().map(|lack| lack.middle()).collect());
            let size = norm_inf(&step);
            if !(size < FALL * last) {
                break;
            }
            last = size;
            self.move_by(&step, centre);
            centre.force = problem.force_of_parts(&centre.d, &centre.low);
        }
    }

    /// Subtracts a step of the scaled unknowns.
    fn move_by(&self, step: &[f64], centre: &mut Centre) {
        let dim = self.contact.dim();
        let mut change = vec![0.0; centre.d.len()];
        for (unknown, step) in self.unknowns.iter().zip(step) {
            let parts = unknown.motion(&self.slopes[unknown.pair]);
            let own = &mut change[dim * unknown.pair..dim * (unknown.pair + 1)];
            own.iter_mut().zip(parts).for_each(|(own, part)| *own -= part * step);
        }
        add_to_parts((&mut centre.d, &mut centre.low), change);
    }
}

/// The unknowns of the pieces, with scales that make the diagonal of the matrix about 1.
fn unknowns(contact: &Contact<'_>, pairs: &[EnclosedPiece]) -> Vec<Unknown> {
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
    unknowns
}
