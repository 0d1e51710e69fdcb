//! Where a slave face and the master faces lie over each other: the parts, and points of integration.
//!
//! A slave face with straight edges is compared with its masters in the auxiliary plane. A curved one is compared on the face that
//! its corners span, point by point of its local coordinates: its outline is straight there, and its parts over the masters make up
//! the whole of it. The outlines of masters are bent by as much as the slave's mid nodes stand off straight edges, and by rounding
//! of these not at all.

use super::bilinear::Bilinear;
use super::clip::{Clipper, Point, measure, turn_left};
use super::face::{Face, ON_EDGE};
use super::meetings::Meetings;
use super::plane::{Flat, MOST_SAG, Plane, outline};
use super::quadrature::{self, MOST_POINTS};
use super::shape::{BLOCK, Block, each};
use crate::linalg::simd::vectorised;
use crate::linalg::vector3::Vector3;

/// Parts smaller than this share of the slave face are left out on both sides: they are the rounding of
/// edges that lie upon each other.
const LEAST_PART: f64 = 1e-13;

/// The error that fewer points may leave: that of the most.
const LEFT: f64 = 1e-12;

/// Straight edges that stand for curved ones leave a share of the area to the neighbour; points may leave this part of it.
const OF_SAG: f64 = 1e-4;

/// Masters are looked at as far as they are nearer to a curved face than this share of its size: further away its
/// local coordinates may turn back.
const AROUND: f64 = 0.1;

/// An edge of the length of the face stands off the straight one by this share of what bends it, relative to it.
const OF_BENDING: f64 = 0.125;

/// Beyond the points of a part distances reach further by at most this share of what they differ by at these: with two
/// points along a line by .37 at either end.
const BEYOND_POINTS: f64 = 0.5;

/// A block of points while they are made.
#[derive(Debug, Default)]
struct Places {
    /// Places where the slave face is straight, then its local coordinates,
    slave: [Block; 2],
    /// and those of the master.
    master: [Block; 2],
    /// Parts of the common part.
    parts: Block,
    /// Distances along the normal.
    heights: Block,
    /// Areas of the slave face.
    areas: Block,
}

/// A slave face in its auxiliary plane.
pub(super) struct SlaveFace<'a> {
    plane: Plane,
    flat: Flat<'a>,
    /// The face with straight edges on which this one and its masters are compared: that of the corners, or, if they span none or
    /// the mid nodes bend it by more, local coordinates, which take less time.
    straight: Bilinear,
    /// How far the face is from that one, as a distortion.
    bending: f64,
    /// Degrees that its own integrals ask for beyond those of its functions.
    further: usize,
    outline: Vec<Point>,
    size: f64,
    /// A convex polygon around a curved face in the plane.
    around: Option<Vec<Point>>,
    area: f64,
    face: Face<'a>,
    /// Degree that gaps have beyond those of faces.
    of_gaps: usize,
}

/// The part of a slave face over a master face.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Part {
    /// Share of the slave face.
    pub(super) share: f64,
    /// Mean distance along the normal, and its least and largest value at the points.
    pub(super) distance: f64,
    pub(super) range: [f64; 2],
}

impl Part {
    /// True if the distances of two parts of a face are those of one surface, with a step of so much at most.
    pub(super) fn joins(&self, other: &Part, step: f64) -> bool {
        let [(a, b), (c, d)] = [self, other].map(|part| (part.range[0], part.range[1]));
        let apart = (c - b).max(a - d);
        apart <= BEYOND_POINTS * (b - a + d - c) + step
    }
}

/// The common parts of a slave face and master faces, in memory that the next one uses again.
#[derive(Debug, Default)]
pub(super) struct Overlaps {
    /// The points, master face after master face.
    pub(super) points: Meetings,
    places: Places,
    clipper: Clipper,
    near: Clipper,
    /// A master's outline in the plane, and what lies between its points on curved edges.
    window: Vec<Point>,
    bent: Vec<[Point; 3]>,
    /// A master's outline where a curved slave is straight.
    mapped: Vec<Point>,
    /// The part of a common part that has no points yet.
    rest: Vec<Point>,
}

/// The terms of a series of powers of this ratio down to what is left.
fn terms(ratio: f64, left: f64) -> usize {
    (left.ln() / ratio.ln()).ceil() as usize
}

/// The degrees that a distortion asks for.
fn of_distortion(distortion: f64, left: f64) -> usize {
    if distortion > ON_EDGE { terms(0.5 * distortion, left) - 1 } else { 0 }
}

