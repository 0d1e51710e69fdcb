//! The public result of a contact problem: its status, and why the first method was abandoned.

use super::call::Call;
use crate::certificate::{Certificate, Proof};
use crate::error::{Error, Message};
use crate::monitor::Stop;
use crate::settings::Method;

/// Solves a contact problem: what methods take that stand before the plan and need it.
pub type Solve = fn(&Call<'_>) -> Result<Solution, Error>;

/// Kind of a result: solved, or the reason why not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// Certified: `eta <= tolerance`.
    Solved,
    /// `max_iterations` used up; the result is the best iterate.
    IterationLimit,
    /// `time_limit` used up; the result is the best iterate.
    TimeLimit,
    /// Cancelled by the callback; the result is the best iterate.
    Cancelled,
    /// Proved: no equilibrium exists; [`Solution::recession`] is the proof.
    NoEquilibrium,
    /// The method cannot go on, and proves nothing.
    Stalled,
}

impl Status {
    /// The limit that has stopped the call, if one has.
    pub(crate) fn stop(self) -> Option<Stop> {
        match self {
            Status::IterationLimit => Some(Stop::IterationLimit),
            Status::TimeLimit => Some(Stop::TimeLimit),
            Status::Cancelled => Some(Stop::Cancelled),
            Status::Solved | Status::Stalled | Status::NoEquilibrium => None,
        }
    }
}

/// Why the first method was abandoned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fallback {
    /// It cycled through the same active sets.
    Cycle,
    /// It met a singular system.
    Singular,
    /// It found a solution of orientation −1, beside which there are others.
    Unstable,
    /// It found no accurate solution.
    Inaccurate,
}

/// Statement on other solutions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Uniqueness {
    /// Neither is proved.
    NotKnown,
    /// Proved to be the only one.
    Unique,
    /// One of several, by an estimate of errors.
    Several,
}

/// Outcome of the proof that the data have a solution with the states of the result.
#[derive(Clone, Debug)]
pub enum Existence {
    /// [`crate::Settings::proof`] is off.
    NotAsked,
    /// It is; and where the solution is.
    Proved(Box<Proof>),
    /// It is not, which says nothing about whether there is one.
    NotProved,
}

/// Errors of a result, relative, without unit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Errors {
    /// Error of the displacements: the largest error of one, over the largest displacement.
    pub d: f64,
    /// Error of the contact forces: the largest error of one, over the largest contact force or load.
    pub force: f64,
}

/// Data that are legal and often a mistake of the host, and what a host should know of a result, which obeys the law as
/// closely as the tolerance asks all the same.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Remarks {
    /// Every finite gap is negative: interference everywhere, or the sign of gaps is turned round.
    pub gaps_negative: bool,
    /// A coefficient of friction is above 10: percent, or another array.
    pub friction_large: bool,
    /// Without friction: the bodies may move without any force and without closing a gap, so that `d` is one
    /// of many. A support may be missing.
    pub free_motion: bool,
    /// Displacements are a million times what the loads ask for, and no more than the rounding of a condensed `K`
    /// resists them: nothing but that rounding holds a body. A support may be missing.
    pub held_by_rounding: bool,
    /// [`Solution::d`] alone misses the tolerance, as its rounding to doubles changes the forces by more; with
    /// [`Solution::d_low`] it meets it.
    pub needs_low_part: bool,
    /// The penetration is more than the square root of the tolerance beside the largest gap or normal displacement, as
    /// bodies are soft beside the loads: `eta` measures it as a force, and forces may be wrong.
    pub gaps_passed: bool,
}

