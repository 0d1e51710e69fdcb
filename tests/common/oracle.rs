//! All solutions of a 2D problem, by enumeration of the states of its pairs.
//!
//! In a state (open or closed, sticking or slipping to one side) the law of a pair is two equations,
//! so that a state of all pairs is a square linear system, and some inequalities. A regular system
//! has one candidate. A singular one that is consistent has a flat of candidates, and the
//! inequalities cut a polyhedron from it, which may be empty: both cases are treated as the second,
//! and the strictness with which the inequalities can be met is found by elimination
//! ([`best_margin`]). An inconsistent system has no candidate.

use signorini::State;

use super::dense::{self, Elimination, best_margin, largest, norm};
use super::measures::force;
use super::problems::Case;

/// A solution is a candidate that violates no inequality by more than this part of the forces:
/// systems of condition 1e6 are solved to 1e-10, and random inequalities rarely fall below.
const FEASIBLE: f64 = 1e-9;

/// State of one pair. `side` is 1 or -1 where it slips (the sign of the slip), 0 where no
/// friction resists it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Local {
    pub closed: bool,
    pub motion: Motion,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motion {
    Stuck,
    Slides(f64),
}

impl Local {
    /// The library's name of it.
    pub fn state(&self) -> State {
        match (self.closed, self.motion) {
            (false, _) => State::Open,
            (true, Motion::Stuck) => State::Stick,
            (true, Motion::Slides(_)) => State::Slip,
        }
    }
}

/// A state of all pairs whose equations have a solution.
pub struct Piece {
    pub local: Vec<Local>,
    /// How strictly the inequalities are met, relative to the forces; negative if they are not.
    pub margin: f64,
    elimination: Elimination,
    matrix: Vec<f64>,
    rhs: Vec<f64>,
}

impl Piece {
    /// Sign of the determinant of the state's equations, 0 if they are singular. The row of what
    /// the state holds fixed has a positive entry on the diagonal and no other, so that this is the
    /// sign for the rows and columns of the free unknowns alone.
    pub fn orientation(&self) -> i8 {
        self.elimination.orientation()
    }

    /// Displacements that solve the state's equations: the only ones of a regular state.
    pub fn candidate(&self) -> Vec<f64> {
        self.elimination.solve(&self.rhs).0
    }
}

/// An enumerated solution that an answer was found to be.
pub struct Match<'a> {
    pub piece: &'a Piece,
    pub d: Vec<f64>,
    pub force: Vec<f64>,
    /// `true` if all inequalities hold with a distance larger than the answer's error.
    pub strict: bool,
}

/// All states that may be one: those that miss their inequalities by 1 % of the forces at most.
pub struct Enumeration<'a> {
    case: &'a Case,
    pub pieces: Vec<Piece>,
}

impl<'a> Enumeration<'a> {
    /// Enumerates a 2D problem with few pairs: at most 4 states each under Coulomb's law, 6 under others.
    pub fn new(case: &'a Case) -> Self {
        assert_eq!(case.dim, 2);
        let options: Vec<Vec<Local>> = (0..case.pairs).map(|pair| options(case, pair)).collect();
        let mut pieces = Vec::new();
        let mut choice = vec![0; case.pairs];
        loop {
            let local = options.iter().zip(&choice).map(|(options, &c)| options[c]).collect();
            pieces.extend(piece(case, local).filter(|piece| piece.margin > -1e-2));
            let Some(pair) = (0..case.pairs).find(|&p| choice[p] + 1 < options[p].len()) else {
                return Enumeration { case, pieces };
            };
            choice[pair] += 1;
            choice[..pair].fill(0);
        }
    }

    /// `true` if no inequality is so close to equality that rounding may decide it (`FEASIBLE`, 100
    /// times over), and no state's equations are singular: then the number of solutions is certain.
    pub fn is_clear(&self) -> bool {
        self.pieces.iter().all(|piece| piece.margin.abs() > 1e-7 && piece.orientation() != 0)
    }

