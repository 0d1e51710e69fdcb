//! The curve of zeros of a homotopy, followed piece by piece.
//!
//! The piece of every pair is a state of the method. On frozen pieces `H` is analytic and is evaluated
//! beyond their boundaries, so that a corrector cannot change pieces by itself. One boundary is
//! crossed at a time: the corrector lands on it, the piece of that one pair changes, and the tangent in
//! the new piece has the orientation of the old one, that of `det [dH; t'] > 0`: its `ds` has the sign of `det J`.
//!
//! One factorisation of `J` serves a tangent and the correction of the step along it: with `t = (-J⁻¹ dH/ds, 1)` and
//! `z = (-J⁻¹ H, 0)`, `z + a t` meets any one condition by its `a`. Where the curve turns in `s` within a piece `J` is
//! singular, at a point that no step hits but for rounding.
//!
//! At a boundary one pair changes its piece, but the blocks of all slipping pairs turn along the way to it, so that
//! the old factor with the changed rows and columns in borders would not be the new system. Nor would it save
//! much: up to 225 pairs the elimination is a tenth to a third of the path's time, and about half of the systems
//! follow a boundary; the products with the stiffness in corrections take the most.

use super::homotopy::{Homotopy, PathPoint, Value};
use crate::law::{Boundary, Piece, Vector};
use crate::linalg::tolerances::SINGULAR;
use crate::monitor::Watch;
use crate::solve::pieces::System;
use crate::solve::result::Ending;

/// Longest step, as a part of the size of the place, which begins near one.
const LONGEST: f64 = 0.5;

/// A step that is halved more often than this finds no zero at all.
const MOST_HALVINGS: usize = 40;

/// Steps of one correction, and its factorisations. With an old factor a step leaves a tenth of `H` or more, so
/// that half as many steps would end most corrections before they are done: three times as many systems.
const MOST_CORRECTIONS: usize = 12;
const MOST_REFACTORISATIONS: u32 = 2;

/// A correction that leaves more of `H` asks for a new factorisation.
const CONTRACTION: f64 = 0.3;

/// `H` relative to the loads where a correction is done: well below what decides on a piece.
const ON_CURVE: f64 = 1e-10;

/// How far rounding moves the corrector, relative to the size of the homotopy: so far may another pair be outside its
/// piece, and shorter steps are not held to their own length.
const ROUNDING_OF_PLACE: f64 = 1e-9;

/// First step after a boundary, as a part of the size of the place.
const AFTER_BOUNDARY: f64 = 1e-4;

/// Systems after which it is given up: for each pair, and at least.
const SYSTEMS_PER_PAIR: usize = 25;
const LEAST_SYSTEMS: usize = 1500;

/// Displacements, relative to what the loads make of the scaling stiffness, that no certificate
/// accepts: the curve runs away.
const AWAY: f64 = 1e11;

/// A curve on the way from `s = 0` to `s = 1`.
pub struct Curve<'h> {
    homotopy: &'h Homotopy<'h>,
    monitor: &'h dyn Watch,
    /// Most distance from the predicted place, relative to the step.
    deviation: f64,
    pieces: Vec<Piece>,
    /// Where the curve is.
    pub place: PathPoint,
    /// Linear systems so far.
    pub systems: u64,
}

/// The system at a place, with the unit tangent of the curve.
struct Local {
    system: System,
    tangent: PathPoint,
}

/// The one condition beside `H = 0`: `normal . X = value`.
enum Condition {
    /// The plane across the tangent through a predicted place.
    Plane { normal: PathPoint, through: PathPoint },
    /// The boundary of a pair.
    Boundary { pair: usize, boundary: Boundary },
    /// The end, `s = 1`.
    End,
}

impl<'h> Curve<'h> {
    /// The curve that begins at `start`, the base of the homotopy.
    pub fn new(
        homotopy: &'h Homotopy<'h>,
        start: Vec<Vector>,
        deviation: f64,
        monitor: &'h dyn Watch,
    ) -> Self {
        let pieces = homotopy.equations.pieces(&start);
        let place = PathPoint { y: start, s: 0.0 };
        Curve { homotopy, monitor, deviation, pieces, place, systems: 0 }
    }

