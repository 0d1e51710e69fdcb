//! The reduction of a whole sparse matrix: rows solved for degrees of freedom, then condensed or left in full space.

use super::change_of_variables::{ChangeOfVariables, contact_forces};
use super::control::{Asked, Control, ranks};
use super::full_space::FullSpace;
use super::general_rows::{GeneralRows, general_rows};
use super::host_arrays::SparseMatrix;
use super::host_matrix::check_diagonal;
use super::messages;
use super::supports::{self, FixedComponent};
use crate::error::{Argument, Error, Limit, Message, index};
use crate::linalg::sparse_matrix::{Csc, OutOfMemory, diagonals, times, transpose_times};
use crate::linalg::sparse_schur::{Failure, Plan, SparseSchur};
use crate::linalg::vector::{columns, combination, norm_inf};
use crate::linalg::watched::unended;
use crate::problem::{Dependence, GoesOn, OfLeastEnergy, StiffnessOperator};
use crate::reduce::equations::Dependents;
use crate::reduce::memory::memory;
use crate::reduce::{Condensed, ContactPairs, HostLoad, Reduction, SolvedCase, motion};

/// The reduction of a whole sparse matrix, kept for further load cases.
pub struct SparseReduction {
    fixed_count: usize,
    variables: ChangeOfVariables,
    /// `Pᵀ K T`: a row for each fixed degree of freedom, a column for each unknown.
    of_fixed: Csc,
    /// `Bᵀ`: nodal forces of unit contact forces.
    contact_forces: Csc,
    /// Normals and tangents, pair by pair.
    frames: Vec<f64>,
    supports: Vec<FixedComponent>,
    fixed_components: Vec<usize>,
    dependent: Option<Dependence>,
    engine: Engine,
}

/// The way to solve for unknowns that are not relative displacements.
enum Engine {
    /// They are condensed.
    Condensed(Box<SparseSchur>),
    /// They stay.
    FullSpace(Box<FullSpace>),
}

impl SparseReduction {
    /// Reduces `matrix` with the degrees of freedom `fixed` and the contact `pairs`.
    ///
    /// # Errors
    /// Arrays that are wrong, by entry; a pair that nothing can move; a motion that neither
    /// supports nor pairs hold, by degrees of freedom that move in it; an order that is no permutation; and what
    /// `control.ask` answers.
    pub fn new(
        matrix: &SparseMatrix<'_>,
        fixed: &[usize],
        pairs: &ContactPairs<'_>,
        control: Control<'_>,
    ) -> Result<Self, Error> {
        let memory = |_: OutOfMemory| Error::OutOfMemory("the reduced stiffness matrix");
        // The matrix first: a wrong size or index base shows in the other arrays too.
        matrix.check_col_start()?;
        let dependents = &Dependents::new(&pairs.equations, matrix.size)?;
        let places = &supports::places_in_fixed(matrix.size, fixed, dependents)?;
        let host = matrix.lower_triangle("K")?;
        (control.ask)(0.0, 0)?;
        let rank = control.order.map(|order| ranks(matrix.size, order)).transpose()?;
        let rows = pairs.rows(matrix.size, dependents)?;
        let may_lack = pairs.without_own_stiffness(dependents.without_own_stiffness(matrix.size));
        check_diagonal("K", &host, |dof| places[dof].is_some() || may_lack[dof])?;
        let stiffness: Vec<f64> = diagonals(&host).collect();
        let mut frames = pairs.frames()?;
        let may_turn = pairs.tangents.is_none();
        let GeneralRows { variables, supports, dependent } =
            general_rows(&rows, (&mut frames, may_turn), (places, &stiffness, dependents))?;
        let own = dependent.is_none() && rows.have_own_slaves;
        (control.ask)(0.0, 0)?;
        let contact_forces = contact_forces(matrix.size, &rows, &frames).map_err(memory)?;
        drop(rows);
        let mut asked = Asked::new(control.ask);
        let (transformed, of_fixed) =
            variables.transform(host, &mut |share| asked.goes_on(share)).map_err(|failure| {
                asked.ended.take().unwrap_or_else(|| refused(&variables, own, failure))
            })?;
        let free = &variables.free;
        let rank: Option<Vec<usize>> = rank.map(|rank| free.iter().map(|&dof| rank[dof]).collect());
        let (rank, reserve, case) = (rank.as_deref(), control.reserve, control.case);
        let parts = Parts { inner: free.len(), dim: pairs.dim, rank, own, reserve, case };
        let choice = (control.full_space, dependent.is_none());
        let mut engine = Engine::new(transformed, &parts, choice, &mut asked)
            .map_err(|failure| asked.ended.unwrap_or_else(|| refused(&variables, own, failure)))?;
        let mut fixed_components: Vec<usize> =
            supports.iter().map(|support| support.component).collect();
        fixed_components.sort_unstable();
        if let (Engine::Condensed(schur), None) = (&mut engine, &dependent) {
            schur.level(&fixed_components, pairs.dim);
        }
        Ok(SparseReduction {
            fixed_count: fixed.len(),
            variables,
            of_fixed,
            contact_forces,
            frames: frames.iter().flat_map(|frame| frame.directions().flatten().copied()).collect(),
            fixed_components,
            supports,
            dependent,
            engine,
        })
    }
}

