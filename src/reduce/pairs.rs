//! Contact pairs of a host: a slave node, the point that it faces, and a frame; and the one form behind all forms of a
//! host, equations between degrees of freedom of the matrix.

use std::collections::HashMap;

use super::equations::{Dependents, Equations, refuse};
use super::frame::Frame;
use crate::error::{Error, index, number};
use crate::linalg::row_elimination::{Terms, gathered, largest};
use crate::linalg::tolerances::{AGREES, ROUNDING};
use crate::linalg::vector::{first_not_finite, norm_inf};
use crate::problem::checked_dim;

/// Contact pairs in degrees of freedom of the host: each a sum `d = Rᵀ sum a_k u_k`, with `R` the pair's frame and
/// a vector `a_k` of `dim` numbers for each degree of freedom.
///
/// There are three forms. A pair of one slave against a point of other bodies has the weight 1 on its slave and,
/// with the opposite sign, the weights of its masters. General rows, where [`Self::slaves`] is empty, list all nodes
/// with signed weights; a node has as many degrees of freedom as axes and one weight for all. General rows by degree
/// of freedom have [`Self::vectors`]. Nodes may stand in any number of pairs, and pairs may depend on each other.
#[derive(Clone, Copy, Debug, Default)]
pub struct ContactPairs<'a> {
    /// Space dimension, 2 or 3.
    pub dim: usize,
    /// Number of pairs.
    pub count: usize,
    /// Degrees of freedom of the slave nodes, `dim` for each pair, in the order of the axes. Empty: general
    /// rows, all nodes of a pair are in `masters` with signed weights.
    pub slaves: &'a [usize],
    /// Start of each pair's masters, and the number of all masters: `count + 1` entries.
    /// A pair without masters faces a rigid obstacle.
    pub master_start: &'a [usize],
    /// Degrees of freedom of the master nodes, `dim` for each; with [`Self::vectors`] one for each.
    pub masters: &'a [usize],
    /// Weight of each master node; those of a pair sum to 1. In general rows positive on the slave's side and
    /// negative on the other; they sum to 0 between bodies and to 1 against an obstacle. With [`Self::vectors`]
    /// empty.
    pub weights: &'a [f64],
    /// General rows by degree of freedom: `dim` numbers for each, in the axes of the normals.
    pub vectors: Option<&'a [f64]>,
    /// Normals, outward from the slave's body, `dim` for each pair, of any positive length.
    pub normals: &'a [f64],
    /// First tangents, `dim` for each pair, orthogonal to the normal to 1e-5; `None`: chosen.
    pub tangents: Option<&'a [f64]>,
    /// Equations by which degrees of freedom follow from others. Pairs may name all of them.
    pub equations: Equations<'a>,
}

