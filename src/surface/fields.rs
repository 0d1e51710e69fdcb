//! A solution as fields on the surfaces: pressure, traction, clearance and slip at nodes, and the
//! resultant of a contact zone.
//!
//! A node that has a pair of its own gets the values of that pair. Other nodes of the rows, the master's
//! and slave nodes with little cover, get means over the pairs that they stand in, weighted by area times
//! the size of the weight: of a uniform pressure the mean is that pressure. On the master's side
//! traction and slip are turned about, as they act on and move the other body.

use std::collections::BTreeMap;
use std::ops::Range;

use super::motion::Motion;
use super::pairs::{SurfacePair, SurfacePairs, Weight};
use crate::error::{Argument, Error};
use crate::linalg::tolerances::ROUNDING_OF_SUM;
use crate::linalg::vector3::{Matrix3, Vector3, vector, without};
use crate::problem::{check_count, check_finite, check_gaps};

/// The solution for pairs, in their frames: normal and tangents of each.
#[derive(Clone, Copy, Debug)]
pub struct PairResults<'a> {
    /// Gaps, one for each pair; `None`: those of the pairs.
    pub gap: Option<&'a [f64]>,
    /// Reference slip, `dim - 1` for each pair; `None`: zero.
    pub reference_slip: Option<&'a [f64]>,
    /// Relative displacements, `dim` for each pair.
    pub d: &'a [f64],
    /// Contact forces, `dim` for each pair.
    pub force: &'a [f64],
}

/// Values at the nodes of both surfaces that stand in pairs. Vectors are in the host's axes and have
/// `dim` components, node after node.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NodalFields {
    /// The nodes, ascending.
    pub nodes: Vec<usize>,
    /// The pair that each node has most to do with: its own, or that of the largest share.
    pub pairs: Vec<usize>,
    /// Contact pressure: positive presses; force over area.
    pub pressure: Vec<f64>,
    /// Contact force on the node's own body over area.
    pub traction: Vec<f64>,
    /// The part of the gap that is left, `gap - d_n`: positive if open.
    pub clearance: Vec<f64>,
    /// Motion along the surface against the other body since the reference slip.
    pub slip: Vec<f64>,
}

/// Sums over a contact zone.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Resultant {
    /// The force of the contact on the slave's body, of whole rings if it is one of revolution.
    pub force: [f64; 3],
    /// Its moment about the given point, in the plane `[0, 0, m]`.
    pub moment: [f64; 3],
    /// The work that friction takes in the step, `-F_t · (d_t - slip0)` with the forces of its end.
    pub friction_work: f64,
    /// The area of the pairs that press.
    pub pressed_area: f64,
    /// The largest pressure of a pair; 0 if none presses.
    pub largest_pressure: f64,
}

/// Values of a pair, or a weighted sum of them.
#[derive(Clone, Copy, Default)]
struct Values {
    traction: Vector3,
    slip: Vector3,
    pressure: f64,
    clearance: f64,
    /// Sum of the weights.
    share: f64,
    /// The pair of the largest weight, and that weight.
    most: (usize, f64),
}

impl Values {
    /// Those of an image.
    fn turned(&self, turn: &Matrix3) -> Values {
        Values { traction: turn * self.traction, slip: turn * self.slip, ..*self }
    }

    fn add(&mut self, other: &Values, (pair, share): (usize, f64), sign: f64) {
        self.traction += sign * share * other.traction;
        self.slip += sign * share * other.slip;
        self.pressure += share * other.pressure;
        self.clearance += share * other.clearance;
        self.share += share;
        if share > self.most.1 {
            self.most = (pair, share);
        }
    }
}

impl SurfacePair {
    /// A vector of the host from components along the normal and the tangents.
    fn to_host(&self, normal: f64, tangential: &[f64]) -> Vector3 {
        let along = self.tangents.iter().zip(tangential);
        normal * Vector3::from(self.normal)
            + along.map(|(tangent, value)| *value * Vector3::from(*tangent)).sum::<Vector3>()
    }
}

impl SurfacePairs {
    /// Pressure, traction, clearance and slip at the nodes of both sides.
    ///
    /// # Errors
    /// An array of another length than the pairs have, or with an entry that is not finite; gaps may be +infinity
    /// ([`Argument::Gap`], [`Argument::ReferenceSlip`], [`Argument::Start`] for `d`, [`Argument::Load`] for the forces).
    pub fn fields(&self, results: &PairResults<'_>) -> Result<NodalFields, Error> {
        self.check(results)?;
        let of_pairs: Vec<Values> =
            (0..self.pairs.len()).map(|pair| self.values(pair, results)).collect();
        let mut sums: BTreeMap<usize, Values> = BTreeMap::new();
        for (j, pair) in self.pairs.iter().enumerate() {
            let sides = [(pair.slaves(), 1.0), (pair.masters(), -1.0)];
            for (nodes, sign) in sides {
                // A node of which a row has rounding alone stands beside its pairs.
                let has_part = |(_, weight): &&Weight| weight.abs() > ROUNDING_OF_SUM;
                for &(node, weight) in nodes.iter().filter(has_part) {
                    let share = pair.area * weight.abs();
                    // An image is not there, but its node is.
                    let (node, motion) = self.images.home(node);
                    let values = of_pairs[j].turned(&motion.turn.transpose());
                    sums.entry(node).or_default().add(&values, (j, share), sign);
                }
            }
        }
        for (j, pair) in self.pairs.iter().enumerate() {
            let mut own = Values::default();
            own.add(&of_pairs[j], (j, 1.0), 1.0);
            sums.insert(pair.slave, own);
        }
        // On a plane of symmetry what is across it cancels against the other side's.
        for node in self.held.keys() {
            let Some(sum) = sums.get_mut(node) else { continue };
            let held = self.held(*node);
            [&mut sum.traction, &mut sum.slip].into_iter().for_each(|v| *v = without(*v, &held));
        }
        for (second, (first, motion)) in self.images.on_second() {
            let image = sums.get(first).map(|sum| sum.turned(&motion.turn));
            sums.extend(image.map(|image| (*second, image)));
        }
        let mut fields = NodalFields::default();
        for (node, sum) in sums {
            fields.nodes.push(node);
            fields.pairs.push(sum.most.0);
            fields.pressure.push(sum.pressure / sum.share);
            fields.clearance.push(sum.clearance / sum.share);
            fields.traction.extend(&(sum.traction / sum.share).as_slice()[..self.dim]);
            fields.slip.extend(&(sum.slip / sum.share).as_slice()[..self.dim]);
        }
        Ok(fields)
    }

