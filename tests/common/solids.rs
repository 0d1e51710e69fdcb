//! Elastic blocks of any elements, in the plane and in space: triangles, quadrilaterals, tetrahedra,
//! wedges and bricks, linear or quadratic, distorted or not. Their lower and upper sides have faces of
//! every kind that the pairing takes.
//!
//! Shape functions are found from the monomials that span them and the nodes of the reference cell, so
//! that none is written down.

use std::collections::HashMap;
use std::sync::Arc;

use fastrand::Rng;
use nalgebra::DMatrix;

use super::mesh::Stiffness;

pub type Point = [f64; 3];

/// Shape of a reference cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Cell {
    /// Interval, square, cube.
    Box,
    /// Triangle, tetrahedron.
    Simplex,
    /// Triangle by interval.
    Wedge,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Order {
    Linear,
    /// Quadratic with nodes on edges alone: Q8, H20, T6, T10, W15.
    Edges,
    /// Quadratic with nodes in faces of four corners and in the middle of cubes too: Q9, H27, W18.
    Full,
}

/// An element: its nodes as means of corners, its functions, and its points of integration.
pub struct Kind {
    dim: usize,
    corners: Vec<Point>,
    /// The corners whose mean each node is: corners first.
    pub means: Vec<Vec<usize>>,
    powers: Vec<[i32; 3]>,
    /// Column i: the coefficients of function i.
    coefficients: DMatrix<f64>,
    points: Vec<(Point, f64)>,
}

fn mean(points: impl ExactSizeIterator<Item = Point>) -> Point {
    let share = 1.0 / points.len() as f64;
    points.fold([0.0; 3], |sum, p| std::array::from_fn(|c| sum[c] + share * p[c]))
}

fn monomial(powers: [i32; 3], at: Point) -> f64 {
    (0..3).map(|c| at[c].powi(powers[c])).product()
}