/// Result of a contact problem.
#[derive(Clone, Debug)]
pub struct Solution {
    /// The status.
    pub status: Status,
    /// One sentence on what happened.
    pub message: Message,
    /// Relative displacements; the best iterate where [`Self::status`] is not [`Status::Solved`].
    pub d: Vec<f64>,
    /// The part that rounding to doubles has left out of [`Self::d`]: `d + d_low` is what the certificate measures.
    pub d_low: Vec<f64>,
    /// The certificate of `d + d_low`: measures, contact forces, states.
    pub certificate: Certificate,
    /// With [`Status::NoEquilibrium`] the recession direction that proves it, its largest component 1.
    /// With friction it lifts each slipping pair by `mu` times its slip: it proves, but no body moves so.
    pub recession: Option<Vec<f64>>,
    /// With [`Status::NoEquilibrium`] the motion with which the bodies escape, as they would move.
    pub escape: Option<Escape>,
    /// The method that ended it.
    pub method: Method,
    /// The method tried first and why it was abandoned, if another one ended it.
    pub fallback: Option<(Method, Fallback)>,
    /// Statement on other solutions.
    pub uniqueness: Uniqueness,
    /// Another solution, if [`crate::Search::Others`] found one or the default method met an unstable
    /// one on its way.
    pub second: Option<Box<SecondSolution>>,
    /// Outcome of the proof that the solution exists, with [`crate::Settings::proof`].
    pub existence: Existence,
    /// How far `d` and the forces are from a solution. With [`Existence::Proved`] proved bounds; otherwise
    /// what the contraction of the last refinement tells, no proof; `None` if there was none.
    pub errors: Option<Errors>,
    /// Sign of the determinant of the system of equations that the states select, 0 if not known.
    /// Over all solutions of a problem with positive definite `K` it adds up to +1.
    pub orientation: i8,
    /// Components whose block of `K` is positive definite beyond doubt; empty if none is known.
    pub(crate) definite: Vec<bool>,
    /// Data that are legal and often a mistake.
    pub remarks: Remarks,
    /// Sweeps, pivots or linear systems, of all methods that were tried.
    pub iterations: u64,
    /// Dense factorisations of Newton's method and of block pivoting; in full space sparse ones.
    pub factorisations: u64,
    /// Threshold updates of [`Method::SorNested`]; where no condensed matrix is formed, solutions with a
    /// factor.
    pub outer_iterations: u64,
    /// How often Lemke's tableau was refactorised because accuracy was lost.
    pub refactorisations: u64,
    /// Over-relaxation factor at the end, 0 if there is none.
    pub omega: f64,
    /// Damping of the threshold at the end, 0 if there is none.
    pub damping: f64,
}

impl Solution {
    /// The result of a method alone.
    pub fn of(
        method: Method,
        (status, message): (Status, impl Into<Message>),
        d: Vec<f64>,
        certificate: Certificate,
    ) -> Self {
        Solution {
            status,
            message: message.into(),
            d_low: vec![0.0; d.len()],
            d,
            certificate,
            recession: None,
            escape: None,
            method,
            fallback: None,
            uniqueness: Uniqueness::NotKnown,
            second: None,
            existence: Existence::NotAsked,
            remarks: Remarks::default(),
            errors: None,
            orientation: 0,
            definite: Vec::new(),
            iterations: 0,
            factorisations: 0,
            outer_iterations: 0,
            refactorisations: 0,
            omega: 0.0,
            damping: 0.0,
        }
    }

    /// Changes the second solution, which is none where its certificate no longer holds.
    pub(crate) fn change_second(
        &mut self,
        tolerance: f64,
        change: impl FnOnce(&mut SecondSolution),
    ) {
        let Some(second) = &mut self.second else { return };
        change(second);
        if !second.certificate.holds(tolerance) {
            (self.second, self.uniqueness) = (None, Uniqueness::NotKnown);
        }
    }

    /// Adds a part to the sentence.
    pub(crate) fn say(&mut self, more: &str) {
        self.message = format!("{}; {more}", self.message.marked()).into();
    }
}

/// How bodies move where no equilibrium exists.
#[derive(Clone, Debug)]
pub struct Escape {
    /// A rigid motion that can be drawn, its largest component 1: no pair approaches its obstacle, pairs that
    /// contact presses stay on it, friction opposes the slip, and the loads do work. It is the motion
    /// against a viscosity of the size of each component's stiffness, every pair that has an obstacle
    /// touching it. [`Solution::recession`] where that motion was not found.
    pub motion: Vec<f64>,
    /// The sum of loads and contact forces along the motion, spread over the components; it has the
    /// same resultants: nothing balances it.
    pub unbalanced: Vec<f64>,
}

/// A further solution, certified like the first.
#[derive(Clone, Debug)]
pub struct SecondSolution {
    /// Relative displacements.
    pub d: Vec<f64>,
    /// As [`Solution::d_low`].
    pub d_low: Vec<f64>,
    /// The certificate: measures, contact forces, states.
    pub certificate: Certificate,
    /// As [`Solution::orientation`].
    pub orientation: i8,
}
