//! The judge of an answer: it takes what a host has, data and answer, and says what is false in it. All
//! sums are in twice the precision; nothing is shared with the library.

use signorini::{Solution, State, Status, Uniqueness};

use super::all_states::{AllSolutions, MOST_PAIRS, all_solutions};
use super::edges::Problem;
use super::ellipses::axes;
use super::escape::flaw_of_motion;
use super::exact::{
    BEYOND_ROUNDING, UNIT, differ, eta, force, is_definite, largest_stiffness, own_line,
    parts as parts_of, quads, refined, residual, rounding, scale, threshold, work,
};
use super::problems::Case;
use super::quad::{Quad, largest, norm};

/// Statements that can be false.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// Status 0, and the residual of `d` as returned is above the reported `eta`.
    AboveEta,
    /// Status 0, and the residual of `d` as returned is above the tolerance.
    AboveTolerance,
    /// Status 0, and the residual is above the reported `eta` by more than the rounding of `d` to doubles
    /// can be the cause of.
    BeyondRounding,
    /// Status 0, and `F` breaks the law, or is not what equilibrium at `d` needs, or `state` is not its.
    Forces,
    /// Status 0, and the forces do not balance the loads on a rigid motion.
    Imbalance,
    /// Status 4, and `K` is definite, or a solution was found.
    WrongProof,
    /// Status 4, and the motion proves nothing.
    Motion,
    /// "Unique", and there are several.
    Unique,
    /// "Several", and there is one, or the second is none.
    Several,
    /// No answer, and `K` is definite, of a condition number up to 1e10 with its diagonal scaled to 1.
    UnsolvedRegular,
    /// The same of a condition number from 1e10 to 1e12.
    UnsolvedTo1e12,
    /// No answer, and there is a solution, of another `K`.
    Unsolved,
    /// Good data refused.
    Refused,
    /// A number that is not finite, or a status without its reason.
    Report,
}

pub const FAULTS: [Fault; 14] = [
    Fault::AboveEta,
    Fault::AboveTolerance,
    Fault::BeyondRounding,
    Fault::Forces,
    Fault::Imbalance,
    Fault::WrongProof,
    Fault::Motion,
    Fault::Unique,
    Fault::Several,
    Fault::UnsolvedRegular,
    Fault::UnsolvedTo1e12,
    Fault::Unsolved,
    Fault::Refused,
    Fault::Report,
];

/// Units of rounding by which two correct doubles of one number may differ: the reported one is rounded
/// once, and its formula (three roots, a quotient) a few times.
const DIGITS: f64 = 8.0 * UNIT;

/// Part of the loads that may be missing in the balance of a rigid motion.
const BALANCE: f64 = 1e-9;

/// A displacement counts as a solution of a matrix that is singular up to rounding only if its rounding
/// does not hide the forces: the library's own limit for what it certifies.
const HIDDEN: f64 = 1e-6;

/// The results that a host has after a call.
pub struct Answer<'a> {
    pub status: Status,
    /// Displacements; of an answer that has more digits than a double, all of them.
    pub d: Vec<Quad>,
    pub force: &'a [f64],
    pub states: &'a [State],
    pub eta: f64,
    /// The reported `max |K d - f - F|`.
    pub equilibrium: f64,
    pub uniqueness: Uniqueness,
    pub second: Option<Vec<Quad>>,
    pub motion: Option<&'a [f64]>,
}

impl<'a> Answer<'a> {
    pub fn new(solution: &'a Solution) -> Self {
        Answer {
            status: solution.status,
            d: whole(&solution.d, &solution.d_low),
            force: &solution.certificate.force,
            states: &solution.certificate.states,
            eta: solution.certificate.eta,
            equilibrium: solution.certificate.equilibrium,
            uniqueness: solution.uniqueness,
            second: solution.second.as_ref().map(|second| whole(&second.d, &second.d_low)),
            motion: solution.recession.as_deref(),
        }
    }
}

/// `d + low`.
fn whole(d: &[f64], low: &[f64]) -> Vec<Quad> {
    d.iter().zip(low).map(|(&d, &low)| Quad::sum(d, low)).collect()
}

/// A fault, how bad it is beside others of its kind, and a sentence.
#[derive(Clone, Debug)]
pub struct Finding {
    pub fault: Fault,
    pub size: f64,
    pub text: String,
}

pub type Faults = Vec<Finding>;

/// A fault of a kind that has no size.
fn plain(fault: Fault, text: impl Into<String>) -> Finding {
    Finding { fault, size: 1.0, text: text.into() }
}

