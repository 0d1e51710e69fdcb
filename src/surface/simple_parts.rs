//! Integration over polygons: by quadrilaterals from a corner, which take half the points that triangles would.
//! Areas have signs, so that polygons need not be convex.

use super::clip::Point;
use super::quadrature;

/// A quadrilateral, two of whose corners are one if it is a triangle.
type Simple = [Point; 4];

/// How many points an integral takes.
#[derive(Clone, Copy)]
pub(super) struct Rule {
    /// Along each direction.
    pub(super) points: usize,
    /// Quadrilaterals are quartered first.
    pub(super) quartered: bool,
}

impl Rule {
    /// Hands over points of a polygon, or of an interval, with their areas.
    ///
    /// # Errors
    /// Those of `add`.
    pub(super) fn on<E>(
        self,
        polygon: &[Point],
        mut add: impl FnMut(Point, f64) -> Result<(), E>,
    ) -> Result<(), E> {
        if let [a, b] = polygon {
            let mut points = quadrature::on_interval(self.points).iter();
            return points.try_for_each(|([_, s, _], share)| {
                add([a[0] + s * (b[0] - a[0]), 0.0], share * (b[0] - a[0]))
            });
        }
        let last = polygon.len() - 1;
        for k in (1..last).step_by(2) {
            let part = [polygon[0], polygon[k], polygon[k + 1], polygon[last.min(k + 2)]];
            if self.quartered {
                quarters(part).into_iter().try_for_each(|part| self.on_simple(part, &mut add))?;
            } else {
                self.on_simple(part, &mut add)?;
            }
        }
        Ok(())
    }

    fn on_simple<E>(
        self,
        [a, b, c, d]: Simple,
        add: &mut impl FnMut(Point, f64) -> Result<(), E>,
    ) -> Result<(), E> {
        let rule = quadrature::on_interval(self.points);
        for ([_, s, _], v) in rule {
            // From the side between `a` and `b` across to that between `d` and `c`.
            let (from, to) = (between(a, b, *s), between(d, c, *s));
            let across = [to[0] - from[0], to[1] - from[1]];
            for ([_, t, _], w) in rule {
                let along = |i: usize| (1.0 - t) * (b[i] - a[i]) + t * (c[i] - d[i]);
                let area = v * w * (along(0) * across[1] - along(1) * across[0]);
                add(between(from, to, *t), area)?;
            }
        }
        Ok(())
    }
}

/// The point at the share `s` of the way from `p` to `q`.
fn between(p: Point, q: Point, s: f64) -> Point {
    [p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1])]
}

/// The four parts that the middles of its sides make of one.
fn quarters([a, b, c, d]: Simple) -> [Simple; 4] {
    let middle = |p: Point, q: Point| between(p, q, 0.5);
    let (ab, bc, cd, da) = (middle(a, b), middle(b, c), middle(c, d), middle(d, a));
    let centre = middle(ab, cd);
    [[a, ab, centre, da], [ab, b, bc, centre], [centre, bc, c, cd], [da, centre, cd, d]]
}
