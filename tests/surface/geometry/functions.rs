//! Shape functions of faces, and the basis in which every node carries pressure.

use super::control::Basis;
use super::shape::FaceKind::{self, Line2, Line3, Q4, Q8, Q9, T3, T6};

/// One at its own node and zero at the others; the sum is one, and the derivatives are those of
/// differences (step 1e-5: error 1e-10 of a cubic, rounding 1e-11).
#[test]
fn functions_are_those_of_their_nodes() {
    for kind in [Line2, Line3, T3, T6, Q4, Q8, Q9] {
        for (i, &place) in kind.places().iter().enumerate() {
            let values = kind.values(place);
            for (j, value) in values.iter().enumerate() {
                assert_eq!(*value, if i == j { 1.0 } else { 0.0 }, "{kind:?}, {i}, {j}");
            }
        }
        let at = [0.21, if kind.is_line() { 0.0 } else { 0.37 }];
        let sum: f64 = kind.values(at).iter().sum();
        assert!((sum - 1.0).abs() < 1e-15, "{kind:?}");
        for c in 0..if kind.is_line() { 1 } else { 2 } {
            let step = |h: f64| {
                let mut at = at;
                at[c] += h;
                kind.values(at)
            };
            let (up, down) = (step(1e-5), step(-1e-5));
            for (i, exact) in kind.derivatives(at).iter().enumerate() {
                let slope = (up[i] - down[i]) / 2e-5;
                assert!((slope - exact[c]).abs() < 1e-9, "{kind:?}, {i}, {c}");
            }
        }
        assert_eq!(kind.values(at), kind.functions(at).map(|[value, _, _]| value));
    }
}

/// Monomials of the list are combinations of the functions, with their values at the nodes.
#[test]
fn functions_span_their_monomials() {
    for kind in [Line2, Line3, T3, T6, Q4, Q8, Q9] {
        let at = [0.3, if kind.is_line() { 0.0 } else { 0.45 }];
        for exponents in kind.exponents() {
            let monomial = |p: [f64; 2]| p[0].powi(exponents[0]) * p[1].powi(exponents[1]);
            let values = kind.values(at);
            let sum: f64 =
                kind.places().iter().zip(values).map(|(&p, value)| monomial(p) * value).sum();
            assert!((sum - monomial(at)).abs() < 1e-15, "{kind:?}, {exponents:?}");
        }
    }
}

/// `Σ N̂ û = Σ N u` for any values, so the two are the same function, and `Σ N̂ = 1`.
#[test]
fn the_changed_basis_gives_the_same_functions() {
    let u = [0.3, -1.2, 0.7, 2.0, -0.4, 0.9, 1.1, -0.8, 0.6];
    for kind in [FaceKind::Line3, FaceKind::T6, FaceKind::Q8, FaceKind::Q9] {
        for spreads in [false, true] {
            let basis = Basis { kind, alpha: [0.2, 0.25, 0.375, 0.1], spreads };
            let n = kind.values([0.21, if kind.is_line() { 0.0 } else { 0.37 }]);
            let sum = |n: [f64; 9], u: [f64; 9]| -> f64 {
                n[..kind.nodes()].iter().zip(u).map(|(n, u)| n * u).sum()
            };
            let (changed, values) = (basis.functions(n), basis.control_values(u));
            assert!((sum(changed, values) - sum(n, u)).abs() < 1e-14, "{kind:?}");
            assert!((sum(changed, [1.0; 9]) - 1.0).abs() < 1e-15, "{kind:?}");
        }
    }
}
