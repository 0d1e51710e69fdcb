//! The one table of methods: what each takes, what runs it, and where it stands in a plan.

use crate::counters::count;
use crate::error::{Argument, Error};
use crate::law::Contact;
use crate::monitor::Stop;
use crate::settings::Method;
use crate::solve::result::{Call, Candidate, Effort, Ending};
use crate::solve::rigid::{self, Balance, leave_idle_motion};
use crate::solve::{lcp, newton, path, proximal, sweeps};

/// A row of the table.
pub struct MethodRow {
    /// The method that the result names.
    pub method: Method,
    /// The name of the row in counts.
    pub name: &'static str,
    /// Where a plan takes the start from.
    pub start: Start,
    /// Why the method does not fit a problem; `None` if it fits.
    refuses: fn(&Contact<'_>) -> Option<String>,
    /// Runs the method; `None` if there is nothing for it to do.
    run: fn(&Call<'_>) -> Result<Option<Candidate>, Error>,
}

impl MethodRow {
    /// Runs the method on a problem that it fits, and refines what it finds; `None` if there is nothing for it to do.
    pub fn candidate(&self, call: &Call<'_>) -> Result<Option<Candidate>, Error> {
        let contact = call.contact;
        if contact.pairs().is_empty() {
            return Ok(Some(Candidate::without_displacements(contact, Ending::Done)));
        }
        let mut found = (self.run)(call)?;
        let Some(candidate) = &mut found else { return Ok(None) };
        leave_idle_motion(call, candidate);
        newton::refine_to_tolerance(call, candidate);
        // To a method a factorisation that was ended is that of a singular or indefinite matrix, and a question that was
        // ended is one without an answer.
        if matches!(candidate.ending, Ending::Singular | Ending::Cycle | Ending::Stalled(_))
            && let Some(stop) = call.monitor.stop()
        {
            candidate.ending = Ending::Stopped(stop);
        }
        Ok(found)
    }
}

/// Where a method starts.
#[derive(Clone, Copy, PartialEq)]
pub enum Start {
    /// At the start of the call.
    Own,
    /// At the best displacements that methods before it have left.
    Best,
    /// At these; at the start of the call if they have left none, as behind a solution of negative orientation.
    Nearest,
}

/// Without friction: methods of linear complementarity first, which end where Newton's method and the path give up.
const WITHOUT_FRICTION: [&MethodRow; 5] = [&BLOCK_PIVOTING, &LEMKE, &NEWTON, &PATH, &NESTED_SWEEPS];

/// With friction: the fastest method first.
///
/// In the plane the path has the guarantee, by theorem K where contact alone holds a body too. It starts where sweeps end
/// and takes far fewer events than Lemke's method takes pivots on most problems: behind a solution of negative orientation
/// that takes up to eight times as long. Lemke's method may end where rounding spoils all starts of the path, or where a
/// body without supports leaves it on a ray that proves nothing. Springs come after both: where the problem with `K` is hard
/// for Newton's method, so are those with springs; a body on rollers with 513 pairs takes 330 systems of springs where the
/// path takes 30.
///
/// In space the path proves nothing where contact alone holds a body, so that springs come before it, by Newton's method.
/// Where that fails on springs, the path on `K` ends with a solution in most cases, for a tenth of the systems of paths on
/// one problem with springs after the other: those come last.
const WITH_FRICTION: [&MethodRow; 10] = [
    &NEWTON,
    &BALANCE,
    &SPRINGS_IN_SPACE,
    &PATH_FROM_BEST,
    &LEMKE,
    &PATH,
    &SPRINGS_BY_PATH,
    &NESTED_SWEEPS,
    &DIAGONAL_SWEEPS,
    &SWEEPS_FROM_BEST,
];

/// The methods of a problem that leaves the choice to the library, in turn: all that fit.
pub fn plan(contact: &Contact<'_>) -> impl Iterator<Item = &'static MethodRow> {
    let rows: &[&MethodRow] =
        if contact.is_frictionless() { &WITHOUT_FRICTION } else { &WITH_FRICTION };
    rows.iter().copied().filter(|row| (row.refuses)(contact).is_none())
}

/// The row of a method that a host has chosen; `None`: the choice is the library's.
///
/// # Errors
/// A method that does not fit the problem.
pub fn chosen(contact: &Contact<'_>, method: Method) -> Result<Option<&'static MethodRow>, Error> {
    let row =
        WITHOUT_FRICTION.iter().chain(&WITH_FRICTION).find(|row| row.method == method).copied();
    match row.and_then(|row| (row.refuses)(contact)) {
        Some(message) => Err(Error::invalid(Argument::Settings, message)),
        None => Ok(row),
    }
}

const NEWTON: MethodRow = MethodRow {
    method: Method::Newton,
    name: "Newton",
    start: Start::Own,
    refuses: |_| None,
    run: |call| Ok(Some(newton_twice(call))),
};

/// Newton's method from the start of the call, and from nothing where that leads nowhere: where loads turn back, beams are
/// solved from nothing in some systems, and from the displacements before by the path alone.
fn newton_twice(call: &Call<'_>) -> Candidate {
    let (contact, tolerance) = (call.contact, call.settings.tolerance);
    let found = newton::newton(call);
    let is_over = found.ending == Ending::Done || found.is_settled(contact, tolerance);
    if is_over || call.start.is_none() {
        return found;
    }
    let alone = newton::newton(&Call { start: None, ..*call });
    count("Newton from nothing", 0, alone.ending == Ending::Done);
    let systems = found.effort.factorisations + alone.effort.factorisations;
    let is_nearer = alone.certificate(contact).eta < found.certificate(contact).eta;
    let nearer = if is_nearer { alone } else { found };
    nearer.with_effort(Effort::of_systems(systems))
}

/// The balance of rigid motions, where contact alone holds a body: it proves in most cases that no equilibrium exists,
/// if there is none.
const BALANCE: MethodRow = MethodRow {
    method: Method::Newton,
    name: "balance of rigid motions",
    start: Start::Best,
    refuses: unsymmetric,
    run: |call| {
        let ended =
            |motion| Candidate::without_displacements(call.contact, Ending::Recession(motion));
        Ok(rigid::escape(call.contact, call.monitor).map(ended))
    },
};

/// Springs that are let go, where contact alone holds a body.
const SPRINGS_IN_SPACE: MethodRow = MethodRow {
    method: Method::Newton,
    name: "springs",
    start: Start::Best,
    refuses: unsymmetric,
    run: |call| if call.contact.dim() == 2 { Ok(None) } else { springs(call, false) },
};

const SPRINGS_BY_PATH: MethodRow =
    MethodRow { name: "springs by the path", run: |call| springs(call, true), ..SPRINGS_IN_SPACE };

fn springs(call: &Call<'_>, by_path: bool) -> Result<Option<Candidate>, Error> {
    let Some(balance) = Balance::new(call.contact, call.monitor) else { return Ok(None) };
    let mut candidate = proximal::let_go(call, by_path);
    if let Ending::RunsAway(motion) = candidate.ending {
        candidate.ending = balance.ending_away(&motion);
    }
    Ok(Some(candidate))
}

const PATH_FROM_BEST: MethodRow =
    MethodRow { name: "path from the best iterate", start: Start::Nearest, ..PATH };

const PATH: MethodRow = MethodRow {
    method: Method::Path,
    name: "path",
    start: Start::Own,
    refuses: |_| None,
    run: |call| {
        let by = if call.contact.dim() == 2 { path::linear } else { path::curved };
        Ok(Some(by(call)))
    },
};

const BLOCK_PIVOTING: MethodRow = MethodRow {
    method: Method::BlockPivoting,
    name: "block pivoting",
    start: Start::Own,
    refuses: |contact| {
        let message = || {
            let law = contact.problem().law().frictionless_if();
            format!(
                "settings: block pivoting is for frictionless contact: the law must be frictionless, or {law}"
            )
        };
        unsymmetric(contact).or_else(|| (!contact.is_frictionless()).then(message))
    },
    run: |call| {
        let of_one_pair = newton::of_one_pair(call);
        Ok(Some(of_one_pair.unwrap_or_else(|| lcp::block_pivoting(call))))
    },
};

const LEMKE: MethodRow = MethodRow {
    method: Method::Lemke,
    name: "Lemke",
    start: Start::Own,
    refuses: |contact| {
        let fits = contact.is_frictionless() || contact.dim() == 2;
        let message =
            "settings: Lemke's method is for frictionless contact, and for friction in 2D";
        unsymmetric(contact).or_else(|| (!fits).then(|| message.to_owned()))
    },
    run: |call| lcp::lemke(call).map(Some),
};

const NESTED_SWEEPS: MethodRow = MethodRow {
    method: Method::SorNested,
    name: "nested sweeps",
    start: Start::Own,
    refuses: unsymmetric,
    run: |call| {
        if call.contact.is_coupled() {
            return for_a_while(call, || sweeps::nested(call));
        }
        single_sweeps(call)
    },
};

/// Where a plan's sweeps are too few from the start of the call, they may be enough from where other methods end.
const SWEEPS_FROM_BEST: MethodRow =
    MethodRow { name: "sweeps from the best iterate", start: Start::Best, ..DIAGONAL_SWEEPS };

const DIAGONAL_SWEEPS: MethodRow = MethodRow {
    method: Method::SorDiagonal,
    name: "diagonal sweeps",
    start: Start::Own,
    refuses: |contact| {
        let fits = contact.is_frictionless() || contact.is_coupled();
        let message = "settings: the diagonal method updates thresholds, and here they are given: \
                       use the nested one";
        unsymmetric(contact).or_else(|| (!fits).then(|| message.to_owned()))
    },
    run: single_sweeps,
};

/// Sweeps that update thresholds as they go, or have given ones.
fn single_sweeps(call: &Call<'_>) -> Result<Option<Candidate>, Error> {
    for_a_while(call, || match call.contact.is_frictionless() {
        true => sweeps::frictionless(call),
        false => sweeps::single(call),
    })
}

/// Sweeps that a plan tries where exact methods have failed: a fortieth of what they may take when they
/// are chosen; more is not worth the wait.
const LATER_SWEEPS: u64 = 5000;

/// Runs sweeps; in a plan only for a while.
fn for_a_while(
    call: &Call<'_>,
    sweeps: impl FnOnce() -> Candidate,
) -> Result<Option<Candidate>, Error> {
    if call.is_chosen() {
        return Ok(Some(sweeps()));
    }
    let (mut candidate, used_up) = call.monitor.within(LATER_SWEEPS, sweeps);
    if candidate.ending == Ending::Stopped(Stop::IterationLimit) && !used_up {
        candidate.ending = Ending::Stalled("no method converges");
    }
    Ok(Some(candidate))
}

fn unsymmetric(contact: &Contact<'_>) -> Option<String> {
    let message = "settings: this method needs a symmetric K: use Newton's, the path, or auto";
    (!contact.problem().is_symmetric()).then(|| message.to_owned())
}
