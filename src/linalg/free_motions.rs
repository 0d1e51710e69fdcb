//! The motions that a condensed matrix does not resist, and the matrix made exact on them: their products, which
//! only rounding fills, become zero.
//!
//! A motion that nothing resists has the energy zero, and in doubles the rounding of zero. No fixed
//! threshold tells it from a soft spring: the rounding of the condensation grows with the mesh, with
//! slenderness, and with the ratio of the stiffnesses. So the energy of a motion `x` of the whole, before
//! anything was eliminated, is compared with the rounding of that very energy:
//!
//! ```text
//! free:  |x.A x| <= 3 e,    held:  x.A x >= 100 e,    e = 2.2e-16 |x|.|A| |x|
//! ```
//!
//! Candidates are the directions with small pivots; Ritz's method parts them. What lies between cannot be
//! told from rounding, and what is far below zero is no stiffness.
//!
//! The condensed matrix `S` then gets on the candidates `V` the products that the whole has: with
//! `R = A V - S V`, and `A V = 0` for the free ones,
//!
//! ```text
//! S <- S + R Vᵀ + V Rᵀ - V (VᵀR) Vᵀ
//! ```
//!
//! For free motions this is the projection `(1 - V Vᵀ) S (1 - V Vᵀ)`. Components that the free motions
//! move on their own get rows of zeros.

use nalgebra::{DMatrix, DMatrixView};

use super::eigen::eigenvectors;
use super::gmres::{extend_basis, orthogonalised};
use super::pivoted_cholesky::PivotedCholesky;
use super::sparse_schur::Failure;
use super::tolerances::{CONDENSATION, FREE, HELD, NEGLIGIBLE, SUSPICIOUS_PIVOT};
use super::vector::{combination, dot, norm};
use super::watched::GoesOn;

/// The matrix from which another one was condensed: of eliminated components, then of those kept.
pub trait Whole {
    /// Continues a motion of the kept components to all, so that no force acts on the others; `None` where `goes_on`
    /// says no.
    fn extended(&self, kept: &[f64], goes_on: GoesOn<'_>) -> Option<Vec<f64>>;

    /// The forces that a motion of all components meets.
    fn forces(&self, motion: &[f64]) -> Vec<f64>;

    /// The rounding of the energy of a motion of all components.
    fn noise(&self, motion: &[f64]) -> f64;
}

/// Steps in which a candidate loses the forces on the components that resist: each gains what the
/// factor is worth, ten digits or more.
const CORRECTIONS: usize = 2;

/// A motion, and the forces that it meets.
struct Motion {
    /// All components.
    whole: Vec<f64>,
    forces: Vec<f64>,
    /// The kept components times their roots, of length 1.
    scaled: Vec<f64>,
}

/// A diagonal entry that keeps less of its unit is small beside the rounding of the condensation.
const SOFT: f64 = 0.05;

/// The energies beside units up to which rounding may pass for stiffness, where the weakest pivot of the eliminated components
/// keeps such a part of its diagonal: a stiff body that soft ones alone hold has weak pivots. Free motions were left energies
/// of up to some hundred times `2.2e-16` over that part (measured).
pub fn suspicious_pivot(weakest: f64) -> f64 {
    (CONDENSATION / weakest).clamp(NEGLIGIBLE, SOFT)
}

/// The reason for which free motions of a condensed matrix are looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Doubt {
    /// A component keeps next to nothing of its unit: it must be told if a motion is free.
    Pivots,
    /// The weakest pivot is small, or a component keeps little of its unit, so that the rounding of free motions may pass for
    /// stiffness. A host's matrix may itself be rounded to fewer digits, so that a motion cannot be told: it keeps the forces
    /// that the whole has.
    Rounding,
}

impl Doubt {
    /// A look at pivots and the diagonal costs nothing beside a factorisation. Other free motions have negligible pivots, which
    /// are found where the matrix is factorised: `None`. `suspicious` is [`suspicious_pivot`] of the weakest one.
    pub fn of(suspicious: f64, units: &[f64], diagonal: impl Fn(usize) -> f64) -> Option<Self> {
        let keeps = |part: f64| units.iter().enumerate().all(|(i, unit)| diagonal(i) > part * unit);
        match keeps(SUSPICIOUS_PIVOT) {
            false => Some(Doubt::Pivots),
            true => (suspicious > NEGLIGIBLE || !keeps(SOFT)).then_some(Doubt::Rounding),
        }
    }
}