impl<'a> SlaveFace<'a> {
    /// The face with the unit normal in its middle; points are for gaps of this degree beyond those of faces.
    pub(super) fn new(face: &Face<'a>, normal: Vector3, of_gaps: usize) -> SlaveFace<'a> {
        let plane = Plane::new(face.kind.dim(), face.position(face.kind.centre()), normal);
        let flat = plane.flatten(face);
        let around = flat.is_curved().then(|| flat.around(AROUND));
        let (of_corners, bending) = (flat.corners.distortion(), flat.bending());
        // Local coordinates of a triangle have no right angle of their own, by which its mirror image is cut likewise.
        let are_straight = face.kind.is_triangle() || of_corners > bending;
        let (straight, bending) = match around.is_none() || are_straight && of_corners < 1.0 {
            true => (flat.corners, bending),
            false => (Bilinear::LOCAL, flat.distortion()),
        };
        let corners = &face.kind.places()[..face.kind.corners()];
        let mut own: Vec<Point> = corners.iter().map(|at| straight.place(*at)).collect();
        turn_left(&mut own);
        let area = measure(&own);
        // A curved face's own integrals are those of its loads, whatever its edges leave to neighbours.
        let further = around.as_ref().map_or(0, |_| of_distortion(straight.distortion(), LEFT));
        let (outline, size, face) = (own, face.size(), face.clone());
        SlaveFace {
            plane,
            flat,
            straight,
            bending,
            further,
            outline,
            size,
            around,
            area,
            face,
            of_gaps,
        }
    }

    /// Adds the points of what lies over a master face, if its mean distance along the normal is `wanted`. `None`: a face
    /// that is turned over in the projection has no local coordinates.
    pub(super) fn overlap(
        &self,
        master: &Face<'_>,
        wanted: impl Fn(f64) -> bool,
        found: &mut Overlaps,
    ) -> Option<Part> {
        let seen = self.plane.project(master);
        let Overlaps { points, places, clipper, near, window, bent, mapped, rest } = found;
        outline(&seen, self.size, window, bent);
        let common = match &self.around {
            None => clipper.common_part(window, &self.outline),
            Some(around) => {
                self.map(near.common_part(window, around), bent, mapped)?;
                clipper.common_part(mapped, &self.outline)
            }
        };
        let area = measure(common);
        // An outline that local coordinates bend may cross itself at a corner, and have less than no area beside it.
        if !(area.abs() > LEAST_PART * self.area) {
            return Some(Part::default());
        }
        let before = points.count();
        let share = area / self.area;
        let part = Part {
            share,
            ..self.add_points(&Flat::new(seen), (common, rest), (&mut *points, places))?
        };
        if !wanted(part.distance) {
            points.truncate(before);
            return Some(Part::default());
        }
        Some(part)
    }

    /// The share of the smaller of two faces that has the given share of this one.
    pub(super) fn of_smaller(&self, share: f64, other: &Face<'_>) -> f64 {
        let [own, other] = [&self.flat.face, &self.plane.project(other)].map(|face| {
            let mut polygon = Vec::new();
            outline(face, self.size, &mut polygon, &mut Vec::new());
            measure(&polygon)
        });
        share * own / own.min(other)
    }

    /// A polygon of the plane where the face is straight. With edges that this bends much it has their middles too, of `bent` ones
    /// those on the curve: an edge that two faces share is one there. `None`: a part of it has no local coordinates.
    fn map(&self, polygon: &[Point], bent: &[[Point; 3]], mapped: &mut Vec<Point>) -> Option<()> {
        mapped.clear();
        let halve = OF_BENDING * self.bending > MOST_SAG && !self.face.kind.is_line();
        for (i, &p) in polygon.iter().enumerate() {
            let next = polygon[(i + 1) % polygon.len()];
            let goes = |from: Point, to: Point| (from, to) == (p, next) || (to, from) == (p, next);
            let on_curve = bent.iter().find(|[from, _, to]| goes(*from, *to));
            let straight = || [0.5 * (p[0] + next[0]), 0.5 * (p[1] + next[1])];
            let middle = on_curve.map_or_else(straight, |[_, between, _]| *between);
            for p in [Some(p), halve.then_some(middle)].into_iter().flatten() {
                mapped.push(self.straight.place(self.flat.local_around(p)?));
            }
        }
        if self.face.kind.is_line() {
            turn_left(mapped);
        }
        Some(())
    }

    /// The number of points along each direction on a common part: exact for products of shape functions if local
    /// coordinates are linear in the position, and otherwise so many more as the distance from linear asks for.
    fn points_along(&self, master: &Flat<'_>) -> usize {
        let own = self.face.kind.degree();
        // The length of a ring is as much of a polynomial as the place.
        let ring = if self.face.is_ring { own } else { 0 };
        // The area of a quadrilateral is linear along both directions.
        let of_area = if self.face.kind.is_line() { 1 } else { 2 };
        let degree = own + own.max(master.face.kind.degree()) + ring + of_area + self.of_gaps;
        let further = self.further_degrees(master);
        further.map_or(MOST_POINTS, |more| (degree + more).div_ceil(2).min(MOST_POINTS))
    }

    /// Degrees that a rule has to be exact to beyond that of products of shape functions; `None`: as many as there are.
    ///
    /// With the distortion `e`, local coordinates are analytic in the position up to the
    /// distance `1 / e` from the middle, so that what is neglected falls by `2 / e` with each degree. The
    /// area of a face whose warp adds the slope `w` has terms `w^2k` of the degree `2 k`.
    fn further_degrees(&self, master: &Flat<'_>) -> Option<usize> {
        let distortion = self.flat.distortion().max(master.distortion());
        let warp = self.flat.warp();
        // At a distortion of 1 a corner is straight, and at a slope of 1 by a warp no series of the area converges.
        if !(distortion < 1.0 && warp < 1.0) {
            return None;
        }
        let of_edges = OF_SAG * self.flat.sag().max(master.sag());
        let of_distortion = self.further.max(of_distortion(distortion, LEFT.max(of_edges)));
        let of_warp = match warp > ON_EDGE {
            true => 2 * (terms(warp * warp, LEFT.max(of_edges)) - 1),
            false => 0,
        };
        Some(of_distortion.max(of_warp))
    }

    /// Adds the points of a common part, in memory for the rest of it, and returns its distances along the normal. `None`: a part
    /// of it has no local coordinates.
    fn add_points(
        &self,
        master: &Flat<'_>,
        (common, rest): (&[Point], &mut Vec<Point>),
        (points, places): (&mut Meetings, &mut Places),
    ) -> Option<Part> {
        let (mut distance, mut whole) = (0.0, 0.0);
        let mut range = [f64::INFINITY, f64::NEG_INFINITY];
        let mut all = quadrature::points(common, rest, self.points_along(master));
        loop {
            let mut count = 0;
            for (p, part) in all.by_ref().take(BLOCK) {
                ([places.slave[0][count], places.slave[1][count]], places.parts[count]) = (p, part);
                count += 1;
            }
            if count == 0 {
                return Some(Part { distance: distance / whole, range, ..Part::default() });
            }
            vectorised(
                #[inline(always)]
                || self.meet(master, places, count),
            )?;
            let Places { slave, master, parts, heights, areas } = &*places;
            for (part, height) in parts.iter().zip(heights).take(count) {
                range = [range[0].min(*height), range[1].max(*height)];
                distance += part * height;
                whole += part;
            }
            let [[s, t], [u, v]] = [slave, master];
            for (list, block) in points.lists().into_iter().zip([s, t, u, v, areas]) {
                list.extend_from_slice(&block[..count]);
            }
        }
    }

    /// Makes local coordinates of both faces and areas from the places and parts of a block of points. `None`: one has none.
    #[inline(always)]
    fn meet(&self, opposite: &Flat<'_>, places: &mut Places, count: usize) -> Option<()> {
        let Places { slave, master, parts, heights, areas } = places;
        let (in_plane, straight) = (self.around.is_none(), self.straight);
        *master = *slave;
        straight.locals(slave, count)?;
        self.flat.each_at(
            slave,
            count,
            #[inline(always)]
            |k, [x, along, across]| {
                let normal = along.cross(&across);
                let local = [slave[0][k], slave[1][k]];
                let flat = if in_plane { normal.z } else { straight.area(local) };
                areas[k] = parts[k] * normal.norm() / flat.abs();
                heights[k] = x.z;
                let place = [master[0][k], master[1][k]];
                [master[0][k], master[1][k]] = if in_plane { place } else { [x.x, x.y] };
            },
        );
        opposite.locals(master, count)?;
        opposite.each_at(
            master,
            count,
            #[inline(always)]
            |k, [x, ..]| heights[k] = x.z - heights[k],
        );
        if self.face.is_ring {
            for k in each(count) {
                areas[k] *= self.face.around([slave[0][k], slave[1][k]]);
            }
        }
        Some(())
    }
}
