//! Reduce once, solve many load cases, recover.

mod arguments;
mod cases;
mod condensed;
mod flexibility;
mod kind;
mod load_case;
mod matrix_free;
mod measures;
mod memory;
mod recovery;
mod surfaces;

use std::path::Path;

use arguments::{check_fixed_gaps, check_vector};
pub(crate) use cases::{BLOCK, Past};
pub use cases::{Series, Starts};
pub use kind::ModelKind;
pub use load_case::LoadCase;

use crate::error::{Argument, Error};
use crate::file;
use crate::linalg::matrix::Matrix;
use crate::linalg::vector::norm_inf;
use crate::monitor::Monitor;
use crate::problem::{
    ContactData, ContactProblem, Dependence, DependentRows, Relation, Remembered, symmetric_matrix,
};
use crate::reduce::{
    ContactPairs, Control, Reduction, SparseMatrix, SparseReduction, driven_motion,
};
use crate::settings::Settings;
use crate::solve::{
    CAUSES, CasePast, NO_EQUILIBRIUM, Solution, Status, check_limit, check_start, memory_of_case,
    solve, solve_dependent, solve_flexibility, solve_matrix_free,
};

/// A structure, reduced to its contact pairs. It does not change: several threads may use it.
pub struct Model {
    dim: usize,
    pairs: usize,
    reduction: Box<dyn Reduction>,
}

impl Model {
    /// A whole sparse stiffness matrix with fixed degrees of freedom and pairs; those of
    /// [`crate::surface`] by `ContactPairs::from(&found.rows())`.
    ///
    /// # Errors
    /// As [`SparseReduction::new`].
    pub fn sparse(
        matrix: &SparseMatrix<'_>,
        fixed: &[usize],
        pairs: &ContactPairs<'_>,
    ) -> Result<Self, Error> {
        let monitor = &mut Monitor::new(&Settings::default(), None);
        Self::sparse_within(matrix, fixed, pairs, None, monitor)
    }

    /// As [`Self::sparse`], within the limits of `monitor` on memory and time, with its callback and its threads. If
    /// the condensed model needs more memory than is allowed or than the system has, or if [`Settings::full_space`] is
    /// set, the model is in full space, as [`Self::kind`] tells: nothing is condensed, and load cases are solved by products and solutions with the sparse
    /// matrix; pairs that depend on each other are condensed all the same. A condensation is done in the host's
    /// `order` of elimination if there is one: each degree of freedom once, the first to be eliminated first. Fixed
    /// ones, slaves and contact are left out; those with the same neighbours stay together.
    ///
    /// # Errors
    /// As [`Self::sparse`]; an order that is no permutation ([`Argument::Order`]); [`Error::Stopped`].
    pub fn sparse_within(
        matrix: &SparseMatrix<'_>,
        fixed: &[usize],
        pairs: &ContactPairs<'_>,
        order: Option<&[usize]>,
        monitor: &mut Monitor<'_>,
    ) -> Result<Self, Error> {
        let Monitor { full_space, reserve, .. } = *monitor;
        let ask = &mut |share, memory| monitor.shared().reducing(share, memory);
        let control = Control { order, full_space, reserve, case: memory_of_case, ask };
        let reduction = Box::new(SparseReduction::new(matrix, fixed, pairs, control)?);
        Model { dim: pairs.dim, pairs: pairs.count, reduction }.checked()
    }

    /// Refuses a reduced matrix that no structure has.
    fn checked(self) -> Result<Self, Error> {
        if self.is_matrix_free() {
            return Ok(self);
        }
        let dependence = self.reduction.dependence();
        let size = dependence.map_or(self.dim * self.pairs, Dependence::variables);
        let matrix = Matrix::new(size, self.reduction.stiffness(), size.max(1));
        // Rigid bodies have none; springs in series with pairs that depend on each other do without.
        if dependence.is_none() || matrix.largest_diagonal() > 0.0 {
            let named = ("K_rel", Argument::Matrix);
            match self.reduction.units_of_condensation() {
                Some(units) => symmetric_matrix::check_condensed(&matrix, units, named)?,
                None => symmetric_matrix::check(&matrix, 1, named)?,
            }
        }
        Ok(self)
    }

    /// Space dimension.
    pub fn dim(&self) -> usize {
        self.dim
    }

    /// Number of pairs.
    pub fn pairs(&self) -> usize {
        self.pairs
    }

    /// Entries of a load or displacement vector of the host: `dim * pairs` (condensed), twice that
    /// (two bodies: A, then B), or the degrees of freedom of the sparse matrix.
    pub fn host_size(&self) -> usize {
        self.reduction.host_size()
    }

