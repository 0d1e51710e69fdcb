//! The places over which a face, or a point, moves along its normal, and what they may meet: boxes along the axes, and
//! walls.

use super::face::Face;
use super::plane::tangents;
use super::shape::BEYOND;
use crate::linalg::vector3::Vector3;

/// Faces that have less than this in common, beside their largest coordinate, have nothing: rounding of the places
/// themselves.
const TOUCH: f64 = 4e-15;

/// A box along the axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub(super) low: Vector3,
    pub(super) high: Vector3,
}

impl Bounds {
    /// The smallest box that holds the points.
    pub(super) fn of(points: impl Iterator<Item = Vector3>) -> Bounds {
        let none = Bounds {
            low: Vector3::repeat(f64::INFINITY),
            high: Vector3::repeat(f64::NEG_INFINITY),
        };
        points.fold(none, |bounds, point| Bounds {
            low: bounds.low.inf(&point),
            high: bounds.high.sup(&point),
        })
    }

    /// The distance between opposite corners.
    pub(super) fn diagonal(&self) -> f64 {
        (self.high - self.low).norm()
    }

    /// How far it reaches along a direction, times the length of that.
    pub(super) fn most(&self, along: &Vector3) -> f64 {
        let [middle, half] = self.middle_and_half();
        along.dot(&middle) + along.abs().dot(&half)
    }

    fn middle_and_half(&self) -> [Vector3; 2] {
        [0.5 * (self.low + self.high), 0.5 * (self.high - self.low)]
    }

    pub(super) fn with(&self, other: &Bounds) -> Bounds {
        Bounds { low: self.low.inf(&other.low), high: self.high.sup(&other.high) }
    }

    /// The box with a margin on all sides.
    pub(super) fn widened(&self, by: f64) -> Bounds {
        Bounds { low: self.low.add_scalar(-by), high: self.high.add_scalar(by) }
    }

    /// `true` if two boxes have a point in common.
    pub(super) fn meets(&self, other: &Bounds) -> bool {
        (0..3).all(|c| self.low[c] <= other.high[c] && other.low[c] <= self.high[c])
    }
}

/// The half space `along · x <= most`; everything if `along` is zero.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Wall {
    pub(super) along: Vector3,
    pub(super) most: f64,
    /// It may be tilted by parts between these of another direction, about the height along that.
    pub(super) tilts: [f64; 2],
    pub(super) normal: Vector3,
    pub(super) height: f64,
}

impl Wall {
    /// Leaves the tilts with which it holds a face too.
    pub(super) fn hold(&mut self, Hull { points, margin }: Hull<'_>) {
        let size = self.along.norm();
        let margin = margin * size;
        for x in points {
            let beyond = self.along.dot(x) - self.most + margin;
            let height = self.normal.dot(x) - self.height;
            // Points of the line about which it tilts are off that by rounding.
            if beyond.abs().max(height.abs()) > TOUCH * x.amax() * size {
                let most = -beyond.min(0.0) / (height.abs() + margin);
                let [low, high] = &mut self.tilts;
                *low = if height < margin { low.max(-most) } else { *low };
                *high = if height > -margin { high.min(most) } else { *high };
            }
        }
    }

    /// As nearly along a normal as it may be.
    fn tilted(&self, normal: &Vector3) -> (Vector3, f64) {
        if self.tilts == [0.0; 2] {
            return (self.along, self.most);
        }
        let tilt = -self.along.dot(normal) / self.normal.dot(normal);
        let tilt = tilt.max(self.tilts[0]).min(self.tilts[1]);
        (self.along + tilt * self.normal, self.most + tilt * self.height)
    }
}

/// Points, and how far beyond them what they stand for may reach.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hull<'a> {
    points: &'a [Vector3],
    margin: f64,
}

