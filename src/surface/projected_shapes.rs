//! The master's shape functions in those of a slave face, by least squares over the covered part: the
//! weights of dual mortar, `X = M⁻¹ ∫ N Nᵐ` with `M = ∫ N Nᵀ`.
//!
//! With dual functions `ψ = D M⁻¹ N` (Wohlmuth 2000), `∫ ψ_j N_i = δ_ij D_j`, the mortar weights
//! `∫ ψ_j Nᵐ_k / D_j` are `X_jk`. `M` of a part that is thin is as good as singular, so it is never formed:
//! polynomials of few terms, centred on the covered part and scaled to it, are made orthonormal there, and those
//! that result are evaluated at the face's nodes, where they are the coefficients.

use std::ops::Range;

use super::curved::POWERS;
use super::face::Face;
use super::lists::{Lists, add_lists, dot, dots, whole_lines};
use super::meetings::Meetings;
use super::overlap::Part;
use super::shape::{FaceKind, Local, MOST_NODES, Values, padded};
use crate::linalg::columns::LINE;
use crate::linalg::simd::vectorised;

/// A monomial that is this close to a combination of those before it adds nothing: the covered part has
/// fewer points than functions.
const DEPENDENT: f64 = 1e-10;

/// Passes of orthogonalisation: the second removes what rounding left of the first.
const PASSES: usize = 2;

/// A function that keeps this share of its norm has lost nothing in the first pass.
const KEPT: f64 = 0.9;

/// The part of a slave face over one master face.
#[derive(Clone, Debug)]
pub(super) struct Opposite<'a> {
    /// Its place among the master's faces.
    pub(super) at: usize,
    pub(super) part: Part,
    pub(super) kind: FaceKind,
    pub(super) nodes: &'a [usize],
    /// Places of its points among those of the slave face.
    pub(super) points: Range<usize>,
}

/// The weights of one slave face for the masters that it lies over.
#[derive(Clone, Debug)]
pub(super) struct Covered {
    /// Integrals of the slave's shape functions over the covered part.
    pub(super) integrals: Values,
    /// Integrals of their products with each coordinate over it.
    pub(super) moments: [Values; 3],
    /// Number of the slave's nodes.
    slaves: usize,
    masters: Vec<usize>,
    /// For each master the coefficients of its shape functions at the slave's nodes.
    coefficients: Vec<f64>,
    /// Coefficients of the gap between true shapes at the slave's nodes; zero if the sides are their faces.
    pub(super) gaps: Values,
    /// Master faces under it are so small that its pairs hold several in the mean.
    pub(super) holds_many: bool,
}

impl Covered {
    /// Master nodes with the coefficients of their shape functions at the slave's nodes.
    pub(super) fn weights(&self) -> impl Iterator<Item = (usize, Values)> {
        let coefficients = self.coefficients.chunks_exact(self.slaves);
        let padded = coefficients.map(|part| padded(part.iter().copied()));
        self.masters.iter().copied().zip(padded)
    }
}

/// Polynomials that span the shape functions of a face, orthonormal over its points, in memory that the
/// next face uses again.
#[derive(Debug, Default)]
pub(super) struct Polynomials {
    /// Length of lists: the number of points, and at least a line of zeros behind them.
    length: usize,
    /// At the slave's nodes.
    at_nodes: Vec<Values>,
    /// At the points, polynomial after polynomial.
    at_points: Vec<f64>,
    /// `at_points` times the weights of the points.
    weighted: Vec<f64>,
    /// Powers 0 to 2 of each local coordinate at the points.
    powers: [[Vec<f64>; POWERS]; 2],
    /// The one that is made, at the points, and times the weights of these.
    next: Vec<f64>,
    next_weighted: Vec<f64>,
    weights: Vec<f64>,
    /// Shape functions at some of the points, function after function.
    functions: Lists,
}

/// Middle and half width of the points along each local coordinate.
fn centre_and_scale(points: &Meetings) -> [(f64, f64); 2] {
    points.slave.each_ref().map(|along| {
        let (mut low, mut high) = (along[0], along[0]);
        for &at in along {
            low = if at < low { at } else { low };
            high = if at > high { at } else { high };
        }
        let half = 0.5 * (high - low);
        (0.5 * (low + high), if half > 0.0 { half } else { 1.0 })
    })
}

impl Polynomials {
    /// Makes the polynomials of a face with these points.
    #[inline(always)]
    fn span(&mut self, kind: FaceKind, points: &Meetings) {
        self.length = whole_lines(points.count()) + LINE;
        self.at_nodes.clear();
        self.at_points.clear();
        self.weighted.clear();
        self.weights.clear();
        self.weights.extend(&points.weights);
        self.weights.resize(self.length, 0.0);
        let scales = centre_and_scale(points);
        let scaled = |at: f64, c: usize| (at - scales[c].0) / scales[c].1;
        // Without the mean of the squares of -1 to 1 a square is orthogonal to what is constant there.
        let square = |x: f64| x * x - 1.0 / 3.0;
        for (c, [constant, first, second]) in self.powers.iter_mut().enumerate() {
            [&mut *constant, first, second].into_iter().for_each(Vec::clear);
            constant.resize(self.length, 1.0);
            first.extend(points.slave[c].iter().map(|&at| scaled(at, c)));
            first.resize(self.length, 0.0);
            second.extend(first.iter().map(|&x| square(x)));
        }
        for exponents in kind.exponents() {
            let [i, j] = exponents.map(|exponent| exponent as usize);
            let [along, across] = [&self.powers[0][i], &self.powers[1][j]];
            self.next.clear();
            self.next.extend(along.iter().zip(across).map(|(s, t)| s * t));
            let power = |x: f64, exponent: usize| [1.0, x, square(x)][exponent];
            let at_node = |&at: &Local| power(scaled(at[0], 0), i) * power(scaled(at[1], 1), j);
            self.add(padded(kind.places().iter().map(at_node)));
        }
    }

