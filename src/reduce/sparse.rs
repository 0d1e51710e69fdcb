//! A host's whole sparse stiffness matrix with contact pairs.
//!
//! The slave's displacement is written `u_slave = sum w_k u_master,k + R d`, with `R` the pair's frame
//! and `d` the relative displacement: the paper's change of variables for any number of bodies. With
//! `u = T [free; d] + u_0` from the fixed degrees of freedom, `K_rel` is the Schur complement of
//! `Tᵀ K T` on `d`. Parts that only contact holds are fine: with `d` held nothing floats.
//!
//! Nodes against segments balance forces and moments, and on matching meshes pass the patch test; on
//! others they do not: under a uniform pressure the nodal forces of three elements against four are
//! 6 % off, up to 8 % on other meshes.

use super::change::{Row, transform};
use super::interface::{ContactPairs, Frame};
use super::sparse_matrix::{LowerTriangle, SparseMatrix};
use crate::error::{Argument, Error};
use crate::linalg::sparse::{Condensation, Failure};

/// The reduction, kept for further load cases.
pub struct SparseReduction {
    host: LowerTriangle,
    dim: usize,
    /// Of each degree of freedom of the host: what it is made of.
    rows: Vec<Row>,
    pairs: usize,
    /// What a unit contact force does: degree of freedom, component of `F`, part of it.
    actions: Vec<(usize, usize, f64)>,
    fixed: Vec<usize>,
    /// Normal and tangents of each pair, `dim` entries each.
    frames: Vec<f64>,
    /// Relative components that supports on both sides hold, with what prescribed values give them.
    held: Vec<(usize, Row)>,
    unknowns: usize,
    condensation: Condensation,
}

impl SparseReduction {
    /// Reduces `matrix` with the degrees of freedom `fixed` and the pairs of `interface`.
    ///
    /// # Errors
    /// What is wrong with the arrays, by entry; a slave that is fixed where its masters are not; a
    /// motion that neither supports nor pairs hold, by a degree of freedom that moves in it.
    pub fn new(
        matrix: &SparseMatrix<'_>,
        fixed: &[usize],
        interface: &ContactPairs<'_>,
    ) -> Result<Self, Error> {
        let size = matrix.size;
        interface.check(size)?;
        let host = matrix.lower_triangle()?;
        let frames = (0..interface.pairs)
            .map(|pair| interface.frame(pair))
            .collect::<Result<Vec<_>, _>>()?;
        let number = numbers_of_fixed(size, fixed)?;
        let dim = interface.dim;
        let contact = dim * interface.pairs;
        let mut is_slave = vec![false; size];
        interface.slaves.iter().for_each(|&dof| is_slave[dof] = true);
        let mut rows = vec![Row::default(); size];
        let mut free_dofs = Vec::new();
        for dof in 0..size {
            if let Some(number) = number[dof] {
                rows[dof].fixed.push((number, 1.0));
            } else if !is_slave[dof] {
                rows[dof].unknowns.push((free_dofs.len(), 1.0));
                free_dofs.push(dof);
            }
        }
        let free = free_dofs.len();
        let mut held = Vec::new();
        for (pair, frame) in frames.iter().enumerate() {
            for (axis, &slave) in interface.slave(pair).iter().enumerate() {
                if number[slave].is_some() {
                    let component = held_component(interface, pair, axis, frame, &number)?;
                    let mut jump = Row { fixed: rows[slave].fixed.clone(), ..Row::default() };
                    for (weight, masters) in interface.masters_of(pair) {
                        let master = rows[masters[axis]].fixed.iter();
                        jump.fixed.extend(master.map(|&(k, c)| (k, -weight * c)));
                    }
                    held.push((dim * pair + component, jump));
                    continue;
                }
                let mut row = Row::default();
                for (component, direction) in frame[..dim].iter().enumerate() {
                    if direction[axis] != 0.0 {
                        row.unknowns.push((free + dim * pair + component, direction[axis]));
                    }
                }
                for (weight, masters) in interface.masters_of(pair) {
                    let master = &rows[masters[axis]];
                    let times = |entries: &[(usize, f64)]| {
                        entries.iter().map(|&(k, c)| (k, weight * c)).collect::<Vec<_>>()
                    };
                    row.unknowns.extend(times(&master.unknowns));
                    row.fixed.extend(times(&master.fixed));
                }
                rows[slave] = row;
            }
        }
        let transformed = transform(&host, &rows, free, contact, &held);
        let condensation =
            Condensation::new(transformed, free).map_err(|failure| match failure {
                Failure::Memory => Error::OutOfMemory("the factor of the stiffness matrix"),
                Failure::Indefinite(row) => Error::invalid(
                    Argument::Matrix,
                    match free_dofs.get(row) {
                        Some(dof) => format!(
                            "K is not positive semi-definite, as degree of freedom {dof} shows"
                        ),
                        None => "K is not positive semi-definite".into(),
                    },
                ),
                Failure::Motion(x) => {
                    let motion: Vec<f64> = rows.iter().map(|row| row.value(&x, None)).collect();
                    Error::invalid(Argument::Matrix, free_motion(&motion))
                }
            })?;
        Ok(SparseReduction {
            host,
            dim,
            rows,
            pairs: interface.pairs,
            actions: actions(interface, &frames),
            fixed: fixed.to_vec(),
            frames: frames
                .iter()
                .flat_map(|frame| &frame[..dim])
                .flat_map(|direction| &direction[..dim])
                .copied()
                .collect(),
            held,
            unknowns: free + contact,
            condensation,
        })
    }

