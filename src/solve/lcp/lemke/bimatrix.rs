//! LCPs of bimatrix games, for which no covering vector leads to a solution.
//!
//! Let the variables be of two kinds, `M = [0 A; B 0]` with `A, B > 0` and any order of the variables, and let `q` have
//! a negative entry of each kind. With `q = -1` the solutions are the equilibria of the game with the costs `A` and `B`
//! (Cottle, Pang and Stone, 1.4). `M` is copositive, and yet Lemke's method ends in a ray at its first pivot, whatever
//! the covering vector: `z` of one kind can grow for ever, and proves nothing. The path of Lemke and Howson (1964)
//! drops the condition of one variable instead, its label `k` with `q_k < 0`: `w_k` and `z_k` may both be positive. It
//! starts on a ray: `z_k` at the least value that makes `w` of the other kind non-negative, so that one of these, `w_j`,
//! is 0, and `z_j` large.
//!
//! **Theorem.** The lexicographic path ends at a solution.
//!
//! *Proof.* It does not cycle, so it ends where `w_k z_k = 0`, which is a solution, or on a ray with a direction
//! `z' >= 0` other than that of its start. Let `x` be the variables of the kind of `k`, and `y` the others. If `y'` is
//! not zero, `A y' > 0`: on the ray no `x_i` but `z_k` is positive. Some `y_j` grows, so that its `w_j = q_j + B_jk z_k`
//! is zero: `z_k` is the least value with `w >= 0`, and with perturbed `q` there is one such `j`. This is the ray of the
//! start. If `y' = 0`, `B x' > 0`: on the ray `y = 0`, and all `w` of the kind of `k` are those of `q`. One of these is
//! negative. ∎

use crate::linalg::matrix::Matrix;

/// The label that the path of a bimatrix game may lack; `None` for any other LCP, or one without a solution.
pub fn missing_label(matrix: &Matrix<'_>, q: &[f64]) -> Option<usize> {
    if q.is_empty() {
        return None;
    }
    let first = matrix.column(0);
    let is_game = || {
        (0..q.len()).all(|j| {
            let entries = matrix.column(j).iter().zip(first);
            // The first variable is of the kind whose entries in its column are zero.
            entries.into_iter().all(|(&entry, &of_first)| {
                let joins_kinds = (of_first == 0.0) != (first[j] == 0.0);
                if joins_kinds { entry > 0.0 } else { entry == 0.0 }
            })
        })
    };
    let label = (0..q.len()).find(|&i| q[i] < 0.0 && first[i] == 0.0)?;
    let is_bound = (0..q.len()).any(|i| q[i] < 0.0 && first[i] != 0.0);
    (is_bound && is_game()).then_some(label)
}
