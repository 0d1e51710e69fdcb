//! What can be wrong with a call, named by the argument at fault.

use std::fmt;

/// The argument that an [`Error::Invalid`] is about.
///
/// The C interface turns it into the position of that argument in the call (status `-k`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Argument {
    /// Space dimension of the contact pairs.
    Dimension,
    /// Number of contact pairs, or of unknowns of a bare complementarity problem.
    Size,
    /// Stiffness matrix, or the matrix of a bare complementarity problem.
    Matrix,
    /// Leading dimension of the matrix.
    LeadingDimension,
    /// Nodal loads, or the vector `q` of a bare complementarity problem.
    Load,
    /// Initial gaps.
    Gap,
    /// Parameters of the friction law: coefficients or thresholds.
    Law,
    /// Slip accumulated before this load case.
    ReferenceSlip,
    /// Covering vector of Lemke's method.
    Covering,
    /// Settings.
    Settings,
    /// Displacements to start from.
    Start,
    /// Stiffness matrix of the second body.
    SecondMatrix,
    /// Leading dimension of the second body's matrix.
    SecondLeadingDimension,
    /// Degrees of freedom that the host holds fixed.
    Fixed,
    /// Values of the fixed degrees of freedom.
    Prescribed,
    /// Contact pairs: slaves, masters, weights, normals, tangents.
    Pairs,
    /// Remark of a problem file.
    Remark,
}

/// Why a call was refused. Nothing has been computed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Error {
    /// An argument is out of range or inconsistent; the message names the entry.
    Invalid {
        /// Which argument.
        argument: Argument,
        /// One sentence for the caller's log, such as `K[12,7] is not finite`.
        message: String,
    },
    /// The memory for the named work array could not be had.
    OutOfMemory(&'static str),
    /// A file cannot be read or written; the message names it, the line if there is one, and what
    /// is wrong.
    File(String),
}

impl Error {
    pub(crate) fn invalid(argument: Argument, message: impl Into<String>) -> Self {
        Error::Invalid { argument, message: message.into() }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::Invalid { message, .. } | Error::File(message) => f.write_str(message),
            Error::OutOfMemory(what) => write!(f, "not enough memory for {what}"),
        }
    }
}

impl std::error::Error for Error {}
