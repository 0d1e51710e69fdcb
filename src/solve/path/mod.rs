//! Paths of solutions that lead to a solution of the problem, for every `mu`: in space from any start.
//!
//! In the plane the path is piecewise linear: `linear`, with theorems of its own (G to K), which moves the
//! load alone. In space it is piecewise analytic: `curved`, with its homotopy, and `curve`, which follows it.
//!
//! # What is proved
//!
//! Let `alpha |x|^2 <= x.K x` for all `x`, `alpha > 0`; `K` need not be symmetric. `mu >= 0`, loads, gaps
//! and reference slips are any. Coordinates are scaled so that `k = 1` (`law::normal_map`), `N` is their
//! number, `v = d - (gap, slip0)`, `r = f - K (gap, slip0)`, and `y0` is any point. With
//! `K_s = s K + (1 - s)` and `r_s = s r + (1 - s) y0` the homotopy is
//!
//! ```text
//! H_s(y) = K_s v(y) + P(y) - r_s,    0 <= s <= 1;    H_0 = y - y0,    H_1 = 0 is the contact problem
//! ```
//!
//! **(W)** At every `y`, `v.P = sum g |delta| >= 0`: `v_n p = 0`, and where `delta` is not zero it has the
//! direction of `tau`, and `|tau| = g`. Only `y = v + P`, a continuous semialgebraic `P`, and (W) are used
//! in A, B and C: they hold for any bound `g = mu p + b`, `b >= 0`, for ellipses, and for any rule of slip
//! with `delta.tau >= 0`.
//!
//! **Theorem A.** `H_1` has a zero, and degree +1 on every large ball.
//!
//! *Proof.* Let `H_s(y) = 0`. Multiplied by `v`, `v.K_s v + v.P = v.r_s`, so that by (W)
//! `min(alpha, 1) |v| <= |r_s|`, and `|P| <= |r_s| + |K_s| |v|`: all zeros, for all `s`, lie in one ball.
//! `H_0` has the degree +1, which homotopy keeps. ∎
//!
//! **Theorem B.** A continuous path of zeros leads from `(y0, 0)` to some `(y*, 1)`, `H_1(y*) = 0`. It is
//! semialgebraic: of finite length, over finitely many pieces.
//!
//! *Proof.* The set of zeros is compact by A, and semialgebraic; at `s = 0` it is one point. If the
//! connected component of that point did not reach `s = 1`, Whyburn's lemma would give an open set around
//! it with no zero on its boundary and none at `s = 1`; the degree of `H_s` on its slices would be the
//! same for all `s`, but it is 1 at `s = 0` and 0 at `s = 1`. Components of semialgebraic sets are
//! connected by semialgebraic paths. ∎
//!
//! **Theorem C.** For almost every `y0` the zeros with `s < 1` form a one-dimensional manifold of finitely
//! many analytic arcs. An arc crosses the boundary of a piece transversally, one pair at a time, and
//! exactly one arc goes on in the next piece. The curve from `(y0, 0)` does not close, does not branch, does
//! not return to `s = 0`, and so tends to `s = 1`. With `t` its direction, `det [dH; t']` is positive
//! on all of it: `ds` has the sign of `det J`, `J = dH_s/dy`, and at a regular end `det J > 0`.
//!
//! *Proof.* `dH/dy0 = -(1 - s)` is onto for `s < 1`. By Sard's theorem on each of the finitely many strata
//! zero is a regular value for almost all `y0`: strata of the dimension `N + 1` carry arcs, those of `N`
//! isolated points, the others nothing. At a point on the common boundary `T` of the pieces A and B,
//! `dH` on `T` is invertible, so that the kernels of `dH_A` and `dH_B` cross `T`: one half of an arc on
//! either side. `H_A = H_B` on `T` gives `dH_B = dH_A + a n'` with `n` normal to `T`, hence
//! `det [dH_A; n'] = det [dH_B; n']`; for `t` in the kernel `det [dH; n'] = (n.t / |t|^2) det [dH; t']`, and
//! `n.t > 0` on both sides. At `s = 0`, `J = 1`. ∎
//!
//! **Theorem D.** If all solutions are regular, the signs of their `det J` add up to +1. Their number is odd,
//! and a solution with `det J < 0` is one of at least three. (A, and the degree as a sum.)
//!
//! **Theorem E.** With given thresholds (`g` does not depend on `p`) there is one solution, `det J > 0` on
//! every piece, and `s` grows along the whole path.
//!
//! *Proof.* `D = dP/dy` is symmetric with `0 <= D <= 1` and commutes with `V = 1 - D`. Let `J x = 0` and
//! `a = V x`: `K_s a = -D x`, so that `a.K_s a = -x.V D x <= 0`, `a = 0`, `D x = 0`, and `x = 0`. ∎
//!
//! **Theorem F.** `K` symmetric and semi-definite: `K_s` is definite for `s < 1`, and the curve exists
//! there. Either it stays bounded and ends at a solution; or there is a limit `e` of `v / |v|`, with
//! `K e = 0`, `e_n <= 0` and `f.e >= lim ((1 - s) |v| + sum mu p |e_t|) >= 0` (the work equation of A,
//! divided by `|v|`). So if `f.e < 0` for every rigid motion `e` with `e_n <= 0`, a solution exists for
//! every `mu`, and the path finds it. That it runs away does not prove that there is none: what does is
//! [`crate::certificate::is_escape`], and `rigid` looks for it before a path begins.
//!
//! # Limits
//!
//! The number of steps has no polynomial bound. Rounding, or a step that is too long, may lead to another
//! branch of zeros, or off it; then the next start is tried, and the certificate decides. The start is
//! perturbed, because symmetric meshes have ties, which C excludes for almost every `y0` only.

mod curve;
mod curved;
mod homotopy;
mod linear;
mod linear_start;
mod linear_walk;

pub use curved::{curved, ends};
pub use linear::linear;
