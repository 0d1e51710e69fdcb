//! Hertz's contacts between two elastic bodies on meshes that do not match, through pairs from surfaces:
//! a parabolic cylinder (plane strain) and a paraboloid on a flat body, each side slave.
//!
//! The closed forms are those of K. L. Johnson, *Contact Mechanics* (1985), sections 4.2 and 4.3, for the
//! load that is applied. Bodies end at `REACH` half-widths, so that bending changes their relative curvature by
//! less than 0.5 %. What remains is the error of elements of the size `2 a / n`, most of it at the rim, where
//! the pressure begins with a vertical tangent. `--nocapture` shows the table.

mod common;
#[path = "common/surfaces.rs"]
#[allow(dead_code)] // Every test of surfaces uses a part.
mod surfaces;

use std::f64::consts::PI;

use common::solids::{Cell, Cells, Kind, Order, Solid, gauss};
use fastrand::Rng;
use signorini::reduce::{ContactPairs, Indices, SparseMatrix, Triangle};
use signorini::surface::SurfaceSettings;
use signorini::{FrictionLaw, LoadCase, Model, Monitor, Settings, Status};
use surfaces::pair;

/// Half-width of the contact; radius of curvature.
const A: f64 = 1.0;
const RADIUS: f64 = 20.0;

/// (E, nu) of the flat body and of the curved one.
const MATERIALS: [(f64, f64); 2] = [(1.0, 0.3), (2.0, 0.2)];

/// The curved body has so many times the elements of the flat one: no nodes match but the first.
const FINER: f64 = 1.25;

/// Points along each direction of a face where pressures are compared.
const POINTS: usize = 8;

/// Elements are fine, and may touch, up to here.
const FINE: f64 = 1.5 * A;

/// `E*`.
fn contact_modulus() -> f64 {
    1.0 / MATERIALS.iter().map(|(young, poisson)| (1.0 - poisson * poisson) / young).sum::<f64>()
}

/// Load and largest pressure of the half-width `A`.
fn hertz(dim: usize) -> (f64, f64) {
    let modulus = contact_modulus();
    match dim {
        2 => (PI * A * A * modulus / (4.0 * RADIUS), A * modulus / (2.0 * RADIUS)),
        _ => (4.0 * modulus * A.powi(3) / (3.0 * RADIUS), 2.0 * A * modulus / (PI * RADIUS)),
    }
}

/// Steps of the size `fine` up to `until`, then growing ones to `end`.
fn graded(fine: f64, until: f64, end: f64, growth: f64) -> Vec<f64> {
    let count = (until / fine).ceil() as usize;
    let mut lines: Vec<f64> = (0..=count).map(|i| fine * i as f64).collect();
    let last = lines[count];
    let mut step = fine;
    while lines[lines.len() - 1] < end {
        step *= growth;
        lines.push(lines[lines.len() - 1] + step);
    }
    let stretch = (end - last) / (lines[lines.len() - 1] - last);
    lines[count + 1..].iter_mut().for_each(|x| *x = last + stretch * (*x - last));
    *lines.last_mut().unwrap() = end;
    lines
}

struct Contact {
    dim: usize,
    solids: [Solid; 2],
    reach: f64,
}

impl Contact {
    /// `n` elements across the contact on the flat body.
    fn new(dim: usize, order: Order, n: f64) -> Contact {
        let (reach, growth) = if dim == 2 { (40.0, 1.3) } else { (12.0, 1.5) };
        let rng = &mut Rng::new();
        let solids = [0, 1].map(|body| {
            let fine = 2.0 * A / if body == 0 { n } else { FINER * n };
            let flat = graded(fine, FINE, reach, growth);
            let levels = graded(fine, fine, reach, growth);
            let levels: Vec<f64> = match body {
                0 => levels.iter().rev().map(|z| -z).collect(),
                _ => levels,
            };
            let lines: Vec<&[f64]> =
                vec![&flat[..]; dim - 1].into_iter().chain([&levels[..]]).collect();
            Solid::new(&lines, (Cells::Boxes, order), MATERIALS[body], (0.0, rng))
        });
        let mut contact = Contact { dim, solids, reach };
        for p in &mut contact.solids[1].nodes {
            let from_axis = p[..dim - 1].iter().map(|x| x * x).sum::<f64>().sqrt();
            // A parabola to twice the fine part, then its tangent.
            let parabola = from_axis.min(2.0 * FINE);
            let rise = (from_axis - parabola / 2.0) * parabola / RADIUS;
            p[dim - 1] += rise * (1.0 - p[dim - 1] / reach);
        }
        contact
    }

