//! Load cases of a model.

use std::sync::{Mutex, PoisonError};

use super::args::{Arrays, size};
use super::case_arguments::{CaseArguments, LoadCases, times};
use super::extra::SignoriniExtra;
use super::guard::{self, Failure};
use super::model::SignoriniModel;
use super::outputs::{OutputArguments, Outputs};
use super::report::SignoriniReport;
use super::settings::{ParsedSettings, SignoriniSettings, WarmStart};
use super::status::remember;
use super::threads::{LoadCaseChunk, Solved, Start, ThreadCases, on_each, stopped, with_workers};
use crate::error::{Argument, Error, Message};
use crate::model::{BLOCK, Model, Past, Series};
use crate::monitor::ProgressFn;
use crate::shortage;
use crate::solve::Solution;
use crate::workers::SingleThread;

const SETTINGS: i32 = 9;
const START: i32 = 10;

/// Solves load cases with one friction law. Every array has a column for each case, without space
/// between the columns. A case that is wrong or not solved does not stop the others; of a wrong one
/// only its status is written.
///
/// Many cases in one call cost less than one by one: they share condensed loads and, with friction
/// in 3D, the elimination of pairs that stay open. So the last digits of a result depend on the
/// cases before it in the call.
///
/// @param model        the model
/// @param cases        number of load cases, 0 allowed
/// @param f            your nodal loads, H a case
/// @param prescribed   values of the fixed degrees of freedom, in the order of fixed; NULL: zero
/// @param gap,law,friction,slip0,settings  as for signorini_solve
/// @param d            out: relative displacements, N a case; in: the starts if
///                     settings->warm_start
/// @param F            out: contact forces, N a case
/// @param status       out: status of each case, -k for the k-th argument of this call; may be NULL
/// @param report       out: one for each case, each with its struct_size set; may be NULL
/// @param state,extra  as for signorini_solve
/// @return 0: every case is solved; otherwise the status of the first that is not, which
///         signorini_last_error names
#[unsafe(no_mangle)]
#[allow(non_snake_case)] // the names of the mechanics, which the header shows
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
    guard::call(|| {
        // SAFETY: the header's contract.
        let mut arrays = unsafe { Arrays::of_call() };
        let handle = arrays.model_handle(model)?;
        let model = handle.model();
        let cases = size(2, "cases", cases)?;
        let received = SignoriniSettings::read(&mut arrays, SETTINGS, settings)?;
        let limit = received.settings.memory_limit;
        let load_cases = given.read(&mut arrays, model, cases, limit)?;
        received.settings.validate().map_err(|error| Failure::from_error(error, |_| SETTINGS))?;
        let (pairs, n) = (model.pairs(), model.dim() * model.pairs());
        times(cases, n)?;
        let outputs = wanted.note(&mut arrays, (START, 14), (n, pairs, cases))?;
        arrays.check_overlap()?;
        let block = Block { model, given: &given, load_cases, outputs };
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
    given: &'a CaseArguments,
    load_cases: LoadCases<'a>,
    outputs: Outputs,
}

impl Block<'_> {
    /// Solves all cases and writes their results. Returns the status of the first one that is not
    /// solved, and remembers its message; and what is left for further calls. `past` is what earlier
    /// ones have left.
    fn solve_all(
        &self,
        cases: usize,
        past: Option<Past>,
        received: &ParsedSettings,
    ) -> (i32, Option<Past>) {
        let goes_on = received.warm_start == WarmStart::Previous;
        let mut lanes = self.lanes(cases, past, received);
        let mut first: Option<(usize, i32, Message)> = None;
        while lanes.iter().any(|lane| !lane.left.is_empty()) {
            for (case, solved) in self.next_of(&mut lanes, received) {
                let (code, message) =
                    solved.map_or_else(stopped, |solved| self.write(case, solved));
                self.outputs.status.part(case, 1).write(&[code]);
                if code != 0 && first.as_ref().is_none_or(|(earlier, ..)| case < *earlier) {
                    first = Some((case, code, message));
                }
            }
        }
        let past = lanes.pop().filter(|_| goes_on).map(|lane| lane.series.into_past());
        let Some((case, code, message)) = first else { return (0, past) };
        // A call with one case needs no number of it.
        remember(if cases == 1 { message } else { message.in_case(case) });
        (code, past)
    }

    /// The cases in as many parts as there are threads. One thread has them all where each starts
    /// from the one before, where a callback waits on the calling thread, and where the host's own
    /// functions are called.
    fn lanes(
        &self,
        cases: usize,
        past: Option<Past>,
        received: &ParsedSettings,
    ) -> Vec<ThreadCases<'_>> {
        let model = self.model;
        if received.warm_start == WarmStart::Previous {
            let series = Series::after(model, past.unwrap_or_else(Past::of_none));
            return vec![ThreadCases { left: 0..cases, series }];
        }
        let alone = received.has_callback() || model.is_matrix_free();
        let count = if alone { 1 } else { received.threads.min(cases) };
        let begin = |lane: usize| lane * cases / count;
        (0..count)
            .map(|lane| begin(lane)..begin(lane + 1))
            .map(|left| ThreadCases { series: Series::of(model, left.len()), left })
            .collect()
    }

    /// Solves the next block of each lane. Returns what each case has come to, by its number.
    fn next_of(
        &self,
        lanes: &mut [ThreadCases<'_>],
        received: &ParsedSettings,
    ) -> Vec<(usize, Solved)> {
        if let [lane] = lanes {
            let work = self.next_work(lane, received);
            let threads = if self.model.is_matrix_free() { received.threads } else { 1 };
            let solved = with_workers(threads, |workers| {
                let mut progress = received.progress();
                let progress = progress.as_mut().map(|progress| progress as &mut ProgressFn<'_>);
                work.solve(&mut lane.series, workers, &received.settings, progress)
            });
            return (work.begin..).zip(solved.into_iter().map(Ok)).collect();
        }
        let work: Vec<_> = lanes.iter_mut().map(|lane| self.next_work(lane, received)).collect();
        let series: Vec<_> = lanes.iter_mut().map(|lane| Mutex::new(&mut lane.series)).collect();
        let (model, settings) = (self.model, &received.settings);
        let solved = on_each(work.len(), &|lane| {
            guard::reserve_estimate(model.memory())?;
            guard::reserve_estimate(model.memory_of_cases(BLOCK))?;
            let mut series = series[lane].lock().unwrap_or_else(PoisonError::into_inner);
            Ok(work[lane].solve(&mut series, &SingleThread, settings, None))
        });
        let mut all = Vec::new();
        for (work, solved) in work.iter().zip(solved) {
            let many = work.cases.len();
            let each = solved.map_or_else(
                |code| (0..many).map(|_| Err(code)).collect(),
                |solved| solved.into_iter().map(Ok).collect::<Vec<_>>(),
            );
            all.extend((work.begin..).zip(each));
        }
        all
    }

    /// Takes the next block of a lane.
    fn next_work(
        &self,
        lane: &mut ThreadCases<'_>,
        received: &ParsedSettings,
    ) -> LoadCaseChunk<'_> {
        let n = self.model.dim() * self.model.pairs();
        let begin = lane.left.start;
        let many = BLOCK.min(lane.left.len());
        lane.left.start += many;
        let cases = (begin..begin + many).map(|k| self.load_cases.case(k)).collect();
        let start = match received.warm_start {
            WarmStart::None => Start::Cold,
            WarmStart::Given => {
                let forces = self.model.starts_from_forces();
                let place = if forces { &self.outputs.force } else { &self.outputs.d };
                Start::Given(place.part(n * begin, n * many).read())
            }
            WarmStart::Previous => Start::Previous,
        };
        LoadCaseChunk { begin, cases, start }
    }

    /// Writes the results of a case, unless it is wrong. Returns status and message.
    fn write(&self, case: usize, solved: Result<Solution, Error>) -> (i32, Message) {
        match solved {
            Ok(solution) => (self.outputs.write(case, &solution), solution.message),
            Err(error) => {
                let message = error.message();
                let position = |argument| {
                    let forces = i32::from(self.model.starts_from_forces());
                    let own = if argument == Argument::Start { START + forces } else { SETTINGS };
                    self.given.position(argument, own)
                };
                (Failure::from_error(error, position).code(), message)
            }
        }
    }
}
