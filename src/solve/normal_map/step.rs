//! Newton's step on the normal map, condensed on the components that move.
//!
//! With `dP/dy` of each pair's branch, `J dy = -H` is reduced to the normal components of open pairs and
//! the tangential ones of slipping pairs and of pairs without friction. A slipping pair has the unknown
//! `x` with `dy_t = k x + drag dp`; `drag = dtau/dp` and `T = dtau/dy_t` have `T drag = 0` under every law,
//! so that
//!
//! ```text
//! dd_t = k⁻¹ (1 - T) k x,   dtau = drag dp + T k x,   dp = -(H + K dd)_n
//! (K dd)_t - drag (K dd)_n + T k x = -H_t + drag H_n
//! ```
//!
//! Under Coulomb's law `drag = mu h` and `T = q (1 - h hᵀ)` with the slip's direction `h` and
//! `q = g / |y_t|`. Nothing is divided by the slip.

use super::point::Point;
use crate::law::{Block, Contact, PairLaw, Plane, Vector, ellipse};
use crate::linalg::factor::Factor;
use crate::linalg::matrix::Matrix;

/// An unknown of the condensed system.
struct Unknown {
    /// Its component.
    component: usize,
    /// Its pair and its tangential number, if it is tangential.
    tangential: Option<(usize, usize)>,
}

/// What `dP/dy` says of a pair.
#[derive(Clone, Copy)]
struct Pair {
    /// Normal component of the pair; the tangential ones follow.
    normal: usize,
    tangents: usize,
    /// Whether the pressure follows `y`, and not the displacement.
    is_closed: bool,
    /// `dtau/dp`, zero without slip and of an open pair.
    drag: [f64; 2],
    /// `k⁻¹ (1 - T) k`: zero if the pair sticks.
    moves: Plane,
    /// `T k`.
    turns: Plane,
}

impl Pair {
    fn new(law: &PairLaw, derivative: &Block, normal: usize, tangents: usize) -> Self {
        let [_, [first, a, b], [second, c, d]] = *derivative;
        let turned = [[a, b], [c, d]];
        Pair {
            normal,
            tangents,
            is_closed: derivative[0][0] == 1.0,
            drag: [first, second],
            moves: law.moves(&turned),
            turns: ellipse::times(&turned, &law.tangential_scale()),
        }
    }

    /// Whether the pair moves along its tangents at all.
    fn moves_along(&self) -> bool {
        self.moves != [[0.0; 2]; 2]
    }
}

/// The system of a point.
pub struct System<'p> {
    matrix: Matrix<'p>,
    unknowns: Vec<Unknown>,
    pairs: Vec<Pair>,
}

impl<'p> System<'p> {
    /// The system of the branches at a point.
    pub fn new(contact: &'p Contact<'p>, point: &Point) -> Self {
        let (dim, matrix) = (contact.dim(), contact.problem().stiffness());
        let (mut unknowns, mut pairs) = (Vec::new(), Vec::with_capacity(point.y.len()));
        for (at, (law, y)) in contact.pairs().iter().zip(&point.y).enumerate() {
            let pair = Pair::new(law, &law.derivative(y), dim * at, dim - 1);
            if !pair.is_closed {
                unknowns.push(Unknown { component: pair.normal, tangential: None });
            }
            if pair.moves_along() {
                unknowns.extend((0..pair.tangents).map(|c| Unknown {
                    component: pair.normal + 1 + c,
                    tangential: Some((at, c)),
                }));
            }
            pairs.push(pair);
        }
        System { matrix, unknowns, pairs }
    }

    /// `(K dd)_i` for a unit of unknown `j`.
    fn moved(&self, i: usize, j: &Unknown) -> f64 {
        let Some((pair, c)) = j.tangential else { return self.matrix.at(i, j.component) };
        let pair = &self.pairs[pair];
        (0..pair.tangents)
            .map(|row| pair.moves[row][c] * self.matrix.at(i, pair.normal + 1 + row))
            .sum()
    }

    /// Coefficient of unknown `j` in the equation of unknown `i`.
    fn entry(&self, i: &Unknown, j: &Unknown) -> f64 {
        let own = self.moved(i.component, j);
        let Some((at, c)) = i.tangential else { return own };
        let pair = &self.pairs[at];
        let turned = match j.tangential {
            Some((other, column)) if other == at => pair.turns[c][column],
            _ => 0.0,
        };
        own - pair.drag[c] * self.moved(pair.normal, j) + turned
    }

    /// Newton's step from the point; `None` if the system is singular. `root` holds the roots of the
    /// diagonal of `K`.
    pub fn step(&self, contact: &Contact<'_>, point: &Point, root: &[f64]) -> Option<Vec<Vector>> {
        let scale: Vec<f64> =
            self.unknowns.iter().map(|unknown| root[unknown.component].recip()).collect();
        let mut factor = Factor::new(self.unknowns.len(), false, |j, column| {
            for (i, entry) in column.iter_mut().enumerate() {
                *entry = scale[i] * self.entry(&self.unknowns[i], &self.unknowns[j]) * scale[j];
            }
        })?;
        let side = |unknown: &Unknown| {
            let dragged = unknown.tangential.map_or(0.0, |(pair, c)| {
                self.pairs[pair].drag[c] * point.lack[self.pairs[pair].normal]
            });
            dragged - point.lack[unknown.component]
        };
        let mut x: Vec<f64> = self
            .unknowns
            .iter()
            .zip(&scale)
            .map(|(unknown, scale)| scale * side(unknown))
            .collect();
        factor.solve(&mut x);
        x.iter_mut().zip(&scale).for_each(|(x, scale)| *x *= scale);
        x.iter().all(|x| x.is_finite()).then(|| self.coordinates(contact, point, &x))
    }

    /// `dy` from the unknowns `x`.
    fn coordinates(&self, contact: &Contact<'_>, point: &Point, x: &[f64]) -> Vec<Vector> {
        let mut free = vec![0.0; self.matrix.size()];
        for (unknown, x) in self.unknowns.iter().zip(x) {
            free[unknown.component] = *x;
        }
        let mut moved = free.clone();
        for pair in &self.pairs {
            let first = pair.normal + 1;
            for row in 0..pair.tangents {
                moved[first + row] =
                    (0..pair.tangents).map(|c| pair.moves[row][c] * free[first + c]).sum();
            }
        }
        let mut reaction: Vec<f64> = point.lack.iter().map(|lack| -lack).collect();
        let opposite: Vec<f64> = moved.iter().map(|d| -d).collect();
        self.matrix.add_product(&opposite, &mut reaction);
        let coordinates = |(law, pair): (&PairLaw, &Pair)| {
            let (n, scale) = (pair.normal, law.tangential_scale());
            let mut dy = [0.0; 3];
            dy[0] = if pair.is_closed { reaction[n] } else { law.normal_scale() * moved[n] };
            let x = &free[n + 1..n + 1 + pair.tangents];
            for c in 0..pair.tangents {
                let scaled: f64 = scale[c].iter().zip(x).map(|(k, x)| k * x).sum();
                dy[1 + c] = match pair.moves_along() {
                    true => scaled + pair.drag[c] * dy[0],
                    false => reaction[n + 1 + c],
                };
            }
            dy
        };
        contact.pairs().iter().zip(&self.pairs).map(coordinates).collect()
    }
}
