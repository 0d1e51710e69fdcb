//! Frictionless contact by Lemke's method on the normal displacements (paper, section 2.2).
//!
//! A load that drives a motion free of contact has no equilibrium, and neither has one that ends
//! Lemke's path in a ray: the condensed matrix is positive semi-definite.

use super::path::{self, LemkeRules, Refactorising, ScaledLcp};
use crate::error::Error;
use crate::law::Contact;
use crate::monitor::Monitor;
use crate::settings::Settings;
use crate::solve::part::NormalProblem;
use crate::solve::result::{Candidate, Ending};

/// Solves by Lemke's method. It needs no start.
pub fn frictionless(
    contact: &Contact<'_>,
    settings: &Settings,
    monitor: &mut Monitor<'_>,
) -> Result<Candidate, Error> {
    let normal = match NormalProblem::new(contact, monitor) {
        Ok(normal) => normal,
        Err(why) => return Ok(Candidate::without_displacements(contact, why)),
    };
    let usual = follow(contact, &normal, Refactorising::Usual, monitor)?;
    if usual.is_settled(contact, settings.tolerance) {
        return Ok(usual);
    }
    let thorough = follow(contact, &normal, Refactorising::Thorough, monitor)?;
    if thorough.ending != Ending::Done {
        return Ok(thorough);
    }
    let effort = thorough.effort;
    let refined = Candidate::of_displacements(
        contact,
        normal.refine(thorough.d().to_vec(), monitor),
        Ending::Done,
    );
    Ok(refined.with_effort(effort))
}

fn follow(
    contact: &Contact<'_>,
    normal: &NormalProblem<'_>,
    care: Refactorising,
    monitor: &mut Monitor<'_>,
) -> Result<Candidate, Error> {
    // The clearances z = x - l, with w = (q + M l) + M z.
    let bounded = normal.lcp();
    let q = bounded.w(bounded.lower);
    let root = normal.restrict(&contact.problem().unit_roots());
    let scale: Vec<f64> = root.iter().map(|root| root.recip()).collect();
    let problem = ScaledLcp { matrix: &bounded.matrix, q: &q, covering: &root, scale: &scale };
    let run = path::follow(problem, LemkeRules::usual(care), monitor)?;
    let ending = match run.ending {
        Ending::Recession(ray) => Ending::Recession(normal.follow(&ray)),
        other => other,
    };
    let x: Vec<f64> = bounded.lower.iter().zip(&run.z).map(|(lower, z)| lower + z).collect();
    let mut candidate = Candidate::of_displacements(contact, normal.expand(&x), ending);
    candidate.effort.refactorisations = run.refactorisations;
    Ok(candidate)
}