    /// `K_rel`, column-major, `dim * pairs` square.
    pub fn stiffness(&self) -> &[f64] {
        self.condensation.schur()
    }

    /// For each pair the normal, then the tangents, `dim` entries each, of unit length.
    pub fn frames(&self) -> &[f64] {
        &self.frames
    }

    /// Degrees of freedom of the host.
    pub fn host_size(&self) -> usize {
        self.rows.len()
    }

    /// Number of fixed degrees of freedom.
    pub fn fixed_count(&self) -> usize {
        self.fixed.len()
    }

    /// Relative components that supports on both sides hold: they are and stay zero.
    pub fn held(&self) -> impl Iterator<Item = usize> {
        self.held.iter().map(|(component, _)| *component)
    }

    /// Refuses prescribed values that part a pair along a component which supports hold.
    ///
    /// # Errors
    /// Names the pair.
    pub fn check_prescribed(&self, prescribed: &[f64]) -> Result<(), Error> {
        for (component, jump) in &self.held {
            let parts = jump.fixed.iter().map(|&(k, c)| (c * prescribed[k]).abs()).sum::<f64>();
            let jump = jump.value(&[], Some(prescribed));
            if jump.abs() > 1e-12 * parts {
                let pair = component / self.dim;
                return Err(Error::invalid(
                    Argument::Prescribed,
                    format!("prescribed values move both sides of pair {pair} apart by {jump}"),
                ));
            }
        }
        Ok(())
    }

    /// Relative loads from nodal loads and the values of the fixed degrees of freedom.
    pub fn condense(&self, load: &[f64], prescribed: Option<&[f64]>) -> Vec<f64> {
        self.half_solved(load, prescribed).0
    }

    /// Displacements of the whole mesh from the loads, the fixed values and `d`.
    pub fn recover(&self, load: &[f64], prescribed: Option<&[f64]>, d: &[f64]) -> Vec<f64> {
        let half = self.half_solved(load, prescribed).1;
        let x = self.condensation.recover(&half, d);
        self.rows.iter().map(|row| row.value(&x, prescribed)).collect()
    }

    /// Contact forces as a nodal force vector of the host: `R F` on slaves, the opposite on
    /// masters by weight.
    pub fn nodal_forces(&self, force: &[f64]) -> Vec<f64> {
        let mut nodal = vec![0.0; self.host_size()];
        for &(dof, component, coefficient) in &self.actions {
            nodal[dof] += coefficient * force[component];
        }
        nodal
    }

