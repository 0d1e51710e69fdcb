//! The quadric through a node that is nearest to the places around it, and its normal there.
//!
//! In the frame of the normal `z = s·x + xᵀ K x + z c·x + q z²`. Products with the height make it exact on spheres, cylinders and
//! cones, where `q` follows from `K` and `c`. Places do not always determine all of it: at a free edge there are three rows of
//! nodes, and conics through three points are many. Then the one is taken that differs least from a sphere, a cylinder or a cone.
//!
//! Faces with mid nodes have places enough for any cubes of `x` besides: they are near their shape as they are, by the fourth power of
//! their length, and so must be the normals of any shape.

use std::f64::consts::SQRT_2;

use super::digits::ON_PLANE;
use super::plane;
use crate::linalg::least_squares::{Column, Matrix, Nearest};
use crate::linalg::vector::norm;
use crate::linalg::vector3::{Matrix2, Matrix3, Matrix3x2, Vector2, Vector3, unit};

/// How dear coefficients are that places do not determine, beside squares: slopes; the square of heights beside what it is on
/// cylinders, cones and spheres, and products with heights. In one layer, whose two rows a pair of planes holds too, all but squares
/// like slopes at first; then products with heights as before along what curves alone, and slopes by the last along what does
/// not: there they are those of the faces.
const DEAR: [f64; 3] = [3.0, 1e3, 30.0];

/// Fits, each in the frame of the normal before, and of twice so many solutions, each with the square of heights from the one before:
/// off by the square of the angle over which the places reach, to a power that grows by 1.
const TURNS: usize = 2;

/// The faces around a node: linear ones, of which one layer is all, linear ones, and curved ones.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Form {
    Layer,
    Linear,
    Curved,
}

/// How a quadric bends: its squares and products across the normal, and those with heights.
struct Bend<S, P> {
    squares: S,
    products: P,
}

/// In space, and in axes across the normal.
type InSpace = Bend<Matrix3, Vector3>;
type Across = Bend<Matrix2, Vector2>;

/// The normal of the quadric through the origin that is nearest to some places.
pub(super) fn fit(mean: Vector3, places: &[Vector3], form: Form) -> Vector3 {
    let (mut normal, mut bend) = (mean, None);
    for _ in 0..TURNS {
        let local = Places::new(places, normal);
        // Places in a plane.
        if local.sizes[2] == 0.0 {
            break;
        }
        let (slopes, found) = local.quadric(form, bend.as_ref());
        let [first, second, _] = local.axes;
        normal = unit(normal - slopes[0] * first - slopes[1] * second).unwrap_or(normal);
        bend = Some(found);
    }
    normal
}

/// Places around a node in their main axes across a normal, and along it, each over its size: long faces are as good as square ones.
struct Places {
    axes: [Vector3; 3],
    sizes: [f64; 3],
    along: [Vec<f64>; 3],
    /// The inverse of the square of each place's distance: near places tell more, as what a quadric leaves of other surfaces grows
    /// with the cube. By the cube itself those of one side alone would not determine cubes.
    weights: Vec<f64>,
}

impl Places {
    fn new(places: &[Vector3], normal: Vector3) -> Places {
        let across = plane::tangents(3, normal);
        let along = |axis: &Vector3| places.iter().map(|x| axis.dot(x)).collect::<Vec<f64>>();
        let [x, y] = [0, 1].map(|k| along(&across[k]));
        let moment = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let turn = 0.5 * (2.0 * moment(&x, &y)).atan2(moment(&x, &x) - moment(&y, &y));
        let (sin, cos) = turn.sin_cos();
        let axes = [cos * across[0] + sin * across[1], cos * across[1] - sin * across[0], normal];
        let mut along = [0, 1, 2].map(|k| along(&axes[k]));
        let each = (places.len() as f64).sqrt();
        let mut sizes = [0, 1, 2].map(|k| norm(&along[k]) / each);
        // Of places on a line.
        sizes[1] = sizes[1].max(ON_PLANE * sizes[0]);
        for (along, size) in along.iter_mut().zip(sizes).filter(|(_, size)| *size > 0.0) {
            along.iter_mut().for_each(|x| *x /= size);
        }
        let weights = places.iter().map(|x| (sizes[0] / x.norm()).powi(2)).collect();
        Places { axes, sizes, along, weights }
    }

    fn column(&self, a: &[f64], b: &[f64], by: f64) -> Vec<f64> {
        self.weights.iter().zip(a.iter().zip(b)).map(|(w, (a, b))| by * w * a * b).collect()
    }

