//! Ties are taken out of a problem before a method sees it.
//!
//! The displacements of tied pairs are known: `d_T` is their reference. What is left is a problem of the other pairs on a
//! block of the matrix, which any method solves:
//!
//! ```text
//! K_OO d_O = (f_O - K_OT d_T) + F_O
//! ```
//!
//! The forces of the ties follow from equilibrium. The certificate measures the whole on the host's data. A motion of the
//! others that proves that no equilibrium exists moves no tie, and is judged on the whole too. The next problem with the
//! same matrix and the same ties has the same block, and what this one leaves of it.

use crate::certificate::{Certificate, is_escape_of, measure};
use crate::error::Error;
use crate::law::Contact;
use crate::linalg::matrix::Matrix;
use crate::problem::{ContactProblem, FrictionLaw, Remembered};
use crate::settings::{SMALLEST_TOLERANCE, Settings};
use crate::solve::newton::refine_to_tolerance;
use crate::solve::part::PairData;
use crate::solve::result::{Call, Candidate, Ending, Escape, Solution, Solve, Status};

/// Most bytes of the matrix of the pairs that are not tied, of a problem with so many unknowns; 0 where none is tied.
pub fn memory_of_ties(law: FrictionLaw<'_>, unknowns: usize) -> u64 {
    if law.has_ties() { (unknowns * unknowns * size_of::<f64>()) as u64 } else { 0 }
}

/// Solves a problem with ties, `solve` the problem of the other pairs; `None`: no pair is tied.
pub fn without_ties(call: &Call<'_>, solve: Solve) -> Option<Result<Solution, Error>> {
    call.contact.ties().next().map(|_| on_others(call, solve))
}

/// Solves a problem of which pairs are tied.
fn on_others(call: &Call<'_>, solve: Solve) -> Result<Solution, Error> {
    let whole = call.contact.problem();
    let others = Others::of(call.contact);
    let start = call.start.map(|start| others.gathered(start));
    // A result is large, and a solution needs the stack: it stays where it is.
    let mut found = {
        let problem = others.problem(whole);
        let contact = &Contact::new(&problem);
        let start = start.as_deref().filter(|_| !contact.is_at_rest());
        let with_tolerance = |tolerance| {
            let settings = &Settings { proof: false, tolerance, ..call.settings.clone() };
            solve(&Call { contact, settings, start, ..*call })
        };
        let tolerance = call.settings.tolerance;
        let mut found = with_tolerance(tolerance);
        let Ok(solution) = &mut found else { return found };
        let (is_solved, of_others) = (solution.status == Status::Solved, solution.certificate.eta);
        others.put_on_whole(call, solution);
        // Where ties move bodies far, the forces that measure the others are larger than those of the whole.
        let enough = 0.5 * of_others * tolerance / solution.certificate.eta;
        if is_solved && solution.status != Status::Solved {
            found = with_tolerance(enough.max(SMALLEST_TOLERANCE));
            let Ok(solution) = &mut found else { return found };
            others.put_on_whole(call, solution);
        }
        found
    };
    let Ok(solution) = &mut found else { return found };
    // What proves something of the others may prove nothing of the whole.
    let is_proof = |motion: &Vec<f64>| is_escape_of(call.contact, motion);
    if solution.status == Status::NoEquilibrium
        && !solution.recession.as_ref().is_some_and(is_proof)
    {
        let motion = solution.recession.take().unwrap_or_default();
        (solution.status, solution.message) =
            Ending::Recession(motion).status(call.settings, &solution.certificate);
    }
    if let Some(remembered) = whole.remembered() {
        remembered.leave(others.block);
    }
    found
}

/// The block of the pairs that are not tied.
struct Block {
    /// Their components.
    components: Vec<usize>,
    /// Column-major.
    matrix: Vec<f64>,
    /// The memory that their problems share.
    remembered: Remembered,
}

/// The pairs that are not tied, with what their problem consists of.
struct Others {
    block: Block,
    load: Vec<f64>,
    own: PairData,
    /// All displacements, those of these pairs zero.
    held: Vec<f64>,
    /// Their numbers for words.
    host: Vec<usize>,
}