/// Gauss points of 0..1 by Newton's method on Legendre's polynomial.
pub fn gauss(count: usize) -> Vec<(f64, f64)> {
    let legendre = |x: f64| {
        let (mut before, mut value) = (1.0, x);
        for k in 2..=count {
            let k = k as f64;
            (before, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
        }
        (value, count as f64 * (x * value - before) / (x * x - 1.0))
    };
    let point = |i: usize| {
        let mut x = (std::f64::consts::PI * (i as f64 + 0.75) / (count as f64 + 0.5)).cos();
        for _ in 0..50 {
            let (value, slope) = legendre(x);
            x -= value / slope;
        }
        let slope = legendre(x).1;
        (0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..count).map(point).collect()
}

/// Points of the triangle (0, 0), (1, 0), (0, 1), collapsed from the square.
pub fn on_triangle(count: usize) -> Vec<([f64; 2], f64)> {
    let rule = gauss(count);
    let pairs = rule.iter().flat_map(|a| rule.iter().map(move |b| (a, b)));
    pairs.map(|((s, v), (t, w))| ([*s, (1.0 - s) * t], (1.0 - s) * v * w)).collect()
}

impl Kind {
    pub fn new(dim: usize, cell: Cell, order: Order) -> Kind {
        let corners = corners(dim, cell);
        let mut means: Vec<Vec<usize>> = (0..corners.len()).map(|corner| vec![corner]).collect();
        if order != Order::Linear {
            means.extend(edges(dim, cell, &corners));
            if order == Order::Full && cell == Cell::Wedge {
                // The sides x = 0, y = 0 and x + y = 1.
                let on = |side: [f64; 3]| {
                    let at = |p: Point| side[0] * p[0] + side[1] * p[1] + side[2];
                    (0..corners.len()).filter(|&k| at(corners[k]) == 0.0).collect::<Vec<usize>>()
                };
                means.extend([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, -1.0]].map(on));
            }
            if order == Order::Full && cell == Cell::Box && dim > 1 {
                let all = (0..corners.len()).collect();
                let side = |c: usize, end: f64| {
                    (0..corners.len()).filter(|&k| corners[k][c] == end).collect::<Vec<usize>>()
                };
                if dim == 3 {
                    means.extend((0..3).flat_map(|c| [side(c, 0.0), side(c, 1.0)]));
                }
                means.push(all);
            }
        }
        let powers = powers(dim, cell, order);
        let nodes: Vec<Point> =
            means.iter().map(|of| mean(of.iter().map(|&corner| corners[corner]))).collect();
        assert_eq!(powers.len(), nodes.len(), "{cell:?} {order:?} in {dim}");
        let values =
            DMatrix::from_fn(nodes.len(), nodes.len(), |i, m| monomial(powers[m], nodes[i]));
        let coefficients = values.try_inverse().expect("the nodes determine the functions");
        Kind { dim, corners, means, powers, coefficients, points: points(dim, cell, order) }
    }

    /// Values of the functions at a point of the reference cell.
    pub fn values(&self, at: Point) -> Vec<f64> {
        self.combine(|powers| monomial(powers, at))
    }

    /// Derivatives of the functions along a direction of the reference cell.
    pub fn slopes(&self, at: Point, c: usize) -> Vec<f64> {
        self.combine(|mut powers| {
            let factor = powers[c];
            powers[c] = (factor - 1).max(0);
            f64::from(factor) * monomial(powers, at)
        })
    }

    fn combine(&self, of: impl Fn([i32; 3]) -> f64) -> Vec<f64> {
        let monomials: Vec<f64> = self.powers.iter().map(|&powers| of(powers)).collect();
        let columns = self.coefficients.column_iter();
        columns.map(|column| column.iter().zip(&monomials).map(|(c, m)| c * m).sum()).collect()
    }

    /// Middle of the reference cell.
    pub fn middle(&self) -> Point {
        mean(self.corners.iter().copied())
    }
}

fn corners(dim: usize, cell: Cell) -> Vec<Point> {
    let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let base = match (cell, dim) {
        (Cell::Box, 1) => square[..2].to_vec(),
        (Cell::Box, _) => square.to_vec(),
        _ => vec![square[0], square[1], square[3]],
    };
    match (cell, dim) {
        (Cell::Simplex, 3) => [base, vec![[0.0, 0.0, 1.0]]].concat(),
        (_, 3) => {
            let above = base.iter().map(|p| [p[0], p[1], 1.0]).collect();
            [base, above].concat()
        }
        _ => base,
    }
}

/// Edges as pairs of corners: in the plane in order around the cell, as faces have them.
fn edges(dim: usize, cell: Cell, corners: &[Point]) -> Vec<Vec<usize>> {
    let count = corners.len();
    if dim < 3 {
        let around = if dim == 1 { 1 } else { count };
        return (0..around).map(|k| vec![k, (k + 1) % count]).collect();
    }
    let is_edge = |a: usize, b: usize| {
        let [p, q] = [corners[a], corners[b]];
        let differ = (0..3).filter(|&c| p[c] != q[c]).count();
        match cell {
            Cell::Box => differ == 1,
            Cell::Simplex => true,
            Cell::Wedge => p[2] == q[2] || differ == 1,
        }
    };
    let pairs = (0..count).flat_map(|a| (a + 1..count).map(move |b| (a, b)));
    pairs.filter(|&(a, b)| is_edge(a, b)).map(|(a, b)| vec![a, b]).collect()
}

/// Powers of the monomials that span the functions.
fn powers(dim: usize, cell: Cell, order: Order) -> Vec<[i32; 3]> {
    let quadratic = order != Order::Linear;
    let most = if quadratic { 2 } else { 1 };
    let is_there = |p: [i32; 3]| {
        let beyond = |c: usize| if p[c] > 1 { p[c] } else { 0 };
        let inside = (dim..3).all(|c| p[c] == 0);
        inside
            && match cell {
                Cell::Box if order == Order::Edges => (0..3).map(beyond).sum::<i32>() <= 2,
                Cell::Box => true,
                Cell::Simplex => p.iter().sum::<i32>() <= most,
                Cell::Wedge if p[2] == 2 && order == Order::Edges => p[0] + p[1] <= 1,
                Cell::Wedge => p[0] + p[1] <= most,
            }
    };
    let range = 0..=most;
    let all = range.clone().flat_map(|a| {
        let range = range.clone();
        range.clone().flat_map(move |b| range.clone().map(move |c| [a, b, c]))
    });
    all.filter(|&p| is_there(p)).collect()
}

/// Points that integrate the gradients of a linear displacement exactly, whatever the shape.
fn points(dim: usize, cell: Cell, order: Order) -> Vec<(Point, f64)> {
    let count = if order == Order::Linear { 2 } else { 3 };
    // Cells that are collapsed from cubes have their factor to integrate too.
    let line = gauss(if cell == Cell::Box { count } else { count + 1 });
    let mut points: Vec<(Point, f64)> = vec![([0.0; 3], 1.0)];
    for c in 0..dim {
        let along = |(at, weight): &(Point, f64)| -> Vec<(Point, f64)> {
            let set = |(x, w): &(f64, f64)| {
                let mut at = *at;
                at[c] = *x;
                (at, weight * w)
            };
            line.iter().map(set).collect()
        };
        points = points.iter().flat_map(along).collect();
    }
    let collapse = |([s, t, r], weight): (Point, f64)| match (cell, dim) {
        (Cell::Box, _) => ([s, t, r], weight),
        (Cell::Simplex, 3) => {
            let (a, b) = (1.0 - s, 1.0 - t);
            ([s, a * t, a * b * r], weight * a * a * b)
        }
        _ => ([s, (1.0 - s) * t, r], weight * (1.0 - s)),
    };
    points.into_iter().map(collapse).collect()
}

/// Which elements a block consists of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cells {
    Boxes,
    Simplices,
    /// Wedges, with triangles at the lower and upper side; in space only.
    Wedges,
    /// Boxes and wedges by turns; in space only.
    Mixed,
}