/// All that is false in an answer.
pub fn judge(problem: &Problem, answer: &Answer<'_>, tolerance: f64) -> Faults {
    let case = &problem.case;
    let mut faults = Faults::new();
    if !answer.d.iter().all(|d| d.value().is_finite())
        || !answer.force.iter().all(|f| f.is_finite())
    {
        faults.push(plain(Fault::Report, "a number is not finite"));
        return faults;
    }
    match answer.status {
        Status::Solved => {
            judge_residual(case, answer, tolerance, &mut faults);
            judge_forces(case, answer, &mut faults);
            judge_balance(problem, answer, tolerance, &mut faults);
            judge_uniqueness(case, answer, tolerance, &mut faults);
        }
        Status::NoEquilibrium => judge_proof(problem, answer, &mut faults),
        Status::Stalled | Status::IterationLimit => {
            if let Some(why) = solvable(problem) {
                let fault = without_answer(case);
                faults.push(plain(fault, format!("{:?}, but {why}", answer.status)));
            }
        }
        other => faults.push(plain(Fault::Report, format!("no reason to end with {other:?}"))),
    }
    faults
}

/// The fault of an answer that is none, where there is a solution, by the condition of `K`.
pub fn without_answer(case: &Case) -> Fault {
    // The largest eigenvalue is at most n: no smallest one is below n / 1e10, or n / 1e12.
    if is_definite(case, 1e-10 / UNIT) {
        Fault::UnsolvedRegular
    } else if is_definite(case, 1e-12 / UNIT) {
        Fault::UnsolvedTo1e12
    } else {
        Fault::Unsolved
    }
}

fn judge_residual(case: &Case, answer: &Answer<'_>, tolerance: f64, faults: &mut Faults) {
    let Answer { d, eta: reported, .. } = answer;
    if !(*reported >= 0.0 && *reported <= tolerance) {
        faults.push(plain(Fault::Report, format!("solved with eta {reported:e}")));
    }
    let found = eta(case, d);
    let least = rounding(case, d, scale(case, &force(case, d)).value());
    let mut above = |fault: Fault, limit: f64| {
        if !(found <= limit * (1.0 + DIGITS)) {
            let text =
                format!("residual {found:.2e}, reported {reported:.2e}, rounding {least:.2e}");
            faults.push(Finding { fault, size: found - limit, text });
        }
    };
    above(Fault::AboveEta, *reported);
    above(Fault::AboveTolerance, tolerance);
    above(Fault::BeyondRounding, reported + least);
}

/// `F` obeys the law, has the states that are told, and is `K d - f` up to what a residual of `eta` and
/// the rounding of `d` leave: the force of the law next to it is `(1 + mu) |e|` away at most.
fn judge_forces(case: &Case, answer: &Answer<'_>, faults: &mut Faults) {
    let dim = case.dim;
    let exact = force(case, &answer.d);
    let mut wrong = |size: f64, text: String| {
        faults.push(Finding { fault: Fault::Forces, size, text });
    };
    for pair in 0..case.pairs {
        let part = &answer.force[dim * pair..dim * (pair + 1)];
        let bound = threshold(case, pair, part[0].into());
        // With an ellipse the friction beyond it, which rounding of a component may leave.
        let friction = quads(&part[1..]);
        let ellipse = axes(case, pair);
        let tangential = match &ellipse {
            Some(axes) if axes.size(&friction) > bound => {
                let carried = axes.nearest(&friction, bound);
                let beyond: Vec<Quad> = (0..2).map(|c| friction[c] - carried[c]).collect();
                bound + norm(&beyond)
            }
            Some(_) => Quad::ZERO,
            None => norm(&friction),
        };
        let state = answer.states[pair];
        let free = case.gap[pair] == f64::INFINITY;
        let tension = case.law.of(pair)[2];
        if part[0] > tension || (part[0] != tension && (free || state == State::Open)) {
            wrong(f64::INFINITY, format!("pair {pair} is {state:?} with F_n = {:e}", part[0]));
        }
        // The reported F_n is rounded where it is far from the tension that it is taken from.
        let [mu, _, a] = case.law.of(pair);
        let allowed = bound * (1.0 + DIGITS) + Quad::from(DIGITS * mu * (a + part[0].abs()));
        if tangential > allowed {
            wrong(
                f64::INFINITY,
                format!("pair {pair}: |F_t| {:e} > {:e}", tangential.value(), bound.value()),
            );
        }
    }
    let mu =
        (0..case.pairs).map(|pair| case.law.of(pair)[0] + own_line(case, pair)).fold(0.0, f64::max);
    let scale = scale(case, &exact).value();
    let error: Vec<Quad> =
        exact.iter().zip(answer.force).map(|(exact, f)| *exact - Quad::from(*f)).collect();
    let left = norm(&residual(case, &answer.d, &exact)).value();
    let least = UNIT * scale + rounding(case, &answer.d, 1.0);
    // A pair whose force and friction are below 1e-11 of the largest is open, with none: SIGNORINI_STATE_OPEN.
    let none = 1e-11 * largest(&exact).value().max(largest(&quads(&case.f)).value());
    let allowed = 2.0 * (1.0 + mu) * (left + least) + 2.0 * none;
    if norm(&error).value() > allowed {
        let size = norm(&error).value();
        wrong(size / scale, format!("|K d - f - F| {size:.2e} > {allowed:.2e}, scale {scale:.1e}"));
    }
    let (most, told) = (largest(&error).value(), answer.equilibrium);
    // The rounding of d and of F is in the host's own check, whatever the library has computed.
    if most > (told + 2.0 * least) * (1.0 + DIGITS) {
        wrong(
            most / scale,
            format!("|K d - f - F| {most:.2e}, reported {told:.2e}, rounding {least:.2e}"),
        );
    }
}