impl Others {
    fn of(contact: &Contact<'_>) -> Self {
        let (problem, dim) = (contact.problem(), contact.dim());
        let laws = contact.pairs();
        let pairs: Vec<usize> = (0..laws.len()).filter(|&pair| !laws[pair].tied).collect();
        let components: Vec<usize> =
            pairs.iter().flat_map(|pair| dim * pair..dim * (pair + 1)).collect();
        let mut held = vec![0.0; contact.unknowns()];
        for pair in contact.ties() {
            held[dim * pair..dim * (pair + 1)].copy_from_slice(&laws[pair].reference()[..dim]);
        }
        let lack = problem.force_of_parts(&held, &vec![0.0; held.len()]);
        let column = |&j: &usize| {
            let column = problem.column(j);
            components.iter().map(|&i| column[i])
        };
        let kept = problem.remembered().and_then(Remembered::take::<Block>);
        let matrix = || components.iter().flat_map(column).collect();
        let block = kept.filter(|block| block.components == components).unwrap_or_else(|| {
            let (components, remembered) = (components.clone(), Remembered::default());
            Block { matrix: matrix(), components, remembered }
        });
        Others {
            load: components.iter().map(|&i| -lack[i]).collect(),
            own: PairData::of(problem, &pairs),
            host: pairs.iter().map(|&pair| problem.host_pair(pair)).collect(),
            block,
            held,
        }
    }

    /// The problem of these pairs.
    fn problem<'p>(&'p self, whole: &ContactProblem<'p>) -> ContactProblem<'p> {
        let size = self.block.components.len();
        let matrix = Matrix::new(size, &self.block.matrix, size.max(1));
        let remembered = whole.remembered().map(|_| &self.block.remembered);
        let PairData { gap, parameters, slip } = &self.own;
        let data = (gap.as_slice(), whole.law().with_values(parameters), slip.as_slice());
        let problem = whole.on_part(matrix, &self.load, data);
        problem.of_host(&self.host, whole.host_pairs()).remembering(remembered)
    }

    /// The entries of these pairs.
    fn gathered(&self, values: &[f64]) -> Vec<f64> {
        self.block.components.iter().map(|&i| values[i]).collect()
    }

    /// Values of all components from those of these pairs; the others are those of `all`.
    fn spread(&self, own: &[f64], mut all: Vec<f64>) -> Vec<f64> {
        self.block.components.iter().zip(own).for_each(|(&i, own)| all[i] = *own);
        all
    }

    /// Makes a result of the whole problem of the solution on these pairs.
    #[inline(never)]
    fn put_on_whole(&self, call: &Call<'_>, found: &mut Solution) {
        let (contact, settings) = (call.contact, call.settings);
        let nothing = || vec![0.0; self.held.len()];
        let displacements = |own: &[f64]| self.spread(own, self.held.clone());
        let (d, low) = (displacements(&found.d), self.spread(&found.d_low, nothing()));
        let force = contact.problem().force_of_parts(&d, &low);
        let ending = found.status.stop().map_or(Ending::Done, Ending::Stopped);
        let at = Candidate::of_displacements(contact, d.clone(), ending);
        let mut at = at.moved_to(d, low, force);
        // Where ties move bodies far, the loads of the other pairs are rounded beside their forces.
        refine_to_tolerance(call, &mut at);
        let certificate = at.certificate(contact).clone().with_rounding(settings.tolerance);
        let holds = certificate.holds(settings.tolerance);
        let (status, message) = match found.status {
            Status::NoEquilibrium => (found.status, found.message.clone()),
            Status::Solved => at.ending.status(settings, &certificate),
            _ if holds => Ending::Done.status(settings, &certificate),
            // The sentence of the others, with the measure of the whole.
            _ => {
                let measured = |by: &Certificate| format!("eta is {:.1e}", by.eta);
                let (others, whole) = (measured(&found.certificate), measured(&certificate));
                (found.status, found.message.marked().replace(&others, &whole).into())
            }
        };
        (found.status, found.message) = (status, message);
        (found.d, found.d_low) = (at.d().to_vec(), at.low_part());
        found.certificate = certificate;
        found.recession = found.recession.take().map(|motion| self.spread(&motion, nothing()));
        found.escape = found.escape.take().map(|Escape { motion, unbalanced }| Escape {
            motion: self.spread(&motion, nothing()),
            unbalanced: self.spread(&unbalanced, nothing()),
        });
        (found.errors, found.definite) = (at.errors, Vec::new());
        found.change_second(settings.tolerance, |second| {
            second.d = displacements(&second.d);
            second.d_low = self.spread(&second.d_low, nothing());
            second.certificate = measure(contact, (&second.d, &second.d_low), &[]);
        });
    }
}
