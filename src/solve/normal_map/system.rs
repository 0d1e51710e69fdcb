//! The linear system of a point: Newton's step on the normal map, condensed on the components that
//! move, and bordered by the parameter of a homotopy.
//!
//! With `K_s = s K + (1 - s) k` (`s = 1`: the problem itself) and `dP/dy` of each pair's piece,
//! `J dy = -H` is reduced to the normal components of open pairs and the tangential ones of pairs that
//! slip or carry no friction. Such a pair has the unknown `x` with `dy_t = k x + drag dp`,
//! `drag = dtau/dp`, so that with `T = dtau/dy_t`, `T drag = 0` under every law,
//!
//! ```text
//! dd_t = k⁻¹ (1 - T) k x,   dtau = drag dp + T k x,   dp = -(H + K_s dd + g ds)_n
//! (K_s dd + g ds)_t - drag (K_s dd + g ds)_n + T k x = -H_t + drag H_n,           g = dH/ds
//! ```
//!
//! `k` is a number of the pair under an isotropic law, and a symmetric matrix with an ellipse.
//!
//! Nothing is divided by the slip. The sign of the determinant is that of `J`, or of `J` bordered: the
//! components that are eliminated have the pivot 1.

use super::equations::Equations;
use crate::law::piece::Piece;
use crate::law::{Block, PairLaw, Plane, Vector, ellipse};
use crate::linalg::factor::{Factor, lu_work};
use crate::linalg::tolerances::SINGULAR;
use crate::linalg::vector::dot;

/// What `dP/dy` says of a pair.
struct Pair {
    /// Whether the pressure follows `y`, and not the displacement.
    closed: bool,
    /// Whether the pair moves along its tangents.
    moves_along: bool,
    /// `dtau/dp`, zero of an open pair.
    drag: [f64; 2],
    /// `k⁻¹ (1 - T) k`.
    moves: Plane,
    /// `T k`.
    turns: Plane,
    /// `k` of the normal component, and of the tangential ones.
    normal_scale: f64,
    scale: Plane,
}

impl Pair {
    fn new(law: &PairLaw, derivative: &Block, slips: bool) -> Self {
        let [_, [first, a, b], [second, c, d]] = *derivative;
        let (turned, scale) = ([[a, b], [c, d]], law.tangential_scale());
        Pair {
            closed: derivative[0][0] != 0.0,
            moves_along: slips,
            drag: [first, second],
            moves: law.moves(&turned),
            turns: ellipse::times(&turned, &scale),
            normal_scale: law.normal_scale(),
            scale,
        }
    }

    /// `k v` of the pair's part of a vector.
    fn scaled(&self, v: &[f64]) -> Vector {
        let [one, two] = ellipse::product(&self.scale, tangential(v));
        [self.normal_scale * v[0], one, two]
    }
}

/// An unknown of the condensed system.
#[derive(Clone, Copy)]
struct Unknown {
    component: usize,
    /// Its pair, and its tangential number if it is tangential.
    pair: usize,
    tangential: Option<usize>,
}

/// The border of a system: `border . (dy, ds) = wanted`.
pub struct Border<'b> {
    /// `g = dH/ds`.
    pub rate: &'b [f64],
    /// Coefficients of `dy`, pair by pair.
    pub normal: &'b [Vector],
    /// Coefficient of `ds`.
    pub along: f64,
    /// Unit of `ds` divided by that of scaled forces: it makes the border as large as the rest.
    pub unit: f64,
}

/// A factorised system.
pub struct System<'e> {
    equations: &'e Equations<'e>,
    s: f64,
    unknowns: Vec<Unknown>,
    pairs: Vec<Pair>,
    factor: Factor,
    /// Of the border: `g`, coefficients of the reactions, and the unit of the last row and of `ds`.
    border: Option<Bordered>,
}

struct Bordered {
    rate: Vec<f64>,
    reactions: Vec<f64>,
    row_scale: f64,
    column_scale: f64,
}

impl<'e> System<'e> {
    /// Operations of a factorisation on given pieces.
    pub fn work(equations: &Equations<'_>, pieces: &[Piece]) -> f64 {
        let unknowns = |piece: &Piece| {
            usize::from(!piece.closed) + if piece.slips { equations.dim - 1 } else { 0 }
        };
        lu_work(pieces.iter().map(unknowns).sum())
    }

    /// Factorises the system at the coordinates `y` on given pieces; `None` if it is singular.
    pub fn new(
        equations: &'e Equations<'e>,
        (pieces, y): (&[Piece], &[Vector]),
        s: f64,
        border: Option<&Border<'_>>,
    ) -> Option<Self> {
        Self::with_least_pivot(equations, (pieces, y), s, border, SINGULAR)
    }

