//! Reduce once, solve many load cases, recover.

use std::path::Path;

use crate::certificate::{Certificate, certify};
use crate::error::{Argument, Error};
use crate::file;
use crate::matrix::{self, SymmetricMatrix};
use crate::monitor::Monitor;
use crate::problem::{ContactData, ContactProblem, FrictionLaw, checked_dim, unknowns};
use crate::reduce::{ContactPairs, SparseMatrix, SparseReduction, TwoBodyReduction};
use crate::settings::Settings;
use crate::solve::{Solution, solve};

/// A structure, reduced to its contact pairs. It does not change: several threads may use it.
pub struct Model {
    dim: usize,
    pairs: usize,
    reduction: Reduction,
}

enum Reduction {
    Condensed(Vec<f64>),
    TwoBody(TwoBodyReduction),
    Sparse(Box<SparseReduction>),
}

/// One load case: nodal loads of the host and the contact data of each pair.
#[derive(Clone, Copy, Debug)]
pub struct LoadCase<'a> {
    /// Nodal loads, [`Model::host_size`].
    pub load: &'a [f64],
    /// Values of the fixed degrees of freedom, in their order; `None`: zero.
    pub prescribed: Option<&'a [f64]>,
    /// Gaps of the pairs.
    pub gap: &'a [f64],
    /// Friction of the pairs.
    pub law: FrictionLaw<'a>,
    /// Tangential displacement at rest, `dim - 1` for each pair; `None`: zero.
    pub reference_slip: Option<&'a [f64]>,
}

impl Model {
    /// A body condensed by the host, on an obstacle: `d = u`.
    ///
    /// # Errors
    /// As [`ContactProblem::new`] for the matrix.
    pub fn condensed(dim: usize, pairs: usize, k: &[f64], ld: usize) -> Result<Self, Error> {
        let size = unknowns(checked_dim(dim)?, pairs)?;
        check_length("K", (k, ld), size, (Argument::Matrix, Argument::LeadingDimension))?;
        let matrix = SymmetricMatrix { size, entries: k, ld };
        matrix.check("K", Argument::Matrix)?;
        let stiffness = (0..size).flat_map(|j| matrix.column(j).iter().copied()).collect();
        Ok(Model { dim, pairs, reduction: Reduction::Condensed(stiffness) })
    }

    /// Two condensed bodies on matching contact nodes, each in its own outward frame.
    ///
    /// # Errors
    /// As [`TwoBodyReduction::new`].
    pub fn two_body(
        dim: usize,
        pairs: usize,
        first: (&[f64], usize),
        second: (&[f64], usize),
    ) -> Result<Self, Error> {
        let size = unknowns(checked_dim(dim)?, pairs)?;
        check_length("K_A", first, size, (Argument::Matrix, Argument::LeadingDimension))?;
        let names = (Argument::SecondMatrix, Argument::SecondLeadingDimension);
        check_length("K_B", second, size, names)?;
        let reduction = Reduction::TwoBody(TwoBodyReduction::new(size, first, second)?);
        Model { dim, pairs, reduction }.checked()
    }

    /// A whole sparse stiffness matrix with fixed degrees of freedom and pairs.
    ///
    /// # Errors
    /// As [`SparseReduction::new`].
    pub fn sparse(
        matrix: &SparseMatrix<'_>,
        fixed: &[usize],
        interface: &ContactPairs<'_>,
    ) -> Result<Self, Error> {
        let reduction = SparseReduction::new(matrix, fixed, interface)?;
        let reduction = Reduction::Sparse(Box::new(reduction));
        Model { dim: interface.dim, pairs: interface.pairs, reduction }.checked()
    }

    /// Refuses a reduced matrix in which a relative component has no stiffness of its own.
    fn checked(self) -> Result<Self, Error> {
        let size = self.dim * self.pairs;
        let matrix = SymmetricMatrix { size, entries: self.stiffness(), ld: size.max(1) };
        matrix.check("K_rel", Argument::Matrix)?;
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
        match &self.reduction {
            Reduction::Condensed(_) => self.dim * self.pairs,
            Reduction::TwoBody(_) => 2 * self.dim * self.pairs,
            Reduction::Sparse(reduction) => reduction.host_size(),
        }
    }

    /// Number of fixed degrees of freedom.
    pub fn fixed_count(&self) -> usize {
        match &self.reduction {
            Reduction::Sparse(reduction) => reduction.fixed_count(),
            _ => 0,
        }
    }

    /// `K_rel`, column-major, `dim * pairs` square.
    pub fn stiffness(&self) -> &[f64] {
        match &self.reduction {
            Reduction::Condensed(stiffness) => stiffness,
            Reduction::TwoBody(reduction) => reduction.stiffness(),
            Reduction::Sparse(reduction) => reduction.stiffness(),
        }
    }

    /// Frames of the pairs of a sparse model: for each pair the normal, then the tangents, unit
    /// vectors of `dim` entries. `None` of other models, which the host condensed in its own frames.
    pub fn frames(&self) -> Option<&[f64]> {
        match &self.reduction {
            Reduction::Sparse(reduction) => Some(reduction.frames()),
            _ => None,
        }
    }

