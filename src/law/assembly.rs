//! The system of equations on given pieces of all pairs, column by column.
//!
//! With `dd` the displacements of a unit of an unknown ([`Slopes`]), the equation of a normal component is
//! `(K dd)_n`, and that of a tangential one `(K dd)_t - drag (K dd)_n + turn x`.

use std::borrow::Cow;
use std::ops::Range;

use super::pair_law::Vector;
use super::slopes::{Linearised, Slopes};
use crate::linalg::matrix::Matrix;
use crate::linalg::simd::vectorised;

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
    /// The scale and the drag of each equation: it is `scale (v[at] - drag v[normal])` of `v = K dd`, but for the turn of its
    /// pair.
    scales: Vec<f64>,
    drags: Vec<f64>,
    /// The equations in runs.
    runs: Vec<Run>,
}

/// Equations one after the other.
struct Run {
    range: Range<usize>,
    spacing: Spacing,
}

/// How the components of a run follow each other. Zones of contact and of slip make long runs, which are loops of vectors.
#[derive(Clone, Copy, PartialEq)]
enum Spacing {
    /// One by one, and nothing drags: open pairs.
    Near,
    /// Every other one, odd, and the normal component, if it drags, is the one before: the tangential components of the
    /// plane.
    Tangential,
    /// In any way.
    Scattered,
}

/// Fewer equations are no loop of vectors.
const SHORTEST_RUN: usize = 4;

/// `K dd` for a unit of an unknown.
pub struct Image<'i> {
    /// The components, each to be multiplied by `factor`.
    entries: Cow<'i, [f64]>,
    factor: f64,
}

impl<'i> Image<'i> {
    /// The image with these components.
    pub fn of(entries: impl Into<Cow<'i, [f64]>>) -> Self {
        Image { entries: entries.into(), factor: 1.0 }
    }
}

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
        let scales = unknowns.iter().map(|unknown| unknown.row).collect();
        let drags = unknowns.iter().map(|own| slopes[own.pair].drag_of(own.component)).collect();
        let mut assembly =
            Assembly { dim, matrix, unknowns, slopes, scales, drags, runs: Vec::new() };
        assembly.find_runs();
        assembly
    }

    /// The component of an equation.
    fn at(&self, i: usize) -> usize {
        self.dim * self.unknowns[i].pair + self.unknowns[i].component
    }

    /// The spacing that lets the next equation follow an equation.
    fn spacing_after(&self, i: usize) -> Spacing {
        let drags = self.drags[i] != 0.0 || self.drags[i + 1] != 0.0;
        let is_odd = self.at(i) % 2 == 1;
        match self.at(i + 1) - self.at(i) {
            1 if !drags => Spacing::Near,
            2 if is_odd && (!drags || self.dim == 2) => Spacing::Tangential,
            _ => Spacing::Scattered,
        }
    }

    /// Finds the runs of equations, scattered ones taken together.
    fn find_runs(&mut self) {
        let mut begin = 0;
        while begin < self.unknowns.len() {
            let last = self.unknowns.len() - 1;
            let mut end = begin + 1;
            let mut spacing = Spacing::Scattered;
            if begin < last {
                spacing = self.spacing_after(begin);
                end += (begin..last).take_while(|&i| self.spacing_after(i) == spacing).count();
            }
            if end - begin < SHORTEST_RUN {
                spacing = Spacing::Scattered;
            }
            match self.runs.last_mut() {
                Some(last) if last.spacing == spacing && spacing == Spacing::Scattered => {
                    last.range.end = end;
                }
                _ => self.runs.push(Run { range: begin..end, spacing }),
            }
            begin = end;
        }
    }

    /// `K dd` for a unit of the unknown `j`, the components from `from` on: a column of `K` where one component moves,
    /// otherwise a sum of them.
    pub fn image(&self, j: usize, from: usize) -> Image<'s> {
        let mut moved = self.moved(j);
        let Some((entries, factor)) = moved.next() else {
            return Image::of(vec![0.0; self.matrix.size()]);
        };
        let Some((others, part)) = moved.next() else {
            return Image { entries: Cow::Borrowed(entries), factor };
        };
        let mut image = vec![0.0; self.matrix.size()];
        let sums = image[from..].iter_mut().zip(&entries[from..]).zip(&others[from..]);
        sums.for_each(|((sum, entry), other)| *sum = factor * entry + part * other);
        Image::of(image)
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
        Image::of(image)
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
    pub fn coefficients(&self, j: usize, first: usize, image: &Image<'_>, entries: &mut [f64]) {
        vectorised(
            #[inline(always)]
            || {
                for run in &self.runs[self.runs.partition_point(|run| run.range.end <= first)..] {
                    let range = run.range.start.max(first)..run.range.end;
                    self.write(run.spacing, range, image, entries);
                }
            },
        );
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

    /// Writes the coefficients in a range of a run, but for the turn.
    #[inline(always)]
    fn write(&self, spacing: Spacing, range: Range<usize>, image: &Image<'_>, entries: &mut [f64]) {
        let (image, factor) = (&*image.entries, image.factor);
        let entries = &mut entries[range.clone()];
        let (count, at) = (entries.len(), self.at(range.start));
        let own = self.scales[range.clone()].iter().zip(&self.drags[range.clone()]);
        let own = entries.iter_mut().zip(own);
        match spacing {
            Spacing::Near => {
                for ((entry, (scale, _)), image) in own.zip(&image[at..at + count]) {
                    *entry = scale * (factor * image);
                }
            }
            Spacing::Tangential => {
                let pairs = image[at - 1..][..2 * count].chunks_exact(2);
                for ((entry, (scale, drag)), pair) in own.zip(pairs) {
                    *entry = scale * (factor * (pair[1] - drag * pair[0]));
                }
            }
            Spacing::Scattered => {
                for ((entry, (scale, drag)), unknown) in own.zip(&self.unknowns[range]) {
                    let normal = self.dim * unknown.pair;
                    let left = image[normal + unknown.component] - drag * image[normal];
                    *entry = scale * (factor * left);
                }
            }
        }
    }
}