    /// Number of fixed degrees of freedom.
    pub fn fixed_count(&self) -> usize {
        self.reduction.fixed_count()
    }

    /// `K_rel`, column-major, `dim * pairs` square; empty if [`Self::dependent_pairs`] names any, as there
    /// is none then, and if [`Self::is_matrix_free`].
    pub fn stiffness(&self) -> &[f64] {
        match self.reduction.dependence() {
            None => self.reduction.stiffness(),
            Some(_) => &[],
        }
    }

    /// Pairs whose rows follow from those of other pairs or from supports, such as a node on two planes with
    /// friction: contact forces are not unique then, and no stiffness in relative displacements exists.
    pub fn dependent_pairs(&self) -> &[usize] {
        self.reduction.dependence().map_or(&[], Dependence::dependent_pairs)
    }

    /// Frames of the pairs in the host's axes: of each pair the normal, then the `dim - 1` tangents,
    /// `dim` entries each, orthonormal, as the components of `d` and `F` use them. `None` if the host
    /// has condensed its bodies in frames of its own.
    pub fn frames(&self) -> Option<&[f64]> {
        self.reduction.frames()
    }

    /// Loads of a load case in relative displacements, `dim * pairs`: `f` of `K_rel d = f + F`.
    ///
    /// # Errors
    /// Loads or prescribed values of the wrong length or not finite, or that contradict the supports;
    /// [`Argument::Matrix`]: pairs depend on each other ([`Self::dependent_pairs`]).
    pub fn condensed_load(
        &self,
        load: &[f64],
        prescribed: Option<&[f64]>,
    ) -> Result<Vec<f64>, Error> {
        self.check_independent()?;
        self.check_stiffness_form()?;
        self.check_loads(Some(load), prescribed)?;
        self.reduction.condense(load, prescribed)
    }

    /// Solves a load case from the relative displacements `start`, or in flexibility form from contact forces.
    ///
    /// # Errors
    /// As [`solve()`], and loads or prescribed values of the wrong length or not finite.
    pub fn solve(
        &self,
        case: &LoadCase<'_>,
        settings: &Settings,
        start: Option<&[f64]>,
        monitor: &mut Monitor<'_>,
    ) -> Result<Solution, Error> {
        let past = (None, &mut CasePast::default());
        self.solve_condensed((case, None), past, (settings, start), monitor)
    }

