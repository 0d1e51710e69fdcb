//! Models: reduce once, solve many load cases, recover.

use super::args::{Arrays, matrix_length, size};
use super::guard::{self, Failure};
use super::host::{SignoriniPairs, SignoriniSparse};
use super::report::{SignoriniReport, state_code};
use super::settings::SignoriniSettings;
use super::status::{code, remember};
use crate::error::Argument;
use crate::model::{LoadCase, Model};
use crate::monitor::{Monitor, ProgressFn};
use crate::problem::Friction;
use crate::solve::Status;

/// A structure, reduced to its contact pairs: what every load case shares. Made by
/// signorini_model_new_..., released by signorini_model_free. It does not change, and every function
/// that takes it const may be called from several threads at once.
pub struct SignoriniModel(Model);

/// Makes a model of a body that the host has condensed, on an obstacle: d = u.
///
/// @param dim    space dimension, 2 or 3
/// @param pairs  number of contact pairs
/// @param K      condensed stiffness, N = dim * pairs columns, as in signorini_solve; copied
/// @param ldk    entries from one column to the next, at least max(1, N)
/// @param model  out: the model, NULL unless 0 is returned
/// @return 0; -k the k-th argument is wrong; <= -1000 internal
#[unsafe(no_mangle)]
#[allow(non_snake_case)] // the names of the mechanics, which the header shows
pub unsafe extern "C" fn signorini_model_new_condensed(
    dim: i32,
    pairs: i64,
    K: *const f64,
    ldk: i64,
    model: *mut *mut SignoriniModel,
) -> i32 {
    guard::call(|| {
        let place = Place::new(5, model)?;
        let (dim, pairs, n) = dimensions(dim, pairs)?;
        let ld = size(4, "ldk", ldk)?;
        let length = matrix_length(4, "K", n, ld)?;
        let mut arrays = Arrays::default();
        // SAFETY: the length is that of the header.
        let k = unsafe { arrays.input(3, "K", K, length, true)? }.unwrap_or_default();
        place.fill(Model::condensed(dim, pairs, k, ld), |argument| match argument {
            Argument::Dimension => 1,
            Argument::Size => 2,
            Argument::LeadingDimension => 4,
            _ => 3,
        })
    })
}

/// Makes a model of two bodies that the host has condensed on matching contact nodes. Each body is
/// in its own outward frame, n_B = -n_A and t_B = -t_A, so that d = u_A + u_B. A motion that neither
/// body resists is refused; one body may float.
///
/// Loads and displacements of the host are [A; B], 2 N entries.
///
/// @param dim    space dimension, 2 or 3
/// @param pairs  number of contact pairs
/// @param K_A    condensed stiffness of body A, N = dim * pairs columns; copied
/// @param lda    entries from one column to the next, at least max(1, N)
/// @param K_B    the same of body B
/// @param ldb    the same of body B
/// @param model  out: the model, NULL unless 0 is returned
/// @return 0; -k the k-th argument is wrong; <= -1000 internal
#[unsafe(no_mangle)]
#[allow(non_snake_case)] // as above
pub unsafe extern "C" fn signorini_model_new_two_body(
    dim: i32,
    pairs: i64,
    K_A: *const f64,
    lda: i64,
    K_B: *const f64,
    ldb: i64,
    model: *mut *mut SignoriniModel,
) -> i32 {
    guard::call(|| {
        let place = Place::new(7, model)?;
        let (dim, pairs, n) = dimensions(dim, pairs)?;
        let (ld_a, ld_b) = (size(4, "lda", lda)?, size(6, "ldb", ldb)?);
        let (length_a, length_b) =
            (matrix_length(4, "K_A", n, ld_a)?, matrix_length(6, "K_B", n, ld_b)?);
        let mut arrays = Arrays::default();
        // SAFETY: the lengths are those of the header.
        let (k_a, k_b) = unsafe {
            (
                arrays.input(3, "K_A", K_A, length_a, true)?.unwrap_or_default(),
                arrays.input(5, "K_B", K_B, length_b, true)?.unwrap_or_default(),
            )
        };
        let made = Model::two_body(dim, pairs, (k_a, ld_a), (k_b, ld_b));
        place.fill(made, |argument| match argument {
            Argument::Dimension => 1,
            Argument::Size => 2,
            Argument::LeadingDimension => 4,
            Argument::SecondMatrix => 5,
            Argument::SecondLeadingDimension => 6,
            _ => 3,
        })
    })
}

