//! Faces as patches that are curved through their nodes with given normals there: arcs of lines, cubic triangles and
//! Coons' patches of quadrilaterals between arcs.
//!
//! An arc is a cubic whose ends have the chord's parts along the surface as tangents, times `2 / (1 + cos b) cos b`, with `b` half of
//! the angle between the normals: of a circle, and of a helix on a cylinder, which turns about its chord besides, it has the place
//! to the sixth power of the division. The length of usual cubics is wrong by the fourth, at 13 divisions half of an
//! interference of a thousandth. Triangles: Vlachos, Peters, Boyd and Mitchell (2001)
//! with these arcs. Quadratic faces are cut into parts at their mid nodes, and each part is a patch.

use super::face::Face;
use super::shape::{FaceKind, Local, MOST_NODES};
use crate::linalg::vector3::{Vector3, axis};

/// A tangent that is shorter than this part of its chord, or normals that nearly oppose, tell no arc: the chord is taken.
const LEAST_TANGENT: f64 = 0.2;

/// A cubic by its control points.
pub(super) type Arc = [Vector3; 4];

/// The arc between two points with normals there.
pub(super) fn arc([p, q]: [Vector3; 2], normals: [Vector3; 2]) -> Arc {
    let chord = q - p;
    let cos = (0.5 * (1.0 + normals[0].dot(&normals[1])).max(0.0)).sqrt();
    let [from, to] = normals.map(|normal| {
        let tangent = chord - chord.dot(&normal) * normal;
        if cos > LEAST_TANGENT && tangent.norm() > LEAST_TANGENT * chord.norm() {
            tangent * (2.0 / 3.0 / ((1.0 + cos) * cos))
        } else {
            chord / 3.0
        }
    });
    [p, p + from, q - to, q]
}

/// The point of an arc at `t` in 0..1, and its derivative.
pub(super) fn on_arc([p, a, b, q]: &Arc, t: f64) -> (Vector3, Vector3) {
    let s = 1.0 - t;
    let point = s * s * s * p + 3.0 * s * t * (s * a + t * b) + t * t * t * q;
    let slope = s * s * (a - p) + 2.0 * s * t * (b - a) + t * t * (q - b);
    (point, 3.0 * slope)
}

/// A part of a face.
#[derive(Clone, Debug)]
enum Form {
    Arc(Arc),
    /// The arcs from corner to corner, and the control point in the middle.
    Triangle([Arc; 3], Vector3),
    /// The arcs along the first coordinate, those along the second, and what is between that no edge has.
    Quadrilateral([Arc; 2], [Arc; 2], Vector3),
}

/// A part of a face.
#[derive(Clone, Debug)]
struct Piece {
    form: Form,
    /// Its own coordinates, from 0 to 1, are those of the face less this,
    from: Local,
    /// times these rows.
    by: [Local; 2],
}

/// A curved face.
#[derive(Clone, Debug)]
pub(super) struct Patch(Vec<Piece>);

/// The parts of a face between neighbouring nodes.
fn parts(kind: FaceKind) -> &'static [&'static [usize]] {
    match kind {
        FaceKind::Line2 => &[&[0, 1]],
        FaceKind::Line3 => &[&[0, 2], &[2, 1]],
        FaceKind::T3 => &[&[0, 1, 2]],
        FaceKind::Q4 => &[&[0, 1, 2, 3]],
        FaceKind::T6 => &[&[0, 3, 5], &[3, 1, 4], &[5, 4, 2], &[3, 4, 5]],
        FaceKind::Q8 => &[&[0, 4, 7], &[4, 1, 5], &[5, 2, 6], &[6, 3, 7], &[4, 5, 6, 7]],
        FaceKind::Q9 => &[&[0, 4, 8, 7], &[4, 1, 5, 8], &[8, 5, 2, 6], &[7, 8, 6, 3]],
    }
}

impl Patch {
    /// Curves a face by unit normals at its nodes.
    pub(super) fn new(face: &Face<'_>, normals: &[Vector3; MOST_NODES]) -> Patch {
        let places = face.kind.places();
        let piece = |nodes: &&[usize]| {
            let last = nodes[nodes.len() - 1];
            let [origin, first, second] = [nodes[0], nodes[1], last].map(|node| places[node]);
            let [a, b] = [first, second].map(|end| [end[0] - origin[0], end[1] - origin[1]]);
            let b = if face.kind.is_line() { [0.0, 1.0] } else { b };
            let area = a[0] * b[1] - a[1] * b[0];
            let by = [[b[1] / area, -b[0] / area], [-a[1] / area, a[0] / area]];
            Piece { form: form(face, nodes, normals), from: origin, by }
        };
        Patch(parts(face.kind).iter().map(piece).collect())
    }

    /// The point at local coordinates of the face, and its derivatives by them; across a line that along the third axis.
    pub(super) fn at(&self, local: Local) -> (Vector3, [Vector3; 2]) {
        let own = |piece: &Piece| {
            let [s, t] = [0, 1].map(|c| local[c] - piece.from[c]);
            piece.by.map(|row| row[0] * s + row[1] * t)
        };
        let inside = |piece: &Piece| piece.form.inside(own(piece));
        let best = self.0.iter().max_by(|a, b| inside(a).total_cmp(&inside(b)));
        let piece = best.expect("a face has parts");
        let (point, [by_first, by_second]) = piece.form.at(own(piece));
        let along = |c: usize| piece.by[0][c] * by_first + piece.by[1][c] * by_second;
        (point, [along(0), along(1)])
    }
}