    /// Relative loads of a load case, `dim * pairs`: `f` of the contact problem whose stiffness is
    /// [`Self::stiffness`].
    ///
    /// # Errors
    /// Loads or prescribed values of the wrong length or not finite.
    pub fn condensed_load(
        &self,
        load: &[f64],
        prescribed: Option<&[f64]>,
    ) -> Result<Vec<f64>, Error> {
        self.check_loads(Some(load), prescribed)?;
        Ok(match &self.reduction {
            Reduction::Condensed(_) => load.to_vec(),
            Reduction::TwoBody(reduction) => reduction.condense(load),
            Reduction::Sparse(reduction) => reduction.condense(load, prescribed),
        })
    }

    /// Measures relative displacements `d` of any origin on a load case.
    ///
    /// # Errors
    /// As [`Self::solve`] for the load case; a `d` of the wrong length or not finite
    /// ([`Argument::Start`]).
    pub fn certify(&self, case: &LoadCase<'_>, d: &[f64]) -> Result<Certificate, Error> {
        check_vector(Argument::Start, "d", d, self.dim * self.pairs)?;
        self.reduced(case, |problem| Ok(certify(problem, d)))
    }

    /// Solves a load case from the relative displacements `start`.
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
        self.reduced(case, |problem| solve(problem, settings, start, monitor))
    }

    /// Writes the contact problem that [`Self::solve`] solves for a load case to a file.
    ///
    /// # Errors
    /// As [`Self::solve`] for the load case, and as [`file::write`].
    pub fn write_case(
        &self,
        path: &Path,
        case: &LoadCase<'_>,
        remark: Option<&str>,
    ) -> Result<(), Error> {
        self.reduced(case, |problem| file::write(path, problem, remark))
    }

    /// Hands over the contact problem of a load case.
    fn reduced<T>(
        &self,
        case: &LoadCase<'_>,
        to: impl FnOnce(&ContactProblem<'_>) -> Result<T, Error>,
    ) -> Result<T, Error> {
        let load = self.condensed_load(case.load, case.prescribed)?;
        let slip = case.reference_slip.map(|slip| self.allowed_slip(slip));
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
        to(&problem)
    }

    /// Displacements of the host from the relative ones; without `load` and `prescribed` those of
    /// a motion, such as that of [`crate::Status::NoEquilibrium`].
    ///
    /// # Errors
    /// Arrays of the wrong length or not finite.
    pub fn recover(
        &self,
        load: Option<&[f64]>,
        prescribed: Option<&[f64]>,
        d: &[f64],
    ) -> Result<Vec<f64>, Error> {
        self.check_loads(load, prescribed)?;
        check_vector(Argument::Start, "d", d, self.dim * self.pairs)?;
        let zero = vec![0.0; self.host_size()];
        let load = load.unwrap_or(&zero);
        Ok(match &self.reduction {
            Reduction::Condensed(_) => d.to_vec(),
            Reduction::TwoBody(reduction) => reduction.recover(load, d),
            Reduction::Sparse(reduction) => reduction.recover(load, prescribed, d),
        })
    }

    /// Contact forces as a nodal force vector of the host.
    ///
    /// # Errors
    /// A force of the wrong length or not finite.
    pub fn nodal_forces(&self, force: &[f64]) -> Result<Vec<f64>, Error> {
        check_vector(Argument::Load, "F", force, self.dim * self.pairs)?;
        Ok(match &self.reduction {
            Reduction::Condensed(_) => force.to_vec(),
            Reduction::TwoBody(_) => [force, force].concat(),
            Reduction::Sparse(reduction) => reduction.nodal_forces(force),
        })
    }

    fn check_loads(&self, load: Option<&[f64]>, prescribed: Option<&[f64]>) -> Result<(), Error> {
        if let Some(load) = load {
            check_vector(Argument::Load, "f", load, self.host_size())?;
        }
        match prescribed {
            Some(values) => {
                check_vector(Argument::Prescribed, "prescribed", values, self.fixed_count())?;
                match &self.reduction {
                    Reduction::Sparse(reduction) => reduction.check_prescribed(values),
                    _ => Ok(()),
                }
            }
            None => Ok(()),
        }
    }

    /// The previous slip, without any where supports on both sides allow none.
    fn allowed_slip(&self, slip: &[f64]) -> Vec<f64> {
        let mut slip = slip.to_vec();
        if let Reduction::Sparse(reduction) = &self.reduction {
            for component in reduction.held() {
                let (pair, axis) = (component / self.dim, component % self.dim);
                if axis > 0
                    && let Some(slip) = slip.get_mut((self.dim - 1) * pair + axis - 1)
                {
                    *slip = 0.0;
                }
            }
        }
        slip
    }
}

fn check_length(
    name: &str,
    (given, ld): (&[f64], usize),
    size: usize,
    (matrix, leading): (Argument, Argument),
) -> Result<(), Error> {
    let entries =
        matrix::entries(name, size, ld).map_err(|message| Error::invalid(leading, message))?;
    if given.len() < entries {
        let given = given.len();
        let message = format!("{name} has {given} entries, it must have {entries}");
        return Err(Error::invalid(matrix, message));
    }
    Ok(())
}

fn check_vector(
    argument: Argument,
    name: &str,
    values: &[f64],
    length: usize,
) -> Result<(), Error> {
    if values.len() != length {
        let message = format!("{name} has {} entries, it must have {length}", values.len());
        return Err(Error::invalid(argument, message));
    }
    match values.iter().position(|value| !value.is_finite()) {
        Some(i) => Err(Error::invalid(argument, format!("{name}[{i}] is not finite"))),
        None => Ok(()),
    }
}