    /// Those whose inequalities hold.
    pub fn solutions(&self) -> impl Iterator<Item = &Piece> {
        self.pieces.iter().filter(|piece| piece.margin >= -FEASIBLE)
    }

    /// The solutions that `d` may be, if `d` has the residual `eta <= tolerance`; more than one only
    /// where states meet.
    ///
    /// The bound: a residual `e` of the natural map makes `d - e / K_ii` the exact solution of the
    /// problem with a load that differs by at most `(1 + mu + |K| / min K_ii) |e|` (prox of the law
    /// moved to the left-hand side; a cone that is `mu |e_n|` off is corrected by the load). In the
    /// equations of its state this is an error of at most `c |e|` with the `c` below, and so an
    /// error of `c |A⁻¹| |e|` in `d`. Inequalities of the exact solution hold up to as much.
    /// To `|e|` comes the rounding of `K d` here and there.
    pub fn identify<'s>(&'s self, d: &[f64], tolerance: f64) -> Vec<Match<'s>> {
        let case = self.case;
        let n = case.size();
        let mu = (0..case.pairs).fold(0.0, |most: f64, pair| most.max(case.law.of(pair)[0]));
        let least = (0..n).fold(f64::INFINITY, |least, i| case.stiffness(i, i).min(least));
        let stiffness = norm(&case.k);
        let c = (1.0 + mu) * (1.0 + mu + 2.0 * stiffness / least);
        let prescribed =
            case.gap.iter().filter(|gap| gap.is_finite()).chain(case.slip.iter().flatten());
        let size = prescribed.fold(largest(d), |most, d| most.max(d.abs()));
        let rounding = n as f64 * f64::EPSILON * stiffness * size;
        let error = c * (tolerance * norm(&case.f).max(norm(&force(case, d))) + rounding);
        let try_piece = |piece: &'s Piece| {
            let Piece { local, matrix, rhs, elimination, .. } = piece;
            let excess: Vec<f64> =
                (0..n).map(|i| dense::dot(&matrix[i * n..(i + 1) * n], d) - rhs[i]).collect();
            if norm(&excess) > error {
                return None;
            }
            // The state's own candidate next to `d`; of a singular system the one that differs in
            // the dependent unknowns only.
            let (correction, _) = elimination.solve(&excess);
            let d = dense::difference(d, &correction);
            let force = force(case, &d);
            let slack = slacks(case, local, &d, &force).into_iter().fold(f64::INFINITY, f64::min);
            let to_force = (1.0 + mu) * stiffness;
            let tolerance = to_force * elimination.inverse_norm() * error;
            let strict = slack > 10.0 * to_force * norm(&correction) + FEASIBLE * force_unit(case);
            (slack >= -tolerance).then_some(Match { piece, d, force, strict })
        };
        self.pieces.iter().filter_map(try_piece).collect()
    }
}

fn options(case: &Case, pair: usize) -> Vec<Local> {
    let [mu, b, a] = case.law.of(pair);
    let motions = |resisted: bool| match resisted {
        false => vec![Motion::Slides(0.0)],
        true => vec![Motion::Stuck, Motion::Slides(1.0), Motion::Slides(-1.0)],
    };
    // The rounding of `mu a` is no friction.
    let open = motions(b > mu * a * (1.0 + 1e-12)).into_iter();
    let mut options: Vec<Local> = open.map(|motion| Local { closed: false, motion }).collect();
    if case.gap[pair].is_finite() {
        let closed = motions(mu > 0.0 || b > 0.0).into_iter();
        options.extend(closed.map(|motion| Local { closed: true, motion }));
    }
    options
}

