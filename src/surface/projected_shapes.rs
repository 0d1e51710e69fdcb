//! The master's shape functions in those of a slave face, by least squares over the covered part: the
//! weights of dual mortar, `X = M⁻¹ ∫ N Nᵐ` with `M = ∫ N Nᵀ`.
//!
//! With dual functions `ψ = D M⁻¹ N` (Wohlmuth 2000), `∫ ψ_j N_i = δ_ij D_j`, the mortar weights
//! `∫ ψ_j Nᵐ_k / D_j` are `X_jk`. `M` of a part that is thin is as good as singular, so it is never formed:
//! monomials, centred on the covered part and scaled to it, are made orthonormal there, and the
//! polynomials that result are evaluated at the face's nodes, where they are the coefficients.

use super::overlap::{Meeting, Part};
use super::shape::{FaceKind, Local, MOST_NODES, Values};

/// A monomial that is this close to a combination of those before it adds nothing: the covered part has
/// fewer points than functions.
const DEPENDENT: f64 = 1e-10;

/// Passes of orthogonalisation: the second removes what rounding left of the first.
const PASSES: usize = 2;

/// What one slave face gets from the masters that it lies over.
#[derive(Clone, Debug)]
pub(super) struct Covered {
    /// Integrals of the slave's shape functions over the covered part.
    pub(super) integrals: Values,
    /// Master nodes with the coefficients of their shape functions at the slave's nodes.
    pub(super) masters: Vec<(usize, Values)>,
}

/// A polynomial of an orthonormal set: at the points, and at the slave's nodes.
struct Polynomial {
    at_points: Vec<f64>,
    at_nodes: Values,
}

/// Integrates over the parts that belong to master faces of the given kinds and nodes.
pub(super) fn project(slave: FaceKind, parts: &[(FaceKind, &[usize], Part)]) -> Covered {
    let points: Vec<Meeting> =
        parts.iter().flat_map(|(_, _, part)| part.points.iter().copied()).collect();
    let basis = orthonormal(slave, &points);
    let mut integrals = [0.0; MOST_NODES];
    for point in &points {
        let values = slave.values(point.slave);
        integrals.iter_mut().zip(values).for_each(|(sum, value)| *sum += point.weight * value);
    }
    let mut masters: Vec<(usize, Values)> = Vec::new();
    let mut first = 0;
    for (kind, nodes, part) in parts {
        let shapes: Vec<Values> = part.points.iter().map(|p| kind.values(p.master)).collect();
        for (k, &node) in nodes.iter().enumerate() {
            let place = masters.iter().position(|(other, _)| *other == node).unwrap_or_else(|| {
                masters.push((node, [0.0; MOST_NODES]));
                masters.len() - 1
            });
            for polynomial in &basis {
                let at = &polynomial.at_points[first..first + shapes.len()];
                let terms = part.points.iter().zip(at).zip(&shapes);
                let moment: f64 =
                    terms.map(|((point, p), shape)| point.weight * p * shape[k]).sum();
                let coefficients = masters[place].1.iter_mut().zip(&polynomial.at_nodes);
                coefficients.for_each(|(sum, at_node)| *sum += moment * at_node);
            }
        }
        first += shapes.len();
    }
    Covered { integrals, masters }
}

/// Middle and half width of the points along each local coordinate.
fn centre_and_scale(points: &[Meeting]) -> [(f64, f64); 2] {
    [0, 1].map(|c| {
        let along = || points.iter().map(|point| point.slave[c]);
        let low = along().fold(f64::INFINITY, f64::min);
        let high = along().fold(f64::NEG_INFINITY, f64::max);
        let half = 0.5 * (high - low);
        (0.5 * (low + high), if half > 0.0 { half } else { 1.0 })
    })
}

/// Polynomials that span the shape functions, orthonormal over the points.
fn orthonormal(kind: FaceKind, points: &[Meeting]) -> Vec<Polynomial> {
    let [s, t] = centre_and_scale(points);
    let scaled = |at: Local| [(at[0] - s.0) / s.1, (at[1] - t.0) / t.1];
    let product = |a: &[f64], b: &[f64]| -> f64 {
        points.iter().zip(a).zip(b).map(|((point, a), b)| point.weight * a * b).sum()
    };
    let mut basis: Vec<Polynomial> = Vec::new();
    for [i, j] in kind.exponents() {
        let monomial = |at: Local| {
            let [s, t] = scaled(at);
            s.powi(*i) * t.powi(*j)
        };
        let mut at_points: Vec<f64> = points.iter().map(|point| monomial(point.slave)).collect();
        let mut at_nodes = [0.0; MOST_NODES];
        at_nodes.iter_mut().zip(kind.places()).for_each(|(p, &place)| *p = monomial(place));
        let before = product(&at_points, &at_points).sqrt();
        for _ in 0..PASSES {
            for other in &basis {
                let part = product(&other.at_points, &at_points);
                let pairs = at_points.iter_mut().zip(&other.at_points);
                pairs.for_each(|(p, other)| *p -= part * other);
                let pairs = at_nodes.iter_mut().zip(&other.at_nodes);
                pairs.for_each(|(p, other)| *p -= part * other);
            }
        }
        let norm = product(&at_points, &at_points).sqrt();
        if norm > DEPENDENT * before {
            at_points.iter_mut().for_each(|p| *p /= norm);
            at_nodes.iter_mut().for_each(|p| *p /= norm);
            basis.push(Polynomial { at_points, at_nodes });
        }
    }
    basis
}