    /// As [`Self::new`]; pivots below `least`, relative to the largest, make the system singular.
    pub fn with_least_pivot(
        equations: &'e Equations<'e>,
        (pieces, y): (&[Piece], &[Vector]),
        s: f64,
        border: Option<&Border<'_>>,
        least: f64,
    ) -> Option<Self> {
        let dim = equations.dim;
        let (mut unknowns, mut pairs) = (Vec::new(), Vec::with_capacity(y.len()));
        for (at, ((law, y), &piece)) in equations.laws.iter().zip(y).zip(pieces).enumerate() {
            let pair = Pair::new(law, &law.derivative_on(piece, y), piece.slips);
            if !pair.closed {
                unknowns.push(Unknown { component: dim * at, pair: at, tangential: None });
            }
            if pair.moves_along {
                unknowns.extend((0..dim - 1).map(|c| Unknown {
                    component: dim * at + 1 + c,
                    pair: at,
                    tangential: Some(c),
                }));
            }
            pairs.push(pair);
        }
        let assembly = Assembly { equations, s, unknowns: &unknowns, pairs: &pairs, least };
        let (factor, border) = match border {
            None => (assembly.factor()?, None),
            Some(border) => {
                let (factor, bordered) = assembly.bordered(border)?;
                (factor, Some(bordered))
            }
        };
        Some(System { equations, s, unknowns, pairs, factor, border })
    }

    /// Sign of the determinant.
    pub fn orientation(&self) -> i8 {
        self.factor.sign()
    }

    /// `(dy, ds)` for the lack `H` and what the border wants, 0 without one; `None` if it overflows.
    pub fn step(&mut self, lack: &[f64], wanted: f64) -> Option<(Vec<Vector>, f64)> {
        let (dim, root) = (self.equations.dim, &self.equations.root);
        let mut x: Vec<f64> = Vec::with_capacity(self.unknowns.len() + 1);
        for unknown in &self.unknowns {
            let dragged = unknown
                .tangential
                .map_or(0.0, |c| self.pairs[unknown.pair].drag[c] * lack[dim * unknown.pair]);
            x.push((dragged - lack[unknown.component]) / root[unknown.component]);
        }
        if let Some(border) = &self.border {
            x.push((wanted + dot(&border.reactions, lack)) * border.row_scale);
        }
        self.factor.solve(&mut x);
        if !x.iter().all(|x| x.is_finite()) {
            return None;
        }
        let ds = match &self.border {
            Some(border) => border.column_scale * x[self.unknowns.len()],
            None => 0.0,
        };
        let mut free = vec![0.0; root.len()];
        for (unknown, x) in self.unknowns.iter().zip(&x) {
            free[unknown.component] = x / root[unknown.component];
        }
        Some((self.coordinates(&free, lack, ds), ds))
    }

    /// `dy` from the unknowns.
    fn coordinates(&self, free: &[f64], lack: &[f64], ds: f64) -> Vec<Vector> {
        let dim = self.equations.dim;
        let mut moved = free.to_vec();
        for (pair, moved) in self.pairs.iter().zip(moved.chunks_exact_mut(dim)) {
            let along = ellipse::product(&pair.moves, tangential(moved));
            moved[1..].copy_from_slice(&along[..dim - 1]);
        }
        // -(H + K_s dd + g ds).
        let mut reaction = vec![0.0; free.len()];
        self.equations.matrix.add_product(&moved, &mut reaction);
        for (at, pair) in self.pairs.iter().enumerate() {
            let n = dim * at;
            let scaled = pair.scaled(&moved[n..n + dim]);
            for (i, scaled) in (n..n + dim).zip(scaled) {
                let rate = self.border.as_ref().map_or(0.0, |border| border.rate[i] * ds);
                reaction[i] = -(lack[i] + self.s * reaction[i] + (1.0 - self.s) * scaled + rate);
            }
        }
        let coordinates = |(at, pair): (usize, &Pair)| {
            let n = dim * at;
            let scaled = pair.scaled(&free[n..n + dim]);
            let mut dy = [0.0; 3];
            dy[0] = if pair.closed { reaction[n] } else { scaled[0] };
            for c in 1..dim {
                dy[c] = match pair.moves_along {
                    true => scaled[c] + pair.drag[c - 1] * dy[0],
                    false => reaction[n + c],
                };
            }
            dy
        };
        self.pairs.iter().enumerate().map(coordinates).collect()
    }
}

/// What the columns of a system are made of.
struct Assembly<'s> {
    equations: &'s Equations<'s>,
    s: f64,
    unknowns: &'s [Unknown],
    pairs: &'s [Pair],
    /// Least pivot of a regular system, relative to the largest.
    least: f64,
}

