//! The bound on the tangential force, `|F_t| <= g(p')`.

/// `g(p') = slope p' + offset`, for the pressure `p' = p + a >= 0` beside the tension `a` that the pair
/// may carry. It holds for an open pair too, with `p' = 0`. Under a law with an ellipse it bounds the
/// gauge of the tangential force.
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

    /// Returns `true` if the admissible forces are a cone: then they are known by their edges.
    pub fn is_cone(&self) -> bool {
        self.offset == 0.0
    }
}

/// Euclidean length of a tangential vector of one (2D) or two (3D) components.
#[inline(always)]
pub fn length(vector: &[f64]) -> f64 {
    match *vector {
        [a] => a.abs(),
        [a, b] => {
            let square = a * a + b * b;
            // `hypot`, which is slow, is asked where a square overflows, or underflows beside the other.
            let usual = f64::MIN_POSITIVE / f64::EPSILON..f64::INFINITY;
            if usual.contains(&square) { square.sqrt() } else { a.hypot(b) }
        }
        _ => unreachable!("a pair has one or two tangential components"),
    }
}