    /// Follows the curve to `s = 1`.
    pub fn follow(&mut self) -> Result<(), Ending> {
        let pairs = self.pieces.len();
        let most = LEAST_SYSTEMS.max(SYSTEMS_PER_PAIR * pairs) as u64;
        let mut step = f64::INFINITY;
        while self.systems <= most {
            let mut local = self.local()?;
            let size = 1.0 + self.homotopy.norm(&self.place);
            let (place, condition, length) = self.advance(&mut local, step.min(LONGEST * size))?;
            self.place = place;
            match condition {
                Condition::End => return Ok(()),
                Condition::Plane { .. } => step = 2.0 * length,
                Condition::Boundary { pair, boundary } => {
                    self.pieces[pair] =
                        self.homotopy.equations.laws[pair].across(self.pieces[pair], boundary);
                    step = step.min(LONGEST * size).max(AFTER_BOUNDARY * size);
                }
            }
        }
        Err(Ending::Stalled("the path of solutions is too long"))
    }

    /// The next place of the curve: at most `step` along the tangent, at the first boundary, or at the end; with the
    /// condition that it meets, and the length of the step along the tangent. Steps are halved until the corrector finds
    /// a place near by in which no other pair has left its piece.
    fn advance(
        &mut self,
        local: &mut Local,
        step: f64,
    ) -> Result<(PathPoint, Condition, f64), Ending> {
        let tangent = local.tangent.clone();
        let (leave, pair, boundary) = self.exit(&tangent);
        let end = if tangent.s > 0.0 { (1.0 - self.place.s) / tangent.s } else { f64::INFINITY };
        let mut length = step.min(leave).min(end);
        for _ in 0..MOST_HALVINGS {
            let predicted = self.place.along(&tangent, length);
            // Boundaries and the end may lie across the tangent.
            let (condition, reach) = if length == end {
                (Condition::End, 2.0)
            } else if length == leave {
                (Condition::Boundary { pair, boundary }, 2.0)
            } else {
                let normal = self.homotopy.dual(&tangent);
                (Condition::Plane { normal, through: predicted.clone() }, 1.0)
            };
            let crossed = (length == leave).then_some((pair, boundary));
            if let Some(place) = self.correct(local, predicted.clone(), &condition)? {
                let deviation = self.homotopy.norm(&predicted.to(&place));
                let most = self.deviation * reach * length.max(ROUNDING_OF_PLACE);
                if deviation <= most && self.is_inside(&place, crossed) {
                    return Ok((place, condition, length));
                }
            }
            length /= 2.0;
        }
        Err(Ending::Stalled("the path of solutions cannot be followed further"))
    }

    /// Factorises at the place of the curve, and finds the tangent.
    fn local(&mut self) -> Result<Local, Ending> {
        let value = self.homotopy.value(&self.pieces, &self.place);
        if value.stretch > AWAY * self.homotopy.size {
            return Err(Ending::Stalled("the displacements run away on the path of solutions"));
        }
        let place = self.place.clone();
        self.factorised(&place, &value)?.ok_or(Ending::Singular)
    }

    fn factorised(&mut self, place: &PathPoint, value: &Value) -> Result<Option<Local>, Ending> {
        self.monitor.step()?;
        let equations = self.homotopy.equations;
        let pairs = equations.linearised(&self.pieces, &place.y);
        self.monitor.affords(System::work(equations, &pairs))?;
        self.systems += 1;
        let asking = &mut self.monitor.asking();
        let system = System::new(equations, (pairs, place.s), SINGULAR, asking);
        let Some(mut system) = system else { return Ok(None) };
        let Some(y) = system.step(equations, &value.rate) else { return Ok(None) };
        let mut tangent = PathPoint { y, s: 1.0 };
        let length = self.homotopy.norm(&tangent);
        tangent.scale(f64::from(system.orientation()) / length);
        Ok(Some(Local { system, tangent }))
    }

