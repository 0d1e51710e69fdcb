//! A proof that the solution is unique.
//!
//! For positive definite `K` the solutions with given thresholds `g` and `g'` differ by at most
//! `|v - v'|_K <= sqrt(L_t) |X⁻¹ (g - g')|`, `L_t` the largest eigenvalue of `X W_tt X` with
//! `W = K⁻¹` and any diagonal `X > 0`; pressures follow with
//! `|X⁻¹ mu (p - p')| <= sqrt(L_n) |v - v'|_K`, `L_n` that of `X⁻¹ mu K_nn mu X⁻¹`. If `L_n L_t < 1`
//! the map `g -> mu p` is a contraction, and Coulomb's problem has one solution. With uniform `mu`
//! and `X = 1` this is `mu < 1 / sqrt(|K_nn| |W_tt|)`. In space `W_tt` has the two tangents of each pair,
//! and friction discs of the radii `g` and `g'` give the same bound:
//! `(tau - tau').(delta - delta') >= (g - g') (|delta| - |delta'|)`.
//!
//! Cohesion adds a constant to `g`. With an ellipse and the associated rule `|delta|` is the most work
//! of forces of gauge 1, which is no longer than the slip (`law::ellipse`), and the same bound follows.
//! Under the collinear rule friction is not monotone, and nothing is proved.

use super::difference::MARGIN;
use crate::linalg::eigen::{is_below, largest_eigenvalue};
use crate::linalg::factor::Factor;
use crate::linalg::matrix::Matrix;
use crate::linalg::tolerances::SINGULAR;
use crate::linalg::watched::{BLOCK, GoesOn};
use crate::solve::result::Call;

/// The factor of `K`, scaled to a unit diagonal, if it is positive definite, and if there is time for it.
pub fn scaled_factor(call: &Call<'_>) -> Option<Factor> {
    let problem = call.contact.problem();
    let matrix = problem.stiffness();
    if !problem.is_symmetric() {
        return None;
    }
    let root = problem.unit_roots();
    let fill = |j: usize, column: &mut [f64]| {
        for (i, (entry, k)) in column.iter_mut().zip(matrix.column(j)).enumerate() {
            *entry = k / (root[i] * root[j]);
        }
    };
    Factor::new(matrix.size(), true, SINGULAR, fill, &mut call.monitor.asking())
}

/// True if the solution is proved to be the only one: `K` is positive definite, and `g -> mu p` is
/// constant or a contraction. When the time is up, or the caller has cancelled, nothing is proved.
pub fn is_unique(call: &Call<'_>) -> bool {
    let Some(mut factor) = scaled_factor(call) else { return false };
    let laws = call.contact.pairs();
    let coupled: Vec<usize> = (0..laws.len()).filter(|&i| laws[i].is_coupled()).collect();
    coupled.is_empty()
        || (!call.contact.has_collinear_slip() && is_contraction(call, &mut factor, &coupled))
}

fn is_contraction(call: &Call<'_>, factor: &mut Factor, coupled: &[usize]) -> bool {
    let (contact, monitor) = (call.contact, call.monitor);
    let (matrix, dim) = (contact.problem().stiffness(), contact.dim());
    let (n, m, tangents) = (matrix.size(), coupled.len(), dim - 1);
    // Column `a` belongs to the tangent `a % tangents` of the pair `coupled[a / tangents]`.
    let component = |a: usize| dim * coupled[a / tangents] + 1 + a % tangents;
    let mut flexibility = vec![0.0; n * m * tangents];
    for (a, column) in flexibility.chunks_exact_mut(n).enumerate() {
        column[component(a)] = 1.0;
    }
    for columns in flexibility.chunks_mut(n * BLOCK) {
        if monitor.goes_on().is_err() {
            return false;
        }
        factor.solve(columns);
    }
    let root = contact.problem().unit_roots();
    let mu: Vec<f64> = coupled.iter().map(|&pair| contact.pairs()[pair].bound.slope).collect();
    let compliance = |a: usize, b: usize| {
        let (i, j) = (component(a), component(b));
        flexibility[i + n * b] / (root[i] * root[j])
    };
    let stiffness =
        |a: usize, b: usize| mu[a] * matrix.at(dim * coupled[a], dim * coupled[b]) * mu[b];
    let softest = |pair: usize| {
        let own = (0..tangents).map(|c| compliance(tangents * pair + c, tangents * pair + c));
        own.fold(0.0, f64::max)
    };
    // Three diagonals X: those that scale either matrix to a unit diagonal, and the one between.
    let scales: [&dyn Fn(usize) -> f64; 3] =
        [&|a| stiffness(a, a).sqrt(), &|a| softest(a).sqrt().recip(), &|a| {
            (stiffness(a, a) / softest(a)).sqrt().sqrt()
        }];
    for scale in scales {
        let x: Vec<f64> = (0..m).map(scale).collect();
        let normal = dense(m, |a, b| stiffness(a, b) / (x[a] * x[b]));
        if monitor.goes_on().is_err() {
            return false;
        }
        let tangential =
            dense(m * tangents, |a, b| compliance(a, b) * x[a / tangents] * x[b / tangents]);
        let matrices = [(m, &normal), (m * tangents, &tangential)];
        let matrices = matrices.map(|(n, entries)| Matrix::new(n, entries, n));
        if have_product_below_one(matrices, &mut monitor.asking()) {
            return true;
        }
    }
    false
}

/// The columns of an `n x n` matrix.
fn dense(n: usize, entry: impl Fn(usize, usize) -> f64) -> Vec<f64> {
    (0..n * n).map(|at| entry(at % n, at / n)).collect()
}

/// True if the product of the largest eigenvalues of two positive definite matrices is below 1 by [`MARGIN`]. Estimates
/// from below tell which bounds may hold; factorisations show that they do.
fn have_product_below_one(matrices: [Matrix<'_>; 2], goes_on: GoesOn<'_>) -> bool {
    let found = matrices.each_ref().map(|matrix| largest_eigenvalue(matrix, goes_on));
    let [Some(normal), Some(tangential)] = found else { return false };
    let room = ((1.0 - MARGIN) / (normal * tangential)).sqrt();
    let mut is_small = |k: usize, largest: f64| is_below(&matrices[k], room * largest, goes_on);
    room > 1.0 && is_small(0, normal) && is_small(1, tangential)
}
