//! A face in space, or a line in the plane: positions, normals, area.

use std::f64::consts::TAU;

use super::quadrature;
use super::shape::{FaceKind, Local, MOST_NODES, Values};
use crate::linalg::vector3::{Vector3, axis, unit};

/// A mid node this close to the middle of its edge, relative to the edge, stands on it, and a face this close to
/// linear is linear. What remains of the patch test is smaller by another factor of ten and more.
pub(super) const ON_EDGE: f64 = 1e-11;

/// Points of the rule for areas along each direction: exact for flat faces of every kind.
const AREA_POINTS: usize = 4;

/// A face with the coordinates of its nodes.
#[derive(Clone, Debug)]
pub(super) struct Face<'a> {
    pub(super) kind: FaceKind,
    pub(super) nodes: &'a [usize],
    pub(super) x: [Vector3; MOST_NODES],
    /// `true`: a meridian of a ring about the axis `x = 0`.
    pub(super) is_ring: bool,
}

impl Face<'_> {
    /// The point at local coordinates.
    pub(super) fn position(&self, at: Local) -> Vector3 {
        self.sum(&self.kind.values(at))
    }

    /// The position where the shape functions have these values.
    #[inline]
    pub(super) fn sum(&self, values: &Values) -> Vector3 {
        self.x.iter().zip(values).map(|(x, value)| x * *value).sum()
    }

    /// Points in whose convex hull its edges are: corners, and between them where the tangents at both meet.
    pub(super) fn control_points(&self) -> impl Iterator<Item = Vector3> {
        let between =
            |(mid, [a, b]): (usize, [usize; 2])| 2.0 * self.x[mid] - 0.5 * (self.x[a] + self.x[b]);
        self.x[..self.kind.corners()].iter().copied().chain(self.kind.mids().map(between))
    }

    /// Derivatives of the position by the local coordinates; across a line that along the third axis.
    pub(super) fn derivatives(&self, at: Local) -> [Vector3; 2] {
        let across = if self.kind.is_line() { axis(2) } else { Vector3::zeros() };
        let mut along = [Vector3::zeros(), across];
        let nodes = &self.x[..self.kind.nodes()];
        for (x, slopes) in nodes.iter().zip(self.kind.derivatives(at)) {
            along[0] += x * slopes[0];
            along[1] += x * slopes[1];
        }
        along
    }

    /// The length of the ring at local coordinates; 1 of a face that is none.
    pub(super) fn around(&self, at: Local) -> f64 {
        if self.is_ring { TAU * self.position(at).x } else { 1.0 }
    }

    /// The outward normal, as long as the area of a unit of local coordinates: to the right of a
    /// line, and towards the eye that sees the corners of a face counterclockwise.
    pub(super) fn outward(&self, at: Local) -> Vector3 {
        let [first, second] = self.derivatives(at);
        first.cross(&second)
    }

    /// The outward unit normal; zero where the face has no area.
    pub(super) fn normal(&self, at: Local) -> Vector3 {
        unit(self.outward(at)).unwrap_or_default()
    }

    /// The outward unit normal in the middle.
    pub(super) fn middle_normal(&self) -> Vector3 {
        self.normal(self.kind.centre())
    }

    /// The longest distance between two of its nodes.
    pub(super) fn size(&self) -> f64 {
        let x = &self.x[..self.kind.nodes()];
        let apart = x.iter().enumerate().flat_map(|(i, a)| x[..i].iter().map(move |b| a - b));
        apart.map(|apart| apart.norm_squared()).fold(0.0, f64::max).sqrt()
    }

    /// `true` of a ring that touches its axis, or is nearer to it than wide: the radius is nearly nothing at one of its corners
    /// beside the other.
    pub(super) fn is_at_axis(&self) -> bool {
        let size = self.size();
        self.is_ring && self.x[..self.kind.nodes()].iter().any(|x| x.x < size)
    }

    /// Integrals of the shape functions over the whole face; their sum is its area.
    pub(super) fn integrals(&self) -> Values {
        let mut integrals = [0.0; MOST_NODES];
        let corners = &self.kind.places()[..self.kind.corners()];
        quadrature::points(corners, &mut Vec::new(), AREA_POINTS).for_each(|(at, weight)| {
            let area = weight * self.outward(at).norm() * self.around(at);
            let values = self.kind.values(at);
            integrals.iter_mut().zip(values).for_each(|(sum, value)| *sum += area * value);
        });
        integrals
    }

    /// How far the face reaches out of the hull of its nodes at most. It is the bilinear face of its corners, which does
    /// not, and the functions of the other nodes times how far these stand off it, whose sizes sum to less than 2.
    pub(super) fn bulge(&self) -> f64 {
        2.0 * self.off_bilinear().map(|(off, _)| off).fold(0.0, f64::max)
    }

    /// Returns `true` if positions are bilinear in local coordinates: mid nodes in the middle of straight edges, and the centre in
    /// the middle.
    pub(super) fn is_bilinear(&self) -> bool {
        self.off_bilinear().all(|(off, size)| off <= ON_EDGE * size)
    }

    /// As [`Self::is_bilinear`], to a distance.
    pub(super) fn is_bilinear_to(&self, most: f64) -> bool {
        self.off_bilinear().all(|(off, _)| off <= most)
    }

    /// How far mid nodes stand off the middles of straight edges, each with the length of its edge, and the centre off that of the
    /// corners, with the size of the face.
    fn off_bilinear(&self) -> impl Iterator<Item = (f64, f64)> {
        let of_mid = |(mid, [a, b]): (usize, [usize; 2])| {
            let [mid, a, b] = [mid, a, b].map(|node| self.x[node]);
            ((0.5 * (a + b) - mid).norm(), (a - b).norm())
        };
        let of_centre = |centre: usize| {
            let corners = self.kind.corners();
            let middle = self.x[..corners].iter().sum::<Vector3>() / corners as f64;
            ((middle - self.x[centre]).norm(), self.size())
        };
        self.kind.mids().map(of_mid).chain(self.kind.central_node().into_iter().map(of_centre))
    }
}
