//! The kinds of faces: their nodes, shape functions and edges.
//!
//! Corners come first, in order around the face; then the mid nodes, the one between corners `i` and
//! `i + 1` at place `i`; then the centre. Lines and quadrilaterals live on -1..1, triangles on the unit
//! triangle.

/// More faces than these meet at a node only where slivers do. What each of them asks of all others is asked of so many.
pub(super) const MANY_FACES: usize = 16;

/// Most nodes of a face.
pub(super) const MOST_NODES: usize = 9;

/// A number for each node of a face; zero beyond them.
pub(super) type Values = [f64; MOST_NODES];

/// Values in an array that they need not fill: zero behind them.
#[inline]
pub(super) fn padded<T: Copy + Default, const N: usize>(values: impl Iterator<Item = T>) -> [T; N] {
    let mut array = [T::default(); N];
    array.iter_mut().zip(values).for_each(|(place, value)| *place = value);
    array
}

/// A point in a face's own coordinates. The second is zero on lines.
pub(super) type Local = [f64; 2];

/// Most points of a block.
pub(super) const BLOCK: usize = 32;

/// A number for each point of a block.
pub(super) type Block = [f64; BLOCK];

/// The places of so many points in a block.
#[inline(always)]
pub(super) fn each(count: usize) -> std::ops::Range<usize> {
    0..count.min(BLOCK)
}

/// A point is on a face if it is beyond it by less than this, in local coordinates, or as a part of the coordinates while
/// faces are looked for: nodes that stand on the rim by construction miss it by rounding.
pub(super) const BEYOND: f64 = 1e-9;

/// The kind of a face, told by the space dimension and the number of its nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FaceKind {
    /// A line with 2 nodes, in the plane.
    Line2,
    /// A line with 3 nodes, in the plane: ends, then the middle.
    Line3,
    /// A triangle with 3 nodes.
    T3,
    /// A triangle with 6 nodes.
    T6,
    /// A quadrilateral with 4 nodes.
    Q4,
    /// A quadrilateral with 8 nodes.
    Q8,
    /// A quadrilateral with 9 nodes.
    Q9,
}

use FaceKind::{Line2, Line3, Q4, Q8, Q9, T3, T6};

const LINE: [Local; 3] = [[-1.0, 0.0], [1.0, 0.0], [0.0, 0.0]];
const TRIANGLE: [Local; 6] =
    [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5]];
const QUADRILATERAL: [Local; 9] = [
    [-1.0, -1.0],
    [1.0, -1.0],
    [1.0, 1.0],
    [-1.0, 1.0],
    [0.0, -1.0],
    [1.0, 0.0],
    [0.0, 1.0],
    [-1.0, 0.0],
    [0.0, 0.0],
];

/// Exponents of the monomials that span the shape functions: of T6 the first six, of Q8 the first eight.
const QUADRATIC: [[i32; 2]; 9] =
    [[0, 0], [1, 0], [0, 1], [2, 0], [1, 1], [0, 2], [2, 1], [1, 2], [2, 2]];
const BILINEAR: [[i32; 2]; 4] = [[0, 0], [1, 0], [0, 1], [1, 1]];
const ON_LINE: [[i32; 2]; 3] = [[0, 0], [1, 0], [2, 0]];

/// A method of a kind by code of each kind's own, without branches and loops over nodes.
macro_rules! by_kind {
    ($kind:expr, $method:ident($($argument:expr),*)) => {
        match $kind {
            Line2 => Line2.$method($($argument),*),
            Line3 => Line3.$method($($argument),*),
            T3 => T3.$method($($argument),*),
            T6 => T6.$method($($argument),*),
            Q4 => Q4.$method($($argument),*),
            Q8 => Q8.$method($($argument),*),
            Q9 => Q9.$method($($argument),*),
        }
    };
}

impl FaceKind {
    /// True if local coordinates are those of a point of the face.
    pub(super) fn holds(self, [s, t]: Local) -> bool {
        if self.is_triangle() {
            return s >= -BEYOND && t >= -BEYOND && s + t <= 1.0 + BEYOND;
        }
        s.abs().max(t.abs()) <= 1.0 + BEYOND
    }

    /// The local coordinates of a point of the face that are nearest to some.
    pub(super) fn nearest(self, [s, t]: Local) -> Local {
        if !self.is_triangle() {
            return [s, t].map(|c| c.clamp(-1.0, 1.0));
        }
        let beyond = 0.5 * (s + t - 1.0).max(0.0);
        let s = (s - beyond).clamp(0.0, 1.0);
        [s, if beyond > 0.0 { 1.0 - s } else { t.clamp(0.0, 1.0) }]
    }