/// Makes a model of the host's whole sparse stiffness matrix with contact pairs, for any number of
/// bodies and zones. Parts that only contact holds are fine.
///
/// Loads and displacements of the host are K->size entries.
///
/// @param K       the stiffness matrix, without supports; copied
/// @param fixed   number of degrees of freedom that are held
/// @param dofs    these, counted from K->base; NULL if there are none
/// @param pairs   the contact pairs; copied
/// @param model   out: the model, NULL unless 0 is returned
/// @return 0; -k the k-th argument is wrong; <= -1000 internal
#[unsafe(no_mangle)]
#[allow(non_snake_case)] // as above
pub unsafe extern "C" fn signorini_model_new_sparse(
    K: *const SignoriniSparse,
    fixed: i64,
    dofs: *const i64,
    pairs: *const SignoriniPairs,
    model: *mut *mut SignoriniModel,
) -> i32 {
    guard::call(|| {
        let place = Place::new(5, model)?;
        // SAFETY: the structures and arrays are those of the header.
        let made = unsafe {
            let matrix = SignoriniSparse::receive(1, K)?;
            let count = size(2, "fixed", fixed)?;
            let mut arrays = Arrays::default();
            let dofs = arrays.input(3, "dofs", dofs, count, true)?.unwrap_or_default();
            let fixed = super::host::shifted(3, "dofs", dofs, matrix.base)?;
            let pairs = SignoriniPairs::receive(4, pairs, matrix.base)?;
            Model::sparse(&matrix, &fixed, &pairs.view())
        };
        place.fill(made, |argument| match argument {
            Argument::Matrix => 1,
            Argument::Fixed => 3,
            _ => 4,
        })
    })
}

/// Releases a model. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_model_free(model: *mut SignoriniModel) {
    guard::call(|| {
        if !model.is_null() {
            // SAFETY: by the header's contract it came from signorini_model_new_..., once.
            drop(unsafe { Box::from_raw(model) });
        }
        Ok(0)
    });
}

/// Entries of a load or displacement vector of the model's host; -1 if model is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_model_host_size(model: *const SignoriniModel) -> i64 {
    // SAFETY: NULL or a model, by the header's contract.
    unsafe { model.as_ref() }.map_or(-1, |model| model.0.host_size() as i64)
}

/// Copies the stiffness matrix in relative displacements, K_rel.
///
/// @param model  the model
/// @param K      out: N = dim * pairs columns of N entries, without space between them
/// @return 0; -k the k-th argument is wrong
#[unsafe(no_mangle)]
#[allow(non_snake_case)] // as above
pub unsafe extern "C" fn signorini_model_stiffness(
    model: *const SignoriniModel,
    K: *mut f64,
) -> i32 {
    guard::call(|| {
        // SAFETY: a model and an array as the header demands.
        unsafe {
            let model = receive(model)?;
            let stiffness = model.stiffness();
            Arrays::default().output(2, "K", K, stiffness.len(), true)?.write(stiffness);
        }
        Ok(0)
    })
}

