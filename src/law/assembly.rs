//! The system of equations on given pieces of all pairs, column by column.
//!
//! With `dd` the displacements of a unit of an unknown ([`Slopes`]), the equation of a normal component is
//! `(K dd)_n`, and that of a tangential one `(K dd)_t - drag (K dd)_n + turn x`.

use super::Linearised;
use super::slopes::Slopes;
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

/// The coefficients of a system.
pub struct Assembly<'s> {
    /// Components of a pair.
    pub dim: usize,
    /// `K`.
    pub matrix: Matrix<'s>,
    /// The unknowns, in the order of the components.
    pub unknowns: &'s [Unknown],
    /// The derivatives of each pair.
    pub slopes: &'s [Slopes],
}

impl Assembly<'_> {
    /// Displacements of its pair by a unit of an unknown.
    pub fn motion_of(&self, unknown: &Unknown) -> [f64; 3] {
        let motion = &self.slopes[unknown.pair].motion;
        match unknown.component {
            0 => [unknown.column, 0.0, 0.0],
            c => [0.0, motion[0][c - 1] * unknown.column, motion[1][c - 1] * unknown.column],
        }
    }

    /// Writes `K dd` for a unit of the unknown `j`, the components from `from` on.
    pub fn image(&self, j: usize, from: usize, image: &mut [f64]) {
        let unknown = &self.unknowns[j];
        let parts = self.motion_of(unknown);
        let mut is_first = true;
        let parts = parts.into_iter().take(self.dim).enumerate();
        for (c, part) in parts.filter(|(_, part)| *part != 0.0) {
            let source = self.matrix.column(self.dim * unknown.pair + c);
            let terms = image[from..].iter_mut().zip(&source[from..]);
            match is_first {
                true => terms.for_each(|(image, k)| *image = part * k),
                false => terms.for_each(|(image, k)| *image += part * k),
            }
            is_first = false;
        }
        if is_first {
            image[from..].fill(0.0);
        }
    }

    /// Adds `(1 - s) k dd` to `s K dd`, the components from `from` on: the matrix is `K_s = s K + (1 - s) k` then.
    pub fn lead(&self, s: f64, pairs: &[Linearised], j: usize, from: usize, image: &mut [f64]) {
        let unknown = &self.unknowns[j];
        let own = pairs[unknown.pair].scaled(&self.motion_of(unknown));
        image[from..].iter_mut().for_each(|image| *image *= s);
        let first = self.dim * unknown.pair;
        let components = image[first..first + self.dim].iter_mut();
        components.zip(own).for_each(|(image, own)| *image += (1.0 - s) * own);
    }

    /// Writes the coefficients of the unknown `j` in the equations from `first` on, by its `image`.
    pub fn coefficients(&self, j: usize, first: usize, image: &[f64], entries: &mut [f64]) {
        let unknown = &self.unknowns[j];
        for (entry, equation) in entries[first..].iter_mut().zip(&self.unknowns[first..]) {
            let at = self.dim * equation.pair;
            let mut value = image[at + equation.component];
            if equation.component > 0 {
                let slopes = &self.slopes[equation.pair];
                let along = equation.component - 1;
                value -= slopes.drag[along] * image[at];
                if equation.pair == unknown.pair && unknown.component > 0 {
                    value += slopes.turn[along][unknown.component - 1] * unknown.column;
                }
            }
            *entry = equation.row * value;
        }
    }
}
