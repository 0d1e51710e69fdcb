//! The structure by which a host hands over equations between degrees of freedom.

use super::args::{Arrays, size};
use super::guard::Failure;
use super::sparse::shifted;
use super::structures::{Structure, check_reserved};
use crate::reduce::Equations;

/// Equations u[dependent] = sum of coefficient * u[dof], without terms 0: constraints, rigid
/// bodies, turned axes, cyclic sectors. Pairs may name dependents. Those of K are eliminated, with
/// their loads; others have any number. Contact forces come out on the rest.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SignoriniEquations {
    /// sizeof(signorini_equations).
    pub struct_size: u32,
    /// 0.
    pub reserved: i32,
    /// Number of equations.
    pub count: i64,
    /// One of each equation, not in fixed.
    pub dependent: *const i64,
    /// Start of each equation's terms, as master_start.
    pub start: *const i64,
    /// Degree of freedom of each term.
    pub dofs: *const i64,
    /// Of each term.
    pub coefficients: *const f64,
}

// SAFETY: led by its size; numbers and pointers.
unsafe impl Structure for SignoriniEquations {}

/// Equations of the caller, with degrees of freedom counted from 0.
#[derive(Default)]
pub(super) struct GivenEquations<'h> {
    dependent: Vec<usize>,
    start: Vec<usize>,
    dofs: Vec<usize>,
    coefficients: &'h [f64],
}

impl SignoriniEquations {
    /// The caller's equations; none if the pointer is NULL.
    pub(super) fn read<'h>(
        arrays: &mut Arrays<'h>,
        position: i32,
        pointer: *const Self,
        base: i64,
    ) -> Result<GivenEquations<'h>, Failure> {
        if pointer.is_null() {
            return Ok(GivenEquations::default());
        }
        let given = arrays.required_copy(position, "equations", pointer)?;
        check_reserved(position, "equations", given.reserved)?;
        let count = size(position, "equations: count", given.count)?;
        if count == 0 {
            return Ok(GivenEquations::default());
        }
        let mut indices = |name, pointer, length| {
            let numbers = arrays.required(position, name, pointer, length)?;
            shifted(position, name, numbers, base)
        };
        let dependent = indices("equations: dependent", given.dependent, count)?;
        let start = indices("equations: start", given.start, count.saturating_add(1))?;
        let terms = start[count];
        let dofs = indices("equations: dofs", given.dofs, terms)?;
        let name = "equations: coefficients";
        let coefficients = arrays.required(position, name, given.coefficients, terms)?;
        Ok(GivenEquations { dependent, start, dofs, coefficients })
    }
}

impl GivenEquations<'_> {
    /// The equations for the library.
    pub(super) fn view(&self) -> Equations<'_> {
        let GivenEquations { dependent, start, dofs, coefficients } = self;
        Equations { dependent, start, dofs, coefficients }
    }
}