fn form(face: &Face<'_>, nodes: &[usize], normals: &[Vector3; MOST_NODES]) -> Form {
    let arc = |i: usize, j: usize| {
        arc([i, j].map(|i| face.x[nodes[i]]), [i, j].map(|i| normals[nodes[i]]))
    };
    match nodes.len() {
        2 => Form::Arc(arc(0, 1)),
        3 => {
            let arcs = [arc(0, 1), arc(1, 2), arc(2, 0)];
            let corners: Vector3 = arcs.iter().map(|arc| arc[0]).sum::<Vector3>() / 3.0;
            let edges: Vector3 = arcs.iter().map(|arc| arc[1] + arc[2]).sum::<Vector3>() / 6.0;
            Form::Triangle(arcs, edges + 0.5 * (edges - corners))
        }
        _ => {
            let corners = [0, 1, 2, 3].map(|i| face.x[nodes[i]]);
            let bulge = bulge(corners, [0, 1, 2, 3].map(|i| normals[nodes[i]]));
            Form::Quadrilateral([arc(0, 1), arc(3, 2)], [arc(0, 3), arc(1, 2)], bulge)
        }
    }
}

impl Form {
    /// How far a point is inside; negative outside.
    fn inside(&self, [s, t]: Local) -> f64 {
        match self {
            Form::Arc(_) => s.min(1.0 - s),
            Form::Triangle(..) => s.min(t).min(1.0 - s - t),
            Form::Quadrilateral(..) => s.min(t).min(1.0 - s).min(1.0 - t),
        }
    }

    fn at(&self, [s, t]: Local) -> (Vector3, [Vector3; 2]) {
        match self {
            Form::Arc(arc) => {
                let (point, slope) = on_arc(arc, s);
                (point, [slope, axis(2)])
            }
            Form::Triangle(arcs, middle) => in_triangle(arcs, middle, [s, t]),
            Form::Quadrilateral(along, across, bulge) => {
                let ([low, high], [left, right]) =
                    (along.map(|arc| on_arc(&arc, s)), across.map(|arc| on_arc(&arc, t)));
                // Coons: both pairs of edges, less what is between the corners.
                let [[a, b], [d, c]] = along.map(|arc| [arc[0], arc[3]]);
                let (below, above) = ((1.0 - s) * a + s * b, (1.0 - s) * d + s * c);
                let between = |f: Vector3, g: Vector3, t: f64| (1.0 - t) * f + t * g;
                let point = between(low.0 - below, high.0 - above, t) + between(left.0, right.0, s);
                let first = between(low.1 - (b - a), high.1 - (c - d), t) + right.0 - left.0;
                let second = (high.0 - above) - (low.0 - below) + between(left.1, right.1, s);
                let (bow, slope) = (|s: f64| s * (1.0 - s), |s: f64| 1.0 - 2.0 * s);
                let (first, second) =
                    (first + slope(s) * bow(t) * bulge, second + bow(s) * slope(t) * bulge);
                (point + bow(s) * bow(t) * bulge, [first, second])
            }
        }
    }
}

/// What a quadrilateral that is no parallelogram has between its edges beyond Coons' patch, which lacks `s² t²`: with
/// `d = a - b + c - e`, by which the sides differ, and the curvature `k` along it, `-k d² / 2` along the normal. The normals of the
/// corners tell the curvature.
fn bulge(corners: [Vector3; 4], normals: [Vector3; 4]) -> Vector3 {
    let means = |[a, b, c, d]: [Vector3; 4]| [0.5 * (b - a + c - d), 0.5 * (d - a + c - b)];
    let ([along, across], turns) = (means(corners), means(normals));
    let [a, b, c, d] = corners;
    let twist = a - b + c - d;
    let (p, q, r) = (along.norm_squared(), along.dot(&across), across.norm_squared());
    let (f, g) = (along.dot(&twist), across.dot(&twist));
    let area = p * r - q * q;
    let turn = (r * f - q * g) / area * turns[0] + (p * g - q * f) / area * turns[1];
    let normal = 0.25 * normals.iter().sum::<Vector3>();
    -0.5 * turn.dot(&twist) * normal
}

/// The point of a cubic triangle and its derivatives, from those by the three barycentric coordinates.
fn in_triangle(arcs: &[Arc; 3], middle: &Vector3, [s, t]: Local) -> (Vector3, [Vector3; 2]) {
    let at = [1.0 - s - t, s, t];
    let slopes = [0, 1, 2].map(|i| {
        let (next, before) = ((i + 1) % 3, (i + 2) % 3);
        let (u, v, w) = (at[i], at[next], at[before]);
        let ([p, a, b, _], [_, d, c, _]) = (arcs[i], arcs[before]);
        let along = u * u * p + 2.0 * u * (v * a + w * c) + v * v * b + w * w * d;
        3.0 * (along + 2.0 * v * w * middle)
    });
    let point = (0..3).map(|i| at[i] * slopes[i]).sum::<Vector3>() / 3.0;
    (point, [slopes[1] - slopes[0], slopes[2] - slopes[0]])
}