    /// The resultant of the contact forces on the slave's body, about a point of `dim` coordinates. The pair of a node on
    /// the first boundary of a sector acts with equal parts at that node and at its images on second boundaries.
    ///
    /// # Errors
    /// As [`Self::fields`]; [`Argument::Coordinates`] for the point.
    pub fn resultant(&self, results: &PairResults<'_>, point: &[f64]) -> Result<Resultant, Error> {
        self.resultant_of(0..self.pairs.len(), results, point)
    }

    /// The resultant of some pairs.
    ///
    /// # Errors
    /// As [`Self::resultant`].
    pub fn resultant_of(
        &self,
        pairs: Range<usize>,
        results: &PairResults<'_>,
        point: &[f64],
    ) -> Result<Resultant, Error> {
        self.check(results)?;
        let dim = self.dim;
        check_count(("point", Argument::Coordinates), point.len(), dim)?;
        check_finite(("point", Argument::Coordinates), point)?;
        let about = vector(point);
        let (mut force, mut moment) = (Vector3::zeros(), Vector3::zeros());
        let mut resultant = Resultant::default();
        // Faces of the model are around all images of a node on second boundaries: each carries an equal part of the pair.
        let mut on_second: BTreeMap<usize, Vec<Motion>> = BTreeMap::new();
        for (first, motion) in self.images.on_second().values() {
            on_second.entry(*first).or_default().push(*motion);
        }
        for (j, pair) in pairs.clone().zip(&self.pairs[pairs]) {
            let of_pair = &results.force[dim * j..dim * (j + 1)];
            let acting = pair.to_host(of_pair[0], &of_pair[1..]);
            let at = Vector3::from(pair.point);
            let images = on_second.get(&pair.slave).map_or(&[][..], Vec::as_slice);
            let part = acting / (1 + images.len()) as f64;
            force += part;
            moment += (at - about).cross(&part);
            for motion in images {
                let part = motion.turn * part;
                force += part;
                moment += (motion.of(at) - about).cross(&part);
            }
            let slip = self.slip(j, results);
            resultant.friction_work -=
                of_pair[1..].iter().zip(slip).map(|(force, slip)| force * slip).sum::<f64>();
            if of_pair[0] < 0.0 {
                resultant.pressed_area += pair.area;
                resultant.largest_pressure =
                    resultant.largest_pressure.max(-of_pair[0] / pair.area);
            }
        }
        if self.axisymmetric {
            // Forces across the axis cancel around a ring, and so do all moments.
            (force.x, moment) = (0.0, Vector3::zeros());
        }
        Ok(Resultant { force: force.into(), moment: moment.into(), ..resultant })
    }

    /// Motion of a pair along its tangents since the reference slip.
    fn slip(&self, pair: usize, results: &PairResults<'_>) -> [f64; 2] {
        let dim = self.dim;
        let mut slip = [0.0; 2];
        for (axis, slip) in slip[..dim - 1].iter_mut().enumerate() {
            let from = results.reference_slip.map_or(0.0, |slip| slip[(dim - 1) * pair + axis]);
            *slip = results.d[dim * pair + 1 + axis] - from;
        }
        slip
    }

    fn values(&self, j: usize, results: &PairResults<'_>) -> Values {
        let (pair, dim) = (&self.pairs[j], self.dim);
        let force = &results.force[dim * j..dim * (j + 1)];
        Values {
            traction: pair.to_host(force[0], &force[1..]) / pair.area,
            slip: pair.to_host(0.0, &self.slip(j, results)),
            pressure: -force[0] / pair.area,
            clearance: results.gap.map_or(pair.gap, |gap| gap[j]) - results.d[dim * j],
            ..Values::default()
        }
    }

    fn check(&self, results: &PairResults<'_>) -> Result<(), Error> {
        let pairs = self.pairs.len();
        let PairResults { gap, reference_slip, d, force } = results;
        check_count(("d", Argument::Start), d.len(), self.dim * pairs)?;
        check_count(("F", Argument::Load), force.len(), self.dim * pairs)?;
        check_count(("gap", Argument::Gap), gap.map_or(pairs, <[f64]>::len), pairs)?;
        let slips = (self.dim - 1) * pairs;
        let given = reference_slip.map_or(slips, <[f64]>::len);
        check_count(("slip0", Argument::ReferenceSlip), given, slips)?;
        check_finite(("d", Argument::Start), d)?;
        check_finite(("F", Argument::Load), force)?;
        check_finite(("slip0", Argument::ReferenceSlip), reference_slip.unwrap_or_default())?;
        check_gaps(gap.unwrap_or_default())
    }
}