/// Solves load cases, one after the other. Case c has its own columns in every array; a NULL status
/// array is not wanted. A case that is wrong or not solved does not stop the others.
///
/// Friction in load steps: hand over as slip the d_t of the step before (zero at first); all state is
/// in your arrays.
///
/// @param model       the model
/// @param cases       number of load cases, 0 allowed
/// @param f           nodal loads of the host, H = signorini_model_host_size entries a case
/// @param prescribed  values of the fixed degrees of freedom, in their order, a column a case; NULL:
///                    zero
/// @param gap         gaps, one for each pair and case
/// @param mu          friction coefficients, one for each pair and case
/// @param slip        tangential displacement at rest, dim - 1 for each pair and case; NULL: zero
/// @param settings    NULL: the defaults; a progress callback is told of each case in turn
/// @param d           out: relative displacements, N = dim * pairs entries a case; in: the starts if
///                    settings->warm_start
/// @param F           out: contact forces, N entries a case
/// @param state       out: state of each pair, a column a case; NULL: not wanted
/// @param report      out: one for each case, struct_size set in each; NULL: not wanted
/// @param status      out: status of each case, as signorini_solve returns it, -k standing for the
///                    k-th argument of this call; NULL: not wanted
/// @return 0 if every case is solved; otherwise the status of the first that is not, and
///         signorini_last_error names it; -k the k-th argument is wrong
#[unsafe(no_mangle)]
#[allow(non_snake_case)] // as above
pub unsafe extern "C" fn signorini_model_solve(
    model: *const SignoriniModel,
    cases: i64,
    f: *const f64,
    prescribed: *const f64,
    gap: *const f64,
    mu: *const f64,
    slip: *const f64,
    settings: *const SignoriniSettings,
    d: *mut f64,
    F: *mut f64,
    state: *mut i32,
    report: *mut SignoriniReport,
    status: *mut i32,
) -> i32 {
    guard::call(|| {
        // SAFETY: a model as the header demands.
        let model = unsafe { receive(model)? };
        let cases = size(2, "cases", cases)?;
        let (pairs, n) = (model.pairs(), model.dim() * model.pairs());
        let (host, fixed, slips) = (model.host_size(), model.fixed_count(), n - pairs);
        let times = |position: i32, length: usize| {
            length
                .checked_mul(cases)
                .ok_or_else(|| Failure::argument(position, "there are too many cases"))
        };
        let mut arrays = Arrays::default();
        // SAFETY: the lengths are those of the header.
        let (load, prescribed, gap, mu, slip) = unsafe {
            (
                arrays.input(3, "f", f, times(2, host)?, true)?.unwrap_or_default(),
                arrays.input(4, "prescribed", prescribed, times(2, fixed)?, false)?,
                arrays.input(5, "gap", gap, times(2, pairs)?, true)?.unwrap_or_default(),
                arrays.input(6, "mu", mu, times(2, pairs)?, true)?.unwrap_or_default(),
                arrays.input(7, "slip", slip, times(2, slips)?, false)?,
            )
        };
        // SAFETY: the header asks for structures that begin with their size.
        let received = unsafe { SignoriniSettings::receive(8, settings)? };
        received.settings.validate().map_err(|error| Failure::from_error(error, |_| 8))?;
        let d = arrays.output(9, "d", d, times(2, n)?, true)?;
        let force = arrays.output(10, "F", F, times(2, n)?, true)?;
        let states = arrays.output(11, "state", state, times(2, pairs)?, false)?;
        let statuses = arrays.output(13, "status", status, cases, false)?;
        // SAFETY: one report for each case, as the header demands.
        let reports = unsafe { Reports::accept(12, report, cases)? };
        arrays.structures(12, "report", report.cast_const(), times(12, reports.stride)?, true)?;
        arrays.check_overlap()?;

        let mut first = None;
        for case in 0..cases {
            let column =
                |array: &'static [f64], length: usize| &array[length * case..length * (case + 1)];
            let given = LoadCase {
                load: column(load, host),
                prescribed: prescribed.map(|values| column(values, fixed)),
                gap: column(gap, pairs),
                friction: Friction::Coulomb(column(mu, pairs)),
                previous_slip: slip.map(|slip| column(slip, slips)),
            };
            let d = d.part(n * case, n);
            // SAFETY: d has n entries for each case, filled by a caller that wants a warm start.
            let start = received.warm_start.then(|| unsafe { d.read() });
            let mut progress = received.progress();
            let progress = progress.as_mut().map(|progress| progress as &mut ProgressFn<'_>);
            let mut monitor = Monitor::new(&received.settings, progress);
            let solved = model.solve(&given, &received.settings, start.as_deref(), &mut monitor);
            let (code, message) = match solved {
                Ok(solution) => {
                    let code = code(solution.status);
                    let codes: Vec<i32> =
                        solution.certificate.states.iter().map(|&s| state_code(s)).collect();
                    // SAFETY: the outputs have the lengths of the header and overlap nothing.
                    unsafe {
                        d.write(&solution.d);
                        force.part(n * case, n).write(&solution.certificate.force);
                        states.part(pairs * case, pairs).write(&codes);
                        SignoriniReport::of(code, received.settings.method, &solution)
                            .send(reports.nth(case));
                    }
                    (code, (solution.status != Status::Solved).then_some(solution.message))
                }
                Err(error) => {
                    let message = error.to_string();
                    (Failure::from_error(error, position).code(), Some(message))
                }
            };
            // SAFETY: as above.
            unsafe { statuses.part(case, 1).write(&[code]) };
            if let Some(message) = message
                && first.is_none()
            {
                first = Some(code);
                remember(format_args!("case {case}: {message}"));
            }
        }
        Ok(first.unwrap_or(0))
    })
}

/// Displacements of the host from the relative ones, for one load case.
///
/// @param model       the model
/// @param f           nodal loads of the case, H entries; NULL: none, for the motion of a case without
///                    equilibrium
/// @param prescribed  values of the fixed degrees of freedom; NULL: zero
/// @param d           relative displacements, N entries
/// @param u           out: displacements, H entries
/// @return 0; -k the k-th argument is wrong
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_model_recover(
    model: *const SignoriniModel,
    f: *const f64,
    prescribed: *const f64,
    d: *const f64,
    u: *mut f64,
) -> i32 {
    guard::call(|| {
        let mut arrays = Arrays::default();
        // SAFETY: a model and arrays as the header demands.
        unsafe {
            let model = receive(model)?;
            let (host, n) = (model.host_size(), model.dim() * model.pairs());
            let load = arrays.input(2, "f", f, host, false)?;
            let values = arrays.input(3, "prescribed", prescribed, model.fixed_count(), false)?;
            let d = arrays.input(4, "d", d, n, true)?.unwrap_or_default();
            let out = arrays.output(5, "u", u, host, true)?;
            arrays.check_overlap()?;
            let recovered = model.recover(load, values, d).map_err(|error| {
                Failure::from_error(error, |argument| match argument {
                    Argument::Load => 2,
                    Argument::Prescribed => 3,
                    _ => 4,
                })
            })?;
            out.write(&recovered);
        }
        Ok(0)
    })
}

/// Contact forces as a nodal force vector of the host: on slaves, and the opposite on masters.
///
/// @param model  the model
/// @param F      contact forces, N entries
/// @param nodal  out: nodal forces, H entries
/// @return 0; -k the k-th argument is wrong
#[unsafe(no_mangle)]
#[allow(non_snake_case)] // as above
pub unsafe extern "C" fn signorini_model_nodal_forces(
    model: *const SignoriniModel,
    F: *const f64,
    nodal: *mut f64,
) -> i32 {
    guard::call(|| {
        let mut arrays = Arrays::default();
        // SAFETY: a model and arrays as the header demands.
        unsafe {
            let model = receive(model)?;
            let n = model.dim() * model.pairs();
            let force = arrays.input(2, "F", F, n, true)?.unwrap_or_default();
            let out = arrays.output(3, "nodal", nodal, model.host_size(), true)?;
            arrays.check_overlap()?;
            let forces = model.nodal_forces(force);
            out.write(&forces.map_err(|error| Failure::from_error(error, |_| 2))?);
        }
        Ok(0)
    })
}

/// Where a new model goes; NULL until it exists.
struct Place(*mut *mut SignoriniModel);

impl Place {
    fn new(position: i32, model: *mut *mut SignoriniModel) -> Result<Self, Failure> {
        if model.is_null() || !model.is_aligned() {
            return Err(Failure::argument(position, "model is NULL or not aligned"));
        }
        // SAFETY: a place for a pointer, by the header's contract.
        unsafe { model.write(std::ptr::null_mut()) };
        Ok(Place(model))
    }

    fn fill(
        self,
        made: Result<Model, crate::error::Error>,
        position: impl Fn(Argument) -> i32,
    ) -> Result<i32, Failure> {
        let model = made.map_err(|error| Failure::from_error(error, position))?;
        // SAFETY: as above.
        unsafe { self.0.write(Box::into_raw(Box::new(SignoriniModel(model)))) };
        Ok(0)
    }
}

/// # Safety
/// NULL or a model that lives during the call.
unsafe fn receive<'a>(model: *const SignoriniModel) -> Result<&'a Model, Failure> {
    // SAFETY: by the caller's contract.
    match unsafe { model.as_ref() } {
        Some(model) => Ok(&model.0),
        None => Err(Failure::argument(1, "model is NULL")),
    }
}

fn dimensions(dim: i32, pairs: i64) -> Result<(usize, usize, usize), Failure> {
    if dim != 2 && dim != 3 {
        return Err(Failure::argument(1, format!("dim is {dim}, it must be 2 or 3")));
    }
    let (dim, pairs) = (dim as usize, size(2, "pairs", pairs)?);
    let n = pairs.checked_mul(dim).filter(|n| *n <= isize::MAX as usize / size_of::<f64>());
    let n = n.ok_or_else(|| Failure::argument(2, format!("pairs is {pairs}, too many")))?;
    Ok((dim, pairs, n))
}

fn position(argument: Argument) -> i32 {
    match argument {
        Argument::Load => 3,
        Argument::Prescribed => 4,
        Argument::Gap => 5,
        Argument::Friction => 6,
        Argument::PreviousSlip => 7,
        Argument::Settings => 8,
        Argument::Start => 9,
        _ => 1,
    }
}

/// An array of reports of the caller, whose structure may be smaller than ours.
struct Reports {
    first: *mut SignoriniReport,
    stride: usize,
}

impl Reports {
    /// # Safety
    /// NULL, or an array of `cases` reports that begin with their size.
    unsafe fn accept(
        position: i32,
        first: *mut SignoriniReport,
        cases: usize,
    ) -> Result<Self, Failure> {
        if first.is_null() || cases == 0 {
            return Ok(Reports { first: std::ptr::null_mut(), stride: 0 });
        }
        // SAFETY: by the caller's contract, as in the loop.
        let stride = unsafe { SignoriniReport::accept(position, first)? };
        let reports = Reports { first, stride };
        for case in 1..cases {
            // SAFETY: as above.
            let size = unsafe { SignoriniReport::accept(position, reports.nth(case))? };
            if size != stride {
                let message = format!("report {case}: struct_size is {size}, not {stride}");
                return Err(Failure::argument(position, message));
            }
        }
        Ok(reports)
    }

    /// The report of a case, NULL if none is wanted.
    fn nth(&self, case: usize) -> *mut SignoriniReport {
        if self.first.is_null() {
            self.first
        } else {
            self.first.wrapping_byte_add(self.stride * case)
        }
    }
}