    /// Faces on which no node is further out than the fine part.
    fn fine_faces(&self, faces: &[Vec<usize>], body: usize) -> Vec<Vec<usize>> {
        let nodes = &self.solids[body].nodes;
        let first = body * self.solids[0].nodes.len();
        let fine = |face: &&Vec<usize>| {
            let mut places = face.iter().flat_map(|&node| &nodes[node][..self.dim - 1]);
            places.all(|x| *x < FINE * (1.0 + 1e-9))
        };
        let shifted = |face: &Vec<usize>| face.iter().map(|node| first + node).collect();
        faces.iter().filter(fine).map(shifted).collect()
    }

    /// A uniform pressure on the top: the load of a half, or of a quarter.
    fn load(&self) -> Vec<f64> {
        let [lower, upper] = &self.solids;
        let mut load = vec![0.0; lower.size() + upper.size()];
        let share = hertz(self.dim).0 / if self.dim == 2 { 2.0 } else { 4.0 };
        for face in &upper.upper {
            let side = |c: usize| {
                let values = face.iter().map(|&node| upper.nodes[node][c]);
                values.clone().fold(f64::MIN, f64::max) - values.fold(f64::MAX, f64::min)
            };
            let area: f64 = (0..self.dim - 1).map(|c| side(c) / self.reach).product();
            let parts: &[f64] = match face.len() {
                2 => &[0.5; 2],
                3 => &[1.0 / 6.0, 1.0 / 6.0, 2.0 / 3.0],
                _ => &[0.25; 4],
            };
            for (node, part) in face.iter().zip(parts) {
                let dof = lower.size() + self.dim * node + self.dim - 1;
                load[dof] -= share * area * part;
            }
        }
        load
    }

    /// Supports: planes of symmetry, and the lower end.
    fn fixed(&self) -> Vec<usize> {
        let mut fixed = Vec::new();
        let nodes = self.solids.iter().flat_map(|solid| &solid.nodes);
        for (node, p) in nodes.enumerate() {
            let planes = (0..self.dim - 1).filter(|&c| p[c] == 0.0);
            fixed.extend(planes.map(|c| self.dim * node + c));
            if p[self.dim - 1] == -self.reach {
                fixed.push(self.dim * node + self.dim - 1);
            }
        }
        fixed
    }

    /// Errors of the pressure in L2, of its largest value, and of the resultant; number of pairs. The
    /// pressure between nodes is interpolated by the functions of the slave's faces.
    fn errors(&self, curved_is_slave: bool) -> ([f64; 4], usize) {
        let dim = self.dim;
        let [lower, upper] = &self.solids;
        let faces = [self.fine_faces(&lower.upper, 0), self.fine_faces(&upper.lower, 1)];
        let sides =
            if curved_is_slave { [&faces[1][..], &faces[0]] } else { [&faces[0][..], &faces[1]] };
        let nodes = [&lower.nodes[..], &upper.nodes].concat();
        let found = pair(dim, &nodes, sides, &SurfaceSettings::default()).unwrap();
        let arrays = found.rows();
        let stiffness = Solid::stiffness(&self.solids.each_ref());
        let matrix = SparseMatrix {
            size: stiffness.size,
            col_start: Indices::Wide(&stiffness.col_start),
            row: Indices::Wide(&stiffness.row),
            values: &stiffness.values,
            index_base: 0,
            triangle: Triangle::Lower,
        };
        let model = Model::sparse(&matrix, &self.fixed(), &ContactPairs::from(&arrays)).unwrap();
        let case = LoadCase {
            load: &self.load(),
            prescribed: None,
            gap: &arrays.gaps,
            law: FrictionLaw::Frictionless,
            reference_slip: None,
        };
        let settings = Settings::default();
        let monitor = &mut Monitor::new(&settings, None);
        let solution = model.solve(&case, &settings, None, monitor).unwrap();
        assert_eq!(solution.status, Status::Solved, "{}", solution.message);
        let (load, largest) = hertz(dim);
        let mut pressure = vec![0.0; nodes.len()];
        let (mut most, mut sum) = (0.0_f64, 0.0);
        for (j, (pair, area)) in found.pairs.iter().zip(&arrays.areas).enumerate() {
            let force = -solution.certificate.force[dim * j];
            pressure[pair.slave] = force / area;
            most = most.max(force / area);
            sum += force;
        }
        let load = load / if dim == 2 { 2.0 } else { 4.0 };
        let exact = |from_axis: f64| largest * (1.0 - (from_axis / A).powi(2)).max(0.0).sqrt();
        let [means, field] = distance(dim, &nodes, sides[0], &pressure, exact);
        ([means, field, most / largest - 1.0, sum / load - 1.0], found.pairs.len())
    }
}