/// A block of elements. The last of the `dim` coordinates points upwards.
pub struct Solid {
    pub dim: usize,
    pub order: Order,
    pub nodes: Vec<Point>,
    pub elements: Vec<(Arc<Kind>, Vec<usize>)>,
    /// Faces of the lower side, seen from below.
    pub lower: Vec<Vec<usize>>,
    /// Faces of the upper side, seen from above.
    pub upper: Vec<Vec<usize>>,
    /// (E, nu).
    pub material: (f64, f64),
}

impl Solid {
    /// A block between grid lines, `dim` lists of them. Inner corners are moved by up to `distortion` of
    /// the shortest step, those of the lower and upper side within it.
    pub fn new(
        lines: &[&[f64]],
        (cells, order): (Cells, Order),
        material: (f64, f64),
        (distortion, rng): (f64, &mut Rng),
    ) -> Solid {
        let dim = lines.len();
        let mut solid = Solid {
            dim,
            order,
            nodes: corner_nodes(lines, (distortion, rng)),
            elements: vec![],
            lower: vec![],
            upper: vec![],
            material,
        };
        let count: Vec<usize> = lines.iter().map(|lines| lines.len()).collect();
        let [nx, ny, nz] =
            if dim == 3 { [count[0], count[1], count[2]] } else { [count[0], 2, count[1]] };
        let node = |i: usize, j: usize, k: usize| match dim {
            3 => i + nx * (j + ny * k),
            _ => i + nx * k,
        };
        let mut kinds: HashMap<Cell, Arc<Kind>> = HashMap::new();
        for k in 0..nz - 1 {
            for j in 0..ny - 1 {
                for i in 0..nx - 1 {
                    let at = |c: [usize; 3]| node(i + c[0], j + c[1], k + c[2]);
                    let is_box = cells == Cells::Boxes || cells == Cells::Mixed && (i + j) % 2 == 0;
                    for (cell, corners) in split(dim, cells, is_box) {
                        let kind = kinds
                            .entry(cell)
                            .or_insert_with(|| Arc::new(Kind::new(dim, cell, order)));
                        let nodes = corners.into_iter().map(at).collect();
                        solid.elements.push((kind.clone(), nodes));
                    }
                    let sides = [(k == 0, 0, true), (k == nz - 2, 1, false)];
                    for (_, level, below) in sides.into_iter().filter(|side| side.0) {
                        let faces = side_faces(dim, is_box).into_iter().map(|face| {
                            let face = face.into_iter().map(|[a, b]| at([a, b, level]));
                            let mut face: Vec<usize> = face.collect();
                            if below {
                                face.reverse();
                            }
                            face
                        });
                        let side = if below { &mut solid.lower } else { &mut solid.upper };
                        side.extend(faces);
                    }
                }
            }
        }
        solid.raise();
        solid
    }

