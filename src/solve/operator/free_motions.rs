//! The motions of all unknowns of a sparse matrix `A` that nothing resists, and their balance.
//!
//! With soft springs `s D` on the components of `d`, `D` their units, the matrix has a factor. Its inverse multiplies a
//! motion with the energy `x . A x = λ d . D d` by `1 / (λ + s)`: what is free grows, and the rest vanishes beside it (simultaneous
//! iteration; B. N. Parlett, *The Symmetric Eigenvalue Problem*, 1980, chapter 14). The images are in equilibrium inside. Ritz's
//! method parts what is free from soft parts of bodies; the certificate says what is free.

use super::session::Session;
use crate::certificate::{is_spread_escape, is_unresisted};
use crate::law::Contact;
use crate::linalg::eigen::eigenvectors;
use crate::linalg::gmres::orthogonalised;
use crate::linalg::perturbation::Perturbation;
use crate::linalg::vector::{combination, dot};
use crate::monitor::Watch;
use crate::problem::{HeldSet, MatrixFree, StiffnessOperator};
use crate::solve::result::Ending;
use crate::solve::rigid::{Balance, RigidMotions};

/// Motions that are followed at first: more than one body has, so that the softest others show that all are found.
const FIRST: usize = 8;

/// Most motions that are followed: those of ten bodies in space. Their vectors fit in the place of the directions of GMRES.
const MOST: usize = 64;

/// Steps of the iteration: parts of a body that resist with 1e-6 of their units are gone after them.
const STEPS: usize = 4;

/// A basis of the free motions.
pub struct FreeMotions {
    rigid: RigidMotions,
    /// All unknowns of each motion of the basis.
    whole: Vec<Vec<f64>>,
}

impl FreeMotions {
    /// The motions of bodies with pairs of `dim` components; `None` if there are none, or too many, or if `A` is no
    /// sparse matrix with a factor.
    pub fn of(bodies: &mut Session<'_>, dim: usize) -> Result<Option<Self>, Ending> {
        let components = bodies.operator.units().len() - bodies.operator.inner();
        let has_factor = bodies.operator.is_sparse() && bodies.operator.is_exact();
        if !has_factor || components == 0 {
            return Ok(None);
        }
        bodies.hold_under(&HeldSet::none(dim, components / dim))?;
        let mut count = FIRST;
        while count <= MOST {
            let motions = FreeMotions::among(bodies, count.min(components))?;
            let found = motions.whole.len();
            if found < count.min(components) || count >= components {
                return Ok((found > 0).then_some(motions));
            }
            count *= 2;
        }
        Ok(None)
    }

    /// The free ones of so many motions that are resisted least.
    fn among(bodies: &mut Session<'_>, count: usize) -> Result<Self, Ending> {
        let inner = bodies.operator.inner();
        let root: Vec<f64> = bodies.operator.units()[inner..].iter().map(|u| u.sqrt()).collect();
        let mut rigid = RigidMotions { root, basis: Vec::new() };
        let mut random = Perturbation::new(1);
        let mut whole = Vec::new();
        let mut basis: Vec<Vec<f64>> =
            (0..count).map(|_| rigid.root.iter().map(|_| random.next()).collect()).collect();
        for _ in 0..STEPS {
            bodies.monitor.goes_on()?;
            let mut forces = Vec::with_capacity(count * (inner + rigid.root.len()));
            for motion in &basis {
                forces.resize(forces.len() + inner, 0.0);
                forces.extend(motion.iter().zip(&rigid.root).map(|(r, root)| r * root));
            }
            let images = bodies.solve(&forces)?;
            let images = images.chunks_exact(inner + rigid.root.len());
            (basis, whole) = orthonormal(&rigid, inner, images);
        }
        let mut products = Vec::new();
        for motion in &whole {
            bodies.monitor.goes_on()?;
            products.push(bodies.product(motion)?);
        }
        let energy =
            |i: usize, j: usize| dot(&whole[i], &products[j]) + dot(&whole[j], &products[i]);
        let mut free = Vec::new();
        for shares in eigenvectors(whole.len(), energy).unwrap_or_default() {
            let of = |vectors: &[Vec<f64>]| {
                combination(vectors[0].len(), shares.iter().copied().zip(vectors))
            };
            let motion = of(&whole);
            if is_unresisted(bodies.operator, &motion)? {
                rigid.basis.push(of(&basis));
                free.push(motion);
            }
        }
        Ok(FreeMotions { rigid, whole: free })
    }

    /// The balance of the loads on these motions.
    pub fn balance<'c>(
        &'c self,
        contact: &'c Contact<'c, MatrixFree<'c>>,
        bodies: &'c dyn StiffnessOperator,
        monitor: &'c dyn Watch,
    ) -> Balance<'c, MatrixFree<'c>> {
        // Products with a sparse matrix do not fail.
        let proves = move |r: &[f64]| {
            is_spread_escape(contact, bodies, &self.continued(r)).unwrap_or_default()
        };
        Balance::of(contact, self.rigid.clone(), monitor, proves)
    }

    /// All unknowns of the free motion with the relative displacements `r`.
    pub fn continued(&self, r: &[f64]) -> Vec<f64> {
        let shares = self.rigid.coordinates(r).into_iter();
        combination(self.whole[0].len(), shares.zip(&self.whole))
    }
}

/// Motions made orthonormal by their components of `d`, in the roots of units: these, and all unknowns of each.
fn orthonormal<'m>(
    rigid: &RigidMotions,
    inner: usize,
    motions: impl Iterator<Item = &'m [f64]>,
) -> (Vec<Vec<f64>>, Vec<Vec<f64>>) {
    let (mut basis, mut whole): (Vec<Vec<f64>>, Vec<Vec<f64>>) = (Vec::new(), Vec::new());
    for motion in motions {
        let mut own = rigid.scaled(&motion[inner..]);
        let (shares, left, _) = orthogonalised(&mut own, &basis);
        if left > 0.0 {
            own.iter_mut().for_each(|r| *r /= left);
            let taken = combination(motion.len(), shares.into_iter().zip(&whole));
            whole.push(motion.iter().zip(taken).map(|(r, taken)| (r - taken) / left).collect());
            basis.push(own);
        }
    }
    (basis, whole)
}