/// `|p - exact| / |exact|` in L2 over faces whose edges are along the axes: of the pressures of pairs, which
/// are means weighted by the functions of their nodes, and of the field interpolated between them.
fn distance(
    dim: usize,
    nodes: &[[f64; 3]],
    faces: &[Vec<usize>],
    pressure: &[f64],
    exact: impl Fn(f64) -> f64,
) -> [f64; 2] {
    let line = gauss(POINTS);
    let across = if dim == 2 { vec![(0.0, 1.0)] } else { gauss(POINTS) };
    let order = if faces[0].len() == 3 { Order::Edges } else { Order::Linear };
    let kind = Kind::new(dim - 1, Cell::Box, order);
    let (mut square, mut whole) = (0.0, 0.0);
    let (mut force, mut areas) = (vec![0.0; nodes.len()], vec![0.0; nodes.len()]);
    for face in faces {
        let side = |c: usize| {
            let values = face.iter().map(|&node| nodes[node][c]);
            values.clone().fold(f64::MIN, f64::max) - values.fold(f64::MAX, f64::min)
        };
        let area: f64 = (0..dim - 1).map(side).product();
        for (s, v) in &line {
            for (t, w) in &across {
                let values = kind.values([*s, *t, 0.0]);
                let sum = |of: &dyn Fn(usize) -> f64| -> f64 {
                    face.iter().zip(&values).map(|(&node, value)| value * of(node)).sum()
                };
                let from_axis =
                    (0..dim - 1).map(|c| sum(&|node| nodes[node][c]).powi(2)).sum::<f64>().sqrt();
                let (found, exact) = (sum(&|node| pressure[node]), exact(from_axis));
                square += area * v * w * (found - exact).powi(2);
                whole += area * v * w * exact * exact;
                for (&node, value) in face.iter().zip(&values) {
                    force[node] += area * v * w * value * exact;
                    areas[node] += area * v * w * value;
                }
            }
        }
    }
    let loaded = (0..nodes.len()).filter(|&node| areas[node] > 0.0);
    let (mut of_means, mut all) = (0.0, 0.0);
    for node in loaded {
        let mean = force[node] / areas[node];
        of_means += areas[node] * (pressure[node] - mean).powi(2);
        all += areas[node] * mean * mean;
    }
    [(of_means / all).sqrt(), (square / whole).sqrt()]
}

/// Errors of meshes of growing fineness, each side slave: those of the interpolated field fall, and those of
/// the pairs are 3 % at most on the finest. The rim, half an element from a node, has most of them.
fn check(dim: usize, order: Order, elements: &[f64]) {
    for curved_is_slave in [false, true] {
        let (mut before, mut last) = (f64::INFINITY, f64::INFINITY);
        for &across in elements {
            let n = if curved_is_slave { across / FINER } else { across };
            let ([means, field, most, sum], pairs) =
                Contact::new(dim, order, n).errors(curved_is_slave);
            println!(
                "{dim}D {order:?}, curved slave {curved_is_slave}: {across:2} across, {pairs:4} pairs: \
                 p in L2 {:6.2} %, interpolated {:6.2} %, p0 {:6.2} %, P {sum:.0e}",
                100.0 * means,
                100.0 * field,
                100.0 * most
            );
            // The normals of the curved side are not vertical: 1 - cos(a / R) at most.
            assert!(sum.abs() < 0.5 * (A / RADIUS).powi(2), "{sum:e}");
            assert!(field < before, "{field} after {before}");
            before = field;
            last = means;
        }
        assert!(last <= 0.03, "{last}");
    }
}

#[test]
fn cylinder_on_a_flat_body() {
    check(2, Order::Linear, &[6.5, 12.5, 24.5, 48.5]);
}

#[test]
fn cylinder_of_quadratic_elements_on_a_flat_body() {
    check(2, Order::Edges, &[6.5, 12.5, 24.5]);
}

#[test]
fn paraboloid_on_a_flat_body() {
    check(3, Order::Linear, &[6.5, 12.5, 24.5]);
}
