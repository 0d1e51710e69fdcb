//! Contact pairs of a host: a slave node, the point that it faces, and a frame.

use super::frame::Frame;
use crate::error::{Argument, Error, index};
use crate::problem::checked_dim;

/// The weights of a pair's masters sum to 1 up to this: far above the rounding of shape functions in
/// doubles (1e-16) and of tables with ten digits, below anything that a gap shows.
const SUM_OF_WEIGHTS: f64 = 1e-9;

/// Contact pairs in degrees of freedom of the host: each a sum over nodes, `d = Rᵀ sum a_k u_k`, with `R` the
/// pair's frame.
///
/// A pair of one slave against a point of other bodies has the weight 1 on its slave and, with the opposite
/// sign, the weights of its masters. General rows, where [`Self::slaves`] is empty, list all nodes with
/// signed weights. Nodes may stand in any number of pairs, and pairs may depend on each other.
#[derive(Clone, Copy, Debug)]
pub struct ContactPairs<'a> {
    /// Space dimension, 2 or 3.
    pub dim: usize,
    /// Number of pairs.
    pub count: usize,
    /// Degrees of freedom of the slave nodes, `dim` for each pair, in the order of the axes. Empty: general
    /// rows, all nodes of a pair are in `masters` with signed weights.
    pub slaves: &'a [usize],
    /// Start of each pair's masters in `weights`, and the number of all masters: `count + 1` entries.
    /// A pair without masters faces a rigid obstacle.
    pub master_start: &'a [usize],
    /// Degrees of freedom of the master nodes, `dim` for each.
    pub masters: &'a [usize],
    /// Weight of each master node; those of a pair sum to 1. In general rows positive on the slave's side and
    /// negative on the other; they sum to 0 between bodies and to 1 against an obstacle.
    pub weights: &'a [f64],
    /// Normals, outward from the slave's body, `dim` for each pair, of any positive length.
    pub normals: &'a [f64],
    /// First tangents, `dim` for each pair, orthogonal to the normal to 1e-5; `None`: chosen.
    pub tangents: Option<&'a [f64]>,
}

fn refuse<T>(message: String) -> Result<T, Error> {
    Err(Error::invalid(Argument::Pairs, message))
}

/// A slave or master of a pair is a degree of freedom that the host does not have.
fn no_dof(pair: usize, dof: usize) -> String {
    format!("pair {}: there is no degree of freedom {}", index(pair), index(dof))
}

impl ContactPairs<'_> {
    /// Returns `true` if all nodes of a pair stand in `masters`, with signed weights.
    fn are_general(&self) -> bool {
        self.slaves.is_empty()
    }

    /// Degrees of freedom of the slave of a pair; `None` in general rows.
    pub(super) fn slave(&self, pair: usize) -> Option<&[usize]> {
        self.slaves.get(self.dim * pair..self.dim * (pair + 1))
    }

    /// Weight and degrees of freedom of each master of a pair.
    pub(super) fn masters_of(&self, pair: usize) -> impl Iterator<Item = (f64, &[usize])> {
        (self.master_start[pair]..self.master_start[pair + 1])
            .map(|k| (self.weights[k], &self.masters[self.dim * k..self.dim * (k + 1)]))
    }

    /// Signed weight and degrees of freedom of each node of a pair.
    pub(super) fn row(&self, pair: usize) -> impl Iterator<Item = (f64, &[usize])> {
        let sign = if self.are_general() { 1.0 } else { -1.0 };
        let slave = self.slave(pair).map(|dofs| (1.0, dofs));
        slave.into_iter().chain(self.masters_of(pair).map(move |(w, dofs)| (sign * w, dofs)))
    }

    /// Returns `true` if each pair has a slave that stands in no other pair.
    pub(super) fn have_own_slaves(&self, size: usize) -> bool {
        let mut is_slave = vec![false; size];
        let is_new = |&dof: &usize| !std::mem::replace(&mut is_slave[dof], true);
        !self.are_general()
            && self.slaves.iter().all(is_new)
            && !self.masters.iter().any(|&dof| is_slave[dof])
    }

    /// Checks the arrays against a host of `size` degrees of freedom.
    ///
    /// # Errors
    /// The first array of a wrong length, start of masters that is out of order, degree of freedom
    /// that does not exist or stands for two axes of a slave, and sum of weights that cannot be.
    pub(super) fn check(&self, size: usize) -> Result<(), Error> {
        self.check_lengths()?;
        self.check_master_start()?;
        (0..self.count).try_for_each(|pair| self.check_row(pair, size))
    }

    fn check_lengths(&self) -> Result<(), Error> {
        let (dim, count) = (self.dim, self.count);
        checked_dim(dim)?;
        let masters = self.weights.len();
        let lengths = [
            ("slaves", self.slaves.len(), if self.are_general() { 0 } else { dim * count }),
            ("master_start", self.master_start.len(), count + 1),
            ("masters", self.masters.len(), dim * masters),
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
        let (start, count, masters) = (self.master_start, self.count, self.weights.len());
        if start[0] != 0 {
            return refuse(format!(
                "pair {}: its masters begin at {}, they must begin with the first one",
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
        if start[count] != masters {
            return refuse(format!(
                "the pairs have {} masters, there are {masters} weights",
                start[count]
            ));
        }
        Ok(())
    }

    fn check_row(&self, pair: usize, size: usize) -> Result<(), Error> {
        if let Some(&dof) = self.row(pair).flat_map(|(_, dofs)| dofs).find(|&&dof| dof >= size) {
            return refuse(no_dof(pair, dof));
        }
        let slave = self.slave(pair).unwrap_or_default();
        if let Some(i) = (1..slave.len()).find(|&i| slave[..i].contains(&slave[i])) {
            let (dof, pair) = (index(slave[i]), index(pair));
            return refuse(format!("pair {pair}: its slave has degree of freedom {dof} twice"));
        }
        let weights = || self.masters_of(pair).map(|(weight, _)| weight);
        let (sum, largest) = (weights().sum::<f64>(), weights().map(f64::abs).fold(0.0, f64::max));
        let scale = if self.are_general() { largest.max(1.0) } else { 1.0 };
        // Written so that NaN is refused.
        let is = |wanted: f64| sum.is_finite() && f64::abs(sum - wanted) <= SUM_OF_WEIGHTS * scale;
        if self.are_general() {
            if largest == 0.0 {
                return refuse(format!("pair {}: it has no node with a weight", index(pair)));
            }
            if !is(0.0) && !is(1.0) {
                return refuse(format!(
                    "pair {}: its signed weights sum to {sum}: they must sum to 0 between bodies, to 1 \
                     against an obstacle",
                    index(pair)
                ));
            }
        } else if self.masters_of(pair).next().is_some() && !is(1.0) {
            return refuse(format!("pair {}: its weights sum to {sum}, not to 1", index(pair)));
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