    /// The kind with this number of nodes.
    pub(super) fn of(dim: usize, nodes: usize) -> Option<FaceKind> {
        let kinds: &[FaceKind] = if dim == 2 { &[Line2, Line3] } else { &[T3, Q4, T6, Q8, Q9] };
        kinds.iter().copied().find(|kind| kind.nodes() == nodes)
    }

    /// Number of nodes.
    pub(super) fn nodes(self) -> usize {
        match self {
            Line2 => 2,
            Line3 | T3 => 3,
            Q4 => 4,
            T6 => 6,
            Q8 => 8,
            Q9 => 9,
        }
    }

    /// Number of corners; of a line, its two ends.
    pub(super) fn corners(self) -> usize {
        match self {
            Line2 | Line3 => 2,
            T3 | T6 => 3,
            Q4 | Q8 | Q9 => 4,
        }
    }

    /// Dimension of the space that it stands in.
    pub(super) fn dim(self) -> usize {
        if self.is_line() { 2 } else { 3 }
    }

    /// Returns `true` if it is a line of the plane.
    pub(super) fn is_line(self) -> bool {
        matches!(self, Line2 | Line3)
    }

    /// Returns `true` if it is a triangle.
    pub(super) fn is_triangle(self) -> bool {
        matches!(self, T3 | T6)
    }

    /// Highest total degree of the shape functions.
    pub(super) fn degree(self) -> usize {
        match self {
            Line2 | T3 => 1,
            Line3 | T6 | Q4 => 2,
            Q8 => 3,
            Q9 => 4,
        }
    }

    /// Places of the nodes in the face's own coordinates.
    pub(super) fn places(self) -> &'static [Local] {
        match self {
            Line2 | Line3 => &LINE[..self.nodes()],
            T3 | T6 => &TRIANGLE[..self.nodes()],
            Q4 | Q8 | Q9 => &QUADRILATERAL[..self.nodes()],
        }
    }

    /// The middle of the face.
    pub(super) fn centre(self) -> Local {
        match self {
            T3 | T6 => [1.0 / 3.0; 2],
            _ => [0.0; 2],
        }
    }

    /// The edges, by their corners; of a line it itself, to and fro.
    pub(super) fn edges(self) -> impl Iterator<Item = [usize; 2]> {
        let corners = self.corners();
        (0..corners).map(move |edge| [edge, (edge + 1) % corners])
    }

    /// Mid nodes on edges, each with the two corners beside it.
    pub(super) fn mids(self) -> impl Iterator<Item = (usize, [usize; 2])> {
        let ends = self.nodes() - usize::from(self.central_node().is_some());
        (self.corners()..ends).zip(self.edges())
    }

    /// The node in the middle of a face with 9 nodes.
    pub(super) fn central_node(self) -> Option<usize> {
        (self == Q9).then_some(MOST_NODES - 1)
    }

    /// Exponents of the monomials that span the shape functions, lowest first.
    pub(super) fn exponents(self) -> &'static [[i32; 2]] {
        match self {
            Line2 | Line3 => &ON_LINE[..self.nodes()],
            T3 | T6 | Q8 | Q9 => &QUADRATIC[..self.nodes()],
            Q4 => &BILINEAR,
        }
    }

    /// Shape functions at a point.
    #[inline(always)]
    pub(super) fn values(self, at: Local) -> Values {
        self.functions(at).map(|[value]| value)
    }

    /// Lists the shape functions at some points, function after function, by blocks of points.
    #[inline(always)]
    pub(super) fn values_at(
        self,
        at: [&[f64]; 2],
        values: &mut [f64],
        block: &mut [Block; MOST_NODES],
    ) {
        by_kind!(self, list(at, values, block));
    }

    /// [`FaceKind::values_at`], of one kind.
    #[inline(always)]
    fn list(self, [s, t]: [&[f64]; 2], values: &mut [f64], block: &mut [Block; MOST_NODES]) {
        let length = values.len() / self.nodes();
        for (place, (s, t)) in s.chunks(BLOCK).zip(t.chunks(BLOCK)).enumerate() {
            for k in each(s.len().min(t.len())) {
                let of_point = self.values([s[k], t[k]]);
                (0..self.nodes()).for_each(|node| block[node][k] = of_point[node]);
            }
            for (list, block) in values.chunks_exact_mut(length).zip(&*block) {
                list[place * BLOCK..][..s.len()].copy_from_slice(&block[..s.len()]);
            }
        }
    }

    /// Derivatives of the shape functions at a point, by the two coordinates.
    pub(super) fn derivatives(self, at: Local) -> [[f64; 2]; MOST_NODES] {
        by_kind!(self, functions(at)).map(|[_, first, second]| [first, second])
    }

    /// Shape functions, each as its value and, with three parts, its derivatives by the two coordinates.
    #[inline(always)]
    pub(super) fn functions<const PARTS: usize>(self, [s, t]: Local) -> [[f64; PARTS]; MOST_NODES] {
        let mut functions = [[0.0; PARTS]; MOST_NODES];
        match self {
            Line2 => (0..2).for_each(|i| functions[i] = product(linear(s)[i], ONE)),
            Line3 => (0..3).for_each(|i| functions[i] = product(quadratic(s)[i], ONE)),
            T3 | T6 => {
                let barycentric = [[1.0 - s - t, -1.0, -1.0], [s, 1.0, 0.0], [t, 0.0, 1.0]];
                (0..3).for_each(|i| functions[i] = first_parts(barycentric[i]));
                for (mid, [a, b]) in self.mids() {
                    functions[mid] = times(4.0, barycentric[a], barycentric[b]);
                }
            }
            Q4 => {
                let (along, across) = (linear(s), linear(t));
                (0..4)
                    .for_each(|i| functions[i] = product(along[SIDES[i][0]], across[SIDES[i][1]]));
            }
            Q8 | Q9 => {
                let on_line = |s| match (linear(s), quadratic(s)) {
                    ([low, high], [.., middle]) if self == Q8 => [low, high, middle],
                    (_, all) => all,
                };
                let (along, across) = (on_line(s), on_line(t));
                for (function, &[a, b]) in functions.iter_mut().zip(&SIDES[..self.nodes()]) {
                    *function = product(along[a], across[b]);
                }
            }
        }
        if matches!(self, T6 | Q8) {
            self.take_from_corners(&mut functions);
        }
        functions
    }

    /// Makes the functions of the corners zero at the mid nodes, where they are a half.
    #[inline(always)]
    fn take_from_corners<const PARTS: usize>(self, functions: &mut [[f64; PARTS]; MOST_NODES]) {
        for (mid, corners) in self.mids() {
            for corner in corners {
                let half = functions[mid].map(|part| 0.5 * part);
                functions[corner].iter_mut().zip(half).for_each(|(part, half)| *part -= half);
            }
        }
    }
}

