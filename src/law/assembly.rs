//! The system of equations on given pieces of all pairs, column by column.
//!
//! With `dd` the displacements of a unit of an unknown ([`Slopes`]), the equation of a normal component is
//! `(K dd)_n`, and that of a tangential one `(K dd)_t - drag (K dd)_n + turn x`.

use super::slopes::{Linearised, Slopes};
use crate::linalg::matrix::Matrix;
use crate::linalg::vector::dot;

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
    dim: usize,
    matrix: Matrix<'s>,
    unknowns: &'s [Unknown],
    slopes: &'s [Slopes],
    equations: Vec<Equation>,
    /// True if a friction follows its pressure.
    drags: bool,
}

/// The equation of an unknown, `scale (v[at] - drag v[normal])` of `v = K dd`, but for the turn of its pair.
struct Equation {
    /// Its component, and the normal one of its pair.
    at: usize,
    normal: usize,
    scale: f64,
    drag: f64,
}

/// `K dd` for a unit of an unknown.
pub struct Image<'i> {
    /// The components, each to be multiplied by `factor`.
    entries: &'i [f64],
    factor: f64,
}

impl<'i> Image<'i> {
    /// The image with these components.
    pub fn of(entries: &'i [f64]) -> Self {
        Image { entries, factor: 1.0 }
    }

    /// Its product with a vector.
    pub fn dot(&self, vector: &[f64]) -> f64 {
        self.factor * dot(vector, self.entries)
    }
}

impl<'s> Assembly<'s> {
    /// The coefficients for the `unknowns`, in the order of the components, of pairs of `dim` components with their
    /// `slopes`; `matrix` is `K`.
    pub fn new(
        dim: usize,
        matrix: Matrix<'s>,
        unknowns: &'s [Unknown],
        slopes: &'s [Slopes],
    ) -> Self {
        let equation = |unknown: &Unknown| {
            let (normal, c) = (dim * unknown.pair, unknown.component);
            let drag = if c == 0 { 0.0 } else { slopes[unknown.pair].drag[c - 1] };
            Equation { at: normal + c, normal, scale: unknown.row, drag }
        };
        let equations: Vec<Equation> = unknowns.iter().map(equation).collect();
        let drags = equations.iter().any(|equation| equation.drag != 0.0);
        Assembly { dim, matrix, unknowns, slopes, equations, drags }
    }

    /// Displacements of its pair by a unit of an unknown.
    pub fn motion_of(&self, unknown: &Unknown) -> [f64; 3] {
        let motion = &self.slopes[unknown.pair].motion;
        match unknown.component {
            0 => [unknown.column, 0.0, 0.0],
            c => [0.0, motion[0][c - 1] * unknown.column, motion[1][c - 1] * unknown.column],
        }
    }

    /// `K dd` for a unit of the unknown `j`, the components from `from` on: a column of `K` where one component moves,
    /// otherwise in `room`.
    pub fn image<'i>(&self, j: usize, from: usize, room: &'i mut [f64]) -> Image<'i>
    where
        's: 'i,
    {
        let mut moved = self.moved(j);
        let Some((entries, factor)) = moved.next() else {
            room[from..].fill(0.0);
            return Image::of(room);
        };
        let Some((others, part)) = moved.next() else { return Image { entries, factor } };
        let sums = room[from..].iter_mut().zip(&entries[from..]).zip(&others[from..]);
        sums.for_each(|((sum, entry), other)| *sum = factor * entry + part * other);
        Image::of(room)
    }

    /// As [`Self::image`], with `s K + (1 - s) k` in the place of `K`.
    pub fn led_image<'i>(
        &self,
        (s, pairs): (f64, &[Linearised]),
        j: usize,
        from: usize,
        room: &'i mut [f64],
    ) -> Image<'i> {
        room[from..].fill(0.0);
        for (entries, part) in self.moved(j) {
            let sums = room[from..].iter_mut().zip(&entries[from..]);
            sums.for_each(|(sum, entry)| *sum += s * part * entry);
        }
        let unknown = &self.unknowns[j];
        let own = pairs[unknown.pair].scaled(&self.motion_of(unknown));
        let components = room[self.dim * unknown.pair..].iter_mut().take(self.dim);
        components.zip(own).for_each(|(sum, own)| *sum += (1.0 - s) * own);
        Image::of(room)
    }

    /// The columns of `K` of the components that a unit of the unknown `j` moves, with the displacement of each.
    fn moved(&self, j: usize) -> impl Iterator<Item = (&'s [f64], f64)> {
        let first = self.dim * self.unknowns[j].pair;
        let parts = self.motion_of(&self.unknowns[j]).into_iter().take(self.dim).enumerate();
        let moved = parts.filter(|(_, part)| *part != 0.0);
        moved.map(move |(c, part)| (self.matrix.column(first + c), part))
    }

    /// Writes the coefficients of the unknown `j` in the equations from `first` on, by its image.
    pub fn coefficients(&self, j: usize, first: usize, image: &Image<'_>, entries: &mut [f64]) {
        let Image { entries: image, factor } = *image;
        let rows = entries[first..].iter_mut().zip(&self.equations[first..]);
        match self.drags {
            true => rows.for_each(|(entry, row)| {
                let dragged = row.drag * image[row.normal];
                *entry = row.scale * (factor * (image[row.at] - dragged));
            }),
            false => rows.for_each(|(entry, row)| *entry = row.scale * (factor * image[row.at])),
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