/// Settles which motions the condensed `matrix`, column-major, does not resist, and makes it exact on them.
/// `units` are positive, of the size of the diagonal before anything was eliminated; motions with pivots up to `least` beside
/// them are looked at. Motions that are `known` to be free, [`orthonormal`] with each component times the root of its unit, need no
/// search. Returns whether any motion is free; `goes_on` is asked now and then, and where it says no, nothing is settled.
pub fn settle(
    matrix: &mut [f64],
    (units, least, doubt): (&[f64], f64, Doubt),
    (known, whole): (&[Vec<f64>], &dyn Whole),
    goes_on: GoesOn<'_>,
) -> Result<bool, Failure> {
    let (size, least) = (units.len(), least.max(SUSPICIOUS_PIVOT));
    let root: Vec<f64> = units.iter().map(|unit| unit.sqrt()).collect();
    // A unit holds those that are known, so that others are found beside them.
    let entry = |i: usize, j: usize| {
        let held: f64 = known.iter().map(|v| v[i] * v[j]).sum();
        matrix[i + size * j] / (root[i] * root[j]) + held
    };
    let Some(factor) = PivotedCholesky::within(size, least, entry, goes_on) else {
        return Ok(false);
    };
    if factor.dependent.is_empty() && known.is_empty() {
        return Ok(false);
    }
    let scale = |matrix: &mut [f64], by: fn(f64, f64) -> f64| {
        for (column, own) in matrix.chunks_exact_mut(size).zip(&root) {
            column.iter_mut().zip(&root).for_each(|(entry, root)| *entry = by(*entry, root * own));
        }
    };
    scale(matrix, |entry, roots| entry / roots);
    let settled = settle_scaled(matrix, (&factor, doubt), &root, (known, whole), goes_on);
    scale(matrix, |entry, roots| entry * roots);
    settled
}

fn settle_scaled(
    matrix: &mut [f64],
    (factor, doubt): (&PivotedCholesky, Doubt),
    root: &[f64],
    (known, whole): (&[Vec<f64>], &dyn Whole),
    goes_on: GoesOn<'_>,
) -> Result<bool, Failure> {
    let size = root.len();
    let Some(mut motions) = candidates(matrix, factor, root, whole, goes_on) else {
        return Ok(false);
    };
    motions.iter_mut().for_each(|motion| drop(orthogonalised(motion, known)));
    let Some(motions) = parted(motions, root, whole, goes_on) else { return Ok(false) };
    let (mut basis, mut products) = (Vec::new(), Vec::new());
    let mut free = known.to_vec();
    for motion in motions {
        let (energy, noise) = (dot(&motion.whole, &motion.forces), whole.noise(&motion.whole));
        if energy.abs() <= FREE * noise {
            free.push(motion.scaled);
        } else if energy >= HELD * noise || doubt == Doubt::Rounding {
            let forces = &motion.forces[motion.forces.len() - size..];
            products.push(forces.iter().zip(root).map(|(force, root)| force / root).collect());
            basis.push(motion.scaled);
        } else if energy <= -HELD * noise {
            return Err(Failure::Negative(motion.whole));
        } else {
            return Err(Failure::Unclear(motion.whole));
        }
    }
    let some_free = !free.is_empty();
    let Some(alone) = separate(&mut free, root, whole, goes_on) else { return Ok(false) };
    products.extend(free.iter().map(|_| vec![0.0; size]));
    basis.extend(free);
    replace_products(matrix, &basis, &products);
    for &i in &alone {
        (0..size).for_each(|j| (matrix[i + size * j], matrix[j + size * i]) = (0.0, 0.0));
    }
    Ok(some_free)
}

/// Motions of the kept components that move one dependent component each, and of the others what no force
/// then acts on; `None` where `goes_on` says no.
fn candidates(
    matrix: &[f64],
    factor: &PivotedCholesky,
    root: &[f64],
    whole: &dyn Whole,
    goes_on: GoesOn<'_>,
) -> Option<Vec<Vec<f64>>> {
    let size = root.len();
    // Takes away the forces, scaled, on the independent components.
    let correct = |scaled: &mut [f64], forces: &dyn Fn(usize) -> f64| {
        factor.solution(forces).into_iter().for_each(|(i, y)| scaled[i] -= y);
    };
    let candidate = |&dependent: &usize| {
        let mut scaled = vec![0.0; size];
        scaled[dependent] = 1.0;
        correct(&mut scaled, &|i| matrix[i + size * dependent]);
        for _ in 0..CORRECTIONS {
            let forces = whole.forces(&whole.extended(&divided(&scaled, root), goes_on)?);
            let kept = &forces[forces.len() - size..];
            correct(&mut scaled, &|i| kept[i] / root[i]);
        }
        Some(scaled)
    };
    factor.dependent.iter().map(candidate).collect()
}

/// The space of the candidates by directions of stationary energy; `None` where `goes_on` says no.
fn parted(
    candidates: Vec<Vec<f64>>,
    root: &[f64],
    whole: &dyn Whole,
    goes_on: GoesOn<'_>,
) -> Option<Vec<Motion>> {
    let mut motions = |scaled: Vec<Vec<f64>>| {
        let count = scaled.len();
        let scaled = orthonormal(scaled, count, goes_on)?;
        let motion = |scaled: Vec<f64>| {
            let whole_motion = whole.extended(&divided(&scaled, root), goes_on)?;
            Some(Motion { forces: whole.forces(&whole_motion), whole: whole_motion, scaled })
        };
        scaled.into_iter().map(motion).collect::<Option<Vec<Motion>>>()
    };
    let given = motions(candidates)?;
    let energy = |i: usize, j: usize| {
        let product = |i: usize, j: usize| dot(&given[i].whole, &given[j].forces);
        (product(i, j) + product(j, i)) / 2.0
    };
    let Some(directions) = eigenvectors(given.len(), energy) else { return Some(given) };
    let scaled = directions.into_iter().map(|shares| {
        combination(root.len(), shares.into_iter().zip(given.iter().map(|given| &given.scaled)))
    });
    motions(scaled.collect())
}