    /// As [`Self::solve`]; `load` is what the loads condense to, if that is known; with what cases before have left.
    fn solve_condensed(
        &self,
        (case, load): (&LoadCase<'_>, Option<Vec<f64>>),
        (remembered, past): (Option<&Remembered>, &mut CasePast),
        (settings, start): (&Settings, Option<&[f64]>),
        monitor: &mut Monitor<'_>,
    ) -> Result<Solution, Error> {
        if let Some(form) = self.reduction.flexibility() {
            return solve_flexibility(&self.on_flexibility(form, case)?, settings, start, monitor);
        }
        if let Some(bodies) = self.reduction.bodies() {
            check_limit(self.memory(), settings)?;
            check_start("d", self.dim * self.pairs, start)?;
            let solution = self.on_bodies(bodies, case, |bodies, case| {
                let mut solution = solve_matrix_free(bodies, case, settings, start, past, monitor)?;
                solution.iterations = monitor.iterations();
                Ok(solution)
            });
            let solution = solution?;
            if solution.recession.is_none() {
                return Ok(solution);
            }
            let load = self.reduction.condense(case.load, case.prescribed)?;
            return Ok(self.with_motion(solution, &load));
        }
        if let Some(dependence) = self.reduction.dependence() {
            check_limit(self.memory(), settings)?;
            return self.on_dependent_rows(dependence, (case, load), |problem| {
                let solution = solve_dependent(problem, settings, start, monitor)?;
                Ok(self.with_motion(solution, problem.relation().load()))
            });
        }
        self.reduced((case, load), |problem| {
            let solution = solve(&problem.remembering(remembered), settings, start, monitor)?;
            Ok(self.with_motion(solution, problem.load()))
        })
    }

    /// The solution with a sentence on the motion that `load` drives, if there is one.
    fn with_motion(&self, mut solution: Solution, load: &[f64]) -> Solution {
        if solution.status == Status::NoEquilibrium
            && let Some(motion) = &solution.recession
        {
            let escape = solution.escape.as_ref();
            let parts =
                escape.map(|escape| (escape.motion.as_slice(), escape.unbalanced.as_slice()));
            let parts = parts.unwrap_or((motion, load));
            let [moves, left] = driven_motion((&*self.reduction, self.dim), load, parts);
            // C cuts what is long: the force comes last.
            solution.message = format!("{NO_EQUILIBRIUM}: {moves}; {CAUSES}{left}").into();
        }
        solution
    }

    /// Writes the contact problem that [`Self::solve`] solves for a load case to a file.
    ///
    /// # Errors
    /// As [`Self::solve`] for the load case, and as [`file::write`]; pairs that depend on each other
    /// ([`Argument::Matrix`]), which such a file cannot hold.
    pub fn write_case(
        &self,
        path: &Path,
        case: &LoadCase<'_>,
        remark: Option<&str>,
    ) -> Result<(), Error> {
        self.reduced((case, None), |problem| file::write(path, problem, remark))
    }

    /// Hands over the contact problem of a load case, with what its loads condense to if that is known.
    fn reduced<T>(
        &self,
        (case, load): (&LoadCase<'_>, Option<Vec<f64>>),
        to: impl FnOnce(&ContactProblem<'_>) -> Result<T, Error>,
    ) -> Result<T, Error> {
        self.check_formed()?;
        let condensed = || self.condensed_load(case.load, case.prescribed);
        let load = load.map_or_else(condensed, Ok)?;
        let slip = self.allowed_slip(case)?;
        let problem = ContactProblem::on_checked_matrix(ContactData {
            dim: self.dim,
            pairs: self.pairs,
            stiffness: self.stiffness(),
            ld: (self.dim * self.pairs).max(1),
            load: &load,
            gap: case.gap,
            law: case.law,
            reference_slip: slip.as_deref(),
        })?;
        match self.reduction.is_condensed_by_host() {
            true => to(&problem.condensed_by_host()),
            false => to(&problem),
        }
    }

    /// Hands over the problem of a load case on rows that depend on each other.
    fn on_dependent_rows<T>(
        &self,
        dependence: &Dependence,
        (case, load): (&LoadCase<'_>, Option<Vec<f64>>),
        to: impl FnOnce(&ContactProblem<'_, DependentRows<'_>>) -> Result<T, Error>,
    ) -> Result<T, Error> {
        let condensed = || {
            self.check_loads(Some(case.load), case.prescribed)?;
            self.reduction.condense(case.load, case.prescribed)
        };
        let load = load.map_or_else(condensed, Ok)?;
        let slip = self.allowed_slip(case)?;
        let offset = dependence.offset(case.prescribed);
        let stiffness = (self.reduction.stiffness(), &load[..]);
        let lengths = case.gap.iter().chain(case.reference_slip.unwrap_or(&[])).chain(&offset);
        let length = lengths.filter(|x| x.is_finite()).fold(0.0_f64, |most, x| most.max(x.abs()));
        let of_rigid = Some(norm_inf(&load) / length).filter(|unit| unit.is_normal());
        let of_rigid = of_rigid.unwrap_or(1.0);
        let relation = DependentRows::new(dependence, stiffness, &offset, of_rigid);
        let (gap, slip) = (case.gap, slip.as_deref());
        let problem = ContactProblem::with_relation(relation, self.dim, gap, case.law, slip)?;
        to(&problem)
    }

    fn check_loads(&self, load: Option<&[f64]>, prescribed: Option<&[f64]>) -> Result<(), Error> {
        if let Some(load) = load {
            check_vector(("f", Argument::Load), load, self.host_size())?;
        }
        match prescribed {
            Some(values) => {
                check_vector(("prescribed", Argument::Prescribed), values, self.fixed_count())?;
                self.reduction.check_prescribed(values)
            }
            None => Ok(()),
        }
    }

    /// The reference slip of a load case, zero where supports on both sides of a pair fix it. Refuses gaps that such
    /// supports do not allow.
    fn allowed_slip(&self, case: &LoadCase<'_>) -> Result<Option<Vec<f64>>, Error> {
        let fixed = self.reduction.fixed_components();
        check_fixed_gaps(fixed, self.dim, case.gap, case.law)?;
        let Some(slip) = case.reference_slip else { return Ok(None) };
        let mut slip = slip.to_vec();
        for component in fixed {
            let (pair, direction) = (component / self.dim, component % self.dim);
            if direction > 0
                && let Some(slip) = slip.get_mut((self.dim - 1) * pair + direction - 1)
            {
                *slip = 0.0;
            }
        }
        Ok(Some(slip))
    }
}
