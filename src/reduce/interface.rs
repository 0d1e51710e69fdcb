//! Contact pairs of a host: a slave node, the point that faces it, and a frame.

use crate::error::{Argument, Error};

/// Pairs of slave nodes and points of other bodies, in degrees of freedom of the host.
#[derive(Clone, Copy, Debug)]
pub struct ContactPairs<'a> {
    /// Space dimension, 2 or 3.
    pub dim: usize,
    /// Number of pairs.
    pub pairs: usize,
    /// Degrees of freedom of the slave nodes, `dim` for each pair, in the axes' order.
    pub slaves: &'a [usize],
    /// Begin of each pair's masters, and their number: `pairs + 1`. No master: a rigid obstacle.
    pub master_starts: &'a [usize],
    /// Degrees of freedom of the master nodes, `dim` for each.
    pub masters: &'a [usize],
    /// Weight of each master node; those of a pair sum to 1.
    pub weights: &'a [f64],
    /// Normals, outward from the slave's body, `dim` for each pair, of any positive length.
    pub normals: &'a [f64],
    /// First tangents, `dim` for each pair, made orthogonal to the normal; `None`: chosen.
    pub tangents: Option<&'a [f64]>,
}

/// A pair's frame by columns: normal, tangents.
pub(super) type Frame = [[f64; 3]; 3];

impl ContactPairs<'_> {
    /// Degrees of freedom of the slave of a pair.
    pub(super) fn slave(&self, pair: usize) -> &[usize] {
        &self.slaves[self.dim * pair..self.dim * (pair + 1)]
    }

    /// Weight and degrees of freedom of each master of a pair.
    pub(super) fn masters_of(&self, pair: usize) -> impl Iterator<Item = (f64, &[usize])> {
        (self.master_starts[pair]..self.master_starts[pair + 1])
            .map(|k| (self.weights[k], &self.masters[self.dim * k..self.dim * (k + 1)]))
    }

    /// Checks the arrays against a host of `size` degrees of freedom.
    pub(super) fn check(&self, size: usize) -> Result<(), Error> {
        let refuse = |message: String| Err(Error::invalid(Argument::Pairs, message));
        let (dim, pairs) = (self.dim, self.pairs);
        if dim != 2 && dim != 3 {
            let message = format!("dim is {dim}, it must be 2 or 3");
            return Err(Error::invalid(Argument::Dimension, message));
        }
        let masters = self.weights.len();
        let lengths = [
            ("slaves", self.slaves.len(), dim * pairs),
            ("master begins", self.master_starts.len(), pairs + 1),
            ("masters", self.masters.len(), dim * masters),
            ("normals", self.normals.len(), dim * pairs),
            ("tangents", self.tangents.map_or(dim * pairs, <[f64]>::len), dim * pairs),
        ];
        for (name, given, needed) in lengths {
            if given != needed {
                return refuse(format!("{name}: {given} entries, there must be {needed}"));
            }
        }
        let starts = self.master_starts;
        if let Some(pair) = (0..pairs).find(|&pair| starts[pair] > starts[pair + 1]) {
            return refuse(format!("pair {pair}: its masters begin after they end"));
        }
        if starts[0] != 0 || starts[pairs] != masters {
            return refuse(format!("the master begins do not cover the {masters} masters"));
        }
        let mut slave_of = vec![None; size];
        for pair in 0..pairs {
            for &dof in self.slave(pair) {
                if dof >= size {
                    return refuse(format!("pair {pair}: there is no degree of freedom {dof}"));
                }
                if let Some(other) = slave_of[dof].replace(pair) {
                    return refuse(format!(
                        "degree of freedom {dof} is a slave in pair {other} and in pair {pair}"
                    ));
                }
            }
        }
        for pair in 0..pairs {
            let mut sum = 0.0;
            let mut any = false;
            for (weight, dofs) in self.masters_of(pair) {
                any = true;
                sum += weight;
                for &dof in dofs {
                    if dof >= size {
                        return refuse(format!("pair {pair}: there is no degree of freedom {dof}"));
                    }
                    if let Some(other) = slave_of[dof] {
                        return refuse(format!(
                            "pair {pair}: its master's degree of freedom {dof} is a slave in \
                             pair {other}"
                        ));
                    }
                }
            }
            if any && !((sum - 1.0).abs() <= 1e-9) {
                return refuse(format!("pair {pair}: its weights sum to {sum}, not to 1"));
            }
        }
        Ok(())
    }

    /// Frame of a pair.
    pub(super) fn frame(&self, pair: usize) -> Result<Frame, Error> {
        let refuse =
            |what: &str| Err(Error::invalid(Argument::Pairs, format!("pair {pair}: its {what}")));
        let vector = |values: &[f64]| {
            let mut vector = [0.0; 3];
            vector[..self.dim].copy_from_slice(&values[self.dim * pair..self.dim * (pair + 1)]);
            vector
        };
        let Some(normal) = unit(vector(self.normals)) else {
            return refuse("normal is zero or not finite");
        };
        let first = match self.tangents {
            Some(tangents) => {
                let given = unit(vector(tangents)).unwrap_or_default();
                let along = dot(given, normal);
                let rest: [f64; 3] = std::array::from_fn(|c| given[c] - along * normal[c]);
                match unit(rest).filter(|_| dot(rest, rest) > 1e-12) {
                    Some(tangent) => tangent,
                    None => return refuse("tangent is zero, not finite or along the normal"),
                }
            }
            None if self.dim == 2 => [-normal[1], normal[0], 0.0],
            None => {
                // The axis that is most across the normal.
                let axis =
                    (0..3).fold(0, |a, b| if normal[b].abs() < normal[a].abs() { b } else { a });
                let mut along = [0.0; 3];
                along[axis] = 1.0;
                unit(cross(along, normal)).unwrap_or(along)
            }
        };
        let second = if self.dim == 3 { cross(normal, first) } else { [0.0; 3] };
        Ok([normal, first, second])
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(vector: [f64; 3]) -> Option<[f64; 3]> {
    // Of any length: its square may be out of range.
    let largest = vector.iter().fold(0.0_f64, |most, component| most.max(component.abs()));
    let scaled = vector.map(|component| component / largest);
    let length = dot(scaled, scaled).sqrt();
    length.is_finite().then(|| scaled.map(|component| component / length))
}