impl ContactPairs<'_> {
    /// Returns `true` if all nodes of a pair stand in `masters`, with signed weights.
    fn are_general(&self) -> bool {
        self.slaves.is_empty()
    }

    /// Degrees of freedom of the slave of a pair; none in general rows.
    fn slave(&self, pair: usize) -> &[usize] {
        self.slaves.get(self.dim * pair..self.dim * (pair + 1)).unwrap_or_default()
    }

    /// Places of the masters of a pair.
    fn masters_of(&self, pair: usize) -> std::ops::Range<usize> {
        self.master_start[pair]..self.master_start[pair + 1]
    }

    fn count_of_masters(&self) -> usize {
        if self.vectors.is_some() { self.masters.len() } else { self.weights.len() }
    }

    /// Degrees of freedom of a master, one for each axis or, with vectors, one.
    fn master(&self, k: usize) -> &[usize] {
        let each = if self.vectors.is_some() { 1 } else { self.dim };
        &self.masters[each * k..each * (k + 1)]
    }

    /// The equation of a pair along an axis of the normals: degrees of freedom with coefficients.
    fn terms(&self, pair: usize, axis: usize) -> Terms {
        let mut terms: Terms =
            self.slave(pair).get(axis).map(|&dof| (dof, 1.0)).into_iter().collect();
        let sign = if self.are_general() { 1.0 } else { -1.0 };
        terms.extend(self.masters_of(pair).map(|k| match self.vectors {
            Some(vectors) => (self.masters[k], vectors[self.dim * k + axis]),
            None => (self.masters[self.dim * k + axis], sign * self.weights[k]),
        }));
        terms
    }

    /// The equations of a pair, by axis. One that is rounding beside the others tells nothing.
    fn equations(&self, pair: usize) -> impl Iterator<Item = Terms> {
        let mut equations: Vec<Terms> = (0..self.dim).map(|axis| self.terms(pair, axis)).collect();
        let most = equations.iter().map(|terms| largest(terms)).fold(0.0, f64::max);
        equations.iter_mut().filter(|terms| largest(terms) <= ROUNDING * most).for_each(Vec::clear);
        equations.into_iter()
    }

    /// Checks the arrays against a host of `size` degrees of freedom, and makes rows of them in which dependent
    /// ones are replaced.
    ///
    /// # Errors
    /// The first array of a wrong length, start of masters that is out of order, degree of freedom
    /// that does not exist or stands for two axes of a slave, sum of weights that cannot be, vector that is not finite,
    /// and pair whose weights cancel.
    pub(super) fn rows(&self, size: usize, dependents: &Dependents) -> Result<Rows, Error> {
        self.check_lengths()?;
        self.check_master_start()?;
        for pair in 0..self.count {
            self.check_dofs(pair, size, dependents)?;
            match self.vectors {
                Some(vectors) => self.check_vectors(pair, vectors)?,
                None => self.check_weights(pair)?,
            }
            if (0..self.dim).all(|axis| gathered(self.terms(pair, axis)).is_empty()) {
                let pair = index(pair);
                return refuse(format!(
                    "pair {pair}: its weights cancel, so that no node moves it: leave the pair out"
                ));
            }
        }
        let equations = (0..self.count).flat_map(|pair| self.equations(pair));
        let equations = equations.map(|terms| dependents.replaced(terms));
        Ok(Rows::new(self.dim, equations.collect(), self.slaves))
    }

    /// Marks what rows by degree of freedom name, as the unknowns of a rigid body: with those marked before it may have no
    /// stiffness of its own. Of a node's row that stiffness is missing.
    pub(super) fn without_own_stiffness(&self, mut marked: Vec<bool>) -> Vec<bool> {
        let named = if self.vectors.is_some() { self.masters } else { &[] };
        // Dependents may have numbers beyond the matrix.
        let size = marked.len();
        named.iter().filter(|dof| **dof < size).for_each(|dof| marked[*dof] = true);
        marked
    }

    fn check_lengths(&self) -> Result<(), Error> {
        let (dim, count) = (self.dim, self.count);
        checked_dim(dim)?;
        let masters = self.count_of_masters();
        let (each, weights, vectors) = match self.vectors {
            Some(vectors) => (1, 0, vectors.len()),
            None => (dim, masters, dim * masters),
        };
        let slaves = if self.are_general() || self.vectors.is_some() { 0 } else { dim * count };
        let lengths = [
            ("slaves", self.slaves.len(), slaves),
            ("master_start", self.master_start.len(), count + 1),
            ("masters", self.masters.len(), each * masters),
            ("weights", self.weights.len(), weights),
            ("vectors", vectors, dim * masters),
            ("normals", self.normals.len(), dim * count),
            ("tangents", self.tangents.map_or(dim * count, <[f64]>::len), dim * count),
        ];
        for (name, given, needed) in lengths {
            if given != needed {
                return refuse(format!("{name} has {given} entries, it must have {needed}"));
            }
        }
        Ok(())
    }

    fn check_master_start(&self) -> Result<(), Error> {
        let (start, count) = (self.master_start, self.count);
        if start[0] != 0 {
            let nodes = if self.slaves.is_empty() { "nodes" } else { "masters" };
            return refuse(format!(
                "pair {}: its {nodes} begin at {}, they must begin with the first one: matrix and pairs count from \
                 one number",
                index(0),
                index(start[0])
            ));
        }
        if let Some(pair) = (0..count).find(|&pair| start[pair] > start[pair + 1]) {
            return refuse(format!(
                "pair {}: its masters begin after they end, master_start must not descend",
                index(pair)
            ));
        }
        let masters = self.count_of_masters();
        if start[count] != masters {
            return refuse(format!(
                "the pairs have {} masters, there are {masters} {}",
                start[count],
                if self.vectors.is_some() { "vectors" } else { "weights" }
            ));
        }
        Ok(())
    }

    fn check_dofs(&self, pair: usize, size: usize, dependents: &Dependents) -> Result<(), Error> {
        let slave = self.slave(pair);
        let all = slave.iter().chain(self.masters_of(pair).flat_map(|k| self.master(k)));
        if let Some(&dof) = all.into_iter().find(|&&dof| dof >= size && !dependents.have(dof)) {
            let (pair, dof) = (index(pair), index(dof));
            let given = if dependents.is_empty() { "" } else { ", and no equation gives it" };
            return refuse(format!("pair {pair}: there is no degree of freedom {dof}{given}"));
        }
        if let Some(i) = (1..slave.len()).find(|&i| slave[..i].contains(&slave[i])) {
            let (dof, pair) = (index(slave[i]), index(pair));
            return refuse(format!("pair {pair}: its slave has degree of freedom {dof} twice"));
        }
        Ok(())
    }

    fn check_weights(&self, pair: usize) -> Result<(), Error> {
        let weights = &self.weights[self.masters_of(pair)];
        let (sum, largest) = (weights.iter().sum::<f64>(), norm_inf(weights));
        let scale = if self.are_general() { largest.max(1.0) } else { 1.0 };
        // Written so that NaN is refused.
        let is = |wanted: f64| sum.is_finite() && f64::abs(sum - wanted) <= AGREES * scale;
        if self.are_general() {
            if largest == 0.0 {
                return refuse(format!("pair {}: it has no node with a weight", index(pair)));
            }
            if !is(0.0) && !is(1.0) {
                return refuse(format!(
                    "pair {}: its signed weights sum to {}: they must sum to 0 between bodies, to 1 \
                     against an obstacle",
                    index(pair),
                    number(sum)
                ));
            }
        } else if !weights.is_empty() && !is(1.0) {
            let (pair, sum) = (index(pair), number(sum));
            return refuse(format!("pair {pair}: its weights sum to {sum}, not to 1"));
        }
        Ok(())
    }

    fn check_vectors(&self, pair: usize, vectors: &[f64]) -> Result<(), Error> {
        let vector = |k: usize| &vectors[self.dim * k..self.dim * (k + 1)];
        if let Some(k) = self.masters_of(pair).find(|&k| first_not_finite(vector(k)).is_some()) {
            let (pair, dof) = (index(pair), index(self.masters[k]));
            return refuse(format!(
                "pair {pair}: the vector of degree of freedom {dof} is not finite"
            ));
        }
        if self.masters_of(pair).all(|k| norm_inf(vector(k)) == 0.0) {
            return refuse(format!(
                "pair {}: it has no degree of freedom with a vector that is not zero",
                index(pair)
            ));
        }
        Ok(())
    }

    /// The frames of all pairs.
    ///
    /// # Errors
    /// The first normal or tangent that is zero or not finite, or a tangent that is not orthogonal.
    pub(super) fn frames(&self) -> Result<Vec<Frame>, Error> {
        (0..self.count)
            .map(|pair| {
                let range = self.dim * pair..self.dim * (pair + 1);
                let tangent = self.tangents.map(|tangents| &tangents[range.clone()]);
                Frame::new(&self.normals[range], tangent)
                    .or_else(|what| refuse(format!("pair {}: its {what}", index(pair))))
            })
            .collect()
    }
}