/// For each node of a quadrilateral, its places along the two coordinates: 0 and 1 the ends, 2 the middle.
const SIDES: [[usize; 2]; 9] =
    [[0, 0], [1, 0], [1, 1], [0, 1], [2, 0], [1, 2], [2, 1], [0, 2], [2, 2]];

const ONE: [f64; 2] = [1.0, 0.0];

/// The linear functions of a line with their derivatives.
#[inline]
fn linear(s: f64) -> [[f64; 2]; 2] {
    [-1.0, 1.0].map(|sign| [0.5 * (1.0 + sign * s), 0.5 * sign])
}

/// The quadratic functions of a line with their derivatives: of the ends, then of the middle.
#[inline]
fn quadratic(s: f64) -> [[f64; 2]; 3] {
    [[0.5 * s * (s - 1.0), s - 0.5], [0.5 * s * (s + 1.0), s + 0.5], [1.0 - s * s, -2.0 * s]]
}

/// So many of a function's value and its derivatives as are asked for.
#[inline]
fn first_parts<const PARTS: usize>(all: [f64; 3]) -> [f64; PARTS] {
    std::array::from_fn(|part| all[part])
}

/// `a(s) b(t)` with its derivatives.
#[inline]
fn product<const PARTS: usize>(a: [f64; 2], b: [f64; 2]) -> [f64; PARTS] {
    first_parts([a[0] * b[0], a[1] * b[0], a[0] * b[1]])
}

/// `factor a b` with its derivatives.
#[inline]
fn times<const PARTS: usize>(factor: f64, a: [f64; 3], b: [f64; 3]) -> [f64; PARTS] {
    first_parts([
        factor * a[0] * b[0],
        factor * (a[1] * b[0] + a[0] * b[1]),
        factor * (a[2] * b[0] + a[0] * b[2]),
    ])
}
