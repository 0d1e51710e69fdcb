//! The change of variables `u = T x + P p` from the unknowns and the fixed values to the host's degrees
//! of freedom, and what it makes of a matrix and of loads.
//!
//! The unknowns `x` are the free degrees of freedom that no row gives, then the relative displacements `d` (of rows
//! that depend on each other, those of independent ones and the degrees of freedom that others name); `p` are the values of the fixed degrees of freedom.
//! Degrees of freedom that follow from others by equations of the host are neither.
//! `W = [T P]` is one sparse matrix, so that `Wᵀ K W` has all that is needed: `Tᵀ K T`, and `Pᵀ K T` for the loads of the fixed values.
//!
//! A component of `d` that supports fix moves nothing. It gets a spring to nothing, as stiff as the
//! stiffest entry of `K`: a further row of `K` and of `W`, so that `Tᵀ K T` has a decoupled row for it. Where `Tᵀ K T` is
//! condensed the spring becomes as stiff as the other components of its pair.

use super::supports::FixedComponent;
use crate::linalg::congruence::{congruence, without_dependents};
use crate::linalg::row_elimination::{Expression, Terms};
use crate::linalg::sparse_matrix::{
    Csc, OutOfMemory, from_columns, from_entries, product_without_rounding, times, transpose_times,
};
use crate::linalg::sparse_schur::{FactorProgress, Failure};
use crate::linalg::vector::norm_inf;
use crate::reduce::equations::Dependents;
use crate::reduce::frame::Frame;
use crate::reduce::pairs::Rows;

pub(super) struct ChangeOfVariables {
    /// `W`: a row for each degree of freedom of the host, then one for each spring.
    matrix: Csc,
    /// The part of it that equations make: it gives dependents from all others.
    equations: Option<Csc>,
    /// Number of the host's degrees of freedom.
    pub(super) host_size: usize,
    springs: usize,
    /// Number of entries of `x`.
    unknowns: usize,
    /// The host's degree of freedom of each free unknown.
    pub(super) free: Vec<usize>,
}

impl ChangeOfVariables {
    /// The change of variables where rows give the degrees of freedom `given` in so many `kept` variables, which
    /// `of_right_sides` tells and of which `hosts` are the last ones; `places` are the places in `fixed` of the host's degrees of freedom.
    /// With springs on components that are fixed.
    pub(super) fn new(
        (places, dependents): (&[Option<usize>], &Dependents),
        (given, kept): (&[(usize, Expression)], usize),
        of_right_sides: impl Fn(&Terms) -> Terms,
        (hosts, fixed_components): (&[usize], &[FixedComponent]),
    ) -> Result<Self, OutOfMemory> {
        let (host_size, springs) = (places.len(), fixed_components.len());
        let mut is_free: Vec<bool> = places.iter().map(Option::is_none).collect();
        let of_equations = dependents.of_matrix(host_size).map(|(dof, _)| dof);
        let of_rows = given.iter().map(|(dof, _)| *dof);
        of_rows
            .chain(of_equations)
            .chain(hosts.iter().copied())
            .for_each(|dof| is_free[dof] = false);
        let free: Vec<usize> = (0..host_size).filter(|&dof| is_free[dof]).collect();
        let unknowns = free.len() + kept;
        let mut column: Vec<Option<usize>> =
            places.iter().map(|place| place.map(|k| unknowns + k)).collect();
        free.iter().enumerate().for_each(|(k, &dof)| column[dof] = Some(k));
        (unknowns - hosts.len()..).zip(hosts).for_each(|(k, &dof)| column[dof] = Some(k));
        let same = (0..host_size).filter_map(|dof| Some((dof, column[dof]?, 1.0)));
        let mut entries: Vec<(usize, usize, f64)> = same.collect();
        for (dof, Expression { unknowns, right_sides }) in given {
            // Unknowns that no equation gives have a column.
            entries.extend(unknowns.iter().filter_map(|&(k, a)| Some((*dof, column[k]?, a))));
            let kept = of_right_sides(right_sides).into_iter();
            entries.extend(kept.map(|(k, a)| (*dof, free.len() + k, a)));
        }
        for (k, fixed) in fixed_components.iter().enumerate() {
            entries.push((host_size + k, free.len() + fixed.variable, 1.0));
        }
        entries.retain(|(_, _, value)| *value != 0.0);
        let (rows, fixed) = (host_size + springs, places.iter().flatten().count());
        let mut matrix = from_entries((rows, unknowns + fixed), entries.into_iter())?;
        let mut equations = None;
        if !dependents.is_empty() {
            let dependents = equations.insert(with_dependents(rows, host_size, dependents)?);
            matrix = product_without_rounding(dependents, &matrix)?;
        }
        Ok(ChangeOfVariables { matrix, equations, host_size, springs, unknowns, free })
    }