    fn half_solved(&self, load: &[f64], prescribed: Option<&[f64]>) -> (Vec<f64>, Vec<f64>) {
        let mut load = load.to_vec();
        if prescribed.is_some() {
            let nothing = vec![0.0; self.unknowns];
            let moved: Vec<f64> =
                self.rows.iter().map(|row| row.value(&nothing, prescribed)).collect();
            for (load, force) in load.iter_mut().zip(self.host.product(&moved)) {
                *load -= force;
            }
        }
        let mut transformed = vec![0.0; self.unknowns];
        for (row, load) in self.rows.iter().zip(&load) {
            for &(k, c) in &row.unknowns {
                transformed[k] += c * load;
            }
        }
        let free = self.unknowns - self.dim * self.pairs;
        for (component, _) in &self.held {
            transformed[free + component] = 0.0;
        }
        self.condensation.condense(&transformed)
    }
}

/// `F . d = F . Rᵀ (u_slave - sum w_k u_master,k)`, term by term.
fn actions(interface: &ContactPairs<'_>, frames: &[Frame]) -> Vec<(usize, usize, f64)> {
    let dim = interface.dim;
    let mut actions = Vec::new();
    for (pair, frame) in frames.iter().enumerate() {
        for (component, direction) in frame[..dim].iter().enumerate() {
            for axis in 0..dim {
                let component = dim * pair + component;
                actions.push((interface.slave(pair)[axis], component, direction[axis]));
                for (weight, masters) in interface.masters_of(pair) {
                    actions.push((masters[axis], component, -weight * direction[axis]));
                }
            }
        }
    }
    actions
}

/// A free motion in words: the part that moves, and how it moves most.
fn free_motion(motion: &[f64]) -> String {
    let largest = motion.iter().fold(0.0_f64, |most, u| most.max(u.abs()));
    let mut moving: Vec<usize> =
        (0..motion.len()).filter(|&dof| motion[dof].abs() > 1e-6 * largest).collect();
    let (count, first, last) = (moving.len(), moving.first(), moving.last());
    let part = match (first, last) {
        (Some(first), Some(last)) => format!("{count} of the degrees of freedom {first} to {last}"),
        _ => "nothing".into(),
    };
    moving.sort_by(|&a, &b| motion[b].abs().total_cmp(&motion[a].abs()));
    let most: Vec<String> = moving
        .iter()
        .take(3)
        .map(|&dof| format!("degree of freedom {dof} by {:.3}", motion[dof] / largest))
        .collect();
    format!(
        "a motion remains that no support and no pair holds: it moves {part}, most of all {}",
        most.join(", ")
    )
}

/// Place in `fixed` of each degree of freedom.
fn numbers_of_fixed(size: usize, fixed: &[usize]) -> Result<Vec<Option<usize>>, Error> {
    let mut number = vec![None; size];
    for (k, &dof) in fixed.iter().enumerate() {
        if dof >= size {
            let message = format!("fixed: there is no degree of freedom {dof}");
            return Err(Error::invalid(Argument::Fixed, message));
        }
        if number[dof].replace(k).is_some() {
            let message = format!("fixed: degree of freedom {dof} stands twice");
            return Err(Error::invalid(Argument::Fixed, message));
        }
    }
    Ok(number)
}

/// The relative component that a support of the slave along `axis` holds, if its masters are fixed
/// there too: a decoupled row.
fn held_component(
    interface: &ContactPairs<'_>,
    pair: usize,
    axis: usize,
    frame: &Frame,
    number: &[Option<usize>],
) -> Result<usize, Error> {
    let refuse = |message: String| Err(Error::invalid(Argument::Pairs, message));
    let mut masters = interface.masters_of(pair).filter(|(weight, _)| *weight != 0.0);
    if masters.any(|(_, masters)| number[masters[axis]].is_none()) {
        return refuse(format!("pair {pair}: its slave is fixed where its masters are not"));
    }
    let along = |component: &usize| frame[*component][axis].abs() > 1.0 - 1e-12;
    match (0..interface.dim).find(along) {
        Some(component) => Ok(component),
        None => refuse(format!(
            "pair {pair}: its slave is fixed along an axis that is neither normal nor tangent"
        )),
    }
}
