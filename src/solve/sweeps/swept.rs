//! What sweeps improve: a contact problem, pair by pair, in proximal form (`law::proximal`), or its clearances, variable
//! by variable.
//!
//! With given thresholds each step lowers `J(d) = d.K d / 2 - f.d + sum g |delta|` for
//! `0 < omega < 2`, definite `K` or not. `K d - f` is carried along: an unknown that does not change
//! costs nothing.

use super::blocks::over_all;
use crate::certificate::{eta_of, is_escape_of, lifts};
use crate::law::{Contact, PairLaw, lift};
use crate::linalg::matrix::Matrix;
use crate::linalg::vector::norm_inf;
use crate::monitor::Watch;
use crate::problem::{BoundedLcp, FreeBlock};
use crate::solve::rigid::escape;

/// So many sweeps with a factor, fewer if the time is up.
pub fn sweep_in_time(
    laws: &[PairLaw],
    matrix: Matrix<'_>,
    (d, force): (&mut [f64], &mut [f64]),
    (sweeps, omega): (usize, f64),
    monitor: &dyn Watch,
) {
    for _ in 0..sweeps {
        if monitor.is_late() {
            break;
        }
        sweep(laws, matrix, (&mut *d, &mut *force), omega);
    }
}

/// One sweep over all pairs on displacements and their force `K d - f`. Under Coulomb's law the threshold follows the
/// pressure within the sweep. Returns the change in the norm of the diagonal of `K`.
fn sweep(
    laws: &[PairLaw],
    matrix: Matrix<'_>,
    iterate: (&mut [f64], &mut [f64]),
    omega: f64,
) -> f64 {
    match matrix.size() / laws.len().max(1) {
        3 => sweep_in::<3>(laws, matrix, iterate, omega),
        _ => sweep_in::<2>(laws, matrix, iterate, omega),
    }
}

fn sweep_in<const DIM: usize>(
    laws: &[PairLaw],
    matrix: Matrix<'_>,
    (d, force): (&mut [f64], &mut [f64]),
    omega: f64,
) -> f64 {
    over_all::<DIM>(
        matrix,
        force,
        #[inline(always)]
        |i, force| {
            let coupling = &matrix.column(i)[i + 1..i + DIM];
            laws[i / DIM].relax(&mut d[i..i + DIM], force, coupling, omega)
        },
    )
}

/// One sweep over all variables of `lcp`, whose matrix is symmetric, on `x` and `w = q + M x`. Returns
/// the change in the norm of the diagonal of `M`.
pub fn sweep_lcp(lcp: &BoundedLcp<'_>, x: &mut [f64], w: &mut [f64], omega: f64) -> f64 {
    over_all::<1>(
        lcp.matrix,
        w,
        #[inline(always)]
        |i, w| {
            let unit = lcp.matrix.at(i, i);
            let value = lcp.admissible(i, x[i] - omega * w[0] / unit);
            let step = value - x[i];
            x[i] = value;
            ([step, 0.0, 0.0], unit * step * step)
        },
    )
}

/// A contact problem in unknowns `x`, with the residual `w` that is carried along.
pub struct Swept<'p> {
    pub contact: &'p Contact<'p>,
    /// The law that the sweeps obey, if it is not the problem's own.
    pub working: Option<Contact<'p>>,
    /// The problem of the clearances, if these are the unknowns.
    pub clearances: Option<BoundedLcp<'p>>,
}

impl Swept<'_> {
    /// One sweep with the over-relaxation factor `omega`. Returns the change in the norm of the
    /// diagonal.
    pub fn sweep(&self, x: &mut [f64], w: &mut [f64], omega: f64) -> f64 {
        if let Some(lcp) = &self.clearances {
            return sweep_lcp(lcp, x, w, omega);
        }
        let laws = self.working.as_ref().unwrap_or(self.contact).pairs();
        sweep(laws, self.contact.problem().stiffness(), (x, w), omega)
    }

    /// `eta` under the law that the sweeps obey.
    pub fn eta_of_sweeps(&self, x: &[f64], w: &[f64]) -> f64 {
        self.working.as_ref().map_or_else(|| self.eta(x, w), |working| eta_of(working, x, w))
    }

    /// `eta` under the problem's own law.
    pub fn eta(&self, x: &[f64], w: &[f64]) -> f64 {
        self.clearances.map_or_else(|| eta_of(self.contact, x, w), |lcp| lcp.eta(x, w))
    }

    /// The residual of unknowns.
    pub fn residual(&self, x: &[f64]) -> Vec<f64> {
        self.clearances.map_or_else(|| self.contact.problem().force(x), |lcp| lcp.w(x))
    }

    /// The loads.
    pub fn load(&self) -> &[f64] {
        self.clearances.map_or(self.contact.load_with_tension(), |lcp| lcp.q)
    }

    /// A recession direction of the displacements, from the drift of the unknowns, which is their change between two looks,
    /// if there is time.
    ///
    /// A body that slides away drifts along the slip of its friction. Where that is the slip from which friction takes the
    /// most work, the drift proves that nothing stops it. Under a collinear rule it is another one, and the balance of the
    /// rigid motions is asked; of clearances, which have no friction, it tells whatever the drift is.
    ///
    /// Components that did not move are taken as fixed. If the matrix is singular on the others, its factor tells which of
    /// them depend on the rest: the null vector that agrees with the drift on these has none of the drift's elastic part.
    pub fn recession(&self, drift: &[f64], monitor: &dyn Watch) -> Option<Vec<f64>> {
        let contact = self.contact;
        if self.clearances.is_some() {
            return escape(contact, monitor);
        }
        let moved: Vec<usize> = (0..drift.len()).filter(|&i| drift[i] != 0.0).collect();
        let block = FreeBlock::of_problem(contact.problem(), moved, &mut monitor.asking())?;
        // The part of the drift that the matrix does not resist.
        let mut motion = vec![0.0; drift.len()];
        block.dependent().for_each(|i| motion[i] = drift[i]);
        block.follow(&mut motion);
        let lifts = lifts(contact, &motion);
        // A slip together with a lift of each pair, which makes contact forces do no negative work on it. Off a plane it is
        // rigid if all are lifted by the same.
        let uniform = vec![norm_inf(&lifts); lifts.len()];
        [vec![0.0; lifts.len()], lifts, uniform]
            .into_iter()
            .map(|lifts| {
                let mut motion = motion.clone();
                let pairs = motion.chunks_exact_mut(contact.dim());
                pairs.zip(lifts).for_each(|(r, by)| lift(r, by));
                motion
            })
            .find(|motion| is_escape_of(contact, motion))
            .or_else(|| contact.has_collinear_slip().then(|| escape(contact, monitor)).flatten())
    }
}