impl<'a> Hull<'a> {
    pub(super) fn of(face: &'a Face<'_>) -> Hull<'a> {
        let points = &face.x[..face.kind.nodes()];
        Hull { points, margin: if face.is_bilinear() { 0.0 } else { face.bulge() } }
    }

    /// How far it reaches along a direction, times the length of that.
    pub(super) fn most(&self, along: &Vector3) -> f64 {
        let heights = self.points.iter().map(|x| along.dot(x));
        heights.fold(f64::NEG_INFINITY, f64::max) + self.margin * along.norm()
    }

    pub(super) fn bounds(&self) -> Bounds {
        Bounds::of(self.points.iter().copied()).widened(self.margin)
    }
}

/// The places over which a face moves along its normal, or a point along a normal.
#[derive(Clone, Debug)]
pub(super) struct Sweep<'a> {
    hull: Hull<'a>,
    normal: Vector3,
    /// How far back and how far forward.
    reach: [f64; 2],
    bounds: Bounds,
    /// Directions across the normal with the lowest and the highest place along them: of a needle along it and across.
    across: [(Vector3, f64, f64); 2],
    /// Walls that are this far away, or nearer by as much, are passed.
    touch: f64,
}

impl<'a> Sweep<'a> {
    pub(super) fn of_face(face: &'a Face<'_>, normal: Vector3, reach: [f64; 2]) -> Sweep<'a> {
        let edges = face.kind.edges().map(|[from, to]| face.x[to] - face.x[from]);
        let longest = edges.max_by(|a, b| a.norm().total_cmp(&b.norm()));
        Sweep::new(Hull::of(face), (normal, longest.unwrap_or_default()), reach, -TOUCH)
    }

    /// A point that is wanted even if it is beyond a face by as much as [`BEYOND`].
    pub(super) fn of_point(point: &'a Vector3, normal: Vector3, reach: [f64; 2]) -> Sweep<'a> {
        let hull = Hull { points: std::slice::from_ref(point), margin: 0.0 };
        Sweep::new(hull, (normal, tangents(3, normal)[0]), reach, BEYOND)
    }

    fn new(
        hull: Hull<'a>,
        (normal, along): (Vector3, Vector3),
        reach: [f64; 2],
        touch: f64,
    ) -> Sweep<'a> {
        let [back, forward] = reach;
        let Bounds { low, high } = hull.bounds();
        let ends = [
            low - back * normal,
            high - back * normal,
            low + forward * normal,
            high + forward * normal,
        ];
        let bounds = Bounds::of(ends.into_iter());
        let largest = bounds.low.abs().sup(&bounds.high.abs()).amax();
        let beyond = (touch * largest).max(0.0);
        let bounds = bounds.widened(beyond);
        let along = along - normal.dot(&along) * normal;
        let across = [along, normal.cross(&along)].map(|v| {
            let v = v.try_normalize(0.0).unwrap_or_default();
            (v, -hull.most(&-v) - beyond, hull.most(&v) + beyond)
        });
        Sweep { hull, normal, reach, bounds, across, touch: touch * largest }
    }

    /// `false` if nothing of a box is met.
    pub(super) fn meets(&self, bounds: &Bounds) -> bool {
        let [middle, half] = bounds.middle_and_half();
        let is_at = |(along, low, high): &(Vector3, f64, f64)| {
            let (at, size) = (along.dot(&middle), along.abs().dot(&half));
            at - size <= *high && at + size >= *low
        };
        self.bounds.meets(bounds) && self.across.iter().all(is_at)
    }

    /// `false` if all of it lies behind the wall.
    pub(super) fn passes(&self, wall: &Wall) -> bool {
        if wall.along == Vector3::zeros() {
            return true;
        }
        let (along, most) = wall.tilted(&self.normal);
        let moves = self.normal.dot(&along);
        let [back, forward] = self.reach;
        let Hull { points, margin } = self.hull;
        let most = most + (self.touch + margin) * along.norm();
        let most = most - (-back * moves).min(forward * moves);
        points.iter().any(|x| along.dot(x) < most)
    }
}
