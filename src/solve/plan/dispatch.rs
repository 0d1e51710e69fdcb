//! One method on one problem: which it fits, and what runs it.

use super::table::{Call, MethodRow, chosen};
use crate::error::{Argument, Error};
use crate::law::Contact;
use crate::monitor::Monitor;
use crate::settings::Method;
use crate::solve::newton;
use crate::solve::result::{Candidate, Ending};
use crate::solve::rigid::without_idle_motion;

/// Refuses a method that does not fit the problem.
pub fn check_method(contact: &Contact<'_>, method: Method) -> Result<(), Error> {
    let refusal = match method {
        Method::Auto => None,
        method => chosen(contact, method).err(),
    };
    refusal.map_or(Ok(()), |message| Err(Error::invalid(Argument::Settings, message)))
}

/// Runs the method of a row, which fits the problem; `None` if there is nothing for it to do.
pub fn run(
    row: &MethodRow,
    call: &Call<'_>,
    monitor: &mut Monitor<'_>,
) -> Result<Option<Candidate>, Error> {
    let (contact, settings) = (call.contact, call.settings);
    if contact.pairs().is_empty() {
        return Ok(Some(Candidate::without_displacements(contact, Ending::Done)));
    }
    let Some(candidate) = (row.run)(call, monitor)? else { return Ok(None) };
    let candidate = without_idle_motion(contact, candidate, monitor);
    Ok(Some(newton::refine_to_tolerance(contact, settings, candidate, monitor)))
}
