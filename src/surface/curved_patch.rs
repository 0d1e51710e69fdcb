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

/// A cubic by its coefficients, lowest first.
pub(super) type Arc = [Vector3; 4];

/// The arc between two points with normals there.
pub(super) fn arc([p, q]: [Vector3; 2], normals: [Vector3; 2]) -> Arc {
    let chord = q - p;
    let cos = (0.5 * (1.0 + normals[0].dot(&normals[1])).max(0.0)).sqrt();
    let least = LEAST_TANGENT * LEAST_TANGENT * chord.norm_squared();
    let [from, to] = normals.map(|normal| {
        let tangent = chord - chord.dot(&normal) * normal;
        if cos > LEAST_TANGENT && tangent.norm_squared() > least {
            tangent * (2.0 / ((1.0 + cos) * cos))
        } else {
            chord
        }
    });
    [p, from, 3.0 * chord - to - 2.0 * from, from + to - 2.0 * chord]
}

/// The point of an arc at `t` in 0..1, and its derivative.
#[inline]
pub(super) fn on_arc([a, b, c, d]: &Arc, t: f64) -> (Vector3, Vector3) {
    (a + t * (b + t * (c + t * d)), b + t * (2.0 * c + 3.0 * t * d))
}

/// A part of a face.
#[derive(Clone, Debug)]
struct Piece {
    /// The coefficients of its places: of each component by powers of the second coordinate, beside each other by those of the first.
    places: [[[f64; 4]; 4]; 3],
    is_triangle: bool,
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
            let is_triangle = nodes.len() == FaceKind::T3.corners();
            let arcs = places_of(face, nodes, normals);
            let places = [0, 1, 2].map(|c| [0, 1, 2, 3].map(|j| arcs.map(|arc| arc[j][c])));
            Piece { places, is_triangle, from: origin, by }
        };
        Patch(parts(face.kind).iter().map(piece).collect())
    }

    /// The point at local coordinates of the face, and its derivatives by them; across a line that along the third axis.
    #[inline]
    pub(super) fn at(&self, local: Local) -> (Vector3, [Vector3; 2]) {
        let own = self.0.iter().map(|piece| {
            let [s, t] = [0, 1].map(|c| local[c] - piece.from[c]);
            let [s, t] = piece.by.map(|row| row[0] * s + row[1] * t);
            let across = if piece.is_triangle { 1.0 - s - t } else { (1.0 - s).min(1.0 - t) };
            (s.min(t).min(across), [s, t], piece)
        });
        let best = own.max_by(|(inside, ..), (other, ..)| inside.total_cmp(other));
        let (_, [s, t], Piece { places, by, .. }) = best.expect("a face has parts");
        let (powers, slopes) = ([1.0, s, s * s, s * s * s], [0.0, 1.0, 2.0 * s, 3.0 * s * s]);
        let (mut point, mut by_first, mut by_second) = <[Vector3; 3]>::default().into();
        for (c, [low, one, two, three]) in places.iter().enumerate() {
            for i in 0..4 {
                let place = low[i] + t * (one[i] + t * (two[i] + t * three[i]));
                point[c] += place * powers[i];
                by_first[c] += place * slopes[i];
                by_second[c] += (one[i] + t * (2.0 * two[i] + 3.0 * t * three[i])) * powers[i];
            }
        }
        (point, [0, 1].map(|c| by[0][c] * by_first + by[1][c] * by_second))
    }
}

/// The coefficients of a part, about its first corner: coordinates lose no digits to those of the whole body.
fn places_of(face: &Face<'_>, nodes: &[usize], normals: &[Vector3; MOST_NODES]) -> [Arc; 4] {
    let origin = face.x[nodes[0]];
    let (x, normal) = (|i: usize| face.x[nodes[i]] - origin, |i: usize| normals[nodes[i]]);
    let arc = |i: usize, j: usize| arc([x(i), x(j)], [normal(i), normal(j)]);
    let mut places = match nodes.len() {
        2 => from_edges(arc(0, 1), [Vector3::zeros(), axis(2), Vector3::zeros(), Vector3::zeros()]),
        3 => triangle([arc(0, 1), arc(1, 2), arc(0, 2)]),
        _ => {
            let bulge = bulge([0, 1, 2, 3].map(x), [0, 1, 2, 3].map(normal));
            quadrilateral([arc(0, 1), arc(3, 2)], [arc(0, 3), arc(1, 2)], bulge)
        }
    };
    places[0][0] += origin;
    places
}

/// The sum of two arcs from the origin, one along each coordinate.
fn from_edges(first: Arc, second: Arc) -> [Arc; 4] {
    let mut places =
        first.map(|along| [along, Vector3::zeros(), Vector3::zeros(), Vector3::zeros()]);
    places[0] = second;
    places
}

/// The cubic triangle whose first corner is the origin, from the arcs along both coordinates and between them. Its control point in
/// the middle is as far from the mean of the corners as half more than the mean of those on the arcs.
fn triangle(arcs @ [first, between, second]: [Arc; 3]) -> [Arc; 4] {
    let [along, slope, across] = arcs.map(|arc| on_arc(&arc, 1.0).1);
    let corners = between[0] + on_arc(&between, 1.0).0;
    let on_arcs: Vector3 = arcs.map(|arc| 2.0 * arc[0] + arc[1] + arc[2] / 3.0).iter().sum();
    let middle = 1.5 * on_arcs - corners - 2.0 * (first[1] + second[1]);
    let mut places = from_edges(first, second);
    places[1][1] = middle;
    places[2][1] = between[1] + along - second[1] - middle;
    places[1][2] = across - slope - first[1] - middle;
    places
}

/// Coons' patch whose first corner is the origin, from the arcs along the first coordinate and along the second: both pairs, less
/// what is between the corners; and what is between that no edge has.
fn quadrilateral(
    [mut low, mut high]: [Arc; 2],
    [left, right]: [Arc; 2],
    bulge: Vector3,
) -> [Arc; 4] {
    for arc in [&mut low, &mut high] {
        let chord = arc[1] + arc[2] + arc[3];
        (arc[0], arc[1]) = (Vector3::zeros(), arc[1] - chord);
    }
    let mut places = from_edges(low, left);
    for k in 0..4 {
        places[k][1] += high[k] - low[k];
        places[1][k] += right[k] - left[k];
    }
    for (i, j, sign) in [(1, 1, 1.0), (1, 2, -1.0), (2, 1, -1.0), (2, 2, 1.0)] {
        places[i][j] += sign * bulge;
    }
    places
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
