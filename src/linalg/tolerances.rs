//! The sizes below which a number is taken for zero, each idea with one number.
//!
//! | name | size | what is zero below it |
//! |---|---|---|
//! | [`ROUNDING`] | 1e-14 | one sum, beside its terms: about 50 units of double precision |
//! | [`NEGLIGIBLE`] | 1e-11 | the result of a factorisation or of thousands of sums, beside its largest entry; a host's own condensation leaves 1e-13 where a zero should be |
//! | [`LEAST_WORK`] | 1e-9 | the work that a proof needs, beside what its motion could do |
//! | [`SINGULAR`] | 1e-12 | a pivot of an unscaled `LU` beside the largest pivot |
//! | [`SINGULAR_BASIS`] | 2.2e-16 | a pivot of the `LU` of a basis of Lemke's method, whose values are refined on the data afterwards |
//! | [`SUSPICIOUS_PIVOT`] | 1e-8 | nothing yet: a closer look is taken |
//!
//! [`SINGULAR`] lies below [`NEGLIGIBLE`] because a pivot of `LU` is no eigenvalue: systems with the
//! condition number 1e10, the largest that can be certified, have pivots of 1e-10 and slightly less.

/// What rounding leaves of a sum that should be zero, relative to its terms.
pub const ROUNDING: f64 = 1e-14;

/// What rounding leaves of a zero after a factorisation, relative to the largest entry: 100 times the
/// 1e-13 that a host's condensation leaves, and below the stiffness of anything that can be certified.
pub const NEGLIGIBLE: f64 = 1e-11;

/// Pivots below this part of the largest make a matrix singular: well above what rounding leaves of
/// a zero, so that units do not decide, and below those of anything certifiable.
pub const SINGULAR: f64 = 1e-12;

/// A relative pivot of an unpivoted Cholesky factorisation, of a scaled matrix, below which the matrix
/// may be singular. Without pivoting a small pivot says less: a closer look decides.
pub const SUSPICIOUS_PIVOT: f64 = 1e-8;

/// The same for a basis of Lemke's method. Iterative refinement on the data follows, so that only a
/// basis that is singular to the last digit is lost.
pub const SINGULAR_BASIS: f64 = f64::EPSILON;

/// Least work of a motion in a proof, relative to what a motion of its size could do: 100 times the
/// rounding that is allowed in the motion ([`NEGLIGIBLE`]), so that the rounding cannot make up for it.
pub const LEAST_WORK: f64 = 100.0 * NEGLIGIBLE;