    /// The zero of `H` on the pieces near `place` that meets a condition, if the corrector finds it.
    fn correct(
        &mut self,
        local: &mut Local,
        mut place: PathPoint,
        condition: &Condition,
    ) -> Result<Option<PathPoint>, Ending> {
        let mut fresh: Option<Local> = None;
        let mut refactorisations = 0;
        let mut before = f64::INFINITY;
        for _ in 0..MOST_CORRECTIONS {
            self.monitor.goes_on()?;
            let value = self.homotopy.value(&self.pieces, &place);
            let (miss, normal) = self.miss(condition, &place);
            let rounding = f64::EPSILON * (value.lack.len() as f64).sqrt() * value.stretch;
            let goal = ON_CURVE * self.homotopy.size.max(value.terms) + rounding;
            let now = value.merit.max(miss.abs() * self.homotopy.size);
            if now <= goal {
                return Ok(Some(place));
            }
            if !(now <= CONTRACTION * before) && before.is_finite() {
                if refactorisations == MOST_REFACTORISATIONS || !(now < before) {
                    return Ok(None);
                }
                refactorisations += 1;
                fresh = self.factorised(&place, &value)?;
                if fresh.is_none() {
                    return Ok(None);
                }
            }
            before = now;
            let local = fresh.as_mut().unwrap_or(local);
            let step = local.system.step(self.homotopy.equations, &value.lack);
            let Some(y) = step else { return Ok(None) };
            let z = PathPoint { y, s: 0.0 };
            let along = normal.apply(&local.tangent);
            let part = (-miss - normal.apply(&z)) / along;
            if !part.is_finite() {
                return Ok(None);
            }
            place = place.along(&z, 1.0).along(&local.tangent, part);
        }
        Ok(None)
    }

    /// By how much a place misses a condition, and the condition's coefficients.
    fn miss(&self, condition: &Condition, place: &PathPoint) -> (f64, PathPoint) {
        match condition {
            Condition::Plane { normal, through } => {
                (normal.apply(&through.to(place)), normal.clone())
            }
            Condition::Boundary { pair, boundary } => {
                let law = &self.homotopy.equations.laws[*pair];
                let (value, gradient) =
                    law.boundary(self.pieces[*pair], *boundary, &place.y[*pair]);
                let unit = self.unit_of(*pair, *boundary);
                let mut y = vec![[0.0; 3]; place.y.len()];
                y[*pair] = gradient.map(|g| g / unit);
                (value / unit, PathPoint { y, s: 0.0 })
            }
            Condition::End => (place.s - 1.0, PathPoint::of_s(place.y.len())),
        }
    }

    /// The nearest boundary along a direction: how far, of which pair, which.
    fn exit(&self, tangent: &PathPoint) -> (f64, usize, Boundary) {
        let mut nearest = (f64::INFINITY, 0, Boundary::Contact);
        for (pair, law) in self.homotopy.equations.laws.iter().enumerate() {
            for boundary in [Boundary::Contact, Boundary::Slip] {
                let (piece, y, t) = (self.pieces[pair], &self.place.y[pair], &tangent.y[pair]);
                if law.has_boundary(piece, boundary) {
                    let q = law.exit(piece, boundary, y, t);
                    if q < nearest.0 {
                        nearest = (q, pair, boundary);
                    }
                }
            }
        }
        nearest
    }

    /// True if all pairs but one that is on a boundary are in their pieces.
    fn is_inside(&self, place: &PathPoint, crossed: Option<(usize, Boundary)>) -> bool {
        self.homotopy.equations.laws.iter().enumerate().all(|(pair, law)| {
            [Boundary::Contact, Boundary::Slip].into_iter().all(|boundary| {
                let piece = self.pieces[pair];
                !law.has_boundary(piece, boundary)
                    || crossed == Some((pair, boundary))
                    || law.excess(piece, boundary, &place.y[pair])
                        <= ROUNDING_OF_PLACE * self.unit_of(pair, boundary)
            })
        })
    }

    /// The unit of a boundary's function.
    fn unit_of(&self, pair: usize, boundary: Boundary) -> f64 {
        let component = self.homotopy.equations.dim * pair
            + match boundary {
                Boundary::Contact => 0,
                Boundary::Slip => 1,
            };
        self.homotopy.equations.root[component] * self.homotopy.size
    }
}
