//! Load cases of a model.

use std::mem::take;
use std::ops::Range;
use std::sync::Mutex;

use super::args::{Arrays, c_entry};
use super::case_arguments::{CaseArguments, LoadCases, times};
use super::guard::Failure;
use super::model::SignoriniModel;
use super::outputs::{OutputArguments, Outputs, SignoriniExtra};
use super::report::SignoriniReport;
use super::settings::{ParsedSettings, SignoriniSettings, WarmStart};
use super::status::{is_told, remember};
use super::threads::with_threads;
use crate::error::{Argument, Error, Message};
use crate::model::{BLOCK, Model, Past, Series, Starts};
use crate::monitor::ProgressFn;
use crate::settings::Settings;
use crate::shortage;
use crate::solve::Solution;
use crate::workers::{locked, share};

const SETTINGS: i32 = 9;
const START: i32 = 10;

/// Solves load cases. Every array has a column for each case, without space between. A case that is
/// wrong or not solved does not stop the others. Only the status is written of a case that is
/// wrong, or had not begun when the callback cancelled.
///
/// Many cases in one call share work: they cost less than one by one, and the last digits depend on
/// the cases before.
///
/// @param model,cases  the model; number of load cases, 0 allowed
/// @param f            your nodal loads, H a case
/// @param prescribed   values of the fixed degrees of freedom, in the order of fixed; NULL: zero
/// @param gap,law,friction,slip0,settings,d,F,state,extra  as for signorini_solve
/// @param status       out: status of each case, -k for the k-th argument of this call; may be NULL
/// @param report       out: one a case, each with its struct_size set; may be NULL
/// @return 0: every case is solved; otherwise the status of the first that is not, which
///         signorini_last_error names
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_model_solve(
    model: *const SignoriniModel,
    cases: i64,
    f: *const f64,
    prescribed: *const f64,
    gap: *const f64,
    law: i32,
    friction: *const f64,
    slip0: *const f64,
    settings: *const SignoriniSettings,
    d: *mut f64,
    F: *mut f64,
    state: *mut i32,
    status: *mut i32,
    report: *mut SignoriniReport,
    extra: *const SignoriniExtra,
) -> i32 {
    let given = CaseArguments { first: 3, f, prescribed, gap, law, friction, slip0 };
    let wanted = OutputArguments { d, F, state, status, report, extra };
    c_entry!(|arrays| {
        let handle = arrays.model(model)?;
        let model = &handle.model;
        let cases = arrays.at(2, "cases").size(cases)?;
        let received = SignoriniSettings::read(arrays.at(SETTINGS, "settings"), settings)?;
        let limit = received.settings.memory_limit;
        let load_cases = given.read(arrays, model, cases, limit)?;
        let (pairs, n) = (model.pairs(), model.dim() * model.pairs());
        times(cases, n)?;
        let outputs = wanted.note(arrays, (START, 14), (n, pairs, cases))?;
        arrays.check_overlap()?;
        let start = START + i32::from(model.starts_from_forces());
        arrays.at(start, "start").is(Argument::Start);
        let block = Block { model, arrays, load_cases, outputs };
        let past = handle.replace_past(None);
        let (answer, past) = block.solve_all(cases, past, &received);
        // The reserve of a call holds nothing that outlives it.
        if !shortage::is_noted() {
            handle.replace_past(past);
        }
        Ok(answer)
    })
}

/// A block of load cases and where their results go.
struct Block<'a> {
    model: &'a Model,
    arrays: &'a Arrays,
    load_cases: LoadCases<'a>,
    outputs: Outputs,
}

/// Load cases that are solved one after the other.
struct Lane<'m> {
    left: Range<usize>,
    series: Series<'m>,
    /// The caller's starts of the next cases.
    starts: Vec<f64>,
    /// The results of the last cases, each with its number.
    solved: Vec<(usize, Result<Solution, Error>)>,
}

impl Lane<'_> {
    /// Solves the next cases.
    fn solve_next(
        &mut self,
        cases: &LoadCases<'_>,
        (settings, start): (&Settings, WarmStart),
        progress: Option<&mut ProgressFn<'_>>,
    ) {
        let next = self.left.start..self.left.end.min(self.left.start + BLOCK);
        self.left.start = next.end;
        let cases: Vec<_> = next.clone().map(|k| cases.case(k)).collect();
        let starts = match start {
            WarmStart::None => Starts::Cold,
            WarmStart::Given => Starts::Given(&self.starts),
            WarmStart::Previous => Starts::Previous(None),
        };
        let solved = self.series.solve_cases(&cases, settings, starts, progress);
        self.solved = next.zip(solved).collect();
    }
}