impl Assembly<'_> {
    /// Writes `K_s dd` for a unit of the unknown `j`, all components.
    fn moved(&self, j: &Unknown, column: &mut [f64]) {
        let (matrix, dim) = (self.equations.matrix, self.equations.dim);
        let pair = &self.pairs[j.pair];
        let n = dim * j.pair;
        let Some(c) = j.tangential else {
            scaled(column, self.s, matrix.column(n));
            column[n] += (1.0 - self.s) * pair.normal_scale;
            return;
        };
        let moves: [f64; 2] = [pair.moves[0][c], pair.moves[1][c]];
        scaled(column, self.s * moves[0], matrix.column(n + 1));
        if dim > 2 {
            let (a, other) = (self.s * moves[1], matrix.column(n + 2));
            column.iter_mut().zip(other).for_each(|(sum, k)| *sum += a * k);
        }
        let own = ellipse::product(&pair.scale, moves);
        for row in 1..dim {
            column[n + row] += (1.0 - self.s) * own[row - 1];
        }
    }

    /// Writes the coefficients of the unknown `j` in all equations, `column` filled by [`Self::moved`].
    fn equations_of(&self, j: &Unknown, column: &[f64], entries: &mut [f64]) {
        let (dim, root) = (self.equations.dim, &self.equations.root);
        let unit = root[j.component].recip();
        for (entry, i) in entries.iter_mut().zip(self.unknowns) {
            let mut value = column[i.component];
            if let Some(c) = i.tangential {
                let pair = &self.pairs[i.pair];
                value -= pair.drag[c] * column[dim * i.pair];
                if let Some(other) = j.tangential.filter(|_| i.pair == j.pair) {
                    value += pair.turns[c][other];
                }
            }
            *entry = unit * value / root[i.component];
        }
    }

    fn factor(&self) -> Option<Factor> {
        let mut column = vec![0.0; self.equations.root.len()];
        Factor::with_least_pivot(self.unknowns.len(), false, self.least, |j, entries| {
            self.moved(&self.unknowns[j], &mut column);
            self.equations_of(&self.unknowns[j], &column, entries);
        })
    }

    fn bordered(&self, border: &Border<'_>) -> Option<(Factor, Bordered)> {
        let (dim, root, n) = (self.equations.dim, &self.equations.root, self.unknowns.len());
        let reactions = self.reactions(border);
        let (row_scale, column_scale) = (border.unit.recip(), border.unit);
        let mut column = vec![0.0; root.len()];
        let factor = Factor::new(n + 1, false, |j, entries| {
            if let Some(unknown) = self.unknowns.get(j) {
                self.moved(unknown, &mut column);
                self.equations_of(unknown, &column, entries);
                // k b of the unknown, less what the reactions take.
                let (pair, c) = (unknown.pair, unknown.tangential.map_or(0, |c| c + 1));
                let own = self.pairs[pair].scaled(&border.normal[pair])[c];
                let row = own - dot(&reactions, &column);
                entries[n] = row_scale * row / root[unknown.component];
                return;
            }
            for (entry, i) in entries.iter_mut().zip(self.unknowns) {
                let dragged = i
                    .tangential
                    .map_or(0.0, |c| self.pairs[i.pair].drag[c] * border.rate[dim * i.pair]);
                let rate = border.rate[i.component] - dragged;
                *entry = column_scale * rate / root[i.component];
            }
            entries[n] = row_scale * column_scale * (border.along - dot(&reactions, border.rate));
        })?;
        let rate = border.rate.to_vec();
        Some((factor, Bordered { rate, reactions, row_scale, column_scale }))
    }

    /// Coefficients of the border on `-(H + K_s dd + g ds)`, which the components follow that are no
    /// unknowns.
    fn reactions(&self, border: &Border<'_>) -> Vec<f64> {
        let dim = self.equations.dim;
        let mut reactions = vec![0.0; self.equations.root.len()];
        for (at, (pair, b)) in self.pairs.iter().zip(border.normal).enumerate() {
            if pair.closed {
                let dragged: f64 = (1..dim).map(|c| pair.drag[c - 1] * b[c]).sum();
                reactions[dim * at] = b[0] + dragged;
            }
            if !pair.moves_along {
                reactions[dim * at + 1..dim * (at + 1)].copy_from_slice(&b[1..dim]);
            }
        }
        reactions
    }
}

/// The tangential components of a pair's part of a vector; the second is 0 in the plane.
fn tangential(v: &[f64]) -> [f64; 2] {
    [v[1], v.get(2).copied().unwrap_or(0.0)]
}

fn scaled(target: &mut [f64], a: f64, source: &[f64]) {
    target.iter_mut().zip(source).for_each(|(target, source)| *target = a * source);
}
