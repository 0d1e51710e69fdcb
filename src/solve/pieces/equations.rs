//! The equations `K d - f + P = 0` with `(d, P)` on the law of each pair, and a point of them.

use std::borrow::Cow;

use super::before::Before;
use crate::law::Piece;
use crate::law::{Contact, Linearised, PairLaw, Vector, natural_sum, scale_roots};
use crate::linalg::matrix::Matrix;
use crate::linalg::vector::{norm, norm_of, opposite};
use crate::linalg::watched::written;
use crate::problem::{BoundedLcp, Remembered};

/// The equations of some pairs: of a whole problem, or of what is left of one when others are
/// eliminated.
pub struct Equations<'a> {
    /// Components of a pair.
    pub dim: usize,
    /// `K`.
    pub matrix: Matrix<'a>,
    /// True if `K` is symmetric.
    pub symmetric: bool,
    /// `f`.
    pub load: Cow<'a, [f64]>,
    /// The laws, pair by pair; none of the variables of a complementarity problem.
    pub laws: Cow<'a, [PairLaw]>,
    /// Roots of the stiffnesses that scale the components: `y / root` and `root d` are of one unit.
    pub root: Vec<f64>,
    /// Size of the loads of the whole problem, as `eta` measures it; a force.
    pub unit: f64,
    /// The memory that problems with this matrix share; `None`: the equations stand alone.
    pub remembered: Option<&'a Remembered>,
}

impl<'a> Equations<'a> {
    /// The equations of a whole problem.
    pub fn of(contact: &'a Contact<'a>) -> Self {
        let problem = contact.problem();
        let (load, laws) = (Cow::Borrowed(problem.load()), Cow::Borrowed(contact.pairs()));
        let matrix = problem.stiffness();
        let equations = Self::new(contact.dim(), matrix, load, laws, norm(problem.load()));
        let remembered = problem.remembered();
        Equations { symmetric: problem.is_symmetric(), remembered, ..equations }
    }

    /// The equations of `laws` with their symmetric matrix and load.
    pub fn new(
        dim: usize,
        matrix: Matrix<'a>,
        load: Cow<'a, [f64]>,
        laws: Cow<'a, [PairLaw]>,
        unit: f64,
    ) -> Self {
        let root = scale_roots(&laws, dim).collect();
        Equations { dim, matrix, symmetric: true, load, laws, root, unit, remembered: None }
    }

    /// The equations `M x + q = w` of a complementarity problem, each variable a pair of one component. They have
    /// coefficients alone, and no laws.
    pub fn of_lcp(lcp: &BoundedLcp<'a>) -> Self {
        let root = lcp.matrix.units(1).iter().map(|unit| unit.sqrt()).collect();
        let (load, laws) = (Cow::Borrowed(lcp.q), Cow::Borrowed([].as_slice()));
        let BoundedLcp { matrix, symmetric, remembered, .. } = *lcp;
        Equations { dim: 1, matrix, symmetric, load, laws, root, unit: norm(lcp.q), remembered }
    }

    /// Columns of `K / k - 1`, contiguous.
    pub fn change_columns(&self, components: &[usize]) -> Vec<f64> {
        written(Vec::new(), (self.root.len(), components.len()), |place, column| {
            let (i, unit) = (components[place], self.root[components[place]].powi(2));
            column.iter_mut().zip(self.matrix.column(i)).for_each(|(own, k)| *own = k / unit);
            column[i] -= 1.0;
        })
    }

    /// An entry of `K / k - 1`.
    pub fn change_entry(&self, i: usize, j: usize) -> f64 {
        self.matrix.at(i, j) / self.root[j].powi(2) - if i == j { 1.0 } else { 0.0 }
    }

    /// `K d - f`.
    pub fn force(&self, d: &[f64]) -> Vec<f64> {
        self.matrix.product_less(d, &self.load)
    }

    /// The pieces on which the coordinates `y` are.
    pub fn pieces(&self, y: &[Vector]) -> Vec<Piece> {
        self.laws.iter().zip(y).map(|(law, y)| law.piece(y)).collect()
    }

    /// The pairs on given pieces at the coordinates `y`, to first order.
    pub fn linearised(&self, pieces: &[Piece], y: &[Vector]) -> Vec<Linearised> {
        let places = self.laws.iter().zip(pieces.iter().zip(y));
        places.map(|(law, (&piece, y))| law.linearised(piece, y)).collect()
    }

    /// True if the law is linear on each piece: in the plane, and of complementarity problems.
    pub fn are_linear(&self) -> bool {
        self.dim < 3
    }

    /// The step on pieces of a linear law that moves displacements by `dd`: coordinates that do not move are `b - K dd`.
    pub fn step(&self, pairs: &[Linearised], b: &[f64], dd: Vec<f64>) -> Step {
        let (product, mut dy) = (self.matrix.product(&dd), dd.clone());
        for (at, (pair, own)) in pairs.iter().zip(dy.chunks_exact_mut(self.dim)).enumerate() {
            for (c, own) in own.iter_mut().enumerate().filter(|(c, _)| !pair.moves(*c)) {
                *own = b[self.dim * at + c] - product[self.dim * at + c];
            }
            pair.complete(own);
        }
        Step { dy, dd, product }
    }

    /// The coordinates of displacements and the force that they need.
    pub fn coordinates(&self, d: &[f64], force: &[f64]) -> Vec<Vector> {
        let parts = d.chunks_exact(self.dim).zip(force.chunks_exact(self.dim));
        self.laws.iter().zip(parts).map(|(law, (d, force))| law.chart(d, force)).collect()
    }