    /// Adds the nodes that are not corners.
    fn raise(&mut self) {
        let mut known: HashMap<Vec<usize>, usize> = HashMap::new();
        let nodes = &mut self.nodes;
        let mut node = |corners: Vec<usize>| {
            let mut key = corners.clone();
            key.sort_unstable();
            *known.entry(key).or_insert_with(|| {
                nodes.push(mean(corners.iter().map(|&corner| nodes[corner])));
                nodes.len() - 1
            })
        };
        for (kind, element) in &mut self.elements {
            let corners = element.clone();
            for of in kind.means.iter().filter(|of| of.len() > 1) {
                element.push(node(of.iter().map(|&k| corners[k]).collect()));
            }
        }
        if self.order == Order::Linear {
            return;
        }
        for face in self.lower.iter_mut().chain(&mut self.upper) {
            let corners = face.clone();
            let around = if corners.len() == 2 { 1 } else { corners.len() };
            for k in 0..around {
                face.push(node(vec![corners[k], corners[(k + 1) % corners.len()]]));
            }
            if self.order == Order::Full && corners.len() == 4 {
                face.push(node(corners));
            }
        }
    }

    pub fn size(&self) -> usize {
        self.dim * self.nodes.len()
    }

    /// The lower triangle of the stiffness of several blocks, which share nothing: plane strain in 2D.
    pub fn stiffness(blocks: &[&Solid]) -> Stiffness {
        let size = blocks.iter().map(|block| block.size()).sum();
        let mut columns: Vec<Vec<(usize, f64)>> = vec![Vec::new(); size];
        let mut first = 0;
        for block in blocks {
            for (kind, nodes) in &block.elements {
                let matrix = block.element(kind, nodes);
                let dim = block.dim;
                let dof = |a: usize| first + dim * nodes[a / dim] + a % dim;
                for a in 0..dim * nodes.len() {
                    for b in 0..dim * nodes.len() {
                        if dof(a) >= dof(b) {
                            columns[dof(b)].push((dof(a), matrix[(a, b)]));
                        }
                    }
                }
            }
            first += block.size();
        }
        let mut lower = Stiffness { size, col_start: vec![0], row: vec![], values: vec![] };
        for column in &mut columns {
            column.sort_by_key(|(i, _)| *i);
            let begin = lower.row.len();
            for &(i, value) in column.iter() {
                if lower.row.len() > begin && lower.row.last() == Some(&(i as i64)) {
                    *lower.values.last_mut().unwrap() += value;
                } else {
                    lower.row.push(i as i64);
                    lower.values.push(value);
                }
            }
            lower.col_start.push(lower.row.len() as i64);
        }
        lower
    }