impl Reduction for SparseReduction {
    fn stiffness(&self) -> &[f64] {
        match &self.engine {
            Engine::Condensed(schur) => &schur.schur,
            Engine::FullSpace(_) => &[],
        }
    }

    fn units_of_condensation(&self) -> Option<&[f64]> {
        match &self.engine {
            Engine::Condensed(schur) => Some(&schur.units),
            Engine::FullSpace(_) => None,
        }
    }

    fn inner_unknowns(&self) -> Option<usize> {
        self.engine.full_space().map(|_| self.variables.free.len())
    }

    fn bodies(&self) -> Option<Box<dyn StiffnessOperator + '_>> {
        self.engine.full_space().map(|space| Box::new(space.in_use()) as Box<_>)
    }

    /// `Tᵀ (f - K P p)`.
    fn all_loads(&self, load: &[f64], prescribed: Option<&[f64]>) -> Vec<f64> {
        let mut transformed = self.variables.load(load);
        if let Some(values) = prescribed {
            let forces = transpose_times(&self.of_fixed, values);
            transformed.iter_mut().zip(forces).for_each(|(load, force)| *load -= force);
        }
        transformed
    }

    fn factor_bytes(&self) -> u64 {
        self.engine.full_space().map_or(0, |space| space.factor_bytes)
    }

    fn host_size(&self) -> usize {
        self.variables.host_size
    }

    fn fixed_count(&self) -> usize {
        self.fixed_count
    }

    fn condense_cases(&self, cases: &[HostLoad<'_>], goes_on: GoesOn<'_>) -> Condensed {
        let loads: Vec<f64> =
            cases.iter().flat_map(|(load, values)| self.all_loads(load, *values)).collect();
        let condensed = match &self.engine {
            Engine::Condensed(schur) => schur.condense(&loads, goes_on),
            Engine::FullSpace(space) => space.condense(&loads, goes_on)?,
        };
        Ok(condensed.map(|condensed| columns(&condensed, cases.len())))
    }

    fn recover_cases(&self, cases: &[SolvedCase<'_>]) -> Result<Vec<Vec<f64>>, Error> {
        let (mut loads, mut variables) = (Vec::new(), Vec::new());
        let nothing = vec![0.0; self.host_size()];
        let of_rows = match (&self.engine, self.dependence()) {
            (Engine::Condensed(schur), Some(dependence)) => {
                Some((schur, OfLeastEnergy::new(dependence, &schur.schur)))
            }
            _ => None,
        };
        for case in cases {
            let load = self.all_loads(case.load.unwrap_or(&nothing), case.prescribed);
            match &of_rows {
                Some((schur, of_rows)) => {
                    let condensed = || unended(|goes_on| schur.condense(&load, goes_on));
                    variables.extend(of_rows.variables(case.d, condensed, case.prescribed));
                }
                None => variables.extend_from_slice(case.d),
            }
            loads.extend(load);
        }
        let x = match &self.engine {
            Engine::Condensed(schur) => {
                unended(|goes_on| schur.recover(&loads, &variables, goes_on))
            }
            Engine::FullSpace(space) => space.recover(&loads, &variables)?,
        };
        let of_host = |(x, case): (Vec<f64>, &SolvedCase<'_>)| {
            self.variables.host_displacements(&x, case.prescribed)
        };
        Ok(columns(&x, cases.len()).into_iter().zip(cases).map(of_host).collect())
    }

    /// `Bᵀ F`: `R F` on each node by its signed weight.
    fn nodal_forces(&self, force: &[f64]) -> Vec<f64> {
        times(&self.contact_forces, force)
    }

    fn dependence(&self) -> Option<&Dependence> {
        self.dependent.as_ref()
    }

    fn check_prescribed(&self, values: &[f64]) -> Result<(), Error> {
        self.supports.iter().try_for_each(|support| support.check(values))
    }

    fn fixed_components(&self) -> &[usize] {
        &self.fixed_components
    }

    fn frames(&self) -> Option<&[f64]> {
        Some(&self.frames)
    }

    fn motion_in_words(&self, dim: usize, d: &[f64]) -> Message {
        let whole = motion::of_host(&self.displacements_of_motion(d));
        let size = |pair: &usize| norm_inf(&d[dim * pair..dim * (pair + 1)]);
        let most = (0..d.len() / dim).max_by(|a, b| size(a).total_cmp(&size(b)));
        let Some(pair) = most.filter(|pair| size(pair) > 0.0) else {
            return whole.into();
        };
        let range = dim * pair..dim * (pair + 1);
        let directions = self.frames[dim * dim * pair..].chunks(dim);
        let relative = combination(dim, d[range].iter().copied().zip(directions));
        format!(
            "{whole}; the slave of pair {} moves along {} relative to what it faces",
            index(pair),
            motion::components(&relative)
        )
        .into()
    }
}

/// How the transformed matrix is divided and eliminated, by whom, and with whose memory.
struct Parts<'a> {
    /// Number of unknowns that are no relative displacements.
    inner: usize,
    dim: usize,
    /// The host's order of them.
    rank: Option<&'a [usize]>,
    /// Each pair has a slave of its own.
    own: bool,
    reserve: fn(u64) -> bool,
    case: fn(Option<usize>, usize) -> u64,
}

