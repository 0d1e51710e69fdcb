//! When a number is zero beside others: the thresholds of "singular" and of "rounding" in one place.
//!
//! Each is relative to what the last column names, so that units do not matter. From the largest to
//! the smallest:
//!
//! | threshold | number | question | relative to |
//! |---|---|---|---|
//! | [`SUSPICIOUS_PIVOT`] | 1e-8 | may the sparse matrix have a null vector? then test one | its diagonal |
//! | [`REGULARISATION`] | 1e-10 | what is added to a singular matrix to find its null vector | its diagonal |
//! | [`ROUNDING_OF_SUM`] | 1e-12 | is a sum of terms that should cancel zero? | the sum of their sizes |
//! | [`NULL_VECTOR`] | 2.2e-15 | is `A x` zero, so that `x` is a null vector? | the terms of the sums in `A x` |

/// Pivots of a sparse Cholesky factorisation below this part of the diagonal raise suspicion: the
/// matrix may be singular. A small pivot proves nothing: a slender cantilever has 2e-12. The null
/// vector itself decides, by [`NULL_VECTOR`].
pub const SUSPICIOUS_PIVOT: f64 = 1e-8;

/// Added to the diagonal of a singular matrix, relative to it, so that inverse iteration can find the
/// null vector: far above rounding, and so far below any stiffness that two steps suffice.
pub const REGULARISATION: f64 = 1e-10;

/// Steps of inverse iteration to a null vector. The first one divides the other eigenvectors by at
/// least 1e5 against the null vector (their eigenvalues are 1e-5 and more, the regularisation 1e-10),
/// the second one by as much again: 1e-10, below what [`NULL_VECTOR`] can see.
pub const INVERSE_ITERATIONS: usize = 2;

/// `x` is a null vector of `A` if the entries of `A x` are below this part of their largest terms: ten
/// roundings. Weak parts of structures that supports hold have 1e-7, free parts 4e-16 (measured).
pub const NULL_VECTOR: f64 = 10.0 * f64::EPSILON;

/// A sum of terms that should cancel is zero below this part of the sum of their sizes: terms that
/// a host has computed in doubles, a few thousand operations each (1e-16 an operation).
pub const ROUNDING_OF_SUM: f64 = 1e-12;
