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
/// matrix may be singular. A small pivot proves nothing, as slender parts are weak and held (the tip of
/// a cantilever of 1 : 5000 resists with 2e-12 of its elements). The null vector itself decides, by
/// [`NULL_VECTOR`].
pub const SUSPICIOUS_PIVOT: f64 = 1e-8;

/// Added to the diagonal of a singular matrix, relative to it, so that it has a factor by which inverse
/// iteration finds the null vector: far above rounding, far below the eigenvalues of weak parts that are
/// held (1e-7, measured).
pub const REGULARISATION: f64 = 1e-10;

/// Steps of inverse iteration to a null vector. A step divides the part of another eigenvector by its
/// eigenvalue (weak parts that are held: 1e-7) over the smallest one. That is rounding, 1e-16, where
/// [`NULL_VECTOR`] decides: two steps leave 1e-18. It is [`REGULARISATION`] where the matrix is known to
/// be singular and the vector is only described: two steps leave 1e-6.
pub const INVERSE_ITERATIONS: usize = 2;

/// `x` is a null vector of `A` if the entries of `A x` are below this part of their largest terms: ten
/// roundings. Weak parts of structures that supports hold have 1e-7, free parts 4e-16 (measured).
pub const NULL_VECTOR: f64 = 10.0 * f64::EPSILON;

/// A sum of terms that should cancel is zero below this part of the sum of their sizes: terms that
/// a host has computed in doubles, a few thousand operations each (1e-16 an operation).
pub const ROUNDING_OF_SUM: f64 = 1e-12;
