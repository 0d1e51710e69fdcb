//! The true shapes of sides whose faces are facets of something curved, and the gaps between them.
//!
//! Facets of two meshes of one curve stand apart by up to `h² / 8 R`, which for divisions of a few degrees is as large as
//! an interference. So the rows, areas and normals of pairs stay those of the faces, and only gaps are of the shapes:
//! `g_j = (1 / D_j) Σ w_q ψ_j(q) g(q)`, where `g(q)` leads from the true point of the slave along the true normal there to
//! the true shape of the master.

use super::curved_patch::Patch;
use super::digits::ON_PLANE;
use super::exact_shape::{ExactShape, Obstacle};
use super::face::Face;
use super::fitted_normals::SMOOTH;
use super::fitted_side::FittedSide;
use super::meetings::Meetings;
use super::mesh::Side;
use super::normals::MOST_STEPS;
use super::projected_shapes::Opposite;
use super::settings::{SurfaceSettings, TrueShape};
use super::shape::Local;
use crate::error::{Argument, Error, index};
use crate::linalg::tolerances::ROUNDING;
use crate::linalg::vector3::{Vector3, unit};

/// A step beside the size of a face this short is the last one: what remains is of the order of its square.
const LAST: f64 = 1e-9;

/// A shape falls along a normal by this at least: faces that oppose each other are inclined by less than 78 degrees.
const LEAST_FALL: f64 = 0.2;

/// The degree of a patch: cubics, between those of a quadrilateral times what is linear. With this on both sides integrals of gaps
/// are exact to some ten digits of what the shapes stand off the faces: beside these, interferences are small.
const OF_PATCH: usize = 4;

/// A face of a side with its shape.
struct Over<'a> {
    face: &'a Face<'a>,
    exact: Option<ExactShape>,
    patch: Option<Patch>,
}

/// Slave and master with their true shapes.
pub(super) struct TrueSides<'a> {
    sides: [&'a Side<'a>; 2],
    /// The exact shapes, or fitted patches; without either a side is its faces.
    exact: [Option<ExactShape>; 2],
    fitted: [Option<FittedSide>; 2],
}

impl<'a> TrueSides<'a> {
    /// `None` if both sides are their faces.
    ///
    /// # Errors
    /// A shape with wrong numbers, or one that a node of its side is far from.
    pub(super) fn new(
        sides: [&'a Side<'a>; 2],
        settings: &SurfaceSettings,
    ) -> Result<Option<TrueSides<'a>>, Error> {
        let shapes = &settings.shapes;
        if shapes.iter().all(|shape| *shape == TrueShape::Facets) {
            return Ok(None);
        }
        let (mut exact, mut fitted) = ([None; 2], [None, None]);
        for (k, (side, name)) in sides.into_iter().zip(["slave", "master"]).enumerate() {
            match &shapes[k] {
                TrueShape::Facets => {}
                TrueShape::Fitted => fitted[k] = Some(FittedSide::new(side)?),
                TrueShape::Exact(shape) => exact[k] = Some(checked(shape, (side, name))?),
            }
        }
        Ok(Some(TrueSides { sides, exact, fitted }))
    }

    /// A face of the slave, 0, or of the master, 1; an image has the image of the shape.
    fn over<'s>(&self, side: usize, at: usize, face: &'s Face<'_>) -> Over<'s> {
        let patch = self.fitted[side].as_ref().map(|fitted| fitted.patch(self.sides[side], at));
        let exact = self.exact[side].map(|shape| of_face(&shape, self.sides[side], at));
        Over { face, exact, patch }
    }

    /// The size of lengths that gaps are differences of, beside the places of nodes.
    pub(super) fn size(&self) -> f64 {
        self.exact.iter().flatten().map(ExactShape::size).sum()
    }

    /// The degree that gaps have beyond those between faces.
    pub(super) fn degree(&self) -> usize {
        OF_PATCH * self.fitted.iter().flatten().count()
    }

    /// The gaps at the points of a slave face.
    pub(super) fn gaps(
        &self,
        (at, face): (usize, &Face<'_>),
        points: &Meetings,
        parts: &[Opposite<'_>],
    ) -> Vec<f64> {
        let (size, own) = (face.size(), self.over(0, at, face));
        let of_part = |part: &Opposite<'_>| {
            let opposite = self.sides[1].face(part.at);
            let opposite = self.over(1, part.at, &opposite);
            // How far the last foot is from where facets meet: that of the next point is about as far.
            let mut moved = [0.0; 2];
            let gap = |point: usize| {
                let [slave, master] = points.at(point);
                let from = own.point(slave);
                let found = match &opposite.exact {
                    Some(shape) => along_to_shape(from, shape, size),
                    None => along_to_patch(from, |at| opposite.at(at), (master, &mut moved)),
                };
                // To the true point where facets meet.
                found.unwrap_or_else(|| from.1.dot(&(opposite.point(master).0 - from.0)))
            };
            part.points.clone().map(gap).collect::<Vec<f64>>()
        };
        parts.iter().flat_map(of_part).collect()
    }
}

