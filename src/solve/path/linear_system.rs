//! The system of the pieces on which all pairs are, `J = K V / k + D`, condensed and updated.
//!
//! With `D = dP/dy` of every pair, `V = 1 - D` and the forces per length `k`, `J x = b` is solved for
//! the displacements that are free: `d = V x / k` is zero in the normal component of a closed pair and
//! in the tangential one of a pair that sticks. Of the free components
//!
//! ```text
//! (K d)_n = b_n                                open
//! (K d)_t - slope h (K d)_n = b_t - slope h b_n        slip to the side h (slope 0 of an open pair)
//! ```
//!
//! is factorised; the forces `x = b - K d` of the others follow. The sign of this determinant is that of
//! `det J`: the rest of `J` is triangular with ones.
//!
//! A pair that passes a boundary with the gradient `n` changes `D` by `-u nᵀ` and `J` by `a nᵀ`,
//! `a = (K / k - 1) u`. So with `z = J⁻¹ a` and `pivot = 1 + n.z`
//!
//! ```text
//! J'⁻¹ b = J⁻¹ b - z (n.J⁻¹ b) / pivot,    det J' = pivot det J
//! ```
//!
//! `z` is one column of `J⁻¹ (K / k - 1)` or two, of the pieces that were factorised (`linear_columns`), which pass
//! through the changes since then in turn, as all solutions do.

use super::linear_columns::{BLOCK, Columns};
use crate::law::branch::Branch;
use crate::law::{Contact, Exit, PairLaw, Planar};
use crate::linalg::factor::{Factor, lu_work, subtract_product};
use crate::linalg::matrix::Matrix;
use crate::linalg::simd::subtract_columns;
use crate::linalg::tolerances::SINGULAR_BASIS;
use crate::linalg::vector::dot;

/// A change of one pair.
struct Change {
    pair: usize,
    gradient: Planar,
    pivot: f64,
    /// `n.z` of the changes before it.
    before: Vec<f64>,
}

/// A change that is ready to be made.
pub struct Flip {
    change: Change,
    /// `J⁻¹ a`.
    z: Vec<f64>,
    beyond: Branch,
}

impl Flip {
    /// `1 + n.z`, by which the determinant changes.
    pub fn pivot(&self) -> f64 {
        self.change.pivot
    }

    /// `J⁻¹ a`: where the pivot is zero, `J` is singular along it beyond the boundary.
    pub fn direction(&self) -> &[f64] {
        &self.z
    }
}

/// The system of the pieces.
pub struct PieceSystem<'p> {
    contact: &'p Contact<'p>,
    matrix: Matrix<'p>,
    root: &'p [f64],
    /// The pieces of today.
    pub branches: Vec<Branch>,
    /// `dP/dy` of the pieces that were factorised.
    slopes: Vec<[Planar; 2]>,
    /// Components that are free on them, and the others.
    free: Vec<usize>,
    bound: Vec<usize>,
    factor: Factor,
    /// Rows of `K` for the forces of the others, each with the free columns.
    rows: Vec<f64>,
    /// Columns for changes.
    columns: Columns,
    changes: Vec<Change>,
    /// `J⁻¹ a` of each change, contiguous.
    directions: Vec<f64>,
}

impl<'p> PieceSystem<'p> {
    /// Operations of [`Self::new`]: a factorisation, and another one where the matrix of pieces without
    /// friction is not definite to the last digit.
    pub fn work(contact: &Contact<'_>, branches: &[Branch]) -> f64 {
        let slopes = contact.pairs().iter().zip(branches).map(|(law, b)| law.slopes(*b));
        let free = |slopes: [Planar; 2]| (0..2).filter(|&i| slopes[i][i] == 0.0).count();
        lu_work(slopes.map(free).sum())
    }

    /// Factorises the system of `branches`; `root` holds the roots of the diagonal of `K`. `None` if it
    /// is singular to the last digit.
    pub fn new(contact: &'p Contact<'p>, root: &'p [f64], branches: Vec<Branch>) -> Option<Self> {
        let matrix = contact.problem().stiffness();
        let slopes: Vec<[Planar; 2]> =
            contact.pairs().iter().zip(&branches).map(|(law, b)| law.slopes(*b)).collect();
        let (free, bound): (Vec<usize>, Vec<usize>) =
            (0..matrix.size()).partition(|&i| slopes[i / 2][i % 2][i % 2] == 0.0);
        let factor = factorised(matrix, root, &slopes, &free)?;
        let mut rows = Vec::with_capacity(free.len() * bound.len());
        for &i in &bound {
            let column = matrix.column(i);
            rows.extend(free.iter().map(|&j| column[j]));
        }
        let changes = Vec::new();
        Some(PieceSystem {
            contact,
            matrix,
            root,
            branches,
            slopes,
            free,
            bound,
            factor,
            rows,
            columns: Columns::none(root.len()),
            changes,
            directions: Vec::new(),
        })
    }

