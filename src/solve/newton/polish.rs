//! Refinement of a candidate with residuals in twice the precision, its displacements carried as two
//! doubles each.
//!
//! A double cannot hold displacements to the accuracy that the forces of an ill-conditioned `K` ask for:
//! rounding `d` alone changes `K d` by `u |K| |d|`. So `d + low` is refined. With `F = K (d + low) - f`, the
//! coordinates `y = k v - F'` on the chart of the law, and `v'` the displacement of the point there,
//! `e = k (v - v')` is small, and computed without cancellation. The lack of equilibrium at that point is
//! `H = e - K k⁻¹ e`, because its push is `P = e - F`. Newton's step `dy` from there on the pieces of `y`
//! moves `v` by `-k⁻¹ e + k⁻¹ (1 - dP/dy) dy`, a small number again, which double precision gives.

use super::descent::{AIM, PATIENCE, ROUNDING_OF_ETA};
use super::iteration::CHORD;
use crate::certificate::eta_of;
use crate::law::{Contact, Linearised, Piece};
use crate::linalg::double_double::add_to_parts;
use crate::linalg::tolerances::NULL_VECTOR;
use crate::linalg::vector::{largest_of, norm_inf};
use crate::monitor::Watch;
use crate::solve::pieces::{Equations, SMALL, System};
use crate::solve::result::{Call, Candidate, Ending, Errors};

/// Most steps; [`PATIENCE`] of them in a row may be no better than an earlier one: pieces may change first.
const MOST_STEPS: usize = 30;

/// Where `eta` is below a candidate is next to a solution. On few unknowns systems cost next to nothing,
/// and rounding may hide a solution from a method altogether: there any candidate is refined.
const NEAR: f64 = 1e-3;

/// Refines a candidate if its residual is above the tolerance and that helps. Where it was done and there was no time to
/// see, it is stopped.
pub fn refine_to_tolerance(call: &Call<'_>, candidate: &mut Candidate) {
    let (contact, settings) = (call.contact, call.settings);
    let old = candidate.certificate(contact);
    let is_finite = candidate.d().iter().all(|d| d.is_finite());
    let is_near = old.eta <= NEAR || contact.unknowns() <= SMALL;
    let is_stopped = matches!(candidate.ending, Ending::Stopped(_)) || contact.is_at_rest();
    if old.residual <= settings.tolerance || !is_finite || !is_near || is_stopped {
        return;
    }
    let at_reference = contact.at_its_reference();
    let equations = Equations::of(&at_reference);
    let aim = AIM * settings.tolerance;
    let mut newton = Newton::on(&equations, call.monitor);
    let refined = refine((contact, &at_reference), candidate, aim, &mut newton);
    let new = refined.certificate(contact);
    if new.residual <= settings.tolerance && !new.runs_away() {
        *candidate = refined;
        candidate.ending = Ending::Done;
    } else if newton.is_stopped && candidate.ending == Ending::Done {
        candidate.ending = Ending::Stopped(call.monitor.reason());
    }
}

/// A candidate refined as far as it goes.
pub struct FullyRefined {
    /// The candidate, with the orientation of the pieces that it is on.
    pub candidate: Candidate,
    /// Newton's next step: how far it is from the solution on its pieces, to first order.
    pub error: Vec<f64>,
}

/// Refines displacements to the last digits; `None` if the system there is singular, or if there is no time.
pub fn refine_fully(call: &Call<'_>, candidate: &Candidate) -> Option<FullyRefined> {
    let contact = call.contact;
    let at_reference = contact.at_its_reference();
    let equations = Equations::of(&at_reference);
    let mut newton = Newton::on(&equations, call.monitor);
    let mut candidate = refine((contact, &at_reference), candidate, 0.0, &mut newton);
    if newton.is_stopped {
        return None;
    }
    let v = contact.beyond_reference(candidate.d(), candidate.low());
    let (error, orientation) = newton.step(&v, candidate.force())?;
    candidate.orientation = orientation;
    Some(FullyRefined { candidate, error })
}

/// Refines until `eta` is at most `aim`, falls no further, or the time is up.
fn refine(
    (contact, at_reference): (&Contact<'_>, &Contact<'_>),
    candidate: &Candidate,
    aim: f64,
    newton: &mut Newton<'_>,
) -> Candidate {
    let (mut d, mut low) = (candidate.d().to_vec(), vec![0.0; candidate.d().len()]);
    let mut best = candidate.clone();
    let (mut least, mut in_vain) = (f64::INFINITY, 0);
    let mut steps = Steps::default();
    for _ in 0..MOST_STEPS {
        if newton.monitor.is_late() {
            newton.is_stopped = true;
            break;
        }
        let v = contact.beyond_reference(&d, &low);
        let force = contact.problem().force_of_parts(&d, &low);
        let eta = eta_of(at_reference, &v, &force);
        if eta < least {
            (least, in_vain) = (eta, 0);
            steps.arrived((best.force(), &force), eta);
            best = best.moved_to(d.clone(), low.clone(), force.clone());
            best.errors = steps.errors(&best, contact.problem().load(), eta);
        } else {
            steps.last = None;
            in_vain += 1;
        }
        if !(least > aim) || in_vain >= PATIENCE {
            break;
        }
        newton.is_good = in_vain == 0 && steps.contraction <= CHORD;
        let Some((step, orientation)) = newton.step(&v, &force) else { break };
        best.orientation = orientation;
        steps.begin(eta, &step);
        add_to_parts((&mut d, &mut low), step);
    }
    best.effort.factorisations += newton.factorisations;
    best
}