/// A shape of a side with a name.
fn checked(shape: &Obstacle, (side, name): (&Side<'_>, &str)) -> Result<ExactShape, Error> {
    let refuse = |message: String| {
        Error::invalid(Argument::Settings, format!("shape of the {name}: {message}"))
    };
    let shape = shape.check(side.dim, side.scale).map_err(refuse)?;
    is_near(side, &shape).map_err(refuse)?;
    Ok(shape)
}

/// The shape of a face of a side; that of an image is the image of it.
fn of_face(shape: &ExactShape, side: &Side<'_>, at: usize) -> ExactShape {
    side.origin(at).map_or(*shape, |(motion, _)| shape.moved(&motion, side.scale))
}

/// The coordinates of all nodes of the slave on its true surface; `None`: where they stand.
///
/// # Errors
/// As [`TrueSides::new`].
pub(super) fn true_places(slave: &Side<'_>, shape: &TrueShape) -> Result<Option<Vec<f64>>, Error> {
    let shape = match shape {
        TrueShape::Facets => return Ok(None),
        TrueShape::Fitted => return Ok(FittedSide::new(slave)?.places()),
        TrueShape::Exact(shape) => checked(shape, (slave, "slave"))?,
    };
    let (dim, mut places) = (slave.dim, slave.coordinates.to_vec());
    for at in 0..slave.count() {
        slave.progress.goes_on()?;
        let shape = of_face(&shape, slave, at);
        for &node in slave.nodes(at) {
            let x = slave.position(node);
            let (distance, gradient) = shape.distance(x);
            let place = (x - distance * gradient.unwrap_or_default()) / slave.scale;
            places[dim * node..dim * (node + 1)].copy_from_slice(&place.as_slice()[..dim]);
        }
    }
    Ok(Some(places))
}

/// Refuses a shape of which a face is no facet, as that of a chamfer at the end of a bore: one with a corner as far away as a face leads that
/// leaves the shape at a quarter of the angle of a sharp edge, or off the shape and turned by that angle; or one that is across it. Mid
/// nodes may stand on chords.
fn is_near(side: &Side<'_>, shape: &ExactShape) -> Result<(), String> {
    let of_corners = ((1.0 - SMOOTH) / 8.0).sqrt();
    for at in (0..side.count()).filter(|at| !side.is_image(*at)) {
        let face = side.face(at);
        let mut is_off = false;
        for (place, &node) in face.nodes.iter().enumerate() {
            let named = || format!("node {} of face {}", index(node), index(at));
            let (distance, normal) = shape.distance(side.position(node));
            let part = distance.abs() / face.size();
            // The apex of a cone is a point of it.
            if normal.is_none() && part > LAST {
                return Err(format!(
                    "{} stands on its axis or in its centre: leave that face out of the side",
                    named()
                ));
            }
            let is_corner = place < face.kind.corners();
            if part > if is_corner { of_corners } else { 1.0 } {
                return Err(format!(
                    "{} is {part:.2} of the face's size away from it: leave that face out of the side, or look at the shape's \
                     place and unit of length",
                    named()
                ));
            }
            is_off |= is_corner && part > ON_PLANE;
        }
        let (_, normal) = shape.distance(face.position(face.kind.centre()));
        let cosine = normal.map_or(1.0, |normal| normal.dot(&face.middle_normal()).abs());
        // Facets of large angles, and ends of a cylinder, have their corners on it.
        if cosine < if is_off { SMOOTH } else { LEAST_FALL } {
            return Err(format!(
                "face {} is turned from it by {:.0} degrees: leave that face out of the side, or look at the shape's place",
                index(at),
                cosine.acos().to_degrees()
            ));
        }
    }
    Ok(())
}

impl Over<'_> {
    /// The point of the face, or of its patch, with its derivatives; across a line that along the third axis.
    fn at(&self, at: Local) -> (Vector3, [Vector3; 2]) {
        match &self.patch {
            Some(patch) => patch.at(at),
            None => (self.face.position(at), self.face.derivatives(at)),
        }
    }

    /// The true point near a point of the face, and the unit normal there, outward as that of the face.
    fn point(&self, at: Local) -> (Vector3, Vector3) {
        let (x, [a, b]) = self.at(at);
        let outward = unit(a.cross(&b)).unwrap_or_default();
        let Some((distance, Some(gradient))) = self.exact.as_ref().map(|shape| shape.distance(x))
        else {
            return (x, outward);
        };
        let sign = if gradient.dot(&outward) < 0.0 { -1.0 } else { 1.0 };
        (x - distance * gradient, sign * gradient)
    }
}