/// Loads and forces do no work on a motion that strains nothing: `r . (f + F) = r . K d = 0`, but for the rounding of
/// the entries of `K`.
fn judge_balance(problem: &Problem, answer: &Answer<'_>, tolerance: f64, faults: &mut Faults) {
    let case = &problem.case;
    let size = norm(&quads(&case.f)).max(norm(&quads(answer.force))).value();
    let parts: f64 = answer.d.iter().map(|d| d.value().abs()).sum();
    let terms = parts_of(case, &answer.d);
    for r in &problem.motions {
        let length = norm(&quads(r)).value();
        let left = (work(r, &case.f) + work(r, answer.force)).abs();
        let strained: f64 = r.iter().zip(&terms).map(|(r, term)| r.abs() * term).sum();
        // The products that make K of rigid motions round beside its largest entries.
        let few = 4.0 * case.size() as f64 * UNIT;
        let noise = few * largest_stiffness(case) * parts * r.iter().map(|r| r.abs()).sum::<f64>();
        let allowed = (BALANCE + 4.0 * tolerance) * size * length + few * strained + noise;
        if left > allowed {
            let size = left / (size * length);
            let text = format!("{size:.1e} of the load is not balanced, |d| is {parts:.1e}");
            faults.push(Finding { fault: Fault::Imbalance, size, text });
            return;
        }
    }
}

/// The solutions of a small 2D problem. Those of a matrix that rounding made definite are left out:
/// their displacements are as large as its smallest eigenvalue is small.
fn enumerated(case: &Case) -> Option<AllSolutions> {
    if case.dim != 2 || case.pairs > MOST_PAIRS {
        return None;
    }
    let mut all = all_solutions(case);
    if !is_definite(case, BEYOND_ROUNDING) {
        let hidden = |d: &Vec<Quad>| {
            rounding(case, d, scale(case, &force(case, d)).value().max(f64::MIN_POSITIVE)) > HIDDEN
        };
        let before = all.solutions.len();
        all.solutions.retain(|d| !hidden(d));
        all.singular |= all.solutions.len() < before;
    }
    Some(all)
}

fn judge_uniqueness(case: &Case, answer: &Answer<'_>, tolerance: f64, faults: &mut Faults) {
    match answer.uniqueness {
        Uniqueness::NotKnown => {}
        Uniqueness::Unique => {
            let count = enumerated(case).map_or(0, |all| all.solutions.len());
            if count > 1 {
                faults.push(plain(Fault::Unique, format!("there are {count}")));
            }
        }
        Uniqueness::Several => {
            let text = flaw_of_several(case, answer, tolerance);
            faults.extend(text.map(|text| plain(Fault::Several, text)));
        }
    }
}

fn flaw_of_several(case: &Case, answer: &Answer<'_>, tolerance: f64) -> Option<String> {
    let all = enumerated(case);
    let regular = all.as_ref().is_some_and(|all| !all.singular);
    if let Some(all) = all
        && !all.singular
        && all.solutions.len() < 2
    {
        return Some(format!("there are {}", all.solutions.len()));
    }
    let second = answer.second.as_ref()?;
    let found = eta(case, second);
    let least = rounding(case, second, scale(case, &force(case, second)).value());
    if found > (tolerance + least) * (1.0 + DIGITS) {
        return Some(format!("the second has the residual {found:.2e}, rounding {least:.2e}"));
    }
    match (refined(case, &answer.d, None), refined(case, second, None)) {
        (Some(first), Some(second)) if !differ(case, &first, &second) => {
            Some("both are one solution".into())
        }
        (_, None) if regular => Some("there is no solution next to the second".into()),
        _ => None,
    }
}

/// Why the problem has a solution, if that is known.
fn solvable(problem: &Problem) -> Option<String> {
    if problem.motions.is_empty() && is_definite(&problem.case, BEYOND_ROUNDING) {
        return Some("K is definite".into());
    }
    if problem.noise > 0.0 {
        return None;
    }
    let count = enumerated(&problem.case)?.solutions.len();
    (count > 0).then(|| format!("{count} solutions were found"))
}

/// Status 4: the motion proves it, and nothing else shows a solution.
fn judge_proof(problem: &Problem, answer: &Answer<'_>, faults: &mut Faults) {
    if let Some(why) = solvable(problem) {
        faults.push(plain(Fault::WrongProof, why));
    }
    let flaw = match answer.motion {
        None => Some((f64::INFINITY, "no motion".into())),
        Some(r) => flaw_of_motion(problem, r),
    };
    faults.extend(flaw.map(|(size, text)| Finding { fault: Fault::Motion, size, text }));
}
