//! Frictionless contact, reduced to normal displacements: by Lemke's method (paper, section 2.2)
//! and by projected SOR.
//!
//! A load that drives a motion free of contact has no equilibrium, and neither has one that ends
//! Lemke's path in a ray: `M` is positive semi-definite.

use super::elimination::{Elimination, Obstruction};
use super::lemke::{self, Care, Path, Rules};
use super::sweeps::{LARGEST_FACTOR, Sweeps};
use super::{Candidate, Ending};
use crate::certificate::{certify, is_escape};
use crate::error::Error;
use crate::lcp::Lcp;
use crate::monitor::Monitor;
use crate::problem::ContactProblem;
use crate::settings::Settings;

/// Solves by Lemke's method. It needs no start.
pub fn lemke(
    problem: &ContactProblem<'_>,
    settings: &Settings,
    monitor: &mut Monitor<'_>,
) -> Result<Candidate, Error> {
    let elimination = match Elimination::new(problem) {
        Ok(elimination) => elimination,
        Err(obstruction) => return Ok(obstructed(problem, obstruction)),
    };
    let usual = follow_path(problem, &elimination, Care::Usual, monitor)?;
    let settled = match &usual.ending {
        Ending::Done => certify(problem, &usual.d).holds(settings.tolerance),
        Ending::Escape(motion) => is_escape(problem, motion),
        Ending::Interrupted(_) => true,
        _ => false,
    };
    if settled {
        return Ok(usual);
    }
    let mut thorough = follow_path(problem, &elimination, Care::Thorough, monitor)?;
    if thorough.ending == Ending::Done {
        thorough.d = elimination.polished(thorough.d);
    }
    Ok(thorough)
}

fn follow_path(
    problem: &ContactProblem<'_>,
    elimination: &Elimination<'_>,
    care: Care,
    monitor: &mut Monitor<'_>,
) -> Result<Candidate, Error> {
    // p = q + M w in the openings w = gap - d_n and the pressures p = -F_n.
    let reduced = elimination.reduced();
    let gap: Vec<f64> = (0..reduced.pairs()).map(|i| reduced.gap(i)).collect();
    let q: Vec<f64> = reduced.force(&gap).iter().map(|force| -force).collect();
    let root: Vec<f64> = elimination.kept().iter().map(|&i| problem.diagonal(i).sqrt()).collect();
    let scale: Vec<f64> = root.iter().map(|root| root.recip()).collect();
    let size = q.len();
    let Ok(lcp) = Lcp::new(size, elimination.matrix(), size.max(1), &q, Some(&root)) else {
        let ending = Ending::Stalled("numbers overflow in the reduced problem");
        return Ok(Candidate::ended(elimination.expand(&gap), ending));
    };
    let run = lemke::lemke(&lcp, &scale, Rules::usual(care), monitor)?;
    let ending = match run.path {
        Path::Solution => Ending::Done,
        Path::Interrupted(reason) => Ending::Interrupted(reason),
        Path::Breakdown => Ending::Stalled("rounding made Lemke's basis singular"),
        Path::Ray(ray) => {
            let opening: Vec<f64> = ray.iter().map(|w| -w).collect();
            Ending::Escape(elimination.follow(&opening))
        }
    };
    let normal: Vec<f64> = gap.iter().zip(&run.z).map(|(gap, w)| gap - w).collect();
    let d = elimination.expand(&normal);
    Ok(Candidate { refactorisations: run.refactorisations, ..Candidate::ended(d, ending) })
}

/// Solves by projected SOR on the normal displacements.
pub fn sor(
    problem: &ContactProblem<'_>,
    settings: &Settings,
    start: &[f64],
    monitor: &mut Monitor<'_>,
) -> Candidate {
    let elimination = match Elimination::new(problem) {
        Ok(elimination) => elimination,
        Err(obstruction) => return obstructed(problem, obstruction),
    };
    let reduced = elimination.reduced();
    let start = elimination.kept().iter().map(|&i| start[i]).collect();
    let mut sweeps = Sweeps::new(&reduced, settings, start, LARGEST_FACTOR, monitor);
    // The reduced problem has another scale of forces than the whole one: what counts is the latter.
    let mut target = settings.tolerance;
    let ending = loop {
        match sweeps.solve(target) {
            Ok(()) => {}
            Err(Ending::Escape(motion)) => break Ending::Escape(elimination.follow(&motion)),
            Err(other) => break other,
        }
        let solved = certify(problem, &elimination.expand(sweeps.d())).holds(settings.tolerance);
        if solved || target < f64::EPSILON * settings.tolerance {
            break Ending::Done;
        }
        target *= 0.1;
    };
    let d = elimination.expand(sweeps.d());
    Candidate { omega: sweeps.omega(), ..Candidate::ended(d, ending) }
}

fn obstructed(problem: &ContactProblem<'_>, obstruction: Obstruction) -> Candidate {
    let ending = match obstruction {
        Obstruction::Indefinite => Ending::Stalled("K is not positive semi-definite"),
        Obstruction::Driven(motion) => Ending::Escape(motion),
    };
    Candidate::ended(vec![0.0; problem.unknowns()], ending)
}