    /// Weighs the one that is made, and returns its norm.
    #[inline(always)]
    fn weigh(&mut self) -> f64 {
        self.next_weighted.clear();
        self.next_weighted.extend(self.weights.iter().zip(&self.next).map(|(w, p)| w * p));
        dot(&self.next_weighted, &self.next).sqrt()
    }

    /// Makes `next` orthonormal to what is there, and adds it.
    #[inline(always)]
    fn add(&mut self, mut at_nodes: Values) {
        let before = self.weigh();
        let mut left = before;
        for pass in 0..PASSES {
            if pass > 0 && left >= KEPT * before {
                break;
            }
            let parts: Values = dots(&self.next, &self.weighted).map(|part| -part);
            add_lists(&mut self.next, &parts[..self.at_nodes.len()], &self.at_points);
            for (part, other) in parts.iter().zip(&self.at_nodes) {
                at_nodes.iter_mut().zip(other).for_each(|(p, other)| *p += part * other);
            }
            left = self.weigh();
        }
        if left > DEPENDENT * before {
            let scale = 1.0 / left;
            self.at_nodes.push(at_nodes.map(|p| p * scale));
            self.at_points.extend(self.next.iter().map(|p| p * scale));
            self.weighted.extend(self.next_weighted.iter().map(|p| p * scale));
        }
    }

    /// Integrals of the functions times the one that is made.
    #[inline(always)]
    fn integrals(&mut self) -> Values {
        self.next_weighted.clear();
        self.next_weighted.extend(self.weights.iter().zip(&self.next).map(|(w, p)| w * p));
        dots(&self.next_weighted, &self.functions.values)
    }

    /// Adds what one master face has to the coefficients of its nodes.
    #[inline(always)]
    fn add_moments(&mut self, opposite: &Opposite<'_>, points: &Meetings, covered: &mut Covered) {
        let (nodes, range) = (covered.slaves, opposite.points.clone());
        let at = points.master.each_ref().map(|along| &along[range.clone()]);
        self.functions.fill(opposite.kind, at);
        let length = whole_lines(range.len());
        let mut moments = [[0.0; MOST_NODES]; MOST_NODES];
        for (moments, made) in moments.iter_mut().zip(self.weighted.chunks_exact(self.length)) {
            *moments = dots(&made[range.start..][..length], &self.functions.values);
        }
        for (k, &node) in opposite.nodes.iter().enumerate() {
            let place = covered.masters.iter().position(|other| *other == node);
            let place = place.unwrap_or_else(|| {
                covered.masters.push(node);
                covered.coefficients.resize(nodes * covered.masters.len(), 0.0);
                covered.masters.len() - 1
            });
            let coefficients = &mut covered.coefficients[nodes * place..nodes * (place + 1)];
            for (at_nodes, moments) in self.at_nodes.iter().zip(&moments) {
                let sums = coefficients.iter_mut().zip(at_nodes);
                sums.for_each(|(sum, at_node)| *sum += moments[k] * at_node);
            }
        }
    }

    /// The coefficients at the slave's nodes of a field with these values at the points of the last face.
    pub(super) fn fit(&self, values: &[f64]) -> Values {
        let mut coefficients = [0.0; MOST_NODES];
        for (at_nodes, weighted) in self.at_nodes.iter().zip(self.weighted.chunks(self.length)) {
            let moment = dot(&weighted[..values.len()], values);
            coefficients.iter_mut().zip(at_nodes).for_each(|(sum, p)| *sum += moment * p);
        }
        coefficients
    }

    /// Integrates over the points of a slave face that belong to master faces.
    pub(super) fn project(
        &mut self,
        face: &Face<'_>,
        points: &Meetings,
        parts: &[Opposite<'_>],
    ) -> Covered {
        let slave = face.kind;
        let slaves = slave.nodes();
        let most: usize = parts.iter().map(|opposite| opposite.nodes.len()).sum();
        let mut covered = Covered {
            integrals: [0.0; MOST_NODES],
            moments: [[0.0; MOST_NODES]; 3],
            slaves,
            gaps: [0.0; MOST_NODES],
            holds_many: false,
            masters: Vec::with_capacity(most),
            coefficients: Vec::with_capacity(slaves * most),
        };
        vectorised(
            #[inline(always)]
            || {
                self.span(slave, points);
                self.functions.fill(slave, points.slave.each_ref().map(|along| &along[..]));
                self.next.clear();
                self.next.resize(whole_lines(points.count()), 1.0);
                covered.integrals = self.integrals();
                for (axis, moments) in covered.moments.iter_mut().enumerate() {
                    self.next.fill(0.0);
                    let x: Values = face.x.map(|x| x[axis]);
                    add_lists(&mut self.next, &x[..slaves], &self.functions.values);
                    *moments = self.integrals();
                }
                for opposite in parts {
                    self.add_moments(opposite, points, &mut covered);
                }
            },
        );
        covered.masters.shrink_to_fit();
        covered.coefficients.shrink_to_fit();
        covered
    }
}