impl Block<'_> {
    /// Solves all cases and writes their results. Returns the status of the first one that is not
    /// solved, and remembers its message, or the first remark; and what is left for further calls. `past` is what earlier
    /// ones have left.
    fn solve_all(
        &self,
        cases: usize,
        past: Option<Past>,
        received: &ParsedSettings,
    ) -> (i32, Option<Past>) {
        let goes_on = received.warm_start == WarmStart::Previous;
        let mut lanes = self.lanes(cases, past, received);
        // A case that is not solved is told before one with a remark.
        let mut told: Option<((bool, usize), i32, Message)> = None;
        // Threads share the cases, or the work of each of them.
        let (threads, memory) = match lanes.len() {
            1 => (received.threads, 0),
            _ => {
                let more = self.model.memory_of_cases(BLOCK) + self.load_cases.memory_of_ties();
                (lanes.len(), self.model.memory().saturating_add(more))
            }
        };
        with_threads(threads, memory, || {
            while lanes.iter().any(|lane| !lane.left.is_empty()) {
                self.solve_next(&mut lanes, received);
                for (case, solved) in lanes.iter_mut().flat_map(|lane| take(&mut lane.solved)) {
                    let (code, message) = self.write(case, solved);
                    self.outputs.status.part(case, 1).write(&[code]);
                    let rank = (code == 0, case);
                    if let Some(message) = message
                        && told.as_ref().is_none_or(|(before, ..)| rank < *before)
                    {
                        told = Some((rank, code, message));
                    }
                }
            }
        });
        let past = lanes.pop().filter(|_| goes_on).map(|lane| lane.series.past);
        let Some(((_, case), code, message)) = told else { return (0, past) };
        // A call with one case needs no number of it.
        remember(if cases == 1 { message } else { message.in_case(case) });
        (code, past)
    }

    /// The cases in as many parts as there are threads. One thread has them all where each starts
    /// from the one before, where a callback waits on the calling thread, and where the host's own
    /// functions are called.
    fn lanes(&self, cases: usize, past: Option<Past>, received: &ParsedSettings) -> Vec<Lane<'_>> {
        let model = self.model;
        let lane = |left, series| Lane { left, series, starts: Vec::new(), solved: Vec::new() };
        if received.warm_start == WarmStart::Previous {
            return vec![lane(0..cases, Series::after(model, past.unwrap_or_else(Past::of_none)))];
        }
        let alone = received.progress.is_some() || model.is_matrix_free();
        let count = if alone { 1 } else { received.threads.min(cases) };
        let begin = |lane: usize| lane * cases / count;
        let parts = (0..count).map(|number| begin(number)..begin(number + 1));
        parts.map(|left| lane(left.clone(), Series::of(model, left.len()))).collect()
    }

    /// Solves the next cases of each lane.
    fn solve_next(&self, lanes: &mut [Lane<'_>], received: &ParsedSettings) {
        if received.warm_start == WarmStart::Given {
            lanes.iter_mut().for_each(|lane| self.take_starts(lane));
        }
        let (cases, how) = (&self.load_cases, (&received.settings, received.warm_start));
        if let [lane] = lanes {
            let mut progress = received.progress();
            let progress = progress.as_mut().map(|progress| progress as &mut ProgressFn<'_>);
            return lane.solve_next(cases, how, progress);
        }
        let parts: Vec<_> = lanes.iter_mut().map(Mutex::new).collect();
        let work = |_, part: usize| locked(&parts[part]).solve_next(cases, how, None);
        share(parts.len(), f64::INFINITY, &work, &mut || true);
    }

    /// Copies the starts that the caller gives to the next cases of a lane.
    fn take_starts(&self, lane: &mut Lane<'_>) {
        let n = self.model.dim() * self.model.pairs();
        let forces = self.model.starts_from_forces();
        let place = if forces { &self.outputs.force } else { &self.outputs.d };
        lane.starts = place.part(n * lane.left.start, n * BLOCK.min(lane.left.len())).read();
    }

    /// Writes the results of a case, unless it is wrong. Returns status and message, if there is one to be read.
    fn write(&self, case: usize, solved: Result<Solution, Error>) -> (i32, Option<Message>) {
        match solved {
            Ok(solution) => {
                let status = self.outputs.write(case, &solution);
                (status, is_told(&solution).then_some(solution.message))
            }
            Err(error) => {
                let Failure { code, message } = self.arrays.refused(SETTINGS)(error);
                (code, Some(message))
            }
        }
    }
}
