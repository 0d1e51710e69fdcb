//! Planes, spheres, cylinders, cones and tori: distance and normal of a point. They are rigid obstacles, and true
//! shapes of meshed sides.

use super::motion::Motion;
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
    /// A point of it, or its middle; of a cone the apex.
    point: Vector3,
    /// The direction out of a plane, of an axis, or from the apex of a cone to the inside, at length one; of a sphere zero.
    axis: Vector3,
    /// The radius, and that of a torus' ring; of a cone cosine and sine of the angle beside its axis.
    radii: [f64; 2],
    /// Negative if it is hollow.
    sign: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Form {
    Plane,
    Sphere,
    Cylinder,
    Cone,
    Torus,
}

impl Obstacle {
    /// The form with a point, a direction, both radii, zero where it has none, and `true` if it is hollow.
    fn numbers(&self) -> (Form, [[f64; 3]; 2], [f64; 2], bool) {
        match *self {
            Obstacle::Plane { point, outward } => (Form::Plane, [point, outward], [0.0; 2], false),
            Obstacle::Sphere { centre, radius, hollow } => {
                (Form::Sphere, [centre, [0.0; 3]], [radius, 0.0], hollow)
            }
            Obstacle::Cylinder { point, axis, radius, hollow } => {
                (Form::Cylinder, [point, axis], [radius, 0.0], hollow)
            }
            Obstacle::Cone { point, to_apex, radius, hollow } => {
                (Form::Cone, [point, to_apex], [radius, 0.0], hollow)
            }
            Obstacle::Torus { centre, axis, radius, ring, hollow } => {
                (Form::Torus, [centre, axis], [radius, ring], hollow)
            }
        }
    }

    /// The numbers that are lengths.
    pub(super) fn lengths(&self) -> Vec<f64> {
        let (form, [point, along], radii, _) = self.numbers();
        let to_apex = if form == Form::Cone { along } else { [0.0; 3] };
        [&point[..], &to_apex, &radii].concat()
    }

    /// The obstacle with lengths multiplied by `scale`, or what is wrong with it.
    pub(super) fn check(&self, dim: usize, scale: f64) -> Result<ExactShape, String> {
        let (form, [point, along], radii @ [radius, ring], hollow) = self.numbers();
        let of_space = match form {
            Form::Plane | Form::Sphere => None,
            Form::Cylinder => Some(("cylinder", "a sphere")),
            Form::Cone => Some(("cone", "a plane")),
            Form::Torus => Some(("torus", "two spheres")),
        };
        if let Some((name, seen)) = of_space.filter(|_| dim == 2) {
            return Err(format!("a {name} needs three dimensions: in the plane it is {seen}"));
        }
        // First: a host's axis may be as long as the ring.
        if form != Form::Plane {
            check_positive("radius", radius)?;
        }
        if form == Form::Torus {
            check_positive("ring", ring)?;
        }
        let direction = match form {
            Form::Plane => "outward direction",
            Form::Cone => "direction to the apex",
            _ => "axis",
        };
        let (point, along) = (Vector3::from(point), Vector3::from(along));
        let axis = unit(along).or((form == Form::Sphere).then_some(along));
        let axis = axis.ok_or_else(|| format!("its {direction} is zero or not finite"))?;
        if form == Form::Torus && radius >= ring {
            return Err(format!(
                "its radius is {radius}, it must be less than that of the ring, {ring}"
            ));
        }
        if !point.iter().all(|x| x.is_finite()) {
            return Err("its point is not finite".to_string());
        }
        let sign = if hollow { -1.0 } else { 1.0 };
        let (point, radii) = (scale * point, radii.map(|radius| scale * radius));
        let shape = ExactShape { form, point, axis, radii, sign };
        let height = along.norm();
        Ok(match form {
            Form::Cone => ExactShape {
                point: point + scale * along,
                axis: -axis,
                radii: [height, radius].map(|side| side / height.hypot(radius)),
                ..shape
            },
            _ => shape,
        })
    }
}

fn check_positive(name: &str, length: f64) -> Result<(), String> {
    // Written so that NaN is refused.
    match length > 0.0 && length.is_finite() {
        true => Ok(()),
        false => Err(format!("its {name} is {length}, it must be positive and finite")),
    }
}

impl ExactShape {
    /// The size of its own lengths.
    pub(super) fn size(&self) -> f64 {
        let radii = if self.form == Form::Cone { 0.0 } else { self.radii.iter().sum() };
        self.point.lp_norm(1) + radii
    }

    /// Its image by a motion in the host's unit.
    pub(super) fn moved(&self, by: &Motion, scale: f64) -> ExactShape {
        let point = scale * by.of(self.point / scale);
        ExactShape { point, axis: by.turn * self.axis, ..*self }
    }

    /// `true` of a shape that has an inside and is not hollow.
    pub(super) fn is_solid(&self) -> bool {
        self.sign > 0.0 && self.form != Form::Plane
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
        let from = x - self.point;
        let along = from.dot(&self.axis);
        let across = from - along * self.axis;
        match (self.form, self.radii) {
            (Form::Plane, _) => (along, Some(self.axis)),
            (Form::Sphere | Form::Cylinder, [radius, _]) => (across.norm() - radius, unit(across)),
            (Form::Cone, [cos, sin]) => {
                // The foot would be beyond the apex.
                if along * cos + across.norm() * sin <= 0.0 {
                    return (from.norm(), unit(from));
                }
                let away = unit(across);
                let outward = cos * away.unwrap_or_default() - sin * self.axis;
                (outward.dot(&from), away.map(|_| outward))
            }
            (Form::Torus, [radius, ring]) => {
                let away = unit(across);
                // On the axis any point of the ring is as near.
                let from_ring = from - ring * away.unwrap_or(tangents(3, self.axis)[0]);
                (from_ring.norm() - radius, away.and(unit(from_ring)))
            }
        }
    }
}
