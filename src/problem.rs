//! The contact problem in relative displacements: the only thing that a solver sees.
//!
//! For `n` pairs in dimension `D`, ordered pair by pair as (n, t) or (n, t1, t2):
//!
//! ```text
//! K d = f + F
//! d_n <= gap,  F_n <= 0,  (d_n - gap) F_n = 0                        (paper, 5 and 8)
//! |F_t| <= mu |F_n|,  d_t = slip inside the cone,
//!                     d_t - slip = -lambda F_t, lambda >= 0, on it     (paper, 6 and 9)
//! ```
//!
//! `K` is symmetric and positive semi-definite: bodies held by nothing but contact are allowed.

use std::fmt::Display;

use crate::error::{Argument, Error};
use crate::linalg::small;
use crate::matrix::{self, SymmetricMatrix};

/// The bound on the tangential force of each pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FrictionLaw<'a> {
    /// No friction: `F_t = 0`.
    Frictionless,
    /// Coulomb: `|F_t| <= mu |F_n|`, one coefficient `mu >= 0` for each pair.
    Coulomb(&'a [f64]),
    /// Tresca: `|F_t| <= g`, one threshold `g >= 0` (a force) for each pair, open or closed.
    Tresca(&'a [f64]),
}

impl<'a> FrictionLaw<'a> {
    fn values(&self) -> &'a [f64] {
        match *self {
            FrictionLaw::Frictionless => &[],
            FrictionLaw::Coulomb(values) | FrictionLaw::Tresca(values) => values,
        }
    }

    /// Number of parameters of each pair.
    pub fn parameters(&self) -> usize {
        match self {
            FrictionLaw::Frictionless => 0,
            FrictionLaw::Coulomb(_) | FrictionLaw::Tresca(_) => 1,
        }
    }

    /// True when no pair can carry a tangential force.
    pub fn is_zero(&self) -> bool {
        self.values().iter().all(|&value| value == 0.0)
    }
}

/// The caller's arrays, not yet checked. Forces and displacements are in the caller's units.
#[derive(Clone, Copy, Debug)]
pub struct ContactData<'a> {
    /// 2 or 3.
    pub dim: usize,
    /// Number of contact pairs, 0 allowed.
    pub pairs: usize,
    /// `K`, `dim * pairs` columns of the same number of rows, column-major.
    pub stiffness: &'a [f64],
    /// Distance between the beginnings of two columns of `stiffness`.
    pub ld: usize,
    /// `f`, the condensed nodal loads, `dim * pairs`.
    pub load: &'a [f64],
    /// Initial gaps, `pairs`; negative: interference, `+inf`: never touches.
    pub gap: &'a [f64],
    /// Friction coefficients or thresholds.
    pub law: FrictionLaw<'a>,
    /// Tangential displacement at which friction is at rest, `(dim - 1) * pairs`;
    /// `None` is zero (the paper's total law).
    pub reference_slip: Option<&'a [f64]>,
}

/// A checked contact problem, a view of the caller's arrays.
#[derive(Clone, Copy, Debug)]
pub struct ContactProblem<'a> {
    data: ContactData<'a>,
}

impl<'a> ContactProblem<'a> {
    /// Checks the data.
    ///
    /// # Errors
    /// [`Error::Invalid`] names the first entry that is not finite, not symmetric beyond rounding
    /// (1e-9 of the diagonal), on a diagonal that is not positive, or out of range.
    pub fn new(data: ContactData<'a>) -> Result<Self, Error> {
        let problem = Self::on_checked_matrix(data)?;
        let size = problem.unknowns();
        SymmetricMatrix { size, entries: data.stiffness, ld: data.ld }
            .check("K", Argument::Matrix)?;
        Ok(problem)
    }

    /// Checks everything but the entries of the matrix, which a model has checked once.
    pub(crate) fn on_checked_matrix(data: ContactData<'a>) -> Result<Self, Error> {
        let ContactData { dim, pairs, .. } = data;
        let n = unknowns(checked_dim(dim)?, pairs)?;
        let problem = ContactProblem { data };
        problem.check_lengths(n)?;
        let problem = problem.trimmed();
        let data = problem.data;
        check_finite(Argument::Load, "f", data.load)?;
        check_gaps(data.gap)?;
        check_friction(data.law)?;
        if let Some(slip) = data.reference_slip {
            check_finite(Argument::ReferenceSlip, "slip0", slip)?;
        }
        Ok(problem)
    }

