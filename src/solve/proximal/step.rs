//! A round: the problem with soft springs in series with its pairs, and its result as one of the problem itself.

use crate::certificate::measure;
use crate::error::Error;
use crate::law::Contact;
use crate::monitor::Watch;
use crate::problem::{ContactProblem, Relation, Stiffness};
use crate::settings::{Method, Settings};
use crate::solve::result::{Call, Ending, Solution, Solve, Status, Uniqueness, wanted};
use crate::solve::rigid::{self, Balance};

/// How a problem with springs is solved.
#[derive(Clone, Copy)]
pub struct Means<'m> {
    pub settings: &'m Settings,
    pub solve: Solve,
    pub monitor: &'m dyn Watch,
}

/// Solves for the step from the displacements `d`, with the stiffness and the load of bodies and springs.
pub fn step<R: Relation>(
    problem: &ContactProblem<'_, R>,
    relation: Stiffness<'_>,
    d: &[f64],
    Means { settings, solve, monitor }: Means<'_>,
) -> Result<Solution, Error> {
    let dim = problem.dim();
    let pairs = 0..problem.pairs();
    let gap: Vec<f64> = pairs.clone().map(|pair| problem.gap(pair) - d[dim * pair]).collect();
    let slips =
        |pair| (1..dim).map(move |c| problem.reference_slip(pair, c - 1) - d[dim * pair + c]);
    let slip: Vec<f64> = pairs.flat_map(slips).collect();
    let law = problem.law();
    let problem = ContactProblem::with_relation(relation, dim, &gap, law, Some(&slip))?;
    let contact = &Contact::new(&problem);
    // A result is large, and a solution needs the stack: it stays where it is.
    let mut found = solve(&Call::new(contact, settings, monitor));
    let Ok(solution) = &mut found else { return found };
    if solution.status == Status::NoEquilibrium {
        // Springs do no work on motions of the bodies that move with them: the escape is that of the bodies.
        let balance = Balance::new(contact, monitor);
        rigid::describe(contact, solution, balance, Some(solve), monitor)?;
    }
    found
}

/// The result of displacements `d` and forces that a method has ended with, and the number of its systems.
pub fn ended<R: Relation>(
    contact: &Contact<'_, R>,
    (d, force): (Vec<f64>, &[f64]),
    settings: &Settings,
    (method, ending, systems): (Method, &Ending, u64),
) -> Solution {
    let certificate = measure(contact, (&d, &[]), force);
    let ended = ending.status(settings, &certificate);
    Solution { factorisations: systems, ..Solution::of(method, ended, d, certificate) }
}

/// Why rounds with springs, each of which is solved, end without a solution of the problem.
const UNSETTLED: &str = "no solution was found: forces that hardly move anything do not settle";

/// The result of a round, solved to a `rough` tolerance, as one of the problem itself, of displacements `d` and forces.
pub fn measured<R: Relation>(
    contact: &Contact<'_, R>,
    (round, rough): (Solution, f64),
    (d, force): (Vec<f64>, &[f64]),
    settings: &Settings,
) -> Solution {
    let certificate = measure(contact, (&d, &[]), force);
    let (status, message) = match round.status {
        Status::Solved | Status::Stalled if certificate.holds(settings.tolerance) => {
            (Status::Solved, format!("solved: eta is {:.1e}", certificate.eta).into())
        }
        Status::Solved => {
            (Status::Stalled, format!("{UNSETTLED} (eta is {:.1e})", certificate.eta).into())
        }
        Status::Stalled => {
            let of_round = wanted(&round.certificate, rough);
            let of_problem = wanted(&certificate, settings.tolerance);
            (Status::Stalled, round.message.marked().replace(&of_round, &of_problem).into())
        }
        other => match other.stop() {
            Some(stop) => Ending::Stopped(stop).status(settings, &certificate),
            None => (other, round.message.clone()),
        },
    };
    Solution {
        status,
        message,
        d_low: vec![0.0; d.len()],
        d,
        errors: None,
        certificate,
        fallback: None,
        uniqueness: Uniqueness::NotKnown,
        second: None,
        orientation: 0,
        ..round
    }
}