/// An equation `sum a_k u_k = delta` for each axis of each pair, `delta` the relative displacement in the axes of the
/// normals.
pub(super) struct Rows {
    /// Space dimension.
    pub(super) dim: usize,
    /// `dim` equations for each pair.
    pub(super) equations: Vec<Terms>,
    /// `true` if each pair has a slave whose degrees of freedom stand in no other equation.
    pub(super) have_own_slaves: bool,
}

impl Rows {
    /// Takes the equations; `slaves` are the degrees of freedom of slaves, `dim` for each pair, or none.
    pub(super) fn new(dim: usize, equations: Vec<Terms>, slaves: &[usize]) -> Self {
        let have_own_slaves = !slaves.is_empty() && stand_once(slaves, &equations);
        Rows { dim, equations, have_own_slaves }
    }

    /// The equations of a pair, one for each axis.
    pub(super) fn of_pair(&self, pair: usize) -> &[Terms] {
        &self.equations[self.dim * pair..self.dim * (pair + 1)]
    }
}

/// `true` if each of some degrees of freedom stands in one equation, once.
fn stand_once(dofs: &[usize], equations: &[Terms]) -> bool {
    let mut uses: HashMap<usize, usize> = dofs.iter().map(|dof| (*dof, 0)).collect();
    for (dof, _) in equations.iter().flatten() {
        uses.entry(*dof).and_modify(|uses| *uses += 1);
    }
    uses.values().all(|uses| *uses == 1)
}