    /// A problem of the library's own making, which may have a single component for each pair.
    pub(crate) fn reduced(data: ContactData<'a>) -> Self {
        ContactProblem { data }
    }

    /// The same problem under another friction law.
    pub(crate) fn with_law<'b>(&self, law: FrictionLaw<'b>) -> ContactProblem<'b>
    where
        'a: 'b,
    {
        ContactProblem { data: ContactData { law, ..self.data } }
    }

    /// Components of a pair: the space dimension `D`, 2 or 3.
    pub fn dim(&self) -> usize {
        self.data.dim
    }

    /// Number of contact pairs.
    pub fn pairs(&self) -> usize {
        self.data.pairs
    }

    /// Number of unknowns, `D` for each pair.
    pub fn unknowns(&self) -> usize {
        self.data.dim * self.data.pairs
    }

    /// Column `j` of `K`.
    pub fn column(&self, j: usize) -> &'a [f64] {
        let begin = j * self.data.ld;
        &self.data.stiffness[begin..begin + self.unknowns()]
    }

    /// Entry `K[i, i]`, positive.
    pub fn diagonal(&self, i: usize) -> f64 {
        self.data.stiffness[i * self.data.ld + i]
    }

    /// Largest eigenvalue of the tangential block of a pair (in 2D its diagonal entry).
    pub fn tangential_stiffness(&self, pair: usize) -> f64 {
        let t = self.data.dim * pair + 1;
        match self.data.dim {
            // Nothing tangential: any positive number will do.
            1 => 1.0,
            2 => self.diagonal(t),
            _ => small::largest_eigenvalue(
                self.diagonal(t),
                self.column(t)[t + 1],
                self.diagonal(t + 1),
            ),
        }
    }

    /// `f`.
    pub fn load(&self) -> &'a [f64] {
        self.data.load
    }

    /// Gap of a pair, `+inf` if it never touches.
    pub fn gap(&self, pair: usize) -> f64 {
        self.data.gap[pair]
    }

    /// The friction law.
    pub fn law(&self) -> FrictionLaw<'a> {
        self.data.law
    }

    /// Tangential displacement at rest of a pair; `component` counts from 0 to `D - 2`.
    pub fn reference_slip(&self, pair: usize, component: usize) -> f64 {
        self.data.reference_slip.map_or(0.0, |slip| slip[(self.data.dim - 1) * pair + component])
    }

    /// Whether friction is at rest at zero displacement everywhere.
    pub fn has_no_reference_slip(&self) -> bool {
        self.data.reference_slip.is_none_or(|slip| slip.iter().all(|&slip| slip == 0.0))
    }

    /// Bound on the tangential force of a pair that carries the pressure `pressure >= 0`.
    pub fn threshold(&self, pair: usize, pressure: f64) -> f64 {
        match self.data.law {
            FrictionLaw::Frictionless => 0.0,
            FrictionLaw::Coulomb(mu) => mu[pair] * pressure,
            FrictionLaw::Tresca(g) => g[pair],
        }
    }

    /// `K d - f`, the force that `d` asks of the contact.
    pub fn force(&self, d: &[f64]) -> Vec<f64> {
        self.product(d, self.data.load.iter().map(|f| -f).collect())
    }

    /// `K d`, the force of the material.
    pub fn internal_force(&self, d: &[f64]) -> Vec<f64> {
        self.product(d, vec![0.0; self.unknowns()])
    }

    /// `sum + K d`.
    fn product(&self, d: &[f64], mut sum: Vec<f64>) -> Vec<f64> {
        self.add_product(d, &mut sum);
        sum
    }

    /// Adds `K d` to `sum`.
    pub(crate) fn add_product(&self, d: &[f64], sum: &mut [f64]) {
        for (j, &dj) in d.iter().enumerate() {
            if dj != 0.0 {
                for (sum, k) in sum.iter_mut().zip(self.column(j)) {
                    *sum += k * dj;
                }
            }
        }
    }

    /// Without what arrays have beyond their lengths.
    fn trimmed(self) -> Self {
        let ContactData { dim, pairs, load, gap, law, reference_slip, .. } = self.data;
        let law = match law {
            FrictionLaw::Frictionless => law,
            FrictionLaw::Coulomb(mu) => FrictionLaw::Coulomb(&mu[..pairs]),
            FrictionLaw::Tresca(g) => FrictionLaw::Tresca(&g[..pairs]),
        };
        let data = ContactData {
            load: &load[..dim * pairs],
            gap: &gap[..pairs],
            law,
            reference_slip: reference_slip.map(|slip| &slip[..(dim - 1) * pairs]),
            ..self.data
        };
        ContactProblem { data }
    }

    fn check_lengths(&self, n: usize) -> Result<(), Error> {
        let ContactData { dim, pairs, ld, .. } = self.data;
        let entries = matrix::entries("K", n, ld)
            .map_err(|message| Error::invalid(Argument::LeadingDimension, message))?;
        let slip = self.data.reference_slip;
        let lengths = [
            (Argument::Matrix, "K", self.data.stiffness.len(), entries),
            (Argument::Load, "f", self.data.load.len(), n),
            (Argument::Gap, "gap", self.data.gap.len(), pairs),
            (
                Argument::Law,
                "friction",
                self.data.law.values().len(),
                self.data.law.parameters() * pairs,
            ),
            (
                Argument::ReferenceSlip,
                "slip0",
                slip.map_or((dim - 1) * pairs, <[f64]>::len),
                (dim - 1) * pairs,
            ),
        ];
        for (argument, name, given, needed) in lengths {
            if given < needed {
                return Err(Error::invalid(
                    argument,
                    format!("{name} has {given} entries, it must have {needed}"),
                ));
            }
        }
        Ok(())
    }
}