fn divided(scaled: &[f64], root: &[f64]) -> Vec<f64> {
    scaled.iter().zip(root).map(|(x, root)| x / root).collect()
}

/// `count` orthonormal vectors that span the given ones, by Gram and Schmidt's process with the longest
/// remainder first; `None` where `goes_on` says no.
pub fn orthonormal(
    vectors: Vec<Vec<f64>>,
    count: usize,
    goes_on: GoesOn<'_>,
) -> Option<Vec<Vec<f64>>> {
    let mut left: Vec<(f64, Vec<f64>)> =
        vectors.into_iter().map(|vector| (norm(&vector), vector)).collect();
    let mut basis: Vec<Vec<f64>> = Vec::with_capacity(count);
    while basis.len() < count
        && let Some(k) = (0..left.len()).max_by(|&a, &b| left[a].0.total_cmp(&left[b].0))
    {
        if !goes_on() {
            return None;
        }
        extend_basis(&mut basis, left.swap_remove(k).1);
        let last = &basis[basis.len() - 1..];
        // Motions of bodies that do not touch each other share nothing.
        let sharing = left.iter_mut().filter(|(_, other)| dot(&last[0], other) != 0.0);
        sharing.for_each(|(size, other)| (_, *size, _) = orthogonalised(other, last));
    }
    Some(basis)
}

/// Parts the components that the free motions move on their own: returns them, and leaves of the motions those of the other
/// components; `None` where `goes_on` says no.
///
/// Free motions move a component on its own if they span its unit vector up to [`NEGLIGIBLE`]: far above the rounding of most
/// motions (1e-15 to 1e-13, measured), and its square, an energy, is below rounding. Rounding mixes them with motions of little
/// energy by more, as balls with a ring on soft springs: by that of an energy over this energy. Then the motion of the component
/// itself tells. The square of the share, which costs less, tells first.
fn separate(
    free: &mut Vec<Vec<f64>>,
    root: &[f64],
    whole: &dyn Whole,
    goes_on: GoesOn<'_>,
) -> Option<Vec<usize>> {
    let size = root.len();
    let share = |i: usize| free.iter().map(|v| v[i] * v[i]).sum::<f64>();
    let remainder = |i: usize| {
        let mut rest = combination(size, free.iter().map(|v| (-v[i], v)));
        rest[i] += 1.0;
        norm(&rest)
    };
    let mut alone = Vec::new();
    for i in (0..size).filter(|&i| share(i) > 1.0 - NEGLIGIBLE) {
        if remainder(i) <= NEGLIGIBLE || is_unresisted(i, root, whole, goes_on)? {
            alone.push(i);
        }
    }
    if !alone.is_empty() {
        let left = free.len().saturating_sub(alone.len());
        let mut rest = std::mem::take(free);
        rest.iter_mut().for_each(|v| alone.iter().for_each(|&i| v[i] = 0.0));
        *free = orthonormal(rest, left, goes_on)?;
    }
    Some(alone)
}

/// `true` if the motion of a component on its own meets forces that are the rounding of its energy: these bound the energy, and
/// what a row of zeros takes from any other one. `None` where `goes_on` says no.
fn is_unresisted(
    component: usize,
    root: &[f64],
    whole: &dyn Whole,
    goes_on: GoesOn<'_>,
) -> Option<bool> {
    let mut scaled = vec![0.0; root.len()];
    scaled[component] = 1.0;
    let motion = whole.extended(&divided(&scaled, root), goes_on)?;
    let forces = whole.forces(&motion);
    let kept = divided(&forces[forces.len() - root.len()..], root);
    Some(norm(&kept) <= FREE * whole.noise(&motion))
}

/// Gives the scaled matrix the `products` with the orthonormal `basis`, and leaves it symmetric.
fn replace_products(matrix: &mut [f64], basis: &[Vec<f64>], products: &[Vec<f64>]) {
    let Some(size) = basis.first().map(Vec::len) else { return };
    let columns = |vectors: &[Vec<f64>]| {
        DMatrix::from_iterator(size, vectors.len(), vectors.iter().flatten().copied())
    };
    let basis = columns(basis);
    let lack = columns(products) - DMatrixView::from_slice(matrix, size, size) * &basis;
    // R - V (VᵀR) / 2, so that one symmetric update does.
    let inner = basis.tr_mul(&lack);
    let halves = lack - &basis * ((&inner + inner.transpose()) / 4.0);
    let (basis, halves) = (basis.as_slice(), halves.as_slice());
    for (v, half) in basis.chunks_exact(size).zip(halves.chunks_exact(size)) {
        for (j, column) in matrix.chunks_exact_mut(size).enumerate() {
            let rows = column.iter_mut().zip(half.iter().zip(v));
            rows.for_each(|(entry, (half_i, v_i))| *entry += half_i * v[j] + v_i * half[j]);
        }
    }
}
