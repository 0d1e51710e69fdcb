//! The linear system of given pieces: Newton's step on the normal map, condensed on the components that
//! move, of the problem or of a homotopy to it.
//!
//! With `K_s = s K + (1 - s) k` (`s = 1`: the problem itself) `J dy = b`, for a step `b = -H`, is reduced to the
//! unknowns of each pair (`law::slopes`), the normal components of open pairs and the tangential ones of pairs that
//! slip or carry no friction:
//!
//! ```text
//! dp = (b - K_s dd)_n                                               closed
//! (K_s dd)_n = b_n                                                  open
//! (K_s dd)_t - drag (K_s dd)_n + turn x = b_t - drag b_n            slipping
//! ```
//!
//! `k` is a number of the pair under an isotropic law, and a symmetric matrix with an ellipse.
//!
//! Nothing is divided by the slip. The sign of the determinant is that of `J`: the components that are eliminated have the
//! pivot 1.

use super::equations::Equations;
use super::held::{self, Held};
use crate::law::{Assembly, Linearised, Unknown, Vector, by_pairs, ellipse};
use crate::linalg::factor::{Factor, cholesky_work, lu_work};
use crate::linalg::vector::{first_not_finite, opposite};
use crate::linalg::watched::{GoesOn, written};

/// A factorised system.
pub struct System {
    /// Components of a pair, and of all pairs.
    dim: usize,
    all: usize,
    s: f64,
    pairs: Vec<Linearised>,
    unknowns: Vec<Unknown>,
    /// Components that are no unknowns.
    held: Held,
    factor: Factor,
}

impl System {
    /// Operations of a factorisation of pairs on their pieces.
    pub fn work(equations: &Equations<'_>, pairs: &[Linearised]) -> f64 {
        let unknowns = |pair: &Linearised| (0..equations.dim).filter(|&c| pair.moves(c)).count();
        let count = pairs.iter().map(unknowns).sum();
        if is_plain(equations, pairs) { cholesky_work(count) } else { lu_work(count) }
    }

    /// Factorises the system of pairs on their pieces; pivots below `least`, relative to the largest, make it
    /// singular. `None` too where `goes_on` says no.
    pub fn new(
        equations: &Equations<'_>,
        (pairs, s): (Vec<Linearised>, f64),
        least: f64,
        goes_on: GoesOn<'_>,
    ) -> Option<Self> {
        let (dim, root) = (equations.dim, &equations.root);
        let all = root.len();
        let mut unknowns = Vec::with_capacity(root.len());
        let mut held = Vec::with_capacity(root.len());
        for (i, root) in root.iter().enumerate() {
            let (pair, component) = (i / dim, i % dim);
            match pairs[pair].moves(component) {
                true => {
                    let unit = root.recip();
                    unknowns.push(Unknown { pair, component, row: unit, column: unit });
                }
                false => held.push(i),
            }
        }
        let slopes = pairs.iter().map(|pair| &pair.slopes);
        let assembly = Assembly::new(dim, equations.matrix, &unknowns, slopes);
        let size = unknowns.len();
        let fill = |j: usize, first: usize, entries: &mut [f64]| {
            let from = dim * unknowns[first].pair;
            let image = match s == 1.0 {
                true => assembly.image(j, from),
                false => assembly.led_image((s, &pairs), j, from),
            };
            assembly.coefficients(j, first, &image, entries);
        };
        let definite = match is_plain(equations, &pairs) {
            true => Factor::new(size, true, least, |j, below| fill(j, j, below), goes_on),
            false => None,
        };
        let whole = |j: usize, entries: &mut [f64]| fill(j, 0, entries);
        let factor = definite.or_else(|| Factor::new(size, false, least, whole, goes_on))?;
        let held = Held::new(held);
        Some(System { dim, all, s, pairs, unknowns, held, factor })
    }

    /// Sign of the determinant.
    pub fn orientation(&self) -> i8 {
        self.factor.sign
    }

    /// As [`Factor::least_pivot`].
    pub fn least_pivot(&self) -> f64 {
        self.factor.least_pivot
    }

    /// Number of unknowns.
    pub fn size(&self) -> usize {
        self.unknowns.len()
    }

    /// `dy` for the lack `H` of the equations; `None` if it overflows.
    pub fn step(&mut self, equations: &Equations<'_>, lack: &[f64]) -> Option<Vec<Vector>> {
        let dy = self.solve(equations, &opposite(lack));
        first_not_finite(&dy).is_none().then(|| by_pairs(self.dim, &dy))
    }

    /// The unknowns of `J⁻¹ b` for each column of `b`.
    pub fn unknowns(&self, b: &[f64]) -> Vec<f64> {
        let mut x = self.right_sides(b);
        self.factor.solve(&mut x);
        x
    }