/// A space dimension, of any type of integer, which must be 2 or 3.
pub(crate) fn checked_dim<T: Copy + Display + TryInto<usize>>(dim: T) -> Result<usize, Error> {
    match dim.try_into() {
        Ok(dim @ (2 | 3)) => Ok(dim),
        _ => {
            let message = format!("dim is {dim}, it must be 2 or 3");
            Err(Error::invalid(Argument::Dimension, message))
        }
    }
}

/// Number of unknowns `dim * pairs`, if their matrix fits in the address space.
pub(crate) fn unknowns(dim: usize, pairs: usize) -> Result<usize, Error> {
    const MOST: usize = isize::MAX as usize / size_of::<f64>();
    let fits = |n: &usize| n.checked_mul(*n).is_some_and(|entries| entries <= MOST);
    dim.checked_mul(pairs).filter(fits).ok_or_else(|| {
        Error::invalid(Argument::Size, format!("pairs is {pairs}: the matrix cannot exist"))
    })
}

fn check_finite(argument: Argument, name: &str, values: &[f64]) -> Result<(), Error> {
    match values.iter().position(|value| !value.is_finite()) {
        Some(i) => Err(Error::invalid(argument, format!("{name}[{i}] is not finite"))),
        None => Ok(()),
    }
}

fn check_gaps(gap: &[f64]) -> Result<(), Error> {
    match gap.iter().position(|&gap| gap.is_nan() || gap == f64::NEG_INFINITY) {
        Some(i) => Err(Error::invalid(
            Argument::Gap,
            format!("gap[{i}] is {}, it must be a number or +inf (never touches)", gap[i]),
        )),
        None => Ok(()),
    }
}

fn check_friction(friction: FrictionLaw<'_>) -> Result<(), Error> {
    let name = match friction {
        FrictionLaw::Frictionless => return Ok(()),
        FrictionLaw::Coulomb(_) => "mu",
        FrictionLaw::Tresca(_) => "g",
    };
    check_finite(Argument::Law, name, friction.values())?;
    match friction.values().iter().position(|&value| value < 0.0) {
        Some(i) => Err(Error::invalid(
            Argument::Law,
            format!("{name}[{i}] is {}, it must not be negative", friction.values()[i]),
        )),
        None => Ok(()),
    }
}
