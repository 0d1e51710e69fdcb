//! The bound on the tangential force, `|F_t| <= g(p)`, and the disc that it makes.

/// `g(p) = slope p + offset`, for the pressure `p >= 0`. It holds for an open pair too, with `p = 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bound {
    /// `dg/dp`, without unit, at least 0.
    pub slope: f64,
    /// `g(0)`, a force, at least 0.
    pub offset: f64,
}

impl Bound {
    /// `g(p)`.
    #[inline(always)]
    pub fn at(&self, pressure: f64) -> f64 {
        self.slope * pressure + self.offset
    }

    /// Whether the admissible forces are a cone: then they are known by their edges.
    pub fn is_cone(&self) -> bool {
        self.offset == 0.0
    }
}

/// Euclidean length of a tangential vector of one (2D) or two (3D) components.
#[inline(always)]
pub fn length(vector: &[f64]) -> f64 {
    match *vector {
        [a] => a.abs(),
        [a, b] => a.hypot(b),
        _ => unreachable!("a pair has one or two tangential components"),
    }
}

/// Brings a tangential vector back to the disc of radius `radius >= 0`.
pub fn project_disc(vector: &mut [f64], radius: f64) {
    let length = length(vector);
    if length > radius {
        for component in vector {
            *component *= radius / length;
        }
    }
}
