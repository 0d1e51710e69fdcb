//! Whether contact forces can balance the loads on the rigid motions at all, whatever the
//! displacements.
//!
//! With a basis `N` of the motions that `K` does not resist, balance is `Nᵀ (f + F) = 0` for forces
//! `F` in the friction cones. The forces that come nearest, by non-negative least squares over the
//! edges of the cones (Lawson and Hanson 1974), leave `e = Nᵀ (f + F)`; if it is not zero, `r = N e` is
//! a motion on which the loads do work, `f . r = |e|²`, and no admissible force does negative work:
//! what [`certificate::is_escape`] asks of a proof.

use super::factor::Factor;
use crate::certificate;
use crate::linalg::direct::Direct;
use crate::problem::{ContactProblem, FrictionLaw};

/// Edges of the polygon around a friction cone in 3D, which it contains: what its forces cannot
/// balance the cone's cannot.
const EDGES: usize = 16;

/// Gradients above this part of the loads' would still lower the distance.
const GRADIENT: f64 = 1e-13;

/// A motion that proves that there is no equilibrium, under Coulomb's law.
pub fn escape(problem: &ContactProblem<'_>) -> Option<Vec<f64>> {
    let FrictionLaw::Coulomb(mu) = problem.law() else { return None };
    let root: Vec<f64> = (0..problem.unknowns()).map(|i| problem.diagonal(i).sqrt()).collect();
    let basis = rigid_motions(problem, &root);
    let on_motions = |force: &dyn Fn(usize) -> f64, first: usize, count: usize| -> Vec<f64> {
        let work = |v: &Vec<f64>| (first..first + count).map(|i| v[i] * force(i) / root[i]).sum();
        basis.iter().map(work).collect()
    };
    let load = on_motions(&|i| problem.load()[i], 0, problem.unknowns());
    let mut edges = Vec::new();
    for pair in (0..problem.pairs()).filter(|&pair| problem.gap(pair) < f64::INFINITY) {
        for tangential in rims(problem.dim(), mu[pair]) {
            let n = problem.dim() * pair;
            let force = |i: usize| if i == n { -1.0 } else { tangential[i - n - 1] };
            edges.push(on_motions(&force, n, problem.dim()));
        }
    }
    let rest = nearest(&load, &edges)?;
    let mut motion = vec![0.0; problem.unknowns()];
    for (v, e) in basis.iter().zip(&rest) {
        for ((motion, v), root) in motion.iter_mut().zip(v).zip(&root) {
            *motion += e * v / root;
        }
    }
    certificate::is_escape(problem, &motion).then_some(motion)
}

/// An orthonormal basis of the motions without force, each component times its `root`.
fn rigid_motions(problem: &ContactProblem<'_>, root: &[f64]) -> Vec<Vec<f64>> {
    let Some(factor) = Factor::new(problem, (0..problem.unknowns()).collect()) else {
        return Vec::new();
    };
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for i in factor.dependent() {
        let mut v = vec![0.0; problem.unknowns()];
        v[i] = 1.0 / root[i];
        factor.follow(problem, &mut v);
        v.iter_mut().zip(root).for_each(|(v, root)| *v *= root);
        // Twice: once leaves what rounding makes of nearly parallel ones.
        for _ in 0..2 {
            for known in &basis {
                let share = dot(known, &v);
                v.iter_mut().zip(known).for_each(|(v, known)| *v -= share * known);
            }
            let size = dot(&v, &v).sqrt();
            v.iter_mut().for_each(|v| *v /= size);
        }
        basis.push(v);
    }
    basis
}

/// Tangential forces on the rim of the cone, or of the polygon around it, under unit pressure.
fn rims(dim: usize, mu: f64) -> Vec<Vec<f64>> {
    match dim {
        _ if mu == 0.0 => vec![vec![0.0; dim - 1]],
        2 => vec![vec![mu], vec![-mu]],
        _ => (0..EDGES)
            .map(|k| {
                let half = std::f64::consts::PI / EDGES as f64;
                let (sin, cos) = (2.0 * half * k as f64).sin_cos();
                vec![mu * cos / half.cos(), mu * sin / half.cos()]
            })
            .collect(),
    }
}

/// `load + sum x_j edges_j` of least length with `x >= 0`; `None` if that is zero up to rounding.
fn nearest(load: &[f64], edges: &[Vec<f64>]) -> Option<Vec<f64>> {
    let size = dot(load, load).sqrt();
    let mut active: Vec<usize> = Vec::new();
    let mut x: Vec<f64> = Vec::new();
    let mut rest = load.to_vec();
    // Each step lowers the length: no set of edges comes twice, and few come at all.
    for _ in 0..10 * (load.len() + edges.len()) {
        let steepest = (0..edges.len())
            .filter(|j| !active.contains(j))
            .map(|j| (dot(&edges[j], &rest) / dot(&edges[j], &edges[j]).sqrt(), j))
            .filter(|(slope, _)| *slope < -GRADIENT * size)
            .min_by(|a, b| a.0.total_cmp(&b.0));
        let Some((_, entering)) = steepest else { break };
        active.push(entering);
        x.push(0.0);
        loop {
            let Some(wanted) = least_squares(load, edges, &active) else {
                // It depends on the others: what is left of its slope is rounding.
                active.pop();
                return (dot(&rest, &rest).sqrt() > GRADIENT * size).then_some(rest);
            };
            let blocking = (0..x.len())
                .filter(|&k| wanted[k] <= 0.0)
                .map(|k| (x[k] / (x[k] - wanted[k]).max(f64::MIN_POSITIVE), k))
                .min_by(|a, b| a.0.total_cmp(&b.0));
            let Some((part, leaving)) = blocking else {
                x = wanted;
                break;
            };
            for (x, wanted) in x.iter_mut().zip(&wanted) {
                *x += part * (wanted - *x);
            }
            active.remove(leaving);
            x.remove(leaving);
        }
        rest = load.to_vec();
        for (&j, x) in active.iter().zip(&x) {
            rest.iter_mut().zip(&edges[j]).for_each(|(rest, edge)| *rest += x * edge);
        }
    }
    (dot(&rest, &rest).sqrt() > GRADIENT * size).then_some(rest)
}

/// The `x` for which `load + sum x_j edges_j` is shortest; `None` if the edges are dependent.
fn least_squares(load: &[f64], edges: &[Vec<f64>], active: &[usize]) -> Option<Vec<f64>> {
    let length = |j: usize| dot(&edges[j], &edges[j]).sqrt();
    let gram = Direct::new(active.len(), true, |c, column| {
        for (entry, &j) in column.iter_mut().zip(active) {
            *entry = dot(&edges[j], &edges[active[c]]) / (length(j) * length(active[c]));
        }
    })?;
    let mut x: Vec<f64> = active.iter().map(|&j| -dot(&edges[j], load) / length(j)).collect();
    gram.solve(&mut x);
    Some(x.iter().zip(active).map(|(x, &j)| x / length(j)).collect())
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
