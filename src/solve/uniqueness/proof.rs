//! A proof that the solution is unique.
//!
//! For positive definite `K` the solutions with given thresholds `g` and `g'` differ by at most
//! `|v - v'|_K <= sqrt(L_t) |X⁻¹ (g - g')|`, `L_t` the largest eigenvalue of `X W_tt X` with
//! `W = K⁻¹` and any diagonal `X > 0`; pressures follow with
//! `|X⁻¹ mu (p - p')| <= sqrt(L_n) |v - v'|_K`, `L_n` that of `X⁻¹ mu K_nn mu X⁻¹`. If `L_n L_t < 1`
//! the map `g -> mu p` is a contraction, and Coulomb's problem has one solution. With uniform `mu`
//! and `X = 1` this is `mu < 1 / sqrt(|K_nn| |W_tt|)`.

use super::difference::MARGIN;
use crate::law::Contact;
use crate::linalg::factor::{Factor, largest_eigenvalue};

/// The factor of `K`, scaled to a unit diagonal, if it is positive definite.
pub fn scaled_factor(contact: &Contact<'_>) -> Option<Factor> {
    let matrix = contact.problem().stiffness();
    let root = contact.problem().unit_roots();
    Factor::new(matrix.size(), true, |j, column| {
        for (i, (entry, k)) in column.iter_mut().zip(matrix.column(j)).enumerate() {
            *entry = k / (root[i] * root[j]);
        }
    })
}

/// Whether the solution is proved to be the only one: `K` is positive definite, and `g -> mu p` is
/// constant or, in the plane, a contraction.
pub fn is_unique(contact: &Contact<'_>) -> bool {
    let Some(mut factor) = scaled_factor(contact) else { return false };
    let laws = contact.pairs();
    let coupled: Vec<usize> = (0..laws.len()).filter(|&i| laws[i].is_coupled()).collect();
    if coupled.is_empty() {
        return true;
    }
    contact.dim() == 2 && is_contraction(contact, &mut factor, &coupled)
}

fn is_contraction(contact: &Contact<'_>, factor: &mut Factor, coupled: &[usize]) -> bool {
    let matrix = contact.problem().stiffness();
    let (n, m) = (matrix.size(), coupled.len());
    let mut flexibility = vec![0.0; n * m];
    for (column, &pair) in flexibility.chunks_exact_mut(n).zip(coupled) {
        column[2 * pair + 1] = 1.0;
    }
    factor.solve(&mut flexibility);
    let root = contact.problem().unit_roots();
    let mu: Vec<f64> = coupled.iter().map(|&pair| contact.pairs()[pair].bound().slope).collect();
    let compliance = |a: usize, b: usize| {
        let (i, j) = (2 * coupled[a] + 1, 2 * coupled[b] + 1);
        flexibility[i + n * b] / (root[i] * root[j])
    };
    let stiffness = |a: usize, b: usize| mu[a] * matrix.at(2 * coupled[a], 2 * coupled[b]) * mu[b];
    // Three diagonals X: those that scale either matrix to a unit diagonal, and the one between.
    let scales: [&dyn Fn(usize) -> f64; 3] =
        [&|a| stiffness(a, a).sqrt(), &|a| compliance(a, a).sqrt().recip(), &|a| {
            (stiffness(a, a) / compliance(a, a)).sqrt().sqrt()
        }];
    scales.iter().any(|x| {
        let normal = largest_eigenvalue(m, |a, b| stiffness(a, b) / (x(a) * x(b)));
        let tangential = largest_eigenvalue(m, |a, b| compliance(a, b) * x(a) * x(b));
        matches!((normal, tangential), (Some(l), Some(k)) if l * k < 1.0 - MARGIN)
    })
}