fn force_unit(case: &Case) -> f64 {
    let prescribed =
        case.gap.iter().filter(|gap| gap.is_finite()).chain(case.slip.iter().flatten());
    let stiffness = (0..case.size()).fold(0.0, |most: f64, i| most.max(case.stiffness(i, i)));
    let given = (0..case.pairs).fold(0.0, |most: f64, pair| {
        let [_, b, a] = case.law.of(pair);
        most.max(b).max(a)
    });
    let forces = prescribed.fold(0.0, |most: f64, d| most.max(stiffness * d.abs()));
    let unit = forces.max(largest(&case.f)).max(given);
    if unit == 0.0 { 1.0 } else { unit }
}

fn piece(case: &Case, local: Vec<Local>) -> Option<Piece> {
    let n = case.size();
    let mut matrix = vec![0.0; n * n];
    let mut rhs = vec![0.0; n];
    for (pair, now) in local.iter().enumerate() {
        let i = 2 * pair;
        let [mu, b, a] = case.law.of(pair);
        if now.closed {
            matrix[i * n + i] = case.stiffness(i, i);
            rhs[i] = case.stiffness(i, i) * case.gap[pair];
        } else {
            (0..n).for_each(|j| matrix[i * n + j] = case.stiffness(i, j));
            rhs[i] = case.f[i] + a;
        }
        let t = i + 1;
        match now.motion {
            Motion::Stuck => {
                matrix[t * n + t] = case.stiffness(t, t);
                rhs[t] = case.stiffness(t, t) * case.rest(pair, 0);
            }
            // F_t = -side (b - mu F_n), against the slip.
            Motion::Slides(side) => {
                let mu = side * mu;
                (0..n).for_each(|j| {
                    matrix[t * n + j] = case.stiffness(t, j) - mu * case.stiffness(i, j);
                });
                rhs[t] = case.f[t] - mu * case.f[i] - side * b;
            }
        }
    }
    let elimination = Elimination::new(n, &matrix);
    let (point, left) = elimination.solve(&rhs);
    let unit = force_unit(case);
    if left > FEASIBLE * unit {
        return None;
    }
    let slack = |d: &[f64]| -> Vec<f64> {
        slacks(case, &local, d, &force(case, d)).iter().map(|slack| slack / unit).collect()
    };
    let at_point = slack(&point);
    // Slacks are affine in d.
    let rates: Vec<Vec<f64>> = elimination
        .kernel()
        .iter()
        .map(|direction| {
            let moved: Vec<f64> = point.iter().zip(direction).map(|(x, v)| x + v).collect();
            let mut rates = dense::difference(&slack(&moved), &at_point);
            // The forces of a rigid motion are rounding alone: no way to go far.
            let absolute: Vec<f64> = case.k.iter().map(|k| k.abs()).collect();
            let size: Vec<f64> = direction.iter().map(|v| v.abs()).collect();
            let parts = largest(&dense::product(&absolute, &size)) / unit;
            for rate in rates.iter_mut().filter(|rate| rate.abs() <= 1e-9 * parts) {
                *rate = 0.0;
            }
            rates
        })
        .collect();
    let margin = best_margin(&at_point, &rates);
    Some(Piece { local, margin, elimination, matrix, rhs })
}

/// Slacks that must not be negative, in forces.
fn slacks(case: &Case, local: &[Local], d: &[f64], force: &[f64]) -> Vec<f64> {
    let mut slacks = Vec::new();
    for (pair, now) in local.iter().enumerate() {
        let (i, t) = (2 * pair, 2 * pair + 1);
        let [mu, b, a] = case.law.of(pair);
        if now.closed {
            slacks.push(a - force[i]);
        } else if case.gap[pair].is_finite() {
            slacks.push(case.stiffness(i, i) * (case.gap[pair] - d[i]));
        }
        match now.motion {
            Motion::Stuck => {
                // Not `Case::bound`, which is not affine in the force where that pulls.
                let bound = b - mu * force[i];
                slacks.extend([bound - force[t], bound + force[t]]);
            }
            Motion::Slides(0.0) => {}
            Motion::Slides(side) => {
                slacks.push(side * case.stiffness(t, t) * (d[t] - case.rest(pair, 0)));
            }
        }
    }
    slacks
}
