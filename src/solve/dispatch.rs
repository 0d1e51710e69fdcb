//! One method on one problem: which it fits, and what runs it.

use super::candidate::{Candidate, Ending};
use super::smallest_lift::without_idle_motion;
use super::{active_set, lemke, normal_map, path, sweeps};
use crate::error::{Argument, Error};
use crate::law::Contact;
use crate::monitor::Monitor;
use crate::settings::{Method, Settings};

/// Refuses a method that does not fit the problem.
pub fn check_method(contact: &Contact<'_>, method: Method) -> Result<(), Error> {
    let refuse = |message: &str| Err(Error::invalid(Argument::Settings, message));
    let frictionless = contact.is_frictionless();
    let planar = contact.dim() == 2;
    let general = matches!(method, Method::Auto | Method::Newton | Method::Path);
    if !general && !contact.problem().is_symmetric() {
        return refuse(
            "settings: this method needs a symmetric K: use Newton's, the path, or auto",
        );
    }
    match method {
        Method::Lemke if !frictionless && !planar => {
            refuse("settings: Lemke's method is for frictionless contact, and for friction in 2D")
        }
        Method::BlockPivoting if !frictionless => refuse(&format!(
            "settings: block pivoting is for frictionless contact: the law must be frictionless, or {}",
            contact.problem().law().frictionless_if()
        )),
        Method::SorDiagonal if !frictionless && !contact.is_coupled() => refuse(
            "settings: the diagonal method updates thresholds, and here they are given: use the \
             nested one",
        ),
        _ => Ok(()),
    }
}

/// Runs one method, which fits the problem.
pub fn run(
    method: Method,
    contact: &Contact<'_>,
    settings: &Settings,
    start: Option<&[f64]>,
    monitor: &mut Monitor<'_>,
) -> Result<Candidate, Error> {
    if contact.pairs().is_empty() {
        return Ok(Candidate::without_displacements(contact, Ending::Done));
    }
    let candidate = run_plainly(method, contact, settings, start, monitor)?;
    let candidate = without_idle_motion(contact, candidate, monitor);
    Ok(normal_map::polished(contact, settings, candidate, monitor))
}

fn run_plainly(
    method: Method,
    contact: &Contact<'_>,
    settings: &Settings,
    start: Option<&[f64]>,
    monitor: &mut Monitor<'_>,
) -> Result<Candidate, Error> {
    let start_or_zero = || start.map_or_else(|| vec![0.0; contact.unknowns()], <[f64]>::to_vec);
    Ok(match (method, contact.is_frictionless()) {
        (Method::Lemke, true) => lemke::frictionless(contact, settings, monitor)?,
        (Method::Lemke, false) => lemke::friction_2d(contact, settings, monitor)?,
        (Method::Newton, _) if contact.dim() == 2 => {
            active_set::newton(contact, settings, start, monitor)
        }
        (Method::Newton, _) => normal_map::newton(contact, settings, start, monitor),
        (Method::Path, _) if contact.dim() == 2 => path::linear(contact, settings, start, monitor),
        (Method::Path, _) => path::curved(contact, settings, start, monitor),
        (Method::BlockPivoting, _) => {
            let chosen = settings.method == Method::BlockPivoting;
            let most = if chosen { u64::MAX } else { active_set::enough(contact.pairs().len()) };
            active_set::contact(contact, settings, start, most, monitor)
        }
        (_, true) => sweeps::frictionless(contact, settings, &start_or_zero(), monitor),
        // Thresholds that do not depend on the pressure need no updates.
        (Method::SorNested, false) if contact.is_coupled() => {
            sweeps::nested(contact, settings, start_or_zero(), monitor)
        }
        _ => sweeps::single(contact, settings, start_or_zero(), monitor),
    })
}