    /// The slopes along the first two axes of the quadric that is nearest, and how it bends; `before`: how that of the last turn
    /// does. The places may leave some free: one side of three rows does not tell the square of heights from slopes, and a pair of
    /// planes holds the nodes of one layer of faces. Then it is the one which is most like a cylinder, a cone or a sphere.
    fn quadric(&self, form: Form, before: Option<&InSpace>) -> ([f64; 2], InSpace) {
        let [a, b, height] = &self.along;
        let ones = vec![1.0; a.len()];
        let by = 1.0 / DEAR[1];
        let mut columns = vec![
            self.column(a, &ones, 1.0),
            self.column(b, &ones, 1.0),
            self.column(a, a, 1.0),
            self.column(b, b, 1.0),
            self.column(a, b, SQRT_2),
            self.column(height, height, by),
        ];
        columns.extend([a, b].map(|a| self.column(a, height, SQRT_2 * by)));
        if form == Form::Curved {
            let [aa, bb] = [a, b].map(|a| a.iter().map(|a| a * a).collect::<Vec<f64>>());
            let root = 3.0_f64.sqrt();
            let cubic = [(a, &aa, 1.0), (b, &bb, 1.0), (b, &aa, root), (a, &bb, root)];
            columns.extend(cubic.map(|(a, b, by)| self.column(a, b, by)));
        }
        let nearest = Nearest::new(&columns, ON_PLANE);
        let (heights, squares) =
            (self.column(height, &ones, 1.0), self.column(height, height, 1.0));
        let mut found = Column::zeros(columns.len());
        for solution in 0..2 * TURNS {
            let bend = match before {
                Some(before) if solution == 0 => self.across(before),
                _ => self.bend(&found),
            };
            let by = bend.of_square() * self.sizes[2];
            let target = heights.iter().zip(&squares).map(|(height, square)| height - by * square);
            nearest.improve(&mut found, &target.collect::<Vec<f64>>());
            if nearest.is_free() {
                let bend = before.map(|_| &bend);
                nearest.cheapest(&mut found, &self.dear(form, bend));
            }
        }
        let Bend { squares, products } = self.bend(&found);
        let axes = Matrix3x2::from_columns(&self.axes[..2]);
        let bend = Bend { squares: axes * squares * axes.transpose(), products: axes * products };
        ([0, 1].map(|k| found[k] * self.sizes[2] / self.sizes[k]), bend)
    }

    /// How dear coefficients are, with lengths along both axes in the unit of the shorter one, so that it does not matter how
    /// axes are turned. `bend`: of the solution before, if it is known.
    fn dear(&self, form: Form, bend: Option<&Across>) -> Matrix {
        let unit = Matrix2::new(self.sizes[1] / self.sizes[0], 0.0, 0.0, 1.0);
        let (long, one, little) = (unit[(0, 0)], Matrix2::identity(), DEAR[0] / DEAR[1]);
        let (slopes, square, products) = match (form, bend) {
            (Form::Layer, None) => (DEAR[0] * one, little, little * one),
            (Form::Layer, Some(bend)) => {
                let curved = bend.curved();
                (one + DEAR[2] * (one - curved), 1.0, curved + one / DEAR[1])
            }
            // Few faces do not tell slopes from cubes: those of the faces stay.
            (Form::Curved, _) => (DEAR[1] * one, 1.0, one),
            _ => (DEAR[0] * one, 1.0, one),
        };
        let [slopes, products] = [slopes, products].map(|block| block * unit);
        let count = if form == Form::Curved { 12 } else { 8 };
        let mut dear = Matrix::identity(count, count);
        for (k, value) in [(2, long * long), (4, long), (5, square)] {
            dear[(k, k)] = value;
        }
        for (from, block) in [(0, slopes), (6, products)] {
            dear.view_mut((from, from), (2, 2)).copy_from(&block);
        }
        dear
    }

    /// How the quadric with these coefficients bends.
    fn bend(&self, found: &Column) -> Across {
        let [first, second, high] = self.sizes;
        let mixed = found[4] / SQRT_2 * high / first / second;
        let [a, b] = [(2, first), (3, second)].map(|(k, size)| found[k] * high / size / size);
        let products = Vector2::new(found[6] / first, found[7] / second) * (SQRT_2 / DEAR[1]);
        Bend { squares: Matrix2::new(a, mixed, mixed, b), products }
    }

    /// In these axes.
    fn across(&self, bend: &InSpace) -> Across {
        let axes = Matrix3x2::from_columns(&self.axes[..2]);
        let squares = axes.tr_mul(&bend.squares) * axes;
        Bend { squares, products: axes.tr_mul(&bend.products) }
    }
}

impl Across {
    /// The coefficient that the square of heights has on spheres, cylinders and cones: with the squares `K` and `c` across the
    /// products, `tr K³ / tr K² - cᵀ K c / (4 tr K²)`.
    fn of_square(&self) -> f64 {
        let twice = self.squares * self.squares;
        if twice.trace() == 0.0 {
            return 0.0;
        }
        let across = Vector2::new(-self.products.y, self.products.x);
        ((twice * self.squares).trace() - 0.25 * across.dot(&(self.squares * across)))
            / twice.trace()
    }

    /// The square of the squares over the larger of its eigenvalues: takes vectors to their parts along which the quadric curves.
    fn curved(&self) -> Matrix2 {
        let [[a, b], [_, c]] = self.squares.into();
        let most = 0.5 * (a + c).abs() + (0.5 * (a - c)).hypot(b);
        if most == 0.0 { self.squares } else { (self.squares / most).pow(2) }
    }
}