/// Changes by the steps of a refinement, beside the residuals from which they began: how large an error
/// a residual stands for.
#[derive(Default)]
struct Steps {
    /// `eta` where the last step began, and its largest change of a displacement.
    last: Option<(f64, f64)>,
    /// The last contraction of `eta` by a step.
    contraction: f64,
    /// Largest changes of a displacement and of a force, over the `eta` at which the step began.
    gain: Errors,
}

impl Steps {
    fn begin(&mut self, eta: f64, step: &[f64]) {
        self.last = Some((eta, norm_inf(step)));
    }

    /// The forces before the step and now, with `eta`.
    fn arrived(&mut self, (before, now): (&[f64], &[f64]), eta: f64) {
        let Some((from, step)) = self.last.take() else { return };
        let change = largest_of(before.iter().zip(now).map(|(before, now)| before - now));
        self.contraction = eta / from;
        self.gain.d = self.gain.d.max(step / from);
        self.gain.force = self.gain.force.max(change / from);
    }

    /// The errors that are left with the residual `eta` and its rounding, beside the rounding of the answer. A residual stands
    /// for up to twice the error of those of the steps before: what is left may point elsewhere.
    fn errors(&self, at: &Candidate, load: &[f64], eta: f64) -> Option<Errors> {
        let left = 2.0 * (eta + ROUNDING_OF_ETA) / (1.0 - self.contraction);
        let part = |gain: f64, size: f64| {
            let error = if gain > 0.0 { gain * left / size } else { 0.0 };
            error + f64::EPSILON
        };
        let forces = norm_inf(at.force()).max(norm_inf(load));
        let errors =
            Errors { d: part(self.gain.d, norm_inf(at.d())), force: part(self.gain.force, forces) };
        let is_known = self.contraction > 0.0 || self.gain.d > 0.0;
        // A step that leaves less than half of `eta` tells what error a residual stands for.
        (is_known && 2.0 * self.contraction < 1.0).then_some(errors)
    }
}

/// Newton's steps, whose factor is kept.
struct Newton<'e> {
    equations: &'e Equations<'e>,
    /// The factor, with the pieces at which it was made.
    kept: Option<(System, Vec<Piece>)>,
    /// True if the last step came near enough for its factor to serve again.
    is_good: bool,
    factorisations: u64,
    /// True if a factorisation or a step was left out as there was no time for it.
    is_stopped: bool,
    monitor: &'e dyn Watch,
}

impl<'e> Newton<'e> {
    fn on(equations: &'e Equations<'e>, monitor: &'e dyn Watch) -> Self {
        let (kept, is_good, is_stopped) = (None, false, false);
        Newton { equations, kept, is_good, factorisations: 0, is_stopped, monitor }
    }

    /// The change of displacements `v` beyond their references that Newton's method wants where they need
    /// `force`, and the sign of the determinant; `None` if the system is singular, or there is no time.
    fn step(&mut self, v: &[f64], force: &[f64]) -> Option<(Vec<f64>, i8)> {
        let (equations, dim) = (self.equations, self.equations.dim);
        let y = equations.coordinates(v, force);
        let pieces = equations.pieces(&y);
        let parts = v.chunks_exact(dim).zip(force.chunks_exact(dim));
        let mut distance = Vec::with_capacity(v.len());
        let mut change = Vec::with_capacity(v.len());
        for (((law, &piece), y), (v, force)) in
            equations.laws.iter().zip(&pieces).zip(&y).zip(parts)
        {
            let apart = law.distance_to_piece(piece, y, v, force);
            distance.extend_from_slice(&apart[..dim]);
            change.extend(law.displacement_by(&apart)[..dim].iter().map(|by| -by));
        }
        let mut lack = distance;
        equations.matrix.add_product(&change, &mut lack);
        let pairs = equations.linearised(&pieces, &y);
        let system = self.factor(pieces, pairs)?;
        let steps = system.step(equations, &lack)?;
        let pairs = equations.laws.iter().zip(system.pairs()).zip(&steps);
        for (((law, pair), dy), change) in pairs.zip(change.chunks_exact_mut(dim)) {
            let moved = law.displacement_by(&pair.moved(dy));
            change.iter_mut().zip(moved).for_each(|(change, moved)| *change += moved);
        }
        Some((change, system.orientation()))
    }

    /// The kept factor if it serves at these coordinates, otherwise theirs if there is time for it. It serves on its pieces
    /// while each step leaves the part [`CHORD`] of `eta` at most, and where derivatives are the same, as in the plane.
    fn factor(&mut self, pieces: Vec<Piece>, pairs: Vec<Linearised>) -> Option<&mut System> {
        let (equations, is_good) = (self.equations, self.is_good);
        let serves = |(system, of): &(System, Vec<Piece>)| {
            *of == pieces && (is_good || system.pairs() == pairs)
        };
        if !self.kept.as_ref().is_some_and(serves) {
            self.factorisations += 1;
            let pairs = (pairs, 1.0);
            let system = System::new(equations, pairs, NULL_VECTOR, &mut self.monitor.asking());
            self.is_stopped = system.is_none() && self.monitor.is_late();
            self.kept = Some((system?, pieces));
        }
        self.kept.as_mut().map(|(system, _)| system)
    }
}