impl Engine {
    fn full_space(&self) -> Option<&FullSpace> {
        match self {
            Engine::Condensed(_) => None,
            Engine::FullSpace(space) => Some(space),
        }
    }

    /// Condenses `matrix`, or leaves it as it is: if that is `wanted`, or if the condensed matrix or a load case with it needs
    /// more memory than is allowed or than the system has, and it is `possible`.
    fn new(
        matrix: Csc,
        parts: &Parts<'_>,
        (wanted, possible): (bool, bool),
        asked: &mut Asked<'_, '_>,
    ) -> Result<Self, Failure> {
        let components = matrix.ncols() - parts.inner;
        let is_condensed = !(wanted && possible);
        let has_room = is_condensed && (parts.reserve)(memory(components));
        if is_condensed && !(has_room || possible) {
            return Err(Failure::OutOfMemory);
        }
        if has_room {
            let plan =
                Plan::new(&matrix, parts.inner, parts.rank, &mut |done| asked.goes_on(done))?;
            if asked.needs(plan.bytes.max((parts.case)(None, components))).is_ok() {
                // Rows of many nodes leave more rounding on motions that are free than the entries of K_rel show.
                let known: Option<&[Vec<f64>]> = (!parts.own).then_some(&[]);
                return SparseSchur::new(plan, matrix, known, &mut |done| asked.goes_on(done))
                    .map(|schur| Engine::Condensed(Box::new(schur)));
            }
            let lacks_memory =
                matches!(asked.ended, Some(Error::Stopped { limit: Limit::Memory, .. }));
            if !(possible && lacks_memory) {
                return Err(Failure::Stopped);
            }
            (asked.memory, asked.ended) = (0, None);
        }
        let case = (parts.case)(Some(parts.inner), components);
        FullSpace::new(matrix, parts.inner, parts.dim, case, asked)
            .map(|space| Engine::FullSpace(Box::new(space)))
    }
}

/// Why the factorisation failed, in degrees of freedom of the host; `own`: each pair has a slave of its own.
fn refused(variables: &ChangeOfVariables, own: bool, failure: Failure) -> Error {
    if let Failure::OutOfMemory = failure {
        return Error::OutOfMemory("the factor of the stiffness matrix");
    }
    let host = |x: &[f64]| variables.host_displacements(x, None);
    Error::invalid(Argument::Matrix, messages::failure(failure, &variables.free, host, !own))
}