/// The distance from a point along a normal to an exact shape; `None` if it leads past it.
fn along_to_shape((x, normal): (Vector3, Vector3), shape: &ExactShape, size: f64) -> Option<f64> {
    let mut along = 0.0;
    for _ in 0..MOST_STEPS {
        let (distance, gradient) = shape.distance(x + along * normal);
        // At the apex of a cone.
        let Some(gradient) = gradient else { return Some(along) };
        let fall = gradient.dot(&normal);
        let step = distance / fall.abs().max(LEAST_FALL).copysign(fall);
        along -= step;
        if step.abs() <= LAST * size {
            return Some(along);
        }
    }
    None
}

/// The distance from a point along a normal to a face or its patch, or their continuation, whose foot is about so far from a point.
/// `None` if no foot is found next to that point: patches of faces with short edges bend, and continue far away.
fn along_to_patch(
    (x, normal): (Vector3, Vector3),
    opposite: impl Fn(Local) -> (Vector3, [Vector3; 2]),
    (near, moved): (Local, &mut Local),
) -> Option<f64> {
    for _ in 0..MOST_STEPS {
        let (place, [a, b]) = opposite([near[0] + moved[0], near[1] + moved[1]]);
        let (from, across) = (place - x, a.cross(&b));
        let along = across.dot(&from) / across.dot(&normal);
        let rest = (along * normal - from) / across.norm_squared();
        let step = [b.cross(&across).dot(&rest), across.cross(&a).dot(&rest)];
        *moved = [moved[0] + step[0], moved[1] + step[1]];
        // It is wrong by the square of the step.
        if step[0] * step[0] + step[1] * step[1] <= ROUNDING {
            return Some(along);
        }
        // A face whose normals at nodes are within 35 degrees stands off its patch by a tenth of its length, which normals inclined by
        // 78 degrees carry by half of it.
        if !moved.iter().all(|moved| moved.abs() <= 1.0) {
            break;
        }
    }
    *moved = [0.0; 2];
    None
}
