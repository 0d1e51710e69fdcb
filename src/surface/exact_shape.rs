//! Planes, spheres, cylinders, cones and tori: distance and normal of a point. They are rigid obstacles, and true
//! shapes of meshed sides.

use super::plane::tangents;
use crate::linalg::vector3::{Vector3, unit};

/// A surface that does not deform. Vectors have their third component zero in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Obstacle {
    /// A half space, in the plane a half plane.
    Plane {
        /// A point of its face.
        point: [f64; 3],
        /// The direction out of it, of any length.
        outward: [f64; 3],
    },
    /// A ball, in the plane a disc, or the space around it.
    Sphere {
        /// The middle.
        centre: [f64; 3],
        /// The radius.
        radius: f64,
        /// `true` if the body is inside, as in a bowl.
        hollow: bool,
    },
    /// A round bar of any length, or the space around it; in space only.
    Cylinder {
        /// A point of the axis.
        point: [f64; 3],
        /// The direction of the axis, of any length.
        axis: [f64; 3],
        /// The radius.
        radius: f64,
        /// `true` if the body is inside, as in a bore.
        hollow: bool,
    },
    /// A cone that widens from its apex without end, or the space around it; in space only.
    Cone {
        /// The middle of one of its circles.
        point: [f64; 3],
        /// From there to the apex.
        to_apex: [f64; 3],
        /// The radius of that circle.
        radius: f64,
        /// `true` if the body is inside, as in a countersink.
        hollow: bool,
    },
    /// A torus, or the space around it; in space only.
    Torus {
        /// The middle of its ring.
        centre: [f64; 3],
        /// The direction across the ring, of any length.
        axis: [f64; 3],
        /// The radius of its tube.
        radius: f64,
        /// The radius of the ring, the circle in the middle of the tube.
        ring: f64,
        /// `true` if the body is inside of the tube.
        hollow: bool,
    },
}

/// An obstacle whose numbers have been checked.
#[derive(Clone, Copy, Debug)]
pub(super) struct ExactShape {
    form: Form,
    /// Negative if it is hollow.
    sign: f64,
}

#[derive(Clone, Copy, Debug)]
enum Form {
    Plane {
        point: Vector3,
        outward: Vector3,
    },
    /// The axis is zero for a sphere.
    Round {
        point: Vector3,
        axis: Vector3,
        radius: f64,
    },
    /// The axis leads from the apex to the inside; cosine and sine are of the angle beside it.
    Cone {
        apex: Vector3,
        axis: Vector3,
        cos_sin: [f64; 2],
    },
    Torus {
        centre: Vector3,
        axis: Vector3,
        radius: f64,
        ring: f64,
    },
}

impl Obstacle {
    /// The numbers that are lengths.
    pub(super) fn lengths(&self) -> Vec<f64> {
        match *self {
            Obstacle::Plane { point, .. } => point.to_vec(),
            Obstacle::Sphere { centre: [x, y, z], radius, .. }
            | Obstacle::Cylinder { point: [x, y, z], radius, .. } => vec![x, y, z, radius],
            Obstacle::Cone { point, to_apex, radius, .. } => {
                [&point[..], &to_apex, &[radius]].concat()
            }
            Obstacle::Torus { centre: [x, y, z], radius, ring, .. } => vec![x, y, z, radius, ring],
        }
    }