    /// `J⁻¹ b` for each column of `b`.
    pub fn solve(&mut self, equations: &Equations<'_>, b: &[f64]) -> Vec<f64> {
        let x = self.unknowns(b);
        self.coordinates(equations, b, &x)
    }

    /// The displacements of all components, from the unknowns.
    pub fn displacements(&self, x: &[f64]) -> Vec<f64> {
        let (mut moved, mut dd) = (x.to_vec(), vec![0.0; self.all]);
        self.displace(&mut moved);
        let places = self.unknowns.iter().map(|own| self.dim * own.pair + own.component);
        places.zip(moved).for_each(|(i, moved)| dd[i] = moved);
        dd
    }

    /// Where a component is among the unknowns, with its unit, if it is one.
    pub fn place(&self, component: usize) -> Option<(usize, f64)> {
        let key = (component / self.dim, component % self.dim);
        let place = self.unknowns.binary_search_by_key(&key, |own| (own.pair, own.component));
        place.ok().map(|place| (place, self.unknowns[place].column))
    }

    /// The rows of `K` of some components with the columns of the unknowns, in their units; in `memory`.
    pub fn rows(
        &self,
        equations: &Equations<'_>,
        components: &[usize],
        memory: Vec<f64>,
    ) -> Vec<f64> {
        let at = |own: &Unknown| (self.dim * own.pair + own.component, own.column);
        let at: Vec<_> = self.unknowns.iter().map(at).collect();
        held::rows(equations, components, &at, memory)
    }

    /// True if the system is one of these equations, whose matrix it has.
    pub fn fits(&self, equations: &Equations<'_>) -> bool {
        let has_unit = |own: &Unknown| {
            let root = equations.root.get(self.dim * own.pair + own.component);
            root.is_some_and(|root| root.recip() == own.row)
        };
        (self.dim, self.all) == (equations.dim, equations.root.len())
            && self.unknowns.iter().all(has_unit)
    }

    /// The pairs on their pieces.
    pub fn pairs(&self) -> &[Linearised] {
        &self.pairs
    }

    /// The right-hand sides of the unknowns for each column of `b`.
    fn right_sides(&self, b: &[f64]) -> Vec<f64> {
        let (size, columns) = (self.size(), b.len().checked_div(self.all).unwrap_or(0));
        written(Vec::new(), (size, columns), |column, sides| {
            let b = &b[self.all * column..];
            for (side, unknown) in sides.iter_mut().zip(&self.unknowns) {
                let at = self.dim * unknown.pair;
                let dragged = match unknown.component {
                    0 => 0.0,
                    c => self.pairs[unknown.pair].slopes.drag_of(c) * b[at],
                };
                *side = (b[at + unknown.component] - dragged) * unknown.row;
            }
        })
    }

    /// `dy` from the unknowns, for each column of `b`.
    fn coordinates(&mut self, equations: &Equations<'_>, b: &[f64], x: &[f64]) -> Vec<f64> {
        let (dim, size, count) = (self.dim, self.all, self.size());
        let mut moved = x.to_vec();
        moved.chunks_exact_mut(count.max(1)).for_each(|moved| self.displace(moved));
        let pushes = self.held.pushes(equations, &self.unknowns, (b, &moved));
        let mut dy = vec![0.0; b.len()];
        for (column, dy) in dy.chunks_exact_mut(size.max(1)).enumerate() {
            for (unknown, x) in self.unknowns.iter().zip(&x[column * count..]) {
                dy[dim * unknown.pair + unknown.component] = x * unknown.column;
            }
            let held = &self.held.components;
            for (&i, push) in held.iter().zip(&pushes[column * held.len()..]) {
                dy[i] = *push;
            }
            let pairs = self.pairs.iter().zip(dy.chunks_exact_mut(dim));
            pairs.for_each(|(pair, dy)| pair.complete(dy));
        }
        dy
    }

    /// Turns a column of unknowns into `s` times the displacements of the components that move.
    fn displace(&self, moved: &mut [f64]) {
        for (moved, unknown) in moved.iter_mut().zip(&self.unknowns) {
            *moved *= self.s * unknown.column;
        }
        let tangential = self.unknowns.iter().enumerate().filter(|(_, own)| own.component == 1);
        for (k, unknown) in tangential {
            let motion = &self.pairs[unknown.pair].slopes.motion;
            match &mut moved[k..k + self.dim - 1] {
                [one, other] => [*one, *other] = ellipse::product(motion, [*one, *other]),
                along => along.iter_mut().for_each(|along| *along *= motion[0][0]),
            }
        }
    }
}

/// True if the system of pairs on their pieces is symmetric: Cholesky's method factorises it, if it is definite.
fn is_plain(equations: &Equations<'_>, pairs: &[Linearised]) -> bool {
    equations.symmetric && pairs.iter().all(|pair| pair.slopes.is_plain())
}