    /// The lower triangle of `Tᵀ K T`, and `Pᵀ K T`, from the lower triangle of `K`. Dependents leave `K` first: there a rigid body has
    /// no stiffness of its own but for rounding, which rows of pairs would mix with the stiffness of others.
    pub(super) fn transform(
        &self,
        host: Csc,
        progress: &mut FactorProgress<'_>,
    ) -> Result<(Csc, Csc), Failure> {
        let mut host = with_springs(host, self.springs);
        let goes_on = &mut || progress(0.0).is_ok();
        if let Some(equations) = &self.equations {
            host = without_dependents(&host, equations, goes_on)?.ok_or(Failure::Stopped)?;
        }
        congruence(host, &self.matrix, self.unknowns, goes_on)?.ok_or(Failure::Stopped)
    }

    /// `T x + P p`; `None`: `p` is zero.
    pub(super) fn host_displacements(&self, x: &[f64], p: Option<&[f64]>) -> Vec<f64> {
        let mut all = vec![0.0; self.matrix.ncols()];
        all[..x.len()].copy_from_slice(x);
        if let Some(p) = p {
            all[self.unknowns..].copy_from_slice(p);
        }
        let mut u = times(&self.matrix, &all);
        u.truncate(self.host_size);
        u
    }

    /// `Tᵀ f`.
    pub(super) fn load(&self, f: &[f64]) -> Vec<f64> {
        let mut all = f.to_vec();
        all.resize(self.matrix.nrows(), 0.0);
        let mut load = transpose_times(&self.matrix, &all);
        load.truncate(self.unknowns);
        load
    }
}

/// The matrix that gives dependents from all others.
fn with_dependents(
    rows: usize,
    host_size: usize,
    dependents: &Dependents,
) -> Result<Csc, OutOfMemory> {
    // Springs stand where the host may have other numbers.
    let stays = |dof: &usize| *dof >= host_size || !dependents.have(*dof);
    let same = (0..rows).filter(stays).map(|dof| (dof, dof, 1.0));
    let given = dependents.of_matrix(host_size);
    let given = given.flat_map(|(dof, terms)| terms.iter().map(move |&(k, a)| (dof, k, a)));
    from_entries((rows, rows), same.chain(given))
}

/// The matrix with rows for decoupled springs at its end, as stiff as its largest entry.
fn with_springs(lower: Csc, springs: usize) -> Csc {
    if springs == 0 {
        return lower;
    }
    let stiff = norm_inf(lower.val());
    let (symbolic, mut values) = lower.into_parts();
    let (size, _, mut col_start, _, mut row) = symbolic.into_parts();
    for k in size..size + springs {
        row.push(k);
        values.push(stiff);
        col_start.push(row.len());
    }
    from_columns((size + springs, size + springs), col_start, row, values)
}

/// `Bᵀ`: the nodal forces of unit contact forces. `B` gives the relative displacements,
/// `d = Rᵀ sum a_k u_k`.
pub(super) fn contact_forces(
    host_size: usize,
    rows: &Rows,
    frames: &[Frame],
) -> Result<Csc, OutOfMemory> {
    let mut entries = Vec::new();
    for (pair, frame) in frames.iter().enumerate() {
        for (component, direction) in frame.directions().enumerate() {
            let component = rows.dim * pair + component;
            for (terms, &part) in rows.of_pair(pair).iter().zip(direction) {
                entries.extend(terms.iter().map(|&(dof, a)| (dof, component, a * part)));
            }
        }
    }
    from_entries((host_size, rows.equations.len()), entries.into_iter())
}
