//! The sizes below which a number is taken for zero, each idea with one number.
//!
//! Each is relative to the quantity in the last column, so that units do not matter.
//!
//! | name | size | what is decided | relative to |
//! |---|---|---|---|
//! | [`MOVING`] | 1e-6 | does a component move, so that a sentence names it? | the largest displacement |
//! | [`SUSPICIOUS_PIVOT`] | 1e-8 | may the matrix be singular? then look closer | its diagonal |
//! | [`AGREES`] | 1e-9 | do numbers that a host gives twice agree? | their sizes |
//! | [`LEAST_WORK`] | 1e-9 | do the loads do work on a motion, so that it is a proof? | what they could do |
//! | [`REGULARISATION`] | 1e-10 | what is added to a singular matrix to find its null vector | its diagonal |
//! | [`NEGLIGIBLE`] | 1e-11 | is the result of a factorisation, or of thousands of sums, zero? | its largest entry |
//! | [`SINGULAR`] | 1e-12 | is a dense matrix singular? | the largest pivot |
//! | [`ROUNDING_OF_SUM`] | 1e-12 | is a sum of a host's terms that should cancel zero? | the sum of their sizes |
//! | [`CONDENSATION`] | 3e-12 | what is the rounding of an energy in a host's condensed matrix? | the stiffness of its pairs |
//! | [`UNRESISTED`] | 1e-13 | is a component's own stiffness no unit for it? | the largest of its pair |
//! | [`ROUNDING`] | 1e-14 | is one sum of the library's own terms zero? | its terms |
//! | [`NULL_VECTOR`] | 2.2e-15 | is `A x` zero, so that `x` is a null vector of a sparse `A`? | the terms of its sums |
//! | [`FREE`], [`HELD`] | 3, 100 | is a motion free, or held? between them neither can be told | the rounding of its energy |
//! | [`FEW_OPERATIONS`] | 1.8e-15 | what is the rounding of a number that some ten operations give? | their terms |
//! | [`SINGULAR_BASIS`] | 2.2e-16 | is a basis of Lemke's method singular? | the largest pivot |
//!
//! [`SINGULAR`] lies below [`NEGLIGIBLE`] because a pivot of `LU` is no eigenvalue: systems with the
//! condition number 1e10, the largest that can be certified, have pivots of 1e-10 and slightly less.
//! [`SINGULAR_BASIS`] lies at the last digit because iterative refinement on the data follows.

/// Numbers that a host gives twice, across the diagonal, as weights that sum to 1 or in rows that repeat others, agree up
/// to this, relative to their sizes: far above the rounding of a condensation (measured 1e-13 from CalculiX and MUMPS) and of
/// tables with ten digits, far below a slip of indices and what a certificate of 1e-10 can bear.
pub const AGREES: f64 = 1e-9;

/// Rounding that is left of a sum that should be zero, relative to its terms: about 50 units of double
/// precision.
pub const ROUNDING: f64 = 1e-14;

/// An entry of a factorised matrix that should be zero, relative to the largest entry. A host's condensation leaves
/// 1e-13 of it: the limit is 100 times that, and below the stiffness of anything that can be certified.
pub const NEGLIGIBLE: f64 = 1e-11;

/// Pivots below this part of the largest make a matrix singular: well above what rounding leaves of
/// a zero, so that units do not decide, and below those of anything certifiable.
pub const SINGULAR: f64 = 1e-12;

/// Pivots below this part of the largest make a basis of Lemke's method singular: only one that is singular to the last
/// digit is lost.
pub const SINGULAR_BASIS: f64 = f64::EPSILON;

/// Least work of a motion in a proof, relative to what a motion of its size could do: 100 times the
/// rounding that is allowed in the motion ([`NEGLIGIBLE`]), so that the rounding cannot make up for it.
pub const LEAST_WORK: f64 = 100.0 * NEGLIGIBLE;

/// Pivots of an unpivoted Cholesky factorisation below this part of the diagonal raise suspicion: the
/// matrix may be singular. A small pivot proves nothing, as slender parts are weak and supported (the tip of
/// a cantilever of 1 : 5000 resists with 2e-12 of its elements). A factorisation with pivoting, or
/// the null vector itself, decides.
pub const SUSPICIOUS_PIVOT: f64 = 1e-8;

/// Added to the diagonal of a singular matrix, relative to it, so that it has a factor by which inverse
/// iteration finds the null vector: far above rounding, far below the eigenvalues of weak parts with
/// supports (1e-7, measured).
pub const REGULARISATION: f64 = 1e-10;

/// The rounding of the energy of a motion that a condensed matrix has, relative to the stiffness of the pairs
/// that it moves: what a host's condensation leaves, of which the matrix itself does not tell. Of 10,000
/// random bodies on two or three points half left less than 4e-14, 99 % less than 2e-12, and a flat one the
/// most, 5.4e-12, which [`FREE`] still takes for rounding. Across the tip of a cantilever of 1 : 5000 the
/// energy is 1e-8.
pub const CONDENSATION: f64 = 3e-12;

/// A motion is free if its energy is at most so many times the rounding of that energy. Free motions of
/// single bodies and of stacks have up to 0.64 (measured).
pub const FREE: f64 = 3.0;

/// A motion is held if its energy is at least so many times the rounding of that energy. Springs of 1e-12 of
/// the stiffness of a body have about 50 (measured): they cannot be told from rounding.
pub const HELD: f64 = 100.0;

/// Below this part of the largest diagonal entry of its pair the diagonal entry of a component is no unit
/// of force per length for it: forces in this unit would not show its penetration. Slender parts that are
/// supported have 2e-12 (a cantilever of 1 : 5000).
pub const UNRESISTED: f64 = 1e-13;

/// Displacements below this part of the largest one are not counted as moving in a sentence: an iteration to a motion
/// leaves up to this where nothing moves ([`INVERSE_ITERATIONS`]).
pub const MOVING: f64 = 1e-6;

/// Steps of inverse iteration to a null vector. A step divides the part of another eigenvector by its
/// eigenvalue (weak parts with supports: 1e-7) over the smallest one. That is rounding, 1e-16, where
/// [`NULL_VECTOR`] decides: two steps leave 1e-18. It is [`REGULARISATION`] where the matrix is known to
/// be singular and the vector is only described: two steps leave 1e-6.
pub const INVERSE_ITERATIONS: usize = 2;

/// `x` is a null vector of `A` if the entries of `A x` are below this part of their largest terms: ten
/// roundings. Weak parts of structures that supports hold have 1e-7, free parts 4e-16 (measured).
pub const NULL_VECTOR: f64 = 10.0 * f64::EPSILON;

/// Rounding of some ten operations, half a unit each, relative to their terms.
pub const FEW_OPERATIONS: f64 = 8.0 * f64::EPSILON;

/// A sum of terms that should cancel is zero below this part of the sum of their sizes: terms that
/// a host has computed in doubles, a few thousand operations each (1e-16 an operation).
pub const ROUNDING_OF_SUM: f64 = 1e-12;
