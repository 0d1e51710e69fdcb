//! Vectors and matrices of the plane and of space, by nalgebra. In the plane the third component is zero.

/// Three components.
pub type Vector3 = nalgebra::Vector3<f64>;

/// Two components.
pub type Vector2 = nalgebra::Vector2<f64>;

/// Two rows and columns.
pub type Matrix2 = nalgebra::Matrix2<f64>;

/// Three rows and two columns.
pub type Matrix3x2 = nalgebra::Matrix3x2<f64>;

/// Three rows and columns.
pub type Matrix3 = nalgebra::Matrix3<f64>;

/// The vector with two or three components.
pub fn vector(components: &[f64]) -> Vector3 {
    let mut vector = Vector3::zeros();
    // One by one: a copy of a length that is not known is a call.
    vector.iter_mut().zip(components).for_each(|(own, component)| *own = *component);
    vector
}

/// The unit vector along an axis.
pub fn axis(axis: usize) -> Vector3 {
    Vector3::ith(axis, 1.0)
}

/// Directions of seven digits are known up to a tenth of this (radians). A tangent that is further from orthogonal to
/// its normal belongs to another pair, or to no frame at all; one that is nearer to an axis is along it.
pub const ERROR_OF_DIRECTION: f64 = 1e-5;

/// The axis along which a vector has its smallest part, of parts that are equal but for [`ERROR_OF_DIRECTION`] the first.
pub fn most_across(vector: Vector3) -> Vector3 {
    let size = vector.abs();
    let least = size.min() + ERROR_OF_DIRECTION * size.max();
    axis(size.iter().position(|part| *part <= least).unwrap_or_default())
}

/// The turn by an angle in radians about a unit vector, right-handed.
pub fn turn_about(axis: Vector3, angle: f64) -> Matrix3 {
    *nalgebra::Rotation3::from_axis_angle(&nalgebra::Unit::new_unchecked(axis), angle).matrix()
}

/// A vector without its parts along orthonormal directions.
pub fn without(mut vector: Vector3, directions: &[Vector3]) -> Vector3 {
    directions.iter().for_each(|along| vector -= along.dot(&vector) * along);
    vector
}

/// The vector at length one; `None` if it is zero or not finite.
pub fn unit(vector: Vector3) -> Option<Vector3> {
    // Scaled first: the square of its length may be out of range.
    let scaled = vector / vector.amax();
    let length = scaled.norm();
    length.is_finite().then(|| scaled / length)
}