    /// Displacements and pushes at coordinates on given pieces.
    pub fn values(&self, pieces: &[Piece], y: &[Vector]) -> (Vec<f64>, Vec<f64>) {
        let size = self.root.len();
        let (mut d, mut push) = (vec![0.0; size], vec![0.0; size]);
        let parts = d.chunks_exact_mut(self.dim).zip(push.chunks_exact_mut(self.dim));
        for (((law, y), &piece), (d, push)) in self.laws.iter().zip(y).zip(pieces).zip(parts) {
            let p = law.push_on(piece, y);
            let moved = law.displacement(y, &p);
            for c in 0..self.dim {
                (d[c], push[c]) = (moved[c], p[c]);
            }
        }
        (d, push)
    }

    /// What a solution on pieces leaves, whose displacements `d` need `force`, from coordinates `y` that tell the forces of the
    /// law: the coordinates that tell `d`, too.
    pub fn before(&self, (pieces, y): (Vec<Piece>, &[Vector]), d: &[f64], force: &[f64]) -> Before {
        let (_, push) = self.values(&pieces, y);
        let y = self.coordinates(d, &opposite(&push));
        let (d, _) = self.values(&pieces, &y);
        let product = force.iter().zip(&*self.load).map(|(force, f)| force + f).collect();
        Before { pieces, d, product, y }
    }

    /// Length of a vector of forces, each in the unit of its component.
    pub fn length(&self, force: &[f64]) -> f64 {
        norm_of(force.iter().zip(&self.root).map(|(force, root)| force / root))
    }

    /// `eta` of displacements with the force that they need: as the certificate measures it.
    pub fn eta(&self, d: &[f64], force: &[f64]) -> f64 {
        let parts = d.chunks_exact(self.dim).zip(force.chunks_exact(self.dim));
        let pairs = self.laws.iter().zip(parts).map(|(law, (d, force))| (law, d, force));
        let size = natural_sum(pairs).root();
        if size == 0.0 { 0.0 } else { size / self.unit.max(norm(force)) }
    }
}

/// A step of Newton's method.
pub struct Step {
    /// The change of the coordinates.
    pub dy: Vec<f64>,
    /// That of the displacements, and its product with `K`, where the law is linear on each piece; otherwise nothing.
    pub dd: Vec<f64>,
    pub product: Vec<f64>,
}

/// A point of the law with its lack of equilibrium.
#[derive(Clone)]
pub struct Point {
    /// The coordinates, pair by pair.
    pub y: Vec<Vector>,
    /// The pieces on which they are.
    pub pieces: Vec<Piece>,
    /// Displacements.
    pub d: Vec<f64>,
    /// `K d - f`: the contact force that equilibrium needs.
    pub force: Vec<f64>,
    /// `H = K d - f + P`, zero at solutions.
    pub lack: Vec<f64>,
    /// Length of `H`.
    pub merit: f64,
}

impl Point {
    /// The point at `y`.
    pub fn new(equations: &Equations<'_>, y: Vec<Vector>) -> Self {
        Self::on(equations, equations.pieces(&y), y)
    }

    /// The point at `y` on given pieces.
    pub fn on(equations: &Equations<'_>, pieces: Vec<Piece>, y: Vec<Vector>) -> Self {
        Self::with_force(equations, (pieces, y), |_, d| equations.force(d))
    }

    /// The point after a part of a step, which is one from the pieces of this point.
    pub fn after(&self, equations: &Equations<'_>, step: &Step, part: f64) -> Self {
        let dim = equations.dim;
        let each = |(y, dy): (&Vector, &[f64])| {
            std::array::from_fn(|c| y[c] + dy.get(c).map_or(0.0, |dy| part * dy))
        };
        let y: Vec<Vector> = self.y.iter().zip(step.dy.chunks_exact(dim)).map(each).collect();
        Self::with_force(equations, (equations.pieces(&y), y), |pieces, d| {
            if step.product.is_empty() {
                return equations.force(d);
            }
            // Beyond the pieces of this point displacements are others than the step tells.
            let mut beyond = vec![0.0; d.len()];
            let changed = (0..pieces.len()).filter(|&pair| pieces[pair] != self.pieces[pair]);
            for i in changed.flat_map(|pair| dim * pair..dim * (pair + 1)) {
                beyond[i] = d[i] - (self.d[i] + part * step.dd[i]);
            }
            let forces = self.force.iter().zip(&step.product);
            let mut force = forces.map(|(force, moved)| force + part * moved).collect::<Vec<f64>>();
            equations.matrix.add_product(&beyond, &mut force);
            force
        })
    }

    /// The point of the solution before, under the loads of these equations.
    pub fn of_before(equations: &Equations<'_>, before: Before) -> Self {
        let Before { pieces, d, y, product } = before;
        Self::with_force(equations, (pieces, y), |_, now| match now == d {
            true => product.iter().zip(&*equations.load).map(|(product, f)| product - f).collect(),
            false => equations.force(now),
        })
    }

    /// The solution at this point, for the next problem.
    pub fn into_before(self, equations: &Equations<'_>) -> Before {
        let Point { y, pieces, d, force, .. } = self;
        let product = force.iter().zip(&*equations.load).map(|(force, f)| force + f).collect();
        Before { pieces, d, y, product }
    }

    fn with_force(
        equations: &Equations<'_>,
        (pieces, y): (Vec<Piece>, Vec<Vector>),
        force: impl FnOnce(&[Piece], &[f64]) -> Vec<f64>,
    ) -> Self {
        // Where the pushes are the lack is made.
        let (d, mut lack) = equations.values(&pieces, &y);
        let force = force(&pieces, &d);
        lack.iter_mut().zip(&force).for_each(|(lack, force)| *lack += force);
        let merit = equations.length(&lack);
        Point { y, pieces, d, force, lack, merit }
    }
}