    fn element(&self, kind: &Kind, nodes: &[usize]) -> DMatrix<f64> {
        let dim = self.dim;
        let (young, poisson) = self.material;
        let lame = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
        let shear = young / (2.0 * (1.0 + poisson));
        let places = DMatrix::from_fn(dim, nodes.len(), |c, i| self.nodes[nodes[i]][c]);
        let mut matrix = DMatrix::zeros(dim * nodes.len(), dim * nodes.len());
        for (at, weight) in &kind.points {
            let slopes: Vec<Vec<f64>> = (0..dim).map(|c| kind.slopes(*at, c)).collect();
            let local = DMatrix::from_fn(nodes.len(), dim, |i, c| slopes[c][i]);
            let jacobian = &places * &local;
            let weight = weight * jacobian.determinant();
            assert!(weight > 0.0, "an element is turned over");
            let gradient = local * jacobian.try_inverse().expect("an element has a volume");
            for m in 0..nodes.len() {
                for n in 0..nodes.len() {
                    let along = gradient.row(m).dot(&gradient.row(n));
                    for i in 0..dim {
                        for j in 0..dim {
                            let same = if i == j { shear * along } else { 0.0 };
                            let entry = lame * gradient[(m, i)] * gradient[(n, j)]
                                + shear * gradient[(m, j)] * gradient[(n, i)]
                                + same;
                            matrix[(dim * m + i, dim * n + j)] += weight * entry;
                        }
                    }
                }
            }
        }
        matrix
    }
}

fn corner_nodes(lines: &[&[f64]], (distortion, rng): (f64, &mut Rng)) -> Vec<Point> {
    let steps = lines.iter().flat_map(|lines| lines.windows(2).map(|ends| ends[1] - ends[0]));
    let most = distortion * steps.fold(f64::INFINITY, f64::min);
    let dim = lines.len();
    let count: usize = lines.iter().map(|lines| lines.len()).product();
    let place = |mut at: usize| {
        let mut place = [0.0; 3];
        let mut inner = [false; 3];
        for c in 0..dim {
            let i = at % lines[c].len();
            at /= lines[c].len();
            place[c] = lines[c][i];
            inner[c] = 0 < i && i + 1 < lines[c].len();
        }
        let inside = inner[..dim - 1].iter().all(|inner| *inner);
        for c in 0..dim {
            let moves = inside && (c + 1 < dim || inner[c]);
            place[c] += if moves { most * (2.0 * rng.f64() - 1.0) } else { 0.0 };
        }
        place
    };
    (0..count).map(place).collect()
}

/// The cells of a square or a cube by its corners.
fn split(dim: usize, cells: Cells, is_box: bool) -> Vec<(Cell, Vec<[usize; 3]>)> {
    let lift = |corners: &[[usize; 2]]| -> Vec<[usize; 3]> {
        let level = |z: usize| corners.iter().map(move |[x, y]| [*x, *y, z]);
        level(0).chain(level(1)).collect()
    };
    match (is_box, dim) {
        (true, 3) => vec![(Cell::Box, lift(&[[0, 0], [1, 0], [1, 1], [0, 1]]))],
        (true, _) => vec![(Cell::Box, vec![[0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1]])],
        (false, 2) => vec![
            (Cell::Simplex, vec![[0, 0, 0], [1, 0, 0], [1, 0, 1]]),
            (Cell::Simplex, vec![[0, 0, 0], [1, 0, 1], [0, 0, 1]]),
        ],
        _ if cells == Cells::Simplices => {
            [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [1, 0, 2], [2, 1, 0]]
                .into_iter()
                .enumerate()
                .map(|(place, axes)| {
                    // From the first corner to the last along the axes in this order.
                    let mut path = vec![[0; 3]];
                    for axis in axes {
                        let mut next = path[path.len() - 1];
                        next[axis] = 1;
                        path.push(next);
                    }
                    if place > 2 {
                        path.swap(1, 2);
                    }
                    (Cell::Simplex, path)
                })
                .collect()
        }
        _ => vec![
            (Cell::Wedge, lift(&[[0, 0], [1, 0], [1, 1]])),
            (Cell::Wedge, lift(&[[0, 0], [1, 1], [0, 1]])),
        ],
    }
}

/// The faces of a cell's lower and upper side, seen from above; in the plane from right to left.
fn side_faces(dim: usize, is_box: bool) -> Vec<Vec<[usize; 2]>> {
    match (dim, is_box) {
        (2, _) => vec![vec![[1, 0], [0, 0]]],
        (_, true) => vec![vec![[0, 0], [1, 0], [1, 1], [0, 1]]],
        _ => vec![vec![[0, 0], [1, 0], [1, 1]], vec![[0, 0], [1, 1], [0, 1]]],
    }
}