    /// The obstacle with lengths multiplied by `scale`, or what is wrong with it.
    pub(super) fn check(&self, dim: usize, scale: f64) -> Result<ExactShape, String> {
        let in_plane = matches!(self, Obstacle::Plane { .. } | Obstacle::Sphere { .. });
        if dim == 2 && !in_plane {
            let (name, seen) = match self {
                Obstacle::Cone { .. } => ("cone", "a plane"),
                Obstacle::Torus { .. } => ("torus", "two spheres"),
                _ => ("cylinder", "a sphere"),
            };
            return Err(format!("a {name} needs three dimensions: in the plane it is {seen}"));
        }
        let point = |x: [f64; 3]| match x.iter().all(|x| x.is_finite()) {
            true => Ok(scale * Vector3::from(x)),
            false => Err("its point is not finite".to_string()),
        };
        let (form, hollow) = match *self {
            Obstacle::Plane { point: at, outward } => {
                let outward = direction("outward direction", outward)?;
                (Form::Plane { point: point(at)?, outward }, false)
            }
            Obstacle::Sphere { centre, radius, hollow } => {
                let radius = scale * positive("radius", radius)?;
                (Form::Round { point: point(centre)?, axis: Vector3::zeros(), radius }, hollow)
            }
            Obstacle::Cylinder { point: at, axis, radius, hollow } => {
                let axis = direction("axis", axis)?;
                let radius = scale * positive("radius", radius)?;
                (Form::Round { point: point(at)?, axis, radius }, hollow)
            }
            Obstacle::Cone { point: at, to_apex, radius, hollow } => {
                let axis = -direction("direction to the apex", to_apex)?;
                let (height, radius) = (Vector3::from(to_apex).norm(), positive("radius", radius)?);
                let cos_sin = [height, radius].map(|side| side / height.hypot(radius));
                let apex = point(at)? + scale * Vector3::from(to_apex);
                (Form::Cone { apex, axis, cos_sin }, hollow)
            }
            Obstacle::Torus { centre, axis, radius, ring, hollow } => {
                // First: a host's axis may be as long as the ring.
                let (radius, ring) = (positive("radius", radius)?, positive("ring", ring)?);
                let axis = direction("axis", axis)?;
                if radius >= ring {
                    return Err(format!(
                        "its radius is {radius}, it must be less than that of the ring, {ring}"
                    ));
                }
                let (radius, ring) = (scale * radius, scale * ring);
                (Form::Torus { centre: point(centre)?, axis, radius, ring }, hollow)
            }
        };
        Ok(ExactShape { form, sign: if hollow { -1.0 } else { 1.0 } })
    }
}

fn direction(name: &str, v: [f64; 3]) -> Result<Vector3, String> {
    unit(v.into()).ok_or_else(|| format!("its {name} is zero or not finite"))
}

fn positive(name: &str, length: f64) -> Result<f64, String> {
    // Written so that NaN is refused.
    match length > 0.0 && length.is_finite() {
        true => Ok(length),
        false => Err(format!("its {name} is {length}, it must be positive and finite")),
    }
}

impl ExactShape {
    /// The size of its own lengths.
    pub(super) fn size(&self) -> f64 {
        match self.form {
            Form::Plane { point, .. } => point.lp_norm(1),
            Form::Round { point, radius, .. } => point.lp_norm(1) + radius,
            Form::Cone { apex, .. } => apex.lp_norm(1),
            Form::Torus { centre, radius, ring, .. } => centre.lp_norm(1) + radius + ring,
        }
    }

    /// `true` of a shape that has an inside and is not hollow.
    pub(super) fn is_solid(&self) -> bool {
        self.sign > 0.0 && !matches!(self.form, Form::Plane { .. })
    }

    /// The gap of a point, and the normal from the point into the obstacle; `None` where all normals
    /// are as good, on an axis or in a centre.
    pub(super) fn facing(&self, x: Vector3) -> (f64, Option<Vector3>) {
        let (distance, outward) = self.distance(x);
        (self.sign * distance, outward.map(|outward| -self.sign * outward))
    }

    /// The distance of a point from the surface, negative inside of a shape that is not hollow, and its gradient, `None` as
    /// above.
    pub(super) fn distance(&self, x: Vector3) -> (f64, Option<Vector3>) {
        match self.form {
            Form::Plane { point, outward } => (outward.dot(&(x - point)), Some(outward)),
            Form::Round { point, axis, radius } => {
                let from = x - point;
                let across = from - from.dot(&axis) * axis;
                (across.norm() - radius, unit(across))
            }
            Form::Cone { apex, axis, cos_sin: [cos, sin] } => {
                let from = x - apex;
                let along = from.dot(&axis);
                let across = from - along * axis;
                // The foot would be beyond the apex.
                if along * cos + across.norm() * sin <= 0.0 {
                    return (from.norm(), unit(from));
                }
                let away = unit(across);
                let outward = cos * away.unwrap_or_default() - sin * axis;
                (outward.dot(&from), away.map(|_| outward))
            }
            Form::Torus { centre, axis, radius, ring } => {
                let from = x - centre;
                let across = from - from.dot(&axis) * axis;
                let away = unit(across);
                // On the axis any point of the ring is as near.
                let from_ring = from - ring * away.unwrap_or(tangents(3, axis)[0]);
                (from_ring.norm() - radius, away.and(unit(from_ring)))
            }
        }
    }
}
