//! Contact pairs of a host: a slave node, the point that it faces, and a frame.

use super::frame::Frame;
use crate::error::{Argument, Error, index};

/// The weights of a pair's masters sum to 1 up to this: far above the rounding of shape functions in
/// doubles (1e-16) and of tables with ten digits, below anything that a gap shows.
const SUM_OF_WEIGHTS: f64 = 1e-9;

/// Pairs of slave nodes and points of other bodies, in degrees of freedom of the host.
#[derive(Clone, Copy, Debug)]
pub struct ContactPairs<'a> {
    /// Space dimension, 2 or 3.
    pub dim: usize,
    /// Number of pairs.
    pub count: usize,
    /// Degrees of freedom of the slave nodes, `dim` for each pair, in the order of the axes.
    pub slaves: &'a [usize],
    /// Start of each pair's masters in `weights`, and the number of all masters: `count + 1` entries.
    /// A pair without masters faces a rigid obstacle.
    pub master_start: &'a [usize],
    /// Degrees of freedom of the master nodes, `dim` for each.
    pub masters: &'a [usize],
    /// Weight of each master node; those of a pair sum to 1.
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
    /// Degrees of freedom of the slave of a pair.
    pub(super) fn slave(&self, pair: usize) -> &[usize] {
        &self.slaves[self.dim * pair..self.dim * (pair + 1)]
    }

    /// Weight and degrees of freedom of each master of a pair.
    pub(super) fn masters_of(&self, pair: usize) -> impl Iterator<Item = (f64, &[usize])> {
        (self.master_start[pair]..self.master_start[pair + 1])
            .map(|k| (self.weights[k], &self.masters[self.dim * k..self.dim * (k + 1)]))
    }

    /// Checks the arrays against a host of `size` degrees of freedom.
    ///
    /// # Errors
    /// The first array of a wrong length, start of masters that is out of order, degree of freedom
    /// that does not exist or is used twice, and sum of weights that is not 1.
    pub(super) fn check(&self, size: usize) -> Result<(), Error> {
        self.check_lengths()?;
        self.check_master_start()?;
        let pair_of_slave = self.checked_slaves(size)?;
        (0..self.count).try_for_each(|pair| self.check_masters(pair, &pair_of_slave))
    }

    fn check_lengths(&self) -> Result<(), Error> {
        let (dim, count) = (self.dim, self.count);
        if dim != 2 && dim != 3 {
            let message = format!("dim is {dim}, it must be 2 or 3");
            return Err(Error::invalid(Argument::Dimension, message));
        }
        let masters = self.weights.len();
        let lengths = [
            ("slaves", self.slaves.len(), dim * count),
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

    /// The pair in which each degree of freedom is a slave.
    fn checked_slaves(&self, size: usize) -> Result<Vec<Option<usize>>, Error> {
        let mut pair_of_slave = vec![None; size];
        for pair in 0..self.count {
            for &dof in self.slave(pair) {
                let Some(place) = pair_of_slave.get_mut(dof) else {
                    return refuse(no_dof(pair, dof));
                };
                if let Some(other) = place.replace(pair) {
                    return refuse(format!(
                        "degree of freedom {} is a slave in pair {} and in pair {}",
                        index(dof),
                        index(other),
                        index(pair)
                    ));
                }
            }
        }
        Ok(pair_of_slave)
    }

    fn check_masters(&self, pair: usize, pair_of_slave: &[Option<usize>]) -> Result<(), Error> {
        let mut sum = None;
        for (weight, dofs) in self.masters_of(pair) {
            *sum.get_or_insert(0.0) += weight;
            for &dof in dofs {
                match pair_of_slave.get(dof) {
                    Some(None) => {}
                    None => return refuse(no_dof(pair, dof)),
                    Some(Some(other)) => {
                        return refuse(format!(
                            "pair {}: its master's degree of freedom {} is a slave in pair {}",
                            index(pair),
                            index(dof),
                            index(*other)
                        ));
                    }
                }
            }
        }
        match sum {
            // Written so that NaN is refused.
            Some(sum) if !(f64::abs(sum - 1.0) <= SUM_OF_WEIGHTS) => {
                refuse(format!("pair {}: its weights sum to {sum}, not to 1", index(pair)))
            }
            _ => Ok(()),
        }
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
