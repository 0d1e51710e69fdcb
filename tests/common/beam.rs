//! The lower fibre of a beam of length 1 that is clamped at both ends: bodies of large condition numbers, 1e7 to 1e9.

/// Its stiffness for so many pairs in the plane, column-major: it bends by second differences of the deflections `w`, and its axis is
/// stretched by first differences of `u + h/2 w'`.
pub fn beam(pairs: usize, height: f64) -> Vec<f64> {
    let (n, step) = (2 * pairs, 1.0 / (pairs + 1) as f64);
    let bending = height.powi(2) / 12.0;
    let mut k = vec![0.0; n * n];
    let mut add = |weight: f64, terms: &[(isize, usize, f64)]| {
        let inside = |node: isize| (1..=pairs as isize).contains(&node);
        let terms: Vec<(usize, f64)> = (terms.iter())
            .filter(|(node, ..)| inside(*node))
            .map(|(node, component, part)| (2 * (*node as usize - 1) + component, *part))
            .collect();
        for (i, a) in &terms {
            terms.iter().for_each(|(j, b)| k[i + n * j] += weight * a * b);
        }
    };
    for node in 0..=pairs as isize + 1 {
        let curvature = [-1, 0, 1].map(|to| (node + to, 0, if to == 0 { -2.0 } else { 1.0 }));
        add(bending / step.powi(3), &curvature);
    }
    for node in 0..=pairs as isize {
        let half = height / 2.0;
        let stretched = [(node, 1, -1.0), (node + 1, 1, 1.0)];
        let turned = [(node - 1, 0, half), (node, 0, -half), (node + 1, 0, -half)];
        let last = [(node + 2, 0, half)];
        let turned = turned.iter().chain(&last).map(|(i, c, part)| (*i, *c, part / (2.0 * step)));
        let terms: Vec<_> = stretched.into_iter().chain(turned).collect();
        add(1.0 / step, &terms);
    }
    k
}