    /// Changes since the factorisation.
    pub fn age(&self) -> usize {
        self.changes.len()
    }

    /// Sign of `det J`.
    pub fn sign(&self) -> f64 {
        let of = |sign: f64, change: &Change| sign * change.pivot.signum();
        self.changes.iter().fold(f64::from(self.factor.sign()), of)
    }

    /// `J⁻¹ b`.
    pub fn solve(&mut self, b: &[f64]) -> Vec<f64> {
        let mut x = self.solve_factorised(b);
        self.apply_changes(&mut x);
        x
    }

    /// `J⁻¹ b` on the pieces that were factorised, for each column of `b`.
    fn solve_factorised(&mut self, b: &[f64]) -> Vec<f64> {
        let (size, free, bound) = (self.root.len(), self.free.len(), self.bound.len());
        let mut d = Vec::with_capacity(b.len() / size * free);
        let mut forces = Vec::with_capacity(b.len() / size * bound);
        for b in b.chunks_exact(size) {
            d.extend(self.free.iter().map(|&i| {
                let coupling = coupling(&self.slopes, i);
                (b[i] - coupling * b[i - i % 2]) / self.root[i]
            }));
            forces.extend(self.bound.iter().map(|&i| b[i]));
        }
        self.factor.solve(&mut d);
        for d in d.chunks_exact_mut(free.max(1)) {
            d.iter_mut().zip(&self.free).for_each(|(d, &i)| *d /= self.root[i]);
        }
        subtract_product(&mut forces, &self.rows, &d, free);
        let mut x = vec![0.0; b.len()];
        for (column, x) in x.chunks_exact_mut(size).enumerate() {
            let forces = &forces[bound * column..];
            for (&i, force) in self.bound.iter().zip(forces) {
                x[i] = *force;
            }
            for (&i, d) in self.free.iter().zip(&d[free * column..]) {
                // Normal components come before tangential ones.
                x[i] = self.root[i] * self.root[i] * d + coupling(&self.slopes, i) * x[i - i % 2];
            }
        }
        x
    }

    /// Whether the change of `pair` needs columns that are not known.
    pub fn lacks_columns(&self, pair: usize, exit: &Exit) -> bool {
        self.columns.are_kept() && self.components(pair, exit).any(|i| self.columns.of(i).is_none())
    }

    /// Components of `pair` that take part in its change.
    fn components(&self, pair: usize, exit: &Exit) -> impl Iterator<Item = usize> + use<> {
        let u = direction(&self.contact.pairs()[pair], self.branches[pair], exit);
        (0..2).filter(move |&c| u[c] != 0.0).map(move |c| 2 * pair + c)
    }

    /// Makes the columns for changes of pairs, the most likely ones first, so far as they are not known.
    pub fn prepare(&mut self, likely: &[(usize, Exit)]) {
        self.columns.make_room();
        let components: Vec<usize> = likely
            .iter()
            .flat_map(|(pair, exit)| self.components(*pair, exit))
            .filter(|&i| self.columns.of(i).is_none())
            .take(BLOCK)
            .collect();
        let mut sides = Vec::with_capacity(components.len() * self.root.len());
        for &i in &components {
            let scale = self.root[i].powi(2).recip();
            let begin = sides.len();
            sides.extend(self.matrix.column(i).iter().map(|k| k * scale));
            sides[begin + i] -= 1.0;
        }
        let columns = self.solve_factorised(&sides);
        self.columns.add(&components, &columns);
    }

