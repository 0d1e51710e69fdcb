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
use super::overlap::{Meeting, Part};
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

/// Most nodes of a linear face.
const MOST_LINEAR: usize = 4;

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
    /// Number of points.
    points: usize,
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
}

/// The sum of products, in as many sums beside each other as a line has numbers.
#[inline(always)]
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (parts, a) = a.as_chunks::<LINE>();
    let (others, b) = b.as_chunks::<LINE>();
    let mut sums = [0.0; LINE];
    for (part, other) in parts.iter().zip(others) {
        (0..LINE).for_each(|k| sums[k] += part[k] * other[k]);
    }
    sums.iter().sum::<f64>() + a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>()
}

/// Adds to sums of products, for each of some polynomials and the first `N` functions at two points.
#[inline(always)]
fn add_products<const N: usize>(
    moments: &mut [Values],
    polynomials: impl Iterator<Item = [f64; 2]>,
    [first, second]: &[Values; 2],
) {
    for (sums, [p, q]) in moments.iter_mut().zip(polynomials) {
        (0..N).for_each(|k| sums[k] += p * first[k] + q * second[k]);
    }
}

/// Middle and half width of the points along each local coordinate.
fn centre_and_scale(points: &[Meeting]) -> [(f64, f64); 2] {
    let [mut low, mut high] = [points[0].slave; 2];
    for (point, c) in points.iter().flat_map(|point| [(point, 0), (point, 1)]) {
        let at = point.slave[c];
        low[c] = if at < low[c] { at } else { low[c] };
        high[c] = if at > high[c] { at } else { high[c] };
    }
    [0, 1].map(|c| {
        let half = 0.5 * (high[c] - low[c]);
        (0.5 * (low[c] + high[c]), if half > 0.0 { half } else { 1.0 })
    })
}

impl Polynomials {
    /// Makes the polynomials of a face with these points.
    #[inline(always)]
    fn span(&mut self, kind: FaceKind, points: &[Meeting]) {
        self.points = points.len();
        self.at_nodes.clear();
        self.at_points.clear();
        self.weighted.clear();
        self.weights.clear();
        self.weights.extend(points.iter().map(|point| point.weight));
        let scales = centre_and_scale(points);
        let scaled = |at: Local, c: usize| (at[c] - scales[c].0) / scales[c].1;
        // Without the mean of the squares of -1 to 1 a square is orthogonal to what is constant there.
        let square = |x: f64| x * x - 1.0 / 3.0;
        for (c, [constant, first, second]) in self.powers.iter_mut().enumerate() {
            [&mut *constant, first, second].into_iter().for_each(Vec::clear);
            constant.resize(points.len(), 1.0);
            first.extend(points.iter().map(|point| scaled(point.slave, c)));
            second.extend(first.iter().map(|&x| square(x)));
        }
        for exponents in kind.exponents() {
            let [i, j] = exponents.map(|exponent| exponent as usize);
            let [along, across] = [&self.powers[0][i], &self.powers[1][j]];
            self.next.clear();
            self.next.extend(along.iter().zip(across).map(|(s, t)| s * t));
            let power = |x: f64, exponent: usize| [1.0, x, square(x)][exponent];
            let at_node = |&at: &Local| power(scaled(at, 0), i) * power(scaled(at, 1), j);
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
            for (other, other_at_nodes) in self.at_nodes.iter().enumerate() {
                let range = other * self.points..(other + 1) * self.points;
                let part = dot(&self.weighted[range.clone()], &self.next);
                let pairs = self.next.iter_mut().zip(&self.at_points[range]);
                pairs.for_each(|(p, other)| *p -= part * other);
                let pairs = at_nodes.iter_mut().zip(other_at_nodes);
                pairs.for_each(|(p, other)| *p -= part * other);
            }
            left = self.weigh();
        }
        if left > DEPENDENT * before {
            at_nodes.iter_mut().for_each(|p| *p /= left);
            self.at_nodes.push(at_nodes);
            self.at_points.extend(self.next.iter().map(|p| p / left));
            self.weighted.extend(self.next_weighted.iter().map(|p| p / left));
        }
    }

    /// Adds what one master face has to the coefficients of its nodes.
    #[inline(always)]
    fn add_moments(&self, opposite: &Opposite<'_>, points: &[Meeting], covered: &mut Covered) {
        let (nodes, count) = (covered.slaves, opposite.nodes.len());
        let mut moments = [[0.0; MOST_NODES]; MOST_NODES];
        for at in opposite.points.clone().step_by(2) {
            // A last point that is alone stands for two, one of which has no weight.
            let (next, has_next) = match at + 1 < opposite.points.end {
                true => (at + 1, 1.0),
                false => (at, 0.0),
            };
            let functions = [at, next].map(|at| opposite.kind.values(points[at].master));
            let made = self.weighted.chunks(self.points).map(|p| [p[at], has_next * p[next]]);
            if count <= MOST_LINEAR {
                add_products::<MOST_LINEAR>(&mut moments, made, &functions);
            } else {
                add_products::<MOST_NODES>(&mut moments, made, &functions);
            }
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
        for (at_nodes, weighted) in self.at_nodes.iter().zip(self.weighted.chunks(self.points)) {
            let moment = dot(weighted, values);
            coefficients.iter_mut().zip(at_nodes).for_each(|(sum, p)| *sum += moment * p);
        }
        coefficients
    }

    /// Integrates over the points of a slave face that belong to master faces.
    pub(super) fn project(
        &mut self,
        face: &Face<'_>,
        points: &[Meeting],
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
                for point in points {
                    let values = slave.values(point.slave);
                    let x = face.sum(&values);
                    for (j, value) in values.into_iter().enumerate().take(slaves) {
                        let part = point.weight * value;
                        covered.integrals[j] += part;
                        (0..3).for_each(|axis| covered.moments[axis][j] += part * x[axis]);
                    }
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
