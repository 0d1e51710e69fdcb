//! The questions that every reduction of a structure to its contact pairs answers.

use super::motion;
use crate::error::{Error, Message};
use crate::problem::{Dependence, FlexibilityForm, GoesOn, StiffnessOperator};

/// Nodal loads of the host, and values of the fixed degrees of freedom (`None`: zero).
pub type HostLoad<'a> = (&'a [f64], Option<&'a [f64]>);

/// The relative loads of each of several load cases.
pub type Condensed = Result<Option<Vec<Vec<f64>>>, Error>;

/// A load case of which the relative displacements are known.
#[derive(Clone, Copy, Debug)]
pub struct SolvedCase<'a> {
    /// Nodal loads of the host; `None`: zero.
    pub load: Option<&'a [f64]>,
    /// Values of the fixed degrees of freedom; `None`: zero.
    pub prescribed: Option<&'a [f64]>,
    /// Relative displacements, `dim` entries for each pair.
    pub d: &'a [f64],
}

/// A structure reduced to its contact pairs. It does not change: several threads may use it at once.
///
/// Vectors of the host have [`Self::host_size`] entries; vectors of relative displacements and of
/// contact forces have `dim` entries for each pair, the normal component first. The lengths of
/// arguments are the caller's responsibility. As they stand here, the functions are those of a host whose vectors
/// are the relative ones.
pub trait Reduction: Send + Sync {
    /// `K_rel`, column-major, square; of rows that depend on each other the stiffness `K` of their
    /// independent variables.
    fn stiffness(&self) -> &[f64] {
        &[]
    }

    /// Number of inner unknowns of [`Self::bodies`]; `None` where a stiffness is formed.
    fn inner_unknowns(&self) -> Option<usize> {
        None
    }

    /// The operator that a solver works on in the place of a stiffness that is not formed, for one load case at a time;
    /// [`Self::stiffness`] is empty then.
    fn bodies(&self) -> Option<Box<dyn StiffnessOperator + '_>> {
        None
    }

    /// Loads of all unknowns of [`Self::bodies`] in a load case.
    fn all_loads(&self, load: &[f64], _prescribed: Option<&[f64]>) -> Vec<f64> {
        load.to_vec()
    }

    /// Most bytes that [`Self::bodies`] take at work beside this reduction, without what the host's functions take.
    fn factor_bytes(&self) -> u64 {
        0
    }

    /// The matrix of the flexibility form; [`Self::stiffness`] is empty then.
    fn flexibility(&self) -> Option<FlexibilityForm<'_>> {
        None
    }

    /// How the relative displacements follow from independent variables; `None`: they are these variables.
    fn dependence(&self) -> Option<&Dependence> {
        None
    }

    /// Returns `true` if the host has condensed the stiffness, so that its rounding is not known from its entries.
    fn is_condensed_by_host(&self) -> bool {
        false
    }

    /// The size of the terms of which each diagonal entry of [`Self::stiffness`] is left, if the library condensed it: its rounding
    /// is known beside them.
    fn units_of_condensation(&self) -> Option<&[f64]> {
        None
    }

    /// Entries of a load or displacement vector of the host.
    fn host_size(&self) -> usize;

    /// Number of degrees of freedom that the host holds fixed.
    fn fixed_count(&self) -> usize {
        0
    }

    /// Relative loads of a load case, of the variables of [`Self::stiffness`]: nodal loads and the values of the fixed degrees of freedom
    /// (`None`: zero).
    ///
    /// # Errors
    /// No memory for a factor that is not kept.
    fn condense(&self, load: &[f64], prescribed: Option<&[f64]>) -> Result<Vec<f64>, Error> {
        let condensed = self.condense_cases(&[(load, prescribed)], &mut || true)?;
        Ok(condensed.unwrap_or_default().concat())
    }

    /// Displacements of the host in a motion, from its relative ones; none where that fails.
    fn displacements_of_motion(&self, d: &[f64]) -> Vec<f64> {
        let motion = SolvedCase { load: None, prescribed: None, d };
        self.recover_cases(&[motion]).unwrap_or_default().concat()
    }

    /// As [`Self::condense`], of the loads and fixed values of several load cases at once; `None` where `goes_on`, which
    /// is asked now and then, says no.
    ///
    /// # Errors
    /// As [`Self::condense`].
    fn condense_cases(&self, cases: &[HostLoad<'_>], _goes_on: GoesOn<'_>) -> Condensed {
        Ok(Some(cases.iter().map(|(load, _)| load.to_vec()).collect()))
    }

    /// Displacements of the host in each of several load cases.
    ///
    /// # Errors
    /// As [`Self::condense`].
    fn recover_cases(&self, cases: &[SolvedCase<'_>]) -> Result<Vec<Vec<f64>>, Error> {
        Ok(cases.iter().map(|case| case.d.to_vec()).collect())
    }

    /// Contact forces as nodal forces of the host.
    fn nodal_forces(&self, force: &[f64]) -> Vec<f64> {
        force.to_vec()
    }

    /// Rejects values of the fixed degrees of freedom that would open a pair along one of
    /// [`Self::fixed_components`].
    ///
    /// # Errors
    /// Names the pair.
    fn check_prescribed(&self, _values: &[f64]) -> Result<(), Error> {
        Ok(())
    }

    /// Components of `d` that supports on both sides of a pair fix: `d` and the contact force are
    /// zero there in every load case, and so must be the reference slip.
    fn fixed_components(&self) -> &[usize] {
        &[]
    }

    /// Frames of the pairs in the host's axes, `dim * dim` entries for each pair: the normal, then the
    /// tangents, orthonormal. `None` if only the host knows them.
    fn frames(&self) -> Option<&[f64]> {
        None
    }

    /// A motion in words, from its relative displacements: which part moves, where, and in which
    /// direction. It completes "it moves ...".
    fn motion_in_words(&self, dim: usize, d: &[f64]) -> Message {
        motion::of_pairs(dim, d).into()
    }
}