    /// The change of `pair` that passes a boundary; no columns that it needs are lacking.
    pub fn flip(&mut self, pair: usize, exit: &Exit) -> Flip {
        let law = &self.contact.pairs()[pair];
        let u = direction(law, self.branches[pair], exit);
        let mut z = vec![0.0; self.root.len()];
        for (c, u) in u.into_iter().enumerate().filter(|(_, u)| *u != 0.0) {
            let i = 2 * pair + c;
            if self.columns.are_kept() {
                let column = self.columns.of(i).expect("the caller has prepared it");
                z.iter_mut().zip(column).for_each(|(z, column)| *z += u * column);
            } else {
                let scaled = u / self.root[i].powi(2);
                z.iter_mut().zip(self.matrix.column(i)).for_each(|(z, k)| *z += k * scaled);
                z[i] -= u;
            }
        }
        if !self.columns.are_kept() {
            z = self.solve_factorised(&z);
        }
        self.apply_changes(&mut z);
        let mut change = Change { pair, gradient: exit.gradient, pivot: 1.0, before: Vec::new() };
        change.before =
            self.directions.chunks_exact(self.root.len()).map(|z| change.along(z)).collect();
        change.pivot += change.along(&z);
        Flip { change, z, beyond: exit.beyond }
    }

    /// Makes a change; `x` becomes `J⁻¹ b` of the new pieces for the same `b`.
    pub fn pass(&mut self, flip: Flip, x: &mut [f64]) {
        let part = flip.change.along(x) / flip.change.pivot;
        subtract_columns(x, &flip.z, &[part]);
        self.branches[flip.change.pair] = flip.beyond;
        self.directions.extend_from_slice(&flip.z);
        self.changes.push(flip.change);
    }

    /// Takes `J⁻¹ b` of the pieces that were factorised to that of the pieces of today. What each change subtracts
    /// depends on those before it through a few numbers, so that all directions are read once.
    fn apply_changes(&self, x: &mut [f64]) {
        let mut parts = Vec::with_capacity(self.changes.len());
        for change in &self.changes {
            let part = (change.along(x) - dot(&change.before, &parts)) / change.pivot;
            parts.push(part);
        }
        subtract_columns(x, &self.directions, &parts);
    }

    /// The displacements along which the coordinates move when they move by `y`.
    pub fn motion(&self, y: &[f64]) -> Vec<f64> {
        let mut motion = Vec::with_capacity(y.len());
        let pairs = self.contact.pairs().iter().zip(&self.branches);
        for (pair, (law, branch)) in pairs.enumerate() {
            let slopes = law.slopes(*branch);
            let at = [y[2 * pair], y[2 * pair + 1]];
            for (c, (y, row)) in at.iter().zip(&slopes).enumerate() {
                let root = self.root[2 * pair + c];
                motion.push((y - row[0] * at[0] - row[1] * at[1]) / (root * root));
            }
        }
        motion
    }
}

impl Change {
    /// `n.x`.
    fn along(&self, x: &[f64]) -> f64 {
        let at = 2 * self.pair;
        self.gradient[0] * x[at] + self.gradient[1] * x[at + 1]
    }
}

/// `slope h` of a tangential component that slips under pressure; 0 of others.
fn coupling(slopes: &[[Planar; 2]], i: usize) -> f64 {
    if i.is_multiple_of(2) { 0.0 } else { slopes[i / 2][1][0] }
}

/// `u` with `V' = V + u nᵀ` for the change of a pair.
fn direction(law: &PairLaw, before: Branch, exit: &Exit) -> Planar {
    let (before, beyond) = (law.slopes(before), law.slopes(exit.beyond));
    let n = exit.gradient;
    let square = n[0] * n[0] + n[1] * n[1];
    std::array::from_fn(|r| {
        ((before[r][0] - beyond[r][0]) * n[0] + (before[r][1] - beyond[r][1]) * n[1]) / square
    })
}

/// The factor of the free components, rows and columns scaled; `None` if it is singular.
fn factorised(
    matrix: Matrix<'_>,
    root: &[f64],
    slopes: &[[Planar; 2]],
    free: &[usize],
) -> Option<Factor> {
    let coupled: Vec<(usize, f64)> = free
        .iter()
        .enumerate()
        .map(|(k, &i)| (k, coupling(slopes, i)))
        .filter(|(_, coupling)| *coupling != 0.0)
        .collect();
    let fill = |j: usize, column: &mut [f64]| {
        let source = matrix.column(free[j]);
        let scale = root[free[j]];
        for (column, &i) in column.iter_mut().zip(free) {
            *column = source[i] / (root[i] * scale);
        }
        for &(k, coupling) in &coupled {
            let i = free[k];
            column[k] -= coupling * source[i - 1] / (root[i] * scale);
        }
    };
    if coupled.is_empty()
        && let Some(factor) = Factor::with_least_pivot(free.len(), true, SINGULAR_BASIS, fill)
    {
        return Some(factor);
    }
    Factor::with_least_pivot(free.len(), false, SINGULAR_BASIS, fill)
}
