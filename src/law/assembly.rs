//! The system of equations on given pieces of all pairs, column by column.
//!
//! With `dd` the displacements of a unit of an unknown ([`Slopes`]), the equation of a normal component is
//! `(K dd)_n`, and that of a tangential one `(K dd)_t - drag (K dd)_n + turn x`.

use std::borrow::Cow;

use super::pair_law::Vector;
use super::slopes::{Linearised, Slopes};
use crate::linalg::matrix::Matrix;

/// An unknown, with the equation of the same component.
#[derive(Clone, Copy, Debug)]
pub struct Unknown {
    /// Its pair.
    pub pair: usize,
    /// Component of the pair, 0 the normal one.
    pub component: usize,
    /// Scale of its equation.
    pub row: f64,
    /// Scale of the unknown itself.
    pub column: f64,
}

impl Unknown {
    /// Displacements of its pair, which has these slopes, by a unit of it.
    pub fn motion(&self, Slopes { motion, .. }: &Slopes) -> Vector {
        match self.component {
            0 => [self.column, 0.0, 0.0],
            c => [0.0, motion[0][c - 1] * self.column, motion[1][c - 1] * self.column],
        }
    }
}

/// The coefficients of a system.
pub struct Assembly<'s> {
    dim: usize,
    matrix: Matrix<'s>,
    unknowns: &'s [Unknown],
    /// Those of each pair.
    slopes: Vec<&'s Slopes>,
    /// Those of the unknowns.
    equations: Vec<Equation>,
}

/// An equation is `scale (v[at] - drag v[normal])` of `v = K dd`, but for the turn of its pair.
struct Equation {
    scale: f64,
    drag: f64,
    at: usize,
    normal: usize,
}

/// The components of `K dd` for a unit of an unknown, each to be multiplied by the factor.
pub type Image<'i> = (Cow<'i, [f64]>, f64);

impl<'s> Assembly<'s> {
    /// The coefficients for the `unknowns`, in the order of the components, of pairs of `dim` components with these
    /// slopes; `matrix` is `K`.
    pub fn new(
        dim: usize,
        matrix: Matrix<'s>,
        unknowns: &'s [Unknown],
        slopes: impl Iterator<Item = &'s Slopes>,
    ) -> Self {
        let slopes: Vec<&Slopes> = slopes.collect();
        let equation = |own: &Unknown| {
            let (drag, normal) = (slopes[own.pair].drag_of(own.component), dim * own.pair);
            Equation { scale: own.row, drag, at: normal + own.component, normal }
        };
        let equations = unknowns.iter().map(equation).collect();
        Assembly { dim, matrix, unknowns, slopes, equations }
    }

    /// `K dd` for a unit of the unknown `j`, the components from `from` on: a column of `K` where one component moves,
    /// otherwise a sum of them.
    pub fn image(&self, j: usize, from: usize) -> Image<'s> {
        let mut moved = self.moved(j);
        let Some((entries, factor)) = moved.next() else {
            return (vec![0.0; self.matrix.size()].into(), 1.0);
        };
        let Some((others, part)) = moved.next() else {
            return (entries.into(), factor);
        };
        let mut image = vec![0.0; self.matrix.size()];
        let sums = image[from..].iter_mut().zip(&entries[from..]).zip(&others[from..]);
        sums.for_each(|((sum, entry), other)| *sum = factor * entry + part * other);
        (image.into(), 1.0)
    }

    /// As [`Self::image`], with `s K + (1 - s) k` in the place of `K`.
    pub fn led_image(&self, (s, pairs): (f64, &[Linearised]), j: usize, from: usize) -> Image<'s> {
        let mut image = vec![0.0; self.matrix.size()];
        for (entries, part) in self.moved(j) {
            let sums = image[from..].iter_mut().zip(&entries[from..]);
            sums.for_each(|(sum, entry)| *sum += s * part * entry);
        }
        let unknown = &self.unknowns[j];
        let own = pairs[unknown.pair].scaled(&unknown.motion(self.slopes[unknown.pair]));
        let components = image[self.dim * unknown.pair..].iter_mut().take(self.dim);
        components.zip(own).for_each(|(sum, own)| *sum += (1.0 - s) * own);
        (image.into(), 1.0)
    }

    /// The columns of `K` of the components that a unit of the unknown `j` moves, with the displacement of each.
    fn moved(&self, j: usize) -> impl Iterator<Item = (&'s [f64], f64)> {
        let unknown = &self.unknowns[j];
        let first = self.dim * unknown.pair;
        let parts = unknown.motion(self.slopes[unknown.pair]).into_iter();
        let parts = parts.take(self.dim).enumerate();
        let moved = parts.filter(|(_, part)| *part != 0.0);
        moved.map(move |(c, part)| (self.matrix.column(first + c), part))
    }

    /// Writes the coefficients of the unknown `j` in the equations from `first` on, by its image.
    pub fn coefficients(
        &self,
        j: usize,
        first: usize,
        (v, factor): &Image<'_>,
        entries: &mut [f64],
    ) {
        for (entry, equation) in entries[first..].iter_mut().zip(&self.equations[first..]) {
            let left = v[equation.at] - equation.drag * v[equation.normal];
            *entry = equation.scale * (factor * left);
        }
        let unknown = &self.unknowns[j];
        let Some(own) = unknown.component.checked_sub(1) else { return };
        let turn = &self.slopes[unknown.pair].turn;
        let near = first.max(j.saturating_sub(1))..self.unknowns.len().min(j + 2);
        for (entry, equation) in entries[near.clone()].iter_mut().zip(&self.unknowns[near]) {
            if equation.pair == unknown.pair && equation.component > 0 {
                *entry += equation.row * (turn[equation.component - 1][own] * unknown.column);
            }
        }
    }
}
